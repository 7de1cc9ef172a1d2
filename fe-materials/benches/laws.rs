//! One update with consistent tangent of every law, in a state where the law has most to do; and of the
//! concrete laws in an elastic state. The law of the beams also for the points of a hexahedron at once, by the point.

use std::hint::black_box;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use fe_core::kinematics::{Axial, Kinematics, PlaneStress, Solid};
use fe_core::material::{Material, PointContext};
use fe_materials::concrete::{
    Associated, Calibration, ConcreteScalars, Isochoric, Objective, Ottosen, Reference,
    ReferenceParameters, TensionStiffening,
};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_materials::{Biso, Elastic, Lamina, LaminaParameters, VonMises};
use nalgebra::Vector6;

/// Updates from the state at `first` to `second`.
fn bench<K: Kinematics>(
    c: &mut Criterion,
    name: &str,
    law: &dyn Material<K>,
    first: &[f64],
    second: &[f64],
) {
    let ctx = PointContext::new(30.0);
    let mut virgin = vec![0.0; law.state_len()];
    law.init_state(&mut virgin);
    let mut state = virgin.clone();
    law.update(&K::vector(first), &virgin, &mut state, &ctx)
        .unwrap();
    let (strain, mut trial) = (K::vector(second), virgin);
    c.bench_function(name, |b| {
        b.iter(|| law.update(&strain, &state, &mut trial, &ctx).unwrap());
    });
}

/// The same with all `POINTS` of a hexahedron at once; time of one of them.
fn bench_many(
    c: &mut Criterion,
    name: &str,
    law: &dyn Material<Solid>,
    [first, second]: &[[f64; 6]; 2],
) {
    const POINTS: u32 = 27;
    let ctx = PointContext::new(30.0);
    let mut state = vec![0.0; law.state_len() * POINTS as usize];
    let mut trial = state.clone();
    let strains = |e: &[f64; 6]| [Vector6::from(*e); POINTS as usize];
    law.update_many(&strains(first), (&trial, &mut state), &ctx, &mut |_, _| ())
        .unwrap();
    let strains = strains(second);
    c.bench_function(name, |b| {
        b.iter_custom(|times| {
            let start = Instant::now();
            for _ in 0..times {
                law.update_many(&strains, (&state, &mut trial), &ctx, &mut |_, answer| {
                    black_box(answer);
                })
                .unwrap();
            }
            start.elapsed() / POINTS
        });
    });
}

fn laws(c: &mut Criterion) {
    let concrete = ConcreteScalars::from_characteristic(30.0).unwrap();
    let intact = [
        [2e-5, 1e-5, 1e-5, 1e-6, -1e-6, 2e-6],
        [3e-5, 1e-5, 1e-5, 2e-6, -1e-6, 2e-6],
    ];
    let crushed = [
        [-1.0e-3, 3e-4, 2e-4, 2e-4, -1e-4, 3e-4],
        [-1.2e-3, 5e-4, 4e-4, 3e-4, -1e-4, 3e-4],
    ];
    let cracked = [
        [8e-4, -1e-4, -2e-4, 2e-4, -1e-4, 3e-4],
        [9e-4, -2e-4, -2e-4, 4e-4, -1e-4, 3e-4],
    ];
    let yielded = [
        [6e-3, -2e-3, -3e-3, 2e-3, 0.0, 1e-3],
        [7e-3, -2e-3, -3e-3, 3e-3, 0.0, 1e-3],
    ];
    let solid = |c: &mut Criterion, name: &str, law: &dyn Material<Solid>, path: &[[f64; 6]; 2]| {
        bench(c, name, law, &path[0], &path[1]);
    };
    solid(c, "elastic", &Elastic::new(30e3, 0.2).unwrap(), &cracked);
    let steel = VonMises::new(200e3, 0.3, 400.0, 2e3).unwrap();
    solid(c, "von Mises", &steel, &yielded);
    let law = Associated::new(&concrete).unwrap();
    solid(c, "associated", &law, &crushed);
    let law = Isochoric::new(&concrete).unwrap();
    solid(c, "isochoric, elastic", &law, &intact);
    solid(c, "isochoric, crushing", &law, &crushed);
    let law = Objective::new(&concrete).unwrap();
    solid(c, "objective, elastic", &law, &intact);
    solid(c, "objective, crushing", &law, &crushed);
    solid(c, "objective, cracked", &law, &cracked);
    let p = ReferenceParameters::new(concrete, TensionStiffening::Stirrups);
    let law = Reference::new(&p).unwrap();
    solid(c, "reference, elastic", &law, &intact);
    solid(c, "reference, crushing", &law, &crushed);
    solid(c, "reference, cracked", &law, &cracked);
    let p = FixedCrackParameters::from_strength(
        concrete.fcm_mpa,
        concrete.fctm_mpa,
        concrete.young_mpa,
    );
    let surface = Ottosen::new(&Calibration::model_code(p.fcm_mpa, p.ft_mpa)).unwrap();
    let law = FixedCrack::new(p, Some(surface)).unwrap();
    solid(c, "fixed crack, elastic", &law, &intact);
    solid(c, "fixed crack, crushing", &law, &crushed);
    solid(c, "fixed crack, cracked", &law, &cracked);
    for (name, path) in [
        ("elastic", &intact),
        ("crushing", &crushed),
        ("cracked", &cracked),
    ] {
        bench_many(c, &format!("fixed crack, {name}, of 27"), &law, path);
    }
    let bar = Biso::hot_rolled(200e3, 460.0, 2e3).unwrap();
    bench::<Axial>(c, "bilinear bar", &bar, &[3e-3], &[4e-3]);
    let sheet = Lamina::new(&LaminaParameters {
        young_1_mpa: 228e3,
        young_2_mpa: 10.0,
        shear_mpa: 10.0,
        poisson_12: 0.0,
        strength_mpa: 3790.0,
    });
    let strain = [5e-3, 1e-4, 1e-3];
    bench::<PlaneStress>(c, "lamina", &sheet.unwrap(), &strain, &strain);
}

criterion_group!(benches, laws);
criterion_main!(benches);
