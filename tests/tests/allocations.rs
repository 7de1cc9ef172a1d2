//! Laws and elements allocate nothing where time is spent.

use std::alloc::System;
use std::sync::Arc;

use fe_contact::envelope::{Bilinear, BilinearSlips};
use fe_contact::{BondSettings, Interface16, InterfaceRule, SlipDamage};
use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::followers::Followers;
use fe_core::kinematics::{Axial, Kinematics, Solid};
use fe_core::material::{Material, Operator, PointContext};
use fe_core::mesh::{CellKind, Mesh};
use fe_core::shape::hex20;
use fe_core::sparsity::{MatrixValues, Sparsity};
use fe_elements::{BandWidth, Bar, Dowel, Hex20, HexRule, Led, UniformHex20, embed};
use fe_materials::concrete::{
    Associated, Calibration, ConcreteScalars, Isochoric, Objective, Ottosen, Reference,
    ReferenceParameters, TensionStiffening,
};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_materials::{Biso, Elastic, VonMises};
use fe_solver::linear::{DirectSolver, LinearSolver};
use nalgebra::{Vector1, Vector6};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};

#[global_allocator]
static COUNTING: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Allocations while `work` runs.
fn allocations(work: impl FnOnce()) -> usize {
    let region = Region::new(COUNTING);
    work();
    let change = region.change();
    change.allocations + change.reallocations
}

fn law_allocations<K: Kinematics>(
    law: &dyn Material<K>,
    strain: impl Fn(usize) -> K::Vector,
) -> usize {
    let n = law.state_len();
    let (mut state, mut trial) = (vec![0.0; n], vec![0.0; n]);
    law.init_state(&mut state);
    let contexts = [Operator::None, Operator::Secant, Operator::Tangent]
        .map(|operator| PointContext::new(30.0).with_operator(operator));
    allocations(|| {
        for i in 0..2000 {
            for ctx in &contexts {
                law.update(&strain(i), &state, &mut trial, ctx).unwrap();
            }
            state.copy_from_slice(&trial);
        }
    })
}

/// Of an element after its first evaluation, while its history grows.
fn element_allocations(element: &dyn Element) -> usize {
    let mut state = vec![0.0; element.state_len()];
    element.init_state(&mut state);
    let virgin = state.clone();
    let mut trial = state.clone();
    let n = element.nodes().len() * element.dofs().len();
    let (mut force, mut stiffness) = (vec![0.0; n], vec![0.0; n * n]);
    let mut u = vec![0.0; n];
    let mut steps = |range: std::ops::Range<u32>| {
        for i in range {
            for (k, u) in u.iter_mut().enumerate() {
                *u = 1e-4 * f64::from(i) * (k as f64).sin();
            }
            for operator in [Operator::None, Operator::Secant, Operator::Tangent] {
                let out = ElementSystem {
                    force: &mut force,
                    stiffness: &mut stiffness,
                };
                let ctx = EvaluationContext::new(operator);
                element.evaluate(&u, &state, &mut trial, &ctx, out).unwrap();
            }
            state.copy_from_slice(&trial);
        }
    };
    steps(0..1);
    let counted = allocations(|| steps(1..200));
    assert_ne!(state, virgin, "nothing has happened");
    counted
}

