//! Limits on the area of triangles, everywhere and by region.

use crate::carve::{flood, reached};
use crate::net::insert::Place;
use crate::net::{NONE, Net};
use crate::validate::Validated;
use hexdel_geom::{Circle, DVec2};

/// By triangle of the input's plane: the largest area allowed, infinite where
/// there is no limit.
pub(crate) struct AreaLimits<'a> {
    plane: &'a Net,
    by_triangle: Vec<f64>,
    /// Where there are limits at all.
    circle: Circle,
}

impl<'a> AreaLimits<'a> {
    /// `None` if there is no limit anywhere. What is carved away if `inside`
    /// has none.
    pub(crate) fn of(
        input: &'a Validated,
        everywhere: Option<f64>,
        circle: Circle,
        inside: bool,
    ) -> Option<Self> {
        let regions = &input.pslg.regions;
        if everywhere.is_none() && regions.iter().all(|r| r.max_area.is_none()) {
            return None;
        }
        let plane = &input.plane;
        let mut by_triangle = vec![f64::INFINITY; plane.tri_count() as usize];
        let mut seen = vec![false; by_triangle.len()];
        for region in regions {
            let Some(t) = plane.part_at(region.point, NONE) else { continue };
            flood(plane, vec![t], |t| {
                if let Some(area) = region.max_area
                    && !seen[t as usize]
                {
                    by_triangle[t as usize] = area;
                }
                !std::mem::replace(&mut seen[t as usize], true)
            });
        }
        for limit in &mut by_triangle {
            *limit = limit.min(everywhere.unwrap_or(f64::INFINITY));
        }
        for (limit, doomed) in by_triangle.iter_mut().zip(reached(plane, &input.pslg.holes, inside)) {
            if doomed {
                *limit = f64::INFINITY;
            }
        }
        Some(Self { plane, by_triangle, circle })
    }

    /// The triangles of a mesh that are larger than allowed where their
    /// centroids lie.
    pub(crate) fn exceeded(&self, net: &Net) -> Vec<u32> {
        let large = |&t: &u32| {
            let [a, b, c] = net.corners(t);
            0.5 * (b - a).perp_dot(c - a) > self.at((a + b + c) / 3.0)
        };
        net.alive().filter(large).collect()
    }

    /// The limit at a place.
    pub(crate) fn at(&self, p: DVec2) -> f64 {
        if p.distance(self.circle.center) > self.circle.radius {
            return f64::INFINITY;
        }
        match self.plane.locate(p, NONE) {
            Place::Inside(t) | Place::Edge(t, _) => self.by_triangle[t as usize],
            Place::Vertex(v) => self.by_triangle[self.plane.some_triangle(v) as usize],
            Place::Outside => f64::INFINITY,
        }
    }
}
