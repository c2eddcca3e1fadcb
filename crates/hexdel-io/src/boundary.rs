//! The boundary of a mesh as loops, and the runs of equal markers that they are made of.
//!
//! Formats of hydrodynamics list boundaries by their vertices. Here they go as the triangles
//! do, with the mesh on the left: counter-clockwise around it, clockwise around its holes.

use std::mem::take;

use hexdel_geom::{DVec2, TriMesh};

use crate::topology::{EdgeMarkers, Edges, counter_clockwise};
use crate::view::MeshView;

/// A part of the boundary with one marker.
pub(crate) struct Run {
    /// The marker of its edges: 1 if no edges of the mesh have markers, 0 if these have none.
    pub(crate) marker: i32,
    /// Its vertices on the way; the last is the first again if it is a whole loop.
    pub(crate) vertices: Vec<u32>,
    /// Whether the loop that it is part of goes around a hole.
    pub(crate) around_hole: bool,
}

impl Run {
    /// Whether it is a whole loop.
    pub(crate) fn is_closed(&self) -> bool {
        self.vertices.first() == self.vertices.last()
    }
}

/// The runs of all loops, loop by loop. Loops begin at their vertex of the smallest index, or
/// the first change of markers after it.
pub(crate) fn runs(view: &MeshView<'_>) -> Vec<Run> {
    let markers = view.marked_edges.map(EdgeMarkers::new);
    let marker = |ends| markers.as_ref().map_or(1, |markers| markers.of(ends).unwrap_or(0));
    let mut all = Vec::new();
    for vertices in loops(view.mesh) {
        let around_hole = twice_area(&view.mesh.vertices, &vertices) < 0.0;
        for (marker, vertices) in divided(&vertices, marker) {
            all.push(Run { marker, vertices, around_hole });
        }
    }
    all
}

/// The boundary as loops of vertices, each ending where it begins.
///
/// Where it meets itself in a vertex, a loop goes on with the edge to the smallest vertex. Only of
/// triangles that do not fit together, as three at an edge, a loop may be open.
fn loops(mesh: &TriMesh) -> Vec<Vec<u32>> {
    let edges = Edges::new(mesh);
    let mut sides: Vec<[u32; 2]> = Vec::new();
    for t in 0..mesh.triangles.len() {
        let corners = counter_clockwise(mesh, t);
        for (k, neighbour) in edges.neighbours(t, corners).into_iter().enumerate() {
            if neighbour.is_none() {
                sides.push([corners[(k + 1) % 3], corners[(k + 2) % 3]].map(|v| v.index() as u32));
            }
        }
    }
    sides.sort_unstable();
    let mut used = vec![false; sides.len()];
    let mut loops = Vec::new();
    for start in 0..sides.len() {
        if used[start] {
            continue;
        }
        let mut vertices = vec![sides[start][0]];
        let mut side = Some(start);
        while let Some(at) = side {
            used[at] = true;
            let end = sides[at][1];
            vertices.push(end);
            let first = sides.partition_point(|side| side[0] < end);
            side = (first..sides.len()).take_while(|&i| sides[i][0] == end).find(|&i| !used[i]);
        }
        loops.push(vertices);
    }
    loops
}

/// The parts of a loop with equal markers.
fn divided(vertices: &[u32], marker: impl Fn([u32; 2]) -> i32) -> Vec<(i32, Vec<u32>)> {
    let mut markers: Vec<i32> = vertices.windows(2).map(|ends| marker([ends[0], ends[1]])).collect();
    let mut vertices = vertices.to_vec();
    let is_closed = vertices.first() == vertices.last();
    let count = markers.len();
    let changes = |i: &usize| markers[*i] != markers[(i + count - 1) % count];
    if let Some(change) = (0..count).find(changes).filter(|_| is_closed) {
        vertices.pop();
        vertices.rotate_left(change);
        vertices.push(vertices[0]);
        markers.rotate_left(change);
    }
    let mut parts = Vec::new();
    let mut part = vec![vertices[0]];
    for (i, &marker) in markers.iter().enumerate() {
        part.push(vertices[i + 1]);
        if markers.get(i + 1) != Some(&marker) {
            parts.push((marker, take(&mut part)));
            part.push(vertices[i + 1]);
        }
    }
    parts
}

/// Twice the signed area in a loop, relative to one of its vertices, at half the scale so that
/// nothing overflows that need not.
fn twice_area(places: &[DVec2], vertices: &[u32]) -> f64 {
    let at = |v: u32| places[v as usize] * 0.5 - places[vertices[0] as usize] * 0.5;
    vertices.windows(2).map(|ends| at(ends[0]).perp_dot(at(ends[1]))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::{MarkedEdge, VertexId};

    /// Three by three squares without the one in the middle.
    fn frame() -> TriMesh {
        let vertices = (0..16).map(|i| DVec2::new(f64::from(i % 4), f64::from(i / 4))).collect();
        let squares = [0, 1, 2, 4, 6, 8, 9, 10];
        let halves = |a: usize| [[a, a + 1, a + 5], [a, a + 5, a + 4]];
        let triangles = squares.into_iter().flat_map(halves).map(|t| t.map(VertexId::new)).collect();
        TriMesh { vertices, triangles }
    }

    fn found(view: &MeshView<'_>) -> Vec<(i32, Vec<u32>, bool)> {
        runs(view).into_iter().map(|run| (run.marker, run.vertices, run.around_hole)).collect()
    }

    #[test]
    fn loops_have_the_mesh_on_their_left() {
        let mut mesh = frame();
        let outside = vec![0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4, 0];
        let expected = [(1, outside, false), (1, vec![5, 9, 10, 6, 5], true)];
        assert_eq!(found(&MeshView::new(&mesh)), expected);
        // However the triangles are turned.
        mesh.triangles.iter_mut().for_each(|t| t.reverse());
        assert_eq!(found(&MeshView::new(&mesh)), expected);
    }

    #[test]
    fn runs_begin_where_markers_change() {
        let mesh = frame();
        let edge = |a, b, marker| MarkedEdge { ends: [a, b].map(VertexId::new), marker };
        // The right side, against the direction of the loop; and an edge inside, which does not count.
        let edges = [edge(7, 3, -1), edge(11, 7, -1), edge(11, 15, -1), edge(0, 5, 3)];
        let found = found(&MeshView::new(&mesh).with_marked_edges(&edges));
        let rest = vec![15, 14, 13, 12, 8, 4, 0, 1, 2, 3];
        let expected = [(-1, vec![3, 7, 11, 15], false), (0, rest, false), (0, vec![5, 9, 10, 6, 5], true)];
        assert_eq!(found, expected);
    }
}
