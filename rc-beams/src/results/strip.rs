//! A part of a picture in memory: full width, some rows. What falls beside it is not drawn.

use std::convert::Infallible;
use std::ops::Range;

use plotters_backend::{BackendColor, BackendCoord, DrawingBackend, DrawingErrorKind};

/// Rows of a picture, white to begin with.
pub struct Strip {
    size: (u32, u32),
    rows: Range<u32>,
    /// Red, green and blue of each unit, row by row.
    units: Vec<u8>,
}

impl Strip {
    /// The given rows of a picture of a size.
    pub fn new(size: (u32, u32), rows: Range<u32>) -> Self {
        let units = vec![255; 3 * size.0 as usize * rows.len()];
        Self { size, rows, units }
    }

    /// What has been drawn.
    pub fn units(&self) -> &[u8] {
        &self.units
    }
}

impl DrawingBackend for &mut Strip {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Result<(), DrawingErrorKind<Infallible>> {
        Ok(())
    }

    fn present(&mut self) -> Result<(), DrawingErrorKind<Infallible>> {
        Ok(())
    }

    fn draw_pixel(
        &mut self,
        (x, y): BackendCoord,
        colour: BackendColor,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else {
            return Ok(());
        };
        if x < self.size.0 && self.rows.contains(&y) {
            let row = (y - self.rows.start) as usize * self.size.0 as usize;
            let at = 3 * (row + x as usize);
            let (r, g, b) = colour.rgb;
            for (unit, new) in self.units[at..at + 3].iter_mut().zip([r, g, b]) {
                let mixed = f64::from(*unit) * (1.0 - colour.alpha) + f64::from(new) * colour.alpha;
                *unit = mixed.round() as u8;
            }
        }
        Ok(())
    }
}
