//! What a mesh of templates consists of, tile by tile.
//!
//! The grid says what there is; kept here is what it said last, with serial
//! numbers, so that what changed can be told, and the few vertices that rounding
//! makes lie a little beside where the templates put them.

use hexdel_classify::{KeptDual, Touched};
use hexdel_geom::{DVec2, TriMesh, VertexId};
use hexdel_grid::window::ones;
use hexdel_grid::{Hex, TileId};
use hexdel_optimize::live::Delta;
use hexdel_refine::Refiner;
use std::collections::BTreeMap;

/// A triangle by the names of its corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Owned {
    pub(super) serial: u64,
    pub(super) corners: [u32; 3],
}

/// A tile's part of the mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Cell {
    /// The places that are vertices.
    pub(super) places: u64,
    /// Where the templates put them, and their serial numbers; in bit order.
    pub(super) at: Vec<DVec2>,
    pub(super) serials: Vec<u64>,
    pub(super) triangles: Vec<Owned>,
}

impl Cell {
    fn rank(&self, bit: u32) -> Option<usize> {
        let there = self.places >> bit & 1 == 1;
        there.then(|| (self.places & ((1 << bit) - 1)).count_ones() as usize)
    }
}

/// The serial numbers given out last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Serials {
    pub(super) vertex: u64,
    pub(super) triangle: u64,
}

/// All tiles' parts, by page.
#[derive(Clone, Debug, Default)]
pub(super) struct Cells {
    pub(super) by_page: Vec<Cell>,
    /// Vertices that do not lie where the templates put them.
    pub(super) moved: BTreeMap<u32, DVec2>,
    /// Numbers of vertices and triangles.
    pub(super) counts: [usize; 2],
    pub(super) serials: Serials,
}

/// What a change replaced.
#[derive(Clone, Debug, Default)]
pub(super) struct Replaced {
    cells: BTreeMap<u32, Cell>,
    moved: BTreeMap<u32, Option<DVec2>>,
}

/// What is new.
#[derive(Clone, Debug, Default)]
pub(super) struct Fresh {
    /// Corners of new triangles.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Vertices that were there and lie elsewhere now.
    pub(super) moved: Vec<u32>,
}

impl Cells {
    /// An empty mesh whose serial numbers begin after `serials`.
    pub(super) fn after(serials: Serials) -> Self {
        Self { serials, ..Self::default() }
    }

    pub(super) fn cell(&self, page: u32) -> Option<&Cell> {
        self.by_page.get(page as usize)
    }

    /// Where the vertex of that name is, and its serial number.
    pub(super) fn vertex(&self, name: u32) -> Option<(DVec2, u64)> {
        let cell = self.cell(name / KeptDual::PAGE)?;
        let rank = cell.rank(name % KeptDual::PAGE)?;
        Some((self.moved.get(&name).copied().unwrap_or(cell.at[rank]), cell.serials[rank]))
    }

    /// Moves a vertex beside where the templates put it.
    pub(super) fn displace(&mut self, name: u32, to: DVec2, replaced: &mut Replaced) {
        let old = self.moved.insert(name, to);
        replaced.moved.entry(name).or_insert(old);
    }

    /// Asks the grid again what touched tiles consist of.
    pub(super) fn renew(
        &mut self,
        refiner: &Refiner,
        dual: &mut KeptDual,
        touched: &Touched,
        replaced: &mut Replaced,
    ) -> Fresh {
        let mut fresh = Fresh::default();
        self.by_page.resize_with(dual.pages(), Cell::default);
        for at in in_order(refiner, &touched.vertices) {
            self.renew_vertices(refiner, dual, at, replaced, &mut fresh);
        }
        for at in in_order(refiner, &touched.triangles) {
            self.renew_triangles(refiner, dual, at, replaced, &mut fresh);
        }
        fresh
    }

    fn renew_vertices(
        &mut self,
        refiner: &Refiner,
        dual: &mut KeptDual,
        tile: (u8, TileId),
        replaced: &mut Replaced,
        fresh: &mut Fresh,
    ) {
        let Some(page) = dual.page(tile.0, tile.1) else { return };
        let places = dual.places(tile.0, tile.1);
        let at = dual.positions(refiner.grid(), tile, |level, id| refiner.occupants_of(level, id));
        let old = &self.by_page[page as usize];
        if old.places == places && old.at == at {
            return;
        }
        replaced.cells.entry(page).or_insert_with(|| old.clone());
        let mut serials = Vec::with_capacity(at.len());
        for (bit, at) in ones(places).zip(&at) {
            let name = page * KeptDual::PAGE + bit;
            let before = old.rank(bit).map(|rank| (old.at[rank], old.serials[rank]));
            serials.push(before.map_or_else(|| next(&mut self.serials.vertex), |b| b.1));
            if before.is_some_and(|b| b.0 != *at) {
                fresh.moved.push(name);
            }
            if before.is_none_or(|b| b.0 != *at) {
                forget(&mut self.moved, name, replaced);
            }
        }
        for bit in ones(old.places & !places) {
            forget(&mut self.moved, page * KeptDual::PAGE + bit, replaced);
        }
        self.counts[0] = self.counts[0] + at.len() - old.at.len();
        let cell = &mut self.by_page[page as usize];
        (cell.places, cell.at, cell.serials) = (places, at, serials);
    }

