//! `GeoJSON` (RFC 7946): reading features and bare geometries.
//!
//! All geometries are read, with the height that a third coordinate is; further coordinates,
//! properties and other members are left. A text may be a sequence of objects, one a line or each after a record
//! separator (RFC 8142). Features are numbered from 1 in the order of the file, null
//! geometries included; geometries of a collection that is no feature count each as
//! one. What becomes of them is said in [`shapes`](crate::shapes).
//!
//! `serde_json` parses the text; it bounds nesting to 128 levels and names lines. The
//! crate `geojson` keeps every property and foreign member as a tree, and its faults
//! beyond JSON's own grammar have no lines, hence these few types.

use hexdel_geom::DVec2;
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, SeqAccess, Visitor};
use std::fmt;

use crate::error::ReadError;
use crate::json::{Source, sequence};
use crate::shapes::{Features, GraphBuilder, Place, Shape};

/// Reads a text.
pub(crate) fn read_geojson(source: &Source<'_>) -> Result<Features, ReadError> {
    let mut builder = GraphBuilder::new(source.file);
    let mut has_system = false;
    sequence(source, |document: Document| {
        has_system |= document.has_system;
        let features = match document.object {
            Object::Features(features) => features,
            Object::Shape(Shape::Collection(shapes)) => shapes,
            Object::Shape(shape) => vec![shape],
        };
        features.into_iter().try_for_each(|shape| builder.feature(shape, 0))
    })?;
    Ok(builder.finish().with_degrees(!has_system))
}

/// What a text is made of: an object, and whether it names a coordinate system.
#[derive(serde::Deserialize)]
#[serde(try_from = "Members")]
struct Document {
    object: Object,
    has_system: bool,
}

impl TryFrom<Members> for Document {
    type Error = &'static str;

    fn try_from(members: Members) -> Result<Self, Self::Error> {
        let has_system = members.crs.is_some();
        Ok(Self { object: members.try_into()?, has_system })
    }
}

/// An object of `GeoJSON`.
#[derive(serde::Deserialize)]
#[serde(try_from = "Members")]
enum Object {
    Features(Vec<Shape>),
    Shape(Shape),
}

/// The members of all kinds of objects: the kind may come last.
#[derive(serde::Deserialize)]
struct Members {
    #[serde(rename = "type")]
    kind: Kind,
    #[serde(default)]
    coordinates: Option<Nested>,
    #[serde(default)]
    geometries: Option<Vec<Object>>,
    #[serde(default)]
    geometry: Option<Box<Object>>,
    #[serde(default)]
    features: Option<Vec<Object>>,
    /// The coordinate system, which is not in the standard any more.
    #[serde(default)]
    crs: Option<IgnoredAny>,
}

#[derive(Clone, Copy, PartialEq, serde::Deserialize)]
enum Kind {
    Point,
    MultiPoint,
    LineString,
    MultiLineString,
    Polygon,
    MultiPolygon,
    GeometryCollection,
    Feature,
    FeatureCollection,
}

impl TryFrom<Members> for Object {
    type Error = &'static str;

    fn try_from(members: Members) -> Result<Self, Self::Error> {
        let shapes = |objects: Vec<Self>| objects.into_iter().map(Self::shape).collect();
        Ok(match members.kind {
            Kind::FeatureCollection => {
                let features = members.features.ok_or("a FeatureCollection without features")?;
                Self::Features(shapes(features))
            }
            // A feature may have no place.
            Kind::Feature => {
                let shape = members.geometry.map_or(Shape::Collection(Vec::new()), |object| object.shape());
                Self::Features(vec![shape])
            }
            Kind::GeometryCollection => {
                let geometries = members.geometries.ok_or("a GeometryCollection without geometries")?;
                Self::Shape(Shape::Collection(shapes(geometries)))
            }
            kind => {
                let coordinates = members.coordinates.ok_or("a geometry without coordinates")?;
                Self::Shape(shape(kind, coordinates)?)
            }
        })
    }
}

impl Object {
    /// The one shape of a feature or geometry.
    fn shape(self) -> Shape {
        match self {
            Self::Shape(shape) => shape,
            Self::Features(shapes) => Shape::Collection(shapes),
        }
    }
}

fn shape(kind: Kind, coordinates: Nested) -> Result<Shape, &'static str> {
    Ok(match kind {
        Kind::Point => match coordinates {
            Nested::Position(p) => Shape::Points(vec![p]),
            // An empty position is an empty point.
            Nested::List(list) if list.is_empty() => Shape::Points(Vec::new()),
            Nested::List(_) => return Err("the coordinates of a Point are one position"),
        },
        Kind::MultiPoint => Shape::Points(positions(coordinates)?),
        Kind::LineString => Shape::Line(positions(coordinates)?),
        Kind::Polygon => Shape::Polygon(rings(coordinates)?),
        Kind::MultiLineString => {
            Shape::Collection(rings(coordinates)?.into_iter().map(Shape::Line).collect())
        }
        _ => {
            let polygons = list(coordinates)?.into_iter().map(|p| rings(p).map(Shape::Polygon));
            Shape::Collection(polygons.collect::<Result<_, _>>()?)
        }
    })
}

