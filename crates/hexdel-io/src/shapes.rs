//! From geographic features to a planar straight-line graph.
//!
//! `GeoJSON` and well-known text name the same shapes, which become a [`Pslg`] here:
//!
//! - Equal coordinates become one point (-0.0 being 0.0), equal segments one segment,
//!   so that a border drawn by two polygons is there once. Rings are closed.
//! - Markers of points and segments are the number of the first feature that has
//!   them, counted from 1.
//! - Each polygon becomes a region, a point inside of it with the feature's number as
//!   attribute, and each of its holes a hole, unless other polygons cover it.
//!
//! A polygon that lines or other polygons divide is named by its region point in one
//! of the parts only. Whether rings cross is left to whoever meshes the graph.

use std::collections::{HashMap, HashSet};

use hexdel_geom::{DVec2, Pslg, Region};

use crate::error::ReadError;
use crate::interior::{covers, interior_points};

/// The most points, so that 32-bit indices reach all of them.
const MAX_POINTS: usize = u32::MAX as usize;

/// The most steps that finding the holes covered by polygons may take: seconds.
const MAX_COVER_STEPS: u64 = 1 << 31;

/// A geometry.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    Points(Vec<DVec2>),
    Line(Vec<DVec2>),
    /// The outer ring, then those of holes.
    Polygon(Vec<Vec<DVec2>>),
    Collection(Vec<Shape>),
}

/// Gathers shapes.
pub(crate) struct GraphBuilder {
    file: String,
    pslg: Pslg,
    /// The index of each point, by its coordinates' bits.
    point_of: HashMap<[u64; 2], u32>,
    /// The segments there are, the smaller end first.
    segments: HashSet<[u32; 2]>,
    polygons: Vec<Polygon>,
    /// Features so far.
    features: i32,
}

/// A polygon with its bounding box.
struct Polygon {
    rings: Vec<Vec<DVec2>>,
    low: DVec2,
    high: DVec2,
}

impl GraphBuilder {
    pub(crate) fn new(file: &str) -> Self {
        Self {
            file: file.to_owned(),
            pslg: Pslg::default(),
            point_of: HashMap::new(),
            segments: HashSet::new(),
            polygons: Vec::new(),
            features: 0,
        }
    }

    /// Adds a feature; `line` is named if there are too many.
    pub(crate) fn feature(&mut self, shape: Shape, line: u64) -> Result<(), ReadError> {
        self.features =
            self.features.checked_add(1).ok_or_else(|| self.too_many("features", line, i32::MAX as u64))?;
        self.shape(shape, line)
    }

    fn shape(&mut self, shape: Shape, line: u64) -> Result<(), ReadError> {
        match shape {
            Shape::Points(points) => {
                for p in points {
                    self.point(p, line)?;
                }
                Ok(())
            }
            Shape::Line(line_string) => self.path(&line_string, line).map(drop),
            Shape::Polygon(rings) => self.polygon(rings, line),
            Shape::Collection(shapes) => shapes.into_iter().try_for_each(|shape| self.shape(shape, line)),
        }
    }

    fn point(&mut self, p: DVec2, line: u64) -> Result<u32, ReadError> {
        // Adding a positive zero turns -0.0 into 0.0 and keeps every other value.
        let key = [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()];
        if let Some(&index) = self.point_of.get(&key) {
            return Ok(index);
        }
        if self.pslg.points.len() >= MAX_POINTS {
            return Err(self.too_many("points", line, MAX_POINTS as u64));
        }
        let index = self.pslg.points.len() as u32;
        self.point_of.insert(key, index);
        self.pslg.points.push(p);
        self.pslg.point_markers.push(self.features);
        Ok(index)
    }

    fn path(&mut self, points: &[DVec2], line: u64) -> Result<(), ReadError> {
        let mut before = None;
        for &p in points {
            let here = self.point(p, line)?;
            if let Some(before) = before {
                self.segment(before, here);
            }
            before = Some(here);
        }
        Ok(())
    }

    fn segment(&mut self, a: u32, b: u32) {
        if a != b && self.segments.insert([a.min(b), a.max(b)]) {
            self.pslg.segments.push([a, b]);
            self.pslg.segment_markers.push(self.features);
        }
    }

    fn polygon(&mut self, mut rings: Vec<Vec<DVec2>>, line: u64) -> Result<(), ReadError> {
        for ring in &mut rings {
            if ring.first() != ring.last() {
                ring.push(ring[0]);
            }
            self.path(ring, line)?;
        }
        if rings.first().is_none_or(|outer| outer.len() <= 3) {
            return Ok(());
        }
        let Some(&point) = interior_points(&rings).first() else {
            return Ok(());
        };
        let region = Region { point, attribute: f64::from(self.features), max_area: None };
        self.pslg.regions.push(region);
        let all = || rings.iter().flatten().copied();
        let (low, high) = (all().reduce(DVec2::min), all().reduce(DVec2::max));
        if let (Some(low), Some(high)) = (low, high) {
            self.polygons.push(Polygon { rings, low, high });
        }
        Ok(())
    }

