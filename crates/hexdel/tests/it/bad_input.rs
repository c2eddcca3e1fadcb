//! Input that cannot be meshed: an error of its own for each fault, naming
//! what is at fault.

#![cfg(feature = "io")]

use crate::common;
use hexdel::geom::PointsError;
use hexdel::{AngleBounds, DVec2, Error, Mesher, Method, Pslg, triangulate};

/// The error of points that no method meshes, the same for all.
fn refused(points: &[DVec2]) -> Error {
    let error = |method| Mesher::new().method(method).triangulate(points).unwrap_err();
    let (templates, simple) = (error(Method::Templates), error(Method::Simple));
    assert_eq!(templates.to_string(), simple.to_string());
    templates
}

/// By points and by PSLGs, with any method.
#[test]
fn bounds_that_no_graded_mesh_keeps() {
    let points = [DVec2::ZERO, DVec2::X, DVec2::new(0.3, 0.8)];
    for (min, max) in [(51.5, 90.0), (60.0, 60.0), (0.0, 71.9)] {
        let asked = AngleBounds::new(min, max).unwrap();
        let refused = Mesher::new().bounds(asked).triangulate(&points).unwrap_err();
        assert_eq!(refused, Error::NoGrading { asked });
        assert!(
            refused.to_string().contains("the lower bound may be at most 51.4, the upper bound at least 72"),
            "{refused}"
        );
        let graph = Pslg::from_points(points.to_vec());
        let refused = Mesher::new().near_bounds(asked).triangulate_pslg(&graph).unwrap_err();
        assert_eq!(refused, Error::NoGrading { asked });
    }
}

#[test]
fn no_points() {
    let error = refused(&[]);
    assert_eq!(error, Error::Points(PointsError::Empty));
    assert_eq!(error.to_string(), "the input has no points");
}

#[test]
fn coordinates_that_are_no_numbers() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for at in 0..3 {
            for point in [DVec2::new(bad, 1.0), DVec2::new(1.0, bad)] {
                let mut points = [DVec2::ZERO, DVec2::X, DVec2::Y];
                points[at] = point;
                let error = refused(&points);
                let Error::Points(PointsError::NotFinite { index, .. }) = error else {
                    panic!("{error}");
                };
                assert_eq!(index, at);
            }
        }
    }
    let error = refused(&[DVec2::ZERO, DVec2::new(0.5, f64::NAN)]);
    assert_eq!(error.to_string(), "point 1 at (0.5, NaN) is not finite");
}

/// The indices are those of the input, duplicates counted.
#[test]
fn points_too_close_to_tell_apart() {
    let close = 1.0 + 8.0 * f64::EPSILON;
    let points = [DVec2::ZERO, DVec2::ZERO, DVec2::ONE, DVec2::Y, DVec2::new(close, 1.0)];
    let error = refused(&points);
    let Error::TooClose { a, b, points: [p, q], distance, least } = error else {
        panic!("{error}");
    };
    assert_eq!(([a, b], [p, q]), ([2, 4], [points[2], points[4]]));
    assert!(distance < least && distance == 8.0 * f64::EPSILON);
    assert!(error.to_string().starts_with("points 2 at (1.0, 1.0) and 4 at (1.000000000000001"), "{error}");
}

/// Coordinates resolve less far from the origin: there a pair may be too close
/// that is not the closest.
#[test]
fn a_pair_too_close_for_where_it_lies() {
    let far = DVec2::ONE;
    for distance in [1e-9, 1e-10, 5e-11, 1e-12, 1e-13, 4e-14] {
        let points = [DVec2::ZERO, DVec2::X * 3e-14, far, far + DVec2::X * distance];
        match triangulate(&points) {
            Ok(made) => common::hold(&made, &points),
            Err(Error::TooClose { a: 2, b: 3, distance: found, least, .. }) => {
                // 2^16 last places of 1, times 4.1547 spacings.
                assert!(distance < 6.1e-11 && found < least, "{distance} {found} {least}");
            }
            Err(error) => panic!("{distance}: {error}"),
        }
    }
}

