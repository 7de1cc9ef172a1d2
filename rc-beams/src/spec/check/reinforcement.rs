//! Bars and stirrups lie inside the concrete.

use std::f64::consts::FRAC_PI_4;
use std::ops::RangeInclusive;

use fe_contact::envelope::{Confinement, ModelCode, ModelCodeParameters};
use fe_core::material::MaterialError;

use super::{ALONG, Checks, TOLERANCE};
use crate::spec::quantity::{BarArea, BarDiameter};
use crate::spec::reinforcement::{Bar, BarBond, Steel, Stirrups, Zone};

/// Smallest and largest cross-section of a bar over the circle of its diameter.
const AREA_RATIO: RangeInclusive<f64> = 0.8..=1.1;

/// Largest cross-section of the bars over that of the beam; codes allow 0.08 where bars overlap (EN 1992-1-1, 9.2.1.1
/// and 9.5.2).
const LARGEST_RATIO: f64 = 0.2;

const UP: &str = "y is measured from the soffit";
const MIRRORED: &str = "z is measured from the middle of the width, where a bar would meet its mirror image: write two of half \
                        its cross-section for one there";
const ACROSS: &str = "z is measured from the middle of the width";

impl Checks<'_> {
    pub(super) fn reinforcement(&mut self) {
        let specimen = self.specimen;
        for (i, bar) in specimen.bars.iter().enumerate() {
            self.bar(&format!("bars[{i}]"), bar);
            let before = specimen.bars[..i].iter().map(|b| &b.name);
            self.named_once(&format!("bars[{i}]"), ("bars", &bar.name), before);
        }
        self.steel_share();
        if let Some(stirrups) = &specimen.stirrups {
            self.steel("stirrups", &stirrups.steel);
            self.area("stirrups", stirrups.diameter_mm, stirrups.area_mm2);
            self.bond("stirrups", &stirrups.bond);
            self.shape(stirrups);
            self.zones(stirrups);
        }
    }

    /// Bars leave room for concrete.
    fn steel_share(&mut self) {
        let of = |bar: &Bar| f64::from(bar.count_in_half.get()) * bar.area_mm2.get();
        let bars = &self.specimen.bars;
        let sum: f64 = bars.iter().map(of).sum();
        let most = LARGEST_RATIO * self.height() * self.half_width();
        let largest = bars
            .iter()
            .enumerate()
            .max_by(|a, b| of(a.1).total_cmp(&of(b.1)));
        if let Some((i, _)) = largest.filter(|_| sum > most) {
            self.report(
                format!("bars[{i}].count_in_half"),
                format!("all bars have {sum:.0} mm2 in half of the width; allowed: {most:.0} mm2, a fifth of the concrete"),
                "count the bars in half of the width, and give the cross-section of one",
            );
        }
    }

    fn bar(&mut self, path: &str, bar: &Bar) {
        self.steel(path, &bar.steel);
        self.area(path, bar.diameter_mm, bar.area_mm2);
        self.bond(path, &bar.bond);
        if bar.anchored && bar.bond == BarBond::Perfect {
            self.report(
                format!("{path}.anchored"),
                "anchored, with perfect bond; allowed: false, as such a bar slips nowhere",
                "give the bond of the bar, or leave `anchored` out",
            );
        }
        let radius = 0.5 * bar.diameter_mm.get();
        let axis = &bar.axis;
        let (from, to) = (axis.x_from_mm.get(), axis.x_to_mm.get());
        let place = format!("axis of bar {:?}", bar.name);
        let (height, half, length) = (self.height(), self.half_width(), self.length());
        let y = (place.as_str(), axis.y_mm.get());
        self.within(format!("{path}.axis.y_mm"), y, radius..=height - radius, UP);
        let z = (place.as_str(), axis.z_mm.get());
        self.within(
            format!("{path}.axis.z_mm"),
            z,
            radius..=half - radius,
            MIRRORED,
        );
        self.within(
            format!("{path}.axis.x_to_mm"),
            (&place, to),
            0.0..=length,
            ALONG,
        );
        self.ascending(format!("{path}.axis.x_to_mm"), from, to);
    }

    /// Bond softens from the end of its plateau to the slip of one rib spacing. Pull-out has the longest plateau.
    fn bond(&mut self, path: &str, bond: &BarBond) {
        let strength = self.specimen.concrete.reported_strength_mpa.get();
        let Some(parameters) = bond.parameters(strength) else {
            return;
        };
        let curve = ModelCode::new(&ModelCodeParameters {
            confinement: Confinement::PullOut,
            ..parameters
        });
        if let Err(MaterialError::Parameter {
            value,
            allowed,
            remedy,
            ..
        }) = curve
        {
            self.report(
                format!("{path}.bond.rib_spacing_mm"),
                format!("{value} mm; allowed: {allowed}"),
                remedy,
            );
        }
    }

    fn steel(&mut self, path: &str, steel: &Steel) {
        let (fy, fu) = (steel.fy_mpa.get(), steel.fu_mpa.get());
        if fu < fy {
            self.report(
                format!("{path}.steel.fu_mpa"),
                format!("rupture at {fu} MPa; allowed: at least the yield stress, {fy} MPa"),
                "exchange fy_mpa and fu_mpa if they are the wrong way round",
            );
        }
    }

    fn area(&mut self, path: &str, diameter: BarDiameter, area: BarArea) {
        let circle = FRAC_PI_4 * diameter.get().powi(2);
        let (low, high) = (AREA_RATIO.start() * circle, AREA_RATIO.end() * circle);
        if !(low..=high).contains(&area.get()) {
            self.report(
                format!("{path}.area_mm2"),
                format!(
                    "{} mm2 for a diameter of {} mm; allowed: {low:.1} to {high:.1} mm2",
                    area.get(),
                    diameter.get(),
                ),
                "give the cross-section of one bar; the number of bars is a field of its own",
            );
        }
    }

    fn shape(&mut self, stirrups: &Stirrups) {
        let radius = 0.5 * stirrups.diameter_mm.get();
        let (height, half) = (self.height(), self.half_width());
        let leg = &stirrups.shape.vertical;
        let path = "stirrups.shape.vertical";
        let (from, to) = (leg.y_from_mm.get(), leg.y_to_mm.get());
        let z = ("vertical leg", leg.z_mm.get());
        self.within(format!("{path}.z_mm"), z, radius..=half - radius, MIRRORED);
        self.within(
            format!("{path}.y_to_mm"),
            ("end of the leg", to),
            0.0..=height,
            UP,
        );
        self.ascending(format!("{path}.y_to_mm"), from, to);
        for (i, leg) in stirrups.shape.horizontal.iter().enumerate() {
            let path = format!("stirrups.shape.horizontal[{i}]");
            let (from, to) = (leg.z_from_mm.get(), leg.z_to_mm.get());
            let y = ("horizontal leg", leg.y_mm.get());
            self.within(format!("{path}.y_mm"), y, radius..=height - radius, UP);
            self.within(
                format!("{path}.z_to_mm"),
                ("end of the leg", to),
                0.0..=half,
                ACROSS,
            );
            self.ascending(format!("{path}.z_to_mm"), from, to);
        }
    }

    /// Zones fill the beam from end to end; stirrups lie in their zone and apart from each other. Behind a wrong zone nothing is
    /// known.
    fn zones(&mut self, stirrups: &Stirrups) {
        let mut end = 0.0;
        let mut last = f64::NEG_INFINITY;
        for (i, zone) in stirrups.zones.iter().enumerate() {
            let path = format!("stirrups.zones[{i}]");
            let (from, to) = (zone.x_from_mm.get(), zone.x_to_mm.get());
            if (from - end).abs() > TOLERANCE {
                self.report(
                    format!("{path}.x_from_mm"),
                    format!(
                        "zone begins at {from} mm; allowed: {end} mm, where the one before ends"
                    ),
                    "give a zone without stirrups as `stirrups: None`",
                );
                return;
            }
            let fits = self.passes(|c| c.ascending(format!("{path}.x_to_mm"), from, to))
                && self.passes(|c| c.row(&path, zone, last + stirrups.diameter_mm.get()));
            if !fits {
                return;
            }
            end = to;
            last = zone.positions().last().copied().unwrap_or(last);
        }
        if (end - self.length()).abs() > TOLERANCE {
            let message = format!(
                "zones end at {end} mm; allowed: {} mm, the end of the beam",
                self.length()
            );
            let path = format!(
                "stirrups.zones[{}].x_to_mm",
                stirrups.zones.len().max(1) - 1
            );
            self.report(path, message, "let the last zone end with the beam");
        }
    }

    fn row(&mut self, path: &str, zone: &Zone, earliest: f64) {
        if let Some(row) = &zone.stirrups {
            let low = zone.x_from_mm.get().max(earliest);
            let range = low..=zone.x_to_mm.get().max(low);
            let first = ("first stirrup", row.first_mm.get());
            let remedy = "stirrups lie in their zone, a diameter or more behind those before it";
            self.within(format!("{path}.stirrups.first_mm"), first, range, remedy);
        }
    }
}
