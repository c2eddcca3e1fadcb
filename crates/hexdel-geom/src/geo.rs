//! Conversions of the shapes of the crate `geo-types` into [`Pslg`], with the feature `geo-types`.
//!
//! | from | to |
//! |---|---|
//! | a slice of [`Coord`], [`MultiPoint`] | points alone, each of its own, by [`From`] |
//! | [`Polygon`], [`MultiPolygon`] | [polygons](Pslg::polygons) with their holes, by [`TryFrom`] |
//! | [`LineString`], [`MultiLineString`] | segments |
//! | [`Geometry`], [`GeometryCollection`] | what is in them |
//!
//! But for points alone, equal coordinates become one point and equal segments one segment ([`PslgBuilder`]). The
//! attribute of a polygon is its number, from 1 in the order given. Whether rings cross or polygons overlap is left to
//! whoever meshes the PSLG.
//!
//! ```
//! use geo_types::{LineString, MultiPolygon, Polygon};
//! use hexdel_geom::Pslg;
//!
//! let ring = |x: f64, side: f64| LineString::from(vec![(x, 0.0), (x + side, 0.0), (x + side, side), (x, side)]);
//! let two = MultiPolygon::new(vec![Polygon::new(ring(0.0, 2.0), vec![]), Polygon::new(ring(2.0, 2.0), vec![])]);
//! let pslg = Pslg::try_from(&two)?;
//! assert_eq!((pslg.points.len(), pslg.segments.len()), (6, 7));
//! assert_eq!(pslg.polygons[1].attribute, 2.0);
//! # Ok::<(), hexdel_geom::PointsError>(())
//! ```

use crate::builder::PslgBuilder;
use crate::points::PointsError;
use crate::pslg::Pslg;
use geo_types::{
    Coord, Geometry, GeometryCollection, LineString, MultiLineString, MultiPoint, MultiPolygon, Polygon,
};
use glam::DVec2;

fn at(c: Coord<f64>) -> DVec2 {
    DVec2::new(c.x, c.y)
}

impl From<&[Coord<f64>]> for Pslg {
    fn from(points: &[Coord<f64>]) -> Self {
        Self::from_points(points.iter().copied().map(at).collect())
    }
}

impl From<&MultiPoint<f64>> for Pslg {
    fn from(points: &MultiPoint<f64>) -> Self {
        Self::from_points(points.iter().map(|p| at(p.0)).collect())
    }
}

/// Gathers shapes and numbers polygons.
#[derive(Default)]
struct Gathered {
    builder: PslgBuilder,
    polygons: u32,
}

/// What can be gathered.
trait Shape {
    fn put(&self, into: &mut Gathered) -> Result<(), PointsError>;
}

impl Shape for LineString<f64> {
    fn put(&self, into: &mut Gathered) -> Result<(), PointsError> {
        let points = self.0.iter().map(|&c| into.builder.point(at(c))).collect::<Result<Vec<u32>, _>>()?;
        into.builder.path(&points);
        Ok(())
    }
}

impl Shape for MultiLineString<f64> {
    fn put(&self, into: &mut Gathered) -> Result<(), PointsError> {
        self.0.iter().try_for_each(|line| line.put(into))
    }
}

impl Shape for Polygon<f64> {
    fn put(&self, into: &mut Gathered) -> Result<(), PointsError> {
        into.polygons += 1;
        let rings = std::iter::once(self.exterior()).chain(self.interiors());
        let rings = rings.map(|ring| ring.0.iter().copied().map(at));
        into.builder.polygon(rings, f64::from(into.polygons))
    }
}

impl Shape for MultiPolygon<f64> {
    fn put(&self, into: &mut Gathered) -> Result<(), PointsError> {
        self.0.iter().try_for_each(|polygon| polygon.put(into))
    }
}

impl Shape for Geometry<f64> {
    fn put(&self, into: &mut Gathered) -> Result<(), PointsError> {
        match self {
            Self::Point(point) => into.builder.point(at(point.0)).map(drop),
            Self::MultiPoint(points) => {
                points.iter().try_for_each(|point| into.builder.point(at(point.0)).map(drop))
            }
            Self::Line(line) => LineString::from(line).put(into),
            Self::LineString(line) => line.put(into),
            Self::MultiLineString(lines) => lines.put(into),
            Self::Polygon(polygon) => polygon.put(into),
            Self::MultiPolygon(polygons) => polygons.put(into),
            Self::Rect(rectangle) => rectangle.to_polygon().put(into),
            Self::Triangle(triangle) => triangle.to_polygon().put(into),
            Self::GeometryCollection(all) => all.put(into),
        }
    }
}

