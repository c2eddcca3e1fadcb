//! Limits on the area of triangles, everywhere and by region, and on the length
//! of edges by place.

use crate::carve::reached;
use crate::error::PslgError;
use crate::locator::Locator;
use crate::net::Net;
use crate::options::{Extent, Options};
use crate::result::Reason;
use crate::sizing::scale_of;
use crate::validate::Validated;
use hexdel_geom::{Circle, DVec2};
use hexdel_grow::Size;
use hexdel_optimize::{Sizing, edge_fits, triangle_fits};
use std::fmt;

/// The largest triangle of a grid over the square of its spacing: equilateral
/// ones have 0.433, templates and the optimiser make larger ones.
const AREA_PER_SPACING_SQ: f64 = 0.75;

/// The longest edge of a grid over its spacing, or a little more, for places
/// between levels.
const EDGE_PER_SPACING: f64 = 1.5;

/// The same where points and segments are put in.
const EDGE_PER_SPACING_SEEN: f64 = 2.2;

/// Circumradius of a hexagon over its inradius, and a little more: the hexagon that
/// is meshed reaches so far beyond the circle that it holds, and by some edges.
const HEXAGON: f64 = 1.2;

/// Those edges.
const RIM_EDGES: f64 = 4.0;

/// Directions in which the size around a point is looked at.
const AROUND: usize = 12;

/// Cells along each side of the square in which triangles are counted.
const CELLS: u32 = 64;

/// What an equilateral triangle's area is over the square of its side.
const EQUILATERAL: f64 = 0.433_012_701_892_219_3;

/// Edges aimed at over those of equilateral triangles with the area allowed: areas vary less than the longest edges.
const AREA_AIM: f64 = 1.03;

/// By place: how large triangles may be, and how long edges.
pub(crate) struct Limits<'a> {
    plane: Locator<'a>,
    /// By triangle of the input's plane: the largest area allowed, infinite where
    /// there is no limit.
    by_triangle: Vec<f64>,
    /// By triangle of the input's plane: whether it is carved away.
    carved: Vec<bool>,
    size: Option<&'a dyn Sizing>,
    extent: Extent,
    /// Where there are limits on areas.
    circle: Circle,
    /// Its radius, or that of a single point's mesh.
    radius: f64,
}

impl<'a> Limits<'a> {
    /// `None` if there is no limit anywhere. What is carved away has none.
    pub(crate) fn of(
        input: &'a Validated,
        options: &Options,
        size: Option<&'a dyn Sizing>,
        circle: Circle,
    ) -> Option<Self> {
        let regions = &input.pslg.regions;
        if options.max_area.is_none() && size.is_none() && regions.iter().all(|r| r.max_area.is_none()) {
            return None;
        }
        let plane = Locator::of(input);
        let everywhere = options.max_area.unwrap_or(f64::INFINITY);
        let limit_of = |region: Option<u32>| region.and_then(|r| regions[r as usize].max_area);
        let limit = |region| limit_of(region).map_or(everywhere, |limit| limit.min(everywhere));
        let mut by_triangle: Vec<f64> = plane.regions(&input.pslg.regions).into_iter().map(limit).collect();
        let carved = reached(&input.plane, &input.pslg.holes, options.extent == Extent::Inside);
        for (limit, &doomed) in by_triangle.iter_mut().zip(&carved) {
            if doomed {
                *limit = f64::INFINITY;
            }
        }
        if size.is_none() && by_triangle.iter().all(|limit| limit.is_infinite()) {
            return None;
        }
        Some(Self {
            plane,
            by_triangle,
            carved,
            size,
            extent: options.extent,
            circle,
            radius: scale_of(circle),
        })
    }

    /// Whether there is a limit on areas anywhere.
    pub(crate) fn limits_areas(&self) -> bool {
        self.by_triangle.iter().any(|limit| limit.is_finite())
    }

