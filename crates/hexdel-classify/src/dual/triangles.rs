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
        let (mut a, mut b, mut c) = (tile.ids[i], tile.ids[i + second], tile.ids[i + third]);
        // At most one corner is none.
        if a.max(b).max(c) == NONE {
            let h = hex_of(bit);
            if a == NONE {
                a = tile.finer(h.scaled());
            } else if b == NONE {
                b = tile.finer(h.neighbour(walk.second()).scaled());
            } else {
                c = tile.finer(h.neighbour(walk.third()).scaled());
            }
        }
        out.push([a, b, c]);
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
    /// The vertices of the tile and, as far as its triangles reach, of one hexagon
    /// around it; [`NONE`] where there is none. Vertices inserted on semi-hexagons are there, too.
    ids: [u32; 10 * ROW],
    /// The blocks one level finer, under the tile and beside them, row by row;
    /// found when they are first asked for.
    finer: OnceCell<[Option<&'a Block>; 16]>,
}

impl<'a> OwnerTile<'a> {
    fn new(layout: &'a Layout<'a>, level: u8, id: TileId) -> Self {
        let own = layout.block(level, id);
        let mut ids = [NONE; 10 * ROW];
        number_all(own, &mut ids);
        let beside =
            |column, row| Some(layout.block(level, layout.grid.tiles().beside(level, id, column, row)?));
        // What triangles with their lowest corner here reach ...
        if let Some(east) = beside(1, 0) {
            number_column::<0>(east, 8, &mut ids);
        }
        if let Some(north) = beside(0, 1) {
            number_row::<0>(north, 8, &mut ids);
        }
        if let Some(west) = beside(-1, 0) {
            number_column::<7>(west, -1, &mut ids);
        }
        if let Some(north_west) = beside(-1, 1) {
            number_one::<7>(north_west, Hex::new(-1, 8), &mut ids);
        }
        // ... and stars around a centre here.
        if own.three != 0 {
            if let Some(south) = beside(0, -1) {
                number_row::<7>(south, -1, &mut ids);
            }
            if let Some(south_east) = beside(1, -1) {
                number_one::<56>(south_east, Hex::new(8, -1), &mut ids);
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

/// Enters the vertices of a tile itself.
#[inline]
fn number_all(block: &Block, ids: &mut [u32; 10 * ROW]) {
    for (id, bit) in (block.first_vertex..).zip(ones(block.numbered)) {
        if block.vertices >> bit & 1 == 1 {
            ids[(bit + (bit & 0x38)) as usize + ROW + 1] = id;
        }
    }
}

/// Enters the vertices of row `R` of a tile as the row `to`.
#[inline]
fn number_row<const R: u32>(block: &Block, to: i64, ids: &mut [u32; 10 * ROW]) {
    let before = block.numbered & ((1 << (8 * R)) - 1);
    let first = block.first_vertex + before.count_ones();
    for (id, column) in (first..).zip(ones(block.numbered >> (8 * R) & 0xff)) {
        if block.vertices >> (8 * R + column) & 1 == 1 {
            ids[place(Hex::new(i64::from(column), to))] = id;
        }
    }
}

/// Enters the vertices of column `C`, the first or last, of a tile as the column
/// `to`.
#[inline]
fn number_column<const C: u32>(block: &Block, to: i64, ids: &mut [u32; 10 * ROW]) {
    const FIRST: u64 = 0x0101_0101_0101_0101;
    let seen = block.vertices & FIRST << C;
    if seen == 0 {
        return;
    }
    // The last of a row comes just before the first of the next one.
    let through = ones_through_rows(block.numbered);
    let ranks = if C == 0 { through << 8 } else { through - (block.numbered >> 7 & FIRST) };
    for bit in ones(seen) {
        let (row, rank) = (i64::from(bit / 8), ranks >> (bit & 0x38) & 0xff);
        ids[place(Hex::new(to, row))] = block.first_vertex + rank as u32;
    }
}

/// Enters one vertex of a tile.
#[inline]
fn number_one<const BIT: u32>(block: &Block, to: Hex, ids: &mut [u32; 10 * ROW]) {
    if block.vertices >> BIT & 1 == 1 {
        ids[place(to)] = block.vertex(BIT).index() as u32;
    }
}

/// Byte `r`: how many ones the rows up to `r` hold.
#[inline]
const fn ones_through_rows(word: u64) -> u64 {
    let word = word - (word >> 1 & 0x5555_5555_5555_5555);
    let word = (word & 0x3333_3333_3333_3333) + (word >> 2 & 0x3333_3333_3333_3333);
    ((word + (word >> 4)) & 0x0f0f_0f0f_0f0f_0f0f).wrapping_mul(0x0101_0101_0101_0101)
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
