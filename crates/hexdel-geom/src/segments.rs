//! Whether segments are unions of edges, checked from scratch.
//!
//! From the vertex at a segment's start the check walks along edges whose ends
//! lie on the segment, up to the rounding of their coordinates, until it comes
//! to the vertex at its end. Whoever made the mesh, and how, does not matter.
//!
//! ```text
//!         o-------o
//!        / \     / \          a, b: points of the segment, bit for bit
//!       /   \   /   \         o on the line: within a few last places of it
//!   a--o-----o-o-----o--b
//! ```

use glam::DVec2;
use rustc_hash::FxHashMap;

use crate::incidence::Incidence;
use crate::mesh::{TriMesh, VertexId};
use crate::points::coordinate_key;
use crate::predicates::orient2d;

/// How far a vertex may be from the segment it lies on, in last places of the
/// largest coordinate. The double nearest to a point of the segment is at most
/// `1 / sqrt 2` away, the differences taken to measure that lose another two.
const LAST_PLACES: f64 = 4.0;

/// What [`check_segments`] found.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SegmentCheck {
    /// How many segments were looked for.
    pub segments: usize,
    /// How many of them are unions of edges.
    pub kept: usize,
    /// The others, in order.
    pub missing: Vec<MissingSegment>,
    /// The edges that segments consist of, as far as they could be followed:
    /// each with its lower vertex first, sorted, once.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub edges: Vec<[VertexId; 2]>,
}

impl SegmentCheck {
    /// Whether there is an edge between two vertices that is part of a segment.
    pub fn has_edge(&self, [a, b]: [VertexId; 2]) -> bool {
        self.edges.binary_search(&[a.min(b), a.max(b)]).is_ok()
    }
}

/// A segment that is no union of edges.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct MissingSegment {
    /// Its index.
    pub segment: usize,
    /// Its ends.
    pub ends: [DVec2; 2],
    /// The last vertex on it that edges lead to from its start; none if there
    /// is no vertex at its start.
    pub reached: Option<DVec2>,
}

/// Checks that each segment, given by the indices of its end points, is a union
/// of edges of the mesh. Segments without length are their point.
///
/// Never panics, whatever the mesh contains.
///
/// # Panics
///
/// If a segment ends at a point that is not there.
///
/// # Complexity
///
/// Linear in the mesh, and in the edges around the vertices on segments.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, TriMesh, VertexId, check_segments};
///
/// let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
/// let mesh = TriMesh {
///     vertices: square.to_vec(),
///     triangles: vec![[0, 1, 2].map(VertexId::new), [0, 2, 3].map(VertexId::new)],
/// };
/// assert_eq!(check_segments(&mesh, &square, &[[0, 1], [2, 0]]).kept, 2);
/// assert_eq!(check_segments(&mesh, &square, &[[1, 3]]).missing[0].segment, 0);
/// ```
pub fn check_segments(mesh: &TriMesh, points: &[DVec2], segments: &[[u32; 2]]) -> SegmentCheck {
    let mut found = SegmentCheck { segments: segments.len(), ..SegmentCheck::default() };
    if segments.is_empty() {
        return found;
    }
    let mut walker = Walker::new(mesh, points, segments);
    for (segment, ends) in segments.iter().enumerate() {
        let ends = ends.map(|p| points[p as usize]);
        match walker.walk(ends) {
            Ok(()) => found.kept += 1,
            Err(reached) => found.missing.push(MissingSegment { segment, ends, reached }),
        }
    }
    found.edges = walker.edges;
    found.edges.sort_unstable();
    found.edges.dedup();
    found
}

/// Whether a point is on a segment between two others, up to the rounding of
/// coordinates that [`check_segments`] allows.
///
/// ```
/// use hexdel_geom::{DVec2, segments::is_on};
///
/// let ends = [DVec2::ZERO, DVec2::new(3.0, 1.0)];
/// assert!(is_on(ends, ends[1] / 3.0) && !is_on(ends, -ends[1]) && !is_on(ends, DVec2::X));
/// ```
pub fn is_on([a, b]: [DVec2; 2], p: DVec2) -> bool {
    let line = Line::new(a, b);
    line.along(p).is_some_and(|along| along >= -line.tolerance)
}

