//! Published values, there and back, angles, and what is refused.

use super::*;

/// A kind with points.
fn made(kind: &str, points: &[[f64; 2]]) -> Result<Projection, ProjectionError> {
    let points: Vec<DVec2> = points.iter().map(|&p| p.into()).collect();
    Projection::new(&kind.parse().unwrap(), &points)
}

/// The examples of "Coordinate Conversions and Transformations including Formulas" (IOGP 373-7-2), which gives
/// results to a centimetre or a hundredth of a foot.
#[test]
fn published_values_are_met() {
    let dms = |d: f64, m: f64| d + m / 60.0;
    for (definition, at, [x, y]) in [
        // Makassar / NEIEZ.
        (
            "+proj=merc +lon_0=110 +k=0.997 +x_0=3900000 +y_0=900000 +ellps=bessel",
            [120.0, -3.0],
            [5_009_726.58, 569_150.82],
        ),
        // Pulkovo 1942 / Caspian Sea Mercator.
        ("+proj=merc +lat_ts=42 +lon_0=51 +ellps=krass", [53.0, 53.0], [165_704.29, 5_171_848.07]),
        // NAD27 / Texas South Central, feet of the United States.
        (
            "+proj=lcc +lat_1=28.383333333333333 +lat_2=30.283333333333333 +lat_0=27.833333333333333 +lon_0=-99 \
             +x_0=609601.2192024384 +ellps=clrk66 +units=us-ft",
            [-96.0, dms(28.0, 30.0)],
            [2_963_503.91, 254_759.80],
        ),
        // WGS 84 / Australian Antarctic Polar Stereographic.
        (
            "+proj=stere +lat_0=-90 +lat_ts=-71 +lon_0=70 +x_0=6000000 +y_0=6000000 +ellps=WGS84",
            [120.0, -75.0],
            [7_255_380.79, 7_053_389.56],
        ),
    ] {
        let projection = made(definition, &[at]).unwrap();
        let found = projection.to_plane(at.into()).unwrap();
        assert!((found - DVec2::new(x, y)).abs().max_element() <= 0.0051, "{definition}: {found}");
    }
}

/// Points all over a box of longitudes and latitudes.
fn places([west, south, east, north]: [f64; 4]) -> Vec<DVec2> {
    let share = |i: i32| f64::from(i) / 12.0;
    let place =
        |i: i32, j: i32| DVec2::new(west + (east - west) * share(i), south + (north - south) * share(j));
    (0..=12).flat_map(|i| (0..=12).map(move |j| place(i, j))).collect()
}

const CASES: [(&str, [f64; 4]); 9] = [
    ("mercator", [-20.0, -15.0, 30.0, 18.0]),
    ("mercator", [-179.0, -80.0, 179.0, 80.0]),
    ("mercator", [170.0, -20.0, 200.0, 10.0]),
    ("lambert", [-12.0, 40.0, 25.0, 68.0]),
    ("lambert", [100.0, -60.0, 160.0, -10.0]),
    ("polar-stereographic", [-180.0, 55.0, 179.0, 89.9]),
    ("polar-stereographic", [0.0, -90.0, 90.0, -60.0]),
    ("+proj=utm +zone=32 +ellps=GRS80", [6.0, 30.0, 12.0, 60.0]),
    ("+proj=tmerc +lon_0=-3 +k=0.9996 +ellps=airy", [-8.0, 49.0, 2.0, 61.0]),
];

#[test]
fn places_come_back_within_a_billionth_of_a_degree() {
    for (kind, domain) in CASES {
        let all = places(domain);
        let projection = Projection::new(&kind.parse().unwrap(), &all).unwrap();
        for at in all {
            let back = projection.to_degrees(projection.to_plane(at).unwrap());
            // At the pole every longitude is right.
            let narrow = (90.0 - at.y.abs()).to_radians().sin();
            assert!(
                (back.y - at.y).abs() <= 1e-9 && around(back.x - at.x).abs() * narrow <= 1e-9,
                "{kind}: {at} {back}"
            );
        }
    }
}

