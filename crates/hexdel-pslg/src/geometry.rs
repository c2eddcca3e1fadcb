//! A few distances.

use hexdel_geom::DVec2;

/// The squared distance of a point from the closed segment from `a` to `b`.
pub(crate) fn distance_sq(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let (u, w) = (b - a, p - a);
    let along = (w.dot(u) / u.length_squared()).clamp(0.0, 1.0);
    let nearest = if along.is_nan() { a } else { a + u * along };
    p.distance_squared(nearest)
}

/// How far along a segment a point on it lies, as a fraction of its length.
pub(crate) fn fraction([a, b]: [DVec2; 2], p: DVec2) -> f64 {
    let u = b - a;
    ((p - a).dot(u) / u.length_squared()).clamp(0.0, 1.0)
}
