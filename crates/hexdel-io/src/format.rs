//! Which format a file name stands for.

use std::path::Path;

/// A format of points and planar straight-line graphs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PointFormat {
    /// Triangle's `.node`: points with attributes and markers.
    Node,
    /// Triangle's `.poly`: points, segments, holes and regions.
    Poly,
    /// A text table of which x and y are two columns: `.csv`, `.tsv`, `.xyz`,
    /// `.txt`, `.pts`. The delimiter is found out from the text.
    Table,
}

impl PointFormat {
    /// The extensions of all point formats, for messages.
    pub const EXTENSIONS: &str = ".node, .poly, .csv, .tsv, .xyz, .txt, .pts";

    /// The format that the extension of `path` stands for, in upper or lower case.
    pub fn from_path(path: &Path) -> Option<Self> {
        Some(match extension(path)?.as_str() {
            "node" => Self::Node,
            "poly" => Self::Poly,
            "csv" | "tsv" | "xyz" | "txt" | "pts" => Self::Table,
            _ => return None,
        })
    }
}

/// A format of triangle meshes or of their pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Triangle's pair of `.node` and `.ele`; either name stands for both.
    NodeEle,
    /// VTK's XML format of unstructured grids, `.vtu`. Written only.
    Vtu,
    /// Rusty Object Notation of a [`TriMesh`](hexdel_geom::TriMesh), `.ron`.
    Ron,
    /// A picture, `.svg`. Written only.
    Svg,
}

impl MeshFormat {
    /// The extensions that meshes are written to, for messages.
    pub const EXTENSIONS: &str = ".node, .ele, .vtu, .ron, .svg";

    /// The extensions that meshes are read from, for messages.
    pub const READABLE: &str = ".node, .ele, .ron";

    /// The format that the extension of `path` stands for, in upper or lower case.
    pub fn from_path(path: &Path) -> Option<Self> {
        Some(match extension(path)?.as_str() {
            "node" | "ele" => Self::NodeEle,
            "vtu" => Self::Vtu,
            "ron" => Self::Ron,
            "svg" => Self::Svg,
            _ => return None,
        })
    }
}

/// A format of the Voronoi dual of a mesh. Written only.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DualFormat {
    /// Cells as polygons, `.vtu`.
    Vtu,
    /// Triangle's pair of `.v.node` and `.v.edge`; either name stands for both.
    Voronoi,
}

impl DualFormat {
    /// The extensions that duals are written to, for messages.
    pub const EXTENSIONS: &str = ".vtu, .v.node, .v.edge";

    /// The format that the extension of `path` stands for, in upper or lower case.
    pub fn from_path(path: &Path) -> Option<Self> {
        match extension(path)?.as_str() {
            "vtu" => Some(Self::Vtu),
            "node" | "edge" if extension(Path::new(path.file_stem()?))? == "v" => Some(Self::Voronoi),
            _ => None,
        }
    }
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}
