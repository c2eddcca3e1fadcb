use super::*;
use crate::DVec2;

fn mesh(vertices: &[(f64, f64)], triangles: &[[usize; 3]]) -> TriMesh {
    TriMesh {
        vertices: vertices.iter().map(|&(x, y)| DVec2::new(x, y)).collect(),
        triangles: triangles.iter().map(|t| t.map(VertexId::new)).collect(),
    }
}

/// A vertex in the middle of six equilateral triangles with edges of 1.
fn hexagon() -> TriMesh {
    let ring = (0..6).map(|i| {
        (libm::cos((60.0 * f64::from(i)).to_radians()), libm::sin((60.0 * f64::from(i)).to_radians()))
    });
    let vertices: Vec<(f64, f64)> = std::iter::once((0.0, 0.0)).chain(ring).collect();
    let triangles: Vec<[usize; 3]> = (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6]).collect();
    mesh(&vertices, &triangles)
}

fn area(polygon: &[DVec2]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(p, q)| 0.5 * p.perp_dot(*q)).sum()
}

#[test]
fn equilateral_triangles() {
    let mesh = hexagon();
    let dual = Voronoi::new(&mesh).unwrap();
    let weight = 1.0 / 3f64.sqrt();
    assert_eq!(dual.edges.len(), 12);
    for edge in &dual.edges {
        let expected = if edge.is_boundary() { weight / 2.0 } else { weight };
        assert!((edge.weight - expected).abs() < 1e-14, "{edge:?}");
    }
    let cell = dual.cell(VertexId::new(0));
    assert_eq!(cell.len(), 6);
    assert!(cell.iter().all(|c| (c.length() - weight).abs() < 1e-14));
    assert!((area(&cell) - dual.areas[0]).abs() < 1e-14);
    // Two kites of a triangle and the vertex: half of an inner triangle's third.
    assert!((area(&dual.cell(VertexId::new(1))) - 3f64.sqrt() / 6.0).abs() < 1e-14);
    assert!((dual.areas.iter().sum::<f64>() - 1.5 * 3f64.sqrt()).abs() < 1e-13);
    let summary = dual.summary();
    assert_eq!((summary.negative_weights, summary.obtuse_triangles), (0, 0));
    assert!(summary.max_skew < 1e-15);
}

#[test]
fn right_angles_make_dual_edges_of_no_length() {
    let mesh = mesh(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], &[[0, 1, 2], [0, 2, 3]]);
    let dual = Voronoi::new(&mesh).unwrap();
    let diagonal = dual.edges.iter().find(|e| !e.is_boundary()).unwrap();
    assert_eq!(diagonal.ends, [VertexId::new(0), VertexId::new(2)]);
    // Left of 0 2 lies 3.
    assert_eq!(diagonal.triangles, [Some(TriangleId::new(1)), Some(TriangleId::new(0))]);
    assert_eq!(dual.summary().shortest_dual_edge, 0.0);
    assert_eq!(dual.cell(VertexId::new(0)).len(), 4);
}

#[test]
fn an_obtuse_angle_is_counted_and_its_cell_cut_off() {
    let mesh = mesh(&[(0.0, 0.0), (4.0, 0.0), (2.0, 1.0)], &[[0, 1, 2]]);
    let dual = Voronoi::new(&mesh).unwrap();
    let summary = dual.summary();
    assert_eq!((summary.negative_weights, summary.obtuse_triangles), (1, 1));
    let cells: Vec<Vec<DVec2>> = (0..3).map(|v| dual.cell(VertexId::new(v))).collect();
    let total: f64 = cells.iter().map(|c| area(c)).sum();
    assert!((total - 2.0).abs() < 1e-14, "{cells:?}");
    // The bisector of (0, 0) and (2, 1) meets the axis at 1.25.
    assert!(cells[0].iter().any(|p| p.distance(DVec2::new(1.25, 0.0)) < 1e-14), "{cells:?}");
    assert!(cells.iter().flatten().all(|p| p.y >= 0.0));
    // Signed areas sum to the whole all the same.
    assert!((dual.areas.iter().sum::<f64>() - 2.0).abs() < 1e-14);
}

#[test]
fn what_is_no_surface_has_no_dual() {
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (2.0, 0.5)];
    let fault = |triangles: &[[usize; 3]]| Voronoi::new(&mesh(&square, triangles)).map(|_| ()).unwrap_err();
    let first = TriangleId::new(0);
    assert_eq!(fault(&[[0, 1, 9]]), VoronoiError::Malformed { triangle: first });
    assert_eq!(fault(&[[0, 1, 1]]), VoronoiError::Malformed { triangle: first });
    assert_eq!(fault(&[[0, 2, 1]]), VoronoiError::NotCounterClockwise { triangle: first });
    let at = VertexId::new(0);
    assert_eq!(fault(&[[0, 1, 2], [0, 1, 3]]), VoronoiError::Branching { vertex: at, at: DVec2::ZERO });
}

#[test]
fn a_vertex_without_triangles_has_no_cell() {
    let mesh = mesh(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (5.0, 5.0)], &[[0, 1, 2]]);
    let dual = Voronoi::new(&mesh).unwrap();
    assert!(dual.cell(VertexId::new(3)).is_empty());
    assert_eq!(dual.areas[3], 0.0);
}

#[test]
fn every_cell_along_a_strip_of_obtuse_angles_is_cut_off() {
    // Flat triangles on a line, with their obtuse angles above.
    let vertices = (0..=20).map(|i| (f64::from(i), if i % 2 == 0 { 0.0 } else { 0.25 }));
    let triangles: Vec<[usize; 3]> =
        (0..19).map(|i| if i % 2 == 0 { [i, i + 2, i + 1] } else { [i, i + 1, i + 2] }).collect();
    let strip = mesh(&vertices.collect::<Vec<_>>(), &triangles);
    let dual = Voronoi::new(&strip).unwrap();
    assert_eq!(dual.leaks.len(), 19);
    let cells: Vec<Vec<DVec2>> = (0..=20).map(|v| dual.cell(VertexId::new(v))).collect();
    assert!(cells.iter().flatten().all(|p| (-1e-12..=0.25 + 1e-12).contains(&p.y)), "{cells:?}");
    let total: f64 = cells.iter().map(|cell| area(cell)).sum();
    assert!((total - 19.0 * 0.25).abs() < 1e-12, "{total}");
}
