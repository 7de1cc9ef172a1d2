//! STR-02: element size against the error of the peak load of a long bonded strip; rules of integration.
//!
//! Source: closed form P_u = b_f sqrt(2 G_f E_f t_f) (Yuan, Teng, Seracino, Wu and Yao 2004). The process zone a_u is 81 mm
//! in the strip of STR-01; linear bars with nodal springs err by 86, 53, 3.9, 6.7, 2.3, 0.8, 0.08, 0.01 % with elements
//! of 100, 80, 50, 40, 25, 20, 10, 5 mm there (computed apart from this project).

use std::sync::Arc;

use fe_contact::envelope::{Bilinear, LuJoint};
use fe_contact::{BondSettings, InterfaceRule, PullOut, SlipDamage};
use fe_core::dof::Dof;
use fe_solver::control::StepControl;
use fe_solver::secant::{SecantAnderson, SecantSettings};
use fe_tests::mesh::lines;
use fe_tests::solve::run;
use fe_tests::strip::{Strip, THICKNESS, WIDTH, YOUNG, bond};

/// Largest force over the closed form while a strip of `n` elements is pulled to `end` (mm).
fn peak(bond: Bilinear, size: f64, n: usize, rule: InterfaceRule, end: f64) -> f64 {
    let law = SlipDamage::new(bond, BondSettings::default()).unwrap();
    let length = size * n as f64;
    let strip = Strip::new(&lines(0.0, length, n), rule, &(Arc::new(law) as _)).unwrap();
    let mut conditions = strip.held().unwrap();
    for (node, _) in strip.line(length) {
        conditions
            .prescribe(&strip.model, node, Dof::Ux, 1.0)
            .unwrap();
    }
    let control = StepControl {
        criterion: 1e-4,
        ..StepControl::new(0.005, end)
    };
    let mut driver = SecantAnderson::new(SecantSettings::default());
    let mut largest = 0.0_f64;
    run(
        &strip.model,
        conditions,
        &control,
        &mut driver,
        |_| {},
        |view| largest = largest.max(view.load),
    )
    .unwrap();
    let closed = PullOut::new(bond, YOUNG * THICKNESS).unwrap();
    largest / (WIDTH * closed.ultimate())
}

#[test]
fn probe() {
    for (size, n) in [
        (100.0, 5),
        (80.0, 5),
        (50.0, 8),
        (40.0, 10),
        (25.0, 16),
        (20.0, 20),
        (10.0, 40),
        (5.0, 80),
    ] {
        print!("{size}:");
        for rule in [
            InterfaceRule::Gauss3,
            InterfaceRule::Gauss2,
            InterfaceRule::Lobatto3,
        ] {
            print!(
                " {:+.3}%",
                100.0 * (peak(bond().unwrap(), size, n, rule, 0.8) - 1.0)
            );
        }
        println!();
    }
    let joint = LuJoint::from_cylinder_strength(35.5, 1.0);
    for (size, n) in [(76.0, 6), (51.0, 9), (38.0, 12), (25.0, 18), (12.5, 36)] {
        print!("{size}:");
        for rule in [
            InterfaceRule::Gauss3,
            InterfaceRule::Gauss2,
            InterfaceRule::Lobatto3,
        ] {
            print!(
                " {:.2}",
                152.60 * peak(joint.bilinear().unwrap(), size, n, rule, 0.8)
            );
        }
        println!();
    }
}
