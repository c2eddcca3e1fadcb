//! What the vertices of a mesh may do, read off its outline.

use hexdel_geom::{TriMesh, VertexId};

use crate::options::VertexKind;

/// Sine of the turn up to which the outline goes straight on: far above the
/// rounding of a straight side's vertices, far below any corner of a domain.
const STRAIGHT: f64 = 1e-3;

/// One kind for each vertex: fixed where `fixed` says so and at the corners of
/// the outline, sliding where the outline goes straight on, else free.
///
/// A sliding vertex's direction is that from one end of its side to the other,
/// so that vertices stay on the side however far they slide. Triangles that
/// make no disk give kinds that [`optimize`](crate::optimize) refuses, or
/// refuses itself.
///
/// # Complexity
///
/// `n log n` in the number of triangles.
///
/// ```
/// use hexdel_geom::{DVec2, TriMesh, VertexId};
/// use hexdel_optimize::{VertexKind, kinds_of};
///
/// let vertices = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 2.0)].map(DVec2::from).to_vec();
/// let triangles = [[0, 1, 3], [1, 2, 3]].map(|t| t.map(VertexId::new)).to_vec();
/// let kinds = kinds_of(&TriMesh { vertices, triangles }, |_| false);
/// assert_eq!(kinds[1], VertexKind::Sliding(DVec2::X));
/// assert_eq!(kinds[3], VertexKind::Fixed);
/// ```
pub fn kinds_of(mesh: &TriMesh, fixed: impl Fn(VertexId) -> bool) -> Vec<VertexKind> {
    let n = mesh.vertices.len();
    let mut kinds: Vec<VertexKind> =
        (0..n).map(|v| if fixed(VertexId::new(v)) { VertexKind::Fixed } else { VertexKind::Free }).collect();
    let next = rim(mesh);
    let at = |v: usize| mesh.vertices[v];
    let turns = |a: usize, b: usize, c: usize| {
        let (u, w) = (at(b) - at(a), at(c) - at(b));
        u.dot(w) <= 0.0 || u.perp_dot(w).abs() > STRAIGHT * u.length() * w.length()
    };
    let mut corner = vec![false; n];
    for (a, b) in next.iter().enumerate() {
        if let Some(b) = *b
            && let Some(c) = next[b]
        {
            corner[b] = turns(a, b, c);
        }
    }
    for start in (0..n).filter(|&v| corner[v]) {
        kinds[start] = VertexKind::Fixed;
        let mut side = Vec::new();
        let mut v = next[start];
        // No side has more vertices than the mesh, not even of an outline that
        // touches itself.
        while let Some(w) = v.filter(|&w| !corner[w] && side.len() < n) {
            side.push(w);
            v = next[w];
        }
        let Some(end) = v else { continue };
        let along = (at(end) - at(start)).normalize_or_zero();
        for w in side {
            if kinds[w] == VertexKind::Free {
                kinds[w] = VertexKind::Sliding(along);
            }
        }
    }
    kinds
}

/// The next vertex of the outline after each vertex on it.
fn rim(mesh: &TriMesh) -> Vec<Option<usize>> {
    let side = |t: &[VertexId; 3], k: usize| (t[k].index(), t[(k + 1) % 3].index());
    let mut sides: Vec<(usize, usize, bool)> = mesh
        .triangles
        .iter()
        .flat_map(|t| {
            (0..3).map(|k| {
                let (a, b) = side(t, k);
                (a.min(b), a.max(b), a < b)
            })
        })
        .collect();
    sides.sort_unstable();
    let mut next = vec![None; mesh.vertices.len()];
    for pair in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if let [(low, high, up)] = *pair {
            let (from, to) = if up { (low, high) } else { (high, low) };
            next[from] = Some(to);
        }
    }
    next
}
