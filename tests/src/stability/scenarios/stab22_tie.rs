//! STAB-22: reinforced tie of 1000 mm, 100 mm x 100 mm, one ribbed bar of 16 mm that slips: it cracks step by step, and the
//! number of cracks does not depend on the cells.
//!
//! Targets: no step opens more than one crack, and as many are open at the end in 40 cells as in 20. The bar is drawn by its end,
//! by 1 mm, and, as the catalogue asks, under load control, to 60 kN; where bond is perfect and no place is weaker all cracks
//! come at once there (STR-05). Under load control every crack is a snap at a held force, which the secant driver passes and
//! marks; Newton-Raphson stops at the first and says so. The automatic driver follows the path under the force, back through every
//! snap: to five cracks in 20 cells and six in 40 (asked: as many; one more is allowed).

use std::f64::consts::PI;
use std::sync::Arc;

use fe_contact::envelope::{Bond, Confinement, ModelCode, ModelCodeParameters};
use fe_contact::{BondSettings, BondSlip, BondSlipBar, SlipDamage};
use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_core::testing::Random;
use fe_elements::{BandWidth, Hex20, HexRule, Truss3};
use fe_materials::Biso;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::newton::NewtonSettings;
use fe_solver::recorder::{Continue, Recorder, StepView};
use fe_solver::stage::{Counters, Stage};

use crate::follow::marked;
use crate::mesh::{BLOCK, boxes, cells, lines};
use crate::stability::{Case, Failure, Figure, Method, Scenario};

const LENGTH: f64 = 1000.0;
const SIDE: f64 = 100.0;
const DIAMETER: f64 = 16.0;
const AREA: f64 = 0.25 * PI * DIAMETER * DIAMETER;
/// Cells of 100 mm share a strength.
const PATCHES: usize = 10;
/// Force (N) to which the bar is pulled.
const LOAD: f64 = 60_000.0;
/// Relative residual of a step.
const CRITERION: f64 = 1e-3;

/// A tie of `n` cells, and the nodes of its bar. The strength of every tenth of its length scatters by 5 %.
fn tie(n: usize) -> Result<(Model, Vec<NodeId>), Failure> {
    let half = 0.5 * SIDE;
    let host = boxes(&lines(0.0, LENGTH, n), &[-half, half], &[-half, half])?;
    let first = host.nodes().len();
    let mut nodes = host.nodes().to_vec();
    nodes.extend(lines(0.0, LENGTH, 2 * n).into_iter().map(|x| [x, 0.0, 0.0]));
    let mut mesh = Mesh::new(nodes)?;
    let connectivity = host.blocks()[0].cells().flatten().copied().collect();
    mesh.add_block(BLOCK, CellKind::Hex20, connectivity)?;
    let mut random = Random::new(22);
    let strengths: Vec<f64> = (0..PATCHES)
        .map(|_| 2.2 * random.uniform(0.95, 1.05))
        .collect();
    let steel = Arc::new(Biso::hot_rolled(200_000.0, 460.0, 2000.0)?);
    let curve = ModelCode::new(&ModelCodeParameters {
        fcm_mpa: 30.0,
        rib_spacing_mm: 8.0,
        bond: Bond::Good,
        confinement: Confinement::PullOut,
    })?;
    let bond = BondSlipBar {
        diameter_mm: DIAMETER,
        transverse_mpa_per_mm: 1e3,
        law: Arc::new(SlipDamage::new(curve, BondSettings::default())?),
    };
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    for (i, (around, coords)) in cells(&mesh, &mesh.blocks()[0]).enumerate() {
        let strength = strengths[i * PATCHES / n];
        let concrete = FixedCrackParameters::from_strength(30.0, strength, 30_000.0);
        let law = Arc::new(FixedCrack::new(concrete, None)?);
        let band = BandWidth::Fixed(LENGTH / n as f64);
        elements.push(Box::new(Hex20::new(
            around,
            &coords,
            HexRule::Full,
            law,
            band,
        )?));
        let own = [0, 2, 1].map(|k| first + 2 * i + k);
        let places = own.map(|n| mesh.nodes()[n]);
        let all = std::array::from_fn(|a| if a < 3 { own[a] } else { around[a - 3] });
        elements.push(Box::new(Truss3::new(own, &places, AREA, steel.clone())?));
        elements.push(Box::new(BondSlip::new(all, &places, &coords, &bond)?));
    }
    Ok((
        Model::new(mesh, elements)?,
        (first..=first + 2 * n).collect(),
    ))
}

/// How the end of the bar is drawn.
#[derive(Debug, Clone, Copy)]
enum Drawn {
    /// By 1 mm.
    Moved,
    /// By 60 kN.
    Pulled,
    /// To 60 kN along the path.
    Followed,
}

/// Cracks, stretches of cells that are open by more than 0.02 mm, step by step.
struct Watch {
    /// At every step.
    cracks: Vec<usize>,
    /// Steps that jumped, or missed the criterion.
    marked: usize,
    counters: Counters,
    stopped: Option<String>,
}

impl Watch {
    /// At the end.
    fn last(&self) -> usize {
        self.cracks.last().copied().unwrap_or(0)
    }

    /// Most that opened in one step.
    fn at_once(&self) -> usize {
        let before = std::iter::once(&0).chain(&self.cracks);
        let new = before.zip(&self.cracks).map(|(a, b)| b.saturating_sub(*a));
        new.max().unwrap_or(0)
    }
}

