//! Protects elements that use a node more than once, as a hexahedron collapsed to a wedge does: the entries (i, j) and (j, i)
//! of its matrix go to one entry of the diagonal.

use std::sync::Arc;

use fe_core::assembly::{Assembled, Assembler};
use fe_core::element::EvaluationContext;
use fe_core::material::Operator;
use fe_core::mesh::Mesh;
use fe_core::model::{Conditions, Model};
use fe_core::shape::hex20;
use fe_core::state::StateStore;
use fe_core::voigt::isotropic;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_tests::laws::Linear;

/// The hexahedron of side 2 whose face x = -1 is drawn together to the edge y = 0.
fn wedge() -> ([usize; 20], Vec<[f64; 3]>) {
    let mut nodes: [usize; 20] = std::array::from_fn(|a| a);
    for (gone, kept) in [(3, 0), (11, 0), (7, 4), (15, 4), (19, 16)] {
        nodes[gone] = kept;
    }
    let mut places = hex20::NODES.to_vec();
    for (node, place) in [
        (0, [-1.0, 0.0, -1.0]),
        (4, [-1.0, 0.0, 1.0]),
        (16, [-1.0, 0.0, 0.0]),
        (8, [0.0, -0.5, -1.0]),
        (10, [0.0, 0.5, -1.0]),
        (12, [0.0, -0.5, 1.0]),
        (14, [0.0, 0.5, 1.0]),
    ] {
        places[node] = place;
    }
    (nodes, places)
}

/// Target: K u = f of the linear wedge within rounding, with a symmetric matrix and with one that is not.
#[test]
fn a_collapsed_hexahedron_has_the_stiffness_of_its_forces() {
    let (nodes, places) = wedge();
    let own = nodes.map(|n| places[n]);
    let symmetric = isotropic(3e4, 0.2);
    let mut skewed = symmetric;
    skewed[(0, 1)] *= 2.0;
    skewed[(3, 0)] = 1e4;
    for d in [symmetric, skewed] {
        let law = Arc::new(Linear(d));
        let element = Hex20::new(nodes, &own, HexRule::Full, law, BandWidth::CubeRoot).unwrap();
        let mesh = Mesh::new(places.clone()).unwrap();
        let model = Model::new(mesh, vec![Box::new(element)]).unwrap();
        let mut state = StateStore::new(model.elements());
        let mut assembler = Assembler::new(&model, &Conditions::new(&model)).unwrap();
        let n = model.dofs().len();
        let u: Vec<f64> = (0..n).map(|i| 1e-3 * ((i * i) as f64).sin()).collect();
        let mut out = Assembled::default();
        let tangent = EvaluationContext::new(Operator::Tangent);
        assembler
            .evaluate(&model, &u, &mut state, &tangent, &mut out)
            .unwrap();
        assert_eq!(out.matrix.is_symmetric(), d == symmetric);
        let mut product = vec![0.0; n];
        out.matrix.multiply(assembler.pattern(), &u, &mut product);
        let largest = out.internal.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        for (ku, f) in product.iter().zip(&out.internal) {
            assert!((ku - f).abs() < 1e-12 * largest, "{ku} for {f}");
        }
    }
}
