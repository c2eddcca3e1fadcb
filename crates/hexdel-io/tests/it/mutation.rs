//! Readers of damaged files: never a panic, never a hang, never more memory than a
//! file can be worth, and what is read can be written.
//!
//! Well-formed samples of every format are damaged in ways that reach deep into the
//! readers: bytes changed, cut out and doubled, numbers replaced by hostile ones, parts
//! of other samples put in. It is deterministic; `HEXDEL_MUTATIONS` asks for another
//! number of damaged files per format than the few of a test run, and
//! `HEXDEL_MUTATION_SEED` for others. Whatever went wrong once lies in
//! `fixtures/regressions/formats/`, named for the format that reads it.

use std::path::Path;

use hexdel_geom::{DVec2, Pslg, Region, TriMesh, VertexId};
use hexdel_io::{
    MarkedEdge, MeshData, MeshFormat, PointFormat, PointReader, ReadError, holds_mesh, parse_raster,
    parse_sizes, read_mesh_from, read_mesh_pair, read_points_from, write_mesh_to, write_points_to,
};

/// Damaged files per format in a test run: a few seconds in all.
const FILES: u64 = 2_000;

/// A generator of the PCG family, small enough to stand here.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let bits = (((self.0 >> 18) ^ self.0) >> 27) as u32;
        bits.rotate_right((self.0 >> 59) as u32)
    }

    fn below(&mut self, n: usize) -> usize {
        self.next() as usize % n.max(1)
    }
}

/// What to damage: a reader's name and its samples.
struct Target {
    name: &'static str,
    samples: Vec<Vec<u8>>,
}

fn mesh() -> MeshData {
    let vertices = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.5], [0.0, 1.0], [-2.5e-3, 1e300]].map(DVec2::from);
    let mut data = MeshData::new(TriMesh {
        vertices: vertices.to_vec(),
        triangles: [[0, 1, 2], [0, 2, 3], [3, 2, 4]].map(|t| t.map(VertexId::new)).to_vec(),
    });
    data.input_indices = Some(vec![Some(0), None, Some(7), Some(1), None]);
    data.vertex_markers = Some(vec![1, 0, -3, 2, 1]);
    data.heights = Some(vec![0.5, 0.0, -1e3, 7.0, 2.0]);
    data.regions = Some(vec![1.0, 2.5, 0.0]);
    data.marked_edges = Some(vec![
        MarkedEdge { ends: [0, 1].map(VertexId::new), marker: 4 },
        MarkedEdge { ends: [2, 3].map(VertexId::new), marker: 0 },
    ]);
    data
}

fn graph() -> Pslg {
    Pslg {
        segments: vec![[0, 1], [1, 2], [2, 0]],
        holes: vec![DVec2::splat(0.25)],
        regions: vec![Region { point: DVec2::ONE, attribute: 1.5, max_area: Some(0.1) }],
        point_markers: vec![1, 2, 3],
        segment_markers: vec![4, 5, 6],
        point_attributes: vec![0.5, 1.5, 2.5],
        attributes_per_point: 1,
        ..Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y])
    }
}

fn meshed(format: &str) -> Vec<u8> {
    let mut out = Vec::new();
    let mut data = mesh();
    if ["mesh", "2dm"].contains(&format) {
        data.regions = Some(vec![1.0, 2.0, 0.0]);
    }
    write_mesh_to(&mut out, MeshFormat::from_name(format).unwrap(), &data.view(), "s").unwrap();
    out
}

fn pointed(format: &str) -> Vec<u8> {
    let mut out = Vec::new();
    let format = PointFormat::from_name(format).unwrap();
    let plain = Pslg {
        segments: Vec::new(),
        segment_markers: Vec::new(),
        holes: Vec::new(),
        regions: Vec::new(),
        ..graph()
    };
    let graph = if matches!(format, PointFormat::Node | PointFormat::Csv) { plain } else { graph() };
    write_points_to(&mut out, format, &graph, "s").unwrap();
    out
}

