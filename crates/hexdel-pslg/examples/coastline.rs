//! Meshes what a fractal closed curve encloses, at growing numbers of segments,
//! and prints CPU seconds and how they grow.
//!
//! ```text
//! cargo run --release -p hexdel-pslg --example coastline [LARGEST] [none|fast|standard|best]
//! ```

#[path = "../tests/support/cpu.rs"]
mod cpu;
#[path = "../tests/support/mod.rs"]
mod support;

use cpu::cpu_seconds;
use hexdel_geom::Unwatched;
use hexdel_pslg::{Effort, Extent, Options, mesh, validate};
use std::io::Write;

fn main() -> std::io::Result<()> {
    let mut args = std::env::args().skip(1);
    let largest: usize = args.next().and_then(|a| a.parse().ok()).unwrap_or(100_000);
    let effort = match args.next().as_deref() {
        Some("none") => None,
        Some("fast") => Some(Effort::Fast),
        Some("best") => Some(Effort::Best),
        _ => Some(Effort::Standard),
    };
    let options = Options::new().extent(Extent::Inside).compact(effort);
    let mut out = std::io::stdout();
    let mut last: Option<(f64, f64)> = None;
    let mut least = 1000;
    while least <= largest {
        let graph = support::coastline(least, 1);
        let start = cpu_seconds();
        let valid = validate(&graph).map_err(std::io::Error::other)?;
        let validated = cpu_seconds();
        let made = mesh(&valid, &options, &Unwatched).map_err(std::io::Error::other)?;
        let (n, seconds) = (graph.segments.len() as f64, cpu_seconds() - start);
        let exponent = last.map_or(f64::NAN, |(m, s)| (seconds / s).ln() / (n / m).ln());
        writeln!(
            out,
            "{n} segments: {seconds:.2} s ({:.2} s to validate), exponent {exponent:.2}, {} triangles, \
             {} exempt, {} failed, {} retries, holds: {}",
            validated - start,
            made.mesh.triangles.len(),
            made.exempt.len(),
            made.failed.len(),
            made.retries,
            made.holds(),
        )?;
        last = Some((n, seconds));
        least *= 10;
    }
    Ok(())
}
