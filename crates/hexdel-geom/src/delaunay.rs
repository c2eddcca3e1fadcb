//! Makes a nearly Delaunay mesh Delaunay for the coordinates it has.
//!
//! A mesh with all angles up to 90 degrees is Delaunay: the two angles
//! opposite an edge sum to at most 180. Where they sum to exactly 180 the four
//! corners are cocircular, and rounding decides whether they still are. Such
//! an edge is flipped (Lawson, "Software for C1 surface interpolation", 1977)
//! if the flipped triangles keep the angle bounds, as those of a rectangle do.
//! The two right triangles of a kite share their hypotenuse, and flipping it
//! would leave the bounds; there a vertex that may move is nudged by a few
//! units in the last place instead.
//!
//! Nudging has a limit that no search overcomes. The angles around a vertex
//! sum to 360 degrees however it moves: where four right angles of kites meet
//! at every apex, as in a tiling by kites, the pairs opposite the hypotenuses
//! sum to 180 degrees on average, and one can only get slack at the expense of
//! another. Such a mesh is an error here, unless its coordinates happen to be
//! exact or the bounds permit a flip.
//!
//! Coordinates are to be in the range of [`predicates`](crate::predicates);
//! the angles of the mesh are left to the certificate.

use std::collections::VecDeque;

use crate::par::prelude::*;
use glam::DVec2;
use rustc_hash::FxHashMap;
use thiserror::Error;

use crate::bounds::AngleBounds;
use crate::certificate::triangles::{Fit, check_angles};
use crate::incidence::{Fan, Incidence, well_formed};
use crate::mesh::{TriMesh, TriangleId, VertexId};
use crate::predicates::{locally_delaunay, orient2d, surely_acute};
use crate::scale::ulp;

/// Why a mesh could not be made Delaunay.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DelaunayError {
    /// A triangle has a corner that is no vertex, or the same corner twice.
    #[error("triangle {} has corners {}, {}, {}: not three vertices of the mesh",
        .triangle.index(), .corners[0].index(), .corners[1].index(), .corners[2].index())]
    Malformed {
        /// The triangle.
        triangle: TriangleId,
        /// Its corners.
        corners: [VertexId; 3],
    },
    /// Two triangles at a vertex have the same edge in the same direction.
    /// Noticed only where an edge from it has an angle opposite that is not
    /// acute; the certificate notices it anywhere.
    #[error("the triangles at vertex {} ({}, {}) overlap", .vertex.index(), .at.x, .at.y)]
    Overlap {
        /// The vertex.
        vertex: VertexId,
        /// Its position.
        at: DVec2,
    },
    /// An edge can be neither flipped within the angle bounds nor made
    /// Delaunay by moving a free vertex, within the budget.
    #[error("the edge from ({}, {}) to ({}, {}) opposite ({}, {}) and ({}, {}) is not delaunay \
        and cannot be repaired within the angle bounds",
        .ends[0].x, .ends[0].y, .ends[1].x, .ends[1].y,
        .opposite[0].x, .opposite[0].y, .opposite[1].x, .opposite[1].y)]
    Stuck {
        /// The edge.
        edge: [VertexId; 2],
        /// Positions of its ends.
        ends: [DVec2; 2],
        /// Positions of the corners opposite the edge.
        opposite: [DVec2; 2],
    },
}

/// What [`restore_delaunay`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FlipReport {
    /// Edges that were not Delaunay.
    pub found: usize,
    /// Edges flipped.
    pub flips: usize,
    /// Times a vertex was moved.
    pub nudges: usize,
}

/// Flips edges and nudges vertices until no vertex is strictly inside the
/// circumcircle of a neighbouring triangle, in exact arithmetic.
///
/// A vertex is moved only if `free` says so, and by no more than 16 units in
/// the last place at a time: of the largest coordinate around it, or of the mesh
/// where that is not enough. Triangles keep their number; neither a flip nor a
/// nudge takes a triangle out of `bounds` (up to the certificate's tolerance and
/// rounding) or turns it over.
///
/// # Errors
///
/// [`DelaunayError`]. After [`DelaunayError::Stuck`] the mesh is a valid mesh
/// on which all other work has been done; after the others it is untouched.
///
/// # Complexity
///
/// A parallel linear scan with 14 bytes per triangle; nothing else if nothing
/// is found. Repairs are sequential, in the order of the vertices, and limited
/// to 64 for each edge found and each triangle; each takes time in proportion to the
/// triangles around its vertices.
pub fn restore_delaunay(
    mesh: &mut TriMesh,
    bounds: AngleBounds,
    free: impl Fn(VertexId) -> bool,
) -> Result<FlipReport, DelaunayError> {
    restore_constrained_delaunay(mesh, bounds, free, |_| true)
}

