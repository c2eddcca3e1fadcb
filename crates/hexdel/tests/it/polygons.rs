//! Polygons are areas: what the meshes of `fixtures/polygons` cover, by attribute,
//! against areas worked out by the shoelace formula.

#![cfg(feature = "io")]

use crate::common;
use hexdel::geom::Region;
use hexdel::pslg::{Feature, PslgError, Repair, Seed, Unused, ValidateError};
use hexdel::{
    DVec2, Domain, Error, Mesher, Overlaps, Pslg, PslgTriangulation, TriangleId, Warning, triangulate_pslg,
};

fn read(name: &str) -> Pslg {
    hexdel::io::read_points(common::root().join("fixtures/polygons").join(name)).unwrap()
}

fn made(name: &str) -> PslgTriangulation {
    let made = triangulate_pslg(&read(name)).unwrap();
    assert!(made.holds(), "{name}: {:?}", made.failed);
    made
}

/// Areas by attribute, in order.
fn areas(made: &PslgTriangulation) -> Vec<(f64, f64)> {
    let mut areas: Vec<(f64, f64)> = Vec::new();
    for (t, attribute) in made.region_attributes().into_iter().enumerate() {
        let [a, b, c] = made.mesh.corners(TriangleId::new(t));
        let area = 0.5 * (b - a).perp_dot(c - a);
        match areas.iter_mut().find(|entry| entry.0 == attribute) {
            Some(entry) => entry.1 += area,
            None => areas.push((attribute, area)),
        }
    }
    areas.sort_by(|a, b| a.0.total_cmp(&b.0));
    areas
}

#[track_caller]
fn hold(name: &str, expected: &[(f64, f64)]) {
    let found = areas(&made(name));
    let total: f64 = expected.iter().map(|e| e.1).sum();
    let same = |(e, f): (&(f64, f64), &(f64, f64))| e.0 == f.0 && (e.1 - f.1).abs() <= 1e-9 * total;
    let all = expected.len() == found.len() && expected.iter().zip(&found).all(same);
    assert!(all, "{name}: {expected:?} expected, {found:?} found");
}

#[test]
fn faces_belong_to_the_polygons_that_cover_them() {
    hold("nested3.geojson", &[(1.0, 42.0), (2.0, 3.0)]);
    hold("nest_half.geojson", &[(1.0, 42.0), (2.0, 9.0)]);
    hold("hole_in_hole.geojson", &[(1.0, 300.0)]);
    hold("ring_of_four.geojson", &[(1.0, 2.0), (2.0, 2.0), (3.0, 2.0), (4.0, 2.0)]);
    hold("pinched_island.geojson", &[(1.0, 91.5)]);
    hold("twice_pinched.geojson", &[(1.0, 46.0)]);
    hold("lake_river.geojson", &[(1.0, 60.0)]);
    hold("inside_overlap.geojson", &[(1.0, 96.0), (2.0, 4.0)]);
    hold("holes_share_vertex.geojson", &[(1.0, 44_642e6 - 1_902e6 - 2_260.5e6)]);
    hold("hole_touch_outer.geojson", &[(1.0, 57.0)]);
    hold("thin10.geojson", &[(1.0, 0.277_448_461_792)]);
    hold("noise27.geojson", &[(1.0, 112.313_934_909_473)]);
}

#[test]
fn graphs_of_triangle_keep_its_seeds() {
    let holes = 1_554_549.0 - 128_002.0 - 50_350.0;
    hold("rtriangle_twoholes.poly", &[(0.0, holes)]);
    hold("two_squares_corner.poly", &[(0.0, 125.0)]);
    hold("two_rects.poly", &[(1.0, 100.0), (2.0, 25.0)]);
    hold("nested_circles.poly", &[(1.0, 24.0), (2.0, 3.0)]);
    hold("reflex6.poly", &[(0.0, 0.365)]);
    hold("envelope.poly", &[(0.0, 750_000.0)]);
    for (area, least) in [(180.0, 4_166), (30.0, 25_000)] {
        let made = Mesher::new().max_area(area).triangulate_pslg(&read("envelope.poly")).unwrap();
        assert!(made.holds() && made.mesh.triangles.len() > least, "{}", made.mesh.triangles.len());
    }
}

