//! Checks of single triangles: form, orientation, angles, edge lengths.
//!
//! An angle between vectors with dot product `d` and (positive) cross product
//! `c` has cotangent `d / c`, which decreases with the angle. A triangle's
//! three cotangents share the cross product, so its extreme angles and their
//! comparison with the bounds cost one division; an arc tangent is evaluated
//! only for triangles near or past a bound and for the extremes of the mesh.

use crate::par::prelude::*;
use glam::DVec2;

use super::{
    ANGLE_TOLERANCE_DEG, CHUNK, CertifyOptions, LENGTH_TOLERANCE, ROUNDING_FACTOR, View, Violation,
    counts_below_exact, note,
};
use crate::bounds::AngleBounds;
use crate::incidence::well_formed;
use crate::mesh::{TriangleId, VertexId};
use crate::predicates::orient2d;
use crate::quality::{angles_deg, aspect_of, aspect_ratio};
use crate::scale::ulp;

/// The templates' exact lower bound alone.
const EXACT: AngleBounds = AngleBounds::at_least(AngleBounds::EXACT_MIN_DEG);

/// How much of an aspect ratio its arithmetic may add: some thirty roundings, each of
/// 1.1e-16, of a quotient whose parts are certain to a few of them.
const ASPECT_ARITHMETIC: f64 = 1e-13;

/// What the triangles of a mesh, or of a part of it, have to say.
#[derive(Clone, Debug, Default)]
pub(super) struct Shapes {
    pub(super) min_angle_deg: f64,
    pub(super) max_angle_deg: f64,
    pub(super) max_aspect_ratio: f64,
    pub(super) stretched_triangles: usize,
    pub(super) shortest_edge: f64,
    pub(super) out_of_bounds: usize,
    pub(super) rounding_limited: usize,
    pub(super) worst_rounding_excess_deg: f64,
    pub(super) below_exact_bound: usize,
    pub(super) not_counter_clockwise: usize,
    pub(super) malformed: usize,
    pub(super) not_finite: usize,
    pub(super) short_triangles: usize,
    pub(super) violations: Vec<Violation>,
}

pub(super) fn check(view: &View<'_>, request: &CertifyOptions<'_>) -> Shapes {
    let limits = Limits::new(view, request);
    let parts: Vec<Part> = view
        .mesh
        .triangles
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(chunk, triangles)| Part::of(view, &limits, chunk * CHUNK, triangles))
        .collect();
    let total = parts.into_iter().fold(Part::default(), |sum, part| sum.merge(part, &limits));
    total.finish(view)
}

/// The request in terms that are cheap to compare with.
struct Limits {
    bounds: AngleBounds,
    /// Cotangents above this belong to angles below the lower bound.
    max_cot: f64,
    /// Cotangents below this belong to angles above the upper bound.
    min_cot: f64,
    /// Cotangents above this belong to angles below the templates' exact bound; infinite if
    /// those are not counted.
    exact_cot: f64,
    /// Aspect ratios above this are looked at.
    max_aspect: f64,
    /// Scaled.
    min_edge: f64,
    /// Squares of scaled lengths below this belong to edges that are too short
    /// unless rounding excuses them.
    min_edge_sq: f64,
    max_violations: usize,
}

impl Limits {
    fn new(view: &View<'_>, request: &CertifyOptions<'_>) -> Self {
        let cot = |deg: f64| {
            let (sin, cos) = libm::sincos(deg.to_radians());
            cos / sin
        };
        let low = request.bounds.min_deg() - ANGLE_TOLERANCE_DEG;
        let high = request.bounds.max_deg() + ANGLE_TOLERANCE_DEG;
        // No edge keeps a bound that is not a number.
        let bound = request.min_edge.map_or(0.0, |e| if e.is_nan() { f64::INFINITY } else { e });
        let min_edge = bound * view.scale;
        Self {
            bounds: request.bounds,
            max_cot: if low > 0.0 { cot(low) } else { f64::INFINITY },
            min_cot: if high < 180.0 { cot(high) } else { f64::NEG_INFINITY },
            exact_cot: if counts_below_exact(request.bounds) {
                cot(AngleBounds::EXACT_MIN_DEG - ANGLE_TOLERANCE_DEG)
            } else {
                f64::INFINITY
            },
            max_aspect: request.bounds.max_aspect_ratio(),
            min_edge,
            min_edge_sq: (min_edge * (1.0 - LENGTH_TOLERANCE)).powi(2),
            max_violations: request.max_violations,
        }
    }
}

