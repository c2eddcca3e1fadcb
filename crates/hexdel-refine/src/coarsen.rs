//! As fine as necessary, as coarse as possible (paper, section 5.3).
//!
//! The paper looks for places where 37 hexagons can be merged to the 7 of a
//! *blossom*. Here a level that has been closed is looked over before its
//! demands go to the next coarser one: a hexagon that no finer level needs is
//! merged again, alone or with its neighbours, wherever every rule still holds
//! afterwards. A blossom is what is left when seven such hexagons lie together.
//!
//! ```text
//!    *  *  *  *            *  *  *  *        * subdivided
//!   *  s  s  *  *         *  3  3  *  *      s spare: nobody needs them
//!  *  s  s  s  *  *  ->  *  3  4  3  *  *    3, 4 the blossom's classes
//!   *  s  s  *  *         *  3  3  *  *
//!    *  *  *  *            *  *  *  *
//! ```
//!
//! Tiles are looked over in nine colours, so that two of one colour never see
//! what the other changes: the result does not depend on threads.

use crate::rule::{RuleSet, Situation};
use hexdel_classify::View;
use hexdel_classify::class::{irregular, is_regular};
use hexdel_geom::par::prelude::*;
use hexdel_grid::grid::hex_of;
use hexdel_grid::window::ones;
use hexdel_grid::{Grid, Hex, TileId, Window};
use std::sync::OnceLock;

/// Merges what no finer level needs in the given tiles of a closed level. Returns
/// the tiles that changed and what was subdivided in them before; a tile that
/// changed several times comes as often, in order.
pub(crate) fn coarsen(grid: &mut Grid, level: u8, tiles: &[TileId], rules: &RuleSet) -> Vec<(TileId, u64)> {
    let mut colours: [Vec<TileId>; 9] = Default::default();
    for &id in tiles {
        let tile = grid.tiles().get(level, id);
        if tile.subdivided & !tile.needed != 0 {
            colours[colour(grid.tiles().first(level, id))].push(id);
        }
    }
    let mut changed = Vec::new();
    for tiles in colours {
        let merged: Vec<_> =
            tiles.into_par_iter().map(|id| Tried::new(grid, level, id).coarsened(rules)).collect();
        for (id, subdivided) in merged.into_iter().flatten() {
            let tile = grid.tiles_mut().get_mut(level, id);
            changed.push((id, std::mem::replace(&mut tile.subdivided, subdivided)));
        }
    }
    changed
}

/// One of nine colours: tiles of the same colour are three apart. A tile's
/// merges reach one hexagon beyond it, and are judged by what lies within nine;
/// two tiles between are sixteen.
fn colour(first: Hex) -> usize {
    let third = |x: i64| (x >> 3).rem_euclid(3) as usize;
    3 * third(first.r) + third(first.q)
}

/// A tile on which merges are tried.
struct Tried<'a> {
    grid: &'a Grid,
    level: u8,
    id: TileId,
    /// The subdivided hexagons of the tile's window, as merged so far.
    subdivided: Window,
    /// Those that the next finer level needs.
    needed: Window,
    /// Whether all fins near the tile are known to be in a row.
    regular: Option<bool>,
    /// The occupied hexagons of both classes, once somebody asks.
    occupied: Option<[Window; 2]>,
    /// What lies around: read when a merge is more than unlikely.
    patch: Option<Patch>,
}

impl<'a> Tried<'a> {
    fn new(grid: &'a Grid, level: u8, id: TileId) -> Self {
        let [subdivided, needed] = grid.tiles().windows(level, id, |tile| [tile.subdivided, tile.needed]);
        Self { grid, level, id, subdivided, needed, regular: None, occupied: None, patch: None }
    }

    /// Tries to merge the spare hexagons of the tile, each first together with
    /// its spare neighbours, then alone. Returns the tiles that changed.
    fn coarsened(mut self, rules: &RuleSet) -> Vec<(TileId, u64)> {
        for at in ones(self.subdivided.without(self.needed).centre()).map(hex_of) {
            let spare = self.subdivided.without(self.needed);
            if spare.contains(at) {
                let alone = Window::from_iter([at]);
                let group = alone.dilated() & spare;
                // Mostly its own fins alone would already break a rule.
                let _ = is_regular(self.needed.ring_of(at)) && self.merge(group, rules)
                    || group != alone && is_regular(self.subdivided.ring_of(at)) && self.merge(alone, rules);
            }
        }
        self.patch.map_or_else(Vec::new, |patch| patch.changed(self.grid, self.level))
    }

    /// Merges hexagons if every rule still holds afterwards.
    fn merge(&mut self, group: Window, rules: &RuleSet) -> bool {
        let rest = self.subdivided.without(group);
        // The tile itself is the likeliest to object.
        if !self.is_regular_as(rest, group) || !self.rules_hold_as(rest, rules) {
            return false;
        }
        let patch = self.patch.get_or_insert_with(|| Patch::of(self.grid, self.level, self.id));
        let legal = patch.merge(group, rules);
        if legal {
            self.subdivided = rest;
        }
        legal
    }

