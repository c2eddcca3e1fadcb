//! A dual mesh that is kept tile by tile while the grid changes.
//!
//! Names of vertices do not depend on what is elsewhere: each tile that holds
//! part of the mesh gets a *page* of 64 names, one for each of its places, and
//! keeps it. What a tile's places are, and which triangles it owns, is a
//! function of the sets around it, so after a change only the tiles that see it
//! are looked at again.

use super::layout::{Block, Layout, survey, surveyed};
use super::{Domain, Occupant, Relocation, triangles, vertices};
use hexdel_geom::DVec2;
use hexdel_grid::grid::hex_of;
use hexdel_grid::{Address, Grid, TileId};
use std::collections::BTreeSet;

/// A dual mesh with templates, tile by tile.
#[derive(Clone, Debug)]
pub struct KeptDual {
    domain: Domain,
    /// A block per tile, by level and tile id; no blocks below the base level.
    /// `first_vertex` is the first name of the tile's page; 0 for those that
    /// have none.
    blocks: Vec<Vec<Block>>,
    /// The tile of each page; the first page is no tile's.
    pages: Vec<(u8, TileId)>,
}

/// Tiles of which part of the mesh may have changed. In order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Touched {
    /// Those that may have other vertices, or vertices elsewhere.
    pub vertices: BTreeSet<(u8, TileId)>,
    /// Those that may own other triangles.
    pub triangles: BTreeSet<(u8, TileId)>,
}

impl KeptDual {
    /// Names of a page.
    pub const PAGE: u32 = 64;

    /// The mesh of a grid as it is. All tiles are touched.
    ///
    /// # Complexity
    ///
    /// Linear in the grid.
    pub fn new(grid: &mut Grid, domain: Domain) -> (Self, Touched) {
        let mut blocks = surveyed(grid, domain, true);
        for (level, blocks) in blocks.iter_mut().enumerate() {
            blocks.resize(grid.tiles().level(level as u8).len(), Block::default());
        }
        let mut kept = Self { domain, blocks, pages: vec![(0, TileId::new(0))] };
        let mut all = BTreeSet::new();
        for level in 0..kept.blocks.len() {
            for i in 0..kept.blocks[level].len() {
                let at = (level as u8, TileId::new(i));
                if kept.name(at) {
                    all.insert(at);
                }
            }
        }
        (kept, Touched { vertices: all.clone(), triangles: all })
    }

    /// What the mesh covers.
    pub fn domain(&self) -> Domain {
        self.domain
    }

    /// Gives a tile that holds part of the mesh its page; false if it holds
    /// none.
    fn name(&mut self, (level, id): (u8, TileId)) -> bool {
        let block = &mut self.blocks[usize::from(level)][id.index()];
        block.numbered = u64::MAX;
        if block.exists | block.vertices == 0 {
            return block.first_vertex != 0;
        }
        if block.first_vertex == 0 {
            block.first_vertex = Self::PAGE * self.pages.len() as u32;
            self.pages.push((level, id));
        }
        true
    }

    /// The page of a tile, if it holds part of the mesh or ever did.
    pub fn page(&self, level: u8, id: TileId) -> Option<u32> {
        let block = self.blocks.get(usize::from(level))?.get(id.index())?;
        Some(block.first_vertex / Self::PAGE).filter(|page| *page != 0)
    }

    /// The tile of a page.
    pub fn tile_of(&self, page: u32) -> (u8, TileId) {
        self.pages[page as usize]
    }

    /// One more than the last page.
    pub fn pages(&self) -> usize {
        self.pages.len()
    }

    /// The places of a tile that are vertices.
    pub fn places(&self, level: u8, id: TileId) -> u64 {
        self.blocks.get(usize::from(level)).and_then(|b| b.get(id.index())).map_or(0, |b| b.vertices)
    }

    /// The place that a name stands for.
    pub fn address(&self, grid: &Grid, name: u32) -> Address {
        let (level, id) = self.tile_of(name / Self::PAGE);
        Address::new(level, grid.tiles().first(level, id) + hex_of(name % Self::PAGE))
    }

    /// The name of a place whose tile has a page.
    pub fn name_of(&self, grid: &Grid, at: Address) -> Option<u32> {
        let (id, bit) = grid.tiles().find(at.level, at.hex)?;
        Some(self.page(at.level, id)? * Self::PAGE + bit)
    }

    /// Whether nothing that touches a hexagon of the tile in one of the ways that
    /// the rim must not be touched lies on the rim, or beyond.
    pub fn has_room(&self, grid: &Grid, level: u8, id: TileId) -> bool {
        level != self.domain.base_level || self.domain.holds(grid, id)
    }

