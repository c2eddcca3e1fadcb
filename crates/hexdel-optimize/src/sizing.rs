//! How long edges may be, place by place.

use std::fmt::Debug;

use hexdel_geom::DVec2;

/// The largest length of an edge wanted at each point.
///
/// The answer must be positive and depend on the point alone. It should not
/// change faster than by its argument's own distance, or edges will see
/// the change only at their ends and middles.
pub trait Sizing: Debug + Send + Sync {
    /// The length wanted at `p`, infinity where any will do.
    fn at(&self, p: DVec2) -> f64;
}

/// An edge may be longer than wanted by this fraction: what the repair of
/// rounded coordinates may add.
pub const SIZE_TOLERANCE: f64 = 1e-9;

/// Whether an edge is no longer than wanted at its ends and its middle.
pub fn edge_fits(sizing: &dyn Sizing, a: DVec2, b: DVec2) -> bool {
    let length = a.distance(b);
    let wanted = sizing.at(a).min(sizing.at(b)).min(sizing.at(0.5 * (a + b)));
    length <= wanted * (1.0 + SIZE_TOLERANCE)
}

/// Whether the edges of a triangle are no longer than wanted.
pub fn triangle_fits(sizing: &dyn Sizing, [a, b, c]: [DVec2; 3]) -> bool {
    edge_fits(sizing, a, b) && edge_fits(sizing, b, c) && edge_fits(sizing, c, a)
}
