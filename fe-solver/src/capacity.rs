//! Peak, drops and trust of a load path, from the history of its accepted steps.

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

/// Why a path whose steps all meet the criterion may not be the only one: jumps and unstable equilibria among its points
/// up to the peak, or no fall behind it.
fn branches(
    path: &[PathPoint],
    capacity: &Capacity,
    (before, jumps): (&[PathPoint], usize),
) -> Option<String> {
    let steps = before.len();
    let count = before.iter().filter(|p| p.unstable).count();
    let first = before.iter().find(|p| p.unstable).map(|first| {
        let share = 100.0 * first.load / before[steps - 1].load;
        format!("unstable equilibria, the first at {share:.0} % of the peak; other branches exist")
    });
    match (jumps, first) {
        (0, Some(first)) => Some(format!(
            "{count} of {steps} steps up to the peak are {first}"
        )),
        (_, Some(first)) => Some(format!(
            "{jumps} of {steps} steps up to the peak are jumps and {count} are {first}"
        )),
        (0, None) if capacity.is_reached() => None,
        (0, None) if capacity.peak + 1 == path.len() => {
            Some("the load is largest at the end of the path, a lower bound of the peak".into())
        }
        (0, None) => Some(format!(
            "the load falls by {:.1} % only behind its peak, which may be a lower bound",
            100.0 * capacity.post_peak_drop
        )),
        (_, None) => Some(format!(
            "{jumps} of {steps} steps up to the peak are jumps, beyond which other branches may exist"
        )),
    }
}

/// Largest share of kinetic energy and largest residual from [`APPROACH`] of the last load of a path on, once the start
/// has died away; none if it is no motion.
fn moving(path: &[PathPoint]) -> Option<(f64, f64)> {
    let near = APPROACH * path.last()?.load;
    let from = path.iter().position(|p| p.load >= near)?;
    let near = &path[from..];
    let kinetic = near.iter().filter_map(|p| p.kinetic).reduce(f64::max)?;
    let residual = near.iter().map(|p| p.residual).fold(0.0, f64::max);
    Some((kinetic, residual))
}

fn relative_fall(from: f64, to: f64) -> f64 {
    if from > 0.0 { (from - to) / from } else { 0.0 }
}

/// How far a computed peak can be relied on, from the best to the worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
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

/// Largest principal tension of cracked concrete up to the peak, over the tensile strength, beyond which the peak is trusted
/// within limits only: its cracks lock.
pub const LOCKING: f64 = 1.2;

/// Change of the peak under a refinement beyond which it is trusted within limits only.
pub const MAX_CHANGE: f64 = 0.03;
/// The same beyond which it is not trusted.
pub const MAX_CHANGE_LIMITED: f64 = 0.10;

/// Kinetic energy over the work done beyond which the peak of a motion is not trusted (prototype runs: the peak no
/// longer depends on the rate from 1e-3 down).
pub const MAX_KINETIC: f64 = 1e-3;

/// Viscous work over the work done beyond which a peak is not trusted (STAB-25 of the stability catalogue).
pub const MAX_VISCOUS: f64 = 0.02;

/// Residual of a step that is not flagged beyond which a peak is trusted within limits only: drivers that do not
/// iterate leave any.
pub const MAX_UNBALANCED: f64 = 0.01;

/// Share of the peak from which on a motion is judged.
pub const APPROACH: f64 = 0.8;

/// Verdict on the peak of a path, with its evidence.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// How far.
    pub trust: Trust,
    /// Why, in one sentence.
    pub reason: String,
    /// P* - P at the last step up to the peak that met the criterion without a jump; `None` without
    /// such a step.
    pub gap: Option<f64>,
    /// Flagged steps up to the peak.
    pub flagged: usize,
    /// Jumps up to the peak.
    pub jumps: usize,
    /// Largest residual up to the peak.
    pub max_residual: f64,
}

