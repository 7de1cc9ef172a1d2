//! Bare beam of 3050 x 305 x 75 mm, E = 30 000 MPa, nu = 0.2, supports and loads on lines.
//!
//! Source: the same model solved with CalculiX 2.20, Kratos 10.4, Akantu 5.0, FElupe 11.3 (8 points) and OpenSees
//! 3.7, Kratos, FElupe (27 points), which agree to the last digit printed.

use fe_core::dof::Dof;
use fe_core::testing::within;
use fe_elements::HexRule;
use fe_tests::beam::bare_beam;
use fe_tests::laws::elastic;
use fe_tests::solve::solve;

fn reaction(cells: [usize; 3], rule: HexRule) -> f64 {
    let beam = bare_beam(cells, rule, &elastic(30_000.0, 0.2).unwrap()).unwrap();
    let solution = solve(&beam.model, beam.conditions).unwrap();
    solution.reaction(&beam.model, &beam.supports, Dof::Uy)
}

/// Protects element, assembly, constraints, solver and reactions together. Target: 41 128.09 N (2 x 2 x 2) and
/// 41 166.10 N (3 x 3 x 3) at 1 mm, within 0.01 N.
#[test]
fn sixty_by_four_by_one() {
    let load = reaction([60, 4, 1], HexRule::Reduced);
    within("load (N), 60 x 4 x 1, Reduced", load, 41_128.09, 0.01);
    let load = reaction([60, 4, 1], HexRule::Full);
    within("load (N), 60 x 4 x 1, Full", load, 41_166.10, 0.01);
}

/// The same on another mesh. Target: 38 061.6 N and 38 102 N, to the digits given.
#[test]
fn thirty_two_by_three_by_one() {
    let load = reaction([32, 3, 1], HexRule::Reduced);
    within("load (N), 32 x 3 x 1, Reduced", load, 38_061.6, 0.05);
    let load = reaction([32, 3, 1], HexRule::Full);
    within("load (N), 32 x 3 x 1, Full", load, 38_102.0, 0.5);
}
