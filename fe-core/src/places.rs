//! Places that are told apart by a tolerance, whichever way their coordinates are rounded.

use std::collections::HashMap;

/// Places (mm) within half of this along every axis are one; those farther apart than one and a half of it are two.
pub(crate) const MERGE: f64 = 1e-6;

/// Farther from the origin (mm) than this, places cannot be told apart by integers.
const FARTHEST: f64 = 9e12;

/// Numbers by place.
#[derive(Debug)]
pub(crate) struct Places<const N: usize>(HashMap<[i64; N], usize>);

impl<const N: usize> Default for Places<N> {
    fn default() -> Self {
        Self(HashMap::new())
    }
}

impl<const N: usize> Places<N> {
    /// Whether a place (mm) is near enough to be told from others.
    pub(crate) fn within(place: &[f64; N]) -> bool {
        place.iter().all(|c| c.abs() <= FARTHEST)
    }

    /// The number at a place (mm), `next` and kept from now on unless there is one.
    pub(crate) fn number(&mut self, place: [f64; N], next: usize) -> usize {
        // One next door may have been rounded either way, so both neighbours are asked.
        let scaled = place.map(|c| c / MERGE);
        for corner in 0..1 << N {
            let key = std::array::from_fn(|k| {
                let up = corner >> k & 1 == 1;
                (if up {
                    scaled[k].ceil()
                } else {
                    scaled[k].floor()
                }) as i64
            });
            if let Some(&number) = self.0.get(&key) {
                return number;
            }
        }
        self.0.insert(scaled.map(|c| c.round() as i64), next);
        next
    }
}
