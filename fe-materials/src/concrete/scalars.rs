//! Mean properties of normal-weight concrete from its cylinder strength (fib Model Code 2010, 5.1).

use fe_core::material::MaterialError;

use crate::limits::out_of_range;

const LAW: &str = "concrete properties";

/// fcm - fck (MPa) (fib Model Code 2010, 5.1-1).
pub(crate) const STRENGTH_MARGIN: f64 = 8.0;

/// Characteristic strengths that the tables below cover (MPa). From 8 to 12 MPa, below the first class of
/// the Code, the tabulated strains keep their value at 12 MPa (assumed).
const FCK_RANGE: (f64, f64) = (8.0, 60.0);

/// fck (MPa) and eps_c1 (-) (fib Model Code 2010, table 5.1-8).
const PEAK_STRAIN: [(f64, f64); 11] = [
    (12.0, 1.9e-3),
    (16.0, 2.0e-3),
    (20.0, 2.1e-3),
    (25.0, 2.2e-3),
    (30.0, 2.3e-3),
    (35.0, 2.3e-3),
    (40.0, 2.4e-3),
    (45.0, 2.5e-3),
    (50.0, 2.6e-3),
    (55.0, 2.6e-3),
    (60.0, 2.7e-3),
];

/// fck (MPa) and eps_c,lim (-) (fib Model Code 2010, table 5.1-8).
const LIMIT_STRAIN: [(f64, f64); 4] = [
    (45.0, 3.5e-3),
    (50.0, 3.4e-3),
    (55.0, 3.4e-3),
    (60.0, 3.3e-3),
];

/// Mean properties of concrete; N, mm, MPa.
///
/// With the characteristic cylinder strength fck (all formulas dimensional, in MPa):
///
/// | property | formula | fib Model Code 2010 |
/// |---|---|---|
/// | mean strength | fcm = fck + 8 | 5.1-1 |
/// | tensile strength | fctm = 0.3 fck^(2/3) up to 50 MPa, then 2.12 ln(1 + 0.1 fcm) | 5.1-3 |
/// | initial modulus | Eci = 21500 (fcm/10)^(1/3), quartzite aggregates | 5.1-21 |
/// | strain at the strength | eps_c1, linear between the entries of the table | table 5.1-8 |
/// | limit strain | eps_c,lim, linear between the entries of the table | table 5.1-8 |
/// | fracture energy | G_F = 0.073 fcm^0.18 | 5.1-9 |
/// | Poisson's ratio | 0.2 | 5.1.7.3 |
///
/// Every field may be overwritten before a law is built from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConcreteScalars {
    /// Mean compressive cylinder strength fcm (MPa).
    pub fcm_mpa: f64,
    /// Mean tensile strength fctm (MPa).
    pub fctm_mpa: f64,
    /// Initial Young's modulus Eci (MPa).
    pub young_mpa: f64,
    /// Poisson's ratio (-).
    pub poisson: f64,
    /// Strain at the compressive strength, positive (-).
    pub eps_c1: f64,
    /// Strain at which the compression curve ends, positive (-).
    pub eps_c_lim: f64,
    /// Fracture energy G_F (N/mm).
    pub fracture_energy: f64,
}

impl ConcreteScalars {
    /// Properties from a characteristic cylinder strength fck (MPa).
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] if fck is outside 8 to 60 MPa, which the tables cover.
    pub fn from_characteristic(fck_mpa: f64) -> Result<Self, MaterialError> {
        let (lowest, highest) = FCK_RANGE;
        if !(lowest..=highest).contains(&fck_mpa) {
            return Err(out_of_range(
                LAW,
                "fck_mpa",
                fck_mpa,
                "MPa",
                format!("[{lowest}, {highest}]"),
                "give the cylinder strength of a normal-strength concrete in MPa",
            ));
        }
        let fcm_mpa = fck_mpa + STRENGTH_MARGIN;
        let fctm_mpa = if fck_mpa <= 50.0 {
            0.3 * fck_mpa.powf(2.0 / 3.0)
        } else {
            2.12 * (0.1 * fcm_mpa).ln_1p()
        };
        Ok(Self {
            fcm_mpa,
            fctm_mpa,
            young_mpa: 21_500.0 * (fcm_mpa / 10.0).cbrt(),
            poisson: 0.2,
            eps_c1: peak_strain(fck_mpa),
            eps_c_lim: interpolate(&LIMIT_STRAIN, fck_mpa),
            fracture_energy: 0.073 * fcm_mpa.powf(0.18),
        })
    }

    /// Properties from a mean cylinder strength fcm (MPa): fck = fcm - 8.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] if fcm is outside 16 to 68 MPa, which the tables cover.
    pub fn from_mean(fcm_mpa: f64) -> Result<Self, MaterialError> {
        Self::from_characteristic(fcm_mpa - STRENGTH_MARGIN).map_err(|_| {
            let (lowest, highest) = FCK_RANGE;
            out_of_range(
                LAW,
                "fcm_mpa",
                fcm_mpa,
                "MPa",
                format!(
                    "[{}, {}]",
                    lowest + STRENGTH_MARGIN,
                    highest + STRENGTH_MARGIN
                ),
                "give the mean cylinder strength of a normal-strength concrete in MPa",
            )
        })
    }

    /// Plasticity number k = Eci eps_c1/fcm of the compression curve (-) (fib Model Code 2010, 5.1-26),
    /// computed, so that modulus, strain and strength agree.
    pub fn plasticity_number(&self) -> f64 {
        self.young_mpa * self.eps_c1 / self.fcm_mpa
    }

    /// Shear modulus G0 = Eci/(2 (1 + nu)) (MPa).
    pub fn shear_modulus(&self) -> f64 {
        self.young_mpa / (2.0 * (1.0 + self.poisson))
    }
}

