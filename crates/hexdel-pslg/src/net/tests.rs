//! The net keeps its invariants through everything that changes it.

use super::insert::Place;
use super::trace::Trace;
use super::*;
use proptest::prelude::*;

fn net_of(points: &[DVec2]) -> Net {
    let mut net = Net::rectangle(DVec2::splat(-1.0), DVec2::splat(2.0));
    for (&p, site) in points.iter().zip(0..) {
        net.insert(p, Kind::Site(site), NONE).unwrap();
    }
    net
}

fn points() -> impl Strategy<Value = Vec<DVec2>> {
    prop::collection::vec((0..40_u32, 0..40_u32), 3..40)
        .prop_map(|raw| raw.iter().map(|&(x, y)| DVec2::new(f64::from(x), f64::from(y)) / 40.0).collect())
}

proptest! {
    #[test]
    fn insertion_gives_a_delaunay_mesh(points in points()) {
        let net = net_of(&points);
        prop_assert_eq!(net.violation(), None);
        for t in net.alive() {
            for i in 0..3 {
                if let Some((_, [a, b, c, d])) = net.quad(t, i) {
                    let [a, b, c, d] = [a, b, c, d].map(|v| net.at(v));
                    prop_assert!(hexdel_geom::incircle(a, b, c, d) <= 0.0);
                }
            }
        }
    }

    #[test]
    fn what_is_inserted_is_found(points in points()) {
        let net = net_of(&points);
        for &p in &points {
            let Place::Vertex(v) = net.locate(p, NONE) else { panic!("{p} is lost") };
            prop_assert_eq!(net.at(v), p);
        }
        prop_assert_eq!(net.locate(DVec2::splat(7.0), NONE), Place::Outside);
    }

    #[test]
    fn removal_leaves_a_mesh(points in points(), which in 0..40_usize) {
        let mut net = net_of(&points);
        let before = net.alive().count();
        let Place::Vertex(v) = net.locate(points[which % points.len()], NONE) else { panic!() };
        prop_assert!(net.remove(v));
        prop_assert_eq!(net.violation(), None);
        prop_assert_eq!(net.alive().count() + 2, before);
    }

    #[test]
    fn a_segment_becomes_edges(points in points(), a in 0..40_usize, b in 0..40_usize) {
        let mut net = net_of(&points);
        let find = |p: DVec2| match net.locate(p, NONE) {
            Place::Vertex(v) => v,
            _ => NONE,
        };
        let (mut v, goal) = (find(points[a % points.len()]), find(points[b % points.len()]));
        for piece in 0.. {
            if v == goal {
                break;
            }
            let Trace::Vertex { vertex, crossed } = net.trace(v, goal) else { panic!("nothing is in the way") };
            prop_assert!(net.recover(v, vertex, crossed, piece));
            let (t, i) = net.find_either(v, vertex).unwrap();
            prop_assert_eq!(net.tri(t).s[i], piece);
            v = vertex;
        }
        prop_assert_eq!(net.violation(), None);
    }
}

#[test]
fn points_along_a_piece_are_the_nearest_doubles() {
    let mut net = Net::rectangle(DVec2::ZERO, DVec2::ONE);
    let (a, b) = (DVec2::new(0.1, 1e6), DVec2::new(0.7, -3.0));
    net.lines.push([a, b]);
    assert_eq!([net.along(0, 0.0), net.along(0, 1.0)], [a, b]);
    for i in 1..100 {
        let p = net.along(0, f64::from(i) / 100.0);
        // Off the line by the rounding of the coordinates at most.
        let off = (b - a).perp_dot(p - a).abs() / a.distance(b);
        assert!(off <= 1e-15, "{off:e}");
    }
}
