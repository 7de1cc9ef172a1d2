//! How many elements a beam has.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use serde::Serialize;

/// Largest number of elements in one direction.
const MAX_ELEMENTS: usize = 1000;
/// Largest number of elements in all.
const MAX_TOTAL: usize = 20_000;
/// Largest factor of the stiffness (GB); a run takes about three times as much.
const MAX_FACTOR_GB: f64 = 4.0;

/// Numbers of elements along, up and across the beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct MeshSize {
    /// Along the beam, x.
    pub nx: usize,
    /// Over the height, y.
    pub ny: usize,
    /// Over half of the width, z; none where the displacement is uniform across it.
    pub nz: Option<usize>,
}

impl From<[usize; 3]> for MeshSize {
    fn from([nx, ny, nz]: [usize; 3]) -> Self {
        let nz = Some(nz);
        Self { nx, ny, nz }
    }
}

impl Display for MeshSize {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.nx, self.ny)?;
        self.nz.map_or(Ok(()), |nz| write!(f, "x{nz}"))
    }
}

impl FromStr for MeshSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let counts: Vec<usize> = text
            .split('x')
            .map(|n| {
                n.parse()
                    .map_err(|_| format!("{n:?} is not a whole number"))
            })
            .collect::<Result<_, _>>()
            .map_err(|what| {
                format!("{what}; write two or three counts, for instance 60x4 or 60x4x1")
            })?;
        let (nx, ny, nz) = match counts[..] {
            [nx, ny] => (nx, ny, None),
            [nx, ny, nz] => (nx, ny, Some(nz)),
            _ => {
                return Err(format!(
                    "{} counts; write two or three, for instance 60x4 or 60x4x1",
                    counts.len()
                ));
            }
        };
        let size = Self { nx, ny, nz };
        size.check()?;
        Ok(size)
    }
}

impl MeshSize {
    /// # Errors
    ///
    /// What is allowed, where a run would take too long or too much memory.
    pub fn check(self) -> Result<(), String> {
        let across = self.nz.unwrap_or(1);
        for (count, axis) in [(self.nx, "along"), (self.ny, "up"), (across, "across")] {
            if !(1..=MAX_ELEMENTS).contains(&count) {
                return Err(format!(
                    "{count} elements {axis} the beam; allowed: 1 to {MAX_ELEMENTS}, for instance 60x4x1"
                ));
            }
        }
        let total = self.nx * self.ny * across;
        if total > MAX_TOTAL {
            return Err(format!(
                "{total} elements; allowed: up to {MAX_TOTAL} in all, for instance 60x4x1"
            ));
        }
        let factor = self.factor_gb();
        if factor > MAX_FACTOR_GB {
            return Err(format!(
                "the factor of the stiffness would take about {factor:.0} GB; allowed: up to \
                 {MAX_FACTOR_GB} GB; give fewer elements up and across, for instance 60x4x1"
            ));
        }
        Ok(())
    }

    /// The mesh with so many times the elements along and up, rounded up.
    #[must_use]
    pub fn finer(self, ratio: f64) -> Self {
        let [nx, ny] = [self.nx, self.ny].map(|n| (ratio * n as f64).ceil() as usize);
        Self { nx, ny, ..self }
    }

    /// About how much the factor of the stiffness takes (GB): equations are numbered along the beam, so that
    /// a layer of elements is coupled with the next, and the band is filled.
    fn factor_gb(self) -> f64 {
        let [nx, ny] = [self.nx, self.ny].map(|n| n as f64);
        // Uniform across, there are as many DOFs as on one face.
        let nz = self.nz.map_or(0.0, |nz| nz as f64);
        let face = (2.0 * ny + 1.0) * (2.0 * nz + 1.0) - ny * nz;
        let middle = (ny + 1.0) * (nz + 1.0);
        let layer = 3.0 * (face + middle);
        8.0 * nx * layer * layer / 1e9
    }
}
