//! What is wrong with a triangle.

use crate::net::{Kind, NONE, Net};
use hexdel_geom::{AngleBounds, DVec2, orient2d, quality};
use rustc_hash::FxHashMap;

/// An angle past its bound by this many degrees is still within: the
/// certificate's tolerance.
const TOLERANCE_DEG: f64 = hexdel_geom::ANGLE_TOLERANCE_DEG;

/// Degrees that one of two right angles opposite an edge must lose. Otherwise
/// the four corners are cocircular, and rounding decides whether the edge is
/// Delaunay. The plain mesh has such edges too; its templates keep them in
/// order.
const STRICT_DEG: f64 = 0.01;

/// Cosine of an angle that counts as a right one here: 90 - 1e-6 degrees.
const NEARLY_RIGHT: f64 = 1.75e-8;

/// Ring from which on triangles keep the bounds of the plain mesh.
pub(crate) const FAR_RING: u32 = 2;

/// The bounds of a mesh with segments in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judge<'a> {
    /// Triangles with a vertex less than [`FAR_RING`] edges from a point or
    /// segment.
    pub(crate) near: AngleBounds,
    /// All others.
    pub(crate) far: AngleBounds,
    /// Corners of the input in which nothing can be asked for.
    pub(crate) wedges: &'a Wedges,
}

/// The smallest and largest angle allowed at a corner, degrees.
pub(crate) type Limits = [f64; 2];

impl Judge<'_> {
    /// The bounds at the three corners.
    pub(crate) fn limits(&self, net: &Net, t: u32) -> [Limits; 3] {
        let tri = net.tri(t);
        if self.wedges.hold(net, tri.v) {
            return [WEDGE_LIMITS; 3];
        }
        self.ordinary_limits(net, t, true)
    }

    /// Whether an angle is out of bounds, wherever it is; right angles that
    /// only the edge between them suffers from are not.
    pub(crate) fn is_out(&self, net: &Net, t: u32) -> bool {
        penalty(net.corners(t), self.ordinary_limits(net, t, false)) > 0.0
    }

    fn ordinary_limits(&self, net: &Net, t: u32, strict: bool) -> [Limits; 3] {
        let tri = net.tri(t);
        if !strict && self.wedges.hold(net, tri.v) {
            return [[0.0, self.near.max_deg()]; 3];
        }
        let is_near = tri.v.iter().any(|&v| net.vertex(v).ring < FAR_RING);
        let bounds = if is_near { self.near } else { self.far };
        let [lo, hi] = [bounds.min_deg(), bounds.max_deg()];
        [0, 1, 2].map(|i| {
            if is_sector(net, t, i) {
                [0.0, hi]
            } else if strict && is_near && is_kite(net, t, i) {
                [lo, hi.min(90.0 - STRICT_DEG)]
            } else {
                [lo, hi]
            }
        })
    }

    /// The squares of what angles are past their bounds by, degrees, summed;
    /// 0 exactly if the triangle is in order.
    pub(crate) fn penalty(&self, net: &Net, t: u32) -> f64 {
        penalty(net.corners(t), self.limits(net, t))
    }

    /// The sum over triangles.
    pub(crate) fn sum(&self, net: &Net, tris: &[u32]) -> f64 {
        tris.iter().map(|&t| self.penalty(net, t)).sum()
    }
}

/// Limits of triangles that span a wedge: counter-clockwise, and not so flat that
/// an edge would not be Delaunay.
const WEDGE_LIMITS: Limits = [0.0, 90.0];

/// Pairs of pieces that leave a site at so small an angle that triangles
/// between them cannot keep any bounds. Least squares would spread their fault
/// over all that is around.
#[derive(Debug, Default)]
pub(crate) struct Wedges {
    /// By piece: the other piece of each wedge.
    others: FxHashMap<u32, Vec<u32>>,
    /// The sites at the ends of each piece.
    ends: Vec<[u32; 2]>,
}

impl Wedges {
    pub(crate) fn of(pairs: &[[u32; 2]], ends: Vec<[u32; 2]>) -> Self {
        let mut others: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for &[p, q] in pairs {
            others.entry(p).or_default().push(q);
            others.entry(q).or_default().push(p);
        }
        Self { others, ends }
    }

    /// Whether all corners of a triangle lie on the two pieces of a wedge.
    fn hold(&self, net: &Net, v: [u32; 3]) -> bool {
        if self.others.is_empty() {
            return false;
        }
        let kinds = v.map(|v| net.vertex(v).kind);
        let on = |kind: Kind, p: u32| match kind {
            Kind::Along { piece, .. } => piece == p,
            Kind::Site(site) => self.ends[p as usize].contains(&site),
            _ => false,
        };
        kinds.iter().any(|kind| match kind {
            Kind::Along { piece, .. } => self.others.get(piece).is_some_and(|others| {
                others.iter().any(|&q| kinds.iter().all(|&k| on(k, *piece) || on(k, q)))
            }),
            _ => false,
        })
    }
}

/// Whether the corner is an input point between two parts of segments: its
/// angle is the input's, and not for the mesh to choose.
pub(crate) fn is_sector(net: &Net, t: u32, i: usize) -> bool {
    let tri = net.tri(t);
    tri.s[(i + 1) % 3] != NONE
        && tri.s[(i + 2) % 3] != NONE
        && matches!(net.vertex(tri.v[i]).kind, Kind::Site(_))
}

/// Whether the angles on both sides of the edge opposite corner `i` are right
/// angles or more.
fn is_kite(net: &Net, t: u32, i: usize) -> bool {
    let is_wide = |t: u32, i: usize| {
        let [a, b, c] = [0, 1, 2].map(|k| net.at(net.tri(t).v[(i + k) % 3]));
        let (u, w) = (b - a, c - a);
        u.dot(w) <= NEARLY_RIGHT * (u.length_squared() * w.length_squared()).sqrt()
    };
    is_wide(t, i) && net.beyond(t, i).is_some_and(|(n, j)| is_wide(n, j))
}

/// Triangles that a free vertex must have. Four angles of 90 degrees at most
/// are four right angles, and rounding decides whether the edges around are
/// Delaunay.
pub(crate) const LEAST_DEGREE: usize = 5;

/// Whether a vertex has too few triangles to have good angles.
pub(crate) fn is_starved(net: &Net, v: u32) -> bool {
    net.vertex(v).kind == Kind::Free && net.degree(v) < LEAST_DEGREE
}

/// The penalty of a triangle against limits.
pub(crate) fn penalty(corners: [DVec2; 3], limits: [Limits; 3]) -> f64 {
    penalty_of(quality::angles_deg(corners), limits, corners)
}

/// The same with the angles known.
///
/// A triangle that is flat or turned over keeps no bounds. Its angles do not tell:
/// with corners in one place all are 0, which is no angle below a bound of 0.
pub(crate) fn penalty_of(angles: [f64; 3], limits: [Limits; 3], corners: [DVec2; 3]) -> f64 {
    let tolerance = TOLERANCE_DEG + quality::rounding_deg(corners);
    let past_bounds: f64 = (0..3)
        .map(|i| {
            let past = (limits[i][0] - angles[i]).max(angles[i] - limits[i][1]);
            if past > tolerance { past * past } else { 0.0 }
        })
        .sum();
    let [a, b, c] = corners;
    if orient2d(a, b, c) > 0.0 { past_bounds } else { past_bounds.max(FLAT) }
}

/// The least penalty of a triangle that is not counter-clockwise: that of an angle past
/// its bound by two right ones.
const FLAT: f64 = 180.0 * 180.0;
