//! A coast and the depths before it, both made up, by formulas: a bay of some 80 by 80 kilometres with two islands, a
//! headland and a shelf, around 5 degrees east and 58 north.
//!
//! Sines come from the crate `libm`, so that the files have the same bytes on every platform.

use hexdel::DVec2;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// The box of longitudes and latitudes, degrees: west, south, east, north.
const BOX: [f64; 4] = [4.3, 57.62, 5.7, 58.38];

/// Kilometres in a degree of latitude, and of longitude at 58 degrees north.
const KM: DVec2 = DVec2::new(59.0, 111.4);

/// Centre, mean radius in kilometres and number of lobes of each island.
const ISLANDS: [(DVec2, f64, f64); 2] =
    [(DVec2::new(4.86, 58.07), 5.5, 3.0), (DVec2::new(5.22, 57.84), 3.5, 5.0)];

fn sine(turns: f64) -> f64 {
    libm::sin(TAU * turns)
}

/// The longitude of the mainland's coast at a latitude.
fn coast(latitude: f64) -> f64 {
    let t = (latitude - BOX[1]) / (BOX[3] - BOX[1]);
    5.36 + 0.16 * sine(0.9 * t + 0.1) + 0.05 * sine(3.7 * t) + 0.018 * sine(11.0 * t + 0.3)
}

/// The distance of an island's coast from its centre in a direction, kilometres.
fn radius(island: usize, turns: f64) -> f64 {
    let (_, mean, lobes) = ISLANDS[island];
    mean * (1.0 + 0.22 * sine(lobes * turns) + 0.08 * sine(2.0 * lobes * turns + 0.2))
}

/// The water's depth in metres, negative on land.
fn depth(at: DVec2) -> f64 {
    let offshore = (coast(at.y) - at.x) * KM.x;
    let island = |i: usize| {
        let away = (at - ISLANDS[i].0) * KM;
        away.length() - radius(i, libm::atan2(away.y, away.x) / TAU)
    };
    let away = offshore.min(island(0)).min(island(1));
    // A beach, a shelf of about 60 metres, and the slope beyond it.
    let shelf = if away > 0.0 { 60.0 * away / (away + 4.0) } else { 12.0 * away };
    shelf + 240.0 / (1.0 + libm::exp(-(offshore - 45.0) / 5.0))
}

/// The water as a polygon in `GeoJSON`: the open sea in the west, the coast in the east, two islands. A coast has so many
/// points, an island half as many.
pub(crate) fn coast_geojson(points: usize) -> String {
    let [west, south, _, north] = BOX;
    let latitude = |i: usize| south + (north - south) * i as f64 / (points - 1) as f64;
    let mut outer = vec![DVec2::new(west, north), DVec2::new(west, south)];
    outer.extend((0..points).map(|i| DVec2::new(coast(latitude(i)), latitude(i))));
    let island = |island: usize| {
        let count = points / 2;
        let corner = |i: usize| {
            // Clockwise, as holes are.
            let turns = -(i as f64) / count as f64;
            let direction = DVec2::new(libm::cos(TAU * turns), sine(turns));
            ISLANDS[island].0 + radius(island, turns) * direction / KM
        };
        (0..count).map(corner).collect::<Vec<_>>()
    };
    let rings = [outer, island(0), island(1)];
    let ring = |ring: &Vec<DVec2>| {
        let corners: Vec<String> =
            ring.iter().chain(ring.first()).map(|p| format!("[{:.5}, {:.5}]", p.x, p.y)).collect();
        format!("[{}]", corners.join(", "))
    };
    let rings: Vec<String> = rings.iter().map(ring).collect();
    format!("{{\"type\": \"Polygon\", \"coordinates\": [{}]}}\n", rings.join(",\n"))
}

/// The depths as a raster of ESRI's, with cells of so many degrees. The corner in the south-east, far inland, has none.
pub(crate) fn depths_asc(cell: f64) -> String {
    let [west, south, east, north] = BOX;
    let [columns, rows] = [(east - west) / cell, (north - south) / cell].map(|count| count.round() as usize);
    let mut text = format!(
        "ncols {columns}\nnrows {rows}\nxllcorner {west}\nyllcorner {south}\ncellsize {cell}\nNODATA_value -9999\n"
    );
    for row in (0..rows).rev() {
        for column in 0..columns {
            let at = DVec2::new(west, south) + cell * (DVec2::new(column as f64, row as f64) + 0.5);
            let end = if column + 1 == columns { '\n' } else { ' ' };
            let _ = match depth(at) {
                inland if inland < -150.0 => write!(text, "-9999{end}"),
                depth => write!(text, "{depth:.1}{end}"),
            };
        }
    }
    text
}
