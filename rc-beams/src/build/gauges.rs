//! Strain gauges on bars: where the tests had them, as far as the bars of the model allow.

use fe_core::element::ElementError;
use fe_core::model::Model;
use fe_core::state::StateStore;

use super::{BarKind, BarRecord};
use crate::spec::Specimen;

/// A strain gauge on a bar, read at the integration points on either side of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauge {
    /// Name of the column.
    pub name: String,
    /// Element, point and weight of the points it interpolates between.
    points: Vec<(usize, usize, f64)>,
}

/// An integration point of a bar at a share `at` of its length.
#[derive(Debug, Clone, Copy)]
struct Place {
    at: f64,
    element: usize,
    point: usize,
}

impl Gauge {
    /// Strain (-).
    ///
    /// # Errors
    ///
    /// [`ElementError`].
    pub fn read(&self, model: &Model, u: &[f64], state: &StateStore) -> Result<f64, ElementError> {
        let mut strain = 0.0;
        for &(element, point, weight) in &self.points {
            let local = model.gather(element, u);
            let mut i = 0;
            model.elements()[element].sample(&local, state.committed(element), &mut |s| {
                if i == point {
                    strain += weight * s.strain[0];
                }
                i += 1;
            })?;
        }
        Ok(strain)
    }

    /// A gauge on `bar` at the share `t` of its length.
    fn on(bar: &BarRecord, t: f64, name: String, model: &Model) -> Option<Self> {
        let along = |p: [f64; 3]| -> f64 {
            let [a, b] = bar.ends;
            let (mut dot, mut square) = (0.0, 0.0);
            for k in 0..3 {
                dot += (p[k] - a[k]) * (b[k] - a[k]);
                square += (b[k] - a[k]).powi(2);
            }
            dot / square
        };
        let mut below: Option<Place> = None;
        let mut above: Option<Place> = None;
        for element in bar.elements.clone() {
            let law = &model.elements()[element];
            let mut state = vec![0.0; law.state_len()];
            law.init_state(&mut state);
            let zero = vec![0.0; 3 * law.nodes().len()];
            let mut point = 0;
            let visited = law.sample(&zero, &state, &mut |s| {
                let here = Place {
                    at: along(s.position),
                    element,
                    point,
                };
                if here.at <= t && below.is_none_or(|b| here.at > b.at) {
                    below = Some(here);
                }
                if here.at >= t && above.is_none_or(|a| here.at < a.at) {
                    above = Some(here);
                }
                point += 1;
            });
            visited.ok()?;
        }
        let points = match (below, above) {
            (Some(b), Some(a)) if a.at > b.at => {
                let share = (t - b.at) / (a.at - b.at);
                vec![
                    (b.element, b.point, 1.0 - share),
                    (a.element, a.point, share),
                ]
            }
            (Some(p), _) | (None, Some(p)) => vec![(p.element, p.point, 1.0)],
            (None, None) => return None,
        };
        Some(Self { name, points })
    }
}

/// Gauges of a specimen: every stirrup of the test span at mid-height; the longitudinal bars at the loads and
/// in the middle of the test span.
pub(super) fn gauges(specimen: &Specimen, model: &Model, bars: &[BarRecord]) -> Vec<Gauge> {
    let span = &specimen.measuring.test_span;
    let (from, to) = (span.x_from_mm.get(), span.x_to_mm.get());
    let middle = 0.5 * specimen.beam.height_mm.get();
    let mut places: Vec<f64> = specimen.loads.iter().map(|l| l.x_mm.get()).collect();
    let centre = 0.5 * (from + to);
    if !places.contains(&centre) {
        places.push(centre);
    }
    let mut gauges = Vec::new();
    for bar in bars {
        let [a, b] = bar.ends;
        match bar.kind {
            BarKind::StirrupLeg(x) if (from..=to).contains(&x) => {
                let t = (middle - a[1]) / (b[1] - a[1]);
                gauges.extend(Gauge::on(bar, t, format!("stirrup_x{x}"), model));
            }
            BarKind::Longitudinal => {
                for &x in &places {
                    let t = (x - a[0]) / (b[0] - a[0]);
                    let name = format!("{}_x{x}", bar.name);
                    gauges.extend(Gauge::on(bar, t, name, model));
                }
            }
            BarKind::StirrupLeg(_) | BarKind::Tie => {}
        }
    }
    gauges
}
