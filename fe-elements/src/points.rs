//! History of the integration points of an element: slices of equal length, one after the other.

use fe_core::kinematics::Kinematics;
use fe_core::material::Material;

/// Writes the virgin state of every point.
pub(crate) fn init_state<K: Kinematics>(law: &dyn Material<K>, state: &mut [f64]) {
    let n = law.state_len();
    if n > 0 {
        for own in state.chunks_exact_mut(n) {
            law.init_state(own);
        }
    }
}

/// [`Material::latch`] for every point.
pub(crate) fn latch<K: Kinematics>(law: &dyn Material<K>, trial: &[f64], base: &mut [f64]) {
    let n = law.state_len();
    if n > 0 {
        for (t, b) in trial.chunks_exact(n).zip(base.chunks_exact_mut(n)) {
            law.latch(t, b);
        }
    }
}
