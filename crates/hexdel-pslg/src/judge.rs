//! Whether a triangle keeps its bounds.

use crate::net::{Kind, NONE, Net};
use hexdel_geom::{AngleBounds, orient2d, quality};
use rustc_hash::FxHashMap;

/// An angle past its bound by this many degrees is still within: the
/// certificate's tolerance.
const TOLERANCE_DEG: f64 = hexdel_geom::ANGLE_TOLERANCE_DEG;

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

impl Judge<'_> {
    /// Whether a triangle has an angle out of its bounds, or is not
    /// counter-clockwise.
    pub(crate) fn is_out(&self, net: &Net, t: u32) -> bool {
        let corners = net.corners(t);
        let [a, b, c] = corners;
        // The angles of a triangle that is turned over do not tell.
        if orient2d(a, b, c) <= 0.0 {
            return true;
        }
        let angles = quality::angles_deg(corners);
        let tolerance = TOLERANCE_DEG + quality::rounding_deg(corners);
        let is_within =
            |(angle, [least, most]): (f64, [f64; 2])| (least - angle).max(angle - most) <= tolerance;
        !angles.into_iter().zip(self.limits(net, t)).all(is_within)
    }

    /// The smallest and largest angle allowed at the three corners, degrees.
    fn limits(&self, net: &Net, t: u32) -> [[f64; 2]; 3] {
        let tri = net.tri(t);
        if self.wedges.hold(net, tri.v) {
            return [[0.0, self.near.max_deg()]; 3];
        }
        let is_near = tri.v.iter().any(|&v| net.vertex(v).ring < FAR_RING);
        let bounds = if is_near { self.near } else { self.far };
        let [least, most] = [bounds.min_deg(), bounds.max_deg()];
        [0, 1, 2].map(|i| if is_sector(net, t, i) { [0.0, most] } else { [least, most] })
    }
}

/// Pairs of pieces that leave a site at so small an angle that triangles
/// between them cannot keep the lower bound.
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
