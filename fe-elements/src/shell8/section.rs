//! What a shell is made of through its thickness.

use std::sync::Arc;

use fe_core::element::ElementError;
use fe_core::kinematics::PlaneStress;
use fe_core::material::Material;
use fe_core::shape::quadrature::gauss_legendre;
use nalgebra::{Matrix2, Rotation2};

/// One layer of a [`ShellSection`].
#[derive(Debug, Clone)]
pub struct Layer {
    /// Thickness (mm).
    pub thickness_mm: f64,
    /// Angle from axis 1 of the shell to axis 1 of the law, towards axis 2 (degrees).
    pub angle_deg: f64,
    /// Law in the plane of the layer.
    pub law: Arc<dyn Material<PlaneStress>>,
    /// Transverse shear moduli G13 and G23 (MPa) in the axes of the law; elastic for good.
    pub shear_mpa: [f64; 2],
}

/// Layers from the bottom to the top, in the direction of the normal; the nodes lie in the middle of the stack.
#[derive(Debug, Clone)]
pub struct ShellSection {
    /// The layers.
    pub layers: Vec<Layer>,
    /// Gauss points through each layer, 2 to 4.
    pub points_per_layer: usize,
    /// Shear correction k (-): the shear forces per width (N/mm) are k sum t_k G_k gamma.
    pub shear_correction: f64,
    /// Stiffness against drilling as a share of the shear stiffness (-), see [`Shell8`](super::Shell8).
    pub drilling: f64,
}

/// A Gauss point through the thickness.
#[derive(Debug, Clone, Copy)]
pub(super) struct Level {
    /// Layer it belongs to.
    pub(super) layer: usize,
    /// Place above the nodes (mm).
    pub(super) z: f64,
    /// Thickness it stands for (mm).
    pub(super) thickness: f64,
}

impl ShellSection {
    /// Layers with 2 points each, the shear correction 5/6 of a homogeneous section (Reissner 1945), and a
    /// drilling stiffness of 0.001.
    pub const fn new(layers: Vec<Layer>) -> Self {
        Self {
            layers,
            points_per_layer: 2,
            shear_correction: 5.0 / 6.0,
            drilling: 1e-3,
        }
    }

    /// Thickness of the stack (mm).
    pub fn thickness_mm(&self) -> f64 {
        self.layers.iter().map(|layer| layer.thickness_mm).sum()
    }

    /// Refuses numbers that cannot be.
    pub(super) fn admit(&self) -> Result<(), ElementError> {
        let positive = |what: String, value: f64| {
            if value.is_finite() && value > 0.0 {
                return Ok(());
            }
            Err(refuse(what, value, "(0, inf)", "give a positive number"))
        };
        if self.layers.is_empty() {
            let remedy = "give at least one layer";
            return Err(refuse("number of layers".into(), 0.0, "[1, inf)", remedy));
        }
        for (k, layer) in self.layers.iter().enumerate() {
            positive(format!("thickness_mm of layer {k}"), layer.thickness_mm)?;
            for shear in layer.shear_mpa {
                positive(format!("shear_mpa of layer {k}"), shear)?;
            }
            if !layer.angle_deg.is_finite() {
                let what = format!("angle_deg of layer {k}");
                let remedy = "give the direction of axis 1 of the law";
                return Err(refuse(what, layer.angle_deg, "(-inf, inf)", remedy));
            }
        }
        if !(2..=4).contains(&self.points_per_layer) {
            let (what, value) = ("points_per_layer".into(), self.points_per_layer as f64);
            return Err(refuse(what, value, "[2, 4]", "split the layer for more"));
        }
        positive("shear_correction".into(), self.shear_correction)?;
        positive("drilling".into(), self.drilling)
    }

    /// Gauss points through the thickness, layer by layer from the bottom.
    pub(super) fn levels(&self) -> Vec<Level> {
        let mut bottom = -0.5 * self.thickness_mm();
        let mut levels = Vec::new();
        for (layer, t) in self.layers.iter().map(|l| l.thickness_mm).enumerate() {
            for (zeta, w) in gauss_legendre(self.points_per_layer) {
                levels.push(Level {
                    layer,
                    z: bottom + 0.5 * t * (1.0 + zeta),
                    thickness: 0.5 * t * w,
                });
            }
            bottom += t;
        }
        levels
    }

    /// Shear stiffness sum t_k G_k (N/mm) in axes 1 and 2 of the shell, uncorrected.
    pub(super) fn shear_stiffness(&self) -> Matrix2<f64> {
        let own = |layer: &Layer| {
            let turn = Rotation2::new(layer.angle_deg.to_radians());
            let g = Matrix2::from_diagonal(&layer.shear_mpa.into());
            turn.matrix() * g * turn.matrix().transpose() * layer.thickness_mm
        };
        self.layers.iter().map(own).sum()
    }
}

fn refuse(what: String, value: f64, allowed: &str, remedy: &str) -> ElementError {
    ElementError::Input {
        what,
        value,
        allowed: allowed.into(),
        remedy: remedy.into(),
    }
}
