//! Moves vertices by units in the last place where rounding spoilt an angle.
//!
//! A template puts a vertex where two right angles meet; stored in `f64` it
//! lies beside that place, and one of the two angles is past the bound by as
//! much as the coordinates are coarse. Often a place a few units in the last
//! place away keeps all angles around the vertex: the angles on its other side
//! have room. This looks for it.

use crate::par::prelude::*;
use glam::DVec2;

use crate::bounds::AngleBounds;
use crate::certificate::ANGLE_TOLERANCE_DEG;
use crate::incidence::{Incidence, well_formed};
use crate::mesh::{TriMesh, TriangleId, VertexId};
use crate::quality::angles_deg;
use crate::scale::ulp;

/// Triangles looked at in all: where more are past their bounds, coordinates
/// are too coarse for a few units to help.
const MAX_TRIANGLES: usize = 1 << 14;

/// Times the triangles that are past their bounds are gone through.
const SWEEPS: usize = 4;

/// How far a vertex is moved at most, in units in the last place of the largest
/// coordinate around it, along each axis. Four rounded corners are off by two
/// such units in all.
const REACH: i32 = 8;

/// Moves free vertices by a few units in the last place so that angles come to
/// lie within `bounds`, up to [`ANGLE_TOLERANCE_DEG`]. Returns how many
/// triangles are still past them, out of those looked at.
///
/// A vertex is moved only if `free` says so, and only to where the worst angle
/// around it is better than before. Meant for triangles that rounding took past
/// their bounds; whatever is wrong by more stays wrong.
///
/// # Complexity
///
/// A parallel scan of all triangles; then time in proportion to the triangles
/// past their bounds, of which at most 16,384 are looked at.
pub fn settle_rounding(mesh: &mut TriMesh, bounds: AngleBounds, free: impl Fn(VertexId) -> bool) -> usize {
    let n = mesh.vertices.len();
    if mesh.triangles.iter().any(|&t| !well_formed(t, n)) {
        return 0;
    }
    let limits = Limits::new(bounds);
    let mut past: Vec<TriangleId> = (0..mesh.triangles.len())
        .into_par_iter()
        .map(TriangleId::new)
        .filter(|&t| limits.excess(mesh.corners(t)) > 0.0)
        .collect();
    past.truncate(MAX_TRIANGLES);
    if past.is_empty() {
        return 0;
    }
    let incidence = Incidence::new(mesh);
    for _ in 0..SWEEPS {
        let mut touched = past.clone();
        for &t in &past {
            for v in mesh.triangles[t.index()] {
                if limits.excess(mesh.corners(t)) > 0.0 && free(v) {
                    touched.extend(improve(mesh, &incidence, v, &limits));
                }
            }
        }
        // What is better for the worst angle may be worse for another.
        touched.retain(|&t| limits.excess(mesh.corners(t)) > 0.0);
        touched.sort_unstable();
        touched.dedup();
        past = touched;
    }
    past.len()
}

/// Moves a vertex to the nearest place at which no angle around it is past the
/// bounds, or else to the best. Returns the triangles around it.
fn improve(mesh: &mut TriMesh, incidence: &Incidence, v: VertexId, limits: &Limits) -> Vec<TriangleId> {
    let star: Vec<TriangleId> =
        incidence.around(v.index()).iter().map(|&t| TriangleId::new(t as usize)).collect();
    let worst = |mesh: &TriMesh| star.iter().map(|&t| limits.excess(mesh.corners(t))).fold(0.0, f64::max);
    let from = mesh.vertices[v.index()];
    let largest = star
        .iter()
        .flat_map(|&t| mesh.corners(t))
        .fold(0.0, |largest: f64, corner| largest.max(corner.abs().max_element()));
    let mut best = (worst(mesh), from);
    for offset in offsets() {
        mesh.vertices[v.index()] = from + offset * ulp(largest);
        let found = worst(mesh);
        if found < best.0 {
            best = (found, mesh.vertices[v.index()]);
        }
        if found == 0.0 {
            break;
        }
    }
    mesh.vertices[v.index()] = best.1;
    star
}

