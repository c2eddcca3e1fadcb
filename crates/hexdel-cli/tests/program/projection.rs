//! `--project`: degrees are meshed in a plane and come back.

use crate::support::{Bench, fixture};
use serde_json::Value;

/// A sea between two latitudes with an island, in degrees.
fn sea(north: f64) -> String {
    format!(
        r#"{{"type": "Polygon", "coordinates": [[[4.0, {0}], [6.0, {0}], [6.5, {1}], [4.5, {1}], [4.0, {0}]],
            [[5.0, {2}], [5.1, {3}], [5.3, {2}], [5.0, {2}]]]}}"#,
        north - 1.0,
        north,
        north - 0.6,
        north - 0.4
    )
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|n| n.as_f64().unwrap()).collect()
}

#[test]
fn degrees_come_back_and_angles_hold_in_the_plane() {
    let bench = Bench::new();
    bench.file("sea.geojson", sea(58.5));
    let plain = bench.run("mesh sea.geojson -o m.geojson");
    assert!(
        plain.out.contains("degrees are treated as plane coordinates; project them first, or with --project")
    );
    for kind in ["mercator", "lambert", "polar-stereographic", "+proj=utm|+zone=31|+ellps=GRS80"] {
        let mut command = bench
            .command("mesh sea.geojson -o m.geojson -o m.ele --report r.json --dual d.geojson --project");
        let output = command.arg(kind.replace('|', " ")).output().unwrap();
        let out = String::from_utf8(output.stdout.clone()).unwrap();
        assert!(output.status.success() && output.stderr.is_empty(), "{kind}: {output:?}");
        assert!(out.contains("projected  +proj=") && !out.contains("warning"), "{out}");
        let report = bench.json("r.json");
        assert_eq!((&report["holds"], &report["projection"]["output"]), (&true.into(), &"degrees".into()));
        let scale = numbers(&report["projection"]["scale"]);
        assert!(scale[0] > 0.98 && scale[1] < 1.02, "{kind}: {scale:?}");
        // What angles are told of is the plane.
        let mesh = bench.json("m.geojson");
        let mut corners = Vec::new();
        for triangle in mesh["features"].as_array().unwrap() {
            assert!(triangle["properties"]["min_angle"].as_f64() >= Some(30.0 - 1e-8));
            assert!(triangle["properties"]["max_angle"].as_f64() <= Some(90.0 + 1e-8));
            let ring = triangle["geometry"]["coordinates"][0].as_array().unwrap();
            corners.extend(ring.iter().map(numbers));
        }
        // Input points are there, bit for bit, and all else is in their box.
        for point in
            [[4.0, 57.5], [6.0, 57.5], [6.5, 58.5], [4.5, 58.5], [5.0, 57.9], [5.1, 58.1], [5.3, 57.9]]
        {
            assert!(corners.iter().any(|c| c[..] == point), "{kind}: {point:?}");
        }
        assert!(corners.iter().all(|c| (3.99..=6.51).contains(&c[0]) && (57.49..=58.51).contains(&c[1])));
        let cells = bench.json("d.geojson");
        let cell = numbers(&cells["features"][0]["geometry"]["coordinates"][0][1]);
        assert!((3.99..=6.51).contains(&cell[0]) && (57.49..=58.51).contains(&cell[1]), "{cell:?}");
        // The area of a cell is that of the plane: all are a sea of some 118 by 111 km.
        let area = |cell: &Value| cell["properties"]["area"].as_f64().unwrap();
        let sum: f64 = cells["features"].as_array().unwrap().iter().map(area).sum();
        assert!((1.25e10..1.33e10).contains(&sum), "{kind}: {sum}");
        // Degrees keep no bounds, and none are promised.
        assert!(!String::from_utf8(bench.read("m.ele")).unwrap().contains("hexdel: angles"));
    }
}

