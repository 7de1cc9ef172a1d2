//! STAB-22: reinforced tie of 1000 mm, 100 mm x 100 mm, one ribbed bar of 16 mm that slips, drawn by its bar to a strain of
//! 1e-3: it cracks step by step, and the number of cracks does not depend on the cells.

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
use fe_solver::control::StepControl;
use fe_solver::recorder::{Continue, Recorder, StepView};
use fe_solver::stage::{Counters, Stage};

use crate::mesh::{BLOCK, boxes, cells, lines};
use crate::stability::{Case, Failure, Figure, Method, Scenario};

const LENGTH: f64 = 1000.0;
const SIDE: f64 = 100.0;
const DIAMETER: f64 = 16.0;
const AREA: f64 = 0.25 * PI * DIAMETER * DIAMETER;
/// Cells of 100 mm share a strength.
const PATCHES: usize = 10;

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

#[derive(Default)]
struct Watch {
    marked: usize,
    counters: Counters,
    stopped: Option<String>,
}

impl Recorder for Watch {
    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        self.marked += usize::from(view.flagged);
        self.counters = *view.stage.counters();
        Ok(Continue::Yes)
    }
}

/// Number of cracks, stretches of cells that are open by more than 0.02 mm, at the end; steps that missed the criterion.
fn cracks(method: Method, n: usize) -> Option<Result<(usize, Watch), Failure>> {
    let step = 0.01;
    let mut driver = method.imposing(step)?;
    let mut count = || -> Result<(usize, Watch), Failure> {
        let (model, bar) = tie(n)?;
        let mut conditions = Conditions::new(&model);
        conditions.fix(&model, bar[0], Dof::Ux)?;
        conditions.prescribe(&model, bar[2 * n], Dof::Ux, 1.0)?;
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
            criterion: 1e-3,
            shortest: step / 64.0,
            ..StepControl::new(step, 1e-3 * LENGTH)
        };
        let mut watch = Watch::default();
        let end = control.run(&mut stage, driver.as_mut(), &mut watch);
        watch.stopped = end.err().map(|error| error.to_string());
        let u = stage.displacement().to_vec();
        let mut open = Vec::new();
        for e in (0..model.elements().len()).step_by(3) {
            let mut widest = 0.0_f64;
            let own = model.gather(e, &u);
            model.elements()[e].sample(&own, state.committed(e), &mut |s| {
                widest = widest.max(s.report.crack_strain * LENGTH / n as f64);
            })?;
            open.push(widest > 0.02);
        }
        let starts = open.windows(2).filter(|w| !w[0] && w[1]).count();
        Ok((starts + usize::from(open[0]), watch))
    };
    Some(count())
}

fn run(method: Method) -> Option<Result<Case, Failure>> {
    let coarse = cracks(method, 20)?;
    let fine = cracks(method, 40)?;
    Some(coarse.and_then(|(coarse, first)| {
        let (fine, watch) = fine?;
        Ok(Case {
            figures: vec![
                Figure::at_least("cracks, 20 cells", coarse as f64, 2.0),
                Figure::near(
                    "cracks, 40 cells",
                    fine as f64,
                    coarse as f64,
                    1.01 / coarse as f64,
                ),
            ],
            stopped: first.stopped.or(watch.stopped),
            marked: first.marked + watch.marked,
            counters: watch.counters,
        })
    }))
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-22",
    title: "reinforced tie with bond slip: cracks one after the other",
    coarse: &[],
    run: |method, _| run(method),
};
