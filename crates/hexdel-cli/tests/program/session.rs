//! Commands from a pipe, sizes from options and files.

use crate::support::Bench;
use serde_json::Value;
use std::io::Write;
use std::process::Stdio;

/// Gives commands to a session; its answers and its exit code.
fn talk(bench: &Bench, arguments: &str, commands: &str) -> (Vec<Value>, i32) {
    let mut command = bench.command(arguments);
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(commands.as_bytes()).unwrap();
    let done = child.wait_with_output().unwrap();
    let text = String::from_utf8(done.stdout).unwrap();
    (text.lines().map(|l| serde_json::from_str(l).unwrap()).collect(), done.status.code().unwrap())
}

#[test]
fn each_command_has_an_answer() {
    let bench = Bench::new();
    let (answers, code) = talk(
        &bench,
        "session",
        "# a session\ndomain 0 0 1\n\ninsert .1 .2 .3 .1\nsize box 0 0 .2 .2 .05\nmesh m.vtu\ncertify\n\
         remove 0\nundo\npoints\nsave s.ron\nquit\ninsert 0 0\n",
    );
    assert_eq!((answers.len(), code), (9, 0), "{answers:?}");
    assert!(answers.iter().all(|a| a["ok"] == true));
    assert_eq!(answers[1]["points_inserted"], serde_json::json!([0, 1]));
    let added = answers[1]["delta"]["triangles_added"].as_array().unwrap().len();
    assert_eq!(answers[1]["triangles"], added);
    assert_eq!(answers[4]["holds"], true);
    assert_eq!(answers[7]["points"], serde_json::json!([[0, 0.1, 0.2], [1, 0.3, 0.1]]));
    bench.run("check m.vtu").fine();

    let (answers, code) = talk(&bench, "session --brief", "load s.ron\ninsert .5 .5\nsave t.ron\n");
    assert_eq!((answers.len(), code), (3, 0), "{answers:?}");
    assert_eq!(answers[1]["points_inserted"], serde_json::json!([2]));
    // A vertex may move to the point, and no triangle become another.
    let told = ["triangles_added", "vertices_moved"].map(|what| answers[1]["delta"][what].as_u64().unwrap());
    assert!(told.iter().sum::<u64>() > 0);
}

/// The options of meshing are those of the first mesh; where there is none they are refused.
#[test]
fn effort_budget_and_threads_are_those_of_sessions_too() {
    let bench = Bench::new();
    let points = (0..40).map(|i| format!("{} {}\n", i * i % 41, i * 7 % 43)).collect::<Vec<_>>().concat();
    bench.file("p.xyz", points);
    let triangles = |options: &str| {
        let (answers, code) =
            talk(&bench, &format!("session --brief {options} p.xyz"), "certify\nsave s.ron\n");
        assert_eq!((code, &answers[1]["holds"]), (0, &true.into()), "{options}: {answers:?}");
        answers[0]["triangles"].as_u64().unwrap()
    };
    let [fast, best] = ["--effort fast --threads 1", "--effort best --threads 2"].map(triangles);
    assert!(best < fast, "{best} {fast}");
    assert!(triangles("--budget 0") > best);
    let option =
        |name: &str| format!("{name} has no effect: it is for sessions that begin with open or insert");
    for (options, name) in
        [("--effort fast", "--effort"), ("--budget 3", "--budget"), ("--threads 2", "--threads")]
    {
        let (answers, code) = talk(&bench, &format!("session {options}"), "domain 0 0 1\nload s.ron\n");
        assert_eq!(code, 2);
        assert!(answers.iter().all(|a| a["error"] == option(name)), "{answers:?}");
    }
    let run = bench.run("session --budget -1");
    assert!(run.code == 2 && run.err.contains("must be a number of seconds, 0 or more"), "{}", run.err);
}

