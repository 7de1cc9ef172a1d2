//! Axes of a crack that follow the strain while it still bridges some of its strength.

use fe_core::material::PointContext;
use fe_core::principal::Principal;
use nalgebra::Vector6;

use super::confinement::Pressed;
use super::curves::Tension;
use super::{Envelopes, FixedCrack, State, principal_strains};

/// Share of the tensile strength up to which stresses are equal, as those of an open crack and of its sound plane are.
const TIE: f64 = 1e-6;

impl FixedCrack {
    /// Turns the axes into the principal ones of the strain, or fixes them: once the crack bridges no more than the fixing
    /// share of its strength, or where the order of the stresses in the turned axes would no longer be that of the strains. Beyond
    /// that the modulus (sigma_i - sigma_j)/(2 (e_i - e_j)) that turns them is negative, and a step could create energy.
    pub(super) fn follow(
        &self,
        (strain, known): (&Vector6<f64>, Option<&Principal>),
        state: &mut State,
        tension: &[Tension; 3],
        (ctx, envelopes): (&PointContext, &Envelopes),
    ) {
        let bridged = tension[0].secant(state.kt[0]).0 * state.kt[0];
        if bridged <= self.p.fixing_share * state.onset {
            state.fixed = true;
            return;
        }
        let (e, axes) = principal_strains(strain, known);
        let grown = |k: f64, e: f64| k + ctx.relaxation * (e - k).max(0.0);
        let kt = std::array::from_fn(|i| grown(state.kt[i], e[i]));
        let kc = [state.kc.into_iter().fold(0.0, f64::max); 3];
        let compression = &envelopes.compression;
        let strains = Pressed {
            e: e.as_ref(),
            kc: &kc,
            driven: [2; 3],
            relaxation: ctx.relaxation,
        };
        let [_, _, last] = self.pressed(&strains, compression);
        let whole = compression.secant(last).0;
        let stress = |i: usize| {
            let secant = if e[i] >= 0.0 {
                tension[i].secant(kt[i]).0
            } else {
                self.softening(&kt, i, ctx.band_width).0 * whole
            };
            secant * e[i]
        };
        let tie = TIE * self.p.ft_mpa;
        if stress(0) + tie >= stress(1) && stress(1) + tie >= stress(2) {
            state.axes = axes;
        } else {
            state.fixed = true;
        }
    }
}