impl Shape for GeometryCollection<f64> {
    fn put(&self, into: &mut Gathered) -> Result<(), PointsError> {
        self.0.iter().try_for_each(|geometry| geometry.put(into))
    }
}

macro_rules! into_pslg {
    ($($shape:ident)*) => {$(
        impl TryFrom<&$shape<f64>> for Pslg {
            /// [`PointsError::TooMany`].
            type Error = PointsError;

            fn try_from(shape: &$shape<f64>) -> Result<Self, PointsError> {
                let mut gathered = Gathered::default();
                shape.put(&mut gathered)?;
                Ok(gathered.builder.finish())
            }
        }
    )*};
}

into_pslg!(LineString MultiLineString Polygon MultiPolygon Geometry GeometryCollection);

#[cfg(test)]
mod tests {
    use super::*;
    use geo_types::{Line, Point, Rect, coord};

    fn ring(x: f64, y: f64, side: f64) -> LineString<f64> {
        LineString::from(vec![(x, y), (x + side, y), (x + side, y + side), (x, y + side)])
    }

    #[test]
    fn holes_are_rings_of_their_polygon() {
        let frame = Polygon::new(ring(0.0, 0.0, 9.0), vec![ring(3.0, 3.0, 3.0)]);
        let filled = MultiPolygon::new(vec![frame, Polygon::new(ring(3.0, 3.0, 3.0), vec![])]);
        let pslg = Pslg::try_from(&filled).unwrap();
        assert!(pslg.holes.is_empty() && pslg.regions.is_empty());
        let rings: Vec<_> = pslg.polygons.iter().flat_map(|p| p.rings.clone()).collect();
        assert_eq!(rings, [[0, 1, 2, 3], [4, 5, 6, 7], [4, 5, 6, 7]]);
        assert_eq!(pslg.polygons.iter().map(|p| p.attribute).collect::<Vec<_>>(), [1.0, 2.0]);
        assert_eq!(pslg.check_layout(), Ok(()));
    }

    #[test]
    fn points_alone_keep_their_order_and_number() {
        let coordinates = [coord! { x: 1.0, y: 2.0 }, coord! { x: 1.0, y: 2.0 }, coord! { x: 0.0, y: 3.0 }];
        let expected = Pslg::from_points([(1.0, 2.0), (1.0, 2.0), (0.0, 3.0)].map(DVec2::from).to_vec());
        assert_eq!(Pslg::from(&coordinates[..]), expected);
        assert_eq!(Pslg::from(&MultiPoint::from(coordinates.map(Point).to_vec())), expected);
    }

    #[test]
    fn a_collection_has_all_that_is_in_it() {
        let [low, high] = [coord! { x: 0.0, y: 0.0 }, coord! { x: 2.0, y: 2.0 }];
        let across = Geometry::from(Line::new(low, high));
        let all = [
            Geometry::from(Rect::new(low, high)),
            across.clone(),
            across,
            Geometry::from(Point::new(1.0, 0.5)),
            Geometry::from(ring(5.0, 0.0, 1.0)),
        ];
        let pslg = Pslg::try_from(&GeometryCollection::from(all.to_vec())).unwrap();
        // The line string is not closed.
        assert_eq!((pslg.points.len(), pslg.segments.len(), pslg.polygons.len()), (9, 8, 1));
        assert_eq!(Pslg::try_from(&LineString::new(vec![])).unwrap(), Pslg::default());
    }

    #[test]
    fn empty_polygons_are_none_but_count() {
        let empty = Polygon::new(LineString::new(vec![]), vec![]);
        let two = MultiPolygon::new(vec![empty, Polygon::new(ring(0.0, 0.0, 1.0), vec![])]);
        let pslg = Pslg::try_from(&two).unwrap();
        assert_eq!(pslg.polygons.iter().map(|p| p.attribute).collect::<Vec<_>>(), [2.0]);
    }
}
