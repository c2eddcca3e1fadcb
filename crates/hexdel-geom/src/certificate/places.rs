//! What is promised of triangles by where they lie, checked from scratch: other
//! bounds away from points and segments, limits on areas and on lengths.
//!
//! As in the rest of the certificate, coordinates and indices are all that
//! counts. [`features`] finds the vertices that are input points or lie on
//! segments; a triangle is *far* if each of its corners is [`FAR_EDGES`] edges
//! or more away from all of them.
//!
//! ```text
//!   0 --- 1 --- 2 --- 3      edges to the nearest feature
//!    \   / \   / \   /
//!     \ /   \ /   \ /
//!      1 --- 2 --- 3         only the triangle 2 3 3 and those beyond are far
//! ```

use crate::par::prelude::*;
use glam::DVec2;
use rustc_hash::FxHashSet;

use super::CHUNK;
use super::triangles::{Fit, check_angles};
use crate::bounds::AngleBounds;
use crate::incidence::well_formed;
use crate::mesh::{TriMesh, TriangleId, VertexId};
use crate::points::coordinate_key;

/// Edges between a feature and the nearest corner of a triangle from which on the
/// triangle is far.
pub const FAR_EDGES: usize = 2;

/// An edge may be longer than wanted, and an area larger than allowed, by this
/// fraction: what the repair of rounded coordinates may add.
pub const SIZE_TOLERANCE: f64 = 1e-9;

/// What is promised of triangles by where they lie.
#[derive(Clone, Copy, Default)]
pub struct Promises<'a> {
    /// Bounds of far triangles, and by vertex whether it is a feature, as
    /// [`features`] finds them.
    pub far: Option<(AngleBounds, &'a [bool])>,
    /// The largest area of a triangle, square units of the mesh, by its index
    /// and centroid.
    pub max_area: Option<&'a (dyn Fn(TriangleId, DVec2) -> f64 + Sync)>,
    /// The largest length of an edge by place; an edge is held against it at
    /// its ends and its middle.
    pub max_edge: Option<&'a (dyn Fn(DVec2) -> f64 + Sync)>,
}

/// A triangle that does not keep what is promised where it lies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BrokenPromise {
    /// The triangle.
    pub triangle: TriangleId,
    /// Its corner positions.
    pub corners: [DVec2; 3],
    /// What it does not keep.
    pub promise: Promise,
}

/// A promise that is not kept.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Promise {
    /// The bounds of far triangles.
    FarAngle {
        /// The corner of the angle that is farthest past them, 0 to 2.
        corner: usize,
        /// The angle, degrees.
        angle_deg: f64,
    },
    /// The limit on areas.
    Area {
        /// The area, square units of the mesh.
        area: f64,
        /// The largest allowed.
        limit: f64,
    },
    /// The limit on lengths.
    Edge {
        /// The length of the edge that exceeds it by most.
        length: f64,
        /// The largest allowed at its ends and its middle.
        limit: f64,
    },
}

/// What [`check_promises`] found.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct PlaceCheck {
    /// How many triangles are far; 0 if nothing was promised of them.
    pub far: usize,
    /// The smallest angle of a far triangle, degrees; none without one.
    pub far_min_deg: Option<f64>,
    /// Far triangles past their bounds by rounding alone, as
    /// [`rounding_limited`](super::Certificate::rounding_limited) says.
    pub rounding_limited: usize,
    /// What is not kept: by triangle, for each in the order of [`Promise`].
    pub broken: Vec<BrokenPromise>,
}

impl PlaceCheck {
    /// Whether everything promised is so.
    pub fn holds(&self) -> bool {
        self.broken.is_empty()
    }
}

