//! The result: a mesh, its segments and regions, and what it keeps.

use super::Domain;
use super::repair::Repaired;
use super::report::PslgReport;
use super::warning::Warning;
use crate::triangulation::Seconds;
use hexdel_geom::certificate::{DualCheck, PlaceCheck};
use hexdel_geom::{AngleBounds, Certificate, Pslg, SegmentCheck, TriMesh, VertexId};
use hexdel_pslg::{Exception, PslgMesh, RepairReport, SegmentEdge, SegmentMethod, holds};

/// A mesh of a PSLG of points and segments.
///
/// Points, segments and regions are counted as in [`graph`](Self::graph): the
/// PSLG given, or what repair has made of it, with holes and regions in place of
/// polygons.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct PslgTriangulation {
    /// Vertices and counter-clockwise triangles.
    pub mesh: TriMesh,
    /// What was meshed.
    pub graph: Pslg,
    /// What repair did, if it was asked for, or if borders of polygons had to be divided
    /// where they cross or run along each other: all changes, and which points and
    /// segments given have become which of the PSLG. Segments without length and those
    /// that are the same as another are dropped without being asked for, and listed here.
    pub repairs: Option<RepairReport>,
    /// What is not used of the PSLG, or could have been meant otherwise.
    pub warnings: Vec<Warning>,
    /// The vertex of each point of the PSLG; duplicates share one. `None` for a
    /// point in a hole or outside of the domain.
    pub vertex_of_point: Vec<Option<VertexId>>,
    /// For each vertex the first point of the PSLG that it is, if any.
    pub point_of_vertex: Vec<Option<u32>>,
    /// A marker of each vertex: that of its point, or else of a segment it lies
    /// on, or else 1 on the boundary and 0 inside.
    pub vertex_markers: Vec<i32>,
    /// The edges that segments and the boundary consist of, segment by segment,
    /// each along its segment.
    pub edges: Vec<SegmentEdge>,
    /// The number of edges that each segment is divided into; 0 if it lies in a
    /// hole or outside of the domain.
    pub edges_of_segment: Vec<u32>,
    /// For each triangle the index of its region, if it lies in one.
    pub region_of_triangle: Vec<Option<u32>>,
    /// Triangles that keep their bounds but for the angle between two segments
    /// that meet in an input point.
    pub exempt: Vec<Exception>,
    /// Triangles that do not keep their bounds, or are larger or longer than
    /// allowed.
    pub failed: Vec<Exception>,
    /// What the mesh was found to keep, held against the bounds near segments.
    /// Exempt and failed triangles count as out of bounds in it.
    pub certificate: Certificate,
    /// The longest edge over the length wanted, if a size was given; above
    /// 1 + 1e-9 only if some triangles [`failed`](Self::failed) for that.
    pub size_ratio: Option<f64>,
    /// What was found of the edges of the Voronoi dual, if a
    /// [bound](crate::Mesher::min_dual_edge) was given. Edges of exempt triangles are excused, all others below the
    /// bound are failures.
    pub dual_edges: Option<DualCheck>,
    /// Whether segments are unions of edges, checked from scratch piece by piece
    /// between the points on them; pieces in holes and outside of the domain are
    /// left out.
    pub segments: SegmentCheck,
    /// The bounds of triangles two edges or more away from points and segments, and from
    /// the boundary but for that of a hexagon.
    pub far_bounds: AngleBounds,
    /// What was found of these and of limits on areas and lengths, checked from
    /// scratch. What is not kept is listed in [`failed`](Self::failed), too.
    pub places: PlaceCheck,
    /// What it covers.
    pub domain: Domain,
    /// How segments came into it.
    pub method: SegmentMethod,
    /// How often parts of the grid were refined because bounds were not met.
    pub retries: u32,
    /// Whether the budget ended optimisation before its end. Triangles may have
    /// failed that would not have otherwise.
    pub budget_spent: bool,
    /// How long it took.
    pub seconds: Seconds,
}

