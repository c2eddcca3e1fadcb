//! Which vertices and how many triangles each tile has.

use super::domain::{self, Domain};
use super::{DualError, star};
use crate::class::Classes;
use hexdel_geom::VertexId;
use hexdel_grid::{Direction, Grid, Hex, TileId, Window};
use rayon::prelude::*;

/// The part of the mesh that a tile owns.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Block {
    /// The places of the tile that are vertices: leaves, and semi-hexagons on
    /// which a `MovedCenter3` inserts a point.
    pub(super) vertices: u64,
    /// Id of the vertex at the lowest bit; the others follow in bit order.
    pub(super) first_vertex: u32,
    /// Triangles owned: lattice triangles by their lowest corner, stars by
    /// their centre.
    pub(super) triangles: u32,
}

/// What a tile and its margin are made of, as far as the dual asks.
pub(super) struct Sets {
    /// Full hexagons of the level; right within a margin of three.
    pub(super) exists: Window,
    /// The classes of the level, or `None` where nothing is subdivided.
    pub(super) classes: Option<Classes>,
    /// Semi-hexagons on which a point is inserted; right within the tile.
    pub(super) inserted: Window,
}

/// Where each vertex and triangle of the mesh will stand.
#[derive(Debug)]
pub struct Layout<'a> {
    pub(super) grid: &'a Grid,
    pub(super) domain: Domain,
    /// Whether vertices are relocated by class.
    pub(super) templates: bool,
    /// A block per tile, by level and tile id; empty below the base level.
    blocks: Vec<Vec<Block>>,
    /// Sum over all blocks.
    vertex_count: u64,
}

impl<'a> Layout<'a> {
    /// Counts the vertices and triangles of all tiles.
    pub(super) fn new(grid: &'a Grid, domain: Domain, templates: bool) -> Result<Self, DualError> {
        let mut layout = Self { grid, domain, templates, blocks: Vec::new(), vertex_count: 0 };
        for level in 0..grid.tiles().levels() as u8 {
            let tiles = if level < domain.base_level { 0 } else { grid.tiles().level(level).len() };
            let mut blocks: Vec<Block> =
                (0..tiles).into_par_iter().map(|i| layout.block(level, TileId::new(i))).collect();
            for block in &mut blocks {
                block.first_vertex = layout.vertex_count as u32;
                layout.vertex_count += u64::from(block.vertices.count_ones());
            }
            layout.blocks.push(blocks);
        }
        if layout.vertex_count > u64::from(u32::MAX) {
            return Err(DualError::TooManyVertices { count: layout.vertex_count });
        }
        Ok(layout)
    }

    /// How many triangles the mesh has.
    pub fn triangles(&self) -> u64 {
        self.blocks.iter().flatten().map(|b| u64::from(b.triangles)).sum()
    }

    /// How many vertices the mesh has.
    pub fn vertices(&self) -> u64 {
        self.vertex_count
    }

    /// The tiles that own part of the mesh, in the order of their vertices,
    /// with how many vertices and triangles they own.
    pub(super) fn owners(&self) -> impl Iterator<Item = (u8, TileId, Block)> {
        self.blocks.iter().enumerate().flat_map(|(level, blocks)| {
            let owned = blocks.iter().enumerate().filter(|(_, b)| b.vertices != 0 || b.triangles != 0);
            owned.map(move |(i, &b)| (level as u8, TileId::new(i), b))
        })
    }

    pub(super) fn block_of(&self, level: u8, id: TileId) -> Block {
        self.blocks[usize::from(level)][id.index()]
    }

    /// The vertex at bit `bit` of a tile.
    #[inline]
    pub(super) fn vertex(&self, level: u8, id: TileId, bit: u32) -> VertexId {
        let block = &self.blocks[usize::from(level)][id.index()];
        debug_assert!(block.vertices >> bit & 1 == 1, "no vertex at bit {bit} of {id:?}, level {level}");
        let rank = (block.vertices & ((1 << bit) - 1)).count_ones();
        VertexId::new((block.first_vertex + rank) as usize)
    }

    fn block(&self, level: u8, id: TileId) -> Block {
        let sets = self.sets(level, id);
        let subdivided = sets.classes.as_ref().map_or(Window::EMPTY, |c| c.subdivided);
        let dropped = sets.classes.as_ref().map_or(Window::EMPTY, |c| self.single(c));
        let vertices = sets.exists.without(subdivided | dropped) | sets.inserted;
        Block { vertices: vertices.centre(), first_vertex: 0, triangles: self.count(&sets) }
    }

    /// The `MovedCenter3` whose own centre is no vertex.
    pub(super) fn single(&self, classes: &Classes) -> Window {
        if !self.templates || classes.moved3.is_empty() {
            return Window::EMPTY;
        }
        let (before, after) = classes.in_run();
        classes.moved3.without(before | after)
    }