#[test]
fn a_graph_is_opened_with_its_segments() {
    let bench = Bench::new();
    bench.file("s.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 1\n1 1 2 5\n2 2 3 5\n3 3 4 5\n4 4 1 6\n0\n");
    let commands = "insert .5 .5 .25 0\nremove 4\nremove 0\ninsert 2 2\ncertify\nmesh m.vtu\nsave s.ron\n";
    let (answers, code) = talk(&bench, "session s.poly", commands);
    assert_eq!((answers.len(), code), (8, 2), "{answers:?}");
    let ok: Vec<bool> = answers.iter().map(|a| a["ok"] == true).collect();
    assert_eq!(ok, [true, true, true, false, false, true, true, true], "{answers:?}");
    assert_eq!(answers[1]["points_inserted"], serde_json::json!([4, 5]));
    assert!(answers[3]["error"].as_str().unwrap().contains("end of a segment"));
    assert_eq!(answers[5]["holds"], true);
    let (answers, code) = talk(&bench, "session --brief none.poly", "load s.ron\ninsert .3 .3\n");
    assert_eq!((answers[0]["ok"] == true, answers[2]["ok"] == true, code), (false, true, 2), "{answers:?}");
}

/// Holes that are not used, segments that are there twice, and segments where points are asked for.
#[test]
fn what_is_not_used_of_a_file_is_said() {
    let bench = Bench::new();
    bench.file("s.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n4 0\n1 1 2\n2 2 3\n3 3 1\n4 2 1\n1\n1 7 7\n");
    bench.file("h.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n0 0\n1\n1 7 7\n");
    let commands = "open s.poly\nopen h.poly\ndomain 0 0 2\ninsert-file s.poly\n";
    let (answers, code) = talk(&bench, "session --brief", commands);
    assert_eq!((answers.len(), code), (4, 0), "{answers:?}");
    let told = |i: usize, of: &str| {
        answers[i][of].as_array().unwrap().iter().map(|t| t.as_str().unwrap()).collect::<Vec<_>>()
    };
    assert_eq!(
        told(0, "warnings"),
        ["s.poly:11: hole 0 at (7, 7) has no effect: it lies outside the domain"]
    );
    assert_eq!(told(0, "repairs"), ["segments 0 and 3 overlapped at (1, 0)"]);
    assert_eq!(told(1, "warnings"), ["only points are used, not 1 holes"]);
    assert_eq!(told(3, "warnings"), ["only points are used, not 4 segments, 1 holes"]);
}

#[test]
fn a_mesh_does_not_replace_the_points_it_is_of() {
    let bench = Bench::new();
    bench.file("p.node", "2 2 0 0\n0 0 0\n1 1 0\n");
    let (answers, code) = talk(&bench, "session --brief", "open p.node\nmesh p.ele\nmesh q.ele\n");
    assert_eq!((answers.len(), code), (3, 2), "{answers:?}");
    assert!(answers[1]["error"].as_str().unwrap().contains("belongs to the input"), "{answers:?}");
    assert_eq!(bench.read("p.node"), b"2 2 0 0\n0 0 0\n1 1 0\n");
}

#[test]
fn sessions_of_templates_answer_the_same_commands() {
    let bench = Bench::new();
    let commands = "domain 0 0 1\ninsert .1 .2 .3 .1\nremove 0\nundo\nmesh m.vtu\ncertify\nsave s.ron\n";
    let (answers, code) = talk(&bench, "session --method templates", commands);
    assert_eq!((answers.len(), code), (7, 0), "{answers:?}");
    let added = answers[1]["delta"]["triangles_added"].as_array().unwrap().len();
    assert!(0 < added && answers[5]["holds"] == true);
    bench.run("check m.vtu").fine();

    // A saved session goes on by its own method.
    let commands =
        "load s.ron\ninsert .5 .5\nsize .1\nrefine 0 0 .1 .1 1\nsize none\nsave t.ron\nload t.ron\n";
    let (answers, code) = talk(&bench, "session --brief", commands);
    assert_eq!((answers.len(), code), (7, 0), "{answers:?}");
    assert_eq!(answers[1]["points_inserted"], serde_json::json!([2]));
    assert!(answers[1]["delta"]["triangles_added"].as_u64().unwrap() > 0);
    let triangles = |i: usize| answers[i]["triangles"].as_u64().unwrap();
    assert!(triangles(1) < triangles(2) && triangles(2) < triangles(3) && triangles(4) < triangles(2));
}

