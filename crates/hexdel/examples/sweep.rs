//! Meshes every kind of point set with many seeds, and files, by the compact method;
//! prints what was not within the bounds, which starts were used, and how many
//! triangles each input took.
//!
//! `sweep [--points N] [--seeds N] [--effort fast|standard|best] [--min DEG] [--max DEG] [file.node..]`

#![allow(clippy::print_stdout, reason = "a program that prints")]

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

use hexdel::generate::{Kind, generate};
use hexdel::geom::{CertifyOptions, certify};
use hexdel::{AngleBounds, DVec2, Effort, Error, Mesher, Method};

struct Sweep {
    mesher: Mesher,
    bounds: AngleBounds,
    /// How often each start led to the mesh.
    starts: BTreeMap<String, usize>,
    /// Meshes that were refused or do not hold.
    failed: usize,
}

impl Sweep {
    /// Meshes one input, checks the mesh from scratch; triangles per point.
    fn run(&mut self, name: &str, points: &[DVec2]) -> f64 {
        let made = match self.mesher.triangulate(points) {
            Ok(made) => made,
            Err(error) => {
                let left = match &error {
                    Error::Unreached { certificate, .. } => certificate.out_of_bounds,
                    _ => 0,
                };
                println!("{name}: {error} ({left} triangles outside)");
                self.failed += 1;
                return f64::NAN;
            }
        };
        let options =
            CertifyOptions { bounds: self.bounds, inputs: Some(points), ..CertifyOptions::default() };
        let found = certify(&made.mesh, &options);
        if !found.holds() || found.inputs_kept != points.len() {
            println!("{name}: {:?}", found.violations);
            self.failed += 1;
        }
        let start = format!("{:?}", made.start);
        if made.start != hexdel::Start::Coarse {
            println!("{name}: started from {start}");
        }
        *self.starts.entry(start).or_default() += 1;
        made.mesh.triangles.len() as f64 / points.len() as f64
    }
}

fn main() {
    let (mut points, mut seeds, mut files) = (100, 10, Vec::new());
    let (mut min, mut max, mut effort) = (AngleBounds::EXTENDED.min_deg(), 90.0, Effort::Standard);
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        let mut value = || args.next().expect("a value follows each option");
        match arg.as_str() {
            "--points" => points = value().parse().expect("a count"),
            "--seeds" => seeds = value().parse().expect("a count"),
            "--min" => min = value().parse().expect("degrees"),
            "--max" => max = value().parse().expect("degrees"),
            "--effort" => {
                effort = match value().as_str() {
                    "fast" => Effort::Fast,
                    "best" => Effort::Best,
                    _ => Effort::Standard,
                }
            }
            _ => files.push(arg),
        }
    }
    let bounds = AngleBounds::new(min, max).expect("feasible bounds");
    let mesher = Mesher::new().method(Method::Compact).effort(effort).bounds(bounds);
    let mut sweep = Sweep { mesher, bounds, starts: BTreeMap::new(), failed: 0 };
    if seeds > 0 {
        kinds(&mut sweep, points, seeds);
    }
    for file in &files {
        let read = hexdel::io::read_points(Path::new(file)).expect("a readable file");
        println!("{file}: {:.2} triangles per point", sweep.run(file, &read.points));
    }
    println!("starts used: {:?}; not within the bounds: {}", sweep.starts, sweep.failed);
}

fn kinds(sweep: &mut Sweep, points: usize, seeds: u64) {
    for kind in Kind::ALL {
        let began = Instant::now();
        let mut per_point: Vec<f64> = (1..=seeds)
            .map(|seed| sweep.run(&format!("{kind} {points} seed {seed}"), &generate(kind, points, seed)))
            .collect();
        per_point.sort_unstable_by(f64::total_cmp);
        println!(
            "{kind} {points}: {:.2} to {:.2} triangles per point, median {:.2}, {:.1} s",
            per_point[0],
            per_point[per_point.len() - 1],
            per_point[per_point.len() / 2],
            began.elapsed().as_secs_f64(),
        );
    }
}
