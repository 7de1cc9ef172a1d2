//! Numbers of the command line and their ranges.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// A number of steps of the command line.
pub(super) fn steps(text: &str) -> Result<u32, String> {
    count(text, 1..=1_000_000)
}

/// A number of threads of the command line.
pub(super) fn threads(text: &str) -> Result<u16, String> {
    count(text, 1..=1024)
}

fn count<N>(text: &str, range: RangeInclusive<N>) -> Result<N, String>
where
    N: FromStr + PartialOrd + Display,
{
    let count = text.parse().ok().filter(|count| range.contains(count));
    let (low, high) = (range.start(), range.end());
    count.ok_or_else(|| format!("allowed: whole numbers from {low} to {high}"))
}

/// A number of the command line within a range.
fn number(text: &str, range: RangeInclusive<f64>) -> Result<f64, String> {
    let value = text.parse().ok().filter(|value| range.contains(value));
    value.ok_or_else(|| format!("allowed: {} to {}", range.start(), range.end()))
}

pub(super) fn shear_floor(text: &str) -> Result<f64, String> {
    number(text, 1e-6..=1.0)
}

pub(super) fn criterion(text: &str) -> Result<f64, String> {
    number(text, 1e-8..=0.1)
}

pub(super) fn band_factor(text: &str) -> Result<f64, String> {
    number(text, 0.25..=2.0)
}

pub(super) fn crack_spacing(text: &str) -> Result<f64, String> {
    number(text, 10.0..=1000.0)
}

pub(super) fn fixing_share(text: &str) -> Result<f64, String> {
    number(text, 0.01..=1.0)
}

pub(super) fn factor(text: &str) -> Result<f64, String> {
    number(text, 0.25..=4.0)
}

pub(super) fn aggregate(text: &str) -> Result<f64, String> {
    number(text, 1.0..=100.0)
}

/// A deflection of the command line (mm).
pub(super) fn deflection(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| {
        let hint = if text.contains(',') {
            "; use a decimal point"
        } else {
            ""
        };
        format!("not a number{hint}; allowed: 0.1 to 500 mm")
    })?;
    crate::spec::Deflection::try_from(value).map(f64::from)
}
