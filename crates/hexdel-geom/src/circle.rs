//! The smallest circle around a set of points.
//!
//! The move-to-front form of Welzl's algorithm ("Smallest enclosing disks",
//! 1991), unrolled into loops: expected linear time over the order of the
//! points, which a fixed shuffle makes independent of the caller's.

use glam::DVec2;

use crate::scale::{max_abs, scale_to};

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    /// The centre.
    pub center: DVec2,
    /// The radius, in the units of the centre.
    pub radius: f64,
}

/// The smallest circle that encloses `points`; `None` if there are none or
/// one of them is not finite.
///
/// # Guarantees
///
/// Every point is inside or on the circle, in exact arithmetic. The radius is
/// larger than the smallest one possible by a relative 1e-12 or so at most,
/// measured against the larger of the radius and `1e-16` times the largest
/// coordinate. A circle that leaves the range of `f64` has an infinite radius.
///
/// # Complexity
///
/// Expected `O(n)`.
pub fn smallest_enclosing_circle(points: &[DVec2]) -> Option<Circle> {
    let first = *points.first()?;
    if !points.iter().all(|p| p.is_finite()) {
        return None;
    }
    // Below 2^0 the difference of two coordinates cannot overflow; relative to
    // one of the points and scaled again it has full precision.
    let outer = scale_to(max_abs(points), -2);
    let mut local: Vec<DVec2> = points.iter().map(|&p| p * outer - first * outer).collect();
    let inner = scale_to(max_abs(&local), 0);
    for p in &mut local {
        *p *= inner;
    }
    shuffle(&mut local);
    let circle = enclose(&mut local);
    let center = circle.center / inner / outer + first;
    Some(Circle { center, radius: covering_radius(center, points, outer) })
}

/// The radius that reaches all points from a centre, rounded up.
fn covering_radius(center: DVec2, points: &[DVec2], outer: f64) -> f64 {
    let from = center * outer;
    let offsets: Vec<DVec2> = points.iter().map(|&p| p * outer - from).collect();
    // Squares of the offsets must not underflow.
    let inner = scale_to(max_abs(&offsets), 0);
    let reach_sq = offsets.iter().map(|&d| (d * inner).length_squared()).fold(0.0, f64::max);
    // Difference, squares, sum and root are off by less than 3 u, u = 2^-53.
    reach_sq.sqrt() * (1.0 + 2.0 * f64::EPSILON) / inner / outer
}

/// Fisher-Yates with a fixed seed.
fn shuffle(points: &mut [DVec2]) {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    for i in (1..points.len()).rev() {
        state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        // The high half of a 64-bit congruential generator is its good half.
        let j = (u128::from(state >> 32) * (i as u128 + 1)) >> 32;
        points.swap(i, j as usize);
    }
}

/// Tolerance of the containment test, relative to the square of the radius.
/// Centre and radius of a circle through points of magnitude 1 carry rounding
/// errors of some 1e-16 times the condition of the triple; a tolerance well
/// above keeps a point of the triple itself from being found outside, and one
/// of 1e-13 is far below what the caller is promised.
const SLACK: f64 = 1e-13;

#[derive(Clone, Copy)]
struct Disk {
    center: DVec2,
    radius_sq: f64,
}

impl Disk {
    fn contains(&self, p: DVec2) -> bool {
        self.center.distance_squared(p) <= self.radius_sq * (1.0 + SLACK)
    }

    fn through_two(a: DVec2, b: DVec2) -> Self {
        let center = a.midpoint(b);
        Self { center, radius_sq: center.distance_squared(a).max(center.distance_squared(b)) }
    }

    /// The circle through three points; `None` if they are collinear.
    fn through_three(a: DVec2, b: DVec2, c: DVec2) -> Option<Self> {
        let (u, w) = (b - a, c - a);
        let d = 2.0 * u.perp_dot(w);
        let (uu, ww) = (u.length_squared(), w.length_squared());
        let offset = DVec2::new(w.y * uu - u.y * ww, u.x * ww - w.x * uu) / d;
        let center = a + offset;
        let radius_sq = [a, b, c].map(|p| center.distance_squared(p)).into_iter().fold(0.0, f64::max);
        (d != 0.0 && radius_sq.is_finite()).then_some(Self { center, radius_sq })
    }
}

fn enclose(points: &mut [DVec2]) -> Disk {
    let mut disk = Disk { center: points[0], radius_sq: 0.0 };
    for i in 1..points.len() {
        if !disk.contains(points[i]) {
            disk = enclose_with(&points[..i], points[i]);
            // A point that mattered once is likely to matter again.
            points[..=i].rotate_right(1);
        }
    }
    disk
}

