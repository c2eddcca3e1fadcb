//! `hexdel mesh` and `hexdel check` of PSLGs.

use crate::support::{Bench, fixture};

fn graph(name: &str) -> String {
    fixture(&format!("graphs/{name}.poly"))
}

#[test]
fn a_graph_is_meshed_inside_without_its_holes_and_holds() {
    let bench = Bench::new();
    for name in ["square_with_hole", "regions", "t_junction", "letters", "airfoil"] {
        let input = graph(name);
        let run = bench.run(&format!("mesh {input} -o m.ele -o m.vtu --report r.json"));
        run.fine();
        assert!(run.out.contains("certified") && run.out.contains("domain inside"), "{}", run.out);
        let check = bench.run(&format!("check m.ele --input {input}"));
        check.fine();
        assert!(check.out.contains("segments are unions of edges"), "{}", check.out);
        let report = bench.json("r.json");
        assert_eq!((&report["holds"], &report["domain"]), (&true.into(), &"inside".into()), "{name}");
        assert!(report["min_angle_deg"].as_f64().unwrap() >= 30.0 - 1e-8);
        assert!(report["max_angle_deg"].as_f64().unwrap() <= 90.0 + 1e-8);
        let edges = report["edges_of_segment"].as_array().unwrap();
        let sum: u64 = edges.iter().map(|e| e.as_u64().unwrap()).sum();
        assert_eq!(Some(sum), report["segment_edges"].as_u64());
    }
}

#[test]
fn markers_and_regions_are_written() {
    let bench = Bench::new();
    bench.run(&format!("mesh {} -q -o a.ele", graph("square_with_hole"))).fine();
    bench.run(&format!("mesh {} -q -o b.ele -o b.vtu", graph("regions"))).fine();
    let text = |name: &str| String::from_utf8(bench.read(name)).unwrap();
    assert!(text("a.node").lines().next().unwrap().ends_with(" 2 1 1"));
    assert!(text("a.node").lines().any(|line| line.ends_with(" 13")));
    assert!(text("a.ele").lines().next().unwrap().ends_with(" 3 0"));
    let attributes = |line: &str| line.starts_with('#') || line.ends_with(" 10.5") || line.ends_with(" 20.0");
    assert!(text("b.ele").lines().skip(1).all(attributes));
    assert!(text("b.vtu").contains("Name=\"region\"") && text("b.vtu").contains("Name=\"marker\""));
}

#[test]
fn domains_cover_points_and_graphs() {
    let bench = Bench::new();
    let points = fixture("points/plane100.node");
    let vertices = |input: &str, domain: &str| {
        bench.run(&format!("mesh {input} -q --domain {domain} -o m.ele --report r.json")).fine();
        bench.run(&format!("check m.ele --input {input} --min-angle 20")).fine();
        bench.json("r.json")["triangles"].as_u64().unwrap()
    };
    for domain in ["hexagon", "hull", "box"] {
        assert!(vertices(&points, domain) > 200, "{domain}");
    }
    let letters = graph("airfoil");
    assert!(vertices(&letters, "inside") < vertices(&letters, "hexagon"));
    bench.run(&format!("mesh {points} -o m.ele --domain inside")).refused("the segments enclose no area");
    bench.run(&format!("mesh {points} -o m.ele --domain disk")).refused("disk");
}

#[test]
fn methods_and_ways_are_at_choice() {
    let bench = Bench::new();
    let input = graph("airfoil");
    let report = |more: &str| {
        bench.run(&format!("mesh {input} -q --report r.json {more}")).fine();
        bench.json("r.json")
    };
    let triangles = |report: &serde_json::Value| report["triangles"].as_u64().unwrap();
    let (compact, templates) = (report("--method compact"), report("--method templates"));
    assert!(triangles(&compact) < triangles(&templates));
    let paper = report("--pslg paper");
    assert_eq!((&paper["method"], &compact["method"]), (&"paper".into(), &"conform".into()));
}

