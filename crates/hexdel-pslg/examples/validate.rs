//! Says what is wrong with a PSLG, repairs it and meshes it:
//! `cargo run --release -p hexdel-pslg --example validate [FILE.poly] [TOLERANCE]`. Without a file,
//! a fence that crosses a field, drawn by hand.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "what an example writes is its result")]

use hexdel_geom::{DVec2, Pslg, Unwatched};
use hexdel_pslg::{Options, mesh, repair, validate, violations};
use std::error::Error;
use std::process::ExitCode;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let graph = args.next().map_or_else(|| Ok(drawn()), hexdel_io::read_points)?;
    let tolerance = args.next().map_or(Ok(1e-6), |text| text.parse())?;

    let found = violations(&graph);
    println!("{} points, {} segments, faults: {}", graph.points.len(), graph.segments.len(), found.len());
    for fault in &found {
        println!("  {fault}");
    }

    let (mended, report) = repair(&graph, tolerance)?;
    for done in &report.repairs {
        println!("  repaired: {done:?}");
    }
    assert!(report.complete, "nothing is left to repair");

    let made = mesh(&validate(&mended)?, &Options::new(), &Unwatched)?;
    println!(
        "{} triangles, {:.1} to {:.1} degrees, {} exempt, {} failed",
        made.certificate.triangles,
        made.certificate.min_angle_deg,
        made.certificate.max_angle_deg,
        made.exempt.len(),
        made.failed.len()
    );
    Ok(())
}

/// A field, its first corner given twice, and a fence across it that crosses a ditch.
fn drawn() -> Pslg {
    let points = [
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 3.0),
        (0.0, 3.0),
        (1e-8, 0.0),
        (0.0, 1.0),
        (4.0, 2.0),
        (1.0, 2.5),
        (3.0, 0.5),
    ];
    let mut graph = Pslg::from_points(points.map(|(x, y)| DVec2::new(x, y)).to_vec());
    graph.segments = vec![[0, 1], [1, 2], [2, 3], [3, 4], [5, 6], [7, 8]];
    graph
}
