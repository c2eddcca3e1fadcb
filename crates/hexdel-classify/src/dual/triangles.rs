//! Index triples.

use super::layout::{Layout, Sets, Walk};
use super::star::{self, Corners, Star};
use hexdel_geom::VertexId;
use hexdel_grid::window::ones;
use hexdel_grid::{Hex, TileId, Window};
use rayon::prelude::*;

/// Tiles filled by one task: enough work to be worth handing out.
const TILES_PER_TASK: usize = 256;

/// Emits every triangle, tile by tile.
pub(super) fn fill(layout: &Layout) -> Vec<[VertexId; 3]> {
    let unset = [VertexId::new(0); 3];
    let mut triangles = vec![unset; layout.triangles() as usize];
    let owners: Vec<_> = layout.owners().collect();
    let mut rest = triangles.as_mut_slice();
    let tasks: Vec<_> = owners
        .chunks(TILES_PER_TASK)
        .map(|tiles| {
            let count: u32 = tiles.iter().map(|(_, _, b)| b.triangles).sum();
            let (mine, others) = std::mem::take(&mut rest).split_at_mut(count as usize);
            rest = others;
            (tiles, mine)
        })
        .collect();
    tasks.into_par_iter().for_each(|(tiles, out)| {
        let mut places = out.iter_mut();
        for &(level, id, block) in tiles {
            let mut count = 0;
            fill_tile(layout, level, id, |t| {
                count += 1;
                *places.next().expect("as many triangles are emitted as were counted") = t;
            });
            debug_assert_eq!(count, block.triangles, "{id:?} of level {level}");
        }
    });
    triangles
}

fn fill_tile(layout: &Layout, level: u8, id: TileId, mut push: impl FnMut([VertexId; 3])) {
    let sets = layout.sets(level, id);
    let tile = OwnerTile { layout, level, id };
    let subdivided = sets.classes.as_ref().map_or(Window::EMPTY, |c| c.subdivided);
    for walk in layout.walks(&sets) {
        emit_whole(&tile, &walk, subdivided, &mut push);
        emit_split(&tile, &walk, subdivided, &mut push);
    }
    emit_stars(&tile, &sets, &mut push);
}

/// Lattice triangles with at most one subdivided corner.
fn emit_whole(tile: &OwnerTile, walk: &Walk, subdivided: Window, push: &mut impl FnMut([VertexId; 3])) {
    for bit in ones(walk.whole.centre()) {
        let h = hexdel_grid::grid::hex_of(bit);
        let corners = [h, h.neighbour(walk.second), h.neighbour(walk.third)];
        push(corners.map(|at| tile.corner(at, subdivided)));
    }
}

/// Lattice triangles with two subdivided corners, split at the hexagon joined
/// between them.
fn emit_split(tile: &OwnerTile, walk: &Walk, subdivided: Window, push: &mut impl FnMut([VertexId; 3])) {
    for bit in ones(walk.split.centre()) {
        let at = hexdel_grid::grid::hex_of(bit);
        let corners = [at, at.neighbour(walk.second), at.neighbour(walk.third)];
        let whole = (0..3).find(|&i| !subdivided.contains(corners[i])).expect("one corner is a leaf");
        let [h, a, b] = [0, 1, 2].map(|i| corners[(whole + i) % 3]);
        let (leaf, joined) = (tile.leaf(h), tile.finer(a + b));
        push([leaf, tile.finer(a.scaled()), joined]);
        push([leaf, joined, tile.finer(b.scaled())]);
    }
}

fn emit_stars(tile: &OwnerTile, sets: &Sets, push: &mut impl FnMut([VertexId; 3])) {
    let Some(classes) = sets.classes.as_ref().filter(|_| tile.layout.templates) else {
        return;
    };
    for bit in ones((classes.moved3 & sets.exists).centre()) {
        let at = hexdel_grid::grid::hex_of(bit);
        let star = Star::of(classes, at).expect("a three-finned hexagon has a middle fin");
        star::emit(star, at, tile, &mut *push);
    }
}

/// A tile whose triangles are emitted.
struct OwnerTile<'a> {
    layout: &'a Layout<'a>,
    level: u8,
    id: TileId,
}

impl OwnerTile<'_> {
    /// The vertex that stands for a corner of a lattice triangle.
    #[inline]
    fn corner(&self, at: Hex, subdivided: Window) -> VertexId {
        if subdivided.contains(at) { self.finer(at.scaled()) } else { self.leaf(at) }
    }

    /// The tile that lies `at` hexagons from this one's first.
    #[inline]
    fn beside(&self, at: Hex) -> TileId {
        let tiles = self.layout.grid.tiles();
        tiles.beside(self.level, self.id, at.q >> 3, at.r >> 3).expect("corners of triangles lie in tiles")
    }
}

impl Corners for OwnerTile<'_> {
    #[inline]
    fn leaf(&self, at: Hex) -> VertexId {
        let bit = 8 * (at.r & 7) + (at.q & 7);
        self.layout.vertex(self.level, self.beside(at), bit as u32)
    }

    #[inline]
    fn finer(&self, at: Hex) -> VertexId {
        let coarse = Hex::new(at.q >> 1, at.r >> 1);
        let quadrant = (coarse.r >> 2 & 1) * 2 + (coarse.q >> 2 & 1);
        let child = self
            .layout
            .grid
            .tiles()
            .child(self.level, self.beside(coarse), quadrant as usize)
            .expect("finer corners of triangles lie in tiles");
        let bit = 8 * (at.r & 7) + (at.q & 7);
        self.layout.vertex(self.level + 1, child, bit as u32)
    }
}