/// Counts and extremes of consecutive triangles. Merging is associative:
/// sums of integers, minima, maxima and concatenation.
struct Part {
    shapes: Shapes,
    /// Smallest and largest cotangent of the angles that were not evaluated
    /// as angles.
    cots: [f64; 2],
    shortest_sq: f64,
}

impl Default for Part {
    fn default() -> Self {
        let shapes =
            Shapes { min_angle_deg: f64::INFINITY, max_angle_deg: f64::NEG_INFINITY, ..Shapes::default() };
        Self { shapes, cots: [f64::INFINITY, f64::NEG_INFINITY], shortest_sq: f64::INFINITY }
    }
}

impl Part {
    fn of(view: &View<'_>, limits: &Limits, first: usize, triangles: &[[VertexId; 3]]) -> Self {
        let mut part = Self::default();
        let n = view.mesh.vertices.len();
        for (i, &corners) in triangles.iter().enumerate() {
            let triangle = TriangleId::new(first + i);
            if well_formed(corners, n) {
                let at = |i: usize| view.at(corners[i].index());
                part.shape(view, limits, triangle, [at(0), at(1), at(2)]);
            } else {
                part.shapes.malformed += 1;
                note(&mut part.shapes.violations, limits.max_violations, || {
                    malformation(triangle, corners, n)
                });
            }
        }
        part
    }

