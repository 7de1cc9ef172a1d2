//! EL-05: Cook's membrane, E = 1, nu = 1/3, thickness 1, unit shear force on the right edge; 8-node quadrilaterals.
//!
//! Source: R. D. Cook, "Improved two-dimensional finite element", ASCE J. Struct. Div. 100 (1974) 1851-1863; deflection of
//! the middle of the right edge 23.96 in the limit. Values per mesh: computed independently of this project.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::PlaneStress;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_elements::QuadRule;
use fe_materials::Elastic;
use fe_tests::conditions::hold;
use fe_tests::mesh::{quadrilaterals, sheets};
use fe_tests::solve::solve;

/// Deflection of the middle of the right edge with n x n elements.
fn deflection(n: usize, rule: QuadRule) -> f64 {
    let mesh = quadrilaterals(n, |s, t| [48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s)]).unwrap();
    let law: Arc<dyn Material<PlaneStress>> = Arc::new(Elastic::new(1.0, 1.0 / 3.0).unwrap());
    let elements = sheets(&mesh, 1.0, rule, &law).unwrap();
    let model = Model::new(mesh, elements);
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &[Dof::Ux, Dof::Uy], |x| {
        x[0] == 0.0
    })
    .unwrap();
    // Consistent forces of a uniform traction on each edge: 1/6, 2/3, 1/6 of its share.
    let step = 16.0 / (2 * n) as f64;
    let mut middle = 0;
    for (node, x) in model
        .mesh()
        .nodes()
        .iter()
        .enumerate()
        .filter(|(_, x)| x[0] == 48.0)
    {
        let place = ((x[1] - 44.0) / step).round() as usize;
        let weight = match place {
            _ if place % 2 == 1 => 4.0,
            0 => 1.0,
            _ if place == 2 * n => 1.0,
            _ => 2.0,
        };
        let share = weight / (6 * n) as f64;
        conditions
            .add_reference(&model, node, Dof::Uy, share)
            .unwrap();
        if place == n {
            middle = node;
        }
    }
    solve(&model, conditions)
        .unwrap()
        .at(&model, middle, Dof::Uy)
}

/// Protects the quadrilateral. Targets: 22.718, 23.708, 23.884, 23.955 (9 points) and 23.171, 23.726, 23.888, 23.957
/// (4 points) with 2, 4, 8, 32 elements per side, within 0.001 (0.0015 for the last digit rounded).
#[test]
fn deflection_converges_to_the_published_value() {
    for (n, full, reduced) in [
        (2, 22.718, 23.171),
        (4, 23.708, 23.726),
        (8, 23.884, 23.888),
        (32, 23.955, 23.957),
    ] {
        for (rule, target) in [(QuadRule::Full, full), (QuadRule::Reduced, reduced)] {
            let found = deflection(n, rule);
            assert!((found - target).abs() < 1e-3, "{n} {rule:?}: {found}");
        }
    }
    assert!((deflection(32, QuadRule::Full) - 23.96).abs() < 0.01);
}
