//! From the caller's mesh to arrays, with every promise checked, and back.

use hexdel_geom::par::prelude::*;
use hexdel_geom::{DVec2, TriMesh, VertexId};

use crate::constraints::{Constraints, Line, NOWHERE, POINT};
use crate::error::OptimizeError;
use crate::mesh::{Around, Mesh, Motion, NONE, Soup, Vertices, opening};
use crate::options::VertexKind;

/// A sliding vertex's direction may differ from its rim sides' by the rounding
/// of coordinates that are small differences of large ones; beyond this sine,
/// that of [`kinds_of`](crate::kinds_of), it is another direction.
const STRAIGHT: f64 = 1e-3;

/// Sine of the turn at a vertex on a segment: where neighbours are as near as
/// coordinates resolve, their rounding turns the edges, yet never by so much.
const NEARLY_STRAIGHT: f64 = 0.1;

/// Checks the mesh and takes it apart.
pub(crate) fn import(
    mesh: TriMesh,
    kinds: &[VertexKind],
    constraints: Option<&Constraints<'_>>,
) -> Result<Soup, OptimizeError> {
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
        bound: vec![0; tris.len()],
        tris,
        pos: mesh.vertices,
        source: Vec::new(),
        lines: Vec::new().into(),
    };
    if let Some(constraints) = constraints {
        constrain(&mut soup, constraints)?;
    }
    soup.sector = sectors(&soup)?;
    Ok(soup)
}

/// Marks edges, segments and points.
fn constrain(soup: &mut Soup, constraints: &Constraints<'_>) -> Result<(), OptimizeError> {
    soup.lines = lines(constraints)?;
    let source = |m: &Motion| if let Motion::On(line) = *m { line } else { NOWHERE };
    soup.source = soup.motion.iter().map(source).collect();
    let count = soup.lines.len();
    let unknown = |m: &Motion| match *m {
        Motion::On(line) if line as usize >= count => Some(line as usize),
        _ => None,
    };
    if let Some(index) = soup.motion.iter().find_map(unknown) {
        return Err(OptimizeError::NoSuchItem { what: "segment", index, count });
    }
    let count = soup.pos.len();
    for p in &constraints.points {
        let no_such = OptimizeError::NoSuchItem { what: "vertex", index: p.index(), count };
        *soup.source.get_mut(p.index()).ok_or(no_such)? = POINT;
    }
    let mut edges: Vec<[usize; 2]> =
        constraints.edges.iter().map(|[a, b]| [a.index().min(b.index()), a.index().max(b.index())]).collect();
    edges.sort_unstable();
    edges.dedup();
    let mut found = vec![false; edges.len()];
    for (t, v) in soup.tris.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (v[(k + 1) % 3] as usize, v[(k + 2) % 3] as usize);
            if let Ok(i) = edges.binary_search(&[a.min(b), a.max(b)]) {
                found[i] = true;
                soup.bound[t] |= 1 << k;
            }
        }
    }
    match found.iter().position(|f| !f) {
        None => Ok(()),
        Some(i) => Err(OptimizeError::NoSuchEdge { edge: edges[i].map(VertexId::new) }),
    }
}

fn lines(constraints: &Constraints<'_>) -> Result<std::sync::Arc<[Line]>, OptimizeError> {
    let mut lines: Vec<Line> = constraints.segments.iter().map(|&ends| Line::new(ends)).collect();
    let count = lines.len();
    for &[a, b] in &constraints.wedges {
        for (of, with) in [(a, b), (b, a)] {
            let no_such = OptimizeError::NoSuchItem { what: "segment", index: of, count };
            lines.get_mut(of).ok_or(no_such)?.wedges.push(with as u32);
        }
    }
    Ok(lines.into())
}