impl Verdict {
    /// Judges the path up to the peak of `capacity`; of the whole path if it has no such point.
    ///
    /// No trust when more than 10 % of the steps up to the peak are flagged, a flagged residual exceeds
    /// 0.03, or P* differs from P by more than 3 % at the last step up to the peak that met the
    /// criterion. That step is no jump: across a jump P* is the work of forces no static state
    /// balances, not an error of the load. Limited trust when a step is flagged, when the path jumps
    /// or passes unstable equilibria before the peak (other equilibrium branches exist then, and which one
    /// the path takes depends on the steps), or when the peak is not [reached](Capacity::is_reached). A motion is trusted
    /// within limits as long as its kinetic energy stays below [`MAX_KINETIC`] from [`APPROACH`] of the peak on, else
    /// not; laws that lag behind as long as viscosity has taken no more than [`MAX_VISCOUS`] of the work; steps without
    /// iteration by their unbalanced force.
    pub fn of(path: &[PathPoint], capacity: &Capacity) -> Self {
        let before = path.get(..=capacity.peak).unwrap_or(path);
        let steps = before.len();
        let worst = |points: &mut dyn Iterator<Item = &PathPoint>| {
            points.map(|p| p.residual).fold(0.0, f64::max)
        };
        let flagged = before.iter().filter(|p| p.flagged).count();
        let jumps = (0..steps).filter(|&i| is_jump(path, i)).count();
        let worst_flagged = worst(&mut before.iter().filter(|p| p.flagged));
        let loaded = |p: &&PathPoint| !p.flagged && p.load > 0.0;
        let unbalanced = worst(&mut before.iter().filter(loaded));
        let regular = |&i: &usize| !path[i].flagged && !is_jump(path, i);
        let last = (0..steps).rev().find(regular).map(|i| path[i]);
        let gap = last.map(|p| p.work_conjugate_load - p.load);
        let relative = last.map_or(f64::NAN, |p| {
            ((p.work_conjugate_load - p.load) / p.load).abs()
        });
        let (trust, reason) = if flagged as f64 > MAX_FLAGGED_SHARE * steps as f64 {
            let reason = format!("{flagged} of {steps} steps up to the peak miss the criterion");
            (Trust::Low, reason)
        } else if worst_flagged > MAX_FLAGGED_RESIDUAL {
            let reason =
                format!("a step before the peak has a relative residual of {worst_flagged:.1e}");
            (Trust::Low, reason)
        } else if relative > MAX_LOAD_GAP {
            let reason = format!(
                "work-conjugate load and load differ by {:.1} % at the peak",
                100.0 * relative
            );
            (Trust::Low, reason)
        } else if relative.is_nan() {
            let reason = "no loaded step up to the peak meets the criterion".to_owned();
            (Trust::Low, reason)
        } else if let Some((kinetic, unbalanced)) = moving(before) {
            let trust = if kinetic > MAX_KINETIC {
                Trust::Low
            } else {
                Trust::Limited
            };
            let reason = format!(
                "a motion, no equilibria: from {APPROACH} of the peak on the kinetic energy is at most {kinetic:.1e} of \
                 the work, the unbalanced force at most {unbalanced:.1e} of the reactions"
            );
            (trust, reason)
        } else if let Some(viscous) = before.last().and_then(|p| p.viscous) {
            let trust = if viscous > MAX_VISCOUS || unbalanced > MAX_FLAGGED_RESIDUAL {
                Trust::Low
            } else {
                Trust::Limited
            };
            let reason = format!(
                "laws lag behind: up to the peak viscosity has taken {:.1} % of the work, the unbalanced force without \
                 it is at most {unbalanced:.1e} of the reactions",
                100.0 * viscous
            );
            (trust, reason)
        } else if unbalanced > MAX_UNBALANCED {
            let trust = if unbalanced > MAX_FLAGGED_RESIDUAL {
                Trust::Low
            } else {
                Trust::Limited
            };
            let reason = format!(
                "steps up to the peak are no equilibria: the unbalanced force is up to {unbalanced:.1e} of the reactions"
            );
            (trust, reason)
        } else if flagged > 0 {
            let reason = format!(
                "{flagged} of {steps} steps up to the peak miss the criterion, residual at most \
                 {worst_flagged:.1e}"
            );
            (Trust::Limited, reason)
        } else if let Some(reason) = branches(path, capacity, (before, jumps)) {
            (Trust::Limited, reason)
        } else {
            let reason = format!(
                "every step up to the peak meets the criterion; work-conjugate load within {:.2} %",
                100.0 * relative
            );
            (Trust::High, reason)
        };
        Self {
            trust,
            reason,
            gap,
            flagged,
            jumps,
            max_residual: worst(&mut before.iter()),
        }
    }

    /// Lowers the trust by the relative `change` of the peak under a `refinement`, "half the steps" say: limited beyond 3 %,
    /// low beyond 10 %, or where there is no such peak. The reason is added to.
    pub fn limit_by_change(&mut self, refinement: &str, change: f64) {
        let size = change.abs();
        let trust = if size <= MAX_CHANGE {
            Trust::High
        } else if size <= MAX_CHANGE_LIMITED {
            Trust::Limited
        } else {
            Trust::Low
        };
        let reason = format!("{refinement}: {:+.1} % of the peak", 100.0 * change);
        self.lower(trust, &reason);
    }

    /// Takes the trust away, for a reason that is added to the others: something that the model does not have has happened.
    pub fn distrust(&mut self, reason: &str) {
        self.lower(Trust::Low, reason);
    }

    /// Lowers the trust to limited where cracked concrete has carried more than [`LOCKING`] times its tensile strength,
    /// `ratio` times, on the way to the peak. The reason is added to.
    pub fn limit_by_locking(&mut self, ratio: f64) {
        if ratio > LOCKING {
            self.limit(&format!(
                "cracked concrete carries up to {ratio:.2} times its tensile strength: cracks lock"
            ));
        }
    }

