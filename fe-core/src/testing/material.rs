//! The check of a constitutive law.

use super::failure::{CheckFailure, few_kinks};
use super::path::RandomPath;
use super::settings::{MaterialCheck, MaterialReport};
use super::walk::Walk;
use crate::kinematics::Kinematics;
use crate::material::Material;

/// Drives a law along random strain paths and holds every step against the contract of [`Material`]:
///
/// - two calls, with NaN and with numbers in `trial` before, answer the same to the last bit, and all
///   of it finite: the law writes every state variable and reads none of them;
/// - the stress and the new state do not depend on the operator asked for;
/// - an update without strain increment, from the state just written or from the committed one with
///   what this step [latches](Material::latch), gives the same stress;
/// - [`Operator::Tangent`](crate::material::Operator::Tangent) is the derivative of the stress, by central differences of this very update, once
///   what the step latches is held.
///   A column that disagrees is excused only where the one-sided differences disagree by more (a kink),
///   and the share of such steps is bounded by [`MaterialCheck::kink_share`];
/// - the tangent is symmetric unless the law [announces](Material::unsymmetric_tangent) that it is not;
/// - [`Operator::Secant`](crate::material::Operator::Secant) is symmetric positive definite;
/// - sigma_(n+1) : d_eps - d_psi >= 0 if the law has a [free energy](Material::free_energy), which is finite.
///
/// # Errors
///
/// The first [`CheckFailure`], with path, step, component and values.
pub fn check_material<K: Kinematics>(
    law: &dyn Material<K>,
    check: &MaterialCheck,
) -> Result<MaterialReport, CheckFailure> {
    check.validate()?;
    let mut report = MaterialReport {
        least_pivot: f64::INFINITY,
        ..MaterialReport::default()
    };
    for path in 0..check.paths {
        let mut walk = Walk::start(law, check, path)?;
        let mut strains = RandomPath::new(check.seed, path, &check.amplitude, K::LEN);
        for step in 0..check.steps {
            walk.step(step, &K::vector(strains.step()), &mut report)?;
        }
    }
    few_kinks(report.kinks, report.steps, check.kink_share)?;
    Ok(report)
}