#[test]
fn a_fan_at_a_narrow_corner_passes_the_check() {
    let bench = Bench::new();
    let wedge = "3 2 0 0\n1 1 0\n2 0 0\n3 0.9 0.01\n2 0\n1 1 2\n2 2 3\n0\n";
    bench.file("wedge.poly", wedge);
    bench.run("mesh wedge.poly -q -o m.ele --report r.json --domain hexagon").fine();
    assert!(bench.json("r.json")["exempt"].as_array().unwrap().len() > 1);
    bench.run("check m.ele --input wedge.poly").fine();
    bench.file("apart.poly", wedge.replace("0.9 0.01", "0.9 0.9"));
    assert_eq!(bench.run("check m.ele --input apart.poly").code, 1);
}

/// Five points over a kilometre with a noise of centimetres, a hull that is a hair: what time
/// there is leaves a mesh of all points.
#[test]
fn a_hull_like_a_hair_keeps_its_budget() {
    let bench = Bench::new();
    let input = fixture("tables/track5_cm.csv");
    let run = bench.run(&format!("mesh {input} -q -o m.ele --domain hull --budget 0.5"));
    assert_eq!(run.code, 3, "{}", run.err);
    assert!(
        bench.run(&format!("check m.ele --input {input}")).out.contains("5 of 5 input points are vertices")
    );
}

#[test]
fn a_budget_that_is_spent_leaves_a_mesh_with_all_segments() {
    let bench = Bench::new();
    let input = graph("airfoil");
    let run = bench.run(&format!("mesh {input} -q -o m.ele --report r.json --budget 0"));
    assert_eq!(run.code, 3, "{}", run.err);
    let report = bench.json("r.json");
    assert_eq!((&report["budget_spent"], &report["segments_missing"]), (&true.into(), &0.into()));
    bench.run(&format!("mesh {input} -q -o m.ele --report r.json --budget 3600")).fine();
    assert_eq!(bench.json("r.json")["budget_spent"], false);
}

#[test]
fn areas_are_limited() {
    let bench = Bench::new();
    let input = graph("square_with_hole");
    let triangles = |more: &str| {
        bench.run(&format!("mesh {input} -q --report r.json {more}")).fine();
        bench.json("r.json")["triangles"].as_u64().unwrap()
    };
    assert!(triangles("--max-area 0.01") >= 1500);
    assert!(triangles("--max-area 0.01") > 4 * triangles(""));
    let points = fixture("points/two_points.node");
    bench.run(&format!("mesh {points} -q --max-area 0.01 -o m.ele")).fine();
    bench.run(&format!("mesh {input} -o m.ele --max-area 0")).refused("must be a positive number");
}

#[test]
fn faults_of_graphs_are_named_and_repaired_if_asked_for() {
    let bench = Bench::new();
    let crossing = graph("crossing");
    bench.run(&format!("mesh {crossing} -o m.ele")).refused("segments 4 and 5 cross at (0.5, 0.5)");
    bench.run(&format!("mesh {} -o m.ele", graph("needle"))).refused("point 4 and segment 0 are too close");
    assert!(bench.names().is_empty());
    for repair in ["--repair", "--repair=1e-6"] {
        let run = bench.run(&format!("mesh {crossing} -o m.ele --report r.json {repair}"));
        run.fine();
        assert!(run.out.contains("repaired   1\n           segments 4 and 5 crossed"), "{}", run.out);
        assert_eq!(bench.json("r.json")["repairs"][0]["at"], serde_json::json!([0.5, 0.5]));
        bench.run(&format!("check m.ele --input {crossing}")).fine();
        bench.run(&format!("mesh {} -q -o m.ele {repair}", graph("needle"))).fine();
    }
    bench.run(&format!("mesh {crossing} -o m.ele --repair=-1")).refused("must be a distance, 0 or more");
    bench.run(&format!("mesh {crossing} -o m.ele --method simple")).refused("applies to points");
    bench.run(&format!("mesh {crossing} -o m.ele --domain-radius 9")).refused("applies to points");
}

