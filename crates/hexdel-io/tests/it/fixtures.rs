//! Reads the files under `fixtures/`, at the root of the workspace.

use std::path::{Path, PathBuf};

use hexdel_geom::{DVec2, Region, VertexId};
use hexdel_io::{ReadError, read_mesh, read_points};

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(name)
}

#[test]
fn point_sets_have_their_points() {
    for (name, count, last) in [
        ("two_close", 2, [0.01, 0.0]),
        ("line100", 100, [0.980_737_199_801_238_6, 0.5]),
        ("plane100", 100, [0.283_462_464_702_365_47, 0.487_423_395_084_577_66]),
        ("capitals", 243, [179.216_647_1, -8.516_652]),
    ] {
        let pslg = read_points(fixture(&format!("points/{name}.node"))).unwrap();
        assert_eq!(pslg.points.len(), count, "{name}");
        assert_eq!(pslg.points[count - 1], DVec2::from(last), "{name}");
        assert!(pslg.segments.is_empty() && pslg.point_markers.is_empty());
    }
}

#[test]
fn poly_with_everything() {
    let pslg = read_points(fixture("formats/plate.poly")).unwrap();
    assert_eq!(pslg.check_layout(), Ok(()));
    assert_eq!(pslg.points.len(), 8);
    assert_eq!(pslg.points[6], DVec2::new(40.0, 30.0));
    assert_eq!(pslg.attributes(3), [21.0]);
    assert_eq!(pslg.attributes(7), [-40.0]);
    assert_eq!(pslg.point_markers, [5, 5, 5, 5, 33, 33, 33, 33]);
    assert_eq!(pslg.segments.len(), 9);
    assert_eq!(pslg.segments[3], [3, 0]);
    assert_eq!(pslg.segments[8], [0, 4]);
    assert_eq!(pslg.segment_markers, [5, 5, 5, 5, 33, 33, 33, 33, -7]);
    assert_eq!(pslg.holes, [DVec2::new(30.0, 20.0)]);
    let region = |x, y, attribute, max_area| Region { point: DVec2::new(x, y), attribute, max_area };
    assert_eq!(
        pslg.regions,
        [region(1.0, 20.0, 1.5, Some(0.25)), region(59.0, 20.0, 2.0, None), region(30.0, 1.0, 3.0, None),]
    );
}

#[test]
fn poly_with_its_points_beside() {
    let pslg = read_points(fixture("formats/outline.poly")).unwrap();
    assert_eq!(pslg.points.len(), 4);
    assert_eq!(pslg.point_markers, [1, 1, 0, 1]);
    assert_eq!(pslg.segments, [[0, 1], [1, 2], [2, 3], [3, 0]]);
    assert!(pslg.segment_markers.is_empty());
}

#[test]
fn poly_without_its_points_beside_names_the_missing_file() {
    let folder = tempfile::tempdir().unwrap();
    let poly = folder.path().join("lonely.poly");
    std::fs::copy(fixture("formats/outline.poly"), &poly).unwrap();
    match read_points(&poly).unwrap_err() {
        ReadError::Missing { file } => assert!(file.ends_with("lonely.node"), "{file}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn mesh_pair_by_either_name() {
    for name in ["formats/fan.node", "formats/fan.ele"] {
        let mesh = read_mesh(fixture(name)).unwrap();
        assert_eq!(mesh.vertices.len(), 5);
        assert_eq!(mesh.vertices[4], DVec2::ONE);
        let corners: Vec<_> = mesh.triangles.iter().map(|t| t.map(VertexId::index)).collect();
        assert_eq!(corners, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]);
    }
}

#[test]
fn tables() {
    let read = |name| read_points(fixture(name)).unwrap().points;
    assert_eq!(read("formats/dos.csv"), [DVec2::new(-95.5555, 33.6609), DVec2::new(2.3522, 48.8566)]);
    assert_eq!(read("formats/survey.xyz")[2], DVec2::new(500_020.5, 4_649_780.0));
    assert!(read("formats/empty.csv").is_empty());
}

#[test]
fn only_comments_is_no_point_file() {
    let error = read_points(fixture("formats/comments.node")).unwrap_err();
    assert!(matches!(error, ReadError::MissingSection { section: "points", .. }), "{error:?}");
}

#[test]
fn missing_files_and_unknown_extensions() {
    let error = read_points("no/such/file.node").unwrap_err();
    assert!(matches!(error, ReadError::Missing { .. }), "{error:?}");
    assert!(error.to_string().starts_with("no/such/file.node: "), "{error}");
    for name in ["a.xls", "node", "a", "", "a.vtp"] {
        let error = read_points(name).unwrap_err();
        assert!(matches!(error, ReadError::UnknownExtension { .. }), "{error:?}");
        let error = read_mesh(name).unwrap_err();
        assert!(matches!(error, ReadError::UnknownExtension { .. }), "{error:?}");
    }
    // A folder opens, but cannot be read.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("folder.csv");
    std::fs::create_dir(&path).unwrap();
    let error = read_points(&path).unwrap_err();
    assert!(matches!(error, ReadError::Io { .. }), "{error:?}");
}

/// As pyshp writes them.
#[cfg(feature = "shapefile")]
mod shapefiles {
    use super::*;
    use hexdel_io::{PointFormat, PointReader, read_points_from};

    #[test]
    fn rings_are_put_together() {
        let pslg = read_points(fixture("formats/areas.shp")).unwrap();
        let shapes: Vec<_> = pslg.polygons.iter().map(|p| (p.attribute, p.rings.len())).collect();
        assert_eq!(shapes, [(1.0, 2), (1.0, 2), (3.0, 1)]);
        let corner = |polygon: usize, ring: usize| {
            let first = pslg.segments[pslg.polygons[polygon].rings[ring][0] as usize];
            pslg.points[first[0] as usize]
        };
        // Each hole in the island that is around it; the record between is empty.
        assert_eq!([corner(0, 1), corner(1, 1)], [DVec2::ONE, DVec2::new(7.0, 1.0)]);
        // The sides that the last square shares with the islands are there once, where they are whole.
        assert_eq!((pslg.points.len(), pslg.segments.len()), (18, 20));
    }

    #[test]
    fn third_coordinates_are_heights() {
        for (name, heights) in [("soundings", vec![-1.5, -2.0, -7.25]), ("rivers", vec![1.0, 2.0, 3.0, 4.0])]
        {
            let file = PointReader::new().read(fixture(&format!("formats/{name}.shp"))).unwrap();
            assert_eq!((file.height_attribute, file.pslg.point_attributes), (Some(0), heights));
            assert_eq!(file.pslg.segments.len(), if name == "rivers" { 3 } else { 0 });
        }
    }

    #[test]
    fn faults_name_their_record() {
        let bytes = std::fs::read(fixture("formats/soundings.shp")).unwrap();
        let error =
            |bytes: &[u8]| read_points_from(bytes, PointFormat::Shapefile, "f").unwrap_err().to_string();
        assert!(error(&bytes[..200]).starts_with("f: record 3: "), "{}", error(&bytes[..200]));
        assert!(error(b"x,y\n1,2\n").starts_with("f: "));
        let mut infinite = bytes;
        infinite[112..120].copy_from_slice(&f64::INFINITY.to_le_bytes());
        assert_eq!(error(&infinite), "f: coordinate inf of record 1 is not finite");
    }
}
