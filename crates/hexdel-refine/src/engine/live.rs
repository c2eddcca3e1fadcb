//! A grid whose points come and go.
//!
//! Refinement made for a mesh only ever adds: what a level needs of the next
//! coarser one may grow, and is kept. Here it may shrink as well. What a level
//! needs is replaced when it is asked again; where something is no longer
//! needed, the hexagons that nobody needs are merged in the tiles around, and
//! the rules are asked what of that they want back. So a change goes from the
//! finest level to coarser ones for as long as something changes, and no
//! farther.
//!
//! A point that goes may have held others down: those near it are taken out
//! with it and put in again.
//!
//! Every write is noted with what was there before, to be taken back.

use super::{LOOSE, OPEN, RefineError, Refiner, UNPROJECTED};
use crate::rule::{RuleSet, Situation};
use crate::sites::Site;
use hexdel_classify::{Occupant, View};
use hexdel_geom::{DVec2, Unwatched};
use hexdel_grid::grid::hex_of;
use hexdel_grid::tiles::{Margin, SIDE};
use hexdel_grid::window::ones;
use hexdel_grid::{Address, Grid, Hex, Lattice, TileId};
use std::collections::BTreeMap;
use thiserror::Error;

/// How far around a point that goes others are put in anew, in steps of the
/// level that they are on: two that hold each other down because of it can only
/// rise together. Within 7 steps the grid keeps a fifth more hexagons than it
/// needs, within 20 a hundredth.
const LIFTED: u64 = 20;

/// The sets of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Planes {
    /// The hexagons that are subdivided.
    subdivided: u64,
    /// Those of them that the next finer level needs.
    needed: u64,
    /// The occupied ones, by class.
    marks: [u64; 2],
}

impl Planes {
    fn of(grid: &Grid, level: u8, id: TileId) -> Self {
        let tile = grid.tiles().get(level, id);
        Self { subdivided: tile.subdivided, needed: tile.needed, marks: tile.marks }
    }
}

/// What was changed, as it was before.
#[derive(Clone, Debug, Default)]
pub struct Changes {
    /// Tiles that were written to.
    tiles: BTreeMap<(u8, TileId), Planes>,
    /// Points that were put elsewhere; none for those that were not there.
    sites: BTreeMap<u32, Option<Site>>,
    /// What was wanted in tiles where that has changed.
    pub(super) wanted: BTreeMap<(u8, TileId), u64>,
}

/// Why a grid is not one that points left behind.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// A level or a place is beyond what there is.
    #[error("level {level} holds a tile at {first:?} beyond all levels or hexagons")]
    OutOfRange {
        /// The level.
        level: u8,
        /// First hexagon of the tile, or the hexagon.
        first: Hex,
    },
    /// A point occupies no leaf, or one that is occupied.
    #[error("point {site} occupies no leaf of its own on level {level}")]
    NoLeaf {
        /// Index of the point.
        site: usize,
        /// The level it is said to be on.
        level: u8,
    },
    /// A rule does not hold.
    #[error("{rule} does not hold at {at:?}")]
    Rule {
        /// Where.
        at: Address,
        /// The rule's name.
        rule: &'static str,
    },
}

impl Refiner {
    /// From now on changes are noted, and demands shrink when points go.
    ///
    /// # Complexity
    ///
    /// Linear in the grid: demands that have become less on the way here are
    /// found.
    pub fn begin_changes(&mut self) {
        for level in 0..self.grid.tiles().levels() as u8 {
            for id in (0..self.grid.tiles().level(level).len()).map(TileId::new) {
                self.grid.tiles_mut().get_mut(level, id).needed = 0;
            }
        }
        let lacking = self.gather_needed();
        debug_assert_eq!(lacking, None, "every rule holds");
        debug_assert!(self.wanted.is_empty(), "nothing is wanted before the first change");
        self.live = Some(Changes::default());
    }

    /// What has changed since the last time this was asked.
    pub fn take_changes(&mut self) -> Changes {
        self.live.replace(Changes::default()).unwrap_or_default()
    }

