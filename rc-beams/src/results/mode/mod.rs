//! Mode of failure, by the same rules for every beam.
//!
//! The evidence is what changes between the peak and the end of the drop after it, together with the
//! state at the peak. Measures:
//!
//! - *growth of cracks* (mm3): sum of volume times increase of crack strain over the drop. A crack is
//!   diagonal if its normal is inclined by 25 to 70 degrees to the beam axis, vertical below that; steeper
//!   normals belong to cracks along the bars, which accompany any mode and are not counted. The *diagonal
//!   share* is that of the diagonal cracks in shear spans in the sum of these and of the vertical cracks
//!   between the spans. Vertical cracks in a shear span count only if bars yield: along elastic bars they
//!   open as the lower part of an inclined crack;
//! - *yield*: a longitudinal bar reaches its yield stress by the peak. It brings no load down by itself: where the
//!   diagonal share is at least 0.6 it does not count. Plain concrete, which has no bars, bends as if they had yielded;
//! - *softened web*: share of the middle half of the height, in one shear span, whose concrete is past its
//!   compressive strength at the peak;
//! - *growth of crushing*: sum of volume times increase of crushing over the drop, as a share of the volume.
//!
//! | load falls | yield | softened web | diagonal share | growth of crushing | mode |
//! |---|---|---|---|---|---|
//! | below 5 %, a plateau | yes | below 10 % | at most 0.4 | | flexure |
//! | below 5 %, a plateau | | otherwise | | | undecided |
//! | below 5 % | | | | | none |
//! | | yes | below 10 % | at most 0.4 | | flexure |
//! | | no | at least 10 % | | | shear (web crushing) |
//! | | | below 10 % | at least 0.6 | | shear (diagonal tension) |
//! | | no | below 10 % | at most 0.4 | at least 0.1 % | concrete crushing |
//! | | | otherwise | | | undecided |
//!
//! A plateau reaches 1.5 times the deflection at the peak. The thresholds are assumed: they separate clear cases and
//! leave the others undecided.
//!
//! Where the span that fails carries sheets, the rules of [`strengthened`] follow.

pub mod strengthened;

use std::fmt;

use fe_solver::capacity::{Capacity, DROP_FALL};
use serde::{Serialize, Serializer};

use super::evidence::{BarReach, Layout, Snapshot};

/// Angles between crack normal and beam axis that make a crack diagonal (degrees).
const DIAGONAL_DEG: std::ops::RangeInclusive<f64> = 25.0..=70.0;
/// Diagonal share from which diagonal cracks govern.
const DIAGONAL_GOVERNS: f64 = 0.6;
/// Diagonal share up to which they do not.
const DIAGONAL_MINOR: f64 = 0.4;
/// Share of the web past its compressive strength from which it governs.
const SOFTENED_WEB: f64 = 0.10;
/// Growth of crushing, as a share of the concrete, from which it is a mode.
const CRUSHING_GROWTH: f64 = 1e-3;

/// How a beam fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FailureMode {
    /// Diagonal cracks of a shear span open.
    DiagonalTension,
    /// The web of a shear span crushes.
    WebCrushing,
    /// Longitudinal bars yield, or there are none.
    Flexure,
    /// Concrete crushes outside the web, bars elastic.
    ConcreteCrushing,
    /// The concrete fails behind sheets that stay bonded.
    ConcreteSplitting,
    /// The sheets lose their bond.
    Debonding,
    /// A sheet ruptures.
    SheetRupture,
    /// Bond, concrete or steel fail together, none of them clearly first.
    Mixed,
    /// The load does not fall.
    None,
    /// The evidence conflicts or does not suffice.
    Undecided,
}

impl fmt::Display for FailureMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::DiagonalTension => "shear (diagonal tension)",
            Self::WebCrushing => "shear (web crushing)",
            Self::Flexure => "flexure",
            Self::ConcreteCrushing => "concrete crushing",
            Self::ConcreteSplitting => "concrete splitting",
            Self::Debonding => "debonding",
            Self::SheetRupture => "sheet rupture",
            Self::Mixed => "mixed",
            Self::None => "none (no failure reached)",
            Self::Undecided => "undecided",
        })
    }
}

