//! A grid refined until no edge of its mesh is longer than wanted.
//!
//! The rim of a mesh is one ring of leaves of one level, so the base level is
//! made as fine as the sizes along the rim want it. Inside, the mesh itself
//! says which edges are too long, and the hexagons at their ends are
//! subdivided, round after round.

use crate::error::Error;
use crate::placement;
use crate::size::{Size, SizeError};
use hexdel_classify::{Domain, Dual, Relocation};
use hexdel_geom::{DVec2, Monitor, TriMesh};
use hexdel_grid::{Address, Grid};
use hexdel_optimize::{Sizing, edge_fits};
use hexdel_refine::{RefineError, Refiner};

/// Rounds of refinement: one for each level, and as many again for edges that
/// the rules make longer on the way.
const ROUNDS: usize = 2 * Grid::MAX_LEVELS as usize;

/// Triangles that a size may lead to: indices have 32 bits, and what lies
/// between an estimate and the mesh is a small factor.
const MOST_TRIANGLES: f64 = 2.5e8;

/// Places on each side of the domain where its size is looked at.
const SAMPLES: u32 = 256;

/// Rings that a patch may grow by before a finer base level is tried instead.
const MOST_GROWTH: u32 = 8;

/// A refined grid, to be refined further until its mesh keeps to `size`.
pub(crate) struct Sized<'a> {
    pub(crate) refiner: &'a mut Refiner,
    pub(crate) relocation: Relocation,
    pub(crate) size: &'a Size,
    pub(crate) monitor: &'a dyn Monitor,
    /// The least size that something was refined for: infinite before.
    pub(crate) least: f64,
}

impl Sized<'_> {
    /// The mesh of the patch, or of a little more than it.
    pub(crate) fn extract(&mut self, patch: Domain) -> Result<(Dual, Domain), Error> {
        let mut domain = self.with_base(patch)?;
        let mut first = domain.radius;
        let mut longest = None;
        for round in 0..ROUNDS {
            let dual = self.refiner.extract(domain, self.relocation, self.monitor)?;
            // What is fine in a place that no triangle has seen yet shows later.
            check_count(&dual.mesh, self.size)?;
            let long = self.at_long_edges(&dual.mesh, domain.base_level)?;
            if long.is_empty() {
                return Ok((dual, domain));
            }
            if round + 1 == ROUNDS {
                longest = Some(worst_edge(&dual.mesh, self.size));
            }
            self.subdivide(long)?;
            domain = self.around(domain)?;
            if domain.radius > first + MOST_GROWTH {
                domain = self.around(finer(domain)?)?;
                first = domain.radius;
            }
        }
        let (_, at, length) = longest.expect("the last round has found edges that are too long");
        Err(SizeError::Unreached { at, length }.into())
    }

    /// The patch at a base level as fine as its rim is to be.
    fn with_base(&mut self, patch: Domain) -> Result<Domain, Error> {
        let lattice = *self.refiner.grid().lattice();
        let radius = f64::from(patch.radius) * lattice.spacing(patch.base_level);
        let wanted = along_rim(self.size, lattice.origin(), radius);
        if wanted <= 0.0 {
            return Err(
                SizeError::NotPositive { what: "the rim of the domain".to_owned(), size: wanted }.into()
            );
        }
        self.least = self.least.min(wanted);
        let mut domain = patch;
        while lattice.spacing(domain.base_level) > wanted {
            domain = finer(domain)?;
        }
        self.around(domain)
    }

    /// The patch, made large enough for what is subdivided by now.
    fn around(&mut self, domain: Domain) -> Result<Domain, Error> {
        loop {
            if let Some(around) = Domain::around(self.refiner.grid(), domain.base_level) {
                return Ok(Domain { radius: domain.radius.max(around.radius), ..domain });
            }
            // Points occupy coarser hexagons than the patch has.
            let coarse: Vec<Address> = self
                .refiner
                .occupants()
                .iter()
                .filter(|o| o.level < domain.base_level)
                .map(|o| Address::new(o.level, o.at.hex))
                .collect();
            self.subdivide(coarse)?;
        }
    }

    fn subdivide(&mut self, hexagons: Vec<Address>) -> Result<(), Error> {
        self.refiner.subdivide_all(hexagons, self.monitor).map_err(|error| match error {
            RefineError::Cancelled(c) => Error::Cancelled(c),
            _ => SizeError::TooFine { levels: Grid::MAX_LEVELS }.into(),
        })
    }

    /// The coarsest leaves at the ends and middles of edges that are too long.
    fn at_long_edges(&mut self, mesh: &TriMesh, base: u8) -> Result<Vec<Address>, Error> {
        let grid = self.refiner.grid();
        let leaf = |p: DVec2| {
            let (level, at, _) = grid.locate(p);
            // What is coarser than the patch is not in the mesh.
            if level < base { (base, grid.lattice().locate(base, p)) } else { (level, at) }
        };
        let (mut found, mut least) = (Vec::new(), self.least);
        for t in &mesh.triangles {
            for k in 0..3 {
                let [a, b] = [t[k], t[(k + 1) % 3]].map(|v| mesh.vertices[v.index()]);
                if edge_fits(self.size, a, b) {
                    continue;
                }
                let places = [a, b, 0.5 * (a + b)];
                least = places.iter().map(|&p| self.size.at(p)).fold(least, f64::min);
                let leaves = places.map(leaf);
                let level = leaves.iter().map(|l| l.0).min().expect("three of them");
                if level + 1 >= Grid::MAX_LEVELS {
                    return Err(SizeError::TooFine { levels: Grid::MAX_LEVELS }.into());
                }
                found.extend(leaves.iter().filter(|l| l.0 == level).map(|l| (level, l.1.hex.q, l.1.hex.r)));
            }
        }
        self.least = least;
        found.sort_unstable();
        found.dedup();
        Ok(found.into_iter().map(|(level, q, r)| Address::new(level, hexdel_grid::Hex::new(q, r))).collect())
    }
}