    /// How long edges may be, if that is limited.
    pub(crate) fn size(&self) -> Option<&'a dyn Sizing> {
        self.size
    }

    /// The triangles of a mesh that are larger than allowed where their
    /// centroids lie, or have an edge longer than allowed.
    pub(crate) fn exceeded(&self, net: &Net) -> Vec<u32> {
        net.alive().filter(|&t| self.exceeded_by(net.corners(t)).is_some()).collect()
    }

    /// What a triangle exceeds.
    pub(crate) fn exceeded_by(&self, corners: [DVec2; 3]) -> Option<Reason> {
        let [a, b, c] = corners;
        let (area, limit) = (0.5 * (b - a).perp_dot(c - a), self.area_at((a + b + c) / 3.0));
        if area > limit {
            return Some(Reason::TooLarge { area, limit });
        }
        let size = self.size.filter(|size| !triangle_fits(*size, corners))?;
        let sides = [[a, b], [b, c], [c, a]].into_iter().filter(|[p, q]| !edge_fits(size, *p, *q));
        let longest = sides.max_by(|s, t| s[0].distance(s[1]).total_cmp(&t[0].distance(t[1])));
        longest.map(|[p, q]| Reason::TooLong { length: p.distance(q), limit: allowed(size, p, q) })
    }

    /// The largest area at a place.
    pub(crate) fn area_at(&self, p: DVec2) -> f64 {
        if p.distance(self.circle.center) > self.circle.radius {
            return f64::INFINITY;
        }
        self.plane.triangle_at(p).map_or(f64::INFINITY, |t| self.by_triangle[t as usize])
    }

    /// The longest spokes of a fan around a site: none reaches where it would be too
    /// long, and twice its largest triangle's area is less than its square.
    pub(crate) fn radius_at(&self, site: DVec2) -> f64 {
        let mut radius = self.area_at(site).sqrt();
        let Some(size) = self.size else { return radius };
        radius = radius.min(size.at(site));
        if !radius.is_finite() {
            return radius;
        }
        let directions = (0..AROUND).map(|i| std::f64::consts::TAU * i as f64 / AROUND as f64);
        for direction in directions {
            let (sin, cos) = libm::sincos(direction);
            for part in [0.5, 1.0] {
                radius = radius.min(size.at(site + part * radius * DVec2::new(cos, sin)));
            }
        }
        radius
    }

    /// The widest hexagons at a place; `is_seen` if a point or segment is so close
    /// that the place being carved away is no reason for them to be wider.
    pub(crate) fn spacing_at(&self, p: DVec2, is_seen: bool) -> f64 {
        let by_area = (self.area_at(p) / AREA_PER_SPACING_SQ).sqrt();
        let Some(size) = self.size else { return by_area };
        let length = size.at(p);
        let reach = match self.extent {
            Extent::Hexagon => HEXAGON * self.radius + RIM_EDGES * length.min(self.radius),
            _ => self.radius + length,
        };
        if p.distance(self.circle.center) > reach || (!is_seen && self.is_carved(p)) {
            return by_area;
        }
        by_area.min(length / if is_seen { EDGE_PER_SPACING_SEEN } else { EDGE_PER_SPACING })
    }

    /// The widest hexagons along the rim of a patch of such a circumradius.
    pub(crate) fn along_rim(&self, radius: f64) -> f64 {
        let Some(size) = self.size else { return f64::INFINITY };
        let corner = |i: u32| {
            let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::FRAC_PI_3);
            self.circle.center + radius * DVec2::new(cos, sin)
        };
        let places = (0..6).flat_map(|i| {
            (0..CELLS).map(move |k| corner(i).lerp(corner(i + 1), f64::from(k) / f64::from(CELLS)))
        });
        places.map(|p| size.at(p)).fold(f64::INFINITY, f64::min) / EDGE_PER_SPACING
    }

    fn is_carved(&self, p: DVec2) -> bool {
        self.plane.triangle_at(p).map_or(self.extent != Extent::Hexagon, |t| self.carved[t as usize])
    }

    /// Refuses sizes that are not positive, and those that would take too many
    /// triangles, before any is made, as far as a look at some places tells.
    pub(crate) fn check(&self, most: usize) -> Result<(), PslgError> {
        let Some(size) = self.size else { return Ok(()) };
        let cell = 2.0 * self.circle.radius / f64::from(CELLS);
        let low = self.circle.center - self.circle.radius;
        let place = |i: u32, j: u32| low + cell * DVec2::new(f64::from(i), f64::from(j));
        let (mut triangles, mut finest) = (0.0, (f64::INFINITY, self.circle.center));
        for (i, j) in (0..CELLS).flat_map(|i| (0..CELLS).map(move |j| (i, j))) {
            let middle = place(i, j) + 0.5 * cell;
            if middle.distance(self.circle.center) > self.circle.radius || self.is_carved(middle) {
                continue;
            }
            let places = [middle, place(i, j), place(i + 1, j), place(i, j + 1), place(i + 1, j + 1)];
            // What is fine in a part of the cell only counts for nothing here.
            let mut largest = 0.0_f64;
            for at in places {
                let length = positive(at, size.at(at))?;
                largest = largest.max(length);
                if length < finest.0 {
                    finest = (length, at);
                }
            }
            triangles += cell * cell / (EQUILATERAL * largest * largest);
        }
        if triangles > most as f64 {
            return Err(PslgError::too_many(most, finest.1));
        }
        Ok(())
    }
}

impl fmt::Debug for Limits<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Limits").field("size", &self.size).finish_non_exhaustive()
    }
}

impl Size for Limits<'_> {
    fn aim(&self, at: DVec2) -> f64 {
        let by_area = AREA_AIM * (self.area_at(at) / EQUILATERAL).sqrt();
        self.size.map_or(by_area, |size| by_area.min(size.at(at)))
    }

    fn excess(&self, [a, b, c]: [DVec2; 3]) -> f64 {
        let area = 0.5 * (b - a).perp_dot(c - a);
        let by_area = (area / self.area_at((a + b + c) / 3.0)).sqrt();
        let Some(size) = self.size else { return by_area };
        let by_edge = |p: DVec2, q: DVec2| p.distance(q) / allowed(size, p, q);
        by_area.max(by_edge(a, b)).max(by_edge(b, c)).max(by_edge(c, a))
    }
}

/// A length, if it is one.
pub(crate) fn positive(at: DVec2, length: f64) -> Result<f64, PslgError> {
    if length > 0.0 { Ok(length) } else { Err(PslgError::InvalidSize { at, length }) }
}

/// The length wanted of an edge.
fn allowed(size: &dyn Sizing, a: DVec2, b: DVec2) -> f64 {
    size.at(a).min(size.at(b)).min(size.at(0.5 * (a + b)))
}
