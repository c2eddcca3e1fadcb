//! `hexdel check`.

use crate::support::{Bench, fixture};
use std::process::Stdio;

const SQUARE: &str = "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n";

/// Checks a mesh of the square's corners.
fn check(elements: &str, options: &str) -> crate::support::Run {
    let bench = Bench::new();
    bench.file("m.node", SQUARE);
    bench.file("m.ele", elements);
    bench.run(&format!("check m.ele {options}"))
}

#[test]
fn a_good_mesh_holds() {
    let run = check("2 3 0\n0 0 1 2\n1 0 2 3\n", "");
    run.fine();
    assert!(run.out.ends_with("holds\n"));
}

#[test]
fn bounds_are_what_is_asked_for() {
    let elements = "2 3 0\n0 0 1 2\n1 0 2 3\n";
    assert_eq!(check(elements, "--min-angle 45 --max-angle 90").code, 0);
    let run = check(elements, "--min-angle 46");
    assert_eq!(run.code, 1);
    assert!(run.out.contains("2 triangles not within 46.0000 to 90.0000"), "{}", run.out);
    assert_eq!(check(elements, "--max-angle 89").code, 1);
    for options in ["--min-angle 61", "--max-angle 59", "--min-angle NaN", "--min-angle -1"] {
        check(elements, options).refused("no triangle has all angles between");
    }
}

/// Bounds and exempt triangles travel with the mesh in the formats that carry them.
#[test]
fn what_the_program_wrote_passes() {
    let bench = Bench::new();
    // A corner of 16.7 degrees.
    bench.file("sliver.poly", "3 2 0 0\n0 0 0\n1 1 0\n2 1 0.3\n3 0\n0 0 1\n1 1 2\n2 2 0\n0\n");
    let outputs = "-o m.ele -o m.vtu -o m.msh -o m.msh2 -o m.json -o m.ron -o m.off";
    bench.run(&format!("mesh sliver.poly -q {outputs}")).fine();
    for mesh in ["m.ele", "m.vtu", "m.msh", "m.msh2", "m.json", "m.ron"] {
        let run = bench.run(&format!("check {mesh}"));
        run.fine();
        assert!(run.out.contains("within 30.0000 to 90.0000 degrees"), "{}", run.out);
        assert!(run.out.contains("1 triangles exempt, the file says"), "{}", run.out);
        assert!(run.out.contains("--input FILE also checks"), "{}", run.out);
        let run = bench.run(&format!("check {mesh} --input sliver.poly"));
        run.fine();
        assert!(run.out.contains("1 triangles exempt at corners"), "{}", run.out);
        assert_eq!(bench.run(&format!("check {mesh} --min-angle 30")).code, 1, "{mesh}");
    }
    // This format says nothing: what is found is told.
    let run = bench.run("check m.off");
    run.fine();
    assert!(run.out.contains("no bounds are known"), "{}", run.out);
    assert_eq!(bench.run("check m.off --min-angle 30").code, 1);
    bench.run("check m.off --min-angle 30 --input sliver.poly").fine();
}

/// An exempt triangle is so for its lower bound only, and only if the file says so.
#[test]
fn exempt_triangles_are_those_listed() {
    let promise = |exempt: &str| {
        format!(
            "2 3 0\n0 0 1 2\n1 0 2 3\n# hexdel: angles 46 90 far 46 90 domain inside\n# hexdel: exempt{exempt}\n"
        )
    };
    check(&promise(" 0 1"), "").fine();
    let run = check(&promise(" 1"), "");
    assert!(run.code == 1 && run.out.contains("1 triangles not within 46.0000 to 90.0000"), "{}", run.out);
    let above = promise(" 0 1").replace("46 90", "40 80");
    assert_eq!(check(&above, "").code, 1);
}

/// Two edges from points and segments other bounds are promised.
#[test]
fn the_far_bound_is_checked_with_the_input() {
    let bench = Bench::new();
    bench.file("square.poly", "4 2 0 0\n0 0 0\n1 9 0\n2 9 9\n3 0 9\n4 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n0\n");
    bench.run("mesh square.poly -q -o m.ele -a 0.5").fine();
    let run = bench.run("check m.ele --input square.poly");
    run.fine();
    assert!(run.out.contains("two edges from points and segments, within 43.8978 to 90.0000"), "{}", run.out);
    let strict = String::from_utf8(bench.read("m.ele")).unwrap().replace("far 43.8978 90", "far 59 61");
    bench.file("m.ele", &strict);
    let run = bench.run("check m.ele --input square.poly");
    assert!(
        run.code == 1 && run.out.contains("two edges from points and segments not within"),
        "{}",
        run.out
    );
    bench.run("check m.ele").fine();
}

/// So they are for points alone, in domains where the bounds beside them are others.
#[test]
fn the_far_bound_of_points_is_checked_in_a_hull_and_in_a_box() {
    let bench = Bench::new();
    bench.file("p.txt", "0 0\n9 0\n9 9\n0 9\n4 4\n");
    for domain in ["hull", "box"] {
        bench.run(&format!("mesh p.txt -q -o m.ele -a 0.5 --domain {domain}")).fine();
        let run = bench.run("check m.ele --input p.txt");
        run.fine();
        assert!(run.out.contains("two edges from points and segments, within 43.8978"), "{}", run.out);
        assert!(!run.out.contains("unions of edges"), "{}", run.out);
        let strict = String::from_utf8(bench.read("m.ele")).unwrap().replace("far 43.8978 90", "far 59 61");
        bench.file("m.ele", &strict);
        let run = bench.run("check m.ele --input p.txt");
        assert!(run.code == 1 && run.out.contains("FAIL"), "{domain}: {}", run.out);
        assert!(run.out.contains("degrees, two edges from points and segments\n"), "{}", run.out);
        // A point that is not there is missed as ever.
        bench.file("q.txt", "0 0\n4.5 4.25\n");
        let run = bench.run("check m.ele --input q.txt");
        assert!(run.out.contains("FAIL  1 of 2 input points are vertices"), "{}", run.out);
    }
}

