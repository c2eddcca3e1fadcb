//! Which columns of a table are x and y.

use crate::support::{Bench, fixture};

/// Vertices of a mesh in `.node` that are input points, in their order.
fn input_points(bench: &Bench, name: &str) -> Vec<[f64; 2]> {
    let text = String::from_utf8(bench.read(name)).unwrap();
    let rows = text.lines().skip(1).map(|row| {
        let numbers: Vec<f64> = row.split_whitespace().map(|n| n.parse().unwrap()).collect();
        (numbers[3], [numbers[1], numbers[2]])
    });
    let mut inputs: Vec<(f64, [f64; 2])> = rows.filter(|row| row.0 >= 0.0).collect();
    inputs.sort_by(|a, b| a.0.total_cmp(&b.0));
    inputs.into_iter().map(|row| row.1).collect()
}

#[test]
fn headers_tell_the_columns_in_any_order() {
    let bench = Bench::new();
    for (table, told, first) in [
        (
            "id_east_north",
            "x = Easting (column 2), y = Northing (column 3), z = Elev (column 4)",
            [500_000.5, 5_200_000.25],
        ),
        ("wellnames", "x = X_UTM (column 2), y = Y_UTM (column 3)", [500_000.5, 5_200_000.25]),
        ("latlon_header", "x = lon (column 3), y = lat (column 2)", [8.2, 47.1]),
    ] {
        let input = fixture(&format!("tables/{table}.csv"));
        for more in ["", "--domain hull"] {
            let run = bench.run(&format!("mesh {input} -o m.ele --report r.json {more}"));
            run.fine();
            assert!(
                run.out.contains(&format!("\ncolumns    {told}\n")) || run.out.starts_with("columns"),
                "{}",
                run.out
            );
            assert_eq!(bench.json("r.json")["columns"], told);
            let found = input_points(&bench, "m.node");
            assert_eq!((found.len(), found[0]), (3, first), "{table}");
        }
        bench.run(&format!("check m.ele --input {input} --min-angle 20")).fine();
    }
    bench.run(&format!("convert {} a.xyz", fixture("tables/latlon_header.csv"))).fine();
    assert_eq!(bench.read("a.xyz"), b"8.2 47.1\n8.9 47.3\n8.5 46.9\n");
}

#[test]
fn a_header_that_does_not_tell_asks_for_columns() {
    let bench = Bench::new();
    bench.file("a.csv", "objectid,where,up,h\n1,5,6,7\n2,6,8,7\n3,5,8,7\n");
    let run = bench.run("mesh a.csv -o m.ele");
    run.refused("a.csv:1: the header does not say which columns are x and y: \"objectid,where,up,h\"");
    assert!(run.err.contains("help: --columns where,up, by name or number"), "{}", run.err);
    for asked in ["where,up", "2,3", "WHERE,3"] {
        let run = bench.run(&format!("mesh a.csv -o m.ele --columns {asked}"));
        run.fine();
        assert!(run.out.contains("columns    x = where (column 2), y = up (column 3)\n"), "{}", run.out);
        assert_eq!(input_points(&bench, "m.node"), [[5.0, 6.0], [6.0, 8.0], [5.0, 8.0]]);
    }
    bench.run("mesh a.csv -o n.ele --columns where,down").refused("a.csv:1: no column down, there are");
    bench.run("mesh a.csv -o n.ele --columns 2").refused("expected the columns of x and y by name or number");
    let run = bench.run("mesh a.csv -o n.ele --columns objectid,z");
    assert!(run.err.contains("help: --columns X,Y"), "{}", run.err);
    // Without a header, a first column that counts.
    bench.file("b.xyz", "1 5 6\n2 6 8\n3 5 8\n");
    let run = bench.run("mesh b.xyz -o n.ele");
    run.refused("b.xyz:1: the first column looks like row numbers");
    assert!(run.err.contains("help: --columns 2,3,"), "{}", run.err);
    bench.run("mesh b.xyz -o n.ele --columns 2,3").fine();
    assert_eq!(bench.read("n.node"), bench.read("m.node"));
    for command in ["check n.ele --input b.xyz", "convert b.xyz c.xyz", "plot n.ele -o n.svg --input b.xyz"] {
        bench.run(command).refused("the first column looks like row numbers");
        bench.run(&format!("{command} --columns 2,3")).fine();
    }
    // Of what is no table, columns are nothing.
    bench.run("mesh n.node -o k.ele --columns 2,3").refused("--columns has no effect: it is for tables");
}

#[test]
fn decimal_commas_are_read_where_they_cannot_be_mistaken() {
    let bench = Bench::new();
    bench.file("a.csv", "id;Hochwert;Rechtswert\n1;1,5;0,25\n2;2,5;0\n3;2;1,5\n");
    let run = bench.run("mesh a.csv -o m.ele");
    run.fine();
    let told = "columns    x = Rechtswert (column 3), y = Hochwert (column 2), with decimal commas\n";
    assert!(run.out.contains(told), "{}", run.out);
    assert_eq!(input_points(&bench, "m.node"), [[0.25, 1.5], [0.0, 2.5], [1.5, 2.0]]);
    bench.file("b.csv", "x,y\n1,5,2,5\n2,5,3,5\n");
    let run = bench.run("mesh b.csv -o n.ele");
    run.refused("decimal commas are read where ; or a tab separates");
    assert!(run.err.contains("b.csv:3: "), "{}", run.err);
}

/// Attributes of `.node` and `.poly` have no names: the option says which is the height.
#[test]
fn an_attribute_may_be_the_height() {
    let bench = Bench::new();
    bench.file("p.node", "4 2 2 0\n0 0 0 7 1.5\n1 4 0 8 2.5\n2 4 4 9 3.5\n3 0 4 7 4.5\n");
    bench.file("s.poly", "0 2 2 0\n4 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n0\n");
    bench.file("s.node", bench.read("p.node"));
    for input in ["p.node", "s.poly"] {
        let run = bench.run(&format!("mesh {input} -o m.2dm --height-attribute 2"));
        run.fine();
        assert!(run.out.contains("heights    1.5 to 4.5 at points, linear between them"), "{}", run.out);
        let mesh = String::from_utf8(bench.read("m.2dm")).unwrap();
        assert!(mesh.lines().any(|line| line.starts_with("ND") && line.ends_with(" 4.0 4.0 3.5")), "{mesh}");
        let plain = bench.run(&format!("mesh {input} -o m.2dm"));
        assert!(!plain.out.contains("heights"), "{}", plain.out);
        let run = bench.run(&format!("mesh {input} -o m.2dm --height-attribute 3"));
        run.refused("--height-attribute 3: each point has 2 attributes");
        bench.run(&format!("mesh {input} -o m.2dm --height-attribute 0")).refused("--height-attribute");
    }
}
