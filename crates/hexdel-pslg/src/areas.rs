//! Limits on the area of triangles, everywhere and by region.

use crate::carve::reached;
use crate::locator::Locator;
use crate::net::Net;
use crate::validate::Validated;
use hexdel_geom::{Circle, DVec2};

/// By triangle of the input's plane: the largest area allowed, infinite where
/// there is no limit.
pub(crate) struct AreaLimits<'a> {
    plane: Locator<'a>,
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
        let plane = Locator::of(input);
        let everywhere = everywhere.unwrap_or(f64::INFINITY);
        let limit_of = |region: Option<u32>| region.and_then(|r| regions[r as usize].max_area);
        let limit = |region| limit_of(region).map_or(everywhere, |limit| limit.min(everywhere));
        let mut by_triangle: Vec<f64> = plane.regions(input).into_iter().map(limit).collect();
        for (limit, doomed) in by_triangle.iter_mut().zip(reached(&input.plane, &input.pslg.holes, inside)) {
            if doomed {
                *limit = f64::INFINITY;
            }
        }
        Some(Self { plane, by_triangle, circle })
    }

    /// The triangles of a mesh that are larger than allowed where their
    /// centroids lie.
    pub(crate) fn exceeded(&self, net: &Net) -> Vec<u32> {
        net.alive().filter(|&t| self.excess(net.corners(t)).is_some()).collect()
    }

    /// The area of a triangle and the limit where its centroid lies, if it is
    /// larger than that.
    pub(crate) fn excess(&self, [a, b, c]: [DVec2; 3]) -> Option<[f64; 2]> {
        let (area, limit) = (0.5 * (b - a).perp_dot(c - a), self.at((a + b + c) / 3.0));
        (area > limit).then_some([area, limit])
    }

    /// The limit at a place.
    pub(crate) fn at(&self, p: DVec2) -> f64 {
        if p.distance(self.circle.center) > self.circle.radius {
            return f64::INFINITY;
        }
        self.plane.triangle_at(p).map_or(f64::INFINITY, |t| self.by_triangle[t as usize])
    }
}
