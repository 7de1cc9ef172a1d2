//! The orthotropic branch in the frozen axes.

use fe_core::kinematics::Solid;
use fe_core::material::{Operator, PointContext, Response};
use fe_core::voigt::{SHEAR_PAIRS, strain_transform};
use nalgebra::{Matrix6, Vector6};

use super::{OPERATOR_FLOOR, Reference, State};

/// Stress of one axis with its derivative and its secant.
struct AxisResponse {
    stress: f64,
    slope: f64,
    secant: f64,
}

impl Reference {
    /// Stress of a cracked point; updates the state.
    pub(super) fn cracked(
        &self,
        strain: &Vector6<f64>,
        state: &mut State,
        ctx: &PointContext,
    ) -> Response<Solid> {
        let t = strain_transform(&state.axes);
        let total = t * strain;
        let plastic = t * state.plastic.strain;
        let wants_secant = ctx.operator == Operator::Secant;
        let young = self.young();
        let mut stress = Vector6::zeros();
        let mut d = Matrix6::zeros();
        let mut retention = [(1.0, 0.0); 3];
        for i in 0..3 {
            // eps_p + kappa of an axis never changes, so that eps_p need not be stored.
            let invariant = plastic[i] + state.plastic.kappa;
            let e = total[i] - (invariant - state.kappa[i]);
            let axis = if e < 0.0 {
                self.compression(total[i], invariant, &mut state.kappa[i])
            } else {
                state.cracked[i] |= young * e > self.strength();
                if state.cracked[i] {
                    retention[i] = self.p.retention.factor(e, self.p.shear_floor);
                    self.opened(e, i, state, ctx.relaxation)
                } else {
                    self.elastic(e)
                }
            };
            stress[i] = axis.stress;
            d[(i, i)] = if wants_secant {
                axis.secant.max(OPERATOR_FLOOR * young)
            } else {
                axis.slope
            };
        }
        state.crushed |= state.kappa.iter().any(|&k| k >= self.curve().peak_kappa());
        for (k, (i, j)) in SHEAR_PAIRS.into_iter().enumerate() {
            let weak = if retention[i].0 <= retention[j].0 {
                i
            } else {
                j
            };
            let (factor, slope) = retention[weak];
            let gamma = total[3 + k] - plastic[3 + k];
            stress[3 + k] = factor * self.shear_modulus * gamma;
            d[(3 + k, 3 + k)] = factor * self.shear_modulus;
            if !wants_secant {
                d[(3 + k, weak)] = slope * self.shear_modulus * gamma;
            }
        }
        Response {
            stress: t.tr_mul(&stress),
            tangent: match ctx.operator {
                Operator::None => Matrix6::zeros(),
                _ => t.tr_mul(&d) * t,
            },
        }
    }

    fn elastic(&self, e: f64) -> AxisResponse {
        AxisResponse {
            stress: self.young() * e,
            slope: self.young(),
            secant: self.young(),
        }
    }

    /// Compression along an axis, the crack closed or not: elastic up to the curve, then along it.
    fn compression(&self, total: f64, invariant: f64, kappa: &mut f64) -> AxisResponse {
        let curve = self.curve();
        let e = total - (invariant - *kappa);
        if -self.young() * e <= curve.at(curve.eta(*kappa)).stress {
            return self.elastic(e);
        }
        let point = curve.at((invariant - total) / curve.peak_strain());
        *kappa = point.kappa;
        AxisResponse {
            stress: -point.stress,
            slope: point.stress_slope / curve.peak_strain(),
            secant: self.young(),
        }
    }

    /// Tension across a crack; the admitted share of the growth of the opening is `relaxation`.
    fn opened(&self, e: f64, i: usize, state: &mut State, relaxation: f64) -> AxisResponse {
        let growth = e - state.opening[i];
        let grows = growth > 0.0;
        state.opening[i] += relaxation * growth.max(0.0);
        let (secant, secant_slope) = self.stiffening_secant(i, state);
        AxisResponse {
            stress: secant * e,
            slope: if grows {
                secant + relaxation * secant_slope * e
            } else {
                secant
            },
            secant,
        }
    }

    /// Secant of the tension stiffening at the largest opening r of an axis, min(Eci, a_ts fctm (1/r -
    /// 1/eps_ctu)), not below zero, and its derivative with respect to r.
    pub(super) fn stiffening_secant(&self, i: usize, state: &State) -> (f64, f64) {
        let axis = state.axes.column(i).into_owned();
        if !self.p.stiffening.serves(&axis) {
            return (0.0, 0.0);
        }
        let opening = state.opening[i];
        let plateau = self.p.stiffening_share * self.strength();
        let secant = plateau * (1.0 / opening - 1.0 / self.p.stiffening_end);
        if secant >= self.young() {
            (self.young(), 0.0)
        } else if secant > 0.0 {
            (secant, -plateau / (opening * opening))
        } else {
            (0.0, 0.0)
        }
    }
}
