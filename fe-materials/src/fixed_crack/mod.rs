//! Orthogonal smeared cracks, fixed once they have opened some way, with irreversible shear transfer: the default law of the beams.
//!
//! **Uncracked**, the law is isotropic. With the equivalent uniaxial strains of the principal strains e and the stiffness C of
//! isotropic elasticity,
//!
//! $$ \tilde e_i = \sum_j Q_{ij} e_j, \qquad Q = \frac{C(E, \nu)}{E}, \qquad
//! \sigma_i = \begin{cases} E \tilde e_i & \tilde e_i \ge 0 \cr
//! E_c(k_{c,i}) \tilde e_i & \tilde e_i < 0, \end{cases} $$
//!
//! Ec being the secant of the compression envelope at kc_i, the largest -e~_i/K_i ever. K_i >= 1 is the
//! [confinement](Confinement) by the pressures on the other axes, p_j = Ec <-e~_j> as if nothing confined those: it makes
//! concrete stronger by slowing the history down, so that pressure which comes and goes alone creates no energy. Where
//! the secants of two axes differ the moduli E_i Q_ij are not symmetric and the stress has no potential: strains that go round
//! a loop in compression take or give energy with every round, 4 % of the work of loading round one whose corners are 0, 2 per
//! mille along, and 2.5 along with an extension of 0.3 across; 6 % in the worst that was found, in crushed concrete. A crack
//! ends that. The histories go by the rank of the strains: where two principal strains pass one another, the stresses of the two
//! axes change places, a jump where their histories differ.
//!
//! **Onset.** A crack opens when sigma_1 >= ft, or when the Ottosen surface is reached with
//! sigma_1 >= ft/2 (CEB Bulletin 156). Its normal n, the principal axis, then freezes, and Poisson's ratio is zero. The
//! axes s and t in its plane stay principal there until a second crack opens across one of them, at a strain of ft/E. The stress
//! jumps with Poisson's ratio, and where tension and compression stand together its energy may rise: strains that go straight back
//! to zero give up to ft^2/(2E) more than they took, 2 % of G_F/h where h is 20 mm.
//!
//! With a fixing share less than one all axes go on following the strain, one history kc serving the three, while the crack bridges
//! more than that share of its strength, there is no second crack, and the stresses in the axes are in the order of the strains
//! (between the fixed and the rotating crack, Cervenka 1985).
//!
//! **Cracked**, in these axes, with the histories kt_i = max e_i and kc_i = max(-e_i/K_i), p_j = Ec <-e_j>,
//!
//! $$ \sigma_i = \begin{cases} E_t(k_{t,i}) e_i & e_i \ge 0 \cr
//! \beta_i E_c(k_{c,i}) e_i & e_i < 0, \end{cases} \qquad
//! \tau = b G_0 \gamma, \qquad
//! b = \max\left(b_{min}, \min\left(\min_i \frac{E_t(k_{t,i})}{E}, \min_j \frac{E_c(k_{c,j})}{E}\right)\right), $$
//!
//! i being all axes for the shear across the first crack (components ns and nt), s and t for the shear in its plane (st), and j
//! all axes in both; b is more where aggregate interlocks, see [`ShearTransfer`], which limits the stress too. beta_i <= 1 is the
//! [compression softening](CompressionSoftening) by the cracks across axis i. While s and t turn, one history kc serves both.
//!
//! The share of the elastic shear that is carried is a history variable too and never grows. So every term of the free
//! energy
//!
//! $$ \psi = \tfrac12 \sum_i E_{sec,i} e_i^2 + \tfrac12 \sum b G_0 \gamma^2 $$
//!
//! falls with growing history at fixed strain, and the cracked law never creates energy. Taking b from the current secant
//! instead would: when a crack closes the factor jumps back to one with a large shear strain standing.
//!
//! The growth of the histories in a step is scaled by the relaxation a of the context (backward Euler of
//! k' = <e - k>/tau, a = dt/(tau + dt)). That a crack opens, or is fixed by a second one, is no growth: it happens at any a.

mod compression_softening;
mod confinement;
mod cracked;
mod curves;
mod following;
mod parameters;
mod shear;
mod shear_transfer;
mod state;
mod uncracked;

#[cfg(test)]
mod tests;

use fe_core::kinematics::Solid;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use fe_core::principal::{Principal, principal, principal_of_many};
use fe_core::voigt::{strain_components, strain_into, strain_tensor};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

