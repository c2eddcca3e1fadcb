use hexdel_geom::{DVec2, TriMesh, VertexId};

use super::{EditMesh, Kind, LOCKED, NONE, Saved, next, prev};

/// A grid of squares cut in two; the outline is marked 1.
fn grid(n: u32) -> EditMesh {
    let at = |i: u32, j: u32| VertexId::new((j * (n + 1) + i) as usize);
    let mut mesh = TriMesh::default();
    for j in 0..=n {
        mesh.vertices.extend((0..=n).map(|i| DVec2::new(f64::from(i), f64::from(j))));
    }
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
        mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    let rim = |p: &DVec2| {
        let most = f64::from(n);
        [p.x, p.y].iter().any(|&x| x == 0.0 || x == most)
    };
    let kinds: Vec<Kind> =
        mesh.vertices.iter().map(|p| if rim(p) { Kind::OnOutline } else { Kind::Free }).collect();
    let (mut made, order) = EditMesh::from_mesh(&mesh, &kinds).expect("a grid is a surface");
    assert!(order.iter().enumerate().all(|(v, &old)| made.pos[v] == mesh.vertices[old as usize]));
    for c in 0..made.vertex.len() as u32 {
        if made.twin[c as usize] == NONE {
            made.set_mark(c, 1);
        }
    }
    made
}

fn vertex_at(m: &EditMesh, x: f64, y: f64) -> u32 {
    let found = |&v: &u32| m.kind[v as usize] != Kind::Dead && m.at(v) == DVec2::new(x, y);
    (0..m.pos.len() as u32).find(found).expect("there is one")
}

fn area(m: &EditMesh) -> f64 {
    let double = |t: u32| {
        let [a, b, c] = m.corners(t);
        (b - a).perp_dot(c - a)
    };
    m.triangles().map(double).sum::<f64>() / 2.0
}

/// All that matters of a mesh, free lists aside.
fn state(m: &EditMesh) -> (Vec<[u32; 9]>, Vec<DVec2>, Vec<Kind>) {
    let of = |t: u32| {
        let c = 3 * t as usize;
        std::array::from_fn(|i| [&m.vertex, &m.twin, &m.mark][i / 3][c + i % 3])
    };
    (m.triangles().map(of).collect(), m.pos.clone(), m.kind.clone())
}

#[test]
fn a_mesh_comes_back_as_it_went() {
    let m = grid(4);
    assert_eq!(m.check(), Ok(()));
    assert_eq!((m.triangle_count(), m.vertex_count()), (32, 25));
    let out = m.export([7, 3].into_iter());
    assert_eq!(out.mesh.vertices[..2], [m.at(7), m.at(3)]);
    assert_eq!(out.mesh.triangles.len(), 32);
    assert_eq!(out.mesh.vertices.len(), 25);
}

#[test]
fn an_edge_of_three_triangles_is_refused() {
    let v = VertexId::new;
    let vertices = [(0.0, 0.0), (1.0, 0.0), (0.5, 1.0), (0.5, 2.0)].map(DVec2::from).to_vec();
    let triangles = vec![[v(0), v(1), v(2)], [v(0), v(1), v(3)]];
    assert!(EditMesh::from_mesh(&TriMesh { vertices, triangles }, &[Kind::Free; 4]).is_none());
}

#[test]
fn stars_are_whole_inside_and_at_the_outline() {
    let m = grid(3);
    let mut ring = Vec::new();
    for (x, y, corners, around) in
        [(1.0, 1.0, 6, 6), (0.0, 0.0, 2, 3), (3.0, 0.0, 1, 2), (1.0, 0.0, 3, 4), (0.0, 2.0, 3, 4)]
    {
        let v = vertex_at(&m, x, y);
        let star: Vec<u32> = m.star(v).collect();
        assert!(star.iter().all(|&c| m.v(c) == v));
        assert_eq!(star.len(), corners, "at {x} {y}");
        m.ring(v, &mut ring);
        ring.sort_unstable();
        ring.dedup();
        assert_eq!(ring.len(), around, "at {x} {y}");
    }
}