/// For each point whether it lies in a triangle of the mesh, or on its rim.
///
/// # Complexity
///
/// `O((n + m) log n)` for `n` points and `m` triangles, and the points in the
/// vertical strips that triangles span.
///
/// # Examples
///
/// ```
/// use hexdel_geom::segments::covered;
/// use hexdel_geom::{DVec2, TriMesh, VertexId};
///
/// let mesh = TriMesh {
///     vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
///     triangles: vec![[0, 1, 2].map(VertexId::new)],
/// };
/// assert_eq!(covered(&mesh, &[DVec2::splat(0.5), DVec2::splat(0.6)]), [true, false]);
/// ```
pub fn covered(mesh: &TriMesh, points: &[DVec2]) -> Vec<bool> {
    let mut covered = vec![false; points.len()];
    each_in(mesh, points, |i, _| covered[i] = true);
    covered
}

/// Calls with each point and each triangle that it lies in or on the rim of, the
/// triangles in order.
fn each_in(mesh: &TriMesh, points: &[DVec2], mut call: impl FnMut(usize, u32)) {
    if points.is_empty() {
        return;
    }
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&i, &j| points[i].x.total_cmp(&points[j].x));
    for (t, corners) in (0..).zip(&mesh.triangles) {
        let [Some(&a), Some(&b), Some(&c)] = corners.map(|v| mesh.vertices.get(v.index())) else { continue };
        let (west, east) = (a.x.min(b.x).min(c.x), a.x.max(b.x).max(c.x));
        let first = order.partition_point(|&i| points[i].x < west);
        for &i in order[first..].iter().take_while(|&&i| points[i].x <= east) {
            let p = points[i];
            if [(a, b), (b, c), (c, a)].into_iter().all(|(a, b)| orient2d(a, b, p) >= 0.0) {
                call(i, t);
            }
        }
    }
}

/// For each triangle the first of the seeds that lies in the same face of the
/// segments: triangles are in one face if edges lead from one to the other that are
/// none of `edges`, those of segments as [`check_segments`] finds them.
///
/// A seed on an edge of a segment, or on an end of one, has two sides and counts for
/// none; on another edge it counts for the first of the triangles there.
///
/// # Complexity
///
/// `O(n log n)` in the mesh, and the seeds in the vertical strips that triangles
/// span.
///
/// # Examples
///
/// ```
/// use hexdel_geom::segments::faces;
/// use hexdel_geom::{DVec2, TriMesh, VertexId};
///
/// let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
/// let mesh = TriMesh {
///     vertices: square.to_vec(),
///     triangles: vec![[0, 1, 2].map(VertexId::new), [0, 2, 3].map(VertexId::new)],
/// };
/// let diagonal = [[0, 2].map(VertexId::new)];
/// let seed = [DVec2::new(0.2, 0.7)];
/// assert_eq!(faces(&mesh, &diagonal, &seed), [None, Some(0)]);
/// assert_eq!(faces(&mesh, &[], &seed), [Some(0), Some(0)]);
/// ```
pub fn faces(mesh: &TriMesh, edges: &[[VertexId; 2]], seeds: &[DVec2]) -> Vec<Option<u32>> {
    let mut face = vec![None; mesh.triangles.len()];
    let mut bound: Vec<[VertexId; 2]> = edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
    bound.sort_unstable();
    let starts = holders(mesh, &bound, seeds);
    if starts.iter().all(Option::is_none) {
        return face;
    }
    let incidence = Incidence::new(mesh);
    for (seed, start) in (0..).zip(starts) {
        let mut stack: Vec<u32> = start.into_iter().collect();
        while let Some(t) = stack.pop() {
            if face[t as usize].is_some() {
                continue;
            }
            face[t as usize] = Some(seed);
            let [a, b, c] = mesh.triangles[t as usize];
            for [p, q] in [[a, b], [b, c], [c, a]] {
                if bound.binary_search(&[p.min(q), p.max(q)]).is_err() {
                    let beyond = incidence.around(p.index()).iter();
                    stack.extend(beyond.filter(|&&s| s != t && mesh.triangles[s as usize].contains(&q)));
                }
            }
        }
    }
    face
}

/// For each point the first triangle that it lies in, or on the rim of; none for those on
/// `bound` edges.
fn holders(mesh: &TriMesh, bound: &[[VertexId; 2]], points: &[DVec2]) -> Vec<Option<u32>> {
    let mut holders = vec![None; points.len()];
    let mut is_bound = vec![false; points.len()];
    each_in(mesh, points, |i, t| {
        holders[i].get_or_insert(t);
        let p = points[i];
        let [a, b, c] = mesh.triangles[t as usize];
        for [v, w] in [[a, b], [b, c], [c, a]] {
            let on = orient2d(mesh.vertices[v.index()], mesh.vertices[w.index()], p) == 0.0;
            is_bound[i] |= on && bound.binary_search(&[v.min(w), v.max(w)]).is_ok();
        }
    });
    let free = |(holder, is_bound): (Option<u32>, bool)| holder.filter(|_| !is_bound);
    holders.into_iter().zip(is_bound).map(free).collect()
}

