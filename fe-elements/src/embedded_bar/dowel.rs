//! Dowel action: the transverse stiffness of a bar that crosses a crack.

use fe_core::element::ElementError;

use crate::input::positive;

/// Resistance of a bar against the shear strain of its host.
///
/// A crack crossed by the bar opens a transverse slip delta = h gamma over the band width h; the bar, a
/// beam on the elastic foundation of the surrounding concrete, resists it with V = E I beta^3 delta. Smeared
/// over the band, V(gamma) = E I beta^3 h (gamma - gamma_p) acts along the bar: delta W = int V delta(gamma) ds, with
/// gamma = t . (grad u + grad u^T) n the engineering shear strain between the axis t and the transverse
/// direction n in the plane of the bar and the crack.
///
/// Where |V| would pass its strength V_u(sigma), which falls with the axial stress, the bar slides and gamma_p follows. A bar
/// that yields along its axis has no strength left across it: from 1 - (sigma/fy)^2 = 1e-6 on V_u is 0, where it has fallen to a
/// thousandth of V_0, and its slope has grown to 1000 V_0/fy.
///
/// gamma_p does not depend on rate, no more than plastic strain along the bar does: the
/// [relaxation](fe_core::element::EvaluationContext::relaxation) of an evaluation has no influence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dowel {
    /// V per unit of shear strain (N).
    stiffness_n: f64,
    /// What V cannot pass, if anything.
    strength: Option<Strength>,
    /// Normal of the plane in which the dowel acts; the transverse direction is `plane_normal` x t, and a
    /// bar along the normal has no dowel.
    plane_normal: [f64; 3],
}

/// V_u = V_0 sqrt(1 - (sigma/fy)^2).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Strength {
    /// V_0 (N).
    free_n: f64,
    /// fy (MPa).
    yield_mpa: f64,
}

impl Strength {
    /// V_u (N) and its derivative with respect to the axial stress (mm2).
    fn at(&self, axial_mpa: f64) -> (f64, f64) {
        let share = axial_mpa / self.yield_mpa;
        let left = 1.0 - share * share;
        if left <= NOTHING_LEFT {
            return (0.0, 0.0);
        }
        let root = left.sqrt();
        (
            self.free_n * root,
            -self.free_n * share / (root * self.yield_mpa),
        )
    }
}

/// 1 - (sigma/fy)^2 from which a bar counts as yielding: the slope of V_u has no bound there.
const NOTHING_LEFT: f64 = 1e-6;

/// Answer of a dowel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Answer {
    /// V (N).
    pub(super) force: f64,
    /// gamma_p (-).
    pub(super) slid: f64,
    /// dV/dgamma (N).
    pub(super) stiffness: f64,
    /// dV/dsigma (mm2).
    pub(super) by_axial: f64,
}

impl Dowel {
    /// A dowel without bound of V per unit of shear strain (N), in the plane of the given normal.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] for a stiffness that is not positive, or a normal without length or direction.
    pub fn new(stiffness_n: f64, plane_normal: [f64; 3]) -> Result<Self, ElementError> {
        admit(&[("stiffness_n", stiffness_n)])?;
        let normal = plane_normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        positive(
            "length of plane_normal",
            normal,
            "give the normal of the plane in which the dowel acts",
        )?;
        Ok(Self {
            stiffness_n,
            plane_normal: plane_normal.map(|x| x / normal),
            strength: None,
        })
    }

