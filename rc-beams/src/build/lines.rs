//! Grid lines: element faces on plate edges and centres, elements spread over what lies between.

/// Lines closer than this (mm) are one.
const SAME: f64 = 1e-6;

/// An interval of the axis that must be meshed with its own even number of elements: a plate or stub.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Centre (mm).
    pub centre: f64,
    /// Length along the axis (mm).
    pub length: f64,
}

/// Grid lines from 0 to `length` with `elements` cells, on the edges and centres of all patches and on all
/// `edges`. Patches have one cell in each half no longer than 1.5 cells of average size (more in longer ones,
/// the same number in both halves), cut further by `edges`; the rest is shared out by length with the largest
/// remainders, at least one cell between any two lines.
///
/// Returns `None` when there are too few elements for the patches and the gaps between them.
pub fn axis_lines(
    length: f64,
    patches: &[Patch],
    edges: &[f64],
    elements: usize,
) -> Option<Vec<f64>> {
    let ends = |p: &Patch| [p.centre - 0.5 * p.length, p.centre + 0.5 * p.length];
    let mut breaks: Vec<f64> = vec![0.0, length];
    for p in patches {
        breaks.extend(ends(p));
        breaks.push(p.centre);
    }
    breaks.extend(edges);
    breaks.sort_by(f64::total_cmp);
    breaks.dedup_by(|a, b| (*a - *b).abs() < SAME);
    let inside = |x: f64| patches.iter().any(|p| ends(p)[0] < x && x < ends(p)[1]);
    let average = length / elements as f64;
    let spans: Vec<f64> = breaks.windows(2).map(|w| w[1] - w[0]).collect();
    let mut cells: Vec<usize> = vec![0; spans.len()];
    let mut gaps = Vec::new();
    for (i, w) in breaks.windows(2).enumerate() {
        if inside(0.5 * (w[0] + w[1])) {
            cells[i] = ((spans[i] / average).round() as usize).max(1);
        } else {
            gaps.push(i);
        }
    }
    let free: f64 = gaps.iter().map(|&i| spans[i]).sum();
    let rest = elements.checked_sub(cells.iter().sum())?;
    if rest < gaps.len() {
        return None;
    }
    let ideal = |i: usize| spans[i] / free * rest as f64;
    for &i in &gaps {
        cells[i] = (ideal(i).floor() as usize).max(1);
    }
    while cells.iter().sum::<usize>() != elements {
        let missing = cells.iter().sum::<usize>() < elements;
        let key = |&i: &usize| ideal(i) - cells[i] as f64;
        let pick = if missing {
            gaps.iter()
                .copied()
                .max_by(|a, b| key(a).total_cmp(&key(b)).then(b.cmp(a)))
        } else {
            gaps.iter()
                .copied()
                .filter(|&i| cells[i] > 1)
                .min_by(|a, b| key(a).total_cmp(&key(b)))
        }?;
        if missing {
            cells[pick] += 1;
        } else {
            cells[pick] -= 1;
        }
    }
    let mut lines = vec![0.0];
    for (w, &n) in breaks.windows(2).zip(&cells) {
        lines.extend((1..=n).map(|k| w[0] + (w[1] - w[0]) * k as f64 / n as f64));
    }
    Some(lines)
}

/// Largest number of cells that become one at a free end.
const COARSEST: usize = 4;

/// Grid lines with fewer of them beyond `loaded`, the stretch of the axis with all plates: the first cell stays, then two, and
/// from there on four become one. A bar is anchored there, and nothing else happens. An end with one of the `edges` stays as
/// it is.
pub fn coarse_ends(lines: &[f64], loaded: [f64; 2], edges: &[f64]) -> Vec<f64> {
    let [low, high] = loaded;
    let beyond = |x: f64, sign: f64| sign * x > sign * if sign > 0.0 { high } else { low } + SAME;
    let thinned = |sign: f64, outwards: &mut dyn Iterator<Item = f64>| -> Vec<f64> {
        let end: Vec<f64> = outwards.filter(|&x| beyond(x, sign)).collect();
        if edges.iter().any(|&x| beyond(x, sign)) {
            return end;
        }
        let mut kept = Vec::new();
        let (mut at, mut together) = (0, 1);
        while at < end.len() {
            at = (at + together).min(end.len());
            kept.push(end[at - 1]);
            together = (2 * together).min(COARSEST);
        }
        kept
    };
    let left = thinned(-1.0, &mut lines.iter().rev().copied());
    let right = thinned(1.0, &mut lines.iter().copied());
    let between = lines.iter().copied();
    let between = between.filter(|&x| !beyond(x, -1.0) && !beyond(x, 1.0));
    left.into_iter().rev().chain(between).chain(right).collect()
}

/// `n` equal cells from `low` to `high`.
pub fn equal_lines(low: f64, high: f64, n: usize) -> Vec<f64> {
    (0..=n)
        .map(|k| low + (high - low) * k as f64 / n as f64)
        .collect()
}

#[cfg(test)]
mod tests {
    //! Protects the reference mesh: 60 elements as 11+2+13+2+4+2+13+2+11 for a/d = 3.
    use super::*;

    #[test]
    fn the_reference_mesh_comes_out() {
        let patches: Vec<Patch> = [610.0, 1370.0, 1680.0, 2440.0]
            .map(|centre| Patch {
                centre,
                length: 100.0,
            })
            .into();
        let lines = axis_lines(3050.0, &patches, &[], 60).unwrap();
        assert_eq!(lines.len(), 61);
        for (line, index) in [
            (560.0, 11),
            (660.0, 13),
            (1320.0, 26),
            (1420.0, 28),
            (1630.0, 32),
        ] {
            assert!((lines[index] - line).abs() < 1e-9);
        }
        assert_eq!(axis_lines(3050.0, &patches, &[], 32).unwrap().len(), 33);
        assert_eq!(axis_lines(3050.0, &patches, &[], 88).unwrap().len(), 89);
        assert!(axis_lines(3050.0, &patches, &[], 12).is_none());
    }

    /// The 11 cells of an overhang become 1 + 2 + 4 + 4; with the edge of a sheet there they stay.
    #[test]
    fn free_ends_are_coarse() {
        let lines = equal_lines(0.0, 30.0, 30);
        let thinned = coarse_ends(&lines, [11.0, 24.0], &[15.0]);
        assert_eq!(thinned[..5], [0.0, 4.0, 8.0, 10.0, 11.0]);
        assert_eq!(thinned[5..18], lines[12..25]);
        assert_eq!(thinned[18..], [25.0, 27.0, 30.0]);
        let covered = coarse_ends(&lines, [11.0, 24.0], &[5.0, 15.0]);
        assert_eq!(covered[..12], lines[..12]);
        assert_eq!(covered[25..], [25.0, 27.0, 30.0]);
        assert_eq!(coarse_ends(&lines, [0.0, 30.0], &[]), lines);
    }

    /// Edges of sheets are lines too, in gaps and within plates.
    #[test]
    fn edges_become_lines() {
        let patch = Patch {
            centre: 100.0,
            length: 100.0,
        };
        let lines = axis_lines(300.0, &[patch], &[20.0, 90.0, 100.0, 160.0], 8).unwrap();
        assert_eq!(
            lines,
            [0.0, 20.0, 50.0, 90.0, 100.0, 150.0, 160.0, 230.0, 300.0]
        );
        assert!(axis_lines(300.0, &[patch], &[20.0, 90.0, 100.0, 160.0], 6).is_none());
    }
}
