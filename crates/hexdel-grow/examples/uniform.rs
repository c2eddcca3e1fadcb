//! `uniform COUNT DEGREES [SEED]`: what growth from uniform points in a hexagon takes, and that nothing is left.

#![allow(clippy::print_stdout, reason = "a program that prints")]

use std::time::Duration;

use hexdel_geom::{AngleBounds, CertifyOptions, DVec2, Unwatched, certify};
use hexdel_grow::{Input, Options, grow};

/// CPU time of this process.
#[cfg(target_os = "linux")]
fn cpu() -> Duration {
    let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Duration::new(now.tv_sec as u64, now.tv_nsec as u32)
}

/// Time since the start, where there is no other.
#[cfg(not(target_os = "linux"))]
fn cpu() -> Duration {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed()
}

/// Uniform points in the unit square, from a 64-bit linear congruential generator.
fn uniform(count: usize, seed: u64) -> Vec<DVec2> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / 2_f64.powi(53)
    };
    (0..count).map(|_| DVec2::new(draw(), draw())).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<f64> = std::env::args().skip(1).map(|a| a.parse()).collect::<Result<_, _>>()?;
    let [count, degrees] = [0, 1].map(|i| arguments.get(i).copied());
    let (count, degrees) = (count.unwrap_or(10_000.0) as usize, degrees.unwrap_or(30.0));
    let mut points = uniform(count, arguments.get(2).map_or(1, |&s| s as u64));
    let corner = |i: u32| {
        let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::FRAC_PI_3);
        DVec2::splat(0.5) + DVec2::new(cos, sin)
    };
    points.extend((0..6).map(corner));
    let rim = |i: u32| [i, (i + 1) % 6].map(|k| count as u32 + k);
    let segments: Vec<[u32; 2]> = (0..6).map(rim).collect();
    let input = Input { points: &points, segments: &segments, ..Input::default() };
    let began = cpu();
    let grown = grow(&input, &Options::new(degrees), &Unwatched)?;
    let took = cpu().saturating_sub(began);
    let bounds = AngleBounds::new(degrees, 90.0)?;
    let options = CertifyOptions { bounds, inputs: Some(&points), ..CertifyOptions::default() };
    let certificate = certify(&grown.mesh, &options);
    println!(
        "{count} points, {degrees} degrees: {:.2} triangles a point, {:.4} ms a point; {} left, holds {}, delaunay {}; {:?}",
        grown.mesh.triangles.len() as f64 / count as f64,
        took.as_secs_f64() * 1e3 / count as f64,
        grown.left.len(),
        certificate.holds(),
        certificate.delaunay,
        grown.stats
    );
    Ok(())
}
