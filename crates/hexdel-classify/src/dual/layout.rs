//! Which vertices and how many triangles each tile has.

use super::DualError;
use super::brood::Brood;
use super::domain::Domain;
use super::star;
use crate::class::Classes;
use hexdel_geom::VertexId;
use hexdel_geom::par::prelude::*;
use hexdel_grid::{Direction, Grid, Hex, TileId};

/// What a tile is made of, as far as the dual asks, and the part of the mesh
/// that it owns.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Block {
    /// The full hexagons of the mesh.
    pub(super) exists: u64,
    /// The places of the tile that are vertices: leaves, and semi-hexagons on
    /// which a `MovedCenter3` inserts a point.
    pub(super) vertices: u64,
    /// The leaves that a template moves; may hold `three` without a vertex.
    pub(super) moved: u64,
    /// The `MovedCenter3`: stars replace the lattice triangles at them. None
    /// without templates.
    pub(super) three: u64,
    /// The places that have an id, whether they are vertices or not: exactly
    /// the vertices in a mesh made at once, all in one that is kept.
    pub(super) numbered: u64,
    /// Id of the lowest of them; the others follow in bit order.
    pub(super) first_vertex: u32,
    /// Triangles owned: lattice triangles by their lowest corner, stars by
    /// their centre.
    pub(super) triangles: u32,
}

impl Block {
    /// The vertex at bit `bit`.
    #[inline]
    pub(super) fn vertex(&self, bit: u32) -> VertexId {
        debug_assert!(self.vertices >> bit & 1 == 1, "no vertex at bit {bit}");
        let before = (self.numbered & ((1 << bit) - 1)).count_ones();
        VertexId::new((self.first_vertex + before) as usize)
    }

    /// How many vertices of the tile come before the one at bit `bit`.
    #[inline]
    pub(super) fn rank(&self, bit: u32) -> usize {
        (self.vertices & ((1 << bit) - 1)).count_ones() as usize
    }
}

/// Where each vertex and triangle of the mesh will stand.
#[derive(Debug)]
pub struct Layout<'a> {
    pub(super) grid: &'a Grid,
    /// A block per tile, by level and tile id; no blocks below the base level.
    blocks: Vec<Vec<Block>>,
    /// Sum over all blocks.
    vertex_count: u64,
    /// Sum over all blocks.
    triangle_count: u64,
}

impl<'a> Layout<'a> {
    /// Counts the vertices and triangles of all tiles, and makes the tiles that
    /// hold a leaf but did not exist.
    pub(super) fn new(grid: &'a mut Grid, domain: Domain, templates: bool) -> Result<Self, DualError> {
        let blocks = surveyed(grid, domain, templates);
        let mut layout = Self { grid, blocks, vertex_count: 0, triangle_count: 0 };
        for level in 0..layout.blocks.len() {
            let tiles = layout.blocks[level].len();
            let walked = |i| {
                let walks = layout.walks(level as u8, TileId::new(i));
                walks.iter().map(|w| w.whole.count_ones() + 2 * w.split.count_ones()).sum()
            };
            let walked: Vec<u32> = (0..tiles).into_par_iter().map(walked).collect();
            for (block, walked) in layout.blocks[level].iter_mut().zip(walked) {
                block.triangles += walked;
                block.first_vertex = layout.vertex_count as u32;
                block.numbered = block.vertices;
                layout.vertex_count += u64::from(block.vertices.count_ones());
                layout.triangle_count += u64::from(block.triangles);
            }
        }
        if layout.vertex_count > u64::from(u32::MAX) {
            return Err(DualError::TooManyVertices { count: layout.vertex_count });
        }
        Ok(layout)
    }

    /// The layout of blocks whose ids are given already.
    pub(super) fn of(grid: &'a Grid, blocks: Vec<Vec<Block>>) -> Self {
        Self { grid, blocks, vertex_count: 0, triangle_count: 0 }
    }

    pub(super) fn into_blocks(self) -> Vec<Vec<Block>> {
        self.blocks
    }

    /// How many triangles the mesh has.
    pub fn triangles(&self) -> u64 {
        self.triangle_count
    }

    /// How many vertices the mesh has.
    pub fn vertices(&self) -> u64 {
        self.vertex_count
    }

    /// The blocks of each level, by tile id: in the order of their vertices.
    pub(super) fn levels(&self) -> impl Iterator<Item = (u8, &[Block])> {
        (0..).zip(&self.blocks).map(|(level, blocks)| (level, blocks.as_slice()))
    }

    #[inline]
    pub(super) fn block(&self, level: u8, id: TileId) -> &Block {
        &self.blocks[usize::from(level)][id.index()]
    }

    /// The same, for a tile that may lie below the finest level of the mesh.
    pub(super) fn block_if_any(&self, level: u8, id: TileId) -> Option<&Block> {
        self.blocks.get(usize::from(level))?.get(id.index())
    }

    /// The lattice triangles that a tile owns, pointing up and down.
    pub(super) fn walks(&self, level: u8, id: TileId) -> [Walk; 2] {
        let tiles = self.grid.tiles();
        let own = self.block(level, id);
        if own.exists == 0 {
            return Walk::NONE;
        }
        // The tile itself, then east, north, north-west and west of it.
        let [mut exists, mut subdivided, mut three] = [[0; 5]; 3];
        for (i, (column, row)) in [(0, 0), (1, 0), (0, 1), (-1, 1), (-1, 0)].into_iter().enumerate() {
            if let Some(there) = tiles.beside(level, id, column, row) {
                let block = self.block(level, there);
                exists[i] = block.exists;
                three[i] = block.three;
                subdivided[i] = tiles.get(level, there).subdivided;
            }
        }
        let (exists, subdivided, three) = (Corners::of(exists), Corners::of(subdivided), Corners::of(three));
        [0, 1].map(|i| {
            let pick = |c: &Corners| (c.0[0], c.0[1 + i], c.0[2 + i]);
            let ((e, f, g), (a, b, c), (x, y, z)) = (pick(&exists), pick(&subdivided), pick(&three));
            let all = e & f & g & !(x | y | z);
            let two = a & b | b & c | c & a;
            Walk { down: i == 1, whole: all & !two, split: all & two & !(a & b & c) }
        })
    }
}

