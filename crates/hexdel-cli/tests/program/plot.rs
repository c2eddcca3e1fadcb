//! `hexdel plot`, and the options of pictures in `hexdel mesh`.

use crate::support::{Bench, fixture};

/// A bench with a mesh of a hundred points.
fn meshed() -> Bench {
    let bench = Bench::new();
    bench.run(&format!("mesh {} -q --method templates -o m.ele", fixture("points/plane100.node"))).fine();
    bench
}

#[test]
fn a_mesh_file_is_drawn() {
    let bench = meshed();
    let points = fixture("points/plane100.node");
    let run = bench.run(&format!("plot m.ele -o p.svg -o new/p.png --histogram --input {points} --size 300"));
    run.fine();
    assert_eq!(run.out, "");
    let svg = String::from_utf8(bench.read("p.svg")).unwrap();
    for words in ["smallest angle", "11,576 triangles", "100 input points", "square root", ">43.9°<", ">90°<"]
    {
        assert!(svg.contains(words), "{words}");
    }
    assert!(!svg.contains("below") && svg.matches("<circle").count() == 101);
    assert!(bench.read("new/p.png").starts_with(b"\x89PNG"));
}

#[test]
fn options_reach_the_picture() {
    let bench = meshed();
    let picture = |options: &str| {
        bench.run(&format!("plot m.ele -o p.svg {options}")).fine();
        String::from_utf8(bench.read("p.svg")).unwrap()
    };
    assert!(picture("--colour largest").contains("largest angle"));
    assert!(picture("--color largest --max-angle 80").contains("above 80°: "));
    assert!(picture("--min-angle 50").contains("below 50°: "));
    assert!(picture("--zoom 0.4,0.6,0.5,0.2").contains(" of 11,576 triangles"));
    assert_eq!(picture("--zoom 0.4,0.6,0.5,0.2"), picture("--zoom 0.5,0.2,0.4,0.6"));
    assert!(picture("--zoom -0.5,-0.5,0.5,0.5").contains(" of 11,576 triangles"));
    assert!(picture("--size 200").len() < picture("").len());
}

#[test]
fn mesh_draws_levels_and_classes() {
    let bench = Bench::new();
    let input = fixture("points/plane100.node");
    let picture = |options: &str| {
        bench.run(&format!("mesh {input} -q -o p.svg {options}")).fine();
        String::from_utf8(bench.read("p.svg")).unwrap()
    };
    assert!(picture("--method templates --colour level").contains(">level 0: "));
    assert!(picture("--method templates --colour class --grid").contains(">moved centre 3: "));
    let simple = picture("--method simple --colour class");
    assert!(simple.contains(">occupied: 6") && !simple.contains("moved"));
    let simple = picture("--method simple --grid");
    assert!(simple.contains(">occupied<") && !simple.contains("moved"));
    assert!(picture("--method simple --histogram").contains("square root"));
    assert!(picture("--method compact --effort fast --grid").contains(">hexagons<"));
    bench.run(&format!("mesh {input} -q --method simple -o p.png --pixels 64 --zoom 0,0,1,1")).fine();
    assert!(bench.read("p.png").starts_with(b"\x89PNG"));
}

#[test]
fn regions_are_drawn_of_graphs_and_of_files() {
    let bench = Bench::new();
    let graph = fixture("graphs/regions.poly");
    bench.run(&format!("mesh {graph} -q -o m.ele -o m.svg --colour region")).fine();
    bench.run("plot m.ele -o p.svg --colour region").fine();
    for name in ["m.svg", "p.svg"] {
        let svg = String::from_utf8(bench.read(name)).unwrap();
        assert!(svg.contains(">region<"), "{name}");
        assert!(svg.matches("#f6b26b").count() >= 2, "the second region: {name}");
    }
    // What the file tells, and segments.
    assert!(String::from_utf8(bench.read("m.svg")).unwrap().contains("id=\"segments\""));
    bench.run(&format!("mesh {graph} -o p.svg --colour level")).refused("the mesh of a PSLG has no levels");
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let bench = meshed();
    bench.file("bad.ele", "1 3 0\n0 0 1 9\n");
    bench.file("bad.node", "1 2 0 0\n0 0 0\n");
    let input = fixture("points/plane100.node");
    let before = bench.names();
    for (arguments, words) in [
        ("plot m.ele -o p.vtu", "p.vtu: unknown extension, expected one of .svg, .png"),
        ("plot m.ele -o p", "p: unknown extension"),
        ("plot m.ele", "--output"),
        ("plot m.ele -o p.svg -o ./p.svg", "two outputs of the same name"),
        ("plot none.ele -o p.svg", "none.node: no such file"),
        ("plot bad.ele -o p.svg", "bad.ele:2"),
        ("plot m.ele -o p.svg --input none.node", "none.node: no such file"),
        ("plot m.ele -o p.svg --colour level", "m.ele: a mesh file has no levels"),
        ("plot m.ele -o p.png --colour class", "m.ele: a mesh file has no levels"),
        ("plot m.ele -o p.png --colour region", "the mesh has no regions"),
        ("plot m.ele -o p.svg --colour mood", "possible values"),
        ("plot m.ele -o p.svg --zoom 1,2,3", "expected four numbers"),
        ("plot m.ele -o p.svg --zoom 1,2,3,4,5", "expected four numbers"),
        ("plot m.ele -o p.svg --zoom 1,2,1,4", "expected four numbers"),
        ("plot m.ele -o p.svg --zoom 1,2,inf,4", "expected four numbers"),
        ("plot m.ele -o p.svg --zoom nan,2,3,4", "expected four numbers"),
        ("plot m.ele -o p.svg --zoom 100,100,101,101", "lies beside the mesh"),
        ("plot m.ele -o p.svg --size 0", "--size"),
        ("plot m.ele -o p.png --size 1000000", "--size"),
        ("plot m.ele -o p.svg --min-angle 61", "no triangle has all angles"),
        ("plot m.ele -o p.svg --min-angle -1", "no triangle has all angles"),
        ("mesh INPUT -o p.svg --method compact --colour level", "the compact method has no levels"),
        ("mesh INPUT -o p.svg --method simple --colour region", "the mesh has no regions"),
        ("mesh INPUT -o p.svg -o p.ele --method simple --zoom 9,9,10,10", "lies beside the mesh"),
    ] {
        bench.run(&arguments.replace("INPUT", &input)).refused(words);
        assert_eq!(bench.names(), before, "{arguments}");
    }
}
