//! The hexagonal patch that the mesh covers.
//!
//! Level 0 of the grid covers the whole plane. A mesh is cut out of it as a
//! regular hexagon of leaves of one *base level*: all that is coarser is left
//! away, and around what is finer lies just enough padding that the patch's rim
//! is neither subdivided nor moved. Its sides are then straight, and so is the
//! proof: nothing at the rim differs from the inside.

use crate::class::{Classes, View};
use hexdel_grid::{Grid, Hex, TileId, Window};

/// A regular hexagon of leaves around the lattice's origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Domain {
    /// The level of the leaves along the rim; all other leaves are of this
    /// level or finer.
    pub base_level: u8,
    /// Lattice steps of the base level from the centre to a corner.
    pub radius: u32,
}

impl Domain {
    /// The hexagons of the base level that the patch holds, as seen from a
    /// tile whose first hexagon is `first`.
    pub(super) fn window(self, first: Hex) -> Window {
        let radius = u64::from(self.radius);
        Window::FULL.iter().filter(|&at| (first + at).norm() <= radius).collect()
    }

    /// The smallest patch of a base level whose rim nothing touches; `None` if
    /// an input point lies on a coarser level.
    pub fn around(grid: &Grid, base_level: u8) -> Option<Self> {
        let occupied = |level| grid.tiles().level(level).iter().any(|t| t.marks != [0; 2]);
        if (0..base_level).any(occupied) {
            return None;
        }
        let reach = tiles(grid, base_level)
            .flat_map(|id| {
                let first = grid.tiles().get(base_level, id).first();
                busy(grid, base_level, id).iter().map(move |at| (first + at).norm())
            })
            .max();
        // One more ring of leaves that stay: the rim. A patch of nothing at
        // all still has a triangle to show.
        Some(Self { base_level, radius: reach.map_or(1, |n| n as u32 + 1) })
    }
}

/// All tiles of a level.
pub(super) fn tiles(grid: &Grid, level: u8) -> impl Iterator<Item = TileId> + use<> {
    (0..grid.tiles().level(level).len()).map(TileId::new)
}

/// The hexagons of a tile that must not lie on the rim: subdivided ones,
/// everything that a template moves, and occupied ones.
fn busy(grid: &Grid, level: u8, id: TileId) -> Window {
    let view = View::of(grid, level, id);
    let classes = Classes::of(view.subdivided);
    let moved = view.subdivided.dilated() | classes.moved4() | view.occupied1 | view.occupied2.dilated();
    moved & Window::with_margin(0)
}
