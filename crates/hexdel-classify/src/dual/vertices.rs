//! Coordinates of the vertices.

use super::layout::Layout;
use super::{Occupant, Relocation, star};
use crate::exact::Offset;
use crate::relocate::{relocation, ring_may_stay, ring_shift};
use hexdel_geom::double_double::Double;
use hexdel_geom::par::prelude::*;
use hexdel_geom::{DVec2, VertexId};
use hexdel_grid::grid::hex_of;
use hexdel_grid::window::ones;
use hexdel_grid::{Direction, Hex, Lattice, TileId};
use std::sync::OnceLock;

/// Places the vertices of a tile by their classes.
pub(super) fn fill_tile(layout: &Layout, level: u8, id: TileId, out: &mut [[f64; 2]]) {
    let block = layout.block(level, id);
    let frame = Frame::new(layout, level, id);
    let centres = centres();
    // Where each of the tile's vertices stands in its part of the array.
    let mut ranks = [0_u8; 64];
    for (rank, (place, bit)) in (0..).zip(out.iter_mut().zip(ones(block.vertices))) {
        *place = frame.place_at(centres[bit as usize]).to_array();
        ranks[bit as usize] = rank;
    }
    let mut put = |bit: u32, at: Offset| {
        out[usize::from(ranks[bit as usize])] = frame.place(at).to_array();
    };
    if block.moved & block.vertices != 0 {
        let subdivided = layout.grid.tiles().window(level, id, |t| t.subdivided);
        for bit in ones(block.moved & block.vertices) {
            let at = hex_of(bit);
            put(bit, Offset::of(at) + relocation(subdivided, at));
        }
    }
    let inserted = block.vertices & !block.exists;
    if inserted != 0 {
        fill_inserted(layout, (level, id), inserted, put);
    }
}

/// Says where the points lie that are inserted at some bits of a tile, relative
/// to the tile's first hexagon.
fn fill_inserted(
    layout: &Layout,
    (level, id): (u8, TileId),
    inserted: u64,
    mut put: impl FnMut(u32, Offset),
) {
    let tiles = layout.grid.tiles();
    let (parent, _) = tiles.parent(level, id).expect("points are inserted below the base level");
    let subdivided = tiles.window(level - 1, parent, |t| t.subdivided);
    let first = tiles.first(level, id);
    let coarser = tiles.first(level - 1, parent);
    for bit in ones(inserted) {
        let (a, b) = (first - coarser.scaled() + hex_of(bit)).parents();
        let b = b.expect("a semi-hexagon has two parents");
        let (hex, fin) = if subdivided.contains(a) { (b, a) } else { (a, b) };
        let p = star::point_on_fin(subdivided, hex, fin)
            .expect("a point lies on the fin of a three-finned hexagon");
        let scaled = Offset { q: 2 * p.q, r: 2 * p.r };
        put(bit, Offset::of((hex + coarser).scaled() - first) + scaled);
    }
}

/// A place in the plane, as the origin of offsets.
struct Frame {
    x: Double,
    y: Double,
    spacing: f64,
}

impl Frame {
    /// Around a tile's first hexagon.
    fn new(layout: &Layout, level: u8, id: TileId) -> Self {
        Self::at(layout.grid.lattice(), level, layout.grid.tiles().first(level, id))
    }

    fn at(lattice: &Lattice, level: u8, hex: Hex) -> Self {
        let (x, y) = lattice.exact(level, hex);
        Self { x, y, spacing: lattice.spacing(level) }
    }

    /// A point given relative to the origin.
    ///
    /// The origin is known to twice the precision, and the offset is small:
    /// what is rounded is the result.
    #[inline]
    fn place(&self, offset: Offset) -> DVec2 {
        self.place_at(offset.cartesian())
    }

    /// The same, in lattice steps.
    #[inline]
    fn place_at(&self, offset: DVec2) -> DVec2 {
        let v = offset * self.spacing;
        DVec2::new(self.x.hi + (self.x.lo + v.x), self.y.hi + (self.y.lo + v.y))
    }
}

/// The centres of a tile's hexagons, from its first, in lattice steps.
fn centres() -> &'static [DVec2; 64] {
    static CENTRES: OnceLock<[DVec2; 64]> = OnceLock::new();
    CENTRES.get_or_init(|| std::array::from_fn(|bit| Offset::of(hex_of(bit as u32)).cartesian()))
}

/// Occupants looked up at once: so few that what is found about them stays in
/// the cache.
const OCCUPANTS_AT_ONCE: usize = 1 << 11;

/// Moves the vertices of occupied hexagons onto their points and, with
/// templates, the rings of those of class `Occupied2` after them. Returns the
/// vertex of each occupant.
pub(super) fn place_occupants(
    layout: &Layout,
    occupants: &[Occupant],
    relocation: Relocation,
    vertices: &mut [DVec2],
) -> Vec<VertexId> {
    let mut of_occupant = Vec::with_capacity(occupants.len());
    for some in occupants.chunks(OCCUPANTS_AT_ONCE) {
        let look_up = |occupant| Moved::of(layout, occupant, relocation);
        let found: Vec<_> = some.par_iter().map(look_up).collect();
        for (moved, occupant) in found.into_iter().zip(some) {
            vertices[moved.vertex.index()] = occupant.point;
            for (vertex, to) in moved.ring.into_iter().flatten() {
                vertices[vertex.index()] = to;
            }
            of_occupant.push(moved.vertex);
        }
    }
    of_occupant
}

/// The vertices that an input point moves, and where to.
pub(super) fn moved_by(
    layout: &Layout,
    occupant: &Occupant,
    relocation: Relocation,
) -> impl Iterator<Item = (VertexId, DVec2)> {
    let moved = Moved::of(layout, occupant, relocation);
    std::iter::once((moved.vertex, occupant.point)).chain(moved.ring.into_iter().flatten())
}

/// The vertices that an input point moves.
struct Moved {
    vertex: VertexId,
    /// The ring and where it goes, if it does.
    ring: Option<[(VertexId, DVec2); 6]>,
}

impl Moved {
    fn of(layout: &Layout, occupant: &Occupant, relocation: Relocation) -> Self {
        let (level, hex) = (occupant.level, occupant.at.hex);
        let id = occupant.tile;
        let at = hex - layout.grid.tiles().first(level, id);
        let ring = (relocation == Relocation::Full && !ring_may_stay(&occupant.at)).then(|| {
            let shift = ring_shift(&occupant.at).cartesian();
            Direction::ALL.map(|d| {
                let to = Frame::at(layout.grid.lattice(), level, hex.neighbour(d)).place_at(shift);
                (vertex_beside(layout, level, id, at + d.step()), to)
            })
        });
        Self { vertex: vertex_beside(layout, level, id, at), ring }
    }
}

/// The vertex at a place relative to a tile, at most one hexagon beyond it.
fn vertex_beside(layout: &Layout, level: u8, id: TileId, at: Hex) -> VertexId {
    let there = match (at.q >> 3, at.r >> 3) {
        // Mostly: then its links need not be read.
        (0, 0) => Some(id),
        (column, row) => layout.grid.tiles().beside(level, id, column, row),
    };
    let bit = 8 * (at.r & 7) + (at.q & 7);
    layout.block(level, there.expect("the ring of an occupied hexagon lies in tiles")).vertex(bit as u32)
}
