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
    // Columns are those of the file that is no stream.
    bench.file("q.csv", "id,u,v\n7,0,0\n8,1,0\n9,0,1\n");
    let check = bench.fed("check - --format off --input q.csv --columns u,v", run.out.as_bytes());
    assert_eq!((check.code, check.err.as_str()), (0, ""), "{}", check.out);
    bench.fed("plot - -o m.svg --format off --input q.csv --columns u,v", run.out.as_bytes()).fine();
    assert!(bench.read("m.svg").starts_with(b"<svg"));
    let generated = bench.run("generate uniform 5 -o - --format csv");
    generated.fine();
    assert!(generated.out.starts_with("x,y\n") && generated.out.lines().count() == 6);
    assert_eq!(bench.names(), ["m.svg", "p.csv", "q.csv"]);
}

#[test]
fn options_without_effect_are_refused() {
    let bench = Bench::new();
    bench.file("p.csv", "x,y\n0,0\n1,0\n0,1\n");
    bench.file("p.json", r#"{"points": [[0, 0], [1, 0]]}"#);
    bench.file("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    bench.file("m.node", "3 2\n1 0 0\n2 1 0\n3 0 1\n");
    let before = bench.names();
    for (arguments, option, words) in [
        ("mesh m.node -o k.ele --columns 2,3", "--columns", "it is for tables, and m.node is not one"),
        ("mesh p.csv -o k.ele --format csv", "--format", "it names the format of -"),
        ("mesh p.csv -o k.ele --input-format csv", "--input-format", "no file to read is -"),
        ("mesh p.csv -o - --format off --input-format csv", "--input-format", "no file to read is -"),
        ("mesh p.csv -o k.ele --histogram", "--histogram", "it is for pictures"),
        ("mesh p.csv -o k.ele --pixels 100", "--pixels", "it is for pictures"),
        ("mesh p.csv -o k.ele --grid", "--grid", "it is for pictures"),
        ("check m.off --columns x,y", "--columns", "no table is read without --input"),
        ("check m.off --input m.node --columns x,y", "--columns", "it is for tables"),
        ("check m.off --format off", "--format", "it names the format of -"),
        ("check m.off --input p.csv --input-format off", "--input-format", "no file to read is -"),
        ("plot m.off -o k.svg --columns x,y", "--columns", "no table is read without --input"),
        ("plot m.off -o k.svg --format off", "--format", "it names the format of -"),
        ("convert m.off k.vtu --columns x,y", "--columns", "it is for tables, and m.off is not one"),
        ("convert m.node k.poly --columns x,y", "--columns", "it is for tables, and m.node is not one"),
        ("convert p.json k.poly --columns x,y", "--columns", "it is for tables, and p.json is not one"),
        ("generate grid 5 -o k.csv --format csv", "--format", "it names the format of -"),
    ] {
        bench.run(arguments).refused(&format!("{option} has no effect: {words}"));
        assert_eq!(bench.names(), before, "{arguments}");
    }
    let run = bench.run("mesh p.csv -o k.ele --overlaps refuse");
    run.refused("a choice for overlaps applies to PSLGs, not to points");
    bench.run("generate grid 5 -o k.csv --columns x,y").refused("unexpected argument '--columns'");
    bench.run("mesh p.csv -q -o k.svg --histogram --pixels 100").fine();
}

#[test]
fn streams_without_a_format_are_refused() {
    let bench = Bench::new();
    for (arguments, words) in [
        ("mesh - -o a.ele", "standard input has no extension"),
        ("mesh p.csv -o -", "standard output has no extension"),
        ("mesh - -o a.ele --format xls", "possible values"),
        ("mesh - -o a.ele --format obj", "obj is not a format of points"),
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
