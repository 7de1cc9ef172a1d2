//! Supports, loads and measuring points lie on the beam and hold it.

use super::{Checks, TOLERANCE};
use crate::spec::specimen::{Held, LoadMeasure};

/// Share of a span up to which spans, and places of loads in them, are alike; assumed.
const ALIKE: f64 = 0.01;

/// A plate on or under the beam.
struct Contact {
    path: String,
    centre: f64,
    length: f64,
}

impl Checks<'_> {
    /// Returns whether supports and loads are as they may be: what else depends on their places can be looked at.
    pub(super) fn supports(&mut self) -> bool {
        let specimen = self.specimen;
        let below = specimen.supports.iter().enumerate().map(|(i, s)| Contact {
            path: format!("supports[{i}].x_mm"),
            centre: s.x_mm.get(),
            length: s.plate.length_mm.get(),
        });
        let above = specimen.loads.iter().enumerate().map(|(i, load)| Contact {
            path: format!("loads[{i}].x_mm"),
            centre: load.x_mm.get(),
            length: load.plate.length_mm.get(),
        });
        let below = self.passes(|c| c.contacts("support", below.collect()));
        let above = self.passes(|c| c.contacts("load", above.collect()));
        let stands = below && above && self.passes(Self::apart);
        let holds = self.passes(Self::holds_something) && self.passes(Self::held);
        self.stubs();
        self.measuring(stands && holds)
    }

    /// What a support holds is named once.
    fn holds_something(&mut self) {
        let specimen = self.specimen;
        for (i, support) in specimen.supports.iter().enumerate() {
            let path = format!("supports[{i}].held");
            let twice = |h: &Held| support.held.iter().filter(|other| *other == h).count() > 1;
            if support.held.is_empty() {
                self.report(
                    path,
                    "holds nothing; allowed: Ux, Uy, or both",
                    "name what it holds, or leave the support out",
                );
            } else if let Some(held) = support.held.iter().find(|h| twice(h)) {
                self.report(
                    path,
                    format!("{held:?} stands twice; allowed: Ux, Uy, or both, once each"),
                    "leave one out",
                );
            }
        }
    }

    /// Plates lie on the beam, from left to right, apart from each other. Behind one that does not, nothing is known.
    fn contacts(&mut self, what: &str, contacts: Vec<Contact>) {
        let mut end = 0.0;
        for Contact {
            path,
            centre,
            length,
        } in contacts
        {
            let half = 0.5 * length;
            let range = end + half..=self.length() - half;
            if range.end() - range.start() < -TOLERANCE {
                self.report(
                    path,
                    format!(
                        "centre of the {what} at {centre} mm; allowed: none, a plate of {length} mm has no place on a beam \
                         of {} mm behind {end} mm, where the {what} to its left ends",
                        self.length()
                    ),
                    format!("order the {what}s from left to right, move the one to its left, or shorten the plates"),
                );
                return;
            }
            let remedy = format!(
                "a plate of {length} mm lies on the beam and behind the {what} to its left"
            );
            let named = format!("centre of the {what}");
            if !self.passes(|c| c.within(path, (&named, centre), range, &remedy)) {
                return;
            }
            end = centre + half;
        }
    }

    /// No load stands above a support: the mesh has element faces at the edges of all plates. Each of both is told once.
    fn apart(&mut self) {
        let specimen = self.specimen;
        let mut told = Vec::new();
        for (i, load) in specimen.loads.iter().enumerate() {
            for (k, support) in specimen.supports.iter().enumerate() {
                if told
                    .iter()
                    .any(|(load, support)| *load == i || *support == k)
                {
                    continue;
                }
                let (x, below) = (load.x_mm.get(), support.x_mm.get());
                let least = 0.5 * (load.plate.length_mm.get() + support.plate.length_mm.get());
                if (x - below).abs() < least - TOLERANCE {
                    self.report(
                        format!("loads[{i}].x_mm"),
                        format!(
                            "centre of the load at {x} mm, above the support at {below} mm; allowed: \
                             {least} mm or more away from it"
                        ),
                        "move the load into the span, or shorten the plates",
                    );
                    told.push((i, k));
                }
            }
        }
    }

    fn held(&mut self) {
        let supports = &self.specimen.supports;
        let count = |held| supports.iter().filter(|s| s.held.contains(&held)).count();
        let (vertical, along) = (count(Held::Uy), count(Held::Ux));
        if vertical < 2 {
            self.report(
                "supports",
                format!(
                    "supports that hold Uy: {vertical}; allowed: at least 2, or the beam turns"
                ),
                "add a support with `held: [Uy]`",
            );
        } else if along == 0 {
            self.report(
                "supports",
                "supports that hold Ux: 0; allowed: at least 1, or the beam slides",
                "write `held: [Ux, Uy]` at one support",
            );
        }
        if self.specimen.loads.is_empty() {
            self.report("loads", "none is given; allowed: at least 1", "add a load");
        }
    }

    /// Stubs are as long as the plate below them: the mesh has element faces at its edges only.
    fn stubs(&mut self) {
        for (i, support) in self.specimen.supports.iter().enumerate() {
            let Some(stub) = &support.stub else { continue };
            let (plate, block) = (support.plate.length_mm.get(), stub.length_mm.get());
            if (plate - block).abs() > TOLERANCE {
                self.report(
                    format!("supports[{i}].stub.length_mm"),
                    format!("stub of {block} mm; allowed: {plate} mm, the length of its plate"),
                    "give plate and stub the same length",
                );
            }
        }
    }

    /// With `supported` known to be held where it may. Returns whether supports suit what is measured, too.
    fn measuring(&mut self, supported: bool) -> bool {
        let measuring = &self.specimen.measuring;
        let (length, height, half) = (self.length(), self.height(), self.half_width());
        let point = &measuring.deflection;
        for (axis, value, limit) in [
            ("x", point.x_mm, length),
            ("y", point.y_mm, height),
            ("z", point.z_mm, half),
        ] {
            self.within(
                format!("measuring.deflection.{axis}_mm"),
                ("deflection read", value.get()),
                0.0..=limit,
                "the point lies in the half model: x from the left end, y from the soffit, \
                 z from the middle of the width",
            );
        }
        let supported = supported && self.passes(Self::gauge_in_a_span);
        let span = &measuring.test_span;
        let (from, to) = (span.x_from_mm.get(), span.x_to_mm.get());
        let within = self.passes(|c| {
            if supported {
                c.between_supports("x_from_mm", ("beginning of the test span", from));
            }
        });
        let within = within
            && self.passes(|c| {
                if supported {
                    c.between_supports("x_to_mm", ("end of the test span", to));
                }
            });
        if within {
            self.ascending("measuring.test_span.x_to_mm", from, to);
        }
        supported && within && self.passes(Self::inner_shear)
    }

    /// The deflection is read where the beam can move.
    fn gauge_in_a_span(&mut self) {
        let x = self.specimen.measuring.deflection.x_mm.get();
        let holding = self.specimen.supports.iter();
        let holding = holding.filter(|s| s.held.contains(&Held::Uy));
        let mut plates = holding.map(|s| (s.x_mm.get(), 0.5 * s.plate.length_mm.get()));
        let below = plates.find(|(support, half)| (support - x).abs() <= half + TOLERANCE);
        if let Some((support, half)) = below {
            self.report(
                "measuring.deflection.x_mm",
                format!(
                    "deflection read at {x} mm, above the support at {support} mm, which does not move; allowed: more than \
                     {half} mm away from it",
                ),
                "read it in a span",
            );
        }
    }

    fn between_supports(&mut self, field: &str, place: (&str, f64)) {
        let supports = self.specimen.supports.iter().map(|s| s.x_mm.get());
        let ends = (self.length(), 0.0);
        let (left, right) = supports.fold(ends, |(l, r): (f64, f64), x| (l.min(x), r.max(x)));
        self.within(
            format!("measuring.test_span.{field}"),
            place,
            left..=right.max(left),
            "the test span lies between the outer supports",
        );
    }

    /// Shear at an inner support has one, between spans that are alike.
    fn inner_shear(&mut self) {
        let supports = self.specimen.supports.len();
        let LoadMeasure::InnerShear { end_support } = self.specimen.measuring.load else {
            return;
        };
        if supports != 3 {
            self.report(
                "measuring.load",
                format!("shear at an inner support of {supports} supports; allowed: 3 supports"),
                "measure TotalReactions",
            );
            return;
        }
        if end_support != 0 && end_support != supports - 1 {
            self.report(
                "measuring.load.end_support",
                format!(
                    "number {end_support} of {supports}; allowed: 0 or {}, the ends",
                    supports - 1
                ),
                "count from 0 at the left",
            );
        }
        self.equal_spans();
    }

    /// Shear at an inner support is read off equal shares of the load: of two spans between supports that hold the beam up, loaded
    /// alike.
    fn equal_spans(&mut self) {
        let specimen = self.specimen;
        for (i, support) in specimen.supports.iter().enumerate() {
            if !support.held.contains(&Held::Uy) {
                self.report(
                    format!("supports[{i}].held"),
                    "no Uy, where shear at an inner support is measured; allowed: with Uy",
                    "measure TotalReactions, or hold it up",
                );
            }
        }
        let places: Vec<f64> = specimen.supports.iter().map(|s| s.x_mm.get()).collect();
        let [left, inner, right] = places[..] else {
            return;
        };
        let from_inner = |side: f64| {
            let loads = specimen
                .loads
                .iter()
                .map(|load| side * (load.x_mm.get() - inner));
            let mut found: Vec<f64> = loads.filter(|way| *way > 0.0).collect();
            found.sort_by(f64::total_cmp);
            found
        };
        let spans = [inner - left, right - inner];
        let loads = [from_inner(-1.0), from_inner(1.0)];
        let alike = |a: f64, b: f64| (a - b).abs() <= ALIKE * spans[0];
        let pairs = loads[0].iter().zip(&loads[1]);
        let mirrored =
            loads[0].len() == loads[1].len() && pairs.clone().all(|(a, b)| alike(*a, *b));
        let within = loads[0].iter().all(|way| *way < spans[0])
            && loads[1].iter().all(|way| *way < spans[1]);
        if !(alike(spans[0], spans[1]) && mirrored && within) {
            self.report(
                "measuring.load",
                format!(
                    "shear at an inner support of spans of {} and {} mm with loads {:?} and {:?} mm from it; allowed: equal spans \
                     with loads at equal places within them, to {} %",
                    spans[0],
                    spans[1],
                    loads[0],
                    loads[1],
                    100.0 * ALIKE
                ),
                "measure TotalReactions",
            );
        }
    }
}
