//! Cutting straight segments at the faces of their hosts.

use fe_core::element::ElementError;
use fe_core::mesh::NodeId;
use fe_core::shape::hex20;
use nalgebra::{Matrix3, Vector3};

/// Natural coordinates up to 1 + this count as inside: a bar on a face must find its host.
const INSIDE: f64 = 1e-9;
/// Share of a segment below which a stretch is rounding and gets no piece of its own.
const SLIVER: f64 = 1e-14;
/// Samples along a segment within the bounding box of a distorted host. Between two of them the largest distance outside is
/// sought where a sample is nearer to leaving than its neighbours; a stretch outside that is shorter and has its largest
/// distance elsewhere is not seen: the map of the host is continued there.
const SAMPLES: usize = 64;
/// Reductions, by the golden section, of the stretch that holds a largest distance: to a ten-thousandth.
const SECTIONS: usize = 20;
/// Bisections of the distance between two samples, down to rounding.
const BISECTIONS: usize = 50;

/// A hexahedron that can carry bars.
#[derive(Debug, Clone)]
pub(super) struct Host {
    pub(super) nodes: [NodeId; 20],
    pub(super) coords: [[f64; 3]; 20],
    /// For an affine cell: centre and the map from position to natural coordinates.
    affine: Option<(Vector3<f64>, Matrix3<f64>)>,
    /// Corners of a box that holds the cell: curved faces may bulge beyond the nodes.
    low: Vector3<f64>,
    high: Vector3<f64>,
}

/// A straight piece of a bar inside one host.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Number of the host among the [`Hosts`](super::Hosts).
    pub host: usize,
    /// Ends (mm).
    pub ends: [Vector3<f64>; 2],
    /// Unit vector from the first end to the second.
    pub direction: Vector3<f64>,
    /// Arc length of the first end along the bar (mm).
    pub start: f64,
}

impl Piece {
    /// Refuses a piece without length, or whose direction is no unit vector along it.
    pub(super) fn check(&self, bar: &str) -> Result<(), ElementError> {
        let length = (self.ends[1] - self.ends[0]).dot(&self.direction);
        let unit = (self.direction.norm() - 1.0).abs() <= 1e-6;
        if unit && length.is_finite() && length > 0.0 {
            return Ok(());
        }
        Err(ElementError::Input {
            what: format!("bar {bar}: length of a piece along its direction (mm)"),
            value: length,
            allowed: "(0, inf), along a unit vector".into(),
            remedy: "take the pieces that Hosts::cut gives".into(),
        })
    }
}

/// A segment a + t (b - a), t in [0, 1].
#[derive(Debug, Clone, Copy)]
struct Segment {
    a: Vector3<f64>,
    direction: Vector3<f64>,
}

impl Segment {
    fn at(&self, t: f64) -> Vector3<f64> {
        self.a + t * self.direction
    }

    /// Smallest t at which the segment, inside the box at `from`, leaves it; at most 1.
    ///
    /// A segment that stays within `tolerance` of a plane does not cross it.
    fn leaves_box(
        &self,
        from: f64,
        low: &Vector3<f64>,
        high: &Vector3<f64>,
        tolerance: f64,
    ) -> f64 {
        let end = self.at(1.0);
        let mut exit = 1.0_f64;
        for k in 0..3 {
            let d = self.direction[k];
            if end[k] > high[k] + tolerance {
                exit = exit.min((high[k] - self.a[k]) / d);
            } else if end[k] < low[k] - tolerance {
                exit = exit.min((low[k] - self.a[k]) / d);
            }
        }
        exit.max(from)
    }
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
        let slack = Vector3::repeat(0.1 * (high - low).norm());
        Self {
            nodes,
            coords: *coords,
            affine: affine.flatten(),
            low: low - slack,
            high: high + slack,
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

    /// Whether a point lies inside or, but for rounding, on a face.
    pub(super) fn holds(&self, point: Vector3<f64>) -> bool {
        self.outside(point) <= 1e-6
    }

    /// How far a point lies outside in natural coordinates: negative inside.
    fn outside(&self, point: Vector3<f64>) -> f64 {
        self.natural(point).map_or(f64::INFINITY, |xi| {
            xi.iter().fold(0.0_f64, |m, c| m.max(c.abs())) - 1.0
        })
    }

    /// Parameter at which `segment` leaves the cell, or `None` if it is not inside at `from`.
    fn exit(&self, segment: &Segment, from: f64) -> Option<f64> {
        let point = segment.at(from);
        let in_box = (0..3).all(|k| point[k] >= self.low[k] && point[k] <= self.high[k]);
        if !in_box || self.outside(point) > INSIDE {
            return None;
        }
        let Some((centre, map)) = &self.affine else {
            return Some(self.first_crossing(segment, from));
        };
        let natural = Segment {
            a: map * (segment.a - centre),
            direction: map * segment.direction,
        };
        let (low, high) = (Vector3::repeat(-1.0), Vector3::repeat(1.0));
        Some(natural.leaves_box(from, &low, &high, INSIDE))
    }

    /// First crossing of a face after `from`, by sampling and bisection.
    fn first_crossing(&self, segment: &Segment, from: f64) -> f64 {
        let end = segment.leaves_box(from, &self.low, &self.high, 0.0);
        let at = |i: usize| from + (end - from) * i as f64 / SAMPLES as f64;
        let reach = |t: f64| self.outside(segment.at(t));
        // What counts as inside for a bar along a face does so here: its rounding is no crossing.
        let crossing = |mut inside: f64, mut outside: f64| {
            for _ in 0..BISECTIONS {
                let mid = inside.midpoint(outside);
                if reach(mid) <= INSIDE {
                    inside = mid;
                } else {
                    outside = mid;
                }
            }
            inside
        };
        let (mut before, mut here) = (f64::NEG_INFINITY, reach(from));
        for i in 1..=SAMPLES {
            let next = reach(at(i));
            if here >= before && here > next {
                let (low, high) = (at(i.saturating_sub(2)), at(i));
                let peak = largest(reach, low, high);
                if reach(peak) > INSIDE {
                    return crossing(low, peak);
                }
            }
            if next > INSIDE {
                return crossing(at(i - 1), at(i));
            }
            (before, here) = (here, next);
        }
        end
    }
}

/// Where between two places a function with one maximum there is largest, by the golden section.
fn largest(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..SECTIONS {
        let step = share * (high - low);
        if value(high - step) < value(low + step) {
            low = high - step;
        } else {
            high = low + step;
        }
    }
    low.midpoint(high)
}

/// Pieces of the segment from `a` to `b`, every stretch in exactly one host: of several that hold it, the
/// first.
pub(super) fn cut(
    bar: &str,
    a: Vector3<f64>,
    b: Vector3<f64>,
    travelled: f64,
    hosts: &[Host],
) -> Result<Vec<Piece>, ElementError> {
    let segment = Segment {
        a,
        direction: b - a,
    };
    let length = segment.direction.norm();
    let mut pieces: Vec<Piece> = Vec::new();
    let mut reached = 0.0;
    while reached < 1.0 - SLIVER {
        let ahead = |(h, host): (usize, &Host)| {
            let exit = host.exit(&segment, reached)?;
            (exit > reached + SLIVER).then_some((h, exit))
        };
        let Some((host, exit)) = hosts.iter().enumerate().find_map(ahead) else {
            return Err(ElementError::no_host(bar, segment.at(reached)));
        };
        pieces.push(Piece {
            host,
            ends: [segment.at(reached), segment.at(exit)],
            direction: segment.direction / length,
            start: travelled + reached * length,
        });
        reached = exit;
    }
    Ok(pieces)
}
