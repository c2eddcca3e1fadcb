//! Meshes that are small enough to read, on record as a whole: every vertex with its input
//! point, every triangle. A change of a method shows here as what it is.
//!
//! Of templates and of the simple method there are all fixtures whose meshes are small. Compact
//! meshes change whenever the optimiser does: they are on record by figures and a hash.
//! `cargo xtask regen` renews the records, `cargo xtask regen --check` holds them.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod common;

use hexdel::geom::DVec2;
use hexdel::{Mesher, Method, TriMesh, VertexId};
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
