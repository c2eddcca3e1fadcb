//! `hexdel mesh`.

use crate::support::{Bench, fixture};

#[test]
fn a_real_input_is_meshed_and_holds() {
    let bench = Bench::new();
    let input = fixture("points/capitals.node");
    let run = bench.run(&format!("mesh {input} -o new/folder/a.ele -o new/folder/a.svg -o a.vtu -o a.ron"));
    run.fine();
    assert!(run.out.contains("points     243\n") && run.out.contains("certified"), "{}", run.out);
    assert_eq!(bench.names(), ["a.ron", "a.vtu", "new"]);
    assert!(bench.read("new/folder/a.svg").starts_with(b"<svg"));
    for mesh in ["new/folder/a.ele", "a.ron"] {
        let check = bench.run(&format!("check {mesh} --input {input}"));
        check.fine();
        assert!(check.out.contains("243 of 243 input points are vertices"), "{}", check.out);
    }
}

#[test]
fn the_report_has_the_figures() {
    let bench = Bench::new();
    bench.run(&format!("mesh {} -q --report r.json", fixture("points/plane100.node"))).fine();
    let report = bench.json("r.json");
    for key in [
        "vertices",
        "triangles",
        "min_angle_deg",
        "max_angle_deg",
        "out_of_bounds",
        "delaunay",
        "inputs",
        "inputs_kept",
        "max_level",
        "seconds",
    ] {
        assert!(!report[key].is_null(), "{key}");
    }
    for key in ["refine", "extract", "certify", "total"] {
        assert!(report["seconds"][key].as_f64().unwrap() >= 0.0, "{key}");
    }
    assert_eq!(report["inputs_kept"], 100);
    assert!(report["min_angle_deg"].as_f64().unwrap() > 43.89);
    assert!(report["max_angle_deg"].as_f64().unwrap() < 90.01);
}

#[test]
fn threads_do_not_change_a_byte() {
    let bench = Bench::new();
    let input = fixture("points/capitals.node");
    let files = ["m.node", "m.ele", "m.vtu", "m.ron", "m.svg"];
    let mut first: Option<Vec<Vec<u8>>> = None;
    for threads in [1, 2, 8] {
        bench
            .run(&format!("mesh {input} -q --grid --threads {threads} -o m.ele -o m.vtu -o m.ron -o m.svg"))
            .fine();
        let bytes: Vec<_> = files.iter().map(|f| bench.read(f)).collect();
        assert!(*first.get_or_insert_with(|| bytes.clone()) == bytes, "{threads} threads");
    }
}

#[test]
fn options_reach_the_mesher() {
    let bench = Bench::new();
    let input = fixture("points/plane100.node");
    let figures = |options: &str| {
        bench.run(&format!("mesh {input} -q --report r.json {options}")).fine();
        bench.json("r.json")
    };
    let (plain, simple) = (figures("--method templates"), figures("--method simple"));
    assert!(simple["triangles"].as_u64() < plain["triangles"].as_u64());
    assert!(simple["max_angle_deg"].as_f64().unwrap() > 90.0);
    assert!(
        figures("--method templates --no-coarsening")["triangles"].as_u64() > plain["triangles"].as_u64()
    );
    assert_eq!(figures("--domain-radius 5")["domain_radius"].as_f64(), Some(5.0));
    let picture = |options: &str| {
        bench.run(&format!("mesh {input} -q -o p.svg {options}")).fine();
        String::from_utf8(bench.read("p.svg")).unwrap()
    };
    assert!(picture("--grid").contains(">hexagons<"));
    assert!(!picture("").contains(">hexagons<"));
    let grown = bench.run(&format!("mesh {input} -q --grid --min-angle 30 -o p.svg"));
    assert!(
        grown.code == 0 && grown.err.contains("--grid shows none; use --method templates"),
        "{}",
        grown.err
    );
}

#[test]
fn quiet_prints_nothing_but_says_what_is_ignored() {
    let bench = Bench::new();
    bench.file("p.poly", "2 2\n0 0 0\n1 1 0\n0\n1\n0 5 5\n");
    let run = bench.run("mesh p.poly -q -o a.ron");
    assert_eq!((run.code, run.out.as_str()), (0, ""));
    assert!(run.err.starts_with("warning: ") && run.err.contains("ignored") && run.err.contains("1 holes"));
}

#[test]
fn duplicates_are_merged_and_counted() {
    let bench = Bench::new();
    bench.file("twice.csv", "x,y\n0,0\n1,0\n0,0\n");
    let run = bench.run("mesh twice.csv -o a.ele");
    run.fine();
    assert!(run.out.contains("points     3 (1 of them duplicates)"), "{}", run.out);
}