/// What fails is written, told of triangle by triangle, and exits with 1.
#[test]
fn triangles_out_of_bounds_are_listed() {
    let bench = Bench::new();
    // A corner of a fiftieth of a degree, for which the method is not made.
    let (input, apex) = ("needle.poly", 0.02_f64.to_radians().tan());
    let frame = "3 -1 -1\n4 2 -1\n5 2 1\n6 -1 1\n6 0\n0 0 1\n1 0 2\n2 3 4\n3 4 5\n4 5 6\n5 6 3\n0\n";
    bench.file(input, format!("7 2 0 0\n0 0 0\n1 1 0\n2 1 {apex}\n{frame}"));
    let run = bench.run(&format!("mesh {input} -o m.ele --report r.json"));
    assert_eq!(run.code, 1);
    assert!(run.err.starts_with("warning: "), "{}", run.err);
    assert!(run.out.contains("NOT MET"), "{}", run.out);
    assert!(run.out.contains("near point 0, where segments meet at 0.02"), "{}", run.out);
    let report = bench.json("r.json");
    let failed = report["failed"].as_array().unwrap();
    for entry in failed {
        // Near corners of the fan around the point, or near nothing to blame.
        let corner = entry["corner"]["angle_deg"].as_f64();
        let reason = if corner.is_some() { "near sector" } else { "unsolved" };
        assert_eq!(entry["reason"], reason);
        assert!(entry["at"][0].is_f64() && corner.unwrap_or(0.0) < 30.0);
    }
    assert_eq!(report["exempt"][0]["reason"], "sector");
    // The check comes to the same triangles by itself, though it excuses only
    // those at the corner.
    let check = bench.run(&format!("check m.ele --input {input} --json"));
    assert_eq!(check.code, 1);
    let found: serde_json::Value = serde_json::from_str(&check.out).unwrap();
    let listed = failed.len() + report["exempt"].as_array().unwrap().len();
    let sum = found["out_of_bounds"].as_u64().unwrap() + found["exempt"].as_u64().unwrap();
    assert_eq!(sum, listed as u64);
    assert_eq!(&found["segments"]["kept"], 6);
}

#[test]
fn segments_that_are_no_edges_fail_the_check() {
    let bench = Bench::new();
    bench.file("m.node", "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n");
    bench.file("m.ele", "2 3 0\n0 0 1 2\n1 0 2 3\n");
    let poly = |segment: &str| format!("4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n1 0\n0 {segment}\n0\n");
    bench.file("kept.poly", poly("2 0"));
    bench.file("lost.poly", poly("1 3"));
    bench.run("check m.ele --input kept.poly").fine();
    let run = bench.run("check m.ele --input lost.poly");
    assert_eq!(run.code, 1);
    assert!(run.out.contains("FAIL  0 of 1 segments are unions of edges"), "{}", run.out);
    assert!(run.out.contains("segment 0 (1, 0) (0, 1): edges lead only to (1, 0)"), "{}", run.out);
}

#[test]
fn graphs_keep_to_sizes() {
    let bench = Bench::new();
    bench.file("sizes.txt", "0 0 0.05\n4 4 1\n");
    let input = graph("square_with_hole");
    let mut triangles = Vec::new();
    for size in ["--size 2", "--size 0.3", "--size-file sizes.txt", "--size 0.3 --size-file sizes.txt"] {
        let run = bench.run(&format!("mesh {input} {size} -o m.ele --report r.json"));
        run.fine();
        assert!(run.out.contains("of the length wanted"), "{}", run.out);
        let report = bench.json("r.json");
        let ratio = report["size_ratio"].as_f64().unwrap();
        assert!((0.3..=1.0 + 1e-9).contains(&ratio), "{size}: {ratio}");
        assert_eq!(report["failed"].as_array().unwrap().len(), 0);
        triangles.push(report["triangles"].as_u64().unwrap());
    }
    assert!(triangles[0] < triangles[1] && triangles[1] < triangles[3] && triangles[2] < triangles[3]);
    bench.run(&format!("mesh {input} -q -o m.ele --report r.json")).fine();
    assert!(bench.json("r.json")["size_ratio"].is_null());
    bench.run(&format!("mesh {input} -o m.ele --size 1e-14")).refused("below");
    bench.run(&format!("mesh {input} -o m.ele --size 1e-6")).refused("more than 50000000 triangles");
    bench.run(&format!("mesh {input} -o m.ele --size 0")).refused("positive");
}
