//! Effective stress of the Ottosen surface as a function of the invariants, and its derivatives.
//!
//! F^2 = A F + alpha J2 with A = L + beta I1, L = lambda(c) r, r = sqrt(J2), c = cos 3t = k J3/r^3,
//! k = 3 sqrt3/2. All derivatives are taken with respect to (I1, J2, J3) through c, which is smooth on the
//! meridians, where the Lode angle is not: no tan 3t, no division by sin 3t.

use nalgebra::{Matrix3, Vector3, Vector6};

use super::Ottosen;

/// (3 sqrt3)/2, the factor of cos 3t.
const LODE_FACTOR: f64 = 2.598_076_211_353_316;

/// Invariants of a stress and its deviator.
pub(super) struct Invariants<D> {
    pub(super) i1: f64,
    pub(super) j2: f64,
    j3: f64,
    pub(super) deviator: D,
}

impl Invariants<Vector6<f64>> {
    pub(super) fn of_voigt(s: &Vector6<f64>) -> Self {
        let i1 = s[0] + s[1] + s[2];
        let mean = i1 / 3.0;
        let [a, b, c] = [s[0] - mean, s[1] - mean, s[2] - mean];
        let [xy, yz, xz] = [s[3], s[4], s[5]];
        Self {
            i1,
            j2: 0.5 * (a * a + b * b + c * c) + xy * xy + yz * yz + xz * xz,
            j3: a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz),
            deviator: Vector6::new(a, b, c, xy, yz, xz),
        }
    }
}

impl Invariants<Vector3<f64>> {
    pub(super) fn of_principal(s: &Vector3<f64>) -> Self {
        let i1 = s[0] + s[1] + s[2];
        let deviator = s.add_scalar(-i1 / 3.0);
        Self {
            i1,
            j2: 0.5 * deviator.norm_squared(),
            j3: deviator[0] * deviator[1] * deviator[2],
            deviator,
        }
    }
}

impl<D> Invariants<D> {
    /// Whether the deviator vanishes to rounding: the Lode angle is undefined.
    fn hydrostatic(&self) -> bool {
        self.j2.sqrt() <= 1e-15 * self.i1.abs()
    }

    fn cos3t(&self) -> f64 {
        (LODE_FACTOR * self.j3 / (self.j2 * self.j2.sqrt())).clamp(-1.0, 1.0)
    }
}

/// Derivatives of F with respect to I1, J2 and J3.
pub(super) struct First {
    pub(super) i1: f64,
    pub(super) j2: f64,
    pub(super) j3: f64,
}

/// lambda and its derivatives with respect to c = cos 3t.
struct Lambda {
    value: f64,
    slope: f64,
    curvature: f64,
}

impl Ottosen {
    fn lambda_derivatives(&self, c: f64) -> Lambda {
        let u = self.c2 * c;
        let phi = u.acos();
        let (sin, cos) = (phi / 3.0).sin_cos();
        let root = (1.0 - u * u).sqrt();
        let d_phi = -self.c2 / root;
        let d2_phi = d_phi * self.c2 * u / (root * root);
        Lambda {
            value: self.c1 * cos,
            slope: -self.c1 * sin * d_phi / 3.0,
            curvature: -self.c1 * (cos * d_phi * d_phi / 9.0 + sin * d2_phi / 3.0),
        }
    }

    /// F and S = 2 F - A for given A and J2, free of cancellation.
    pub(super) fn solve(&self, a: f64, j2: f64) -> (f64, f64) {
        let s = (a * a + 4.0 * self.alpha * j2).sqrt();
        let f = if a >= 0.0 {
            0.5 * (a + s)
        } else {
            2.0 * self.alpha * j2 / (s - a)
        };
        (f, s)
    }

    pub(super) fn value<D>(&self, q: &Invariants<D>) -> f64 {
        if q.hydrostatic() {
            return (self.beta * q.i1).max(0.0);
        }
        let a = self.lambda(q.cos3t()) * q.j2.sqrt() + self.beta * q.i1;
        self.solve(a, q.j2).0
    }

