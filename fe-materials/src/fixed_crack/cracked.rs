//! The orthotropic branch in the frozen axes.

use fe_core::kinematics::Solid;
use fe_core::material::{MaterialError, Operator, PointContext, Response};
use fe_core::voigt::strain_transform;
use nalgebra::{Matrix6, Vector6};

use super::{FixedCrack, OPERATOR_FLOOR, State, wants_secant};

/// Axis pairs of the local shear components, in Voigt order.
const SHEAR_PAIRS: [(usize, usize); 3] = [(0, 1), (1, 2), (0, 2)];

/// Shear retention r of one axis and its derivative with respect to the axis strain.
#[derive(Debug, Clone, Copy, Default)]
struct Retention {
    value: f64,
    slope: f64,
}

impl FixedCrack {
    /// Stress of a cracked point; updates the histories. `onset` tells that the crack opens in this very
    /// update: its axes then still follow the strain.
    pub(super) fn cracked(
        &self,
        strain: &Vector6<f64>,
        state: &mut State,
        ctx: &PointContext,
        onset: bool,
    ) -> Result<Response<Solid>, MaterialError> {
        let (tension, compression) = self.envelopes(state, ctx.band_width)?;
        let t = strain_transform(&state.axes);
        let e = t * strain;
        let young = self.p.young_mpa;
        let mut local = Vector6::zeros();
        let mut d = Matrix6::zeros();
        let mut retention = [Retention::default(); 3];
        for i in 0..3 {
            let (grow_t, grow_c) = (e[i] - state.kt[i], -e[i] - state.kc[i]);
            state.kt[i] += ctx.relaxation * grow_t.max(0.0);
            state.kc[i] += ctx.relaxation * grow_c.max(0.0);
            state.crushing = state.crushing.max(compression.crushing(state.kc[i]));
            let growing = |growth: f64| if growth > 0.0 { ctx.relaxation } else { 0.0 };
            let in_tension = Retention {
                value: tension[i].secant(state.kt[i]),
                slope: growing(grow_t) * tension[i].secant_slope(state.kt[i]),
            };
            let in_compression = Retention {
                value: compression.secant(state.kc[i]),
                slope: -growing(grow_c) * compression.secant_slope(state.kc[i]),
            };
            let active = if e[i] >= 0.0 {
                in_tension
            } else {
                in_compression
            };
            local[i] = active.value * e[i];
            d[(i, i)] = if wants_secant(ctx) {
                active.value.max(OPERATOR_FLOOR * young)
            } else {
                active.value + active.slope * e[i]
            };
            let weaker = if in_tension.value <= in_compression.value {
                in_tension
            } else {
                in_compression
            };
            retention[i] = Retention {
                value: weaker.value / young,
                slope: weaker.slope / young,
            };
        }
        for (k, (i, j)) in SHEAR_PAIRS.into_iter().enumerate() {
            let weak = if retention[i].value <= retention[j].value {
                i
            } else {
                j
            };
            let r = retention[weak];
            let b = r.value.max(self.p.shear_floor);
            local[3 + k] = b * self.shear_modulus * e[3 + k];
            d[(3 + k, 3 + k)] = b * self.shear_modulus;
            if wants_secant(ctx) {
                continue;
            }
            if r.value > self.p.shear_floor {
                d[(3 + k, weak)] = r.slope * self.shear_modulus * e[3 + k];
            }
            let gap = e[i] - e[j];
            if onset && gap.abs() > f64::EPSILON {
                // The axes turn with the strain: stress and strain stay coaxial.
                d[(3 + k, 3 + k)] = (local[i] - local[j]) / (2.0 * gap);
            }
        }
        let stress = t.tr_mul(&local);
        let tangent = if ctx.operator == Operator::None {
            Matrix6::zeros()
        } else {
            t.tr_mul(&d) * t
        };
        Ok(Response { stress, tangent })
    }

    /// Free energy density of a cracked point (MPa).
    pub(super) fn cracked_energy(
        &self,
        strain: &Vector6<f64>,
        state: &State,
        ctx: &PointContext,
    ) -> Option<f64> {
        let (tension, compression) = self.envelopes(state, ctx.band_width).ok()?;
        let e = strain_transform(&state.axes) * strain;
        let secants = |i: usize| {
            (
                tension[i].secant(state.kt[i]),
                compression.secant(state.kc[i]),
            )
        };
        let mut energy = 0.0;
        for i in 0..3 {
            let (st, sc) = secants(i);
            energy += 0.5 * if e[i] >= 0.0 { st } else { sc } * e[i] * e[i];
        }
        for (k, (i, j)) in SHEAR_PAIRS.into_iter().enumerate() {
            let ((ti, ci), (tj, cj)) = (secants(i), secants(j));
            let r = ti.min(ci).min(tj).min(cj) / self.p.young_mpa;
            energy += 0.5 * r.max(self.p.shear_floor) * self.shear_modulus * e[3 + k] * e[3 + k];
        }
        Some(energy)
    }
}
