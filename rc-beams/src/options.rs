//! Options of a run; as flags of the command line they carry the texts of its help.

use std::fmt::{self, Display, Formatter};
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, Parser, ValueEnum};
use serde::Serialize;
use serde_json::{Map, Value};

/// How specimens are modelled, solved and written.
#[derive(Debug, Clone, PartialEq, Serialize, Args)]
pub struct RunOptions {
    /// Set of modelling choices
    #[arg(long, value_enum, default_value_t)]
    pub preset: Preset,

    /// Elements along, up and across the half beam, of which free ends get fewer; two counts for one uniform across its
    /// width; without it, 60x4, with sheets 60x6 or as many more as their edges need
    #[arg(long, value_name = "NXxNY[xNZ]")]
    pub mesh: Option<MeshSize>,

    /// Integration points of the concrete elements; without it, those of the preset
    #[arg(long, value_enum)]
    pub integration: Option<Integration>,

    /// Law of the concrete
    #[arg(long, value_enum, default_value_t)]
    pub law: Law,

    /// Ingredients of the fixed-crack law
    #[command(flatten)]
    pub cracks: Cracks,

    /// Bond of the sheets
    #[arg(long, value_enum, default_value_t)]
    pub bond: Bond,

    /// Fibres of the sheet on the soffit; without it, as in the preset
    #[arg(long, value_enum)]
    pub soffit_fibre: Option<SoffitFibre>,

    /// Shear modulus of the sheets; without it, that of the preset
    #[arg(long, value_enum)]
    pub sheet_shear: Option<SheetShear>,

    /// Width that the bond of strips counts with; without it, that of the preset
    #[arg(long, value_enum)]
    pub strip_bond: Option<StripBond>,

    /// Run strengthened beams a second time with perfect bond, as evidence for the mode of failure
    #[arg(long)]
    pub counterfactual: bool,

    /// Run every beam twice more, with steps half as long and with a finer mesh, and print an error bar and by how much
    /// the peak changes
    #[arg(long)]
    pub band: bool,

    /// Solution of a step
    #[arg(long, value_enum, default_value_t)]
    pub driver: Driver,

    /// Steps to the deflection of `--until`, or to that which the specimen imposes, at the initial step size, which then adapts
    #[arg(long, value_name = "N", value_parser = steps, allow_negative_numbers = true)]
    pub steps: Option<u32>,

    /// Final deflection imposed on the loads (mm); without it, beyond the peak, up to four times that of the specimen
    #[arg(long = "until", value_name = "MM", value_parser = deflection, allow_negative_numbers = true)]
    pub until_mm: Option<f64>,

    /// Relative residual that every step must meet
    #[arg(long, value_name = "SHARE", value_parser = criterion, default_value_t = CRITERION, allow_negative_numbers = true)]
    pub criterion: f64,

    /// Continue runs that were interrupted, from their last accepted step; beams already done are left as they are
    #[arg(long)]
    #[serde(skip)]
    pub resume: bool,

    /// Threads; without it, one per core
    #[serde(skip)]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    pub threads: Option<u16>,

    /// Folder of the results, made if missing
    #[serde(skip)]
    #[arg(short, long, value_name = "DIR", default_value = "results")]
    pub output: PathBuf,

    /// Steps whose fields are written for ParaView
    #[arg(long, value_enum, default_value_t)]
    pub fields: Fields,
}

/// The options of a run where nothing is given.
#[derive(Parser)]
struct Defaults {
    #[command(flatten)]
    options: RunOptions,
}

impl RunOptions {
    /// Those that results depend on and that are not the default, by name; of the ingredients of the law each.
    pub fn changed(&self) -> Map<String, Value> {
        let defaults = Defaults::try_parse_from(["rc-beams"]).map(|d| d.options.by_name());
        let defaults = defaults.unwrap_or_default();
        let mut own = self.by_name();
        own.retain(|name, value| defaults.get(name) != Some(value));
        own
    }

    fn by_name(&self) -> Map<String, Value> {
        let mut all = match serde_json::to_value(self) {
            Ok(Value::Object(all)) => all,
            _ => Map::new(),
        };
        if let Some(Value::Object(cracks)) = all.remove("cracks") {
            all.extend(cracks);
        }
        all
    }
}

/// Ingredients of the fixed-crack law; those not given are of the preset.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Args)]
pub struct Cracks {
    /// Softening in tension; without it, that of the preset
    #[arg(long, value_enum)]
    pub tension_softening: Option<TensionSoftening>,

    /// Shear across cracks; without it, that of the preset
    #[arg(long, value_enum)]
    pub shear_transfer: Option<ShearTransfer>,

    /// What cracks do to the compression across them; without it, that of the preset
    #[arg(long, value_enum)]
    pub compression_softening: Option<CompressionSoftening>,

    /// What pressure from the sides does to compression; without it, nothing
    #[arg(long, value_enum)]
    pub confinement: Option<Confinement>,

    /// Distance of cracks, over which narrower elements share one (mm)
    #[arg(long, value_name = "MM", value_parser = crack_spacing, allow_negative_numbers = true)]
    pub crack_spacing_mm: Option<f64>,

