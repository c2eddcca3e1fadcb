//! Options of PSLGs, and the one call for them.
//!
//! What makes the mesh is `hexdel-pslg`. Here the PSLG is repaired if asked
//! for, the domain settled, and the finished mesh checked for its segments.

mod attributes;
mod boxed;
pub(crate) mod prepare;
mod repair;
pub(crate) mod report;
pub(crate) mod result;
mod verify;
pub(crate) mod warning;
mod watch;

use crate::error::Error;
use crate::mesher::{Mesher, Method};
use crate::placement::finest_spacing;
use crate::size::SizeError;
use crate::sized;
use hexdel_geom::{
    AngleBounds, DVec2, Monitor, Phase, Pslg, TriangleId, Unwatched, smallest_enclosing_circle,
};
use hexdel_pslg::{Extent, Options, PslgError, PslgMesh, SegmentMethod, Validated, mesh, mesh_sized};
use prepare::Prepared;
pub use repair::Names;
use result::PslgTriangulation;
use verify::Meshed;
use watch::Stopwatch;
use web_time::Instant;

/// The part of the plane that the mesh of a PSLG covers. Holes are left out of
/// each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Domain {
    /// A regular hexagon around the points. The default of PSLGs without
    /// segments.
    Hexagon,
    /// The convex hull of the points.
    Hull,
    /// The rectangle around the points, with a margin of a tenth of its longer
    /// side.
    Box,
    /// What segments enclose. The default of PSLGs with segments.
    Inside,
}

impl Domain {
    /// Its name in reports and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hexagon => "hexagon",
            Self::Hull => "hull",
            Self::Box => "box",
            Self::Inside => "inside",
        }
    }

    pub(super) fn extent(self) -> Extent {
        match self {
            Self::Hexagon => Extent::Hexagon,
            Self::Hull => Extent::Hull,
            // The box is made of segments.
            Self::Box | Self::Inside => Extent::Inside,
        }
    }
}

/// How a PSLG is repaired.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Tolerance {
    /// In proportion to the PSLG.
    Relative,
    /// In input units.
    Absolute(f64),
}

/// What is made of polygons that overlap and differ in attribute or largest area.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Overlaps {
    /// The later polygon's attribute and largest area are taken, with a
    /// [warning](crate::Warning::Overlap).
    #[default]
    Later,
    /// They are an error.
    Refuse,
}

/// Options that points alone have no use for.
#[derive(Clone, Debug, Default)]
pub(crate) struct GraphOptions {
    domain: Option<Domain>,
    near: Option<AngleBounds>,
    max_area: Option<f64>,
    repair: Option<Tolerance>,
    overlaps: Overlaps,
    segments: Option<SegmentMethod>,
}

impl GraphOptions {
    /// What a session goes on with: its PSLG is repaired once, at the beginning.
    pub(crate) fn for_session(self) -> Self {
        Self { repair: None, ..self }
    }

    /// An error if any option is set but for the domain that points have.
    pub(crate) fn refuse_for_points(&self) -> Result<(), Error> {
        let other_domain = self.domain.is_some_and(|d| d != Domain::Hexagon);
        let given = [
            ("a domain other than the hexagon", other_domain),
            ("bounds near segments", self.near.is_some()),
            ("a limit on areas", self.max_area.is_some()),
            ("repair", self.repair.is_some()),
            ("a choice for overlaps", self.overlaps != Overlaps::default()),
            ("a choice of segment method", self.segments.is_some()),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Error::NotForPoints { option }),
            None => Ok(()),
        }
    }
}

