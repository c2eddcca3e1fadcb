//! Every kind of file that is written is read by a reader that is not ours: meshio, netCDF4,
//! shapely and py2dm, in a virtual environment of Python that is made once below `target/`. Of
//! what these do not know, Triangle's formats, ADCIRC's, MODFLOW's, JSON, RON and pictures, Python
//! itself is the reader.
//!
//! Without Python or a package registry this is skipped, and says so, unless
//! `HEXDEL_REQUIRE_MESHIO` is set: then it fails. There is no test
//! harness around it, which would keep that line to itself.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking, and this one talks")]

use std::path::Path;
use std::process::{Command, ExitCode};

use hexdel_geom::{AngleBounds, DVec2, TriMesh, VertexId, Voronoi};
use hexdel_io::{
    MarkedEdge, MeshData, MeshFormat, MeshView, Promised, PromisedDomain, write_dual, write_mesh,
};

#[path = "support/python.rs"]
mod python;

/// What is installed. A new version must not break an old commit.
const PACKAGES: [&str; 6] =
    ["meshio==5.3.5", "numpy<3", "netCDF4<2", "shapely<3", "py2dm==0.1.1", "typing_extensions<5"];

fn main() -> ExitCode {
    if python::is_asked_for_a_list() {
        return ExitCode::SUCCESS;
    }
    let python = match python::environment(env!("CARGO_TARGET_TMPDIR"), "meshio", &PACKAGES) {
        Ok(python) => python,
        Err(reason) if std::env::var_os("HEXDEL_REQUIRE_MESHIO").is_some() => {
            println!("meshio: required and not there, {reason}");
            return ExitCode::FAILURE;
        }
        Err(reason) => {
            println!("meshio: skipped, {reason}");
            return ExitCode::SUCCESS;
        }
    };
    for integers in [true, false] {
        let folder = tempfile::tempdir().unwrap();
        write_all(folder.path(), integers);
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/read_back.py");
        let found = Command::new(&python).arg(script).arg(folder.path()).output().unwrap();
        print!("meshio: {}", String::from_utf8_lossy(&found.stdout));
        if !found.status.success() {
            println!("failed\n{}", String::from_utf8_lossy(&found.stderr));
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// Vertices in a row of the sample.
const N: usize = 7;

/// Writes a mesh with everything in every format.
fn write_all(folder: &Path, integers: bool) {
    let data = sample(integers);
    // Two names are of versions that share an extension, and two are of one format.
    for name in MeshFormat::names().filter(|name| !["msh4", "medit", "node"].contains(name)) {
        // Regions that are no integers are not for Medit and SMS.
        if integers || !["mesh", "2dm"].contains(&name) {
            write_mesh(folder.join("mesh").with_extension(name), &data.view().with_epsg(25_832)).unwrap();
        }
    }
    // The dual of the same triangles with better angles.
    let mut mesh = data.mesh.clone();
    for (i, p) in mesh.vertices.iter_mut().enumerate() {
        let [x, y] = [i % N, i / N].map(|i| i as f64);
        *p = DVec2::new(0.1 + x - 0.4 * y, 0.9 * y + 0.01 * x * x);
    }
    let dual = Voronoi::new(&mesh).unwrap();
    for name in ["vtu", "geojson", "wkt", "disv", "nc", "mpas.nc"] {
        write_dual(folder.join(format!("dual.{name}")), &MeshView::new(&mesh), &dual).unwrap();
    }
    write_mesh(folder.join("dual.json"), &MeshData::new(mesh).view()).unwrap();
    write_mesh(folder.join("expected.json"), &data.view()).unwrap();
}

/// A grid of bent squares, halved, with coordinates of many digits and magnitudes.
fn sample(integers: bool) -> MeshData {
    let at = |i: usize| {
        let (x, y) = ((i % N) as f64, (i / N) as f64);
        DVec2::new(x / 3.0 - 1e-3 * y * y, y * 1e-7 / 7.0 + x * x * 1e-9)
    };
    let mut vertices: Vec<DVec2> = (0..N * N).map(at).collect();
    vertices.push(DVec2::new(-0.0, 5e-324));
    vertices.push(DVec2::new(-1e300, f64::MAX));
    let mut triangles = Vec::new();
    for i in (0..N * (N - 1)).filter(|i| i % N != N - 1) {
        triangles.extend([[i, i + 1, i + N + 1], [i, i + N + 1, i + N]]);
    }
    let triangles: Vec<_> = triangles.into_iter().map(|t| t.map(VertexId::new)).collect();
    let mut data = MeshData::new(TriMesh { vertices, triangles });
    let count = data.mesh.vertices.len();
    data.input_indices = Some((0..count as u32).map(|i| (i % 3 > 0).then_some(u32::MAX - i)).collect());
    data.vertex_markers = Some((0..count as i32).map(|i| i % 5 - 2).collect());
    data.heights = Some((0..count).map(|i| 0.1 * i as f64 - 1.0).collect());
    let region = |t: usize| (t * t % 4) as f64 + if integers || t.is_multiple_of(2) { 0.0 } else { 0.1 };
    data.regions = Some((0..data.mesh.triangles.len()).map(region).collect());
    let edge = |i: usize| MarkedEdge { ends: [i, i + 1].map(VertexId::new), marker: (i * i % 3) as i32 };
    data.marked_edges = Some((0..N - 1).map(edge).collect());
    let near = AngleBounds::new(30.0, 90.0).unwrap();
    let (far, domain) = (AngleBounds::EXTENDED, PromisedDomain::Box);
    data.promised = Some(Promised { near, far, domain, exempt: vec![1, 4] });
    data
}
