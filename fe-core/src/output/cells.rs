//! Fields of the elements that draw a cell.

use super::vtu::{DataArray, UnstructuredGrid};
use crate::element::PointSample;
use crate::kinematics::{Kinematics, Solid};
use crate::model::{Model, ModelError};
use crate::state::StateStore;

const AXES: [&str; 3] = ["x", "y", "z"];

/// The elements that draw a [cell](crate::element::Element::cell), with the committed `state` at the
/// displacement `u` of all DOFs.
///
/// Point data: `displacement` (mm). Cell data, in Voigt order (which is ParaView's) and averaged over the
/// volume of the element's integration points:
///
/// | name | components | unit |
/// |---|---|---|
/// | `stress`, `strain` | 6, shear strain engineering; NaN unless the law is one of solids | MPa, - |
/// | `plastic_strain` | 6 | - |
/// | `crack_strain` | 1, the largest of the points instead of the mean | - |
/// | `crack_normal` | 3, at the point of the largest crack strain | - |
/// | `crushing`, `utilisation` | 1 | - |
///
/// # Errors
///
/// [`ModelError::Element`], and [`ModelError::Foreign`] for displacements or a state of another model.
pub fn cell_grid(
    model: &Model,
    u: &[f64],
    state: &StateStore,
) -> Result<UnstructuredGrid, ModelError> {
    model.admit(u, state)?;
    let mut displacement = DataArray::new("displacement", &AXES);
    for node in 0..model.mesh().nodes().len() {
        displacement.values.extend(model.displacement(node, u));
    }
    let mut grid = UnstructuredGrid::new(model.mesh().nodes().to_vec());
    grid.point_data.push(displacement);
    let mut fields = Fields::new();
    for (e, element) in model.elements().iter().enumerate() {
        let Some((kind, nodes)) = element.cell() else {
            continue;
        };
        grid.add_cell(kind.vtk_type(), nodes);
        let mut mean = Mean::default();
        model.sample(e, u, state, &mut |s| mean.add(&s))?;
        fields.push(&mean);
    }
    grid.cell_data = fields.0.into();
    Ok(grid)
}

/// Sums over the integration points of one element.
#[derive(Debug, Default)]
struct Mean {
    volume: f64,
    /// Volume of the points whose law is one of solids.
    solid: f64,
    stress: [f64; 6],
    strain: [f64; 6],
    plastic_strain: [f64; 6],
    crack_strain: f64,
    crack_normal: [f64; 3],
    crushing: f64,
    utilisation: f64,
}

impl Mean {
    fn add(&mut self, sample: &PointSample<'_>) {
        let (w, report) = (sample.volume, &sample.report);
        self.volume += w;
        if sample.strain.len() == Solid::LEN {
            self.solid += w;
            add(&mut self.stress, w, sample.stress);
            add(&mut self.strain, w, sample.strain);
        }
        add(&mut self.plastic_strain, w, &report.plastic_strain);
        self.crushing += w * report.crushing;
        self.utilisation += w * report.utilisation;
        if report.crack_strain > self.crack_strain {
            self.crack_strain = report.crack_strain;
            self.crack_normal = report.crack_normal;
        }
    }
}

fn add(sum: &mut [f64; 6], weight: f64, values: &[f64]) {
    for (s, v) in sum.iter_mut().zip(values) {
        *s += weight * v;
    }
}

/// The arrays of the cell data.
#[derive(Debug)]
struct Fields([DataArray; 7]);

impl Fields {
    const fn new() -> Self {
        Self([
            DataArray::new("stress", Solid::STRESS_LABELS),
            DataArray::new("strain", Solid::STRAIN_LABELS),
            DataArray::new("plastic_strain", Solid::STRAIN_LABELS),
            DataArray::scalar("crack_strain"),
            DataArray::new("crack_normal", &AXES),
            DataArray::scalar("crushing"),
            DataArray::scalar("utilisation"),
        ])
    }

    fn push(&mut self, mean: &Mean) {
        let [
            stress,
            strain,
            plastic,
            crack,
            normal,
            crushing,
            utilisation,
        ] = &mut self.0;
        stress.values.extend(mean.stress.map(|s| s / mean.solid));
        strain.values.extend(mean.strain.map(|s| s / mean.solid));
        plastic
            .values
            .extend(mean.plastic_strain.map(|s| s / mean.volume));
        crack.values.push(mean.crack_strain);
        normal.values.extend(mean.crack_normal);
        crushing.values.push(mean.crushing / mean.volume);
        utilisation.values.push(mean.utilisation / mean.volume);
    }
}
