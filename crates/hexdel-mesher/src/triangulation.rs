//! The result: a mesh, what it promises, and how it was made.

use crate::mesher::Method;
use crate::start::{Gridded, Start};
use hexdel_classify::hexagons::{Hexagon, hexagons};
use hexdel_geom::certificate::DualCheck;
use hexdel_geom::{Certificate, DVec2, TriMesh, VertexId, Voronoi, VoronoiSummary};

/// A certified mesh of points.
#[derive(Clone, Debug)]
pub struct Triangulation {
    /// Vertices and counter-clockwise triangles.
    pub mesh: TriMesh,
    /// The vertex of each input point; duplicates share one.
    pub vertex_of_input: Vec<VertexId>,
    /// What the mesh was found to keep.
    pub certificate: Certificate,
    /// What was found of the edges of the Voronoi dual, if a
    /// [bound](crate::Mesher::min_dual_edge) was given: all keep it.
    pub dual_edges: Option<DualCheck>,
    /// The longest edge over the length wanted there, if any was: at most 1 but
    /// for [`SIZE_TOLERANCE`](hexdel_optimize::SIZE_TOLERANCE).
    pub size_ratio: Option<f64>,
    /// How it was made.
    pub method: Method,
    /// The mesh that was the start: for [`Method::Compact`] that which grows out of the points or, where growth is
    /// not for them or did not lead to the bounds, one of the grid.
    pub start: Start,
    /// Whether optimisation ended because its time did.
    pub budget_spent: bool,
    /// What it covers.
    pub patch: Patch,
    /// Levels of the grid used below the coarsest.
    pub max_level: u8,
    /// How long it took.
    pub seconds: Seconds,
    /// The grid behind the mesh, if it has one.
    pub(crate) grid: Option<Gridded>,
}

/// The regular hexagon that a mesh covers, with corners east and west.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Centre of the points' smallest enclosing circle.
    pub centre: DVec2,
    /// Circumradius, in input units.
    pub radius: f64,
}

/// Seconds of wall time by phase.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Seconds {
    /// Checking the input and refining the grid.
    pub refine: f64,
    /// Making vertices and triangles, and optimising them.
    pub extract: f64,
    /// The exact Delaunay property, and the certificate.
    pub certify: f64,
    /// All of it.
    pub total: f64,
}

/// The figures of a mesh, for a file or a pipe.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Report<'a> {
    /// How the mesh was made.
    pub method: &'static str,
    /// The mesh that was the start.
    pub start: &'static str,
    /// Whether optimisation ended because its time did.
    pub budget_spent: bool,
    /// All that the certificate says.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub certificate: &'a Certificate,
    /// What its Voronoi dual is like.
    pub dual: Option<VoronoiSummary>,
    /// What was found of its edges, if a bound was given.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub dual_edges: Option<&'a DualCheck>,
    /// The longest edge over the length wanted there, if any was.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub size_ratio: Option<f64>,
    /// Levels used below the coarsest.
    pub max_level: u8,
    /// Circumradius of the domain, in input units.
    pub domain_radius: f64,
    /// How long it took.
    pub seconds: Seconds,
}

impl Triangulation {
    /// The figures of this mesh, those of its Voronoi dual among them.
    ///
    /// # Complexity
    ///
    /// Linear in the size of the mesh.
    ///
    /// ```
    /// # use hexdel::DVec2;
    /// let made = hexdel::triangulate(&[DVec2::ZERO, DVec2::X])?;
    /// let report = made.report();
    /// assert_eq!(report.certificate.out_of_bounds, 0);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn report(&self) -> Report<'_> {
        Report {
            method: match self.method {
                Method::Templates => "templates",
                Method::Simple => "simple",
                Method::Compact => "compact",
            },
            start: match self.start {
                Start::Templates => "templates",
                Start::Simple => "simple",
                Start::Coarse => "coarse",
                Start::Grown => "grown",
            },
            budget_spent: self.budget_spent,
            certificate: &self.certificate,
            dual: Voronoi::new(&self.mesh).ok().map(|dual| dual.summary()),
            dual_edges: self.dual_edges.as_ref(),
            size_ratio: self.size_ratio,
            max_level: self.max_level,
            domain_radius: self.patch.radius,
            seconds: self.seconds,
        }
    }

    /// The hexagons whose dual the mesh is, with their classes; of
    /// [`Method::Compact`] those of the mesh that optimisation began with, none if that has grown.
    ///
    /// ```
    /// # use hexdel::DVec2;
    /// let made = hexdel::triangulate(&[DVec2::ZERO, DVec2::X])?;
    /// assert!(made.hexagons().iter().any(|h| h.class.is_some()));
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn hexagons(&self) -> Vec<Hexagon> {
        let of = |g: &Gridded| hexagons(g.refiner.grid(), g.domain, &g.refiner.occupants());
        self.grid.as_ref().map(of).unwrap_or_default()
    }

    /// For each vertex the first input point it stands for, if any.
    ///
    /// ```
    /// # use hexdel::DVec2;
    /// let made = hexdel::triangulate(&[DVec2::ZERO, DVec2::X, DVec2::ZERO])?;
    /// let inputs = made.input_of_vertex();
    /// assert_eq!(inputs[made.vertex_of_input[2].index()], Some(0));
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    pub fn input_of_vertex(&self) -> Vec<Option<u32>> {
        let mut inputs = vec![None; self.mesh.vertices.len()];
        for (input, vertex) in self.vertex_of_input.iter().enumerate().rev() {
            inputs[vertex.index()] = Some(input as u32);
        }
        inputs
    }
}
