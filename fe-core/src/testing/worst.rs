//! The largest of many deviations.

use std::fmt::Debug;

use super::below;

/// Deviations that are to stay below one limit, and the largest of them.
#[derive(Debug)]
#[must_use = "it is to be told"]
pub struct Worst {
    what: String,
    limit: f64,
    found: f64,
}

impl Worst {
    /// Deviations of what is named, and their limit.
    pub fn new(what: &str, limit: f64) -> Self {
        Self {
            what: what.into(),
            limit,
            found: 0.0,
        }
    }

    /// Takes the size of a deviation at a place into account.
    ///
    /// # Panics
    ///
    /// If it exceeds the limit: for tests.
    #[track_caller]
    pub fn see(&mut self, deviation: f64, place: impl Debug) {
        let (what, limit) = (&self.what, self.limit);
        assert!(
            deviation.abs() <= limit,
            "{what}: {deviation:e} exceeds {limit:e} at {place:?}"
        );
        self.found = self.found.max(deviation.abs());
    }

    /// Tells the largest, as [`below`] does.
    #[track_caller]
    pub fn tell(self) {
        below(&self.what, self.found, self.limit);
    }
}

#[cfg(test)]
mod tests {
    //! Protects against deviations that are overlooked.
    use super::*;

    #[test]
    fn the_largest_is_kept() {
        let mut worst = Worst::new("miss", 0.5);
        for (i, deviation) in [0.1, -0.3, 0.2].into_iter().enumerate() {
            worst.see(deviation, i);
        }
        assert_eq!(worst.found, 0.3);
    }

    #[test]
    #[should_panic(expected = "miss: NaN exceeds 5e-1 at \"here\"")]
    fn a_place_is_named() {
        Worst::new("miss", 0.5).see(f64::NAN, "here");
    }
}