    /// The dowel of [`Self::new`] from the foundation stiffness of He and Kwan (2001): k = 127 c sqrt(fc)/phi^(2/3) (N/mm3) with c = 0.8,
    /// beta = (k phi/(4 E I))^(1/4) (1/mm), stiffness = E I beta^3 h (N). The constants 127 and 0.8 are assumed:
    /// they are quoted here at second hand.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] for a value that is not positive, or a normal without length or direction.
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
        admit(&inputs)?;
        let inertia = std::f64::consts::PI * diameter_mm.powi(4) / 64.0;
        let foundation = 127.0 * 0.8 * fc_mpa.sqrt() / diameter_mm.powf(2.0 / 3.0);
        let beta = (foundation * diameter_mm / (4.0 * young_mpa * inertia)).powf(0.25);
        Self::new(
            young_mpa * inertia * beta.powi(3) * band_width_mm,
            plane_normal,
        )
    }

    /// The same with a strength V_u = V_0 sqrt(1 - (sigma/fy)^2): V_0 (N) where the bar carries no axial stress, and its yield stress
    /// fy (MPa).
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] for a value that is not positive.
    pub fn with_strength(mut self, free_n: f64, yield_mpa: f64) -> Result<Self, ElementError> {
        admit(&[("free_n", free_n), ("yield_mpa", yield_mpa)])?;
        self.strength = Some(Strength { free_n, yield_mpa });
        Ok(self)
    }

    /// [`Self::with_strength`] with the strength of CEB-FIP Model Code 1990, 3.10 (without eccentricity and partial factors), after Rasmussen (1963),
    /// at second hand:
    ///
    /// V_u = V_0 sqrt(1 - (sigma/fy)^2), V_0 = 1.3 phi^2 sqrt(fc fy), no more than A fy/sqrt(3).
    ///
    /// It holds where the cover does not split.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] for a value that is not positive.
    pub fn bounded(
        self,
        diameter_mm: f64,
        fc_mpa: f64,
        yield_mpa: f64,
    ) -> Result<Self, ElementError> {
        admit(&[
            ("diameter_mm", diameter_mm),
            ("fc_mpa", fc_mpa),
            ("yield_mpa", yield_mpa),
        ])?;
        let area = std::f64::consts::FRAC_PI_4 * diameter_mm * diameter_mm;
        let concrete = 1.3 * diameter_mm * diameter_mm * (fc_mpa * yield_mpa).sqrt();
        self.with_strength(concrete.min(area * yield_mpa / 3.0_f64.sqrt()), yield_mpa)
    }

    /// The dowel of `count` such bars in one place.
    #[must_use]
    pub fn times(mut self, count: u32) -> Self {
        let count = f64::from(count);
        self.stiffness_n *= count;
        if let Some(strength) = &mut self.strength {
            strength.free_n *= count;
        }
        self
    }

    /// V per unit of shear strain (N) before the bar slides.
    pub(super) const fn stiffness(&self) -> f64 {
        self.stiffness_n
    }

    /// Normal of the plane in which the dowel acts.
    pub(super) const fn plane_normal(&self) -> [f64; 3] {
        self.plane_normal
    }

    /// Whether V has a bound, and the dowel a slid strain to keep.
    pub(super) const fn is_bounded(&self) -> bool {
        self.strength.is_some()
    }

    /// V at a shear strain, from the slid strain gamma_p kept and the axial stress (MPa) of the bar.
    pub(super) fn at(&self, shear: f64, slid: f64, axial_mpa: f64) -> Answer {
        let trial = self.stiffness_n * (shear - slid);
        let elastic = Answer {
            force: trial,
            slid,
            stiffness: self.stiffness_n,
            by_axial: 0.0,
        };
        let Some(strength) = &self.strength else {
            return elastic;
        };
        let (most, slope) = strength.at(axial_mpa);
        if trial.abs() <= most {
            return elastic;
        }
        let force = most.copysign(trial);
        Answer {
            force,
            slid: shear - force / self.stiffness_n,
            stiffness: 0.0,
            by_axial: slope * trial.signum(),
        }
    }

    /// What the dowel gives back when it unloads, per length (N).
    pub(super) fn free_energy(&self, shear: f64, slid: f64) -> f64 {
        0.5 * self.stiffness_n * (shear - slid).powi(2)
    }
}

