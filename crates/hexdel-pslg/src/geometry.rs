//! A few distances.

use hexdel_geom::DVec2;

/// The point of the closed segment from `a` to `b` nearest to another.
pub(crate) fn nearest_on(p: DVec2, a: DVec2, b: DVec2) -> DVec2 {
    let (u, w) = (b - a, p - a);
    let along = (w.dot(u) / u.length_squared()).clamp(0.0, 1.0);
    if along.is_nan() { a } else { a + u * along }
}

/// The points of two segments that do not cross that are nearest to each other.
pub(crate) fn nearest_places([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> [DVec2; 2] {
    let places = [
        [a, nearest_on(a, c, d)],
        [b, nearest_on(b, c, d)],
        [nearest_on(c, a, b), c],
        [nearest_on(d, a, b), d],
    ];
    let nearer = |x: [DVec2; 2], y: [DVec2; 2]| {
        if y[0].distance_squared(y[1]) < x[0].distance_squared(x[1]) { y } else { x }
    };
    places.into_iter().reduce(nearer).unwrap_or([a, c])
}

/// The squared distance of a point from the closed segment from `a` to `b`.
pub(crate) fn distance_sq(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    p.distance_squared(nearest_on(p, a, b))
}

/// How far along a segment a point on it lies, as a fraction of its length.
pub(crate) fn fraction([a, b]: [DVec2; 2], p: DVec2) -> f64 {
    let u = b - a;
    ((p - a).dot(u) / u.length_squared()).clamp(0.0, 1.0)
}
