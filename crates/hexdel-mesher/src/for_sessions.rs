//! What `hexdel-session` needs of the mesher besides its options and results.
//!
//! This is not for users: it is hidden from the documentation and may change with any version.

pub use crate::graph::Names;
pub use crate::placement::{
    ALIKE, CONFLICT_REACH, FINEST, MAX_COORDINATE, corners, excess, finest_spacing, most_steps, steps_for,
};
pub use crate::shortest::{has_shorter_edge, of_session as shortest_edge};
pub use crate::sized::{along_rim, check_count, worst_edge};
pub use crate::workers::{Workers, check_threads};

use crate::error::Error;
use crate::graph::Domain;
use crate::mesher::{Mesher, Method};
use crate::placement::Placement;
use crate::size::Size;
use crate::start::Start;
use hexdel_classify::Relocation;
use hexdel_geom::{DVec2, PointSet, Unwatched};
use hexdel_grid::Lattice;
use hexdel_optimize::Effort;
use hexdel_pslg::Options;
use hexdel_refine::Refiner;
use std::time::Duration;

/// The options of a mesher that sessions read.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// How the mesh is made.
    pub method: Method,
    /// How long edges may be.
    pub size: Option<&'a Size>,
    /// How short dual edges may be over the edges that they cross.
    pub min_dual_edge: Option<f64>,
    /// Whether hexagons are not merged again.
    pub without_coarsening: bool,
    /// How hard the compact method tries.
    pub effort: Effort,
    /// The time that it has.
    pub budget: Option<Duration>,
    /// How many threads work.
    pub threads: Option<usize>,
}

#[doc(hidden)]
impl Mesher {
    /// The options, read.
    pub fn asked(&self) -> Asked<'_> {
        Asked {
            method: self.method,
            size: self.size.as_ref(),
            min_dual_edge: self.min_dual_edge,
            without_coarsening: self.without_coarsening,
            effort: self.effort,
            budget: self.budget,
            threads: self.threads,
        }
    }

    /// The domain is a hexagon around this centre, whatever the points'.
    #[must_use]
    pub fn around(mut self, centre: DVec2, radius: f64) -> Self {
        (self.centre, self.domain_radius) = (Some(centre), Some(radius));
        self
    }

    /// Edges may be as long as the points allow.
    #[must_use]
    pub fn without_size(self) -> Self {
        Self { size: None, ..self }
    }

    /// What a session meshes anew with; the size and the domain are its own.
    #[must_use]
    pub fn for_session(&self) -> Self {
        let graph = self.graph.clone().for_session();
        Self { size: None, domain_radius: None, centre: None, graph, ..self.clone() }
    }

    /// Refuses options that points alone have no use for.
    ///
    /// # Errors
    ///
    /// [`Error::NotForPoints`].
    pub fn refuse_options_of_pslgs(&self) -> Result<(), Error> {
        self.graph.refuse_for_points()
    }

    /// Refuses bounds that templates do not keep.
    ///
    /// # Errors
    ///
    /// [`Error::BoundsBeyondMethod`].
    pub fn refuse_bounds_beyond_templates(&self) -> Result<(), Error> {
        self.refuse_bounds_beyond(Method::Templates)
    }

    /// The options of PSLGs, with the domain that they have by default.
    pub fn options_inside(&self) -> Options {
        self.pslg_options(Domain::Inside)
    }

    /// The lattice of a mesh of templates with the base level as its coarsest,
    /// and the steps of that to the corners.
    ///
    /// # Errors
    ///
    /// [`Error`], naming the offending points.
    pub fn coarsest_lattice(&self, points: &[DVec2]) -> Result<(Lattice, u32), Error> {
        let set = PointSet::new(points)?;
        let placement = Placement::around(&set, self.domain_radius, self.centre, Method::Templates)?;
        let mut refiner = Refiner::new(placement.lattice, Start::Templates.rules(self.effort));
        self.on_threads(|| {
            let refined = refiner.insert(set.sites(), &Unwatched);
            refined.map_err(Error::from)
        })?;
        let domain = placement.domain(refiner.grid(), Relocation::Full)?;
        let lattice = placement.lattice;
        Ok((Lattice::new(lattice.origin(), lattice.spacing(domain.base_level)), domain.radius))
    }
}