/// The smallest circle around `points` with `a` on it.
fn enclose_with(points: &[DVec2], a: DVec2) -> Disk {
    let mut disk = Disk { center: a, radius_sq: 0.0 };
    for (i, &b) in points.iter().enumerate() {
        if !disk.contains(b) {
            disk = enclose_with_two(&points[..i], a, b);
        }
    }
    disk
}

/// The smallest circle around `points` with `a` and `b` on it.
///
/// The centres lie on the bisector of `a` and `b`; the points to the left of
/// `a b` push the centre one way, those to the right the other. Keeping the
/// furthest push of each side instead of the latest circle keeps a nearly
/// collinear triple from throwing the centre far away.
fn enclose_with_two(points: &[DVec2], a: DVec2, b: DVec2) -> Disk {
    let diameter = Disk::through_two(a, b);
    let ab = b - a;
    let mut pushes: [Option<(f64, Disk)>; 2] = [None, None];
    for &p in points.iter().filter(|&&p| !diameter.contains(p)) {
        let Some(disk) = Disk::through_three(a, b, p) else {
            continue;
        };
        let left = ab.perp_dot(p - a) > 0.0;
        let along = ab.perp_dot(disk.center - a);
        let push = if left { along } else { -along };
        let held = &mut pushes[usize::from(left)];
        if held.is_none_or(|(most, _)| push > most) {
            *held = Some((push, disk));
        }
    }
    match pushes.map(|p| p.map(|(_, disk)| disk)) {
        [None, None] => diameter,
        [Some(disk), None] | [None, Some(disk)] => disk,
        [Some(p), Some(q)] => {
            if p.radius_sq < q.radius_sq {
                p
            } else {
                q
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The smallest of all circles through two or three points that enclose.
    fn brute_force(points: &[DVec2]) -> f64 {
        let mut best = f64::INFINITY;
        let mut offer = |disk: Disk| {
            let reach = points.iter().map(|&p| disk.center.distance(p)).fold(0.0, f64::max);
            best = best.min(reach);
        };
        for (i, &a) in points.iter().enumerate() {
            for (j, &b) in points[..i].iter().enumerate() {
                offer(Disk::through_two(a, b));
                for &c in &points[..j] {
                    if let Some(d) = Disk::through_three(a, b, c) {
                        offer(d);
                    }
                }
            }
        }
        best
    }

    fn encloses(points: &[DVec2]) -> Circle {
        let circle = smallest_enclosing_circle(points).unwrap();
        for p in points {
            assert!((*p - circle.center).length() <= circle.radius);
        }
        circle
    }

    #[test]
    fn small_and_odd_inputs() {
        assert_eq!(smallest_enclosing_circle(&[]), None);
        assert_eq!(smallest_enclosing_circle(&[DVec2::ONE, DVec2::splat(f64::INFINITY)]), None);
        let one = smallest_enclosing_circle(&[DVec2::new(3.0, 4.0); 5]).unwrap();
        assert_eq!(one, Circle { center: DVec2::new(3.0, 4.0), radius: 0.0 });
    }

    #[test]
    fn collinear_points() {
        let points: Vec<DVec2> =
            (0..=1000).map(|i| DVec2::new(0.1, 0.3) + DVec2::new(1.0, 0.7) * f64::from(i)).collect();
        let circle = encloses(&points);
        assert!((circle.radius / DVec2::new(500.0, 350.0).length() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn extreme_magnitudes() {
        for scale in [1e-300, 1e-200, 1e200, 1e300] {
            let points = [DVec2::X, -DVec2::X, DVec2::Y, -DVec2::Y].map(|p| p * scale);
            let circle = smallest_enclosing_circle(&points).unwrap();
            assert!(circle.center.x.abs() <= 1e-12 * scale && circle.center.y.abs() <= 1e-12 * scale);
            assert!((circle.radius / scale - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn far_from_the_origin() {
        let at = DVec2::new(5.5e6, -4.2e6);
        let circle = encloses(&[at, at + DVec2::X * 1e-3, at + DVec2::Y * 1e-3]);
        assert!((circle.radius - 0.5e-3 * 2.0_f64.sqrt()).abs() < 2e-9);
    }

    proptest! {
        #[test]
        fn agrees_with_brute_force(raw in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64), 2..25)) {
            let points: Vec<DVec2> = raw.iter().map(|&(x, y)| DVec2::new(x, y)).collect();
            prop_assert!(encloses(&points).radius <= brute_force(&points) * (1.0 + 1e-12));
        }

        #[test]
        fn agrees_on_flat_and_repeated(raw in prop::collection::vec((-4i8..4, -4i8..4), 2..20), flat in 0_i32..18) {
            let points: Vec<DVec2> = raw
                .iter()
                .map(|&(x, y)| DVec2::new(f64::from(x), f64::from(y) * 10f64.powi(-flat)) * 0.1)
                .collect();
            let best = brute_force(&points);
            prop_assert!(encloses(&points).radius <= best * (1.0 + 1e-12));
        }
    }
}
