//! Planar straight-line graphs in JSON: our own, and instances of CG:SHOP 2025.
//!
//! Our own is what serde makes of a [`Pslg`]; every member but `points` may be
//! missing:
//!
//! ```text
//! {"points": [[0.0, 0.0], ..],            or "vertices"
//!  "segments": [[0, 1], ..],
//!  "holes": [[0.5, 0.5], ..],
//!  "regions": [{"point": [0.1, 0.1], "attribute": 3.0, "max_area": 0.01}, ..],
//!  "polygons": [{"rings": [[0, 1, 2], ..], "attribute": 3.0, "max_area": 0.01}, ..],
//!  "point_markers": [1, ..],              or "vertex_markers"
//!  "segment_markers": [1, ..],
//!  "point_attributes": [7.5, ..],         attributes_per_point for each point
//!  "attributes_per_point": 1}
//! ```
//!
//! An instance of CG:SHOP has coordinates in `points_x` and `points_y`, a simple
//! polygon in `region_boundary`, whose segments get marker 1, and segments inside in
//! `additional_constraints`, which get marker 2.

use std::io::{self, Write};
use std::mem::discriminant;

use hexdel_geom::{DVec2, Polygon, Pslg, Region};
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::error::{ReadError, WriteError};
use crate::geojson::read_geojson;
use crate::json::{Source, first, parse};
use crate::mend::Faults;
use crate::shapes::Features;
use crate::text::TextWriter;

/// What tells the kinds of JSON apart.
#[derive(Deserialize)]
struct Kinds {
    points_x: Option<IgnoredAny>,
    #[serde(alias = "vertices")]
    points: Option<IgnoredAny>,
    r#type: Option<IgnoredAny>,
}

/// Reads a PSLG of our own, `GeoJSON` or an instance of CG:SHOP, whatever it is.
pub(crate) fn read_any_json(source: &Source<'_>) -> Result<Features, ReadError> {
    let kinds: Kinds = first(source)?;
    if kinds.points_x.is_some() {
        read_cgshop(source).map(Features::from)
    } else if kinds.r#type.is_some() && kinds.points.is_none() {
        read_geojson(source)
    } else {
        parse::<GraphDocument>(source)?.graph(source.file).map(Features::from)
    }
}

/// [`Pslg`] with points that must be there, and with other tools' names.
#[derive(Deserialize)]
pub(crate) struct GraphDocument {
    #[serde(alias = "vertices")]
    points: Vec<DVec2>,
    #[serde(default)]
    segments: Vec<[u32; 2]>,
    #[serde(default)]
    holes: Vec<DVec2>,
    #[serde(default)]
    regions: Vec<Region>,
    #[serde(default)]
    polygons: Vec<Polygon>,
    #[serde(default, alias = "vertex_markers")]
    point_markers: Vec<i32>,
    #[serde(default)]
    segment_markers: Vec<i32>,
    #[serde(default)]
    point_attributes: Vec<f64>,
    #[serde(default)]
    attributes_per_point: usize,
}

impl GraphDocument {
    /// The PSLG, if its arrays fit together and its positions are finite.
    pub(crate) fn graph(self, file: &str) -> Result<Pslg, ReadError> {
        let pslg = Pslg {
            points: self.points,
            segments: self.segments,
            holes: self.holes,
            regions: self.regions,
            polygons: self.polygons,
            point_markers: self.point_markers,
            segment_markers: self.segment_markers,
            point_attributes: self.point_attributes,
            attributes_per_point: self.attributes_per_point,
        };
        check_graph(pslg, file)
    }
}

/// A PSLG whose arrays fit together and whose positions are finite.
fn check_graph(pslg: Pslg, file: &str) -> Result<Pslg, ReadError> {
    let mut faults = Faults::default();
    let first = pslg.layout_errors().next().map(|error| discriminant(&error));
    for source in pslg.layout_errors().filter(|error| Some(discriminant(error)) == first) {
        faults.note::<()>(Err(ReadError::Layout { file: file.to_owned(), source }))?;
    }
    faults.take()?;
    let regions: Vec<DVec2> = pslg.regions.iter().map(|r| r.point).collect();
    for (item, points) in [("point", &pslg.points), ("hole", &pslg.holes), ("region", &regions)] {
        for (p, index) in points.iter().zip(0..).filter(|(p, _)| !p.is_finite()) {
            let found = if p.x.is_finite() { p.y } else { p.x }.to_string();
            let file = file.to_owned();
            faults.note::<()>(Err(ReadError::NonFinite { file, line: 0, column: 0, item, index, found }))?;
        }
    }
    faults.take()?;
    Ok(pslg)
}

/// An instance of the challenge.
#[derive(Deserialize)]
struct Instance {
    points_x: Vec<f64>,
    points_y: Vec<f64>,
    #[serde(default)]
    region_boundary: Vec<i64>,
    #[serde(default)]
    additional_constraints: Vec<[i64; 2]>,
}

