//! Where segments move the centres of hexagons (paper, section 7.3).
//!
//! Of the three axes of a hexagon, through the middles of opposite sides, the
//! one at the largest angle to the segment is taken; it is the same for all
//! hexagons along the segment. If the segment cuts it inside of the hexagon,
//! the hexagon's centre goes there.
//!
//! ```text
//!    .    .    .          Columns of hexagons along the axis; the line cuts
//!  .   .----*----         every column once, in one hexagon. At an angle of
//!  --*-  .    .           at least 60 degrees it climbs by half a hexagon at
//!    .    .    .          most from one column to the next: the two hexagons
//!                         are neighbours, and * to * is an edge.
//! ```
//!
//! Hexagons with an input point in them keep it.

use super::assign::{HALF_WIDTH, unit};
use super::rules::{Passed, Scene};
use crate::net::Net;
use hexdel_geom::DVec2;
use hexdel_grid::{Direction, Lattice};

/// Two places on a piece this many spacings apart are one: those of neighbours
/// in a column on the side between them, up to rounding.
const SAME: f64 = 1e-6;

/// A place on a piece where the centre of a hexagon may go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Record {
    /// Index into the hexagons that pieces pass.
    pub(super) hexagon: u32,
    pub(super) piece: u32,
    /// Fraction of the piece's length.
    pub(super) t: f64,
    pub(super) at: DVec2,
}

/// The axis at the largest angle to a vector; the first of equals.
fn axis(along: DVec2) -> DVec2 {
    let units = [0, 1, 2].map(|d| unit(Direction::new(d)));
    let cosine = |u: &DVec2| u.dot(along).abs();
    units.into_iter().min_by(|u, v| cosine(u).total_cmp(&cosine(v))).unwrap_or(DVec2::X)
}

/// All records, piece by piece, from its start to its end. `vertices` are those
/// of the hexagons, where the rings of input points have been shifted.
///
/// A place is left out if the hexagon's centre, shifted, is farther away from
/// it than the corners of the hexagon are from its centre (section 7.4).
pub(super) fn records(
    net: &Net,
    lattice: &Lattice,
    scene: &Scene<'_>,
    passed: &[Passed],
    vertices: &[Option<u32>],
) -> Vec<Record> {
    let mut all = Vec::new();
    for (i, p) in passed.iter().enumerate() {
        let Some(vertex) = vertices[i] else { continue };
        let (centre, spacing) = (lattice.position(p.at), lattice.spacing(p.at.level));
        let radius = spacing / 3.0_f64.sqrt();
        let found = p.pieces.iter().filter_map(|&piece| {
            let t = cut(scene.ends(piece), centre, spacing)?;
            Some(Record { hexagon: i as u32, piece, t, at: net.along(piece, t) })
        });
        all.extend(found.filter(|r| net.at(vertex).distance(r.at) <= radius));
    }
    all.sort_by(|r, s| r.piece.cmp(&s.piece).then(r.t.total_cmp(&s.t)));
    // The same place on the side between two hexagons is one of them's.
    let spacing = |r: &Record| lattice.spacing(passed[r.hexagon as usize].at.level);
    all.dedup_by(|r, s| r.piece == s.piece && r.at.distance(s.at) <= SAME * spacing(r));
    all
}

/// Where a piece cuts its axis inside of a hexagon, as a fraction of its
/// length.
fn cut(ends: [DVec2; 2], centre: DVec2, spacing: f64) -> Option<f64> {
    let [a, b] = ends.map(|p| (p - centre) / spacing);
    let along = b - a;
    let u = axis(along);
    let t = -u.perp_dot(a) / u.perp_dot(along);
    let height = u.dot(a + along * t);
    (t > 0.0 && t < 1.0 && height.abs() <= HALF_WIDTH).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::assign::passed;
    use hexdel_grid::Address;

    #[test]
    fn a_line_moves_a_row_of_neighbours() {
        let lattice = Lattice::new(DVec2::ZERO, 1.0);
        for i in 0..720 {
            let direction = DVec2::from_angle(f64::from(i) * 0.0087);
            let middle = DVec2::new(0.37, 0.21 + f64::from(i) * 1e-3);
            let ends = [middle - direction * 9.0, middle + direction * 9.0];
            let cuts = |hex| cut(ends, lattice.position(Address::new(0, hex)), 1.0);
            let mut row: Vec<_> =
                passed(&lattice, 0, ends).into_iter().filter_map(|hex| Some((cuts(hex)?, hex))).collect();
            row.sort_by(|x, y| x.0.total_cmp(&y.0));
            for pair in row.windows(2) {
                assert_eq!(pair[0].1.distance(pair[1].1), 1, "{i}: {row:?}");
            }
            // Columns are sqrt(3) / 2 apart, and cut at 60 degrees or more.
            assert!(row.len() >= 18 && row.len() <= 22, "{i}: {}", row.len());
        }
    }

    #[test]
    fn the_axis_is_at_sixty_degrees_at_least() {
        for i in 0..360 {
            let along = DVec2::from_angle(f64::from(i).to_radians()) * 3.0;
            assert!(axis(along).dot(along).abs() <= 1.5 + 1e-9);
        }
    }
}
