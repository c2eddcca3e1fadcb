//! Options, and the one call.

use crate::compact::{Again, Ended, Time, Work};
use crate::error::Error;
use crate::graph::GraphOptions;
use crate::placement::{self, Placement};
use crate::shortest::of_placement;
use crate::size::{Size, SizeError};
use crate::sized;
use crate::start::{Begun, Gridded, Input, Link, links};
use crate::triangulation::{Seconds, Triangulation};
use crate::workers::Workers;
use hexdel_geom::monitor::check;
use hexdel_geom::{
    AngleBounds, Certificate, CertifyOptions, DVec2, Monitor, Phase, PointSet, TriMesh, Unwatched, VertexId,
    certify, restore_delaunay, settle_rounding,
};
use hexdel_optimize::{Effort, SIZE_TOLERANCE};
use std::time::Duration;
use web_time::Instant;

pub use crate::start::Start;

/// How the mesh is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// The paper's extended refinement and relocation templates (section 5):
    /// 43.89 to 90 degrees. No optimisation: fast, many triangles.
    Templates,
    /// The paper's simple refinement (section 4): 30 to 120 degrees, about a
    /// quarter of the triangles.
    Simple,
    /// Optimisation of a first mesh, which has grown ([`Start::Grown`]) or is one of the grid, to any bounds: with 43.89 to 90
    /// degrees, about a thirteenth of the templates' triangles in fifty times
    /// their time.
    ///
    /// Bounds as wide as the templates' or wider are kept for every input; for
    /// tighter ones it is tried ([`Error::Unreached`]).
    #[default]
    Compact,
}

impl Method {
    /// The bounds that the method keeps for every input.
    pub const fn bounds(self) -> AngleBounds {
        match self {
            Self::Templates | Self::Compact => AngleBounds::EXTENDED,
            Self::Simple => AngleBounds::SIMPLE,
        }
    }

    /// Whether the method keeps these bounds for every input.
    fn keeps(self, bounds: AngleBounds) -> bool {
        let kept = self.bounds();
        bounds.min_deg() <= kept.min_deg() && bounds.max_deg() >= kept.max_deg()
    }
}

/// Meshes points, or a PSLG, with options.
///
/// Options apply to both unless noted. An option that does not apply to the call is
/// [`Error::NotForPoints`] or [`Error::NotForGraphs`].
///
/// ```
/// use hexdel::{DVec2, Mesher, Method};
///
/// let points: Vec<_> = (0..20).map(|i| DVec2::new(f64::from(i), f64::from(i * i % 7))).collect();
/// let made = Mesher::new().method(Method::Simple).threads(1).triangulate(&points)?;
/// assert!(made.certificate.min_angle_deg >= 30.0 - 1e-9);
/// # Ok::<(), hexdel::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Mesher {
    pub(crate) method: Method,
    pub(crate) bounds: Option<AngleBounds>,
    pub(crate) min_dual_edge: Option<f64>,
    pub(crate) domain_radius: Option<f64>,
    /// Centre of the domain, if it is not that of the points.
    pub(crate) centre: Option<DVec2>,
    pub(crate) size: Option<Size>,
    pub(crate) threads: Option<usize>,
    pub(crate) without_coarsening: bool,
    pub(crate) effort: Effort,
    pub(crate) budget: Option<Duration>,
    pub(crate) graph: GraphOptions,
}

/// Meshes points with the default options.
///
/// # Errors
///
/// [`Error`], naming the offending points.
///
/// # Complexity
///
/// Near-linear in the number of points, about a millisecond each for evenly
/// spread ones, of which nine triangles come; [`Method::Templates`] takes a
/// thirtieth of the time for 120 triangles.
///
/// # Examples
///
/// ```
/// use hexdel::DVec2;
/// let made = hexdel::triangulate(&[DVec2::ZERO, DVec2::new(0.02, 0.0)])?;
/// assert_eq!(made.certificate.inputs_kept, 2);
/// # Ok::<(), hexdel::Error>(())
/// ```
pub fn triangulate(points: &[DVec2]) -> Result<Triangulation, Error> {
    Mesher::new().triangulate(points)
}

impl Mesher {
    /// The default options: compact, 43.89 to 90 degrees, the tightest domain,
    /// all threads.
    pub fn new() -> Self {
        Self::default()
    }

