//! Polygons of the crate geo-types, meshed: triangles and area of each.
//!
//! `cargo run -p hexdel --features geo-types --example geo_types`

use geo_types::{LineString, MultiPolygon, Polygon};
use hexdel::Pslg;

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A lake with an island, and a meadow beside it.
    let ring = |x: f64, y: f64, side: f64| {
        LineString::from(vec![(x, y), (x + side, y), (x + side, y + side), (x, y + side)])
    };
    let lake = Polygon::new(ring(0.0, 0.0, 6.0), vec![ring(2.0, 2.0, 1.0)]);
    let meadow = Polygon::new(ring(6.0, 0.0, 6.0), vec![]);
    let pslg = Pslg::try_from(&MultiPolygon::new(vec![lake, meadow]))?;

    let made = hexdel::triangulate_pslg(&pslg)?;
    let polygon_of_triangle = made.region_attributes();
    for (number, name) in [(1.0, "lake"), (2.0, "meadow")] {
        let of_it = made.mesh.triangles.iter().zip(&polygon_of_triangle).filter(|(_, n)| **n == number);
        let corners = of_it.map(|(t, _)| t.map(|v| made.mesh.vertices[v.index()]));
        let areas: Vec<f64> = corners.map(|[a, b, c]| 0.5 * (b - a).perp_dot(c - a)).collect();
        println!("{name}: {} triangles, area {:.6}", areas.len(), areas.iter().sum::<f64>());
    }
    Ok(())
}
