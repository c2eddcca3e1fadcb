//! Index triples.

use super::layout::{Block, Layout, Walk};
use super::star::{self, Corners, Star};
use hexdel_grid::grid::hex_of;
use hexdel_grid::window::ones;
use hexdel_grid::{Hex, TileId};
use std::cell::OnceCell;

/// Emits the triangles that a tile owns.
pub(super) fn fill_tile(layout: &Layout, level: u8, id: TileId, out: &mut [[u32; 3]]) {
    if out.is_empty() {
        return;
    }
    let tile = OwnerTile::new(layout, level, id);
    let mut out = Emitter { out, count: 0 };
    let [up, down] = layout.walks(level, id);
    emit_whole::<false>(&tile, &up, &mut out);
    emit_split(&tile, &up, &mut out);
    emit_whole::<true>(&tile, &down, &mut out);
    emit_split(&tile, &down, &mut out);
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
fn emit_whole<const DOWN: bool>(tile: &OwnerTile, walk: &Walk, out: &mut Emitter) {
    let (second, third) = const { if DOWN { (ROW, ROW - 1) } else { (1, ROW) } };
    for bit in ones(walk.whole) {
        // Where `hex_of(bit)` is kept: rows are twice as long as the tile's.
        let i = (bit + (bit & 0x38)) as usize + ROW + 1;
        let mut corners = [tile.ids[i], tile.ids[i + second], tile.ids[i + third]];
        if corners[0].max(corners[1]).max(corners[2]) == NONE {
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
    /// The blocks one level finer, under the tile and beside them, row by row;
    /// found when they are first asked for.
    finer: OnceCell<[Option<&'a Block>; 16]>,
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
        Self { layout, level, id, ids, finer: OnceCell::new() }
    }

    fn finer_blocks(&self) -> [Option<&'a Block>; 16] {
        let tiles = self.layout.grid.tiles();
        std::array::from_fn(|i| {
            // From the tile before the first under this one on.
            let (column, row) = (i as i64 % 4 - 1, i as i64 / 4 - 1);
            let coarse = tiles.beside(self.level, self.id, column >> 1, row >> 1)?;
            let child = tiles.child(self.level, coarse, (2 * (row & 1) + (column & 1)) as usize)?;
            self.layout.block_if_any(self.level + 1, child)
        })
    }
}

impl Corners for OwnerTile<'_> {
    #[inline]
    fn leaf(&self, at: Hex) -> u32 {
        self.ids[place(at)]
    }

    #[inline]
    fn finer(&self, at: Hex) -> u32 {
        let blocks = self.finer.get_or_init(|| self.finer_blocks());
        let block = blocks[(4 * ((at.r >> 3) + 1) + (at.q >> 3) + 1) as usize];
        let bit = 8 * (at.r & 7) + (at.q & 7);
        block.expect("finer corners of triangles lie in tiles").vertex(bit as u32).index() as u32
    }
}