#[test]
fn bad_inputs_are_refused_and_nothing_is_written() {
    let bench = Bench::new();
    bench.file("empty.node", "");
    bench.file("empty.csv", "");
    bench.file("short.node", "3 2 0 0\n0 0 0\n");
    bench.file("nan.txt", "0 0\nnan 1\n");
    bench.file("noise.csv", [0xff, 0xfe, 0x00, 0x81]);
    bench.file("huge.txt", "0 0\n1e300 0\n");
    bench.file("close.txt", "1e16 0\n1.0000000000000002e16 0\n");
    std::fs::create_dir(bench.path("folder.node")).unwrap();
    let before = bench.names();
    for (input, words) in [
        ("missing.node", "missing.node: no such file"),
        ("folder.node", "folder.node: "),
        ("empty.node", "number of points"),
        ("empty.csv", "empty.csv: the input has no points"),
        ("short.node", "short.node:2: file ends after 1 of 3 points"),
        ("nan.txt", "nan.txt:2: coordinate nan of point 1"),
        ("noise.csv", "noise.csv:1: not UTF-8"),
        ("huge.txt", "huge.txt: point 1 at"),
        ("close.txt", "close.txt: points 0 at"),
        ("points.xls", "points.xls: unknown extension"),
    ] {
        bench.run(&format!("mesh {input} -o new/a.ele -o new/a.svg --report r.json")).refused(words);
        assert_eq!(bench.names(), before, "{input}");
    }
}

#[test]
fn bad_outputs_are_refused_before_anything_is_written() {
    let bench = Bench::new();
    bench.file("p.txt", "0 0\n1 0\n");
    bench.file("p.node", "1 2 0 0\n0 0 0\n");
    bench.file("q.poly", "0 2 0 0\n1 0\n0 0 1\n0\n");
    std::fs::create_dir(bench.path("folder.svg")).unwrap();
    let before = bench.names();
    for (arguments, words) in [
        ("p.txt -o a.ele -o a.xls", "a.xls: unknown extension"),
        ("p.txt -o a.ele -o a.node", "two outputs of the same name"),
        ("p.txt -o a.svg --report ./a.svg", "two outputs of the same name"),
        ("p.txt -o folder.svg", "not a plain file"),
        ("p.txt -o a.ele -o p.txt/a.svg", "p.txt/a.svg: "),
        ("p.txt -o a.ele --report p.txt", "belongs to the input"),
        ("p.node -o p.ele", "belongs to the input"),
        ("q.poly -o q.ele", "belongs to the input"),
        ("p.txt", "--output"),
    ] {
        bench.run(&format!("mesh {arguments}")).refused(words);
        assert_eq!(bench.names(), before, "{arguments}");
    }
    assert_eq!(bench.read("p.txt"), b"0 0\n1 0\n");
}

#[test]
fn bad_options_are_refused() {
    let bench = Bench::new();
    bench.file("p.txt", "0 0\n1 0\n");
    for options in ["--domain-radius 0", "--domain-radius -1", "--domain-radius NaN", "--domain-radius inf"] {
        bench.run(&format!("mesh p.txt -o a.ele {options}")).refused("must be a positive number");
    }
    bench
        .run("mesh p.txt -o a.ele --domain-radius 1e-3")
        .refused("p.txt: a domain of radius 0.001 is too small");
    bench.run("mesh p.txt -o a.ele --threads 0").refused("--threads");
    bench.run("mesh p.txt -o a.ele --method best").refused("templates, simple");
    assert_eq!(bench.names(), ["p.txt"]);
}

#[test]
fn an_older_file_is_replaced_only_by_a_complete_one() {
    let bench = Bench::new();
    bench.file("p.txt", "0 0\n1 0\n");
    bench.file("a.ele", "old");
    bench.file("broken.txt", "0 0\n1\n");
    assert_eq!(bench.run("mesh broken.txt -o a.ele").code, 2);
    assert_eq!(bench.read("a.ele"), b"old");
    bench.run("mesh p.txt -q -o a.ele").fine();
    assert!(bench.read("a.ele").ends_with(b"\n"));
    assert_eq!(bench.names(), ["a.ele", "a.node", "broken.txt", "p.txt"]);
}

#[test]
fn help_fits_a_screen() {
    let bench = Bench::new();
    let commands = [
        "mesh",
        "triangle",
        "check",
        "plot",
        "convert",
        "dual",
        "generate",
        "session",
        "completions",
        "man",
        "",
    ];
    for command in commands {
        let run = bench.run(&format!("{command} --help"));
        run.fine();
        assert!(run.out.contains("Example"), "{command}");
        assert!(run.out.lines().count() <= 30, "{command}");
        let widest = run.out.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(100), "{command}: {widest:?}");
    }
    assert_eq!(bench.run("-V").out, format!("hexdel {}\n", env!("CARGO_PKG_VERSION")));
    assert_eq!(bench.run("").code, 2);
}

