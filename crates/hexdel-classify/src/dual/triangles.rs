//! Index triples.

use super::layout::{Layout, Walk};
use super::star::{self, Corners, Star};
use hexdel_geom::VertexId;
use hexdel_grid::grid::hex_of;
use hexdel_grid::window::ones;
use hexdel_grid::{Hex, TileId};

/// Emits the triangles that a tile owns.
pub(super) fn fill_tile(layout: &Layout, level: u8, id: TileId, out: &mut [[u32; 3]]) {
    if out.is_empty() {
        return;
    }
    let tile = OwnerTile::new(layout, level, id);
    let mut out = Emitter { out, count: 0 };
    for walk in layout.walks(level, id) {
        emit_whole(&tile, &walk, &mut out);
        emit_split(&tile, &walk, &mut out);
    }
    let three = layout.block(level, id).three;
    if three != 0 {
        let subdivided = layout.grid.tiles().window(level, id, |t| t.subdivided);
        for at in ones(three).map(hex_of) {
            let star = Star::of(subdivided, at).expect("a three-finned hexagon has a middle fin");
            star::emit(star, at, &tile, |t| out.push(t));
        }
    }
    debug_assert_eq!(out.count, out.out.len(), "{id:?} of level {level}");
}

/// A tile's part of the array, and how much of it is filled.
struct Emitter<'a> {
    out: &'a mut [[u32; 3]],
    count: usize,
}

impl Emitter<'_> {
    #[inline]
    fn push(&mut self, corners: [u32; 3]) {
        self.out[self.count] = corners;
        self.count += 1;
    }
}

/// Lattice triangles with at most one subdivided corner.
fn emit_whole(tile: &OwnerTile, walk: &Walk, out: &mut Emitter) {
    let (second, third) = if walk.down { (ROW, ROW - 1) } else { (1, ROW) };
    for bit in ones(walk.whole) {
        let i = place(hex_of(bit));
        let mut corners = [tile.ids[i], tile.ids[i + second], tile.ids[i + third]];
        if corners.contains(&NONE) {
            let h = hex_of(bit);
            let at = [h, h.neighbour(walk.second()), h.neighbour(walk.third())];
            for (corner, at) in corners.iter_mut().zip(at).filter(|(corner, _)| **corner == NONE) {
                *corner = tile.finer(at.scaled());
            }
        }
        out.push(corners);
    }
}

/// Lattice triangles with two subdivided corners, split at the hexagon joined
/// between them.
fn emit_split(tile: &OwnerTile, walk: &Walk, out: &mut Emitter) {
    for at in ones(walk.split).map(hex_of) {
        let corners = [at, at.neighbour(walk.second()), at.neighbour(walk.third())];
        let whole = (0..3).find(|&i| tile.ids[place(corners[i])] != NONE).expect("one corner is a leaf");
        let [h, a, b] = [0, 1, 2].map(|i| corners[(whole + i) % 3]);
        let (leaf, joined) = (tile.leaf(h), tile.finer(a + b));
        out.push([leaf, tile.finer(a.scaled()), joined]);
        out.push([leaf, joined, tile.finer(b.scaled())]);
    }
}

/// Places in a row of [`OwnerTile::ids`]: the tile and one hexagon beyond it
/// on each side, made a power of two.
const ROW: usize = 16;

/// No leaf.
const NONE: u32 = u32::MAX;

/// Index in [`OwnerTile::ids`].
#[inline]
fn place(at: Hex) -> usize {
    ((at.r + 1) * ROW as i64 + at.q + 1) as usize
}

/// A tile whose triangles are emitted.
struct OwnerTile<'a> {
    layout: &'a Layout<'a>,
    level: u8,
    id: TileId,
    /// The vertices of the tile and of one hexagon around it; [`NONE`] where
    /// there is none. Vertices inserted on semi-hexagons are there, too.
    ids: [u32; 10 * ROW],
}

impl<'a> OwnerTile<'a> {
    fn new(layout: &'a Layout<'a>, level: u8, id: TileId) -> Self {
        const WEST: u64 = 0x0101_0101_0101_0101;
        const COLUMNS: [u64; 3] = [WEST << 7, u64::MAX, WEST];
        const ROWS: [u64; 3] = [0xff << 56, u64::MAX, 0xff];
        let mut ids = [NONE; 10 * ROW];
        for row in -1..=1 {
            for column in -1..=1 {
                let Some(there) = layout.grid.tiles().beside(level, id, column, row) else {
                    continue;
                };
                let block = layout.block(level, there);
                let seen = block.vertices & COLUMNS[(column + 1) as usize] & ROWS[(row + 1) as usize];
                let corner = Hex::new(8 * column, 8 * row);
                if seen == 0 {
                    continue;
                }
                for bit in ones(seen) {
                    ids[place(corner + hex_of(bit))] = block.vertex(bit).index() as u32;
                }
            }
        }
        Self { layout, level, id, ids }
    }
}

impl Corners for OwnerTile<'_> {
    #[inline]
    fn leaf(&self, at: Hex) -> u32 {
        self.ids[place(at)]
    }

    #[inline]
    fn finer(&self, at: Hex) -> u32 {
        let tiles = self.layout.grid.tiles();
        let coarse = Hex::new(at.q >> 1, at.r >> 1);
        let quadrant = (coarse.r >> 2 & 1) * 2 + (coarse.q >> 2 & 1);
        let child = tiles
            .beside(self.level, self.id, coarse.q >> 3, coarse.r >> 3)
            .and_then(|tile| tiles.child(self.level, tile, quadrant as usize))
            .expect("finer corners of triangles lie in tiles");
        let bit = 8 * (at.r & 7) + (at.q & 7);
        let vertex: VertexId = self.layout.block(self.level + 1, child).vertex(bit as u32);
        vertex.index() as u32
    }
}
