//! The program of a case.

use std::collections::BTreeMap;
use std::fmt;

use fe_core::kinematics::Kinematics;
use fe_core::point::{Control, Segment};
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::CaseError;

/// A ramp of every component from its present value to a target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SegmentCase {
    /// Strains (-) by name.
    #[serde(default, deserialize_with = "components")]
    pub strain: BTreeMap<String, f64>,
    /// Stresses (MPa) by name; components that are not named at all go to zero stress.
    #[serde(default, deserialize_with = "components")]
    pub stress_mpa: BTreeMap<String, f64>,
    /// Steps of the ramp.
    pub steps: usize,
}

impl SegmentCase {
    /// The segment with one control per component of K; `number` stands for it in messages.
    ///
    /// # Errors
    ///
    /// [`CaseError::Component`] and [`CaseError::Overdetermined`].
    pub fn build<K: Kinematics>(&self, number: usize) -> Result<Segment, CaseError> {
        for (field, names, labels) in [
            ("strain", &self.strain, K::STRAIN_LABELS),
            ("stress_mpa", &self.stress_mpa, K::STRESS_LABELS),
        ] {
            if let Some(name) = names.keys().find(|name| !labels.contains(&name.as_str())) {
                return Err(CaseError::Component {
                    segment: number,
                    field,
                    name: name.clone(),
                    allowed: labels.join(", "),
                });
            }
        }
        let control = |i: usize| {
            let (strain, stress) = (K::STRAIN_LABELS[i], K::STRESS_LABELS[i]);
            match (self.strain.get(strain), self.stress_mpa.get(stress)) {
                (Some(_), Some(_)) => Err(CaseError::Overdetermined {
                    segment: number,
                    strain,
                    stress,
                }),
                (Some(&target), None) => Ok(Control::Strain(target)),
                (None, target) => Ok(Control::Stress(target.copied().unwrap_or(0.0))),
            }
        };
        let controls = (0..K::LEN).map(control).collect::<Result<_, _>>()?;
        Ok(Segment::new(controls, self.steps))
    }
}

/// Numbers by name; a name that stands twice is refused, which a map alone would overwrite.
fn components<'de, D: Deserializer<'de>>(input: D) -> Result<BTreeMap<String, f64>, D::Error> {
    struct Components;

    impl<'de> Visitor<'de> for Components {
        type Value = BTreeMap<String, f64>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("components by name, such as {\"eps_xx\": 0.001}")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut components = BTreeMap::new();
            while let Some((name, value)) = map.next_entry::<String, f64>()? {
                if components.contains_key(&name) {
                    let twice =
                        format!("the component `{name}` stands twice; remove one of the two");
                    return Err(A::Error::custom(twice));
                }
                components.insert(name, value);
            }
            Ok(components)
        }
    }

    input.deserialize_map(Components)
}
