//! What every element does with its integration points: for whoever writes an element. The histories of the
//! points are slices of equal length, one after the other.

use crate::element::{ElementError, EvaluationContext, PointSample};
use crate::kinematics::Kinematics;
use crate::material::{Material, MaterialError, PointContext, Response};

/// Context of a point of the given crack-band width (mm) within an evaluation.
pub const fn context(band_width: f64, ctx: &EvaluationContext) -> PointContext {
    PointContext {
        band_width,
        operator: ctx.operator,
        relaxation: ctx.relaxation,
    }
}

/// Writes the virgin state of every point.
pub fn init_state<K: Kinematics>(law: &dyn Material<K>, state: &mut [f64]) {
    let n = law.state_len();
    if n > 0 {
        for own in state.chunks_exact_mut(n) {
            law.init_state(own);
        }
    }
}

/// Answer of the law at one of the points, whose history is its part of the `committed` and the `trial` one.
///
/// # Errors
///
/// [`ElementError::Material`], naming the point.
pub fn answer<K: Kinematics>(
    law: &dyn Material<K>,
    (point, strain): (usize, &K::Vector),
    (committed, trial): (&[f64], &mut [f64]),
    ctx: &PointContext,
) -> Result<Response<K>, ElementError> {
    let n = law.state_len();
    let own = point * n..(point + 1) * n;
    law.update(strain, &committed[own.clone()], &mut trial[own], ctx)
        .map_err(|source| ElementError::Material { point, source })
}

/// [`Material::latch`] for every point.
pub fn latch<K: Kinematics>(law: &dyn Material<K>, trial: &[f64], base: &mut [f64]) -> bool {
    let n = law.state_len();
    if n == 0 {
        return false;
    }
    let points = trial.chunks_exact(n).zip(base.chunks_exact_mut(n));
    points.fold(false, |any, (t, b)| law.latch(t, b) | any)
}

/// Sum over the points, given as volume (mm3) and strain, of the recoverable energy (N mm): the free energy, or for laws
/// that state none what unloading along the secant gives back, 1/2 sigma : (eps - eps_p).
///
/// # Errors
///
/// [`ElementError::Material`], naming the point.
pub fn free_energy<K: Kinematics>(
    law: &dyn Material<K>,
    band_width: f64,
    state: &[f64],
    points: impl Iterator<Item = (f64, K::Vector)>,
) -> Result<f64, ElementError> {
    let n = law.state_len();
    let ctx = context(band_width, &EvaluationContext::frozen());
    let mut scratch = vec![0.0; n];
    let mut rest = state;
    let mut numbered = points.enumerate();
    numbered.try_fold(0.0, |sum, (point, (volume, strain))| {
        let (own, tail) = rest.split_at(n);
        rest = tail;
        let density = match law.free_energy(&strain, own, &ctx) {
            Some(stated) => stated,
            None => along_secant(law, &strain, (own, &mut scratch), &ctx)
                .map_err(|source| ElementError::Material { point, source })?,
        };
        Ok(sum + volume * density)
    })
}

/// Whether every point, given by its strain, unloads along its secant to the origin: the [`free_energy`] of an element is
/// then half the product of its forces and displacements.
pub fn unload_to_origin<K: Kinematics>(
    law: &dyn Material<K>,
    band_width: f64,
    state: &[f64],
    strains: &[K::Vector],
) -> bool {
    let n = law.state_len();
    let ctx = context(band_width, &EvaluationContext::frozen());
    strains.iter().enumerate().all(|(point, strain)| {
        let own = &state[point * n..(point + 1) * n];
        law.free_energy(strain, own, &ctx).is_none()
            && law.report(strain, own).plastic_strain == [0.0; 6]
    })
}

/// 1/2 sigma : (eps - eps_p).
fn along_secant<K: Kinematics>(
    law: &dyn Material<K>,
    strain: &K::Vector,
    (state, scratch): (&[f64], &mut [f64]),
    ctx: &PointContext,
) -> Result<f64, MaterialError> {
    let stress = law.update(strain, state, scratch, ctx)?.stress;
    let plastic = law.report(strain, state).plastic_strain;
    let parts = K::components(&stress).iter().zip(K::components(strain));
    let whole: f64 = parts.map(|(s, e)| s * e).sum();
    let parts = K::components(&stress).iter().zip(&plastic);
    let lost: f64 = parts.map(|(s, e)| s * e).sum();
    Ok(0.5 * (whole - lost))
}

/// Shows every point, given as position (mm), volume (mm3) and strain, with the stress of a committed state.
///
/// # Errors
///
/// [`ElementError::Material`], naming the point.
pub fn sample<K: Kinematics>(
    law: &dyn Material<K>,
    band_width: f64,
    state: &[f64],
    points: impl Iterator<Item = ([f64; 3], f64, K::Vector)>,
    visit: &mut dyn FnMut(PointSample<'_>),
) -> Result<(), ElementError> {
    let n = law.state_len();
    let ctx = context(band_width, &EvaluationContext::frozen());
    let points: Vec<_> = points.collect();
    let strains: Vec<K::Vector> = points.iter().map(|p| p.2).collect();
    let mut scratch = vec![0.0; n * points.len()];
    law.update_many(&strains, (state, &mut scratch), &ctx, &mut |p, response| {
        let (position, volume, strain) = &points[p];
        let own = &state[p * n..(p + 1) * n];
        visit(PointSample {
            position: *position,
            volume: *volume,
            strain: K::components(strain),
            stress: K::components(&response.stress),
            report: law.report(strain, own),
            state_vars: law.state_vars(),
            state: own,
        });
    })
    .map_err(|(point, source)| ElementError::Material { point, source })
}