    /// Takes points out, by their place in the order of adding, and puts others
    /// in. The points must be distinct and finite, and those that go there.
    ///
    /// # Errors
    ///
    /// As [`insert`](Self::insert); [`revert`](Self::revert) then restores the
    /// grid.
    ///
    /// # Complexity
    ///
    /// In proportion to the tiles that change, and to the number of levels.
    pub fn exchange(&mut self, gone: &[usize], points: &[DVec2]) -> Result<(), RefineError> {
        self.exchange_and_lift(gone, points, false)
    }

    /// The same with all points put in anew, so that those rise which hold each other
    /// down over any distance.
    ///
    /// # Errors
    ///
    /// As [`exchange`](Self::exchange).
    ///
    /// # Complexity
    ///
    /// That of putting all points in.
    pub fn exchange_all(&mut self, gone: &[usize], points: &[DVec2]) -> Result<(), RefineError> {
        self.exchange_and_lift(gone, points, true)
    }

    fn exchange_and_lift(&mut self, gone: &[usize], points: &[DVec2], all: bool) -> Result<(), RefineError> {
        if !gone.is_empty() {
            let gone: Vec<u32> = gone.iter().map(|&i| self.sites.ids()[i]).collect();
            for &id in &gone {
                self.take_out(id);
            }
            let lifted = if all { self.all_there() } else { self.around(&gone) };
            self.lift(lifted)?;
        }
        if points.is_empty() {
            return Ok(());
        }
        let lattice = *self.grid.lattice();
        let added = self.sites.add(&lattice, points);
        if let Some(live) = &mut self.live {
            live.sites.extend(added.iter().map(|&id| (id, None)));
        }
        self.settle(added, &Unwatched)?;
        self.close(&Unwatched)
    }

    /// Takes a point off its hexagon.
    fn take_out(&mut self, id: u32) {
        self.note_site(id);
        let (site, tile) = (*self.sites.get(id), self.sites.tile_of(id));
        let bit = bit_of(site.at.hex);
        self.note(site.level, tile);
        self.sites.leave(site.level, tile, bit);
        let planes = self.grid.tiles_mut().get_mut(site.level, tile);
        planes.marks = planes.marks.map(|plane| plane & !(1 << bit));
        self.changed(site.level, tile, 1 << bit);
    }

    /// Puts points anew: those that others, which are gone, may have held down.
    fn lift(&mut self, lifted: Vec<u32>) -> Result<(), RefineError> {
        for &id in &lifted {
            self.take_out(id);
        }
        self.close(&Unwatched)?;
        let lattice = *self.grid.lattice();
        for &id in &lifted {
            *self.sites.get_mut(id) = Site::new(&lattice, 0, self.sites.get(id).point);
        }
        self.settle(lifted, &Unwatched)?;
        self.close(&Unwatched)
    }

    /// All points that are there, ascending.
    fn all_there(&self) -> Vec<u32> {
        let mut all: Vec<u32> = self.sites.ids().iter().copied().filter(|&id| self.is_there(id)).collect();
        all.sort_unstable();
        all
    }

