//! Conversions to the triangulations of spade and back.

#![cfg(feature = "io")]
#![cfg(feature = "spade")]

use crate::common;
use hexdel::spade::{SpadeError, constrained_of, delaunay_of, edges_of, graph_of, mesh_of};
use hexdel::{DVec2, Mesher, Method, TriMesh, VertexId};
use std::collections::BTreeSet;

/// Triangles, each from its least corner on.
fn triangles(mesh: &TriMesh) -> BTreeSet<[usize; 3]> {
    let turned = |t: &[VertexId; 3]| {
        let [a, b, c] = t.map(VertexId::index);
        [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap()
    };
    mesh.triangles.iter().map(turned).collect()
}

#[test]
fn a_mesh_comes_back_as_it_was() {
    for (method, name) in [(Method::Templates, "five"), (Method::Compact, "capitals")] {
        let made = Mesher::new().method(method).triangulate(&common::points(name)).unwrap();
        let there = constrained_of(&made.mesh, &edges_of(&made.mesh)).unwrap();
        let back = mesh_of(&there);
        assert_eq!(back.vertices, made.mesh.vertices);
        // Where rounding bent a side of the domain inwards, spade fills the hull with slivers.
        let (there, ours) = (triangles(&back), triangles(&made.mesh));
        assert!(ours.is_subset(&there), "{name}");
        for sliver in there.difference(&ours) {
            let [a, b, c] = sliver.map(|v| back.vertices[v]);
            assert!(0.5 * (b - a).perp_dot(c - a) < 1e-12 * (b - a).length_squared(), "{name}: {sliver:?}");
        }
        // Spade's own Delaunay triangulation has as many triangles, and the same but for
        // diagonals of points on a circle.
        let delaunay = mesh_of(&delaunay_of(&made.mesh).unwrap());
        assert_eq!(delaunay.vertices, made.mesh.vertices);
        assert_eq!(delaunay.triangles.len(), back.triangles.len());
    }
}

#[test]
fn a_graph_goes_through_spade_and_is_meshed() {
    let graph = common::graph("square_with_hole");
    let mesh = TriMesh { vertices: graph.points.clone(), triangles: Vec::new() };
    let segments: Vec<_> = graph.segments.iter().map(|s| s.map(|v| VertexId::new(v as usize))).collect();
    let there = constrained_of(&mesh, &segments).unwrap();
    assert_eq!(there.num_constraints(), graph.segments.len());
    let mut back = graph_of(&there);
    assert_eq!(back.points, graph.points);
    let sorted = |segments: &[[u32; 2]]| -> BTreeSet<[u32; 2]> {
        segments.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect()
    };
    assert_eq!(sorted(&back.segments), sorted(&graph.segments));
    back.holes = graph.holes.clone();
    assert!(hexdel::triangulate_pslg(&back).unwrap().holds());
}

#[test]
fn what_spade_does_not_take_is_named() {
    let mesh = |points: &[(f64, f64)]| TriMesh {
        vertices: points.iter().map(|&(x, y)| DVec2::new(x, y)).collect(),
        triangles: Vec::new(),
    };
    let square = mesh(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    let edge = |a, b| [VertexId::new(a), VertexId::new(b)];
    let crossed = constrained_of(&square, &[edge(0, 2), edge(1, 3)]).unwrap_err();
    assert!(matches!(crossed, SpadeError::Crossing { .. }), "{crossed}");
    let missing = constrained_of(&square, &[edge(0, 1), edge(2, 9)]).unwrap_err();
    assert_eq!(missing, SpadeError::NoVertex { edge: 1, vertex: 9, vertices: 4 });
    let twice = delaunay_of(&mesh(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 0.0)])).unwrap_err();
    assert_eq!(twice, SpadeError::Duplicates { vertices: 4, distinct: 3 });
    let nan = delaunay_of(&mesh(&[(0.0, 0.0), (f64::NAN, 0.0)])).unwrap_err();
    assert!(matches!(nan, SpadeError::Vertex { vertex: 1, .. }), "{nan}");
}
