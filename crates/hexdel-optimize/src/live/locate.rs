//! The triangle that holds a point: a walk from a triangle remembered nearby.
//!
//! The memory is a grid of as many cells as seem useful, each with the
//! triangle that a walk last ended at in it. It makes walks short and
//! has no influence on where they end.

use std::collections::{BTreeSet, VecDeque};

use hexdel_geom::{DVec2, orient2d};

use crate::live::insert::Spot;
use crate::live::store::Store;
use crate::mesh::NONE;

/// Triangles per cell of the memory: walks cross some tens.
const PER_CELL: usize = 64;

/// Most cells in a row.
const MOST_CELLS: usize = 2048;

/// Where walks ended.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    low: DVec2,
    /// Cells per unit of length.
    scale: DVec2,
    cells: usize,
    /// Slots of triangles, or `NONE`; any of them may be dead by now.
    hints: Vec<u32>,
}

impl Memory {
    /// A memory with a triangle in each cell that holds a corner of one.
    pub(crate) fn new(store: &Store) -> Self {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for v in store.live_vertices() {
            (low, high) = (low.min(store.at(v)), high.max(store.at(v)));
        }
        let cells = (store.counts()[1] / PER_CELL).isqrt().clamp(1, MOST_CELLS);
        let scale = DVec2::splat(cells as f64) / (high - low).max(DVec2::splat(f64::MIN_POSITIVE));
        let mut memory = Self { low, scale, cells, hints: vec![NONE; cells * cells] };
        for v in store.live_vertices() {
            memory.remember(store.at(v), store.vertex(v).anchor);
        }
        memory
    }

    /// Whether the mesh has grown so much that walks get long.
    pub(crate) fn is_outgrown(&self, store: &Store) -> bool {
        store.counts()[1] > 4 * PER_CELL * self.cells * self.cells && self.cells < MOST_CELLS
    }

    fn cell(&self, p: DVec2) -> usize {
        // A cast of a negative number or none gives the first cell.
        let c = ((p - self.low) * self.scale).min(DVec2::splat((self.cells - 1) as f64));
        c.y as usize * self.cells + c.x as usize
    }

    fn remember(&mut self, p: DVec2, t: u32) {
        let cell = self.cell(p);
        self.hints[cell] = t;
    }

    fn hint(&self, store: &Store, p: DVec2) -> Option<u32> {
        let alive = |t: u32| store.triangles.get(t as usize).is_some_and(super::store::Triangle::alive);
        Some(self.hints[self.cell(p)]).filter(|&t| alive(t)).or_else(|| store.live_triangles().next())
    }

    /// Some triangle that holds `p`, or a side on a segment that it lies on.
    pub(crate) fn find(&self, store: &Store, p: DVec2) -> Option<u32> {
        let start = self.hint(store, p)?;
        let around = |stuck: u32| {
            let any = || store.live_triangles().find(|&t| holds(store, t, p));
            flood(store, stuck, p).or_else(|| flood(store, start, p)).or_else(any)
        };
        walk(store, start, p).map_or_else(around, Some)
    }

    /// Where `p` lies: in the triangle that holds it, of several on whose edges it
    /// lies the one in the lowest slot, or on a segment; none if it lies outside.
    ///
    /// # Complexity
    ///
    /// In proportion to the triangles between the remembered one and the
    /// point. Linear in the mesh if the point lies outside of it.
    pub(crate) fn locate(&mut self, store: &Store, p: DVec2) -> Option<Spot> {
        let found = self.find(store, p)?;
        self.remember(p, found);
        Self::spot(store, found, p)
    }

    /// The segment that `p` lies on, if any.
    pub(crate) fn line_at(&self, store: &Store, p: DVec2) -> Option<u32> {
        let spot = Self::spot(store, self.find(store, p)?, p)?;
        store.line_of_side(spot.triangle, spot.side?)
    }

    /// Where `p` lies that triangle `found` holds.
    fn spot(store: &Store, found: u32, p: DVec2) -> Option<Spot> {
        let mut nearby: Vec<u32> = Vec::new();
        for v in store.triangle(found).v {
            store.around(v, |t| nearby.push(t));
        }
        nearby.sort_unstable();
        nearby.dedup();
        let on = |&t: &u32| side_of(store, t, p).map(|k| Spot { triangle: t, side: Some(k) });
        let inside = || nearby.iter().copied().find(|&t| leaves(store, t, p).is_none());
        nearby.iter().find_map(on).or_else(|| inside().map(|triangle| Spot { triangle, side: None }))
    }
}

/// The side of `t` on a segment that `p` lies on, up to rounding.
fn side_of(store: &Store, t: u32, p: DVec2) -> Option<usize> {
    let tri = store.triangle(t);
    (0..3).filter(|_| tri.bound != 0).find(|&k| {
        let Some(line) = store.line_of_side(t, k) else { return false };
        let [a, b] = tri.side(k).map(|v| store.at(v));
        (p - a).dot(b - a) > 0.0 && (p - b).dot(a - b) > 0.0 && store.lines[line as usize].holds(p)
    })
}

/// Whether `p` lies in triangle `t`, or on one of its sides on a segment.
fn holds(store: &Store, t: u32, p: DVec2) -> bool {
    leaves(store, t, p).is_none() || side_of(store, t, p).is_some()
}

/// Triangles that are looked at around a place from which a walk found no way.
const FLOOD: usize = 2048;

/// The triangle that holds `p` among those nearest to triangle `from`: around
/// holes and bays.
fn flood(store: &Store, from: u32, p: DVec2) -> Option<u32> {
    let mut seen = BTreeSet::from([from]);
    let mut queue = VecDeque::from([from]);
    while let Some(t) = queue.pop_front().filter(|_| seen.len() < FLOOD) {
        if holds(store, t, p) {
            return Some(t);
        }
        let next = store.triangle(t).n.into_iter().filter(|&n| n != NONE);
        queue.extend(next.filter(|&n| seen.insert(n)));
    }
    None
}

/// A side of `t` that `p` lies strictly beyond, the first after side `from`.
fn leaves_after(store: &Store, t: u32, p: DVec2, from: usize) -> Option<usize> {
    let c = store.corners(t);
    (1..4).map(|i| (from + i) % 3).find(|&k| orient2d(c[(k + 1) % 3], c[(k + 2) % 3], p) < 0.0)
}

fn leaves(store: &Store, t: u32, p: DVec2) -> Option<usize> {
    leaves_after(store, t, p, 2)
}

/// Walks towards `p`; the last triangle where the walk ends at the rim. On a Delaunay
/// mesh no triangle is met twice (Edelsbrunner, "An acyclicity theorem for cell
/// complexes", 1990); the limit is for meshes that are not.
fn walk(store: &Store, start: u32, p: DVec2) -> Result<u32, u32> {
    let mut t = start;
    let mut entered = 2;
    for _ in 0..store.triangles.len() {
        let Some(k) = leaves_after(store, t, p, entered) else {
            return Ok(t);
        };
        let next = store.triangle(t).n[k];
        if next == NONE {
            return Err(t);
        }
        let back = store.triangle(next).n.iter().position(|&n| n == t);
        entered = back.unwrap_or(2);
        t = next;
    }
    Err(t)
}
