//! Polygons in every domain, and warnings in the numbers of the PSLG given.

#![cfg(feature = "io")]

use hexdel::geom::{Polygon, Region};
use hexdel::pslg::{Seed, Unused};
use hexdel::{DVec2, Domain, Mesher, Pslg, PslgTriangulation, TriangleId, Warning, triangulate_pslg};

const DOMAINS: [Domain; 4] = [Domain::Inside, Domain::Hull, Domain::Box, Domain::Hexagon];

/// A square of 4 by 4 with a hole of 2 by 2, of attribute 1, and apart from it a square of 2 by 2, of
/// attribute 2.
fn apart() -> Pslg {
    let square = |x: f64, y: f64, side: f64| {
        [(x, y), (x + side, y), (x + side, y + side), (x, y + side)].map(DVec2::from)
    };
    let corners = [square(0.0, 0.0, 4.0), square(1.0, 1.0, 2.0), square(6.0, 0.0, 2.0)];
    let mut graph = Pslg::from_points(corners.concat());
    graph.segments = (0..12).map(|i: u32| [i, i - i % 4 + (i + 1) % 4]).collect();
    let ring = |first: u32| (first..first + 4).collect::<Vec<u32>>();
    graph.polygons = vec![
        Polygon { rings: vec![ring(0), ring(4)], attribute: 1.0, max_area: None },
        Polygon { rings: vec![ring(8)], attribute: 2.0, max_area: None },
    ];
    graph
}

/// The area of the triangles of an attribute.
fn area(made: &PslgTriangulation, attribute: f64) -> f64 {
    let of = made.region_attributes().into_iter().enumerate().filter(|a| a.1 == attribute);
    let area = |[a, b, c]: [DVec2; 3]| 0.5 * (b - a).perp_dot(c - a);
    of.map(|(t, _)| area(made.mesh.corners(TriangleId::new(t)))).sum()
}

#[test]
fn polygons_are_meshed_in_every_domain() {
    let graph = apart();
    // What is around the polygons: nothing; the hull without both and the hole; the box of 9.6 by 5.6 without them.
    let around = [0.0, 8.0, 9.6 * 5.6 - 20.0];
    for (i, domain) in DOMAINS.into_iter().enumerate() {
        let made = Mesher::new().domain(domain).triangulate_pslg(&graph).unwrap();
        assert!(
            made.holds() && made.warnings.is_empty(),
            "{domain:?}: {:?} {:?}",
            made.failed,
            made.warnings
        );
        let found = [1.0, 2.0].map(|attribute| area(&made, attribute));
        assert!((found[0] - 12.0).abs() < 1e-12 && (found[1] - 4.0).abs() < 1e-12, "{domain:?}: {found:?}");
        let rest = area(&made, 0.0);
        match around.get(i) {
            Some(expected) => assert!((rest - expected).abs() < 1e-12, "{domain:?}: {rest}"),
            None => assert!(rest > 34.0, "{rest}"),
        }
        assert_eq!((made.certificate.inputs, made.certificate.inputs_kept), (12, 12), "{domain:?}");
    }
}

/// A hole beside the PSLG takes the box away.
#[test]
fn a_hole_outside_leaves_nothing_of_the_box() {
    let mut graph = apart();
    graph.holes = vec![DVec2::new(5.0, 3.0)];
    for graph in [graph.clone(), Pslg { polygons: Vec::new(), ..graph }] {
        let made = Mesher::new().domain(Domain::Box).triangulate_pslg(&graph).unwrap();
        assert!(made.holds() && made.warnings.is_empty(), "{:?} {:?}", made.failed, made.warnings);
        let total: f64 = [0.0, 1.0, 2.0].map(|attribute| area(&made, attribute)).iter().sum();
        let expected = if graph.holes.len() > 1 { 20.0 } else { total };
        assert!((total - expected).abs() < 1e-12 && total < 20.5, "{total}");
        assert_eq!((made.certificate.inputs, made.certificate.inputs_kept), (12, 12));
    }
}