/// For each vertex whether it is one of the points, bit for bit, a neighbour of one of
/// `centres`, an end of one of the edges, or, if `with_boundary`, on the boundary of the
/// mesh.
///
/// # Complexity
///
/// Linear, by hashing.
pub fn features(
    mesh: &TriMesh,
    points: &[DVec2],
    centres: &[DVec2],
    edges: &[[VertexId; 2]],
    with_boundary: bool,
) -> Vec<bool> {
    let mut features = at_points(mesh, points);
    if !centres.is_empty() {
        let beside = beside(mesh, &at_points(mesh, centres));
        features.iter_mut().zip(beside).for_each(|(feature, beside)| *feature |= beside);
    }
    let mut mark = |v: VertexId| {
        if let Some(feature) = features.get_mut(v.index()) {
            *feature = true;
        }
    };
    edges.iter().flatten().for_each(|&v| mark(v));
    if with_boundary {
        boundary(mesh).into_iter().flatten().for_each(mark);
    }
    features
}

/// For each vertex whether it is at one of the points.
fn at_points(mesh: &TriMesh, points: &[DVec2]) -> Vec<bool> {
    let keys: FxHashSet<[u64; 2]> = points.iter().map(|&p| coordinate_key(p)).collect();
    mesh.vertices.iter().map(|&v| keys.contains(&coordinate_key(v))).collect()
}

/// The directed edges without a partner.
fn boundary(mesh: &TriMesh) -> Vec<[VertexId; 2]> {
    let sides = |&[a, b, c]: &[VertexId; 3]| [[a, b], [b, c], [c, a]];
    let mut all: Vec<[VertexId; 2]> = mesh.triangles.iter().flat_map(sides).collect();
    all.par_sort_unstable();
    let single = |&&[a, b]: &&[VertexId; 2]| all.binary_search(&[b, a]).is_err();
    all.iter().filter(single).copied().collect()
}

/// Checks what is promised of triangles by where they lie.
///
/// # Guarantees
///
/// Never panics, whatever the mesh contains; triangles that are not well formed
/// or not finite are left to [`certify`](super::certify). The outcome is the same
/// at any number of threads.
///
/// # Complexity
///
/// Linear in the mesh, parallel.
///
/// # Examples
///
/// ```
/// use hexdel_geom::certificate::{Promise, Promises, check_promises};
/// use hexdel_geom::{DVec2, TriMesh, VertexId};
///
/// let mesh = TriMesh {
///     vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
///     triangles: vec![[0, 1, 2].map(VertexId::new)],
/// };
/// let max_area = |_, _| 0.25;
/// let found = check_promises(&mesh, &Promises { max_area: Some(&max_area), ..Promises::default() });
/// assert_eq!(found.broken[0].promise, Promise::Area { area: 0.5, limit: 0.25 });
/// ```
pub fn check_promises(mesh: &TriMesh, promises: &Promises<'_>) -> PlaceCheck {
    let far = promises.far.map(|(bounds, features)| (bounds, beside(mesh, features)));
    let parts: Vec<PlaceCheck> = mesh
        .triangles
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(chunk, triangles)| {
            let mut part = PlaceCheck::default();
            for (i, &v) in triangles.iter().enumerate() {
                let triangle = TriangleId::new(chunk * CHUNK + i);
                let Some(corners) = corners(mesh, v) else { continue };
                let mut broken = Vec::new();
                if let Some((bounds, _)) =
                    far.as_ref().filter(|(_, beside)| v.iter().all(|v| !beside[v.index()]))
                {
                    let fit = check_angles(corners, *bounds);
                    if let Fit::Outside { corner, angle_deg, .. } = fit {
                        broken.push(Promise::FarAngle { corner, angle_deg });
                    }
                    part.note_far(corners, fit);
                }
                broken.extend(promises.max_area.and_then(|limit| excess_area(corners, triangle, limit)));
                broken.extend(promises.max_edge.and_then(|limit| excess_edge(corners, limit)));
                part.broken.extend(broken.into_iter().map(|promise| BrokenPromise {
                    triangle,
                    corners,
                    promise,
                }));
            }
            part
        })
        .collect();
    parts.into_iter().fold(PlaceCheck::default(), PlaceCheck::merge)
}

