//! Every format that is written is read back: all pairs of formats, bit for bit, as
//! far as the formats carry what there is.

use crate::support;
use hexdel_geom::{AngleBounds, DVec2, Pslg, Region, TriMesh, VertexId};
use hexdel_io::{
    MarkedEdge, MeshData, MeshFormat, PointFormat, PointReader, Promised, PromisedDomain, ReadError,
    WriteError, read_mesh_data, read_mesh_from, read_points, read_points_from, write_mesh, write_mesh_to,
    write_points, write_points_to,
};
use proptest::prelude::*;

/// What a format carries beside the triangles.
type Carries = &'static [&'static str];

const NOTHING: Carries = &[];
const NO_EDGES: Carries = &["inputs", "markers", "regions", "promised"];
const VTU: Carries = &["inputs", "markers", "regions", "promised", "heights"];
const NO_HEIGHTS: Carries = &["inputs", "markers", "regions", "edges", "promised"];
const NO_INPUTS: Carries = &["markers", "regions", "edges"];
const ALL: Carries = &["inputs", "markers", "regions", "edges", "promised", "heights"];

/// Every format that is written and read, by the extension it has here.
const MESHES: [(MeshFormat, &str, Carries); 9] = [
    (MeshFormat::NodeEle, "ele", NO_EDGES),
    (MeshFormat::Vtu, "vtu", VTU),
    (MeshFormat::Msh41, "msh", NO_HEIGHTS),
    (MeshFormat::Msh22, "msh2", NO_HEIGHTS),
    (MeshFormat::Obj, "obj", NOTHING),
    (MeshFormat::Off, "off", NOTHING),
    (MeshFormat::Medit, "mesh", NO_INPUTS),
    (MeshFormat::Json, "json", ALL),
    (MeshFormat::Ron, "ron", ALL),
];

/// Coordinates that show whether every bit is kept.
const AWKWARD: [f64; 12] = [
    0.1,
    -0.0,
    5e-324,
    f64::MAX,
    -f64::MIN_POSITIVE,
    1e308,
    123_456_789_012_345_680.0,
    0.333_333_333_333_333_3,
    -7.0,
    1e16,
    2.5e-8,
    1.0 + f64::EPSILON,
];

/// A mesh with everything, its regions integers or not.
fn sample(integers: bool) -> MeshData {
    let at = |i: usize| DVec2::new(AWKWARD[i % 12], AWKWARD[(5 * i + 3) % 12]);
    let triangles = [[0, 1, 2], [2, 1, 3], [4, 3, 1], [5, 6, 0], [7, 0, 6]];
    let mut data = MeshData::new(TriMesh {
        vertices: (0..8).map(at).collect(),
        triangles: triangles.map(|t| t.map(VertexId::new)).to_vec(),
    });
    data.input_indices = Some(vec![None, Some(3), Some(0), Some(u32::MAX), None, Some(7), Some(5), Some(4)]);
    data.vertex_markers = Some(vec![0, 1, -5, i32::MAX, i32::MIN, 2, 0, 7]);
    data.heights = Some((0..8).map(|i| AWKWARD[(i + 1) % 12]).collect());
    let regions = [3.0, 0.0, -2.0, 3.0, 2_147_483_647.0];
    data.regions = Some(if integers { regions.to_vec() } else { regions.map(|r| r + 0.1).to_vec() });
    let edge = |a, b, marker| MarkedEdge { ends: [VertexId::new(a), VertexId::new(b)], marker };
    data.marked_edges = Some(vec![edge(3, 1, 4), edge(0, 1, 0), edge(2, 0, -3), edge(6, 7, 4)]);
    let near = AngleBounds::new(30.0, 90.0).unwrap();
    let (far, domain) = (AngleBounds::EXTENDED, PromisedDomain::Box);
    data.promised = Some(Promised { near, far, domain, exempt: vec![1, 4] });
    data
}

/// What is left of `data` in a format.
fn carried(data: &MeshData, carries: Carries) -> MeshData {
    let mut left = data.clone();
    left.input_indices.take_if(|_| !carries.contains(&"inputs"));
    left.vertex_markers.take_if(|_| !carries.contains(&"markers"));
    left.regions.take_if(|_| !carries.contains(&"regions"));
    left.heights.take_if(|_| !carries.contains(&"heights"));
    left.promised.take_if(|_| !carries.contains(&"promised"));
    left.marked_edges.take_if(|_| !carries.contains(&"edges"));
    left
}

