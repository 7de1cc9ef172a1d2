//! What the sheets lose while the load falls from its peak.

use fe_solver::capacity::{CAPACITY_FALL, Capacity, PathPoint};

use super::{SheetLayout, SheetRow};

/// Fall of the load from which the force of the sheets is lost too.
pub const LOST: f64 = 0.90;

/// Whether a load is what is left of a peak that has been lost.
pub fn is_lost(load: f64, peak: f64) -> bool {
    load <= (1.0 - LOST) * peak
}

/// Index of the first point after the peak at which the load is at most 0.8 of it; none while the load is above.
pub fn end_of_drop(path: &[PathPoint], capacity: &Capacity) -> Option<usize> {
    let peak = path.get(capacity.peak)?.load;
    let after = path.iter().enumerate().skip(capacity.peak + 1);
    after
        .take_while(|(_, p)| p.load <= peak)
        .find(|(_, p)| p.load <= (1.0 - CAPACITY_FALL) * peak)
        .map(|(i, _)| i)
}

/// A shear span, at the peak and at the end of the drop.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SpanDrop {
    /// Force SVf of the sheets (kN).
    pub force_kn: [f64; 2],
    /// Debonded share of the side; none where the span has no bonded side.
    pub debonded: Option<[f64; 2]>,
    /// Stirrups in the span.
    pub stirrups: usize,
}

impl SpanDrop {
    /// Whether a sheet on the side carries tension across a diagonal crack at the peak.
    pub fn is_covered(&self) -> bool {
        self.force_kn[0] > 0.0
    }

    /// Loss of force relative to that at the peak, negative where it grows; 0 where the sheets are idle at the peak.
    pub fn loss(&self) -> f64 {
        loss(self.force_kn)
    }
}

/// A zone, at the end of the drop.
#[derive(Debug, Clone, PartialEq)]
pub struct ZoneDrop {
    /// Name.
    pub name: String,
    /// Debonded share.
    pub debonded: f64,
    /// Largest slip so far (mm).
    pub slip_max_mm: f64,
    /// Largest fibre stress at the peak and at the end (MPa).
    pub fibre_mpa: [f64; 2],
}

impl ZoneDrop {
    /// Loss of fibre stress relative to that at the peak, negative where it grows; 0 where the zone is idle at the peak.
    pub fn loss(&self) -> f64 {
        loss(self.fibre_mpa)
    }
}

fn loss([peak, end]: [f64; 2]) -> f64 {
    if peak > 0.0 { (peak - end) / peak } else { 0.0 }
}

/// What the sheets lose from the peak to 0.8 of it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetDrop {
    /// Shear spans.
    pub spans: Vec<SpanDrop>,
    /// Whether the load fell to 0.8 of the peak; else the end is the last step.
    pub complete: bool,
    /// Load at the end of the drop (kN).
    pub end_load_kn: f64,
    /// Whether next to nothing is left of the load there.
    pub lost: bool,
    /// Largest utilisation of a sheet up to the peak.
    pub utilisation: f64,
    /// The zone that is debonded most at the end.
    pub zone: Option<ZoneDrop>,
    /// The same of the zones that leave the side bare.
    pub flat: Option<ZoneDrop>,
}

impl SheetDrop {
    /// Reads the rows of a run, one per point of its path (self weight is none); `None` without the row of
    /// the peak.
    pub fn of(
        sheets: &SheetLayout,
        rows: &[SheetRow],
        path: &[PathPoint],
        capacity: &Capacity,
    ) -> Option<Self> {
        let end = end_of_drop(path, capacity);
        let peak = rows.get(capacity.peak)?;
        let last = match end {
            Some(i) => rows.get(i)?,
            None => rows.last()?,
        };
        let spans = peak.spans.iter().zip(&last.spans).enumerate();
        let spans = spans.map(|(i, (before, after))| SpanDrop {
            force_kn: [before.force_kn, after.force_kn],
            debonded: before.debonded.zip(after.debonded).map(<[f64; 2]>::from),
            stirrups: sheets.stirrups_in_spans.get(i).copied().unwrap_or(0),
        });
        let zones = sheets.zones.iter().zip(peak.zones.iter().zip(&last.zones));
        let debonded = zones.filter_map(|(zone, (before, after))| {
            let drop = ZoneDrop {
                name: zone.name.clone(),
                debonded: after.debonded.filter(|share| *share > 0.0)?,
                slip_max_mm: after.slip_max_mm,
                fibre_mpa: [before.fibre_mpa, after.fibre_mpa],
            };
            Some((zone, drop))
        });
        let most = |flat: bool| {
            let found = debonded
                .clone()
                .filter(|(zone, _)| !flat || zone.leaves_the_side_bare());
            found
                .map(|(_, drop)| drop)
                .max_by(|a, b| a.debonded.total_cmp(&b.debonded))
        };
        Some(Self {
            spans: spans.collect(),
            complete: end.is_some(),
            end_load_kn: last.load_kn,
            lost: is_lost(last.load_kn, peak.load_kn),
            utilisation: rows[..=capacity.peak]
                .iter()
                .map(|r| r.utilisation)
                .fold(0.0, f64::max),
            zone: most(false),
            flat: most(true),
        })
    }
}