/// A plane of a tile, and the same one step off in directions 0, 1 and 2.
struct Corners([u64; 4]);

impl Corners {
    /// From the planes of the tile itself, east, north, north-west and west.
    #[inline]
    fn of([own, east, north, north_west, west]: [u64; 5]) -> Self {
        const FIRST_COLUMN: u64 = 0x0101_0101_0101_0101;
        let westward = |own: u64, west: u64| own << 1 & !FIRST_COLUMN | west >> 7 & FIRST_COLUMN;
        let d0 = own >> 1 & !(FIRST_COLUMN << 7) | (east & FIRST_COLUMN) << 7;
        let d1 = own >> 8 | north << 56;
        let d2 = westward(own, west) >> 8 | westward(north, north_west) << 56;
        Self([own, d0, d1, d2])
    }
}

/// Lattice triangles by their corner `h`: `(h, h + d0, h + d1)` pointing up,
/// `(h, h + d1, h + d2)` pointing down.
#[derive(Clone, Copy)]
pub(super) struct Walk {
    pub(super) down: bool,
    /// At most one corner subdivided: one triangle each.
    pub(super) whole: u64,
    /// Two corners subdivided: two triangles each.
    pub(super) split: u64,
}

impl Walk {
    const NONE: [Self; 2] =
        [Self { down: false, whole: 0, split: 0 }, Self { down: true, whole: 0, split: 0 }];

    pub(super) fn second(&self) -> Direction {
        Direction::new(usize::from(self.down))
    }

    pub(super) fn third(&self) -> Direction {
        Direction::new(1 + usize::from(self.down))
    }
}

/// The blocks of all tiles, lattice triangles not counted yet.
///
/// Goes down the levels: what exists in a tile follows from the one above it.
pub(super) fn surveyed(grid: &mut Grid, domain: Domain, templates: bool) -> Vec<Vec<Block>> {
    let mut blocks = vec![Vec::new(); usize::from(domain.base_level)];
    let mut level = domain.base_level;
    let mut current = patch(grid, domain);
    while !current.is_empty() {
        let mut finer = Vec::new();
        for (chunk, blocks) in (0..).zip(current.chunks_mut(SURVEYED_AT_ONCE)) {
            let survey = |(i, block): (usize, &mut Block)| {
                let id = TileId::new(SURVEYED_AT_ONCE * chunk + i);
                survey(grid, level, id, block, templates).map(|brood| (id, brood))
            };
            let broods: Vec<_> = blocks.par_iter_mut().enumerate().filter_map(survey).collect();
            for (id, brood) in broods {
                bring_forth(grid, (level, id), &brood, &mut finer);
            }
        }
        blocks.push(std::mem::replace(&mut current, finer));
        level += 1;
    }
    blocks
}

/// Tiles surveyed before what they bring forth is entered one level finer: so
/// few that it stays in the cache.
const SURVEYED_AT_ONCE: usize = 1 << 12;

/// Enters what a tile brings forth into the blocks one level finer.
fn bring_forth(grid: &mut Grid, (level, id): (u8, TileId), brood: &Brood, finer: &mut Vec<Block>) {
    for quadrant in 0..4 {
        let (exists, vertices) = (brood.exists[quadrant], brood.inserted[quadrant]);
        if exists | vertices != 0 {
            let child = grid.tiles_mut().require_child(level, id, quadrant).index();
            if child >= finer.len() {
                let tiles = grid.tiles().level(level + 1).len();
                finer.resize(tiles, Block::default());
            }
            finer[child] = Block { exists, vertices, ..Block::default() };
        }
    }
}

/// The tiles of the base level that the domain touches, made if need be.
fn patch(grid: &mut Grid, domain: Domain) -> Vec<Block> {
    let radius = i64::from(domain.radius);
    for q in (-radius..=radius + 7).step_by(8) {
        for r in (-radius..=radius + 7).step_by(8) {
            grid.tiles_mut().require(domain.base_level, Hex::new(q, r));
        }
    }
    let tiles = grid.tiles().placed(domain.base_level);
    tiles.map(|(first, _)| Block { exists: domain.window(first).centre(), ..Block::default() }).collect()
}

/// Completes a tile's block, of which `exists` and the inserted vertices are
/// known, and returns what exists one level finer.
pub(super) fn survey(
    grid: &Grid,
    level: u8,
    id: TileId,
    block: &mut Block,
    templates: bool,
) -> Option<Brood> {
    let tiles = grid.tiles();
    block.vertices |= block.exists & !tiles.get(level, id).subdivided;
    let subdivided = tiles.window(level, id, |t| t.subdivided);
    if subdivided.is_empty() {
        return None;
    }
    let mut brood = Brood::of(subdivided);
    if templates {
        let classes = Classes::of(subdivided);
        block.moved = (classes.finned() | classes.moved4()).centre() & block.exists;
        if !classes.moved3.is_empty() {
            let (before, after) = classes.in_run();
            let single = classes.moved3.without(before | after);
            block.three = classes.moved3.centre() & block.exists;
            block.vertices &= !single.centre();
            block.triangles = star::count(&classes, (before, after), block.exists);
            brood.insert(&classes);
        }
    }
    Some(brood)
}
