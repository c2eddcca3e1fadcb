//! docs/ocean.md: its commands, at a smaller size, and the size by depth.

use crate::support::Bench;

#[path = "../../examples/ocean/data.rs"]
mod data;

/// A bench with the made-up coast, of fewer points, and its depths, in larger cells.
fn bench() -> Bench {
    let bench = Bench::new();
    bench.file("coast.geojson", data::coast_geojson(60));
    bench.file("depths.asc", data::depths_asc(0.02));
    bench
}

/// Six times as long edges.
fn smaller(command: &str) -> String {
    command
        .replace("--min-size 300", "--min-size 2000")
        .replace("--wave-period 900", "--wave-period 6000")
        .replace("--size 3000", "--size 18000")
}

#[test]
fn the_commands_of_the_page_do_what_it_says() {
    let bench = bench();
    let page = include_str!("../../../../docs/ocean.md");
    let text = page.replace("\\\n", " ");
    let commands: Vec<String> =
        text.lines().filter_map(|line| line.strip_prefix("hexdel ")).map(smaller).collect();
    assert!(commands.len() >= 4 && commands.iter().any(|c| c.contains("--size 18000")), "{commands:?}");
    for command in &commands {
        let run = bench.run(command);
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{command}");
    }
    let report = bench.json("bay.json");
    assert_eq!((&report["holds"], &report["dual_edges"]["below"]), (&true.into(), &0.into()));
    assert_eq!(report["projection"]["output"], "degrees");
    // Depths of the raster, without what is far inland.
    assert!(report["depths"]["without"].as_u64() > Some(10) && report["depths"]["dry"].as_u64() > Some(100));
    assert!((500..5000).contains(&report["vertices"].as_u64().unwrap()), "{}", report["vertices"]);
    for name in ["bay.14", "bay.nc", "cells.nc", "plane.vtu", "bay.svg"] {
        assert!(bench.read(name).len() > 1000, "{name}");
    }
}

/// The sizes of the edges of a triangle, by place.
#[test]
fn edges_are_longer_in_deep_water() {
    let bench = bench();
    let mesh = |more: &str| {
        let command = "mesh coast.geojson --project mercator --size-from-depth depths.asc --report r.json -q";
        bench.run(&format!("{command} {more}")).fine();
        bench.json("r.json")
    };
    let triangles = |more: &str| mesh(more)["triangles"].as_u64().unwrap();
    let coarse = triangles("--wave-period 6000 --min-size 3000");
    // Half the period, half the length.
    let fine = triangles("--wave-period 3000 --min-size 3000");
    assert!(5 * coarse < 3 * fine, "{coarse} {fine}");
    assert!(triangles("--wave-period 6000 --per-wavelength 60 --min-size 3000") == fine);
    // A smaller gradation takes the short edges at the coast farther.
    assert!(triangles("--wave-period 6000 --min-size 3000 --gradation 0.1") > coarse);
    let report = mesh("--wave-period 6000 --size 20000");
    let rule = &report["depths"]["rule"];
    assert_eq!((rule["per_wavelength"].as_f64(), rule["max"].as_f64()), (Some(30.0), Some(20000.0)));
    // The side of a cell: 0.02 degrees of longitude.
    assert!((1100.0..1250.0).contains(&rule["min"].as_f64().unwrap()), "{rule}");
    assert!(report["size_ratio"].as_f64() <= Some(1.0 + 1e-8));
}

/// Heights are depths with the other sign; the two are told apart by what is more likely.
#[test]
fn the_sign_of_depths_is_said_and_doubted() {
    let bench = bench();
    let heights: String = data::depths_asc(0.02).lines().fold(String::new(), |text, line| {
        let negated = |word: &str| match word.strip_prefix('-') {
            _ if word == "-9999" => word.to_owned(),
            Some(positive) => positive.to_owned(),
            None => format!("-{word}"),
        };
        let is_header = line.starts_with(|c: char| c.is_alphabetic());
        let line = if is_header {
            line.to_owned()
        } else {
            line.split(' ').map(negated).collect::<Vec<_>>().join(" ")
        };
        text + &line + "\n"
    });
    bench.file("heights.asc", heights);
    let command = "mesh coast.geojson --project lambert -q --wave-period 6000 --min-size 3000";
    bench.run(&format!("{command} -o a.ele --size-from-depth depths.asc")).fine();
    bench.run(&format!("{command} -o b.ele --size-from-depth heights.asc --elevations")).fine();
    assert_eq!(bench.read("a.node"), bench.read("b.node"));
    let run = bench.run(&format!("{command} -o c.ele --size-from-depth heights.asc"));
    assert!(
        run.err.contains("warning: heights.asc: most of the depths are above the water")
            && run.err.contains("give --elevations")
    );
}

#[test]
fn options_of_depths_need_depths() {
    let bench = bench();
    for option in ["--wave-period 9", "--per-wavelength 9", "--min-size 9", "--elevations"] {
        bench.run(&format!("mesh coast.geojson -o m.ele {option}")).refused("--size-from-depth");
    }
    bench.run("mesh coast.geojson -o m.ele --gradation 0.2").refused("--gradation has no effect");
    bench
        .run("mesh coast.geojson -o m.ele --size-from-depth depths.asc --min-size 9 --size 8")
        .refused("depths.asc: the longest edge must be at least");
    bench.file("plane.asc", "ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n5\n");
    let command = "mesh coast.geojson -o m.ele --project lambert --size-from-depth plane.asc --min-size 1";
    bench.run(command).refused("plane.asc: the raster has no value around the points");
    bench.file("empty.asc", "ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9\n-9\n");
    bench
        .run("mesh coast.geojson -o m.ele --size-from-depth empty.asc --min-size 1")
        .refused("empty.asc: the raster has NaN");
}