fn rings(nested: Nested) -> Result<Vec<Vec<Place>>, &'static str> {
    list(nested)?.into_iter().map(positions).collect()
}

fn positions(nested: Nested) -> Result<Vec<Place>, &'static str> {
    let position = |nested| match nested {
        Nested::Position(p) => Ok(p),
        Nested::List(_) => Err("coordinates are nested more deeply than the geometry's type says"),
    };
    list(nested)?.into_iter().map(position).collect()
}

fn list(nested: Nested) -> Result<Vec<Nested>, &'static str> {
    match nested {
        Nested::List(list) => Ok(list),
        Nested::Position(_) => Err("coordinates are nested less deeply than the geometry's type says"),
    }
}

/// Coordinates, whatever the kind of their geometry.
enum Nested {
    Position(Place),
    List(Vec<Nested>),
}

impl<'de> Deserialize<'de> for Nested {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match deserializer.deserialize_any(NumberOrList)? {
            Item::List(nested) => Ok(nested),
            Item::Number(_) => Err(D::Error::custom("expected an array of coordinates")),
        }
    }
}

/// An item of an array of coordinates.
enum Item {
    Number(f64),
    List(Nested),
}

struct NumberOrList;

impl<'de> Visitor<'de> for NumberOrList {
    type Value = Item;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a coordinate or an array of coordinates")
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Item, E> {
        Ok(Item::Number(number))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Item, E> {
        Ok(Item::Number(number as f64))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Item, E> {
        Ok(Item::Number(number as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Item, A::Error> {
        let first = match items.next_element::<Item>()? {
            None => return Ok(Item::List(Nested::List(Vec::new()))),
            Some(Item::List(nested)) => nested,
            Some(Item::Number(x)) => {
                let y = items.next_element()?;
                let y = y.ok_or_else(|| A::Error::custom("expected a position of two numbers"))?;
                let height = items.next_element::<Option<f64>>()?.flatten();
                while items.next_element::<IgnoredAny>()?.is_some() {}
                return Ok(Item::List(Nested::Position(Place { at: DVec2::new(x, y), height })));
            }
        };
        let mut list = vec![first];
        while let Some(nested) = items.next_element()? {
            list.push(nested);
        }
        Ok(Item::List(Nested::List(list)))
    }
}

impl<'de> Deserialize<'de> for Item {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberOrList)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::Pslg;

    fn read(text: &str) -> Result<Pslg, ReadError> {
        read_geojson(&Source { bytes: text.as_bytes(), file: "f" }).map(|features| features.pslg)
    }

    #[test]
    fn third_coordinates_are_heights() {
        let heights = |coordinates: &str| {
            let text = format!("{{\"type\":\"MultiPoint\",\"coordinates\":{coordinates}}}");
            read_geojson(&Source { bytes: text.as_bytes(), file: "f" })?.heights("f")
        };
        assert_eq!(heights("[[1,2,3],[4,5,-6.5,9]]").unwrap(), Some(vec![3.0, -6.5]));
        assert_eq!(heights("[[1,2,0],[4,5,null]]").unwrap(), None);
        assert!(heights("[[1,2,3],[4,5]]").is_err());
        let error = heights("[[1,2,\"3\"]]").unwrap_err().to_string();
        assert!(error.contains("invalid type: string"), "{error}");
    }

    #[test]
    fn geometries_of_every_kind() {
        for (geometry, points, segments, polygons) in [
            (r#"{"type":"Point","coordinates":[1,2,300]}"#, 1, 0, 0),
            (r#"{"coordinates":[],"type":"Point"}"#, 0, 0, 0),
            (r#"{"type":"MultiPoint","coordinates":[[1,2],[3,4.5],[1,2]]}"#, 2, 0, 0),
            (r#"{"coordinates":[[1,2],[3,4],[5,6]],"type":"LineString"}"#, 3, 2, 0),
            (r#"{"type":"MultiLineString","coordinates":[[[1,2],[3,4]],[[3,4],[1,2]]]}"#, 2, 1, 0),
            (r#"{"type":"Polygon","coordinates":[[[0,0],[4,0],[0,4],[0,0]]]}"#, 3, 3, 1),
            (r#"{"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[0,4],[0,0]]],[]]}"#, 3, 3, 1),
            (r#"{"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[1,2]}]}"#, 1, 0, 0),
        ] {
            let feature =
                format!(r#"{{"id":7,"geometry":{geometry},"properties":{{"a":[{{}}]}},"type":"Feature"}}"#);
            let collection =
                format!(r#"{{"type":"FeatureCollection","bbox":[1],"features":[{feature},{feature}]}}"#);
            for text in [geometry, &feature, &collection] {
                let pslg = read(text).unwrap();
                let found = (pslg.points.len(), pslg.segments.len());
                assert_eq!(found, (points, segments), "{text}");
                assert!(pslg.polygons.len() >= polygons, "{text}");
                assert!(pslg.point_markers.iter().all(|m| *m == 1), "{text}");
            }
        }
        let nowhere = r#"{"type":"FeatureCollection","features":[{"type":"Feature","geometry":null}]}"#;
        assert_eq!(read(nowhere).unwrap(), Pslg::default());
    }

    #[test]
    fn degrees_are_what_the_standard_says_unless_the_file_does() {
        let degrees = |place: &str, more: &str| {
            let text = format!("{{\"type\":\"Point\",\"coordinates\":{place}{more}}}");
            read_geojson(&Source { bytes: text.as_bytes(), file: "f" }).unwrap().degrees()
        };
        assert!(degrees("[-180,90]", "") && !degrees("[500000,50]", ""));
        assert!(!degrees("[1,2]", ",\"crs\":{\"type\":\"name\"}"));
    }

    #[test]
    fn sequences_are_read_as_one_text() {
        let features = [(0, 0), (9, 0)].map(|(x, y)| {
            format!(r#"{{"type":"Feature","geometry":{{"type":"Point","coordinates":[{x},{y}]}}}}"#)
        });
        let [a, b] = &features;
        let nowhere = r#"{"type":"Feature","geometry":null}"#;
        for text in [
            format!("{a}\n{nowhere}\n{b}\n"),
            format!("\u{1e}{a}\n\u{1e}{nowhere}\n\u{1e}{b}\n"),
            format!(r#"{{"type":"FeatureCollection","features":[{a},{nowhere}]}} {b}"#),
        ] {
            let pslg = read(&text).unwrap();
            assert_eq!(pslg.points, [DVec2::ZERO, DVec2::new(9.0, 0.0)], "{text}");
            assert_eq!(pslg.point_markers, [1, 3], "{text}");
        }
        // A fault has its line, wherever it is, and nothing else may follow.
        for text in [format!("{a}\n{{}}\n"), format!("{a}\nx\n")] {
            let error = read(&text).unwrap_err().to_string();
            assert!(error.starts_with("f:2:"), "{error}");
        }
        let error = read(&format!("{a}\n{a}\n,{b}")).unwrap_err().to_string();
        assert!(error.starts_with("f:3:1: expected value"), "{error}");
    }

    #[test]
    fn faults_have_lines() {
        for (text, message) in [
            ("", "f:1:0: EOF while parsing a value"),
            ("{}", "f:1:2: missing field `type`"),
            ("{\"type\":\n\"Circle\"}", "f:2:8: unknown variant `Circle`"),
            ("{\"type\":\"Point\",\n\"coordinates\":[1]}", "f:2:17: expected a position of two numbers"),
            ("{\"type\":\"Point\",\n\"coordinates\":[1,\"2\"]}", "f:2:20: invalid type: string \"2\""),
            ("{\"type\":\"Point\",\"coordinates\":[1,1e999]}", "f:1:38: number out of range"),
            ("{\"type\":\"Point\",\"coordinates\":[1,[2]]}", "f:1:33: invalid type: sequence"),
            ("{\"type\":\"Polygon\",\"coordinates\":[[1,2]]}", "f: coordinates are nested less"),
            ("{\"type\":\"LineString\",\"coordinates\":[[[1,2]]]}", "f: coordinates are nested more"),
            (
                "{\"type\":\"FeatureCollection\",\n\"features\":[\n{\"type\":\"Feature\",\"geometry\":\n\
              {\"type\":\"Point\"}}]}",
                "f:4:17: a geometry without coordinates",
            ),
        ] {
            let error = read(text).unwrap_err().to_string();
            assert!(error.starts_with(message), "{error}");
        }
    }

    #[test]
    fn deep_nesting_is_refused() {
        let coordinates = format!("{{\"type\":\"Point\",\"coordinates\":{}", "[".repeat(1_000_000));
        let member = format!("{{\"a\":{}", "[".repeat(1_000_000));
        let geometries = "{\"type\":\"GeometryCollection\",\"geometries\":[".repeat(100_000);
        for text in [coordinates, member, geometries] {
            assert!(matches!(read(&text), Err(ReadError::Json { .. })));
        }
    }
}
