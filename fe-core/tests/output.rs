//! Protects the result files: what is read back is what the model holds, in the layout of VTK's XML
//! format, and a collection on disk is complete at any moment.

mod common;

use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use common::{Brick, Elastic};
use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::grid::GridBuilder;
use fe_core::material::{PointReport, StateVar};
use fe_core::mesh::{Mesh, NodeId};
use fe_core::model::Model;
use fe_core::output::{DataArray, FieldSeries, OutputError, Pvd, UnstructuredGrid, interface_grid};
use fe_core::shape::quad8;
use fe_core::state::StateStore;

/// A folder of its own for each test.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// Value of an attribute in a tag.
fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let start = tag.find(&format!(" {name}=\""))? + name.len() + 3;
    tag[start..].split('"').next()
}

/// Every array of a file, as raw bytes by name, read by the description of the format alone.
fn arrays(file: &Path) -> BTreeMap<String, Vec<u8>> {
    let bytes = fs::read(file).unwrap();
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let start = bytes
        .windows(marker.len())
        .position(|w| w == marker)
        .unwrap();
    let header = std::str::from_utf8(&bytes[..start]).unwrap();
    let data = &bytes[start + marker.len()..];
    assert!(data.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
    header
        .split('<')
        .filter(|tag| tag.starts_with("DataArray"))
        .map(|tag| {
            let offset: usize = attribute(tag, "offset").unwrap().parse().unwrap();
            let name = attribute(tag, "Name").unwrap();
            (name.to_owned(), decompress(&data[offset..]))
        })
        .collect()
}

fn decompress(data: &[u8]) -> Vec<u8> {
    let word = |i: usize| u64::from_le_bytes(data[8 * i..8 * i + 8].try_into().unwrap()) as usize;
    let (blocks, full, last) = (word(0), word(1), word(2));
    let mut at = 8 * (3 + blocks);
    let mut out = Vec::new();
    for block in 0..blocks {
        let size = word(3 + block);
        let before = out.len();
        flate2::read::ZlibDecoder::new(&data[at..at + size])
            .read_to_end(&mut out)
            .unwrap();
        let expected = if block + 1 == blocks && last > 0 {
            last
        } else {
            full
        };
        assert_eq!(out.len() - before, expected);
        at += size;
    }
    out
}

fn floats(bytes: &[u8]) -> Vec<f64> {
    bytes
        .chunks_exact(8)
        .map(|c| f64::from_le_bytes(c.try_into().unwrap()))
        .collect()
}

/// Two bricks in a row, the second with a drawn segment, under the uniform strain eps_xx = 1e-3.
fn model() -> (Model, Vec<f64>, StateStore) {
    let mut grid = GridBuilder::new();
    grid.add_box("beam", &[0.0, 20.0, 50.0], &[0.0, 10.0], &[0.0, 5.0]);
    let mesh: Mesh = grid.finish().unwrap();
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    for (i, cell) in mesh.blocks()[0].cells().enumerate() {
        let mut brick = Brick::new(cell, mesh.nodes());
        brick.segment = (i == 1).then_some([[25.0, 2.0, 1.0], [45.0, 8.0, 3.0]]);
        elements.push(Box::new(brick));
    }
    let model = Model::new(mesh, elements).unwrap();
    let u = (0..model.dofs().len())
        .map(|i| {
            let (node, dof) = model.dofs().owner(i);
            if dof as usize == 0 {
                1e-3 * model.mesh().nodes()[node][0]
            } else {
                0.0
            }
        })
        .collect();
    let state = StateStore::new(model.elements());
    (model, u, state)
}

#[test]
fn a_series_holds_the_fields_of_cells_and_bars() {
    let folder = folder("series");
    let (model, u, state) = model();
    let mut series = FieldSeries::create(&folder, "fields").unwrap();
    series.record(0.5, &model, &u, &state).unwrap();
    series.record(1.0, &model, &u, &state).unwrap();
    series.flush().unwrap();
    let cells = arrays(&folder.join("fields_0001.vtu"));
    assert_eq!(
        floats(&cells["Points"]).len(),
        3 * model.mesh().nodes().len()
    );
    assert_eq!(cells["types"], [25, 25]);
    let first: Vec<u64> = cells["connectivity"]
        .chunks_exact(8)
        .map(|c| u64::from_le_bytes(c.try_into().unwrap()))
        .collect();
    assert_eq!(first.len(), 40);
    assert_eq!(first[0] as usize, model.elements()[0].nodes()[0]);
    let displacement = floats(&cells["displacement"]);
    for (x, d) in model
        .mesh()
        .nodes()
        .iter()
        .zip(displacement.chunks_exact(3))
    {
        assert_eq!(d, [1e-3 * x[0], 0.0, 0.0]);
    }
    let expected = Elastic::isotropic(30e3, 0.2).tangent.column(0) * 1e-3;
    for (strain, stress) in floats(&cells["strain"])
        .chunks_exact(6)
        .zip(floats(&cells["stress"]).chunks_exact(6))
    {
        assert!((strain[0] - 1e-3).abs() < 1e-15 && strain[1].abs() < 1e-15);
        assert!((0..6).all(|i| (stress[i] - expected[i]).abs() < 1e-10));
    }
    // The largest crack strain of the two points with its normal; the mean of the crushing.
    assert_eq!(floats(&cells["crack_strain"]), [3e-3, 3e-3]);
    assert_eq!(floats(&cells["crack_normal"])[..3], [0.0, 1.0, 0.0]);
    assert!((floats(&cells["crushing"])[0] - 2.5e-3).abs() < 1e-17);

    let bars = arrays(&folder.join("fields_bars_0002.vtu"));
    assert_eq!(bars["types"], [3]);
    assert_eq!(floats(&bars["axial_stress"]), [5.0]);
    let moved = floats(&bars["displacement"]);
    assert!(
        (moved[0] - 0.025).abs() < 1e-12 && (moved[3] - 0.045).abs() < 1e-12,
        "{moved:?}"
    );

    let pvd = fs::read_to_string(folder.join("fields.pvd")).unwrap();
    let sets: Vec<&str> = pvd
        .split('<')
        .filter(|t| t.starts_with("DataSet"))
        .collect();
    assert_eq!(sets.len(), 4);
    assert_eq!(attribute(sets[3], "file"), Some("fields_bars_0002.vtu"));
    assert_eq!(attribute(sets[3], "timestep"), Some("1"));
    assert_eq!(attribute(sets[3], "part"), Some("1"));
    let left = fs::read_dir(&folder).unwrap().count();
    assert_eq!(left, 5, "no temporary file is left");
}

#[test]
fn arrays_longer_than_a_block_are_read_back_whole() {
    let folder = folder("blocks");
    // 8192 numbers are exactly one block, so the last of 3 x 8192 is full.
    for n in [8192, 10_000] {
        let points: Vec<[f64; 3]> = (0..n).map(|i| [f64::from(i), 0.5, -1.0]).collect();
        let mut grid = UnstructuredGrid::new(points.clone());
        grid.add_cell(3, &[0, 1]);
        let mut index = DataArray::scalar("index");
        index.values = (0..n).map(f64::from).collect();
        grid.point_data.push(index.clone());
        let file = folder.join(format!("grid_{n}.vtu"));
        grid.write(&mut fs::File::create(&file).unwrap()).unwrap();
        let back = arrays(&file);
        assert_eq!(floats(&back["Points"]), points.concat());
        assert_eq!(floats(&back["index"]), index.values);
    }
}

#[test]
fn a_folder_that_is_not_there_is_an_error_with_its_path() {
    let missing = folder("missing").join("nowhere");
    let error = FieldSeries::create(&missing, "fields").unwrap_err();
    assert!(matches!(&error, OutputError::Io { path, .. } if path.starts_with(&missing)));
    assert!(error.to_string().contains("nowhere"), "{error}");
}

#[test]
fn a_file_that_cannot_be_written_is_an_error_of_the_series() {
    let folder = folder("refused");
    let (model, u, state) = model();
    let mut series = FieldSeries::create(&folder, "fields").unwrap();
    // A folder in place of the temporary file.
    fs::create_dir(folder.join("fields_bars_0001.vtu.part")).unwrap();
    let told = series.record(0.5, &model, &u, &state);
    let error = told.and_then(|()| series.flush()).unwrap_err();
    assert!(error.to_string().contains("fields_bars_0001"), "{error}");
    let pvd = fs::read_to_string(folder.join("fields.pvd")).unwrap();
    assert!(!pvd.contains("DataSet"), "{pvd}");
}

#[test]
fn a_failed_rewrite_leaves_the_collection_as_it_was() {
    let folder = folder("atomic");
    let path = folder.join("run.pvd");
    let mut pvd = Pvd::create(&path).unwrap();
    pvd.add(1.0, &["a<b>&\"c\".vtu".to_owned()]).unwrap();
    let before = fs::read_to_string(&path).unwrap();
    assert!(
        before.contains("file=\"a&lt;b>&amp;&quot;c&quot;.vtu\""),
        "{before}"
    );
    // A folder in place of the temporary file makes the next rewrite fail.
    fs::create_dir(folder.join("run.pvd.part")).unwrap();
    let added = ["b.vtu".to_owned()];
    assert!(pvd.add(2.0, &added).is_err());
    assert_eq!(fs::read_to_string(&path).unwrap(), before);
    // Made again, the addition is there once.
    fs::remove_dir(folder.join("run.pvd.part")).unwrap();
    pvd.add(2.0, &added).unwrap();
    let after = fs::read_to_string(&path).unwrap();
    assert_eq!(after.matches("<DataSet").count(), 2, "{after}");
}

/// A grid that no reader could read is not written; what is wrong is named. Names are escaped.
#[test]
fn grids_that_do_not_fit_together_are_refused_by_name() {
    let pair = || UnstructuredGrid::new(vec![[0.0; 3], [1.0; 3]]);
    let refused = |grid: &UnstructuredGrid| {
        let error = grid.write(&mut Vec::new()).unwrap_err();
        assert_eq!(error.kind(), std::io::ErrorKind::InvalidInput);
        error.to_string()
    };
    let mut grid = pair();
    grid.add_cell(3, &[0, 99]);
    assert!(refused(&grid).contains("point 99; the grid has 2"));
    let mut grid = pair();
    grid.add_cell(25, &[0, 1]);
    assert!(refused(&grid).contains("type 25 has 2 points instead of 20"));
    let mut grid = pair();
    let mut array = DataArray::new("<a & \"b\">", &["x&", "y"]);
    array.values = vec![1.0];
    grid.point_data.push(array);
    let told = refused(&grid);
    assert!(
        told.contains("has 1 values instead of 4: 2 for each of 2 points"),
        "{told}"
    );
    grid.point_data[0].values = vec![0.0; 4];
    let mut out = Vec::new();
    grid.write(&mut out).unwrap();
    let text = String::from_utf8_lossy(&out);
    assert!(text.contains("Name=\"&lt;a &amp; &quot;b&quot;>\""));
    assert!(text.contains("ComponentName0=\"x&amp;\""));
    grid.cell_data.push(DataArray::scalar("none"));
    assert!(grid.write(&mut Vec::new()).is_ok());
    grid.cell_data[0].values.push(1.0);
    assert!(refused(&grid).contains("array none has 1 values instead of 0"));
}

/// Draws an interface, but of a law with one component.
#[derive(Debug)]
struct Odd([NodeId; 8]);

impl Element for Odd {
    fn nodes(&self) -> &[NodeId] {
        &self.0
    }

    fn dofs(&self) -> &'static [Dof] {
        &Dof::DISPLACEMENTS
    }

    fn state_len(&self) -> usize {
        0
    }

    fn init_state(&self, _: &mut [f64]) {}

    fn evaluate(
        &self,
        _: &[f64],
        _: &[f64],
        _: &mut [f64],
        _: &EvaluationContext,
        _: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        Ok(())
    }

    fn interface_face(&self) -> Option<[NodeId; 8]> {
        Some(self.0)
    }

    fn sample(
        &self,
        _: &[f64],
        _: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        const VARS: [StateVar; 1] = [StateVar::scalar("damage", "-")];
        visit(PointSample {
            position: [0.0; 3],
            volume: 1.0,
            strain: &[0.1],
            stress: &[1.0],
            report: PointReport::default(),
            state_vars: &VARS,
            state: &[],
        });
        Ok(())
    }
}

/// What is no jump and no traction is drawn as NaN, and so is a history that is not there.
#[test]
fn an_interface_without_three_components_is_drawn_as_nan() {
    let mesh = Mesh::new(quad8::NODES.map(|[x, y]| [x, y, 0.0]).to_vec()).unwrap();
    let odd = Box::new(Odd(std::array::from_fn(|a| a)));
    let model = Model::new(mesh, vec![odd]).unwrap();
    let state = StateStore::new(model.elements());
    let grid = interface_grid(&model, &[0.0; 24], &state).unwrap();
    let named = |name| grid.cell_data.iter().find(|a| a.name == name).unwrap();
    for (name, count) in [("jump", 3), ("traction", 3), ("damage", 1)] {
        let values = &named(name).values;
        assert!(values.len() == count && values.iter().all(|v| v.is_nan()));
    }
    assert_eq!(named("utilisation").values, [0.0]);
}
