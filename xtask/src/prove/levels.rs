//! How deep the grid can become: a bound, and inputs that try to break it.
//!
//! Let the points be `d_min` apart and let `k` be the first level whose spacing
//! `s_k` satisfies `(3 + 2/sqrt(3)) s_k < d_min`. Two points in hexagons at most
//! three lattice steps apart are closer than that, a hexagon's circumradius
//! being `s_k / sqrt(3)`; so occupied hexagons of level `k` are at least four
//! steps apart, and no rule about pairs of points asks for anything. While
//! nothing is subdivided on level `k`, no other rule does, no point descends to
//! level `k + 1`, so nothing is asked for on finer levels or projected from
//! them: level `k` stays unsubdivided. There are at most `k + 1` levels,
//!
//! ```text
//!   1 + ceil(log2(4.1548 s_0 / d_min)).
//! ```

use hexdel_geom::{DVec2, Unwatched};
use hexdel_grid::Lattice;
use hexdel_refine::{RefineError, Refiner, RuleSet};

/// A little more than `3 + 2/sqrt(3) = 4.154700538`: the margin of 2e-5 covers
/// the rounding of distances and of offsets in hexagons, some 1e-15.
const REACH: f64 = 4.1548;

/// The finest level that points `d_min` apart can make on a lattice.
pub(crate) fn finest_level(spacing: f64, d_min: f64) -> u8 {
    (REACH * spacing / d_min).log2().ceil().max(0.0) as u8
}

/// An input and the levels it makes.
#[derive(Clone, Debug)]
pub(crate) struct Trial {
    /// What the input is.
    pub(crate) name: &'static str,
    /// Number of points.
    pub(crate) points: usize,
    /// Smallest distance in units of the base spacing.
    pub(crate) d_min: f64,
    /// Finest level with a hexagon.
    pub(crate) finest: u8,
    /// The bound on it.
    pub(crate) bound: u8,
}

/// Refines the adversarial inputs.
pub(crate) fn trials() -> Result<Vec<Trial>, RefineError> {
    inputs().into_iter().map(|(name, points)| trial(name, &points)).collect()
}

fn trial(name: &'static str, points: &[DVec2]) -> Result<Trial, RefineError> {
    const SPACING: f64 = 4.0;
    let mut refiner = Refiner::new(Lattice::new(DVec2::ZERO, SPACING), RuleSet::extended());
    refiner.insert(points, &Unwatched)?;
    let subdivided = refiner.grid().subdivided().map(|at| at.level + 1).max().unwrap_or(0);
    let occupied = refiner.occupants().iter().map(|o| o.level).max().unwrap_or(0);
    let d_min = least_distance(points);
    Ok(Trial {
        name,
        points: points.len(),
        d_min: d_min / SPACING,
        finest: subdivided.max(occupied),
        bound: finest_level(SPACING, d_min),
    })
}

fn least_distance(points: &[DVec2]) -> f64 {
    let pairs = points.iter().enumerate().flat_map(|(i, a)| points[..i].iter().map(move |b| a.distance(*b)));
    pairs.fold(f64::INFINITY, f64::min)
}

fn inputs() -> Vec<(&'static str, Vec<DVec2>)> {
    let pair = |at: DVec2, d: f64, turn: f64| vec![at, at + DVec2::from_angle(turn) * d];
    let spiral = (0..60).map(|i| DVec2::from_angle(f64::from(i)) * 0.7_f64.powi(i)).collect();
    let nested = (0..9)
        .flat_map(|i| {
            let (at, size) = (DVec2::new(0.3, 0.2), 0.1_f64.powi(i));
            (0..5).map(move |j| at + DVec2::from_angle(f64::from(i + 7 * j)) * size)
        })
        .collect();
    let line = (0..40).map(|i| DVec2::new(0.6_f64.powi(i), 0.25 * 0.6_f64.powi(i))).collect();
    let clusters = (0..4)
        .flat_map(|i| {
            let at = DVec2::from_angle(1.7 * f64::from(i)) * 0.8;
            (0..6).map(move |j| at + DVec2::from_angle(f64::from(j)) * 1e-4_f64.powi(i / 2 + 1))
        })
        .collect();
    // At the corner of hexagons of every level, and on an edge of level 0.
    let corner = DVec2::new(2.0, 2.0 / 3.0_f64.sqrt());
    vec![
        ("two points", pair(DVec2::new(0.123, -0.456), 0.02, 0.3)),
        ("two points at 1e-9", pair(DVec2::new(0.123, -0.456), 1e-9, 1.1)),
        ("two points at 1e-9 across a corner", pair(corner - DVec2::new(5e-10, 0.0), 1e-9, 0.0)),
        ("two points at 1e-6 across an edge", pair(DVec2::new(2.0 - 5e-7, 0.1), 1e-6, 0.0)),
        ("clusters at 1e-4 and 1e-8", clusters),
        ("nested circles of five, ratio 10", nested),
        ("logarithmic spiral, ratio 0.7", spiral),
        ("points on a line, ratio 0.6", line),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adversarial_inputs_stay_within_the_bound() {
        for t in trials().unwrap() {
            assert!(t.finest <= t.bound, "{t:?}");
            assert!(t.finest + 4 >= t.bound, "the bound says little: {t:?}");
        }
    }

    #[test]
    fn points_far_apart_need_no_second_level() {
        assert_eq!(finest_level(1.0, 5.0), 0);
        assert_eq!(finest_level(1.0, 4.0), 1);
    }
}
