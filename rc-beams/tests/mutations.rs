//! Specimen files spoilt at random.
//!
//! Protects users from typing errors: of 300 spoilt files each is refused with a message and a place in the file, or
//! refused when the model is built, or gives a beam in equilibrium. Never a panic, a hang or a number that is none.

use std::io;

use fe_core::testing::Random;
use fe_solver::recorder::{Continue, IterationRecord, StepView};
use fe_solver::secant::SecantAnderson;
use miette::Diagnostic;
use rc_beams::analysis::{Observer, Reading, Stepping, analyse};
use rc_beams::build::{Beam, ModelSettings};
use rc_beams::options::Preset;
use rc_beams::spec::{self, Specimen};

/// Byte ranges of the numbers of a text.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let digit = |c: char| c.is_ascii_digit() || c == '.';
    let mut found = Vec::new();
    let mut from = 0;
    for (at, value) in text.match_indices(": ") {
        let start = at + value.len();
        let rest = &text[start..];
        let length = rest.find(|c| !digit(c)).unwrap_or(rest.len());
        if length > 0 && start >= from {
            found.push((start, start + length));
            from = start + length;
        }
    }
    found
}

/// Spoils a text in one place.
fn spoil(text: &str, chance: &mut Random) -> String {
    let places = numbers(text);
    let (a, b) = places[chance.below(places.len())];
    let value: f64 = text[a..b].parse().unwrap_or(1.0);
    let with = |number: &str| format!("{}{number}{}", &text[..a], &text[b..]);
    let mut lines: Vec<&str> = text.lines().collect();
    let line = chance.below(lines.len());
    match chance.below(10) {
        0 | 1 => {
            let odd = [
                "0", "-1", "1e308", "NaN", "inf", "-inf", "1e-300", "", "abc", "1,5",
            ];
            with(odd[chance.below(odd.len())])
        }
        2 | 3 => {
            let factor = [-1.0, 0.1, 0.5, 0.9, 1.1, 2.0, 10.0][chance.below(7)];
            with(&(value * factor).to_string())
        }
        4 => {
            let (c, d) = places[chance.below(places.len())];
            let other = text[c..d].to_owned();
            with(&other)
        }
        5 => {
            lines.remove(line);
            lines.join("\n")
        }
        6 => {
            lines.insert(line, lines[line]);
            lines.join("\n")
        }
        7 => {
            let other = chance.below(lines.len());
            lines.swap(line, other);
            lines.join("\n")
        }
        8 => text[..cut(text, chance)].to_owned(),
        _ => {
            let (before, after) = text.split_at(cut(text, chance));
            let odd = ["(", ")", "x", ",", "\"", ":", "[", "é"][chance.below(8)];
            format!("{before}{odd}{after}")
        }
    }
}

/// A place between two characters.
fn cut(text: &str, chance: &mut Random) -> usize {
    let mut at = chance.below(text.len());
    while !text.is_char_boundary(at) {
        at += 1;
    }
    at
}

/// Watches that a run ends, and that all it says are numbers.
#[derive(Default)]
struct Sober {
    iterations: usize,
    steps: usize,
}

impl Sober {
    fn look(reading: &Reading) {
        let all = [reading.deflection_mm, reading.load_kn];
        assert!(
            all.iter()
                .chain(&reading.reactions_kn)
                .chain(&reading.loads_kn)
                .all(|v| v.is_finite())
        );
    }
}

impl Observer for Sober {
    fn weight(&mut self, _: &StepView<'_>, reading: &Reading) -> io::Result<()> {
        Self::look(reading);
        Ok(())
    }

    fn iteration(&mut self, _: &IterationRecord) -> io::Result<()> {
        self.iterations += 1;
        assert!(self.iterations < 5000, "does not end");
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>, _: usize, reading: &Reading) -> io::Result<Continue> {
        Self::look(reading);
        assert!(view.flagged || view.residual <= 1e-3);
        self.steps += 1;
        Ok(Continue::Yes)
    }
}

/// How a spoilt file ends.
#[derive(Debug, Default)]
struct Ends {
    refused: usize,
    not_built: usize,
    run: usize,
    not_run: usize,
}

/// Two short steps under load; the reactions carry the weight of the beam.
fn run(specimen: &Specimen, beam: &Beam, ends: &mut Ends) {
    let stepping = Stepping {
        initial_mm: 0.02,
        longest_share: 0.0,
        until_mm: 0.05,
        to_the_end: true,
        criterion: 1e-3,
    };
    let mut sober = Sober::default();
    let mut driver = SecantAnderson::default();
    match analyse(beam, None, &stepping, &mut driver, &mut sober) {
        Ok(outcome) => {
            ends.run += 1;
            assert!(outcome.stop.is_ok() && sober.steps >= 2);
            let section = specimen.beam.width_mm.get() * specimen.beam.height_mm.get();
            let volume = 1e-9 * section * specimen.beam.length_mm.get();
            let density = specimen.concrete.density_kg_m3.get();
            let gravity = specimen.gravity.acceleration_m_s2.get();
            let weight = 1e-3 * volume * density * gravity;
            let carried = outcome.self_weight_kn;
            // Column stubs of series B weigh 3 % of the beam.
            let over = carried / weight - 1.0;
            assert!((-2e-3..0.05).contains(&over), "{carried} kN of {weight}");
        }
        Err(error) => {
            ends.not_run += 1;
            assert!(error.to_string().len() > 20);
        }
    }
}

#[test]
fn spoilt_files_are_refused_or_give_a_beam_in_equilibrium() {
    let mut ends = Ends::default();
    for (name, mesh) in [
        ("A-SO3-1", [16, 2, 1]),
        ("B-CW1", [20, 2, 1]),
        ("A-SO4-2", [47, 2, 1]),
    ] {
        let path = format!("{}/specimens/{name}.ron", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        for seed in 0..100 {
            let spoilt = spoil(&text, &mut Random::new(seed));
            match spec::read(name, &spoilt) {
                Err(errors) => {
                    ends.refused += 1;
                    assert!(!errors.is_empty());
                    for error in errors {
                        assert!(!error.to_string().is_empty());
                        let mut places = error.labels().into_iter().flatten();
                        assert!(places.all(|place| place.offset() <= spoilt.len()));
                    }
                }
                Ok(specimen) => {
                    let mut settings = ModelSettings::new(Preset::Physical, &specimen);
                    settings.mesh = mesh.into();
                    match Beam::new(&specimen, &settings) {
                        Err(error) => {
                            ends.not_built += 1;
                            assert!(error.to_string().len() > 20);
                        }
                        Ok(beam) => run(&specimen, &beam, &mut ends),
                    }
                }
            }
        }
    }
    println!("{ends:?}");
    assert!(ends.refused > 100 && ends.run > 30, "{ends:?}");
}
