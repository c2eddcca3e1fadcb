//! Every fixture, meshed by every method, against what is on record.
//!
//! A snapshot has the figures of a mesh and, if it is small, the mesh itself;
//! of a large one the hexagons by level and class and a hash of its bytes. So
//! it also holds the promise of equal bytes on every platform. Points that
//! cannot be meshed have their error on record.
//!
//! `cargo xtask regen` renews the records; `cargo xtask regen --check` holds
//! them.

#![cfg(feature = "io")]
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use common::{Fixture, METHODS};
use hexdel::{Error, Mesher, Method, PslgTriangulation, Triangulation, VertexId};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::PathBuf;

/// Meshes with fewer triangles are on record in full.
const SMALL: usize = 60;

#[test]
fn templates() {
    hold_all(Method::Templates);
}

#[test]
fn simple() {
    hold_all(Method::Simple);
}

#[test]
fn compact() {
    hold_all(Method::Compact);
}

/// A record whose fixture is gone would be held by nothing.
#[test]
fn every_record_has_its_fixture() {
    let folder = common::root().join("crates/hexdel/tests/snapshots");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let records = files.filter(|file| file.extension().is_some_and(|e| e == "snap"));
    let name = |file: PathBuf| file.file_name().unwrap().to_str().unwrap().to_owned();
    let found: BTreeSet<String> = records.map(name).collect();
    let fixtures = common::fixtures();
    let expected = fixtures.iter().flat_map(|f| METHODS.map(|(_, m)| format!("{}-{m}.snap", f.name)));
    let graphs = common::graphs();
    let of_graphs = graphs.iter().map(|(name, _)| format!("graphs-{name}.snap"));
    assert_eq!(found, expected.chain(of_graphs).collect());
}

/// The record would show any hash; this one is FNV-1a's.
#[test]
fn the_hash_is_fnv_1a() {
    assert_eq!(fnv_1a([]), 0xcbf2_9ce4_8422_2325);
    assert_eq!(fnv_1a(*b"foobar"), 0x8594_4171_f739_67e8);
}

/// Every PSLG, with the default options.
#[test]
fn graphs() {
    let _bound = settings().bind_to_scope();
    for (name, graph) in common::graphs() {
        let text = match hexdel::triangulate_pslg(&graph) {
            Ok(made) => format!("fixtures/graphs/{name}.poly\n{}", of_graph(&made)),
            Err(error) => {
                assert!(matches!(error, Error::Segments(_) | Error::Pslg(_)), "{name}: {error}");
                format!("fixtures/graphs/{name}.poly\nerror: {error}\n")
            }
        };
        insta::assert_snapshot!(format!("graphs-{name}"), text);
    }
}

fn of_graph(made: &PslgTriangulation) -> String {
    let c = &made.certificate;
    let mut text = String::new();
    let split = made.edges_of_segment.iter().map(u32::to_string).collect::<Vec<_>>();
    let lines = [
        ("holds", made.holds().to_string()),
        ("inputs", format!("{}, {} kept", c.inputs, c.inputs_kept)),
        ("vertices", c.vertices.to_string()),
        ("triangles", c.triangles.to_string()),
        ("angles", format!("{:.6} to {:.6} degrees", c.min_angle_deg, c.max_angle_deg)),
        ("delaunay", c.delaunay.to_string()),
        ("boundary loops", c.boundary_loops.to_string()),
        ("retries", made.retries.to_string()),
        ("edges of segments", split.join(" ")),
    ];
    for (what, value) in lines {
        let _ = writeln!(text, "{what}: {value}");
    }
    let report = made.report();
    for (what, list) in [("exempt", &report.exempt), ("failed", &report.failed)] {
        for entry in list {
            let (min, max) = (entry.min_angle_deg, entry.max_angle_deg);
            let _ =
                writeln!(text, "{what}: {} {min:.6} to {max:.6} degrees {}", entry.triangle, entry.reason);
        }
    }
    let _ = writeln!(text, "hash: {:016x}", hash(common::bits_of(&made.mesh)));
    text
}

