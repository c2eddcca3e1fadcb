//! Errors name the way out, and the way out works.

use crate::support::{Bench, Run, fixture};

/// The value that the help of a run gives an option.
fn named(run: &Run, option: &str) -> String {
    let help =
        run.err.lines().find_map(|line| line.strip_prefix("help: ")).unwrap_or_else(|| panic!("{}", run.err));
    let word =
        help.split_whitespace().find(|word| word.starts_with(option)).unwrap_or_else(|| panic!("{help}"));
    word.trim_end_matches([',', ';']).to_owned()
}

#[test]
fn points_too_close_are_joined_by_the_tolerance_that_is_named() {
    let bench = Bench::new();
    for table in ["near_dup_1e9", "polar"] {
        let input = fixture(&format!("tables/{table}.csv"));
        let run = bench.run(&format!("mesh {input} -o m.ele"));
        run.refused(" apart, closer than the ");
        let repair = named(&run, "--repair=");
        let run = bench.run(&format!("mesh {input} -o m.ele {repair} --report r.json"));
        assert_eq!(run.code, 0, "{table} {repair}: {}", run.err);
        assert!(!bench.json("r.json")["repairs"].as_array().unwrap().is_empty());
    }
}

/// Segments as well: a vertex of one so close to another that nothing fits between them.
#[test]
fn segments_too_close_are_joined_by_the_tolerance_that_is_named() {
    let bench = Bench::new();
    let input = fixture("graphs/needle.poly");
    let run = bench.run(&format!("mesh {input} -o m.ele"));
    run.refused("are too close at");
    let repair = named(&run, "--repair=");
    assert_eq!(run.err.lines().filter(|line| line.starts_with("help: ")).count(), 1, "{}", run.err);
    bench.run(&format!("mesh {input} -q -o m.ele {repair}")).fine();
}

/// Rounding keeps points from a line, or nothing does.
#[test]
fn hulls_that_are_a_line_lead_to_other_domains() {
    let bench = Bench::new();
    bench.file("line.xyz", "0 0\n1 1e-13\n2 0\n3 1e-13\n");
    bench.file("line.poly", "4 2 0 0\n1 0 0\n2 1 1e-13\n3 2 0\n4 3 1e-13\n0 0\n0\n");
    bench.file("exact.xyz", "0 0\n1 1\n3 3\n");
    let near = "the line through point 0 and point 3, 6.6";
    for (input, what) in
        [("line.xyz", near), ("line.poly", near), ("exact.xyz", "all points are on the line")]
    {
        let run = bench.run(&format!("mesh {input} -o m.ele --domain hull"));
        run.refused(what);
        assert!(run.err.contains("the convex hull is too flat to mesh"), "{}", run.err);
        assert!(run.err.contains("help: --domain hexagon or box meshes"), "{}", run.err);
        for domain in ["hexagon", "box"] {
            bench.run(&format!("mesh {input} -q -o m.ele --domain {domain}")).fine();
        }
    }
}

/// Between edges of the hull no tolerance helps.
#[test]
fn hulls_too_thin_lead_to_other_domains() {
    let bench = Bench::new();
    let input = fixture("polygons/near_collinear6.poly");
    // Three points are left of it, in a line as good as can be.
    let run = bench.run(&format!("mesh {input} -o m.ele --domain hull --repair=1e-4"));
    run.refused("two edges of the convex hull are too close at");
    assert!(run.err.contains("help: --domain hexagon or box meshes"), "{}", run.err);
    bench.run(&format!("mesh {input} -q -o m.ele --domain box --repair=1e-4")).fine();
}