/// Null geometries, heights, empty rings, byte order marks, rings that are clockwise or not
/// closed ..: a rectangle of 4 by 3.
#[test]
fn what_else_there_is_in_a_file_changes_nothing() {
    let files = std::fs::read_dir(common::root().join("fixtures/polygons/geojson")).unwrap();
    let mut names: Vec<String> = files.map(|f| f.unwrap().file_name().to_str().unwrap().to_owned()).collect();
    names.sort();
    assert!(names.len() > 20);
    for name in names.iter().filter(|name| *name != "bowtie.geojson") {
        let made = made(&format!("geojson/{name}"));
        let twice = ["two_adjacent.geojson", "adj_tjunction.geojson", "ndjson.geojson", "rs.geojson"]
            .contains(&name.as_str());
        let area: f64 = areas(&made).iter().map(|a| a.1).sum();
        assert!((area - if twice { 24.0 } else { 12.0 }).abs() < 1e-12, "{name}: {area}");
        let overlap = made.warnings.iter().any(|w| matches!(w, Warning::Overlap { .. }));
        assert_eq!(overlap, name == "dup_feature.geojson", "{name}: {:?}", made.warnings);
    }
}

#[test]
fn overlaps_are_warned_of_or_refused() {
    let made = made("inside_overlap.geojson");
    let [Warning::Overlap { polygons: [0, 1], attributes, at, area }] = made.warnings[..] else {
        panic!("{:?}", made.warnings)
    };
    assert!(attributes == [1.0, 2.0] && (area - 4.0).abs() < 1e-12);
    assert!(at.cmpgt(DVec2::splat(4.0)).all() && at.cmplt(DVec2::splat(6.0)).all());
    let refused = Mesher::new().overlaps(Overlaps::Refuse).triangulate_pslg(&read("inside_overlap.geojson"));
    assert!(matches!(refused, Err(Error::Overlap { polygons: [0, 1], .. })));
    let apart = Mesher::new().overlaps(Overlaps::Refuse).triangulate_pslg(&read("nested3.geojson"));
    assert!(apart.unwrap().warnings.is_empty());
}

/// A region counts where it is, as in Triangle's files, though a polygon covers it: not without a word.
#[test]
fn regions_in_polygons_are_warned_of() {
    let mut graph = read("nested3.geojson");
    let region = |x: f64, attribute| Region { point: DVec2::new(x, x), attribute, max_area: None };
    graph.regions = vec![region(0.5, 7.0), region(0.25, 7.0)];
    let made = triangulate_pslg(&graph).unwrap();
    let at = DVec2::splat(0.5);
    assert_eq!(made.warnings, [Warning::RegionInPolygon { region: 0, at, attributes: [7.0, 1.0] }]);
    assert_eq!(
        made.warnings[0].to_string(),
        "region 0 at (0.5, 0.5) lies in a polygon: its attribute 7 applies there, not 1"
    );
    let areas = areas(&made);
    assert!(areas.len() == 2 && areas[1].0 == 7.0 && (areas[1].1 - 42.0).abs() < 1e-9, "{areas:?}");
    graph.regions = vec![region(0.5, 1.0)];
    assert!(triangulate_pslg(&graph).unwrap().warnings.is_empty());
}