/// Like [`restore_delaunay`], with edges that must stay: an edge is flipped
/// only if `flippable` says so of its two ends, in either order.
///
/// # Errors
///
/// As [`restore_delaunay`].
pub fn restore_constrained_delaunay(
    mesh: &mut TriMesh,
    bounds: AngleBounds,
    free: impl Fn(VertexId) -> bool,
    flippable: impl Fn([VertexId; 2]) -> bool,
) -> Result<FlipReport, DelaunayError> {
    let n = mesh.vertices.len();
    let formed = |triangles: &[[VertexId; 3]]| triangles.iter().all(|&t| well_formed(t, n));
    if !mesh.triangles.par_chunks(CHUNK).all(formed)
        && let Some(t) = mesh.triangles.iter().position(|&t| !well_formed(t, n))
    {
        let triangle = TriangleId::new(t);
        return Err(DelaunayError::Malformed { triangle, corners: mesh.triangles[t] });
    }
    let incidence = Incidence::new(mesh);
    let queue = scan(mesh, &incidence)?;
    let report = FlipReport { found: queue.len(), ..FlipReport::default() };
    // Lawson's flips alone could take a quadratic number; a mesh that needs
    // more than this is not nearly Delaunay.
    let budget = 64 * queue.len() + 64 * mesh.triangles.len().min(1 << 20);
    let rings = Rings { incidence: &incidence, changed: FxHashMap::default() };
    let spoiling_moves = 1000 + queue.len();
    let largest = if queue.is_empty() { 0.0 } else { largest_coordinate(&mesh.vertices) };
    let queue = queue.into();
    let mut repair = Repair { mesh, bounds, free, flippable, rings, queue, report, largest, spoiling_moves };
    // One edge that is stuck is no reason to leave the others.
    let mut left = Vec::new();
    for _ in 0..budget {
        let Some(ends) = repair.queue.pop_front() else {
            break;
        };
        if !repair.edge(ends) {
            left.push(ends);
        }
    }
    match left.iter().chain(&repair.queue).find_map(|&ends| repair.bad_quad(ends)) {
        Some(quad) => Err(repair.stuck(&quad)),
        None => Ok(repair.report),
    }
}

fn largest_coordinate(vertices: &[DVec2]) -> f64 {
    vertices.iter().fold(0.0, |largest, v| v.abs().max_element().max(largest))
}

/// Vertices looked at by one thread at a time.
const CHUNK: usize = 1 << 14;

/// For each vertex whether an edge to a higher one has an angle opposite to it
/// that is not acute for certain: an edge without is Delaunay.
fn suspects(mesh: &TriMesh) -> Vec<bool> {
    let lower_ends = |triangles: &[[VertexId; 3]]| {
        let mut lower = Vec::new();
        for &[a, b, c] in triangles {
            let at = |v: VertexId| mesh.vertices[v.index()];
            let (p, q, r) = (at(a), at(b), at(c));
            for (u, w, [s, t]) in [(q - p, r - p, [b, c]), (r - q, p - q, [c, a]), (p - r, q - r, [a, b])] {
                if !surely_acute(u, w) {
                    lower.push(s.min(t));
                }
            }
        }
        lower
    };
    let parts: Vec<Vec<VertexId>> = mesh.triangles.par_chunks(CHUNK).map(lower_ends).collect();
    let mut suspects = vec![false; mesh.vertices.len()];
    for v in parts.into_iter().flatten() {
        suspects[v.index()] = true;
    }
    suspects
}

/// The edges that are not Delaunay, by lower vertex.
fn scan(mesh: &TriMesh, incidence: &Incidence) -> Result<Vec<[u32; 2]>, DelaunayError> {
    let n = mesh.vertices.len();
    let suspects = suspects(mesh);
    let parts: Vec<Result<Vec<[u32; 2]>, DelaunayError>> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let (mut fan, mut bad) = (Fan::default(), Vec::new());
            for v in (chunk * CHUNK..n.min((chunk + 1) * CHUNK)).filter(|&v| suspects[v]) {
                fan.load(mesh, v, incidence.around(v));
                if fan.is_tangled() {
                    let at = mesh.vertices[v];
                    return Err(DelaunayError::Overlap { vertex: VertexId::new(v), at });
                }
                bad.extend(fan.upward_quads(v).filter_map(|quad| {
                    let at = |i: usize| mesh.vertices[quad[i] as usize];
                    let [a, b, c, d] = [at(0), at(1), at(2), at(3)];
                    (!locally_delaunay(a, b, c, d)).then_some([quad[0], quad[2]])
                }));
            }
            Ok(bad)
        })
        .collect();
    let mut all = Vec::new();
    for part in parts {
        all.extend(part?);
    }
    Ok(all)
}