impl PlaceCheck {
    fn note_far(&mut self, corners: [DVec2; 3], fit: Fit) {
        self.far += 1;
        self.rounding_limited += usize::from(matches!(fit, Fit::RoundingLimited { .. }));
        let least = crate::quality::angles_deg(corners).into_iter().fold(f64::INFINITY, f64::min);
        self.far_min_deg = Some(self.far_min_deg.map_or(least, |min| min.min(least)));
    }

    fn merge(mut self, part: Self) -> Self {
        self.far += part.far;
        self.rounding_limited += part.rounding_limited;
        self.far_min_deg = match (self.far_min_deg, part.far_min_deg) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        self.broken.extend(part.broken);
        self
    }
}

/// The positions of a well-formed, finite triangle's corners.
fn corners(mesh: &TriMesh, v: [VertexId; 3]) -> Option<[DVec2; 3]> {
    if !well_formed(v, mesh.vertices.len()) {
        return None;
    }
    let corners = v.map(|v| mesh.vertices[v.index()]);
    corners.iter().all(|p| p.is_finite()).then_some(corners)
}

/// For each vertex whether fewer than [`FAR_EDGES`] edges lead from it to a feature.
fn beside(mesh: &TriMesh, features: &[bool]) -> Vec<bool> {
    let mut beside = features.to_vec();
    beside.resize(mesh.vertices.len(), false);
    for _ in 1..FAR_EDGES {
        let before = beside.clone();
        for v in mesh.triangles.iter().filter(|&&v| well_formed(v, before.len())) {
            if v.iter().any(|v| before[v.index()]) {
                for v in v {
                    beside[v.index()] = true;
                }
            }
        }
    }
    beside
}

fn excess_area(
    [a, b, c]: [DVec2; 3],
    triangle: TriangleId,
    limit: &(dyn Fn(TriangleId, DVec2) -> f64 + Sync),
) -> Option<Promise> {
    let (area, limit) = (0.5 * (b - a).perp_dot(c - a), limit(triangle, (a + b + c) / 3.0));
    (area > limit * (1.0 + SIZE_TOLERANCE)).then_some(Promise::Area { area, limit })
}