/// Borders of different polygons may cross; one polygon's may not.
#[test]
fn borders_that_cross_are_divided() {
    let squares = |second: [f64; 4]| {
        let [x, y, w, h] = second;
        let text = format!(
            "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0))\nPOLYGON (({x} {y}, {} {y}, {} {}, {x} {}, {x} {y}))",
            x + w,
            x + w,
            y + h,
            y + h
        );
        hexdel::io::read_points_from(text.as_bytes(), hexdel::io::PointFormat::Wkt, "f").unwrap()
    };
    // Across a corner, across two sides, along a side.
    for (second, expected, overlap) in [
        ([2.0, 2.0, 4.0, 4.0], [12.0, 16.0], 4.0),
        ([1.0, -1.0, 1.0, 6.0], [12.0, 6.0], 4.0),
        ([4.0, 1.0, 2.0, 6.0], [16.0, 12.0], 0.0),
        ([3.0, 1.0, 1.0, 1.0], [15.0, 1.0], 1.0),
    ] {
        let made = triangulate_pslg(&squares(second)).unwrap();
        assert!(made.holds());
        let found: Vec<f64> = areas(&made).iter().map(|a| a.1).collect();
        assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-12), "{second:?}: {found:?}");
        let area: f64 = made
            .warnings
            .iter()
            .map(|w| if let Warning::Overlap { area, .. } = w { *area } else { 0.0 })
            .sum();
        assert!((area - overlap).abs() < 1e-12, "{second:?}: {:?}", made.warnings);
        let divided = made.warnings.iter().any(|w| matches!(w, Warning::DividedBorders { .. }));
        assert_eq!((made.repairs.is_some(), divided), (true, true));
    }
    let crossing = triangulate_pslg(&read("geojson/bowtie.geojson"));
    assert!(matches!(crossing, Err(Error::Segments(ValidateError::Crossing { segments: [0, 2], .. }))));
    let mended = Mesher::new().repair().triangulate_pslg(&read("geojson/bowtie.geojson")).unwrap();
    assert!((areas(&mended)[0].1 - 6.0).abs() < 1e-12, "{:?}", areas(&mended));
}

/// A closed line outside of all polygons is outside; in the hull it is not.
#[test]
fn lines_enclose_nothing_where_there_are_polygons() {
    let text = "POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0), (0.5 0.5, 1.5 0.5, 1.5 1.5, 0.5 1.5, 0.5 0.5))\n\
        LINESTRING (3 0, 5 0, 5 2, 3 2, 3 0)";
    let graph = hexdel::io::read_points_from(text.as_bytes(), hexdel::io::PointFormat::Wkt, "f").unwrap();
    for (domain, expected) in [(Domain::Inside, 3.0), (Domain::Hull, 9.0)] {
        let made = Mesher::new().domain(domain).triangulate_pslg(&graph).unwrap();
        let area: f64 = areas(&made).iter().map(|a| a.1).sum();
        assert!(made.holds() && (area - expected).abs() < 1e-12, "{domain:?}: {area}");
    }
}

#[test]
fn unused_holes_and_regions_are_named() {
    let only = |made: &PslgTriangulation| match made.warnings[..] {
        [Warning::UnusedSeed(unused)] => unused,
        _ => panic!("{:?}", made.warnings),
    };
    let hole = only(&made("hole_on_segment.poly"));
    assert_eq!((hole.seed, hole.why), (Seed::Hole(0), Unused::OnSegment { segment: 7 }));
    assert_eq!(hole.at, DVec2::new(3.0, 4.5));
    let region = only(&made("region_outside.poly"));
    assert_eq!((region.seed, region.why), (Seed::Region(0), Unused::Outside));

    let mut rects = read("two_rects.poly");
    rects.regions[1].point = rects.regions[0].point + 1.0;
    let same_face = triangulate_pslg(&rects).unwrap();
    assert_eq!(only(&same_face).why, Unused::SameFace { region: 0 });
    rects.regions[1].attribute = rects.regions[0].attribute;
    assert!(triangulate_pslg(&rects).unwrap().warnings.is_empty());
    rects.holes = vec![rects.regions[0].point];
    rects.regions.truncate(1);
    assert_eq!(only(&triangulate_pslg(&rects).unwrap()).why, Unused::InHole);
    rects.holes = vec![DVec2::new(100.0, 0.0)];
    assert_eq!(only(&triangulate_pslg(&rects).unwrap()).seed, Seed::Hole(0));
    assert_eq!(only(&triangulate_pslg(&rects).unwrap()).why, Unused::Outside);
}