#[test]
fn the_plane_may_be_kept() {
    let bench = Bench::new();
    bench.file("sea.geojson", sea(58.5));
    let run =
        bench.run("mesh sea.geojson -o m.ele -o m.nc --project lambert --keep-projected --report r.json");
    run.fine();
    bench.run("check m.ele").fine();
    assert_eq!(bench.json("r.json")["projection"]["output"], "plane");
    let text = |name: &str| String::from_utf8_lossy(&bench.read(name)).into_owned();
    assert!(
        text("m.nc").contains("projected_coordinate_system") && text("m.nc").contains("+proj=lcc +lat_1=")
    );
    let first: Vec<f64> =
        text("m.node").lines().nth(1).unwrap().split(' ').map(|n| n.parse().unwrap()).collect();
    assert!(first[1].abs() > 1e4, "{first:?}");
    let run = bench.run("mesh sea.geojson -q -o m.geojson --project lambert --keep-projected");
    assert_eq!(run.code, 0);
    assert!(
        run.err.starts_with("warning: m.geojson: GeoJSON without --crs is taken for longitudes"),
        "{}",
        run.err
    );
    bench.run("mesh sea.geojson -q -o m.geojson --project lambert --keep-projected --crs EPSG:3034").fine();
}

#[test]
fn files_that_hold_a_system_name_the_right_one() {
    let bench = Bench::new();
    bench.file("sea.geojson", sea(-70.0));
    bench.run("mesh sea.geojson -q -o m.nc -o m.geojson --dual d.nc --project polar-stereographic").fine();
    let text = |name: &str| String::from_utf8_lossy(&bench.read(name)).into_owned();
    for name in ["m.nc", "d.nc"] {
        let text = text(name);
        for part in ["degrees_east", "degrees_north", "latitude_longitude", "EPSG:4326", "wgs84"] {
            assert!(text.contains(part), "{name}: {part}");
        }
        assert!(!text.contains("projection_x_coordinate"), "{name}");
    }
    // Without a system it is longitudes and latitudes, by the standard.
    assert!(!text("m.geojson").contains("\"crs\""));
    bench.run("mesh sea.geojson -q -o m.nc --project polar-stereographic --crs EPSG:4258").fine();
    assert!(text("m.nc").contains("EPSG:4258"));
}

#[test]
fn points_are_projected_too() {
    let bench = Bench::new();
    let run = bench
        .run(&format!("mesh {} -o m.ele -o m.svg --project lambert", fixture("tables/latlon_header.csv")));
    run.fine();
    assert!(
        run.out.contains("projected  +proj=lcc") && run.out.contains("every point a vertex"),
        "{}",
        run.out
    );
}

#[test]
fn what_cannot_be_projected_is_named_with_a_way_out() {
    let bench = Bench::new();
    bench.file("pole.csv", "lon,lat\n0,80\n90,85\n180,90\n");
    bench.file("both.csv", "lon,lat\n0,80\n90,85\n100,-1\n");
    bench.file("equator.csv", "lon,lat\n0,-10\n9,10\n3,1\n");
    bench.file("metres.csv", "x,y\n500000,4649776\n500100,4649776\n500000,4649900\n");
    bench.file("ring.wkt", "POLYGON ((-170 60, -60 60, 50 60, 160 60, -170 60))");
    for (arguments, message, help) in [
        ("pole.csv --project mercator", "point 2 at (180, 90) is outside", "--project polar-stereographic"),
        (
            "both.csv --project polar-stereographic",
            "point 2 at (100, -1) is outside",
            "--project mercator or lambert",
        ),
        ("equator.csv --project lambert", "both sides of the equator", "--project mercator"),
        (
            "metres.csv --project lambert",
            "point 0 at (500000, 4649776) is not a longitude",
            "without --project",
        ),
        ("ring.wkt --project lambert", "crosses the meridian", "--project polar-stereographic"),
        ("pole.csv --project +proj=laea", "laea does not keep angles", "--project mercator"),
    ] {
        let run = bench.run(&format!("mesh {arguments} -o m.ele"));
        run.refused(message);
        assert!(run.err.contains(&format!("help: {help}")), "{}", run.err);
    }
    bench
        .run("mesh pole.csv --project sinusoidal -o m.ele")
        .refused("must be mercator, polar-stereographic, lambert");
    bench.run("mesh pole.csv --keep-projected -o m.ele").refused("--project");
    let run = bench.run("mesh ring.wkt -o m.ele -q --project polar-stereographic");
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.err.contains("triangles cross the meridian of 180 degrees and look torn"), "{}", run.err);
}