    fn renew_triangles(
        &mut self,
        refiner: &Refiner,
        dual: &mut KeptDual,
        tile: (u8, TileId),
        replaced: &mut Replaced,
        fresh: &mut Fresh,
    ) {
        let Some(page) = dual.page(tile.0, tile.1) else { return };
        let new = dual.triangles(refiner.grid(), tile);
        let old = &self.by_page[page as usize];
        if old.triangles.iter().map(|t| t.corners).eq(new.iter().copied()) {
            return;
        }
        replaced.cells.entry(page).or_insert_with(|| old.clone());
        let mut known: Vec<([u32; 3], u64)> = old.triangles.iter().map(|t| (t.corners, t.serial)).collect();
        known.sort_unstable();
        let renewed = new.into_iter().map(|corners| {
            let found = known.binary_search_by_key(&corners, |k| k.0);
            let serial = found.map_or_else(
                |_| {
                    fresh.triangles.push(corners);
                    next(&mut self.serials.triangle)
                },
                |i| known[i].1,
            );
            Owned { serial, corners }
        });
        let renewed: Vec<Owned> = renewed.collect();
        self.counts[1] = self.counts[1] + renewed.len() - old.triangles.len();
        self.by_page[page as usize].triangles = renewed;
    }

    /// What is new since something was replaced.
    pub(super) fn fresh_since(&self, replaced: &Replaced) -> Fresh {
        let mut fresh = Fresh::default();
        for (&page, old) in &replaced.cells {
            let new = &self.by_page[page as usize];
            let mut known: Vec<u64> = old.triangles.iter().map(|t| t.serial).collect();
            known.sort_unstable();
            let is_new = |t: &&Owned| known.binary_search(&t.serial).is_err();
            fresh.triangles.extend(new.triangles.iter().filter(is_new).map(|t| t.corners));
            for bit in ones(old.places & new.places) {
                if let (Some(was), Some(is)) = (old.rank(bit), new.rank(bit))
                    && old.serials[was] == new.serials[is]
                    && old.at[was] != new.at[is]
                {
                    fresh.moved.push(page * KeptDual::PAGE + bit);
                }
            }
        }
        fresh
    }

    /// Puts back what a change replaced, and returns what it had put there.
    pub(super) fn put_back(&mut self, replaced: Replaced) -> Replaced {
        let mut undone = Replaced::default();
        for (page, cell) in replaced.cells {
            let there = &mut self.by_page[page as usize];
            self.counts[0] = self.counts[0] + cell.at.len() - there.at.len();
            self.counts[1] = self.counts[1] + cell.triangles.len() - there.triangles.len();
            undone.cells.insert(page, std::mem::replace(there, cell));
        }
        for (name, at) in replaced.moved {
            let there = match at {
                Some(at) => self.moved.insert(name, at),
                None => self.moved.remove(&name),
            };
            undone.moved.insert(name, there);
        }
        undone
    }

    /// What is different from before a change.
    pub(super) fn delta(&self, replaced: &Replaced) -> Delta {
        let mut delta = Delta::default();
        let old_at = |name: u32, at: DVec2| match replaced.moved.get(&name) {
            Some(was) => was.unwrap_or(at),
            None => self.moved.get(&name).copied().unwrap_or(at),
        };
        for (&page, old) in &replaced.cells {
            let new = &self.by_page[page as usize];
            for bit in ones(old.places | new.places) {
                let name = page * KeptDual::PAGE + bit;
                let was = old.rank(bit).map(|rank| (old.serials[rank], old_at(name, old.at[rank])));
                let is = self.vertex(name).map(|(at, serial)| (serial, at));
                tell(&mut delta, was, is);
            }
            tell_triangles(&mut delta, self, old, new);
        }
        for &name in replaced.moved.keys() {
            let page = name / KeptDual::PAGE;
            if !replaced.cells.contains_key(&page)
                && let Some((at, serial)) = self.vertex(name)
            {
                let cell = &self.by_page[page as usize];
                let was = cell.rank(name % KeptDual::PAGE).map(|rank| old_at(name, cell.at[rank]));
                tell(&mut delta, was.map(|was| (serial, was)), Some((serial, at)));
            }
        }
        in_order_of_serials(&mut delta);
        delta
    }