    /// How the mesh is made.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Method};
    /// let mesher = Mesher::new().method(Method::Simple);
    /// let made = mesher.triangulate(&[DVec2::ZERO, DVec2::X])?;
    /// assert!(made.certificate.max_angle_deg <= 120.0);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.method = method;
        self
    }

    /// The bounds that the mesh is held to, by default those the method keeps.
    /// They may be wider; narrower ones are for
    /// [`Method::Compact`] only. Of PSLGs, the default is 30 to 90 degrees in
    /// triangles at most one edge away from a point or segment, and 43.89 to 90
    /// elsewhere.
    ///
    /// ```
    /// # use hexdel::{AngleBounds, DVec2, Error, Mesher, Method};
    /// let templates = Mesher::new().method(Method::Templates);
    /// let mesher = templates.bounds(AngleBounds::new(48.0, 84.0)?);
    /// let refused = mesher.triangulate(&[DVec2::ZERO, DVec2::X]);
    /// assert!(matches!(refused, Err(Error::BoundsBeyondMethod { .. })));
    /// # Ok::<(), hexdel::geom::BoundsError>(())
    /// ```
    #[must_use]
    pub fn bounds(mut self, bounds: AngleBounds) -> Self {
        self.bounds = Some(bounds);
        self
    }

    /// Circumradius of the hexagon that a mesh of points covers, in input units. Its
    /// centre is that of the points' smallest enclosing circle, two of its
    /// corners lie east and west. By default as small as the method allows.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher};
    /// let made = Mesher::new().domain_radius(1.0).triangulate(&[DVec2::ZERO, DVec2::new(0.02, 0.0)])?;
    /// let east = made.mesh.vertices.iter().map(|v| v.x).fold(f64::MIN, f64::max);
    /// assert!((east - 1.01).abs() < 1e-12);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn domain_radius(mut self, radius: f64) -> Self {
        self.domain_radius = Some(radius);
        self
    }

    /// How long edges may be, by default as long as the points allow. Every edge
    /// keeps to it at both ends and its middle. In the mesh of a PSLG those of segments
    /// do, too; triangles with longer edges, where the angles left no way, are listed in
    /// [`failed`](crate::PslgTriangulation::failed). A region of a PSLG has a size of
    /// its own by its corners ([`Size::and_polygon`]).
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Size};
    /// let size = Size::constant(0.1)?;
    /// let made = Mesher::new().size(size).triangulate(&[DVec2::ZERO, DVec2::X])?;
    /// assert!(made.size_ratio.is_some_and(|ratio| ratio < 1.0 + 1e-8));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn size(mut self, size: Size) -> Self {
        self.size = Some(size);
        self
    }

    /// How many threads work, by default as many as the machine has, at most 1024. The mesh
    /// does not depend on it. Without the feature `rayon` one thread works, however many are asked for.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher};
    /// let points = [DVec2::ZERO, DVec2::X, DVec2::new(0.2, 0.7)];
    /// let one = Mesher::new().threads(1).triangulate(&points)?;
    /// let two = Mesher::new().threads(2).triangulate(&points)?;
    /// assert_eq!(one.mesh, two.mesh);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads);
        self
    }

    /// Whether hexagons are merged again where all rules allow it (section
    /// 5.3): up to 7 % fewer triangles. On by default; always, for PSLGs. Without it [`Method::Compact`]
    /// begins with a mesh of the grid.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Method, generate};
    /// let points = generate::generate(generate::Kind::Uniform, 50, 1);
    /// let templates = Mesher::new().method(Method::Templates);
    /// let fine = templates.clone().coarsening(false).triangulate(&points)?;
    /// let coarse = templates.triangulate(&points)?;
    /// assert!(coarse.mesh.triangles.len() < fine.mesh.triangles.len());
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn coarsening(mut self, coarsening: bool) -> Self {
        self.without_coarsening = !coarsening;
        self
    }

    /// How hard [`Method::Compact`] tries; nothing to the other methods.
    ///
    /// ```
    /// # use hexdel::{Effort, Mesher, generate};
    /// let points = generate::generate(generate::Kind::Uniform, 20, 1);
    /// let compact = Mesher::new();
    /// let fast = compact.clone().effort(Effort::Fast).triangulate(&points)?;
    /// let standard = compact.triangulate(&points)?;
    /// assert!(standard.mesh.triangles.len() < fast.mesh.triangles.len());
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn effort(mut self, effort: Effort) -> Self {
        self.effort = effort;
        self
    }

    /// The wall-clock time from the call on after which [`Method::Compact`] ends
    /// optimisation, by default as long as it takes; nothing to the other methods.
    /// However short, the mesh is valid; how compact it gets depends on the machine. The
    /// mesh of a PSLG has every segment in it, but angles may be left out of
    /// bounds that more time would mend.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Method};
    /// # use std::time::Duration;
    /// let points = [DVec2::ZERO, DVec2::X, DVec2::new(0.2, 0.7)];
    /// let none = Mesher::new().budget(Duration::ZERO).triangulate(&points)?;
    /// let templates = Mesher::new().method(Method::Templates).triangulate(&points)?;
    /// assert_eq!(none.mesh.triangles.len(), templates.mesh.triangles.len());
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn budget(mut self, budget: Duration) -> Self {
        self.budget = Some(budget);
        self
    }

    /// Meshes points.
    ///
    /// # Guarantees
    ///
    /// The mesh has passed its certificate: every angle within the bounds,
    /// aspect ratio as those imply, Delaunay, one disk, every point a vertex bit for bit, no edge
    /// shorter than the paper's `l_min` of the closest two points (with a size, of that where it is
    /// less). Angles that only the rounding of coordinates takes past a bound are listed in it. Same
    /// points, same bytes, at any number of threads.
    ///
    /// # Errors
    ///
    /// [`Error`], naming the offending points.
    pub fn triangulate(&self, points: &[DVec2]) -> Result<Triangulation, Error> {
        self.triangulate_watched(points, &Unwatched)
    }

    /// Meshes points, reporting progress to a monitor that may stop the work.
    ///
    /// ```
    /// # use hexdel::{DVec2, Error, Mesher, Monitor};
    /// struct Never;
    /// impl Monitor for Never {
    ///     fn cancelled(&self) -> bool {
    ///         true
    ///     }
    /// }
    /// let stopped = Mesher::new().triangulate_watched(&[DVec2::ZERO, DVec2::X], &Never);
    /// assert!(matches!(stopped, Err(Error::Cancelled(_))));
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Cancelled`] if the monitor asks for it, else as
    /// [`triangulate`](Self::triangulate).
    pub fn triangulate_watched(
        &self,
        points: &[DVec2],
        monitor: &dyn Monitor,
    ) -> Result<Triangulation, Error> {
        self.on_threads(|| self.run(points, monitor))
    }

    /// Refuses bounds that a method without optimisation does not keep.
    pub(crate) fn refuse_bounds_beyond(&self, method: Method) -> Result<(), Error> {
        let kept = method.bounds();
        let asked = self.lowered(self.bounds.unwrap_or(kept));
        if method != Method::Compact && !method.keeps(asked) {
            return Err(Error::BoundsBeyondMethod { asked, kept });
        }
        Ok(())
    }

    /// Works on as many threads as asked for.
    pub(crate) fn on_threads<T: Send>(
        &self,
        work: impl FnOnce() -> Result<T, Error> + Send,
    ) -> Result<T, Error> {
        Workers::new(self.threads)?.run(work)
    }

    fn run(&self, points: &[DVec2], monitor: &dyn Monitor) -> Result<Triangulation, Error> {
        let time = Time::new(self.budget);
        self.graph.refuse_for_points()?;
        self.refuse_dual_edges()?;
        let bounds = self.lowered(self.bounds.unwrap_or(self.method.bounds()));
        self.refuse_bounds_beyond(self.method)?;
        if !bounds.allow_grading() {
            return Err(Error::NoGrading { asked: bounds });
        }
        let set = PointSet::new(points)?;
        let placement = Placement::around(&set, self.domain_radius, self.centre, self.method)?;
        self.check_size(&placement)?;
        let input = Input { points, set: &set, placement: &placement };
        let mut again = Again::new(monitor);
        let mut best: Option<Error> = None;
        let templates_do = self.method.keeps(bounds) && self.size.is_none();
        for link in links(self.method) {
            // What is to be optimised in no time is not even begun, if another start
            // needs no optimisation.
            let in_vain = link.start.is_repaired() && time.is_over() && templates_do;
            if in_vain || link.start == Start::Grown && !self.is_for_growth(set.sites().len(), bounds) {
                continue;
            }
            match self.from(*link, &input, bounds, &time, &again) {
                Ok(Some(made)) => return Ok(made),
                Ok(None) => again.restart(),
                // What one start does not reach, the next one may.
                Err(
                    error @ (Error::Unreached { .. }
                    | Error::NotCertified { .. }
                    | Error::Delaunay(_)
                    | Error::Size(SizeError::Unreached { .. })
                    | Error::Optimize(_)),
                ) => {
                    if best.as_ref().is_none_or(|best| error.outside() < best.outside()) {
                        best = Some(error);
                    }
                    again.restart();
                }
                Err(error) => return Err(error),
            }
        }
        Err(best.expect("every method has a way to a mesh"))
    }

    /// Makes the mesh from one start; none if that is not for the input, or time was up before the mesh was within
    /// the bounds and another start is so from the beginning.
    fn from(
        &self,
        Link { start, optimize }: Link,
        input: &Input<'_>,
        bounds: AngleBounds,
        time: &Time,
        monitor: &dyn Monitor,
    ) -> Result<Option<Triangulation>, Error> {
        let clock = Instant::now();
        let Some(mut begun) = self.begin(start, input, bounds, time, monitor)? else { return Ok(None) };
        let mut ended = Ended { reached: true, spent: false };
        if optimize {
            let work = Work { bounds, effort: self.effort, size: self.size.as_ref(), monitor };
            ended = work.optimize(&mut begun, start, time)?;
            if start.is_repaired() && ended.spent && !ended.reached && self.method.keeps(bounds) {
                return Ok(None);
            }
        }
        let extracted = clock.elapsed();
        check(monitor)?;
        let min_edge = of_placement(input.placement, self.size.is_some().then_some(begun.least));
        let certificate = match self.finish(&mut begun, (bounds, min_edge), input.points, monitor) {
            // Without optimisation the mesh is a last resort at any bounds.
            Err(Error::NotCertified { mesh, certificate })
                if !ended.reached || !optimize && self.method == Method::Compact =>
            {
                return Err(Error::Unreached { mesh, certificate });
            }
            done => done?,
        };
        let size_ratio = self.size_ratio(&begun.mesh)?;
        let dual_edges = self.dual_edges(&begun.mesh, &[]);
        if let Some(check) = dual_edges.as_ref().filter(|check| !check.holds()) {
            return Err(Error::DualEdges { mesh: Box::new(begun.mesh), check: Box::new(check.clone()) });
        }
        let total = clock.elapsed();
        let of_input = input.set.site_of_input().iter().map(|&site| begun.vertex_of_site[site as usize]);
        Ok(Some(Triangulation {
            vertex_of_input: of_input.collect(),
            certificate,
            dual_edges,
            size_ratio,
            method: self.method,
            start,
            budget_spent: ended.spent,
            patch: begun.patch,
            max_level: begun.grid.as_ref().map_or(0, Gridded::depth),
            seconds: Seconds {
                refine: begun.refined.as_secs_f64(),
                extract: extracted.as_secs_f64() - begun.refined.as_secs_f64(),
                certify: total.as_secs_f64() - extracted.as_secs_f64(),
                total: total.as_secs_f64(),
            },
            mesh: begun.mesh,
            grid: begun.grid,
        }))
    }

    /// Refuses sizes that coordinates do not resolve in the domain.
    fn check_size(&self, placement: &Placement) -> Result<(), SizeError> {
        let lattice = &placement.lattice;
        let reach = lattice.origin().abs().max_element() + lattice.spacing(0);
        self.size.as_ref().map_or(Ok(()), |s| s.check(placement::finest_spacing(DVec2::splat(reach))))
    }

    /// The longest edge over what is wanted.
    fn size_ratio(&self, mesh: &TriMesh) -> Result<Option<f64>, SizeError> {
        let Some(size) = &self.size else {
            return Ok(None);
        };
        let (ratio, at, length) = sized::worst_edge(mesh, size);
        if ratio > 1.0 + SIZE_TOLERANCE {
            return Err(SizeError::Unreached { at, length });
        }
        Ok(Some(ratio))
    }

    /// Makes the mesh exactly Delaunay and certifies it.
    fn finish(
        &self,
        begun: &mut Begun,
        (bounds, min_edge): (AngleBounds, Option<f64>),
        points: &[DVec2],
        monitor: &dyn Monitor,
    ) -> Result<Certificate, Error> {
        let fixed = begun.fixed();
        let compact = self.method == Method::Compact;
        let kept = if compact { bounds } else { self.method.bounds() };
        let free = |v: VertexId| !fixed[v.index()];
        settle_rounding(&mut begun.mesh, bounds, free);
        restore_delaunay(&mut begun.mesh, kept, free)?;
        let total = begun.mesh.triangles.len() as u64;
        check(monitor)?;
        let options = CertifyOptions { bounds, inputs: Some(points), min_edge, ..CertifyOptions::default() };
        let certificate = certify(&begun.mesh, &options);
        if certificate.holds() {
            // Not before: what does not hold may lead to another start.
            monitor.progress(Phase::Certify, total, total);
            return Ok(certificate);
        }
        let mesh: TriMesh = std::mem::take(&mut begun.mesh);
        Err(Error::NotCertified { mesh: Box::new(mesh), certificate: Box::new(certificate) })
    }
}
