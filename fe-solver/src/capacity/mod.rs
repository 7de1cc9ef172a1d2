//! Peak, drops and trust of a load path, from the history of its accepted steps.

mod verdict;

pub use verdict::{
    APPROACH, LOCKING, MAX_CHANGE, MAX_CHANGE_LIMITED, MAX_FLAGGED_RESIDUAL, MAX_FLAGGED_SHARE,
    MAX_KINETIC, MAX_LOAD_GAP, MAX_UNBALANCED, MAX_VISCOUS, Trust, Verdict,
};

/// One accepted step of a path, as far as capacity and trust are concerned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Deflection, or another measure that grows along the path.
    pub deflection: f64,
    /// Load, positive the way it grows.
    pub load: f64,
    /// Work-conjugate load, in the unit of `load`.
    pub work_conjugate_load: f64,
    /// Relative residual.
    pub residual: f64,
    /// Accepted without meeting the criterion.
    pub flagged: bool,
    /// Reached by solves at a held load factor.
    pub held: bool,
    /// Equilibrium, but not a stable one: the tangent has negative pivots.
    pub unstable: bool,
    /// Largest kinetic energy over the work so far, where the path is a motion and no chain of equilibria.
    pub kinetic: Option<f64>,
    /// Viscous work over the work so far, where laws lag behind.
    pub viscous: Option<f64>,
}

/// Fall from the running maximum after which the path before it holds the capacity.
pub const CAPACITY_FALL: f64 = 0.20;
/// Fall after a local maximum that makes it a drop.
pub const DROP_FALL: f64 = 0.05;

/// A path that stays above that fall up to this multiple of the deflection at its peak is a plateau.
pub const PLATEAU_REACH: f64 = 1.5;

/// Fall within one step at a held load factor that makes it a jump.
pub const JUMP_FALL: f64 = 0.01;

/// Whether the step to point `i` of a path is a jump: it lost [`JUMP_FALL`] of the load while the load
/// factor was held. No static equilibrium exists along it.
pub fn is_jump(path: &[PathPoint], i: usize) -> bool {
    let before = i.checked_sub(1).and_then(|i| path.get(i));
    let (Some(before), Some(now)) = (before, path.get(i)) else {
        return false;
    };
    now.held && relative_fall(before.load, now.load) >= JUMP_FALL
}

/// What a path says about capacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capacity {
    /// Index of the largest load before the first fall of [`CAPACITY_FALL`], or of the whole path.
    pub peak: usize,
    /// Whether such a fall was seen.
    pub fell: bool,
    /// Index of the first local maximum followed by a fall of [`DROP_FALL`].
    pub first_drop: Option<usize>,
    /// Largest fall after the peak, relative to it, before the load exceeds the peak again.
    pub post_peak_drop: f64,
    /// Whether a single jump of that part of the path falls by [`DROP_FALL`] of the peak: the drop is
    /// vertical, no static equilibrium exists along it.
    pub vertical_drop: bool,
    /// Whether the load stays within [`DROP_FALL`] of the peak up to [`PLATEAU_REACH`] times the deflection there.
    pub plateau: bool,
}

impl Capacity {
    /// Reads a path; `None` for an empty one. A load that is no number is passed over; the [`Verdict`] trusts no such path.
    pub fn of(path: &[PathPoint]) -> Option<Self> {
        let mut best = 0;
        let mut fell = false;
        let mut first_drop = None;
        for (i, point) in path.iter().enumerate() {
            if point.load > path[best].load || path[best].load.is_nan() {
                best = i;
            }
            let fall = relative_fall(path[best].load, point.load);
            if first_drop.is_none() && fall >= DROP_FALL {
                first_drop = Some(best);
            }
            if fall >= CAPACITY_FALL {
                fell = true;
                break;
            }
        }
        let peak = path.get(best)?;
        let beyond = path[best..].iter().position(|p| p.load > peak.load);
        let after = &path[best..beyond.map_or(path.len(), |n| best + n)];
        let lowest = after.iter().map(|p| p.load).fold(peak.load, f64::min);
        let post_peak_drop = relative_fall(peak.load, lowest);
        // The point may move up.
        let reached = after.last().map_or(0.0, |p| p.deflection.abs());
        let at_peak = peak.deflection.abs();
        Some(Self {
            peak: best,
            fell,
            first_drop,
            post_peak_drop,
            plateau: post_peak_drop < DROP_FALL && reached > PLATEAU_REACH * at_peak,
            vertical_drop: after.windows(2).any(|pair| {
                is_jump(pair, 1) && pair[0].load - pair[1].load >= DROP_FALL * peak.load
            }),
        })
    }