fn assert_same(found: &MeshData, expected: &MeshData, name: &str) {
    let bits = |data: &MeshData| -> Vec<[u64; 2]> {
        data.mesh.vertices.iter().map(|p| [p.x.to_bits(), p.y.to_bits()]).collect()
    };
    assert_eq!(bits(found), bits(expected), "{name}");
    assert_eq!(found, expected, "{name}");
}

#[test]
fn every_pair_of_mesh_formats() {
    let folder = tempfile::tempdir().unwrap();
    for (first, extension, carries) in MESHES {
        for integers in [true, false] {
            let data = sample(integers);
            let path = folder.path().join("first").with_extension(extension);
            assert_eq!(MeshFormat::from_path(&path), Some(first));
            if first == MeshFormat::Medit && !integers {
                let error = write_mesh(&path, &data.view()).unwrap_err();
                assert!(matches!(error, WriteError::Unrepresentable { index: 0, .. }), "{error:?}");
                continue;
            }
            write_mesh(&path, &data.view()).unwrap();
            let read = read_mesh_data(&path).unwrap();
            assert_same(&read, &carried(&data, carries), extension);
            for (second, extension, carries) in MESHES {
                if second == MeshFormat::Medit && !integers && read.regions.is_some() {
                    continue;
                }
                let path = folder.path().join("second").with_extension(extension);
                write_mesh(&path, &read.view()).unwrap();
                let again = read_mesh_data(&path).unwrap();
                assert_same(&again, &carried(&read, carries), &format!("{} to {extension}", first.name()));
                if second == MeshFormat::NodeEle {
                    continue;
                }
                let mut stream = Vec::new();
                write_mesh_to(&mut stream, second, &read.view(), "stream").unwrap();
                assert_eq!(stream, std::fs::read(&path).unwrap());
                assert_eq!(read_mesh_from(&stream[..], second, "stream").unwrap(), again);
            }
        }
    }
}

#[test]
fn meshes_of_nothing() {
    let mut point = MeshData::default();
    point.mesh.vertices.push(DVec2::X);
    for data in [MeshData::default(), point] {
        for (format, name, _) in MESHES.iter().filter(|(format, ..)| *format != MeshFormat::NodeEle) {
            let mut stream = Vec::new();
            write_mesh_to(&mut stream, *format, &data.view(), name).unwrap();
            assert_eq!(read_mesh_from(&stream[..], *format, name).unwrap(), data);
        }
    }
}

#[test]
fn formats_of_one_direction_say_so() {
    let data = sample(true);
    for format in MeshFormat::names().filter_map(MeshFormat::from_name).filter(|format| !format.is_read()) {
        write_mesh_to(&mut Vec::new(), format, &data.view(), "s").unwrap();
        let error = read_mesh_from(&b""[..], format, "s").unwrap_err();
        assert!(matches!(error, ReadError::WriteOnly { .. }), "{error:?}");
    }
    let error = read_mesh_from(&b""[..], MeshFormat::NodeEle, "s").unwrap_err();
    assert_eq!(error.to_string(), "s: the format .node/.ele takes two files");
    for name in ["wkt", "cgshop", "2dm", "14"] {
        let format = PointFormat::from_name(name).unwrap();
        let error = write_points_to(&mut Vec::new(), format, &Pslg::default(), "s").unwrap_err();
        assert!(matches!(error, WriteError::ReadOnly { .. }), "{error:?}");
    }
}

/// A PSLG with everything.
fn graph() -> Pslg {
    let at = |i: usize| DVec2::new(AWKWARD[i % 12], AWKWARD[(7 * i + 1) % 12]);
    Pslg {
        segments: vec![[0, 1], [1, 2], [2, 0], [3, 4]],
        holes: vec![at(9)],
        regions: vec![
            Region { point: at(10), attribute: 1.5, max_area: None },
            Region { point: at(11), attribute: -2.0, max_area: Some(0.1) },
        ],
        point_markers: vec![1, 2, i32::MIN, i32::MAX, 0],
        segment_markers: vec![4, -1, 0, 2],
        point_attributes: (0..10).map(|i| AWKWARD[i]).collect(),
        attributes_per_point: 2,
        ..Pslg::from_points((0..5).map(at).collect())
    }
}

