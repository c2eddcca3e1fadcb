//! Shapefiles, `.shp`: reading points, lines and polygons, by the crate `shapefile`.
//!
//! Only the `.shp` itself is read; attributes (`.dbf`) and the coordinate system (`.prj`) are left.
//! Records are numbered from 1, empty ones included. Third coordinates are heights. A polygon
//! may have several outer rings, which are polygons of their own here; holes belong to the smallest
//! outer ring around them. What becomes of the shapes is said in [`shapes`](crate::shapes).

use std::io::Cursor;

use hexdel_geom::DVec2;
use shapefile::record::polygon::GenericPolygon;
use shapefile::{Point, PointM, PointZ, PolygonRing, ShapeReader};

use crate::error::ReadError;
use crate::json::Source;
use crate::shapes::{Features, GraphBuilder, Place, Shape};

/// Reads a file.
pub(crate) fn read_shapefile(source: &Source<'_>) -> Result<Features, ReadError> {
    let fault = |record, error: shapefile::Error| {
        let file = source.file.to_owned();
        ReadError::Shapefile { file, record, message: error.to_string() }
    };
    let mut reader = ShapeReader::new(Cursor::new(source.bytes)).map_err(|error| fault(0, error))?;
    let mut builder = GraphBuilder::new(source.file);
    for (record, shape) in (1..).zip(reader.iter_shapes()) {
        let shape = taken(shape.map_err(|error| fault(record, error))?).ok_or_else(|| {
            let what = format!("record {record}, a multipatch,");
            ReadError::Unsupported { file: source.file.to_owned(), line: 0, what }
        })?;
        check_finite(&shape, record, source.file)?;
        builder.feature(shape, 0)?;
    }
    Ok(builder.finish())
}

/// The shape of a record; `None` of a surface in space.
fn taken(shape: shapefile::Shape) -> Option<Shape> {
    use shapefile::Shape as S;
    Some(match shape {
        S::NullShape => Shape::Collection(Vec::new()),
        S::Point(p) => Shape::Points(vec![p.place()]),
        S::PointM(p) => Shape::Points(vec![p.place()]),
        S::PointZ(p) => Shape::Points(vec![p.place()]),
        S::Multipoint(points) => Shape::Points(places(points.points())),
        S::MultipointM(points) => Shape::Points(places(points.points())),
        S::MultipointZ(points) => Shape::Points(places(points.points())),
        S::Polyline(line) => lines(line.parts()),
        S::PolylineM(line) => lines(line.parts()),
        S::PolylineZ(line) => lines(line.parts()),
        S::Polygon(polygon) => polygons(&polygon),
        S::PolygonM(polygon) => polygons(&polygon),
        S::PolygonZ(polygon) => polygons(&polygon),
        S::Multipatch(_) => return None,
    })
}

/// Points of a shapefile.
trait Positioned {
    fn place(&self) -> Place;
}

impl Positioned for Point {
    fn place(&self) -> Place {
        Place { at: DVec2::new(self.x, self.y), height: None }
    }
}

impl Positioned for PointM {
    fn place(&self) -> Place {
        Place { at: DVec2::new(self.x, self.y), height: None }
    }
}

impl Positioned for PointZ {
    fn place(&self) -> Place {
        Place { at: DVec2::new(self.x, self.y), height: Some(self.z) }
    }
}

fn places<P: Positioned>(points: &[P]) -> Vec<Place> {
    points.iter().map(Positioned::place).collect()
}

fn lines<P: Positioned>(parts: &[Vec<P>]) -> Shape {
    Shape::Collection(parts.iter().map(|part| Shape::Line(places(part))).collect())
}

/// The polygons of a record, each with its holes.
fn polygons<P: Positioned>(polygon: &GenericPolygon<P>) -> Shape {
    let mut all: Vec<Vec<Vec<Place>>> = Vec::new();
    let mut holes = Vec::new();
    for ring in polygon.rings() {
        match ring {
            PolygonRing::Outer(points) => all.push(vec![places(points)]),
            PolygonRing::Inner(points) => holes.push(places(points)),
        }
    }
    for hole in holes {
        let around = (0..all.len()).filter(|&i| is_within(&hole, &all[i][0]));
        let smallest = around.min_by(|&i, &j| area(&all[i][0]).total_cmp(&area(&all[j][0])));
        match smallest {
            Some(outer) => all[outer].push(hole),
            // A hole in nothing is an area that goes around the wrong way.
            None => all.push(vec![hole]),
        }
    }
    Shape::Collection(all.into_iter().map(Shape::Polygon).collect())
}

/// Whether most corners of a ring are within another; some may be on it.
fn is_within(ring: &[Place], outer: &[Place]) -> bool {
    let inside = ring.iter().filter(|corner| winds_around(outer, corner.at)).count();
    2 * inside > ring.len()
}

/// Whether a ray to the right crosses a ring an odd number of times.
fn winds_around(ring: &[Place], p: DVec2) -> bool {
    let crossed = ring.windows(2).filter(|ends| {
        let [a, b] = [ends[0].at, ends[1].at];
        let is_beside = (a.y > p.y) != (b.y > p.y);
        is_beside && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

/// The area in a ring.
fn area(ring: &[Place]) -> f64 {
    let Some(origin) = ring.first() else { return 0.0 };
    let twice: f64 =
        ring.windows(2).map(|ends| (ends[0].at - origin.at).perp_dot(ends[1].at - origin.at)).sum();
    twice.abs() / 2.0
}

fn check_finite(shape: &Shape, record: u64, file: &str) -> Result<(), ReadError> {
    let check = |place: &Place| {
        let numbers = [Some(place.at.x), Some(place.at.y), place.height];
        match numbers.into_iter().flatten().find(|number| !number.is_finite()) {
            None => Ok(()),
            Some(bad) => Err(ReadError::NonFinite {
                file: file.to_owned(),
                line: 0,
                column: 0,
                item: "record",
                index: record,
                found: bad.to_string(),
            }),
        }
    };
    match shape {
        Shape::Points(places) | Shape::Line(places) => places.iter().try_for_each(check),
        Shape::Polygon(rings) => rings.iter().flatten().try_for_each(check),
        Shape::Collection(shapes) => shapes.iter().try_for_each(|shape| check_finite(shape, record, file)),
    }
}
