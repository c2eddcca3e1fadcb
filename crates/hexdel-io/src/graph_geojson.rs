//! PSLGs in `GeoJSON`: polygons, and what is in none of them as lines and points.
//!
//! A feature for each polygon with the properties `attribute` and, if it has a limit, `max_area`; one for each run of
//! segments of the same marker that is in no polygon, each segment beginning where the one before ends, with the property `marker`;
//! and one for each point at no segment. Outer rings are counter-clockwise, those of holes clockwise (RFC 7946).
//! When read, polygons, segments and points are the same, numbered as they come and marked by feature.

use std::io::{self, Write};

use hexdel_geom::{DVec2, Pslg};
use rustc_hash::FxHashMap;

use crate::error::WriteError;
use crate::graph_json::check_numbers;
use crate::text::TextWriter;

/// Finds what the format cannot hold.
pub(crate) fn check(pslg: &Pslg, file: &str) -> Result<(), WriteError> {
    let seeds = [("holes", pslg.holes.is_empty()), ("regions", pslg.regions.is_empty())];
    if let Some((item, _)) = seeds.into_iter().find(|(_, empty)| !empty) {
        return Err(WriteError::Seeds { file: file.to_owned(), item });
    }
    let numbers = pslg.polygons.iter().flat_map(|polygon| [Some(polygon.attribute), polygon.max_area]);
    check_numbers(numbers.map(|number| number.unwrap_or(0.0)), "attribute of polygon", file)?;
    for (polygon, rings) in pslg.polygons.iter().map(|polygon| &polygon.rings).enumerate() {
        if rings.iter().any(|ring| circuit(pslg, ring).is_none()) {
            return Err(WriteError::Ring { file: file.to_owned(), polygon });
        }
    }
    Ok(())
}

/// Writes a PSLG that has been checked.
pub(crate) fn write_geojson(out: &mut dyn Write, pslg: &Pslg) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.text("{\"type\": \"FeatureCollection\", \"features\": [");
    let features = features(pslg);
    text.rows(features, |text, feature| feature.write(text, pslg))?;
    text.text("]}\n").finish()
}

/// What becomes a feature, points by their index.
enum Feature {
    /// The polygon, and its closed rings.
    Polygon(usize, Vec<Vec<u32>>),
    /// A run of segments with its marker.
    Line(Vec<u32>, Option<i32>),
    Point(u32),
}

fn features(pslg: &Pslg) -> Vec<Feature> {
    let mut of_polygons = vec![false; pslg.segments.len()];
    let mut at_segment = vec![false; pslg.points.len()];
    pslg.segments.iter().flatten().for_each(|&point| at_segment[point as usize] = true);
    let mut all = Vec::new();
    for (index, polygon) in pslg.polygons.iter().enumerate() {
        polygon.rings.iter().flatten().for_each(|&segment| of_polygons[segment as usize] = true);
        let ring = |(i, ring): (usize, &Vec<u32>)| {
            let mut ring = circuit(pslg, ring).unwrap_or_default();
            if (doubled_area(pslg, &ring) < 0.0) == (i == 0) {
                ring.reverse();
            }
            ring
        };
        all.push(Feature::Polygon(index, polygon.rings.iter().enumerate().map(ring).collect()));
    }
    let mut run: Option<(Vec<u32>, Option<i32>)> = None;
    for (segment, &[from, to]) in pslg.segments.iter().enumerate().filter(|(s, _)| !of_polygons[*s]) {
        let marker = pslg.segment_markers.get(segment).copied();
        match &mut run {
            Some((points, of_run)) if points.last() == Some(&from) && *of_run == marker => points.push(to),
            _ => all.extend(
                run.replace((vec![from, to], marker)).map(|(points, marker)| Feature::Line(points, marker)),
            ),
        }
    }
    all.extend(run.map(|(points, marker)| Feature::Line(points, marker)));
    let alone = (0..pslg.points.len()).filter(|&point| !at_segment[point]);
    all.extend(alone.map(|point| Feature::Point(point as u32)));
    all
}