const GEOJSON: &str = r#"{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"a": [1, {"b": null}]}, "geometry": {"type": "Polygon", "coordinates":
[[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]], [[3, 3], [6, 3], [6, 6], [3, 6], [3, 3]]]}},
{"type": "Feature", "geometry": {"type": "MultiPolygon", "coordinates": [[[[3, 3], [6, 3], [6, 6], [3, 3]]]]}},
{"type": "Feature", "geometry": {"type": "GeometryCollection", "geometries": [
{"type": "Point", "coordinates": [1.5, -2e3, 7]}, {"type": "LineString", "coordinates": [[1, 2], [3, 4]]}]}}]}"#;

const WKT: &str = "SRID=4326;POLYGON Z ((0 0 1, 9 0 1, 9 9 1, 0 9 1, 0 0 1), (3 3 1, 6 3 1, 6 6 1, 3 3 1))\n\
MULTIPOINT (1 2, (3 4)); GEOMETRYCOLLECTION (POINT (1 2), LINESTRING EMPTY, TIN (((0 0, 1 0, 0 1, 0 0))))";

const CGSHOP: &str = r#"{"content_type": "CG_SHOP_2025_Instance", "num_points": 4, "points_x": [0, 5, 5, 0],
"points_y": [0, 0, 5, 5.5], "region_boundary": [0, 1, 2, 3], "additional_constraints": [[0, 2]]}"#;

const OBJ: &str = "# a\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0.0\nvt 0 0\ng b\nf 1/1 2/1/1 3//1\nf -3 -2 -1\n";

const VTU: [&str; 2] = [
    "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\" byte_order=\"BigEndian\"><UnstructuredGrid>\
<Piece NumberOfPoints=\"3\" NumberOfCells=\"2\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" \
format=\"ascii\">0 0 0 1 0 0\n0 1 0</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\">\
0 1 2 0 1</DataArray><DataArray type=\"Int32\" Name=\"offsets\">3 5</DataArray><DataArray type=\"UInt8\" \
Name=\"types\">5 3</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>",
    // Points 0 0 0 1 0 0 as Float32 and one array of indices, appended in base64.
    "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt32\"><UnstructuredGrid><Piece>\n\
<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points>\
<PointData><DataArray type=\"Int8\" Name=\"marker\" format=\"appended\" offset=\"40\"/></PointData></Piece>\
</UnstructuredGrid><AppendedData encoding=\"base64\">\n_GAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAA==AgAAAAEC\n</AppendedData></VTKFile>",
];

const MSH: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\na $b\n$EndComments\n$Entities\n1 1 1 0\n\
1 0 0 0 1 9\n1 0 0 0 1 1 0 1 5 2 1 -1\n2 0 0 0 1 1 0 2 7 8 1 1\n$EndEntities\n$Nodes\n2 3 1 9\n0 1 0 1\n9\n0 0 0\n\
2 2 1 2\n4\n5\n1 0 0 0.5 0.5\n0 1 0 0.5 0.5\n$EndNodes\n$Elements\n3 3 1 3\n0 1 15 1\n1 9\n1 1 1 1\n2 9 4\n2 2 2 1\n\
3 9 4 5\n$EndElements\n";

const RASTER: &str =
    "ncols 3\nnrows 2\nxllcorner 10\nyllcenter -1\ncellsize 4.5\nNODATA_value -9999\n1 2 3\n4 nan -9999\n";

