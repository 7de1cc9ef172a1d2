//! Bars that slip: they have nodes of their own, bonded to the concrete around them.

use std::sync::Arc;

use fe_contact::envelope::ModelCode;
use fe_contact::{BondSettings, BondSlip, BondSlipBar, Envelope, SlipDamage};
use fe_core::element::{Element, ElementError};
use fe_core::mesh::Mesh;
use fe_core::shape::hex20;
use fe_elements::{Bar, Hosts, Led};

use super::{BuildError, ModelSettings, laws};
use crate::spec::{BarBond, Specimen};

/// Pieces shorter than this (mm) are rounding: the bar ends at the face, or begins there.
const SHORT: f64 = 1e-6;

/// Elements of one kind.
type Elements = Vec<Box<dyn Element>>;

/// How a bar slips.
#[derive(Debug, Clone)]
pub(super) struct Slip {
    bond: BondSlipBar,
    /// Whether the concrete holds its ends.
    held: bool,
}

/// Slip of `count` bars of one diameter (mm) at one place, with ends that are `held` or not; `None` if their bond is perfect.
///
/// The strength of the concrete is the mean as the preset reads the report. All bars of the place count: n bars of
/// diameter phi have the surface n pi phi per length, that of one bar of diameter n phi. Across its axis a bar is held
/// by the stiffness that [`BondSettings`] gives the normal of a bonded face, 10 K0.
pub(super) fn slip(
    specimen: &Specimen,
    settings: &ModelSettings,
    (count, diameter_mm): (u8, f64),
    (bond, held): (&BarBond, bool),
) -> Result<Option<Slip>, BuildError> {
    let strength = laws::mean_strength(specimen, settings)?;
    let Some(parameters) = bond.parameters(strength) else {
        return Ok(None);
    };
    let curve = ModelCode::new(&parameters)?;
    let across = BondSettings::default();
    let bond = BondSlipBar {
        diameter_mm: f64::from(count) * diameter_mm,
        transverse_mpa_per_mm: across.normal_over_initial * curve.stiffness(),
        law: Arc::new(SlipDamage::new(curve, across)?),
    };
    Ok(Some(Slip { bond, held }))
}

/// Cuts a straight bar at every face of the concrete `blocks` and gives each piece three nodes, the ends shared with
/// its neighbours. Returns the pieces and their bonds, in order along the bar.
///
/// Ends that are held move with the concrete; nothing anchors a bar with free ends but its bond.
pub(super) fn lay(
    bar: &Bar,
    slip: &Slip,
    mesh: &mut Mesh,
    blocks: &[&str],
) -> Result<(Elements, Elements), BuildError> {
    let hosts = Hosts::new(mesh, blocks)?;
    let mut pieces = hosts.cut(bar)?;
    pieces.retain(|piece| (piece.ends[1] - piece.ends[0]).norm() > SHORT);
    let (mut steel, mut bonds) = (Elements::new(), Elements::new());
    let mut last = None;
    let count = pieces.len();
    for (i, piece) in pieces.into_iter().enumerate() {
        let ends = piece.ends;
        let outside = |end: usize| ElementError::no_host(&bar.name, ends[end]);
        let first = match last {
            Some(node) => node,
            None => mesh.add_node(ends[0].into())?,
        };
        let middle = 0.5 * (ends[0] + ends[1]);
        let own = [
            first,
            mesh.add_node(ends[1].into())?,
            mesh.add_node(middle.into())?,
        ];
        last = Some(own[1]);
        let (around, host) = hosts.cell(piece.host).ok_or_else(|| outside(0))?;
        let places = own.map(|n| mesh.nodes()[n]);
        let all = std::array::from_fn(|a| if a < 3 { own[a] } else { around[a - 3] });
        let mut pair: [Box<dyn Element>; 2] = [
            Box::new(hosts.slipping(bar, &piece, own)?),
            Box::new(BondSlip::new(all, &places, &host, &slip.bond)?),
        ];
        for end in [0, 1] {
            if !slip.held || (end == 0 && i > 0) || (end == 1 && i + 1 < count) {
                continue;
            }
            let natural = hex20::inverse_map(&host, places[end]);
            let natural = natural.ok_or_else(|| outside(end))?;
            let weights = hex20::shape(natural).0;
            let between: Vec<_> = around.into_iter().zip(weights).collect();
            let [piece, bond] = pair;
            pair = [
                Led::hung(piece, own[end], &between)?,
                Led::hung(bond, own[end], &between)?,
            ];
        }
        let [piece, bond] = pair;
        steel.push(piece);
        bonds.push(bond);
    }
    Ok((steel, bonds))
}
