//! Meshes every PSLG in a folder at three pairs of bounds and says what came of each.
//!
//! ```sh
//! cargo run --release -p hexdel --example instances -- FOLDER [SECONDS]
//! ```
//!
//! Made for the instances of CG:SHOP 2025, whose coordinates are integers with many points
//! in line; any format of PSLGs will do. With SECONDS, each mesh has that budget.

use hexdel::{AngleBounds, Mesher};
use std::error::Error;
use std::time::{Duration, Instant};

const BOUNDS: [[f64; 2]; 3] = [[0.0, 90.0], [30.0, 90.0], [43.89, 90.0]];

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("which folder?")?;
    let budget = arguments.next().map(|s| s.parse()).transpose()?.map(Duration::from_secs_f64);
    let mut files: Vec<_> =
        std::fs::read_dir(folder)?.map(|e| e.map(|e| e.path())).collect::<Result<_, _>>()?;
    files.sort();
    for [min, max] in BOUNDS {
        let bounds = AngleBounds::new(min, max)?;
        let mut mesher = Mesher::new().bounds(bounds).near_bounds(bounds);
        if let Some(budget) = budget {
            mesher = mesher.budget(budget);
        }
        let (mut held, mut all) = (0, 0);
        for file in &files {
            // Other files than PSLGs may lie there.
            let Ok(graph) = hexdel::io::read_points(file) else { continue };
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let start = Instant::now();
            let made = mesher.triangulate_pslg(&graph);
            let seconds = start.elapsed().as_secs_f64();
            all += 1;
            let what = match made {
                Err(error) => format!("error: {error}"),
                Ok(made) => {
                    held += usize::from(made.holds());
                    let c = &made.certificate;
                    format!(
                        "{} triangles, {:.4} to {:.4} degrees, {} exempt, {} failed{}",
                        c.triangles,
                        c.min_angle_deg,
                        c.max_angle_deg,
                        made.exempt.len(),
                        made.failed.len(),
                        if made.budget_spent { ", budget spent" } else { "" },
                    )
                }
            };
            println!("[{min}, {max}] {name}: {seconds:.1} s, {what}");
        }
        println!("[{min}, {max}]: {held} of {all} hold");
    }
    Ok(())
}