fn targets() -> Vec<Target> {
    let text = |text: &str| text.as_bytes().to_vec();
    let target = |name, samples| Target { name, samples };
    let mut rest: Vec<Target> = Vec::new();
    for name in ["json", "ron"] {
        rest.push(target(name, vec![meshed(name), pointed(name)]));
    }
    rest.extend([
        target("node", vec![pointed("node")]),
        target("poly", vec![pointed("poly")]),
        target("csv", vec![pointed("csv"), text("\"a\";x;Y\nb;\"1\";2\n#c\n;3;4\n")]),
        target("geojson", vec![text(GEOJSON)]),
        target("wkt", vec![text(WKT)]),
        target("cgshop", vec![text(CGSHOP)]),
        target("vtu", vec![meshed("vtu"), text(VTU[0]), text(VTU[1])]),
        target("msh", vec![meshed("msh"), meshed("msh2"), text(MSH)]),
        target("obj", vec![meshed("obj"), text(OBJ)]),
        target("off", vec![meshed("off"), text("COFF\n3 1 3\n0 0 0 1 1 1 1\n1 0 0\n0 1 0\n3 0 1 2 0.5\n")]),
        target("mesh", vec![meshed("mesh")]),
        target(
            "2dm",
            vec![
                meshed("2dm"),
                text("MESH2D\nE3T 1 4 5 6 2\nND 4 0 0 1\nND 5 1 0 2\nND 6 0 1 3\nNS 4 5\nNS -6\n"),
            ],
        ),
        target(
            "14",
            vec![
                meshed("14"),
                text("a\n1 3\n1 0 0 1\n2 1 0 1\n3 0 1 1\n1 3 1 2 3\n1\n2\n2\n1\n2\n1\n3\n3 1\n1\n2\n3\n"),
            ],
        ),
        target("asc", vec![text(RASTER)]),
        target("sizes", vec![text("# x y size\n1 2 0.5\n3,4;1e-3\n")]),
        target("ele", vec![text("3 3 1\n0 0 1 2 1.5\n1 1 2 3 0\n2 0 3 1 -2\n")]),
    ]);
    if cfg!(feature = "shapefile") {
        let fixture = |name| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/formats").join(name);
        let samples =
            ["areas.shp", "rivers.shp", "soundings.shp"].map(|name| std::fs::read(fixture(name)).unwrap());
        rest.push(target("shp", samples.to_vec()));
    }
    rest
}

/// Reads a file in every way its name stands for.
fn read(name: &str, bytes: &[u8]) {
    if name == "ele" {
        let nodes = "4 2 1 1\n0 0 0 -1 1\n1 1 0 3 1\n2 1 1 2 0\n3 0 1 -1 1\n".as_bytes();
        judge(read_mesh_pair((nodes, "n"), (bytes, "e")));
        judge(read_mesh_pair((bytes, "n"), (&b"1\n0 0 1 2\n"[..], "e")));
        return;
    }
    let items = match name {
        "asc" => Some(parse_raster(bytes, "f").map(|raster| raster.values.len())),
        "sizes" => Some(parse_sizes(bytes, "f").map(|sizes| sizes.len())),
        _ => None,
    };
    match items {
        Some(Ok(items)) => bounded(items, bytes),
        Some(Err(error)) => assert_plausible(&error, bytes),
        None => {}
    }
    if let Some(format) = MeshFormat::from_name(name).filter(|format| format.is_read()) {
        if name != "node" {
            judge(read_mesh_from(bytes, format, "f"));
        }
        holds_mesh(bytes, format);
    }
    if let Some(format) = PointFormat::from_name(name) {
        let read = PointReader::new().read_from(bytes, format, "f");
        assert!(
            read.is_ok_and(|file| file.pslg.check_layout().is_ok())
                || read_points_from(bytes, format, "f").is_err()
        );
        match read_points_from(bytes, format, "f") {
            Ok(pslg) => {
                assert_eq!(pslg.check_layout(), Ok(()));
                bounded(pslg.points.len() + pslg.segments.len(), bytes);
                let written = write_points_to(&mut Vec::new(), PointFormat::Poly, &pslg, "f");
                // Polygons have no place there.
                assert_eq!(written.is_ok(), pslg.polygons.is_empty());
            }
            Err(error) => assert_plausible(&error, bytes),
        }
    }
}

