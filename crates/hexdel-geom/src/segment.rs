//! Points of a segment, rounded once.

use glam::DVec2;

use crate::double_double::Double;

/// The double nearest to the point at the fraction `t` of the way from `a` to
/// `b`, in each coordinate.
///
/// Exact at both ends. In between the error before the final rounding is a
/// few units of `2^-106` of the segment's extent, so that the point lies off
/// the line by half a unit in the last place of its coordinates and no more.
///
/// ```
/// use hexdel_geom::{DVec2, point_on_segment};
/// let (a, b) = (DVec2::new(0.25, 0.0), DVec2::new(0.75, 1.0));
/// assert_eq!(point_on_segment(a, b, 1.0), b);
/// assert_eq!(point_on_segment(a, b, 0.5), DVec2::new(0.5, 0.5));
/// ```
pub fn point_on_segment(a: DVec2, b: DVec2, t: f64) -> DVec2 {
    // From the nearer end, so that the rounding of `t` matters less.
    let (from, to, t) = if t <= 0.5 { (a, b, t) } else { (b, a, 1.0 - t) };
    let at = |p: f64, q: f64| {
        let offset = Double::difference(q, p) * Double::from(t);
        (offset + Double::from(p)).hi
    };
    DVec2::new(at(from.x, to.x), at(from.y, to.y))
}