/// The triangles around each vertex while edges are being flipped.
struct Rings<'a> {
    /// As it was in the beginning.
    incidence: &'a Incidence,
    /// The vertices that have gained or lost triangles since. Never iterated.
    changed: FxHashMap<u32, Vec<u32>>,
}

impl Rings<'_> {
    fn around(&self, v: u32) -> &[u32] {
        self.changed.get(&v).map_or_else(|| self.incidence.around(v as usize), Vec::as_slice)
    }

    fn change(&mut self, v: u32) -> &mut Vec<u32> {
        self.changed.entry(v).or_insert_with(|| self.incidence.around(v as usize).to_vec())
    }
}

/// The two triangles `a b c` and `a c d` of edge `a c`.
#[derive(Clone, Copy)]
struct Quad {
    corners: [u32; 4],
    triangles: [u32; 2],
}

struct Repair<'a, F, G> {
    mesh: &'a mut TriMesh,
    bounds: AngleBounds,
    free: F,
    flippable: G,
    /// Agrees with `mesh.triangles`.
    rings: Rings<'a>,
    /// Contains every edge that is not Delaunay.
    queue: VecDeque<[u32; 2]>,
    report: FlipReport,
    /// The largest coordinate of the mesh.
    largest: f64,
    /// Moves left that make other edges worse. The others bring the number of
    /// edges that are not Delaunay down and need no limit.
    spoiling_moves: usize,
}

impl<F: Fn(VertexId) -> bool, G: Fn([VertexId; 2]) -> bool> Repair<'_, F, G> {
    /// Makes an edge Delaunay, if that can be done.
    fn edge(&mut self, ends: [u32; 2]) -> bool {
        let Some(quad) = self.bad_quad(ends) else {
            return true;
        };
        let [a, b, c, d] = quad.corners;
        let flippable = (self.flippable)([a, c].map(|v| VertexId::new(v as usize)));
        if flippable && [[a, b, d], [b, c, d]].into_iter().all(|t| self.fits(t)) {
            self.flip(&quad);
            return true;
        }
        self.nudge(&quad)
    }

    fn stuck(&self, quad: &Quad) -> DelaunayError {
        let [a, b, c, d] = quad.corners;
        let edge = [a, c].map(|v| VertexId::new(v as usize));
        DelaunayError::Stuck { edge, ends: [self.at(a), self.at(c)], opposite: [self.at(b), self.at(d)] }
    }

    fn at(&self, v: u32) -> DVec2 {
        self.mesh.vertices[v as usize]
    }

    /// The corners of triangle `t` from `v` on.
    fn from(&self, v: u32, t: u32) -> [u32; 3] {
        let [a, b, c] = self.mesh.triangles[t as usize].map(|v| v.index() as u32);
        match v {
            _ if v == a => [a, b, c],
            _ if v == b => [b, c, a],
            _ => [c, a, b],
        }
    }

    /// The quadrilateral around an edge; `None` on the boundary and where the
    /// edge is no more.
    fn quad(&self, [a, c]: [u32; 2]) -> Option<Quad> {
        let (mut before, mut after) = (None, None);
        for &t in self.rings.around(a) {
            let [_, next, prev] = self.from(a, t);
            if prev == c {
                before = Some((t, next));
            }
            if next == c {
                after = Some((t, prev));
            }
        }
        let ((s, b), (t, d)) = (before?, after?);
        Some(Quad { corners: [a, b, c, d], triangles: [s, t] })
    }

    fn is_bad(&self, quad: &Quad) -> bool {
        let [a, b, c, d] = quad.corners.map(|v| self.at(v));
        !locally_delaunay(a, b, c, d)
    }

    fn bad_quad(&self, ends: [u32; 2]) -> Option<Quad> {
        self.quad(ends).filter(|quad| self.is_bad(quad))
    }

    /// Whether a triangle is counter-clockwise with its angles in the bounds.
    fn fits(&self, triangle: [u32; 3]) -> bool {
        let corners @ [a, b, c] = triangle.map(|v| self.at(v));
        orient2d(a, b, c) > 0.0 && !matches!(check_angles(corners, self.bounds), Fit::Outside { .. })
    }

    fn flip(&mut self, quad: &Quad) {
        let ([a, b, c, d], [s, t]) = (quad.corners, quad.triangles);
        self.mesh.triangles[s as usize] = [a, b, d].map(|v| VertexId::new(v as usize));
        self.mesh.triangles[t as usize] = [b, c, d].map(|v| VertexId::new(v as usize));
        self.rings.change(a).retain(|&u| u != t);
        self.rings.change(c).retain(|&u| u != s);
        self.rings.change(b).push(t);
        self.rings.change(d).push(s);
        self.queue.extend([[a, b], [b, c], [c, d], [d, a]]);
        self.report.flips += 1;
    }

    /// Moves a free corner of the quadrilateral so that its edge is Delaunay.
    ///
    /// The first move that spoils no other edge is taken; if there is none,
    /// the first of those that spoil the fewest, which are queued.
    fn nudge(&mut self, quad: &Quad) -> bool {
        let [a, b, c, d] = quad.corners;
        let movable: Vec<u32> =
            [b, d, a, c].into_iter().filter(|&v| (self.free)(VertexId::new(v as usize))).collect();
        let stars: Vec<Star> = movable.iter().map(|&v| self.star(v)).collect();
        let step = ulp(largest_coordinate(&quad.corners.map(|v| self.at(v))));
        // Places have been rounded where coordinates are larger than here.
        let reach = (ulp(self.largest) / step).max(1.0);
        let mut best: Option<(Vec<[u32; 2]>, u32, DVec2)> = None;
        for offset in offsets(reach) {
            for (&v, star) in movable.iter().zip(&stars) {
                let to = self.at(v) + offset * step;
                let Some(spoilt) = self.spoilt_by(quad, v, to, star) else {
                    continue;
                };
                let none = spoilt.is_empty();
                if best.as_ref().is_none_or(|(least, ..)| spoilt.len() < least.len()) {
                    best = Some((spoilt, v, to));
                }
                if none {
                    return self.take(best);
                }
            }
        }
        self.spoiling_moves = match self.spoiling_moves.checked_sub(1) {
            Some(left) => left,
            None => return false,
        };
        self.take(best)
    }

    fn take(&mut self, best: Option<(Vec<[u32; 2]>, u32, DVec2)>) -> bool {
        let Some((spoilt, v, to)) = best else {
            return false;
        };
        self.mesh.vertices[v as usize] = to;
        self.queue.extend(spoilt);
        self.report.nudges += 1;
        true
    }

    fn star(&self, v: u32) -> Star {
        let mut star = Star::default();
        for &t in self.rings.around(v) {
            let triangle @ [_, next, prev] = self.from(v, t);
            star.triangles.push((triangle, self.fits(triangle)));
            for ends in [[v, prev], [next, prev]] {
                if let Some(quad) = self.quad(ends) {
                    star.edges.push((quad, self.is_bad(&quad)));
                }
            }
        }
        star
    }

    /// The Delaunay edges that would no longer be so with `v` moved; `None` if
    /// the edge of `quad` would still not be, or a triangle would leave the
    /// bounds.
    fn spoilt_by(&mut self, quad: &Quad, v: u32, to: DVec2, star: &Star) -> Option<Vec<[u32; 2]>> {
        let from = std::mem::replace(&mut self.mesh.vertices[v as usize], to);
        let good = !self.is_bad(quad) && star.triangles.iter().all(|&(t, fitted)| self.keeps(t, fitted));
        let spoilt = good.then(|| {
            star.edges
                .iter()
                .filter(|(edge, bad)| !bad && self.is_bad(edge))
                .map(|(edge, _)| [edge.corners[0], edge.corners[2]])
                .collect()
        });
        self.mesh.vertices[v as usize] = from;
        spoilt
    }

    /// Whether a moved triangle is no worse: one that was out of bounds before
    /// has only to stay counter-clockwise.
    fn keeps(&self, triangle: [u32; 3], fitted: bool) -> bool {
        let [a, b, c] = triangle.map(|v| self.at(v));
        if fitted { self.fits(triangle) } else { orient2d(a, b, c) > 0.0 }
    }
}

