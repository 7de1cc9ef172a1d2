//! Fields of the elements that draw line segments.

use super::vtu::{DataArray, UnstructuredGrid};
use crate::model::{Model, ModelError};
use crate::shape::hex20;
use crate::state::StateStore;

/// Line cell of VTK.
const LINE: u8 = 3;

/// The [segments](crate::element::Element::segments) of all elements, with the committed `state` at the
/// displacement `u` of all DOFs.
///
/// Point data: `displacement` (mm), interpolated in the host of an embedded bar; cell data:
/// `axial_stress` (MPa).
///
/// # Errors
///
/// [`ModelError::Element`], and [`ModelError::Foreign`] for displacements or a state of another model.
pub fn bar_grid(
    model: &Model,
    u: &[f64],
    state: &StateStore,
) -> Result<UnstructuredGrid, ModelError> {
    model.admit(u, state)?;
    let mut grid = UnstructuredGrid::default();
    let mut displacement = DataArray::new("displacement", &["x", "y", "z"]);
    let mut stress = DataArray::scalar("axial_stress");
    for (e, element) in model.elements().iter().enumerate() {
        element
            .segments(
                &model.gather(e, u),
                state.committed(e),
                &mut |ends, axial| {
                    let first = grid.points.len();
                    grid.points.extend(ends);
                    grid.add_cell(LINE, &[first, first + 1]);
                    for end in ends {
                        displacement
                            .values
                            .extend(displacement_at(model, u, e, end));
                    }
                    stress.values.push(axial);
                },
            )
            .map_err(|source| model.locate(e, source))?;
    }
    grid.point_data.push(displacement);
    grid.cell_data.push(stress);
    Ok(grid)
}

/// Displacement (mm) of a point of an element: interpolated in its host, that of the nearest node
/// otherwise.
fn displacement_at(model: &Model, u: &[f64], element: usize, point: [f64; 3]) -> [f64; 3] {
    let nodes = model.elements()[element].nodes();
    let coords = model.mesh().nodes();
    let host = model.elements()[element].host();
    let inside =
        host.and_then(|host| Some((host, hex20::inverse_map(&host.map(|n| coords[n]), point)?)));
    if let Some((host, xi)) = inside {
        let mut sum = [0.0; 3];
        for (&node, weight) in host.iter().zip(hex20::shape(xi).0) {
            let own = model.displacement(node, u);
            for k in 0..3 {
                sum[k] += weight * own[k];
            }
        }
        return sum;
    }
    let distance = |node: usize| -> f64 {
        coords[node]
            .iter()
            .zip(point)
            .map(|(a, b)| (a - b) * (a - b))
            .sum()
    };
    nodes
        .iter()
        .min_by(|&&a, &&b| distance(a).total_cmp(&distance(b)))
        .map_or([0.0; 3], |&node| model.displacement(node, u))
}
