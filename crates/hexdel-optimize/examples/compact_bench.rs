//! Prints what the optimiser does to uniform random points: triangles per
//! point, CPU time per point, attempts and successes.
//!
//! `cargo run --release -p hexdel-optimize --example compact_bench -- [start] [effort] [min] [counts..]`

#![allow(clippy::print_stdout, reason = "a program that prints")]

mod support;

use std::time::Instant;

use hexdel_geom::AngleBounds;
use hexdel_optimize::{Effort, OptimizeError, Options, optimize};
use support::{Rule, points, start};

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let rule = match args.first().map(String::as_str) {
        Some("b") => Rule::B,
        Some("c") => Rule::C,
        Some("d") => Rule::D,
        Some(x) => x.parse().map_or(Rule::E(0.6), Rule::E),
        None => Rule::E(0.6),
    };
    let effort = match args.get(1).map(String::as_str) {
        Some("fast") => Effort::Fast,
        Some("best") => Effort::Best,
        _ => Effort::Standard,
    };
    let min = args
        .get(2)
        .and_then(|a| a.parse().ok())
        .unwrap_or(AngleBounds::EXTENDED.min_deg());
    let max = 90.0;
    let bounds = AngleBounds::new(min, max).expect("feasible bounds");
    let mut counts: Vec<String> = args.into_iter().skip(3).collect();
    if counts.is_empty() {
        counts = ["100", "1000", "10000"].map(String::from).to_vec();
    }
    println!(
        "{:>9} {:>8} {:>8} {:>9} {:>9} {:>6} {:>16} {:>18} {:>16} {:>9}",
        "input",
        "start/pt",
        "tri/pt",
        "cpu ms/pt",
        "wall",
        "rounds",
        "repairs",
        "removals",
        "shakes",
        "steps"
    );
    for count in counts {
        let points = match count.as_str() {
            "line" => points::line(100, 1),
            "two" => points::two_close(),
            "grid" => points::grid(10),
            "circle" => points::circle(100),
            "cluster" => points::clusters(1000, 1),
            "pairs" => points::pairs(50, 1e-4, 1),
            n => points::uniform(n.parse().expect("a count"), 1),
        };
        let mesh = start(&points, rule);
        let n = points.len() as f64;
        let before = mesh.mesh.triangles.len() as f64 / n;
        let mut options = Options::new(bounds, effort);
        let log = |p: hexdel_optimize::Progress| {
            println!(
                "  {:?} {} {:.3} bad {} cpu {:.4}",
                p.phase,
                p.round,
                p.triangles as f64 / n,
                p.bad,
                cpu_seconds() * 1e3 / n
            );
            true
        };
        if std::env::var("LOG").is_ok() {
            options = options.with_hook(&log);
        }
        let (wall, cpu) = (Instant::now(), cpu_seconds());
        let (result, bad) = match optimize(mesh.mesh, &mesh.kinds, &options) {
            Ok(o) => (o, 0),
            Err(OptimizeError::Unreached { best, bad, .. }) => (*best, bad),
            Err(e) => {
                println!("{count:>9} {e}");
                continue;
            }
        };
        if std::env::var("SHOW").is_ok() {
            let mut degree = vec![0; result.mesh.vertices.len()];
            for t in &result.mesh.triangles {
                for v in t {
                    degree[v.index()] += 1;
                }
            }
            for t in &result.mesh.triangles {
                let p = t.map(|v| result.mesh.vertices[v.index()]);
                let a: [f64; 3] = std::array::from_fn(|k| {
                    let (u, w) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                    u.perp_dot(w).atan2(u.dot(w)).to_degrees()
                });
                if a.iter().any(|x| *x < min - 1e-9 || *x > max + 1e-9) {
                    println!(
                        "{:?} at {:.4} angles {:.2?}",
                        t.map(|v| (
                            result.kinds[v.index()] == hexdel_optimize::VertexKind::Fixed,
                            degree[v.index()],
                            v.index()
                        )),
                        p[0],
                        a
                    );
                }
            }
        }
        let (wall, cpu) = (wall.elapsed().as_secs_f64(), cpu_seconds() - cpu);
        let s = result.stats;
        println!(
            "{count:>9} {before:8.2} {:8.3} {:9.4} {:8.2}s {:>6} {:>16} {:>18} {:>16} {:>9}{}",
            result.mesh.triangles.len() as f64 / n,
            cpu * 1e3 / n,
            wall,
            s.rounds,
            format!("{}/{}", s.repairs[1], s.repairs[0]),
            format!("{}/{}", s.removals[1], s.removals[0]),
            format!("{}/{}", s.shakes[1], s.shakes[0]),
            s.steps,
            if bad > 0 {
                format!(" BAD {bad}")
            } else {
                String::new()
            },
        );
    }
}

/// CPU time of this process so far; zero where the system does not tell.
fn cpu_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // User and system time are the 12th and 13th fields after the name.
    let fields = stat
        .rsplit(')')
        .next()
        .unwrap_or_default()
        .split_whitespace();
    let ticks: f64 = fields
        .skip(11)
        .take(2)
        .filter_map(|f| f.parse::<f64>().ok())
        .sum();
    ticks / 100.0
}