pub use compression_softening::CompressionSoftening;
pub use confinement::Confinement;
pub use curves::TensionSoftening;
use curves::{Compression, Tension};
pub(crate) use parameters::CRUSHING_OVER_FRACTURE;
use parameters::out_of_range;
pub use parameters::{AGGREGATE_MM, CRACK_SPACING_MM, FIXING_SHARE, FixedCrackParameters};
pub use shear_transfer::ShearTransfer;
use state::{STATE_VARS, State};

const NAME: &str = "fixed crack";

/// Relative difference of strengths that are the same but for rounding.
const SAME_STRENGTH: f64 = 1e-9;

/// Points whose principal strains are found together: those of a fully integrated hexahedron.
const TOGETHER: usize = 27;

/// Smallest modulus of the secant operator, relative to E: keeps the operator positive definite where the
/// envelope has dropped to zero. It does not enter the stress.
const OPERATOR_FLOOR: f64 = 1e-4;

/// The fixed-crack law, see the [module documentation](self).
#[derive(Debug, Clone, PartialEq)]
pub struct FixedCrack {
    p: FixedCrackParameters,
    shear_modulus: f64,
    onset: Option<crate::concrete::Ottosen>,
}

impl FixedCrack {
    /// Response of a point, with its principal strains if they are known; an operator that is not asked for stays as it
    /// is.
    fn respond(
        &self,
        strain: &Vector6<f64>,
        (committed, trial): (&[f64], &mut [f64]),
        ctx: &PointContext,
        (envelopes, known): (&Envelopes, Option<&Principal>),
        out: &mut Response<Solid>,
    ) -> Result<(), MaterialError> {
        crate::limits::finite(NAME, strain)?;
        let mut state = State::read(committed);
        let onset = !state.cracked;
        let intact = onset && {
            let found = principal_strains(strain, known);
            self.uncracked(found, &mut state, (ctx, envelopes), out)
        };
        if !intact {
            self.cracked((strain, known), &mut state, (ctx, envelopes), onset, out)?;
        }
        state.write(trial);
        Ok(())
    }

    /// A law with Rankine onset and, where `onset` is given, Ottosen onset: a surface of the same strength.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`].
    pub fn new(
        p: FixedCrackParameters,
        onset: Option<crate::concrete::Ottosen>,
    ) -> Result<Self, MaterialError> {
        p.check()?;
        let other = onset.as_ref().map(crate::concrete::Ottosen::strength);
        if let Some(other) = other.filter(|f| (f / p.fcm_mpa - 1.0).abs() > SAME_STRENGTH) {
            let allowed = format!("[{other}, {other}], the strength of the surface of onset");
            return Err(out_of_range("fcm_mpa", p.fcm_mpa, "MPa", &allowed));
        }
        Ok(Self {
            p,
            shear_modulus: p.young_mpa / (2.0 * (1.0 + p.poisson)),
            onset,
        })
    }

    /// The parameters.
    pub const fn parameters(&self) -> &FixedCrackParameters {
        &self.p
    }

    /// Strains per axis from which softening starts.
    fn strains_at_onset(&self, onset: f64) -> [f64; 3] {
        let other = self.p.ft_mpa / self.p.young_mpa;
        [onset / self.p.young_mpa, other, other]
    }

    fn envelopes(&self, ctx: &PointContext) -> Result<Envelopes, MaterialError> {
        let (band_width, relaxation) = (ctx.band_width, ctx.relaxation);
        if !(band_width.is_finite() && band_width > 0.0) {
            return Err(out_of_range("band_width", band_width, "mm", "(0, inf)"));
        }
        crate::limits::relaxes(NAME, relaxation)?;
        Ok(Envelopes {
            tension: Tension::new(&self.p, self.p.ft_mpa, band_width)?,
            compression: Compression::new(&self.p, band_width)?,
        })
    }

    /// Tension across the axes of a cracked point.
    fn tension(
        &self,
        state: &State,
        envelopes: &Envelopes,
        band_width: f64,
    ) -> Result<[Tension; 3], MaterialError> {
        let other = envelopes.tension;
        let first = if state.onset == self.p.ft_mpa {
            other
        } else {
            Tension::new(&self.p, state.onset, band_width)?
        };
        Ok([first, other, other])
    }
}

/// Envelopes of all points of a crack-band width: tension from the tensile strength, and compression.
#[derive(Debug, Clone, Copy)]
struct Envelopes {
    tension: Tension,
    compression: Compression,
}