fn admit(inputs: &[(&str, f64)]) -> Result<(), ElementError> {
    let mut all = inputs.iter();
    all.try_for_each(|(what, value)| {
        positive(&format!("dowel {what}"), *value, "give a positive value")
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// phi 10, fc = 19.3, fy = 350 MPa: V_0 = 1.3 * 100 * sqrt(19.3 * 350) = 10 685 N.
    fn bounded() -> Dowel {
        let free = Dowel::he_kwan(10.0, 19.3, 200e3, 50.0, [0.0, 0.0, 1.0]).unwrap();
        free.bounded(10.0, 19.3, 350.0).unwrap()
    }

    /// Source: He and Kwan (2001), by hand for phi 8, fc = 25 MPa, E = 200 GPa, h = 50 mm: k = 127 * 0.8 * 5/4 = 127 N/mm3,
    /// E I = 64 pi E = 40.2124e6 N mm2, beta = (127 * 8/(4 E I))^(1/4) = 0.0501324 /mm. Target: E I beta^3 h = 253 329 N to 5 digits.
    #[test]
    fn stiffness_of_the_foundation() {
        let dowel = Dowel::he_kwan(8.0, 25.0, 200e3, 50.0, [0.0, 0.0, 1.0]).unwrap();
        assert!((dowel.at(1e-3, 0.0, 0.0).force / 253.329 - 1.0).abs() < 1e-5);
    }

    /// Stiff below the strength, at the strength above it, and stiff again on the way back, with the slid strain kept.
    #[test]
    fn a_dowel_slides_at_its_strength() {
        let dowel = bounded();
        let yielding = 10_685.0 / dowel.stiffness_n;
        let below = dowel.at(0.9 * yielding, 0.0, 0.0);
        assert!((below.force - 0.9 * 10_685.0).abs() < 2.0 && below.slid == 0.0);
        let above = dowel.at(-3.0 * yielding, 0.0, 0.0);
        assert!((above.force + 10_685.0).abs() < 1.0 && above.stiffness == 0.0);
        let back = dowel.at(-2.5 * yielding, above.slid, 0.0);
        assert!((back.force + 0.5 * 10_685.0).abs() < 1.0 && back.slid == above.slid);
    }

    /// A dowel of the same two numbers is the same, whatever they come from.
    #[test]
    fn a_dowel_is_its_stiffness_and_strength() {
        let dowel = bounded();
        let (free, yielding) = (dowel.strength.unwrap().free_n, 350.0);
        let same = Dowel::new(dowel.stiffness_n, [0.0, 0.0, 2.0])
            .and_then(|same| same.with_strength(free, yielding));
        assert_eq!(same, Ok(dowel));
        assert!(Dowel::new(0.0, [0.0, 0.0, 1.0]).is_err());
        assert!(dowel.with_strength(free, f64::NAN).is_err());
    }

    /// Half the yield stress along the axis leaves sqrt(3)/2 of the strength across it, yielding leaves none; the slope is that of
    /// the force.
    #[test]
    fn axial_stress_takes_the_strength() {
        let dowel = bounded();
        let at = |axial| dowel.at(1.0, 0.0, axial);
        assert!((at(175.0).force / at(0.0).force - 0.75_f64.sqrt()).abs() < 1e-12);
        for axial in [-355.0, -350.0, 350.0, 400.0] {
            let none = at(axial);
            assert!(none.force == 0.0 && none.slid == 1.0 && none.by_axial == 0.0);
        }
        let secant = (at(200.001).force - at(199.999).force) / 0.002;
        assert!((at(200.0).by_axial - secant).abs() < 1e-6 * secant.abs());
    }

    /// Two bars in one place give twice the force of one, before they slide and after.
    #[test]
    fn bars_in_one_place_add_up() {
        let (one, two) = (bounded(), bounded().times(2));
        for shear in [1e-6, 1.0] {
            let [one, two] = [one, two].map(|dowel| dowel.at(shear, 0.0, 100.0));
            assert_eq!((two.force, two.slid), (2.0 * one.force, one.slid));
        }
    }

    /// Without a normal there is no plane to act in.
    #[test]
    fn a_normal_that_is_none_is_refused() {
        for normal in [[0.0; 3], [f64::NAN, 0.0, 1.0]] {
            assert!(Dowel::he_kwan(10.0, 30.0, 200e3, 50.0, normal).is_err());
        }
    }

    /// The length of the normal says nothing.
    #[test]
    fn a_short_normal_is_as_good_as_a_unit_one() {
        let [unit, short] = [1.0, 1e-7]
            .map(|length| Dowel::he_kwan(16.0, 30.0, 200e3, 100.0, [0.0, 0.0, length]).unwrap());
        assert_eq!(short.plane_normal(), unit.plane_normal());
    }

    /// Thin bars in strong concrete shear off: V_0 is no more than A fy/sqrt(3).
    #[test]
    fn steel_shears_off_in_strong_concrete() {
        let free = Dowel::he_kwan(10.0, 80.0, 200e3, 50.0, [0.0, 0.0, 1.0]).unwrap();
        let dowel = free.bounded(10.0, 80.0, 350.0).unwrap();
        let shear = 25.0 * std::f64::consts::PI * 350.0 / 3.0_f64.sqrt();
        assert!((dowel.at(1.0, 0.0, 0.0).force - shear).abs() < 1e-6);
    }
}
