//! The fixtures that are drawn from seeds or computed: written as they are, bit for bit.
//!
//! What was written by hand, what once failed, and real data stay as files; `fixtures/README.md`
//! says of every file which it is, and [`check_listed`] that it does.

mod drawn;
mod listed;
mod shapes;

use super::Files;
use hexdel::DVec2;
use hexdel::geom::Pslg;
use hexdel::io::{PointFormat, write_points_to};

pub(super) use listed::check as check_listed;

/// Every fixture that is made, by its path below the fixtures' folder.
pub(super) fn all() -> Result<Files, Box<dyn std::error::Error>> {
    let mut files = Files::new();
    for (name, points) in drawn::sets().into_iter().chain(shapes::sets()) {
        let bytes = written(PointFormat::Node, &Pslg::from_points(points))?;
        files.insert(format!("points/{name}.node"), bytes);
    }
    let graphs = [
        ("graphs/letters.poly", shapes::letters()),
        ("graphs/airfoil.poly", shapes::airfoil()),
        ("polygons/annulus_linspace.poly", shapes::annulus_linspace()),
        ("polygons/nested_circles.poly", shapes::nested_circles()),
        ("polygons/notch_2deg.poly", shapes::notch(2.0)),
        ("polygons/notch_7deg.poly", shapes::notch(7.1)),
    ];
    for (path, graph) in graphs {
        files.insert(path.to_owned(), written(PointFormat::Poly, &graph)?);
    }
    let tables = [
        ("tables/near_dup_1e9.csv", shapes::near_dup_1e9()),
        ("tables/polar.csv", shapes::polar()),
        ("tables/track5_cm.csv", drawn::track5_cm()),
    ];
    files.extend(tables.map(|(path, points)| (path.to_owned(), table(&points).into_bytes())));
    let texts = [
        ("polygons/rotated_touch.geojson", shapes::rotated_touch()),
        ("triangle/circle_twice.poly", shapes::circle_twice()),
    ];
    files.extend(texts.map(|(path, text)| (path.to_owned(), text.into_bytes())));
    Ok(files)
}

fn written(format: PointFormat, graph: &Pslg) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mut bytes = Vec::new();
    write_points_to(&mut bytes, format, graph, "a fixture")?;
    Ok(bytes)
}

fn table(points: &[DVec2]) -> String {
    let rows = points.iter().map(|p| format!("{:?},{:?}\n", p.x, p.y));
    std::iter::once("x,y\n".to_owned()).chain(rows).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fixtures_are_what_is_made() {
        for (path, bytes) in all().unwrap() {
            let found = std::fs::read(crate::tidy::root().join("fixtures").join(&path)).unwrap();
            assert!(found == bytes, "{path} differs");
        }
    }
}