    /// Share of the tensile strength down to which the axes of a crack follow the strain, fixed then, 1: at the onset; without it, that of the preset
    #[arg(long, value_name = "SHARE", value_parser = fixing_share, allow_negative_numbers = true)]
    pub fixing_share: Option<f64>,

    /// Least shear stiffness of open cracks over that of sound concrete; without it, that of the preset, 1e-4 of the default
    #[arg(long, value_name = "SHARE", value_parser = shear_floor, allow_negative_numbers = true)]
    pub shear_floor: Option<f64>,

    /// Crack-band width over the side of the square of the same area as an element; without it, that of the preset
    #[arg(long, value_name = "FACTOR", value_parser = band_factor, allow_negative_numbers = true)]
    pub band_factor: Option<f64>,

    /// Tensile strength over that of the preset
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_negative_numbers = true)]
    pub tensile_strength_factor: Option<f64>,

    /// Fracture energy over that of the Model Code
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_negative_numbers = true)]
    pub fracture_energy_factor: Option<f64>,

    /// Crushing energy over 250 times the fracture energy of the Model Code
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_negative_numbers = true)]
    pub crushing_energy_factor: Option<f64>,

    /// Largest aggregate (mm)
    #[arg(long, value_name = "MM", value_parser = aggregate, allow_negative_numbers = true)]
    pub aggregate_mm: Option<f64>,
}

/// Softening in tension.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum TensionSoftening {
    /// A line
    Linear,
    /// An exponential
    Exponential,
}

/// Shear across cracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum ShearTransfer {
    /// As far as the crack is still bridged in tension
    Damage,
    /// That and aggregate interlock
    Interlock,
}

/// What cracks do to the compression across them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum CompressionSoftening {
    /// Nothing
    None,
    /// The strength falls with the strain across
    VecchioCollins,
    /// The same, less, as cracks slip by themselves
    VecchioCollinsSlip,
}

/// What pressure from the sides does to compression.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Confinement {
    /// Nothing
    None,
    /// Concrete gets stronger, as in tests with two and three axes pressed
    Vecchio,
}

/// Set of modelling choices.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Preset {
    /// The reported strength is the mean; 14-point integration, dowel action of the bars; sheets as given
    #[default]
    Physical,
    /// As physical, but with strength and sheets as the reference reads them: mean of 8 MPa more than reported, fibres of the
    /// soffit along the beam, shear modulus E/2, bond of strips as under a sheet
    Reference,
    /// The reported strength is characteristic (mean: 8 MPa more); reduced integration, no dowel action, no interlock,
    /// no compression softening, linear softening in tension, half the band width, axes of cracks fixed at the onset, a tenfold floor
    /// of the shear of open cracks, bond of strips as under a sheet
    Characteristic,
}

/// Integration points of the concrete elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Integration {
    /// 2x2x2
    Reduced,
    /// 14 points, as exact as 3x3x3
    Irons,
    /// 3x3x3
    Full,
}

/// Law of the concrete.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Law {
    /// Orthogonal cracks that follow the strain, then stay fixed; crack band, interlock, struts weakened by cracks
    #[default]
    FixedCrack,
    /// The law of the reference: Ottosen surface, fixed cracks
    Reference,
    /// Ottosen surface, softening by fracture energy
    Objective,
}

/// Bond of the sheets.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Bond {
    /// Cohesive interface without thickness
    #[default]
    Cohesive,
    /// No slip: the sheets share the nodes of the concrete
    Perfect,
    /// Two solid layers of adhesive with the cohesive interface between them
    Adhesive,
}

/// Fibres of the sheet on the soffit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum SoffitFibre {
    /// As the specimen says
    Given,
    /// Along the beam
    Along,
}

/// Shear modulus of the sheets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum SheetShear {
    /// As the specimen says
    Given,
    /// Half of Young's modulus along the fibres
    Half,
}

/// Width factor of the bond of strips (Lu et al. 2005).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum StripBond {
    /// Width of the strips over their spacing
    Strip,
    /// As under a sheet that covers the concrete
    Sheet,
}

/// Solution of a step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Driver {
    /// Secant operator with Anderson acceleration
    #[default]
    Secant,
    /// The same in steps limited by events: a snap, a fall of the load or a loss of stability is met in the shortest steps
    Automatic,
    /// Newton-Raphson, tangent renewed at every iteration
    Newton,
    /// Newton-Raphson, tangent kept while it serves
    ModifiedNewton,
    /// Newton-Raphson on laws that lag behind; the viscous work is told
    Viscous,
    /// One linear solve a step, no iteration; the unbalanced force is told
    Implex,
    /// No equilibria: slow motion with fictitious masses, to check the others by; takes minutes
    Explicit,
}

/// Steps whose fields are written for ParaView.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Fields {
    /// No step
    None,
    /// The peak and the last step
    #[default]
    Last,
    /// Every accepted step
    All,
}

