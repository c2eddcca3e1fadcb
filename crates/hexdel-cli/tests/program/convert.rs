//! `hexdel convert`.

use crate::support::{Bench, fixture};
use std::io::Write;
use std::process::Stdio;

const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0.1 1e-300 0\nf 1 2 3\n";

#[test]
fn the_help_fits_a_screen() {
    let run = Bench::new().run("convert --help");
    run.fine();
    assert!(run.out.lines().count() <= 30, "{} lines", run.out.lines().count());
    assert!(run.out.lines().all(|line| line.chars().count() <= 105), "{}", run.out);
}

#[test]
fn a_mesh_goes_around_all_formats() {
    let bench = Bench::new();
    bench.file("a.obj", OBJ);
    let around =
        ["a.obj", "b.off", "c.vtu", "d.msh", "e.msh2", "f.mesh", "g.json", "h.ron", "i.ele", "j.obj"];
    for pair in around.windows(2) {
        bench.run(&format!("convert {} {}", pair[0], pair[1])).fine();
    }
    assert_eq!(bench.read("j.obj"), b"v 0.0 0.0 0\nv 1.0 0.0 0\nv 0.1 1e-300 0\nf 1 2 3\n");
    // Either name of the pair, where only a mesh will do.
    bench.run("convert i.node k.off").fine();
    assert_eq!(bench.read("k.off"), bench.read("b.off"));
    // Of nodes with triangles, if the output takes no points.
    bench.run("convert i.node n.geojson").fine();
    for name in ["l.edge", "l.neigh", "l.svg", "l.vtk", "l.stl", "l.nc", "l.geojson", "l.wkt", "l.poly"] {
        bench.run(&format!("convert d.msh {name}")).fine();
    }
    assert!(bench.read("l.poly").starts_with(b"3 2 0 0\n"));
}

#[test]
fn points_and_graphs_stay_what_they_are() {
    let bench = Bench::new();
    let capitals = fixture("points/capitals.node");
    for (from, to) in [
        (capitals.as_str(), "a.json"),
        ("a.json", "b.ron"),
        ("b.ron", "c.csv"),
        ("c.csv", "d.xyz"),
        ("d.xyz", "e.node"),
    ] {
        bench.run(&format!("convert {from} {to}")).fine();
    }
    bench.run(&format!("convert {capitals} f.node")).fine();
    assert_eq!(bench.read("e.node"), bench.read("f.node"));
    bench.run(&format!("convert {} g.json", fixture("formats/outline.poly"))).fine();
    bench.run("convert g.json g.poly").fine();
    bench.run("convert g.poly h.json").fine();
    assert_eq!(bench.read("g.json"), bench.read("h.json"));
    bench.file("p.wkt", "POLYGON ((0 0, 4 0, 0 4, 0 0))");
    bench.run("convert p.wkt p.poly").fine();
    assert!(bench.read("p.poly").starts_with(b"3 2 0 1\n"));
}

