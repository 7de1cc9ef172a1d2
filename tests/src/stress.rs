//! Elastic stress of a hexahedron at any point of it.

use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError, PointContext};
use fe_core::shape::{hex20, quadrature};
use nalgebra::{Vector3, Vector6};

/// A hexahedron of a solved elastic model.
#[derive(Debug)]
pub struct ElasticCell<'a> {
    /// Law without internal variables.
    pub law: &'a dyn Material<Solid>,
    /// Places of the nodes (mm).
    pub coords: [[f64; 3]; 20],
    /// Displacements of the nodes (mm), node-major.
    pub u: Vec<f64>,
}

impl ElasticCell<'_> {
    /// Stress (MPa, Voigt) of the strain at the natural point `xi`.
    ///
    /// # Errors
    ///
    /// [`MaterialError`].
    pub fn direct(&self, xi: [f64; 3]) -> Result<Vector6<f64>, MaterialError> {
        let (_, gradients, _) = hex20::map(&self.coords, xi);
        let mut strain = Vector6::zeros();
        for (g, u) in gradients.iter().zip(self.u.chunks_exact(3)) {
            let (g, u) = (Vector3::from(*g), Vector3::from_column_slice(u));
            strain += Vector6::new(
                g.x * u.x,
                g.y * u.y,
                g.z * u.z,
                g.x * u.y + g.y * u.x,
                g.y * u.z + g.z * u.y,
                g.x * u.z + g.z * u.x,
            );
        }
        let point = PointContext::new(1.0);
        Ok(self.law.update(&strain, &[], &mut [], &point)?.stress)
    }

    /// Stress (MPa, Voigt) at `xi` extrapolated from the 2 x 2 x 2 Gauss points, where it is most accurate
    /// (Barlow 1976).
    ///
    /// # Errors
    ///
    /// [`MaterialError`].
    pub fn extrapolated(&self, xi: [f64; 3]) -> Result<Vector6<f64>, MaterialError> {
        let mut sum = Vector6::zeros();
        for (point, _) in quadrature::cube(2) {
            // Linear Lagrange polynomial of each direction: (1 + 3 xi p)/2 with p = +-1/sqrt(3).
            let share: f64 = (0..3)
                .map(|k| 0.5 * (1.0 + 3.0 * xi[k] * point[k]))
                .product();
            sum += share * self.direct(point)?;
        }
        Ok(sum)
    }
}
