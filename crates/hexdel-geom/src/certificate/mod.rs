//! The certificate: what a mesh promises, checked on the mesh alone.
//!
//! [`certify`] reads the final coordinates and indices and nothing else; how
//! the mesh was made is unknown to it. It looks at every triangle (angles,
//! orientation, lengths), at the triangles around every vertex (manifold,
//! boundary, local Delaunay property of the edges) and, if asked, for every
//! input point among the vertices.
//!
//! # What counts as an angle within the bounds
//!
//! A bound `b` is kept by an angle that is past it by no more than
//! [`ANGLE_TOLERANCE_DEG`]. An angle that is past it by more is the fault of
//! the method, or of storing the corners in `f64`. The certificate accepts
//! the second excuse only as far as it carries. Let the exact corners `a`,
//! `b`, `c` be moved by `da`, `db`, `dc`. To first order the angle at `a`
//! changes by
//!
//! ```text
//!   n_c . (dc - da) / |ac|  -  n_b . (db - da) / |ab|
//! ```
//!
//! with `n_c`, `n_b` the unit normals of `ac`, `ab`. The coefficient of `da`
//! is `n_b / |ab| - n_c / |ac|`, whose length is `|bc| / (|ab| |ac|)`
//! (inversion at `a` takes `b`, `c` to points that far apart). So it changes
//! by at most
//!
//! ```text
//!   |db| / |ab|  +  |dc| / |ac|  +  |da| |bc| / (|ab| |ac|).
//! ```
//!
//! A correctly rounded coordinate `x` is off by half an ulp of `x` at most, so
//! `|dv| <= hypot(ulp(x), ulp(y)) / 2`. The certificate grants twice this
//! bound (the [`ROUNDING_FACTOR`]). A triangle with an angle past the
//! tolerance but within this slack counts as `rounding_limited`, and the worst
//! excess is reported; beyond it, as `out_of_bounds`.
//!
//! # Aspect ratio
//!
//! Angle bounds bound the aspect ratio ([`AngleBounds::max_aspect_ratio`]). It is computed
//! from lengths and area, another way than angles, and held against the bound that follows
//! from the angles granted: those past a bound by the tolerance and by rounding included.
//!
//! # What is not checked
//!
//! That the triangles do not overlap without sharing an edge or vertex
//! wrongly: a counter-clockwise disk whose boundary crosses itself, like a
//! turn of a spiral staircase seen from above, passes.

mod duals;
mod inputs;
mod local;
mod places;
mod topology;
pub(crate) mod triangles;

use glam::DVec2;

use crate::bounds::AngleBounds;
use crate::mesh::{TriMesh, TriangleId, VertexId};
use crate::scale::{max_abs, scale_to};

pub use duals::{DualCheck, DualEdge, check_dual_edges, max_angle_of_ratio};
pub use local::{keeps_bounds, keeps_bounds_at};
pub use places::{
    BrokenPromise, FAR_EDGES, PlaceCheck, Promise, Promises, SIZE_TOLERANCE, check_promises, features,
};

/// An angle within this many degrees of a bound is within the bound.
///
/// Coordinates of magnitude 1 with edges of length 1e-4 put the rounding of
/// an angle at about 1e-10 degrees; ten times that leaves room for the
/// arithmetic that found them and is far below what anybody can use.
pub const ANGLE_TOLERANCE_DEG: f64 = 1e-9;

/// An edge shorter than its bound by this fraction of it still keeps it.
///
/// The displacement that turns an edge by [`ANGLE_TOLERANCE_DEG`] (1.7e-11
/// radians), relative to the edge, rounded down.
pub const LENGTH_TOLERANCE: f64 = 1e-11;

/// How much of the first-order effect of half an ulp in every coordinate is
/// excused.
///
/// One for the final rounding of a coordinate; one more for what a
/// construction in `f64` cannot avoid, one rounding of an offset no larger
/// than the coordinate before it is added to an origin. The neglected terms
/// of second order matter only to edges of a few ulps.
pub const ROUNDING_FACTOR: f64 = 2.0;

/// What to certify.
#[derive(Clone, Copy, Debug)]
pub struct CertifyOptions<'a> {
    /// The interval every angle has to lie in.
    pub bounds: AngleBounds,
    /// Points that have to be vertices, bit for bit (`-0.0` is `0.0`). May
    /// contain duplicates; each is counted.
    pub inputs: Option<&'a [DVec2]>,
    /// A lower bound on the length of every edge, in the units of the mesh.
    pub min_edge: Option<f64>,
    /// Whether the mesh has to be Delaunay for the certificate to hold.
    pub require_delaunay: bool,
    /// Whether the mesh has to be one disk for the certificate to hold.
    pub require_disk: bool,
    /// How many violations to list. All are counted.
    pub max_violations: usize,
}

