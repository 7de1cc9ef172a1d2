//! Grid of the half beam with its plates and stubs.

use fe_core::grid::GridBuilder;
use fe_core::mesh::Mesh;

use super::lines::{Patch, axis_lines, coarse_ends, equal_lines};
use super::{BuildError, ModelSettings};
use crate::options::{MeshSize, Preset};
use crate::spec::{Face, Specimen};

/// Block of concrete in zones with or without stirrups.
pub(super) const fn concrete_block(stirrups: bool) -> &'static str {
    if stirrups {
        "concrete"
    } else {
        "concrete without stirrups"
    }
}

/// Block of the plate at support `i`.
pub(super) fn support_plate(i: usize) -> String {
    format!("support plate {}", i + 1)
}

/// Block of the plate at load `i`.
pub(super) fn load_plate(i: usize) -> String {
    format!("load plate {}", i + 1)
}

/// The half beam, z from 0 to half the width; element faces on the edges and centres of all plates.
pub(super) fn mesh(specimen: &Specimen, settings: &ModelSettings) -> Result<Mesh, BuildError> {
    let MeshSize { nx, ny, nz } = settings.mesh;
    let (length, height) = (specimen.beam.length_mm.get(), specimen.beam.height_mm.get());
    let patches = patches(specimen);
    let lines = |axis: usize, length: f64, patches: &[Patch], n: usize| {
        let edges = &sheet_edges(specimen)[axis];
        axis_lines(length, patches, edges, n).ok_or_else(|| BuildError::TooFewElements {
            specimen: specimen.name.clone(),
            along: ["along", "up", "across"][axis],
            elements: n,
            least: least(n, |n| axis_lines(length, patches, edges, n).is_some()),
        })
    };
    let xs = lines(0, length, &patches, nx)?;
    let xs = coarse_ends(&xs, loaded(&patches), &sheet_edges(specimen)[0]);
    let ys = lines(1, height, &[], ny)?;
    let zs = lines(2, specimen.half_width_mm(), &[], nz.unwrap_or(1))?;
    let mut grid = GridBuilder::new();
    for column in xs.windows(2) {
        let centre = 0.5 * (column[0] + column[1]);
        let block = concrete_block(has_stirrups(specimen, centre));
        grid.add_box(block, column, &ys, &zs);
    }
    for (i, s) in specimen.supports.iter().enumerate() {
        let mut top = 0.0;
        if let Some(stub) = &s.stub {
            let depth = stub.depth_mm.get();
            let own = under(&xs, s.x_mm.get(), stub.length_mm.get());
            let rows = ((depth / (height / ny as f64)).round() as usize).max(1);
            let block = concrete_block(has_stirrups(specimen, s.x_mm.get()));
            grid.add_box(block, &own, &equal_lines(-depth, 0.0, rows), &zs);
            top = -depth;
        }
        let own = under(&xs, s.x_mm.get(), s.plate.length_mm.get());
        let plate = [top - s.plate.thickness_mm.get(), top];
        grid.add_box(&support_plate(i), &own, &plate, &zs);
    }
    for (i, l) in specimen.loads.iter().enumerate() {
        let own = under(&xs, l.x_mm.get(), l.plate.length_mm.get());
        let plate = [height, height + l.plate.thickness_mm.get()];
        grid.add_box(&load_plate(i), &own, &plate, &zs);
    }
    Ok(grid.finish()?)
}

/// The stretch of the axis with all plates and stubs (mm).
fn loaded(patches: &[Patch]) -> [f64; 2] {
    patches
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
            let half = 0.5 * p.length;
            [low.min(p.centre - half), high.max(p.centre + half)]
        })
}

/// Elements along and over the height of a bare beam.
const BARE: [usize; 2] = [60, 4];
/// Elements over the height of a strengthened beam: the load a bond transfers is too high where elements along
/// the fibre are long.
const STRENGTHENED: usize = 6;
/// Height of the tallest of them, where edges of sheets make others low, in heights of equal ones.
const TALLEST: f64 = 1.25;

/// Mesh of a specimen that none is asked for: 60 x 4, with sheets 6 over the height, and as many along the beam as plates and
/// edges of sheets need; uniform across the width, unless sheets cover a part of it or another preset than the physical one asks
/// for hexahedra as in its source.
pub fn default_mesh(specimen: &Specimen, preset: Preset) -> MeshSize {
    let [nx, ny] = BARE;
    let across = |least: usize| (least > 1 || preset != Preset::Physical).then_some(least);
    let patches = patches(specimen);
    let edges = sheet_edges(specimen);
    let along = |n| axis_lines(specimen.beam.length_mm.get(), &patches, &edges[0], n).is_some();
    let nx = least(nx, along).unwrap_or(nx);
    if specimen.sheets.is_none() {
        let nz = across(1);
        return MeshSize { nx, ny, nz };
    }
    let height = specimen.beam.height_mm.get();
    let tallest = TALLEST * height / STRENGTHENED as f64;
    let up = |n| {
        let rows = axis_lines(height, &[], &edges[1], n);
        rows.is_some_and(|ys| ys.windows(2).all(|row| row[1] - row[0] <= tallest))
    };
    let wide = |n| axis_lines(specimen.half_width_mm(), &[], &edges[2], n).is_some();
    MeshSize {
        nx,
        ny: least(STRENGTHENED, up).unwrap_or(STRENGTHENED),
        nz: across(least(1, wide).unwrap_or(1)),
    }
}

/// The least number from `n` on that will do.
fn least(n: usize, will_do: impl Fn(usize) -> bool) -> Option<usize> {
    (n..n + MOST_LINES).find(|&n| will_do(n))
}

/// More lines than plates and sheets of any beam have.
const MOST_LINES: usize = 1000;

/// Edges of the sheets (mm) along x, y and z.
fn sheet_edges(specimen: &Specimen) -> [Vec<f64>; 3] {
    let mut edges = [vec![], vec![], vec![]];
    for wrap in specimen.sheets.iter().flat_map(|s| &s.wraps) {
        for stretch in &wrap.stretches {
            edges[0].extend([stretch.x_from_mm.get(), stretch.x_to_mm.get()]);
        }
        for cover in &wrap.faces {
            let axis = if cover.face == Face::Side { 1 } else { 2 };
            edges[axis].extend([cover.from_mm.get(), cover.to_mm.get()]);
        }
    }
    edges
}

/// Whether the zone at `x` (mm) has stirrups.
fn has_stirrups(specimen: &Specimen, x: f64) -> bool {
    specimen.stirrups.as_ref().is_some_and(|s| s.cover(x))
}

/// Plates and stubs along the axis, from left to right.
fn patches(specimen: &Specimen) -> Vec<Patch> {
    let plates = specimen.plates();
    let mut patches: Vec<Patch> = plates
        .map(|(centre, length)| Patch { centre, length })
        .collect();
    patches.sort_by(|a, b| a.centre.total_cmp(&b.centre));
    patches
}

/// Grid lines within a plate.
fn under(xs: &[f64], centre: f64, length: f64) -> Vec<f64> {
    let reach = 0.5 * length + 1e-6;
    xs.iter()
        .copied()
        .filter(|x| (x - centre).abs() <= reach)
        .collect()
}
