//! Which hexagons a segment passes (paper, section 7.1).
//!
//! A hexagon is assigned to a piece if its closed cell meets it. Cells are
//! intersections of three strips, as wide as the lattice's spacing:
//!
//! ```text
//!       /\            a piece meets the cell if what it has in common with
//!    --/--\----       each of the three strips has something in common
//!     |    |
//!      \  /
//!       \/
//! ```

use hexdel_classify::Offset;
use hexdel_geom::DVec2;
use hexdel_grid::{Address, Direction, Hex, Lattice};
use rustc_hash::FxHashSet;

/// Half of a cell's width in spacings, and a little more: a piece along the
/// edge between two cells belongs to both, whatever rounding says.
pub(super) const HALF_WIDTH: f64 = 0.5 + 1e-9;

/// The unit vector of a lattice direction.
pub(super) fn unit(d: Direction) -> DVec2 {
    Offset::of(d.step()).cartesian()
}

/// The hexagons of a level that a piece meets, in no particular order.
///
/// # Complexity
///
/// Linear in their number.
pub(super) fn passed(lattice: &Lattice, level: u8, ends: [DVec2; 2]) -> Vec<Hex> {
    let start = lattice.locate(level, ends[0]).hex;
    let mut seen = FxHashSet::from_iter([start]);
    let mut found = vec![start];
    let mut next = 0;
    // What a piece meets is connected.
    while let Some(&hex) = found.get(next) {
        next += 1;
        for beside in hex.neighbours() {
            if !seen.contains(&beside) && meets(lattice, Address::new(level, beside), ends) {
                seen.insert(beside);
                found.push(beside);
            }
        }
    }
    found
}

/// Whether a piece meets the cell of a hexagon.
fn meets(lattice: &Lattice, at: Address, ends: [DVec2; 2]) -> bool {
    let (centre, spacing) = (lattice.position(at), lattice.spacing(at.level));
    let [a, b] = ends.map(|p| (p - centre) / spacing);
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for u in Direction::ALL.map(unit) {
        // By how much the ends are outside of the side in this direction.
        let (from, to) = (u.dot(a) - HALF_WIDTH, u.dot(b) - HALF_WIDTH);
        if from > 0.0 && to > 0.0 {
            return false;
        }
        if from > 0.0 {
            first = first.max(from / (from - to));
        } else if to > 0.0 {
            last = last.min(from / (from - to));
        }
    }
    first <= last
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> Lattice {
        Lattice::new(DVec2::new(0.1, -0.2), 1.0)
    }

    #[test]
    fn every_point_of_a_piece_lies_in_a_passed_hexagon() {
        for i in 0..40 {
            let direction = DVec2::from_angle(f64::from(i) * 0.157);
            let ends = [DVec2::new(0.3, 0.2) - direction, DVec2::new(0.3, 0.2) + direction * 2.0];
            for level in 0..5 {
                let found = passed(&lattice(), level, ends);
                for k in 0..=1000 {
                    let p = ends[0].lerp(ends[1], f64::from(k) / 1000.0);
                    assert!(found.contains(&lattice().locate(level, p).hex), "{i} {level} {k}");
                }
                // Two rows at most, each a hexagon per spacing.
                let most = 2.0 * 3.0 / lattice().spacing(level) + 4.0;
                assert!((found.len() as f64) < most, "{} of {most}", found.len());
            }
        }
    }

    #[test]
    fn a_piece_along_an_edge_meets_both_sides() {
        let lattice = Lattice::new(DVec2::ZERO, 1.0);
        let found = passed(&lattice, 0, [DVec2::new(0.5, -0.2), DVec2::new(0.5, 0.2)]);
        assert_eq!(found.len(), 2);
        let across = passed(&lattice, 0, [DVec2::ZERO, DVec2::new(3.0, 0.0)]);
        assert_eq!(across.len(), 4);
    }
}
