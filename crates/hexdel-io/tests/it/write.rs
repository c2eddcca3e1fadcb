//! Written files: content of the formats that are not read back, and the promise
//! of all or nothing.

use std::fs;
use std::path::Path;

use crate::support::squares;
use hexdel_geom::{DVec2, Pslg, TriMesh, VertexId};
use hexdel_io::{
    MarkedEdge, MeshFormat, MeshView, ReadError, WriteError, read_mesh, write_mesh, write_mesh_pair_to,
    write_mesh_to, write_points,
};

fn text(format: MeshFormat, view: &MeshView<'_>) -> String {
    let mut out = Vec::new();
    write_mesh_to(&mut out, format, view, "stream").unwrap();
    String::from_utf8(out).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_pair_of_files_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    write_mesh(folder.path().join("m.ele"), &MeshView::new(&squares(1))).unwrap();
    assert_eq!(names(folder.path()), ["m.ele", "m.node"]);
    let nodes = fs::read_to_string(folder.path().join("m.node")).unwrap();
    assert_eq!(nodes, "4 2 0 0\n0 0.0 0.0\n1 1.0 0.0\n2 0.0 1.0\n3 1.0 1.0\n");
    let elements = fs::read_to_string(folder.path().join("m.ele")).unwrap();
    assert_eq!(elements, "2 3 0\n0 0 1 3\n1 0 3 2\n");
    let mut pair = [Vec::new(), Vec::new()];
    let [to_nodes, to_elements] = &mut pair;
    write_mesh_pair_to(to_nodes, to_elements, &MeshView::new(&squares(1)), "stream").unwrap();
    assert_eq!(pair.map(|bytes| String::from_utf8(bytes).unwrap()), [nodes, elements]);
}

#[test]
fn markers_and_regions_are_written() {
    let mesh = squares(1);
    let markers = [7, 1, -2, 0];
    let regions = [1.5, 0.0];
    let view = MeshView::new(&mesh).with_vertex_markers(&markers).with_regions(&regions);
    let folder = tempfile::tempdir().unwrap();
    write_mesh(folder.path().join("m.ele"), &view).unwrap();
    let nodes = fs::read_to_string(folder.path().join("m.node")).unwrap();
    assert_eq!(nodes, "4 2 0 1\n0 0.0 0.0 7\n1 1.0 0.0 1\n2 0.0 1.0 -2\n3 1.0 1.0 0\n");
    let elements = fs::read_to_string(folder.path().join("m.ele")).unwrap();
    assert_eq!(elements, "2 3 1\n0 0 1 3 1.5\n1 0 3 2 0.0\n");
    assert_eq!(read_mesh(folder.path().join("m.ele")).unwrap(), mesh);
    let vtu = text(MeshFormat::Vtu, &view);
    assert!(vtu.contains("Name=\"marker\"") && vtu.contains("Name=\"region\""));
    let ron = text(MeshFormat::Ron, &view);
    assert!(ron.contains("vertex_markers") && ron.contains("regions"), "{ron}");
}

#[test]
fn second_order_elements_have_nodes_on_their_edges() {
    let mesh = squares(1);
    let edge = MarkedEdge { ends: [1, 3].map(VertexId::new), marker: 9 };
    let (markers, edges) = ([1; 4], [edge]);
    let view = MeshView::new(&mesh).with_vertex_markers(&markers).with_marked_edges(&edges);
    let folder = tempfile::tempdir().unwrap();
    write_mesh(folder.path().join("m.ele"), &view.with_second_order(true)).unwrap();
    let nodes = fs::read_to_string(folder.path().join("m.node")).unwrap();
    let midpoints = "4 0.5 0.0 1\n5 0.0 0.5 1\n6 0.5 0.5 0\n7 1.0 0.5 9\n8 0.5 1.0 1\n";
    assert!(nodes.starts_with("9 2 0 1\n") && nodes.ends_with(midpoints), "{nodes}");
    // 0 1 3 are (0, 0), (1, 0), (1, 1); opposite to them (1, 0.5), (0.5, 0.5), (0.5, 0).
    let elements = fs::read_to_string(folder.path().join("m.ele")).unwrap();
    assert_eq!(elements, "2 6 0\n0 0 1 3 7 6 4\n1 0 3 2 8 5 6\n");
}

