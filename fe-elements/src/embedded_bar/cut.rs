//! Cutting straight segments at the faces of their hosts.

use fe_core::element::ElementError;
use fe_core::mesh::NodeId;
use fe_core::shape::hex20;
use nalgebra::{Matrix3, Vector3};

/// Natural coordinates up to 1 + this count as inside: a bar on a face must find its host.
const INSIDE: f64 = 1e-9;
/// Intervals shorter than this share of a segment are dropped.
const SLIVER: f64 = 1e-10;
/// Samples per segment in a distorted host, between which entries and exits are bracketed.
const SAMPLES: usize = 64;

/// A hexahedron that can carry bars.
#[derive(Debug, Clone)]
pub(super) struct Host {
    pub(super) nodes: [NodeId; 20],
    pub(super) coords: [[f64; 3]; 20],
    /// For an affine cell: centre and the map from position to natural coordinates.
    affine: Option<(Vector3<f64>, Matrix3<f64>)>,
    low: Vector3<f64>,
    high: Vector3<f64>,
}

/// A straight piece of a bar inside one host.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Piece {
    pub(super) host: usize,
    pub(super) ends: [Vector3<f64>; 2],
    /// Arc length of the first end along the bar [mm].
    pub(super) start: f64,
}

impl Host {
    pub(super) fn new(nodes: [NodeId; 20], coords: &[[f64; 3]; 20]) -> Self {
        let x = |a: usize| Vector3::from(coords[a]);
        let affine = hex20::is_affine(coords).then(|| {
            let edges = Matrix3::from_columns(&[x(1) - x(0), x(3) - x(0), x(4) - x(0)]);
            let centre = 0.5 * (x(0) + x(6));
            edges.try_inverse().map(|inverse| (centre, 2.0 * inverse))
        });
        let fold = |start: f64, f: fn(f64, f64) -> f64| {
            Vector3::from_fn(|k, _| coords.iter().map(|c| c[k]).fold(start, f))
        };
        let (low, high) = (fold(f64::MAX, f64::min), fold(f64::MIN, f64::max));
        Self {
            nodes,
            coords: *coords,
            affine: affine.flatten(),
            low,
            high,
        }
    }

    pub(super) const fn is_affine(&self) -> bool {
        self.affine.is_some()
    }

    /// Natural coordinates of a point, if the map can be inverted there.
    pub(super) fn natural(&self, point: Vector3<f64>) -> Option<[f64; 3]> {
        match &self.affine {
            Some((centre, map)) => Some((map * (point - centre)).into()),
            None => hex20::inverse_map(&self.coords, point.into()),
        }
    }

    /// Parameters in [0, 1] between which the segment from `a` to `b` runs inside.
    fn intervals(&self, a: Vector3<f64>, b: Vector3<f64>) -> Vec<(f64, f64)> {
        let slack = 0.05 * (self.high - self.low).norm();
        for k in 0..3 {
            if a[k].max(b[k]) < self.low[k] - slack || a[k].min(b[k]) > self.high[k] + slack {
                return Vec::new();
            }
        }
        match &self.affine {
            Some((centre, map)) => clip(map * (a - centre), map * (b - centre))
                .into_iter()
                .collect(),
            None => self.search(a, b),
        }
    }

    fn search(&self, a: Vector3<f64>, b: Vector3<f64>) -> Vec<(f64, f64)> {
        let outside = |t: f64| -> f64 {
            self.natural(a + t * (b - a)).map_or(1.0, |xi| {
                xi.iter().fold(0.0_f64, |m, c| m.max(c.abs())) - 1.0 - INSIDE
            })
        };
        let edge = |mut low: f64, mut high: f64, entering: bool| {
            for _ in 0..60 {
                let mid = low.midpoint(high);
                if (outside(mid) <= 0.0) == entering {
                    high = mid;
                } else {
                    low = mid;
                }
            }
            low.midpoint(high)
        };
        let mut found = Vec::new();
        let mut since = (outside(0.0) <= 0.0).then_some(0.0);
        for i in 1..=SAMPLES {
            let (before, t) = ((i - 1) as f64 / SAMPLES as f64, i as f64 / SAMPLES as f64);
            let inside = outside(t) <= 0.0;
            match (since, inside) {
                (None, true) => since = Some(edge(before, t, true)),
                (Some(start), false) => {
                    found.push((start, edge(before, t, false)));
                    since = None;
                }
                _ => {}
            }
        }
        found.extend(since.map(|start| (start, 1.0)));
        found
    }
}

/// Liang and Barsky's clipping of a segment in natural coordinates against the cube.
fn clip(a: Vector3<f64>, b: Vector3<f64>) -> Option<(f64, f64)> {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for k in 0..3 {
        let d = b[k] - a[k];
        if d.abs() < 1e-12 {
            if a[k].abs() > 1.0 + INSIDE {
                return None;
            }
            continue;
        }
        let (t0, t1) = ((-1.0 - a[k]) / d, (1.0 - a[k]) / d);
        low = low.max(t0.min(t1));
        high = high.min(t0.max(t1));
    }
    (high - low > SLIVER).then_some((low, high))
}

/// Pieces of the segment from `a` to `b`, every stretch in exactly one host.
pub(super) fn cut(
    name: &str,
    a: Vector3<f64>,
    b: Vector3<f64>,
    travelled: f64,
    hosts: &[Host],
) -> Result<Vec<Piece>, ElementError> {
    let length = (b - a).norm();
    let mut claims: Vec<(f64, f64, usize)> = Vec::new();
    for (h, host) in hosts.iter().enumerate() {
        claims.extend(
            host.intervals(a, b)
                .into_iter()
                .map(|(low, high)| (low, high, h)),
        );
    }
    claims.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.2.cmp(&y.2)));
    let mut pieces = Vec::new();
    let mut reached = 0.0;
    let gap = 1e-9_f64.max(1e-7 / length);
    let no_host = |t: f64| {
        let at = a + t * (b - a);
        ElementError::NoHost {
            bar: name.into(),
            x: at[0],
            y: at[1],
            z: at[2],
        }
    };
    // Sweep: each claim extends what is covered; of equal starts the first host wins, unless it ends at once.
    while reached < 1.0 - gap {
        let next = claims
            .iter()
            .filter(|(low, high, _)| *low <= reached + gap && *high > reached + gap)
            .min_by_key(|c| c.2)
            .ok_or_else(|| no_host(reached + 0.5 * gap))?;
        let end = next.1.min(1.0);
        pieces.push(Piece {
            host: next.2,
            ends: [a + reached * (b - a), a + end * (b - a)],
            start: travelled + reached * length,
        });
        reached = end;
    }
    // The last sliver belongs to the last piece.
    if let Some(last) = pieces.last_mut() {
        last.ends[1] = b;
    }
    Ok(pieces)
}