    /// The graph.
    pub(crate) fn finish(mut self) -> Result<Pslg, ReadError> {
        let mut steps = 0;
        // By their lower left, so that a search need not look at those beyond.
        self.polygons.sort_by(|a, b| a.low.x.total_cmp(&b.low.x));
        for hole in self.polygons.iter().flat_map(|p| p.rings.iter().skip(1)) {
            let candidates = interior_points(std::slice::from_ref(hole));
            for p in candidates {
                let covered = self.is_covered(p, &mut steps);
                if steps > MAX_COVER_STEPS {
                    return Err(self.too_many("steps to find covered holes", 0, MAX_COVER_STEPS));
                }
                if !covered {
                    self.pslg.holes.push(p);
                    break;
                }
            }
        }
        if self.pslg.segments.is_empty() {
            self.pslg.segment_markers.clear();
        }
        Ok(self.pslg)
    }

    /// Whether a polygon covers the point.
    fn is_covered(&self, p: DVec2, steps: &mut u64) -> bool {
        let reach = self.polygons.partition_point(|polygon| polygon.low.x <= p.x);
        *steps += reach as u64;
        self.polygons[..reach].iter().any(|polygon| {
            let inside = p.cmpge(polygon.low).all() && p.cmple(polygon.high).all();
            inside && {
                *steps += polygon.rings.iter().map(Vec::len).sum::<usize>() as u64;
                covers(&polygon.rings, p)
            }
        })
    }

    fn too_many(&self, section: &'static str, line: u64, limit: u64) -> ReadError {
        ReadError::TooMany { file: self.file.clone(), line, section, limit }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(corners: &[(i32, i32)]) -> Vec<DVec2> {
        corners.iter().map(|&(x, y)| DVec2::new(f64::from(x), f64::from(y))).collect()
    }

    fn square(x: i32, y: i32, side: i32) -> Vec<DVec2> {
        ring(&[(x, y), (x + side, y), (x + side, y + side), (x, y + side), (x, y)])
    }

    fn graph(features: Vec<Shape>) -> Pslg {
        let mut builder = GraphBuilder::new("f");
        for shape in features {
            builder.feature(shape, 1).unwrap();
        }
        let pslg = builder.finish().unwrap();
        assert_eq!(pslg.check_layout(), Ok(()));
        pslg
    }

    #[test]
    fn a_border_of_two_polygons_is_there_once() {
        let pslg = graph(vec![Shape::Polygon(vec![square(0, 0, 2)]), Shape::Polygon(vec![square(2, 0, 2)])]);
        assert_eq!(pslg.points.len(), 6);
        assert_eq!(pslg.segments.len(), 7);
        assert_eq!(pslg.segment_markers, [1, 1, 1, 1, 2, 2, 2]);
        assert_eq!(pslg.point_markers, [1, 1, 1, 1, 2, 2]);
        let regions: Vec<_> = pslg.regions.iter().map(|r| (r.point.x, r.point.y, r.attribute)).collect();
        assert_eq!(regions, [(1.0, 1.0, 1.0), (3.0, 1.0, 2.0)]);
    }

    #[test]
    fn holes_are_empty_unless_another_polygon_fills_them() {
        let frame = Shape::Polygon(vec![square(0, 0, 9), square(3, 3, 3)]);
        let pslg = graph(vec![frame.clone()]);
        assert_eq!(pslg.holes, [DVec2::splat(4.5)]);
        let pslg = graph(vec![frame.clone(), Shape::Polygon(vec![square(3, 3, 3)])]);
        assert!(pslg.holes.is_empty());
        assert_eq!(pslg.regions.len(), 2);
        // A neighbour in a corner of the hole leaves the rest of it empty.
        let corner = ring(&[(3, 3), (6, 3), (6, 5), (3, 5)]);
        let pslg = graph(vec![frame, Shape::Polygon(vec![corner])]);
        assert!(pslg.holes.iter().all(|p| p.y > 5.0), "{:?}", pslg.holes);
    }

    #[test]
    fn shapes_without_area_are_no_regions() {
        let flat = Shape::Polygon(vec![ring(&[(0, 0), (1, 0), (2, 0)])]);
        let pslg = graph(vec![flat, Shape::Polygon(vec![vec![]]), Shape::Line(ring(&[(2, 0), (2, 0)]))]);
        assert!(pslg.regions.is_empty());
        assert_eq!(pslg.segments, [[0, 1], [1, 2], [2, 0]]);
    }

    #[test]
    fn zero_has_one_sign() {
        let pslg = graph(vec![Shape::Points(vec![DVec2::ZERO, -DVec2::ZERO, DVec2::X])]);
        assert_eq!(pslg.points.len(), 2);
        assert_eq!(pslg.check_layout(), Ok(()));
    }
}
