//! A grid of points, its mesh, and the two kept in step.

use super::cells::{Cells, Replaced, Serials};
use super::patch::{is_free, settle};
use crate::session::{PointId, SessionError};
use hexdel_classify::{Domain, KeptDual};
use hexdel_geom::delaunay::restore_constrained_delaunay;
use hexdel_geom::{
    AngleBounds, Certificate, CertifyOptions, DVec2, TriMesh, Unwatched, VertexId, certify, settle_rounding,
};
use hexdel_grid::{Lattice, TileId};
use hexdel_refine::{Changes, RefineError, Refiner, RuleSet};

/// The grid and its mesh.
#[derive(Clone, Debug)]
pub(super) struct Grown {
    pub(super) refiner: Refiner,
    pub(super) dual: KeptDual,
    pub(super) cells: Cells,
    /// The point in each place of the refiner's memory.
    pub(super) of_site: Vec<PointId>,
}

/// One call, as what undoes it.
#[derive(Clone, Debug)]
pub(super) struct Step {
    changes: Changes,
    replaced: Replaced,
}

/// Why a change was not made. Nothing has changed.
#[derive(Debug)]
pub(super) enum Stuck {
    /// Levels run out.
    Levels(RefineError),
    /// Something would touch the rim.
    Rim,
    /// What is new does not hold.
    Unsettled,
}

impl Grown {
    /// The mesh of points in a hexagon of so many steps of level 0, or of as
    /// many halves, quarters .. of a step as room along the rim takes.
    pub(super) fn new(
        lattice: Lattice,
        radius: u32,
        (ids, points): (&[PointId], &[DVec2]),
        serials: Serials,
    ) -> Result<Self, SessionError> {
        let (mut lattice, mut radius) = (lattice, radius);
        loop {
            let mut refiner = Refiner::new(lattice, RuleSet::extended());
            refiner.insert(points, &Unwatched).map_err(|error| too_close(&error, points))?;
            if Domain::around(refiner.grid(), 0).is_some_and(|around| around.radius <= radius) {
                refiner.begin_changes();
                let mut grown = Self::of(refiner, radius, ids, serials);
                grown.settle_all(points)?;
                return Ok(grown);
            }
            if radius > Domain::MAX_RADIUS / 2 {
                let least = f64::from(radius) * lattice.spacing(0);
                let beyond = |p: &&DVec2| (**p - lattice.origin()).length();
                let at = points.iter().max_by(|p, q| beyond(p).total_cmp(&beyond(q))).copied();
                return Err(SessionError::AtRim { at: at.unwrap_or(lattice.origin()), radius: least });
            }
            lattice = Lattice::new(lattice.origin(), lattice.spacing(1));
            radius *= 2;
        }
    }

    /// The mesh as the templates have it.
    pub(super) fn of(mut refiner: Refiner, radius: u32, ids: &[PointId], serials: Serials) -> Self {
        let (mut dual, touched) = KeptDual::new(refiner.grid_mut(), Domain { base_level: 0, radius });
        let mut cells = Cells::after(serials);
        cells.renew(&refiner, &mut dual, &touched, &mut Replaced::default());
        let mut grown = Self { refiner, dual, cells, of_site: Vec::new() };
        grown.name_points(0, ids);
        grown
    }

    /// Says which points the refiner's are from the `first` added on.
    fn name_points(&mut self, first: usize, ids: &[PointId]) {
        let sites = self.refiner.site_ids();
        self.of_site.resize(sites.len(), PointId(0));
        for (&site, &id) in sites[first..].iter().zip(ids) {
            self.of_site[site as usize] = id;
        }
    }

    /// Makes the whole mesh Delaunay where rounding spoilt that, and certifies
    /// it.
    fn settle_all(&mut self, points: &[DVec2]) -> Result<(), SessionError> {
        let bounds = AngleBounds::EXTENDED;
        let (mut mesh, names) = self.mesh();
        let before = mesh.vertices.clone();
        let free = |v: VertexId| is_free(&self.refiner, &self.dual, names[v.index()]);
        settle_rounding(&mut mesh, bounds, free);
        restore_constrained_delaunay(&mut mesh, bounds, free, |_| false).map_err(crate::Error::Delaunay)?;
        let certificate = certified(&mesh, points);
        if !certificate.holds() {
            let (mesh, certificate) = (Box::new(mesh), Box::new(certificate));
            return Err(crate::Error::NotCertified { mesh, certificate }.into());
        }
        for ((name, now), was) in names.into_iter().zip(mesh.vertices).zip(before) {
            if now != was {
                self.cells.displace(name, now, &mut Replaced::default());
            }
        }
        Ok(())
    }

