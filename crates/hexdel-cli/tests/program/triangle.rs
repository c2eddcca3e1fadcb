//! `hexdel triangle`.

use crate::support::{Bench, fixture};

fn bench_with(name: &str) -> Bench {
    let bench = Bench::new();
    bench.file("in.poly", std::fs::read(fixture(&format!("graphs/{name}.poly"))).unwrap());
    bench
}

#[test]
fn the_habitual_call_makes_the_habitual_files() {
    let bench = bench_with("square_with_hole");
    let run = bench.run("triangle -pq30a0.1 in.poly");
    run.fine();
    assert!(run.out.contains("certified"), "{}", run.out);
    assert_eq!(bench.names(), ["in.1.ele", "in.1.node", "in.1.poly", "in.poly"]);
    bench.run("check in.1.ele --input in.poly").fine();
    // The next round goes on from there.
    bench.run("triangle -pQ in.1").fine();
    assert!(bench.names().contains(&"in.2.ele".to_owned()));
    let quiet = bench.run("triangle -pQP in");
    assert_eq!((quiet.code, quiet.out.as_str(), quiet.err.as_str()), (0, "", ""));
}

#[test]
fn everything_else_is_written_too() {
    let bench = bench_with("regions");
    bench.run("triangle -p -A -a -e -n -v -g -o2 -z -D -Q in").fine();
    let files = ["edge", "ele", "neigh", "node", "off", "poly", "v.edge", "v.node"];
    let names: Vec<String> = files.iter().map(|e| format!("in.1.{e}")).chain(["in.poly".into()]).collect();
    assert_eq!(bench.names(), names);
    let text = |name: &str| String::from_utf8(bench.read(name)).unwrap();
    let elements = text("in.1.ele");
    let header: Vec<&str> = elements.lines().next().unwrap().split_whitespace().collect();
    assert_eq!(header[1..], ["6", "1"]);
    assert!(elements.lines().skip(1).all(|row| row.split_whitespace().count() == 8));
    let count = |name: &str| text(name).split_whitespace().next().unwrap().parse::<usize>().unwrap();
    // A vertex, an edge and a triangle each: nodes are vertices and midpoints.
    let (nodes, edges, triangles) = (count("in.1.node"), count("in.1.edge"), count("in.1.ele"));
    assert_eq!(nodes - edges + triangles, edges + 1);
    assert_eq!(count("in.1.neigh"), triangles);
}

#[test]
fn areas_of_regions_count_when_asked_for() {
    let triangles = |switches: &str| {
        let bench = bench_with("regions");
        bench.run(&format!("triangle -Q {switches} in.poly")).fine();
        let text = String::from_utf8(bench.read("in.1.ele")).unwrap();
        text.split_whitespace().next().unwrap().parse::<usize>().unwrap()
    };
    let (plain, by_region) = (triangles("-p"), triangles("-pa"));
    assert!(by_region >= 40 && by_region > plain, "{plain} {by_region}");
    // Points alone fill their convex hull, without the walls.
    assert!(triangles("-pc") > plain);
}

#[test]
fn points_fill_their_hull() {
    let bench = Bench::new();
    bench.file("dots.node", "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n");
    let run = bench.run("triangle dots");
    run.fine();
    assert!(run.out.contains("domain hull"), "{}", run.out);
    assert_eq!(bench.names(), ["dots.1.ele", "dots.1.node", "dots.node"]);
}

#[test]
fn what_does_not_fit_is_refused() {
    let bench = bench_with("square_with_hole");
    for (arguments, words) in [
        ("-pY in.poly", "-Y: segments must be divided"),
        ("-pq70 in.poly", "no triangle has all angles"),
        ("-p", "one file is needed"),
        ("-p in.poly in.poly", "one file is needed"),
        ("-p missing", "missing.poly: no such file"),
        ("-pI in", "-I: the input is not replaced"),
        ("-pr in", "-r: meshes are not refined"),
    ] {
        bench.run(&format!("triangle {arguments}")).refused(words);
        assert_eq!(bench.names(), ["in.poly"], "{arguments}");
    }
}
