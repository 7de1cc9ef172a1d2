//! Strain gauges on bars and sheets: where the tests had them, as far as the model allows.

use std::collections::BTreeSet;

use fe_core::dof::Dof;
use fe_core::element::ElementError;
use fe_core::mesh::NodeId;
use fe_core::model::Model;
use fe_core::shape::quad8;
use fe_core::state::StateStore;
use nalgebra::Vector3;

use super::{BarKind, BarRecord, BuildError, SheetRecord};
use crate::column::{GAUGE_COLUMNS, bar_gauge};
use crate::spec::{Face, Specimen};

/// Points closer than this (mm) to a plane lie in it.
const ON: f64 = 1e-6;

/// A strain gauge.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauge {
    /// Name of the column.
    pub name: String,
    kind: Kind,
}

#[derive(Debug, Clone, PartialEq)]
enum Kind {
    /// On a bar: element, point and weight of the integration points on either side of it.
    Bar(Vec<(usize, usize, f64)>),
    /// On a sheet: factors (1/mm) of the displacements that give the mean strain over its length, relative to
    /// the strain when the sheet was bonded.
    Sheet {
        factors: Vec<(usize, f64)>,
        bonded_at: f64,
    },
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
        let points = match &self.kind {
            Kind::Bar(points) => points,
            Kind::Sheet { factors, bonded_at } => {
                return Ok(factors.iter().map(|&(d, f)| f * u[d]).sum::<f64>() - bonded_at);
            }
        };
        let mut strain = 0.0;
        for &(element, point, weight) in points {
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

    /// A gauge on `bar` at the share `t` of its length; none beyond its ends.
    fn on(bar: &BarRecord, t: f64, name: String, model: &Model) -> Option<Self> {
        if !(0.0..=1.0).contains(&t) {
            return None;
        }
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
        let kind = Kind::Bar(points);
        Some(Self { name, kind })
    }

    /// A gauge on the sheets at the points `ends` (mm), read along the line between them.
    fn between(
        ends: [[f64; 3]; 2],
        name: String,
        cells: &[[NodeId; 8]],
        model: &Model,
    ) -> Option<Self> {
        let [a, b] = ends.map(Vector3::from);
        let length = (b - a).norm();
        let along = (b - a) / length;
        let mut factors = Vec::new();
        for (end, sign) in [(a, -1.0), (b, 1.0)] {
            let (nodes, values) = locate(end, cells, model)?;
            for (node, value) in nodes.into_iter().zip(values) {
                for (k, dof) in Dof::DISPLACEMENTS.into_iter().enumerate() {
                    let factor = sign * value * along[k] / length;
                    factors.push((model.dofs().index(node, dof)?, factor));
                }
            }
        }
        let kind = Kind::Sheet {
            factors,
            bonded_at: 0.0,
        };
        Some(Self { name, kind })
    }

    /// Whether it is on a sheet.
    pub const fn is_on_sheet(&self) -> bool {
        matches!(self.kind, Kind::Sheet { .. })
    }

    /// Makes the strain of a sheet at `u` its zero: the sheet is bonded in that state.
    pub fn zero_at(&mut self, u: &[f64]) {
        if let Kind::Sheet { factors, bonded_at } = &mut self.kind {
            *bonded_at = factors.iter().map(|&(d, f)| f * u[d]).sum();
        }
    }
}

/// Cell of rectangular sheet that holds a point, and its shape functions there.
fn locate(
    point: Vector3<f64>,
    cells: &[[NodeId; 8]],
    model: &Model,
) -> Option<([NodeId; 8], [f64; 8])> {
    const SLACK: f64 = 1.0 + 1e-9;
    cells.iter().find_map(|&nodes| {
        let x = |a: usize| Vector3::from(model.mesh().nodes()[nodes[a]]);
        let (e1, e2) = (x(1) - x(0), x(3) - x(0));
        let natural =
            |edge: Vector3<f64>| 2.0 * (point - x(0)).dot(&edge) / edge.norm_squared() - 1.0;
        let xi = [natural(e1), natural(e2)];
        let off = (point - x(0)).dot(&e1.cross(&e2).normalize()).abs();
        (off < ON && xi.iter().all(|c| c.abs() <= SLACK)).then(|| (nodes, quad8::shape(xi).0))
    })
}

/// Gauges of a specimen: every stirrup of the test span at mid-height; the longitudinal bars at the loads and
/// in the middle of the test span; those on the sheets as the specimen says.
///
/// # Errors
///
/// [`BuildError::TwoGauges`].
pub(super) fn gauges(
    specimen: &Specimen,
    model: &Model,
    bars: &[BarRecord],
    sheets: Option<&SheetRecord>,
) -> Result<Vec<Gauge>, BuildError> {
    let span = &specimen.measuring.test_span;
    let (from, to) = (span.x_from_mm.get(), span.x_to_mm.get());
    let middle = 0.5 * specimen.beam.height_mm.get();
    let places = specimen.gauge_places();
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
                    gauges.extend(Gauge::on(bar, t, bar_gauge(&bar.name, x), model));
                }
            }
            BarKind::StirrupLeg(_) | BarKind::Tie => {}
        }
    }
    if let Some(sheets) = sheets {
        let cells: Vec<[NodeId; 8]> = sheets
            .cells
            .iter()
            .filter(|cell| cell.face == Face::Side)
            .map(|cell| {
                let nodes = model.elements()[cell.membrane].nodes();
                std::array::from_fn(|a| nodes[a])
            })
            .collect();
        // Over layers of adhesive the sheet lies outside the face.
        let lifted = cells.first().map(|cell| model.mesh().nodes()[cell[0]][2]);
        for g in &specimen.measuring.sheet_gauges {
            let z = lifted.unwrap_or(g.z_mm.get());
            let ends = g.ends().map(|(x, y)| [x, y, z]);
            let name = g.name.replace(' ', "_");
            gauges.extend(Gauge::between(ends, name, &cells, model));
        }
    }
    let mut columns: BTreeSet<&str> = GAUGE_COLUMNS.into();
    match gauges.iter().find(|g| !columns.insert(&g.name)) {
        Some(twice) => Err(BuildError::TwoGauges {
            column: twice.name.clone(),
        }),
        None => Ok(gauges),
    }
}
