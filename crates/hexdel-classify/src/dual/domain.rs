//! The hexagonal patch that the mesh covers.
//!
//! Level 0 of the grid covers the whole plane. A mesh is cut out of it as a
//! regular hexagon of leaves of one *base level*: all that is coarser is left
//! away, and around what is finer lies just enough padding that the patch's rim
//! is neither subdivided nor moved. Its sides are then straight, and so is the
//! proof: nothing at the rim differs from the inside.

use super::Relocation;
use crate::class::{Classes, View};
use hexdel_grid::{Direction, Grid, Hex, TileId, Window};

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

    /// Whether nothing in a tile of the base level touches the rim.
    pub(super) fn holds(self, grid: &Grid, id: TileId) -> bool {
        let first = grid.tiles().first(self.base_level, id);
        let radius = u64::from(self.radius);
        busy(grid, self.base_level, id).iter().all(|at| (first + at).norm() < radius)
    }

    /// Steps from the centre to a corner that a patch may have, for three
    /// million triangles of padding.
    pub const MAX_RADIUS: u32 = 768;

    /// The same for a patch that nobody asked to be wide: 25,000 triangles,
    /// where each finer level only adds to them.
    const WIDEST: u32 = 64;

    /// Among the smallest patches of all base levels, the one whose mesh has
    /// the fewest triangles; the coarsest of equals.
    ///
    /// A patch of radius `n` has `6 n^2` triangles before anything in it is
    /// subdivided, and a disk gains two with each vertex: what a finer base
    /// level leaves away is counted without making the mesh.
    pub fn smallest(grid: &Grid, relocation: Relocation) -> Self {
        Self::smallest_reaching(grid, relocation, 0.0)
    }

    /// Like [`smallest`](Self::smallest), among the patches that hold the disc
    /// of radius `reach`, in input units, around the lattice's origin with at
    /// least two rings of leaves to spare. At level 0 any patch is wide enough.
    pub fn smallest_reaching(grid: &Grid, relocation: Relocation, reach: f64) -> Self {
        let mut best = (i64::MAX, Self { base_level: 0, radius: 1 });
        let mut left_away = 0;
        for level in 0..=grid.tiles().levels() as u8 {
            let Some(mut domain) = Self::around(grid, level) else {
                break;
            };
            if reach > 0.0 {
                domain.radius = domain.radius.max(radius_for(reach / grid.lattice().spacing(level)));
            }
            if domain.radius > Self::WIDEST && level > 0 {
                break;
            }
            let triangles = 6 * i64::from(domain.radius).pow(2) - left_away;
            if triangles < best.0 {
                best = (triangles, domain);
            }
            left_away += 2 * vertices_gained(grid, level, relocation);
        }
        best.1
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
                let first = grid.tiles().first(base_level, id);
                busy(grid, base_level, id).iter().map(move |at| (first + at).norm())
            })
            .max();
        // One more ring of leaves that stay: the rim. A patch of nothing at
        // all still has a triangle to show.
        Some(Self { base_level, radius: reach.map_or(1, |n| n as u32 + 1) })
    }
}

/// Steps to the corners of a patch whose sides are `reach + 2` steps away.
fn radius_for(reach: f64) -> u32 {
    // The sides of a hexagon are sqrt(3) / 2 of its corners' distance away.
    ((reach + 2.0) * 2.0 / 3.0_f64.sqrt()).ceil() as u32
}

/// All tiles of a level.
pub(super) fn tiles(grid: &Grid, level: u8) -> impl Iterator<Item = TileId> + use<> {
    (0..grid.tiles().level(level).len()).map(TileId::new)
}

/// How many vertices the subdivided hexagons of a level add: one for each pair
/// of neighbours, and those that three-finned hexagons insert.
fn vertices_gained(grid: &Grid, level: u8, relocation: Relocation) -> i64 {
    let gained = tiles(grid, level).map(|id| {
        let subdivided = grid.tiles().window(level, id, |t| t.subdivided);
        let inside = |set: Window| i64::from((set & Window::with_margin(0)).count());
        let pairs: i64 =
            [0, 1, 2].into_iter().map(|d| inside(subdivided & subdivided.at(Direction::new(d)))).sum();
        if relocation == Relocation::Occupied {
            return pairs;
        }
        let classes = Classes::of(subdivided);
        let (before, after) = classes.in_run();
        // Three points each; a single one loses its centre, one that continues
        // a run shares its first point.
        let single = classes.moved3.without(before | after);
        pairs + 3 * inside(classes.moved3) - inside(single) - inside(before)
    });
    gained.sum()
}

/// The hexagons of a tile that must not lie on the rim: subdivided ones,
/// everything that a template moves, and occupied ones.
fn busy(grid: &Grid, level: u8, id: TileId) -> Window {
    let view = View::of(grid, level, id);
    let classes = Classes::of(view.subdivided);
    let moved = view.subdivided.dilated() | classes.moved4() | view.occupied1 | view.occupied2.dilated();
    moved & Window::with_margin(0)
}