    /// Takes note of hexagons that are subdivided or occupied otherwise than
    /// before, given tile by tile.
    ///
    /// # Complexity
    ///
    /// In proportion to the tiles within four hexagons of a change, and those
    /// one level finer.
    pub fn update(&mut self, grid: &mut Grid, changed: &[(u8, TileId, u64)]) -> Touched {
        let mut touched = Touched::default();
        let base = self.domain.base_level;
        let mut seen: Vec<BTreeSet<TileId>> = vec![BTreeSet::new(); grid.tiles().levels() + 1];
        for &(level, id, bits) in changed.iter().filter(|c| c.0 >= base) {
            let seen = &mut seen[usize::from(level)];
            let margin = grid.tiles_mut().require_margin(level, id, bits);
            seen.extend(margin.iter().filter(|(_, reached)| *reached).map(|(tile, _)| tile));
        }
        for level in base..seen.len() as u8 {
            let tiles = std::mem::take(&mut seen[usize::from(level)]);
            for id in tiles {
                self.fit(grid);
                touched.vertices.insert((level, id));
                touched.triangles.insert((level, id));
                for child in self.survey(grid, (level, id), &mut touched) {
                    seen[usize::from(level) + 1].insert(child);
                }
            }
        }
        self.fit(grid);
        touched.vertices.retain(|&at| self.name(at));
        touched.triangles.retain(|&at| self.name(at));
        touched
    }

    /// Makes as many blocks as there are tiles.
    fn fit(&mut self, grid: &Grid) {
        self.blocks.resize_with(grid.tiles().levels().max(self.blocks.len()), Vec::new);
        for (level, blocks) in self.blocks.iter_mut().enumerate() {
            let tiles = grid.tiles().level(level as u8).len();
            if blocks.len() < tiles && level >= usize::from(self.domain.base_level) {
                blocks.resize(tiles, Block::default());
            }
        }
    }

    /// Surveys a tile again. Returns the tiles one level finer in which other
    /// hexagons exist now than before, or other points are inserted.
    fn survey(&mut self, grid: &mut Grid, at: (u8, TileId), touched: &mut Touched) -> Vec<TileId> {
        let (level, id) = at;
        let old = self.blocks[usize::from(level)][id.index()];
        let exists = if level == self.domain.base_level {
            self.domain.window(grid.tiles().first(level, id)).centre()
        } else {
            old.exists
        };
        let mut block = Block {
            exists,
            vertices: old.vertices & !old.exists,
            first_vertex: old.first_vertex,
            numbered: u64::MAX,
            ..Block::default()
        };
        let brood = survey(grid, level, id, &mut block, true).unwrap_or_default();
        if (old.vertices, old.three) != (block.vertices, block.three) {
            touched.triangles.extend(grid.tiles().around(level, id).map(|tile| (level, tile)));
        }
        self.blocks[usize::from(level)][id.index()] = block;
        let mut changed = Vec::new();
        for quadrant in 0..4 {
            let (exists, inserted) = (brood.exists[quadrant], brood.inserted[quadrant]);
            if exists | inserted != 0 {
                grid.tiles_mut().require_child(level, id, quadrant);
                self.fit(grid);
            }
            let Some(child) = grid.tiles().child(level, id, quadrant) else { continue };
            let block = &mut self.blocks[usize::from(level) + 1][child.index()];
            if (block.exists, block.vertices & !block.exists) != (exists, inserted) {
                touched.triangles.extend(grid.tiles().around(level + 1, child).map(|tile| (level + 1, tile)));
                (block.exists, block.vertices) = (exists, inserted);
                changed.push(child);
            } else if inserted != 0 {
                touched.vertices.insert((level + 1, child));
            }
        }
        changed
    }

    /// Where the templates put the vertices of a tile, in the order of
    /// [`places`](Self::places). `occupants` tells the points in a tile.
    pub fn positions<I: Iterator<Item = Occupant>>(
        &mut self,
        grid: &Grid,
        (level, id): (u8, TileId),
        occupants: impl Fn(u8, TileId) -> I,
    ) -> Vec<DVec2> {
        self.with_layout(grid, |layout| {
            let block = layout.block(level, id);
            let mut places = vec![[0.0; 2]; block.vertices.count_ones() as usize];
            vertices::fill_tile(layout, level, id, &mut places);
            let tiles = grid.tiles();
            let occupied = |&tile: &TileId| tiles.get(level, tile).marks != [0; 2];
            for tile in tiles.around(level, id).filter(occupied) {
                for occupant in occupants(level, tile) {
                    for (vertex, to) in vertices::moved_by(layout, &occupant, Relocation::Full) {
                        let name = vertex.index() as u32;
                        if name / Self::PAGE == block.first_vertex / Self::PAGE {
                            places[block.rank(name % Self::PAGE)] = to.to_array();
                        }
                    }
                }
            }
            places.into_iter().map(DVec2::from_array).collect()
        })
    }

    /// The triangles that a tile owns, by the names of their corners,
    /// counter-clockwise.
    pub fn triangles(&mut self, grid: &Grid, (level, id): (u8, TileId)) -> Vec<[u32; 3]> {
        self.with_layout(grid, |layout| {
            let walks = layout.walks(level, id);
            let walked: u32 = walks.iter().map(|w| w.whole.count_ones() + 2 * w.split.count_ones()).sum();
            let count = layout.block(level, id).triangles + walked;
            let mut triangles = vec![[0; 3]; count as usize];
            triangles::fill_tile(layout, level, id, &mut triangles);
            triangles
        })
    }

    fn with_layout<T>(&mut self, grid: &Grid, f: impl FnOnce(&Layout) -> T) -> T {
        let layout = Layout::of(grid, std::mem::take(&mut self.blocks));
        let answer = f(&layout);
        self.blocks = layout.into_blocks();
        answer
    }
}
