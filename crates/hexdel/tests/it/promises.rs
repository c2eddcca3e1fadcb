//! The four promises of the paper's abstract, in every certificate: angles, aspect ratio,
//! the Delaunay property, the shortest edge.

#![cfg(feature = "io")]

use crate::common;
use hexdel::generate::{Kind, generate};
use hexdel::{AngleBounds, AnySession, Certificate, DVec2, Mesher, Method, PointId, Size};

/// `l_min / d_min` (paper, section 6.3).
fn l_min() -> f64 {
    7_f64.sqrt() / (12.0 * 3_f64.sqrt())
}

const KINDS: [Kind; 9] = [
    Kind::Uniform,
    Kind::Line,
    Kind::Clusters,
    Kind::Grid,
    Kind::Jittered,
    Kind::Circle,
    Kind::Spiral,
    Kind::Pairs,
    Kind::Contrast,
];

/// Holds a certificate to the four promises, for points with features of `least`.
#[track_caller]
fn hold(c: &Certificate, least: f64) {
    assert!(c.holds(), "{:?}", c.violations);
    assert!(c.delaunay && c.delaunay_required);
    let slack = 1e-9 + c.worst_rounding_excess_deg;
    assert!(c.min_angle_deg >= c.bounds.min_deg() - slack && c.max_angle_deg <= c.bounds.max_deg() + slack);
    let aspect = c.max_aspect_bound.expect("the lower bound is not 0");
    assert!(c.max_aspect_ratio <= aspect + slack, "{} {aspect}", c.max_aspect_ratio);
    let promised = c.min_edge_bound.expect("two points, or a domain");
    assert!((promised / (least * l_min()) - 1.0).abs() < 1e-9, "{promised} for {least}");
    assert!(c.shortest_edge >= promised * (1.0 - 1e-9), "{} {promised}", c.shortest_edge);
}

#[test]
fn meshes_of_points_keep_all_four() {
    for kind in KINDS {
        let points = generate(kind, 40, 3);
        let least = common::closest_distance(&points).unwrap();
        for method in [Method::Templates, Method::Simple, Method::Compact] {
            let made = Mesher::new().method(method).triangulate(&points).unwrap();
            hold(&made.certificate, least);
        }
        let templates = Mesher::new().method(Method::Templates).domain_radius(3.0).triangulate(&points);
        hold(&templates.unwrap().certificate, least);
        let wide = AngleBounds::new(30.0, 90.0).unwrap();
        hold(&Mesher::new().bounds(wide).triangulate(&points).unwrap().certificate, least);
    }
    let aspect = AngleBounds::EXTENDED.max_aspect_ratio();
    assert!((aspect - 1.207_87).abs() < 1e-6, "{aspect}");
}

#[test]
fn sized_meshes_keep_all_four() {
    for (seed, longest) in [(1, 0.4), (2, 0.1), (3, 0.03)] {
        let points = generate(Kind::Uniform, 20, seed);
        let least = common::closest_distance(&points).unwrap();
        for method in [Method::Templates, Method::Simple, Method::Compact] {
            let size = Size::constant(longest).unwrap();
            let made = Mesher::new().method(method).size(size).triangulate(&points).unwrap();
            // The size counts where something was refined for it.
            let promised = made.certificate.min_edge_bound.unwrap() / l_min();
            assert!(promised == least.min(longest) || (promised / least - 1.0).abs() < 1e-9, "{promised}");
            hold(&made.certificate, promised);
        }
    }
}

/// Holds the certificates of a session in which points come and go, and a size.
fn hold_session(mut session: AnySession, seed: u64) {
    let mut bits = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = || {
        bits ^= bits << 13;
        bits ^= bits >> 7;
        bits ^= bits << 17;
        (bits >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut there: Vec<(PointId, DVec2)> = Vec::new();
    for i in 0..40 {
        let r = random();
        if i == 20 || i == 30 {
            let size = (i == 20).then(|| Size::constant(0.15).unwrap());
            session.set_size(size).unwrap();
        }
        if r < 0.4 && there.len() > 3 {
            let (id, _) = there.swap_remove((random() * there.len() as f64) as usize);
            session.remove(&[id]).unwrap();
        } else {
            // Near another point, or anywhere.
            let anywhere = DVec2::new(1.4 * random() - 0.7, 1.4 * random() - 0.7);
            let near = 10_f64.powf(-1.0 - 4.0 * random()) * DVec2::from_angle(6.3 * random());
            let at = match there.last() {
                Some((_, p)) if r < 0.6 && p.length() < 0.6 => *p + near,
                _ => anywhere,
            };
            let Ok(outcome) = session.insert(at) else { continue };
            there.push((outcome.points[0], at));
        }
        let certificate = session.certificate();
        hold(&certificate, certificate.min_edge_bound.expect("there is a domain") / l_min());
    }
}

#[test]
fn sessions_keep_all_four() {
    for method in [Method::Compact, Method::Templates] {
        hold_session(AnySession::empty(DVec2::ZERO, 1.0, method).unwrap(), 1);
    }
}