#[test]
fn radii_that_do_not_fit_name_one_that_does() {
    let bench = Bench::new();
    bench.file("p.txt", "0 0\n1 0\n0.3 0.4\n");
    let run = bench.run("mesh p.txt -o m.ele --domain-radius 0.1 --method templates");
    run.refused("is too small");
    // The grid follows the radius, so that a second, larger one may be named.
    let mut run = run;
    for _ in 0..3 {
        if run.code != 0 {
            let value =
                run.err.split("--domain-radius ").nth(1).unwrap().split(',').next().unwrap().to_owned();
            run = bench.run(&format!("mesh p.txt -o m.ele --domain-radius {value} --method templates"));
        }
    }
    assert_eq!(run.code, 0, "{}", run.err);
}

#[test]
fn loose_ends_are_named_where_nothing_is_enclosed() {
    let bench = Bench::new();
    let input = fixture("triangle/box_open.poly");
    let run = bench.run(&format!("mesh {input} -o m.ele"));
    run.refused("loose ends: point 0 at (0, 0), point 1 at (0, 3)");
    assert!(run.err.contains("help: --domain hull") && !run.err.contains("-c "), "{}", run.err);
    bench.run(&format!("mesh {input} -q -o m.ele --domain hull")).fine();
    let run = bench.run(&format!("triangle -pQP {input}"));
    run.refused("loose ends: ");
    assert!(run.err.contains("help: -c meshes the convex hull"), "{}", run.err);
    bench.file("open.poly", std::fs::read(&input).unwrap());
    bench.run("triangle -pcQ open").fine();
    // Many of them are counted.
    let spokes = (0..9).map(|i| format!("{} 1 {}\n", i + 1, i)).collect::<Vec<_>>().concat();
    let segments = (0..9).map(|i| format!("{i} 0 {}\n", i + 1)).collect::<Vec<_>>().concat();
    bench.file("fan.poly", format!("10 2\n0 0 0\n{spokes}9 0\n{segments}0\n"));
    bench.run("mesh fan.poly -o m.ele").refused("point 5 at (1, 4) and 4 more");
}

#[test]
fn segments_without_length_and_twice_are_dropped_with_a_warning() {
    let bench = Bench::new();
    for (name, warning) in [
        ("octagon_dupclose", "segment 8 had no length at (118.57716599999999, 28.538463999999994)"),
        ("dup_last", "segment 3 had no length at (0, -2)"),
        ("circle_twice", "segments 2 and 13 overlapped"),
    ] {
        let input = fixture(&format!("triangle/{name}.poly"));
        let run = bench.run(&format!("mesh {input} -o m.ele --report r.json"));
        assert_eq!(run.code, 0, "{name}: {}", run.err);
        assert!(run.err.lines().all(|line| line.starts_with("warning: ")), "{}", run.err);
        assert!(run.err.contains(warning), "{}", run.err);
        let repairs = bench.json("r.json")["repairs"].as_array().unwrap().len();
        assert_eq!(repairs, run.err.lines().count());
        bench.run(&format!("check m.ele --input {input}")).fine();
    }
    // The marker of the one that has one stays.
    bench.run(&format!("mesh {} -q -o c.poly", fixture("triangle/circle_twice.poly")));
    assert!(String::from_utf8(bench.read("c.poly")).unwrap().lines().any(|row| row.ends_with(" 7")));
}

#[test]
fn faults_of_a_kind_are_told_together() {
    let bench = Bench::new();
    let rows = (0..8).map(|i| format!("{i}.5,x{i}\n")).collect::<Vec<_>>().concat();
    bench.file("t.csv", format!("x,y\n0,0\n{rows}"));
    let run = bench.run("mesh t.csv -o m.ele");
    run.refused("t.csv:3: expected the y coordinate, found \"x0\"\nt.csv:4: ");
    assert!(run.err.contains("t.csv:7: ") && run.err.contains("\nand 3 more of this kind\n"), "{}", run.err);
    bench.file("s.poly", "2 2\n1 0 0\n2 1 0\n3 0\n1 1 9\n2 1 2\n3 8 2\n0\n");
    let run = bench.run("mesh s.poly -o m.ele");
    run.refused("s.poly:5: no point 9, there are 2 counted from 1\ns.poly:7: no point 8");
    // Two crosses.
    bench.file(
        "x.poly",
        "8 2\n0 0 0\n1 1 1\n2 1 0\n3 0 1\n4 5 0\n5 6 1\n6 6 0\n7 5 1\n4 0\n0 0 1\n1 2 3\n2 4 5\n3 6 7\n0\n",
    );
    let run = bench.run("mesh x.poly -o m.ele --domain hull");
    run.refused(
        "x.poly: segments 0 and 1 cross at (0.5, 0.5)\nx.poly: segments 2 and 3 cross at (5.5, 0.5)\n",
    );
    assert!(run.err.contains("help: --repair divides segments"), "{}", run.err);
    bench.run("mesh x.poly -q -o m.ele --domain hull --repair").fine();
}

