//! Peak, drops and trust of a load path, from the history of its accepted steps.

/// One accepted step of a path, as far as capacity and trust are concerned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Deflection, or another measure that grows along the path.
    pub deflection: f64,
    /// Load.
    pub load: f64,
    /// Work-conjugate load, in the unit of `load`.
    pub work_conjugate_load: f64,
    /// Relative residual.
    pub residual: f64,
    /// Accepted without meeting the criterion.
    pub flagged: bool,
}

/// Fall from the running maximum after which the path before it holds the capacity.
pub const CAPACITY_FALL: f64 = 0.20;
/// Fall after a local maximum that makes it a drop.
pub const DROP_FALL: f64 = 0.05;

/// What a path says about capacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capacity {
    /// Index of the largest load before the first fall of [`CAPACITY_FALL`], or of the whole path.
    pub peak: usize,
    /// Whether such a fall was seen.
    pub fell: bool,
    /// Index of the first local maximum followed by a fall of [`DROP_FALL`].
    pub first_drop: Option<usize>,
    /// Largest fall after the peak, relative to it, within the path.
    pub post_peak_drop: f64,
}

impl Capacity {
    /// Reads a path; `None` for an empty one.
    pub fn of(path: &[PathPoint]) -> Option<Self> {
        let mut best = 0;
        let mut fell = false;
        let mut first_drop = None;
        for (i, point) in path.iter().enumerate() {
            if point.load > path[best].load {
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
        let lowest = path[best..]
            .iter()
            .map(|p| p.load)
            .fold(peak.load, f64::min);
        Some(Self {
            peak: best,
            fell,
            first_drop,
            post_peak_drop: relative_fall(peak.load, lowest),
        })
    }
}

fn relative_fall(from: f64, to: f64) -> f64 {
    if from > 0.0 { (from - to) / from } else { 0.0 }
}

/// How far a computed peak can be relied on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trust {
    /// Equilibrium holds at every step up to the peak.
    High,
    /// Some steps up to the peak miss the criterion, within bounds.
    Limited,
    /// The peak is not an equilibrium load.
    Low,
}

impl std::fmt::Display for Trust {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::High => "high",
            Self::Limited => "limited",
            Self::Low => "low",
        })
    }
}

/// Share of flagged steps up to the peak beyond which no peak is trusted.
pub const MAX_FLAGGED_SHARE: f64 = 0.10;
/// Residual of a flagged step beyond which no peak is trusted.
pub const MAX_FLAGGED_RESIDUAL: f64 = 0.03;
/// Relative gap between work-conjugate load and load beyond which no peak is trusted.
pub const MAX_LOAD_GAP: f64 = 0.03;

/// Verdict on the peak of a path, with its evidence.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// How far.
    pub trust: Trust,
    /// Why, in one sentence.
    pub reason: String,
    /// P* - P at the last step up to the peak that met the criterion.
    pub gap: f64,
    /// Flagged steps up to the peak.
    pub flagged: usize,
    /// Largest residual up to the peak.
    pub max_residual: f64,
}

impl Verdict {
    /// Judges the path up to `peak`.
    ///
    /// No trust when more than 10 % of the steps up to the peak are flagged, a flagged residual exceeds
    /// 0.03, or P* differs from P by more than 3 % at the last step before the peak that met the
    /// criterion; limited trust when any step is flagged.
    pub fn of(path: &[PathPoint], peak: usize) -> Self {
        let before = &path[..=peak];
        let flagged = before.iter().filter(|p| p.flagged).count();
        let max_residual = before.iter().map(|p| p.residual).fold(0.0, f64::max);
        let worst = before
            .iter()
            .filter(|p| p.flagged)
            .map(|p| p.residual)
            .fold(0.0, f64::max);
        let last = before.iter().rev().find(|p| !p.flagged);
        let gap = last.map_or(f64::NAN, |p| p.work_conjugate_load - p.load);
        let relative = last.map_or(f64::INFINITY, |p| (gap / p.load).abs());
        let share = flagged as f64 / before.len() as f64;
        let (trust, reason) = if share > MAX_FLAGGED_SHARE {
            (
                Trust::Low,
                format!(
                    "{flagged} of {} steps up to the peak miss the criterion",
                    before.len()
                ),
            )
        } else if worst > MAX_FLAGGED_RESIDUAL {
            (
                Trust::Low,
                format!("a step before the peak has a relative residual of {worst:.1e}"),
            )
        } else if relative > MAX_LOAD_GAP {
            (
                Trust::Low,
                format!(
                    "work-conjugate load and load differ by {:.1} % at the peak",
                    100.0 * relative
                ),
            )
        } else if flagged > 0 {
            (
                Trust::Limited,
                format!(
                    "{flagged} of {} steps up to the peak miss the criterion, residual at most {worst:.1e}",
                    before.len()
                ),
            )
        } else {
            (
                Trust::High,
                format!(
                    "every step up to the peak meets the criterion; work-conjugate load within {:.1} %",
                    100.0 * relative
                ),
            )
        };
        Self {
            trust,
            reason,
            gap,
            flagged,
            max_residual,
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the reading of a path: arching after a diagonal crack must not hide the first drop.
    use super::*;

    fn path(loads: &[f64]) -> Vec<PathPoint> {
        let point = |(i, &load): (usize, &f64)| PathPoint {
            deflection: i as f64,
            load,
            work_conjugate_load: load * 1.001,
            residual: 5e-4,
            flagged: false,
        };
        loads.iter().enumerate().map(point).collect()
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
    fn trust_falls_with_flagged_steps_and_with_the_load_gap() {
        let mut p = path(&[1.0; 30]);
        assert_eq!(Verdict::of(&p, 29).trust, Trust::High);
        p[3].flagged = true;
        assert_eq!(Verdict::of(&p, 29).trust, Trust::Limited);
        p[3].residual = 0.05;
        assert_eq!(Verdict::of(&p, 29).trust, Trust::Low);
        let mut gap = path(&[1.0; 30]);
        gap[29].work_conjugate_load = 1.05;
        assert_eq!(Verdict::of(&gap, 29).trust, Trust::Low);
    }
}
