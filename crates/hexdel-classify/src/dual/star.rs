//! The triangles around a three-finned hexagon (paper, section 5.4).
//!
//! ```text
//!   single                         in a run, the next one counter-clockwise
//!
//!     a0---m01---a1---m12---a2        a0---m01---a1---m12---a2
//!     | \  / \   |   / \  / |         | \  / \   |   / \  / |
//!     |  P0----\-P1-/----P2 |         |  P0    \ P1 /    P2-+-- ..
//!     | / \ \______ ___/ / \|         | /  \     |     /  \ |
//!     g0   \       |    /   g2        g0----.    |    .---- C' (next)
//!       \   \      |   /   /            \     \  |  /     /
//!        `----------t-----'              `-------C--------
//!                                                t (shared)
//! ```
//!
//! `a0 a1 a2` are the scaled centres beyond the fins, `m01` and `m12` the
//! hexagons joined between them, `g0` and `g2` the right and left neighbour,
//! `t` the top. A single one loses its centre; one in a run keeps it, and the
//! point on the fin between two of a run is shared.

use super::layout::Layout;
use crate::class::Classes;
use crate::exact::Offset;
use crate::relocate::star_points;
use hexdel_geom::VertexId;
use hexdel_grid::{Direction, Hex, TileId, Window};

/// A `MovedCenter3` and its place in a run.
#[derive(Clone, Copy)]
pub(super) struct Star {
    /// The direction of the middle fin.
    pub(super) middle: Direction,
    /// Whether the run goes on on the clockwise side.
    pub(super) before: bool,
    /// Whether the run goes on on the counter-clockwise side.
    pub(super) after: bool,
}

impl Star {
    /// The star of the `MovedCenter3` at `at`; `None` for any other hexagon.
    pub(super) fn of(classes: &Classes, at: Hex) -> Option<Self> {
        let middle = Direction::ALL.into_iter().find(|d| classes.middle[d.index()].contains(at))?;
        let is_middle = |d: Direction, at| classes.middle[d.index()].contains(at);
        Some(Self {
            middle,
            before: is_middle(middle.turned(5), at.neighbour(middle.turned(4))),
            after: is_middle(middle.turned(1), at.neighbour(middle.turned(2))),
        })
    }

    pub(super) fn single(self) -> bool {
        !self.before && !self.after
    }
}

/// For each direction, the `MovedCenter3` that insert a vertex on their fin in
/// that direction. The point that two of a run share counts for the first.
pub(super) fn fins_with_vertex(classes: &Classes) -> [Window; 6] {
    let (before, _) = classes.in_run();
    std::array::from_fn(|d| {
        let first = classes.middle[(d + 1) % 6].without(before);
        first | classes.middle[d] | classes.middle[(d + 5) % 6]
    })
}

/// How many triangles the stars of a tile have.
pub(super) fn count(classes: &Classes, exists: Window) -> u32 {
    let three = classes.moved3 & exists & Window::with_margin(0);
    if three.is_empty() {
        return 0;
    }
    let (before, after) = classes.in_run();
    let single = three.without(before | after);
    let run = three.without(single);
    // Six towards the fins, always. Single: two at the ends and four inside. In
    // a run: one at each end of the run, and six around each centre, two of
    // which belong to the one before.
    let ends = run.without(before).count() + run.without(after).count();
    12 * single.count() + (6 + 4) * run.count() + 2 * run.without(before).count() + ends
}

/// Where the point lies that is inserted at place `at` of a tile, relative to
/// the tile's first hexagon.
pub(super) fn inserted_at(layout: &Layout, level: u8, id: TileId, at: Hex) -> Offset {
    let tiles = layout.grid.tiles();
    let (parent, _) = tiles.parent(level, id).expect("points are inserted below the base level");
    let classes = Classes::of(tiles.window(level - 1, parent, |t| t.subdivided));
    let first = tiles.get(level, id).first();
    let coarser = tiles.get(level - 1, parent).first();
    let (a, b) = (first + at).parents();
    let b = b.expect("a semi-hexagon has two parents");
    let Some(point) = inserted_between(&classes, a - coarser, b - coarser) else {
        unreachable!("no three-finned hexagon at {at:?} of {id:?}, level {level}")
    };
    let scaled = Offset { q: 2 * point.q, r: 2 * point.r };
    scaled + Offset::of(coarser.scaled() - first)
}

/// Where the point lies that is inserted between a subdivided hexagon and one
/// that is not, relative to the window's tile; `None` if there is none.
pub(super) fn inserted_between(classes: &Classes, a: Hex, b: Hex) -> Option<Offset> {
    [(a, b), (b, a)].into_iter().find_map(|(hex, fin)| {
        let star = Star::of(classes, hex)?;
        let i = (0..3).find(|&i| star.middle.turned(5 + i).step() == fin - hex)?;
        Some(Offset::of(hex) + star_points(star.middle, star.before, star.after)[i])
    })
}

/// Ids of the vertices around a star.
pub(super) trait Corners {
    /// The leaf at `at`, relative to the tile's first hexagon.
    fn leaf(&self, at: Hex) -> VertexId;

    /// The vertex at `at` one level finer, relative to twice the tile's first
    /// hexagon.
    fn finer(&self, at: Hex) -> VertexId;
}

/// Emits the triangles of the star at `at`.
pub(super) fn emit(star: Star, at: Hex, corners: &impl Corners, mut push: impl FnMut([VertexId; 3])) {
    let d = |by: usize| star.middle.turned(by).step();
    let fins = [5, 0, 1].map(|by| at + d(by));
    let a = fins.map(|n| corners.finer(n.scaled()));
    let m01 = corners.finer(fins[0] + fins[1]);
    let m12 = corners.finer(fins[1] + fins[2]);
    let p = [0, 1, 2].map(|i| {
        // The first point of one that continues a run is the last of the one
        // before.
        let owner = if i == 0 && star.before { at + d(4) } else { at };
        corners.finer(owner + fins[i])
    });
    let [g0, g2, top] = [4, 2, 3].map(|by| at + d(by));
    for t in [
        [p[0], a[0], m01],
        [p[0], m01, p[1]],
        [p[1], m01, a[1]],
        [p[1], a[1], m12],
        [p[1], m12, p[2]],
        [p[2], m12, a[2]],
    ] {
        push(t);
    }
    if !star.before {
        push([p[0], corners.leaf(g0), a[0]]);
    }
    if !star.after {
        push([p[2], a[2], corners.leaf(g2)]);
    }
    let (g0, g2, top) = (corners.leaf(g0), corners.leaf(g2), corners.leaf(top));
    if star.single() {
        for t in [[p[0], p[1], p[2]], [p[0], p[2], top], [p[0], top, g0], [p[2], g2, top]] {
            push(t);
        }
        return;
    }
    let c = corners.leaf(at);
    for t in [[c, p[0], p[1]], [c, p[1], p[2]], [c, p[2], g2], [c, g2, top]] {
        push(t);
    }
    if !star.before {
        push([c, top, g0]);
        push([c, g0, p[0]]);
    }
}
