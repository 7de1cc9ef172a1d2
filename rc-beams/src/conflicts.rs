//! Options that contradict each other, or that others leave without effect.

use crate::options::{Cracks, Integration, Law, Preset, RunOptions, ShearTransfer, name};

/// What is wrong with the options together, and the remedy; nothing where they fit.
pub fn conflict(options: &RunOptions) -> Option<String> {
    without_effect(options).or_else(|| too_few_points(options))
}

/// Ingredients of a law that is not taken.
fn without_effect(options: &RunOptions) -> Option<String> {
    let cracks = &options.cracks;
    if options.law != Law::FixedCrack {
        let (flag, law) = (given(cracks)?, name(&options.law));
        return Some(format!(
            "{flag} has no effect with --law {law}: leave it out, or take --law fixed-crack"
        ));
    }
    let transfer = cracks.shear_transfer.unwrap_or(match options.preset {
        Preset::Characteristic => ShearTransfer::Damage,
        Preset::Physical | Preset::Reference => ShearTransfer::Interlock,
    });
    let idle = cracks.aggregate_mm.is_some() && transfer == ShearTransfer::Damage;
    idle.then(|| {
        "--aggregate-mm has no effect without interlock: leave it out, or take --shear-transfer \
         interlock"
            .into()
    })
}

/// First ingredient of the fixed-crack law that is given.
fn given(cracks: &Cracks) -> Option<&'static str> {
    let Cracks {
        tension_softening,
        shear_transfer,
        compression_softening,
        confinement,
        crack_spacing_mm,
        fixing_share,
        shear_floor,
        band_factor,
        fracture_energy_factor,
        crushing_energy_factor,
        aggregate_mm,
    } = cracks;
    let flags = [
        ("--tension-softening", tension_softening.is_some()),
        ("--shear-transfer", shear_transfer.is_some()),
        ("--compression-softening", compression_softening.is_some()),
        ("--confinement", confinement.is_some()),
        ("--crack-spacing-mm", crack_spacing_mm.is_some()),
        ("--fixing-share", fixing_share.is_some()),
        ("--shear-floor", shear_floor.is_some()),
        ("--band-factor", band_factor.is_some()),
        ("--fracture-energy-factor", fracture_energy_factor.is_some()),
        ("--crushing-energy-factor", crushing_energy_factor.is_some()),
        ("--aggregate-mm", aggregate_mm.is_some()),
    ];
    flags.into_iter().find_map(|(flag, is)| is.then_some(flag))
}

/// Eight points are too few for elements that are uniform across the width.
fn too_few_points(options: &RunOptions) -> Option<String> {
    let mesh = options.mesh.filter(|mesh| mesh.nz.is_none())?;
    let of_preset = match options.preset {
        Preset::Characteristic => Integration::Reduced,
        Preset::Physical | Preset::Reference => Integration::Irons,
    };
    let integration = options.integration.unwrap_or(of_preset);
    (integration == Integration::Reduced).then(|| {
        format!(
            "--mesh {mesh} is uniform across the width, for which reduced integration (--integration reduced, or \
             --preset characteristic without another) has too few points: give --mesh {mesh}x1, or --integration irons"
        )
    })
}