#[test]
fn arrays_that_do_not_fit_are_named() {
    let mesh = squares(1);
    let edge = MarkedEdge { ends: [0, 4].map(VertexId::new), marker: 1 };
    for (view, words) in [
        (MeshView::new(&mesh).with_vertex_markers(&[1]), "1 vertex markers instead of 4"),
        (MeshView::new(&mesh).with_regions(&[0.0; 3]), "3 regions instead of 2"),
        (MeshView::new(&mesh).with_marked_edges(&[edge]), "edge 0 refers to number 4 of 4"),
    ] {
        let error = write_mesh_to(&mut Vec::new(), MeshFormat::Vtu, &view, "stream").unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn failure_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let mut mesh = squares(2);
    for name in ["m.ele", "m.vtu", "m.ron", "m.svg"] {
        let path = folder.path().join(name);
        write_mesh(&path, &MeshView::new(&mesh)).unwrap();
    }
    let before = names(folder.path());
    let old = fs::read(folder.path().join("m.vtu")).unwrap();

    mesh.vertices[4].y = f64::NAN;
    for name in ["m.ele", "m.vtu", "m.ron", "m.svg"] {
        let error = write_mesh(folder.path().join(name), &MeshView::new(&mesh)).unwrap_err();
        assert!(matches!(error, WriteError::NonFinite { item: "vertex", index: 4, .. }), "{error:?}");
    }
    // Fails in the middle of writing, when part of the file is there.
    let failing = Failing;
    let good = squares(2);
    let view = MeshView::new(&good).with_certificate(&failing);
    let error = write_mesh(folder.path().join("m.ron"), &view).unwrap_err();
    assert!(matches!(error, WriteError::Io { .. }), "{error:?}");
    assert!(error.to_string().contains("m.ron"), "{error}");

    assert_eq!(names(folder.path()), before);
    assert_eq!(fs::read(folder.path().join("m.vtu")).unwrap(), old);
    assert_eq!(read_mesh(folder.path().join("m.ron")).unwrap(), squares(2));
}

/// A certificate that cannot be serialised.
struct Failing;

impl serde::Serialize for Failing {
    fn serialize<S: serde::Serializer>(&self, _: S) -> Result<S::Ok, S::Error> {
        Err(serde::ser::Error::custom("no certificate"))
    }
}

#[test]
fn if_one_of_a_pair_cannot_be_made_the_other_is_not() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("m.ele")).unwrap();
    let error = write_mesh(folder.path().join("m.node"), &MeshView::new(&squares(1))).unwrap_err();
    assert!(matches!(error, WriteError::NotAFile { .. }), "{error:?}");
    assert_eq!(names(folder.path()), ["m.ele"]);
}

#[test]
fn paths_that_cannot_be_written() {
    let mesh = squares(1);
    let view = MeshView::new(&mesh);
    let error = write_mesh("no/such/folder/m.svg", &view).unwrap_err();
    assert!(matches!(error, WriteError::Io { .. }), "{error:?}");
    assert!(error.to_string().starts_with("no/such/folder/m.svg: "), "{error}");
    let error = write_mesh("m.xls", &view).unwrap_err();
    assert!(matches!(error, WriteError::UnknownExtension { .. }), "{error:?}");
    let error = write_mesh_to(&mut Vec::new(), MeshFormat::NodeEle, &view, "-").unwrap_err();
    assert!(matches!(error, WriteError::TwoFiles { .. }), "{error:?}");
}

