//! Bars that slip: trusses with nodes of their own, bonded to the concrete around them.

use std::sync::Arc;

use fe_contact::envelope::ModelCode;
use fe_contact::{BondSettings, BondSlip, BondSlipBar, Envelope, SlipDamage};
use fe_core::element::{Element, ElementError};
use fe_core::mesh::Mesh;
use fe_elements::{Bar, Hosts, Piece, Truss3};
use nalgebra::Vector3;

use super::{BuildError, ModelSettings, laws};
use crate::spec::{self, Specimen};

/// Pieces shorter than this (mm) are rounding: the bar ends at the face, or begins there.
const SHORT: f64 = 1e-6;

/// Elements of one kind.
type Elements = Vec<Box<dyn Element>>;

/// Bond of the bars at one place, `None` if it is perfect.
///
/// The strength of the concrete is the mean as the preset reads the report. All bars of the place count: n bars of
/// diameter phi have the surface n pi phi per length, that of one bar of diameter n phi. Across its axis a bar is held
/// by the stiffness that [`BondSettings`] gives the normal of a bonded face, 10 K0.
pub(super) fn bond(
    specimen: &Specimen,
    settings: &ModelSettings,
    bar: &spec::Bar,
) -> Result<Option<BondSlipBar>, BuildError> {
    let strength = laws::mean_strength(specimen, settings.preset)?;
    let Some(parameters) = bar.bond.parameters(strength) else {
        return Ok(None);
    };
    let curve = ModelCode::new(&parameters)?;
    let held = BondSettings::default();
    Ok(Some(BondSlipBar {
        diameter_mm: f64::from(bar.count_in_half.get()) * bar.diameter_mm.get(),
        transverse_mpa_per_mm: held.normal_over_initial * curve.stiffness(),
        law: Arc::new(SlipDamage::new(curve, held)?),
    }))
}

/// Cuts a straight bar at every face of the concrete `blocks` and gives each piece three nodes, the ends shared with
/// its neighbours. Returns the trusses and their bonds, in order along the bar.
///
/// The ends of the bar are free: nothing anchors it but its bond. A dowel of `bar` is left out, the trusses bear no
/// force across their axis.
pub(super) fn lay(
    bar: &Bar,
    slip: &BondSlipBar,
    mesh: &mut Mesh,
    blocks: &[&str],
) -> Result<(Elements, Elements), BuildError> {
    let hosts = Hosts::new(mesh, blocks)?;
    let mut pieces = hosts.cut(bar)?;
    pieces.retain(|piece| (piece.ends[1] - piece.ends[0]).norm() > SHORT);
    let (mut trusses, mut bonds) = (Elements::new(), Elements::new());
    let mut last = None;
    for Piece { host, ends, .. } in pieces {
        let (around, host) = hosts.cell(host).ok_or_else(|| ElementError::NoHost {
            bar: bar.name.clone(),
            x: ends[0][0],
            y: ends[0][1],
            z: ends[0][2],
        })?;
        let first = match last {
            Some(node) => node,
            None => mesh.add_node(ends[0].into())?,
        };
        let start = mesh.nodes()[first];
        let middle = 0.5 * (Vector3::from(start) + ends[1]);
        let own = [
            first,
            mesh.add_node(ends[1].into())?,
            mesh.add_node(middle.into())?,
        ];
        last = Some(own[1]);
        let places = own.map(|n| mesh.nodes()[n]);
        let truss = Truss3::new(own, &places, bar.area_mm2, Arc::clone(&bar.law))?;
        trusses.push(Box::new(truss));
        let all = std::array::from_fn(|a| if a < 3 { own[a] } else { around[a - 3] });
        bonds.push(Box::new(BondSlip::new(all, &places, &host, slip)?));
    }
    Ok((trusses, bonds))
}