/// A small right-angled step has the same length to the east as to the north, and a right angle between, as measured on
/// the ellipsoid.
#[test]
fn angles_are_kept() {
    for (kind, domain) in CASES {
        let all = places(domain);
        let projection = Projection::new(&kind.parse().unwrap(), &all).unwrap();
        for at in all.into_iter().filter(|p| p.y.abs() < 89.0) {
            let step = 1e-4;
            let [a, es] = WGS84;
            let sine = at.y.to_radians().sin();
            let w = 1.0 - es * sine * sine;
            // Radii of the parallel and of the meridian.
            let (parallel, meridian) = (a * at.y.to_radians().cos() / w.sqrt(), a * (1.0 - es) / w.powf(1.5));
            let place = |dx: f64, dy: f64| projection.to_plane(at + step * DVec2::new(dx, dy)).unwrap();
            let east = (place(1.0, 0.0) - place(-1.0, 0.0)) / parallel;
            let north = (place(0.0, 1.0) - place(0.0, -1.0)) / meridian;
            let (long, wide) = (north.length(), east.length());
            // Other ellipsoids than that of WGS 84 differ in shape by some 1e-5.
            assert!((wide / long - 1.0).abs() < 1e-4, "{kind}: {at} {wide} {long}");
            assert!(east.dot(north).abs() < 1e-6 * long * wide && east.perp_dot(north) > 0.0, "{kind}: {at}");
        }
    }
}

#[test]
fn parameters_follow_the_points() {
    let definition = |kind, domain| Projection::new(&kind, &places(domain)).unwrap().definition().to_owned();
    let north_sea = [-4.0, 51.0, 9.0, 60.0];
    let lambert = definition(ProjectionKind::Lambert, north_sea);
    assert_eq!(
        lambert,
        "+proj=lcc +lat_1=52.5 +lat_2=58.5 +lat_0=55.5 +lon_0=2.5 +ellps=WGS84 +units=m +no_defs"
    );
    let mercator = definition(ProjectionKind::Mercator, [170.0, -20.0, 200.0, 10.0]);
    assert_eq!(mercator, "+proj=merc +lat_ts=5 +lon_0=-175 +ellps=WGS84 +units=m +no_defs");
    let south = definition(ProjectionKind::PolarStereographic, [-60.0, -80.0, -20.0, -70.0]);
    assert_eq!(south, "+proj=stere +lat_0=-90 +lat_ts=-75 +lon_0=-40 +ellps=WGS84 +units=m +no_defs");
}

#[test]
fn the_scale_is_one_where_it_is_said_to_be() {
    let near = |kind: &str, domain, at: [f64; 2], scale: f64| {
        let projection = Projection::new(&kind.parse().unwrap(), &places(domain)).unwrap();
        let found = projection.scale(at.into()).unwrap();
        assert!((found - scale).abs() < 2e-6, "{kind}: {found}");
    };
    near("lambert", [-4.0, 51.0, 9.0, 60.0], [7.0, 52.5], 1.0);
    near("lambert", [-4.0, 51.0, 9.0, 60.0], [-1.0, 58.5], 1.0);
    near("mercator", [0.0, 10.0, 9.0, 30.0], [3.0, 20.0], 1.0);
    near("polar-stereographic", [-60.0, -80.0, -20.0, -70.0], [0.0, -75.0], 1.0);
    near("+proj=utm +zone=32 +ellps=WGS84", [6.0, 30.0, 12.0, 60.0], [9.0, 45.0], 0.9996);
}

/// Longitudes go on across 180 degrees if those of the points do, and jump if those do.
#[test]
fn the_antimeridian_is_no_border() {
    let going_on = made("mercator", &[[175.0, 0.0], [190.0, 5.0]]).unwrap();
    let jumping = made("mercator", &[[175.0, 0.0], [-170.0, 5.0]]).unwrap();
    assert_eq!((going_on.centre(), jumping.centre()), (-177.5, -177.5));
    let east = [going_on.to_plane(DVec2::new(190.0, 5.0)), jumping.to_plane(DVec2::new(-170.0, 5.0))];
    assert!(east[0].unwrap().distance(east[1].unwrap()) < 1e-6);
    let longitude = |projection: &Projection| projection.to_degrees(east[0].unwrap()).x;
    assert!((longitude(&jumping) + 170.0).abs() < 1e-9, "{}", longitude(&jumping));
}

