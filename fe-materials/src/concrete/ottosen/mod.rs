//! The failure surface of Ottosen (1977) as an effective stress.

mod calibration;
mod derivatives;

use fe_core::voigt::stress_tensor;
use nalgebra::{Vector3, Vector6};

pub use calibration::Calibration;
use derivatives::Invariants;

/// The four-parameter failure surface of Ottosen (1977), in the form of fib Model Code 2010, 5.1-13.
///
/// With the invariants I1, J2, J3 and the Lode angle t, cos 3t = (3 sqrt3/2) J3/J2^(3/2), the surface is
///
/// $$ \alpha \frac{J_2}{f_c^2} + \lambda \frac{\sqrt{J_2}}{f_c} + \beta \frac{I_1}{f_c} - 1 = 0,
/// \qquad \lambda = c_1 \cos\left(\tfrac13 \arccos(c_2 \cos 3t)\right). $$
///
/// The Code's two branches for lambda (cos 3t of either sign) are identically this one function.
///
/// Solved for the strength that a stress would need, it gives the **effective stress** F, homogeneous of
/// degree one and convex, with F = fc on the surface:
///
/// $$ F = \frac{A + S}{2}, \qquad A = \lambda \sqrt{J_2} + \beta I_1, \qquad
/// S = \sqrt{A^2 + 4 \alpha J_2}, $$
///
/// evaluated as 2 alpha J2/(S - A) for A < 0, free of cancellation near the hydrostatic compression
/// axis, where F tends to zero.
///
/// Sources: N. S. Ottosen, "A failure criterion for concrete", J. Eng. Mech. Div. ASCE 103 (1977)
/// 527-535; fib Model Code 2010, 5.1.6.2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ottosen {
    strength: f64,
    alpha: f64,
    beta: f64,
    lambda_c: f64,
    lambda_t: f64,
    c1: f64,
    c2: f64,
}

/// Relative rounding that the bound of [`Ottosen::reaches`] may have.
const ROUNDING: f64 = 1e-9;

impl Ottosen {
    /// Uniaxial compressive strength fc (MPa).
    pub const fn strength(&self) -> f64 {
        self.strength
    }

    /// Coefficient alpha of J2 (-).
    pub const fn alpha(&self) -> f64 {
        self.alpha
    }

    /// Coefficient beta of I1 (-).
    pub const fn beta(&self) -> f64 {
        self.beta
    }

    /// lambda on the compressive meridian, t = 60 degrees (-).
    pub const fn lambda_c(&self) -> f64 {
        self.lambda_c
    }

    /// lambda on the tensile meridian, t = 0 (-).
    pub const fn lambda_t(&self) -> f64 {
        self.lambda_t
    }

    /// Size c1 of the deviatoric section (-).
    pub const fn c1(&self) -> f64 {
        self.c1
    }

    /// Shape c2 of the deviatoric section (-): 0 is a circle, 1 a triangle.
    pub const fn c2(&self) -> f64 {
        self.c2
    }

    /// lambda at a value of cos 3t in [-1, 1] (-).
    pub fn lambda(&self, cos3t: f64) -> f64 {
        self.c1 * ((self.c2 * cos3t.clamp(-1.0, 1.0)).acos() / 3.0).cos()
    }

    /// Effective stress F (MPa) of a Voigt stress (MPa); F = fc on the surface.
    pub fn effective_stress(&self, stress: &Vector6<f64>) -> f64 {
        self.value(&Invariants::of_voigt(stress))
    }

    /// Whether the effective stress F of a Voigt stress (MPa) is at least `limit` (MPa). Mostly told without the Lode angle:
    /// F grows with lambda, which is largest on the tensile meridian.
    pub fn reaches(&self, stress: &Vector6<f64>, limit: f64) -> bool {
        let q = Invariants::of_voigt(stress);
        let bound = self.solve(self.lambda_t * q.j2.sqrt() + self.beta * q.i1, q.j2);
        bound.0 >= limit * (1.0 - ROUNDING) && self.value(&q) >= limit
    }

    /// Effective stress F (MPa) of three principal stresses (MPa), in any order.
    pub fn principal_effective_stress(&self, stress: &Vector3<f64>) -> f64 {
        self.value(&Invariants::of_principal(stress))
    }

    /// Effective stress F (MPa) and its gradient dF/dsigma (-), strain-like Voigt: a shear component is the
    /// derivative with respect to that one Voigt component, so that dF/dsigma . sigma = F.
    ///
    /// Where J2 = 0, F has a kink at the apex of the tension side, where the axial member beta 1 of the
    /// subdifferential is returned, and a vanishing gradient on the compression side.
    pub fn gradient(&self, stress: &Vector6<f64>) -> (f64, Vector6<f64>) {
        let invariants = Invariants::of_voigt(stress);
        let (value, d) = self.first_derivatives(&invariants);
        let s = stress_tensor(&invariants.deviator);
        // dJ3/dsigma = s s - (2/3) J2 1, equal to the cofactors of s plus J2/3.
        let square = s * s;
        let spherical = d.i1 - d.j3 * 2.0 / 3.0 * invariants.j2;
        let gradient = Vector6::from_fn(|i, _| {
            let (a, b) = fe_core::voigt::PAIRS[i];
            let component = d.j2 * s[(a, b)] + d.j3 * square[(a, b)];
            if i < 3 {
                component + spherical
            } else {
                2.0 * component
            }
        });
        (value, gradient)
    }
}

#[cfg(test)]
mod tests;
