//! Internal variables of a point.

use fe_core::material::StateVar;
use nalgebra::Matrix3;

/// Internal variables; see [`State`].
pub(super) const STATE_VARS: [StateVar; 7] = [
    StateVar::scalar("crack_stage", "-"),
    StateVar::vector("crack_axes", "-", 9),
    StateVar::vector("kappa_t", "-", 3),
    StateVar::vector("kappa_c", "-", 3),
    StateVar::scalar("onset_stress", "MPa"),
    StateVar::scalar("crushing", "-"),
    StateVar::vector("shear_shares", "-", 2),
];

/// Typed view of the internal variables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct State {
    pub(super) cracked: bool,
    /// Whether the axes no longer follow the strain.
    pub(super) fixed: bool,
    /// Whether a second crack has opened, which fixes all axes.
    pub(super) second: bool,
    /// Columns are the axes n, s, t.
    pub(super) axes: Matrix3<f64>,
    /// Largest tensile strain per axis.
    pub(super) kt: [f64; 3],
    /// Largest compressive strain per axis (cracked) or principal rank (uncracked).
    pub(super) kc: [f64; 3],
    /// Tensile strength of the first axis: sigma_1 at onset (MPa).
    pub(super) onset: f64,
    /// Largest consumed share of the descending branch in compression.
    pub(super) crushing: f64,
    /// Share of the elastic shear that is carried across the first crack and in its plane.
    pub(super) shares: [f64; 2],
}

impl State {
    /// Whether the axes of a state's point are fixed.
    pub(super) fn is_fixed(s: &[f64]) -> bool {
        s[0] > 1.5
    }

    pub(super) fn read(s: &[f64]) -> Self {
        Self {
            cracked: s[0] > 0.5,
            fixed: Self::is_fixed(s),
            second: s[0] > 2.5,
            axes: Matrix3::from_column_slice(&s[1..10]),
            kt: [s[10], s[11], s[12]],
            kc: [s[13], s[14], s[15]],
            onset: s[16],
            crushing: s[17],
            shares: [s[18], s[19]],
        }
    }

    pub(super) fn write(&self, s: &mut [f64]) {
        // 0: sound, 1: axes follow, 2: axes fixed, 3: second crack.
        s[0] = f64::from(u8::from(self.cracked) + u8::from(self.fixed) + u8::from(self.second));
        s[1..10].copy_from_slice(self.axes.as_slice());
        s[10..13].copy_from_slice(&self.kt);
        s[13..16].copy_from_slice(&self.kc);
        s[16] = self.onset;
        s[17] = self.crushing;
        s[18..20].copy_from_slice(&self.shares);
    }
}
