//! Shear in the axes of the cracks: retention, slip of the faces and their strength.

use fe_core::material::PointContext;
use nalgebra::{Matrix6, Vector3, Vector6};

use super::shear_transfer::Interlock;
use super::{FixedCrack, State, wants_tangent};

/// Shear components (Voigt order xy, yz, xz) that act across the same cracks, and the axes of these: the shear across
/// the first crack, in whose plane the other axes may still turn, and the shear in its plane.
const PLANES: [(&[usize], &[usize]); 2] = [(&[0, 2], &[0, 1, 2]), (&[1], &[1, 2])];

/// A factor on a modulus and its derivative with respect to the strain of one axis, or to its compressive history.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Factor {
    pub(super) value: f64,
    pub(super) slope: f64,
    /// The axis; 3 more for its history.
    pub(super) axis: usize,
}

/// What is added to an axis to mean its history.
pub(super) const HISTORY: usize = 3;

fn least(a: Factor, b: Factor) -> Factor {
    if b.value < a.value { b } else { a }
}

/// Retention of the axes in tension, Et(kt)/E, and in compression, Ec(kc)/E.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Retention {
    pub(super) tension: [Factor; 3],
    pub(super) compression: [Factor; 3],
    /// Derivatives of the kc with respect to the strains, if they are wanted.
    pub(super) pressed: Option<[[f64; 3]; 3]>,
    /// Derivatives of the kt with respect to the strains.
    pub(super) growing: [f64; 3],
}

/// Shear stresses (MPa), Voigt order; their shares of the elastic ones and derivatives with respect to the local strains.
#[derive(Debug, Default)]
pub(super) struct Shear {
    pub(super) stress: [f64; 3],
    pub(super) shares: [f64; 3],
    pub(super) tangent: [Vector6<f64>; 3],
}

impl FixedCrack {
    /// Shear at local strains `e`, given the stresses (MPa) on the axes and, for a tangent, their derivatives; updates the
    /// shares. Derivatives are those of the consistent tangent; without it they are left at zero.
    pub(super) fn shear(
        &self,
        state: &mut State,
        (e, ctx): (&Vector6<f64>, &PointContext),
        retention: &Retention,
        (local, normal): (&Vector6<f64>, &Matrix6<f64>),
    ) -> Shear {
        let mut out = Shear::default();
        let derive = wants_tangent(ctx);
        let elastic = |k: usize| self.shear_modulus * e[3 + k];
        let crushed = retention.compression.into_iter().reduce(least);
        let crushed = crushed.unwrap_or_default();
        for ((pairs, axes), kept) in PLANES.into_iter().zip(0..) {
            let wider = |a, b| if state.kt[b] > state.kt[a] { b } else { a };
            let open = axes.iter().copied().reduce(wider).unwrap_or(0);
            let reach = self.p.crack_reach(ctx.band_width);
            let opening = reach * retention.growing[open];
            let interlock = self.interlock(state.kt[open], reach);
            let tension = axes.iter().map(|&i| retention.tension[i]);
            let bridged = tension.fold(crushed, least);
            let slips = interlock.map(|lock| Factor {
                value: lock.factor.0,
                slope: lock.factor.1 * opening,
                axis: open,
            });
            let slips = slips.map(|slips| least(slips, crushed));
            let share = self.share(bridged, slips, state.shares[kept]);
            let square: f64 = pairs.iter().map(|&k| elastic(k).powi(2)).sum();
            let strain = square.sqrt();
            let strength = interlock.map(|lock| lock.strength(-local[open]));
            let strength = strength.filter(|v| v.value < share.value * strain);
            let least_share = self.p.shear_floor.min(share.value);
            let mut carried = share.value;
            // Derivatives of the carried share.
            let mut slopes = Vector6::zeros();
            if derive {
                if share.axis < HISTORY {
                    slopes[share.axis] = share.slope;
                } else if let Some(by_strain) = retention.pressed {
                    let by_strain = Vector3::from(by_strain[share.axis - HISTORY]);
                    slopes
                        .fixed_rows_mut::<3>(0)
                        .copy_from(&(share.slope * by_strain));
                }
            }
            if let Some(v) = strength {
                let rate = ctx.relaxation;
                let limit = (v.value / strain).max(least_share);
                carried -= rate * (carried - limit);
                slopes *= 1.0 - rate;
                if derive && limit > least_share {
                    slopes -= normal.row(open).transpose() * (rate * v.by_pressure / strain);
                    slopes[open] += rate * v.by_opening * opening / strain;
                    for &l in pairs {
                        slopes[3 + l] -= rate * limit * elastic(l) * self.shear_modulus / square;
                    }
                }
            }
            state.shares[kept] = carried;
            for &k in pairs {
                out.shares[k] = carried;
                out.stress[k] = carried * elastic(k);
                if derive {
                    out.tangent[k] = slopes * elastic(k);
                    out.tangent[k][3 + k] += carried * self.shear_modulus;
                }
            }
        }
        out
    }

    /// Share carried below the strength of the faces: max(b_min, b, r), no more than was `kept`.
    fn share(&self, bridged: Factor, slips: Option<Factor>, kept: f64) -> Factor {
        let larger = slips.filter(|slips| slips.value > bridged.value);
        let share = larger.unwrap_or(bridged);
        let value = share.value.max(self.p.shear_floor).min(kept);
        let slope = if value == share.value {
            share.slope
        } else {
            0.0
        };
        Factor {
            value,
            slope,
            ..share
        }
    }

    /// Free energy (MPa) of the shear at local strains `e`.
    pub(super) fn shear_energy(&self, state: &State, e: &Vector6<f64>) -> f64 {
        let energy = |((pairs, _), share): ((&[usize], _), f64)| {
            let square: f64 = pairs.iter().map(|&k| e[3 + k].powi(2)).sum();
            0.5 * share * self.shear_modulus * square
        };
        PLANES.into_iter().zip(state.shares).map(energy).sum()
    }

    /// The interlock of a crack whose axis has been strained to `kt` over its `reach` (mm), if it is open.
    fn interlock(&self, kt: f64, reach: f64) -> Option<Interlock> {
        let w = reach * (kt - self.p.ft_mpa / self.p.young_mpa);
        let transfer = self.p.shear_transfer;
        transfer.interlock(&self.p, self.shear_modulus, reach, w)
    }
}
