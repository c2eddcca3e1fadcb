//! What is asked when.
//!
//! Rules look at one level: what is subdivided there and which input points
//! occupy its hexagons. What they ask for concerns that level, or, where
//! hexagons must exist, the next coarser one. Nothing a coarser level does can
//! break a rule of a finer one, except that a point whose hexagon is subdivided
//! moves down. Hence the order: always the finest level on which something
//! changed. A level is first *closed*, round by round, until no rule wants
//! more of its hexagons subdivided; then its demands are *projected* to the
//! next coarser one.
//!
//! Each round asks all tiles that changed, or have a neighbour that did, about
//! the state before the round, in parallel; what they ask for is then applied
//! in tile order. The result therefore does not depend on the number of
//! threads. A tile is asked again only after a change, so the work is in
//! proportion to what changes: near-linear in the output.

mod live;
mod region;
mod wanted;

use crate::coarsen;
use crate::queue::Queues;
use crate::rule::{RuleSet, Situation};
use crate::sites::Sites;
use hexdel_classify::{Domain, Dual, DualError, Occupant, Relocation, View, extract};
use hexdel_geom::DVec2;
use hexdel_geom::monitor::{Cancelled, Monitor, Phase, check};
use hexdel_geom::par::prelude::*;
use hexdel_grid::grid::hex_of;
use hexdel_grid::window::ones;
use hexdel_grid::{Address, Grid, Lattice, TileId};
use region::{Hull, ROWS_BEYOND};
use std::collections::BTreeMap;
use thiserror::Error;

pub use live::{Changes, RestoreError};

