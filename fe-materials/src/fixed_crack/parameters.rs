//! Parameters of the fixed-crack law, their sources and their ranges.

use fe_core::material::MaterialError;

use super::{CompressionSoftening, Confinement, NAME, ShearTransfer, TensionSoftening};
use crate::concrete::{STRENGTH_MARGIN, peak_strain};

/// Parameters of [`FixedCrack`](super::FixedCrack); N, mm, MPa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedCrackParameters {
    /// Young's modulus E (MPa).
    pub young_mpa: f64,
    /// Poisson's ratio before cracking (-).
    pub poisson: f64,
    /// Mean compressive strength fcm (MPa).
    pub fcm_mpa: f64,
    /// Tensile strength ft (MPa).
    pub ft_mpa: f64,
    /// Strain at the compressive strength, positive (-).
    pub eps_c1: f64,
    /// Fracture energy G_F (N/mm).
    pub fracture_energy: f64,
    /// Crushing energy G_c (N/mm).
    pub crushing_energy: f64,
    /// Floor b_min of the shear factor of open cracks (-); assumed, and without influence on beams whose
    /// bars have dowel action between 1e-5 and 1e-3.
    pub shear_floor: f64,
    /// Shape of the softening in tension.
    pub tension_softening: TensionSoftening,
    /// What carries shear across open cracks.
    pub shear_transfer: ShearTransfer,
    /// What cracks do to the compression across them.
    pub compression_softening: CompressionSoftening,
    /// What pressure across an axis does to the compression along it.
    pub confinement: Confinement,
    /// Distance of cracks s (mm), see [`Self::crack_reach`].
    pub crack_spacing_mm: f64,
    /// Share of the strength at onset (-), in (0, 1], above which the axes of a crack follow the strain; 1: fixed at the onset.
    pub fixing_share: f64,
}

/// Distance of cracks (mm) where none is given: the grid of the wires in the panels whose average strains gave the softening of
/// struts (Vecchio and Collins 1982), between which they cracked (assumed).
pub const CRACK_SPACING_MM: f64 = 50.0;

/// Share of the strength down to which axes follow the strain where none is given: that advised for large elements by the authors of
/// ATENA, which has the same.
pub const FIXING_SHARE: f64 = 0.7;

/// Largest aggregate (mm) where none is given: 3/4 inch, usual in the United States (assumed).
pub const AGGREGATE_MM: f64 = 19.0;

/// G_c over G_F (-) (Nakamura and Higai 2001).
pub(crate) const CRUSHING_OVER_FRACTURE: f64 = 250.0;

impl FixedCrackParameters {
    /// Parameters from a mean cylinder strength and a measured modulus.
    ///
    /// eps_c1 as in fib Model Code 2010, table 5.1-8, for fck = fcm - 8, linear between its entries;
    /// G_F = 0.073 fcm^0.18 (fib Model Code 2010, 5.1-9); G_c = 250 G_F (Nakamura and Higai 2001).
    pub fn from_strength(fcm_mpa: f64, ft_mpa: f64, young_mpa: f64) -> Self {
        let fracture_energy = 0.073 * fcm_mpa.powf(0.18);
        Self {
            young_mpa,
            poisson: 0.2,
            fcm_mpa,
            ft_mpa,
            eps_c1: peak_strain(fcm_mpa - STRENGTH_MARGIN),
            fracture_energy,
            crushing_energy: CRUSHING_OVER_FRACTURE * fracture_energy,
            shear_floor: 1e-4,
            tension_softening: TensionSoftening::default(),
            shear_transfer: ShearTransfer::Interlock {
                aggregate_mm: AGGREGATE_MM,
            },
            compression_softening: CompressionSoftening::default(),
            confinement: Confinement::default(),
            crack_spacing_mm: CRACK_SPACING_MM,
            fixing_share: FIXING_SHARE,
        }
    }

    /// Length l = max(h, s) (mm) over which the strains of a crack band of width h (mm) make up one crack, which opens
    /// by w = l kt (struts) or, less what is elastic, l (kt - ft/E) (interlock), and slips by l gamma. A band as wide as
    /// the spacing of cracks or wider holds one crack; narrower ones share it with their neighbours, or smaller elements
    /// would mean more and finer cracks.
    pub const fn crack_reach(&self, band_width: f64) -> f64 {
        band_width.max(self.crack_spacing_mm)
    }

    pub(super) fn check(&self) -> Result<(), MaterialError> {
        let positive = [
            ("crack_spacing_mm", self.crack_spacing_mm, "mm"),
            ("young_mpa", self.young_mpa, "MPa"),
            ("fcm_mpa", self.fcm_mpa, "MPa"),
            ("ft_mpa", self.ft_mpa, "MPa"),
            ("eps_c1", self.eps_c1, "-"),
            ("fracture_energy", self.fracture_energy, "N/mm"),
            ("crushing_energy", self.crushing_energy, "N/mm"),
        ];
        for (parameter, value, unit) in positive {
            if !(value.is_finite() && value > 0.0) {
                return Err(out_of_range(parameter, value, unit, "(0, inf)"));
            }
        }
        if self.ft_mpa >= self.fcm_mpa {
            let allowed = format!("(0, {}), the compressive strength", self.fcm_mpa);
            return Err(out_of_range("ft_mpa", self.ft_mpa, "MPa", &allowed));
        }
        if !(0.0..0.5).contains(&self.poisson) {
            return Err(out_of_range("poisson", self.poisson, "-", "[0, 0.5)"));
        }
        for (parameter, share) in [
            ("shear_floor", self.shear_floor),
            ("fixing_share", self.fixing_share),
        ] {
            if !(share > 0.0 && share <= 1.0) {
                return Err(out_of_range(parameter, share, "-", "(0, 1]"));
            }
        }
        self.shear_transfer.check()?;
        let plasticity = self.young_mpa * self.eps_c1 / self.fcm_mpa;
        if plasticity <= 1.0 {
            return Err(MaterialError::Parameter {
                law: NAME,
                parameter: "young_mpa",
                value: self.young_mpa,
                unit: "MPa",
                allowed: format!(
                    "({:.0}, inf), beyond fcm/eps_c1",
                    self.fcm_mpa / self.eps_c1
                ),
                remedy:
                    "raise the modulus or the strain eps_c1 at the strength, or lower the strength"
                        .into(),
            });
        }
        Ok(())
    }
}

pub(super) fn out_of_range(
    parameter: &'static str,
    value: f64,
    unit: &'static str,
    allowed: &str,
) -> MaterialError {
    MaterialError::Parameter {
        law: NAME,
        parameter,
        value,
        unit,
        allowed: allowed.into(),
        remedy: "give a value in that range".into(),
    }
}
