//! Meshes small random PSLGs, planar ones and ones to be repaired, and checks
//! that each gives a valid mesh with every segment in it, or an error.
//!
//! ```text
//! cargo run --release -p hexdel-pslg --example dirty [COUNT] [FIRST] [SECONDS]
//! ```
//!
//! With a budget of seconds for each PSLG more triangles are left out of bounds.

#[path = "../tests/support/cpu.rs"]
mod cpu;
#[path = "../tests/support/mod.rs"]
mod support;

use cpu::cpu_seconds;
use hexdel_geom::{Pslg, Unwatched};
use hexdel_pslg::{Options, mesh, repair, validate};
use std::io::Write;
use std::time::Duration;

#[derive(Default)]
struct Tally {
    good: u32,
    failed: u32,
    refused: u32,
    broken: u32,
    /// CPU seconds and seed of each.
    seconds: Vec<(f64, u64)>,
}

fn main() -> std::io::Result<()> {
    let args: Vec<f64> = std::env::args().skip(1).map(|a| a.parse().unwrap_or(0.0)).collect();
    let whole = |i: usize, usual: u64| args.get(i).map_or(usual, |a| *a as u64);
    let (count, first) = (whole(0, 10_000), whole(1, 0));
    let budget = args.get(2).map(|&seconds| Duration::from_secs_f64(seconds));
    let options = Options::new().retries(1).max_triangles(200_000).budget(budget);
    let mut out = std::io::stdout();
    let (mut clean, mut dirty) = (Tally::default(), Tally::default());
    for seed in first..first + count {
        let mut graph = support::random_graph(seed);
        graph.holes.clear();
        if validate(&graph).is_ok() {
            one(&graph, seed, &options, &mut clean, &mut out)?;
        } else if let Ok((mended, _)) = repair(&graph, 1e-6) {
            one(&mended, seed, &options, &mut dirty, &mut out)?;
        }
    }
    for (name, mut t) in [("planar", clean), ("repaired", dirty)] {
        t.seconds.sort_by(|a, b| b.0.total_cmp(&a.0));
        let at = |share: f64| t.seconds.get((t.seconds.len() as f64 * share) as usize).map_or(0.0, |s| s.0);
        writeln!(
            out,
            "{name}: {} within bounds, {} with failed triangles, {} refused, {} broken; CPU seconds: median {:.3}, \
             one in ten {:.3}, one in a hundred {:.2}, one in a thousand {:.2}, slowest {:.2?}",
            t.good,
            t.failed,
            t.refused,
            t.broken,
            at(0.5),
            at(0.1),
            at(0.01),
            at(0.001),
            &t.seconds[..t.seconds.len().min(3)],
        )?;
    }
    Ok(())
}

fn one(
    graph: &Pslg,
    seed: u64,
    options: &Options,
    tally: &mut Tally,
    out: &mut impl Write,
) -> std::io::Result<()> {
    let start = cpu_seconds();
    let valid = match validate(graph) {
        Ok(valid) => valid,
        Err(error) => {
            tally.refused += 1;
            return writeln!(out, "{seed}: {error}");
        }
    };
    match mesh(&valid, options, &Unwatched) {
        Ok(made) => match support::check(graph, &made) {
            Ok(()) if made.holds() => tally.good += 1,
            Ok(()) => {
                tally.failed += 1;
                let left = made.failed.len();
                writeln!(out, "{seed}: {left} failed, {} not Delaunay", made.certificate.non_delaunay_edges)?;
            }
            Err(what) => {
                tally.broken += 1;
                writeln!(out, "{seed}: {what}")?;
            }
        },
        Err(error) => {
            tally.refused += 1;
            writeln!(out, "{seed}: {error}")?;
        }
    }
    let seconds = cpu_seconds() - start;
    if seconds > 1.0 {
        writeln!(out, "{seed}: {seconds:.2} s")?;
    }
    tally.seconds.push((seconds, seed));
    Ok(())
}