    /// The whole mesh and the names of its vertices, by place.
    pub(super) fn mesh(&self) -> (TriMesh, Vec<u32>) {
        let (mesh, names, _) = self.cells.whole(&self.pages());
        (mesh, names)
    }

    pub(super) fn pages(&self) -> Vec<u32> {
        self.cells.pages_in_order(&self.refiner, &self.dual)
    }

    pub(super) fn lattice(&self) -> Lattice {
        *self.refiner.grid().lattice()
    }

    /// Steps of level 0 to the corners.
    pub(super) fn steps(&self) -> u32 {
        self.dual.domain().radius
    }

    /// Takes points out, by their place in the order of adding, and puts others
    /// in.
    pub(super) fn exchange(&mut self, gone: &[usize], new: (&[PointId], &[DVec2])) -> Result<Step, Stuck> {
        // On one of the threads that work in parallel: handing them many small
        // tasks from outside would take longer than the tasks.
        rayon::scope(|_| self.exchange_here(gone, new))
    }

    fn exchange_here(
        &mut self,
        gone: &[usize],
        (ids, points): (&[PointId], &[DVec2]),
    ) -> Result<Step, Stuck> {
        let (added, serials) = (self.refiner.site_ids().len(), self.cells.serials);
        let done = self.refiner.exchange(gone, points);
        let changes = self.refiner.take_changes();
        let changed = self.refiner.differences(&changes);
        if done.is_err() || !self.has_room(&changed) {
            self.refiner.revert(&changes);
            self.refiner.forget_from(added);
            return Err(done.map_or_else(Stuck::Levels, |()| Stuck::Rim));
        }
        let touched = self.dual.update(self.refiner.grid_mut(), &changed);
        let mut step = Step { changes, replaced: Replaced::default() };
        let fresh = self.cells.renew(&self.refiner, &mut self.dual, &touched, &mut step.replaced);
        if !settle(&self.refiner, &self.dual, &mut self.cells, &fresh, &mut step.replaced) {
            self.take_back(step);
            self.cells.serials = serials;
            self.refiner.forget_from(added);
            return Err(Stuck::Unsettled);
        }
        self.name_points(added, ids);
        Ok(step)
    }

    /// Whether nothing touches the rim around what has changed.
    fn has_room(&self, changed: &[(u8, TileId, u64)]) -> bool {
        let grid = self.refiner.grid();
        let coarsest = changed.iter().filter(|c| c.0 == 0);
        coarsest
            .flat_map(|&(level, id, _)| grid.tiles().around(level, id).map(move |tile| (level, tile)))
            .all(|(level, id)| self.dual.has_room(grid, level, id))
    }

    /// Takes the last step back that is not taken back yet. Returns what was
    /// there, for the difference.
    pub(super) fn take_back(&mut self, step: Step) -> Replaced {
        let changed = self.refiner.differences(&step.changes);
        self.refiner.revert(&step.changes);
        self.dual.update(self.refiner.grid_mut(), &changed);
        self.cells.put_back(step.replaced)
    }

    /// What a step has changed.
    pub(super) fn delta(&self, step: &Step) -> hexdel_optimize::live::Delta {
        self.cells.delta(&step.replaced)
    }
}

pub(super) fn certified(mesh: &TriMesh, points: &[DVec2]) -> Certificate {
    let bounds = AngleBounds::EXTENDED;
    certify(mesh, &CertifyOptions { bounds, inputs: Some(points), ..CertifyOptions::default() })
}

/// Points that no level tells apart.
pub(super) fn too_close(error: &RefineError, points: &[DVec2]) -> SessionError {
    let at = match error {
        RefineError::TooClose { point, .. } => *point,
        _ => DVec2::ZERO,
    };
    let others = points.iter().copied().filter(|p| *p != at);
    let to = others.min_by(|p, q| p.distance(at).total_cmp(&q.distance(at))).unwrap_or(at);
    let distance = at.distance(to);
    SessionError::TooClose { at, to, distance, least: 2.0 * distance }
}
