//! Points asked together answer as each does alone.

use super::failure::{CheckFailure, Place, equal};
use crate::kinematics::Kinematics;
use crate::material::{Material, Operator, PointContext, Response};

const BETWEEN: &str = "alone and with other points in one call (update_many)";

/// Asks the law for some points from one committed state, together and one by one, with every operator: stresses,
/// operators and states are the same to the last bit.
pub(super) fn together<K: Kinematics>(
    law: &dyn Material<K>,
    (strains, committed): (&[K::Vector], &[f64]),
    context: &PointContext,
    place: Place,
) -> Result<(), CheckFailure> {
    let n = committed.len();
    let before = committed.repeat(strains.len());
    for operator in [Operator::None, Operator::Secant, Operator::Tangent] {
        let ctx = context.with_operator(operator);
        let mut after = vec![f64::NAN; before.len()];
        let mut taken: Vec<Option<Response<K>>> = vec![None; strains.len()];
        law.update_many(
            strains,
            (&before, &mut after),
            &ctx,
            &mut |point, response| {
                if let Some(taken) = taken.get_mut(point) {
                    *taken = Some(*response);
                }
            },
        )
        .map_err(|(_, source)| CheckFailure::material(place, source))?;
        for (point, (strain, taken)) in strains.iter().zip(&taken).enumerate() {
            let mut state = vec![f64::NAN; n];
            let alone = law
                .update(strain, committed, &mut state, &ctx)
                .map_err(|source| CheckFailure::material(place, source))?;
            let own = &after[point * n..(point + 1) * n];
            let label = |what: &str| format!("{what} of point {point}");
            equal(place, &state, own, BETWEEN, |i| {
                label(&format!("state variable {i}"))
            })?;
            let numbers = |response: &Response<K>| {
                let operator = (0..K::LEN * K::LEN)
                    .filter(|_| operator != Operator::None)
                    .map(|k| K::entry(&response.tangent, k / K::LEN, k % K::LEN));
                let stress = K::components(&response.stress).iter().copied();
                stress.chain(operator).collect::<Vec<f64>>()
            };
            let alone = numbers(&alone);
            let with_others = taken.as_ref().map(numbers);
            let with_others = with_others.unwrap_or_else(|| vec![f64::NAN; alone.len()]);
            equal(place, &alone, &with_others, BETWEEN, |i| {
                label(if i < K::LEN { "stress" } else { "operator" })
            })?;
        }
    }
    Ok(())
}
