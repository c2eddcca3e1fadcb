//! Meshes a `.poly` file and says what came out.
//!
//! ```text
//! cargo run --release -p hexdel-pslg --example poly IN.poly [OUT.node] [hexagon|hull|inside] [REPAIR TOLERANCE]
//! ```

use hexdel_geom::{DVec2, Unwatched};
use hexdel_io::{MeshView, read_points, write_mesh};
use hexdel_pslg::{Extent, Options, mesh, repair, validate};
use std::error::Error;
use std::io::Write;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [input, rest @ ..] = args.as_slice() else {
        return Err("give a .poly file".into());
    };
    let extent = match rest.get(1).map(String::as_str) {
        Some("inside") => Extent::Inside,
        Some("hull") => Extent::Hull,
        _ => Extent::Hexagon,
    };
    let mut out = std::io::stdout();
    let start = Instant::now();
    let mut graph = read_points(input)?;
    if let Some(tolerance) = rest.get(2) {
        let (mended, report) = repair(&graph, tolerance.parse()?)?;
        writeln!(out, "{} repairs, complete: {}", report.repairs.len(), report.complete)?;
        graph = mended;
    }
    let valid = validate(&graph)?;
    let made = mesh(&valid, &Options::new().extent(extent), &Unwatched)?;
    let seconds = start.elapsed().as_secs_f64();
    let c = &made.certificate;
    writeln!(
        out,
        "{} triangles, {:.4} to {:.4} degrees, {} exempt, {} failed, {} not Delaunay, {} retries, {seconds:.2} s",
        c.triangles,
        c.min_angle_deg,
        c.max_angle_deg,
        made.exempt.len(),
        made.failed.len(),
        c.non_delaunay_edges,
        made.retries,
    )?;
    for failed in &made.failed {
        let DVec2 { x, y } = failed.at;
        writeln!(out, "  ({x:.6}, {y:.6}) {:.3?} {:?}", failed.angles_deg, failed.reason)?;
    }
    if let Some(path) = rest.first() {
        write_mesh(path, &MeshView::new(&made.mesh).with_input_indices(&made.point_of_vertex))?;
    }
    Ok(())
}