#[test]
fn files_that_triangle_reads_are_read_with_a_warning() {
    let bench = Bench::new();
    for (name, warning) in [
        (
            "p_extra_marker",
            "p_extra_marker.poly:2: expected end of line, found \"5\"; fields beyond those announced are ignored, and 7 times more",
        ),
        (
            "p_missing_marker",
            "expected a boundary marker, found end of line; missing markers are read as 0, and 7 times more",
        ),
        (
            "p_comma",
            "p_comma.poly:1: expected white space between fields, found \",\"; commas are read as spaces, and 9 times more",
        ),
        ("p_float_int", "found \"1.0\"; markers with a decimal point are read as integers, and 7 times more"),
    ] {
        let input = fixture(&format!("triangle/{name}.poly"));
        let run = bench.run(&format!("mesh {input} -q -o m.ele --report r.json"));
        assert_eq!(run.code, 0, "{name}: {}", run.err);
        assert!(run.err.starts_with("warning: ") && run.err.contains(warning), "{}", run.err);
        let report = bench.json("r.json");
        assert_eq!((&report["segments"], report["input_warnings"].as_array().unwrap().len()), (&4.into(), 1));
        bench.file("copy.poly", std::fs::read(&input).unwrap());
        let run = bench.run("triangle -Q copy.poly");
        assert!(run.code == 0 && run.err.starts_with("warning: copy.poly:"), "{}", run.err);
    }
    bench.run(&format!("mesh {} -q -o m.poly", fixture("triangle/p_float_int.poly")));
    let text = String::from_utf8(bench.read("m.poly")).unwrap();
    assert!(text.lines().next().unwrap().ends_with(" 1 1"), "{text}");
}

#[test]
fn options_that_there_are_not_lead_to_those_that_mean_the_same() {
    let bench = Bench::new();
    bench.file("p.txt", "0 0\n1 0\n");
    for (arguments, tip) in [
        ("mesh p.txt -o m.ele --area 1", "use '--max-area A'"),
        ("mesh p.txt --to m.ele", "use '-o FILE'"),
        ("convert p.txt --to csv", "the output is the second argument: 'hexdel convert INPUT OUTPUT'"),
        ("convert p.txt --output csv", "the output is the second argument: 'hexdel convert INPUT OUTPUT'"),
        ("mesh --input p.txt -o m.ele", "the input is the first argument: 'hexdel mesh INPUT'"),
        ("check --mesh m.ele", "the mesh is the first argument: 'hexdel check MESH'"),
        ("mesh p.txt -o m.ele --angle 20", "use '--min-angle DEG'"),
        ("mesh p.txt -o m.ele --tol 20", "use '--repair=TOL'"),
        ("mesh p.txt -o m.ele --hull", "use '--domain hexagon, hull, box or inside'"),
        ("mesh p.txt -o m.ele --min-angel 20", "a similar argument exists: '--min-angle'"),
    ] {
        let run = bench.run(arguments);
        assert_eq!(run.code, 2);
        assert!(run.err.contains(tip), "{arguments}: {}", run.err);
    }
    for (arguments, wrong) in [
        ("mesh p.txt -o m.ele --area 1", "repair"),
        ("mesh p.txt --to m.ele", "histogram"),
        ("plot m.ele --to m.svg", "histogram"),
        ("plot m.ele -o m.svg --length 2", "size"),
        ("mesh p.txt -o m.ele --frobnicate", "tip:"),
    ] {
        let run = bench.run(arguments);
        assert!(run.code == 2 && !run.err.contains(wrong), "{arguments}: {}", run.err);
    }
}

