//! Protects the models: what the elements hold must be what the specimen says.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;
use fe_core::state::StateStore;
use fe_solver::control::StepControl;
use fe_solver::recorder::Silent;
use fe_solver::secant::SecantAnderson;
use fe_solver::stage::Stage;

use super::{BarKind, Beam, BuildError, ModelSettings};
use crate::options::{Law, MeshSize, Preset};
use crate::spec::{BUILTIN, Specimen, read};

fn specimen(name: &str) -> Specimen {
    let (_, text) = BUILTIN.iter().find(|(n, _)| *n == name).unwrap();
    read(name, text).unwrap()
}

fn beam(name: &str) -> Beam {
    let specimen = specimen(name);
    Beam::new(&specimen, &ModelSettings::new(Preset::Physical, &specimen)).unwrap()
}

/// specimens.md: a beam of series A weighs 3.477 kN, carried by its supports before loading.
#[test]
fn the_supports_carry_the_weight() {
    let beam = beam("A-SO3-1");
    let mut state = StateStore::new(beam.model.elements());
    let zero = vec![0.0; beam.model.dofs().len()];
    let mut stage = Stage::new(&beam.model, beam.weight.clone(), &mut state, zero).unwrap();
    let mut driver = SecantAnderson::default();
    StepControl::new(1.0, 1.0)
        .run(&mut stage, &mut driver, &mut Silent)
        .unwrap();
    let reactions = beam.measures.reactions(|d| stage.reaction(d));
    let weight = 2.0 * reactions.iter().sum::<f64>();
    assert!((weight - 3477.0).abs() < 1.0, "{weight}");
    assert!((beam.measures.load_kn(&reactions) - 3.477).abs() < 1e-3);
}

/// Two bars given as one entry resist like two entries, along and, by their dowels, across. Target: rounding.
#[test]
fn bars_in_one_place_add_up() {
    let mut twice = specimen("A-SO3-1");
    let mut copy = twice.bars[1].clone();
    copy.name.push_str(" again");
    let mut double = twice.clone();
    twice.bars.push(copy);
    double.bars[1].count_in_half = 2.try_into().unwrap();
    let force = |specimen: &Specimen| {
        let beam = Beam::new(specimen, &ModelSettings::new(Preset::Physical, specimen)).unwrap();
        let mut state = StateStore::new(beam.model.elements());
        let moved: Vec<f64> = (0..beam.model.dofs().len())
            .map(|d| (d as f64).sin())
            .collect();
        let weight = beam.weight.clone();
        let mut stage = Stage::new(&beam.model, weight, &mut state, moved.clone()).unwrap();
        stage
            .residual(&moved, 0.0, &EvaluationContext::new(Operator::None))
            .unwrap()
    };
    let (twice, double) = (force(&twice), force(&double));
    let largest = twice.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    for (a, b) in twice.iter().zip(&double) {
        assert!((a - b).abs() < 1e-12 * largest, "{a} {b}");
    }
}