/// The edges that must stay, each once.
fn bound_edges(soup: &Soup) -> Vec<[VertexId; 2]> {
    let mut edges = Vec::new();
    for (v, bound) in soup.tris.iter().zip(&soup.bound).filter(|(_, bound)| **bound != 0) {
        for k in (0..3).filter(|k| bound >> k & 1 == 1) {
            let (a, b) = (v[(k + 1) % 3], v[(k + 2) % 3]);
            edges.push([a.min(b), a.max(b)].map(|v| VertexId::new(v as usize)));
        }
    }
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// A mesh as it leaves: with its kinds, where its vertices were before, and
/// the edges that stayed.
pub(crate) struct Exported {
    pub(crate) mesh: TriMesh,
    pub(crate) kinds: Vec<VertexKind>,
    pub(crate) vertices: Vec<Option<VertexId>>,
    pub(crate) edges: Vec<[VertexId; 2]>,
}

/// The caller's mesh again, which had so many vertices.
pub(crate) fn export(soup: Soup, vertices: usize) -> Exported {
    let edges = bound_edges(&soup);
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
            Motion::On(line) => VertexKind::OnSegment(*line as usize),
            Motion::Free => VertexKind::Free,
        })
        .collect();
    let triangles = soup.tris.iter().map(|t| t.map(|v| VertexId::new(v as usize))).collect();
    Exported { mesh: TriMesh { vertices: soup.pos, triangles }, kinds, vertices: map, edges }
}

fn motion(kind: &VertexKind) -> Motion {
    match *kind {
        VertexKind::Fixed => Motion::Fixed,
        VertexKind::Sliding(d) => Motion::Along(d),
        VertexKind::OnSegment(line) => Motion::On(line as u32),
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
        // None is known to be inside yet.
        motion: vec![Motion::Fixed; n],
        sector: soup.sector.clone(),
        outside: vec![0; n],
        around: Around { source: soup.source.clone(), near: soup.near(), lines: soup.lines.clone() },
    };
    let mesh = Mesh::build(vertices, &soup.tris, &soup.bound).map_err(|s| OptimizeError::SharedSide {
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
            let stay: Vec<u32> = bound_neighbours(&mesh, v, tris);
            if tris.len() != mesh.degree(v) {
                return Err(OptimizeError::NotOneFan { vertex, at });
            }
            let side = |w: Option<&u32>| w.map_or(DVec2::ZERO, |&w| soup.pos[w as usize] - at);
            let (first, last) = (side(ring.first()), side(ring.last()));
            match (closed, soup.motion[v as usize]) {
                (true, Motion::Free) if stay.is_empty() => Ok(std::f64::consts::TAU),
                (true, Motion::Fixed) => Ok(std::f64::consts::TAU),
                (_, Motion::On(line))
                    if soup.lines.get(line as usize).is_some_and(|line| goes_on(line, soup, v, &stay)) =>
                {
                    Ok(if closed { std::f64::consts::TAU } else { std::f64::consts::PI })
                }
                (false, Motion::Fixed) => Ok(opening(first, last)),
                (false, Motion::Along(d)) if slides(d, first, last) => Ok(std::f64::consts::PI),
                _ => Err(OptimizeError::Misplaced { vertex, at }),
            }
        })
        .collect();
    // The first one in order, whichever thread was first.
    checked.into_iter().collect()
}

/// The vertices that edges which must stay join to `v`, in the triangles `tris`.
fn bound_neighbours(mesh: &Mesh, v: u32, tris: &[u32]) -> Vec<u32> {
    let mut ends: Vec<u32> = Vec::new();
    for tri in tris.iter().map(|&t| mesh.tri[t as usize]) {
        for k in (0..3).filter(|&k| tri.v[k] != v && tri.is_bound(k)) {
            ends.extend(tri.v.iter().enumerate().filter(|&(i, &w)| i != k && w != v).map(|(_, &w)| w));
        }
    }
    ends.sort_unstable();
    ends.dedup();
    ends
}

/// Whether the edges from `v` to two others are along a segment.
fn goes_on(line: &Line, soup: &Soup, v: u32, stay: &[u32]) -> bool {
    let [a, b] = *stay else { return false };
    let [u, w] = [a, b].map(|w| soup.pos[w as usize] - soup.pos[v as usize]);
    let straight = |side: DVec2| line.along.perp_dot(side).abs() <= NEARLY_STRAIGHT * side.length();
    straight(u) && straight(w) && u.dot(w) < 0.0
}

fn slides(along: DVec2, first: DVec2, last: DVec2) -> bool {
    let straight = |side: DVec2| along.perp_dot(side).abs() <= STRAIGHT * side.length();
    (along.length() - 1.0).abs() <= STRAIGHT && straight(first) && straight(last) && first.dot(last) < 0.0
}
