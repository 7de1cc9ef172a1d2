//! What a child leaves, added to its parent: part of it on the columns of the panel, the rest on the rows below.

use super::dense::Panel;
use super::fronts::Fronts;

impl Fronts {
    /// Adds what a child left on the columns of its parent.
    pub(super) fn extend_panel(&self, child: usize, update: &[f64], panel: &mut Panel<'_>) {
        let runs = self.runs(&self.list[child]);
        let width = panel.subdiagonal.len();
        let rows = self.list[child].height() - self.list[child].width();
        for (k, run) in runs.iter().enumerate() {
            for j in 0..run.len as usize {
                let (from, to) = (run.from as usize + j, run.to as usize + j);
                if to >= width {
                    return;
                }
                let own = std::iter::once((from, to, run.len as usize - j));
                let later = runs[k + 1..].iter();
                let below =
                    own.chain(later.map(|r| (r.from as usize, r.to as usize, r.len as usize)));
                for (row, target, len) in below {
                    let source = &update[from * rows + row..][..len];
                    add(
                        &mut panel.lower[to * panel.height + target..][..len],
                        source,
                    );
                    if !panel.upper.is_empty() {
                        let column = &mut panel.upper[to * panel.height + target..][..len];
                        for (i, t) in column.iter_mut().enumerate() {
                            *t += update[(row + i) * rows + from];
                        }
                    }
                }
            }
        }
    }

    /// Adds what a child left on the rows below its parent: all of it, or the lower triangle.
    pub(super) fn extend_update(&self, child: usize, old: &[f64], update: &mut [f64], whole: bool) {
        let front = &self.list[child];
        let parent = &self.list[front.parent];
        let (width, height) = (parent.width(), parent.height() - parent.width());
        let rows = front.height() - front.width();
        let runs = self.runs(front);
        for (k, run) in runs.iter().enumerate() {
            for j in 0..run.len as usize {
                let (from, to) = (run.from as usize + j, run.to as usize + j);
                if to < width {
                    continue;
                }
                let column = &mut update[(to - width) * height..][..height];
                let seen = if whole { 0 } else { k };
                for (l, other) in runs.iter().enumerate().skip(seen) {
                    let (start, to) = (other.from as usize, other.to as usize);
                    // The lower triangle begins at the diagonal, in the run of the column itself.
                    let diagonal = if l == k && !whole { j } else { 0 };
                    let skip = diagonal.max(width.saturating_sub(to));
                    if let Some(len) = (other.len as usize).checked_sub(skip) {
                        let source = &old[from * rows + start + skip..][..len];
                        let target = to + skip - width;
                        add(&mut column[target..][..len], source);
                    }
                }
            }
        }
    }
}

fn add(to: &mut [f64], from: &[f64]) {
    for (a, b) in to.iter_mut().zip(from) {
        *a += b;
    }
}
