//! How far the peak of a path can be relied on, and why.

use super::{Capacity, PathPoint, is_jump};

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
    /// What is no number counts as the worst: no trust where a load is none, or up to the peak another quantity.
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
        let worst =
            |points: &mut dyn Iterator<Item = &PathPoint>| largest(points.map(|p| p.residual));
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
        let (trust, reason) = if let Some(step) = path.iter().position(|p| p.load.is_nan()) {
            let reason = format!("the load of step {step}, counted from 0, is not a number");
            (Trust::Low, reason)
        } else if flagged as f64 > MAX_FLAGGED_SHARE * steps as f64 {
            let reason = format!("{flagged} of {steps} steps up to the peak miss the criterion");
            (Trust::Low, reason)
        } else if beyond(worst_flagged, MAX_FLAGGED_RESIDUAL) {
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
            let trust = if beyond(kinetic, MAX_KINETIC) || unbalanced.is_nan() {
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
            let trust = if beyond(viscous, MAX_VISCOUS) || beyond(unbalanced, MAX_FLAGGED_RESIDUAL)
            {
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
        } else if beyond(unbalanced, MAX_UNBALANCED) {
            let trust = if beyond(unbalanced, MAX_FLAGGED_RESIDUAL) {
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
        if beyond(ratio, LOCKING) {
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
    near.iter().find(|p| p.kinetic.is_some())?;
    let kinetic = largest(near.iter().filter_map(|p| p.kinetic));
    Some((kinetic, largest(near.iter().map(|p| p.residual))))
}

/// Whether a value exceeds a limit, as one that is no number does.
fn beyond(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}

/// Largest of values that are not negative; NaN if one of them is.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |a, b| if beyond(b, a) && !a.is_nan() { b } else { a })
}

#[cfg(test)]
mod tests {
    //! Protects what lowers trust in a peak, and by how much.
    use super::super::tests::path;
    use super::*;

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
    fn what_is_no_number_is_not_trusted() {
        type Spoil = fn(&mut PathPoint);
        let spoils: [(usize, Spoil); 6] = [
            (3, |p| p.residual = f64::NAN),
            (3, |p| (p.residual, p.flagged) = (f64::NAN, true)),
            (3, |p| p.load = f64::NAN),
            (0, |p| p.load = f64::NAN),
            (29, |p| p.load = f64::NAN),
            (28, |p| p.work_conjugate_load = f64::NAN),
        ];
        for (at, spoil) in spoils {
            let mut path = peaked();
            spoil(&mut path[at]);
            assert_eq!(Capacity::of(&path).unwrap().peak, 28);
            assert_eq!(trust(&path), Trust::Low, "{:?}", path[at]);
        }
        let lags: [fn(&mut PathPoint); 2] = [
            |p| p.kinetic = Some(f64::NAN),
            |p| p.viscous = Some(f64::NAN),
        ];
        for spoil in lags {
            let mut path = peaked();
            spoil(&mut path[28]);
            assert_eq!(trust(&path), Trust::Low, "{:?}", path[28]);
        }
        let mut verdict = Verdict::of(&peaked(), &Capacity::of(&peaked()).unwrap());
        verdict.limit_by_locking(f64::NAN);
        assert_eq!(verdict.trust, Trust::Limited);
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