/// Name of a value, as on the command line.
pub fn name(value: &impl ValueEnum) -> String {
    let shown = value.to_possible_value();
    shown.map_or_else(String::new, |v| v.get_name().to_owned())
}

/// Numbers of elements along, up and across the beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct MeshSize {
    /// Along the beam, x.
    pub nx: usize,
    /// Over the height, y.
    pub ny: usize,
    /// Over half of the width, z; none where the displacement is uniform across it.
    pub nz: Option<usize>,
}

impl From<[usize; 3]> for MeshSize {
    fn from([nx, ny, nz]: [usize; 3]) -> Self {
        let nz = Some(nz);
        Self { nx, ny, nz }
    }
}

impl Display for MeshSize {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.nx, self.ny)?;
        self.nz.map_or(Ok(()), |nz| write!(f, "x{nz}"))
    }
}

/// Relative residual that a step must meet where none is given.
const CRITERION: f64 = 1e-3;
/// Largest number of elements in one direction.
const MAX_ELEMENTS: usize = 1000;
/// Largest number of elements in all.
const MAX_TOTAL: usize = 20_000;
/// Largest factor of the stiffness (GB); a run takes about three times as much.
const MAX_FACTOR_GB: f64 = 4.0;

impl FromStr for MeshSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let counts: Vec<usize> = text
            .split('x')
            .map(|n| {
                n.parse()
                    .map_err(|_| format!("{n:?} is not a whole number"))
            })
            .collect::<Result<_, _>>()
            .map_err(|what| {
                format!("{what}; write two or three counts, for instance 60x4 or 60x4x1")
            })?;
        let (nx, ny, nz) = match counts[..] {
            [nx, ny] => (nx, ny, None),
            [nx, ny, nz] => (nx, ny, Some(nz)),
            _ => {
                return Err(format!(
                    "{} counts; write two or three, for instance 60x4 or 60x4x1",
                    counts.len()
                ));
            }
        };
        let size = Self { nx, ny, nz };
        size.check()?;
        Ok(size)
    }
}

impl MeshSize {
    /// # Errors
    ///
    /// What is allowed, where a run would take too long or too much memory.
    pub fn check(self) -> Result<(), String> {
        let across = self.nz.unwrap_or(1);
        for (count, axis) in [(self.nx, "along"), (self.ny, "up"), (across, "across")] {
            if !(1..=MAX_ELEMENTS).contains(&count) {
                return Err(format!(
                    "{count} elements {axis} the beam; allowed: 1 to {MAX_ELEMENTS}, for instance 60x4x1"
                ));
            }
        }
        let total = self.nx * self.ny * across;
        if total > MAX_TOTAL {
            return Err(format!(
                "{total} elements; allowed: up to {MAX_TOTAL} in all, for instance 60x4x1"
            ));
        }
        let factor = self.factor_gb();
        if factor > MAX_FACTOR_GB {
            return Err(format!(
                "the factor of the stiffness would take about {factor:.0} GB; allowed: up to \
                 {MAX_FACTOR_GB} GB; give fewer elements up and across, for instance 60x4x1"
            ));
        }
        Ok(())
    }

    /// The mesh with so many times the elements along and up, rounded up.
    #[must_use]
    pub fn finer(self, ratio: f64) -> Self {
        let [nx, ny] = [self.nx, self.ny].map(|n| (ratio * n as f64).ceil() as usize);
        Self { nx, ny, ..self }
    }

    /// About how much the factor of the stiffness takes (GB): equations are numbered along the beam, so that
    /// a layer of elements is coupled with the next, and the band is filled.
    fn factor_gb(self) -> f64 {
        let [nx, ny] = [self.nx, self.ny].map(|n| n as f64);
        // Uniform across, there are as many DOFs as on one face.
        let nz = self.nz.map_or(0.0, |nz| nz as f64);
        let face = (2.0 * ny + 1.0) * (2.0 * nz + 1.0) - ny * nz;
        let middle = (ny + 1.0) * (nz + 1.0);
        let layer = 3.0 * (face + middle);
        8.0 * nx * layer * layer / 1e9
    }
}

/// A number of steps of the command line.
fn steps(text: &str) -> Result<u32, String> {
    count(text, 1..=1_000_000)
}

/// A number of threads of the command line.
fn threads(text: &str) -> Result<u16, String> {
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

fn shear_floor(text: &str) -> Result<f64, String> {
    number(text, 1e-6..=1.0)
}

fn criterion(text: &str) -> Result<f64, String> {
    number(text, 1e-8..=0.1)
}

fn band_factor(text: &str) -> Result<f64, String> {
    number(text, 0.25..=2.0)
}

fn crack_spacing(text: &str) -> Result<f64, String> {
    number(text, 10.0..=1000.0)
}

fn fixing_share(text: &str) -> Result<f64, String> {
    number(text, 0.01..=1.0)
}

fn factor(text: &str) -> Result<f64, String> {
    number(text, 0.25..=4.0)
}

fn aggregate(text: &str) -> Result<f64, String> {
    number(text, 1.0..=100.0)
}

/// A deflection of the command line (mm).
fn deflection(text: &str) -> Result<f64, String> {
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
