//! Draws the pictures of a run and of a report from invented data, to look at their design:
//! `cargo run --release -p rc-beams --example pictures -- FOLDER`.

use std::error::Error;
use std::path::PathBuf;

use fe_solver::capacity::{Capacity, PathPoint, Verdict};
use rc_beams::results::crack::CrackView;
use rc_beams::results::curve::{Curve, GroupCurves, GroupLine};
use rc_beams::results::drawing::Picture;
use rc_beams::results::evidence::ConcretePoint;
use rc_beams::results::folder::Folder;
use rc_beams::results::sheets::{
    Face, InterfacePoint, MapRow, MapState, SheetLayout, SheetPoint, SheetState, SheetView, Shown,
    Zone,
};

fn main() -> Result<(), Box<dyn Error>> {
    let root = std::env::args_os()
        .nth(1)
        .map_or_else(std::env::temp_dir, PathBuf::from);
    let folder = Folder::create(&root, "pictures")?;
    let path = path();
    let capacity = Capacity::of(&path).ok_or("no path")?;
    let curve = Curve {
        specimen: "A-SO3-1",
        title: "invented: a diagonal crack, arching, a second peak",
        path: &path,
        capacity: &capacity,
        verdict: &Verdict::of(&path, &capacity),
        test_load_kn: Some(151.0),
    };
    let cracks = CrackView {
        specimen: "A-SO3-1",
        title: "invented: crack strain at the peak, 149.2 kN at 2.07 mm",
        elements: &elements(),
        bars: &[51.0, 254.0].map(|y| vec![[25.0, y], [3025.0, y]]),
        stirrups: &[25.0, 150.0, 275.0, 400.0, 2650.0, 2775.0, 2900.0, 3025.0]
            .map(|x| vec![[x, 30.0], [x, 275.0]]),
        supports: &[[610.0, -20.0], [2440.0, -20.0]],
        loads: &[[1370.0, 325.0], [1680.0, 325.0]],
        points: &points(),
    };
    curve.save_svg(&folder, "curve")?;
    curve.save_png(&folder, "curve")?;
    cracks.save_svg(&folder, "crack")?;
    cracks.save_png(&folder, "crack")?;
    let sheets = sheets();
    let rows = MapRow::of(MapState::Peak, &sheets, &sheet_state());
    for shown in [Shown::Slip, Shown::FibreStress] {
        let view = SheetView {
            specimen: "A-SO3-3",
            title: &format!("invented: {}", shown.title(240.4, 5.9)),
            shown,
            state: MapState::Peak,
            rows: &rows,
            zones: &sheets.zones,
            elements: cracks.elements,
            supports: cracks.supports,
            loads: cracks.loads,
        };
        view.save_svg(&folder, shown.file())?;
        view.save_png(&folder, shown.file())?;
        let alone = SheetView {
            zones: &[],
            elements: &[],
            supports: &[],
            loads: &[],
            ..view
        };
        alone.save_png(&folder, &format!("{}-from-rows", shown.file()))?;
    }
    let points: Vec<[f64; 2]> = path.iter().map(|p| [p.deflection, p.load]).collect();
    let lines = [
        ("A-SO3-1", Some(151.0)),
        ("A-SO3-2", None),
        ("A-SO3-3", Some(267.1)),
    ];
    let scaled: Vec<Vec<[f64; 2]>> = [1.0, 1.4, 1.7]
        .map(|f| points.iter().map(|p| [f * p[0], f * p[1]]).collect())
        .into();
    let lines: Vec<GroupLine<'_>> = lines
        .iter()
        .zip(&scaled)
        .map(|((name, test_load_kn), path)| GroupLine {
            name,
            path,
            peak: path[capacity.peak],
            test_load_kn: *test_load_kn,
        })
        .collect();
    let group = GroupCurves {
        name: "A-SO3",
        lines: &lines,
    };
    group.save_svg(&folder, "group")?;
    group.save_png(&folder, "group")?;
    println!("see {}", folder.path().display());
    Ok(())
}

/// Rises to a jump, climbs again with two flagged steps, and falls.
fn path() -> Vec<PathPoint> {
    let load = |w: f64| match w {
        w if w < 1.6 => 132.0 * (1.0 - (-1.3 * w).exp()),
        w if w < 2.9 => 96.0 + 41.0 * (w - 1.6),
        w => 149.2 - 90.0 * (w - 2.9),
    };
    let point = |i: u32| {
        let w = 0.03 * f64::from(i);
        PathPoint {
            deflection: w,
            load: load(w),
            work_conjugate_load: load(w) * (1.0 + 0.012 * (9.0 * w).sin()),
            residual: 8e-4,
            flagged: i == 70 || i == 71,
            held: i == 54,
            unstable: false,
            kinetic: None,
            viscous: None,
        }
    };
    (0..=112).map(point).collect()
}