/// Meshes a PSLG of points and segments with the default options: what the
/// segments enclose, without the holes, at 30 to 90 degrees.
///
/// # Errors
///
/// [`Error`], naming the points and segments at fault.
///
/// # Examples
///
/// ```
/// use hexdel::{DVec2, Pslg};
///
/// // A square with a square hole.
/// let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)];
/// let mut plate = Pslg::from_points(corners.map(|(x, y)| DVec2::new(x, y)).to_vec());
/// plate.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
/// plate.holes = vec![DVec2::new(1.5, 1.5)];
///
/// let made = hexdel::triangulate_pslg(&plate)?;
/// assert!(made.holds());
/// let edges = made.edges.iter().filter(|e| e.segment == Some(4)).count();
/// assert_eq!(edges as u32, made.edges_of_segment[4]);
/// # Ok::<(), hexdel::Error>(())
/// ```
pub fn triangulate_pslg(pslg: &Pslg) -> Result<PslgTriangulation, Error> {
    Mesher::new().triangulate_pslg(pslg)
}

/// Options and calls for PSLGs.
impl Mesher {
    /// What part of the plane the mesh of a PSLG covers: by default what its
    /// segments enclose, or a hexagon if it has none.
    ///
    /// ```
    /// # use hexdel::{DVec2, Domain, Mesher, Pslg};
    /// let points = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    /// let made = Mesher::new().domain(Domain::Hull).triangulate_pslg(&points)?;
    /// assert!(made.mesh.vertices.iter().all(|v| v.x >= 0.0 && v.x <= 1.0));
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn domain(mut self, domain: Domain) -> Self {
        self.graph.domain = Some(domain);
        self
    }

