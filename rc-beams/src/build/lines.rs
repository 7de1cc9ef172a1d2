//! Grid lines: element faces on plate edges and centres, elements spread over what lies between.

/// An interval of the axis that must be meshed with its own even number of elements: a plate or stub.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Centre (mm).
    pub centre: f64,
    /// Length along the axis (mm).
    pub length: f64,
}

/// Grid lines from 0 to `length` with `elements` cells: two cells in every plate no longer than two
/// cells of average size (an even number by length in longer ones), the rest shared out by length with the
/// largest remainders.
///
/// Returns `None` when there are too few elements for the patches and the gaps between them.
pub fn axis_lines(length: f64, patches: &[Patch], elements: usize) -> Option<Vec<f64>> {
    let mut edges = vec![0.0];
    let mut is_patch = Vec::new();
    for p in patches {
        let (low, high) = (p.centre - 0.5 * p.length, p.centre + 0.5 * p.length);
        if low - edges[edges.len() - 1] > 1e-9 {
            edges.push(low);
            is_patch.push(false);
        }
        edges.push(high);
        is_patch.push(true);
    }
    if length - edges[edges.len() - 1] > 1e-9 {
        edges.push(length);
        is_patch.push(false);
    }
    let average = length / elements as f64;
    let spans: Vec<f64> = edges.windows(2).map(|w| w[1] - w[0]).collect();
    let mut cells: Vec<usize> = spans
        .iter()
        .zip(&is_patch)
        .map(|(s, &patch)| {
            if patch {
                2 * ((s / average / 2.0).round() as usize).max(1)
            } else {
                0
            }
        })
        .collect();
    let gaps: Vec<usize> = (0..spans.len()).filter(|&i| !is_patch[i]).collect();
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
    for (w, &n) in edges.windows(2).zip(&cells) {
        lines.extend((1..=n).map(|k| w[0] + (w[1] - w[0]) * k as f64 / n as f64));
    }
    Some(lines)
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
        let lines = axis_lines(3050.0, &patches, 60).unwrap();
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
        assert_eq!(axis_lines(3050.0, &patches, 32).unwrap().len(), 33);
        assert_eq!(axis_lines(3050.0, &patches, 88).unwrap().len(), 89);
        assert!(axis_lines(3050.0, &patches, 12).is_none());
    }
}