impl Feature {
    fn write(&self, text: &mut TextWriter<'_>, pslg: &Pslg) {
        text.text("{\"type\": \"Feature\", \"properties\": {");
        match self {
            Self::Polygon(index, rings) => {
                let polygon = &pslg.polygons[*index];
                text.text("\"attribute\": ").number(polygon.attribute);
                if let Some(area) = polygon.max_area {
                    text.text(", \"max_area\": ").number(area);
                }
                geometry(text, "Polygon");
                list(text, rings, |text, ring| positions(text, pslg, ring));
            }
            Self::Line(points, marker) => {
                self::marker(text, *marker);
                geometry(text, "LineString");
                positions(text, pslg, points);
            }
            Self::Point(point) => {
                self::marker(text, pslg.point_markers.get(*point as usize).copied());
                geometry(text, "Point");
                position(text, pslg.points[*point as usize]);
            }
        }
        text.text("}}");
    }
}

fn marker(text: &mut TextWriter<'_>, marker: Option<i32>) {
    if let Some(marker) = marker {
        text.text("\"marker\": ").integer(marker);
    }
}

/// Ends the properties and begins the geometry.
fn geometry(text: &mut TextWriter<'_>, kind: &str) {
    text.text("}, \"geometry\": {\"type\": \"").text(kind).text("\", \"coordinates\": ");
}

fn positions(text: &mut TextWriter<'_>, pslg: &Pslg, points: &[u32]) {
    list(text, points, |text, &point| position(text, pslg.points[point as usize]));
}

fn position(text: &mut TextWriter<'_>, p: DVec2) {
    text.text("[").number(p.x).text(", ").number(p.y).text("]");
}

fn list<T>(text: &mut TextWriter<'_>, items: &[T], write: impl Fn(&mut TextWriter<'_>, &T)) {
    text.text("[");
    for (i, item) in items.iter().enumerate() {
        text.text(if i == 0 { "" } else { ", " });
        write(text, item);
    }
    text.text("]");
}

/// The points of a ring in order, the first again at the end, given its segments in any order (Hierholzer 1873); none if
/// it is not one closed path.
fn circuit(pslg: &Pslg, ring: &[u32]) -> Option<Vec<u32>> {
    // Only looked up, never iterated.
    let mut around: FxHashMap<u32, Vec<(u32, usize)>> = FxHashMap::default();
    for (i, &segment) in ring.iter().enumerate() {
        let [a, b] = pslg.segments[segment as usize];
        around.entry(a).or_default().push((b, i));
        around.entry(b).or_default().push((a, i));
    }
    let mut used = vec![false; ring.len()];
    let mut stack = vec![pslg.segments[*ring.first()? as usize][0]];
    let mut found = Vec::with_capacity(ring.len() + 1);
    while let Some(&at) = stack.last() {
        let ways = around.get_mut(&at)?;
        while ways.last().is_some_and(|&(_, segment)| used[segment]) {
            ways.pop();
        }
        match ways.pop() {
            Some((to, segment)) => {
                used[segment] = true;
                stack.push(to);
            }
            None => found.extend(stack.pop()),
        }
    }
    (found.len() == ring.len() + 1 && found.first() == found.last()).then_some(found)
}

