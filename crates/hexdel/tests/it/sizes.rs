//! Edges no longer than wanted, by every method, and sizes that are refused.

use hexdel::{DVec2, Effort, Error, Mesher, Method, Raster, Size, SizeError, generate, triangle_fits};

fn sizes() -> Vec<(&'static str, Size)> {
    let raster = Raster {
        columns: 2,
        rows: 2,
        low: DVec2::ZERO,
        cell: 1.0,
        values: vec![Some(0.05), None, Some(0.4), Some(0.2)],
    };
    let triangle = vec![DVec2::new(0.1, 0.1), DVec2::new(0.4, 0.15), DVec2::new(0.2, 0.5)];
    let two_boxes = Size::constant(0.3).unwrap().and_box(DVec2::ZERO, DVec2::new(0.5, 1.0), 0.05).unwrap();
    let two_boxes = two_boxes.and_box(DVec2::new(0.5, 0.0), DVec2::ONE, 0.1).unwrap();
    vec![
        ("constant", Size::constant(0.11).unwrap()),
        ("box", Size::unlimited().and_box(DVec2::splat(0.3), DVec2::new(0.4, 0.5), 0.03).unwrap()),
        ("points", Size::constant(0.5).unwrap().and_points(&[(DVec2::new(0.7, 0.2), 0.01)]).unwrap()),
        ("raster", Size::unlimited().and_raster(&raster).unwrap()),
        ("polygon", Size::unlimited().with_gradation(0.2).unwrap().and_polygon(triangle, 0.04).unwrap()),
        ("two boxes", two_boxes),
        ("function", Size::function(|p| 0.05 + 0.2 * p.x.abs())),
        ("area", Size::area(0.002).unwrap()),
    ]
}

#[test]
fn every_edge_is_as_short_as_wanted_and_every_angle_kept() {
    let points = generate::generate(generate::Kind::Uniform, 12, 1);
    for method in [Method::Templates, Method::Simple, Method::Compact] {
        for (name, size) in sizes() {
            let made = Mesher::new().method(method).size(size.clone()).triangulate(&points);
            let made = made.unwrap_or_else(|e| panic!("{method:?}, {name}: {e}"));
            assert!(made.certificate.holds(), "{method:?}, {name}");
            for t in &made.mesh.triangles {
                let corners = t.map(|v| made.mesh.vertices[v.index()]);
                assert!(triangle_fits(&size, corners), "{method:?}, {name}: {corners:?}");
                if name == "area" {
                    let [a, b, c] = corners;
                    assert!(0.5 * (b - a).perp_dot(c - a) <= 0.002 * (1.0 + 1e-8));
                }
            }
            assert!(made.size_ratio.is_some_and(|r| r > 0.3), "{method:?}, {name}: {:?}", made.size_ratio);
        }
    }
}

#[test]
fn sizes_that_cannot_be_had_are_refused() {
    let points = [DVec2::ZERO, DVec2::X];
    let refused = |size: Size| match Mesher::new().size(size).triangulate(&points) {
        Err(Error::Size(error)) => error,
        other => panic!("{:?}", other.map(|made| made.mesh.triangles.len())),
    };
    assert!(matches!(refused(Size::constant(1e-13).unwrap()), SizeError::BelowResolution { .. }));
    assert!(matches!(refused(Size::constant(1e-6).unwrap()), SizeError::TooMany { .. }));
    let negative = refused(Size::function(|_| -1.0));
    assert!(matches!(negative, SizeError::NotPositive { size: -1.0, .. }), "{negative:?}");
    let spike = Size::function(|p| if p.distance(DVec2::new(0.5, 0.1)) < 0.3 { f64::NAN } else { 1.0 });
    assert!(matches!(refused(spike), SizeError::TooFine { .. } | SizeError::NotPositive { .. }));
}

/// The length of the longest edge with an end so far from the origin.
fn longest_at(size: Size, from: f64, to: f64) -> f64 {
    let points = [DVec2::new(-1.0, -1.0), DVec2::new(1.0, 1.0)];
    let made = Mesher::new().size(size).triangulate(&points).unwrap();
    let at = |v: hexdel::VertexId| made.mesh.vertices[v.index()];
    let sides = made.mesh.triangles.iter().flat_map(|t| (0..3).map(|k| [at(t[k]), at(t[(k + 1) % 3])]));
    let there = sides.filter(|side| side.iter().all(|p| (from..to).contains(&p.length())));
    there.map(|[a, b]| a.distance(b)).fold(0.0, f64::max)
}

#[test]
fn edges_grow_with_the_distance_by_the_gradation() {
    let spot = |g| Size::unlimited().with_gradation(g).unwrap().and_points(&[(DVec2::ZERO, 0.01)]).unwrap();
    for gradation in [0.1, 0.3] {
        for (from, to) in [(0.1, 0.3), (0.3, 0.6)] {
            let longest = longest_at(spot(gradation), from, to);
            let (least, most) = (0.2 * (0.01 + gradation * from), 0.01 + gradation * to);
            assert!((least..=most).contains(&longest), "{gradation}, {from} to {to}: {longest}");
        }
    }
}

#[test]
fn a_size_that_asks_for_nothing_changes_nothing() {
    let points = generate::generate(generate::Kind::Clusters, 40, 2);
    let plain = Mesher::new().triangulate(&points).unwrap();
    let sized = Mesher::new().size(Size::constant(1e6).unwrap()).triangulate(&points).unwrap();
    assert_eq!(plain.mesh, sized.mesh);
}

/// Of a fine grid the first passes of removals take next to nothing, the later ones half of the triangles.
#[test]
fn removals_go_on_where_the_first_of_them_take_little() {
    let points = [DVec2::new(0.44, 0.03), DVec2::new(0.68, 0.64)];
    let count = |effort| {
        let mesher = Mesher::new().effort(effort).size(Size::constant(0.04).unwrap());
        mesher.triangulate(&points).unwrap().mesh.triangles.len()
    };
    let [fast, standard] = [Effort::Fast, Effort::Standard].map(count);
    assert!(3 * standard < 2 * fast, "{standard} instead of {fast} triangles");
}