/// Bytes that factorisations keep beyond those of the first ones, on one thread: of a grid of nodes with six equations each,
/// whose parts are eliminated apart.
fn kept_by_factorisations() -> usize {
    let (nodes, width) = (30, 6);
    let node = |x: u32, y: u32| (x * nodes + y) * width..(x * nodes + y + 1) * width;
    let cells = (0..nodes - 1).flat_map(|x| (0..nodes - 1).map(move |y| (x, y)));
    let groups: Vec<Vec<u32>> = cells
        .map(|(x, y)| {
            let corners = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
            corners.into_iter().flat_map(|(x, y)| node(x, y)).collect()
        })
        .collect();
    let n = (nodes * nodes * width) as usize;
    let pattern = Sparsity::from_groups(n, groups.iter().map(Vec::as_slice));
    let mut lower = vec![-1.0; pattern.nnz()];
    for &diagonal in &pattern.col_ptr()[..n] {
        lower[diagonal] = 1000.0;
    }
    let upper = Vec::new();
    let values = MatrixValues { lower, upper };
    let mut solver = DirectSolver::default();
    solver.analyze(&pattern).unwrap();
    let mut factorise = |times: usize| {
        for _ in 0..times {
            solver.factorize(&values).unwrap();
        }
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let change = pool.unwrap().install(|| {
        factorise(4);
        let region = Region::new(COUNTING);
        factorise(8);
        region.change()
    });
    change
        .bytes_allocated
        .saturating_sub(change.bytes_deallocated)
}

/// The law of the beams with their onset.
fn concrete() -> FixedCrack {
    let p = FixedCrackParameters::from_strength(35.0, 2.7, 32_000.0);
    let onset = Ottosen::new(&Calibration::model_code(p.fcm_mpa, p.ft_mpa)).unwrap();
    FixedCrack::new(p, Some(onset)).unwrap()
}

/// What beams are made of in a half body that is uniform across: a hexahedron, an oblique bar in it that yields, with a dowel that
/// slides, and an interface to a sheet below that comes off.
fn parts_of_a_beam(
    nodes: [usize; 20],
    coords: &[[f64; 3]; 20],
) -> [(&'static str, Box<dyn Element>); 3] {
    let mut mesh = Mesh::new(coords.to_vec()).unwrap();
    mesh.add_block("host", CellKind::Hex20, nodes.into())
        .unwrap();
    let face = hex20::FACES[2];
    let sheet = face.map(|a| mesh.add_node(coords[a]).unwrap());
    let mut followers = Followers::uniform_across(&mesh, nodes);
    followers.extend(Followers::uniform_across(&mesh, sheet));
    let (rule, band) = (HexRule::Irons, BandWidth::CubeRoot);
    let law = Arc::new(concrete());
    let hexahedron = UniformHex20::new(nodes, coords, &followers, rule, law, band).unwrap();
    let dowel = Dowel::he_kwan(16.0, 35.0, 2e5, 50.0, [0.0, 0.0, 1.0]).unwrap();
    let bar = Bar {
        name: "bar".into(),
        polyline: vec![[1.0, 5.0, 20.0], [49.0, 40.0, 20.0]],
        area_mm2: 201.0,
        law: Arc::new(Biso::hot_rolled(2e5, 50.0, 1e3).unwrap()),
        dowel: Some(dowel.bounded(16.0, 35.0, 50.0).unwrap()),
    };
    let bar = embed(&[bar], &mesh, &["host"]).unwrap().remove(0);
    let slips = BilinearSlips {
        strength_mpa: 3.0,
        peak_slip_mm: 0.005,
        final_slip_mm: 0.02,
    };
    let curve = Bilinear::from_slips(&slips).unwrap();
    let law = Arc::new(SlipDamage::new(curve, BondSettings::default()).unwrap());
    let sides = std::array::from_fn(|i| if i < 8 { face[i] } else { sheet[i - 8] });
    let (corners, rule) = (face.map(|a| coords[a]), InterfaceRule::Gauss3);
    let interface = Interface16::new(sides, &corners, [1.0, 0.0, 0.0], rule, law).unwrap();
    [
        ("uniform hexahedron", Box::new(hexahedron)),
        ("bar with dowel", Box::new(bar.led_by(&followers))),
        ("interface", Led::by(Box::new(interface), &followers)),
    ]
}

/// Protects the hot loop: an update of the laws of concrete and steel, the evaluation of a hexahedron, of its own nodes or hung
/// between others, and that of the parts of a beam that is uniform across, with and without operator, allocate nothing, from the
/// first strain to an open crack. And the memory of long runs: factorisations that follow one another keep no more than the first
/// ones. Tests of one binary share the counter, so there is one test.
#[test]
fn updates_and_elements_allocate_nothing_and_factorisations_keep_nothing() {
    let counted = allocations(|| drop(std::hint::black_box(vec![0_u8; 7])));
    assert_eq!(counted, 1, "the counter counts");
    let scalars = ConcreteScalars::from_mean(35.0).unwrap();
    let reference = ReferenceParameters::new(scalars, TensionStiffening::Stirrups);
    let solids: [&dyn Material<Solid>; 7] = [
        &concrete(),
        &Reference::new(&reference).unwrap(),
        &Associated::new(&scalars).unwrap(),
        &Objective::new(&scalars).unwrap(),
        &Isochoric::new(&scalars).unwrap(),
        &VonMises::new(2e5, 0.3, 400.0, 1e3).unwrap(),
        &Elastic::new(2e5, 0.3).unwrap(),
    ];
    let wave = |i: usize, k: usize| 2e-6 * i as f64 * (0.01 * (i * (k + 1)) as f64).sin();
    let solid = |i| Vector6::from_fn(|k, _| wave(i, k));
    for law in solids {
        assert_eq!(law_allocations(law, solid), 0, "{}", law.name());
    }
    let bar = Biso::hot_rolled(2e5, 400.0, 1e3).unwrap();
    assert_eq!(
        law_allocations::<Axial>(&bar, |i| Vector1::new(wave(i, 0))),
        0
    );

    let coords = hex20::NODES.map(|x| x.map(|c| 25.0 * (c + 1.0)));
    let nodes = std::array::from_fn(|a| a);
    let law = Arc::new(concrete());
    let hexahedron = || {
        let law = Arc::clone(&law);
        Box::new(Hex20::new(nodes, &coords, HexRule::Full, law, BandWidth::CubeRoot).unwrap())
    };
    let hung = Led::hung(hexahedron(), 19, &[(20, 0.5), (21, 0.5)]).unwrap();
    assert_eq!(element_allocations(hexahedron().as_ref()), 0, "hexahedron");
    assert_eq!(element_allocations(hung.as_ref()), 0, "hung hexahedron");
    for (name, element) in parts_of_a_beam(nodes, &coords) {
        assert_eq!(element_allocations(element.as_ref()), 0, "{name}");
    }
    let kept = kept_by_factorisations();
    assert!(
        kept < 10_000,
        "{kept} bytes more after eight factorisations"
    );
}
