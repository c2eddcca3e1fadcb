//! Writes the coast and the depths of docs/ocean.md: `cargo run -p hexdel-cli --example ocean -- FOLDER [POINTS DEGREES]`,
//! with so many points of the coast (400) and cells of so many degrees (0.005).

mod data;

use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".to_owned());
    let folder = Path::new(&folder);
    let number = |i: usize| std::env::args().nth(i).and_then(|text| text.parse::<f64>().ok());
    let (points, cell) = (number(2).unwrap_or(400.0), number(3).unwrap_or(0.005));
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("coast.geojson"), data::coast_geojson(points as usize))?;
    std::fs::write(folder.join("depths.asc"), data::depths_asc(cell))
}
