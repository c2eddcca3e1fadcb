//! A grid of points, its mesh, and the two kept in step.

use super::cells::{Cells, Replaced, Serials, in_order};
use super::patch::{is_free, settle};
use crate::{PointId, SessionError};
use hexdel_classify::{Domain, KeptDual};
use hexdel_geom::delaunay::restore_constrained_delaunay;
use hexdel_geom::par::on_a_thread;
use hexdel_geom::{
    AngleBounds, Certificate, CertifyOptions, DVec2, TriMesh, Unwatched, VertexId, certify, settle_rounding,
};
use hexdel_grid::{Address, Grid, Hex, Lattice, TileId};
use hexdel_mesher::for_sessions::CONFLICT_REACH;
use hexdel_mesher::for_sessions::along_rim;
use hexdel_mesher::for_sessions::{has_shorter_edge, shortest_edge};
use hexdel_mesher::{Size, SizeError};
use hexdel_optimize::{Sizing, edge_fits};
use hexdel_refine::{Changes, RefineError, Refiner, RuleSet};
use std::sync::Arc;

/// Rounds of refinement for a size: one for each level, and as many again for edges that
/// the rules make longer on the way.
const SIZE_ROUNDS: usize = 2 * Grid::MAX_LEVELS as usize;

/// The grid and its mesh.
#[derive(Clone, Debug)]
pub(super) struct Grown {
    pub(super) refiner: Refiner,
    pub(super) dual: KeptDual,
    pub(super) cells: Cells,
    /// The point in each place of the refiner's memory.
    pub(super) of_site: Vec<PointId>,
    /// How long edges may be.
    pub(super) size: Option<Arc<Size>>,
}