fn judge(found: Result<MeshData, ReadError>) {
    match found {
        Ok(data) => {
            // The writer checks that positions are finite, indices in range and arrays
            // complete.
            let mut out = Vec::new();
            write_mesh_to(&mut out, MeshFormat::Vtu, &data.view(), "f").unwrap();
            read_mesh_from(&out[..], MeshFormat::Vtu, "f").unwrap();
        }
        Err(error) => assert!(error.to_string().len() < 1_000, "{error}"),
    }
}

/// No more items than a file has bytes.
fn bounded(items: usize, bytes: &[u8]) {
    assert!(items <= 1 + bytes.len(), "{items} items of {} bytes", bytes.len());
}

/// A line that is named is one of the file.
fn assert_plausible(error: &ReadError, bytes: &[u8]) {
    let lines = 1 + bytes.iter().fold(0, |sum, b| sum + u64::from(*b == b'\n'));
    assert!(error.line().is_none_or(|line| line <= lines), "{error} in {lines} lines");
    assert!(error.to_string().len() < 1_000, "{error}");
}

/// Numbers and words that readers must not trust.
const HOSTILE: [&str; 26] = [
    "-1",
    "0",
    "1",
    "2",
    "3",
    "4294967295",
    "4294967296",
    "1000000000000",
    "9223372036854775807",
    "18446744073709551615",
    "-9223372036854775808",
    "1e308",
    "-1e999",
    "NaN",
    "inf",
    "1e-320",
    "null",
    "[",
    "]",
    "(",
    "\"",
    "<",
    "\n",
    "EMPTY",
    "$EndNodes",
    "\u{e9}",
];

/// Damages a file in place, once to a few times.
fn damage(file: &mut Vec<u8>, others: &[Vec<u8>], random: &mut Random) {
    for _ in 0..=random.below(4) {
        let (a, b) = (random.below(file.len()), random.below(file.len()));
        let (start, end) = (a.min(b), a.max(b).min(a.min(b) + 1 + random.below(40)));
        match random.below(8) {
            0 if !file.is_empty() => file[start] = random.next() as u8,
            1 if !file.is_empty() => file[start] ^= 1 << random.below(8),
            2 => drop(file.drain(start..end)),
            3 => {
                let piece = file[start..end].to_vec();
                let at = random.below(file.len());
                file.splice(at..at, piece);
            }
            4 => file.truncate(start),
            5 => {
                let other = &others[random.below(others.len())];
                let from = random.below(other.len());
                let piece = other[from..other.len().min(from + 1 + random.below(60))].to_vec();
                file.splice(start..end, piece);
            }
            _ => {
                // A number or word as a whole.
                let is_end = |b: &u8| !b.is_ascii_alphanumeric() && !matches!(b, b'.' | b'-' | b'+');
                let start = file[..start].iter().rposition(is_end).map_or(0, |at| at + 1);
                let end = file[start..].iter().position(is_end).map_or(file.len(), |at| start + at);
                file.splice(start..end, HOSTILE[random.below(HOSTILE.len())].bytes());
            }
        }
    }
}

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

#[test]
fn damaged_files_of_every_format() {
    let files = setting("HEXDEL_MUTATIONS", FILES);
    let mut random = Random(setting("HEXDEL_MUTATION_SEED", 1));
    for target in targets() {
        for sample in &target.samples {
            read(target.name, sample);
        }
        for _ in 0..files {
            let mut file = target.samples[random.below(target.samples.len())].clone();
            damage(&mut file, &target.samples, &mut random);
            let reading = std::panic::AssertUnwindSafe(|| read(target.name, &file));
            let fine = std::panic::catch_unwind(reading).is_ok();
            assert!(fine, "a damaged {}:\n{}", target.name, file.escape_ascii());
        }
    }
}

#[test]
fn what_went_wrong_once() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/regressions/formats");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.extension().unwrap().to_str().unwrap();
        read(name, &std::fs::read(&path).unwrap());
        count += 1;
    }
    assert!(count > 0);
}
