//! Points asked together answer as each does alone.

use super::failure::{CheckFailure, equal};
use super::walk::{Answer, Walk, entries, tangent_label};
use crate::kinematics::Kinematics;
use crate::material::Operator;

/// Shares of the step at which points are asked together: more than vectors are wide.
const SHARES: [f64; 9] = [1.0, 0.0, 0.9, 0.5, 0.1, 0.7, 0.3, 0.8, 0.2];

const BETWEEN: &str = "alone and with other points in one call (update_many)";

impl<K: Kinematics> Walk<'_, K> {
    /// Asks the law for points on the way to `strain`, all from the committed state, together and one by one, with every
    /// operator: stresses, operators and states are the same to the last bit.
    pub(super) fn together(&self, strain: &K::Vector) -> Result<(), CheckFailure> {
        let strains = SHARES.map(|share| self.between(strain, share));
        let n = self.committed.len();
        let before = self.committed.repeat(strains.len());
        for operator in [Operator::None, Operator::Secant, Operator::Tangent] {
            let alone = strains
                .iter()
                .map(|strain| self.update(strain, operator, &self.committed, f64::NAN))
                .collect::<Result<Vec<_>, _>>()?;
            let mut after = vec![f64::NAN; before.len()];
            // A point that is not answered stays without a number.
            let mut responses: Vec<_> = alone.iter().map(|answer| answer.response).collect();
            for response in &mut responses {
                response.stress = K::vector(&vec![f64::NAN; K::LEN]);
            }
            let ctx = self.check.context.with_operator(operator);
            self.law
                .update_many(&strains, (&before, &mut after), &ctx, &mut |p, answer| {
                    if let Some(response) = responses.get_mut(p) {
                        *response = *answer;
                    }
                })
                .map_err(|(_, source)| CheckFailure::material(self.place, source))?;
            for (p, (alone, response)) in alone.iter().zip(responses).enumerate() {
                let state = after[p * n..(p + 1) * n].to_vec();
                let together = Answer { response, state };
                self.same(alone, &together, BETWEEN)?;
                if operator != Operator::None {
                    let [first, second] =
                        [alone, &together].map(|a| entries::<K>(&a.response.tangent));
                    equal(self.place, &first, &second, BETWEEN, tangent_label::<K>)?;
                }
            }
        }
        Ok(())
    }

    /// The strain at a share of the step.
    fn between(&self, strain: &K::Vector, share: f64) -> K::Vector {
        let ends = K::components(&self.strain)
            .iter()
            .zip(K::components(strain));
        let strain: Vec<f64> = ends.map(|(a, b)| a + share * (b - a)).collect();
        K::vector(&strain)
    }
}
