//! Options of a run; as flags of the command line they carry the texts of its help.

mod choices;
mod cracks;
mod mesh_size;
mod numbers;

use std::path::PathBuf;

use clap::{Args, Parser};
use serde::Serialize;
use serde_json::{Map, Value};

pub use choices::{
    Bond, Driver, Fields, Integration, Law, Preset, SheetShear, SoffitFibre, StripBond, name,
};
pub use cracks::{CompressionSoftening, Confinement, Cracks, ShearTransfer, TensionSoftening};
pub use mesh_size::MeshSize;
use numbers::{criterion, deflection, steps, threads};

/// Relative residual that a step must meet where none is given.
const CRITERION: f64 = 1e-3;

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

    /// Law of the concrete; without it, that of the preset
    #[arg(long, value_enum)]
    pub law: Option<Law>,

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

    /// The law of the concrete.
    pub fn law(&self) -> Law {
        self.law.unwrap_or_else(|| self.preset.law())
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