impl Serialize for FailureMode {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Mode with its evidence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Diagnosis {
    /// How the beam fails.
    pub mode: FailureMode,
    /// Why, in one line, with numbers.
    pub mode_evidence: String,
    /// Peak with perfect bond over that of the beam, where the run with perfect bond was made.
    pub counterfactual_ratio: Option<f64>,
}

impl Diagnosis {
    /// Judges a beam by its states at the peak and at the end of the drop after it.
    pub fn of(layout: &Layout, peak: &Snapshot, end: &Snapshot, capacity: &Capacity) -> Self {
        let measures = Measures::of(layout, peak, end);
        let held = measures.mode_without_drop(capacity);
        Self {
            mode: held.unwrap_or_else(|| measures.mode()),
            mode_evidence: evidence(capacity, &measures, (end, layout)),
            counterfactual_ratio: None,
        }
    }
}

/// One line that says why, around what was found.
fn evidence(
    capacity: &Capacity,
    found: &dyn fmt::Display,
    (end, layout): (&Snapshot, &Layout),
) -> String {
    format!(
        "load falls by {:.1} %; {found}; {} of {} stirrups yield",
        100.0 * capacity.post_peak_drop,
        end.stirrups.iter().filter(|s| s.utilisation >= 1.0).count(),
        layout.stirrups
    )
}

/// The measures of the module, each with where it is largest.
#[derive(Debug, Clone, Default)]
struct Measures {
    diagonal_share: f64,
    diagonal_span: String,
    /// Index of that span; none where no diagonal crack grows.
    span: Option<usize>,
    bar: Option<BarReach>,
    yielded: bool,
    softened_web: f64,
    crushing_growth: f64,
}

impl Measures {
    fn of(layout: &Layout, peak: &Snapshot, end: &Snapshot) -> Self {
        let spans = layout.shear_spans.len();
        let bars = peak.bars.iter();
        let bar = bars.max_by(|a, b| a.utilisation.total_cmp(&b.utilisation));
        let yielded = bar.is_none_or(|bar| bar.utilisation >= 1.0);
        let mut diagonal = vec![0.0; spans];
        let mut vertical = 0.0;
        let mut web = vec![[0.0; 2]; spans];
        let (mut crushing, mut volume) = (0.0, 0.0);
        for (before, after) in peak.concrete.iter().zip(&end.concrete) {
            let span = layout.span_at(before.position[0]);
            let growth = before.volume * (after.crack_strain - before.crack_strain).max(0.0);
            let angle = after.inclination_deg();
            match span {
                Some(i) if DIAGONAL_DEG.contains(&angle) => diagonal[i] += growth,
                _ if angle < *DIAGONAL_DEG.start() && (span.is_none() || yielded) => {
                    vertical += growth;
                }
                _ => {}
            }
            let height = before.position[1] / layout.height_mm;
            if let Some(i) = span.filter(|_| (0.25..=0.75).contains(&height)) {
                web[i][0] += if before.crushing > 0.0 {
                    before.volume
                } else {
                    0.0
                };
                web[i][1] += before.volume;
            }
            crushing += before.volume * (after.crushing - before.crushing).max(0.0);
            volume += before.volume;
        }
        let total: f64 = diagonal.iter().sum();
        let worst = (0..spans).max_by(|&a, &b| diagonal[a].total_cmp(&diagonal[b]));
        Self {
            diagonal_share: share(total, total + vertical),
            span: worst.filter(|_| total > 0.0),
            diagonal_span: worst.map_or_else(String::new, |i| layout.shear_spans[i].name.clone()),
            yielded,
            bar: bar.cloned(),
            softened_web: web.iter().map(|w| share(w[0], w[1])).fold(0.0, f64::max),
            crushing_growth: share(crushing, volume),
        }
    }

    /// Mode where the load does not fall by [`DROP_FALL`]; none where it does.
    fn mode_without_drop(&self, capacity: &Capacity) -> Option<FailureMode> {
        (capacity.post_peak_drop < DROP_FALL).then(|| match self.mode() {
            _ if !capacity.plateau => FailureMode::None,
            FailureMode::Flexure => FailureMode::Flexure,
            _ => FailureMode::Undecided,
        })
    }

    /// Whether bars yield and diagonal cracks do not govern.
    fn bends(&self) -> bool {
        self.yielded && self.diagonal_share < DIAGONAL_GOVERNS
    }

    fn mode(&self) -> FailureMode {
        let softened = self.softened_web >= SOFTENED_WEB;
        let minor = self.diagonal_share <= DIAGONAL_MINOR;
        match (self.bends(), softened) {
            (true, false) if minor => FailureMode::Flexure,
            (false, true) => FailureMode::WebCrushing,
            (false, false) if self.diagonal_share >= DIAGONAL_GOVERNS => {
                FailureMode::DiagonalTension
            }
            (false, false) if minor && self.crushing_growth >= CRUSHING_GROWTH => {
                FailureMode::ConcreteCrushing
            }
            _ => FailureMode::Undecided,
        }
    }
}

impl fmt::Display for Measures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |share: f64| 100.0 * share;
        write!(
            f,
            "{:.0} % of the crack growth is diagonal",
            percent(self.diagonal_share)
        )?;
        if self.diagonal_share > 0.0 {
            write!(f, " (most in the {})", self.diagonal_span)?;
        }
        if let Some(BarReach {
            bar,
            x_mm,
            utilisation,
        }) = &self.bar
        {
            write!(
                f,
                "; {bar} bars reach {utilisation:.2} fy by the peak at x = {x_mm:.0} mm"
            )?;
        }
        write!(
            f,
            "; {:.1} % of a web past its strength at the peak; crushing grows by {:.2} % of the concrete",
            percent(self.softened_web),
            percent(self.crushing_growth)
        )
    }
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

#[cfg(test)]
mod tests;
