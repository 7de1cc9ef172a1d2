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

/// Up to 1e3 MPa/mm (element over characteristic length 0.9 with that of a bond) no rule oscillates; from 1e4 MPa/mm on, Gauss
/// points do. Points on the nodes hardly do at 1e4 MPa/mm, and at 1e6 MPa/mm by less than a ten-thousandth, where the catalogue
/// has 0.
fn figures() -> Result<Vec<Figure>, Failure> {
    let measure = |rule: InterfaceRule, stiffness: f64| -> Result<(String, f64), Failure> {
        let name = format!("least over largest traction, {rule:?}, {stiffness:e} MPa/mm");
        Ok((name, least_over_largest(stiffness, rule)?))
    };
    let mut figures = Vec::new();
    for (rule, at_1e4, at_1e6) in [
        (InterfaceRule::Gauss2, -0.50, Some(-0.93)),
        (InterfaceRule::Gauss3, -0.12, Some(-0.24)),
        (InterfaceRule::Lobatto3, -0.006, None),
    ] {
        for stiffness in [76.9, 1e3] {
            let (name, found) = measure(rule, stiffness)?;
            figures.push(Figure::at_least(name, found, 0.0));
        }
        let (name, found) = measure(rule, 1e4)?;
        figures.push(Figure::near(name, found, at_1e4, 0.04));
        let (name, found) = measure(rule, 1e6)?;
        figures.push(match at_1e6 {
            Some(target) => Figure::near(name, found, target, 0.04),
            None => Figure::at_least(name, found, -1e-4).measured("0"),
        });
    }
    Ok(figures)
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-09",
    title: "dummy stiffness: traction of an interface oscillates with a penalty, not with a bond",
    remark: "",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
