//! `hexdel generate`.

use crate::support::Bench;
use hexdel::generate::Kind;

#[test]
fn every_kind_is_made_and_the_same_again() {
    let bench = Bench::new();
    for kind in Kind::ALL {
        bench.run(&format!("generate {kind} 50 --seed 3 -o a.node")).fine();
        bench.run(&format!("generate {kind} 50 --seed 3 -o b.node")).fine();
        assert_eq!(bench.read("a.node"), bench.read("b.node"), "{kind}");
        bench.run(&format!("mesh a.node -q -o {kind}.ron")).fine();
        assert!(bench.run("generate --help").out.contains(kind.name()), "{kind}");
    }
}

#[test]
fn the_seed_matters_and_the_format_is_that_of_the_extension() {
    let bench = Bench::new();
    bench.run("generate uniform 5 --seed 1 -o new/a.csv").fine();
    bench.run("generate uniform 5 --seed 2 -o new/b.csv").fine();
    assert!(bench.read("new/a.csv").starts_with(b"x,y\n"));
    assert_ne!(bench.read("new/a.csv"), bench.read("new/b.csv"));
}

#[test]
fn nonsense_is_refused_and_nothing_is_written() {
    let bench = Bench::new();
    for (arguments, words) in [
        ("uniform 0 -o a.node", "0 is not in 1"),
        ("uniform 1000000000000 -o a.node", "is not in 1"),
        ("uniform -5 -o a.node", "-5"),
        ("fog 5 -o a.node", "uniform, line"),
        ("uniform 5 -o a.ele", "a.ele: unknown extension"),
        ("uniform 5", "--output"),
    ] {
        bench.run(&format!("generate {arguments}")).refused(words);
        assert!(bench.names().is_empty(), "{arguments}");
    }
}