/// What a move of a vertex may affect.
#[derive(Default)]
struct Star {
    /// The triangles around it, and whether they keep the bounds.
    triangles: Vec<([u32; 3], bool)>,
    /// The edges from it and opposite it, and whether they are not Delaunay.
    edges: Vec<(Quad, bool)>,
}

/// Displacements to try, in units in the last place, shortest first: all of a
/// square of 7 by 7, then the eight compass directions out to 16 times `reach`. Four rounded
/// corners put a fifth of a unit to a few units between a vertex and its
/// circle, of the unit that they were rounded with.
fn offsets(reach: f64) -> impl Iterator<Item = DVec2> {
    let square = (1..=3).flat_map(|r: i32| {
        (-r..=r)
            .flat_map(move |x| (-r..=r).map(move |y| [x, y]))
            .filter(move |[x, y]| x.abs().max(y.abs()) == r)
    });
    let near = [4.0, 6.0, 8.0, 12.0, 16.0];
    let far = std::iter::successors(Some(32.0), |r| Some(r * 2.0)).take_while(move |r| *r <= 16.0 * reach);
    let compass = near.into_iter().chain(far).flat_map(|r| {
        [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]]
            .map(|[x, y]| r * DVec2::new(x.into(), y.into()))
    });
    square.map(|[x, y]| DVec2::new(x.into(), y.into())).chain(compass)
}

#[cfg(test)]
mod tests;
