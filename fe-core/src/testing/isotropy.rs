//! The check of isotropy.

use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

use super::difference::norm;
use super::failure::{CheckFailure, Place, finite};
use super::path::RandomPath;
use super::random::Random;
use super::settings::MaterialCheck;
use super::walk::entries;
use crate::kinematics::{Kinematics, Solid};
use crate::material::{Material, Operator};
use crate::voigt;

/// What [`check_isotropy`] has seen.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct IsotropyReport {
    /// Steps checked.
    pub steps: usize,
    /// Worst disagreement, relative to the largest stress of its path so far or to the virgin stiffness times the strain,
    /// whichever is more.
    pub worst: f64,
}

/// Drives a law along random strain paths and along the same paths seen from randomly rotated axes, and
/// compares the stresses: sigma(T e) = T_s sigma(e), with the transformations of [`voigt`].
///
/// Stresses are compared relative to the largest of their path so far, or to the virgin stiffness times the strain where that
/// is more: what a crack leaves of a stress is rounding.
///
/// Every step of a path is taken, so the history (the axes of cracks, a back stress) must turn along.
///
/// # Errors
///
/// [`CheckFailure::Anisotropic`], or the error of the law.
pub fn check_isotropy(
    law: &dyn Material<Solid>,
    check: &MaterialCheck,
) -> Result<IsotropyReport, CheckFailure> {
    check.validate()?;
    let ctx = check.context.with_operator(Operator::None);
    let mut report = IsotropyReport::default();
    let stiffness = virgin_stiffness(law, check)?;
    for path in 0..check.paths {
        let axes = random_axes(&mut Random::new(check.seed ^ path as u64));
        let (turn_strain, turn_stress) = (
            voigt::strain_transform(&axes),
            voigt::stress_transform(&axes),
        );
        let mut virgin = vec![0.0; law.state_len()];
        law.init_state(&mut virgin);
        let mut histories = [virgin.clone(), virgin.clone()];
        let mut trial = virgin;
        let mut strains = RandomPath::new(check.seed, path, &check.amplitude, 6);
        let mut scale = 0.0_f64;
        for step in 0..check.steps {
            let place = Place { path, step };
            let strain = Vector6::from_column_slice(strains.step());
            let mut stress = [Vector6::zeros(); 2];
            for (k, e) in [strain, turn_strain * strain].iter().enumerate() {
                stress[k] = law
                    .update(e, &histories[k], &mut trial, &ctx)
                    .map_err(|source| CheckFailure::material(place, source))?
                    .stress;
                histories[k].copy_from_slice(&trial);
            }
            let (expected, rotated) = (turn_stress * stress[0], stress[1]);
            scale = scale.max(expected.amax()).max(stiffness * strain.amax());
            let limit = check.isotropy_tolerance * scale;
            for i in 0..6 {
                let error = (rotated[i] - expected[i]).abs();
                if error.is_nan() || error > limit {
                    return Err(CheckFailure::Anisotropic {
                        place,
                        component: Solid::STRESS_LABELS[i],
                        rotated: rotated[i],
                        expected: expected[i],
                        limit,
                    });
                }
                if error > 0.0 {
                    report.worst = report.worst.max(error / scale);
                }
            }
            report.steps += 1;
        }
    }
    Ok(report)
}

/// Norm of the tangent of the virgin state.
fn virgin_stiffness(law: &dyn Material<Solid>, check: &MaterialCheck) -> Result<f64, CheckFailure> {
    let mut virgin = vec![0.0; law.state_len()];
    law.init_state(&mut virgin);
    let mut trial = virgin.clone();
    let ctx = check.context.with_operator(Operator::Tangent);
    let place = Place { path: 0, step: 0 };
    let response = law
        .update(&Vector6::zeros(), &virgin, &mut trial, &ctx)
        .map_err(|source| CheckFailure::material(place, source))?;
    let tangent = entries::<Solid>(&response.tangent);
    finite(place, &tangent, |_| "virgin tangent".to_owned())?;
    Ok(norm(&tangent))
}

/// Axes turned by up to pi about a random direction.
fn random_axes(random: &mut Random) -> Matrix3<f64> {
    let direction = Vector3::from_fn(|_, _| random.uniform(-1.0, 1.0));
    let angle = random.uniform(0.0, std::f64::consts::PI);
    Rotation3::new(direction.normalize() * angle).into_inner()
}
