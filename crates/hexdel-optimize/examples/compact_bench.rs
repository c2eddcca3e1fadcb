//! Prints what the optimiser does: triangles per point, CPU time per point,
//! attempts and successes.
//!
//! `compact_bench [start] [effort] [min] [input..]` where start is `templates`,
//! `separate`, `apart` or `among`, effort `fast`, `standard` or `best`, and an input a number of uniform
//! points or one of `line two grid circle cluster pairs`, each with `xN` behind for seeds 1 to N.

#![allow(clippy::print_stdout, reason = "a program that prints")]

mod support;

use std::sync::Mutex;
use std::time::Instant;

use hexdel_geom::{AngleBounds, DVec2, Monitor, Phase};
use hexdel_optimize::{Effort, OptimizeError, Options, Stats, optimize};
use hexdel_refine::Start as Coarse;
use support::{Rule, points, start};

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let rule = match args.first().map(String::as_str) {
        Some("separate") => Rule::Coarse(Coarse::Separate),
        Some("apart") => Rule::Coarse(Coarse::Apart),
        Some("among") => Rule::Coarse(Coarse::Among),
        _ => Rule::Templates,
    };
    let effort = match args.get(1).map(String::as_str) {
        Some("fast") => Effort::Fast,
        Some("best") => Effort::Best,
        _ => Effort::Standard,
    };
    let extended = AngleBounds::EXTENDED;
    let min = args.get(2).and_then(|a| a.parse().ok()).unwrap_or(extended.min_deg());
    let bounds = AngleBounds::new(min, 90.0).expect("feasible bounds");
    let mut inputs: Vec<String> = args.into_iter().skip(3).collect();
    if inputs.is_empty() {
        inputs = ["100", "1000", "10000"].map(String::from).to_vec();
    }
    println!(
        "input: start/pt, triangles/pt, CPU ms/pt, rounds; successes/attempts of repairs, removals, shakes; steps"
    );
    for name in inputs {
        run(&name, rule, &Options::new(bounds, effort));
    }
}

fn input(name: &str, seed: u64) -> Vec<DVec2> {
    match name {
        "line" => points::line(100, seed),
        "two" => points::two_close(),
        "grid" => points::grid(10),
        "circle" => points::circle(100),
        "cluster" => points::clusters(1000, seed),
        "pairs" => points::pairs(50, 1e-4, seed),
        n => points::uniform(n.parse().expect("a count"), seed),
    }
}

/// All seeds of an input.
fn run(input: &str, rule: Rule, options: &Options) {
    let (name, seeds) = input.split_once('x').map_or((input, 1), |(n, s)| (n, s.parse().expect("a count")));
    let runs: Vec<Run> = (1..=seeds).filter_map(|seed| one(name, seed, rule, options)).collect();
    if runs.len() < 2 {
        return;
    }
    let mean = |f: fn(&Run) -> f64| runs.iter().map(f).sum::<f64>() / runs.len() as f64;
    let of = |pick: fn(f64, f64) -> f64| runs.iter().map(|r| r.triangles).reduce(pick).unwrap_or_default();
    let (least, most) = (of(f64::min), of(f64::max));
    println!(
        "{input}: mean {:.3} ({least:.3} to {most:.3}) triangles/pt, {:.4} ms/pt",
        mean(|r| r.triangles),
        mean(|r| r.ms)
    );
}

/// What one run took, per point.
struct Run {
    triangles: f64,
    ms: f64,
}

fn one(name: &str, seed: u64, rule: Rule, options: &Options) -> Option<Run> {
    let points = input(name, seed);
    let start = start(&points, rule);
    let n = points.len() as f64;
    let before = start.mesh.triangles.len() as f64 / n;
    let cpu = cpu_seconds();
    let wall = Instant::now();
    let rounds_ms = Rounds::default();
    let (result, bad) = match optimize(start.mesh, &start.kinds, options, &rounds_ms) {
        Ok(result) => (result, 0),
        Err(OptimizeError::Unreached { best, bad, .. }) => (*best, bad),
        Err(error) => {
            println!("{name} seed {seed}: {error}");
            return None;
        }
    };
    let run = Run { triangles: result.mesh.triangles.len() as f64 / n, ms: (cpu_seconds() - cpu) * 1e3 / n };
    let Stats { rounds, repairs, removals, shakes, steps, .. } = result.stats;
    println!(
        "{name} seed {seed}: {before:.2}, {:.3}, {:.4}, {rounds}; {}/{} {}/{} {}/{}; {steps}; wall {:.2} s, {bad} bad",
        run.triangles,
        run.ms,
        repairs[1],
        repairs[0],
        removals[1],
        removals[0],
        shakes[1],
        shakes[0],
        wall.elapsed().as_secs_f64(),
    );
    let seen = rounds_ms.0.into_inner().expect("no panic");
    let each: Vec<String> = seen.windows(2).map(|w| format!("{:.3}", (w[1].1 - w[0].1) * 1e3 / n)).collect();
    println!("  CPU ms/pt of each round: {}", each.join(" "));
    Some(run)
}

/// Prints the CPU time at which each round begins.
#[derive(Default)]
struct Rounds(Mutex<Vec<(u64, f64)>>);

impl Monitor for Rounds {
    fn progress(&self, _: Phase, done: u64, _: u64) {
        let mut seen = self.0.lock().expect("no panic");
        if seen.last().is_none_or(|last| last.0 != done) {
            seen.push((done, cpu_seconds()));
        }
    }
}

/// CPU time of this process so far; zero where the system does not tell.
fn cpu_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // User and system time are the 12th and 13th fields after the name, in
    // ticks of a hundredth of a second.
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    let ticks: f64 = fields.skip(11).take(2).filter_map(|f| f.parse::<f64>().ok()).sum();
    ticks / 100.0
}