/// `insert` may come first: the domain is around the points, and grows for others.
#[test]
fn a_session_may_begin_with_points() {
    let bench = Bench::new();
    bench.file("wells.csv", "name,lat,lon\nA,1,2\nB,3,9\n");
    for method in ["compact", "templates"] {
        let commands = "insert 500000 5200000 500010 5200005\ninsert 500900 5199000\ncertify\nundo\nundo\n\
            save s.ron\nload s.ron\ninsert 500900 5199000\ncertify\n";
        let (answers, code) = talk(&bench, &format!("session --method {method}"), commands);
        let ok: Vec<bool> = answers.iter().map(|a| a["ok"] == true).collect();
        // What it began with is no change to take back.
        assert_eq!(
            (&ok[..], code),
            (&[true, true, true, true, false, true, true, true, true][..], 2),
            "{answers:?}"
        );
        assert_eq!(answers[0]["points_inserted"], serde_json::json!([0, 1]));
        let added = answers[0]["delta"]["triangles_added"].as_array().unwrap().len();
        assert_eq!(answers[0]["triangles"], added);
        let radius = |i: usize| answers[i]["domain"]["radius"].as_f64().unwrap();
        assert!(radius(0) < 100.0 && radius(1) > 1345.0, "{answers:?}");
        assert!((radius(3) - radius(0)).abs() < 1e-6);
        assert_eq!((&answers[2]["holds"], &answers[8]["holds"]), (&true.into(), &true.into()));
        assert_eq!(answers[7]["points_inserted"], serde_json::json!([3]));
    }
    // A domain that was asked for stays as it is.
    let (answers, _) = talk(&bench, "session", "domain 0 0 1\ninsert 5 5\n");
    assert!(answers[1]["error"].as_str().unwrap().contains("does not grow by itself"), "{answers:?}");
    let (answers, code) = talk(&bench, "session --brief", "insert-file wells.csv\npoints\n");
    assert_eq!(code, 0, "{answers:?}");
    assert_eq!(answers[0]["columns"], "x = lon (column 3), y = lat (column 2)");
    assert_eq!(answers[1]["points"], serde_json::json!([[0, 2.0, 1.0], [1, 9.0, 3.0]]));
}

#[test]
fn a_bad_command_is_answered_and_changes_nothing() {
    let bench = Bench::new();
    bench.file("points.csv", "0,0\n1,0\n0,1\n");
    bench.file("bad.ron", "(version:1)");
    let bad = [
        "insert 1",
        "insert 9 9",
        "insert 0 0",
        "remove 7",
        "size -1",
        "size box 0 0 1 1 0",
        "size file none.asc",
        "mesh",
        "mesh m.foo",
        "load bad.ron",
        "load none.ron",
        "open none.csv",
        "domain 0 0 -1",
        "undo",
        "fly",
    ];
    let (first, code) = talk(&bench, "session", "remove 0\n");
    assert_eq!((first[0]["ok"].as_bool(), code), (Some(false), 2));
    assert!(first[0]["error"].as_str().unwrap().contains("begin with insert"), "{first:?}");
    let script = format!("open points.csv\nsave before.ron\n{}\nsave after.ron\n", bad.join("\n"));
    let (answers, code) = talk(&bench, "session", &script);
    assert_eq!((answers.len(), code), (bad.len() + 3, 2));
    for (line, answer) in bad.iter().zip(&answers[2..]) {
        assert_eq!(answer["ok"], false, "{line}");
        assert!(answer["error"].as_str().is_some_and(|e| !e.is_empty()), "{line}");
    }
    assert_eq!(bench.read("before.ron"), bench.read("after.ron"));
}

#[test]
fn edges_are_as_short_as_options_and_files_want() {
    let bench = Bench::new();
    bench.file("points.csv", "0,0\n1,0\n0,1\n");
    bench.file("sizes.txt", "# x y size\n.5 .5 .02\n");
    bench.file("sizes.asc", "ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n.1 .3\n");
    for options in [
        "--size .1",
        "--max-edge .1",
        "--size-file sizes.txt",
        "--size-file sizes.asc --max-edge .2",
        "--max-area .01",
    ] {
        bench.run(&format!("mesh points.csv --report r.json -q {options}")).fine();
        let report = bench.json("r.json");
        assert!(report["size_ratio"].as_f64().is_some_and(|r| r <= 1.0 + 1e-9), "{options}: {report}");
    }
    bench.run("mesh points.csv --report r.json --size 0").refused("positive");
    bench.run("mesh points.csv --report r.json --max-edge 1e-14").refused("resolve");
    bench.run("mesh points.csv --report r.json --size-file none.asc").refused("none.asc");
    bench.file("sizes.asc", "ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n.1 0\n");
    bench.run("mesh points.csv --report r.json --size-file sizes.asc").refused("row 0 and column 1");
}