impl Recorder for Watch {
    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        self.marked += usize::from(marked(view, CRITERION));
        self.counters = *view.stage.counters();
        let model = view.stage.model();
        let u = view.stage.displacement();
        let hosts = (0..model.elements().len()).step_by(3);
        let width = LENGTH / hosts.len() as f64;
        let mut open = vec![false];
        for e in hosts {
            let mut widest = 0.0_f64;
            let state = view.stage.state().committed(e);
            let seen = model.elements()[e].sample(&model.gather(e, u), state, &mut |s| {
                widest = widest.max(s.report.crack_strain * width);
            });
            seen.map_err(std::io::Error::other)?;
            open.push(widest > 0.02);
        }
        let starts = open.windows(2).filter(|w| !w[0] && w[1]).count();
        self.cracks.push(starts);
        Ok(if view.stage.lambda() >= LOAD {
            Continue::Stop("the load is reached".into())
        } else {
            Continue::Yes
        })
    }
}

/// A tie of `n` cells, drawn by a method.
fn cracks(method: Method, n: usize, drawn: Drawn) -> Option<Result<Watch, Failure>> {
    let (step, end) = match drawn {
        Drawn::Moved => (0.01, 1.0),
        Drawn::Pulled => (500.0, LOAD),
        Drawn::Followed => (0.01, 10.0),
    };
    let mut driver: Box<dyn Driver> = match drawn {
        Drawn::Followed => Box::new(Automatic::new(NewtonSettings::default())),
        Drawn::Moved | Drawn::Pulled => method.imposing(step)?,
    };
    let mut watch = || -> Result<Watch, Failure> {
        let (model, bar) = tie(n)?;
        let mut conditions = Conditions::new(&model);
        conditions.fix(&model, bar[0], Dof::Ux)?;
        let loaded = bar[2 * n];
        match drawn {
            Drawn::Moved => conditions.prescribe(&model, loaded, Dof::Ux, 1.0)?,
            Drawn::Pulled | Drawn::Followed => {
                conditions.add_reference(&model, loaded, Dof::Ux, 1.0)?;
            }
        }
        for (node, x) in model.mesh().nodes().iter().enumerate() {
            for (k, dof) in [(1, Dof::Uy), (2, Dof::Uz)] {
                if x[k] <= 0.0 {
                    conditions.fix(&model, node, dof)?;
                }
            }
        }
        let mut state = StateStore::new(model.elements());
        let virgin = vec![0.0; model.dofs().len()];
        let mut stage = Stage::new(&model, conditions, &mut state, virgin)?;
        let control = StepControl {
            criterion: CRITERION,
            shortest: step / 64.0,
            ..StepControl::new(step, end)
        };
        let mut watch = Watch {
            cracks: Vec::new(),
            marked: 0,
            counters: Counters::default(),
            stopped: None,
        };
        let end = control.run(&mut stage, driver.as_mut(), &mut watch);
        watch.stopped = end.err().map(|error| error.to_string());
        Ok(watch)
    };
    Some(watch())
}

/// Cracks in 20 and 40 cells, which may differ by `slack`, at the end and in one step.
fn figures((by, slack): (&str, f64), [coarse, fine]: [&Watch; 2]) -> [Figure; 3] {
    let as_many = |figure: Figure| {
        if slack > 0.0 {
            figure.measured("as many as in 20")
        } else {
            figure
        }
    };
    let [few, many] = [coarse, fine].map(|watch| watch.last() as f64);
    let at_once = coarse.at_once().max(fine.at_once()) as f64;
    [
        Figure::at_least(format!("cracks, 20 cells, {by}"), few, 2.0),
        as_many(Figure::near(
            format!("cracks, 40 cells, {by}"),
            many,
            few,
            slack / few.max(1.0),
        )),
        Figure::at_most(format!("cracks that open in one step, {by}"), at_once, 1.0),
    ]
}

fn run(method: Method) -> Option<Result<Case, Failure>> {
    let moved = [20, 40].map(|n| cracks(method, n, Drawn::Moved));
    let [Some(coarse), Some(fine)] = moved else {
        return None;
    };
    let case = || -> Result<Case, Failure> {
        let (coarse, fine) = (coarse?, fine?);
        let mut figures_of_all = Vec::from(figures(("moved", 0.0), [&coarse, &fine]));
        let mut stopped = coarse.stopped.or(fine.stopped);
        let mut marked = coarse.marked + fine.marked;
        if method == Method::Automatic {
            for (drawn, by) in [
                (Drawn::Pulled, ("pulled, secant driver", 0.0)),
                (Drawn::Followed, ("followed", 1.0)),
            ] {
                let pulled = [20, 40].map(|n| cracks(Method::SecantLoad, n, drawn));
                let [Some(coarse), Some(fine)] = pulled else {
                    return Err("no driver under a force".into());
                };
                let (coarse, fine) = (coarse?, fine?);
                figures_of_all.extend(figures(by, [&coarse, &fine]));
                stopped = stopped.or(coarse.stopped).or(fine.stopped);
                marked += coarse.marked + fine.marked;
            }
        }
        Ok(Case {
            figures: figures_of_all,
            stopped,
            marked,
            counters: fine.counters,
        })
    };
    Some(case())
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-22",
    title: "reinforced tie with bond slip: cracks one after the other",
    remark: "",
    coarse: &[],
    run: |method, _| run(method),
};
