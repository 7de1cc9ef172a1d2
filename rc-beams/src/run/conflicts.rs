//! Options that contradict each other, or that others leave without effect.

use std::thread;

use fe_elements::HexRule;
use fe_materials::fixed_crack::{CompressionSoftening, ShearTransfer};

use crate::bound;
use crate::build::{ModelSettings, has_law};
use crate::options::{Bond, Cracks, Law, Preset, RunOptions, name};
use crate::results::numerical_error::REFINEMENT;
use crate::spec::Specimen;

/// What is wrong with the options that have led to the `settings` of a specimen, and the remedy; nothing where they fit.
pub(super) fn conflict(
    options: &RunOptions,
    settings: &ModelSettings,
    specimen: &Specimen,
) -> Option<String> {
    without_effect(options, settings)
        .or_else(|| too_few_points(settings))
        .or_else(|| too_fine_a_band(options, settings))
        .or_else(|| too_large(settings, specimen))
        .or_else(|| no_surface(settings, specimen))
}

/// The mesh that edges of sheets and plates need has the limits of one that is asked for.
fn too_large(settings: &ModelSettings, specimen: &Specimen) -> Option<String> {
    let (name, mesh) = (&specimen.name, settings.mesh);
    let refused = mesh.check().err()?;
    Some(format!(
        "the mesh that edges of plates and sheets of {name} need, {mesh}, has {refused}: let edges lie on one another"
    ))
}

/// A surface of onset that is not convex, by options: with the defaults it is, or the specimen is refused.
fn no_surface(settings: &ModelSettings, specimen: &Specimen) -> Option<String> {
    let fits = |tensile_strength_factor: f64| {
        let settings = ModelSettings {
            tensile_strength_factor,
            ..*settings
        };
        has_law(specimen, &settings)
    };
    let (name, factor) = (&specimen.name, settings.tensile_strength_factor);
    if fits(factor) {
        None
    } else if fits(1.0) {
        let allowed = bound::allowed(bound::last(1.0, factor, fits), factor);
        Some(format!(
            "--tensile-strength-factor {factor} does not go with the compressive strength of {name}; allowed: {allowed}"
        ))
    } else if settings.preset != Preset::Physical {
        let strength = specimen.concrete.reported_strength_mpa.get();
        let preset = self::name(&settings.preset);
        Some(format!(
            "--preset {preset} reads the strength of {name}, {strength} MPa, as characteristic, and no convex surface of onset \
             belongs to it: take --preset physical, or give a lower concrete.reported_strength_mpa"
        ))
    } else {
        None
    }
}

/// The finer mesh that an error bar needs has the limits of any other.
fn too_fine_a_band(options: &RunOptions, settings: &ModelSettings) -> Option<String> {
    let finer = settings.mesh.finer(REFINEMENT);
    let refused = options.band.then(|| finer.check().err()).flatten()?;
    Some(format!(
        "--band runs --mesh {finer} too, and that has {refused}: leave --band out, or give a coarser --mesh"
    ))
}

/// Ingredients of a law that is not taken.
fn without_effect(options: &RunOptions, settings: &ModelSettings) -> Option<String> {
    if settings.law != Law::FixedCrack
        && let Some(flag) = given(&options.cracks)
    {
        let law = name(&settings.law);
        return Some(format!(
            "{flag} has no effect with --law {law}: leave it out, or take --law fixed-crack"
        ));
    }
    let cracks = &options.cracks;
    let damage = settings.shear_transfer == ShearTransfer::Damage;
    let no_distance = damage && settings.compression_softening == CompressionSoftening::None;
    let perfect = settings.bond == Bond::Perfect;
    let idle = [
        (
            cracks.aggregate_mm.is_some() && damage,
            "--aggregate-mm",
            "without interlock",
            "--shear-transfer interlock",
        ),
        (
            cracks.crack_spacing_mm.is_some() && no_distance,
            "--crack-spacing-mm",
            "without interlock and softening of struts",
            "--shear-transfer interlock",
        ),
        (
            options.strip_bond.is_some() && perfect,
            "--strip-bond",
            "with perfect bond",
            "--bond cohesive",
        ),
        (
            options.counterfactual && perfect,
            "--counterfactual",
            "with perfect bond",
            "--bond cohesive",
        ),
    ];
    let (_, flag, when, remedy) = idle.into_iter().find(|(idle, ..)| *idle)?;
    Some(format!(
        "{flag} has no effect {when}: leave it out, or take {remedy}"
    ))
}

/// An ingredient of the fixed-crack law that is given: flags are named as their fields are.
fn given(cracks: &Cracks) -> Option<String> {
    let fields = serde_json::to_value(cracks).ok()?;
    let (field, _) = fields.as_object()?.iter().find(|(_, v)| !v.is_null())?;
    Some(format!("--{}", field.replace('_', "-")))
}

/// Eight points are too few for elements that are uniform across the width.
fn too_few_points(settings: &ModelSettings) -> Option<String> {
    let mesh = settings.mesh;
    (mesh.nz.is_none() && settings.integration == HexRule::Reduced).then(|| {
        format!(
            "--mesh {mesh} is uniform across the width, for which reduced integration (--integration reduced, or \
             that of the preset) has too few points: give --mesh {mesh}x1, or --integration irons"
        )
    })
}

/// What can be run and is hardly meant, a line each: options of sheets where none of the `specimens` has any, a law that takes
/// no modulus, and more threads than cores.
pub(crate) fn warnings(specimens: &[Specimen], options: &RunOptions) -> Vec<String> {
    let of_sheets = [
        ("--bond", options.bond != Bond::default()),
        ("--soffit-fibre", options.soffit_fibre.is_some()),
        ("--sheet-shear", options.sheet_shear.is_some()),
        ("--strip-bond", options.strip_bond.is_some()),
        ("--counterfactual", options.counterfactual),
    ];
    let bare = specimens.iter().all(|s| s.sheets.is_none());
    let idle = of_sheets.iter().filter(|(_, given)| bare && *given);
    let idle = idle.map(|(flag, _)| format!("{flag} has no effect on beams without sheets"));
    let cores = thread::available_parallelism().map_or(usize::MAX, usize::from);
    let threads = options.threads.map_or(0, usize::from);
    let crowded = (threads > cores).then(|| {
        format!("--threads {threads} is slower than one per core, of which there are {cores}")
    });
    let law = options.law();
    let stiff = (law != Law::FixedCrack).then(|| {
        let law = name(&law);
        format!("--law {law} takes Young's modulus of the Model Code for the strength, not concrete.young_mpa of the specimens")
    });
    idle.chain(stiff).chain(crowded).collect()
}
