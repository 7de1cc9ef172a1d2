//! Internal variables of the reference law.

use fe_core::material::StateVar;
use nalgebra::Matrix3;

use crate::plastic_state::PlasticState;

/// Internal variables, in the order of the state slice; see [`State`].
pub(super) const STATE_VARS: [StateVar; 7] = [
    StateVar::vector("plastic_strain", "-", 6),
    StateVar::scalar("kappa", "-"),
    StateVar::scalar("crushed", "-"),
    StateVar::vector("cracked", "-", 3),
    StateVar::vector("crack_axes", "-", 9),
    StateVar::vector("eps_ref", "-", 3),
    StateVar::vector("kappa_axis", "-", 3),
];

/// Typed view of the internal variables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct State {
    /// Plastic strain and hardening of the uncracked law; they rest once a crack has opened.
    pub(super) plastic: PlasticState,
    /// The compressive strength has been reached.
    pub(super) crushed: bool,
    /// Axes with a crack; the first one cracks first.
    pub(super) cracked: [bool; 3],
    /// Columns are the frozen axes n, s, t.
    pub(super) axes: Matrix3<f64>,
    /// Largest strain normal to each crack.
    pub(super) opening: [f64; 3],
    /// Hardening variable per axis; it goes on from kappa at cracking.
    pub(super) kappa: [f64; 3],
}

impl State {
    pub(super) fn read(s: &[f64]) -> Self {
        Self {
            plastic: PlasticState::read(&s[..7]),
            crushed: s[7] > 0.5,
            cracked: [s[8] > 0.5, s[9] > 0.5, s[10] > 0.5],
            axes: Matrix3::from_column_slice(&s[11..20]),
            opening: [s[20], s[21], s[22]],
            kappa: [s[23], s[24], s[25]],
        }
    }

    pub(super) fn write(&self, s: &mut [f64]) {
        self.plastic.write(&mut s[..7]);
        s[7] = f64::from(u8::from(self.crushed));
        s[8..11].copy_from_slice(&self.cracked.map(|c| f64::from(u8::from(c))));
        s[11..20].copy_from_slice(self.axes.as_slice());
        s[20..23].copy_from_slice(&self.opening);
        s[23..26].copy_from_slice(&self.kappa);
    }

    /// Whether the point has cracked.
    pub(super) const fn is_cracked(&self) -> bool {
        self.cracked[0]
    }

    /// Opens the first crack: freezes the axes (columns, normal first) and the plastic strain.
    pub(super) const fn crack(&mut self, axes: Matrix3<f64>, plastic: PlasticState) {
        self.plastic = plastic;
        self.cracked = [true, false, false];
        self.axes = axes;
        self.opening = [0.0; 3];
        self.kappa = [plastic.kappa; 3];
    }
}