/// Why points cannot be refined for.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RefineError {
    /// A point is so close to another that the levels run out.
    #[error("point {site} at ({}, {}) is closer to another than {levels} levels resolve", point.x, point.y)]
    TooClose {
        /// Index of the point, in the order of adding.
        site: usize,
        /// The point.
        point: DVec2,
        /// How many levels there are.
        levels: u8,
    },
    /// A leaf of the finest level was to be subdivided.
    #[error("a hexagon of the finest of {levels} levels cannot be subdivided")]
    TooFine {
        /// How many levels there are.
        levels: u8,
    },
    /// A rule asks for hexagons farther and farther out. Neither set of this crate does;
    /// a rule of one's own may.
    #[error("a rule asks for hexagons without end, the last of them {at:?}")]
    Unbounded {
        /// The first hexagon that was refused.
        at: Address,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A grid that obeys rules around input points.
#[derive(Clone, Debug)]
pub struct Refiner {
    grid: Grid,
    rules: RuleSet,
    /// Whether closed levels are looked over for what can be merged again.
    coarsening: bool,
    /// All points. Each occupies a leaf of its level, whose mark is set, except
    /// while it descends.
    sites: Sites,
    /// Per level: the tiles that are [`OPEN`], [`UNPROJECTED`] and [`LOOSE`].
    waiting: Vec<Queues<3>>,
    /// Points whose hexagon was subdivided: to be moved down.
    moving: Queues<1>,
    /// Per level: the hull of the tiles in which there was something that no rule of the
    /// level asked for.
    began: Vec<Option<Hull>>,
    /// Rows beyond that hull in which rules are obeyed one hexagon at a time.
    rows_beyond: i64,
    /// Tiles asked so far, for progress.
    asked: u64,
    /// What changes, if points come and go: then demands shrink as well.
    live: Option<Changes>,
    /// Hexagons that the caller wants subdivided while points come and go.
    wanted: BTreeMap<(u8, TileId), u64>,
}

/// Tiles whose rules must be asked again.
const OPEN: usize = 0;

/// Tiles whose demands on the next coarser level may have grown.
const UNPROJECTED: usize = 1;

/// Tiles with a neighbour that changed since the level was last looked over
/// for what can be merged; all that are unprojected are loose.
const LOOSE: usize = 2;

/// Fewer tiles than this are asked at once by one thread: handing them out
/// would take longer.
const TILES_PER_TASK: usize = 64;

/// Points moved down at once.
const SITES_AT_ONCE: usize = 1 << 12;

impl Refiner {
    /// An empty grid on `lattice` that is to obey `rules`.
    pub fn new(lattice: Lattice, rules: RuleSet) -> Self {
        Self {
            grid: Grid::new(lattice),
            rules,
            coarsening: true,
            sites: Sites::default(),
            waiting: Vec::new(),
            moving: Queues::default(),
            began: Vec::new(),
            rows_beyond: ROWS_BEYOND,
            asked: 0,
            live: None,
            wanted: BTreeMap::new(),
        }
    }

    /// With or without local coarsening (section 5.3); with it by default.
    #[must_use]
    pub fn with_coarsening(mut self, coarsening: bool) -> Self {
        self.coarsening = coarsening;
        self
    }

    /// The grid as it stands.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The grid, to add tiles for a mesh.
    pub fn grid_mut(&mut self) -> &mut Grid {
        &mut self.grid
    }

    /// The points and the leaves they occupy, in the order of adding.
    pub fn occupants(&self) -> Vec<Occupant> {
        self.sites.occupants(self.grid.lattice())
    }

    /// The mesh of the grid: what [`extract`] makes of it and of all
    /// points, sooner. Points are taken in the order in which memory holds them
    /// and their tiles; that the rules keep their rings apart makes it the same
    /// mesh.
    ///
    /// # Errors
    ///
    /// As [`extract`].
    pub fn extract(
        &mut self,
        domain: Domain,
        relocation: Relocation,
        monitor: &dyn Monitor,
    ) -> Result<Dual, DualError> {
        let occupants = self.sites.occupants_by_id(self.grid.lattice());
        let mut dual = extract(&mut self.grid, &occupants, domain, relocation, monitor)?;
        let of_site = dual.vertex_of_occupant;
        dual.vertex_of_occupant = self.sites.ids().par_iter().map(|&id| of_site[id as usize]).collect();
        Ok(dual)
    }

    /// How many times the rules were asked about a tile so far, or what it
    /// demands of the next coarser level.
    pub fn tiles_asked(&self) -> u64 {
        self.asked
    }

    /// Adds points and refines until every rule holds again.
    ///
    /// The points must be distinct and finite. Adding them in batches gives a
    /// grid that obeys the same rules, though not always the same grid.
    ///
    /// # Errors
    ///
    /// [`RefineError::TooClose`] if points are too close for the coordinates,
    /// [`RefineError::Cancelled`] if the monitor asks for it. The refiner is
    /// then of no further use.
    ///
    /// # Complexity
    ///
    /// Near-linear in the number of hexagons that come to exist, plus the
    /// number of points times their levels.
    pub fn insert(&mut self, points: &[DVec2], monitor: &dyn Monitor) -> Result<(), RefineError> {
        let lattice = *self.grid.lattice();
        let added = self.sites.add(&lattice, points);
        self.settle(added, monitor)?;
        self.close(monitor)
    }

    /// Subdivides hexagons that the caller needs subdivided, for whatever
    /// reason of its own, and refines until every rule holds again. Coarsening
    /// leaves them subdivided.
    ///
    /// # Errors
    ///
    /// As [`insert`](Self::insert).
    pub fn subdivide_all(
        &mut self,
        hexagons: impl IntoIterator<Item = Address>,
        monitor: &dyn Monitor,
    ) -> Result<(), RefineError> {
        for at in hexagons {
            let (id, bit) = self.grid.tile_of(at);
            self.grid.tiles_mut().get_mut(at.level, id).needed |= 1 << bit;
            self.subdivide(at.level, id, 1 << bit);
        }
        self.sink()?;
        self.close(monitor)
    }

    /// Moves points down until no hexagon holds two and no two occupied ones
    /// are closer than their rings allow.
    fn settle(&mut self, mut moving: Vec<u32>, monitor: &dyn Monitor) -> Result<(), RefineError> {
        let mut level = 0;
        while !moving.is_empty() {
            check(monitor)?;
            self.occupy_all(&moving);
            // Only points can be in conflict yet; what else the rules want is
            // asked again when all points have settled.
            while let Some(queues) = self.waiting.get_mut(level).filter(|q| !q.is_empty(OPEN)) {
                let tiles = queues.take(OPEN, TileId::new);
                let occupied = |id| {
                    let tile = self.grid.tiles().get(level as u8, id);
                    tile.marks[0] | tile.marks[1]
                };
                let tiles: Vec<_> = tiles.into_iter().filter(|&id| occupied(id) != 0).collect();
                for (id, bits) in self.ask(level as u8, tiles, RuleSet::must_subdivide_occupied) {
                    self.subdivide(level as u8, id, bits);
                }
            }
            moving = self.take_moving();
            self.descend(&moving)?;
            level += 1;
        }
        for queues in &mut self.waiting {
            queues.copy(UNPROJECTED, OPEN);
        }
        Ok(())
    }

    /// Closes and projects levels, finest first.
    fn close(&mut self, monitor: &dyn Monitor) -> Result<(), RefineError> {
        let pending = |q: &Queues<3>| !q.is_empty(OPEN) || !q.is_empty(UNPROJECTED);
        while let Some(level) = self.waiting.iter().rposition(pending) {
            check(monitor)?;
            if self.waiting[level].is_empty(OPEN) {
                self.coarsen(level as u8);
                self.project(level as u8)?;
            } else {
                self.round(level as u8)?;
            }
            monitor.progress(Phase::Refine, self.asked, self.asked);
        }
        Ok(())
    }

    /// Asks the open tiles of a level once and subdivides what they want.
    fn round(&mut self, level: u8) -> Result<(), RefineError> {
        let tiles = self.waiting[usize::from(level)].take(OPEN, TileId::new);
        let asked = self.ask(level, tiles, RuleSet::must_subdivide);
        self.subdivide_asked(level, asked)?;
        self.sink()
    }

    /// Moves points whose hexagon was subdivided down to the next leaf.
    fn sink(&mut self) -> Result<(), RefineError> {
        while !self.moving.is_empty(0) {
            let moving = self.take_moving();
            self.descend(&moving)?;
            self.occupy_all(&moving);
        }
        Ok(())
    }

    fn take_moving(&mut self) -> Vec<u32> {
        self.moving.take(0, |id| id as u32)
    }

    /// The hexagons that the rules want subdivided, by tile.
    fn ask(
        &mut self,
        level: u8,
        tiles: Vec<TileId>,
        wanted: fn(&RuleSet, &Situation) -> u64,
    ) -> Vec<(TileId, u64)> {
        self.asked += tiles.len() as u64;
        let ask = |id| {
            let view = View::of(&self.grid, level, id);
            if view.is_empty() {
                return (id, 0);
            }
            (id, wanted(&self.rules, &Situation::of(view)))
        };
        let tiles = tiles.into_par_iter().with_min_len(TILES_PER_TASK);
        tiles.map(ask).filter(|(_, bits)| *bits != 0).collect()
    }

    /// Merges what a closed level has to spare.
    fn coarsen(&mut self, level: u8) {
        if self.coarsening {
            let tiles = self.waiting[usize::from(level)].take(LOOSE, TileId::new);
            let merged = coarsen::coarsen(&mut self.grid, level, &tiles, &self.rules);
            self.note_merged(level, &merged);
        }
    }

    /// Passes the demands of a level on to the next coarser one.
    fn project(&mut self, level: u8) -> Result<(), RefineError> {
        let tiles = self.waiting[usize::from(level)].take(UNPROJECTED, TileId::new);
        let Some(coarser) = level.checked_sub(1) else {
            return Ok(());
        };
        self.asked += tiles.len() as u64;
        let demand = |id| {
            let view = View::of(&self.grid, level, id);
            if view.is_empty() {
                return (id, 0);
            }
            let situation = Situation::of(view);
            // The parents of a hexagon are those whose scaled centre it is or
            // lies beside.
            (id, self.rules.must_exist(&situation).dilated().even_centre())
        };
        let shrinking = self.live.is_some();
        let tiles = tiles.into_par_iter().with_min_len(TILES_PER_TASK);
        let demands: Vec<_> = tiles.map(demand).filter(|(_, d)| shrinking || *d != 0).collect();
        let mut lost = Vec::new();
        for (id, demand) in demands {
            let (parent, quadrant) = self.grid.tiles().parent(level, id).expect("level 0 is not projected");
            let bits = in_quadrant(demand, quadrant);
            if shrinking {
                lost.extend(self.replace_needed(coarser, parent, (quadrant, bits)));
            } else {
                self.grid.tiles_mut().get_mut(coarser, parent).needed |= bits;
            }
            self.subdivide(coarser, parent, bits);
        }
        self.reset(coarser, lost);
        self.sink()
    }

    /// Subdivides hexagons of a tile for a reason from outside of its level.
    fn subdivide(&mut self, level: u8, id: TileId, bits: u64) {
        if bits != 0 {
            self.begin_in(level, id);
        }
        self.subdivide_in(level, id, bits);
    }

    /// Subdivides hexagons of a tile, and says whether there was anything to subdivide. The
    /// points that occupy them are to be moved.
    fn subdivide_in(&mut self, level: u8, id: TileId, bits: u64) -> bool {
        let subdivided = self.mark_subdivided(level, id, bits);
        if subdivided != 0 {
            self.changed(level, id, subdivided);
        }
        subdivided != 0
    }

    /// The same without noting the change; returns what was not subdivided yet.
    fn mark_subdivided(&mut self, level: u8, id: TileId, bits: u64) -> u64 {
        self.note(level, id);
        let tile = self.grid.tiles_mut().get_mut(level, id);
        let bits = bits & !tile.subdivided;
        tile.subdivided |= bits;
        let occupied = bits & (tile.marks[0] | tile.marks[1]);
        tile.marks = tile.marks.map(|plane| plane & !bits);
        for bit in ones(occupied) {
            let site = self.sites.leave(level, id, bit).expect("a marked hexagon has an occupant");
            self.note_site(site);
            self.moving.push(site as usize, [true]);
        }
        bits
    }

    /// Puts points one level down.
    fn descend(&mut self, moving: &[u32]) -> Result<(), RefineError> {
        let (lattice, levels) = (*self.grid.lattice(), Grid::MAX_LEVELS);
        // As many at once as the cache holds.
        for some in moving.chunks(SITES_AT_ONCE) {
            let lower = |&id: &u32| self.sites.get(id).below(&lattice);
            let lowered: Vec<_> = some.par_iter().with_min_len(TILES_PER_TASK).map(lower).collect();
            for (&id, site) in some.iter().zip(lowered) {
                if site.level >= levels {
                    let (site, point) = (self.sites.index_of(id), site.point);
                    return Err(RefineError::TooClose { site, point, levels });
                }
                *self.sites.get_mut(id) = site;
            }
        }
        Ok(())
    }

    /// Lets points occupy their hexagons. If one is subdivided its point moves
    /// on, if it is occupied both do.
    fn occupy_all(&mut self, sites: &[u32]) {
        // Points come along a curve: the next one's tile is near the last's,
        // and mostly the same. What changed in it is noted once.
        let mut last: Option<(u8, TileId, u64)> = None;
        let mut passed = None;
        for &id in sites {
            let (level, hex) = (self.sites.get(id).level, self.sites.get(id).at.hex);
            if let Some((_, _, tile)) = passed.filter(|&(l, h, _)| (l, h) == (level, hex)) {
                self.sites.pass(id, tile);
                self.moving.push(id as usize, [true]);
                continue;
            }
            let tiles = self.grid.tiles_mut();
            let near = last.filter(|&(l, _, _)| l == level);
            let near = near.and_then(|(_, near, _)| tiles.require_near(level, near, hex));
            let (tile, bit) = near.unwrap_or_else(|| match level {
                0 => tiles.require(0, hex),
                // It comes from the level above.
                _ => tiles.require_under(level, self.sites.tile_of(id), hex),
            });
            let changed = self.occupy(id, (tile, bit));
            if self.grid.tiles().get(level, tile).subdivided >> bit & 1 == 1 {
                passed = Some((level, hex, tile));
            }
            match &mut last {
                Some((l, t, bits)) if (*l, *t) == (level, tile) => *bits |= changed,
                _ => self.changed_if_any(last.replace((level, tile, changed))),
            }
        }
        self.changed_if_any(last);
    }

    /// Returns what changed in the tile: the point's hexagon, or nothing.
    fn occupy(&mut self, site: u32, (id, bit): (TileId, u32)) -> u64 {
        let level = self.sites.get(site).level;
        let tile = self.grid.tiles().get(level, id);
        if tile.subdivided >> bit & 1 == 1 {
            self.sites.pass(site, id);
            self.moving.push(site as usize, [true]);
            return 0;
        }
        if (tile.marks[0] | tile.marks[1]) >> bit & 1 == 1 {
            self.sites.pass(site, id);
            self.moving.push(site as usize, [true]);
            return self.mark_subdivided(level, id, 1 << bit);
        }
        self.note(level, id);
        let plane = self.sites.get(site).plane(self.grid.lattice());
        self.grid.tiles_mut().get_mut(level, id).marks[plane] |= 1 << bit;
        self.sites.enter(site, id);
        1 << bit
    }

    fn changed_if_any(&mut self, change: Option<(u8, TileId, u64)>) {
        if let Some((level, id, bits)) = change.filter(|&(_, _, bits)| bits != 0) {
            self.begin_in(level, id);
            self.changed(level, id, bits);
        }
    }

    /// Notes that hexagons of a tile changed: all tiles that see them are to be
    /// asked again.
    fn changed(&mut self, level: u8, id: TileId, bits: u64) {
        let k = usize::from(level);
        if k >= self.waiting.len() {
            self.waiting.resize_with(k + 1, Queues::default);
        }
        let queues = &mut self.waiting[k];
        for (tile, reached) in self.grid.tiles_mut().require_margin(level, id, bits).iter() {
            queues.push(tile.index(), [reached, reached, true]);
        }
    }

    /// The first hexagon that breaks a rule, with the rule's name: `None` after
    /// every successful [`insert`](Self::insert).
    pub fn violation(&self) -> Option<(Address, &'static str)> {
        (0..self.grid.tiles().levels() as u8).find_map(|level| {
            let ids = (0..self.grid.tiles().level(level).len()).map(TileId::new);
            ids.into_iter().find_map(|id| self.violation_in(level, id))
        })
    }

    fn violation_in(&self, level: u8, id: TileId) -> Option<(Address, &'static str)> {
        let situation = Situation::of(View::of(&self.grid, level, id));
        let first = self.grid.tiles().first(level, id);
        let at = |bit| Address::new(level, first + hex_of(bit));
        self.rules.iter().find_map(|rule| {
            let asked = rule.must_subdivide(&situation).without(situation.view.subdivided).centre();
            let missing = ones(rule.must_exist(&situation).centre()).find(|&b| !self.grid.exists(at(b)));
            ones(asked).next().or(missing).map(|bit| (at(bit), rule.name()))
        })
    }
}

/// Four by four hexagons of a quarter of a tile as bits of the tile.
fn in_quadrant(demand: u16, quadrant: usize) -> u64 {
    let (column, row) = (4 * (quadrant & 1), 4 * (quadrant >> 1));
    (0..4).fold(0, |bits, r| {
        let four = u64::from(demand >> (4 * r) & 0xf);
        bits | four << (8 * (row + r) + column)
    })
}