#[test]
fn a_flip_is_undone_by_another_two() {
    let mut m = grid(2);
    let inner = |m: &EditMesh| {
        let diagonal = |&c: &u32| {
            let [a, b] = m.edge(c).map(|v| m.at(v));
            m.twin[c as usize] != NONE && a.x != b.x && a.y != b.y
        };
        (0..m.vertex.len() as u32).find(diagonal).expect("there are diagonals")
    };
    let c = inner(&m);
    let edge = m.edge(c);
    let [s, _] = m.flip(c);
    assert_eq!(m.check(), Ok(()));
    assert!(m.corner_opposite(edge[0], edge[1]).is_none());
    // The flipped edge is opposite the second corner of the first triangle.
    m.flip(3 * s + 1);
    assert_eq!(m.check(), Ok(()));
    assert!(m.corner_opposite(edge[0], edge[1]).is_some());
    assert_eq!(area(&m), 4.0);
}

#[test]
fn removing_a_vertex_keeps_marks_and_is_taken_back() {
    let mut m = grid(2);
    let before = state(&m);
    let v = vertex_at(&m, 1.0, 0.0);
    let old: Vec<u32> = m.star(v).map(|c| c / 3).collect();
    assert_eq!(old.len(), 3);
    let at = |m: &EditMesh, x, y| vertex_at(m, x, y);
    // The part without the vertex lacks its outline edges, which lose their mark; all others keep theirs.
    let fill = [
        [at(&m, 0.0, 0.0), at(&m, 2.0, 0.0), at(&m, 2.0, 1.0)],
        [at(&m, 0.0, 0.0), at(&m, 2.0, 1.0), at(&m, 1.0, 1.0)],
    ];
    let (mut saved, mut slots) = (Saved::default(), Vec::new());
    m.replace(&old, &fill, &mut slots, Some(&mut saved));
    m.try_remove_vertex(v, &mut saved);
    assert_eq!(m.check(), Ok(()));
    assert_eq!(area(&m), 4.0);
    let right = m.corner_opposite(at(&m, 2.0, 0.0), at(&m, 2.0, 1.0)).expect("an edge of the outline");
    assert_eq!((m.mark[right as usize], m.twin[right as usize]), (1, NONE));
    m.take_back(&mut saved);
    assert_eq!(m.check(), Ok(()));
    assert_eq!(state(&m), before);
}

#[test]
fn an_attempt_with_new_vertices_and_moves_is_taken_back() {
    let mut m = grid(3);
    let before = state(&m);
    let (mut saved, mut slots) = (Saved::default(), Vec::new());
    let t = m.corner_of[vertex_at(&m, 1.0, 1.0) as usize] / 3;
    let [a, b, c] = m.vertices(t);
    let middle = m.corners(t).iter().sum::<DVec2>() / 3.0;
    let v = m.try_add_vertex(middle, Kind::Free, &mut saved);
    m.replace(&[t], &[[a, b, v], [b, c, v], [c, a, v]], &mut slots, Some(&mut saved));
    m.try_move(v, middle + DVec2::new(0.01, 0.0), &mut saved);
    assert_eq!((m.check(), slots.len()), (Ok(()), 3));
    m.take_back(&mut saved);
    assert_eq!((m.check(), m.triangle_count(), m.vertex_count()), (Ok(()), 18, 16));
    assert_eq!(state(&m).0, before.0);
}

#[test]
fn a_cavity_grows_and_is_refilled() {
    let mut m = grid(4);
    let v = vertex_at(&m, 2.0, 2.0);
    let star = m.cavity_around(v).expect("six triangles");
    assert_eq!((star.len(), star.enclosed()), (6, &[v][..]));
    let wider = m.grown(&star, 0).expect("nothing is in the way");
    assert_eq!((wider.len(), wider.triangles().len()), (7, 7));
    assert_ne!(wider.hash, star.hash);
    let mut slots = Vec::new();
    let made = m.refill(&star, None, DVec2::new(2.1, 2.0), Kind::Free, &mut slots);
    assert_eq!((m.check(), slots.len(), made), (Ok(()), 6, v));
    assert_eq!(area(&m), 16.0);
}