fn excess_edge([a, b, c]: [DVec2; 3], at: &(dyn Fn(DVec2) -> f64 + Sync)) -> Option<Promise> {
    let sides =
        [[a, b], [b, c], [c, a]].map(|[p, q]| (p.distance(q), at(p).min(at(q)).min(at(0.5 * (p + q)))));
    let long = sides.into_iter().filter(|(length, limit)| length > &(limit * (1.0 + SIZE_TOLERANCE)));
    let most = long.max_by(|s, t| (s.0 / s.1).total_cmp(&(t.0 / t.1)));
    most.map(|(length, limit)| Promise::Edge { length, limit })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of the lattice: two rows of vertices, the upper one half a step to the
    /// right and `height` above.
    fn strip(n: usize, height: f64) -> TriMesh {
        let mut mesh = TriMesh::default();
        for i in 0..n {
            mesh.vertices.push(DVec2::new(i as f64, 0.0));
            mesh.vertices.push(DVec2::new(i as f64 + 0.5, height));
        }
        for i in 0..n - 1 {
            let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3].map(VertexId::new);
            mesh.triangles.extend([[a, c, b], [c, d, b]]);
        }
        mesh
    }

    fn far(mesh: &TriMesh, points: &[DVec2], least: f64) -> PlaceCheck {
        let features = features(mesh, points, &[], &[], false);
        let bounds = AngleBounds::new(least, 90.0).unwrap();
        check_promises(mesh, &Promises { far: Some((bounds, &features)), ..Promises::default() })
    }

    #[test]
    fn triangles_are_far_from_the_second_edge_on() {
        // All angles 45, 45 and 90.
        let mesh = strip(6, 0.5);
        assert_eq!(far(&mesh, &[], 45.0).far, 10);
        // Vertices 0 is the feature, 1 and 2 are beside it: of the ten triangles
        // 0 2 1, 2 3 1 and 2 4 3 have one of them.
        let found = far(&mesh, &[DVec2::new(-0.0, 0.0)], 46.0);
        assert_eq!((found.far, found.broken.len(), found.far_min_deg), (7, 7, Some(45.0)));
        assert_eq!(found.broken[0].triangle, TriangleId::new(3));
        assert!(matches!(found.broken[0].promise, Promise::FarAngle { angle_deg, .. } if angle_deg == 45.0));
        assert!(!found.holds() && far(&mesh, &[DVec2::ZERO], 45.0).holds());
    }

    /// Far from the origin coordinates are rounded to what shows in angles of 45 and 90 degrees; there are
    /// more triangles than one thread handles at a time.
    #[test]
    fn far_triangles_past_their_bounds_by_rounding_are_counted() {
        let mut mesh = strip(CHUNK, 0.5);
        for v in &mut mesh.vertices {
            *v = DVec2::new(1e6, -2e6) + 0.007 * DVec2::new(0.6, 0.8).rotate(*v);
        }
        let past = |corners| {
            let past = |angle| !(45.0 - 1e-9..=90.0 + 1e-9).contains(&angle);
            crate::quality::angles_deg(corners).into_iter().any(past)
        };
        let limited = mesh.triangles.iter().filter(|v| past(v.map(|v| mesh.vertices[v.index()]))).count();
        let found = far(&mesh, &[], 45.0);
        assert!(found.holds() && limited > CHUNK / 2, "{limited}");
        assert_eq!((found.far, found.rounding_limited), (2 * CHUNK - 2, limited));
    }

    #[test]
    fn edges_and_the_boundary_are_features_if_they_are_said_to_be() {
        let mesh = strip(6, 0.5);
        let ends = [[10, 11].map(VertexId::new)];
        let by_edge = features(&mesh, &[], &[], &ends, false);
        assert_eq!(by_edge.iter().filter(|f| **f).count(), 2);
        assert!(by_edge[10] && by_edge[11]);
        // The neighbours of vertex 0.
        let around = features(&mesh, &[], &[DVec2::ZERO], &[], false);
        assert_eq!(around.iter().filter(|f| **f).count(), 3);
        assert!(around[0] && around[1] && around[2]);
        // Every vertex of a strip is on its boundary.
        assert!(features(&mesh, &[], &[], &[], true).into_iter().all(|f| f));
    }

    #[test]
    fn areas_and_edges_beyond_their_limits_are_named_and_those_at_them_are_not() {
        let mesh = strip(2, 0.5);
        for (limit, broken) in [(0.25, 0), (0.25 * (1.0 - 2e-9), 2), (0.1, 2)] {
            let max_area = |_, _| limit;
            let found = check_promises(&mesh, &Promises { max_area: Some(&max_area), ..Promises::default() });
            assert_eq!(found.broken.len(), broken, "{limit}");
        }
        // Fine in the middle of the lowest edge only, from (0, 0) to (1, 0).
        let max_edge = |p: DVec2| if p == DVec2::new(0.5, 0.0) { 0.75 } else { 2.0 };
        let found = check_promises(&mesh, &Promises { max_edge: Some(&max_edge), ..Promises::default() });
        assert_eq!(found.broken.len(), 1);
        assert_eq!(found.broken[0].promise, Promise::Edge { length: 1.0, limit: 0.75 });
        let at = |end: DVec2| move |p: DVec2| if p == end { 0.9 } else { 2.0 };
        for end in [DVec2::ZERO, DVec2::X] {
            let limit = at(end);
            let found = check_promises(&mesh, &Promises { max_edge: Some(&limit), ..Promises::default() });
            assert_eq!(found.broken.iter().filter(|b| b.triangle == TriangleId::new(0)).count(), 1, "{end}");
        }
    }

    #[test]
    fn limits_are_asked_for_by_triangle_and_centroid() {
        let mesh = strip(3, 0.5);
        let corners = |t: TriangleId| mesh.triangles[t.index()].map(|v| mesh.vertices[v.index()]);
        let max_area = |t: TriangleId, at: DVec2| {
            let [a, b, c] = corners(t);
            assert!(at.distance((a + b + c) * (1.0 / 3.0)) < 1e-15, "{at}");
            if t.index() == 2 { 0.2 } else { 0.3 }
        };
        let found = check_promises(&mesh, &Promises { max_area: Some(&max_area), ..Promises::default() });
        let broken: Vec<usize> = found.broken.iter().map(|b| b.triangle.index()).collect();
        assert_eq!(broken, [2]);
    }

    /// Twice the area is the product of two sides.
    #[test]
    fn an_area_that_is_all_that_is_allowed_is_no_excess() {
        let area_is_excess = |width: f64| {
            let corners = [DVec2::ZERO, DVec2::new(2.0 * width, 0.0), DVec2::Y];
            excess_area(corners, TriangleId::new(0), &|_, _| 1.0).is_some()
        };
        let most = 1.0 + SIZE_TOLERANCE;
        assert!(!area_is_excess(most) && area_is_excess(most.next_up()));
    }

    /// Triangles are handled a chunk at a time.
    #[test]
    fn triangles_of_every_chunk_are_asked_for_and_named_by_their_index() {
        let mesh = strip(CHUNK + 3, 0.5);
        let small = [5, CHUNK, CHUNK + 1, 2 * CHUNK + 3];
        let max_area = |t: TriangleId, _| if small.contains(&t.index()) { 0.2 } else { 0.3 };
        let found = check_promises(&mesh, &Promises { max_area: Some(&max_area), ..Promises::default() });
        let broken: Vec<usize> = found.broken.iter().map(|b| b.triangle.index()).collect();
        assert_eq!(broken, small);
        assert!(found.broken.iter().all(|b| b.corners == mesh.corners(b.triangle)));
    }

    /// Edges of 3, 4 and 5; the longest is not the one farthest above its limit.
    #[test]
    fn the_edge_that_exceeds_its_limit_by_most_is_named() {
        let [a, b, c] = [DVec2::new(1.0, 1.0), DVec2::new(5.0, 1.0), DVec2::new(1.0, 4.0)];
        let most = |limits: [f64; 3]| {
            let middles = [[a, b], [b, c], [c, a]].map(|[p, q]| p.midpoint(q));
            let at = |p| middles.iter().zip(limits).find(|(m, _)| **m == p).map_or(9.0, |(_, limit)| limit);
            excess_edge([a, b, c], &at)
        };
        assert_eq!(most([3.9, 4.0, 1.0]), Some(Promise::Edge { length: 3.0, limit: 1.0 }));
        assert_eq!(most([3.0, 4.9, 2.9]), Some(Promise::Edge { length: 4.0, limit: 3.0 }));
        assert_eq!(most([4.0, 4.0, 3.0]), Some(Promise::Edge { length: 5.0, limit: 4.0 }));
        assert_eq!(most([4.0, 5.0, 3.0]), None);
        // Up to the tolerance a limit is kept.
        assert_eq!(most([4.0, 5.0, 3.0].map(|l| l * (1.0 - 0.9 * SIZE_TOLERANCE))), None);
        assert!(most([4.0, 5.0 * (1.0 - 1.1 * SIZE_TOLERANCE), 3.0]).is_some());
        let at_tolerance = [DVec2::ZERO, DVec2::new(1.0 + SIZE_TOLERANCE, 0.0), DVec2::new(0.5, 0.5)];
        assert_eq!(excess_edge(at_tolerance, &|_| 1.0), None);
    }

    #[test]
    fn broken_meshes_are_no_reason_to_panic() {
        let mesh = TriMesh {
            vertices: vec![DVec2::ZERO, DVec2::new(f64::NAN, 0.0), DVec2::Y],
            triangles: vec![
                [0, 1, 7].map(VertexId::new),
                [0, 0, 1].map(VertexId::new),
                [0, 1, 2].map(VertexId::new),
            ],
        };
        let features = features(&mesh, &[DVec2::ZERO], &[], &[[9, 1].map(VertexId::new)], true);
        let bounds = AngleBounds::EXTENDED;
        let found =
            check_promises(&mesh, &Promises { far: Some((bounds, &features)), ..Promises::default() });
        assert!(found.holds() && found.far == 0);
    }
}
