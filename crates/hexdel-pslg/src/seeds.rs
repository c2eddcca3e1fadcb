//! Holes and regions that name no part of the plane, or one that has another name.

use crate::carve::reached;
use crate::hull::convex_hull;
use crate::locator::Locator;
use crate::net::NONE;
use crate::net::insert::Place;
use crate::options::Extent;
use crate::validate::Validated;
use hexdel_geom::{DVec2, Pslg, Region, orient2d};

/// A hole or region that changes nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnusedSeed {
    /// Which.
    pub seed: Seed,
    /// Where it is.
    pub at: DVec2,
    /// Why.
    pub why: Unused,
}

/// A hole or a region, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seed {
    /// A hole.
    Hole(u32),
    /// A region.
    Region(u32),
}

/// Why a hole or region changes nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unused {
    /// It lies on a segment, which has two sides.
    OnSegment {
        /// Index of the segment.
        segment: u32,
    },
    /// It lies outside of what is meshed.
    Outside,
    /// The region lies in a hole.
    InHole,
    /// The region lies in the same part of the plane as another of a different attribute
    /// or largest area, which comes first.
    SameFace {
        /// Index of the other region.
        region: u32,
    },
}

impl std::fmt::Display for Seed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Hole(i) => write!(f, "hole {i}"),
            Self::Region(i) => write!(f, "region {i}"),
        }
    }
}

impl std::fmt::Display for UnusedSeed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} at ({}, {}) has no effect: ", self.seed, self.at.x, self.at.y)?;
        match self.why {
            Unused::OnSegment { segment } => write!(f, "it lies on segment {segment}"),
            Unused::Outside => write!(f, "it lies outside the domain"),
            Unused::InHole => write!(f, "it lies in a hole"),
            Unused::SameFace { region } => write!(f, "no segment separates it from region {region}"),
        }
    }
}

impl Validated {
    /// The holes and regions that change nothing in a mesh of such an extent, holes
    /// first. Where parts of the plane have a hole or region twice, and it makes no
    /// difference, nothing is said.
    ///
    /// # Complexity
    ///
    /// Linear in the PSLG.
    ///
    /// # Examples
    ///
    /// ```
    /// use hexdel_geom::{DVec2, Pslg};
    /// use hexdel_pslg::{Extent, validate};
    ///
    /// let mut triangle = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y]);
    /// triangle.segments = vec![[0, 1], [1, 2], [2, 0]];
    /// triangle.holes = vec![DVec2::new(0.5, 0.0), DVec2::new(0.2, 0.2)];
    /// let unused = validate(&triangle)?.unused_seeds(Extent::Inside);
    /// assert_eq!(unused[0].to_string(), "hole 0 at (0.5, 0) has no effect: it lies on segment 0");
    /// assert_eq!(unused.len(), 1);
    /// # Ok::<(), hexdel_pslg::ValidateError>(())
    /// ```
    pub fn unused_seeds(&self, extent: Extent) -> Vec<UnusedSeed> {
        if self.pslg.holes.is_empty() && self.pslg.regions.is_empty() {
            return Vec::new();
        }
        let search = Search::new(self, extent);
        let holes = self.pslg.holes.iter().zip(0..).filter_map(|(&at, i)| {
            let why = search.hole(at)?;
            Some(UnusedSeed { seed: Seed::Hole(i), at, why })
        });
        let regions = self.pslg.regions.iter().zip(0..).filter_map(|(region, i)| {
            let (at, why) = (region.point, search.region(i)?);
            Some(UnusedSeed { seed: Seed::Region(i), at, why })
        });
        holes.chain(regions).collect()
    }
}

impl Validated {
    /// The same PSLG with no effect of holes and regions outside of the extent. Where no segments
    /// part them from it, as along the convex hull, they would be seeds of what is inside.
    ///
    /// Holes are dropped, regions keep their numbers and go beyond everything.
    ///
    /// # Complexity
    ///
    /// Linear in the PSLG.
    ///
    /// # Examples
    ///
    /// ```
    /// use hexdel_geom::{DVec2, Pslg};
    /// use hexdel_pslg::{Extent, validate};
    ///
    /// let mut triangle = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y]);
    /// triangle.holes = vec![DVec2::new(0.9, 0.9), DVec2::new(0.2, 0.2)];
    /// let confined = validate(&triangle)?.confined(Extent::Hull);
    /// assert_eq!(confined.pslg().holes, [DVec2::new(0.2, 0.2)]);
    /// # Ok::<(), hexdel_pslg::ValidateError>(())
    /// ```
    #[must_use]
    pub fn confined(mut self, extent: Extent) -> Self {
        // What is outside of all segments is parted from it, and a hexagon has no outside.
        if extent != Extent::Hull || self.pslg.holes.is_empty() && self.pslg.regions.is_empty() {
            return self;
        }
        let (holes, regions) = Search::new(&self, extent).confined();
        (self.pslg.holes, self.pslg.regions) = (holes, regions);
        self
    }
}

/// How large the parts of the plane are that a mesh covers.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Areas {
    /// The area of each region, square input units; 0 of one that is not used.
    pub of_region: Vec<f64>,
    /// The area in no region; unless the extent is the inside, up to a rectangle around
    /// all points.
    pub of_none: f64,
}