    pub(super) fn first_derivatives<D>(&self, q: &Invariants<D>) -> (f64, First) {
        if q.hydrostatic() {
            let slope = if q.i1 > 0.0 { self.beta } else { 0.0 };
            return (
                slope * q.i1,
                First {
                    i1: slope,
                    j2: 0.0,
                    j3: 0.0,
                },
            );
        }
        let (r, c) = (q.j2.sqrt(), q.cos3t());
        let lambda = self.lambda_derivatives(c);
        let (f, s) = self.solve(lambda.value * r + self.beta * q.i1, q.j2);
        let l2 = (0.5 * lambda.value - 1.5 * lambda.slope * c) / r;
        let l3 = LODE_FACTOR * lambda.slope / q.j2;
        let share = f / s;
        (
            f,
            First {
                i1: share * self.beta,
                j2: share * l2 + self.alpha / s,
                j3: share * l3,
            },
        )
    }

    /// Effective stress F (MPa) and its gradient (-) with respect to three principal stresses (MPa), in any
    /// order; kinks as in [`Ottosen::gradient`].
    pub fn principal_gradient(&self, stress: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let q = Invariants::of_principal(stress);
        let (f, d) = self.first_derivatives(&q);
        let gradient = q
            .deviator
            .map(|s| d.i1 + d.j2 * s + d.j3 * (s * s - 2.0 / 3.0 * q.j2));
        (f, gradient)
    }

    /// lambda and its first two derivatives with respect to the Lode angle (rad).
    pub(crate) fn polar_lambda(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = (3.0 * angle).sin_cos();
        let lambda = self.lambda_derivatives(cos);
        [
            lambda.value,
            -3.0 * sin * lambda.slope,
            9.0 * (sin * sin * lambda.curvature - cos * lambda.slope),
        ]
    }

    /// F and S = 2 F - A (MPa) for given lambda, sqrt(J2) and I1.
    pub(crate) fn polar_value(&self, lambda: f64, r: f64, i1: f64) -> (f64, f64) {
        self.solve(lambda * r + self.beta * i1, r * r)
    }

    /// F (MPa), gradient (-) and Hessian (1/MPa) with respect to three principal stresses.
    ///
    /// The Hessian is that of the smooth surface; where J2 = 0 it is undefined and zero is returned.
    pub fn principal_derivatives(
        &self,
        stress: &Vector3<f64>,
    ) -> (f64, Vector3<f64>, Matrix3<f64>) {
        let q = Invariants::of_principal(stress);
        if q.hydrostatic() {
            let (f, gradient) = self.principal_gradient(stress);
            return (f, gradient, Matrix3::zeros());
        }
        let (r, c) = (q.j2.sqrt(), q.cos3t());
        let lambda = self.lambda_derivatives(c);
        let (f, s) = self.solve(lambda.value * r + self.beta * q.i1, q.j2);

        // L(J2, J3) with c_2 = -1.5 c/J2 and c_3 = k/r^3.
        let (c_2, c_3) = (-1.5 * c / q.j2, LODE_FACTOR / (q.j2 * r));
        let l2 = 0.5 * lambda.value / r + r * lambda.slope * c_2;
        let l3 = r * lambda.slope * c_3;
        let l22 = -0.25 * lambda.value / (q.j2 * r)
            + lambda.slope * c_2 / r
            + r * (lambda.curvature * c_2 * c_2 + lambda.slope * 3.75 * c / (q.j2 * q.j2));
        let l23 = 0.5 * lambda.slope * c_3 / r
            + r * (lambda.curvature * c_2 * c_3 - 1.5 * lambda.slope * c_3 / q.j2);
        let l33 = r * lambda.curvature * c_3 * c_3;

        let d = &q.deviator;
        let d_j3 = d.map(|x| x * x - 2.0 / 3.0 * q.j2);
        let d_a = d * l2 + d_j3 * l3 + Vector3::repeat(self.beta);
        let gradient = (d_a * f + d * self.alpha) / s;
        let hessian = Matrix3::from_fn(|i, j| {
            let same = if i == j { 1.0 } else { 0.0 };
            let h_j2 = same - 1.0 / 3.0;
            let h_j3 = 2.0 * d[i] * same - 2.0 / 3.0 * (d[i] + d[j]);
            let h_a = l2 * h_j2
                + l3 * h_j3
                + l22 * d[i] * d[j]
                + l23 * (d[i] * d_j3[j] + d_j3[i] * d[j])
                + l33 * d_j3[i] * d_j3[j];
            let outer =
                gradient[i] * d_a[j] + d_a[i] * gradient[j] - 2.0 * gradient[i] * gradient[j];
            (outer + f * h_a + self.alpha * h_j2) / s
        });
        (f, gradient, hessian)
    }
}
