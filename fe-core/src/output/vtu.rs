//! The XML format of unstructured grids, with raw appended data in compressed blocks.
//!
//! Layout after "VTK File Formats" (Kitware, VTK 9): after the underscore, each array starts with 64-bit
//! integers in little-endian order (number of blocks, size of a block, size of the last one if it is not
//! full, compressed size of each block), followed by the blocks as zlib streams.

use std::io::{self, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;

use super::pvd::escape;

/// Uncompressed size of a block.
const BLOCK: usize = 1 << 16;

/// Points of the types of cells that are known here.
const VTK_POINTS: [(u8, usize); 3] = [(3, 2), (23, 8), (25, 20)];

/// One named array on points or cells.
#[derive(Debug, Clone, PartialEq)]
pub struct DataArray {
    /// Name, as shown by the reader.
    pub name: &'static str,
    /// Name of each component; one empty name for a scalar.
    pub components: &'static [&'static str],
    /// Values, the components of one point or cell after the other.
    pub values: Vec<f64>,
}

impl DataArray {
    /// An empty array of scalars.
    pub const fn scalar(name: &'static str) -> Self {
        Self::new(name, &[""])
    }

    /// An empty array with named components.
    pub const fn new(name: &'static str, components: &'static [&'static str]) -> Self {
        Self {
            name,
            components,
            values: Vec::new(),
        }
    }
}

/// Points, cells and their data.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct UnstructuredGrid {
    /// Points (mm).
    pub points: Vec<[f64; 3]>,
    /// Points of all cells, one cell after the other.
    connectivity: Vec<usize>,
    /// End of each cell in `connectivity`.
    offsets: Vec<usize>,
    /// Type of each cell, as VTK numbers them.
    types: Vec<u8>,
    /// Arrays with one entry per point.
    pub point_data: Vec<DataArray>,
    /// Arrays with one entry per cell.
    pub cell_data: Vec<DataArray>,
}

impl UnstructuredGrid {
    /// Points (mm) without cells.
    pub fn new(points: Vec<[f64; 3]>) -> Self {
        Self {
            points,
            ..Self::default()
        }
    }

    /// Adds a cell of a type of VTK (3 line, 23 quadratic quadrilateral, 25 quadratic hexahedron) on points of the grid.
    pub fn add_cell(&mut self, vtk_type: u8, points: &[usize]) {
        self.connectivity.extend_from_slice(points);
        self.offsets.push(self.connectivity.len());
        self.types.push(vtk_type);
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.types.len()
    }

    /// Refuses cells on points that are not there, or on fewer or more than their type has, and arrays of another length than
    /// that of what they belong to.
    fn check(&self) -> io::Result<()> {
        let refuse = |text| Err(io::Error::new(io::ErrorKind::InvalidInput, text));
        let points = self.points.len();
        if let Some(point) = self.connectivity.iter().find(|p| **p >= points) {
            return refuse(format!(
                "a cell has point {point}; the grid has {points}, counted from 0"
            ));
        }
        let mut start = 0;
        for (cell, (&end, &kind)) in self.offsets.iter().zip(&self.types).enumerate() {
            let found = end - std::mem::replace(&mut start, end);
            let known = VTK_POINTS.iter().find(|(known, _)| *known == kind);
            if let Some((_, asked)) = known.filter(|(_, asked)| *asked != found) {
                return refuse(format!(
                    "cell {cell} of type {kind} has {found} points instead of {asked}"
                ));
            }
        }
        let owned = [
            (&self.point_data, points, "points"),
            (&self.cell_data, self.cells(), "cells"),
        ];
        for (arrays, count, owners) in owned {
            for array in arrays {
                let (found, each) = (array.values.len(), array.components.len().max(1));
                if found != count * each {
                    return refuse(format!(
                        "the array {} has {found} values instead of {}: {each} for each of {count} {owners}",
                        array.name,
                        count * each
                    ));
                }
            }
        }
        Ok(())
    }

    /// Writes the grid as the contents of a `.vtu` file.
    ///
    /// # Errors
    ///
    /// [`io::ErrorKind::InvalidInput`] for a cell on points that are not there, or not as many as its type has, and for an array
    /// with another number of values than its points or cells ask for; else those of `out`.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        self.check()?;
        let mut appended = Vec::new();
        let points: Vec<f64> = self.points.iter().flatten().copied().collect();
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(
            out,
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">"
        )?;
        writeln!(out, "<UnstructuredGrid>")?;
        writeln!(
            out,
            "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">",
            self.points.len(),
            self.cells()
        )?;
        for (tag, arrays) in [
            ("PointData", &self.point_data),
            ("CellData", &self.cell_data),
        ] {
            writeln!(out, "<{tag}>")?;
            for array in arrays {
                let name = escape(array.name);
                write!(out, "<DataArray type=\"Float64\" Name=\"{name}\"")?;
                if array.components.len() > 1 {
                    write!(out, " NumberOfComponents=\"{}\"", array.components.len())?;
                    for (i, name) in array.components.iter().enumerate() {
                        write!(out, " ComponentName{i}=\"{}\"", escape(name))?;
                    }
                }
                finish(out, &mut appended, &floats(&array.values))?;
            }
            writeln!(out, "</{tag}>")?;
        }
        writeln!(out, "<Points>")?;
        write!(
            out,
            "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\""
        )?;
        finish(out, &mut appended, &floats(&points))?;
        writeln!(out, "</Points>\n<Cells>")?;
        for (name, values) in [
            ("connectivity", &self.connectivity),
            ("offsets", &self.offsets),
        ] {
            let bytes: Vec<u8> = values
                .iter()
                .flat_map(|&v| (v as u64).to_le_bytes())
                .collect();
            write!(out, "<DataArray type=\"Int64\" Name=\"{name}\"")?;
            finish(out, &mut appended, &bytes)?;
        }
        write!(out, "<DataArray type=\"UInt8\" Name=\"types\"")?;
        finish(out, &mut appended, &self.types)?;
        writeln!(out, "</Cells>\n</Piece>\n</UnstructuredGrid>")?;
        write!(out, "<AppendedData encoding=\"raw\">\n_")?;
        out.write_all(&appended)?;
        writeln!(out, "\n</AppendedData>\n</VTKFile>")
    }
}

fn floats(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Ends the tag of an array and appends its compressed bytes.
fn finish(out: &mut impl Write, appended: &mut Vec<u8>, bytes: &[u8]) -> io::Result<()> {
    writeln!(out, " format=\"appended\" offset=\"{}\"/>", appended.len())?;
    let blocks: Vec<Vec<u8>> = bytes
        .chunks(BLOCK)
        .map(|block| {
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
            encoder.write_all(block)?;
            encoder.finish()
        })
        .collect::<io::Result<_>>()?;
    let header = [blocks.len(), BLOCK, bytes.len() % BLOCK];
    for size in header.into_iter().chain(blocks.iter().map(Vec::len)) {
        appended.extend((size as u64).to_le_bytes());
    }
    for block in &blocks {
        appended.extend(block);
    }
    Ok(())
}
