//! Curves of bond stress over slip in monotone loading, the envelopes of [`SlipDamage`](crate::SlipDamage).

mod bilinear;
mod exponential;
mod lu;
mod model_code;

use std::fmt::Debug;

pub use bilinear::{Bilinear, BilinearEnergy, BilinearSlips};
pub use exponential::{Exponential, ExponentialParameters};
pub use lu::{LuJoint, LuPrecise, LuSimplified};
pub use model_code::{Bond, Confinement, ModelCode, ModelCodeParameters};

/// Bond stress tau (MPa) over the slip s (mm) of a monotone path.
///
/// The secant stiffness tau/s must not grow with the slip: [`SlipDamage`](crate::SlipDamage) takes its
/// damage from it.
pub trait Envelope: Debug + Send + Sync + 'static {
    /// Name, for messages and output.
    fn name(&self) -> &'static str;

    /// Initial stiffness K0 (MPa/mm): tau/s as s goes to zero.
    fn stiffness(&self) -> f64;

    /// Largest stress tau_max (MPa).
    fn strength(&self) -> f64;

    /// Slip s0 (mm) at which it is reached.
    fn peak_slip(&self) -> f64;

    /// Slip s_f (mm) at which the bond counts as lost: where the stress ends, has fallen to one hundredth of tau_max on a curve
    /// that only approaches zero, or to the friction that is left on a curve that ends in friction.
    fn final_slip(&self) -> f64;

    /// Fracture energy G_f (N/mm): the area under the whole curve; infinite for one with residual stress.
    fn energy(&self) -> f64;

    /// Secant stiffness tau/s (MPa/mm) at a slip s >= 0, and its derivative with respect to s.
    fn secant(&self, slip: f64) -> (f64, f64);

    /// Stress (MPa) at a slip s >= 0 (mm).
    fn stress(&self, slip: f64) -> f64 {
        self.secant(slip).0 * slip
    }
}

/// Share of tau_max below which a curve without end counts as lost bond.
const LOST: f64 = 0.01;
