//! Meshes graphs by the paper's own method for segments and says what angles it
//! leaves.
//!
//! ```text
//! cargo run --release -p hexdel-pslg --example paper -- [hexagon|inside] FILE.poly|line|square|FAMILY:SEED ...
//! ```
//!
//! Columns: triangles; smallest and largest angle; the same among triangles
//! without a corner on a point or segment; triangles that do not keep 30 to 90
//! degrees.

#[path = "../tests/support/mod.rs"]
mod support;

use hexdel_geom::{DVec2, Pslg, TriangleId, Unwatched, quality};
use hexdel_io::read_points;
use hexdel_pslg::{Extent, Options, PslgMesh, SegmentMethod, mesh, validate};
use std::error::Error;
use std::io::Write;

fn main() -> Result<(), Box<dyn Error>> {
    let mut options = Options::new().method(SegmentMethod::Paper);
    let mut out = std::io::stdout();
    for name in std::env::args().skip(1) {
        match name.as_str() {
            "hexagon" => options = options.extent(Extent::Hexagon),
            "inside" => options = options.extent(Extent::Inside),
            _ => {
                let made = mesh(&validate(&graph(&name)?)?, &options, &Unwatched)?;
                let c = &made.certificate;
                let [least, most] = angles_away(&made);
                writeln!(
                    out,
                    "{name:40} {:7} {:7.2} {:7.2}   {least:7.4} {most:7.4} {:6} {}",
                    c.triangles,
                    c.min_angle_deg,
                    c.max_angle_deg,
                    made.failed.len(),
                    if made.holds() { "holds" } else { "DOES NOT HOLD" },
                )?;
            }
        }
    }
    Ok(())
}

fn graph(name: &str) -> Result<Pslg, Box<dyn Error>> {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y));
    Ok(match name.split_once(':') {
        Some((family, seed)) => support::family(family, seed.parse()?),
        None if name == "line" => {
            let mut line = Pslg::from_points(vec![corners[0], DVec2::new(1.0, 0.3)]);
            line.segments.push([0, 1]);
            line
        }
        None if name == "square" => {
            let mut square = Pslg::from_points(corners.to_vec());
            square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
            square
        }
        None => read_points(name)?,
    })
}

/// The smallest and largest angle of triangles that have no corner on a point
/// or segment.
fn angles_away(made: &PslgMesh) -> [f64; 2] {
    let mut near = vec![false; made.mesh.vertices.len()];
    for v in made.edges.iter().filter(|e| e.segment.is_some()).flat_map(|e| e.ends) {
        near[v.index()] = true;
    }
    for v in made.vertex_of_point.iter().flatten() {
        near[v.index()] = true;
    }
    let away = made.mesh.triangles.iter().enumerate().filter(|(_, t)| t.iter().all(|v| !near[v.index()]));
    away.flat_map(|(t, _)| quality::angles_deg(made.mesh.corners(TriangleId::new(t))))
        .fold([180.0, 0.0], |[least, most], a| [a.min(least), a.max(most)])
}
