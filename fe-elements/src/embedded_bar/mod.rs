//! Reinforcing bars embedded in hexahedra of any shape.
//!
//! A bar is a polyline. With perfect bond it shares the displacements of its hosts: at a point of direction
//! t the axial strain is e = t . (grad u) t, and the internal force is int A sigma B^T ds. The polyline is cut
//! at every face of a host, because the strain has a kink there; a piece in an affine host is integrated
//! with two Gauss points (the strain along a line is at most cubic), in a distorted one with four. A bar that
//! slips has nodes of its own, [`Hosts::slipping`], and a bond element beside it.

mod cut;
mod dowel;
mod element;
mod row;

pub use cut::Piece;
pub use dowel::Dowel;
pub use element::EmbeddedBar;

use std::sync::Arc;

use fe_core::element::ElementError;
use fe_core::kinematics::Axial;
use fe_core::material::Material;
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::shape::hex20;
use nalgebra::Vector3;

use cut::Host;

/// A bar before it is embedded.
#[derive(Debug, Clone)]
pub struct Bar {
    /// Name, for messages and gauges.
    pub name: String,
    /// Corners of the polyline (mm).
    pub polyline: Vec<[f64; 3]>,
    /// Cross-section (mm2).
    pub area_mm2: f64,
    /// Uniaxial law.
    pub law: Arc<dyn Material<Axial>>,
    /// Transverse stiffness where the bar crosses cracks, if any.
    pub dowel: Option<Dowel>,
}

impl Bar {
    fn check(&self) -> Result<(), ElementError> {
        let input = |what: &str, value: f64, allowed: &str, remedy: &str| ElementError::Input {
            what: format!("bar {}: {what}", self.name),
            value,
            allowed: allowed.into(),
            remedy: remedy.into(),
        };
        if !(self.area_mm2.is_finite() && self.area_mm2 > 0.0) {
            return Err(input(
                "area_mm2",
                self.area_mm2,
                "(0, inf)",
                "give a positive area",
            ));
        }
        if self.polyline.len() < 2 {
            let count = self.polyline.len() as f64;
            return Err(input(
                "number of points",
                count,
                "2 or more",
                "give both ends of the bar",
            ));
        }
        if let Some(bad) = self.polyline.iter().flatten().find(|c| !c.is_finite()) {
            return Err(input(
                "coordinate",
                *bad,
                "finite numbers",
                "give coordinates in mm",
            ));
        }
        if self.length_mm() <= 0.0 {
            return Err(input(
                "length_mm",
                0.0,
                "(0, inf)",
                "give two different points",
            ));
        }
        Ok(())
    }

    /// Length of the polyline (mm).
    pub fn length_mm(&self) -> f64 {
        let segments = self.polyline.windows(2);
        segments
            .map(|w| (Vector3::from(w[1]) - Vector3::from(w[0])).norm())
            .sum()
    }
}

/// Embeds bars in the hexahedra of the named blocks; one element per bar and host.
///
/// A piece on a face or edge shared by several hosts belongs to the first of them: the displacement is
/// continuous there, so any host gives the same axial strain along the face.
///
/// # Errors
///
/// [`ElementError::NoHost`] naming the first point of a bar that lies in no host,
/// [`ElementError::NoSuchBlock`] for an unknown block, [`ElementError::Input`] for an impossible bar.
pub fn embed(
    bars: &[Bar],
    mesh: &Mesh,
    host_blocks: &[&str],
) -> Result<Vec<EmbeddedBar>, ElementError> {
    let hosts = Hosts::new(mesh, host_blocks)?;
    let mut elements = Vec::new();
    for bar in bars {
        let mut by_host: Vec<(usize, Vec<Piece>)> = Vec::new();
        for piece in hosts.cut(bar)? {
            match by_host.iter_mut().find(|(h, _)| *h == piece.host) {
                Some((_, own)) => own.push(piece),
                None => by_host.push((piece.host, vec![piece])),
            }
        }
        for (host, pieces) in by_host {
            elements.push(EmbeddedBar::new(bar, &hosts.0[host], &pieces)?);
        }
    }
    Ok(elements)
}

