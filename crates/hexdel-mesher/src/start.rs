//! Where a mesh begins: the starts of each method, and the mesh of each.

use crate::compact::Time;
use crate::error::Error;
use crate::mesher::{Mesher, Method};
use crate::placement::{Placement, corners};
use crate::sized::Sized;
use crate::triangulation::Patch;
use hexdel_classify::{Domain, Relocation};
use hexdel_geom::{AngleBounds, DVec2, Monitor, PointSet, TriMesh, VertexId};
use hexdel_grow::{GrowError, grow};
use hexdel_optimize::Effort;
use hexdel_refine::{Refiner, RuleSet, Start as Coarse};
use std::time::Duration;
use web_time::Instant;

/// The largest lower bound, degrees, at which growth ends by itself; for larger ones the rest is for the optimiser.
const GROWN_DEG: f64 = 43.0;

/// The largest lower bound, degrees, at which it ends with few vertices however few points there are; the start for
/// bounds that it does not reach.
const EASY_DEG: f64 = 42.5;

/// Of so many triangles one may be out of bounds after growth, for the mesh to be repaired.
const TRIANGLES_PER_LEFT: usize = 1000;

/// Points from which on a mesh grows whatever its bounds. The optimiser needs room for what is beyond [`EASY_DEG`].
const MANY: usize = 5000;

/// The mesh that a mesh was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Start {
    /// All rules and templates of section 5.
    Templates,
    /// The rules of section 4.
    Simple,
    /// Legal classes only, a third of the triangles of the templates: repaired
    /// by [`Method::Compact`].
    Coarse,
    /// No grid: a mesh that grows out of the points' Delaunay triangulation, repaired by [`Method::Compact`].
    Grown,
}

/// One way to a mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    pub(crate) start: Start,
    pub(crate) optimize: bool,
}

/// The ways to a mesh, in the order they are tried.
pub(crate) fn links(method: Method) -> &'static [Link] {
    const GROWN: Link = Link { start: Start::Grown, optimize: true };
    const COARSE: Link = Link { start: Start::Coarse, optimize: true };
    const FINE: Link = Link { start: Start::Templates, optimize: true };
    const TEMPLATES: Link = Link { start: Start::Templates, optimize: false };
    const SIMPLE: Link = Link { start: Start::Simple, optimize: false };
    match method {
        Method::Simple => &[SIMPLE],
        Method::Templates => &[TEMPLATES],
        Method::Compact => &[GROWN, COARSE, FINE, TEMPLATES],
    }
}

/// What is meshed, and where.
pub(crate) struct Input<'a> {
    pub(crate) points: &'a [DVec2],
    pub(crate) set: &'a PointSet,
    pub(crate) placement: &'a Placement,
}

/// The grid behind a mesh, and the part of it that is its domain.
#[derive(Clone, Debug)]
pub(crate) struct Gridded {
    pub(crate) refiner: Refiner,
    pub(crate) domain: Domain,
}

impl Gridded {
    /// Levels below the coarsest.
    pub(crate) fn depth(&self) -> u8 {
        let tiles = self.refiner.grid().tiles();
        let holds = |level: &u8| tiles.level(*level).iter().any(|t| t.subdivided != 0);
        let deepest = (0..tiles.levels() as u8).rev().find(holds).map_or(0, |level| level + 1);
        deepest - self.domain.base_level
    }
}

/// A mesh to begin with.
pub(crate) struct Begun {
    pub(crate) mesh: TriMesh,
    pub(crate) vertex_of_site: Vec<VertexId>,
    pub(crate) patch: Patch,
    pub(crate) grid: Option<Gridded>,
    /// The least size that was wanted anywhere.
    pub(crate) least: f64,
    /// Time to refine.
    pub(crate) refined: Duration,
}

impl Begun {
    /// By vertex: whether it is a site.
    pub(crate) fn fixed(&self) -> Vec<bool> {
        let mut fixed = vec![false; self.mesh.vertices.len()];
        for v in &self.vertex_of_site {
            fixed[v.index()] = true;
        }
        fixed
    }
}

impl Start {
    /// Whether its mesh may be out of bounds until it is optimised.
    pub(crate) fn is_repaired(self) -> bool {
        matches!(self, Self::Coarse | Self::Grown)
    }

    fn relocation(self) -> Relocation {
        match self {
            Self::Templates => Relocation::Full,
            Self::Simple => Relocation::Occupied,
            Self::Coarse | Self::Grown => Relocation::Fins,
        }
    }

