//! The fixtures that are computed: written as they are, bit for bit.
//!
//! What was drawn at random by a generator that is not kept, what was written by hand, and real
//! data stay as files; `fixtures/README.md` says which are which.

use super::Files;
use hexdel::DVec2;
use hexdel::geom::Pslg;
use hexdel::io::{PointFormat, write_points_to};

/// Every computed fixture by its path below the fixtures' folder.
pub(super) fn all() -> Result<Files, Box<dyn std::error::Error>> {
    let sets = [
        ("two_close", two_close()),
        ("cocircular", cocircular()),
        ("exact_lattice", exact_lattice()),
        ("square_grid", (0..36).map(|i| DVec2::new(f64::from(i % 6), f64::from(i / 6))).collect()),
    ];
    let mut files = Files::new();
    for (name, points) in sets {
        let mut bytes = Vec::new();
        write_points_to(&mut bytes, PointFormat::Node, &Pslg::from_points(points), name)?;
        files.insert(format!("points/{name}.node"), bytes);
    }
    Ok(files)
}

/// Two points, 0.02 apart (paper, section 8).
fn two_close() -> Vec<DVec2> {
    vec![DVec2::new(-0.01, 0.0), DVec2::new(0.01, 0.0)]
}

/// The integer points at distance 65 from the origin.
fn cocircular() -> Vec<DVec2> {
    let all = (-65..=65).flat_map(|x: i32| (-65..=65).map(move |y: i32| (x, y)));
    all.filter(|(x, y)| x * x + y * y == 65 * 65).map(|(x, y)| DVec2::new(x.into(), y.into())).collect()
}

/// 19 points of a triangular lattice, row by row.
fn exact_lattice() -> Vec<DVec2> {
    let height = 0.5 * 3_f64.sqrt();
    let row = |r: i32| (-2 - r.min(0)..=2 - r.max(0)).map(move |q| (q, r));
    let place = |(q, r): (i32, i32)| DVec2::new(f64::from(q) + 0.5 * f64::from(r), f64::from(r) * height);
    (-2..=2).flat_map(row).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixtures_are_what_is_computed() {
        for (path, bytes) in all().unwrap() {
            let found = std::fs::read(crate::tidy::root().join("fixtures").join(&path)).unwrap();
            assert!(found == bytes, "{path}\n{}", String::from_utf8_lossy(&bytes));
        }
    }
}
