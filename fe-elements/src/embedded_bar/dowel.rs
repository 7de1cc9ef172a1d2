//! Dowel action: the transverse stiffness of a bar that crosses a crack.

use fe_core::element::ElementError;

/// Transverse stiffness of a bar against the shear strain of its host.
///
/// A crack crossed by the bar opens a transverse slip delta = h gamma over the band width h; the bar, a
/// beam on the elastic foundation of the surrounding concrete, resists it with V = E I beta^3 delta. Smeared
/// over the band, V(gamma) = E I beta^3 h gamma acts along the bar: delta W = int V delta(gamma) ds, with
/// gamma = t . (grad u + grad u^T) n the engineering shear strain between the axis t and the transverse
/// direction n in the plane of the bar and the crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dowel {
    /// V per unit of shear strain (N).
    pub stiffness_n: f64,
    /// Normal of the plane in which the dowel acts; the transverse direction is `plane_normal` x t, and a
    /// bar along the normal has no dowel.
    pub plane_normal: [f64; 3],
}

impl Dowel {
    /// Foundation stiffness of He and Kwan (2001): k = 127 c sqrt(fc)/phi^(2/3) (N/mm3) with c = 0.8,
    /// beta = (k phi/(4 E I))^(1/4) (1/mm), stiffness = E I beta^3 h (N). The constants 127 and 0.8 are assumed:
    /// they are quoted here at second hand.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] for a value that is not positive.
    pub fn he_kwan(
        diameter_mm: f64,
        fc_mpa: f64,
        young_mpa: f64,
        band_width_mm: f64,
        plane_normal: [f64; 3],
    ) -> Result<Self, ElementError> {
        let inputs = [
            ("diameter_mm", diameter_mm),
            ("fc_mpa", fc_mpa),
            ("young_mpa", young_mpa),
            ("band_width_mm", band_width_mm),
        ];
        for (what, value) in inputs {
            if !(value.is_finite() && value > 0.0) {
                return Err(ElementError::Input {
                    what: format!("dowel {what}"),
                    value,
                    allowed: "(0, inf)".into(),
                    remedy: "give a positive value".into(),
                });
            }
        }
        let inertia = std::f64::consts::PI * diameter_mm.powi(4) / 64.0;
        let foundation = 127.0 * 0.8 * fc_mpa.sqrt() / diameter_mm.powf(2.0 / 3.0);
        let beta = (foundation * diameter_mm / (4.0 * young_mpa * inertia)).powf(0.25);
        Ok(Self {
            stiffness_n: young_mpa * inertia * beta.powi(3) * band_width_mm,
            plane_normal,
        })
    }
}