    /// The same of a path with so many points more before its first.
    #[must_use]
    pub fn behind(self, points: usize) -> Self {
        Self {
            peak: self.peak + points,
            first_drop: self.first_drop.map(|i| i + points),
            ..self
        }
    }

    /// Whether the load went down behind the peak, by [`DROP_FALL`] at least, or stayed there on a plateau. Otherwise the path
    /// ends while the load may rise, and its largest load is a lower bound of the capacity.
    pub fn is_reached(&self) -> bool {
        self.post_peak_drop >= DROP_FALL || self.plateau
    }
}

fn relative_fall(from: f64, to: f64) -> f64 {
    if from > 0.0 { (from - to) / from } else { 0.0 }
}
#[cfg(test)]
mod tests {
    //! Protects the reading of a path: arching after a diagonal crack must not hide the first drop.
    use super::*;

    pub(super) fn path(loads: &[f64]) -> Vec<PathPoint> {
        let point = |(i, &load): (usize, &f64)| PathPoint {
            deflection: i as f64,
            load,
            work_conjugate_load: load * 1.001,
            residual: 5e-4,
            flagged: false,
            held: false,
            unstable: false,
            kinetic: None,
            viscous: None,
        };
        loads.iter().enumerate().map(point).collect()
    }

    #[test]
    fn a_point_that_moves_up_is_read_as_one_that_moves_down() {
        let mut up = path(&[0.0, 1.0, 2.0, 1.99, 1.98, 1.97]);
        for steps in 2..=up.len() {
            let down = Capacity::of(&up[..steps]);
            for point in &mut up {
                point.deflection *= -1.0;
            }
            assert_eq!(Capacity::of(&up[..steps]), down);
            assert_eq!(down.unwrap().plateau, steps > 4);
        }
    }

    #[test]
    fn capacity_is_the_largest_load_before_a_fall_of_a_fifth() {
        let c = Capacity::of(&path(&[0.0, 50.0, 100.0, 94.0, 110.0, 120.0, 95.0, 200.0])).unwrap();
        assert_eq!((c.peak, c.first_drop, c.fell), (5, Some(2), true));
        let rising = Capacity::of(&path(&[0.0, 1.0, 2.0])).unwrap();
        assert_eq!(
            (rising.peak, rising.first_drop, rising.fell),
            (2, None, false)
        );
        assert!(Capacity::of(&[]).is_none());
    }

    #[test]
    fn the_drop_after_the_peak_ends_where_the_load_exceeds_it_again() {
        let c = Capacity::of(&path(&[0.0, 100.0, 79.0, 150.0, 10.0])).unwrap();
        assert_eq!((c.peak, c.fell), (1, true));
        assert!((c.post_peak_drop - 0.21).abs() < 1e-12);
    }

    #[test]
    fn a_plateau_stays_near_the_peak_beyond_one_and_a_half_of_its_deflection() {
        let plateau = |loads: &[f64]| Capacity::of(&path(loads)).unwrap().plateau;
        assert!(plateau(&[0.0, 50.0, 100.0, 99.0, 96.0]));
        assert!(!plateau(&[0.0, 50.0, 100.0, 99.0]), "not far enough");
        assert!(!plateau(&[0.0, 50.0, 100.0, 94.0, 99.0]), "fell between");
        assert!(!plateau(&[0.0, 50.0, 100.0, 99.0, 101.0]), "rises again");
    }

    #[test]
    fn a_drop_is_vertical_where_a_jump_takes_a_twentieth_of_the_peak() {
        let mut p = path(&[0.0, 100.0, 98.0, 60.0]);
        assert!(!Capacity::of(&p).unwrap().vertical_drop);
        p[2].held = true;
        assert!(!Capacity::of(&p).unwrap().vertical_drop);
        p[3].held = true;
        assert!(Capacity::of(&p).unwrap().vertical_drop);
    }

    #[test]
    fn a_step_held_without_losing_load_is_no_jump() {
        let mut p = path(&[0.0, 100.0, 99.5, 110.0, 60.0]);
        for point in &mut p {
            point.held = true;
        }
        let jumps: Vec<bool> = (0..6).map(|i| is_jump(&p, i)).collect();
        assert_eq!(jumps, [false, false, false, false, true, false]);
    }
}