    #[inline]
    fn shape(&mut self, view: &View<'_>, limits: &Limits, triangle: TriangleId, [a, b, c]: [DVec2; 3]) {
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let lengths_sq = [ab, bc, ca].map(DVec2::length_squared);
        let (left, right) = (ab.y * ca.x, ab.x * ca.y);
        let cross = left - right;
        // The differences and products are off by 4 u of their magnitude in
        // all: above 8 u the sign is certain. This is false for NaN, too.
        if !(cross > 4.0 * f64::EPSILON * (left.abs() + right.abs()) && cross.is_finite()) {
            return self.doubtful(view, limits, triangle, [a, b, c]);
        }
        let shortest_sq = lengths_sq[0].min(lengths_sq[1]).min(lengths_sq[2]);
        self.shortest_sq = self.shortest_sq.min(shortest_sq);
        let aspect = aspect_of(lengths_sq.map(f64::sqrt), cross);
        self.shapes.max_aspect_ratio = self.shapes.max_aspect_ratio.max(aspect);
        let dots = [-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)];
        let inv = 1.0 / cross;
        let low = dots[0].min(dots[1]).min(dots[2]) * inv;
        let high = dots[0].max(dots[1]).max(dots[2]) * inv;
        self.cots = [self.cots[0].min(low), self.cots[1].max(high)];
        if high > limits.max_cot || low < limits.min_cot {
            self.past_bounds(view, limits, triangle, [a, b, c]);
        }
        if high > limits.exact_cot {
            self.below_exact([a, b, c]);
        }
        if aspect > limits.max_aspect {
            self.stretched(view, limits, triangle, [a, b, c]);
        }
        if shortest_sq < limits.min_edge_sq {
            self.too_short(view, limits, triangle, [a, b, c]);
        }
    }

    /// A triangle whose orientation is not plain.
    #[cold]
    fn doubtful(&mut self, view: &View<'_>, limits: &Limits, triangle: TriangleId, corners: [DVec2; 3]) {
        if let Some(i) = corners.iter().position(|p| !p.is_finite()) {
            self.shapes.not_finite += 1;
            let vertex = view.mesh.triangles[triangle.index()][i];
            let violation = || Violation::CornerNotFinite { triangle, vertex };
            return note(&mut self.shapes.violations, limits.max_violations, violation);
        }
        let [a, b, c] = corners;
        for angle in angles_deg(corners) {
            self.shapes.min_angle_deg = self.shapes.min_angle_deg.min(angle);
            self.shapes.max_angle_deg = self.shapes.max_angle_deg.max(angle);
        }
        for side in [b - a, c - b, a - c] {
            self.shortest_sq = self.shortest_sq.min(side.length_squared());
        }
        if orient2d(a, b, c) > 0.0 {
            self.shapes.max_aspect_ratio = self.shapes.max_aspect_ratio.max(aspect_ratio(corners));
            self.past_bounds(view, limits, triangle, corners);
            if limits.exact_cot.is_finite() {
                self.below_exact(corners);
            }
            self.stretched(view, limits, triangle, corners);
        } else {
            self.shapes.not_counter_clockwise += 1;
            note(&mut self.shapes.violations, limits.max_violations, || Violation::NotCounterClockwise {
                triangle,
                corners: original(view, corners),
            });
        }
        self.too_short(view, limits, triangle, corners);
    }

    #[cold]
    fn past_bounds(&mut self, view: &View<'_>, limits: &Limits, triangle: TriangleId, corners: [DVec2; 3]) {
        match check_angles(corners, limits.bounds) {
            Fit::Within => {}
            Fit::RoundingLimited { excess_deg } => {
                self.shapes.rounding_limited += 1;
                self.shapes.worst_rounding_excess_deg = self.shapes.worst_rounding_excess_deg.max(excess_deg);
            }
            Fit::Outside { corner, angle_deg, below } => {
                self.shapes.out_of_bounds += 1;
                note(&mut self.shapes.violations, limits.max_violations, || {
                    let corners = original(view, corners);
                    if below {
                        Violation::AngleBelow { triangle, corner, angle_deg, corners }
                    } else {
                        Violation::AngleAbove { triangle, corner, angle_deg, corners }
                    }
                });
            }
        }
    }

    #[cold]
    fn below_exact(&mut self, corners: [DVec2; 3]) {
        if matches!(check_angles(corners, EXACT), Fit::Outside { .. }) {
            self.shapes.below_exact_bound += 1;
        }
    }

    #[cold]
    fn stretched(&mut self, view: &View<'_>, limits: &Limits, triangle: TriangleId, corners: [DVec2; 3]) {
        if matches!(check_angles(corners, limits.bounds), Fit::Outside { .. }) {
            return;
        }
        let [a, b, c] = corners;
        let slack = [[a, b, c], [b, c, a], [c, a, b]].map(rounding_slack_deg).into_iter().fold(0.0, f64::max);
        let granted = limits.bounds.widened(ANGLE_TOLERANCE_DEG + slack).max_aspect_ratio();
        let aspect_ratio = aspect_ratio(corners);
        if aspect_ratio > granted * (1.0 + ASPECT_ARITHMETIC) {
            self.shapes.stretched_triangles += 1;
            note(&mut self.shapes.violations, limits.max_violations, || Violation::AspectAbove {
                triangle,
                aspect_ratio,
                corners: original(view, corners),
            });
        }
    }

    #[cold]
    fn too_short(&mut self, view: &View<'_>, limits: &Limits, triangle: TriangleId, corners: [DVec2; 3]) {
        let [a, b, c] = corners;
        let floor = limits.min_edge * (1.0 - LENGTH_TOLERANCE);
        let short = [(a, b), (b, c), (c, a)].into_iter().find_map(|(p, q)| {
            let length = p.distance(q);
            let slack = ROUNDING_FACTOR * (displacement(p) + displacement(q));
            (length + slack < floor).then_some(length)
        });
        if let Some(length) = short {
            self.shapes.short_triangles += 1;
            note(&mut self.shapes.violations, limits.max_violations, || Violation::EdgeTooShort {
                triangle,
                length: length / view.scale,
                corners: original(view, corners),
            });
        }
    }

    fn merge(mut self, part: Self, limits: &Limits) -> Self {
        let (sum, new) = (&mut self.shapes, part.shapes);
        sum.min_angle_deg = sum.min_angle_deg.min(new.min_angle_deg);
        sum.max_angle_deg = sum.max_angle_deg.max(new.max_angle_deg);
        sum.max_aspect_ratio = sum.max_aspect_ratio.max(new.max_aspect_ratio);
        sum.out_of_bounds += new.out_of_bounds;
        sum.rounding_limited += new.rounding_limited;
        sum.worst_rounding_excess_deg = sum.worst_rounding_excess_deg.max(new.worst_rounding_excess_deg);
        sum.below_exact_bound += new.below_exact_bound;
        sum.stretched_triangles += new.stretched_triangles;
        sum.not_counter_clockwise += new.not_counter_clockwise;
        sum.malformed += new.malformed;
        sum.not_finite += new.not_finite;
        sum.short_triangles += new.short_triangles;
        let room = limits.max_violations - sum.violations.len();
        sum.violations.extend(new.violations.into_iter().take(room));
        self.cots = [self.cots[0].min(part.cots[0]), self.cots[1].max(part.cots[1])];
        self.shortest_sq = self.shortest_sq.min(part.shortest_sq);
        self
    }

    /// The extremes as angles and lengths.
    fn finish(self, view: &View<'_>) -> Shapes {
        let mut shapes = self.shapes;
        if self.cots[0] <= self.cots[1] {
            let [largest, smallest] = self.cots.map(|cot| libm::atan2(1.0, cot).to_degrees());
            shapes.min_angle_deg = shapes.min_angle_deg.min(smallest);
            shapes.max_angle_deg = shapes.max_angle_deg.max(largest);
        }
        shapes.shortest_edge = self.shortest_sq.sqrt() / view.scale;
        if self.shortest_sq.is_infinite() {
            (shapes.min_angle_deg, shapes.max_angle_deg, shapes.shortest_edge) = (0.0, 0.0, 0.0);
        }
        shapes
    }
}

