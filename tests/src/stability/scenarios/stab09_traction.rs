//! STAB-09: traction along an elastic strip in interface elements of 20 mm, with stiffness from that of a bond
//! (76.9 MPa/mm) to that of a penalty (1e6 MPa/mm).
//!
//! Source: J. C. J. Schellekens and R. de Borst, Int. J. Numer. Meth. Engng 36 (1993) 43-66: Gauss points couple the
//! nodes of an interface and the traction oscillates where it has a steep gradient; points on the nodes do not. The exact
//! traction, K delta cosh(lambda x)/cosh(lambda L), has one sign.

use std::sync::Arc;

use fe_contact::envelope::{Bilinear, BilinearEnergy};
use fe_contact::{BondSettings, InterfaceRule, SlipDamage};
use fe_core::dof::Dof;

use crate::mesh::lines;
use crate::solve::solve;
use crate::stability::{Case, Failure, Figure, Method, Scenario};
use crate::strip::Strip;

/// Bond that stays elastic.
pub(super) fn elastic(stiffness: f64) -> Result<SlipDamage, Failure> {
    let curve = Bilinear::from_energy(&BilinearEnergy {
        strength_mpa: 1e9,
        stiffness_mpa_per_mm: stiffness,
        fracture_energy_n_per_mm: 1e18,
    });
    Ok(SlipDamage::new(curve?, BondSettings::default())?)
}

/// Least over largest traction along a strip of 400 mm that is pulled by 0.01 mm.
fn least_over_largest(stiffness: f64, rule: InterfaceRule) -> Result<f64, Failure> {
    let law = Arc::new(elastic(stiffness)?);
    let strip = Strip::new(&lines(0.0, 400.0, 20), rule, &(law as _))?;
    let mut conditions = strip.held()?;
    for (node, _) in strip.line(400.0) {
        conditions.prescribe(&strip.model, node, Dof::Ux, 0.01)?;
    }
    let solution = solve(&strip.model, conditions)?;
    let (mut least, mut largest) = (0.0_f64, 0.0_f64);
    for (e, element) in strip.model.elements().iter().enumerate().skip(20) {
        let u = strip.model.gather(e, &solution.displacement);
        element.sample(&u, solution.state.committed(e), &mut |s| {
            least = least.min(s.stress[0]);
            largest = largest.max(s.stress[0]);
        })?;
    }
    Ok(least / largest)
}

/// With the stiffness of a bond (element over characteristic length 0.9) no rule oscillates; from 1e4 MPa/mm on, Gauss
/// points are known to.
fn figures() -> Result<Vec<Figure>, Failure> {
    let mut figures = Vec::new();
    for (rule, at_1e4, at_1e6) in [
        (InterfaceRule::Gauss2, -0.50, -0.93),
        (InterfaceRule::Gauss3, -0.12, -0.24),
    ] {
        for (stiffness, target) in [(1e4, at_1e4), (1e6, at_1e6)] {
            let found = least_over_largest(stiffness, rule)?;
            let name = format!("least over largest traction, {rule:?}, {stiffness:e} MPa/mm");
            figures.push(Figure::near(name, found, target, 0.04));
        }
    }
    for rule in [
        InterfaceRule::Gauss2,
        InterfaceRule::Gauss3,
        InterfaceRule::Lobatto3,
    ] {
        let found = least_over_largest(76.9, rule)?;
        figures.push(Figure::at_least(
            format!("{rule:?}, 76.9 MPa/mm"),
            found,
            0.0,
        ));
    }
    let found = least_over_largest(1e6, InterfaceRule::Lobatto3)?;
    figures.push(Figure::at_least("Lobatto3, 1e6 MPa/mm", found, -0.01));
    Ok(figures)
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-09",
    title: "dummy stiffness: traction of an interface oscillates with a penalty, not with a bond",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
