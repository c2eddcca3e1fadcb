//! Meshes every PSLG in a folder at three pairs of bounds and says what came of each.
//!
//! ```sh
//! cargo run --release -p hexdel --example instances -- FOLDER [fast|standard|best|fewest] [SECONDS]
//! ```
//!
//! Made for the instances of CG:SHOP 2025, whose coordinates are integers with many points
//! in line; any format of PSLGs will do. With SECONDS, each mesh has that budget. Where the folder has a table
//! `steiner.tsv`, of the name of each instance, its points, and the Steiner points of the best triangulation known
//! without obtuse angles, the score of that competition comes last: for each instance without a failed triangle 0.5, and
//! 0.5 times the fewest points over ours.

use hexdel::{AngleBounds, Effort, Mesher};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};

const BOUNDS: [[f64; 2]; 3] = [[0.0, 90.0], [30.0, 90.0], [43.89, 90.0]];

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("which folder?")?;
    let effort = match arguments.next().as_deref() {
        Some("fast") => Effort::Fast,
        None | Some("standard") => Effort::Standard,
        Some("best") => Effort::Best,
        Some("fewest") => Effort::Fewest,
        Some(other) => return Err(format!("no effort is called {other}").into()),
    };
    let budget = arguments.next().map(|s| s.parse()).transpose()?.map(Duration::from_secs_f64);
    let mut files: Vec<_> =
        std::fs::read_dir(&folder)?.map(|e| e.map(|e| e.path())).collect::<Result<_, _>>()?;
    files.sort();
    let fewest = fewest_known(Path::new(&folder))?;
    for [min, max] in BOUNDS {
        let bounds = AngleBounds::new(min, max)?;
        let mut mesher = Mesher::new().bounds(bounds).near_bounds(bounds).effort(effort);
        if let Some(budget) = budget {
            mesher = mesher.budget(budget);
        }
        let (mut held, mut all, mut score) = (0, 0, 0.0);
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
                    let c = &made.certificate;
                    let steiner = made.mesh.vertices.len().saturating_sub(graph.points.len());
                    held += usize::from(made.holds());
                    if let Some(known) = fewest.get(name.split('.').next().unwrap_or_default())
                        && made.holds()
                    {
                        score += 0.5 + 0.5 * (known / steiner.max(1) as f64).min(1.0);
                    }
                    format!(
                        "{} triangles, {steiner} Steiner points, {:.4} to {:.4} degrees, {} exempt, {} failed{}",
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
        if !fewest.is_empty() {
            println!("[{min}, {max}]: score {score:.2} of {}", fewest.len());
        }
    }
    Ok(())
}

/// By instance, the Steiner points of the best triangulation known; empty without a table.
fn fewest_known(folder: &Path) -> Result<BTreeMap<String, f64>, Box<dyn Error>> {
    let Ok(table) = std::fs::read_to_string(folder.join("steiner.tsv")) else {
        return Ok(BTreeMap::new());
    };
    let rows = table.lines().filter(|row| !row.starts_with('#'));
    rows.map(|row| {
        let mut cells = row.split('\t');
        let name = cells.next().unwrap_or_default().to_owned();
        let count = cells.nth(1).ok_or_else(|| format!("no count of Steiner points: {row}"))?;
        Ok((name, count.parse()?))
    })
    .collect()
}