fn malformation(triangle: TriangleId, corners: [VertexId; 3], vertex_count: usize) -> Violation {
    let [a, b, c] = corners;
    match corners.iter().position(|v| v.index() >= vertex_count) {
        Some(corner) => Violation::CornerOutOfRange { triangle, corner, vertex: corners[corner] },
        // If a and b differ, c is the same as one of them.
        None => Violation::RepeatedCorner { triangle, vertex: if a == b { a } else { c } },
    }
}

fn original(view: &View<'_>, corners: [DVec2; 3]) -> [DVec2; 3] {
    corners.map(|p| p / view.scale)
}

/// How a triangle's angles stand to the bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fit {
    /// All within, up to the tolerance.
    Within,
    /// Some past by more than the tolerance, but no more than rounding
    /// explains.
    RoundingLimited {
        /// The most that an angle is past its bound, degrees.
        excess_deg: f64,
    },
    /// One past by more than that.
    Outside {
        /// The corner with the largest excess.
        corner: usize,
        /// Its angle.
        angle_deg: f64,
        /// Past the lower bound, not the upper.
        below: bool,
    },
}

/// Holds the angles of a counter-clockwise triangle against the bounds.
pub(crate) fn check_angles(corners: [DVec2; 3], bounds: AngleBounds) -> Fit {
    check_angles_at(corners, bounds, [true; 3])
}