/// By the line of the file, whatever the numbers in it are.
#[test]
fn unused_holes_and_regions_are_named_by_their_line() {
    let bench = Bench::new();
    bench.file(
        "a.poly",
        "# a square\n4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n\n# holes\n2\n1 5 5\n2 0.5 0\n1\n1 7 7 3\n",
    );
    for command in ["mesh a.poly -q -o m.ele", "triangle -QA a.poly"] {
        let run = bench.run(command);
        assert_eq!(run.code, 0);
        for warning in [
            "warning: a.poly:15: hole 0 at (5, 5) has no effect: it lies outside the domain\n",
            "warning: a.poly:16: hole 1 at (0.5, 0) has no effect: it lies on segment 0\n",
            "warning: a.poly:18: region 0 at (7, 7) has no effect: it lies outside the domain\n",
        ] {
            assert!(run.err.contains(warning), "{command}: {}", run.err);
        }
    }
}

/// What is not GeoJSON, or not quite, with the place of the fault.
#[test]
fn geojson_that_is_none_is_refused_with_its_place() {
    let bench = Bench::new();
    for (name, place, words) in [
        ("esri", ":1:173", "missing field `type`"),
        ("nan", ":1:50", "expected value"),
        ("str", ":1:41", "invalid type: string \"0\", expected a coordinate"),
        ("topo", ":1:19", "unknown variant `Topology`, expected one of `Point`"),
        ("upper", ":1:18", "unknown variant `POLYGON`, expected one of `Point`"),
        ("wktname", ":1:1", "expected value"),
        ("xnull", ":1:45", "invalid type: null, expected f64"),
        ("nullonly", "", "the input has no points"),
        ("lines_open", "", "the segments enclose no area"),
        ("bowtie_r", "", "segments 0 and 2 cross at (2, 1.5)"),
        ("sliveroverlap_r", "", "the mesh would need more than 50000000 triangles"),
    ] {
        let file = fixture(&format!("polygons/refused/{name}.geojson"));
        bench.run(&format!("mesh {file} -o m.ele")).refused(&format!("{name}.geojson{place}: {words}"));
        assert!(bench.names().is_empty());
    }
}

/// Points with and without heights, a spike, borders that meet in one point more or not quite,
/// millimetres far from the origin.
#[test]
fn other_geojson_is_meshed_as_it_is() {
    let bench = Bench::new();
    for (name, warnings) in [
        ("point1", 0),
        ("pointz", 0),
        ("spike_r", 0),
        ("slivergap_r", 0),
        ("adj_tjunction_r", 3),
        ("millimetres_3857", 0),
    ] {
        let file = fixture(&format!("polygons/{name}.geojson"));
        let run = bench.run(&format!("mesh {file} -q -o m.ele"));
        assert_eq!((run.code, run.err.lines().count()), (0, warnings), "{name}: {}", run.err);
        assert_eq!(bench.run(&format!("check m.ele --input {file}")).code, 0, "{name}");
    }
}

#[test]
fn a_mesh_may_lie_beside_a_graph_that_has_its_points_in_it() {
    let bench = Bench::new();
    bench.file("box.poly", std::fs::read(fixture("triangle/box_closed.poly")).unwrap());
    bench.run("mesh box.poly -q -o box.ele").fine();
    assert_eq!(bench.names(), ["box.ele", "box.node", "box.poly"]);
    bench.run("check box.ele --input box.poly").fine();
}
