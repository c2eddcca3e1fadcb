//! From geographic features to a planar straight-line graph.
//!
//! `GeoJSON` and well-known text name the same shapes, which become a [`Pslg`] here:
//!
//! - Equal coordinates become one point (-0.0 being 0.0), equal segments one segment,
//!   so that a border drawn by two polygons is there once. Rings are closed.
//! - Markers of points and segments are the number of the first feature that has
//!   them, counted from 1.
//! - The height of a point is the first that a geometry gives it.
//! - Each polygon becomes a [`Polygon`](hexdel_geom::Polygon) with the feature's number as attribute.
//!
//! Whether rings cross or polygons overlap is left to whoever meshes the PSLG.

use hexdel_geom::{DVec2, Pslg, PslgBuilder};

use crate::error::ReadError;

/// The most points, so that 32-bit indices reach all of them.
const MAX_POINTS: usize = u32::MAX as usize;

/// A position of a geometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) at: DVec2,
    /// The third coordinate, if there is one.
    pub(crate) height: Option<f64>,
}

/// A geometry.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    Points(Vec<Place>),
    Line(Vec<Place>),
    /// The outer ring, then those of holes.
    Polygon(Vec<Vec<Place>>),
    Collection(Vec<Shape>),
}

/// What shapes become.
#[derive(Debug)]
pub(crate) struct Features {
    pub(crate) pslg: Pslg,
    /// The height of each point, the first that is given; empty if there are no shapes.
    heights: Vec<Option<f64>>,
    /// Whether coordinates must be longitudes and latitudes by the format.
    are_degrees: bool,
}

impl From<Pslg> for Features {
    fn from(pslg: Pslg) -> Self {
        Self { pslg, heights: Vec::new(), are_degrees: false }
    }
}

impl Features {
    /// Points alone, each of its own.
    pub(crate) fn points(places: &[Place]) -> Self {
        let pslg = Pslg::from_points(places.iter().map(|place| place.at).collect());
        Self { pslg, heights: places.iter().map(|place| place.height).collect(), are_degrees: false }
    }

    /// The same if coordinates are longitudes and latitudes by the format.
    pub(crate) fn with_degrees(self, are_degrees: bool) -> Self {
        Self { are_degrees, ..self }
    }

    /// Whether coordinates are longitudes and latitudes, by the format and by what they are.
    pub(crate) fn degrees(&self) -> bool {
        let is_on_earth = |p: &DVec2| p.x.abs() <= 180.0 && p.y.abs() <= 90.0;
        self.are_degrees && self.pslg.points.iter().all(is_on_earth)
    }

    /// The heights, if each point has one and they are not all 0; an error if only some have.
    pub(crate) fn heights(&self, file: &str) -> Result<Option<Vec<f64>>, ReadError> {
        let known: Vec<f64> = self.heights.iter().copied().flatten().collect();
        if known.iter().all(|&z| z == 0.0) {
            return Ok(None);
        }
        if known.len() == self.heights.len() {
            return Ok(Some(known));
        }
        let (expected, found) = (self.heights.len() as u64, known.len() as u64);
        Err(ReadError::Length { file: file.to_owned(), line: 0, array: "heights", expected, found })
    }
}

/// Gathers shapes.
pub(crate) struct GraphBuilder {
    file: String,
    pslg: PslgBuilder,
    heights: Vec<Option<f64>>,
    /// Features so far.
    features: i32,
}

impl GraphBuilder {
    pub(crate) fn new(file: &str) -> Self {
        Self { file: file.to_owned(), pslg: PslgBuilder::new(), heights: Vec::new(), features: 0 }
    }

    /// Adds a feature; `line` is named if there are too many.
    pub(crate) fn feature(&mut self, shape: Shape, line: u64) -> Result<(), ReadError> {
        self.features =
            self.features.checked_add(1).ok_or_else(|| self.too_many("features", line, i32::MAX as u64))?;
        self.pslg.mark(self.features);
        self.shape(shape, line)
    }

    fn shape(&mut self, shape: Shape, line: u64) -> Result<(), ReadError> {
        match shape {
            Shape::Points(points) => self.points(&points, line).map(drop),
            Shape::Line(line_string) => {
                let points = self.points(&line_string, line)?;
                self.pslg.path(&points);
                Ok(())
            }
            Shape::Polygon(rings) => {
                let rings = rings.iter().map(|ring| self.points(ring, line)).collect::<Result<_, _>>()?;
                self.pslg.polygon_of(rings, f64::from(self.features));
                Ok(())
            }
            Shape::Collection(shapes) => shapes.into_iter().try_for_each(|shape| self.shape(shape, line)),
        }
    }