impl Default for CertifyOptions<'_> {
    /// The default bounds, no inputs, no bound on edges, a Delaunay disk, 100
    /// violations.
    fn default() -> Self {
        Self {
            bounds: AngleBounds::default(),
            inputs: None,
            min_edge: None,
            require_delaunay: true,
            require_disk: true,
            max_violations: 100,
        }
    }
}

/// One thing wrong with a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Violation {
    /// A corner is no vertex of the mesh.
    CornerOutOfRange {
        /// The triangle.
        triangle: TriangleId,
        /// The corner, 0 to 2.
        corner: usize,
        /// The index that is no vertex.
        vertex: VertexId,
    },
    /// Two corners are the same vertex.
    RepeatedCorner {
        /// The triangle.
        triangle: TriangleId,
        /// The vertex it has twice.
        vertex: VertexId,
    },
    /// A corner's position is infinite or not a number.
    CornerNotFinite {
        /// The triangle.
        triangle: TriangleId,
        /// The vertex.
        vertex: VertexId,
    },
    /// The exact orientation of the corners is clockwise or collinear.
    NotCounterClockwise {
        /// The triangle.
        triangle: TriangleId,
        /// Its corner positions.
        corners: [DVec2; 3],
    },
    /// An angle is below the lower bound by more than tolerance and rounding.
    AngleBelow {
        /// The triangle.
        triangle: TriangleId,
        /// The corner of the angle, 0 to 2.
        corner: usize,
        /// The angle, degrees.
        angle_deg: f64,
        /// The corner positions of the triangle.
        corners: [DVec2; 3],
    },
    /// An angle is above the upper bound by more than tolerance and rounding.
    AngleAbove {
        /// The triangle.
        triangle: TriangleId,
        /// The corner of the angle, 0 to 2.
        corner: usize,
        /// The angle, degrees.
        angle_deg: f64,
        /// The corner positions of the triangle.
        corners: [DVec2; 3],
    },
    /// The angles are within their bounds, but the aspect ratio is larger than that of any
    /// triangle whose angles are.
    AspectAbove {
        /// The triangle.
        triangle: TriangleId,
        /// Circumradius over twice the inradius.
        aspect_ratio: f64,
        /// The corner positions of the triangle.
        corners: [DVec2; 3],
    },
    /// An edge is shorter than its bound by more than tolerance and rounding.
    EdgeTooShort {
        /// A triangle with the edge.
        triangle: TriangleId,
        /// Its length.
        length: f64,
        /// The corner positions of the triangle.
        corners: [DVec2; 3],
    },
    /// Two triangles have the same edge in the same direction.
    RepeatedEdge {
        /// The later triangle.
        triangle: TriangleId,
        /// Start and end of the edge.
        edge: [VertexId; 2],
        /// Their positions.
        ends: [DVec2; 2],
    },
    /// The triangles around a vertex are not one fan.
    BranchingVertex {
        /// The vertex.
        vertex: VertexId,
        /// Its position.
        at: DVec2,
    },
    /// A vertex has no (well-formed) triangle.
    UnusedVertex {
        /// The vertex.
        vertex: VertexId,
    },
    /// A vertex is strictly inside the circumcircle of a triangle next to it.
    NotDelaunay {
        /// The edge between the two triangles.
        edge: [VertexId; 2],
        /// Positions of its ends.
        ends: [DVec2; 2],
        /// Positions of the two corners opposite the edge.
        opposite: [DVec2; 2],
    },
    /// An input point is no vertex.
    InputMissing {
        /// Its position in the list of inputs.
        input: usize,
        /// The point.
        at: DVec2,
    },
}

