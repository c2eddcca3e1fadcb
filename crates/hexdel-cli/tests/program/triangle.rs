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
    bench.run("triangle -p -A -a -e -n -v -g -o2 -z -j -D -Q in").fine();
    let files = ["edge", "ele", "neigh", "node", "off", "poly", "v.edge", "v.node"];
    let names: Vec<String> = files.iter().map(|e| format!("in.1.{e}")).chain(["in.poly".into()]).collect();
    assert_eq!(bench.names(), names);
    let text = |name: &str| String::from_utf8(bench.read(name)).unwrap();
    let elements = text("in.1.ele");
    let header: Vec<&str> = elements.lines().next().unwrap().split_whitespace().collect();
    assert_eq!(header[1..], ["6", "1"]);
    let rows = elements.lines().skip(1).filter(|row| !row.starts_with('#'));
    assert!(rows.clone().count() > 0 && rows.map(|row| row.split_whitespace().count()).all(|n| n == 8));
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

/// The rows of a file of Triangle's after its first header, up to the next.
fn rows(bench: &Bench, name: &str) -> Vec<Vec<f64>> {
    let text = String::from_utf8(bench.read(name)).unwrap();
    let mut rows = text.lines().map(|row| row.split_whitespace().map(|n| n.parse().unwrap()).collect());
    let header: Vec<f64> = rows.next().unwrap();
    rows.take(header[0] as usize).collect()
}

#[test]
fn a_poly_is_a_graph_whether_it_is_said_or_not() {
    let bench = Bench::new();
    bench.file("box.poly", std::fs::read(fixture("triangle/box_closed.poly")).unwrap());
    let run = bench.run("triangle box.poly");
    run.fine();
    assert!(run.out.contains("domain inside"), "{}", run.out);
    let said = ["box.1.ele", "box.1.node", "box.1.poly"].map(|name| bench.read(name));
    bench.run("triangle -p box.poly").fine();
    assert_eq!(["box.1.ele", "box.1.node", "box.1.poly"].map(|name| bench.read(name)), said);
    // Holes go on to the next round.
    let area = |mesh: &str| {
        let nodes = rows(&bench, &format!("{mesh}.node"));
        let area = |t: &Vec<f64>| {
            let [a, b, c] = [1, 2, 3].map(|k| &nodes[t[k] as usize - 1]);
            0.5 * ((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]))
        };
        rows(&bench, &format!("{mesh}.ele")).iter().map(area).sum::<f64>()
    };
    bench.run("triangle -Q box.1.poly").fine();
    assert!((area("box.1") - 8.0).abs() < 1e-9 && (area("box.2") - 8.0).abs() < 1e-9);
    bench.run("triangle box.1.ele").refused("-r: meshes are not refined");
}

#[test]
fn input_points_are_first_with_their_numbers_and_attributes() {
    let bench = Bench::new();
    let text = std::fs::read_to_string(fixture("triangle/letter_A.poly")).unwrap();
    bench.file("A.poly", &text);
    bench.run("triangle -pqa0.01Q A.poly").fine();
    let given: Vec<Vec<f64>> = text
        .lines()
        .skip(2)
        .take(11)
        .map(|row| row.split_whitespace().map(|n| n.parse().unwrap()).collect())
        .collect();
    let nodes = rows(&bench, "A.1.node");
    assert!(nodes.len() > 60);
    for (i, (node, given)) in nodes.iter().zip(&given).enumerate() {
        assert_eq!((node[0], &node[..4]), (i as f64 + 1.0, &given[..]));
    }
    // Those between are between, and the rest is numbered from 1 as well.
    let (least, most) = (-0.55, 0.3);
    assert!(nodes.iter().all(|node| (least..=most).contains(&node[3])), "{nodes:?}");
    assert!(nodes[11..].iter().any(|node| node[3].fract().abs() > 1e-6));
    let elements = rows(&bench, "A.1.ele");
    assert_eq!(elements[0][0], 1.0);
    let corners = elements.iter().flat_map(|row| &row[1..4]);
    let (first, last) = corners.fold((f64::MAX, 0.0_f64), |(a, b), &c| (a.min(c), b.max(c)));
    assert_eq!((first, last), (1.0, nodes.len() as f64));
    bench.run("check A.1.ele --input A.poly").fine();
    bench.run("triangle -pqzQ A.poly").fine();
    assert_eq!((rows(&bench, "A.1.node")[0][0], rows(&bench, "A.1.ele")[0][0]), (0.0, 0.0));
    // Six nodes each, with the means of the attributes.
    bench.run("triangle -pqo2enQ A.poly").fine();
    assert!(rows(&bench, "A.1.node").iter().all(|node| node.len() == 5 && (least..=most).contains(&node[3])));
    assert_eq!((rows(&bench, "A.1.edge")[0][0], rows(&bench, "A.1.neigh")[0][0]), (1.0, 1.0));
}

