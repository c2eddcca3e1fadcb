//! Meshes segments that meet at small angles, two of them, stars of many, needles in
//! a frame, and prints what is exempt and what failed.
//!
//! ```text
//! cargo run --release -p hexdel-pslg --example wedges [SEEDS] [NEEDLE] [alone]
//! ```
//!
//! Needles that are alone have no frame.

#[path = "../tests/support/cpu.rs"]
mod cpu;
#[path = "../tests/support/mod.rs"]
mod support;

use cpu::cpu_seconds;
use hexdel_geom::{Pslg, Unwatched};
use hexdel_pslg::{Extent, Options, mesh, validate};
use std::io::Write;

fn main() -> std::io::Result<()> {
    let seeds: u64 = std::env::args().nth(1).and_then(|a| a.parse().ok()).unwrap_or(20);
    let only = std::env::args().nth(2);
    let alone = std::env::args().nth(3).is_some_and(|a| a == "alone");
    let (extent, place) = if alone { (Extent::Hexagon, "alone") } else { (Extent::Inside, "in a frame") };
    for name in support::NEEDLES.into_iter().filter(|n| only.as_deref().is_none_or(|o| o == *n)) {
        for angle in [0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 5.0] {
            let made = |seed| {
                let needle = support::needle(name, angle, seed);
                if alone { support::without_frame(needle) } else { needle }
            };
            report(&format!("{name}, {angle} degrees, {place}"), seeds, extent, made)?;
        }
    }
    if only.is_some() {
        return Ok(());
    }
    let extent = Extent::Hexagon;
    for angle in [0.1, 0.3, 1.0, 2.0, 3.0, 5.0, 7.0, 8.0, 10.0, 15.0, 20.0, 25.0] {
        let made = |seed| support::wedge(angle, seed);
        report(&format!("two segments at {angle} degrees"), seeds, extent, made)?;
    }
    for n in [12, 13, 18, 24, 36, 60, 120] {
        report(&format!("star of {n}, {:.1} degrees", 360.0 / f64::from(n)), seeds, extent, |seed| {
            support::rays(n, seed)
        })?;
    }
    Ok(())
}

fn report(name: &str, seeds: u64, extent: Extent, graph: impl Fn(u64) -> Pslg) -> std::io::Result<()> {
    let start = cpu_seconds();
    let (mut good, mut triangles, mut exempt, mut failed) = (0, 0, 0, 0);
    let mut which = Vec::new();
    let (mut worst, mut highest) = (180.0_f64, 0.0_f64);
    for seed in 0..seeds {
        let graph = graph(seed);
        let valid = validate(&graph).map_err(std::io::Error::other)?;
        let made = mesh(&valid, &Options::new().extent(extent), &Unwatched).map_err(std::io::Error::other)?;
        support::check(&graph, &made).map_err(std::io::Error::other)?;
        good += u64::from(made.holds());
        triangles += made.certificate.triangles;
        exempt += made.exempt.len();
        failed += made.failed.len();
        if !made.holds() {
            which.push(seed);
        }
        worst = made.failed.iter().fold(worst, |w, f| w.min(f.angles_deg[0]));
        highest = highest.max(made.certificate.max_angle_deg);
    }
    writeln!(
        std::io::stdout(),
        "{name}: {good} of {seeds} hold; on average {:.0} triangles, {:.1} exempt, {:.2} failed (down to \
         {worst:.1} degrees), largest angle {highest:.4}, {:.2} s {which:?}",
        triangles as f64 / seeds as f64,
        exempt as f64 / seeds as f64,
        failed as f64 / seeds as f64,
        (cpu_seconds() - start) / seeds as f64,
    )
}