    /// Whether no rule would ask for anything in the tile itself.
    fn rules_hold_as(&mut self, rest: Window, rules: &RuleSet) -> bool {
        let [occupied1, occupied2] = *self.occupied.get_or_insert_with(|| {
            let view = View::of(self.grid, self.level, self.id);
            [view.occupied1, view.occupied2]
        });
        let view = View { subdivided: rest, occupied1, occupied2 };
        view.is_empty() || rules.hold(&Situation::of(view))
    }

    /// Whether all fins around the tile would be in a row without a group: the
    /// cheap half of the question, which most tries fail. Asked of the group
    /// first, then of those that lose fins.
    fn is_regular_as(&mut self, rest: Window, group: Window) -> bool {
        let is_regular_at = |at| is_regular(rest.ring_of(at));
        let all_regular = |set: Window| (irregular(set) & Window::with_margin(2)).is_empty();
        group.iter().all(is_regular_at)
            && group.dilated().without(self.subdivided).iter().all(is_regular_at)
            && (*self.regular.get_or_insert_with(|| all_regular(self.subdivided)) || all_regular(rest))
    }
}

/// Five by five tiles.
struct Patch {
    /// The tiles, row by row; `None` where there is none.
    ids: [Option<TileId>; 25],
    /// Subdivided hexagons of each tile.
    subdivided: [u64; 25],
    /// Occupied hexagons of both classes.
    marks: [[u64; 25]; 2],
}

impl Patch {
    fn of(grid: &Grid, level: u8, centre: TileId) -> Self {
        let tiles = grid.tiles();
        let mut patch = Self { ids: [None; 25], subdivided: [0; 25], marks: [[0; 25]; 2] };
        for row in -1..=1 {
            for column in -1..=1 {
                let Some(inner) = tiles.beside(level, centre, column, row) else {
                    continue;
                };
                for i in 0..9 {
                    let (c, r) = (i % 3 - 1, i / 3 - 1);
                    patch.ids[index(column + c, row + r)] = tiles.beside(level, inner, c, r);
                }
            }
        }
        for i in 0..25 {
            if let Some(id) = patch.ids[i] {
                let tile = tiles.get(level, id);
                patch.subdivided[i] = tile.subdivided;
                patch.marks[0][i] = tile.marks[0];
                patch.marks[1][i] = tile.marks[1];
            }
        }
        patch
    }

    /// The tiles that differ from what the grid holds, and what is subdivided in
    /// them.
    fn changed(&self, grid: &Grid, level: u8) -> Vec<(TileId, u64)> {
        let all = self.ids.into_iter().zip(self.subdivided);
        all.filter_map(|(id, subdivided)| Some((id?, subdivided)))
            .filter(|&(id, subdivided)| grid.tiles().get(level, id).subdivided != subdivided)
            .collect()
    }

    /// Merges hexagons if no rule asks for them in the tiles around the middle
    /// one.
    fn merge(&mut self, group: Window, rules: &RuleSet) -> bool {
        let before = self.subdivided;
        for at in group.iter() {
            let (i, bit) = place(at);
            self.subdivided[i] &= !(1 << bit);
        }
        let legal = self.rules_hold(group, rules);
        if !legal {
            self.subdivided = before;
        }
        legal
    }

    /// Whether no rule asks for anything where it can see the group, but for the
    /// tile in the middle.
    fn rules_hold(&self, group: Window, rules: &RuleSet) -> bool {
        let reached = |i: &usize| !(group & seen_from()[*i]).is_empty();
        [1, 3, 5, 7, 0, 2, 6, 8].into_iter().filter(reached).all(|i| {
            let (column, row) = (i as i64 % 3 - 1, i as i64 / 3 - 1);
            let view = View {
                subdivided: Self::window(&self.subdivided, column, row),
                occupied1: Self::window(&self.marks[0], column, row),
                occupied2: Self::window(&self.marks[1], column, row),
            };
            view.is_empty() || rules.hold(&Situation::of(view))
        })
    }

    /// The window of one of the nine inner tiles.
    fn window(plane: &[u64; 25], column: i64, row: i64) -> Window {
        let tiles = |r: i64| [-1, 0, 1].map(|c| plane[index(column + c, row + r)]);
        Window::gather(&[tiles(-1), tiles(0), tiles(1)])
    }
}

/// For each of the nine inner tiles the hexagons that a rule may see from it. A
/// group reaches one hexagon beyond the tile in the middle, a rule four: never
/// more than a neighbouring tile.
fn seen_from() -> &'static [Window; 9] {
    static SEEN: OnceLock<[Window; 9]> = OnceLock::new();
    SEEN.get_or_init(|| {
        std::array::from_fn(|i| {
            let first = Hex::new(8 * (i as i64 % 3 - 1), 8 * (i as i64 / 3 - 1));
            let tile = || (0..64).map(|bit| first + hex_of(bit));
            let near = |at: &Hex| tile().any(|h| h.distance(*at) <= Window::MARGIN as u64);
            Window::with_margin(1).iter().filter(near).collect()
        })
    })
}

/// Where a tile `column` and `row` tiles from the middle is kept.
fn index(column: i64, row: i64) -> usize {
    (5 * (row + 2) + column + 2) as usize
}

/// The tile and bit of a hexagon, relative to the first of the middle tile.
fn place(at: Hex) -> (usize, i64) {
    (index(at.q >> 3, at.r >> 3), 8 * (at.r & 7) + (at.q & 7))
}