    /// Lowers the trust to limited for a reason that the path does not tell, which is added.
    pub fn limit(&mut self, reason: &str) {
        self.lower(Trust::Limited, reason);
    }

    /// Lowers the trust to `at_most`, if it is better, and adds the reason.
    fn lower(&mut self, at_most: Trust, reason: &str) {
        self.trust = self.trust.max(at_most);
        self.reason.push_str("; ");
        self.reason.push_str(reason);
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

    /// A path of 30 steps whose peak is the last but one.
    fn peaked() -> Vec<PathPoint> {
        let mut loads = [1.0; 30];
        loads[28] = 2.0;
        path(&loads)
    }

    fn trust(path: &[PathPoint]) -> Trust {
        Verdict::of(path, &Capacity::of(path).unwrap()).trust
    }

    #[test]
    fn trust_falls_with_flagged_steps_and_with_the_load_gap() {
        let mut p = peaked();
        assert_eq!(trust(&p), Trust::High);
        p[3].flagged = true;
        assert_eq!(trust(&p), Trust::Limited);
        p[3].residual = 0.05;
        assert_eq!(trust(&p), Trust::Low);
        let mut many = peaked();
        for point in &mut many[..3] {
            point.flagged = true;
        }
        assert_eq!(trust(&many), Trust::Low);
        let mut unstable = peaked();
        unstable[2].unstable = true;
        assert_eq!(trust(&unstable), Trust::Limited);
        let mut gap = peaked();
        gap[28].work_conjugate_load = 2.1;
        assert_eq!(trust(&gap), Trust::Low);
    }

    #[test]
    fn a_jump_limits_trust_and_its_work_is_no_load_gap() {
        let mut p = peaked();
        p[27].load = 0.9;
        p[27].held = true;
        p[27].work_conjugate_load = -1400.0;
        assert_eq!(trust(&p), Trust::Limited);
        p[2].unstable = true;
        let reason = Verdict::of(&p, &Capacity::of(&p).unwrap()).reason;
        assert!(reason.contains("are jumps and 1 are unstable"), "{reason}");
        p[2].unstable = false;
        p[28].flagged = true;
        let verdict = Verdict::of(&p, &Capacity::of(&p).unwrap());
        assert_eq!((verdict.trust, verdict.jumps), (Trust::Limited, 1));
        assert!(verdict.gap.is_some_and(|gap| (gap - 0.001).abs() < 1e-12));
    }

    #[test]
    fn trust_falls_with_the_change_of_the_peak_under_half_the_steps() {
        for (change, expected) in [
            (-0.03, Trust::High),
            (0.05, Trust::Limited),
            (-0.2, Trust::Low),
            (f64::NAN, Trust::Low),
        ] {
            let path = peaked();
            let mut verdict = Verdict::of(&path, &Capacity::of(&path).unwrap());
            verdict.limit_by_change("half the steps", change);
            assert_eq!(verdict.trust, expected, "{change}");
            assert!(verdict.reason.contains("half the steps"));
        }
        let mut jumps = peaked();
        jumps[27].held = true;
        jumps[27].load = 0.9;
        let mut verdict = Verdict::of(&jumps, &Capacity::of(&jumps).unwrap());
        verdict.limit_by_change("half the steps", 0.0);
        assert_eq!(verdict.trust, Trust::Limited);
    }

    #[test]
    fn stress_locking_limits_trust() {
        for (ratio, expected) in [(1.0, Trust::High), (1.46, Trust::Limited)] {
            let path = peaked();
            let mut verdict = Verdict::of(&path, &Capacity::of(&path).unwrap());
            verdict.limit_by_locking(ratio);
            assert_eq!(verdict.trust, expected, "{ratio}");
            assert_eq!(verdict.reason.contains("1.46"), ratio > LOCKING);
        }
    }

    #[test]
    fn a_path_without_a_peak_earns_no_high_trust() {
        assert_eq!(trust(&path(&[0.0, 1.0, 2.0])), Trust::Limited);
        assert_eq!(trust(&path(&[0.0])), Trust::Low);
    }

    #[test]
    fn a_motion_is_trusted_within_limits_while_it_is_slow() {
        for (share, trust) in [(5e-4, Trust::Limited), (5e-3, Trust::Low)] {
            let mut path = path(&[10.0, 50.0, 85.0, 100.0, 70.0]);
            for (point, kinetic) in path.iter_mut().zip([0.1, 0.01, share, 1e-4, 0.05]) {
                point.kinetic = Some(kinetic);
            }
            let capacity = Capacity::of(&path).unwrap();
            let verdict = Verdict::of(&path, &capacity);
            assert_eq!(verdict.trust, trust, "{}", verdict.reason);
        }
    }
}
