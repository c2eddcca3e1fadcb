//! Standard input and output, places in files, completions and manual pages.

use crate::support::{Bench, fixture};

#[test]
fn points_come_in_and_meshes_go_out_through_pipes() {
    let bench = Bench::new();
    let points = b"x,y\n0,0\n1,0\n0,1\n";
    let run = bench.fed("mesh - -o - --input-format csv --format off", points);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.out.starts_with("OFF"), "{}", run.out);
    // What is worth knowing goes where it does not disturb.
    assert!(run.err.contains("certified"), "{}", run.err);
    let quiet = bench.fed("mesh - -q -o - --input-format csv --format off", points);
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), (run.out.as_str(), ""));
    bench.file("p.csv", points);
    let check = bench.fed("check - --format off --input p.csv", run.out.as_bytes());
    assert_eq!((check.code, check.err.as_str()), (0, ""), "{}", check.out);
    let generated = bench.run("generate uniform 5 -o - --format csv");
    generated.fine();
    assert!(generated.out.starts_with("x,y\n") && generated.out.lines().count() == 6);
    assert_eq!(bench.names(), ["p.csv"]);
}

#[test]
fn streams_without_a_format_are_refused() {
    let bench = Bench::new();
    for (arguments, words) in [
        ("mesh - -o a.ele", "standard input has no extension"),
        ("mesh p.csv -o -", "standard output has no extension"),
        ("mesh - -o a.ele --format stl", "possible values"),
        ("mesh - -o a.ele --format obj", "obj: no format of points"),
        ("check -", "standard input has no extension"),
        ("check - --format svg", ""),
        ("generate uniform 5 -o -", "standard output has no extension"),
    ] {
        bench.fed(arguments, b"0 0\n").refused(words);
    }
    bench.file("p.csv", "x,y\n0,0\n1,0\n");
    bench.run("mesh p.csv -q -o - --format ele").refused("takes two files");
    bench.run("mesh p.csv -o - -o - --format off").refused("two outputs of the same name");
    bench.fed("mesh - -o a.ele --format csv", b"x,y\n0,zero\n").refused("<stdin>:2: ");
}

#[test]
fn errors_show_their_place() {
    let bench = Bench::new();
    bench.file("bad.poly", "3 2\n0 0 0\n1 1 0\n2 0 1\n2 0\n0 0 1\n1 1 7\n0\n");
    let run = bench.run("mesh bad.poly -o a.ele");
    run.refused("bad.poly:7: no point 7");
    assert!(run.err.contains("[bad.poly:7:5]") && run.err.contains("1 1 7"), "{}", run.err);
    bench.file("bad.csv", "x,y\n0,0\n1,one\n");
    let run = bench.run("mesh bad.csv -o a.ele");
    assert!(run.err.contains("[bad.csv:3:") && run.err.contains("1,one"), "{}", run.err);
    bench.file("short.node", "3 2\n0 0 0\n");
    bench.run("mesh short.node -o a.ele").refused("short.node:2: file ends after 1 of 3 points");
}

#[test]
fn completions_and_manual_pages_are_made() {
    let bench = Bench::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = bench.run(&format!("completions {shell}"));
        run.fine();
        assert!(run.out.contains("hexdel") && run.out.contains("max-area"), "{shell}");
    }
    let run = bench.run("man");
    run.fine();
    assert!(run.out.contains(".TH hexdel 1") || run.out.contains(".TH hexdel"), "{}", &run.out[..200]);
    bench.run("man pages").fine();
    assert!(bench.path("pages/hexdel-mesh.1").exists());
    bench.run("completions tcsh").refused("tcsh");
    assert!(bench.run(&format!("mesh {}", fixture("points/five.node"))).code == 2);
}
