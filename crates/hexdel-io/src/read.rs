//! Reading files: which reader for which format, and the files beside a file.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use hexdel_geom::{Pslg, TriMesh};
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::data::MeshData;
use crate::error::ReadError;
use crate::format::MeshFormat;
use crate::json::{Source, parse, slurp};
use crate::lines::BYTE_ORDER_MARK;
use crate::mend::Mends;
use crate::triangle::PointRange;
use crate::{fort14, medit, mesh_json, mesh_ron, msh, obj, off, triangle, twodm, vtu_in};

/// Reads a mesh without what else its file knows, see [`read_mesh_data`].
///
/// # Errors
///
/// As [`read_mesh_data`].
pub fn read_mesh(path: impl AsRef<Path>) -> Result<TriMesh, ReadError> {
    read_mesh_data(path).map(|data| data.mesh)
}

/// Reads a mesh with its markers and regions, in the format that the extension stands
/// for. A `.node` or `.ele` path stands for the pair of both.
///
/// Nothing is promised about the triangles but that their corners exist: whoever needs
/// more computes a certificate.
///
/// # Errors
///
/// Every [`ReadError`] but [`ReadError::PointsElsewhere`].
///
/// # Complexity
///
/// As [`read_points`](crate::read_points).
pub fn read_mesh_data(path: impl AsRef<Path>) -> Result<MeshData, ReadError> {
    let path = path.as_ref();
    let name = path.display().to_string();
    match MeshFormat::from_path(path) {
        Some(MeshFormat::NodeEle) => {
            let (points, range) = read_nodes(&beside(path, "node"))?;
            let elements = beside(path, "ele");
            let reader = open(&elements)?;
            triangle::read_ele(reader, &elements.display().to_string(), points, range)
        }
        Some(format) if format.is_read() => read_mesh_from(open(path)?, format, &name),
        Some(format) => Err(ReadError::WriteOnly { file: name, format: format.name() }),
        None => Err(ReadError::UnknownExtension { file: name, known: MeshFormat::READABLE }),
    }
}

/// Reads a mesh from anything that can be read, `name` being what errors call it.
///
/// # Errors
///
/// As [`read_mesh_data`], and [`ReadError::TwoFiles`] for [`MeshFormat::NodeEle`], see
/// [`read_mesh_pair`].
///
/// # Examples
///
/// ```
/// use hexdel_io::{MeshFormat, read_mesh_from};
///
/// let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
/// let data = read_mesh_from(text.as_bytes(), MeshFormat::Obj, "a.obj")?;
/// assert_eq!(data.mesh.triangles[0].map(|v| v.index()), [0, 1, 2]);
/// # Ok::<(), hexdel_io::ReadError>(())
/// ```
pub fn read_mesh_from(reader: impl BufRead, format: MeshFormat, name: &str) -> Result<MeshData, ReadError> {
    match format {
        MeshFormat::Vtu => vtu_in::read_vtu(reader, name),
        MeshFormat::Msh41 | MeshFormat::Msh22 => msh::read_msh(reader, name),
        MeshFormat::Obj => obj::read_obj(reader, name),
        MeshFormat::Off => off::read_off(reader, name),
        MeshFormat::Medit => medit::read_medit(reader, name),
        MeshFormat::TwoDm => twodm::read_2dm(reader, name),
        MeshFormat::Fort14 => fort14::read_fort14(reader, name),
        MeshFormat::Json => mesh_json::read_json(reader, name),
        MeshFormat::Ron => mesh_ron::read_ron(&Source { bytes: &slurp(reader, name)?, file: name }),
        MeshFormat::NodeEle => Err(ReadError::TwoFiles { file: name.to_owned(), format: ".node/.ele" }),
        _ => Err(ReadError::WriteOnly { file: name.to_owned(), format: format.name() }),
    }
}

/// Whether a text of JSON or RON is that of a mesh, with `triangles`, rather than of a
/// PSLG. What it is like otherwise is left to the readers. Of other formats that are read, each
/// text is that of a mesh.
///
/// # Examples
///
/// ```
/// use hexdel_io::{MeshFormat, holds_mesh};
///
/// assert!(holds_mesh(br#"{"triangles": [], "vertices": []}"#, MeshFormat::Json));
/// assert!(!holds_mesh(br#"{"points": [[0, 0]]}"#, MeshFormat::Json));
/// ```
pub fn holds_mesh(text: &[u8], format: MeshFormat) -> bool {
    let source = Source { bytes: text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text), file: "" };
    match format {
        MeshFormat::Ron => mesh_ron::parse_ron::<MeshProbe>(&source).is_ok(),
        MeshFormat::Json => parse::<MeshProbe>(&source).is_ok(),
        other => other.is_read(),
    }
}

/// The member that must be there.
#[derive(Deserialize)]
struct MeshProbe {
    #[serde(rename = "triangles")]
    _triangles: IgnoredAny,
}

/// Reads a mesh from the two texts of a `.node` and an `.ele` file, each with
/// what errors call it.
///
/// # Errors
///
/// As [`read_mesh_data`].
///
/// # Examples
///
/// ```
/// let nodes = "3 2\n1 0 0\n2 1 0\n3 0 1\n".as_bytes();
/// let elements = "1\n1 1 2 3\n".as_bytes();
/// let data = hexdel_io::read_mesh_pair((nodes, "a.node"), (elements, "a.ele"))?;
/// assert_eq!(data.mesh.triangles[0].map(|v| v.index()), [0, 1, 2]);
/// # Ok::<(), hexdel_io::ReadError>(())
/// ```
pub fn read_mesh_pair(
    nodes: (impl BufRead, &str),
    elements: (impl BufRead, &str),
) -> Result<MeshData, ReadError> {
    let (points, range) = triangle::read_node(nodes.0, nodes.1, &mut Mends::new(true))?;
    triangle::read_ele(elements.0, elements.1, points, range)
}

fn read_nodes(path: &Path) -> Result<(Pslg, PointRange), ReadError> {
    triangle::read_node(open(path)?, &path.display().to_string(), &mut Mends::new(true))
}

pub(crate) fn open(path: &Path) -> Result<BufReader<File>, ReadError> {
    let file = File::open(path).map_err(|source| ReadError::open(path, source))?;
    Ok(BufReader::with_capacity(1 << 16, file))
}

/// The file beside `path` with another extension. An extension in upper case asks
/// for one in upper case, as file systems tell them apart.
pub(crate) fn beside(path: &Path, extension: &str) -> std::path::PathBuf {
    let own = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    if own.eq_ignore_ascii_case(extension) {
        return path.to_owned();
    }
    let upper = !own.is_empty() && own.chars().all(|c| c.is_ascii_uppercase());
    if upper { path.with_extension(extension.to_ascii_uppercase()) } else { path.with_extension(extension) }
}