struct Walker<'a> {
    mesh: &'a TriMesh,
    incidence: Incidence,
    /// The vertices at the ends of segments, by coordinates. There may be
    /// several at one place, where parts of the mesh touch in a point.
    at: FxHashMap<[u64; 2], Vec<u32>>,
    /// The edges followed.
    edges: Vec<[VertexId; 2]>,
}

impl<'a> Walker<'a> {
    fn new(mesh: &'a TriMesh, points: &[DVec2], segments: &[[u32; 2]]) -> Self {
        let ends = segments.iter().flatten().map(|&p| coordinate_key(points[p as usize]));
        let mut at: FxHashMap<[u64; 2], Vec<u32>> = ends.map(|key| (key, Vec::new())).collect();
        for (v, &p) in mesh.vertices.iter().enumerate() {
            if let Some(vertices) = at.get_mut(&coordinate_key(p)) {
                vertices.push(v as u32);
            }
        }
        Self { mesh, incidence: Incidence::new(mesh), at, edges: Vec::new() }
    }

    /// Follows a segment; if that fails, says how far it came.
    fn walk(&mut self, [a, b]: [DVec2; 2]) -> Result<(), Option<DVec2>> {
        let start = self.at.get(&coordinate_key(a)).and_then(|vertices| vertices.first());
        let mut v = *start.ok_or(None)? as usize;
        let line = Line::new(a, b);
        let mut done = 0.0;
        while self.place(v) != b {
            // The next vertex along the segment is the nearest one.
            let onward = self.neighbours(v).filter_map(|[v, w]| Some((line.along(self.place(w))?, [v, w])));
            let next = onward.filter(|next| next.0 > done).min_by(|x, y| x.0.total_cmp(&y.0));
            let (along, [from, to]) = next.ok_or(Some(self.place(v)))?;
            self.edges.push([from.min(to), from.max(to)].map(VertexId::new));
            (done, v) = (along, to);
        }
        Ok(())
    }

    fn place(&self, v: usize) -> DVec2 {
        self.mesh.vertices[v]
    }

    /// The edges of the triangles at a vertex, and at others in its place, that
    /// begin there, and from each vertex to itself.
    fn neighbours(&self, v: usize) -> impl Iterator<Item = [usize; 2]> + '_ {
        let same = self.at.get(&coordinate_key(self.place(v))).map_or(&[][..], Vec::as_slice);
        let alone = same.is_empty().then_some(v);
        let copies = same.iter().map(|&v| v as usize).chain(alone);
        copies.flat_map(|v| {
            let corners = self.incidence.around(v).iter().flat_map(|&t| self.mesh.triangles[t as usize]);
            corners.map(move |w| [v, w.index()])
        })
    }
}

/// A segment that places are held against.
struct Line {
    from: DVec2,
    direction: DVec2,
    length: f64,
    tolerance: f64,
}

impl Line {
    fn new(a: DVec2, b: DVec2) -> Self {
        let largest = a.abs().max(b.abs()).max_element();
        let length = a.distance(b);
        let direction = (b - a) / length;
        Self { from: a, direction, length, tolerance: LAST_PLACES * f64::EPSILON * largest }
    }