/// Strain eps_c1 (-) at the mean strength of the concrete of characteristic strength fck (MPa) (fib Model Code 2010, table
/// 5.1-8); outside the table that of its nearer end.
pub(crate) fn peak_strain(fck_mpa: f64) -> f64 {
    interpolate(&PEAK_STRAIN, fck_mpa)
}

/// Linear interpolation in a table of ascending abscissae; constant outside.
fn interpolate(table: &[(f64, f64)], x: f64) -> f64 {
    let mut value = table[0].1;
    for pair in table.windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        value += (y1 - y0) * ((x - x0) / (x1 - x0)).clamp(0.0, 1.0);
    }
    value
}

#[cfg(test)]
mod tests {
    //! Protects the formulas and tables of the Code.
    use super::ConcreteScalars;
    use crate::limits::out_of_range;

    /// Source: fib Model Code 2010 evaluated independently for the concretes of the beams.
    /// Target: the printed digits.
    #[test]
    fn tabulated_properties() {
        let table = [
            (
                19.3,
                [27.3, 2.158537, 30048.72, 2.0825, 3.5, 2.292178, 0.13238],
            ),
            (
                27.5,
                [35.5, 2.733231, 32798.04, 2.25, 3.5, 2.078749, 0.13879],
            ),
            (
                20.5,
                [28.5, 2.247107, 30482.70, 2.11, 3.5, 2.256789, 0.13341],
            ),
            (
                50.0,
                [58.0, 4.071626, 38629.09, 2.6, 3.4, 1.731649, 0.15161],
            ),
        ];
        let half_digit = [1e-9, 6e-7, 6e-3, 1e-9, 1e-9, 6e-7, 6e-6];
        for (fck, expected) in table {
            let p = ConcreteScalars::from_characteristic(fck).unwrap();
            let found = [
                p.fcm_mpa,
                p.fctm_mpa,
                p.young_mpa,
                1e3 * p.eps_c1,
                1e3 * p.eps_c_lim,
                p.plasticity_number(),
                p.fracture_energy,
            ];
            for i in 0..found.len() {
                assert!(
                    (found[i] - expected[i]).abs() < half_digit[i],
                    "{fck}: {found:?}"
                );
            }
            let same = ConcreteScalars::from_mean(fck + 8.0).unwrap();
            assert!((same.young_mpa - p.young_mpa).abs() < 1e-9);
        }
    }

    /// Source: fib Model Code 2010, 5.1-3b: above C50 the tensile strength grows with the logarithm.
    #[test]
    fn tensile_strength_above_fifty() {
        let p = ConcreteScalars::from_characteristic(55.0).unwrap();
        assert!((p.fctm_mpa - 2.12 * 7.3_f64.ln()).abs() < 1e-12);
    }

    #[test]
    fn strengths_outside_the_tables_are_refused() {
        for bad in [f64::NAN, f64::INFINITY, -20.0, 0.0, 7.9, 60.1, 2750.0] {
            assert!(ConcreteScalars::from_characteristic(bad).is_err(), "{bad}");
        }
        let error = ConcreteScalars::from_mean(2.75).unwrap_err();
        let remedy = "give the mean cylinder strength of a normal-strength concrete in MPa";
        let expected = out_of_range(
            "concrete properties",
            "fcm_mpa",
            2.75,
            "MPa",
            "[16, 68]",
            remedy,
        );
        assert_eq!(error, expected);
    }
}