impl Material<Solid> for FixedCrack {
    fn name(&self) -> &'static str {
        NAME
    }

    fn state_vars(&self) -> &[StateVar] {
        &STATE_VARS
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        let envelopes = self.envelopes(ctx)?;
        let mut response = blank();
        let states = (committed, trial);
        self.respond(strain, states, ctx, (&envelopes, None), &mut response)?;
        Ok(response)
    }

    /// Principal strains of the points whose axes are not fixed are found together.
    fn update_many(
        &self,
        strains: &[Vector6<f64>],
        (committed, trial): (&[f64], &mut [f64]),
        ctx: &PointContext,
        take: &mut dyn FnMut(usize, &Response<Solid>),
    ) -> Result<(), (usize, MaterialError)> {
        let envelopes = self.envelopes(ctx).map_err(|error| (0, error))?;
        let n = self.state_len();
        let state = |p: usize| p * n..(p + 1) * n;
        let mut response = blank();
        for start in (0..strains.len()).step_by(TOGETHER) {
            let end = strains.len().min(start + TOGETHER);
            let turns = |p: &usize| !State::is_fixed(&committed[state(*p)]);
            let mut tensors = [Vector6::zeros(); TOGETHER];
            let mut found = [(Vector3::zeros(), Matrix3::zeros()); TOGETHER];
            let mut count = 0;
            for p in (start..end).filter(turns) {
                tensors[count] = strain_components(&strains[p]);
                count += 1;
            }
            principal_of_many(&tensors[..count], &mut found);
            let mut next = found.iter();
            for p in start..end {
                let axes = if turns(&p) { next.next() } else { None };
                let states = (&committed[state(p)], &mut trial[state(p)]);
                self.respond(&strains[p], states, ctx, (&envelopes, axes), &mut response)
                    .map_err(|error| (p, error))?;
                take(p, &response);
            }
        }
        Ok(())
    }

    fn admit(&self, ctx: &PointContext) -> Result<(), MaterialError> {
        self.envelopes(ctx).map(drop)
    }

    fn unsymmetric_tangent(&self) -> bool {
        true
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        // Opening, fixing and a second crack.
        if trial[0] <= base[0] {
            return false;
        }
        let (found, mut kept) = (State::read(trial), State::read(base));
        if found.cracked && !kept.cracked {
            kept.onset = found.onset;
            kept.shares = [1.0; 2];
            kept.kt = self.strains_at_onset(found.onset);
        }
        (kept.cracked, kept.fixed, kept.second) = (found.cracked, found.fixed, found.second);
        kept.axes = found.axes;
        kept.write(base);
        true
    }

    fn free_energy(&self, strain: &Vector6<f64>, state: &[f64], ctx: &PointContext) -> Option<f64> {
        let state = State::read(state);
        state
            .cracked
            .then(|| self.cracked_energy(strain, &state, ctx))
            .flatten()
    }

    fn report(&self, strain: &Vector6<f64>, state: &[f64]) -> PointReport {
        let state = State::read(state);
        let crushing = state.crushing;
        if !state.cracked {
            return PointReport {
                crushing,
                ..PointReport::default()
            };
        }
        let local = strain_into(&state.axes, strain);
        // What the strain has beyond that at the onset.
        let opening: Vector3<f64> =
            local.fixed_rows::<3>(0) - Vector3::from(self.strains_at_onset(state.onset));
        let (axis, crack_strain) = opening.argmax();
        PointReport {
            crack_strain: crack_strain.max(0.0),
            crack_normal: state.axes.column(axis).into_owned().into(),
            crushing,
            ..PointReport::default()
        }
    }
}

/// Principal strains, found unless they are known.
fn principal_strains(strain: &Vector6<f64>, known: Option<&Principal>) -> Principal {
    known
        .copied()
        .unwrap_or_else(|| principal(&strain_tensor(strain)))
}

/// A response to fill.
fn blank() -> Response<Solid> {
    Response {
        stress: Vector6::zeros(),
        tangent: Matrix6::zeros(),
    }
}

/// Whether the operator is the secant one.
fn wants_secant(ctx: &PointContext) -> bool {
    ctx.operator == Operator::Secant
}

/// Whether the operator is the consistent tangent.
fn wants_tangent(ctx: &PointContext) -> bool {
    ctx.operator == Operator::Tangent
}
