//! Meshes that are small enough to read, on record as a whole: every vertex with its input
//! point, every triangle. A change of a method shows here as what it is.
//!
//! Of templates and of the simple method there are all fixtures whose meshes are small, of the
//! compact method a few tiny ones, of the paper's own way with segments the small graphs.
//! `cargo xtask regen` renews the records, `cargo xtask regen --check` holds them.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use hexdel::geom::DVec2;
use hexdel::pslg::{Extent, Options, SegmentMethod, mesh, validate};
use hexdel::{Mesher, Method, TriMesh, Unwatched, VertexId};
use std::fmt::Write as _;

/// Larger meshes are on record elsewhere, by their figures and a hash.
const MOST: usize = 400;

/// The same for compact ones, which change whenever the optimiser does.
const MOST_COMPACT: usize = 40;

#[test]
fn whole_templates() {
    hold(Method::Templates, "templates", MOST, 6);
}

#[test]
fn whole_simple() {
    hold(Method::Simple, "simple", MOST, 6);
}

#[test]
fn whole_compact() {
    hold(Method::Compact, "compact", MOST_COMPACT, 2);
}

/// Holds all meshes of a method that are small enough; there are so many at least.
fn hold(method: Method, name: &str, most: usize, least: usize) {
    let _bound = settings().bind_to_scope();
    let mut count = 0;
    // What has more points has more triangles.
    for fixture in common::fixtures().iter().filter(|fixture| 2 * fixture.points.len() <= most) {
        let Ok(made) = Mesher::new().method(method).triangulate(&fixture.points) else { continue };
        if made.mesh.triangles.len() > most {
            continue;
        }
        count += 1;
        let text = format!("{}, {name}\n{}", fixture.path, whole(&made.mesh, &made.input_of_vertex()));
        insta::assert_snapshot!(format!("{}-{name}", fixture.name), text);
    }
    assert!(count >= least, "{count}");
}

/// Segments by the paper's section 7.
#[test]
fn whole_paper() {
    let _bound = settings().bind_to_scope();
    let mut count = 0;
    for (name, graph) in common::graphs() {
        let options = Options::new().method(SegmentMethod::Paper).extent(Extent::Inside);
        let Ok(valid) = validate(&graph) else { continue };
        let Ok(made) = mesh(&valid, &options, &Unwatched) else { continue };
        if made.mesh.triangles.len() > MOST {
            continue;
        }
        count += 1;
        let mut text = format!("fixtures/graphs/{name}.poly, paper\n");
        text += &whole(&made.mesh, &made.point_of_vertex);
        for edge in &made.edges {
            let [a, b] = edge.ends.map(VertexId::index);
            let segment = edge.segment.map_or_else(String::new, |segment| format!(" segment {segment}"));
            let _ = writeln!(text, "e {a} {b}{segment}");
        }
        insta::assert_snapshot!(format!("graphs-{name}-paper"), text);
    }
    assert!(count >= 1, "{count}");
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
