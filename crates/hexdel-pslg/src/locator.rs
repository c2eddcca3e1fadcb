//! Which triangle of the input's plane a place lies in, and which region.

use crate::carve::flood;
use crate::net::insert::Place;
use crate::net::{NONE, Net};
use crate::validate::{Validated, bounding_box};
use hexdel_geom::{DVec2, Region};

/// Starts every walk near its goal: at the triangle that the centre of a cell
/// lies in, of a grid with about as many cells as there are vertices. So what it
/// answers does not depend on what it was asked before.
pub(crate) struct Locator<'a> {
    plane: &'a Net,
    min: DVec2,
    /// Width and height of a cell, positive.
    cell: DVec2,
    side: usize,
    /// By cell, row by row: a triangle of the plane.
    start: Vec<u32>,
}

/// Cells in a row, at most.
const MOST: f64 = 1024.0;

impl<'a> Locator<'a> {
    /// # Complexity
    ///
    /// Linear in the number of vertices for evenly spread ones.
    pub(crate) fn of(input: &'a Validated) -> Self {
        let plane = &input.plane;
        let (min, max) = bounding_box(input.points.sites());
        let side = f64::from(plane.vertex_count()).sqrt().ceil().min(MOST);
        let cell = ((max - min) / side).max(DVec2::splat(f64::MIN_POSITIVE));
        let mut locator = Self { plane, min, cell, side: side as usize, start: Vec::new() };
        let mut hint = NONE;
        for y in 0..locator.side {
            // Back and forth: the next cell is beside the last.
            let mut row = vec![NONE; locator.side];
            for i in 0..locator.side {
                let x = if y % 2 == 0 { i } else { locator.side - 1 - i };
                let centre = min + cell * DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                hint = locator.walk(centre, hint).unwrap_or(hint);
                row[x] = hint;
            }
            locator.start.extend(row);
        }
        locator
    }

    /// The triangle that a place lies in, one of those it lies on the border of;
    /// `None` outside of the plane.
    pub(crate) fn triangle_at(&self, p: DVec2) -> Option<u32> {
        let most = self.side as f64 - 1.0;
        let at = ((p - self.min) / self.cell).clamp(DVec2::ZERO, DVec2::splat(most));
        self.walk(p, self.start[at.y as usize * self.side + at.x as usize])
    }

    fn walk(&self, p: DVec2, hint: u32) -> Option<u32> {
        match self.plane.locate(p, hint) {
            Place::Inside(t) | Place::Edge(t, _) => Some(t),
            Place::Vertex(v) => Some(self.plane.some_triangle(v)),
            Place::Outside => None,
        }
    }

    /// By triangle of the plane: the region it lies in; of two in the same part of
    /// the plane the first.
    pub(crate) fn regions(&self, seeds: &[Region]) -> Vec<Option<u32>> {
        let mut regions = vec![None; self.plane.tri_count() as usize];
        for (region, i) in seeds.iter().zip(0..) {
            let hint = self.triangle_at(region.point).unwrap_or(NONE);
            let Some(start) = self.plane.part_at(region.point, hint) else { continue };
            flood(self.plane, vec![start], |t| {
                let region = &mut regions[t as usize];
                region.is_none() && {
                    *region = Some(i);
                    true
                }
            });
        }
        regions
    }
}