#[test]
fn standard_streams() {
    let bench = Bench::new();
    let mut child = bench
        .command("convert - - --input-format obj --format off")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(OBJ.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    assert_eq!(output.stdout, b"OFF\n3 1 0\n0.0 0.0 0\n1.0 0.0 0\n0.1 1e-300 0\n3 0 1 2\n");
    bench.file("a.obj", OBJ);
    // The one format goes to the stream that needs it, or to the output.
    assert!(bench.run("convert a.obj - --format json").out.starts_with("{\"vertices\": ["));
    bench.run("convert a.obj a.msh --format msh2").fine();
    assert!(bench.read("a.msh").starts_with(b"$MeshFormat\n2.2 0 8\n"));
    bench.run("convert a.obj -").refused("standard output has no extension");
    bench.run("convert - a.vtu").refused("standard input has no extension");
    bench.run("convert a.obj - --format ele").refused("takes two files");
}

#[test]
fn what_is_lost_is_said_and_what_cannot_be_is_refused() {
    let bench = Bench::new();
    bench.file(
        "m.json",
        r#"{"vertices": [[0, 0], [1, 0], [0, 1]], "triangles": [[0, 1, 2]], "regions": [0.5]}"#,
    );
    let run = bench.run("convert m.json m.off");
    assert_eq!((run.code, run.err.as_str()), (0, "warning: m.off: the format has no regions\n"));
    bench.run("convert m.json m.mesh").refused("error: m.mesh: region of triangle 0 is 0.5");
    bench.run("convert m.json m.csv").refused("m.json: contains a mesh, which csv cannot store");
    bench.file("p.csv", "1,2\n3,4\n");
    bench.run("convert p.csv p.vtu").refused("p.csv: contains points, which vtu cannot store");
    bench.run("convert p.csv p.wkt").refused("error: p.wkt: the format wkt is read, not written");
    bench.run("convert p.csv p.xls").refused("unknown extension");
    bench.run("convert p.csv p.csv").refused("belongs to the input");
    bench.run("convert none.obj p.off").refused("none.obj: no such file");
    bench.run("convert m.off m.svg --input-format svg").refused("is written, not read");
    bench.file("bad.obj", "v 0 0 0\nf 1 2 3\n");
    bench.run("convert bad.obj bad.vtu").refused("bad.obj:2: no point 3");
    assert_eq!(bench.names(), ["bad.obj", "m.json", "m.off", "p.csv"]);
}

#[test]
fn tables_are_what_their_names_say_and_losses_are_told() {
    let bench = Bench::new();
    bench.file("a.node", "2 2 1 1\n0 0.5 1 7 3\n1 2 3 8 4\n");
    for (arguments, expected) in [
        ("a.node - --format csv", "x,y\n0.5,1.0\n2.0,3.0\n"),
        ("a.node - --format tsv", "x\ty\n0.5\t1.0\n2.0\t3.0\n"),
        ("a.node - --format xyz", "0.5 1.0\n2.0 3.0\n"),
    ] {
        let run = bench.run(&format!("convert {arguments}"));
        assert_eq!(run.out, expected);
        assert!(run.err.contains("the format has no point markers, point attributes"), "{}", run.err);
    }
    bench.run("convert a.node b.csv --format tsv");
    assert_eq!(bench.read("b.csv"), b"x\ty\n0.5\t1.0\n2.0\t3.0\n");
    bench.file("m.obj", OBJ);
    bench.run("convert m.obj m.ele --format node").fine();
    assert!(bench.read("m.node").starts_with(b"3 2 0 0\n"));
}

/// Boundaries of grids become marked edges, and nodes points.
#[test]
fn grids_of_hydrodynamics_are_meshes_and_points() {
    let bench = Bench::new();
    bench.file(
        "a.json",
        r#"{"vertices": [[0, 0], [1, 0], [0, 1]], "triangles": [[0, 1, 2]], "heights": [1, 2, 3.5]}"#,
    );
    for pair in [["a.json", "b.2dm"], ["b.2dm", "fort.14"], ["fort.14", "c.json"], ["fort.14", "d.vtu"]] {
        let run = bench.run(&format!("convert {} {}", pair[0], pair[1]));
        assert_eq!(run.code, 0, "{}", run.err);
    }
    let expected = "MESH2D\nNUM_MATERIALS_PER_ELEM 1\nE3T 1 1 2 3 1\nND 1 0.0 0.0 1.0\nND 2 1.0 0.0 2.0\n\
        ND 3 0.0 1.0 3.5\nNS 1 2 3 -1 1\n";
    assert_eq!(String::from_utf8(bench.read("b.2dm")).unwrap(), expected);
    assert_eq!(bench.json("c.json")["heights"], serde_json::json!([1.0, 2.0, 3.5]));
    let run = bench.run("convert fort.14 e.csv");
    assert_eq!((run.code, run.err.as_str()), (0, "warning: e.csv: the format has no point attributes\n"));
    assert_eq!(bench.read("e.csv"), b"x,y\n0.0,0.0\n1.0,0.0\n0.0,1.0\n");
    assert!(bench.run("check b.2dm --min-angle 20").out.contains("1 triangles"));
}

#[test]
fn coordinate_systems_are_named_where_they_can_be() {
    let bench = Bench::new();
    bench.file("a.obj", OBJ);
    bench.file("p.csv", "lon,lat\n8,47\n9,47\n8.5,48\n");
    let run = bench.run("mesh p.csv -o m.geojson --dual c.nc --crs epsg:4326 --report r.json");
    run.fine();
    let told = "degrees are treated as plane coordinates; project them first, or with --project";
    assert!(run.out.contains(&format!("\nwarning    {told}\n")), "{}", run.out);
    assert_eq!(bench.json("r.json")["input_warnings"], serde_json::json!([told]));
    bench.run("convert a.obj b.geojson --crs EPSG:25832").fine();
    for (name, code) in [("m", 4326), ("b", 25_832)] {
        let named = &bench.json(&format!("{name}.geojson"))["crs"]["properties"]["name"];
        assert_eq!(*named, format!("urn:ogc:def:crs:EPSG::{code}"));
    }
    bench
        .run("mesh b.geojson -o d.vtu --crs EPSG:1")
        .refused("--crs has no effect: it is for .geojson and .nc");
    bench.run("convert a.obj c.off --crs EPSG:1").refused("--crs has no effect");
    bench.run("dual a.obj -o c.vtu --crs EPSG:1").refused("--crs has no effect");
    bench.run("mesh p.csv -o n.geojson --crs WGS84").refused("must be a code like EPSG:25832");
}

/// Points keep their heights, others get theirs from between them.
#[test]
fn meshes_have_the_heights_of_points() {
    let bench = Bench::new();
    bench.file("a.csv", "x,y,depth\n0,0,-1\n1,0,-2\n0,1,-3.5\n");
    let outline = r#"{"type": "Polygon", "coordinates": [[[0, 0, 1], [1, 0, 2], [0, 1, 3.5], [0, 0, 1]]]}"#;
    bench.file("b.geojson", outline);
    for input in ["a.csv", "b.geojson"] {
        let run = bench.run(&format!("mesh {input} -o m.json -o m.14"));
        run.fine();
        assert!(run.out.contains("\nheights    1 to 3.5 at points, linear between them\n"), "{}", run.out);
        let made = bench.json("m.json");
        let rows = |name: &str| made[name].as_array().unwrap().clone();
        for ((input, height), p) in rows("input_indices").iter().zip(rows("heights")).zip(rows("vertices")) {
            let [height, x, y] = [&height, &p[0], &p[1]].map(|value| value.as_f64().unwrap());
            let given = input.as_u64().map(|i| [1.0, 2.0, 3.5][i as usize]);
            assert!(given.is_none_or(|given| given == height), "{given:?} {height}");
            if x > 0.0 && y > 0.0 && x + y < 1.0 {
                assert!((1.0 + x + 2.5 * y - height).abs() < 1e-12, "{x} {y} {height}");
            }
        }
        bench.run("convert m.14 n.json").fine();
        assert_eq!(bench.json("n.json")["heights"], made["heights"]);
    }
    // Some have none.
    bench.file("c.csv", "x,y,z\n0,0,1\n1,0,\n0,1,3.5\n");
    let run = bench.run("mesh c.csv -o c.json");
    assert_eq!(
        (run.code, run.err.as_str()),
        (0, "warning: c.csv: 2 heights instead of 3; heights are ignored\n")
    );
    bench.run("mesh c.csv -o c.json --columns x,y,z").refused("c.csv:3: expected a height, found \"\"");
}

/// What a mesh of a map is warned of, its conversion to a format without polygons is.
#[test]
fn conversion_warns_of_what_meshing_warns_of() {
    let bench = Bench::new();
    let square = |x: f64, y: f64, side: f64, attribute: u8| {
        let [a, b] = [x + side, y + side];
        format!(
            r#"{{"type": "Feature", "properties": {{"attribute": {attribute}}}, "geometry": {{"type": "Polygon",
            "coordinates": [[[{x}, {y}], [{a}, {y}], [{a}, {b}], [{x}, {b}], [{x}, {y}]]]}}}}"#
        )
    };
    let two = [square(0.0, 0.0, 4.0, 1), square(2.0, 2.0, 4.0, 2)].join(",");
    bench.file("m.geojson", format!(r#"{{"type": "FeatureCollection", "features": [{two}]}}"#));
    let warnings =
        |err: &str| err.lines().filter(|l| l.starts_with("warning: m.geojson")).map(str::to_owned).collect();
    let mesh = bench.run("mesh m.geojson --quiet -o m.vtu");
    let convert = bench.run("convert m.geojson m.poly");
    let [expected, found]: [Vec<String>; 2] = [warnings(&mesh.err), warnings(&convert.err)];
    assert!(expected.len() >= 3 && expected.iter().any(|l| l.contains("overlap")), "{}", mesh.err);
    assert_eq!((convert.code, found), (0, expected));
}

/// Polygons stay polygons; holes and regions of Triangle's have no place.
#[test]
fn pslgs_become_geojson() {
    let bench = Bench::new();
    bench.file(
        "a.wkt",
        "POLYGON ((0 0, 6 0, 6 6, 0 6, 0 0), (2 2, 4 2, 4 4, 2 2))\nLINESTRING (7 7, 8 8)\nPOINT (9 9)\n",
    );
    bench.run("convert a.wkt a.geojson").fine();
    let kinds = |name: &str| -> Vec<String> {
        let features = bench.json(name)["features"].as_array().unwrap().clone();
        features.iter().map(|f| f["geometry"]["type"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(kinds("a.geojson"), ["Polygon", "LineString", "Point"]);
    let triangles = |input: &str| {
        bench.run(&format!("mesh {input} -q -o m.ele --report r.json"));
        bench.json("r.json")["triangles"].clone()
    };
    assert_eq!(triangles("a.wkt"), triangles("a.geojson"));
    let run = bench.run(&format!("convert {} h.geojson", fixture("graphs/square_with_hole.poly")));
    run.refused("h.geojson: the format has polygons, not holes");
    bench.run("convert a.wkt a.geojsonl").refused("a.geojsonl");
    // With attributes there is something to lose.
    let run = bench.run(&format!("convert {} c.geojson", fixture("formats/fan.node")));
    assert_eq!(run.code, 0, "{}", run.err);
}