/// Twice the signed area of a closed ring.
fn doubled_area(pslg: &Pslg, ring: &[u32]) -> f64 {
    let at = |point: u32| pslg.points[point as usize] - pslg.points[ring[0] as usize];
    ring.windows(2).map(|pair| at(pair[0]).perp_dot(at(pair[1]))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PointFormat, read_points_from, write_points_to};
    use hexdel_geom::{Polygon, Region};

    fn written(pslg: &Pslg) -> String {
        let mut bytes = Vec::new();
        write_points_to(&mut bytes, PointFormat::GeoJson, pslg, "t").unwrap();
        String::from_utf8(bytes).unwrap()
    }

    /// A square with a hole, its rings in no order and direction; a path of two markers; a point.
    fn plate() -> Pslg {
        let corners =
            [(0, 0), (6, 0), (6, 6), (0, 6), (2, 2), (4, 2), (4, 4), (2, 4), (7, 0), (8, 1), (9, 0), (9, 9)];
        let mut pslg =
            Pslg::from_points(corners.map(|(x, y)| DVec2::new(f64::from(x), f64::from(y))).to_vec());
        pslg.segments = vec![[2, 1], [2, 3], [1, 0], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [8, 9], [9, 10]];
        pslg.segment_markers = vec![0, 0, 0, 0, 0, 0, 0, 0, 5, -6];
        pslg.polygons = vec![Polygon {
            rings: vec![vec![0, 1, 2, 3], vec![4, 6, 5, 7]],
            attribute: 1.0,
            max_area: Some(0.5),
        }];
        pslg
    }

    #[test]
    fn polygons_lines_and_points_are_features() {
        let text = written(&plate());
        let ring = "[[6.0, 0.0], [6.0, 6.0], [0.0, 6.0], [0.0, 0.0], [6.0, 0.0]]";
        let start = text.find("\"coordinates\": [[").unwrap() + 16;
        let outer = &text[start..start + ring.len()];
        // The ring begins anywhere.
        assert_eq!(outer.matches('[').count(), 6, "{outer}");
        for part in [
            "\"attribute\": 1.0, \"max_area\": 0.5",
            "{\"marker\": 5}, \"geometry\": {\"type\": \"LineString\", \"coordinates\": [[7.0, 0.0], [8.0, 1.0]]}",
            "{\"marker\": -6}, \"geometry\": {\"type\": \"LineString\", \"coordinates\": [[8.0, 1.0], [9.0, 0.0]]}",
            "{}, \"geometry\": {\"type\": \"Point\", \"coordinates\": [9.0, 9.0]}",
        ] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }

    #[test]
    fn what_is_read_back_is_the_same() {
        let before = plate();
        let after = read_points_from(written(&before).as_bytes(), PointFormat::GeoJson, "t").unwrap();
        let sorted = |mut ends: [DVec2; 2]| {
            ends.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
            ends.map(|p| p.to_array().map(f64::to_bits))
        };
        let segments = |pslg: &Pslg| {
            let mut all: Vec<_> =
                pslg.segments.iter().map(|s| sorted(s.map(|p| pslg.points[p as usize]))).collect();
            all.sort_unstable();
            all
        };
        assert_eq!(segments(&before), segments(&after));
        assert_eq!(after.points.len(), before.points.len());
        let counts = after.polygons[0].rings.iter().map(Vec::len);
        assert!(after.polygons.len() == 1 && counts.eq([4, 4]));
        // Written again it is the same text, but for the markers that features have given.
        let areas = |pslg: &Pslg| {
            let ring = |ring: &Vec<u32>| doubled_area(pslg, &circuit(pslg, ring).unwrap()).abs();
            pslg.polygons[0].rings.iter().map(ring).collect::<Vec<_>>()
        };
        assert_eq!((areas(&before), areas(&after)), (vec![72.0, 8.0], vec![72.0, 8.0]));
    }

    /// Two triangles that share a corner are one path; two apart are not.
    #[test]
    fn a_ring_may_touch_itself_but_not_fall_apart() {
        let mut pslg = Pslg::from_points(
            [(0, 0), (2, 1), (2, -1), (-2, 1), (-2, -1), (9, 9)]
                .map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)))
                .to_vec(),
        );
        pslg.segments = vec![[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0]];
        assert_eq!(circuit(&pslg, &[0, 1, 2, 3, 4, 5]).unwrap().len(), 7);
        pslg.segments = vec![[0, 1], [1, 2], [2, 0], [5, 3], [3, 4], [4, 5]];
        assert_eq!(circuit(&pslg, &[0, 1, 2, 3, 4, 5]), None);
        assert_eq!((circuit(&pslg, &[0, 1]), circuit(&pslg, &[])), (None, None));
        pslg.polygons = vec![Polygon { rings: vec![vec![0, 1, 2, 3, 4, 5]], ..Polygon::default() }];
        let error = write_points_to(&mut Vec::new(), PointFormat::GeoJson, &pslg, "t").unwrap_err();
        assert_eq!(error.to_string(), "t: a ring of polygon 0 is not one closed path");
    }

    #[test]
    fn seeds_are_refused_by_name() {
        let mut pslg = plate();
        pslg.regions = vec![Region { point: DVec2::ONE, attribute: 1.0, max_area: None }];
        let error = write_points_to(&mut Vec::new(), PointFormat::GeoJson, &pslg, "t").unwrap_err();
        assert_eq!(error.to_string(), "t: the format has polygons, not regions");
    }
}
