//! Fields of the elements that join two faces.

use super::vtu::{DataArray, UnstructuredGrid};
use crate::element::PointSample;
use crate::kinematics::{Interface, Kinematics};
use crate::material::state_labels;
use crate::mesh::CellKind;
use crate::model::{Model, ModelError};
use crate::state::StateStore;

/// The elements that draw an [interface](crate::element::Element::interface_face), with the committed `state` at
/// the displacement `u` of all DOFs; every cell has points of its own.
///
/// Point data: `displacement` (mm). Cell data, averaged over the area of the element's integration points:
///
/// | name | components | unit |
/// |---|---|---|
/// | `jump` | 3: slip along both tangents, opening; NaN unless the law is one of interfaces | mm |
/// | `traction` | 3, likewise | MPa |
/// | `slip_max`, `damage` | 1; NaN where the law has no internal variable of that name | mm, - |
/// | `utilisation` | 1 | - |
///
/// # Errors
///
/// [`ModelError::Element`], and [`ModelError::Foreign`] for displacements or a state of another model.
pub fn interface_grid(
    model: &Model,
    u: &[f64],
    state: &StateStore,
) -> Result<UnstructuredGrid, ModelError> {
    model.admit(u, state)?;
    let mut grid = UnstructuredGrid::default();
    let mut displacement = DataArray::new("displacement", &["x", "y", "z"]);
    let mut jump = DataArray::new("jump", Interface::STRAIN_LABELS);
    let mut traction = DataArray::new("traction", Interface::STRESS_LABELS);
    let mut histories = HISTORIES.map(DataArray::scalar);
    let mut utilisation = DataArray::scalar("utilisation");
    for (e, element) in model.elements().iter().enumerate() {
        let Some(face) = element.interface_face() else {
            continue;
        };
        let first = grid.points.len();
        grid.points.extend(face.map(|n| model.mesh().nodes()[n]));
        let points: Vec<usize> = (first..first + face.len()).collect();
        grid.add_cell(CellKind::Quad8.vtk_type(), &points);
        for node in face {
            let values = model.displacement(node, u);
            displacement.values.extend(values);
        }
        let mut mean = Mean::default();
        model.sample(e, u, state, &mut |s| mean.add(&s))?;
        jump.values.extend(mean.jump.map(|v| v / mean.joined));
        let tractions = mean.traction.map(|v| v / mean.joined);
        traction.values.extend(tractions);
        for (array, sum) in histories.iter_mut().zip(mean.histories) {
            array.values.push(sum / mean.area);
        }
        utilisation.values.push(mean.utilisation / mean.area);
    }
    grid.point_data.push(displacement);
    grid.cell_data.extend([jump, traction]);
    grid.cell_data.extend(histories);
    grid.cell_data.push(utilisation);
    Ok(grid)
}

/// Internal variables that are drawn.
const HISTORIES: [&str; 2] = ["slip_max", "damage"];

/// Sums over the integration points of one element, times area.
#[derive(Debug, Default)]
struct Mean {
    area: f64,
    /// Area of the points whose law is one of interfaces.
    joined: f64,
    jump: [f64; 3],
    traction: [f64; 3],
    histories: [f64; 2],
    utilisation: f64,
}

impl Mean {
    fn add(&mut self, sample: &PointSample<'_>) {
        let w = sample.volume;
        self.area += w;
        self.utilisation += w * sample.report.utilisation;
        if [sample.strain.len(), sample.stress.len()] == [Interface::LEN; 2] {
            self.joined += w;
            for k in 0..Interface::LEN {
                self.jump[k] += w * sample.strain[k];
                self.traction[k] += w * sample.stress[k];
            }
        }
        let labels = state_labels(sample.state_vars);
        for (sum, name) in self.histories.iter_mut().zip(HISTORIES) {
            let at = labels.iter().position(|label| label == name);
            let value = at.and_then(|i| sample.state.get(i));
            *sum += w * value.copied().unwrap_or(f64::NAN);
        }
    }
}