/// What the error calls close enough is.
#[test]
fn the_least_distance_named_would_do() {
    for at in [DVec2::new(1.0, 0.3), DVec2::new(-3.7e5, 2.0), DVec2::new(1e-7, 1e3)] {
        let Error::TooClose { least, .. } = refused(&[at, at + DVec2::X * at.x.abs().max(1e-3) * 1e-14])
        else {
            panic!("{at} is resolved");
        };
        for others in [&[][..], &[DVec2::new(0.1, 0.2)], &[DVec2::splat(10.0), DVec2::new(-20.0, 5.0)]] {
            let mut points = vec![at, at + DVec2::X * (1.01 * least)];
            points.extend(others);
            common::hold(&triangulate(&points).unwrap(), &points);
        }
    }
}

#[test]
fn coordinates_beyond_the_range_of_the_predicates() {
    let point = DVec2::new(3.0, -2e71);
    let error = refused(&[DVec2::ZERO, DVec2::X, DVec2::ZERO, point]);
    assert_eq!(error, Error::OutOfRange { index: 3, point, limit: 1e70 });
    assert_eq!(refused(&[DVec2::splat(f64::MAX)]).to_string().find("point 0"), Some(0));
}

/// Distances whose squares vanish.
#[test]
fn points_too_close_for_the_predicates() {
    let error = refused(&[DVec2::ZERO, DVec2::new(1e-200, 0.0)]);
    assert!(matches!(error, Error::TooClose { a: 0, b: 1, .. }), "{error}");
    let error = refused(&[DVec2::ZERO, DVec2::new(0.0, 5e-324)]);
    assert!(matches!(error, Error::TooClose { a: 0, b: 1, .. }), "{error}");
}

#[test]
fn a_radius_that_is_none() {
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Mesher::new().domain_radius(radius).triangulate(&[DVec2::ZERO, DVec2::X]).unwrap_err();
        let Error::InvalidRadius { radius: named } = error else {
            panic!("{error}");
        };
        assert_eq!(named.to_bits(), radius.to_bits());
    }
}

/// Each radius that the error names is larger than the one asked for, and
/// following it soon leads to one that does.
#[test]
fn a_domain_too_small_for_its_points() {
    let points = common::points("plane100");
    for asked in [1e-3, 0.1, 0.7] {
        let mut radius = asked;
        let mut tries = 0..8;
        let made = loop {
            assert!(tries.next().is_some(), "{radius} is still too small");
            match Mesher::new().domain_radius(radius).triangulate(&points) {
                Ok(made) => break made,
                Err(Error::DomainTooSmall { radius: named, least }) => {
                    assert!(
                        (named / radius - 1.0).abs() < 1e-12 && least > radius,
                        "{named} {radius} {least}"
                    );
                    radius = least;
                }
                Err(error) => panic!("{error}"),
            }
        };
        assert!(tries.start > 1, "{asked} is large enough");
        common::hold(&made, &points);
    }
}

/// A single point has a patch of radius 1, wherever it lies as long as
/// coordinates there resolve it.
#[test]
fn a_single_point_far_away() {
    for exponent in 0..70 {
        let points = [DVec2::new(10.0_f64.powi(exponent), 0.3)];
        let made = triangulate(&points).unwrap();
        common::hold(&made, &points);
        assert!(made.patch.radius == 1.0 || exponent > 10);
        let narrow = Mesher::new().domain_radius(1.0).triangulate(&points);
        match narrow {
            Ok(made) => common::hold(&made, &points),
            Err(Error::DomainTooSmall { radius, least }) => {
                assert!(radius == 1.0 && least > 1.0 && exponent > 9);
            }
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn bounds_beyond_the_method() {
    let points = [DVec2::ZERO, DVec2::X];
    let with = |method, min, max| {
        let bounds = AngleBounds::new(min, max).unwrap();
        Mesher::new().method(method).bounds(bounds).triangulate(&points)
    };
    for (method, min, max) in [
        (Method::Templates, 44.0, 90.0),
        (Method::Templates, 43.0, 89.0),
        (Method::Simple, 30.5, 120.0),
        (Method::Simple, 30.0, 119.0),
    ] {
        let error = with(method, min, max).unwrap_err();
        let Error::BoundsBeyondMethod { asked, kept } = error else {
            panic!("{error}");
        };
        assert_eq!((asked.min_deg(), asked.max_deg(), kept), (min, max, method.bounds()));
    }
    assert!(with(Method::Templates, 40.0, 91.0).is_ok());
    assert!(with(Method::Simple, 20.0, 130.0).is_ok());
}