/// Corners of the hull are exempt where they are narrower than the bound, with the input as
/// without it; so are fans in a box.
#[test]
fn narrow_corners_of_other_domains_are_exempt() {
    let bench = Bench::new();
    bench.file("p.txt", "0 0\n3 0\n3 0.6\n1 0.1\n");
    bench.file("s.poly", "4 2\n0 0 0\n1 3 0\n2 3 0.6\n3 1 0.1\n1 0\n0 1 3\n0\n");
    bench.file("v.poly", "4 2\n0 0 0\n1 3 0\n2 3 0.3\n3 1 2\n2 0\n0 0 1\n1 0 2\n0\n");
    for (input, domain) in [("p.txt", "hull"), ("s.poly", "hull"), ("v.poly", "box"), ("v.poly", "hexagon")] {
        bench.run(&format!("mesh {input} -q -o m.ele --domain {domain} -a 0.01")).fine();
        bench.run("check m.ele").fine();
        let run = bench.run(&format!("check m.ele --input {input}"));
        assert_eq!(run.code, 0, "{input} {domain}: {}", run.out);
    }
}

#[test]
fn whatever_is_wrong_with_a_mesh_is_told() {
    for (elements, words) in [
        ("2 3 0\n0 0 2 1\n1 0 2 3\n", "clockwise or flat"),
        ("2 3 0\n0 0 1 1\n1 0 2 3\n", "vertex 1 twice"),
        ("2 3 0\n0 0 1 2\n1 0 1 3\n", "again"),
        ("1 3 0\n0 0 1 2\n", "vertex 3: in no triangle"),
        ("0 3 0\n", "no triangles"),
    ] {
        let run = check(elements, "");
        assert_eq!((run.code, run.err.as_str()), (1, ""), "{elements}");
        assert!(run.out.contains(words) && run.out.ends_with("does not hold\n"), "{}", run.out);
    }
    for (elements, words) in [
        ("1 3 0\n0 0 1 4\n", "m.ele:2: no point 4"),
        ("1 3 0\n0 -1 1 2\n", "m.ele:2: no point -1"),
        ("2 3 0\n0 0 1 2\n", "file ends after 1 of 2 triangles"),
        ("99999999999 3 0\n", "m.ele:1: more than"),
        ("", "number of triangles"),
    ] {
        check(elements, "").refused(words);
    }
}

#[test]
fn missing_input_points_fail_the_check() {
    let bench = Bench::new();
    bench.file("m.node", SQUARE);
    bench.file("m.ele", "2 3 0\n0 0 1 2\n1 0 2 3\n");
    bench.file("p.txt", "0 0\n0.5 0.5\n");
    let run = bench.run("check m.ele --input p.txt");
    assert_eq!(run.code, 1);
    assert!(run.out.contains("FAIL  1 of 2 input points are vertices"), "{}", run.out);
    assert!(run.out.contains("input point 1 (0.5, 0.5): no vertex"), "{}", run.out);
}

#[test]
fn json_says_the_same() {
    let run = check("2 3 0\n0 0 1 2\n1 0 1 3\n", "--json");
    assert_eq!(run.code, 1);
    let json: serde_json::Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!((&json["holds"], &json["manifold"]), (&false.into(), &false.into()));
    assert!(!json["violations"].as_array().unwrap().is_empty());
}

#[test]
fn bad_files_are_refused() {
    let bench = Bench::new();
    bench.file("a.ron", "(vertices: [(0.0, NaN)], triangles: [])");
    bench.file("b.ron", "nonsense");
    for (mesh, words) in [
        ("missing.ele", "no such file"),
        ("a.svg", "is written, not read"),
        ("a.xls", "unknown extension"),
        ("a.ron", "not finite"),
        ("b.ron", "b.ron:1:"),
    ] {
        bench.run(&format!("check {mesh}")).refused(words);
    }
}

#[test]
fn a_closed_pipe_is_no_failure() {
    let bench = Bench::new();
    for options in ["", "--json"] {
        let mut child = bench
            .command(&format!("check {} {options}", fixture("formats/fan.ele")))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), output.stderr), (Some(0), Vec::new()));
    }
}

/// What a polygon's file says is outside is part of the hull, narrow corners there too.
#[test]
fn the_input_is_taken_as_for_the_domain_of_the_mesh() {
    let bench = Bench::new();
    bench.file(
        "l.geojson",
        r#"{"type":"GeometryCollection","geometries":[
        {"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,4],[0,0]]]},
        {"type":"LineString","coordinates":[[10,0],[14,0.5],[14,-0.5],[10,0]]}]}"#,
    );
    for domain in ["hull", "hexagon", "box", "inside"] {
        bench.run(&format!("mesh l.geojson -q -o m.vtu --domain {domain}")).fine();
        let run = bench.run("check m.vtu --input l.geojson");
        assert_eq!(run.code, 0, "{domain}: {}", run.out);
    }
}
