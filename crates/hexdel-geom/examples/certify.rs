//! Measures the certificate and the scan for edges that are not Delaunay on
//! structured patches: `cargo run --release --example certify [million triangles]`.
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::time::Instant;

use hexdel_geom::{
    AngleBounds, CertifyOptions, DVec2, TriMesh, VertexId, certify, closest_pair, restore_delaunay,
    smallest_enclosing_circle,
};

/// `columns` by `columns` cells of two triangles each, spanned by `u` and `w`.
fn patch(columns: usize, u: DVec2, w: DVec2) -> TriMesh {
    let side = columns + 1;
    let at = |i: usize| u * (i % side) as f64 + w * (i / side) as f64;
    let cells = (0..side * columns).filter(|i| i % side < columns);
    let triangles = cells.flat_map(|i| [[i, i + 1, i + side], [i + 1, i + side + 1, i + side]]);
    TriMesh {
        vertices: (0..side * side).map(at).collect(),
        triangles: triangles.map(|t| t.map(VertexId::new)).collect(),
    }
}

fn timed<T>(what: &str, millions: f64, run: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = run();
    let seconds = start.elapsed().as_secs_f64();
    println!("  {what}: {seconds:.3} s, {:.1} million per second", millions / seconds);
    result
}

fn measure(name: &str, mesh: &mut TriMesh) {
    let millions = mesh.triangles.len() as f64 * 1e-6;
    println!("{name}: {millions:.2} million triangles");
    let inputs: Vec<DVec2> = mesh.vertices.iter().step_by(50).copied().collect();
    let request = CertifyOptions { inputs: Some(&inputs), ..CertifyOptions::default() };
    let report =
        timed("restore", millions, || restore_delaunay(mesh, AngleBounds::EXTENDED, |v| v.index() % 50 != 0));
    println!("  {report:?}");
    let certificate = timed("certify", millions, || certify(mesh, &request));
    println!(
        "  holds: {}, angles {} to {}, {} rounding limited",
        certificate.holds(),
        certificate.min_angle_deg,
        certificate.max_angle_deg,
        certificate.rounding_limited
    );
}

fn main() -> Result<(), Box<dyn Error>> {
    let millions: f64 = std::env::args().nth(1).map_or(Ok(4.0), |s| s.parse())?;
    let columns = (millions * 0.5e6).sqrt() as usize;
    let (sin, cos) = 0.3_f64.sin_cos();
    let turned = |x: f64, y: f64| DVec2::new(cos * x - sin * y, sin * x + cos * y) * 1e-3;
    let height = 0.75_f64.sqrt();
    measure("equilateral", &mut patch(columns, turned(1.0, 0.0), turned(0.5, height)));
    measure("squares", &mut patch(columns, DVec2::X, DVec2::Y));
    measure("turned squares", &mut patch(columns, turned(1.0, 0.0), turned(0.0, 1.0)));

    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let points: Vec<DVec2> = (0..1_000_000).map(|_| DVec2::new(random(), random())).collect();
    println!("random points");
    timed("closest pair", 1.0, || closest_pair(&points));
    timed("enclosing circle", 1.0, || smallest_enclosing_circle(&points));
    timed("merging duplicates", 1.0, || hexdel_geom::PointSet::new(&points))?;
    let line: Vec<DVec2> = (0..1_000_000).map(|i| DVec2::new(0.5, f64::from(i))).collect();
    println!("points on a vertical line");
    timed("closest pair", 1.0, || closest_pair(&line));
    timed("enclosing circle", 1.0, || smallest_enclosing_circle(&line));
    Ok(())
}
