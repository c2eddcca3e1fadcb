//! Every fixture, meshed by every method, against what is on record.
//!
//! A snapshot has the figures of a mesh and, if it is small, the mesh itself;
//! of a large one the hexagons by level and class and a hash of its bytes. So
//! it also holds the promise of equal bytes on every platform. Points that
//! cannot be meshed have their error on record.
//!
//! `cargo xtask regen` renews the records; `cargo xtask regen --check` holds
//! them.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use common::{Fixture, METHODS};
use hexdel::{Error, Mesher, Method, Triangulation, VertexId};
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
    assert_eq!(found, expected.collect());
}

/// The record would show any hash; this one is FNV-1a's.
#[test]
fn the_hash_is_fnv_1a() {
    assert_eq!(fnv_1a([]), 0xcbf2_9ce4_8422_2325);
    assert_eq!(fnv_1a(*b"foobar"), 0x8594_4171_f739_67e8);
}

fn hold_all(method: Method) {
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let _bound = settings.bind_to_scope();
    for fixture in common::fixtures() {
        let name = METHODS.into_iter().find(|(m, _)| *m == method).expect("both are listed").1;
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
    let (vertices, triangles) = common::bits(made);
    let vertices = vertices.into_iter().flatten().flat_map(u64::to_le_bytes);
    let triangles = triangles.into_iter().flatten().flat_map(|v| (v as u32).to_le_bytes());
    let _ = writeln!(text, "hash: {:016x}", fnv_1a(vertices.chain(triangles)));
}

/// The hash of Fowler, Noll and Vo, 64 bits, variant 1a.
fn fnv_1a(bytes: impl IntoIterator<Item = u8>) -> u64 {
    let fold = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, fold)
}
