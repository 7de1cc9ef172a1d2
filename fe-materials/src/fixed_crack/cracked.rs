//! The orthotropic branch in the frozen axes.

use fe_core::kinematics::Solid;
use fe_core::material::{MaterialError, Operator, PointContext, Response};
use fe_core::voigt::{strain_into, strain_transform, stress_out_of};
use nalgebra::{Matrix6, Vector6};

use super::shear_transfer::{self, Interlock};
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
        out: &mut Response<Solid>,
    ) -> Result<(), MaterialError> {
        let (tension, compression) = self.envelopes(state, ctx.band_width)?;
        let e = strain_into(&state.axes, strain);
        let young = self.p.young_mpa;
        let mut local = Vector6::zeros();
        let mut d = Matrix6::zeros();
        let mut retention = [Retention::default(); 3];
        let mut crushed = [Retention::default(); 3];
        let grow_t: [f64; 3] = std::array::from_fn(|i| e[i] - state.kt[i]);
        for (k, growth) in state.kt.iter_mut().zip(grow_t) {
            *k += ctx.relaxation * growth.max(0.0);
        }
        let growing = |growth: f64| if growth > 0.0 { ctx.relaxation } else { 0.0 };
        for i in 0..3 {
            let grow_c = -e[i] - state.kc[i];
            state.kc[i] += ctx.relaxation * grow_c.max(0.0);
            state.crushing = state.crushing.max(compression.crushing(state.kc[i]));
            let (soft, soft_slopes) = self.softening(&state.kt, i);
            let whole = compression.secant(state.kc[i]);
            let in_tension = Retention {
                value: tension[i].secant(state.kt[i]),
                slope: growing(grow_t[i]) * tension[i].secant_slope(state.kt[i]),
            };
            let in_compression = Retention {
                value: soft * whole,
                slope: -growing(grow_c) * soft * compression.secant_slope(state.kc[i]),
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
            if !wants_secant(ctx) && e[i] < 0.0 {
                for j in (0..3).filter(|&j| j != i) {
                    d[(i, j)] = growing(grow_t[j]) * soft_slopes[j] * whole * e[i];
                }
            }
            crushed[i] = Retention {
                value: whole / young,
                slope: -growing(grow_c) * compression.secant_slope(state.kc[i]) / young,
            };
            retention[i] = if in_tension.value <= whole {
                Retention {
                    value: in_tension.value / young,
                    slope: in_tension.slope / young,
                }
            } else {
                crushed[i]
            };
        }
        let interlocks = self.interlocks(state, ctx.band_width);
        for (k, (i, j)) in SHEAR_PAIRS.into_iter().enumerate() {
            let row = 3 + k;
            let weak = if retention[i].value <= retention[j].value {
                i
            } else {
                j
            };
            let floor = self.p.shear_floor;
            let mut b = retention[weak];
            if b.value <= floor {
                b = Retention {
                    value: floor,
                    slope: 0.0,
                };
            }
            let elastic = self.shear_modulus * e[row];
            let mut share = b;
            let mut of = weak;
            let mut limit = None;
            let open = wider(state, i, j);
            if let Some(interlock) = interlocks[open] {
                let opening = ctx.band_width * growing(grow_t[open]);
                let stiff = if crushed[i].value <= crushed[j].value {
                    i
                } else {
                    j
                };
                let (r, axis) = if interlock.factor.0 <= crushed[stiff].value {
                    let (value, slope) = interlock.factor;
                    let slope = slope * opening;
                    (Retention { value, slope }, open)
                } else {
                    (crushed[stiff], stiff)
                };
                let (v, slope) = interlock.strength;
                let size = elastic.abs();
                if r.value > b.value && b.value * size < v {
                    if r.value * size <= v {
                        (share, of) = (r, axis);
                    } else {
                        share.value = v / size;
                        limit = Some((open, slope * opening * elastic.signum()));
                    }
                }
            }
            local[row] = share.value * elastic;
            d[(row, row)] = share.value * self.shear_modulus;
            if wants_secant(ctx) {
                continue;
            }
            if let Some((open, slope)) = limit {
                d[(row, row)] = 0.0;
                d[(row, open)] = slope;
            } else {
                d[(row, of)] = share.slope * elastic;
            }
            let gap = e[i] - e[j];
            if onset && gap.abs() > f64::EPSILON {
                // The axes turn with the strain: stress and strain stay coaxial.
                d[(row, row)] = (local[i] - local[j]) / (2.0 * gap);
            }
        }
        out.stress = stress_out_of(&state.axes, &local);
        if ctx.operator != Operator::None {
            let t = strain_transform(&state.axes);
            out.tangent = t.tr_mul(&d) * t;
        }
        Ok(())
    }

    /// The interlock of every axis with an open crack.
    fn interlocks(&self, state: &State, h: f64) -> [Option<Interlock>; 3] {
        let closed = self.p.ft_mpa / self.p.young_mpa;
        let transfer = self.p.shear_transfer;
        state
            .kt
            .map(|k| transfer.interlock(&self.p, self.shear_modulus, h, h * (k - closed)))
    }

    /// Factor of the cracks across axis `i` on its compression curve, and its derivatives.
    fn softening(&self, kt: &[f64; 3], i: usize) -> (f64, [f64; 3]) {
        self.p.compression_softening.factor(kt, i, self.p.eps_c1)
    }

    /// Free energy density of a cracked point (MPa).
    pub(super) fn cracked_energy(
        &self,
        strain: &Vector6<f64>,
        state: &State,
        ctx: &PointContext,
    ) -> Option<f64> {
        let (tension, compression) = self.envelopes(state, ctx.band_width).ok()?;
        let e = strain_into(&state.axes, strain);
        let secants = |i: usize| {
            (
                tension[i].secant(state.kt[i]),
                compression.secant(state.kc[i]),
            )
        };
        let interlocks = self.interlocks(state, ctx.band_width);
        let mut energy = 0.0;
        for i in 0..3 {
            let (st, sc) = secants(i);
            let sc = self.softening(&state.kt, i).0 * sc;
            energy += 0.5 * if e[i] >= 0.0 { st } else { sc } * e[i] * e[i];
        }
        for (k, (i, j)) in SHEAR_PAIRS.into_iter().enumerate() {
            let ((ti, ci), (tj, cj)) = (secants(i), secants(j));
            let young = self.p.young_mpa;
            let crushed = ci.min(cj) / young;
            let b = (ti.min(tj) / young).min(crushed).max(self.p.shear_floor);
            let interlock = interlocks[wider(state, i, j)]
                .map(|lock| (lock.factor.0.min(crushed), lock.strength.0));
            let elastic = self.shear_modulus * e[3 + k].abs();
            energy += shear_transfer::energy(b, interlock, self.shear_modulus, elastic);
        }
        Some(energy)
    }
}

/// The axis of a pair with the wider crack.
fn wider(state: &State, i: usize, j: usize) -> usize {
    if state.kt[i] >= state.kt[j] { i } else { j }
}