/// Every specimen builds on its mesh: full columns of concrete, no more than in an even grid (and a stub), bars of the
/// full length cut once at every face, a gauge on every stirrup of the test span and wherever the specimen has one on its sheets.
#[test]
fn every_specimen_builds() {
    for (name, _) in BUILTIN {
        let (specimen, beam) = (specimen(name), beam(name));
        let stubs = specimen.supports.iter().any(|s| s.stub.is_some());
        let MeshSize { nx, ny, nz } = super::default_mesh(&specimen, Preset::Physical);
        let nz = nz.unwrap_or(1);
        let columns = beam.concrete.len() / (ny * nz);
        let whole = columns <= nx && beam.concrete.len() == columns * ny * nz;
        assert!(2 * columns > nx && (stubs || whole), "{name}");
        for bar in &beam.bars {
            let [a, b] = bar.ends;
            let expected: f64 = (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f64>().sqrt();
            let mut volume = 0.0;
            for e in bar.elements.clone() {
                let element = &beam.model.elements()[e];
                let mut state = vec![0.0; element.state_len()];
                element.init_state(&mut state);
                let zero = vec![0.0; 3 * element.nodes().len()];
                element
                    .sample(&zero, &state, &mut |s| volume += s.volume)
                    .unwrap();
            }
            let area = match bar.kind {
                BarKind::Longitudinal => specimen.bars[0].area_mm2.get(),
                _ => specimen.stirrups.as_ref().unwrap().area_mm2.get(),
            };
            assert!(
                (volume / area - expected).abs() < 1e-6 * expected,
                "{name} {}",
                bar.name
            );
        }
        let span = &specimen.measuring.test_span;
        let inside = |b: &&super::BarRecord| {
            matches!(b.kind, BarKind::StirrupLeg(x)
                if (span.x_from_mm.get()..=span.x_to_mm.get()).contains(&x))
        };
        let stirrups = beam.bars.iter().filter(inside).count();
        let longitudinal = specimen.bars.len() * (specimen.loads.len() + 1);
        let sheets = specimen.measuring.sheet_gauges.len();
        assert_eq!(
            beam.gauges.len(),
            stirrups + longitudinal + sheets,
            "{name}"
        );
    }
}

/// The load of series B is the shear force at the inner support: half of all reactions less the end
/// reaction, doubled for the whole width.
#[test]
fn the_shear_force_of_series_b_is_read_from_reactions() {
    let measures = beam("B-CO1").measures;
    let v = measures.load_kn(&[10e3, 60e3, 12e3]);
    assert!((v - 2.0 * (41.0 - 12.0)).abs() < 1e-12);
}

/// A mesh that cannot hold the plates is refused with a number of elements that can.
#[test]
fn too_few_elements_are_refused() {
    let specimen = specimen("A-SO3-1");
    let settings = ModelSettings {
        mesh: [9, 4, 1].into(),
        ..ModelSettings::new(Preset::Physical, &specimen)
    };
    let error = Beam::new(&specimen, &settings).unwrap_err();
    let BuildError::TooFewElements { least, .. } = error else {
        panic!("{error}");
    };
    let settings = ModelSettings {
        mesh: [least.unwrap(), 4, 1].into(),
        ..settings
    };
    assert!(Beam::new(&specimen, &settings).is_ok());
}

/// materials.md, section 1: the reference reads the reported strength as the characteristic one, 27.5 MPa of A-SO3-1, with
/// fcm = 35.5 and fctm = 2.733231 MPa; the default reads it as the mean.
#[test]
fn the_reference_reads_strengths_as_its_source_does() {
    let specimen = specimen("A-SO3-1");
    for (preset, mean) in [
        (Preset::Physical, 27.5),
        (Preset::Reference, 35.5),
        (Preset::Characteristic, 35.5),
    ] {
        let settings = ModelSettings::new(preset, &specimen);
        let fcm = super::laws::mean_strength(&specimen, &settings).unwrap();
        assert!((fcm - mean).abs() < 1e-12, "{preset:?} {fcm}");
    }
    let settings = ModelSettings::new(Preset::Reference, &specimen);
    assert_eq!((settings.law, settings.dowel), (Law::Reference, false));
    let fctm = super::laws::tensile_strength(&specimen, &settings).unwrap();
    assert!((fctm - 2.733_231).abs() < 1e-6, "{fctm}");
}

/// The tensile strength is that of the report, 2.7 MPa of A-SO3-1, and without one that of fib Model Code 2010, 5.1.5.1, for
/// fck = 27.5 - 8: 2.173423 MPa.
#[test]
fn a_tensile_strength_that_is_reported_counts() {
    let mut specimen = specimen("A-SO3-1");
    let settings = ModelSettings::new(Preset::Physical, &specimen);
    let fctm = |specimen: &Specimen| super::laws::tensile_strength(specimen, &settings).unwrap();
    assert_eq!(fctm(&specimen), 2.7);
    specimen.concrete.reported_tensile_mpa = None;
    assert!((fctm(&specimen) - 2.173_423).abs() < 1e-6);
}