/// The same patch with the next finer level along its rim.
fn finer(domain: Domain) -> Result<Domain, Error> {
    let radius = 2 * domain.radius;
    if radius > Domain::MAX_RADIUS || domain.base_level + 1 >= Grid::MAX_LEVELS {
        return Err(SizeError::TooMany { triangles: 6.0 * f64::from(radius).powi(2) }.into());
    }
    Ok(Domain { base_level: domain.base_level + 1, radius })
}

/// The least size along the rim of a patch.
pub fn along_rim(size: &Size, centre: DVec2, radius: f64) -> f64 {
    let corners = placement::corners(centre, radius);
    let mut least = f64::INFINITY;
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % 6];
        for k in 0..SAMPLES {
            least = least.min(size.at(a.lerp(b, f64::from(k) / f64::from(SAMPLES))));
        }
    }
    least
}

/// Refuses sizes that would take too many triangles, before they are made: a
/// triangle with an edge `n` times too long becomes `n^2`.
///
/// # Errors
///
/// [`SizeError::NotPositive`], [`SizeError::TooMany`].
pub fn check_count(mesh: &TriMesh, size: &Size) -> Result<(), SizeError> {
    let mut triangles = 0.0;
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| mesh.vertices[v.index()]);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let middle = (a + b + c) / 3.0;
        let wanted = [a, b, c, middle].into_iter().map(|p| size.at(p)).fold(f64::INFINITY, f64::min);
        if wanted <= 0.0 {
            return Err(SizeError::NotPositive {
                what: format!("the place ({:?}, {:?})", middle.x, middle.y),
                size: wanted,
            });
        }
        triangles += (longest / wanted).powi(2).max(1.0);
    }
    if triangles > MOST_TRIANGLES { Err(SizeError::TooMany { triangles }) } else { Ok(()) }
}

/// The largest of all edges' lengths over the ones wanted, and the middle and
/// length of that edge.
pub fn worst_edge(mesh: &TriMesh, sizing: &dyn Sizing) -> (f64, DVec2, f64) {
    let mut worst = (0.0, DVec2::ZERO, 0.0);
    for t in &mesh.triangles {
        for k in 0..3 {
            let [a, b] = [t[k], t[(k + 1) % 3]].map(|v| mesh.vertices[v.index()]);
            let middle = 0.5 * (a + b);
            let wanted = sizing.at(a).min(sizing.at(b)).min(sizing.at(middle));
            let ratio = a.distance(b) / wanted;
            if ratio > worst.0 {
                worst = (ratio, middle, a.distance(b));
            }
        }
    }
    worst
}
