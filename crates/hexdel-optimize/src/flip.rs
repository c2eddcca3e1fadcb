//! Lawson flips inside a patch.
//!
//! Where no angle exceeds a right angle a mesh is Delaunay, so flipping
//! towards it never leads away from the bounds. Inverted triangles are
//! flipped away wherever that leaves two upright ones.

use crate::mesh::Mesh;
use crate::patch::Patch;

/// The sine of the sum of the angles opposite an edge, relative to the
/// product of their sides' lengths, below which the edge is flipped: well
/// above rounding, so that cocircular quadruples do not flip for ever.
const FLIP_BELOW: f64 = -1e-9;

/// Flips edges between triangles of the loaded patch until none wants it;
/// returns the number of flips.
pub(crate) fn flip_patch(mesh: &mut Mesh, patch: &Patch) -> usize {
    let mut flips = 0;
    // Lawson's algorithm ends on upright triangles; on inverted ones it may
    // not, hence the limit.
    for _ in 0..8 {
        let before = flips;
        for &t in patch.triangles() {
            for k in 0..3 {
                flips += usize::from(try_flip(mesh, patch, t, k));
            }
        }
        if flips == before {
            break;
        }
    }
    flips
}

fn try_flip(mesh: &mut Mesh, patch: &Patch, t: u32, k: usize) -> bool {
    let Some((u, d)) = mesh.diamond(t, k) else {
        return false;
    };
    patch.holds(u) && wants_flip(mesh, d) && mesh.flip(t, k)
}

/// Whether the edge `from to` of the diamond should be the other diagonal.
pub(crate) fn wants_flip(mesh: &Mesh, [apex, from, to, far]: [u32; 4]) -> bool {
    let [a, b, c, d] = [apex, from, to, far].map(|v| mesh.pos[v as usize]);
    let (ab, ac, db, dc) = (b - a, c - a, b - d, c - d);
    let (s1, c1) = (ab.perp_dot(ac), ab.dot(ac));
    let (s2, c2) = (dc.perp_dot(db), dc.dot(db));
    if s1 > 0.0 && s2 > 0.0 {
        let scale = c1.abs() * c2.abs() + s1 * s2;
        if s1 * c2 + c1 * s2 >= FLIP_BELOW * scale {
            return false;
        }
    }
    // Both new triangles must be upright: a b d and d c a.
    ab.perp_dot(d - a) > 0.0 && dc.perp_dot(a - d) > 0.0
}
