//! What the rules for the mode of failure look at, read off a state of the model.

use fe_core::model::ModelError;

use crate::analysis::Snapshot;
use crate::build::{BarKind, Beam};
use crate::column::TEST_SPAN;
use crate::results::evidence::{self, BarReach, ConcretePoint, Layout, ShearSpan};
use crate::spec::Specimen;

/// Shear spans: between a support and a load that are neighbours; over a stub the beam bends like between
/// the loads, so a span ends at its face.
pub(super) fn layout(specimen: &Specimen, beam: &Beam) -> Layout {
    let supports = specimen.supports.iter().map(|s| {
        let stub = s.stub.as_ref().map_or(0.0, |stub| stub.length_mm.get());
        (s.x_mm.get(), true, 0.5 * stub)
    });
    let loads = specimen.loads.iter().map(|l| (l.x_mm.get(), false, 0.0));
    let mut places: Vec<(f64, bool, f64)> = supports.chain(loads).collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    let test = &specimen.measuring.test_span;
    let middle = 0.5 * (test.x_from_mm.get() + test.x_to_mm.get());
    let shear_spans = places
        .windows(2)
        .filter(|pair| pair[0].1 != pair[1].1)
        .map(|pair| {
            let (from_mm, to_mm) = (pair[0].0 + pair[0].2, pair[1].0 - pair[1].2);
            let name = if (from_mm..to_mm).contains(&middle) {
                TEST_SPAN.into()
            } else {
                format!("shear span from {from_mm:.0} to {to_mm:.0} mm")
            };
            ShearSpan {
                name,
                from_mm,
                to_mm,
            }
        })
        .collect();
    Layout {
        shear_spans,
        height_mm: specimen.beam.height_mm.get(),
        stirrups: beam.bars.iter().filter(|b| is_stirrup(b.kind)).count(),
    }
}

const fn is_stirrup(kind: BarKind) -> bool {
    matches!(kind, BarKind::StirrupLeg(_))
}

/// The state of concrete and bars in a snapshot.
pub(super) fn snapshot(beam: &Beam, at: &Snapshot) -> Result<evidence::Snapshot, ModelError> {
    let mut concrete = Vec::new();
    for e in beam.concrete.clone() {
        beam.model
            .sample(e, &at.displacement, &at.state, &mut |s| {
                concrete.push(ConcretePoint::from(&s));
            })?;
    }
    let mut bars = Vec::new();
    let mut stirrups = Vec::new();
    for bar in &beam.bars {
        let mut reach = BarReach {
            bar: bar.name.clone(),
            x_mm: bar.ends[0][0],
            utilisation: f64::NEG_INFINITY,
        };
        for e in bar.elements.clone() {
            beam.model
                .sample(e, &at.displacement, &at.state, &mut |s| {
                    // A bar that has yielded and is relieved again has yielded all the same.
                    let has_yielded = s.report.plastic_strain[0] > 0.0;
                    let now = s.stress[0] / bar.fy_mpa;
                    let utilisation = if has_yielded { now.max(1.0) } else { now };
                    if utilisation > reach.utilisation {
                        (reach.utilisation, reach.x_mm) = (utilisation, s.position[0]);
                    }
                })?;
        }
        match bar.kind {
            BarKind::Longitudinal => bars.push(reach),
            BarKind::StirrupLeg(_) => stirrups.push(reach),
            BarKind::Tie => {}
        }
    }
    Ok(evidence::Snapshot {
        concrete,
        bars,
        stirrups,
    })
}