    /// How far along the segment a place on it is.
    fn along(&self, p: DVec2) -> Option<f64> {
        let u = p - self.from;
        let along = u.dot(self.direction);
        let on = self.direction.perp_dot(u).abs() <= self.tolerance && along <= self.length + self.tolerance;
        on.then_some(along)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(vertices: &[(f64, f64)], triangles: &[[usize; 3]]) -> TriMesh {
        TriMesh {
            vertices: vertices.iter().map(|&(x, y)| DVec2::new(x, y)).collect(),
            triangles: triangles.iter().map(|t| t.map(VertexId::new)).collect(),
        }
    }

    /// Two triangles above a line through three vertices.
    fn row(middle: f64) -> TriMesh {
        mesh(&[(0.1, 0.3), (0.2, middle), (0.3, 0.9), (0.0, 1.0)], &[[0, 1, 3], [1, 2, 3]])
    }

    #[test]
    fn rounded_vertices_are_on_the_segment_and_others_are_not() {
        let ends = [DVec2::new(0.1, 0.3), DVec2::new(0.3, 0.9)];
        for middle in [0.6, 0.6 + f64::EPSILON, 0.6 - f64::EPSILON] {
            for segment in [[0, 1], [1, 0]] {
                let found = check_segments(&row(middle), &ends, &[segment, [0, 0]]);
                assert_eq!(found.kept, 2, "{middle}");
                assert!(found.edges.len() == 2 && found.has_edge([2, 1].map(VertexId::new)));
                assert!(!found.has_edge([0, 2].map(VertexId::new)));
            }
        }
        for middle in [0.6 + 1e-14, 0.7] {
            let found = check_segments(&row(middle), &ends, &[[0, 1]]);
            let missing = MissingSegment { segment: 0, ends, reached: Some(ends[0]) };
            assert_eq!((found.kept, found.missing), (0, vec![missing]), "{middle}");
        }
    }

    #[test]
    fn a_vertex_is_needed_at_both_ends_bit_for_bit() {
        let off = DVec2::new(0.1, 0.3 + f64::EPSILON);
        let ends = [off, DVec2::new(0.3, 0.9)];
        assert_eq!(check_segments(&row(0.6), &ends, &[[0, 1]]).missing[0].reached, None);
        assert_eq!(
            check_segments(&row(0.6), &ends, &[[1, 0]]).missing[0].reached,
            Some(DVec2::new(0.1, 0.3))
        );
        // A segment without length is its point; -0.0 is 0.0.
        let left = mesh(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], &[[0, 1, 2]]);
        assert_eq!(check_segments(&left, &[DVec2::new(-0.0, 0.0)], &[[0, 0]]).kept, 1);
    }

    /// Two triangles that touch in a point with a vertex for each.
    #[test]
    fn parts_that_touch_in_a_point_are_passed_through() {
        let bow = mesh(
            &[(0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 1.0), (2.0, 2.0), (2.0, 1.0)],
            &[[0, 1, 2], [3, 5, 4]],
        );
        let points = [DVec2::ZERO, DVec2::ONE, DVec2::splat(2.0)];
        assert_eq!(check_segments(&bow, &points, &[[0, 1], [2, 1]]).kept, 2);
        assert_eq!(check_segments(&bow, &points, &[[0, 2]]).missing.len(), 1);
    }

    /// A square cut by a diagonal, and another beside it: faces end at the edges named
    /// and at the first seed that came.
    #[test]
    fn faces_end_at_edges_and_the_first_seed_counts() {
        let plate = mesh(
            &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (2.0, 0.0), (2.0, 1.0)],
            &[[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]],
        );
        let seeds = [DVec2::new(1.7, 0.1), DVec2::new(0.2, 0.9), DVec2::new(1.1, 0.9), DVec2::splat(7.0)];
        let edge = |a, b| [a, b].map(VertexId::new);
        assert_eq!(faces(&plate, &[edge(2, 1)], &seeds), [Some(1), Some(1), Some(0), Some(0)]);
        assert_eq!(faces(&plate, &[edge(1, 2), edge(2, 0)], &seeds), [None, Some(1), Some(0), Some(0)]);
        assert_eq!(faces(&plate, &[], &seeds), [Some(0); 4]);
        assert_eq!(faces(&plate, &[], &seeds[3..]), [None; 4]);
        // On the edge between two: the first triangle of them.
        let on_edge = [DVec2::new(1.0, 0.5)];
        assert_eq!(faces(&plate, &[edge(0, 2)], &on_edge), [Some(0), None, Some(0), Some(0)]);
        // On a segment, between its ends or at one: none.
        for seed in [on_edge[0], DVec2::new(1.0, 0.0), DVec2::new(1.0, 1.0)] {
            assert_eq!(faces(&plate, &[edge(1, 2), edge(0, 2)], &[seed]), [None; 4], "{seed}");
        }
    }

    #[test]
    fn broken_meshes_are_no_reason_to_panic() {
        let broken = mesh(&[(0.0, 0.0), (f64::NAN, 0.0)], &[[0, 1, 7], [0, 0, 1]]);
        let found = check_segments(&broken, &[DVec2::ZERO, DVec2::X], &[[0, 1], [1, 0]]);
        assert_eq!((found.segments, found.kept, found.missing.len()), (2, 0, 2));
        assert_eq!(covered(&broken, &[DVec2::ZERO, DVec2::splat(f64::NAN)]), [false, false]);
        assert_eq!(check_segments(&TriMesh::default(), &[], &[]).segments, 0);
        assert_eq!(faces(&broken, &[], &[DVec2::ZERO]), [None, None]);
    }
}
