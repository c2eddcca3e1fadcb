//! Meshes that are small enough to read, on record as a whole: every vertex with its input
//! point, every triangle. A change of a method shows here as what it is.
//!
//! Of templates and of the simple method there are all fixtures whose meshes are small, of
//! compact meshes some of two to seven points, and of the paper's way with segments a few
//! PSLGs. `cargo xtask regen` renews the records, `cargo xtask regen --check` holds them.

#![cfg(feature = "io")]
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use hexdel::geom::DVec2;
use hexdel::pslg::{self, Extent, Options, SegmentMethod, validate};
use hexdel::{Mesher, Method, Pslg, TriMesh, Unwatched, VertexId};
use std::fmt::Write as _;

/// Larger meshes are on record elsewhere, by their figures and a hash.
const MOST: usize = 400;

#[test]
fn whole_templates() {
    hold(Method::Templates, "templates");
}

#[test]
fn whole_simple() {
    hold(Method::Simple, "simple");
}

type Place = (f64, f64);

/// A PSLG by its name, points and segments, and what of it is meshed.
type Input<'a> = (&'a str, &'a [Place], &'a [[u32; 2]], Extent);

/// Points by their coordinates.
fn points(coordinates: &[Place]) -> Vec<DVec2> {
    coordinates.iter().map(|&(x, y)| DVec2::new(x, y)).collect()
}

#[test]
fn whole_compact() {
    const SEVEN: [Place; 7] =
        [(0.0, 0.0), (2.0, 0.0), (1.0, 1.75), (-1.0, 1.75), (-2.0, 0.0), (-1.0, -1.75), (1.0, -1.75)];
    const SQUARE: [Place; 5] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.5, 0.5)];
    const LINE: [Place; 3] = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)];
    let _bound = settings().bind_to_scope();
    let inputs: [(&str, &[Place]); 7] = [
        ("two", &LINE[..2]),
        ("three_on_a_line", &LINE),
        ("triangle", &[(0.0, 0.0), (4.0, 0.0), (1.0, 3.0)]),
        ("square", &SQUARE[..4]),
        ("square_and_centre", &SQUARE),
        ("hexagon", &SEVEN[1..]),
        ("hexagon_and_centre", &SEVEN),
    ];
    for (name, coordinates) in inputs {
        let made = Mesher::new().triangulate(&points(coordinates)).unwrap();
        common::hold(&made, &points(coordinates));
        let text = format!("{coordinates:?}, compact\n{}", whole(&made.mesh, &made.input_of_vertex()));
        insta::assert_snapshot!(format!("compact-{name}"), text);
    }
}

#[test]
fn whole_by_the_papers_way_with_segments() {
    let _bound = settings().bind_to_scope();
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let around = [[0, 1], [1, 2], [2, 3], [3, 0]];
    let inputs: [Input<'_>; 5] = [
        ("segment", &square[..2], &around[..1], Extent::Hexagon),
        ("triangle", &[(0.0, 0.0), (4.0, 0.0), (1.0, 3.0)], &[[0, 1], [1, 2], [2, 0]], Extent::Inside),
        ("square", &square, &around, Extent::Inside),
        ("square_divided", &square, &[[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]], Extent::Inside),
        ("right_triangle", &[(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)], &[[0, 1], [1, 2], [2, 0]], Extent::Inside),
    ];
    for (name, coordinates, segments, extent) in inputs {
        let mut graph = Pslg::from_points(points(coordinates));
        graph.segments = segments.to_vec();
        let options = Options::new().method(SegmentMethod::Paper).extent(extent);
        let made = pslg::mesh(&validate(&graph).unwrap(), &options, &Unwatched).unwrap();
        let mut text = format!("{coordinates:?}, segments {segments:?}, {extent:?}, the paper's way\n");
        text += &whole(&made.mesh, &made.point_of_vertex);
        for edge in made.edges.iter().filter(|edge| edge.segment.is_some()) {
            let [a, b] = edge.ends.map(VertexId::index);
            let _ = writeln!(text, "e {a} {b} segment {}", edge.segment.unwrap());
        }
        insta::assert_snapshot!(format!("paper-{name}"), text);
    }
}

/// Holds all meshes of a method that are small enough.
fn hold(method: Method, name: &str) {
    let _bound = settings().bind_to_scope();
    let mut count = 0;
    // What has more points has more triangles.
    for fixture in common::fixtures().iter().filter(|fixture| 2 * fixture.points.len() <= MOST) {
        let Ok(made) = Mesher::new().method(method).triangulate(&fixture.points) else { continue };
        if made.mesh.triangles.len() > MOST {
            continue;
        }
        count += 1;
        let text = format!("{}, {name}\n{}", fixture.path, whole(&made.mesh, &made.input_of_vertex()));
        insta::assert_snapshot!(format!("{}-{name}", fixture.name), text);
    }
    assert!(count >= 4, "{count}");
}

fn settings() -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("whole");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}

/// Figures, then vertices and triangles one by one.
fn whole(mesh: &TriMesh, inputs: &[Option<u32>]) -> String {
    let angles = mesh.triangles.iter().flat_map(|t| {
        let corners: [DVec2; 3] = t.map(|v| mesh.vertices[v.index()]);
        hexdel::geom::quality::angles_deg(corners)
    });
    let (least, most) = angles.fold((180.0_f64, 0.0_f64), |(low, high), a| (low.min(a), high.max(a)));
    let mut text = format!(
        "{} vertices, {} triangles, {least:.6} to {most:.6} degrees\n",
        mesh.vertices.len(),
        mesh.triangles.len()
    );
    for (i, v) in mesh.vertices.iter().enumerate() {
        let input = inputs[i].map_or_else(String::new, |input| format!(" input {input}"));
        let _ = writeln!(text, "v{i} {:?} {:?}{input}", v.x, v.y);
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(VertexId::index);
        let _ = writeln!(text, "t {a} {b} {c}");
    }
    text
}