/// Hexahedra that can carry bars.
#[derive(Debug, Clone)]
pub struct Hosts(Vec<Host>);

impl Hosts {
    /// Cells of the named blocks, in the order of the mesh.
    ///
    /// # Errors
    ///
    /// [`ElementError::NoSuchBlock`] for a name that no block of hexahedra has.
    pub fn new(mesh: &Mesh, blocks: &[&str]) -> Result<Self, ElementError> {
        let hexahedra = || mesh.blocks().iter().filter(|b| b.kind == CellKind::Hex20);
        if let Some(unknown) = blocks.iter().find(|n| hexahedra().all(|b| b.name != **n)) {
            let known: Vec<&str> = hexahedra().map(|b| b.name.as_str()).collect();
            return Err(ElementError::NoSuchBlock {
                block: (*unknown).into(),
                known: known.join(", "),
            });
        }
        let named = hexahedra().filter(|b| blocks.contains(&b.name.as_str()));
        let host = |cell: &[NodeId]| {
            let nodes: [NodeId; 20] = std::array::from_fn(|a| cell[a]);
            Host::new(nodes, &nodes.map(|n| mesh.nodes()[n]))
        };
        Ok(Self(named.flat_map(|b| b.cells().map(host)).collect()))
    }

    /// Cuts a bar at every face of its hosts. The pieces follow one another along the bar, each begins where the
    /// one before it ends, and each lies in exactly one host: of several that hold it, the first.
    ///
    /// # Errors
    ///
    /// [`ElementError::NoHost`] naming the first point of the bar that lies in no host, [`ElementError::Input`] for an
    /// impossible bar.
    pub fn cut(&self, bar: &Bar) -> Result<Vec<Piece>, ElementError> {
        bar.check()?;
        let mut pieces = Vec::new();
        let mut travelled = 0.0;
        for ends in bar.polyline.windows(2) {
            let (a, b) = (Vector3::from(ends[0]), Vector3::from(ends[1]));
            let length = (b - a).norm();
            if length == 0.0 {
                continue;
            }
            pieces.extend(cut::cut(&bar.name, a, b, travelled, &self.0)?);
            travelled += length;
        }
        Ok(pieces)
    }

    /// The `piece` of a bar that slips, on three nodes of its own: its ends, then its middle. The bond that holds it along
    /// its axis and across is not part of it.
    ///
    /// # Errors
    ///
    /// [`ElementError::NoHost`] where the piece does not lie in its host, [`ElementError::Input`] for an impossible bar, or a
    /// piece without length, or whose direction is no unit vector from its first end to the second.
    pub fn slipping(
        &self,
        bar: &Bar,
        piece: &Piece,
        own: [NodeId; 3],
    ) -> Result<EmbeddedBar, ElementError> {
        bar.check()?;
        let host = self.0.get(piece.host);
        let host = host.ok_or_else(|| ElementError::no_host(&bar.name, piece.ends[0]))?;
        if let Some(end) = piece.ends.iter().find(|end| !host.holds(**end)) {
            return Err(ElementError::no_host(&bar.name, *end));
        }
        piece.check(&bar.name)?;
        EmbeddedBar::slipping(bar, host, piece, own)
    }

    /// Nodes and coordinates (mm) of a host, `None` if there is none of that number.
    pub fn cell(&self, host: usize) -> Option<([NodeId; 20], [[f64; 3]; 20])> {
        self.0.get(host).map(|h| (h.nodes, h.coords))
    }
}

/// Gradients (1/mm) of the host's shape functions at a point (mm) inside it.
fn gradients_at(host: &Host, point: Vector3<f64>) -> Option<[[f64; 3]; 20]> {
    let xi = host.natural(point)?;
    Some(hex20::map(&host.coords, xi).1)
}