/// A grid of 60x4 and four plates.
fn elements() -> Vec<[[f64; 2]; 2]> {
    let (dx, dy) = (3050.0 / 60.0, 305.0 / 4.0);
    let cell = |i: u32| {
        let (x, y) = (dx * f64::from(i % 60), dy * f64::from(i / 60));
        [[x, y], [x + dx, y + dy]]
    };
    let plates = [
        (610.0, -20.0),
        (2440.0, -20.0),
        (1370.0, 305.0),
        (1680.0, 305.0),
    ];
    let plates = plates.map(|(x, y): (f64, f64)| [[x - 50.0, y], [x + 50.0, y + 20.0]]);
    (0..240).map(cell).chain(plates).collect()
}

/// Bending cracks, a diagonal one in the right span, and crushing under a load.
fn points() -> Vec<ConcretePoint> {
    let point = |i: u32| {
        let x = 12.7 + 25.4 * f64::from(i % 120);
        let y = 19.1 + 38.1 * f64::from(i / 120);
        let bending = (1.0 - ((x - 1525.0) / 1050.0).powi(2)).max(0.0);
        let vertical = 2.5e-3 * bending * (1.0 - y / 200.0).max(0.0);
        let off = (x - 1760.0) - (290.0 - y) * 1.9;
        let diagonal = 2e-2 * (-(off / 45.0).powi(2)).exp();
        let normal: [f64; 3] = if diagonal > vertical {
            [0.53, -0.85, 0.0]
        } else {
            let lean: f64 = (x - 1525.0) / 2000.0;
            [lean.cos(), -lean.sin(), 0.0]
        };
        let crushing = ((y - 250.0) / 50.0).max(0.0) * (1.0 - ((x - 1680.0) / 90.0).abs()).max(0.0);
        ConcretePoint {
            position: [x, y, 37.5],
            volume: 36_000.0,
            crack_strain: vertical.max(diagonal),
            crack_normal: normal,
            crushing,
        }
    };
    (0..960).map(point).collect()
}

/// Strips of 75 mm every 125 mm.
fn sheets() -> SheetLayout {
    let zone = |i: u32| {
        let from = 670.0 + 125.0 * f64::from(i);
        Zone {
            name: format!("strip {}", i + 1),
            x_mm: [from, from + 75.0],
            y_mm: [0.0, 305.0],
            covered_mm: 305.0,
        }
    };
    SheetLayout {
        zones: (0..14).map(zone).collect(),
        stirrups_in_spans: vec![6, 0],
    }
}

/// Slip and stress along a diagonal crack in the right span; one element of 75 mm per strip, four over the height.
fn sheet_state() -> SheetState {
    let gauss = [(0.1127, 0.2778), (0.5, 0.4444), (0.8873, 0.2778)];
    let mut state = SheetState::default();
    for (zone, strip) in sheets().zones.iter().enumerate() {
        for line in 0..4 {
            for ((a, wa), (b, wb)) in gauss.into_iter().flat_map(|a| gauss.map(|b| (a, b))) {
                let x = strip.x_mm[0] + 75.0 * a;
                let y = 76.25 * (f64::from(line) + b);
                let off = (x - 1760.0) - (290.0 - y) * 1.9;
                let slip = 0.31 * (-(off / 110.0).powi(2)).exp();
                let (position, area_mm2) = ([x, y, 75.0], 75.0 * 76.25 * wa * wb);
                state.sheet.push(SheetPoint {
                    position,
                    zone,
                    face: Face::Side,
                    area_mm2,
                    hoop_n_per_mm: 0.165 * 1390.0 * (-(off / 160.0).powi(2)).exp(),
                    fibre_stress_mpa: 1390.0 * (-(off / 160.0).powi(2)).exp(),
                    utilisation: 0.3,
                });
                state.interface.push(InterfacePoint {
                    position,
                    zone,
                    face: Face::Side,
                    area_mm2,
                    slip_mm: slip,
                    slip_max_mm: slip,
                    s0_mm: 0.05,
                    sf_mm: 0.19,
                });
            }
        }
    }
    state
}