#[cfg(unix)]
#[test]
fn links_stay_links_and_modes_stay_modes() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let [file, link] = ["file.ron", "link.ron"].map(|name| folder.path().join(name));
    fs::write(&file, "old").unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&file, &link).unwrap();
    write_mesh(&link, &MeshView::new(&squares(1))).unwrap();
    assert!(link.is_symlink());
    assert_eq!(read_mesh(&file).unwrap(), squares(1));
    assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
    // A device is not to be replaced by a file.
    symlink("/dev/null", folder.path().join("null.svg")).unwrap();
    let error = write_mesh(folder.path().join("null.svg"), &MeshView::new(&squares(1)));
    assert!(matches!(error, Err(WriteError::NotAFile { .. })));
}

#[test]
fn views_that_do_not_fit() {
    let mut mesh = squares(1);
    let mut out = Vec::new();
    let view = MeshView::new(&mesh).with_input_indices(&[None]);
    let error = write_mesh_to(&mut out, MeshFormat::Vtu, &view, "v").unwrap_err();
    assert_eq!(error.to_string(), "v: 1 input indices instead of 4");
    mesh.triangles[1][2] = VertexId::new(4);
    let error = write_mesh_to(&mut out, MeshFormat::Vtu, &MeshView::new(&mesh), "v").unwrap_err();
    assert_eq!(error.to_string(), "v: triangle 1 refers to number 4 of 4");
    assert!(out.is_empty());
}

#[test]
fn points_that_would_be_lost() {
    let folder = tempfile::tempdir().unwrap();
    let mut pslg = Pslg::from_points(vec![DVec2::ZERO, DVec2::X]);
    pslg.segments = vec![[0, 1]];
    let error = write_points(folder.path().join("p.node"), &pslg).unwrap_err();
    assert!(matches!(error, WriteError::PointsOnly { item: "segments", .. }));
    pslg.segments = vec![[0, 2]];
    let error = write_points(folder.path().join("p.poly"), &pslg).unwrap_err();
    assert!(matches!(error, WriteError::Layout { .. }), "{error:?}");
    pslg.segments.clear();
    pslg.points[1].x = f64::INFINITY;
    let error = write_points(folder.path().join("p.csv"), &pslg).unwrap_err();
    assert!(matches!(error, WriteError::NonFinite { item: "point", index: 1, .. }));
    assert!(names(folder.path()).is_empty());
}

/// The values of a data array of a `.vtu` file, decoded.
fn array(vtu: &str, name: &str) -> Vec<u8> {
    use base64::prelude::{BASE64_STANDARD, Engine};
    let (_, rest) = vtu.split_once(&format!("Name=\"{name}\"")).unwrap();
    let (_, rest) = rest.split_once(">\n").unwrap();
    let (data, _) = rest.split_once("\n</DataArray>").unwrap();
    let bytes = BASE64_STANDARD.decode(data).unwrap();
    let (length, values) = bytes.split_first_chunk().unwrap();
    assert_eq!(u64::from_le_bytes(*length), values.len() as u64);
    values.to_vec()
}

fn words<T, const N: usize>(bytes: &[u8], from: fn([u8; N]) -> T) -> Vec<T> {
    assert_eq!(bytes.len() % N, 0);
    let chunks = bytes.chunks_exact(N);
    chunks.map(|chunk| from(chunk.try_into().unwrap())).collect()
}

