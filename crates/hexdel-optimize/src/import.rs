//! From the caller's mesh to arrays, with every promise checked, and back.

use hexdel_geom::{DVec2, TriMesh, VertexId};
use rayon::prelude::*;

use crate::error::OptimizeError;
use crate::mesh::{Mesh, Motion, NONE, Soup, Vertices};
use crate::options::VertexKind;

/// A sliding vertex's direction may differ from its rim sides' by the rounding
/// of coordinates that are small differences of large ones; beyond this sine,
/// that of [`kinds_of`](crate::kinds_of), it is another direction.
const STRAIGHT: f64 = 1e-3;

/// Checks the mesh and takes it apart.
pub(crate) fn import(mesh: TriMesh, kinds: &[VertexKind]) -> Result<Soup, OptimizeError> {
    let n = mesh.vertices.len();
    if kinds.len() != n {
        return Err(OptimizeError::KindCount { vertices: n, kinds: kinds.len() });
    }
    for (i, &at) in mesh.vertices.iter().enumerate() {
        if !at.is_finite() {
            return Err(OptimizeError::NotFinite { vertex: VertexId::new(i), at });
        }
    }
    let tris = corners(&mesh)?;
    let motion: Vec<Motion> = kinds.iter().map(motion).collect();
    let mut soup = Soup {
        motion,
        sector: vec![std::f64::consts::TAU; n],
        origin: (0..n as u32).collect(),
        failed: vec![0; n],
        tris,
        pos: mesh.vertices,
    };
    soup.sector = sectors(&soup)?;
    Ok(soup)
}

/// The caller's mesh again, and the kinds of its vertices.
pub(crate) fn export(soup: Soup, vertices: usize) -> (TriMesh, Vec<VertexKind>, Vec<Option<VertexId>>) {
    let mut map = vec![None; vertices];
    for (i, &o) in soup.origin.iter().enumerate() {
        if o != NONE {
            map[o as usize] = Some(VertexId::new(i));
        }
    }
    let kinds = soup
        .motion
        .iter()
        .map(|m| match m {
            Motion::Fixed | Motion::Frozen => VertexKind::Fixed,
            Motion::Along(d) => VertexKind::Sliding(*d),
            Motion::Free => VertexKind::Free,
        })
        .collect();
    let triangles = soup.tris.iter().map(|t| t.map(|v| VertexId::new(v as usize))).collect();
    (TriMesh { vertices: soup.pos, triangles }, kinds, map)
}

fn motion(kind: &VertexKind) -> Motion {
    match *kind {
        VertexKind::Fixed => Motion::Fixed,
        VertexKind::Sliding(d) => Motion::Along(d),
        VertexKind::Free => Motion::Free,
    }
}

fn corners(mesh: &TriMesh) -> Result<Vec<[u32; 3]>, OptimizeError> {
    let vertices = mesh.vertices.len();
    let check = |(triangle, t): (usize, &[VertexId; 3])| {
        for k in 0..3 {
            if t[k].index() >= vertices {
                return Err(OptimizeError::NoSuchVertex { triangle, corner: t[k].index(), vertices });
            }
            if t[k] == t[(k + 1) % 3] {
                return Err(OptimizeError::RepeatedCorner { triangle, vertex: t[k] });
            }
        }
        Ok(t.map(|v| v.index() as u32))
    };
    mesh.triangles.iter().enumerate().map(check).collect()
}

/// The domain's angle at each vertex; on the way, the topology and the kinds
/// are checked.
fn sectors(soup: &Soup) -> Result<Vec<f64>, OptimizeError> {
    let n = soup.pos.len();
    let vertices = Vertices {
        pos: soup.pos.clone(),
        motion: soup.motion.clone(),
        sector: soup.sector.clone(),
        outside: vec![0; n],
    };
    let mesh = Mesh::build(vertices, &soup.tris).map_err(|s| OptimizeError::SharedSide {
        from: VertexId::new(s.from as usize),
        to: VertexId::new(s.to as usize),
    })?;
    let checked: Vec<Result<f64, OptimizeError>> = (0..n as u32)
        .into_par_iter()
        .map_init(<(Vec<u32>, Vec<u32>)>::default, |(tris, ring), v| {
            let (vertex, at) = (VertexId::new(v as usize), soup.pos[v as usize]);
            if !mesh.alive(v) {
                return Err(OptimizeError::Isolated { vertex, at });
            }
            let closed = mesh.ring(v, tris, ring);
            if tris.len() != mesh.degree(v) {
                return Err(OptimizeError::NotOneFan { vertex, at });
            }
            let side = |w: Option<&u32>| w.map_or(DVec2::ZERO, |&w| soup.pos[w as usize] - at);
            let (first, last) = (side(ring.first()), side(ring.last()));
            match (closed, soup.motion[v as usize]) {
                (true, Motion::Free | Motion::Fixed) => Ok(std::f64::consts::TAU),
                (false, Motion::Fixed) => Ok(opening(first, last)),
                (false, Motion::Along(d)) if slides(d, first, last) => Ok(std::f64::consts::PI),
                _ => Err(OptimizeError::Misplaced { vertex, at }),
            }
        })
        .collect();
    // The first one in order, whichever thread was first.
    checked.into_iter().collect()
}

/// The angle from `u` counter-clockwise to `w`, in (0, 2 pi].
fn opening(u: DVec2, w: DVec2) -> f64 {
    let a = libm::atan2(u.perp_dot(w), u.dot(w));
    if a <= 0.0 { a + std::f64::consts::TAU } else { a }
}

fn slides(along: DVec2, first: DVec2, last: DVec2) -> bool {
    let straight = |side: DVec2| along.perp_dot(side).abs() <= STRAIGHT * side.length();
    (along.length() - 1.0).abs() <= STRAIGHT && straight(first) && straight(last) && first.dot(last) < 0.0
}
