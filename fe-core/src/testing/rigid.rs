//! Rigid-body motions of an element, and the resultants that are conjugate to them.

use crate::dof::Dof;

/// One rigid-body motion on the DOFs of an element, of unit translation or unit rotation.
///
/// Its product with the nodal forces is the force or moment resultant of the same name.
#[derive(Debug)]
pub(super) struct Motion {
    pub(super) name: &'static str,
    pub(super) resultant: &'static str,
    pub(super) values: Vec<f64>,
}

const ROTATIONS: [Dof; 3] = [Dof::Rx, Dof::Ry, Dof::Rz];

/// Names of translations and rotations, and of their resultants.
const NAMES: [[&str; 2]; 6] = [
    ["a translation along x", "sum along x"],
    ["a translation along y", "sum along y"],
    ["a translation along z", "sum along z"],
    ["a rotation about x", "moment about x"],
    ["a rotation about y", "moment about y"],
    ["a rotation about z", "moment about z"],
];

/// The translations u = e_k and rotations u = e_k x (x - centre) that the DOFs can represent, or only those in the plane x-y.
pub(super) fn motions(coords: &[[f64; 3]], dofs: &[Dof], in_plane: bool) -> Vec<Motion> {
    let has = |k: usize| dofs.contains(&Dof::DISPLACEMENTS[k]) && !(in_plane && k == 2);
    let centre: [f64; 3] =
        std::array::from_fn(|k| coords.iter().map(|x| x[k]).sum::<f64>() / coords.len() as f64);
    let fill = |value: &dyn Fn(&[f64; 3], Dof) -> f64| {
        coords
            .iter()
            .flat_map(|x| dofs.iter().map(move |&dof| value(x, dof)))
            .collect()
    };
    let mut motions = Vec::new();
    for k in (0..3).filter(|&k| has(k)) {
        motions.push(Motion {
            name: NAMES[k][0],
            resultant: NAMES[k][1],
            values: fill(&|_, dof| f64::from(u8::from(dof == Dof::DISPLACEMENTS[k]))),
        });
    }
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        if !(has(i) && has(j)) {
            continue;
        }
        let (u_i, u_j) = (Dof::DISPLACEMENTS[i], Dof::DISPLACEMENTS[j]);
        motions.push(Motion {
            name: NAMES[3 + k][0],
            resultant: NAMES[3 + k][1],
            values: fill(&|x, dof| match dof {
                d if d == u_i => centre[j] - x[j],
                d if d == u_j => x[i] - centre[i],
                d if d == ROTATIONS[k] => 1.0,
                _ => 0.0,
            }),
        });
    }
    motions
}

#[cfg(test)]
mod tests {
    //! Protects the sense of the rotations and the choice of motions.
    use super::*;

    #[test]
    fn a_rotation_about_z_turns_x_towards_y() {
        let coords = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
        let all = motions(&coords, &Dof::DISPLACEMENTS, false);
        assert_eq!(all.len(), 6);
        assert_eq!(all[5].values, [0.0, 1.0, 0.0, 0.0, -1.0, 0.0]);
        assert_eq!(motions(&coords, &[Dof::Ux, Dof::Uy], false).len(), 3);
        assert_eq!(motions(&coords, &[Dof::Uz], false).len(), 1);
        assert_eq!(motions(&coords, &Dof::DISPLACEMENTS, true).len(), 3);
    }
}