    /// The bounds of triangles at most one edge away from a point or segment of
    /// a PSLG, by default those of [`bounds`](Self::bounds), or else 30 to 90
    /// degrees.
    ///
    /// ```
    /// # use hexdel::{AngleBounds, DVec2, Mesher, Pslg};
    /// let mut triangle = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::new(0.5, 0.8)]);
    /// triangle.segments = vec![[0, 1], [1, 2], [2, 0]];
    /// let made = Mesher::new().near_bounds(AngleBounds::new(35.0, 90.0)?).triangulate_pslg(&triangle)?;
    /// assert!(made.holds() && made.certificate.min_angle_deg >= 35.0 - 1e-8);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn near_bounds(mut self, bounds: AngleBounds) -> Self {
        self.graph.near = Some(bounds);
        self
    }

    /// The largest area of a triangle of a PSLG's mesh, in square input units,
    /// whose centroid lies in the smallest circle around the PSLG. Regions may
    /// have limits of their own, and keep both. Triangles that are larger all the
    /// same are listed in [`failed`](PslgTriangulation::failed).
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Pslg};
    /// let mut square = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    /// square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
    /// let made = Mesher::new().max_area(1e-3).triangulate_pslg(&square)?;
    /// assert!(made.mesh.triangles.len() > 1000);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn max_area(mut self, area: f64) -> Self {
        self.graph.max_area = Some(area);
        self
    }

    /// How segments come into the mesh of a PSLG, by default as an optimiser
    /// makes them fit.
    ///
    /// [`SegmentMethod::Paper`] is for comparison: it keeps no bounds near
    /// segments, and triangles there do not count as failures.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Pslg, SegmentMethod, pslg::Reason};
    /// let mut square = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::new(0.9, 1.2), DVec2::Y]);
    /// square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
    /// let made = Mesher::new().segment_method(SegmentMethod::Paper).triangulate_pslg(&square)?;
    /// assert!(made.holds() && made.failed.iter().all(|f| f.reason == Reason::Template));
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn segment_method(mut self, method: SegmentMethod) -> Self {
        self.graph.segments = Some(method);
        self
    }

    /// Repairs PSLGs first: points within a billionth of the PSLG's size
    /// become one, segments are divided where they cross and where points lie on
    /// them, or nearly so: seen from both ends at less than 0.015 degrees.
    /// [`PslgTriangulation::repairs`] tells all that was done.
    ///
    /// ```
    /// # use hexdel::{DVec2, Error, Mesher, Pslg};
    /// // The diagonals of a square cross.
    /// let mut square = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    /// square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]];
    /// let refused = hexdel::triangulate_pslg(&square).unwrap_err();
    /// assert_eq!(refused.to_string(), "segments 4 and 5 cross at (0.5, 0.5)");
    ///
    /// let made = Mesher::new().repair().triangulate_pslg(&square)?;
    /// assert_eq!(made.repairs.as_ref().map(|report| report.repairs.len()), Some(1));
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn repair(mut self) -> Self {
        self.graph.repair = Some(Tolerance::Relative);
        self
    }

    /// As [`repair`](Self::repair), with a tolerance in input units for points near others and
    /// near segments.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Pslg};
    /// let mut gap = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::new(0.01, 0.0)]);
    /// gap.segments = vec![[0, 1], [1, 2], [2, 3]];
    /// let made = Mesher::new().repair_within(0.02).triangulate_pslg(&gap)?;
    /// assert_eq!(made.graph.points.len(), 3);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn repair_within(mut self, tolerance: f64) -> Self {
        self.graph.repair = Some(Tolerance::Absolute(tolerance));
        self
    }

    /// What is made of polygons that overlap, by default the later one's attribute with a
    /// [warning](PslgTriangulation::warnings).
    ///
    /// ```
    /// # use hexdel::{DVec2, Error, Mesher, Overlaps, Pslg, geom::Polygon};
    /// // A square in a square.
    /// let corners = [(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0), (1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)];
    /// let mut graph = Pslg::from_points(corners.map(|(x, y)| DVec2::new(x, y)).to_vec());
    /// graph.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
    /// let ring = |first: u32, attribute| Polygon { rings: vec![(first..first + 4).collect()], attribute, max_area: None };
    /// graph.polygons = vec![ring(0, 1.0), ring(4, 2.0)];
    /// let made = hexdel::triangulate_pslg(&graph)?;
    /// assert!(made.region_attributes().contains(&2.0) && made.warnings.len() == 1);
    /// let refused = Mesher::new().overlaps(Overlaps::Refuse).triangulate_pslg(&graph);
    /// assert!(matches!(refused, Err(Error::Overlap { polygons: [0, 1], .. })));
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn overlaps(mut self, overlaps: Overlaps) -> Self {
        self.graph.overlaps = overlaps;
        self
    }

    /// Meshes a PSLG of points and segments, with holes, regions and polygons. Points
    /// alone are a PSLG, too ([`Pslg::from_points`]).
    ///
    /// # Guarantees
    ///
    /// Every input point in the domain is a vertex, bit for bit. Every segment in
    /// it is a union of edges, whose other vertices are the doubles nearest to
    /// points of the segment. Triangles are counter-clockwise, exactly, and
    /// Delaunay. Those that do not keep their bounds are listed with reason and
    /// place: [`exempt`](PslgTriangulation::exempt) at corners of the input
    /// narrower than the bound, [`failed`](PslgTriangulation::failed) elsewhere,
    /// and so are those larger than a limit on areas or with edges longer than a
    /// [`size`](Self::size) allows.
    /// That none fails is not guaranteed; where segments meet at 30 degrees or
    /// more it is what to expect. Same PSLG, same bytes, at any number of
    /// threads.
    ///
    /// # Errors
    ///
    /// [`Error`], naming the points and segments at fault.
    pub fn triangulate_pslg(&self, pslg: &Pslg) -> Result<PslgTriangulation, Error> {
        self.triangulate_pslg_watched(pslg, &Unwatched)
    }

    /// As [`triangulate_pslg`](Self::triangulate_pslg), reporting progress to a
    /// monitor that may stop the work. Where bounds were not met, the phases up
    /// to optimisation come again.
    ///
    /// # Errors
    ///
    /// [`Error::Cancelled`] if the monitor asks for it, else as
    /// [`triangulate_pslg`](Self::triangulate_pslg).
    pub fn triangulate_pslg_watched(
        &self,
        pslg: &Pslg,
        monitor: &dyn Monitor,
    ) -> Result<PslgTriangulation, Error> {
        self.on_threads(|| self.run_pslg(pslg, monitor))
    }

    fn run_pslg(&self, pslg: &Pslg, monitor: &dyn Monitor) -> Result<PslgTriangulation, Error> {
        self.refuse_for_graphs()?;
        self.refuse_dual_edges()?;
        let watch = Stopwatch::new(monitor);
        let began = Instant::now();
        let Prepared { repaired, validated, domain, warnings } = self.prepare(pslg)?;
        let graph = &repaired.graph;
        self.check_graph_size(&graph.points)?;
        let mut options = self.pslg_options(domain);
        // Without segments there is nothing that asks for less than points do.
        let points_alone = validated.pslg().segments.is_empty() && domain == Domain::Hexagon;
        if points_alone && self.graph.near.is_none() && self.bounds.is_none() {
            options.near = options.far;
        }
        if let Some(&asked) = [options.near, options.far].iter().find(|bounds| !bounds.allow_grading()) {
            return Err(Error::NoGrading { asked });
        }
        options.budget = self.budget.map(|budget| budget.saturating_sub(began.elapsed()));
        let mut made =
            self.mesh_of_graph(&validated, &options, &watch).map_err(|e| repaired.error_as_given(e))?;
        if domain == Domain::Box {
            boxed::forget_box(&mut made, graph);
        }
        verify::list_all(&mut made);
        let segments = verify::segments(&mut made, graph, &validated, domain);
        let input = Meshed { graph, validated: &validated, domain, size: self.size.as_ref() };
        let places = verify::places(&mut made, &segments, &input, &options);
        let size_ratio = self.size.as_ref().map(|size| sized::worst_edge(&made.mesh, size).0);
        let excused: Vec<TriangleId> = made.exempt.iter().map(|exempt| exempt.triangle).collect();
        let dual_edges = self.dual_edges(&made.mesh, &excused);
        let total = made.mesh.triangles.len() as u64;
        watch.progress(Phase::Certify, total, total);
        let made = PslgTriangulation::new(made, segments, repaired, domain, watch.seconds());
        Ok(PslgTriangulation { warnings, size_ratio, dual_edges, far_bounds: options.far, places, ..made })
    }

    fn mesh_of_graph(
        &self,
        graph: &Validated,
        options: &Options,
        monitor: &dyn Monitor,
    ) -> Result<PslgMesh, PslgError> {
        match &self.size {
            Some(size) => mesh_sized(graph, options, size, monitor),
            None => mesh(graph, options, monitor),
        }
    }

    /// Refuses sizes that coordinates do not resolve around a PSLG.
    fn check_graph_size(&self, points: &[DVec2]) -> Result<(), SizeError> {
        let (Some(size), Some(circle)) = (&self.size, smallest_enclosing_circle(points)) else {
            return Ok(());
        };
        size.check(finest_spacing(DVec2::splat(circle.center.abs().max_element() + circle.radius)))
    }

    fn refuse_for_graphs(&self) -> Result<(), Error> {
        let given = [
            ("the simple method", self.method == Method::Simple),
            ("a domain radius", self.domain_radius.is_some()),
            ("meshing without coarsening", self.without_coarsening),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Error::NotForGraphs { option }),
            None => Ok(()),
        }
    }

    pub(crate) fn pslg_options(&self, domain: Domain) -> Options {
        let effort = (self.method == Method::Compact).then_some(self.effort);
        let mut options = Options::new().extent(domain.extent()).compact(effort);
        options.method = self.graph.segments.unwrap_or_default();
        if let Some(bounds) = self.bounds {
            (options.near, options.far) = (bounds, bounds);
        }
        if let Some(near) = self.graph.near {
            options.near = near;
        }
        (options.near, options.far) = (self.lowered(options.near), self.lowered(options.far));
        options.max_area = self.graph.max_area;
        options.budget = self.budget;
        options
    }
}
