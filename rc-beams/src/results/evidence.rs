//! What is looked at to see how a beam fails, at one state of it.

use fe_core::element::PointSample;

/// An integration point of the concrete.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConcretePoint {
    /// Position (mm).
    pub position: [f64; 3],
    /// Volume it stands for (mm3).
    pub volume: f64,
    /// Largest crack strain.
    pub crack_strain: f64,
    /// Unit normal of that crack; zero without a crack.
    pub crack_normal: [f64; 3],
    /// Share of the compressive capacity that crushing has consumed: 0 up to the strength, 1 at the
    /// residual stress.
    pub crushing: f64,
}

impl ConcretePoint {
    /// Angle between crack normal and beam axis (degrees); 90 without a crack.
    pub fn inclination_deg(&self) -> f64 {
        self.crack_normal[0].abs().min(1.0).acos().to_degrees()
    }
}

impl From<&PointSample<'_>> for ConcretePoint {
    fn from(sample: &PointSample<'_>) -> Self {
        Self {
            position: sample.position,
            volume: sample.volume,
            crack_strain: sample.report.crack_strain,
            crack_normal: sample.report.crack_normal,
            crushing: sample.report.crushing,
        }
    }
}

/// Where a bar is stressed most within one stretch of the beam.
#[derive(Debug, Clone, PartialEq)]
pub struct BarReach {
    /// Name of the bar.
    pub bar: String,
    /// Where (mm).
    pub x_mm: f64,
    /// Tensile stress over yield stress; 1 at least where it has yielded in tension.
    pub utilisation: f64,
}

/// A state of the beam, as far as its failure is concerned.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Snapshot {
    /// Concrete, the same points in the same order in every snapshot of a beam.
    pub concrete: Vec<ConcretePoint>,
    /// Longitudinal bars, one entry per bar and stretch.
    pub bars: Vec<BarReach>,
    /// Vertical legs of stirrups.
    pub stirrups: Vec<BarReach>,
}

/// A stretch of the beam between load and support in which shear is transferred.
#[derive(Debug, Clone, PartialEq)]
pub struct ShearSpan {
    /// Name, as in "right shear span".
    pub name: String,
    /// Left end (mm).
    pub from_mm: f64,
    /// Right end (mm).
    pub to_mm: f64,
}

/// What does not change during a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Layout {
    /// Shear spans; what lies between them are zones of bending.
    pub shear_spans: Vec<ShearSpan>,
    /// Height of the section (mm).
    pub height_mm: f64,
    /// Stirrups in the beam.
    pub stirrups: usize,
}

impl Layout {
    /// Index of the shear span that holds `x` (mm).
    pub fn span_at(&self, x: f64) -> Option<usize> {
        let mut spans = self.shear_spans.iter();
        spans.position(|span| (span.from_mm..=span.to_mm).contains(&x))
    }
}