    pub(crate) fn rules(self, effort: Effort) -> RuleSet {
        match (self, effort) {
            (Self::Templates, _) => RuleSet::extended(),
            (Self::Simple, _) => RuleSet::simple(),
            // More repair, fewer removals: what little is removed at this effort
            // is better not there at all.
            (_, Effort::Fast) => RuleSet::coarse(Coarse::Apart),
            _ => RuleSet::coarse(Coarse::Among),
        }
    }
}

impl Mesher {
    /// The mesh of a start; none if there was none within the time, or not of these points.
    pub(crate) fn begin(
        &self,
        start: Start,
        input: &Input<'_>,
        bounds: AngleBounds,
        time: &Time,
        monitor: &dyn Monitor,
    ) -> Result<Option<Begun>, Error> {
        match start {
            Start::Grown => grown(input, bounds, time, monitor),
            _ => self.refined(start, input.set, input.placement, monitor).map(Some),
        }
    }

    /// The dual of a refined grid.
    fn refined(
        &self,
        start: Start,
        set: &PointSet,
        placement: &Placement,
        monitor: &dyn Monitor,
    ) -> Result<Begun, Error> {
        let began = Instant::now();
        let mut refiner = Refiner::new(placement.lattice, start.rules(self.effort))
            .with_coarsening(!self.without_coarsening);
        refiner.insert(set.sites(), monitor).map_err(Error::from)?;
        let refined = began.elapsed();
        let relocation = start.relocation();
        let domain = placement.domain(refiner.grid(), relocation)?;
        let mut least = f64::INFINITY;
        let (dual, domain) = if let Some(size) = &self.size {
            let mut sized = Sized { refiner: &mut refiner, relocation, size, monitor, least };
            let extracted = sized.extract(domain)?;
            least = sized.least;
            extracted
        } else {
            (refiner.extract(domain, relocation, monitor)?, domain)
        };
        let lattice = &placement.lattice;
        let radius = f64::from(domain.radius) * lattice.spacing(domain.base_level);
        Ok(Begun {
            mesh: dual.mesh,
            vertex_of_site: dual.vertex_of_occupant,
            patch: Patch { centre: lattice.origin(), radius },
            grid: Some(Gridded { refiner, domain }),
            least,
            refined,
        })
    }

    /// Whether a mesh of so many points within bounds is to grow.
    pub(crate) fn is_for_growth(&self, points: usize, bounds: AngleBounds) -> bool {
        let easy = bounds.min_deg() <= EASY_DEG;
        self.size.is_none() && !self.without_coarsening && points > 1 && (easy || points >= MANY)
    }
}

/// A mesh that has grown out of points in a hexagon; none if it did not.
fn grown(
    Input { set, placement, .. }: &Input<'_>,
    bounds: AngleBounds,
    time: &Time,
    monitor: &dyn Monitor,
) -> Result<Option<Begun>, Error> {
    let sites = set.sites();
    let began = Instant::now();
    let patch = Patch { centre: placement.lattice.origin(), radius: placement.radius(sites) };
    let count = sites.len() as u32;
    let mut points = sites.to_vec();
    points.extend(corners(patch.centre, patch.radius));
    let segments: [[u32; 2]; 6] = std::array::from_fn(|i| [0, 1].map(|k| count + (i as u32 + k) % 6));
    let input =
        hexdel_grow::Input { points: &points, segments: &segments, inside: true, ..Default::default() };
    let asked = bounds.min_deg();
    let least = if asked <= GROWN_DEG { asked } else { EASY_DEG };
    let options = hexdel_grow::Options::new(least).with_deadline(time.deadline());
    match grow(&input, &options, monitor) {
        // Growth that spent its limit leaves much, and made more than removals undo.
        Ok(made) if made.left.len() > made.mesh.triangles.len() / TRIANGLES_PER_LEFT => Ok(None),
        Ok(made) => Ok(begun(made, sites.len(), patch, began.elapsed())),
        Err(GrowError::Cancelled(c)) => Err(c.into()),
        Err(_) => Ok(None),
    }
}

/// A grown mesh of so many sites; none if one of them is missing, outside.
fn begun(made: hexdel_grow::Grown, sites: usize, patch: Patch, refined: Duration) -> Option<Begun> {
    let mut vertex_of_site = vec![None; sites];
    for (v, point) in made.point_of_vertex.iter().enumerate() {
        if let Some(of) = point.and_then(|point| vertex_of_site.get_mut(point as usize)) {
            *of = Some(VertexId::new(v));
        }
    }
    let vertex_of_site = vertex_of_site.into_iter().collect::<Option<Vec<VertexId>>>()?;
    Some(Begun { mesh: made.mesh, vertex_of_site, patch, grid: None, least: f64::INFINITY, refined })
}
