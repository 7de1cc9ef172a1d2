//! Bars and stirrups of a specimen: embedded, or slipping where the specimen gives a law of bond.

use std::ops::Range;
use std::sync::Arc;

use fe_core::element::Element;
use fe_core::followers::Followers;
use fe_core::kinematics::Axial;
use fe_core::material::Material;
use fe_core::mesh::Mesh;
use fe_elements::{Bar, Dowel, Led};
use fe_materials::Biso;

use super::slipping::{self, Slip};
use super::{BuildError, ModelSettings, laws};
use crate::spec::{BarArea, BarBond, BarDiameter, Specimen, Steel};

/// What a bar is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BarKind {
    /// A longitudinal bar.
    Longitudinal,
    /// The vertical leg of a stirrup at a position along the beam (mm).
    StirrupLeg(f64),
    /// A horizontal leg of a stirrup.
    Tie,
}

/// A bar of the model.
#[derive(Debug, Clone, PartialEq)]
pub struct BarRecord {
    /// Name.
    pub name: String,
    /// What it is for.
    pub kind: BarKind,
    /// Ends (mm).
    pub ends: [[f64; 3]; 2],
    /// Yield stress (MPa).
    pub fy_mpa: f64,
    /// Elements it was cut into, in no particular order along the bar; their samples are axial.
    pub elements: Range<usize>,
    /// Elements of its bond; none where it is perfect.
    pub bond: Range<usize>,
}

/// Lays every bar in the concrete `blocks` and adds its elements; a slipping bar adds nodes as well.
pub(super) fn lay(
    specimen: &Specimen,
    settings: &ModelSettings,
    (mesh, blocks): (&mut Mesh, &[&str]),
    followers: &Followers,
    elements: &mut Vec<Box<dyn Element>>,
) -> Result<Vec<BarRecord>, BuildError> {
    let mut records = Vec::new();
    for planned in bars(specimen, settings)? {
        let (bar, slip, mut record) = (planned.bar, planned.slip, planned.record);
        let first = elements.len();
        let mut bonds = Vec::new();
        if let Some(slip) = slip {
            let (steel, around) = slipping::lay(&bar, &slip, mesh, blocks)?;
            let led = |e| Led::by(e, followers);
            elements.extend(steel.into_iter().map(led));
            bonds = around.into_iter().map(led).collect();
        } else {
            let pieces = fe_elements::embed(&[bar], mesh, blocks)?;
            let led = pieces.into_iter().map(|e| Box::new(e.led_by(followers)));
            elements.extend(led.map(|e| e as Box<dyn Element>));
        }
        record.elements = first..elements.len();
        elements.extend(bonds);
        record.bond = record.elements.end..elements.len();
        records.push(record);
    }
    Ok(records)
}

/// Every bar of the half model, its record still without elements.
fn bars(specimen: &Specimen, settings: &ModelSettings) -> Result<Vec<Planned>, BuildError> {
    let mut bars = Vec::new();
    for b in &specimen.bars {
        let size = (b.count_in_half.get(), b.diameter_mm, b.area_mm2);
        let bond = (&b.bond, b.anchored);
        let stock = Stock::new(specimen, settings, size, &b.steel, bond)?;
        let at = |x: f64| [x, b.axis.y_mm.get(), b.axis.z_mm.get()];
        let ends = [at(b.axis.x_from_mm.get()), at(b.axis.x_to_mm.get())];
        bars.push(stock.bar(b.name.clone(), BarKind::Longitudinal, ends));
    }
    if let Some(s) = &specimen.stirrups {
        let size = (1, s.diameter_mm, s.area_mm2);
        let stock = Stock::new(specimen, settings, size, &s.steel, (&s.bond, true))?;
        for x in s.positions() {
            let leg = &s.shape.vertical;
            let ends = [&leg.y_from_mm, &leg.y_to_mm].map(|y| [x, y.get(), leg.z_mm.get()]);
            let name = format!("stirrup at {x}");
            bars.push(stock.bar(name, BarKind::StirrupLeg(x), ends));
            for tie in &s.shape.horizontal {
                let y = tie.y_mm.get();
                let ends = [&tie.z_from_mm, &tie.z_to_mm].map(|z| [x, y, z.get()]);
                let tie = stock.bar(format!("tie at {x}, {y}"), BarKind::Tie, ends);
                bars.push(Planned { slip: None, ..tie });
            }
        }
    }
    Ok(bars)
}

/// A bar to lay.
struct Planned {
    bar: Bar,
    /// How it slips, if it does.
    slip: Option<Slip>,
    record: BarRecord,
}

/// What bars of one kind have in common.
struct Stock {
    area_mm2: f64,
    fy_mpa: f64,
    law: Arc<dyn Material<Axial>>,
    dowel: Option<Dowel>,
    slip: Option<Slip>,
}

impl Stock {
    /// Bars of which `count` with this diameter and area lie at one place; their ends are held or not.
    fn new(
        specimen: &Specimen,
        settings: &ModelSettings,
        (count, diameter, area): (u8, BarDiameter, BarArea),
        steel: &Steel,
        bond: (&BarBond, bool),
    ) -> Result<Self, BuildError> {
        let diameter = diameter.get();
        let dowel = dowel(specimen, settings, diameter, steel)?;
        Ok(Self {
            area_mm2: f64::from(count) * area.get(),
            fy_mpa: steel.fy_mpa.get(),
            law: law(steel)?,
            dowel: dowel.map(|one| one.times(u32::from(count))),
            slip: slipping::slip(specimen, settings, (count, diameter), bond)?,
        })
    }

    fn bar(&self, name: String, kind: BarKind, ends: [[f64; 3]; 2]) -> Planned {
        let bar = Bar {
            name: name.clone(),
            polyline: ends.into(),
            area_mm2: self.area_mm2,
            law: Arc::clone(&self.law),
            dowel: self.dowel,
        };
        let record = BarRecord {
            name,
            kind,
            ends,
            fy_mpa: self.fy_mpa,
            elements: 0..0,
            bond: 0..0,
        };
        Planned {
            bar,
            slip: self.slip.clone(),
            record,
        }
    }
}

fn law(steel: &Steel) -> Result<Arc<dyn Material<Axial>>, BuildError> {
    let young = steel.young_mpa.get();
    let tangent = young * steel.hardening_ratio.get();
    Ok(Arc::new(Biso::hot_rolled(
        young,
        steel.fy_mpa.get(),
        tangent,
    )?))
}

/// Dowel action in the plane of the beam.
fn dowel(
    specimen: &Specimen,
    settings: &ModelSettings,
    diameter: f64,
    steel: &Steel,
) -> Result<Option<Dowel>, BuildError> {
    if !settings.dowel {
        return Ok(None);
    }
    let strength = laws::mean_strength(specimen, settings)?;
    let band = settings.nominal_band_width(specimen);
    let young = steel.young_mpa.get();
    let plane = [0.0, 0.0, 1.0];
    let dowel = Dowel::he_kwan(diameter, strength, young, band, plane)?;
    let fy = steel.fy_mpa.get();
    Ok(Some(dowel.bounded(diameter, strength, fy)?))
}
