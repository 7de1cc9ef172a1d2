//! The bound of what is allowed.

/// Halvings that find it.
const HALVINGS: usize = 40;

/// The last value on the way from `fits`, which does, to `fails`, that `will_do`.
pub(crate) fn last(mut fits: f64, mut fails: f64, will_do: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = fits.midpoint(fails);
        if will_do(middle) {
            fits = middle;
        } else {
            fails = middle;
        }
    }
    fits
}

/// A range up to or from a bound as it is told, with two digits, for a value beyond it.
pub(crate) fn allowed(bound: f64, value: f64) -> String {
    if value > bound {
        format!("up to {:.2}", (100.0 * bound).floor() / 100.0)
    } else {
        format!("from {:.2}", (100.0 * bound).ceil() / 100.0)
    }
}