    /// Reads a tile's sets.
    pub(super) fn sets(&self, level: u8, id: TileId) -> Sets {
        let subdivided = self.grid.tiles().window(level, id, |t| t.subdivided);
        let classes = (!subdivided.is_empty()).then(|| Classes::of(subdivided));
        if level == self.domain.base_level {
            let exists = self.domain.window(self.grid.tiles().get(level, id).first());
            return Sets { exists, classes, inserted: Window::EMPTY };
        }
        let (exists, inserted) = self.from_parent(level, id);
        Sets { exists, classes, inserted }
    }

    /// What the subdivided hexagons one level coarser make exist in a tile:
    /// full hexagons, and the inserted points.
    fn from_parent(&self, level: u8, id: TileId) -> (Window, Window) {
        let Some((parent, quadrant)) = self.grid.tiles().parent(level, id) else {
            return (Window::EMPTY, Window::EMPTY);
        };
        let subdivided = self.grid.tiles().window(level - 1, parent, |t| t.subdivided);
        let exists = children(subdivided, quadrant);
        if !self.templates {
            return (exists, Window::EMPTY);
        }
        let classes = Classes::of(subdivided);
        if classes.moved3.is_empty() {
            return (exists, Window::EMPTY);
        }
        let inserted = star::fins_with_vertex(&classes);
        let inserted = Direction::ALL.into_iter().fold(Window::EMPTY, |set, d| {
            set | Window::scaled(inserted[d.index()].cut(corner_of(quadrant))).moved(d)
        });
        (exists, inserted & Window::with_margin(0))
    }

    /// How many triangles a tile owns.
    fn count(&self, sets: &Sets) -> u32 {
        let mut count = 0;
        for walk in self.walks(sets) {
            count += walk.whole.count() + 2 * walk.split.count();
        }
        if let Some(classes) = sets.classes.as_ref().filter(|_| self.templates) {
            count += star::count(classes, sets.exists);
        }
        count
    }

    /// The lattice triangles that a tile owns, pointing up and down.
    pub(super) fn walks(&self, sets: &Sets) -> [Walk; 2] {
        let three = match &sets.classes {
            Some(classes) if self.templates => classes.moved3,
            _ => Window::EMPTY,
        };
        let subdivided = sets.classes.as_ref().map_or(Window::EMPTY, |c| c.subdivided);
        [0, 1].map(|i| {
            let second = Direction::new(i);
            let third = Direction::new(i + 1);
            let corners = |set: Window| (set, set.at(second), set.at(third));
            let (e, f, g) = corners(sets.exists);
            let (a, b, c) = corners(subdivided);
            let (x, y, z) = corners(three);
            let all = (e & f & g & Window::with_margin(0)).without(x | y | z);
            let two = a & b | b & c | c & a;
            Walk { second, third, whole: all.without(two), split: all & two.without(a & b & c) }
        })
    }
}

/// Lattice triangles `(h, h + second, h + third)`, by their corner `h`.
pub(super) struct Walk {
    pub(super) second: Direction,
    pub(super) third: Direction,
    /// At most one corner subdivided: one triangle each.
    pub(super) whole: Window,
    /// Two corners subdivided: two triangles each.
    pub(super) split: Window,
}

/// The hexagons that exist in one quarter of a tile, one level finer: scaled
/// centres, and those joined between two subdivided ones. Right for a margin
/// of three.
pub(super) fn children(subdivided: Window, quadrant: usize) -> Window {
    let corner = corner_of(quadrant);
    let mut exists = Window::scaled(subdivided.cut(corner));
    for d in [0, 1, 2].map(Direction::new) {
        let pairs = subdivided & subdivided.at(d);
        exists |= Window::scaled(pairs.cut(corner)).moved(d);
    }
    exists
}

/// Where, relative to a tile, the 8 x 8 hexagons start whose scaled centres
/// fill the window of the tile's quarter: the quarter and two more on each
/// side.
fn corner_of(quadrant: usize) -> Hex {
    Hex::new(4 * (quadrant as i64 & 1) - 2, 4 * (quadrant as i64 >> 1) - 2)
}

/// Makes all tiles exist that hold a leaf, an inserted point or a triangle.
pub(super) fn require_leaf_tiles(grid: &mut Grid, domain: Domain) {
    let radius = i64::from(domain.radius);
    for q in (-radius..=radius + 7).step_by(8) {
        for r in (-radius..=radius + 7).step_by(8) {
            grid.tiles_mut().require(domain.base_level, Hex::new(q, r));
        }
    }
    let mut level = domain.base_level;
    while usize::from(level) < grid.tiles().levels() {
        for id in domain::tiles(grid, level) {
            let subdivided = grid.tiles().window(level, id, |t| t.subdivided);
            for quadrant in 0..4 {
                // A semi-hexagon lies beside a full one: one step of dilation
                // covers the inserted points.
                let children = children(subdivided, quadrant).dilated().centre();
                if children != 0 && grid.tiles().child(level, id, quadrant).is_none() {
                    grid.tiles_mut().require_child(level, id, quadrant);
                }
            }
        }
        level += 1;
    }
}
