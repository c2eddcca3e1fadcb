//! The Voronoi dual in files.

use std::fs;

use hexdel_geom::{DVec2, TriMesh, VertexId, Voronoi};
use hexdel_io::{MeshView, WriteError, write_dual};

/// A square halved.
fn square() -> TriMesh {
    TriMesh {
        vertices: [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y)).to_vec(),
        triangles: vec![[0, 1, 2].map(VertexId::new), [0, 2, 3].map(VertexId::new)],
    }
}

#[test]
fn circumcentres_edges_and_rays() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = square();
    write_dual(folder.path().join("m.v.edge"), &MeshView::new(&mesh), &Voronoi::new(&mesh).unwrap()).unwrap();
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("m.v.node"), "2 2 0 0\n0 0.5 0.5\n1 0.5 0.5\n");
    let edges = read("m.v.edge");
    let lines: Vec<&str> = edges.lines().collect();
    assert_eq!(lines[0], "5 0");
    assert!(lines.contains(&"1 1 0"), "the diagonal, triangle 1 on its left: {edges}");
    // Out of the square through its four sides.
    for ray in ["0 -1 0.0 -1.0", "0 -1 1.0 0.0", "1 -1 0.0 1.0", "1 -1 -1.0 0.0"] {
        let is_ray = |line: &&&str| line.split_once(' ').unwrap().1.replace("-0.0", "0.0") == ray;
        assert_eq!(lines.iter().filter(is_ray).count(), 1, "{ray}: {edges}");
    }
}

#[test]
fn cells_share_their_corners() {
    let folder = tempfile::tempdir().unwrap();
    let (mesh, path) = (square(), folder.path().join("m.vtu"));
    write_dual(&path, &MeshView::new(&mesh), &Voronoi::new(&mesh).unwrap()).unwrap();
    let text = fs::read_to_string(path).unwrap();
    // Four corners, four middles, one centre.
    assert!(text.contains("NumberOfPoints=\"9\" NumberOfCells=\"4\""), "{text}");
}

#[test]
fn other_extensions_are_refused() {
    let mesh = square();
    let dual = Voronoi::new(&mesh).unwrap();
    for name in ["m.node", "m.v.ele", "m", ".v"] {
        let error = write_dual(name, &MeshView::new(&mesh), &dual).unwrap_err();
        assert!(matches!(error, WriteError::UnknownExtension { .. }), "{name}: {error}");
    }
}

#[test]
fn netcdf_has_no_duals_of_nothing() {
    let mesh = TriMesh::default();
    let dual = Voronoi::new(&mesh).unwrap();
    for name in ["m.nc", "m.mpas.nc"] {
        let error = write_dual(name, &MeshView::new(&mesh), &dual).unwrap_err();
        assert!(matches!(error, WriteError::Empty { .. }), "{name}: {error}");
    }
}
