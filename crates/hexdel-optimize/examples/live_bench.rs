//! Insertions into a compact mesh and removals from it: how many find room,
//! what each costs, and what the mesh comes to.
//!
//! `cargo run --release -p hexdel-optimize --example live_bench -- POINTS CHANGES [fast]`

#![allow(clippy::print_stdout, reason = "an example prints")]

mod support;

use hexdel_geom::{AngleBounds, CertifyOptions, DVec2, Unwatched, certify};
use hexdel_optimize::live::LiveMesh;
use hexdel_optimize::{Effort, Options, optimize};
use hexdel_refine::Start;
use support::{Rule, points, start};

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let number = |i: usize| args.get(i).map(|a| a.parse::<usize>().expect("a number"));
    let (n, changes) = (number(0).unwrap_or(1000), number(1).unwrap_or(100));
    let effort = if args.get(2).is_some_and(|a| a == "fast") { Effort::Fast } else { Effort::Standard };
    let all = points::uniform(n + changes, 1);
    let bounds = AngleBounds::EXTENDED;
    let begin = start(&all[..n], Rule::Coarse(Start::Among));
    let options = Options::new(bounds, effort);
    let made = optimize(begin.mesh, &begin.kinds, &options, &Unwatched).expect("reached");
    println!(
        "{n} points: {} triangles, {:.2} per point",
        made.mesh.triangles.len(),
        made.mesh.triangles.len() as f64 / n as f64
    );
    let mut live = LiveMesh::new(made.mesh, &made.kinds, bounds).expect("a mesh");
    let mut times = Vec::new();
    let mut failed = 0;
    let mut touched = 0;
    let mut slots = Vec::new();
    for &p in &all[n..] {
        let began = cpu_ms();
        match live.insert(p) {
            Ok(slot) => slots.push(slot),
            Err(error) => {
                failed += 1;
                println!("{error} {:.1} ms", cpu_ms() - began);
            }
        }
        times.push(cpu_ms() - began);
        let (_, delta) = live.take_step();
        touched += delta.triangles_added.len();
    }
    report("insert", &mut times);
    let count = live.counts()[1];
    println!(
        "failed {failed}, triangles touched per change {}, now {count} triangles, {:.2} per point",
        touched / changes,
        count as f64 / (n + changes - failed) as f64
    );
    check(&live, bounds, &all[..n]);
    times.clear();
    for slot in slots {
        let began = cpu_ms();
        live.release(slot).expect("room");
        times.push(cpu_ms() - began);
        live.take_step();
    }
    report("remove", &mut times);
    println!("now {} triangles", live.counts()[1]);
    check(&live, bounds, &all[..n]);
    close(&mut live, &all[..n.min(8)]);
}

/// Points ever closer to others, each taken out again.
fn close(live: &mut LiveMesh, others: &[DVec2]) {
    for exponent in [1, 2, 4] {
        let distance = 0.02 * 10_f64.powi(-exponent);
        let (mut inserted, mut removed, mut failed) = (Vec::new(), Vec::new(), 0);
        for (i, &p) in others.iter().enumerate() {
            let turn = DVec2::from_angle(i as f64);
            let began = cpu_ms();
            let slot = live.insert(p + distance * turn);
            inserted.push(cpu_ms() - began);
            live.take_step();
            let Ok(slot) = slot else {
                failed += 1;
                continue;
            };
            let began = cpu_ms();
            live.release(slot).expect("room");
            removed.push(cpu_ms() - began);
            live.take_step();
        }
        println!(
            "{distance:.0e} from another: {failed} of {} failed, now {} triangles",
            others.len(),
            live.counts()[1]
        );
        report("  insert", &mut inserted);
        report("  remove", &mut removed);
    }
}

fn report(what: &str, times: &mut [f64]) {
    times.sort_by(f64::total_cmp);
    if times.is_empty() {
        return;
    }
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    println!(
        "{what}: median {:.2} ms, 90 % {:.2}, 99 % {:.2}, most {:.2}, mean {mean:.2}",
        at(0.5),
        at(0.9),
        at(0.99),
        at(1.0)
    );
}

fn check(live: &LiveMesh, bounds: AngleBounds, inputs: &[DVec2]) {
    let certificate = certify(
        &live.snapshot().mesh,
        &CertifyOptions { bounds, inputs: Some(inputs), ..CertifyOptions::default() },
    );
    println!("certified: {}", certificate.holds());
}

/// Milliseconds that this thread has run.
#[cfg(target_os = "linux")]
fn cpu_ms() -> f64 {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    now.tv_sec as f64 * 1e3 + now.tv_nsec as f64 * 1e-6
}

/// Milliseconds since the first call.
#[cfg(not(target_os = "linux"))]
fn cpu_ms() -> f64 {
    static FIRST: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    FIRST.get_or_init(std::time::Instant::now).elapsed().as_secs_f64() * 1e3
}