/// One call, as what undoes it.
#[derive(Clone, Debug)]
pub(super) struct Step {
    changes: Changes,
    replaced: Replaced,
    /// The size before.
    size: Option<Arc<Size>>,
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
        (serials, size): (Serials, Option<Arc<Size>>),
    ) -> Result<Self, SessionError> {
        let (mut lattice, mut radius) = (lattice, radius);
        if let Some(size) = &size {
            let wanted = along_rim(size, lattice.origin(), f64::from(radius) * lattice.spacing(0));
            while lattice.spacing(0) > wanted {
                (lattice, radius) = finer(lattice, radius)?;
            }
        }
        loop {
            let mut refiner = Refiner::new(lattice, RuleSet::extended());
            refiner.insert(points, &Unwatched).map_err(|error| too_close(&error, &lattice, points))?;
            if Domain::around(refiner.grid(), 0).is_some_and(|around| around.radius <= radius) {
                refiner.begin_changes();
                let mut grown = Self::of(refiner, radius, ids, serials);
                grown.size.clone_from(&size);
                match grown.shorten_all() {
                    Ok(()) => {
                        grown.settle_all(points)?;
                        return Ok(grown);
                    }
                    Err(Stuck::Levels(_)) => return Err(too_fine().into()),
                    // What is too long touches the rim.
                    Err(_) => {
                        (lattice, radius) = finer(lattice, radius)?;
                        continue;
                    }
                }
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
        let mut grown = Self { refiner, dual, cells, of_site: Vec::new(), size: None };
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
        restore_constrained_delaunay(&mut mesh, bounds, free, |_| false)
            .map_err(hexdel_mesher::Error::Delaunay)?;
        let certificate = certified(&mesh, points, None);
        if !certificate.holds() {
            let (mesh, certificate) = (Box::new(mesh), Box::new(certificate));
            return Err(hexdel_mesher::Error::NotCertified { mesh, certificate }.into());
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

    /// The certificate of the whole mesh.
    pub(super) fn certificate(&self, points: &[DVec2]) -> Certificate {
        let mesh = self.mesh().0;
        let allowed = self.shortest_edge_allowed(&mesh, points);
        certified(&mesh, points, allowed.filter(|&edge| !has_shorter_edge(&mesh, edge)))
    }

    /// Whether an edge is shorter than what is there allows, as where points hold each other
    /// down on levels that a size has asked for.
    pub(super) fn has_short_edge(&self, points: &[DVec2]) -> bool {
        let mesh = self.mesh().0;
        self.shortest_edge_allowed(&mesh, points).is_some_and(|edge| has_shorter_edge(&mesh, edge))
    }

    fn shortest_edge_allowed(&self, mesh: &TriMesh, points: &[DVec2]) -> Option<f64> {
        let lattice = self.lattice();
        let domain = (lattice.origin(), f64::from(self.steps()) * lattice.spacing(0));
        shortest_edge(points, domain, mesh, self.size.as_deref())
    }

    /// Takes points out, by their place in the order of adding, and puts others
    /// in; with those that go all others anew, if that is wanted.
    pub(super) fn exchange(
        &mut self,
        gone: (&[usize], bool),
        new: (&[PointId], &[DVec2]),
    ) -> Result<Step, Stuck> {
        on_a_thread(|| self.exchange_here(gone, new))
    }

    fn exchange_here(
        &mut self,
        (gone, all): (&[usize], bool),
        (ids, points): (&[PointId], &[DVec2]),
    ) -> Result<Step, Stuck> {
        let (added, serials) = (self.refiner.site_ids().len(), self.cells.serials);
        let done =
            if all { self.refiner.exchange_all(gone, points) } else { self.refiner.exchange(gone, points) };
        match self.follow(done, false) {
            Ok(step) => {
                self.name_points(added, ids);
                Ok(step)
            }
            Err(stuck) => {
                self.cells.serials = serials;
                self.refiner.forget_from(added);
                Err(stuck)
            }
        }
    }

    /// Brings the mesh in step with the grid, and the grid with the size: from then on
    /// edges fit, here or where something has changed.
    fn follow(&mut self, mut done: Result<(), RefineError>, everywhere: bool) -> Result<Step, Stuck> {
        let mut replaced = Replaced::default();
        for round in 0..SIZE_ROUNDS {
            let changed = self.refiner.differences_so_far();
            let stuck = match done {
                Err(error) => Some(Stuck::Levels(error)),
                Ok(()) => (!self.has_room(&changed)).then_some(Stuck::Rim),
            };
            if let Some(stuck) = stuck {
                self.abandon(replaced);
                return Err(stuck);
            }
            let touched = self.dual.update(self.refiner.grid_mut(), &changed);
            let mut fresh = self.cells.renew(&self.refiner, &mut self.dual, &touched, &mut replaced);
            let long = match &self.size {
                None => Vec::new(),
                Some(_) if everywhere && round == 0 => self.at_long_edges(&self.pages()),
                Some(_) => {
                    let tiles = in_order(&self.refiner, &touched.triangles);
                    let pages = tiles.into_iter().filter_map(|(level, id)| self.dual.page(level, id));
                    self.at_long_edges(&pages.collect::<Vec<_>>())
                }
            };
            if long.is_empty() {
                if round > 0 {
                    fresh = self.cells.fresh_since(&replaced);
                }
                if settle(&self.refiner, &self.dual, &mut self.cells, &fresh, &mut replaced) {
                    let changes = self.refiner.take_changes();
                    return Ok(Step { changes, replaced, size: self.size.clone() });
                }
                break;
            }
            done = self.refiner.want(&long);
        }
        self.abandon(replaced);
        Err(Stuck::Unsettled)
    }

    /// Takes back what has changed since the last step.
    fn abandon(&mut self, replaced: Replaced) {
        let changes = self.refiner.take_changes();
        self.take_back(Step { changes, replaced, size: self.size.clone() });
    }

    /// Whether edges along the rim are as short as they are because of the size there is,
    /// and another allows them to be twice as long.
    pub(super) fn frees_rim(&self, size: Option<&Size>) -> bool {
        let spacing = self.lattice().spacing(0);
        let radius = f64::from(self.steps()) * spacing;
        let along =
            |s: Option<&Size>| s.map_or(f64::INFINITY, |s| along_rim(s, self.lattice().origin(), radius));
        let now = along(self.size.as_deref());
        // Edges near the rim may have asked for half of what is wanted along it.
        now < 4.0 * spacing && along(size) >= 2.0 * now
    }

    /// Wants edges to be no longer than a size says.
    pub(super) fn set_size(&mut self, size: Option<Arc<Size>>) -> Result<Step, Stuck> {
        let (serials, old) = (self.cells.serials, std::mem::replace(&mut self.size, size));
        let lattice = self.lattice();
        let at = |size: &Option<Arc<Size>>, p| size.as_ref().map_or(f64::INFINITY, |s| s.at(p));
        // Where edges may be longer than before nothing is kept that is not sure to be
        // wanted: what is too long then is found.
        let keep = |address: Address| {
            let centre = lattice.position(address);
            let new = at(&self.size, centre);
            new <= at(&old, centre) || lattice.spacing(address.level) > new
        };
        let done = self.refiner.drop_wanted(keep);
        let followed = on_a_thread(|| self.follow(done, true));
        match followed {
            Ok(step) => Ok(Step { size: old, ..step }),
            Err(stuck) => {
                (self.cells.serials, self.size) = (serials, old);
                Err(stuck)
            }
        }
    }

    /// Refines a new mesh until every edge fits.
    fn shorten_all(&mut self) -> Result<(), Stuck> {
        for _ in 0..SIZE_ROUNDS {
            let long = if self.size.is_some() { self.at_long_edges(&self.pages()) } else { Vec::new() };
            if long.is_empty() {
                return Ok(());
            }
            self.refiner.want(&long).map_err(Stuck::Levels)?;
            let changes = self.refiner.take_changes();
            let changed = self.refiner.differences(&changes);
            if !self.has_room(&changed) {
                return Err(Stuck::Rim);
            }
            let touched = self.dual.update(self.refiner.grid_mut(), &changed);
            self.cells.renew(&self.refiner, &mut self.dual, &touched, &mut Replaced::default());
        }
        Err(Stuck::Unsettled)
    }

    /// The coarsest leaves at the ends and middles of edges of some pages that are too
    /// long; ascending.
    fn at_long_edges(&self, pages: &[u32]) -> Vec<Address> {
        let Some(size) = self.size.as_deref() else { return Vec::new() };
        let grid = self.refiner.grid();
        let mut found = Vec::new();
        for t in pages.iter().flat_map(|&page| &self.cells.by_page[page as usize].triangles) {
            let at = t.corners.map(|name| self.cells.vertex(name).map(|v| v.0));
            for k in 0..3 {
                let (Some(a), Some(b)) = (at[k], at[(k + 1) % 3]) else { continue };
                if edge_fits(size, a, b) {
                    continue;
                }
                let leaves =
                    [a, b, 0.5 * (a + b)].map(|p| grid.locate(p)).map(|(level, at, _)| (level, at.hex));
                let level = leaves.iter().map(|l| l.0).min().unwrap_or(0);
                found.extend(leaves.iter().filter(|l| l.0 == level).map(|l| (l.0, l.1.q, l.1.r)));
            }
        }
        found.sort_unstable();
        found.dedup();
        found.into_iter().map(|(level, q, r)| Address::new(level, Hex::new(q, r))).collect()
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
        self.size = step.size;
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

/// The lattice with half the spacing.
fn finer(lattice: Lattice, radius: u32) -> Result<(Lattice, u32), SizeError> {
    if radius > Domain::MAX_RADIUS / 2 {
        // As many as a hexagon of twice the steps has.
        return Err(SizeError::TooMany { triangles: 24.0 * f64::from(radius).powi(2) });
    }
    Ok((Lattice::new(lattice.origin(), lattice.spacing(1)), 2 * radius))
}

pub(super) fn too_fine() -> SizeError {
    SizeError::TooFine { levels: Grid::MAX_LEVELS }
}

/// The certificate of a mesh, against a shortest edge if one is promised.
pub(super) fn certified(mesh: &TriMesh, points: &[DVec2], min_edge: Option<f64>) -> Certificate {
    let bounds = AngleBounds::EXTENDED;
    certify(mesh, &CertifyOptions { bounds, inputs: Some(points), min_edge, ..CertifyOptions::default() })
}

/// Points that no level tells apart.
pub(super) fn too_close(error: &RefineError, lattice: &Lattice, points: &[DVec2]) -> SessionError {
    let RefineError::TooClose { point: at, .. } = *error else {
        return too_fine().into();
    };
    let others = points.iter().copied().filter(|p| *p != at);
    let Some(to) = others.min_by(|p, q| p.distance(at).total_cmp(&q.distance(at))) else {
        return too_fine().into();
    };
    let least = lattice.spacing(Grid::MAX_LEVELS - 2) * CONFLICT_REACH;
    SessionError::TooClose { at, to, distance: at.distance(to), least }
}
