//! Meshes 500 members of each family of small PSLGs and prints how many keep
//! their bounds, by default 30 to 90 degrees near segments and 43.89 to 90
//! elsewhere, and in how many all triangles two edges away from points and
//! segments keep the latter, seen from outside.
//!
//! ```text
//! cargo run --release -p hexdel-pslg --example families [COUNT] [FAMILY] [--min-angle DEG]
//! ```

#[path = "../tests/support/cpu.rs"]
mod cpu;
#[path = "../tests/support/mod.rs"]
mod support;

use cpu::cpu_seconds;
use hexdel_geom::{AngleBounds, Unwatched};
use hexdel_pslg::{Options, mesh, validate};
use std::io::Write;

fn main() -> std::io::Result<()> {
    let (mut count, mut only, mut options) = (500, None, Options::new());
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        if arg == "--min-angle" {
            let least = args.next().and_then(|a| a.parse().ok()).unwrap_or(30.0);
            options = options.near(AngleBounds::new(least, 90.0).map_err(std::io::Error::other)?);
        } else if let Ok(n) = arg.parse() {
            count = n;
        } else {
            only = Some(arg);
        }
    }
    let names = support::FAMILIES.into_iter().filter(|n| only.as_deref().is_none_or(|o| o == *n));
    names.into_iter().try_for_each(|name| family(name, count, &options))
}

fn family(name: &str, count: u64, options: &Options) -> std::io::Result<()> {
    let start = cpu_seconds();
    let (mut good, mut far, mut triangles, mut retries, mut worst) = (0, 0, 0, 0, Vec::new());
    for seed in 0..count {
        let valid = validate(&support::family(name, seed)).map_err(std::io::Error::other)?;
        let made = mesh(&valid, options, &Unwatched).map_err(std::io::Error::other)?;
        triangles += made.mesh.triangles.len();
        retries += u32::from(made.retries > 0);
        far += u64::from(support::far_triangles(&made).1 == 0);
        if made.holds() {
            good += 1;
        } else {
            worst.push((seed, made.failed.len(), made.certificate.non_delaunay_edges));
        }
    }
    writeln!(
        std::io::stdout(),
        "{name:10} {good:4} / {count}, two edges away {far:4}, {retries:3} with retries, {:6.0} triangles, {:.1} s {:?}",
        triangles as f64 / count as f64,
        cpu_seconds() - start,
        &worst[..worst.len().min(8)],
    )
}