/// What [`certify`] found.
///
/// Angles are in degrees, lengths in the units of the mesh. Extremes of a mesh
/// without a finite triangle are 0.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
#[expect(clippy::struct_excessive_bools, reason = "each is a finding of its own")]
pub struct Certificate {
    /// Number of vertices, used or not.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// The bounds the angles were held against.
    pub bounds: AngleBounds,
    /// The smallest angle; negative if a triangle is clockwise.
    pub min_angle_deg: f64,
    /// The largest angle.
    pub max_angle_deg: f64,
    /// The largest circumradius over twice the inradius, of counter-clockwise
    /// triangles.
    pub max_aspect_ratio: f64,
    /// The largest aspect ratio of a triangle within `bounds`
    /// ([`AngleBounds::max_aspect_ratio`]); none if it is not bounded.
    pub max_aspect_bound: Option<f64>,
    /// Counter-clockwise triangles that are not among `out_of_bounds`, but have a larger
    /// aspect ratio than any triangle whose angles are past `bounds` by no more than tolerance
    /// and rounding: one of the two measures would be wrong.
    pub stretched_triangles: usize,
    /// Length of the shortest edge.
    pub shortest_edge: f64,
    /// Counter-clockwise triangles with an angle past a bound by more than
    /// tolerance and rounding (see the [module docs](self)).
    pub out_of_bounds: usize,
    /// Counter-clockwise triangles with an angle past a bound by more than the
    /// tolerance, but none by more than the rounding of its corners explains.
    pub rounding_limited: usize,
    /// The most that an angle of a `rounding_limited` triangle is past its
    /// bound, degrees; 0 if there is none.
    pub worst_rounding_excess_deg: f64,
    /// Counter-clockwise triangles with an angle below the templates' exact bound
    /// ([`AngleBounds::EXACT_MIN_DEG`]) by more than tolerance and rounding; those that are
    /// out of bounds are among them. None if `bounds` allow less than [`AngleBounds::EXTENDED`]:
    /// they are not counted then.
    pub below_exact_bound: Option<usize>,
    /// Triangles whose exact orientation is clockwise or collinear.
    pub not_counter_clockwise: usize,
    /// Triangles with a corner that is no vertex, or the same corner twice.
    /// They take no part in any other check.
    pub malformed: usize,
    /// Triangles with a corner whose position is not finite. They take part
    /// in topological checks only.
    pub not_finite: usize,
    /// Whether no edge is in `non_delaunay_edges`.
    pub delaunay: bool,
    /// Edges of exactly two triangles, both counter-clockwise, where, in exact
    /// arithmetic, the corner of one is strictly inside the circumcircle of
    /// the other.
    pub non_delaunay_edges: usize,
    /// Whether a Delaunay mesh was asked for.
    pub delaunay_required: bool,
    /// Whether no triangle is malformed, no directed edge occurs twice, every
    /// vertex is used and its triangles form one fan.
    pub manifold: bool,
    /// Times a directed edge occurs again.
    pub repeated_edges: usize,
    /// Vertices whose triangles form no single fan.
    pub branching_vertices: usize,
    /// Vertices without a well-formed triangle.
    pub unused_vertices: usize,
    /// Undirected edges.
    pub edges: usize,
    /// Directed edges without a partner.
    pub boundary_edges: usize,
    /// Connected components of the boundary edges; closed curves if the mesh
    /// is manifold.
    pub boundary_loops: usize,
    /// Used vertices minus edges plus well-formed triangles.
    pub euler_characteristic: i64,
    /// Whether the mesh is a disk: manifold, one boundary loop, Euler
    /// characteristic 1.
    pub disk: bool,
    /// Whether a disk was asked for.
    pub disk_required: bool,
    /// Input points that were to be vertices.
    pub inputs: usize,
    /// Input points that are vertices.
    pub inputs_kept: usize,
    /// The lower bound on edge lengths that was asked for.
    pub min_edge_bound: Option<f64>,
    /// Triangles with an edge shorter than that by more than
    /// [`LENGTH_TOLERANCE`] and the rounding of its ends (half an ulp per
    /// coordinate, times [`ROUNDING_FACTOR`]).
    pub short_triangles: usize,
    /// The first violations: of triangles in order, then of edges and vertices
    /// in the order of (lower) vertices, then of inputs in order.
    pub violations: Vec<Violation>,
}

impl Certificate {
    /// Whether everything that was asked for is so.
    ///
    /// That is: every triangle well formed, finite, counter-clockwise, with
    /// angles, aspect ratio and edges within the bounds up to tolerance and rounding; the
    /// mesh manifold; a disk and Delaunay if required; every input a vertex.
    pub fn holds(&self) -> bool {
        let faults = self.out_of_bounds
            + self.not_counter_clockwise
            + self.malformed
            + self.not_finite
            + self.stretched_triangles
            + self.short_triangles;
        faults == 0
            && self.manifold
            && (self.disk || !self.disk_required)
            && (self.delaunay || !self.delaunay_required)
            && self.inputs_kept == self.inputs
    }

    /// Whether every edge keeps the lower bound on lengths, if there is one.
    pub fn min_edge_holds(&self) -> bool {
        self.short_triangles == 0
    }
}

