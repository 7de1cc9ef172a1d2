//! The isotropic branch and the onset of the first crack.

use fe_core::kinematics::Solid;
use fe_core::material::{Operator, PointContext, Response};
use fe_core::principal::Principal;
use fe_core::voigt::{SHEAR_PAIRS, isotropic, strain_transform, stress_along};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::confinement::Pressed;
use super::curves::Compression;
use super::{Envelopes, FixedCrack, OPERATOR_FLOOR, State, wants_secant};

impl FixedCrack {
    /// Stress of the uncracked point of known principal strains, or `false` when a crack opens: the state then holds its axes.
    pub(super) fn uncracked(
        &self,
        (e, axes): Principal,
        state: &mut State,
        (ctx, envelopes): (&PointContext, &Envelopes),
        out: &mut Response<Solid>,
    ) -> bool {
        let compression = &envelopes.compression;
        let nu = self.p.poisson;
        let (q1, q2) = (
            (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)),
            nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
        );
        let equivalent: Vector3<f64> = e.map(|ei| (q1 - q2) * ei) + Vector3::repeat(q2 * e.sum());
        let committed_kc = state.kc;
        let mut secant = [self.p.young_mpa; 3];
        let mut by_kc = [0.0; 3];
        let strains = Pressed {
            e: equivalent.as_ref(),
            kc: &committed_kc,
            driven: [0, 1, 2],
            relaxation: ctx.relaxation,
        };
        let grown = self.pressed(&strains, compression);
        for i in 0..3 {
            if equivalent[i] < 0.0 {
                state.kc[i] = grown[i];
                (secant[i], by_kc[i]) = compression.secant(grown[i]);
            }
        }
        let stress = Vector3::from_fn(|i, _| secant[i] * equivalent[i]);
        if let Some(onset) = self.onset_stress(&stress) {
            state.cracked = true;
            state.axes = axes;
            state.onset = onset;
            state.kt = self.strains_at_onset(onset);
            state.shares = [1.0; 2];
            state.kc = committed_kc;
            return false;
        }
        for k in state.kc {
            state.crushing = state.crushing.max(compression.crushing(k));
        }
        out.stress = stress_along(&axes, &stress);
        if ctx.operator != Operator::None {
            if equivalent.min() >= 0.0 {
                // Nothing is compressed: linear elasticity, whatever the axes.
                out.tangent = isotropic(self.p.young_mpa, nu);
                return true;
            }
            let t = strain_transform(&axes);
            let mut d = Matrix6::zeros();
            let q = |i, j| if i == j { q1 } else { q2 };
            // Derivatives of the stresses with respect to the equivalent strains, or moduli.
            let mut slopes = Matrix3::from_diagonal(&Vector3::from(secant));
            if !wants_secant(ctx) {
                slopes += self.growth_slopes(&strains, compression, &by_kc);
            }
            for i in 0..3 {
                for j in 0..3 {
                    d[(i, j)] = if wants_secant(ctx) {
                        let floor = OPERATOR_FLOOR * self.p.young_mpa;
                        (secant[i].max(floor) * secant[j].max(floor)).sqrt() * q(i, j)
                    } else {
                        (0..3).map(|l| slopes[(i, l)] * q(l, j)).sum()
                    };
                }
            }
            for (k, (i, j)) in SHEAR_PAIRS.into_iter().enumerate() {
                let gap = e[i] - e[j];
                let scale = e.amax().max(1e-12);
                // Rotation of the axes: (s_i - s_j)/(2 (e_i - e_j)), its limit for equal strains.
                let g = if gap.abs() > 1e-6 * scale {
                    (stress[i] - stress[j]) / (2.0 * gap)
                } else {
                    let [a, b] = [(i, j), (j, i)].map(|(i, j)| slopes[(i, i)] - slopes[(i, j)]);
                    0.5 * (q1 - q2) * a.midpoint(b)
                };
                d[(3 + k, 3 + k)] = if wants_secant(ctx) {
                    g.max(OPERATOR_FLOOR * self.shear_modulus)
                } else {
                    g
                };
            }
            out.tangent = t.tr_mul(&d) * t;
        }
        true
    }

    /// What growing histories add to the derivatives of the stresses with respect to the equivalent strains.
    #[inline(never)]
    fn growth_slopes(
        &self,
        strains: &Pressed<'_>,
        compression: &Compression,
        by_kc: &[f64; 3],
    ) -> Matrix3<f64> {
        let growth = self.pressed_slopes(strains, compression);
        Matrix3::from_fn(|i, j| by_kc[i] * growth[i][j] * strains.e[i])
    }

    /// Stress sigma_1 at which a crack opens, if it does.
    fn onset_stress(&self, stress: &Vector3<f64>) -> Option<f64> {
        let ft = self.p.ft_mpa;
        let largest = stress[0].max(stress[1]).max(stress[2]);
        if largest >= ft {
            return Some(ft);
        }
        let ottosen = self.onset.as_ref()?;
        if largest < 0.5 * ft {
            return None;
        }
        let sigma = Vector6::new(stress[0], stress[1], stress[2], 0.0, 0.0, 0.0);
        ottosen.reaches(&sigma, self.p.fcm_mpa).then_some(largest)
    }
}
