//! The check of an element.

use super::difference::Differences;
use super::drive::Drive;
use super::failure::{CheckFailure, few_kinks};
use super::path::RandomPath;
use super::random::Random;
use super::rigid::motions;
use super::settings::{ElementCheck, ElementReport};
use crate::element::Element;

/// Drives an element along random displacement paths; `coords` (mm) are the positions of its nodes.
///
/// - Rigid-body translations and small rotations of the virgin element give no force, as far as the
///   element has the displacements for them.
/// - Two calls, with NaN and with numbers in `trial` before, answer the same to the last bit, and all of
///   it finite; asked for forces only, the element gives the same forces and state.
/// - Where it [fills the symmetric part](Element::fills_symmetric_part), that is (K + K^T)/2.
/// - The nodal forces have neither a resultant force nor a moment.
/// - The stiffness is the derivative of the force, by central differences, and thereby symmetric where
///   [`Element::unsymmetric`] promises it (only the upper triangle is read then). Kinks are treated as in
///   [`check_material`](super::check_material), and so is what the element latches.
/// - The secant operator has no negative eigenvalue.
/// - At the same displacements, from the state just written, the forces are the same again.
///
/// Not checked is [`Element::free_energy`]: the check of the law is what proves it. Elements are taken to be
/// geometrically linear: small rotations give no force, and moments are taken about the positions at rest. Of others
/// an infinite `rigid_tolerance` and `balance_tolerance` leave the rest of the demands.
///
/// # Errors
///
/// The first [`CheckFailure`], with path, step, component and values.
pub fn check_element(
    element: &dyn Element,
    coords: &[[f64; 3]],
    check: &ElementCheck,
) -> Result<ElementReport, CheckFailure> {
    check.validate(element, coords)?;
    let n = coords.len() * element.dofs().len();
    let mut differences = Differences::new(n, &check.amplitude, check.difference_step);
    let mut random = Random::new(check.seed);
    let mut report = ElementReport::default();
    let motions = motions(coords, element.dofs(), check.in_plane);
    report.motions = motions.len();
    for path in 0..check.paths {
        let mut drive = Drive::start(element, check, path, n)?;
        for motion in &motions {
            report.worst_rigid = report.worst_rigid.max(drive.rigid(motion)?);
        }
        let mut displacements = RandomPath::new(check.seed, path, &check.amplitude, n);
        for step in 0..check.steps {
            drive.place.step = step;
            let u = displacements.step();
            let answer = drive.repeatable(u, random.uniform(-1e3, 1e3))?;
            for motion in &motions {
                report.worst_balance = report.worst_balance.max(drive.balance(motion, &answer)?);
            }
            drive.latch(&answer);
            let latched = drive.repeatable(u, random.uniform(-1e3, 1e3))?;
            match drive.tangent(u, &latched, &mut differences)? {
                Some(error) => report.worst_tangent = report.worst_tangent.max(error),
                None => report.kinks += 1,
            }
            report.steps += 1;
            drive.secant(u)?;
            drive.settle(u, answer)?;
        }
    }
    few_kinks(report.kinks, report.steps, check.kink_share)?;
    Ok(report)
}
