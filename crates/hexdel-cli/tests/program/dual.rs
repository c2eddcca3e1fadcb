//! `hexdel dual`.

use crate::support::{Bench, fixture};

#[test]
fn a_mesh_without_obtuse_angles_has_no_negative_weight() {
    let bench = Bench::new();
    let points = fixture("points/capitals.node");
    bench.run(&format!("mesh {points} -o m.ele --quiet")).fine();
    let run = bench.run("dual m.ele -o cells.vtu -o m.v.node --json");
    run.fine();
    let summary: serde_json::Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!((&summary["negative_weights"], &summary["obtuse_triangles"]), (&0.into(), &0.into()));
    assert!(summary["max_skew"].as_f64().unwrap() < 1e-9);
    assert_eq!(bench.names(), ["cells.vtu", "m.ele", "m.node", "m.v.edge", "m.v.node"]);
}

#[test]
fn a_negative_weight_fails() {
    let bench = Bench::new();
    bench.file("m.node", "3 2 0 0\n0 0 0\n1 4 0\n2 2 1\n");
    bench.file("m.ele", "1 3 0\n0 0 1 2\n");
    let run = bench.run("dual m.ele");
    assert_eq!((run.code, run.err.as_str()), (1, ""));
    assert!(run.out.contains("1 negative"), "{}", run.out);
}

#[test]
fn what_has_no_dual_is_refused() {
    let bench = Bench::new();
    bench.file("m.node", "3 2 0 0\n0 0 0\n1 4 0\n2 2 1\n");
    bench.file("m.ele", "1 3 0\n0 0 2 1\n");
    bench.run("dual m.ele -o m.vtu").refused("triangle 0 is flat, clockwise");
    bench.run("dual m.ele -o m.v.xyz").refused("expected one of .vtu, .v.node, .v.edge");
    assert_eq!(bench.names(), ["m.ele", "m.node"]);
}

#[test]
fn a_mesh_comes_through_a_pipe() {
    let bench = Bench::new();
    let mesh = b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let run = bench.fed("dual - --format off -o cells.vtu", mesh);
    run.fine();
    assert!(run.out.starts_with("-: 3 edges"), "{}", run.out);
    assert_eq!(bench.names(), ["cells.vtu"]);
    let run = bench.fed("dual -", mesh);
    run.refused("standard input has no extension to tell its format");
    assert!(run.err.contains("help: name it with --format\n"), "{}", run.err);
    bench.file("m.off", mesh);
    bench.run("dual m.off --format off").refused("--format has no effect: it names the format of -");
}