/// The marker of segments of the boundary.
const BOUNDARY: i32 = 1;

/// The marker of segments inside.
const CONSTRAINT: i32 = 2;

/// Reads an instance of CG:SHOP 2025.
pub(crate) fn read_cgshop(source: &Source<'_>) -> Result<Pslg, ReadError> {
    let instance: Instance = parse(source)?;
    let count = instance.points_x.len();
    if instance.points_y.len() != count {
        return Err(ReadError::Length {
            file: source.file.to_owned(),
            line: 0,
            array: "points_y",
            expected: count as u64,
            found: instance.points_y.len() as u64,
        });
    }
    let positions = instance.points_x.into_iter().zip(instance.points_y);
    let mut pslg = Pslg::from_points(positions.map(|(x, y)| DVec2::new(x, y)).collect());
    let boundary = &instance.region_boundary;
    let ring = boundary.iter().zip(boundary.iter().cycle().skip(1)).map(|(&a, &b)| ([a, b], BOUNDARY));
    let inner = instance.additional_constraints.iter().map(|&ends| (ends, CONSTRAINT));
    let mut faults = Faults::default();
    for (ends, marker) in ring.chain(inner) {
        let end = |index: i64| match u32::try_from(index) {
            Ok(end) if (end as usize) < count => Ok(end),
            _ => Err(ReadError::IndexOutOfRange {
                file: source.file.to_owned(),
                line: 0,
                column: 0,
                index,
                first: 0,
                points: count as u64,
            }),
        };
        let [a, b] = ends.map(end);
        // A corner of the boundary ends two segments, and is told of once.
        let b = if marker == BOUNDARY { b.or(Ok(0)) } else { b };
        let (a, b) = (faults.note(a)?, faults.note(b)?);
        pslg.segments.extend(a.zip(b).map(|(a, b)| [a, b]));
        pslg.segment_markers.push(marker);
    }
    faults.take()?;
    check_graph(pslg, source.file)
}

/// JSON has no infinities: finds the attribute that cannot be written.
pub(crate) fn check_writable(pslg: &Pslg, file: &str) -> Result<(), WriteError> {
    let attributes = pslg.point_attributes.iter().copied();
    let regions = pslg.regions.iter().flat_map(|r| [r.attribute, r.max_area.unwrap_or(0.0)]);
    let polygons = pslg.polygons.iter().flat_map(|p| [p.attribute, p.max_area.unwrap_or(0.0)]);
    check_numbers(polygons, "attribute or largest area of polygons", file)?;
    check_numbers(attributes, "attribute", file)?;
    check_numbers(regions, "attribute or largest area of regions", file)
}

/// Checks that JSON can hold all numbers.
pub(crate) fn check_numbers(
    numbers: impl Iterator<Item = f64>,
    item: &'static str,
    file: &str,
) -> Result<(), WriteError> {
    match numbers.enumerate().find(|(_, n)| !n.is_finite()) {
        None => Ok(()),
        Some((index, found)) => {
            Err(WriteError::Unrepresentable { file: file.to_owned(), format: "JSON", item, index, found })
        }
    }
}

/// The end of a region's or a polygon's object.
fn label(text: &mut TextWriter<'_>, attribute: f64, max_area: Option<f64>) {
    text.text(", \"attribute\": ").number(attribute).text(", \"max_area\": ");
    match max_area {
        Some(area) => text.number(area),
        None => text.text("null"),
    };
    text.text("}");
}

