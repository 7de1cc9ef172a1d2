//! The orthotropic branch in the axes of the cracks.

use fe_core::kinematics::Solid;
use fe_core::material::{MaterialError, Operator, PointContext, Response};
use fe_core::principal::{Principal, principal};
use fe_core::voigt::{SHEAR_PAIRS, strain_into, strain_tensor, strain_transform, stress_out_of};
use nalgebra::{Matrix6, Vector6};

use super::confinement::Pressed;
use super::shear::{Factor, HISTORY, Retention};
use super::{Envelopes, FixedCrack, OPERATOR_FLOOR, State, wants_secant, wants_tangent};

impl FixedCrack {
    /// Stress of a cracked point, with its principal strains if they are known; updates the histories. `onset` tells that
    /// the first crack opens in this very update: its axes then still follow the strain.
    pub(super) fn cracked(
        &self,
        (strain, known): (&Vector6<f64>, Option<&Principal>),
        state: &mut State,
        (ctx, envelopes): (&PointContext, &Envelopes),
        onset: bool,
        out: &mut Response<Solid>,
    ) -> Result<(), MaterialError> {
        let tension = self.tension(state, envelopes, ctx.band_width)?;
        let compression = &envelopes.compression;
        let turning = !state.second;
        if !onset && !state.fixed {
            self.follow((strain, known), state, &tension, (ctx, envelopes));
        }
        let following = !onset && !state.fixed;
        let e = if turning && !following {
            state.turn(strain)
        } else {
            strain_into(&state.axes, strain)
        };
        let young = self.p.young_mpa;
        let derive = wants_tangent(ctx);
        let mut local = Vector6::zeros();
        let mut d = Matrix6::zeros();
        let mut retention = Retention::default();
        let grow_t: [f64; 3] = std::array::from_fn(|i| e[i] - state.kt[i]);
        for (k, growth) in state.kt.iter_mut().zip(grow_t) {
            *k += ctx.relaxation * growth.max(0.0);
        }
        state.second |= grow_t[1] > 0.0 || grow_t[2] > 0.0;
        state.fixed |= state.second || self.p.fixing_share >= 1.0;
        let growing = |growth: f64| if growth > 0.0 { ctx.relaxation } else { 0.0 };
        retention.growing = grow_t.map(growing);
        // Isotropic in the axes that turn: the one that is compressed most, the last, speaks for all.
        let turned = match (following, turning) {
            (true, _) => 0,
            (_, true) => 1,
            _ => 2,
        };
        state.kc[2] = state.kc[turned..].iter().copied().fold(0.0, f64::max);
        let last = state.kc[2];
        state.kc[turned..].fill(last);
        let driven = std::array::from_fn(|i| if i >= turned { 2 } else { i });
        let before = state.kc;
        let strains = Pressed {
            e: &[e[0], e[1], e[2]],
            kc: &before,
            driven,
            relaxation: ctx.relaxation,
        };
        let grown = self.pressed(&strains, compression);
        state.kc = grown;
        state.kc[turned..].fill(grown[2]);
        if derive {
            retention.pressed = Some(self.pressed_slopes(&strains, compression));
        }
        for i in 0..3 {
            state.crushing = state.crushing.max(compression.crushing(state.kc[i]));
            let (soft, soft_slopes) = if e[i] >= 0.0 {
                (1.0, [0.0; 3])
            } else {
                self.softening(&state.kt, i, ctx.band_width)
            };
            let (bridged, by_kt) = tension[i].secant(state.kt[i]);
            let bridged_slope = retention.growing[i] * by_kt;
            let (whole, by_kc) = compression.secant(state.kc[i]);
            let secant = if e[i] >= 0.0 { bridged } else { soft * whole };
            local[i] = secant * e[i];
            if wants_secant(ctx) {
                d[(i, i)] = secant.max(OPERATOR_FLOOR * young);
            } else if derive {
                d[(i, i)] = secant;
                if e[i] >= 0.0 {
                    d[(i, i)] += bridged_slope * e[i];
                } else {
                    let by_strain = retention.pressed.map_or([0.0; 3], |by| by[driven[i]]);
                    for j in 0..3 {
                        d[(i, j)] += soft * by_kc * by_strain[j] * e[i];
                        if j != i {
                            d[(i, j)] += retention.growing[j] * soft_slopes[j] * whole * e[i];
                        }
                    }
                }
            }
            let factor = |modulus, slope, axis| Factor {
                value: modulus / young,
                slope: slope / young,
                axis,
            };
            retention.tension[i] = factor(bridged, bridged_slope, i);
            retention.compression[i] = factor(whole, by_kc, HISTORY + driven[i]);
        }
        let shear = self.shear(state, (&e, ctx), &retention, (&local, &d));
        for (k, (i, j)) in SHEAR_PAIRS.into_iter().enumerate() {
            let row = 3 + k;
            local[row] = shear.stress[k];
            if wants_secant(ctx) {
                d[(row, row)] = shear.shares[k] * self.shear_modulus;
            }
            if !derive {
                continue;
            }
            d.set_row(row, &shear.tangent[k].transpose());
            if onset || i.min(j) >= turned {
                // The axes turn with the strain: stress and strain stay coaxial.
                let gap = e[i] - e[j];
                d[(row, row)] = if gap.abs() > 1e-9 * e.amax() {
                    (local[i] - local[j]) / (2.0 * gap)
                } else {
                    // Its limit for equal strains.
                    let [a, b] = [(i, j), (j, i)].map(|(i, j)| d[(i, i)] - d[(i, j)]);
                    0.5 * a.midpoint(b)
                };
            }
        }
        out.stress = stress_out_of(&state.axes, &local);
        if ctx.operator != Operator::None {
            let t = strain_transform(&state.axes);
            out.tangent = t.tr_mul(&d) * t;
        }
        Ok(())
    }