    /// Adds points, and says which they are.
    fn points(&mut self, places: &[Place], line: u64) -> Result<Vec<u32>, ReadError> {
        places.iter().map(|&place| self.point(place, line)).collect()
    }

    fn point(&mut self, place: Place, line: u64) -> Result<u32, ReadError> {
        let index = self.pslg.point(place.at);
        let index = index.map_err(|_| self.too_many("points", line, MAX_POINTS as u64))?;
        match self.heights.get_mut(index as usize) {
            Some(height) => *height = height.or(place.height),
            None => self.heights.push(place.height),
        }
        Ok(index)
    }

    /// The PSLG, with its heights.
    pub(crate) fn finish(self) -> Features {
        Features { pslg: self.pslg.finish(), heights: self.heights, are_degrees: false }
    }

    fn too_many(&self, section: &'static str, line: u64, limit: u64) -> ReadError {
        ReadError::TooMany { file: self.file.clone(), line, section, limit }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(corners: &[(i32, i32)]) -> Vec<Place> {
        corners.iter().map(|&(x, y)| place(DVec2::new(f64::from(x), f64::from(y)))).collect()
    }

    fn place(at: DVec2) -> Place {
        Place { at, height: None }
    }

    fn square(x: i32, y: i32, side: i32) -> Vec<Place> {
        ring(&[(x, y), (x + side, y), (x + side, y + side), (x, y + side), (x, y)])
    }

    fn graph(features: Vec<Shape>) -> Pslg {
        let mut builder = GraphBuilder::new("f");
        for shape in features {
            builder.feature(shape, 1).unwrap();
        }
        let pslg = builder.finish().pslg;
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
        let attributes = pslg.polygons.iter().map(|p| (p.attribute, &p.rings[..]));
        let expected = [(1.0, &[vec![0, 1, 2, 3]][..]), (2.0, &[vec![4, 5, 6, 1]])];
        assert!(attributes.eq(expected), "{:?}", pslg.polygons);
    }

    #[test]
    fn holes_are_rings_of_their_polygon() {
        let frame = Shape::Polygon(vec![square(0, 0, 9), square(3, 3, 3)]);
        let pslg = graph(vec![frame, Shape::Polygon(vec![square(3, 3, 3)])]);
        assert!(pslg.holes.is_empty() && pslg.regions.is_empty());
        let rings: Vec<_> = pslg.polygons.iter().flat_map(|p| p.rings.clone()).collect();
        assert_eq!(rings, [[0, 1, 2, 3], [4, 5, 6, 7], [4, 5, 6, 7]]);
    }

    #[test]
    fn shapes_without_area_are_no_polygons() {
        let flat = Shape::Polygon(vec![ring(&[(0, 0), (1, 0), (0, 0)])]);
        let pslg = graph(vec![flat, Shape::Polygon(vec![vec![]]), Shape::Line(ring(&[(2, 0), (2, 0)]))]);
        assert!(pslg.polygons.is_empty());
        assert_eq!(pslg.segments, [[0, 1]]);
    }

    #[test]
    fn heights_are_those_of_all_points_or_none() {
        let raised = |at, height| Place { at, height: Some(height) };
        let heights = |places: &[Place]| {
            let mut builder = GraphBuilder::new("f");
            builder.feature(Shape::Points(places.to_vec()), 1).unwrap();
            builder.finish().heights("f").map_err(|error| error.to_string())
        };
        let [a, b] = [place(DVec2::ZERO), raised(DVec2::X, 2.0)];
        assert_eq!(heights(&[a, b]), Err("f: 1 heights instead of 2".to_owned()));
        // The first height counts.
        let again = raised(DVec2::ZERO, 1.0);
        assert_eq!(heights(&[a, again, b, raised(DVec2::X, 3.0)]), Ok(Some(vec![1.0, 2.0])));
        assert_eq!(heights(&[a, raised(DVec2::X, 0.0)]), Ok(None));
        assert_eq!(heights(&[]), Ok(None));
    }

    #[test]
    fn zero_has_one_sign() {
        let pslg = graph(vec![Shape::Points([DVec2::ZERO, -DVec2::ZERO, DVec2::X].map(place).to_vec())]);
        assert_eq!(pslg.points.len(), 2);
        assert_eq!(pslg.check_layout(), Ok(()));
    }
}