#[test]
fn what_a_projection_is_not_for_is_refused() {
    let text = |kind: &str, points: &[[f64; 2]]| {
        let points: Vec<DVec2> = points.iter().map(|&p| p.into()).collect();
        let projected = Projection::new(&kind.parse().unwrap(), &points)
            .and_then(|projection| projection.project(&Pslg::from_points(points)));
        projected.map(drop).unwrap_err().to_string()
    };
    assert_eq!(text("mercator", &[]), "there are no points to project");
    let metres = text("mercator", &[[0.0, 0.0], [4e5, 5e6]]);
    assert_eq!(metres, "point 1 at (400000, 5000000) is not a longitude and latitude in degrees");
    let pole = text("mercator", &[[0.0, 0.0], [0.0, 90.0]]);
    assert!(
        pole.starts_with("point 1 at (0, 90) is outside")
            && pole.ends_with("latitudes from -89 to 89 degrees")
    );
    let both = text("polar-stereographic", &[[0.0, 80.0], [0.0, -1.0]]);
    assert!(
        both.starts_with("point 1 at (0, -1) is outside") && both.ends_with("one side of the equator"),
        "{both}"
    );
    assert!(text("lambert", &[[0.0, 80.0], [0.0, -81.0]]).contains("both sides of the equator"));
    assert!(
        text("+proj=laea +lat_0=52", &[[0.0, 50.0]]).starts_with("the projection laea does not keep angles")
    );
    assert!(text("+proj=nonsense", &[[0.0, 50.0]]).contains("is not a projection"));
    assert!("sinusoidal".parse::<ProjectionKind>().is_err());
}

#[test]
fn segments_across_the_end_of_the_plane_are_refused_but_not_at_a_pole() {
    let ring = |latitude: f64| {
        let mut ring =
            Pslg::from_points((0..12).map(|i| DVec2::new(30.0 * f64::from(i) - 180.0, latitude)).collect());
        ring.segments = (0..12).map(|i| [i, (i + 1) % 12]).collect();
        ring
    };
    let project = |kind: ProjectionKind, pslg: &Pslg| Projection::new(&kind, &pslg.points)?.project(pslg);
    for kind in [ProjectionKind::Mercator, ProjectionKind::Lambert] {
        let error = project(kind, &ring(70.0)).unwrap_err();
        assert!(matches!(error, ProjectionError::Cut { .. }), "{error}");
    }
    let around = project(ProjectionKind::PolarStereographic, &ring(70.0)).unwrap();
    let [radius, other] = [0, 5].map(|i: usize| around.points[i].length());
    assert!((radius - other).abs() < 1e-6 && (2.1e6..2.3e6).contains(&radius), "{radius}");
}

#[test]
fn holes_and_regions_are_projected_too() {
    let mut pslg = Pslg::from_points(places([0.0, 40.0, 5.0, 45.0]));
    pslg.holes = vec![DVec2::new(1.0, 41.0)];
    pslg.regions =
        vec![hexdel_geom::Region { point: DVec2::new(2.0, 42.0), attribute: 3.0, max_area: Some(5.0) }];
    let projection = Projection::new(&ProjectionKind::Lambert, &pslg.points).unwrap();
    let plane = projection.project(&pslg).unwrap();
    assert_eq!(plane.holes[0], projection.to_plane(pslg.holes[0]).unwrap());
    assert_eq!(plane.regions[0].point, projection.to_plane(pslg.regions[0].point).unwrap());
    assert_eq!((plane.regions[0].attribute, plane.regions[0].max_area), (3.0, Some(5.0)));
    pslg.holes[0].y = 91.0;
    assert!(matches!(
        projection.project(&pslg),
        Err(ProjectionError::NotDegrees { item: "hole", index: 0, .. })
    ));
}
