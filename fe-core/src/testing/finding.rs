//! What a test found, held against its target and told in one call, so that the three cannot drift apart.
//!
//! Each call prints one line on standard output, which `cargo test -- --show-output` shows under the name of the test:
//!
//! ```text
//! finding | tests/tests/el05_cook.rs | deflection, 8 x 8 cells | 23.8840 | 23.884 ± 0.001
//! curve | tests/tests/el05_cook.rs | cook, 9 points | 0.5 22.718, 0.25 23.708
//! ```
//!
//! These are the place, what was found, its value to one digit more than the target asks for, and the target. The line is
//! printed before the check, so that a test that fails shows it as well.

use std::fmt::Write;
use std::panic::Location;

/// Tells a value and holds it against a target, met within a tolerance of its own unit.
///
/// # Panics
///
/// If it misses: for tests.
#[track_caller]
pub fn within(what: &str, found: f64, target: f64, tolerance: f64) {
    hold(what, found, (target, tolerance), &plain(tolerance));
}

/// Tells a value and holds it against a target, met within a share of it.
///
/// # Panics
///
/// If it misses: for tests.
#[track_caller]
pub fn within_share(what: &str, found: f64, target: f64, share: f64) {
    let told = format!("{} %", plain(100.0 * share));
    hold(what, found, (target, share * target.abs()), &told);
}

/// Tells a value and its target with the tolerance in words, and holds one against the other.
#[track_caller]
fn hold(what: &str, found: f64, (target, tolerance): (f64, f64), told: &str) {
    let goal = format!("{} ± {told}", goal(target, tolerance));
    tell(what, &rounded(found, tolerance), &goal);
    assert!(
        (found - target).abs() <= tolerance,
        "{what}: {found} instead of {target}"
    );
}

/// Tells a value and holds it against the ends of a range.
///
/// # Panics
///
/// If it is outside: for tests.
#[track_caller]
pub fn between(what: &str, found: f64, [low, high]: [f64; 2]) {
    let goal = format!("{} to {}", plain(low), plain(high));
    tell(what, &rounded(found, 0.1 * (high - low)), &goal);
    assert!(
        found >= low && found <= high,
        "{what}: {found} outside {low} to {high}"
    );
}

/// Tells the size of a deviation, which must not exceed a limit. See [`Worst`](super::Worst) for that of many.
///
/// # Panics
///
/// If it does: for tests.
#[track_caller]
pub fn below(what: &str, found: f64, limit: f64) {
    let goal = format!("< {}", plain(limit));
    let size = if beyond(found, limit) {
        goal.clone()
    } else {
        size(found)
    };
    tell(what, &size, &goal);
    assert!(found <= limit, "{what}: {found:e} exceeds {limit:e}");
}

/// Tells a count and holds it against the one expected.
///
/// # Panics
///
/// If they differ: for tests.
#[track_caller]
pub fn counted(what: &str, found: usize, target: usize) {
    tell(what, &found.to_string(), &target.to_string());
    assert_eq!(found, target, "{what}");
}

/// Tells the points of a curve, for a figure.
#[track_caller]
pub fn curve(name: &str, points: impl IntoIterator<Item = [f64; 2]>) {
    let mut line = String::new();
    for [x, y] in points {
        let between = if line.is_empty() { "" } else { ", " };
        // Writing to a string does not fail.
        let _ = write!(line, "{between}{} {}", plain(x), plain(y));
    }
    println!("curve | {} | {name} | {line}", Location::caller().file());
}

#[track_caller]
fn tell(what: &str, found: &str, target: &str) {
    let file = Location::caller().file();
    println!("finding | {file} | {what} | {found} | {target}");
}

/// Order of the first digit.
fn order(x: f64) -> i32 {
    x.abs().log10().floor() as i32
}

/// A value with one digit more than its tolerance has, nine at most.
fn rounded(value: f64, tolerance: f64) -> String {
    if value == 0.0 || tolerance <= 0.0 || !(value / tolerance).is_finite() {
        return format!("{value}");
    }
    let first = order(value);
    let digits = (first - order(tolerance) + 1).clamp(0, 8);
    if (-4..7).contains(&first) {
        let decimals = usize::try_from(digits - first).unwrap_or(0);
        format!("{value:.decimals$}")
    } else {
        format!("{value:.*e}", digits as usize)
    }
}

/// A number without the noise of the last digits.
fn plain(x: f64) -> String {
    let x: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    if x != 0.0 && !(-4..7).contains(&order(x)) {
        format!("{x:e}")
    } else {
        format!("{x}")
    }
}

/// A target as it is given, or to the digits that its tolerance asks for if that is endless.
fn goal(target: f64, tolerance: f64) -> String {
    let given = format!("{target}");
    let needed = rounded(target, tolerance);
    if given.len() <= 9 || given.len() <= needed.len() {
        given
    } else {
        needed
    }
}

/// A deviation to two digits; what is left by rounding, which differs between processors, by the power of ten above it.
fn size(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        format!("{x}")
    } else if x.abs() < 1e-8 {
        format!("< {}", plain(10.0_f64.powi(order(x) + 1)))
    } else {
        plain(format!("{x:.1e}").parse().unwrap_or(x))
    }
}

/// Whether a deviation within its limit would be told by a power of ten beyond it.
fn beyond(x: f64, limit: f64) -> bool {
    x > 0.0 && x < 1e-8 && x <= limit && 10.0_f64.powi(order(x) + 1) > limit
}

#[cfg(test)]
mod tests {
    //! Protects what the verification manual shows, and that a miss fails.
    use super::*;

    #[test]
    fn digits_follow_the_tolerance() {
        assert_eq!(rounded(22.718_06, 1e-3), "22.7181");
        assert_eq!(rounded(41_128.091_2, 0.01), "41128.091");
        assert_eq!(rounded(7.333_17e-5, 7e-9), "7.33317e-5");
        assert_eq!(rounded(9_269.91, 90.0), "9270");
        assert_eq!(rounded(6.094_3e-4, 1e-7), "0.00060943");
        assert_eq!(goal(41_128.09, 0.01), "41128.09");
        assert_eq!(goal(57.125, 0.3), "57.125");
        assert_eq!(goal(500.0 / 3.0, 0.33), "166.67");
        assert_eq!(
            [0.1 + 0.2, 7.000_000_000_000_001, 1e-12, 2e5].map(plain),
            ["0.3", "7", "1e-12", "200000"]
        );
        assert_eq!([0.0, 3e-14, 0.004_37].map(size), ["0", "< 1e-13", "0.0044"]);
        let near = [
            (1.1e-14, 2e-14),
            (3e-14, 2e-14),
            (3e-14, 1e-12),
            (0.0, 1e-12),
        ];
        assert_eq!(
            near.map(|(x, limit)| beyond(x, limit)),
            [true, false, false, false]
        );
    }

    #[test]
    #[should_panic(expected = "load: 2.2 instead of 2")]
    fn a_miss_fails() {
        within("load", 2.2, 2.0, 0.1);
    }

    #[test]
    #[should_panic(expected = "load: NaN")]
    fn what_is_no_number_fails() {
        within_share("load", f64::NAN, 2.0, 0.1);
    }

    #[test]
    #[should_panic(expected = "exceeds")]
    fn a_large_deviation_fails() {
        below("miss", f64::NAN, 0.1);
    }

    #[test]
    #[should_panic(expected = "outside")]
    fn a_value_out_of_range_fails() {
        between("ratio", 0.99, [1.0, 1.08]);
    }
}