impl Validated {
    /// The areas that a mesh of an extent has, but for a hexagon's: of what lies between
    /// the segments, without holes, and without the outside if `extent` is
    /// [`Extent::Inside`].
    ///
    /// # Complexity
    ///
    /// Linear in the PSLG.
    ///
    /// # Examples
    ///
    /// ```
    /// use hexdel_geom::{DVec2, Pslg, Region};
    /// use hexdel_pslg::{Extent, validate};
    ///
    /// let mut triangle = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y]);
    /// triangle.segments = vec![[0, 1], [1, 2], [2, 0]];
    /// triangle.regions = vec![Region { point: DVec2::splat(0.2), attribute: 1.0, max_area: None }];
    /// let areas = validate(&triangle)?.areas(Extent::Inside);
    /// assert_eq!((areas.of_region, areas.of_none), (vec![0.5], 0.0));
    /// # Ok::<(), hexdel_pslg::ValidateError>(())
    /// ```
    pub fn areas(&self, extent: Extent) -> Areas {
        let plane = &self.plane;
        let mut areas = Areas { of_region: vec![0.0; self.pslg.regions.len()], of_none: 0.0 };
        let carved = reached(plane, &self.pslg.holes, extent == Extent::Inside);
        let regions = Locator::of(self).regions(&self.pslg.regions);
        for t in plane.alive().filter(|&t| !carved[t as usize]) {
            let [a, b, c] = plane.corners(t);
            let area = 0.5 * (b - a).perp_dot(c - a);
            match regions[t as usize] {
                Some(region) => areas.of_region[region as usize] += area,
                None => areas.of_none += area,
            }
        }
        areas
    }
}

struct Search<'a> {
    input: &'a Validated,
    locator: Locator<'a>,
    extent: Extent,
    /// By triangle of the plane: the first region there.
    regions: Vec<Option<u32>>,
    /// By triangle of the plane: whether it is outside of all that segments enclose.
    outside: Vec<bool>,
    /// By triangle of the plane: whether it is in a hole.
    in_hole: Vec<bool>,
    hull: Vec<DVec2>,
}

impl<'a> Search<'a> {
    fn new(input: &'a Validated, extent: Extent) -> Self {
        let locator = Locator::of(input);
        let sites = input.points.sites();
        let hull = if extent == Extent::Hull { convex_hull(sites) } else { Vec::new() };
        let mut search = Self {
            input,
            locator,
            extent,
            regions: Vec::new(),
            outside: reached(&input.plane, &[], true),
            in_hole: Vec::new(),
            hull: hull.into_iter().map(|site| sites[site as usize]).collect(),
        };
        let (holes, regions) = search.confined();
        search.in_hole = reached(&input.plane, &holes, false);
        search.regions = search.locator.regions(&regions);
        search
    }

    /// The holes in the hull, if that is the extent, and the regions: those outside beyond everything.
    fn confined(&self) -> (Vec<DVec2>, Vec<Region>) {
        let Pslg { mut holes, mut regions, .. } = self.input.pslg.clone();
        if self.extent == Extent::Hull {
            let is_outside = |p: DVec2| self.triangle(p).is_ok_and(|t| self.is_outside(p, t));
            let [low, high] = [0, 2].map(|corner| self.input.plane.at(corner));
            holes.retain(|&hole| !is_outside(hole));
            regions
                .iter_mut()
                .filter(|region| is_outside(region.point))
                .for_each(|region| region.point = high + (high - low));
        }
        (holes, regions)
    }

    /// The triangle of a seed, if it is not on a segment.
    fn triangle(&self, p: DVec2) -> Result<u32, Unused> {
        let Some(start) = self.locator.triangle_at(p) else { return Err(Unused::Outside) };
        if let Some(t) = self.input.plane.part_at(p, start) {
            return Ok(t);
        }
        Err(self.segment_at(p, start).map_or(Unused::Outside, |segment| Unused::OnSegment { segment }))
    }

    /// A segment through a point.
    fn segment_at(&self, p: DVec2, start: u32) -> Option<u32> {
        let plane = &self.input.plane;
        let piece = match plane.locate(p, start) {
            Place::Edge(t, i) => plane.tri(t).s[i],
            Place::Vertex(v) => {
                let mut star = Vec::new();
                plane.star(v, &mut star);
                let sides = star.iter().flat_map(|&t| (0..3).map(move |i| (t, i)));
                let mut pieces =
                    sides.filter(|&(t, i)| plane.tri(t).v[i] != v).map(|(t, i)| plane.tri(t).s[i]);
                pieces.find(|&piece| piece != NONE)?
            }
            _ => NONE,
        };
        self.input.pieces.get(piece as usize).map(|piece| piece.segment)
    }

    fn is_outside(&self, p: DVec2, t: u32) -> bool {
        match self.extent {
            Extent::Hexagon => false,
            Extent::Inside => self.outside[t as usize],
            Extent::Hull => {
                let sides =
                    (0..self.hull.len()).map(|i| [self.hull[i], self.hull[(i + 1) % self.hull.len()]]);
                sides.into_iter().any(|[a, b]| orient2d(a, b, p) < 0.0)
            }
        }
    }

    fn hole(&self, at: DVec2) -> Option<Unused> {
        match self.triangle(at) {
            Ok(t) => self.is_outside(at, t).then_some(Unused::Outside),
            // Beyond the plane's rectangle all is one with the rim.
            Err(Unused::Outside) if self.extent == Extent::Hexagon => None,
            Err(why) => Some(why),
        }
    }

    fn region(&self, index: u32) -> Option<Unused> {
        let regions = &self.input.pslg.regions;
        let region = regions[index as usize];
        let t = match self.triangle(region.point) {
            Ok(t) => t,
            Err(Unused::Outside) if self.extent == Extent::Hexagon => return None,
            Err(why) => return Some(why),
        };
        if self.is_outside(region.point, t) {
            return Some(Unused::Outside);
        }
        if self.in_hole[t as usize] {
            return Some(Unused::InHole);
        }
        let first = self.regions[t as usize]?;
        let label = |r: u32| (regions[r as usize].attribute, regions[r as usize].max_area);
        (label(first) != label(index)).then_some(Unused::SameFace { region: first })
    }
}