#[test]
fn points_that_are_no_vertices_keep_their_numbers() {
    let bench = Bench::new();
    bench.file(
        "a.poly",
        "6 2 1\n1 0 0 5\n2 1 0 5\n3 1 0 6\n4 1 1 5\n5 0 1 5\n6 9 9 7\n4 0\n1 1 2\n2 3 4\n3 4 5\n4 5 1\n0\n",
    );
    let run = bench.run("triangle -Q a.poly");
    assert_eq!(
        (run.code, run.err.as_str()),
        (0, "warning: a.poly: point 2 was a duplicate of point 1 at (1, 0)\n")
    );
    let nodes = rows(&bench, "a.1.node");
    assert_eq!((&nodes[2][..4], &nodes[5][..4]), (&[3.0, 1.0, 0.0, 6.0][..], &[6.0, 9.0, 9.0, 7.0][..]));
    let used = |name: f64| rows(&bench, "a.1.ele").iter().any(|row| row[1..4].contains(&name));
    assert!(used(2.0) && !used(3.0) && !used(6.0));
    bench.run("check a.1.ele --input a.poly").fine();
    assert_eq!(bench.run("triangle -Qj a.poly").code, 0);
    assert_eq!(rows(&bench, "a.1.node").len(), nodes.len() - 2);
    bench.run("check a.1.ele --input a.poly").fine();
}

#[test]
fn segments_that_meet_are_divided_with_a_warning() {
    let bench = Bench::new();
    bench.file("x.poly", std::fs::read(fixture("triangle/crossing.poly")).unwrap());
    let run = bench.run("triangle -Q x.poly");
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.err.lines().all(|line| line.starts_with("warning: x.poly: ")), "{}", run.err);
    for words in ["segments 5 and 6 crossed at (2, 2)", "segment 8 had no length", "overlapped at"] {
        assert!(run.err.contains(words), "{words}: {}", run.err);
    }
    let nodes = rows(&bench, "x.1.node");
    assert!(nodes.iter().any(|node| node[1..3] == [2.0, 2.0]));
    // Attributes that are linear stay so, at the crossing too.
    for node in &nodes {
        assert!((node[3] - (1.0 + 2.0 * node[1] - 3.0 * node[2])).abs() < 1e-9, "{node:?}");
        assert!((node[4] - node[1]).abs() < 1e-9, "{node:?}");
    }
    bench.file("alone.poly", "4 2\n1 0 0\n2 4 4\n3 4 0\n4 0 4\n2 0\n1 1 2\n2 3 4\n0\n");
    assert_eq!(bench.run("triangle -pcQ alone").code, 0);
}

/// A point that nearly lies on a segment is not on it: seen from the ends at 0.01 degrees.
#[test]
fn segments_are_not_bent_to_points_near_them() {
    let bench = Bench::new();
    bench.file(
        "near.poly",
        "6 2\n1 0 0\n2 10 0\n3 10 4\n4 0 4\n5 5 0.0009\n6 5 0.000900005\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n",
    );
    bench.run("triangle -Q near.poly").fine();
    bench.run("check near.1.ele --input near.poly").fine();
    let nodes = rows(&bench, "near.1.node");
    assert_eq!((&nodes[4][1..3], &nodes[5][1..3]), (&[5.0, 0.0009][..], &[5.0, 0.000_900_005][..]));
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
        ("-pa0 in", "-a0: the largest area must be positive, got 0"),
        ("-pq1.2.3 in", "-q1.2.3: the smallest angle must be a number, got 1.2.3"),
    ] {
        bench.run(&format!("triangle {arguments}")).refused(words);
        assert_eq!(bench.names(), ["in.poly"], "{arguments}");
    }
}
