//! The first triangulation: constrained Delaunay, without holes and outside.

use hexdel_geom::{DVec2, orient2d};
use hexdel_optimize::edit::curve::Frame;
use hexdel_optimize::edit::{EditMesh, Kind, LOCKED, NONE};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use crate::error::GrowError;
use crate::options::{Input, Role};

/// The mesh that growth begins with.
pub(crate) struct First {
    pub(crate) mesh: EditMesh,
    /// For each vertex the point that it is, [`NONE`] for carved ones. Several may be one point, where holes touch themselves.
    pub(crate) point_of: Vec<u32>,
}

/// The constrained Delaunay triangulation of the input, numbered along a curve.
pub(crate) fn first(input: &Input<'_>) -> Result<First, GrowError> {
    let frame = Frame::of(input.points);
    let order = frame.order(input.points);
    let mut number = vec![NONE; order.len()];
    for (new, &old) in order.iter().enumerate() {
        number[old as usize] = new as u32;
    }
    // Minus zero is another number to some, and the same place.
    let pos: Vec<DVec2> = order.iter().map(|&v| input.points[v as usize] + DVec2::ZERO).collect();
    let edges: Vec<[u32; 2]> = input.segments.iter().map(|s| s.map(|v| number[v as usize])).collect();
    let triangles = triangulated(&pos, &edges, input)?;
    let middle = |t: &[u32; 3]| frame.along(t.iter().map(|&v| pos[v as usize]).sum::<DVec2>() / 3.0);
    let mut keyed: Vec<(u32, [u32; 3])> = triangles.iter().map(|t| (middle(t), *t)).collect();
    keyed.sort_unstable();
    let mut mesh = EditMesh::default();
    mesh.kind = vec![Kind::Fixed; pos.len()];
    mesh.pos = pos;
    mesh.set_triangles(keyed.into_iter().map(|(_, t)| t)).expect("a triangulation is a surface");
    mark(&mut mesh, &edges, input)?;
    let mut point_of = order;
    let doomed = doomed(&mesh, input);
    if doomed.contains(&true) {
        for [copy, of] in mesh.carve(&doomed) {
            debug_assert_eq!(copy as usize, point_of.len());
            point_of.push(point_of[of as usize]);
        }
        for (point, kind) in point_of.iter_mut().zip(&mesh.kind) {
            if *kind == Kind::Dead {
                *point = NONE;
            }
        }
    }
    if mesh.triangle_count() == 0 {
        return Err(GrowError::NothingEnclosed);
    }
    Ok(First { mesh, point_of })
}

/// Triangles of the points by index.
fn triangulated(pos: &[DVec2], edges: &[[u32; 2]], input: &Input<'_>) -> Result<Vec<[u32; 3]>, GrowError> {
    let points: Vec<Point2<f64>> = pos.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let ends: Vec<[usize; 2]> = edges.iter().map(|e| e.map(|v| v as usize)).collect();
    let mut conflict = false;
    let made = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(points, ends, |_| {
        conflict = true;
    });
    let cdt = made.map_err(|_| {
        let fits = |x: f64| x == 0.0 || (1e-42..=1e60).contains(&x.abs());
        let index = input.points.iter().position(|p| !(fits(p.x) && fits(p.y))).unwrap_or(0);
        GrowError::OutOfRange { index, point: input.points.get(index).copied().unwrap_or_default() }
    })?;
    let same = pos.len() - cdt.num_vertices();
    if same > 0 {
        return Err(GrowError::SamePoints { same });
    }
    Ok(cdt.inner_faces().map(|f| f.vertices().map(|v| v.fix().index() as u32)).collect())
}

/// Marks the edges of the segments. Two that are the same edge have the first one's.
fn mark(mesh: &mut EditMesh, edges: &[[u32; 2]], input: &Input<'_>) -> Result<(), GrowError> {
    let mut sorted: Vec<([u32; 2], u32)> =
        edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).zip(0..).collect();
    sorted.sort_unstable();
    let mut found = vec![false; edges.len()];
    for c in 0..mesh.vertex.len() as u32 {
        let [a, b] = mesh.edge(c);
        let edge = [a.min(b), a.max(b)];
        let at = sorted.partition_point(|(e, _)| *e < edge);
        if sorted.get(at).is_some_and(|(e, _)| *e == edge) {
            let segment = sorted[at].1;
            let lock = if input.role(segment as usize) == Role::Border { 0 } else { LOCKED };
            mesh.mark[c as usize] = (segment + 1) | lock;
            found[segment as usize] = true;
        }
    }
    let missing = |&(edge, segment): &([u32; 2], u32)| {
        let first = sorted.partition_point(|(e, _)| *e < edge);
        !found[sorted[first].1 as usize] && segment == sorted[first].1
    };
    match sorted.iter().find(|entry| missing(entry)) {
        Some(&(_, segment)) => Err(GrowError::NotAnEdge { segment: segment as usize }),
        None => Ok(()),
    }
}

/// The triangles in holes and outside.
fn doomed(mesh: &EditMesh, input: &Input<'_>) -> Vec<bool> {
    let is_border = |c: u32| mesh.segment(c).is_some_and(|s| input.role(s as usize) != Role::Inner);
    let mut doomed = vec![false; mesh.slots() as usize];
    let mut stack: Vec<u32> = Vec::new();
    if input.inside {
        let rim = |c: &u32| mesh.twin[*c as usize] == NONE && !is_border(*c);
        stack.extend((0..mesh.vertex.len() as u32).filter(rim).map(|c| c / 3));
    }
    let mut hint = 0;
    for &hole in input.holes {
        let Some(t) = locate(mesh, hole, hint) else { continue };
        hint = t;
        let [on, _] = sides(mesh, t, hole);
        if !on.iter().any(|&c| is_border(c)) {
            stack.push(t);
        }
    }
    while let Some(t) = stack.pop() {
        if std::mem::replace(&mut doomed[t as usize], true) {
            continue;
        }
        let open = |&c: &u32| !is_border(c) && mesh.twin[c as usize] != NONE;
        stack.extend((3 * t..3 * t + 3).filter(open).map(|c| mesh.twin[c as usize] / 3));
    }
    doomed
}

/// Corners of a triangle opposite the edges that a point is on, and that it is beyond.
fn sides(mesh: &EditMesh, t: u32, p: DVec2) -> [Vec<u32>; 2] {
    let side = |c: u32| {
        let [a, b] = mesh.edge(c).map(|v| mesh.at(v));
        orient2d(a, b, p)
    };
    let corners = 3 * t..3 * t + 3;
    [corners.clone().filter(|&c| side(c) == 0.0).collect(), corners.filter(|&c| side(c) < 0.0).collect()]
}

/// A triangle with a point in it, walking from another one; all are looked at if the walk goes round in circles.
fn locate(mesh: &EditMesh, p: DVec2, from: u32) -> Option<u32> {
    let mut t = from;
    for step in 0..mesh.slots() as usize {
        let [_, beyond] = sides(mesh, t, p);
        if beyond.is_empty() {
            return Some(t);
        }
        let twin = mesh.twin[beyond[step % beyond.len()] as usize];
        if twin == NONE {
            break;
        }
        t = twin / 3;
    }
    mesh.triangles().find(|&t| sides(mesh, t, p)[1].is_empty())
}
