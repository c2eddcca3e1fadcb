//! Coordinates of the vertices.

use super::layout::{Block, Layout, Sets};
use super::{Occupant, Relocation, star};
use crate::exact::Offset;
use crate::relocate::{ring_may_stay, ring_shift};
use hexdel_geom::{DVec2, VertexId};
use hexdel_grid::double::Double;
use hexdel_grid::grid::hex_of;
use hexdel_grid::window::ones;
use hexdel_grid::{Hex, TileId, Window};
use rayon::prelude::*;

/// Tiles filled by one task: enough work to be worth handing out.
const TILES_PER_TASK: usize = 256;

/// Places every vertex by its class.
pub(super) fn fill(layout: &Layout) -> Vec<DVec2> {
    let mut vertices = vec![DVec2::ZERO; layout.vertices() as usize];
    let owners: Vec<_> = layout.owners().collect();
    let mut rest = vertices.as_mut_slice();
    let tasks: Vec<_> = owners
        .chunks(TILES_PER_TASK)
        .map(|tiles| {
            let count: u32 = tiles.iter().map(|(_, _, b)| b.vertices.count_ones()).sum();
            let (mine, others) = std::mem::take(&mut rest).split_at_mut(count as usize);
            rest = others;
            (tiles, mine)
        })
        .collect();
    tasks.into_par_iter().for_each(|(tiles, mut out)| {
        for &(level, id, block) in tiles {
            let (mine, others) = out.split_at_mut(block.vertices.count_ones() as usize);
            fill_tile(layout, level, id, block, mine);
            out = others;
        }
    });
    vertices
}

fn fill_tile(layout: &Layout, level: u8, id: TileId, block: Block, out: &mut [DVec2]) {
    let frame = Frame::new(layout, level, id);
    let sets = layout.sets(level, id);
    let moved = moved(layout, &sets).centre();
    let inserted = sets.inserted.centre();
    for (place, bit) in out.iter_mut().zip(ones(block.vertices)) {
        let at = hex_of(bit);
        let offset = match &sets.classes {
            _ if inserted >> bit & 1 == 1 => star::inserted_at(layout, level, id, at),
            Some(classes) if moved >> bit & 1 == 1 => Offset::of(at) + classes.relocation(at),
            _ => Offset::of(at),
        };
        *place = frame.place(offset);
    }
}

/// The hexagons that a template moves.
fn moved(layout: &Layout, sets: &Sets) -> Window {
    match &sets.classes {
        Some(classes) if layout.templates => classes.finned() | classes.moved4(),
        _ => Window::EMPTY,
    }
}

/// A tile's place in the plane.
struct Frame {
    x: Double,
    y: Double,
    spacing: f64,
}

impl Frame {
    fn new(layout: &Layout, level: u8, id: TileId) -> Self {
        let first = layout.grid.tiles().get(level, id).first();
        let lattice = layout.grid.lattice();
        let (x, y) = lattice.exact(level, first);
        Self { x, y, spacing: lattice.spacing(level) }
    }

    /// A point given relative to the tile's first hexagon.
    ///
    /// The tile's corner is known to twice the precision, and the offset is
    /// small: what is rounded is the result.
    #[inline]
    fn place(&self, offset: Offset) -> DVec2 {
        let v = offset.cartesian() * self.spacing;
        DVec2::new(self.x.hi + (self.x.lo + v.x), self.y.hi + (self.y.lo + v.y))
    }
}

/// Moves the vertices of occupied hexagons onto their points, and the rings of
/// those of class `Occupied2` after them. Returns the vertex of each occupant.
pub(super) fn place_occupants(
    layout: &Layout,
    occupants: &[Occupant],
    relocation: Relocation,
    vertices: &mut [DVec2],
) -> Vec<VertexId> {
    occupants
        .iter()
        .map(|occupant| {
            let (level, hex) = (occupant.level, occupant.at.hex);
            let vertex = vertex_at(layout, level, hex);
            vertices[vertex.index()] = occupant.point;
            if relocation == Relocation::Full && !ring_may_stay(&occupant.at) {
                let shift = ring_shift(&occupant.at);
                for beside in hex.neighbours() {
                    let moved = vertex_at(layout, level, beside);
                    vertices[moved.index()] = shifted(layout, level, beside, shift);
                }
            }
            vertex
        })
        .collect()
}

fn shifted(layout: &Layout, level: u8, hex: Hex, shift: Offset) -> DVec2 {
    let lattice = layout.grid.lattice();
    let (x, y) = lattice.exact(level, hex);
    let v = shift.cartesian() * lattice.spacing(level);
    DVec2::new(x.hi + (x.lo + v.x), y.hi + (y.lo + v.y))
}

fn vertex_at(layout: &Layout, level: u8, hex: Hex) -> VertexId {
    let (id, bit) =
        layout.grid.tiles().find(level, hex).expect("an occupied hexagon and its ring lie in tiles");
    layout.vertex(level, id, bit)
}
