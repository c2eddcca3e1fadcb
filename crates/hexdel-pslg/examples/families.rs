//! Meshes 500 members of each family of small graphs and prints how many keep
//! 30 to 90 degrees near segments and 43.9 to 90 elsewhere.
//!
//! ```text
//! cargo run --release -p hexdel-pslg --example families [COUNT] [FAMILY]
//! ```

#[path = "../tests/support/mod.rs"]
mod support;

use hexdel_geom::Unwatched;
use hexdel_pslg::{Options, mesh, validate};
use std::io::Write;
use std::time::Instant;

fn main() -> std::io::Result<()> {
    let mut args = std::env::args().skip(1);
    let count: u64 = args.next().and_then(|a| a.parse().ok()).unwrap_or(500);
    let only = args.next();
    let options = match std::env::var("RETRIES") {
        Ok(n) => Options::new().retries(n.parse().unwrap_or(4)),
        Err(_) => Options::new(),
    };
    let mut out = std::io::stdout();
    for name in support::FAMILIES.into_iter().filter(|n| only.as_deref().is_none_or(|o| o == *n)) {
        let start = Instant::now();
        let (mut good, mut triangles, mut retries, mut worst) = (0, 0, 0, Vec::new());
        for seed in 0..count {
            let valid = validate(&support::family(name, seed)).map_err(std::io::Error::other)?;
            let made = mesh(&valid, &options, &Unwatched).map_err(std::io::Error::other)?;
            triangles += made.mesh.triangles.len();
            retries += u32::from(made.retries > 0);
            if made.holds() {
                good += 1;
            } else {
                worst.push((seed, made.failed.len(), made.certificate.non_delaunay_edges));
            }
        }
        writeln!(
            out,
            "{name:10} {good:4} / {count}, {retries:3} with retries, {:6.0} triangles, {:.1} s {:?}",
            triangles as f64 / count as f64,
            start.elapsed().as_secs_f64(),
            &worst[..worst.len().min(8)],
        )?;
    }
    Ok(())
}
