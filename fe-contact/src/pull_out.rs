//! Closed form of a sheet pulled off a rigid substrate.

use fe_core::material::MaterialError;

use crate::envelope::{Bilinear, Envelope};
use crate::limits::positive;

/// A sheet of unit width with bilinear bond over a length L on a rigid substrate, pulled at one end.
///
/// delta'' = tau(delta)/(E_f t_f), force per width p = E_f t_f delta' at the loaded end. With
/// lambda_1^2 = tau_max/(s0 E_f t_f) and lambda_2^2 = tau_max/((s_f - s0) E_f t_f), and a the length that
/// softens next to the loaded end:
///
/// | stage | p |
/// |---|---|
/// | elastic, up to s0 at the loaded end | (tau_max/lambda_1) tanh(lambda_1 L) delta/s0 |
/// | elastic and softening | (tau_max/lambda_2) \[(lambda_2/lambda_1) tanh(lambda_1 (L-a)) cos(lambda_2 a) + sin(lambda_2 a)\] |
/// | peak: tanh(lambda_1 (L-a)) = (lambda_2/lambda_1) tan(lambda_2 a) | (tau_max/lambda_2) s_f/(s_f - s0) sin(lambda_2 a) |
/// | debonding, d off | that of elastic and softening over L - d, with s_f at its end |
/// | the last a_u = pi/(2 lambda_2) | falls from tau_max/lambda_2 to 0 along a straight line |
///
/// A substrate that gives, of membrane stiffness E_c t_c and width b_c under a sheet of width b_f, changes E_f t_f to 1/kappa, kappa =
/// 1/(E_f t_f) + b_f/(b_c E_c t_c), in all formulas: give that as the membrane stiffness; displacements are slips then.
///
/// Lengths are positive (mm), `softened` at most the length; for others the formulas mean nothing, and may be NaN.
///
/// Source: H. Yuan, J. G. Teng, R. Seracino, Z. S. Wu and J. Yao, Engineering Structures 26 (2004) 553-565.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PullOut {
    bond: Bilinear,
    membrane: f64,
    lambda: [f64; 2],
}

impl PullOut {
    /// A sheet of membrane stiffness `membrane_n_per_mm` = E_f t_f (N/mm).
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless it is positive.
    pub fn new(bond: Bilinear, membrane_n_per_mm: f64) -> Result<Self, MaterialError> {
        positive(
            "pull-out",
            &[("membrane_n_per_mm", membrane_n_per_mm, "N/mm")],
        )?;
        let (s0, sf) = (bond.peak_slip(), bond.final_slip());
        let lambda =
            [s0, sf - s0].map(|slip| (bond.strength() / (slip * membrane_n_per_mm)).sqrt());
        Ok(Self {
            bond,
            membrane: membrane_n_per_mm,
            lambda,
        })
    }

    /// lambda_1 and lambda_2 (1/mm).
    pub const fn lambda(&self) -> [f64; 2] {
        self.lambda
    }

    /// Largest force per width (N/mm) that any bond length can carry: sqrt(2 G_f E_f t_f).
    pub fn ultimate(&self) -> f64 {
        (2.0 * self.bond.energy() * self.membrane).sqrt()
    }

    /// Longest element (mm) that resolves the process zone: a third of the softening length at debonding, pi/(2 lambda_2)/3.
    /// Beyond it the force oscillates as the zone passes element by element, and its peak is too high.
    pub fn longest_element(&self) -> f64 {
        self.debonding_zone() / 3.0
    }

    /// Force per width (N/mm) at which the loaded end reaches s0.
    pub fn elastic_limit(&self, length: f64) -> f64 {
        let l1 = self.lambda[0];
        self.bond.strength() / l1 * (l1 * length).tanh()
    }

    /// Force per width (N/mm) and displacement (mm) of the loaded end while `softened` (mm) of the length
    /// softens.
    pub fn softening(&self, length: f64, softened: f64) -> (f64, f64) {
        let [l1, l2] = self.lambda;
        let (s0, sf) = (self.bond.peak_slip(), self.bond.final_slip());
        let tanh = l2 / l1 * (l1 * (length - softened)).tanh();
        let (sin, cos) = (l2 * softened).sin_cos();
        (
            self.bond.strength() / l2 * (tanh * cos + sin),
            s0 + (sf - s0) * (tanh * sin - cos + 1.0),
        )
    }

    /// Softened length at debonding (mm): pi/(2 lambda_2). What is left of a sheet when it comes off at once.
    pub fn debonding_zone(&self) -> f64 {
        std::f64::consts::FRAC_PI_2 / self.lambda[1]
    }

    /// Force per width (N/mm) and displacement (mm) of the loaded end when `debonded` (mm) of the length is off and more than
    /// [`Self::debonding_zone`] is left.
    ///
    /// What is left, l, softens over the a of tan(lambda_2 a) tanh(lambda_1 (l - a)) = lambda_1/lambda_2, at which the slip of its end is
    /// s_f; the part that is off is stretched by p d/(E_f t_f).
    pub fn debonding(&self, length: f64, debonded: f64) -> (f64, f64) {
        let [l1, l2] = self.lambda;
        let left = length - debonded;
        let softened = farthest(left.min(self.debonding_zone()), |a| {
            let (sin, cos) = (l2 * a).sin_cos();
            l2 / l1 * (l1 * (left - a)).tanh() * sin < cos
        });
        let (force, _) = self.softening(left, softened);
        (
            force,
            self.bond.final_slip() + force / self.membrane * debonded,
        )
    }

    /// Force per width (N/mm) and displacement (mm) of the loaded end where the last [`Self::debonding_zone`] of the length begins to
    /// come off, for a length of that at least. From there the path is a straight line to no force at s_f: a snap-back.
    pub fn last_line(&self, length: f64) -> (f64, f64) {
        let force = self.bond.strength() / self.lambda[1];
        let off = length - self.debonding_zone();
        (force, self.bond.final_slip() + force / self.membrane * off)
    }

    /// Softened length (mm), force per width (N/mm) and displacement of the loaded end (mm) at the peak.
    pub fn peak(&self, length: f64) -> (f64, f64, f64) {
        let [l1, l2] = self.lambda;
        let softened = farthest(length.min(self.debonding_zone()), |a| {
            // Times cos(lambda_2 a) > 0, which keeps it finite.
            let (sin, cos) = (l2 * a).sin_cos();
            (l1 * (length - a)).tanh() * cos > l2 / l1 * sin
        });
        let (force, displacement) = self.softening(length, softened);
        (softened, force, displacement)
    }

    /// Effective length (mm): the bond length whose strength is `share`, in (0, 1), of [`Self::ultimate`]; 0.97 in Yuan et
    /// al. (2004), 0.99 in Lu et al. (2005).
    ///
    /// lambda_2 a = asin(share sqrt((s_f - s0)/s_f)),
    /// L_e = a + ln((lambda_1 + lambda_2 tan(lambda_2 a))/(lambda_1 - lambda_2 tan(lambda_2 a)))/(2 lambda_1).
    pub fn effective_length(&self, share: f64) -> f64 {
        let [l1, l2] = self.lambda;
        let (s0, sf) = (self.bond.peak_slip(), self.bond.final_slip());
        let a = (share * ((sf - s0) / sf).sqrt()).asin() / l2;
        let t = l2 * (l2 * a).tan();
        a + ((l1 + t) / (l1 - t)).ln() / (2.0 * l1)
    }
}

/// The place up to which a condition holds that holds at zero and fails from some place before `end` on, by bisection.
fn farthest(end: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, end);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