#[test]
fn compact_meshes_are_small_and_hold() {
    let bench = Bench::new();
    let input = fixture("points/plane100.node");
    let triangles = |more: &str| {
        let run = bench.run(&format!("mesh {input} -q -o m.ele --report r.json {more}"));
        let spent = more.contains("--budget");
        assert_eq!((run.code, run.err.as_str()), (if spent { 3 } else { 0 }, ""));
        assert_eq!(bench.json("r.json")["budget_spent"], spent);
        bench.run(&format!("check m.ele --input {input}")).fine();
        bench.json("r.json")["triangles"].as_u64().unwrap()
    };
    let templates = triangles("--method templates");
    let standard = triangles("");
    let fast = triangles("--method compact --effort fast");
    let none = triangles("--budget 0");
    assert!(8 * standard < templates && standard < fast && none == templates, "{standard} {fast} {none}");
    assert_eq!(bench.json("r.json")["method"], "compact");
}

#[test]
fn the_effort_fewest_takes_a_fraction_of_the_steiner_points() {
    let bench = Bench::new();
    let input = fixture("graphs/narrow.poly");
    let mut triangles = |more: &str| {
        bench.run(&format!("mesh {input} -q --min-angle 0 -o m.ele --report r.json {more}")).fine();
        bench.json("r.json")["triangles"].as_u64().unwrap()
    };
    let [best, fewest] = ["--effort best", "--effort fewest"].map(&mut triangles);
    assert!(10 * fewest < best, "{fewest} {best}");
    // A search with a budget goes on until then, and has not been cut short.
    assert!(triangles("--effort fewest --budget 0.5") <= fewest);
}

#[test]
fn angles_may_be_asked_for() {
    let bench = Bench::new();
    let input = fixture("points/two_close.node");
    bench.run(&format!("mesh {input} -q --method compact --min-angle 30 --report r.json")).fine();
    assert_eq!(bench.json("r.json")["bounds"]["min_deg"], 30.0);
    assert_eq!(bench.json("r.json")["bounds"]["max_deg"], 90.0);
    for (arguments, code, message) in [
        ("--method templates --min-angle 50", 2, "the method cannot keep"),
        ("--min-angle 70", 2, "no triangle has all angles"),
        ("--max-angle -1", 2, "no triangle has all angles"),
        ("--method compact --budget -1", 2, "must be a number of seconds, 0 or more"),
        ("--method compact --effort none", 2, "possible values"),
        ("--min-angle 51.5", 2, "the lower bound may be at most 51.4"),
        ("--max-angle 71", 2, "the upper bound at least 72"),
        ("--min-dual-edge 0.4", 2, "no graded mesh has all below 72"),
        ("--min-dual-edge 0", 2, "must be a positive number"),
        ("--min-dual-edge 0.1 --method templates", 2, "the method cannot keep"),
        // Two points of these may be had, five may not.
        ("--method compact --min-angle 51.3 --max-angle 72.1", 1, "did not reach"),
    ] {
        let input = if code == 1 { fixture("points/five.node") } else { input.clone() };
        let run = bench.run(&format!("mesh {input} -o x.ele {arguments}"));
        assert_eq!(run.code, code, "{arguments}: {}", run.err);
        assert!(run.err.contains(message), "{arguments}: {}", run.err);
    }
    assert!(!bench.names().iter().any(|name| name.starts_with("x.")));
}

#[test]
fn dual_edges_may_be_asked_for() {
    let bench = Bench::new();
    for input in [fixture("points/plane100.node"), fixture("graphs/airfoil.poly")] {
        let run = bench.run(&format!("mesh {input} --min-dual-edge 0.1 --report r.json -o m.ele"));
        run.fine();
        assert!(
            run.out.contains("dual edges at least 0.1") && run.out.contains("asked for 0.1\n"),
            "{}",
            run.out
        );
        let report = bench.json("r.json");
        let found = &report["dual_edges"];
        assert_eq!((&found["below"], &found["min_ratio"]), (&0.into(), &0.1.into()));
        assert!(found["worst"]["ratio"].as_f64() >= Some(0.1 - 1e-9), "{found}");
        // On the boundary half of a dual edge is there.
        assert!(report["dual"]["min_weight"].as_f64() >= Some(0.05 - 1e-9));
        bench.run(&format!("check m.ele --input {input} --max-angle 84.2895 --min-angle 30")).fine();
        bench.run(&format!("mesh {input} -q --max-angle 85 --report r.json")).fine();
        assert!(bench.json("r.json")["max_angle_deg"].as_f64() <= Some(85.0 + 1e-8));
    }
}

/// Without time to optimise they are as they are, and the worst is named.
#[test]
fn dual_edges_that_are_not_reached_fail() {
    let bench = Bench::new();
    let input = fixture("graphs/letters.poly");
    let run = bench.run(&format!("mesh {input} --min-dual-edge 0.3 --budget 0 --report r.json -o m.ele"));
    assert_eq!(run.code, 3, "{}", run.err);
    assert!(run.out.contains(" FAILED: shorter than 0.3 of their edges"), "{}", run.out);
    assert!(bench.json("r.json")["dual_edges"]["below"].as_u64() > Some(0));
}