#[test]
fn vtu_arrays() {
    let mut mesh = squares(1);
    mesh.vertices[2].x = -0.0;
    let view = MeshView::new(&mesh).with_input_indices(&[Some(0), None, Some(u32::MAX), None]);
    let vtu = text(MeshFormat::Vtu, &view);
    assert!(vtu.contains("<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">"));
    let points = words(&array(&vtu, "Points"), f64::from_le_bytes);
    assert_eq!(points, [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -0.0, 1.0, 0.0, 1.0, 1.0, 0.0]);
    assert!(points[6].is_sign_negative());
    let corners = words(&array(&vtu, "connectivity"), i32::from_le_bytes);
    assert_eq!(corners, [0, 1, 3, 0, 3, 2]);
    assert_eq!(words(&array(&vtu, "offsets"), i32::from_le_bytes), [3, 6]);
    assert_eq!(array(&vtu, "types"), [5, 5]);
    let inputs = words(&array(&vtu, "input_index"), i64::from_le_bytes);
    assert_eq!(inputs, [0, -1, 4_294_967_295, -1]);
    for (name, angle) in [("min_angle", 45.0), ("max_angle", 90.0)] {
        for found in words(&array(&vtu, name), f64::from_le_bytes) {
            assert!((found - angle).abs() < 1e-12, "{name} {found}");
        }
    }
}

#[test]
fn ron_is_a_mesh_with_a_certificate() {
    let mesh = squares(1);
    let certificate = ("every angle", 43.9);
    let view = MeshView::new(&mesh).with_certificate(&certificate);
    let ron = text(MeshFormat::Ron, &view);
    assert_eq!(ron::from_str::<TriMesh>(&ron).unwrap(), mesh);
    assert!(ron.contains("certificate: Some((\"every angle\", 43.9))"), "{ron}");
    assert!(ron.contains("    triangles: [\n        (0, 1, 3),\n"), "{ron}");
}

#[test]
fn ron_that_is_no_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.ron");
    let read = |text: &[u8]| {
        fs::write(&path, text).unwrap();
        read_mesh(&path).unwrap_err()
    };
    let error = read(b"(\n  vertices: [(0, 0)],\n  triangles: [(0, 0)],\n)");
    assert!(matches!(error, ReadError::Ron { line: 3, .. }), "{error:?}");
    let error = read(b"(\n  vertices: [(0, 0)],\n  triangles: [(0, 0, 1)],\n)");
    assert!(matches!(error, ReadError::IndexOutOfRange { index: 1, points: 1, .. }), "{error:?}");
    let error = read(b"(vertices: [(0, 0), (1, inf)], triangles: [])");
    assert!(matches!(error, ReadError::NonFinite { index: 1, .. }), "{error:?}");
    assert_eq!(error.line(), None);
    let error = read(b"(\n\nvertices: \xff");
    assert!(matches!(error, ReadError::NotUtf8 { line: 3, .. }), "{error:?}");
    let error = read(b"");
    assert!(matches!(error, ReadError::Ron { line: 1, .. }), "{error:?}");
    let deep = "(".repeat(1_000_000);
    let error = read(deep.as_bytes());
    assert!(matches!(error, ReadError::Ron { .. }), "{error:?}");
}

#[cfg(feature = "plot")]
#[test]
fn pictures_are_those_of_the_plot() {
    use hexdel_plot::{ColourBy, Plot, PlotError};

    let mesh = squares(3);
    let indices: Vec<_> = (0..16).map(|i| (i < 9).then_some(i)).collect();
    let (regions, edge) = ([2.0; 18], |a, b| MarkedEdge { ends: [a, b].map(VertexId::new), marker: 3 });
    let edges = [edge(0, 5), edge(5, 10)];
    let mut view =
        MeshView::new(&mesh).with_input_indices(&indices).with_regions(&regions).with_marked_edges(&edges);
    view.picture.colour_by = ColourBy::Region;
    let plot = Plot::new(&mesh)
        .with_input_indices(&indices)
        .with_regions(&regions)
        .with_marked_edges(&edges)
        .with_picture(view.picture);
    let mut drawn = Vec::new();
    plot.write_svg(&mut drawn).unwrap();
    assert_eq!(text(MeshFormat::Svg, &view).as_bytes(), drawn);

    view.regions = None;
    let error = write_mesh_to(&mut Vec::new(), MeshFormat::Svg, &view, "s").unwrap_err();
    assert!(matches!(error, WriteError::Picture { source: PlotError::NoRegions, .. }), "{error:?}");
    assert_eq!(error.to_string(), "s: the mesh has no regions to colour triangles by");
    assert_eq!(error.renamed("t").to_string(), "t: the mesh has no regions to colour triangles by");
    // Nothing is left behind.
    let folder = tempfile::tempdir().unwrap();
    write_mesh(folder.path().join("m.svg"), &view).unwrap_err();
    assert!(names(folder.path()).is_empty());
}