/// A notch is narrow on the side that is not meshed.
#[test]
fn what_is_carved_away_asks_for_nothing() {
    for (name, most) in [("notch_2deg.poly", 30), ("notch_7deg.poly", 20), ("slivergap.geojson", 8)] {
        let made = made(name);
        let (triangles, least) = (made.mesh.triangles.len(), made.certificate.min_angle_deg);
        assert!(made.exempt.is_empty() && least >= 30.0 - 1e-9, "{name}: {least}");
        assert!(triangles <= most, "{name}: {triangles}");
    }
    hold("notch_2deg.poly", &[(0.0, 3.982_544_935_072)]);
    hold("slivergap.geojson", &[(1.0, 12.0), (2.0, 11.999_999_7)]);
    // A slit of a millionth.
    hold("sliver_1e6.geojson", &[(1.0, 0.952_887_289_305)]);
}

#[test]
fn what_is_too_near_is_named_before_the_work() {
    // In the hull the gap between two borders is to be meshed.
    let hull = Mesher::new().domain(Domain::Hull).triangulate_pslg(&read("slivergap.geojson"));
    let Err(Error::Pslg(PslgError::TooMany { near: Some(near), .. })) = hull else { panic!("{hull:?}") };
    assert_eq!(near.items, [Feature::Segment(1), Feature::Segment(7)]);
    assert!((near.distance - 1e-7).abs() < 1e-15);
    let mesher = Mesher::new().domain(Domain::Hull).repair_within(2.0 * near.distance);
    let joined = mesher.triangulate_pslg(&read("slivergap.geojson")).unwrap();
    assert!(joined.holds() && joined.mesh.triangles.len() < 10);

    for (name, distance) in [("annulus_linspace.poly", 2.45e-16), ("rotated_touch.geojson", 1e-15)] {
        let error = triangulate_pslg(&read(name)).unwrap_err();
        let Error::Pslg(PslgError::TooClose { distance: Some(found), .. }) = error else { panic!("{error}") };
        assert!(found <= distance, "{name}: {found:e}");
        let mended = Mesher::new().repair().triangulate_pslg(&read(name)).unwrap();
        assert!(mended.holds() && mended.mesh.triangles.len() < 150, "{name}");
    }
}

/// Lists what repair did farther than rounding.
fn bent(made: &PslgTriangulation) -> usize {
    let far = |r: &&Repair| matches!(r, Repair::DividedAtPoint { distance, .. } if *distance > 1e-12);
    made.repairs.as_ref().map_or(0, |report| report.repairs.iter().filter(far).count())
}

