//! What is written reads back to the same bits.

use hexdel_geom::{DVec2, Pslg, Region, TriMesh, VertexId};
use hexdel_io::{MeshView, read_mesh, read_points, write_mesh, write_points};
use proptest::collection::vec;
use proptest::prelude::*;

/// Finite doubles of all magnitudes, among them the awkward ones.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |c| c.is_finite()),
        -1.0..1.0,
        proptest::sample::select(vec![
            0.0,
            -0.0,
            f64::from_bits(1),
            -f64::from_bits(1),
            f64::MIN_POSITIVE,
            f64::MIN_POSITIVE.next_down(),
            1e308,
            f64::MAX,
            f64::MIN,
            1.0f64.next_up(),
            0.1,
            1e16,
            123_456_789_012_345_680.0,
            5e-324,
        ]),
    ]
}

fn position() -> impl Strategy<Value = DVec2> {
    [coordinate(), coordinate()].prop_map(DVec2::from)
}

fn mesh() -> impl Strategy<Value = TriMesh> {
    vec(position(), 1..40).prop_flat_map(|vertices| {
        let id = (0..vertices.len()).prop_map(VertexId::new);
        let triangles = vec([id.clone(), id.clone(), id], 0..60);
        triangles.prop_map(move |triangles| TriMesh { vertices: vertices.clone(), triangles })
    })
}

/// Each array is complete or empty, as [`Pslg::check_layout`] demands.
fn pslg() -> impl Strategy<Value = Pslg> {
    let counts = (1usize..30, 0usize..30, 0usize..3, any::<[bool; 2]>());
    counts.prop_flat_map(|(n, m, attributes, [marked, edge_marked])| {
        let end = 0..n as u32;
        let region = (position(), coordinate(), proptest::option::of(1e-9..1e9));
        let parts = (
            vec(position(), n),
            vec([end.clone(), end], m),
            vec(any::<i32>(), if marked { n } else { 0 }),
            vec(any::<i32>(), if edge_marked { m } else { 0 }),
            vec(coordinate(), n * attributes),
            vec(position(), 0..4),
            vec(region, 0..4),
        );
        parts.prop_map(move |p| Pslg {
            points: p.0,
            segments: p.1,
            point_markers: p.2,
            segment_markers: p.3,
            point_attributes: p.4,
            attributes_per_point: attributes,
            holes: p.5,
            regions: p.6.into_iter().map(region_of).collect(),
            polygons: Vec::new(),
        })
    })
}

fn region_of((point, attribute, max_area): (DVec2, f64, Option<f64>)) -> Region {
    Region { point, attribute, max_area }
}

/// Unlike `==`, tells -0.0 from 0.0.
fn bits(points: &[DVec2]) -> Vec<[u64; 2]> {
    points.iter().map(|p| [p.x.to_bits(), p.y.to_bits()]).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn meshes(mesh in mesh(), inputs in any::<bool>(), extension in "node|ele|ron") {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(format!("m.{extension}"));
        let indices: Vec<_> = (0..mesh.vertices.len() as u32)
            .map(|i| (i % 3 > 0).then_some(u32::MAX - i))
            .collect();
        let mut view = MeshView::new(&mesh);
        if inputs {
            view = view.with_input_indices(&indices);
        }
        write_mesh(&path, &view).unwrap();
        let back = read_mesh(&path).unwrap();
        prop_assert_eq!(bits(&back.vertices), bits(&mesh.vertices));
        prop_assert_eq!(back.triangles, mesh.triangles);
    }

    #[test]
    fn graphs(pslg in pslg()) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("g.poly");
        write_points(&path, &pslg).unwrap();
        let back = read_points(&path).unwrap();
        prop_assert_eq!(bits(&back.points), bits(&pslg.points));
        prop_assert_eq!(bits(&back.holes), bits(&pslg.holes));
        prop_assert_eq!(back, pslg);
    }

    #[test]
    fn point_sets(points in vec(position(), 0..40), extension in "node|csv|tsv|xyz|txt|pts") {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(format!("p.{extension}"));
        write_points(&path, &Pslg::from_points(points.clone())).unwrap();
        let back = read_points(&path).unwrap();
        prop_assert_eq!(bits(&back.points), bits(&points));
    }
}

#[test]
fn input_indices_are_the_attribute_of_nodes() {
    let mesh = TriMesh {
        vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
        triangles: vec![[0, 1, 2].map(VertexId::new)],
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.ele");
    let view = MeshView::new(&mesh).with_input_indices(&[Some(4), None, Some(u32::MAX)]);
    write_mesh(&path, &view).unwrap();
    let nodes = read_points(path.with_extension("node")).unwrap();
    assert_eq!(nodes.attributes_per_point, 1);
    assert_eq!(nodes.point_attributes, [4.0, -1.0, 4_294_967_295.0]);
}

#[test]
fn attributes_that_are_not_finite_survive() {
    let pslg = Pslg {
        point_attributes: vec![f64::INFINITY, f64::NEG_INFINITY, f64::NAN],
        attributes_per_point: 3,
        ..Pslg::from_points(vec![DVec2::ONE])
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.node");
    write_points(&path, &pslg).unwrap();
    let back = read_points(&path).unwrap().point_attributes;
    assert_eq!(back[..2], pslg.point_attributes[..2]);
    assert!(back[2].is_nan());
}
