//! Improves a mesh that came from elsewhere and keeps an interface in it: a Delaunay
//! triangulation of jittered points, with a row of edges between two materials that must stay.
//! `cargo run --release -p hexdel-optimize --example foreign_mesh`.
#![allow(clippy::print_stdout, reason = "what an example writes is its result")]

use hexdel_geom::{AngleBounds, CertifyOptions, DVec2, TriMesh, Unwatched, VertexId, certify};
use hexdel_optimize::{Constraints, Effort, Options, VertexKind, kinds_of, optimize_constrained};
use spade::{DelaunayTriangulation, Point2, Triangulation};
use std::error::Error;

/// Cells on each side of the unit square.
const CELLS: u32 = 24;

fn main() -> Result<(), Box<dyn Error>> {
    let mesh = foreign()?;
    report("before", &mesh)?;

    // The interface: the vertices on y = 1/2, from side to side.
    let mut row: Vec<VertexId> =
        (0..mesh.vertices.len()).map(VertexId::new).filter(|v| mesh.vertices[v.index()].y == 0.5).collect();
    row.sort_by(|a, b| mesh.vertices[a.index()].x.total_cmp(&mesh.vertices[b.index()].x));
    let ends = [row[0], row[row.len() - 1]];
    let mut kinds = kinds_of(&mesh, |v| ends.contains(&v));
    for v in &row[1..row.len() - 1] {
        kinds[v.index()] = VertexKind::OnSegment(0);
    }
    let constraints = Constraints {
        segments: vec![ends.map(|v| mesh.vertices[v.index()])],
        edges: row.windows(2).map(|pair| [pair[0], pair[1]]).collect(),
        points: ends.to_vec(),
        near: AngleBounds::new(30.0, 90.0)?,
        ..Constraints::default()
    };
    let options = Options::new(AngleBounds::new(38.0, 90.0)?, Effort::Fast);
    let made = optimize_constrained(mesh, &kinds, &constraints, &options, &Unwatched)?;

    report("after ", &made.mesh)?;
    println!("the interface is {} edges", made.edges.len());
    let on_it = |v: VertexId| made.mesh.vertices[v.index()].y == 0.5;
    assert!(made.edges.iter().flatten().all(|&v| on_it(v)), "all of it stays where it was");
    Ok(())
}

/// A triangulation as other programs make it: a jittered lattice, straight along the sides and
/// the interface.
fn foreign() -> Result<TriMesh, Box<dyn Error>> {
    let mut bits = 1_u32;
    let mut jitter = || {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        0.5 * (f64::from(bits >> 8) / f64::from(1_u32 << 24) - 0.5)
    };
    let step = 1.0 / f64::from(CELLS);
    let mut points = Vec::new();
    for j in 0..=CELLS {
        for i in 0..=CELLS {
            let inner = |k: u32| 0 < k && k < CELLS;
            let x = f64::from(i) + if inner(i) { jitter() } else { 0.0 };
            let y = f64::from(j) + if inner(j) && j != CELLS / 2 { jitter() } else { 0.0 };
            points.push(Point2::new(x * step, y * step));
        }
    }
    let delaunay = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(points)?;
    Ok(TriMesh {
        vertices: delaunay.vertices().map(|v| DVec2::new(v.position().x, v.position().y)).collect(),
        triangles: delaunay
            .inner_faces()
            .map(|face| face.vertices().map(|v| VertexId::new(v.fix().index())))
            .collect(),
    })
}

fn report(when: &str, mesh: &TriMesh) -> Result<(), Box<dyn Error>> {
    let bounds = AngleBounds::new(0.0, 180.0)?;
    let found = certify(mesh, &CertifyOptions { bounds, ..CertifyOptions::default() });
    println!(
        "{when}: {} triangles, {:.1} to {:.1} degrees",
        found.triangles, found.min_angle_deg, found.max_angle_deg
    );
    Ok(())
}
