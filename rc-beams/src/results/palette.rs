//! Colours that readers with any colour vision tell apart.
//!
//! Curves and marks: M. Okabe and K. Ito, Color Universal Design (2008). Crack strains: a sequence whose
//! lightness falls, after the scheme OrRd of C. Brewer (colorbrewer2.org).

use plotters::style::RGBColor;

/// Text, axes.
pub const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
/// Secondary text and lines.
pub const GREY: RGBColor = RGBColor(0x70, 0x70, 0x70);
/// Grid and outlines.
pub const FAINT: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);
/// Okabe-Ito blue.
pub const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
/// Okabe-Ito sky blue.
pub const SKY_BLUE: RGBColor = RGBColor(0x56, 0xb4, 0xe9);
/// Okabe-Ito orange.
pub const ORANGE: RGBColor = RGBColor(0xe6, 0x9f, 0x00);
/// Okabe-Ito vermillion.
pub const VERMILLION: RGBColor = RGBColor(0xd5, 0x5e, 0x00);
/// Okabe-Ito bluish green.
pub const GREEN: RGBColor = RGBColor(0x00, 0x9e, 0x73);
/// Okabe-Ito reddish purple.
pub const PURPLE: RGBColor = RGBColor(0xcc, 0x79, 0xa7);

const SEQUENCE: [[f64; 3]; 4] = [
    [253.0, 204.0, 138.0],
    [252.0, 141.0, 89.0],
    [215.0, 48.0, 31.0],
    [107.0, 0.0, 0.0],
];

/// Colour of a share from 0, light, to 1, dark; beyond, the nearest of them.
pub fn sequential(share: f64) -> RGBColor {
    let intervals = SEQUENCE.len() - 1;
    let at = share.clamp(0.0, 1.0) * intervals as f64;
    let i = (at as usize).min(intervals - 1);
    let mix = |c: usize| {
        let (low, high) = (SEQUENCE[i][c], SEQUENCE[i + 1][c]);
        (low + (at - i as f64) * (high - low)).round() as u8
    };
    RGBColor(mix(0), mix(1), mix(2))
}

#[cfg(test)]
mod tests {
    //! Protects the reading of a picture without colours: a larger strain is always darker.
    use super::*;

    #[test]
    fn the_sequence_darkens() {
        let luminance = |share| {
            let RGBColor(r, g, b) = sequential(share);
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        let steps: Vec<f64> = (0..=60).map(|i| luminance(f64::from(i) / 60.0)).collect();
        assert!(steps.windows(2).all(|pair| pair[1] < pair[0]));
        assert_eq!(sequential(-1.0), sequential(0.0));
        assert_eq!(sequential(2.0), sequential(1.0));
    }
}
