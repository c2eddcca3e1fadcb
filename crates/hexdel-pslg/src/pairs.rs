//! Which points and segments are near each other: a quadtree of their lists.
//!
//! A square that holds much is divided in four, and each quarter gets what of
//! the square's lists reaches it. What shares a small square in the end is
//! looked at pair by pair. Squares are divided level by level, only as long as
//! their lists together stay in proportion to the input: segments on top of
//! each other share every square they pass, however small.

use crate::geometry::distance_sq;
use crate::validate::bounding_box;
use hexdel_geom::{DVec2, orient2d};

/// Pairs that are worth looking at one by one.
const FEW: usize = 32;

/// Divisions at most: many segments at one point stay together forever.
const DEPTH: u32 = 20;

/// Entries in all lists of a level, for each point and segment there is.
const CROWD: usize = 16;

/// A square and what reaches it.
struct Square {
    centre: DVec2,
    /// Half of its side.
    half: f64,
    segments: Vec<u32>,
    points: Vec<u32>,
}

/// What touches what.
#[derive(Debug, Default)]
pub(crate) struct Contacts {
    /// Segments and points on them that are not their ends.
    pub(crate) touching: Vec<(u32, u32)>,
    /// Segments that cross between their ends, the smaller number first.
    pub(crate) crossing: Vec<(u32, u32)>,
}

/// Which points are on a segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    /// Those within this distance, input units.
    pub(crate) distance: f64,
    /// Those seen from both of its ends at less than this angle, radians.
    pub(crate) angle: f64,
}

/// Finds all contacts. Of points within the distance of an end none is on a segment
/// because of that.
pub(crate) fn contacts(points: &[DVec2], segments: &[[u32; 2]], touch: Touch) -> Contacts {
    let (min, max) = bounding_box(points);
    let half = 0.5 * (max - min).max_element();
    let mut finder = Finder { points, segments, touch, found: Contacts::default() };
    let [of_segments, of_points] = [segments.len(), points.len()].map(|n| (0..n as u32).collect());
    // Room for points on the sides.
    let half = half * 1.001 + touch.distance;
    let mut squares =
        vec![Square { centre: min.midpoint(max), half, segments: of_segments, points: of_points }];
    for _ in 0..DEPTH {
        let entries: usize = squares.iter().map(|s| s.segments.len() + s.points.len()).sum();
        if entries > CROWD * (segments.len() + points.len()) {
            break;
        }
        squares = squares.iter().flat_map(|square| finder.divide(square)).collect();
    }
    for square in squares {
        finder.look(&square.segments, &square.points);
    }
    let mut found = finder.found;
    for list in [&mut found.touching, &mut found.crossing] {
        list.sort_unstable();
        list.dedup();
    }
    found
}

struct Finder<'a> {
    points: &'a [DVec2],
    segments: &'a [[u32; 2]],
    touch: Touch,
    found: Contacts,
}

impl Finder<'_> {
    fn ends(&self, s: u32) -> [DVec2; 2] {
        self.segments[s as usize].map(|p| self.points[p as usize])
    }

    /// The quarters of a square that holds much; of any other, nothing is left
    /// to be done.
    fn divide(&mut self, square: &Square) -> Vec<Square> {
        let Square { centre, half, segments, points } = square;
        if segments.len() * (segments.len() + points.len()) <= FEW {
            self.look(segments, points);
            return Vec::new();
        }
        let quarter = |(x, y)| {
            let centre = *centre + DVec2::new(x, y) * (0.5 * half);
            // A thousandth and the tolerance cover rounding and what lies just
            // outside.
            let reach = 0.5 * half * 1.001 + self.touch.distance;
            let meets = |&s: &u32| {
                let [a, b] = self.ends(s);
                meets([a, b], centre, reach + 0.5 * self.touch.angle * a.distance(b))
            };
            let inside = |p: &u32| (self.points[*p as usize] - centre).abs().max_element() <= reach;
            Square {
                centre,
                half: 0.5 * half,
                segments: segments.iter().copied().filter(meets).collect(),
                points: points.iter().copied().filter(inside).collect(),
            }
        };
        let quarters = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)].map(quarter);
        quarters.into_iter().filter(|q| !q.segments.is_empty()).collect()
    }

    fn look(&mut self, segments: &[u32], points: &[u32]) {
        for (i, &s) in segments.iter().enumerate() {
            for &p in points {
                if self.is_on(p, s) {
                    self.found.touching.push((s, p));
                }
            }
            for &r in &segments[..i] {
                if self.cross(r, s) {
                    self.found.crossing.push((r.min(s), r.max(s)));
                }
            }
        }
    }

    fn is_on(&self, p: u32, s: u32) -> bool {
        if self.segments[s as usize].contains(&p) {
            return false;
        }
        let [a, b] = self.ends(s);
        let p = self.points[p as usize];
        let between = (p - a).dot(b - a) > 0.0 && (p - b).dot(a - b) > 0.0;
        if !between {
            return false;
        }
        // The angle is the larger at the nearer end.
        let reach = self.touch.angle * p.distance(a).min(p.distance(b));
        distance_sq(p, a, b) <= self.touch.distance.max(reach).powi(2) || orient2d(a, b, p) == 0.0
    }

    fn cross(&self, r: u32, s: u32) -> bool {
        let [a, b] = self.ends(r);
        let [c, d] = self.ends(s);
        let apart = |x: f64, y: f64| (x > 0.0 && y < 0.0) || (x < 0.0 && y > 0.0);
        apart(orient2d(a, b, c), orient2d(a, b, d)) && apart(orient2d(c, d, a), orient2d(c, d, b))
    }
}

/// Whether a segment meets a square, by separating axes.
fn meets([a, b]: [DVec2; 2], centre: DVec2, half: f64) -> bool {
    let (a, b) = (a - centre, b - centre);
    if a.min(b).max_element() > half || (-a.max(b)).max_element() > half {
        return false;
    }
    let u = b - a;
    u.perp_dot(a).abs() <= half * (u.x.abs() + u.y.abs()) * (1.0 + 1e-12)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_tree_finds_what_all_pairs_find(
            raw in prop::collection::vec((0..12_i8, 0..12_i8), 3..30),
            ends in prop::collection::vec((0..30_u32, 0..30_u32), 1..40),
            tolerance in prop::sample::select(vec![0.0, 0.3]),
            angle in prop::sample::select(vec![0.0, 0.2]),
        ) {
            let points: Vec<DVec2> = raw.iter().map(|&(x, y)| DVec2::new(x.into(), y.into())).collect();
            let n = points.len() as u32;
            let segments: Vec<[u32; 2]> = ends.iter().map(|&(a, b)| [a % n, b % n]).collect();
            let touch = Touch { distance: tolerance, angle };
            let found = contacts(&points, &segments, touch);
            let mut all = Finder { points: &points, segments: &segments, touch, found: Contacts::default() };
            let every = [segments.len() as u32, n].map(|n| (0..n).collect::<Vec<_>>());
            all.look(&every[0], &every[1]);
            for list in [&mut all.found.touching, &mut all.found.crossing] {
                list.sort_unstable();
            }
            prop_assert_eq!(found.touching, all.found.touching);
            prop_assert_eq!(found.crossing, all.found.crossing);
        }
    }
}