/// Checks `mesh` against `request`.
///
/// # Guarantees
///
/// Never panics, whatever the mesh contains: bad indices and coordinates are
/// violations. The outcome is the same at any number of threads. Orientation
/// and the Delaunay property are decided exactly as long as coordinates span
/// no more than some 60 orders of magnitude.
///
/// # Complexity
///
/// Linear in the mesh (`O(n log n)` in inputs and boundary), parallel, with 14
/// bytes per triangle on top of the mesh.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{CertifyOptions, DVec2, TriMesh, VertexId, certify};
///
/// let mesh = TriMesh {
///     vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
///     triangles: vec![[0, 1, 2].map(VertexId::new)],
/// };
/// let certificate = certify(&mesh, &CertifyOptions::default());
/// assert!(certificate.holds());
/// assert_eq!(certificate.max_angle_deg, 90.0);
/// ```
pub fn certify(mesh: &TriMesh, request: &CertifyOptions<'_>) -> Certificate {
    let view = View::new(mesh);
    let cap = request.max_violations;
    let shapes = triangles::check(&view, request);
    let topology = topology::check(&view, cap);
    let inputs = inputs::check(mesh, request.inputs.unwrap_or(&[]), cap);
    let manifold = shapes.malformed == 0
        && topology.repeated_edges == 0
        && topology.branching_vertices == 0
        && topology.unused_vertices == 0;
    let used = mesh.vertices.len() - topology.unused_vertices;
    let well_formed = mesh.triangles.len() - shapes.malformed;
    let euler_characteristic = used as i64 - topology.edges as i64 + well_formed as i64;
    let violations = [shapes.violations, topology.violations, inputs.violations].concat();
    Certificate {
        vertices: mesh.vertices.len(),
        triangles: mesh.triangles.len(),
        bounds: request.bounds,
        min_angle_deg: shapes.min_angle_deg,
        max_angle_deg: shapes.max_angle_deg,
        max_aspect_ratio: shapes.max_aspect_ratio,
        max_aspect_bound: Some(request.bounds.max_aspect_ratio()).filter(|bound| bound.is_finite()),
        stretched_triangles: shapes.stretched_triangles,
        shortest_edge: shapes.shortest_edge,
        out_of_bounds: shapes.out_of_bounds,
        rounding_limited: shapes.rounding_limited,
        worst_rounding_excess_deg: shapes.worst_rounding_excess_deg,
        below_exact_bound: counts_below_exact(request.bounds).then_some(shapes.below_exact_bound),
        not_counter_clockwise: shapes.not_counter_clockwise,
        malformed: shapes.malformed,
        not_finite: shapes.not_finite,
        delaunay: topology.non_delaunay_edges == 0,
        non_delaunay_edges: topology.non_delaunay_edges,
        delaunay_required: request.require_delaunay,
        manifold,
        repeated_edges: topology.repeated_edges,
        branching_vertices: topology.branching_vertices,
        unused_vertices: topology.unused_vertices,
        edges: topology.edges,
        boundary_edges: topology.boundary_edges,
        boundary_loops: topology.boundary_loops,
        euler_characteristic,
        disk: manifold && topology.boundary_loops == 1 && euler_characteristic == 1,
        disk_required: request.require_disk,
        inputs: inputs.count,
        inputs_kept: inputs.kept,
        min_edge_bound: request.min_edge,
        short_triangles: shapes.short_triangles,
        violations: violations.into_iter().take(cap).collect(),
    }
}

/// A mesh whose coordinates are brought into a range fit for the predicates as
/// they are read.
#[derive(Clone, Copy)]
struct View<'a> {
    mesh: &'a TriMesh,
    /// A power of two; 1 unless coordinates are extreme.
    scale: f64,
}

impl<'a> View<'a> {
    fn new(mesh: &'a TriMesh) -> Self {
        use crate::par::prelude::*;
        let parts: Vec<f64> = mesh.vertices.par_chunks(CHUNK).map(max_abs).collect();
        let max = parts.into_iter().fold(0.0, f64::max);
        // Scaling could take small coordinates to subnormals, so it is kept
        // for meshes that need it. 2^60 to the fourth power is far from both
        // ends of the range.
        let fit = max == 0.0 || (2f64.powi(-60)..2f64.powi(60)).contains(&max);
        Self { mesh, scale: if fit { 1.0 } else { scale_to(max, 0) } }
    }

    /// The scaled position of vertex `v`.
    #[inline]
    fn at(&self, v: usize) -> DVec2 {
        self.mesh.vertices[v] * self.scale
    }
}

/// Whether triangles below the templates' exact bound are counted: they are where few are.
fn counts_below_exact(bounds: AngleBounds) -> bool {
    bounds.min_deg() >= AngleBounds::EXTENDED.min_deg()
}

/// Triangles or vertices handled at a time by one thread: large enough to hide
/// the overhead, small enough to share out.
const CHUNK: usize = 1 << 14;

/// Appends to a capped list.
fn note(violations: &mut Vec<Violation>, cap: usize, violation: impl FnOnce() -> Violation) {
    if violations.len() < cap {
        violations.push(violation());
    }
}

#[cfg(test)]
mod tests;