    /// Factor of the cracks across axis `i` on its compression curve, and its derivatives.
    pub(super) fn softening(&self, kt: &[f64; 3], i: usize, band_width: f64) -> (f64, [f64; 3]) {
        let law = self.p.compression_softening;
        let unit = self.p.crack_reach(band_width) / (self.p.crack_spacing_mm * self.p.eps_c1);
        law.factor(kt, i, unit)
    }

    /// Free energy density of a cracked point (MPa).
    pub(super) fn cracked_energy(
        &self,
        strain: &Vector6<f64>,
        state: &State,
        ctx: &PointContext,
    ) -> Option<f64> {
        let envelopes = self.envelopes(ctx).ok()?;
        let tension = self.tension(state, &envelopes, ctx.band_width).ok()?;
        let compression = &envelopes.compression;
        let mut state = *state;
        if !state.fixed {
            state.axes = principal(&strain_tensor(strain)).1;
        }
        let e = if state.fixed && !state.second {
            state.turn(strain)
        } else {
            strain_into(&state.axes, strain)
        };
        let mut energy = self.shear_energy(&state, &e);
        for i in 0..3 {
            let bridged = tension[i].secant(state.kt[i]).0;
            let whole = compression.secant(state.kc[i]).0;
            let soft = self.softening(&state.kt, i, ctx.band_width).0;
            let secant = if e[i] >= 0.0 { bridged } else { soft * whole };
            energy += 0.5 * secant * e[i] * e[i];
        }
        Some(energy)
    }
}

impl State {
    /// Turns the axes in the plane of the first crack into the principal ones of the strain there, the larger first; returns
    /// the strains along them.
    fn turn(&mut self, strain: &Vector6<f64>) -> Vector6<f64> {
        let e = strain_into(&self.axes, strain);
        if e[4] == 0.0 && e[1] >= e[2] {
            return e;
        }
        let (sin, cos) = (0.5 * e[4].atan2(e[1] - e[2])).sin_cos();
        let s = self.axes.column(1) * cos + self.axes.column(2) * sin;
        let t = self.axes.column(2) * cos - self.axes.column(1) * sin;
        self.axes.set_column(1, &s);
        self.axes.set_column(2, &t);
        strain_into(&self.axes, strain)
    }
}