#[test]
fn every_pair_of_graph_formats() {
    let points_only = Pslg::from_points(graph().points);
    let no_segments = Pslg {
        segments: Vec::new(),
        segment_markers: Vec::new(),
        holes: Vec::new(),
        regions: Vec::new(),
        ..graph()
    };
    let formats = ["poly", "json", "ron", "node", "csv", "tsv", "xyz", "txt", "pts"];
    let left = |format: &str| match format {
        "poly" | "json" | "ron" => graph(),
        "node" => no_segments.clone(),
        _ => points_only.clone(),
    };
    let folder = tempfile::tempdir().unwrap();
    for first in formats {
        let path = folder.path().join("first").with_extension(first);
        write_points(&path, &left(first)).unwrap();
        let read = read_points(&path).unwrap();
        assert_eq!(read, left(first), "{first}");
        for second in formats {
            let path = folder.path().join("second").with_extension(second);
            let write = write_points(&path, &read);
            if !read.segments.is_empty() && !["poly", "json", "ron"].contains(&second) {
                assert!(matches!(write, Err(WriteError::PointsOnly { .. })));
                continue;
            }
            write.unwrap();
            let expected =
                if ["poly", "json", "ron", "node"].contains(&second) { &read } else { &points_only };
            assert_eq!(read_points(&path).unwrap(), *expected, "{first} to {second}");
            let format = PointFormat::from_name(second).unwrap();
            let mut stream = Vec::new();
            write_points_to(&mut stream, format, &read, "stream").unwrap();
            assert_eq!(read_points_from(&stream[..], format, "stream").unwrap(), *expected);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn coordinates_keep_their_bits(raw in proptest::collection::vec(any::<[f64; 2]>(), 0..20)) {
        let vertices = raw.into_iter().map(DVec2::from).filter(|p| p.is_finite()).collect();
        let data = MeshData::new(TriMesh { vertices, triangles: Vec::new() });
        for (format, name, _) in MESHES.iter().filter(|(format, ..)| *format != MeshFormat::NodeEle) {
            let mut stream = Vec::new();
            write_mesh_to(&mut stream, *format, &data.view(), name).unwrap();
            assert_same(&read_mesh_from(&stream[..], *format, name).unwrap(), &data, name);
        }
    }
}

/// Nodes have any numbers there and edges only a place on the boundary, so that these formats have tests of
/// their own.
#[test]
fn grids_of_hydrodynamics() {
    let mut data = MeshData::new(support::squares(2));
    data.heights = Some((0..9).map(|i| AWKWARD[i]).collect());
    data.regions = Some(vec![1.0, 2.0, 3.0, -4.0, 1.0, 1.0, 1.0, 1.0]);
    let edge = |a, b, marker| MarkedEdge { ends: [VertexId::new(a), VertexId::new(b)], marker };
    // The lower side is open, in two parts; the upper is marked, the left against its direction, one edge inside.
    data.marked_edges =
        Some(vec![edge(0, 1, -1), edge(1, 2, -2), edge(8, 7, 7), edge(0, 3, 9), edge(4, 5, 1)]);
    let again = |data: &MeshData, format| {
        let mut stream = Vec::new();
        write_mesh_to(&mut stream, format, &data.view(), "s").unwrap();
        read_mesh_from(&stream[..], format, "s").unwrap()
    };
    let sms = again(&data, MeshFormat::TwoDm);
    let strings = vec![edge(0, 1, -1), edge(1, 2, -2), edge(8, 7, 7), edge(3, 0, 9)];
    let mut expected = data.clone();
    expected.marked_edges = Some(strings);
    assert_same(&sms, &expected, "2dm");
    assert_same(&again(&sms, MeshFormat::TwoDm), &sms, "2dm again");
    let adcirc = again(&data, MeshFormat::Fort14);
    let land = [edge(2, 5, 1), edge(5, 8, 1), edge(8, 7, 2), edge(7, 6, 3), edge(6, 3, 3), edge(3, 0, 4)];
    let edges = [&[edge(0, 1, -1), edge(1, 2, -2)][..], &land].concat();
    (expected.marked_edges, expected.regions) = (Some(edges), None);
    assert_same(&adcirc, &expected, "14");
    assert_same(&again(&adcirc, MeshFormat::Fort14), &adcirc, "14 again");
    // As points.
    for format in [PointFormat::TwoDm, PointFormat::Fort14] {
        let mut stream = Vec::new();
        write_mesh_to(&mut stream, MeshFormat::from_name(format.name()).unwrap(), &data.view(), "s").unwrap();
        let file = PointReader::new().read_from(&stream[..], format, "s").unwrap();
        assert_eq!((file.pslg.points, file.height_attribute), (data.mesh.vertices.clone(), Some(0)));
        assert_eq!(Some(file.pslg.point_attributes), data.heights);
    }
    data.regions = Some(vec![0.5; 8]);
    let error = write_mesh_to(&mut Vec::new(), MeshFormat::TwoDm, &data.view(), "s").unwrap_err();
    assert_eq!(error.to_string(), "s: region of triangle 0 is 0.5, which the format .2dm cannot hold");
}

#[test]
fn polygons_are_read_as_a_graph() {
    let mut data = MeshData::new(support::squares(2));
    for heights in [None, Some((0..9).map(|i| AWKWARD[i]).collect::<Vec<_>>())] {
        data.heights = heights;
        for format in [PointFormat::GeoJson, PointFormat::Wkt] {
            let mut stream = Vec::new();
            write_mesh_to(&mut stream, MeshFormat::from_name(format.name()).unwrap(), &data.view(), "s")
                .unwrap();
            let file = PointReader::new().read_from(&stream[..], format, "s").unwrap();
            assert_eq!((file.pslg.polygons.len(), file.pslg.segments.len()), (8, 16));
            for (p, &z) in file.pslg.points.iter().zip(&file.pslg.point_attributes) {
                let vertex = data.mesh.vertices.iter().position(|v| v == p).unwrap();
                assert_eq!(data.heights.as_ref().map(|heights| heights[vertex]), Some(z));
            }
            assert_eq!(file.height_attribute.is_some(), data.heights.is_some());
        }
    }
}

#[test]
fn netcdf_has_no_meshes_of_nothing() {
    let error = |data: &MeshData| {
        write_mesh_to(&mut Vec::new(), MeshFormat::Ugrid, &data.view(), "s").unwrap_err().to_string()
    };
    let mut data = MeshData::default();
    assert_eq!(error(&data), "s: NetCDF-3 cannot hold a mesh without vertices");
    data.mesh.vertices.push(DVec2::X);
    assert_eq!(error(&data), "s: NetCDF-3 cannot hold a mesh without triangles");
    data.heights = Some(vec![f64::NAN]);
    let error = write_mesh_to(&mut Vec::new(), MeshFormat::Vtu, &data.view(), "s").unwrap_err();
    assert_eq!(error.to_string(), "s: height of vertex 0 is NaN, which a mesh cannot hold");
}

#[test]
fn edges_and_neighbours() {
    let mut data = sample(true);
    let text = |data: &MeshData, format| {
        let mut stream = Vec::new();
        write_mesh_to(&mut stream, format, &data.view(), "s").unwrap();
        String::from_utf8(stream).unwrap()
    };
    // Triangle 1 has the corners 2 1 3: opposite to 2 is the edge 1 3 of triangle 2,
    // opposite to 3 the edge 2 1 of triangle 0. Triangles 3 and 4 share the edge 6 0.
    let neighbours = "5 3\n0 1 -1 -1\n1 2 -1 0\n2 1 -1 -1\n3 4 -1 -1\n4 3 -1 -1\n";
    assert_eq!(text(&data, MeshFormat::Neigh), neighbours);
    let edges = text(&data, MeshFormat::Edge);
    assert!(edges.starts_with("12 1\n0 0 1 0\n"), "{edges}");
    assert!(
        edges.contains(" 1 3 4\n") && edges.contains(" 6 7 4\n") && edges.contains(" 0 6 0\n"),
        "{edges}"
    );
    data.marked_edges = None;
    let edges = text(&data, MeshFormat::Edge);
    assert!(edges.contains(" 1 3 0\n") && edges.contains(" 6 7 1\n"), "{edges}");
    let poly = read_points_from(text(&data, MeshFormat::Poly).as_bytes(), PointFormat::Poly, "p").unwrap();
    assert_eq!(poly.points, data.mesh.vertices);
    assert_eq!(poly.segments.len(), 9);
    assert!(poly.segment_markers.iter().all(|&m| m == 1));
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    for (format, name, _) in MESHES {
        let data = sample(true);
        let mut bytes = b"\xef\xbb\xbf".to_vec();
        // The coordinates of a .node are in a stream of their own.
        if format != MeshFormat::NodeEle {
            write_mesh_to(&mut bytes, format, &data.view(), "stream").unwrap();
            let found = read_mesh_from(&bytes[..], format, "stream").unwrap();
            assert_eq!(found.mesh, data.mesh, "{name}");
        }
    }
}