/// The same where the lower bound counts at some corners only.
pub(crate) fn check_angles_at(corners: [DVec2; 3], bounds: AngleBounds, lower: [bool; 3]) -> Fit {
    let angles = angles_deg(corners);
    let mut limited: f64 = 0.0;
    let mut outside: Option<(f64, usize)> = None;
    for (i, angle) in angles.into_iter().enumerate() {
        let low = if lower[i] { bounds.min_deg() } else { 0.0 };
        let excess = (low - angle).max(angle - bounds.max_deg());
        if excess <= ANGLE_TOLERANCE_DEG {
            continue;
        }
        let turned = [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]];
        if excess <= ANGLE_TOLERANCE_DEG + rounding_slack_deg(turned) {
            limited = limited.max(excess);
        } else if outside.is_none_or(|(most, _)| excess > most) {
            outside = Some((excess, i));
        }
    }
    if let Some((_, corner)) = outside {
        let angle_deg = angles[corner];
        return Fit::Outside { corner, angle_deg, below: angle_deg < bounds.min_deg() };
    }
    if limited > 0.0 { Fit::RoundingLimited { excess_deg: limited } } else { Fit::Within }
}

/// How far the rounding of the corners may have moved the angle at `a`; the
/// derivation is in the docs of the certificate.
pub(super) fn rounding_slack_deg([a, b, c]: [DVec2; 3]) -> f64 {
    let (ab, ac, bc) = (a.distance(b), a.distance(c), b.distance(c));
    let turn = displacement(b) / ab + displacement(c) / ac + displacement(a) * bc / (ab * ac);
    (ROUNDING_FACTOR * turn).to_degrees()
}

/// How far a point may be from the one it is the correct rounding of.
fn displacement(p: DVec2) -> f64 {
    0.5 * DVec2::new(ulp(p.x), ulp(p.y)).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The derivation term by term: twice half an ulp of each end over its side, and of the corner
    /// over both.
    #[test]
    fn rounding_turns_an_angle_by_the_displacements_over_the_sides() {
        let near = |found: f64, turn: f64| {
            let expected = (2.0 * turn).to_degrees();
            assert!((found - expected).abs() < 1e-3 * expected, "{found:e} {expected:e}");
        };
        // The corner is exact, as are the zeros of its ends.
        let (b, c) = (DVec2::new(1e6, 0.0), DVec2::new(0.0, 3e6));
        near(rounding_slack_deg([DVec2::ZERO, b, c]), 0.5 * (ulp(1e6) / 1e6 + ulp(3e6) / 3e6));
        // Sides of 2, 4 and sqrt(20) far away.
        let a = DVec2::new(1e6, 0.0);
        let displacement = 0.5 * ulp(1e6);
        let corners = [a, a + DVec2::new(2.0, 0.0), a + DVec2::new(0.0, 4.0)];
        near(rounding_slack_deg(corners), displacement * (1.0 / 2.0 + 1.0 / 4.0 + 20.0_f64.sqrt() / 8.0));
    }

    /// Angles of 94.8 degrees, 4.8 too many, and of 36.9 and 48.4 degrees, 13.1 and 1.6 too few.
    #[test]
    fn the_angle_that_is_farthest_past_its_bound_is_named() {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::new(0.4, 0.45)];
        let bounds = AngleBounds::new(50.0, 90.0).unwrap();
        for turn in 0..3 {
            let mut turned = corners;
            turned.rotate_left(turn);
            let Fit::Outside { corner, angle_deg, below } = check_angles(turned, bounds) else {
                panic!("{turn}")
            };
            assert!(turned[corner] == DVec2::X && (angle_deg - 36.9).abs() < 0.1 && below, "{turn}");
            // Where the lower bound does not count it is the one that is too large.
            let fit = check_angles_at(turned, bounds, [false; 3]);
            let Fit::Outside { corner, below, .. } = fit else { panic!("{turn}") };
            assert!(turned[corner] == corners[2] && !below, "{turn}");
        }
    }

    #[test]
    fn of_angles_equally_far_past_their_bounds_the_first_is_named() {
        let named = |corners| check_angles(corners, AngleBounds::new(46.0, 90.0).unwrap());
        let first = |corner| Fit::Outside { corner, angle_deg: 45.0, below: true };
        assert_eq!(named([DVec2::ZERO, DVec2::X, DVec2::Y]), first(1));
        assert_eq!(named([DVec2::X, DVec2::Y, DVec2::ZERO]), first(0));
    }
}