/// Repair divides the first segment, so that those after it have other numbers in the PSLG that is meshed.
#[test]
fn unused_seeds_name_the_segments_given() {
    let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (2.0, 0.0), (2.0, 2.0)];
    let mut graph = Pslg::from_points(corners.map(DVec2::from).to_vec());
    // The first two segments are the same, and one of them is dropped.
    graph.segments = vec![[0, 1], [1, 0], [1, 2], [2, 3], [3, 0], [4, 5]];
    graph.holes = vec![DVec2::new(2.0, 1.0)];
    graph.regions = vec![Region { point: DVec2::new(3.0, 4.0), attribute: 1.0, max_area: None }];
    let expected = [(Seed::Hole(0), 5), (Seed::Region(0), 3)];
    for mesher in [Mesher::new(), Mesher::new().repair()] {
        let made = mesher.triangulate_pslg(&graph).unwrap();
        let named: Vec<(Seed, u32)> = made
            .warnings
            .iter()
            .map(|warning| match warning {
                Warning::UnusedSeed(unused) => match unused.why {
                    Unused::OnSegment { segment } => (unused.seed, segment),
                    why => panic!("{why:?}"),
                },
                other => panic!("{other}"),
            })
            .collect();
        assert_eq!(named, expected, "{:?}", made.warnings);
    }
}

/// The side of the box is no segment of the PSLG.
#[test]
fn a_seed_on_the_box_is_outside() {
    let mut graph = apart();
    graph.holes = vec![DVec2::new(-0.8, 0.0)];
    let made = Mesher::new().domain(Domain::Box).triangulate_pslg(&graph).unwrap();
    let [Warning::UnusedSeed(unused)] = made.warnings[..] else { panic!("{:?}", made.warnings) };
    assert_eq!((unused.seed, unused.why), (Seed::Hole(0), Unused::Outside));
}

#[test]
fn divided_borders_are_counted_in_words_that_fit() {
    let squares = |text: &str| {
        hexdel::io::read_points_from(text.as_bytes(), hexdel::io::PointFormat::Wkt, "f").unwrap()
    };
    let told = |text: &str| {
        let made = triangulate_pslg(&squares(text)).unwrap();
        let divided = |w: &&Warning| matches!(w, Warning::DividedBorders { .. });
        made.warnings.iter().find(divided).unwrap().to_string()
    };
    let first = "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0))";
    let line = |x: i32| format!("LINESTRING ({x} -1, {x} 2)");
    for (lines, expected) in [
        (1, "borders of polygons were divided at (1, 0), where they cross or run along each other"),
        (
            2,
            "borders of polygons were divided at (1, 0) and 1 other place, where they cross or run along each other",
        ),
        (
            3,
            "borders of polygons were divided at (1, 0) and 2 other places, where they cross or run along each other",
        ),
    ] {
        let text = (1..=lines).fold(first.to_owned(), |text, x| text + "\n" + &line(x));
        assert_eq!(told(&text), expected);
    }
}

/// Found by fuzzing: beside the hull, which no segments part from its outside, holes and regions were said
/// to be unused, and had the mesh made as if they were not.
#[test]
fn seeds_beside_the_hull_change_nothing() {
    let mut graph =
        Pslg::from_points([(7.0, 7.0), (0.0, 0.0), (7.375, -0.5), (7.4375, 0.0)].map(DVec2::from).to_vec());
    graph.segments = vec![[3, 1]];
    let mesher = Mesher::new().domain(Domain::Hull);
    let without = mesher.triangulate_pslg(&graph).unwrap();
    graph.holes = vec![DVec2::new(7.3, 7.1)];
    let region = |x, y, max_area| Region { point: DVec2::new(x, y), attribute: 3.0, max_area };
    graph.regions = vec![region(7.1, 7.3, Some(0.1)), region(6.0, 1.0, None)];
    let made = mesher.triangulate_pslg(&graph).unwrap();
    assert!(made.holds() && made.warnings.len() == 2, "{:?} {:?}", made.failed, made.warnings);
    assert_eq!(made.mesh, without.mesh);
    assert!(made.region_of_triangle.contains(&Some(1)) && !made.region_of_triangle.contains(&Some(0)));
    assert_eq!((made.graph.holes.len(), made.graph.regions.len()), (1, 2));
}