fn settings() -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}

fn hold_all(method: Method) {
    let _bound = settings().bind_to_scope();
    for fixture in common::fixtures() {
        let name = METHODS.into_iter().find(|(m, _)| *m == method).expect("all are listed").1;
        let result = Mesher::new().method(method).triangulate(&fixture.points);
        let text = match result {
            Ok(made) => {
                common::hold(&made, &fixture.points);
                record(&fixture, name, &made)
            }
            Err(error) => {
                let legitimate =
                    matches!(error, Error::Points(_) | Error::TooClose { .. } | Error::OutOfRange { .. });
                assert!(legitimate, "{}: {error}", fixture.path);
                format!("{}, {name}\nerror: {error}\n", fixture.path)
            }
        };
        insta::assert_snapshot!(format!("{}-{name}", fixture.name), text);
    }
}

fn record(fixture: &Fixture, method: &str, made: &Triangulation) -> String {
    let mut text = header(fixture, method, made);
    if made.mesh.triangles.len() < SMALL {
        full(&mut text, made);
    } else {
        summary(&mut text, made);
    }
    text
}

fn header(fixture: &Fixture, method: &str, made: &Triangulation) -> String {
    let c = &made.certificate;
    let mut text = format!("{}, {method}\n", fixture.path);
    let lines = [
        ("inputs", format!("{}, {} kept", c.inputs, c.inputs_kept)),
        ("vertices", c.vertices.to_string()),
        ("triangles", c.triangles.to_string()),
        ("angles", format!("{:.9} to {:.9} degrees", c.min_angle_deg, c.max_angle_deg)),
        ("limited by rounding", c.rounding_limited.to_string()),
        ("aspect ratio", format!("at most {:.9}", c.max_aspect_ratio)),
        ("shortest edge", format!("{:.9e}", c.shortest_edge)),
        ("delaunay", c.delaunay.to_string()),
        ("boundary edges", c.boundary_edges.to_string()),
        ("levels", made.max_level.to_string()),
        ("patch", format!("radius {:.9e}", made.patch.radius)),
    ];
    for (what, value) in lines {
        let _ = writeln!(text, "{what}: {value}");
    }
    text
}

fn full(text: &mut String, made: &Triangulation) {
    let inputs = made.input_of_vertex();
    for (i, v) in made.mesh.vertices.iter().enumerate() {
        let input = inputs[i].map_or_else(String::new, |input| format!(" input {input}"));
        let _ = writeln!(text, "v{i} {:?} {:?}{input}", v.x, v.y);
    }
    for t in &made.mesh.triangles {
        let [a, b, c] = t.map(VertexId::index);
        let _ = writeln!(text, "t {a} {b} {c}");
    }
}

fn summary(text: &mut String, made: &Triangulation) {
    let mut counts: BTreeMap<(u8, String), usize> = BTreeMap::new();
    for hexagon in made.hexagons() {
        let class = hexagon.class.map_or_else(|| "SemiHexagon".to_owned(), |class| format!("{class:?}"));
        *counts.entry((hexagon.address.level, class)).or_default() += 1;
    }
    for ((level, class), count) in counts {
        let _ = writeln!(text, "level {level}: {count} {class}");
    }
    let _ = writeln!(text, "hash: {:016x}", hash(common::bits(made)));
}

fn hash((vertices, triangles): common::Bits) -> u64 {
    let vertices = vertices.into_iter().flatten().flat_map(u64::to_le_bytes);
    let triangles = triangles.into_iter().flatten().flat_map(|v| (v as u32).to_le_bytes());
    fnv_1a(vertices.chain(triangles))
}

/// The hash of Fowler, Noll and Vo, 64 bits, variant 1a.
fn fnv_1a(bytes: impl IntoIterator<Item = u8>) -> u64 {
    let fold = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, fold)
}