    /// The points that others may have held down: no deeper than one of them,
    /// and near it on the level that they are on. Ascending.
    fn around(&self, gone: &[u32]) -> Vec<u32> {
        let mut found = Vec::new();
        for &id in gone {
            let site = self.sites.get(id);
            for level in 0..=site.level {
                let hex = self.grid.lattice().locate(level, site.point).hex;
                found.extend(self.sites_near(level, hex, LIFTED));
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Sites that occupy hexagons of a level at most `reach` steps away.
    fn sites_near(&self, level: u8, hex: Hex, reach: u64) -> impl Iterator<Item = u32> + '_ {
        let tiles = self.grid.tiles();
        let n = reach.div_ceil(SIDE as u64) as i64;
        let around = (-n..=n).flat_map(move |r| (-n..=n).map(move |q| Hex::new(SIDE * q, SIDE * r)));
        let around = around.filter_map(move |step| Some(tiles.find(level, hex + step)?.0));
        let occupied = around.filter(move |&id| tiles.get(level, id).marks != [0; 2]);
        let all = occupied.flat_map(move |id| self.sites.of_tile(level, id));
        all.filter(move |&id| self.sites.get(id).at.hex.distance(hex) <= reach)
    }

    /// The points whose hexagons lie at most two steps from the finest place
    /// that holds `point`: their places in memory (see
    /// [`sites`](Self::site_ids)) and themselves.
    pub fn near(&self, point: DVec2) -> Vec<(u32, DVec2)> {
        let (level, at, _) = self.grid.locate(point);
        let near = self.sites_near(level, at.hex, 2);
        near.map(|id| (id, self.sites.get(id).point)).collect()
    }

    /// The place in memory of each point, in the order of adding.
    pub fn site_ids(&self) -> &[u32] {
        self.sites.ids()
    }

    /// Forgets the points from `count` on, in the order of adding, which must
    /// have been taken out.
    pub fn forget_from(&mut self, count: usize) {
        self.sites.truncate(count);
    }

    /// The point that was added as the `i`th, and where it is or was last.
    pub fn occupant(&self, i: usize) -> Occupant {
        self.occupant_at(self.sites.ids()[i])
    }

    fn occupant_at(&self, id: u32) -> Occupant {
        let site = self.sites.get(id);
        let at = self.grid.lattice().locate(site.level, site.point);
        Occupant { level: site.level, at, tile: self.sites.tile_of(id), point: site.point }
    }

    /// The points in a tile, in no particular order.
    pub fn occupants_of(&self, level: u8, tile: TileId) -> impl Iterator<Item = Occupant> + '_ {
        self.sites.of_tile(level, tile).map(|id| self.occupant_at(id))
    }

    /// The same for what has changed since [`take_changes`](Self::take_changes) was asked.
    pub fn differences_so_far(&self) -> Vec<(u8, TileId, u64)> {
        self.live.as_ref().map_or_else(Vec::new, |changes| self.differences(changes))
    }

    /// The tiles in which something differs from what it was before `changes`,
    /// and the hexagons there that were or are subdivided or occupied
    /// otherwise. In order.
    pub fn differences(&self, changes: &Changes) -> Vec<(u8, TileId, u64)> {
        let mut found = BTreeMap::new();
        for (&(level, id), old) in &changes.tiles {
            let new = Planes::of(&self.grid, level, id);
            let bits = (old.subdivided ^ new.subdivided)
                | (old.marks[0] ^ new.marks[0])
                | (old.marks[1] ^ new.marks[1]);
            if bits != 0 {
                found.insert((level, id), bits);
            }
        }
        for (&site, old) in &changes.sites {
            let new = Some(*self.sites.get(site)).filter(|_| self.is_there(site));
            for at in [*old, new].into_iter().flatten().filter(|_| *old != new) {
                if let Some((id, bit)) = self.grid.tiles().find(at.level, at.at.hex) {
                    *found.entry((at.level, id)).or_default() |= 1 << bit;
                }
            }
        }
        found.into_iter().map(|((level, id), bits)| (level, id, bits)).collect()
    }

    /// Whether a site occupies its hexagon.
    fn is_there(&self, id: u32) -> bool {
        let level = self.sites.get(id).level;
        self.sites.of_tile(level, self.sites.tile_of(id)).any(|other| other == id)
    }

    /// Takes changes back: the last ones not taken back yet. What is pending
    /// after an error is forgotten.
    pub fn revert(&mut self, changes: &Changes) {
        for queues in &mut self.waiting {
            for set in [OPEN, UNPROJECTED, LOOSE] {
                queues.take(set, TileId::new);
            }
        }
        self.take_moving();
        for &id in changes.sites.keys() {
            if self.is_there(id) {
                let (level, tile) = (self.sites.get(id).level, self.sites.tile_of(id));
                self.sites.leave(level, tile, bit_of(self.sites.get(id).at.hex));
            }
        }
        for (&(level, id), planes) in &changes.tiles {
            let tile = self.grid.tiles_mut().get_mut(level, id);
            (tile.subdivided, tile.needed, tile.marks) = (planes.subdivided, planes.needed, planes.marks);
        }
        self.wanted.extend(&changes.wanted);
        self.wanted.retain(|_, bits| *bits != 0);
        for (&id, site) in &changes.sites {
            if let Some(site) = site {
                *self.sites.get_mut(id) = *site;
                let (tile, _) = self.grid.tile_of(Address::new(site.level, site.at.hex));
                self.sites.enter(id, tile);
            }
        }
    }

    /// Notes a tile that is about to change.
    #[inline]
    pub(super) fn note(&mut self, level: u8, id: TileId) {
        if let Some(live) = &mut self.live {
            live.tiles.entry((level, id)).or_insert_with(|| Planes::of(&self.grid, level, id));
        }
    }

    /// Notes a point that is about to be put elsewhere.
    #[inline]
    pub(super) fn note_site(&mut self, id: u32) {
        if let Some(live) = &mut self.live {
            live.sites.entry(id).or_insert_with(|| Some(*self.sites.get(id)));
        }
    }

    /// Notes what coarsening has merged, which needs less than it did.
    pub(super) fn note_merged(&mut self, level: u8, merged: &[(TileId, u64)]) {
        let Some(live) = &mut self.live else {
            return;
        };
        let waiting = &mut self.waiting[usize::from(level)];
        for &(id, before) in merged {
            let now = Planes::of(&self.grid, level, id);
            live.tiles.entry((level, id)).or_insert(Planes { subdivided: before, ..now });
            let bits = before ^ now.subdivided;
            for tile in reached(self.grid.tiles_mut().require_margin(level, id, bits)) {
                waiting.push(tile.index(), [false, true, false]);
            }
        }
    }

    /// Replaces what a quarter of a tile is needed for, and returns what no
    /// longer is.
    pub(super) fn replace_needed(
        &mut self,
        level: u8,
        id: TileId,
        (quadrant, bits): (usize, u64),
    ) -> Option<(TileId, u64)> {
        let own = super::in_quadrant(u16::MAX, quadrant);
        let old = self.grid.tiles().get(level, id).needed;
        let new = old & !own | bits | own & self.wanted_in(level, id);
        if old == new {
            return None;
        }
        self.note(level, id);
        self.grid.tiles_mut().get_mut(level, id).needed = new;
        (old & !new != 0).then_some((id, old & !new))
    }

    /// Merges what nobody needs in the tiles that see hexagons which are no
    /// longer needed. The rules are asked again there.
    pub(super) fn reset(&mut self, level: u8, lost: Vec<(TileId, u64)>) {
        let mut seen = Vec::new();
        for (id, bits) in lost {
            seen.extend(reached(self.grid.tiles_mut().require_margin(level, id, bits)));
        }
        seen.sort_unstable();
        seen.dedup();
        for id in seen {
            let tile = self.grid.tiles().get(level, id);
            let spare = tile.subdivided & !tile.needed;
            if spare != 0 {
                self.note(level, id);
                self.grid.tiles_mut().get_mut(level, id).subdivided &= !spare;
                self.changed(level, id, spare);
            }
        }
    }

    /// A grid as it was left: its subdivided hexagons tile by tile, each given
    /// by its first hexagon and a bit set, and the levels of its points.
    ///
    /// # Errors
    ///
    /// [`RestoreError`] if it is not one that obeys `rules` around the points.
    ///
    /// # Complexity
    ///
    /// Linear in the grid, times the number of levels.
    pub fn restored(
        lattice: Lattice,
        rules: RuleSet,
        subdivided: impl IntoIterator<Item = (u8, Hex, u64)>,
        sites: &[(DVec2, Option<u8>)],
    ) -> Result<Self, RestoreError> {
        let mut refiner = Self::new(lattice, rules);
        for (level, first, bits) in subdivided {
            let beyond = level >= Grid::MAX_LEVELS - 1 || is_far(first);
            if beyond || (first.q | first.r) & 7 != 0 {
                return Err(RestoreError::OutOfRange { level, first });
            }
            let (id, _) = refiner.grid.tile_of(Address::new(level, first));
            refiner.grid.tiles_mut().require_margin(level, id, u64::MAX);
            refiner.grid.tiles_mut().get_mut(level, id).subdivided = bits;
            refiner.begin_in(level, id);
        }
        refiner.restore_sites(sites)?;
        // The queues are as long as there are levels.
        refiner.waiting.resize_with(refiner.grid.tiles().levels(), Default::default);
        if let Some((at, rule)) = refiner.violation() {
            return Err(RestoreError::Rule { at, rule });
        }
        refiner.begin_changes();
        Ok(refiner)
    }

    fn restore_sites(&mut self, sites: &[(DVec2, Option<u8>)]) -> Result<(), RestoreError> {
        let lattice = *self.grid.lattice();
        let points: Vec<DVec2> = sites.iter().map(|s| s.0).collect();
        self.sites.add(&lattice, &points);
        for (i, &(point, level)) in sites.iter().enumerate() {
            let Some(level) = level else { continue };
            let site = Site::new(&lattice, level.min(Grid::MAX_LEVELS - 1), point);
            let at = Address::new(site.level, site.at.hex);
            if level >= Grid::MAX_LEVELS || is_far(at.hex) || !self.grid.exists(at) {
                return Err(RestoreError::NoLeaf { site: i, level });
            }
            let (tile, bit) = self.grid.tile_of(at);
            self.grid.tiles_mut().require_margin(level, tile, 1 << bit);
            let planes = self.grid.tiles_mut().get_mut(level, tile);
            if (planes.subdivided | planes.marks[0] | planes.marks[1]) >> bit & 1 == 1 {
                return Err(RestoreError::NoLeaf { site: i, level });
            }
            planes.marks[site.plane(&lattice)] |= 1 << bit;
            self.begin_in(level, tile);
            let id = self.sites.ids()[i];
            *self.sites.get_mut(id) = site;
            self.sites.enter(id, tile);
        }
        Ok(())
    }

    /// Finds out what each level needs of the next coarser one, and the first
    /// hexagon that is needed and not subdivided.
    fn gather_needed(&mut self) -> Option<Address> {
        let mut lacking = None;
        for level in (1..self.grid.tiles().levels() as u8).rev() {
            for id in (0..self.grid.tiles().level(level).len()).map(TileId::new) {
                let view = View::of(&self.grid, level, id);
                if view.is_empty() {
                    continue;
                }
                let demand = self.rules.must_exist(&Situation::of(view)).dilated().even_centre();
                let (parent, quadrant) = self.grid.tiles().parent(level, id).expect("above level 0");
                let bits = super::in_quadrant(demand, quadrant);
                let tile = self.grid.tiles_mut().get_mut(level - 1, parent);
                tile.needed |= bits;
                let bit = ones(bits & !tile.subdivided).next();
                let first = self.grid.tiles().first(level - 1, parent);
                lacking = lacking.or(bit.map(|bit| Address::new(level - 1, first + hex_of(bit))));
            }
        }
        lacking
    }
}

/// Steps from the origin to the hexagons of any level, at most: addresses stay
/// where [`Lattice::locate`] is exact.
const FARTHEST: u64 = 1 << 50;

pub(super) fn is_far(hex: Hex) -> bool {
    hex.q.unsigned_abs().max(hex.r.unsigned_abs()) > FARTHEST
}

/// The tiles within reach of a change.
fn reached(margin: Margin) -> impl Iterator<Item = TileId> {
    let all: Vec<(TileId, bool)> = margin.iter().collect();
    all.into_iter().filter(|(_, reached)| *reached).map(|(tile, _)| tile)
}

/// The bit of a hexagon in its tile.
fn bit_of(hex: Hex) -> u32 {
    (8 * (hex.r & 7) + (hex.q & 7)) as u32
}