/// Bounds with their tolerance, in terms that are cheap to compare with.
struct Limits {
    low_deg: f64,
    high_deg: f64,
    /// Cotangents below this belong to angles above `low_deg` by some room.
    most: f64,
    /// Cotangents above this belong to angles below `high_deg` by some room.
    least: f64,
}

impl Limits {
    /// Far more than the arithmetic on cotangents is off by, in degrees.
    const ROOM_DEG: f64 = 1e-9;

    fn new(bounds: AngleBounds) -> Self {
        let (low_deg, high_deg) =
            (bounds.min_deg() - ANGLE_TOLERANCE_DEG, bounds.max_deg() + ANGLE_TOLERANCE_DEG);
        let cot = |deg: f64| {
            let (sin, cos) = libm::sincos(deg.clamp(Self::ROOM_DEG, 180.0 - Self::ROOM_DEG).to_radians());
            cos / sin
        };
        let (most, least) = (cot(low_deg + Self::ROOM_DEG), cot(high_deg - Self::ROOM_DEG));
        Self { low_deg, high_deg, most, least }
    }

    /// By how many degrees the worst angle of a triangle is past the limits;
    /// zero if none is.
    #[inline]
    fn excess(&self, corners: [DVec2; 3]) -> f64 {
        if self.surely_hold(corners) {
            return 0.0;
        }
        let past = |a: f64| (self.low_deg - a).max(a - self.high_deg);
        angles_deg(corners).into_iter().fold(0.0, |worst: f64, a| worst.max(past(a)))
    }

    /// Whether all angles are within the limits, without an arc tangent.
    #[inline]
    fn surely_hold(&self, [a, b, c]: [DVec2; 3]) -> bool {
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let cross = -ab.perp_dot(ca);
        let dots = [-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)];
        cross > 0.0 && dots.into_iter().all(|dot| dot < self.most * cross && dot > self.least * cross)
    }
}

/// Moves to try, shortest first.
fn offsets() -> impl Iterator<Item = DVec2> {
    (1..=REACH).flat_map(|r| {
        let square = (-r..=r).flat_map(move |x| (-r..=r).map(move |y| (x, y)));
        let rim = square.filter(move |(x, y)| x.abs().max(y.abs()) == r);
        rim.map(|(x, y)| DVec2::new(x.into(), y.into()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vertex on the line between two others, with right angles towards a
    /// third: rounding puts one of them past 90 degrees.
    fn rounded(at: DVec2) -> TriMesh {
        let (along, up) = (DVec2::new(0.6, 0.8) * 1e-7, DVec2::new(-0.8, 0.6) * 1e-7);
        let points = [at - along, at, at + along, at + up, at - up - along * 0.3, at - up + along * 0.3];
        let triangles = [[0, 1, 3], [1, 2, 3], [0, 4, 1], [4, 5, 1], [5, 2, 1]];
        TriMesh { vertices: points.to_vec(), triangles: triangles.map(|t| t.map(VertexId::new)).to_vec() }
    }

    #[test]
    fn right_angles_spoilt_by_rounding_are_mended() {
        let bounds = AngleBounds::new(20.0, 90.0).unwrap();
        let limits = Limits::new(bounds);
        let mut spoilt = 0;
        for i in 0..50 {
            let at = DVec2::new(0.1 + 0.013 * f64::from(i), 0.7 - 0.009 * f64::from(i));
            let mut mesh = rounded(at);
            let worst = |mesh: &TriMesh| {
                let all = (0..5).map(|t| limits.excess(mesh.corners(TriangleId::new(t))));
                all.fold(0.0, f64::max)
            };
            spoilt += usize::from(worst(&mesh) > 0.0);
            let left = settle_rounding(&mut mesh, bounds, |v| v.index() == 1);
            assert_eq!((left, worst(&mesh)), (0, 0.0));
            assert!((mesh.vertices[1] - at).length() < 1e-14);
        }
        assert!(spoilt > 20, "{spoilt}");
    }

    #[test]
    fn fixed_vertices_stay() {
        let bounds = AngleBounds::new(20.0, 90.0).unwrap();
        let mut mesh = rounded(DVec2::new(0.3, 0.4));
        let before = mesh.clone();
        settle_rounding(&mut mesh, bounds, |_| false);
        assert_eq!(mesh, before);
    }
}