#[test]
fn cavities_enclose_free_vertices_only() {
    let mut m = grid(4);
    let v = vertex_at(&m, 2.0, 2.0);
    // From one triangle around the vertex: only growth encloses it.
    let around: Vec<u32> = m.star(v).map(|c| c / 3).collect();
    let grow = |m: &EditMesh| {
        let mut cavity = m.cavity_of(around[0]);
        for _ in 0..5 {
            let inside = |i: &usize| {
                let beyond = m.twin[cavity.inner(*i) as usize];
                beyond != NONE
                    && around.contains(&(beyond / 3))
                    && !cavity.triangles().contains(&(beyond / 3))
            };
            let Some(i) = (0..cavity.len()).find(inside) else { break };
            let Some(grown) = m.grown(&cavity, i) else { break };
            cavity = grown;
        }
        cavity
    };
    let whole = grow(&m);
    assert!(whole.enclosed().contains(&v));
    m.kind[v as usize] = Kind::Fixed;
    assert!(grow(&m).enclosed().is_empty());
}

#[test]
fn a_vertex_on_a_segment_is_put_elsewhere_on_it() {
    let mut m = grid(2);
    // A segment across the middle.
    let ends = [0.0, 1.0, 2.0].map(|x| vertex_at(&m, x, 1.0));
    for [a, b] in [[ends[0], ends[1]], [ends[1], ends[2]]] {
        let c = m.corner_opposite(a, b).expect("a row of the grid");
        m.set_mark(c, 3);
    }
    m.kind[ends[1] as usize] = Kind::OnSegment;
    let [upper, lower] = m.cavities_beside(ends[1]).expect("two marked edges");
    assert_eq!((upper.triangles().len(), lower.triangles().len()), (3, 3));
    assert!(!upper.touches(&lower));
    let mut slots = Vec::new();
    let v = m.refill(&upper, Some(&lower), DVec2::new(1.2, 1.0), Kind::OnSegment, &mut slots);
    assert_eq!(m.check(), Ok(()));
    let marked: Vec<Option<u32>> = m
        .star(v)
        .flat_map(|c| [next(c), prev(c)])
        .filter(|&c| m.is_marked(c))
        .map(|c| m.segment(c))
        .collect();
    assert_eq!(marked, [Some(2); 4]);
    // And one on the outline.
    let v = vertex_at(&m, 1.0, 0.0);
    let [inner, outer] = m.cavities_beside(v).expect("on the outline");
    assert!(outer.is_empty() && inner.ring().len() == 4 && inner.enclosed() == [v]);
    m.refill(&inner, None, DVec2::new(0.9, 0.0), Kind::OnOutline, &mut slots);
    assert_eq!((m.check(), area(&m)), (Ok(()), 4.0));
}

#[test]
fn an_edge_is_divided_on_both_sides() {
    let mut m = grid(2);
    let c = m.corner_opposite(vertex_at(&m, 1.0, 1.0), vertex_at(&m, 2.0, 1.0)).expect("an edge inside");
    m.set_mark(c, 5 | LOCKED);
    assert!(m.is_locked(c) && m.segment(c) == Some(4));
    let (one, two) = (m.cavity_on(c), m.cavity_on(m.twin[c as usize]));
    let mut slots = Vec::new();
    m.refill(&one, Some(&two), DVec2::new(1.5, 1.0), Kind::OnSegment, &mut slots);
    assert_eq!((m.check(), m.triangle_count(), area(&m)), (Ok(()), 10, 4.0));
}

#[test]
fn carving_leaves_an_outline() {
    let mut m = grid(2);
    let mut doomed = vec![false; m.slots() as usize];
    let corner = vertex_at(&m, 2.0, 0.0);
    doomed[m.corner_of[corner as usize] as usize / 3] = true;
    assert!(m.carve(&doomed).is_empty());
    assert_eq!((m.check(), m.triangle_count(), m.vertex_count()), (Ok(()), 7, 8));
}

#[test]
fn carving_makes_one_vertex_of_each_fan() {
    let mut m = grid(2);
    let v = vertex_at(&m, 1.0, 1.0);
    let keep: Vec<u32> = m.star(v).map(|c| c / 3).step_by(3).collect();
    let doomed: Vec<bool> = (0..m.slots()).map(|t| !keep.contains(&t)).collect();
    let copies = m.carve(&doomed);
    assert!(matches!(copies[..], [[copy, of]] if of == v && m.at(copy) == m.at(v)));
    assert_eq!((m.check(), m.triangle_count(), m.vertex_count()), (Ok(()), 2, 6));
}
