//! What the tests of the facade share: the fixtures, and what every finished
//! mesh is held to.

#![allow(dead_code, reason = "each test binary uses its own part")]

use hexdel::geom::{CertifyOptions, certify};
use hexdel::{DVec2, Method, Pslg, TriMesh, Triangulation, VertexId};
use std::path::{Path, PathBuf};

/// All methods, with the names they have in snapshots.
pub(crate) const METHODS: [(Method, &str); 3] =
    [(Method::Templates, "templates"), (Method::Simple, "simple"), (Method::Compact, "compact")];

/// `R / (2 rho)` of the right triangle with the smallest angle allowed, rounded
/// up (paper, section 6.2).
pub(crate) const ASPECT_TEMPLATES: f64 = 1.207_88;

/// The same of the triangle with angles 30, 30 and 120 degrees.
pub(crate) const ASPECT_SIMPLE: f64 = 2.154_71;

/// Folders of point sets, below `fixtures/`.
const FOLDERS: [&str; 2] = ["points", "regressions"];

/// A point set of the fixtures.
pub(crate) struct Fixture {
    /// Folder and file name without extension, joined by a hyphen.
    pub(crate) name: String,
    /// Path below the workspace's folder.
    pub(crate) path: String,
    pub(crate) points: Vec<DVec2>,
}

/// The workspace's folder.
pub(crate) fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).expect("the crate lies two folders deep").to_owned()
}

/// All point sets, in the order of their names.
pub(crate) fn fixtures() -> Vec<Fixture> {
    let mut all: Vec<Fixture> = FOLDERS.into_iter().flat_map(in_folder).collect();
    all.sort_by(|a, b| a.name.cmp(&b.name));
    all
}

/// The fixture `fixtures/points/<name>.node`.
pub(crate) fn points(name: &str) -> Vec<DVec2> {
    let path = root().join("fixtures/points").join(name).with_extension("node");
    hexdel::io::read_points(path).unwrap().points
}

/// The PSLG `fixtures/graphs/<name>.poly`.
pub(crate) fn graph(name: &str) -> Pslg {
    let path = root().join("fixtures/graphs").join(name).with_extension("poly");
    hexdel::io::read_points(path).unwrap()
}

/// All PSLGs with their names, in their order.
pub(crate) fn graphs() -> Vec<(String, Pslg)> {
    let entries = std::fs::read_dir(root().join("fixtures/graphs")).unwrap();
    let names = entries.map(|e| e.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names.into_iter().map(|name| (name.clone(), graph(&name))).collect()
}

fn in_folder(folder: &str) -> Vec<Fixture> {
    let entries = std::fs::read_dir(root().join("fixtures").join(folder)).unwrap();
    let files = entries.map(|e| e.unwrap().path()).filter(|p| p.extension().is_some_and(|e| e == "node"));
    files
        .map(|file| {
            let stem = file.file_stem().unwrap().to_str().unwrap();
            Fixture {
                name: format!("{folder}-{stem}"),
                path: format!("fixtures/{folder}/{stem}.node"),
                points: hexdel::io::read_points(&file).unwrap().points,
            }
        })
        .collect()
}

/// The distance of the closest two distinct points, by looking at all pairs.
pub(crate) fn closest_distance(points: &[DVec2]) -> Option<f64> {
    let pairs = points.iter().enumerate().flat_map(|(i, p)| points[..i].iter().map(|q| p.distance(*q)));
    pairs.filter(|d| *d > 0.0).min_by(f64::total_cmp)
}

/// Holds a finished mesh to everything that is promised of it, from scratch.
#[track_caller]
pub(crate) fn hold(made: &Triangulation, points: &[DVec2]) {
    let (bounds, aspect) = match made.method {
        Method::Simple => (made.method.bounds(), ASPECT_SIMPLE),
        _ => (made.method.bounds(), ASPECT_TEMPLATES),
    };
    let options = CertifyOptions { bounds, inputs: Some(points), ..CertifyOptions::default() };
    let certificate = certify(&made.mesh, &options);
    assert!(certificate.holds(), "{:?}", certificate.violations);
    assert!(certificate.delaunay && certificate.manifold && certificate.disk);
    // Rounding is granted what the certificate found to be rounding, no more.
    let slack = hexdel::geom::ANGLE_TOLERANCE_DEG + certificate.worst_rounding_excess_deg;
    assert!(certificate.min_angle_deg >= bounds.min_deg() - slack, "{}", certificate.min_angle_deg);
    assert!(certificate.max_angle_deg <= bounds.max_deg() + slack, "{}", certificate.max_angle_deg);
    // Points that are refused would suffer more: 2^-11 radians.
    assert!(slack < 0.028, "rounding takes {slack} degrees");
    // Per degree past a bound the ratio grows by less than a tenth.
    assert!(certificate.max_aspect_ratio <= aspect + 0.1 * slack, "{}", certificate.max_aspect_ratio);
    // The compact method promises nothing of lengths.
    if let Some(distance) = closest_distance(points).filter(|_| made.method != Method::Compact) {
        let shortest = distance * 7.0_f64.sqrt() / (12.0 * 3.0_f64.sqrt());
        assert!(certificate.shortest_edge >= shortest * (1.0 - 1e-9), "{}", certificate.shortest_edge);
    }
    assert_eq!(made.vertex_of_input.len(), points.len());
    for (point, vertex) in points.iter().zip(&made.vertex_of_input) {
        // A negative zero counts as zero where it is a duplicate of one.
        assert_eq!(made.mesh.vertices[vertex.index()], *point);
    }
}

/// Coordinates and corners.
pub(crate) type Bits = (Vec<[u64; 2]>, Vec<[usize; 3]>);

/// The bits of a mesh: equal exactly for equal bytes.
pub(crate) fn bits(made: &Triangulation) -> Bits {
    bits_of(&made.mesh)
}

/// The same of a mesh alone.
pub(crate) fn bits_of(mesh: &TriMesh) -> Bits {
    let vertices = mesh.vertices.iter().map(|v| [v.x.to_bits(), v.y.to_bits()]).collect();
    let triangles = mesh.triangles.iter().map(|t| t.map(VertexId::index)).collect();
    (vertices, triangles)
}