/// Two counties whose common border was digitised twice: other points on it, a shift of a
/// metre to the side and along.
#[test]
fn borders_digitised_twice_are_joined() {
    let border = |k: f64| 60.0 * (k * 0.7).sin() + 25.0 * (k * 1.9).cos();
    for (dx, dy) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.7, -0.7)] {
        // Each has points between the corners that the other has not.
        let corners: Vec<DVec2> = (0..=20).map(f64::from).map(|k| DVec2::new(border(k), 100.0 * k)).collect();
        let drawn = |between: f64, shift: DVec2| -> Vec<[f64; 2]> {
            let row = corners.windows(2).flat_map(|pair| [pair[0], pair[0].lerp(pair[1], between)]);
            row.chain(corners.last().copied()).map(|p| (p + shift).to_array()).collect()
        };
        let (first, second) = (drawn(0.25, DVec2::ZERO), drawn(0.6, DVec2::new(dx, dy)));
        let ring = |border: &[[f64; 2]], x: f64| {
            let corners = border.iter().copied().chain([[x, 2000.0], [x, 0.0], border[0]]);
            corners.map(|[x, y]| format!("{x} {y}")).collect::<Vec<_>>().join(", ")
        };
        let text = format!("POLYGON (({}))\nPOLYGON (({}))", ring(&first, -1500.0), ring(&second, 1500.0));
        let graph = hexdel::io::read_points_from(text.as_bytes(), hexdel::io::PointFormat::Wkt, "f").unwrap();
        let made = Mesher::new().repair_within(3.0).triangulate_pslg(&graph).unwrap();
        assert!(made.holds(), "{dx} {dy}: {:?}", made.failed);
        let areas = areas(&made);
        // The shoelace formula on both sides of the first border.
        let strips = |p: &[[f64; 2]]| 0.5 * (p[0][0] + p[1][0]) * (p[1][1] - p[0][1]);
        let west = 3e6 + first.windows(2).map(strips).sum::<f64>();
        let total: f64 = areas.iter().map(|a| a.1).sum();
        assert!((areas[0].1 - west).abs() < 2.0 * 3.0 * 2000.0 && (total - 6e6).abs() < 2e4, "{areas:?}");
        let overlaps = made.warnings.iter().filter(|w| matches!(w, Warning::Overlap { .. })).count();
        assert_eq!((areas.len(), overlaps), (2, 0), "{dx} {dy}: {:?}", made.warnings);
        assert_eq!(made.certificate.boundary_loops, 1, "{dx} {dy}");
        assert!(bent(&made) > 3 && made.mesh.triangles.len() < 2_000, "{}", made.mesh.triangles.len());
    }
}

/// Seven points, three of them a little off a long segment.
#[test]
fn points_nearly_on_a_segment_are_put_on_it() {
    let mut hanging = Pslg::from_points(
        [(1500.0, 0.3), (-800.0, 0.0), (800.0, -250.0), (1000.0, 0.33), (780.0, -270.0), (500.0, 0.26)]
            .map(|(x, y)| DVec2::new(x, y))
            .to_vec(),
    );
    hanging.segments = vec![[0, 1]];
    let made = Mesher::new().domain(Domain::Hull).repair().triangulate_pslg(&hanging).unwrap();
    assert!(made.holds() && bent(&made) > 0, "{:?}", made.failed);
    assert!(made.mesh.triangles.len() < 1_000, "{}", made.mesh.triangles.len());
}

/// Segments that end just beyond a long one, at the hull: its edge from the long one's end would leave a
/// hundredth of a degree.
#[test]
fn ends_just_beyond_a_segment_are_put_on_it_at_the_hull() {
    let hull = Mesher::new().domain(Domain::Hull).repair();
    let mut crossing = Pslg::from_points(
        [(0.0, 0.0), (1000.0, 0.0), (999.0, -0.1), (996.0, 40.0)].map(|(x, y)| DVec2::new(x, y)).to_vec(),
    );
    crossing.segments = vec![[0, 1], [2, 3]];
    for graph in [read("near_collinear6.poly"), crossing.clone()] {
        let made = hull.triangulate_pslg(&graph).unwrap();
        assert!(made.holds() && bent(&made) == 1, "{:?}", made.failed);
        assert!(made.mesh.triangles.len() < 500, "{}", made.mesh.triangles.len());
    }
    // Elsewhere there is room enough around the crossing.
    let made = Mesher::new().domain(Domain::Hexagon).repair().triangulate_pslg(&crossing).unwrap();
    assert!(made.holds() && bent(&made) == 0, "{:?}", made.failed);
}

/// Points that are repaired keep the bounds of points.
#[test]
fn repaired_points_keep_the_bounds_of_points() {
    let mut points = common::points("plane100");
    points.push(points[7] + DVec2::new(1e-13, 0.0));
    let made = Mesher::new().repair().triangulate_pslg(&Pslg::from_points(points)).unwrap();
    assert!(made.holds() && made.certificate.min_angle_deg >= 43.89, "{}", made.certificate.min_angle_deg);
    assert_eq!(made.graph.points.len(), 100);
}