    /// What is different from another mesh.
    pub(super) fn delta_from(&self, other: &Self) -> Delta {
        let mut delta = Delta::default();
        for old in &other.by_page {
            delta.vertices_removed.extend(&old.serials);
            delta.triangles_removed.extend(old.triangles.iter().map(|t| t.serial));
        }
        for (page, new) in (0_u32..).zip(&self.by_page) {
            for bit in ones(new.places) {
                let vertex = self.vertex(page * KeptDual::PAGE + bit);
                tell(&mut delta, None, vertex.map(|(at, serial)| (serial, at)));
            }
            tell_triangles(&mut delta, self, &Cell::default(), new);
        }
        in_order_of_serials(&mut delta);
        delta
    }

    /// Pages by level and place of their tiles.
    pub(super) fn pages_in_order(&self, refiner: &Refiner, dual: &KeptDual) -> Vec<u32> {
        let mut pages: Vec<u32> = (1..self.by_page.len() as u32).collect();
        pages.sort_unstable_by_key(|&page| place(refiner, dual.tile_of(page)));
        pages
    }

    /// The whole mesh in the order of pages, with the names of its vertices and
    /// the serial numbers of its triangles.
    pub(super) fn whole(&self, pages: &[u32]) -> (TriMesh, Vec<u32>, Vec<u64>) {
        let (mut mesh, mut names, mut serials) = (TriMesh::default(), Vec::new(), Vec::new());
        let mut first = vec![0; self.by_page.len()];
        for &page in pages {
            let cell = &self.by_page[page as usize];
            first[page as usize] = names.len();
            for (bit, &at) in ones(cell.places).zip(&cell.at) {
                let name = page * KeptDual::PAGE + bit;
                names.push(name);
                mesh.vertices.push(self.moved.get(&name).copied().unwrap_or(at));
            }
        }
        let index = |name: u32| {
            let page = (name / KeptDual::PAGE) as usize;
            VertexId::new(
                first[page] + self.by_page[page].rank(name % KeptDual::PAGE).unwrap_or(usize::from(u16::MAX)),
            )
        };
        for &page in pages {
            for t in &self.by_page[page as usize].triangles {
                mesh.triangles.push(t.corners.map(index));
                serials.push(t.serial);
            }
        }
        (mesh, names, serials)
    }
}

/// Tiles by level and place: their ids depend on what was there before.
pub(super) fn in_order<'a>(
    refiner: &Refiner,
    tiles: impl IntoIterator<Item = &'a (u8, TileId)>,
) -> Vec<(u8, TileId)> {
    let mut tiles: Vec<(u8, TileId)> = tiles.into_iter().copied().collect();
    tiles.sort_unstable_by_key(|&tile| place(refiner, tile));
    tiles
}

/// Level and place of a tile.
pub(super) fn place(refiner: &Refiner, (level, id): (u8, TileId)) -> (u8, Hex) {
    (level, refiner.grid().tiles().first(level, id))
}

fn forget(moved: &mut BTreeMap<u32, DVec2>, name: u32, replaced: &mut Replaced) {
    if let Some(old) = moved.remove(&name) {
        replaced.moved.entry(name).or_insert(Some(old));
    }
}

fn next(serial: &mut u64) -> u64 {
    *serial += 1;
    *serial
}

fn tell(delta: &mut Delta, was: Option<(u64, DVec2)>, is: Option<(u64, DVec2)>) {
    match (was, is) {
        (Some(was), Some(is)) if was.0 == is.0 => {
            if was.1 != is.1 {
                delta.vertices_moved.push(is);
            }
        }
        _ => {
            delta.vertices_removed.extend(was.map(|was| was.0));
            delta.vertices_added.extend(is);
        }
    }
}

fn tell_triangles(delta: &mut Delta, cells: &Cells, old: &Cell, new: &Cell) {
    let serials = |cell: &Cell| {
        let mut all: Vec<u64> = cell.triangles.iter().map(|t| t.serial).collect();
        all.sort_unstable();
        all
    };
    let (before, after) = (serials(old), serials(new));
    delta.triangles_removed.extend(before.iter().filter(|s| after.binary_search(s).is_err()));
    for t in new.triangles.iter().filter(|t| before.binary_search(&t.serial).is_err()) {
        let corners = t.corners.map(|name| cells.vertex(name).map_or(0, |v| v.1));
        delta.triangles_added.push((t.serial, corners));
    }
}

fn in_order_of_serials(delta: &mut Delta) {
    delta.vertices_removed.sort_unstable();
    delta.triangles_removed.sort_unstable();
    delta.vertices_added.sort_by_key(|v| v.0);
    delta.vertices_moved.sort_by_key(|v| v.0);
    delta.triangles_added.sort_unstable();
}
