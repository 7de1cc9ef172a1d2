//! Artificial viscosity of an interface law, with the energy it swallows.

use std::sync::Arc;

use fe_core::kinematics::Interface;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use nalgebra::Vector3;

use crate::limits::{out_of_range, relaxes};

const LAW: &str = "artificial viscosity";

/// A law whose damage lags behind: per step, only the share `a` of the growth of its history is admitted.
///
/// This is the relaxation of the context, a = dt/(t + dt) for a viscosity time t and steps of dt, written into the
/// law: it stays in the accepted state, unlike that of a driver which returns to the inviscid law. It smooths
/// snaps at the price of strength and energy. What it costs is counted, as the work of the excess of traction over
/// the inviscid law from the same history,
///
/// W += (t_viscous - t_inviscid) . (d - d_n),
///
/// in the internal variable `viscous_energy` (N/mm); its sum over the area should stay below a few per cent of the
/// dissipated energy, and results should not change when the viscosity is halved. The result depends on the length
/// of the steps.
///
/// At a held jump the traction of a softening law relaxes from step to step.
///
/// State: that of the law, then the last jump (mm) and `viscous_energy`.
#[derive(Debug, Clone)]
pub struct Viscous {
    law: Arc<dyn Material<Interface>>,
    share: f64,
    vars: Vec<StateVar>,
}

impl Viscous {
    /// Admits the share `share` in (0, 1] of the growth in a step; 1 changes nothing.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] for a share out of range.
    pub fn new(law: Arc<dyn Material<Interface>>, share: f64) -> Result<Self, MaterialError> {
        if !(share > 0.0 && share <= 1.0) {
            return Err(out_of_range(
                LAW,
                "share",
                share,
                "-",
                "(0, 1]",
                "give the share of growth admitted in a step, dt/(t + dt)",
            ));
        }
        let mut vars = law.state_vars().to_vec();
        vars.push(StateVar::vector("last_jump", "mm", 3));
        vars.push(StateVar::scalar("viscous_energy", "N/mm"));
        Ok(Self { law, share, vars })
    }

    /// The law without viscosity.
    pub const fn law(&self) -> &Arc<dyn Material<Interface>> {
        &self.law
    }

    /// Energy per area (N/mm) that the viscosity has swallowed in a state of this law.
    ///
    /// # Panics
    ///
    /// For a state that is shorter.
    pub fn viscous_energy(&self, state: &[f64]) -> f64 {
        state[self.law.state_len() + 3]
    }
}

impl Material<Interface> for Viscous {
    fn name(&self) -> &'static str {
        self.law.name()
    }

    fn state_vars(&self) -> &[StateVar] {
        &self.vars
    }

    fn init_state(&self, state: &mut [f64]) {
        let (own, rest) = state.split_at_mut(self.law.state_len());
        self.law.init_state(own);
        rest.fill(0.0);
    }

    fn admit(&self, ctx: &PointContext) -> Result<(), MaterialError> {
        self.law.admit(ctx)
    }

    fn update(
        &self,
        jump: &Vector3<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Interface>, MaterialError> {
        relaxes(LAW, ctx.relaxation)?;
        let n = self.law.state_len();
        let (before, rest) = committed.split_at(n);
        let (own, new) = trial.split_at_mut(n);
        let inviscid = PointContext {
            relaxation: 1.0,
            operator: Operator::None,
            ..*ctx
        };
        let target = self.law.update(jump, before, own, &inviscid)?.stress;
        let viscous = PointContext {
            relaxation: self.share * ctx.relaxation,
            ..*ctx
        };
        let response = self.law.update(jump, before, own, &viscous)?;
        let step = jump - Vector3::from_column_slice(&rest[..3]);
        new[..3].copy_from_slice(jump.as_slice());
        new[3] = rest[3] + (response.stress - target).dot(&step);
        Ok(response)
    }

    fn unsymmetric_tangent(&self) -> bool {
        self.law.unsymmetric_tangent()
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        let n = self.law.state_len();
        self.law.latch(&trial[..n], &mut base[..n])
    }

    fn free_energy(&self, jump: &Vector3<f64>, state: &[f64], ctx: &PointContext) -> Option<f64> {
        self.law
            .free_energy(jump, &state[..self.law.state_len()], ctx)
    }

    fn report(&self, jump: &Vector3<f64>, state: &[f64]) -> PointReport {
        self.law.report(jump, &state[..self.law.state_len()])
    }
}