impl PslgTriangulation {
    pub(super) fn new(
        made: PslgMesh,
        segments: SegmentCheck,
        repaired: Repaired,
        domain: Domain,
        seconds: Seconds,
    ) -> Self {
        Self {
            mesh: made.mesh,
            graph: repaired.graph,
            repairs: repaired.report,
            warnings: Vec::new(),
            vertex_of_point: made.vertex_of_point,
            point_of_vertex: made.point_of_vertex,
            vertex_markers: made.vertex_markers,
            edges: made.edges,
            edges_of_segment: made.edges_of_segment,
            region_of_triangle: made.region_of_triangle,
            exempt: made.exempt,
            failed: made.failed,
            certificate: made.certificate,
            size_ratio: None,
            dual_edges: None,
            far_bounds: AngleBounds::EXTENDED,
            places: PlaceCheck::default(),
            segments,
            domain,
            method: made.method,
            retries: made.retries,
            budget_spent: made.budget_spent,
            seconds,
        }
    }

    /// Whether every triangle keeps its bounds, up to exempt corners, and
    /// everything else that was asked for is so. By
    /// [`SegmentMethod::Paper`], bounds and the Delaunay property are asked for away
    /// from segments only.
    ///
    /// ```
    /// # use hexdel::{DVec2, Pslg};
    /// let mut sliver = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::new(1.0, 0.3)]);
    /// sliver.segments = vec![[0, 1], [1, 2], [2, 0]];
    /// let made = hexdel::triangulate_pslg(&sliver)?;
    /// // The corner of 16.7 degrees is as it was given.
    /// assert!(made.holds() && made.exempt.len() == 1);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn holds(&self) -> bool {
        holds(self.method, &self.certificate, &self.failed)
            && self.segments.missing.is_empty()
            && self.dual_edges.as_ref().is_none_or(DualCheck::holds)
    }

    /// The vertex of each point given, repaired or not; `None` for a point in a
    /// hole or outside of the domain.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Pslg};
    /// let mut twice = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::new(1e-12, 0.0)]);
    /// twice.segments = vec![[0, 1], [1, 2], [2, 3]];
    /// let vertices = Mesher::new().repair().triangulate_pslg(&twice)?.vertex_of_input();
    /// assert_eq!(vertices[0], vertices[3]);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn vertex_of_input(&self) -> Vec<Option<VertexId>> {
        match &self.repairs {
            None => self.vertex_of_point.clone(),
            Some(report) => {
                let point = report.point_of_input.iter();
                point.map(|&p| self.vertex_of_point.get(p as usize).copied().flatten()).collect()
            }
        }
    }

    /// For each vertex the first point given that it is, if any.
    ///
    /// ```
    /// # use hexdel::{DVec2, Pslg};
    /// let made = hexdel::triangulate_pslg(&Pslg::from_points(vec![DVec2::X, DVec2::Y]))?;
    /// assert_eq!(made.input_of_vertex().iter().flatten().count(), 2);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn input_of_vertex(&self) -> Vec<Option<u32>> {
        let mut inputs = vec![None; self.mesh.vertices.len()];
        for (input, vertex) in self.vertex_of_input().iter().enumerate().rev() {
            if let Some(vertex) = vertex {
                inputs[vertex.index()] = Some(input as u32);
            }
        }
        inputs
    }

    /// The attribute of each triangle's region, 0 if it lies in none.
    ///
    /// ```
    /// # use hexdel::{DVec2, Pslg, geom::Region};
    /// let mut square = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    /// square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
    /// square.regions = vec![Region { point: DVec2::splat(0.3), attribute: 7.5, max_area: None }];
    /// let made = hexdel::triangulate_pslg(&square)?;
    /// assert!(made.region_attributes().iter().all(|&a| a == 7.5));
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn region_attributes(&self) -> Vec<f64> {
        let regions = &self.graph.regions;
        let attribute = |region: &Option<u32>| region.map_or(0.0, |r| regions[r as usize].attribute);
        self.region_of_triangle.iter().map(attribute).collect()
    }

    /// The figures of this mesh.
    ///
    /// ```
    /// # use hexdel::{DVec2, Pslg};
    /// let made = hexdel::triangulate_pslg(&Pslg::from_points(vec![DVec2::ZERO]))?;
    /// assert_eq!(made.report().domain, "hexagon");
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn report(&self) -> PslgReport<'_> {
        PslgReport::new(self)
    }
}