/// Writes a PSLG, an item per line.
pub(crate) fn write_graph(out: &mut dyn Write, pslg: &Pslg) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.text("{\"points\": [");
    text.rows(&pslg.points, |text, p| {
        text.position(*p);
    })?;
    text.text("],\n\"segments\": [");
    text.rows(&pslg.segments, |text, ends| {
        text.text("[").integer(ends[0]).text(", ").integer(ends[1]).text("]");
    })?;
    text.text("],\n\"holes\": [");
    text.rows(&pslg.holes, |text, p| {
        text.position(*p);
    })?;
    text.text("],\n\"regions\": [");
    text.rows(&pslg.regions, |text, region| {
        text.text("{\"point\": ").position(region.point);
        label(text, region.attribute, region.max_area);
    })?;
    if !pslg.polygons.is_empty() {
        text.text("],\n\"polygons\": [");
        text.rows(&pslg.polygons, |text, polygon| {
            let ring = |ring: &Vec<u32>| ring.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
            let rings: Vec<String> = polygon.rings.iter().map(ring).collect();
            text.text("{\"rings\": [[").text(&rings.join("], [")).text("]]");
            label(text, polygon.attribute, polygon.max_area);
        })?;
    }
    for (name, markers) in
        [("point_markers", &pslg.point_markers), ("segment_markers", &pslg.segment_markers)]
    {
        text.text("],\n\"").text(name).text("\": [");
        text.rows(markers, |text, marker| {
            text.integer(*marker);
        })?;
    }
    text.text("],\n\"point_attributes\": [");
    text.rows(&pslg.point_attributes, |text, number| {
        text.number(*number);
    })?;
    text.text("],\n\"attributes_per_point\": ").integer(pslg.attributes_per_point).text("}\n");
    text.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Pslg, ReadError> {
        read_any_json(&Source { bytes: text.as_bytes(), file: "f" }).map(|features| features.pslg)
    }

    #[test]
    fn kinds_are_told_apart() {
        let square = r#"{"content_type": "CG_SHOP_2025_Instance", "instance_uid": "s", "num_points": 4,
            "points_x": [0, 1, 1, 0], "points_y": [0, 0, 1, 1], "region_boundary": [0, 1, 2, 3],
            "num_constraints": 1, "additional_constraints": [[0, 2]]}"#;
        let pslg = read(square).unwrap();
        assert_eq!(pslg.segments, [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]);
        assert_eq!(pslg.segment_markers, [1, 1, 1, 1, 2]);
        assert_eq!(
            read(r#"{"type": "Point", "coordinates": [1, 2]}"#).unwrap().points,
            [DVec2::new(1.0, 2.0)]
        );
        let own = read(r#"{"vertices": [[1, 2], [3, 4]], "segments": [[0, 1]], "vertex_markers": [5, 6]}"#);
        let own = own.unwrap();
        assert_eq!((own.segments.len(), own.point_markers), (1, vec![5, 6]));
    }

    #[test]
    fn faults_are_named() {
        for (text, message) in [
            ("{}", "f:1:2: missing field `points`"),
            ("[", "f:1:1: EOF while parsing"),
            ("{\"points\":\n[[1]]}", "f:2:4: invalid length 1"),
            ("{\"points\": [[1, 2]], \"segments\": [[0, 1]]}", "f: segment 0 ends at point 1, of 1 points"),
            ("{\"points\": [[1, 2]], \"point_markers\": [1, 2]}", "f: point_markers has 2 entries"),
            ("{\"points_x\": [1], \"points_y\": []}", "f: 0 points_y instead of 1"),
            (
                "{\"points\": [[1, 2]], \"segments\": [[0, 1], [2, 0], [3, 4], [0, 0], [5, 6]], \"point_markers\": [1, 2]}",
                "f: segment 0 ends at point 1, of 1 points\nf: segment 1 ends at point 2, of 1 points\n\
                 f: segment 2 ends at point 3, of 1 points\nf: segment 2 ends at point 4, of 1 points\n\
                 f: segment 4 ends at point 5, of 1 points\nand 1 more of this kind",
            ),
            (
                "{\"points_x\": [1], \"points_y\": [1], \"region_boundary\": [0, 7, 8], \"additional_constraints\": [[9, 0]]}",
                "f: no point 7, there are 1 counted from 0\nf: no point 8, there are 1 counted from 0\n\
                 f: no point 9, there are 1 counted from 0",
            ),
            (
                "{\"points_x\": [1], \"points_y\": [1], \"region_boundary\": [-1]}",
                "f: no point -1, there are 1",
            ),
            (
                "{\"points_x\": [1], \"points_y\": [1],\n\"additional_constraints\": [[0, 0.5]]}",
                "f:2:34: invalid",
            ),
        ] {
            let error = read(text).unwrap_err().to_string();
            assert!(error.starts_with(message), "{error}");
        }
    }

    #[test]
    fn what_is_written_is_what_serde_reads() {
        let pslg = Pslg {
            segments: vec![[0, 1]],
            holes: vec![DVec2::new(0.5, -0.0)],
            regions: vec![
                Region { point: DVec2::ONE, attribute: 2.5, max_area: None },
                Region { point: DVec2::ONE, attribute: -1.0, max_area: Some(1e-300) },
            ],
            polygons: vec![Polygon { rings: vec![vec![0], vec![]], attribute: 1.5, max_area: Some(0.1) }],
            point_markers: vec![i32::MIN, i32::MAX],
            segment_markers: vec![-3],
            point_attributes: vec![1.0, 0.1, f64::MAX, -0.0],
            attributes_per_point: 2,
            ..Pslg::from_points(vec![DVec2::new(5e-324, 1e308), DVec2::new(0.1, -0.0)])
        };
        let mut out = Vec::new();
        write_graph(&mut out, &pslg).unwrap();
        assert_eq!(serde_json::from_slice::<Pslg>(&out).unwrap(), pslg);
        assert_eq!(read(std::str::from_utf8(&out).unwrap()).unwrap(), pslg);
        let broken = Pslg { point_attributes: vec![f64::NAN], attributes_per_point: 1, ..Pslg::default() };
        assert!(matches!(check_writable(&broken, "f"), Err(WriteError::Unrepresentable { index: 0, .. })));
    }
}
