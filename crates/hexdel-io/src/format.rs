//! Which format a file name or a format's own name stands for.

use std::path::Path;

/// A format of points and planar straight-line graphs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PointFormat {
    /// Triangle's `.node`: points with attributes and markers.
    Node,
    /// Triangle's `.poly`: points, segments, holes and regions.
    Poly,
    /// A text table of which x and y are two columns: `.xyz`, `.txt`, `.pts`.
    /// Written with spaces and without header; when any table is read, the
    /// delimiter and whether there is a header are found out from the text.
    Table,
    /// A table with commas and a header, `.csv`.
    Csv,
    /// A table with tabs and a header, `.tsv`.
    Tsv,
    /// `GeoJSON` (RFC 7946), `.geojson`, or a sequence of it, `.geojsonl`, `.geojsons`, `.ndjson`.
    /// Sequences are read only.
    GeoJson,
    /// Well-known text, `.wkt`. Read only.
    Wkt,
    /// JSON of a [`Pslg`](hexdel_geom::Pslg), `.json`. What is read under this name
    /// may be `GeoJSON` or an instance of CG:SHOP as well.
    Json,
    /// An instance of the CG:SHOP 2025 challenge, JSON as well. Read only.
    CgShop,
    /// Rusty Object Notation of a [`Pslg`](hexdel_geom::Pslg), `.ron`.
    Ron,
    /// The nodes of a mesh of SMS, `.2dm`, with their heights. Read only.
    TwoDm,
    /// The nodes of a grid of ADCIRC, `fort.14`, with their heights. Read only.
    Fort14,
    /// A shapefile, `.shp`. Read only, with the feature `shapefile`.
    #[cfg(feature = "shapefile")]
    Shapefile,
}

/// Names of formats, with what they name.
type Names<F> = &'static [(&'static str, F)];

/// The first name of each format is the one it is known by.
const POINT_NAMES: Names<PointFormat> = &[
    ("node", PointFormat::Node),
    ("poly", PointFormat::Poly),
    ("csv", PointFormat::Csv),
    ("tsv", PointFormat::Tsv),
    ("xyz", PointFormat::Table),
    ("txt", PointFormat::Table),
    ("pts", PointFormat::Table),
    ("geojson", PointFormat::GeoJson),
    ("geojsonl", PointFormat::GeoJson),
    ("geojsons", PointFormat::GeoJson),
    ("ndjson", PointFormat::GeoJson),
    ("wkt", PointFormat::Wkt),
    ("json", PointFormat::Json),
    ("cgshop", PointFormat::CgShop),
    ("ron", PointFormat::Ron),
    ("2dm", PointFormat::TwoDm),
    ("14", PointFormat::Fort14),
    #[cfg(feature = "shapefile")]
    ("shp", PointFormat::Shapefile),
];

const MESH_NAMES: Names<MeshFormat> = &[
    ("ele", MeshFormat::NodeEle),
    ("node", MeshFormat::NodeEle),
    ("edge", MeshFormat::Edge),
    ("neigh", MeshFormat::Neigh),
    ("poly", MeshFormat::Poly),
    ("vtu", MeshFormat::Vtu),
    ("msh", MeshFormat::Msh41),
    ("msh4", MeshFormat::Msh41),
    ("msh2", MeshFormat::Msh22),
    ("obj", MeshFormat::Obj),
    ("off", MeshFormat::Off),
    ("mesh", MeshFormat::Medit),
    ("medit", MeshFormat::Medit),
    ("json", MeshFormat::Json),
    ("ron", MeshFormat::Ron),
    ("geojson", MeshFormat::GeoJson),
    ("wkt", MeshFormat::Wkt),
    ("2dm", MeshFormat::TwoDm),
    ("14", MeshFormat::Fort14),
    ("nc", MeshFormat::Ugrid),
    ("vtk", MeshFormat::Vtk),
    ("stl", MeshFormat::Stl),
    #[cfg(feature = "plot")]
    ("svg", MeshFormat::Svg),
    #[cfg(feature = "png")]
    ("png", MeshFormat::Png),
];

impl PointFormat {
    /// The extensions that points are written to, for messages.
    pub const EXTENSIONS: &str = ".node, .poly, .csv, .tsv, .xyz, .txt, .pts, .geojson, .json, .ron";

    /// The extensions that points are read from, for messages.
    pub const READABLE: &str = if cfg!(feature = "shapefile") {
        ".node, .poly, .csv, .tsv, .xyz, .txt, .pts, .geojson, .geojsonl, .geojsons, .ndjson, .wkt, .json, .ron, \
         .2dm, .14, .shp"
    } else {
        ".node, .poly, .csv, .tsv, .xyz, .txt, .pts, .geojson, .geojsonl, .geojsons, .ndjson, .wkt, .json, .ron, \
         .2dm, .14"
    };

    /// The format that the extension of `path` stands for, in upper or lower case.
    pub fn from_path(path: &Path) -> Option<Self> {
        Self::from_name(&extension(path)?)
    }

    /// The format of that name, an extension without its point or `cgshop`.
    pub fn from_name(name: &str) -> Option<Self> {
        lookup(POINT_NAMES, name)
    }

    /// All names of formats.
    pub fn names() -> impl Iterator<Item = &'static str> {
        POINT_NAMES.iter().map(|(name, _)| *name)
    }

    /// The format's name.
    pub fn name(self) -> &'static str {
        name_of(POINT_NAMES, self)
    }

    /// What of a PSLG's points a file in this format is without. Segments, holes
    /// and regions are never lost: a format without them is refused.
    ///
    /// ```
    /// use hexdel_geom::{DVec2, Pslg};
    /// use hexdel_io::PointFormat;
    ///
    /// let marked = Pslg { point_markers: vec![1], ..Pslg::from_points(vec![DVec2::ZERO]) };
    /// assert_eq!(PointFormat::Csv.lost(&marked), ["point markers"]);
    /// assert!(PointFormat::Node.lost(&marked).is_empty());
    /// ```
    pub fn lost(self, pslg: &hexdel_geom::Pslg) -> Vec<&'static str> {
        let keeps_all = !matches!(self, Self::Table | Self::Csv | Self::Tsv);
        let all = [
            ("point markers", pslg.point_markers.is_empty(), keeps_all),
            ("point attributes", pslg.point_attributes.is_empty(), keeps_all && self != Self::GeoJson),
        ];
        all.into_iter().filter(|(_, empty, kept)| !empty && !kept).map(|(name, ..)| name).collect()
    }

    /// Whether the format can be written.
    pub fn is_written(self) -> bool {
        let as_tables = matches!(self, Self::Table | Self::Csv | Self::Tsv);
        as_tables || matches!(self, Self::Node | Self::Poly | Self::GeoJson | Self::Json | Self::Ron)
    }
}

/// A format of triangle meshes or of their pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MeshFormat {
    /// Triangle's pair of `.node` and `.ele`; either name stands for both.
    NodeEle,
    /// Triangle's `.edge`: all edges, with boundary markers. Written only.
    Edge,
    /// Triangle's `.neigh`: the neighbours of each triangle. Written only.
    Neigh,
    /// Triangle's `.poly` of the vertices and the marked edges. Written only, as
    /// what is read from it is a PSLG.
    Poly,
    /// VTK's XML format of unstructured grids, `.vtu`.
    Vtu,
    /// Gmsh's `.msh`, version 4.1, in text. Reading takes version 2 as well.
    Msh41,
    /// Gmsh's `.msh`, version 2.2, in text. Reading takes version 4.1 as well.
    Msh22,
    /// Wavefront's `.obj`.
    Obj,
    /// The Object File Format of Geomview, `.off`.
    Off,
    /// Medit's `.mesh`, in text.
    Medit,
    /// JSON of a [`TriMesh`](hexdel_geom::TriMesh), `.json`.
    Json,
    /// Rusty Object Notation of a [`TriMesh`](hexdel_geom::TriMesh), `.ron`.
    Ron,
    /// Triangles as polygons in `GeoJSON` (RFC 7946), `.geojson`. Written only, as what is read from
    /// it is a PSLG.
    GeoJson,
    /// Triangles as polygons in well-known text, `.wkt`. Written only, as what is read from it is a
    /// PSLG.
    Wkt,
    /// The mesh format of SMS, `.2dm`.
    TwoDm,
    /// ADCIRC's grid, `fort.14` or any `.14`.
    Fort14,
    /// UGRID in NetCDF-3, `.nc`. Written only.
    Ugrid,
    /// VTK's legacy format in text, `.vtk`. Written only.
    Vtk,
    /// Stereolithography in text, `.stl`. Written only.
    Stl,
    /// A picture, `.svg`. Written only, with the feature `plot`.
    #[cfg(feature = "plot")]
    Svg,
    /// A picture, `.png`. Written only, with the feature `png`.
    #[cfg(feature = "png")]
    Png,
}

impl MeshFormat {
    /// The extensions that meshes are written to, for messages.
    pub const EXTENSIONS: &str = if cfg!(feature = "png") {
        ".node, .ele, .edge, .neigh, .poly, .vtu, .vtk, .msh, .obj, .off, .mesh, .stl, .2dm, .14, .nc, .geojson, \
         .wkt, .json, .ron, .svg, .png"
    } else if cfg!(feature = "plot") {
        ".node, .ele, .edge, .neigh, .poly, .vtu, .vtk, .msh, .obj, .off, .mesh, .stl, .2dm, .14, .nc, .geojson, \
         .wkt, .json, .ron, .svg"
    } else {
        ".node, .ele, .edge, .neigh, .poly, .vtu, .vtk, .msh, .obj, .off, .mesh, .stl, .2dm, .14, .nc, .geojson, \
         .wkt, .json, .ron"
    };

    /// The extensions of pictures, for messages.
    #[cfg(feature = "plot")]
    pub const PICTURES: &str = if cfg!(feature = "png") { ".svg, .png" } else { ".svg" };

    /// The extensions that meshes are read from, for messages.
    pub const READABLE: &str = ".node, .ele, .vtu, .msh, .obj, .off, .mesh, .2dm, .14, .json, .ron";

    /// The format that the extension of `path` stands for, in upper or lower case.
    pub fn from_path(path: &Path) -> Option<Self> {
        Self::from_name(&extension(path)?)
    }

    /// The format of that name: an extension without its point, `msh4` and `msh2`
    /// for the two versions of `.msh` (`msh` is 4.1), or `medit`.
    pub fn from_name(name: &str) -> Option<Self> {
        lookup(MESH_NAMES, name)
    }

    /// All names of formats.
    pub fn names() -> impl Iterator<Item = &'static str> {
        MESH_NAMES.iter().map(|(name, _)| *name)
    }

    /// The format's name.
    pub fn name(self) -> &'static str {
        name_of(MESH_NAMES, self)
    }

    /// Whether the format can be read.
    pub fn is_read(self) -> bool {
        let is_written_only = matches!(
            self,
            Self::Edge
                | Self::Neigh
                | Self::Poly
                | Self::GeoJson
                | Self::Wkt
                | Self::Ugrid
                | Self::Vtk
                | Self::Stl
        );
        !is_written_only && !self.is_picture()
    }

    /// Whether files of the format can name a coordinate system.
    pub fn holds_crs(self) -> bool {
        matches!(self, Self::GeoJson | Self::Ugrid)
    }

    /// Whether it is a picture.
    pub fn is_picture(self) -> bool {
        match self {
            #[cfg(feature = "png")]
            Self::Png => true,
            _ => self.is_svg(),
        }
    }

    pub(crate) fn is_svg(self) -> bool {
        match self {
            #[cfg(feature = "plot")]
            Self::Svg => true,
            _ => false,
        }
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
    /// Cells as polygons in `GeoJSON` (RFC 7946), `.geojson`.
    GeoJson,
    /// Cells as polygons in well-known text, `.wkt`.
    Wkt,
    /// Cells as a discretisation by vertices of MODFLOW 6, `.disv`.
    Disv,
    /// Cells as the faces of UGRID in NetCDF-3, `.nc`.
    Ugrid,
    /// Cells and triangles as the input of MPAS's mesh converter in NetCDF-3, `.mpas.nc`.
    Mpas,
}

impl DualFormat {
    /// Whether files of the format can name a coordinate system.
    pub fn holds_crs(self) -> bool {
        matches!(self, Self::GeoJson | Self::Ugrid)
    }

    /// The extensions that duals are written to, for messages.
    pub const EXTENSIONS: &str = ".vtu, .v.node, .v.edge, .geojson, .wkt, .disv, .nc, .mpas.nc";

    /// The format that the extension of `path` stands for, in upper or lower case.
    pub fn from_path(path: &Path) -> Option<Self> {
        let before = extension(Path::new(path.file_stem()?));
        match (extension(path)?.as_str(), before.as_deref()) {
            ("vtu", _) => Some(Self::Vtu),
            ("node" | "edge", Some("v")) => Some(Self::Voronoi),
            ("geojson", _) => Some(Self::GeoJson),
            ("wkt", _) => Some(Self::Wkt),
            ("disv", _) => Some(Self::Disv),
            ("nc", Some("mpas")) => Some(Self::Mpas),
            ("nc", _) => Some(Self::Ugrid),
            _ => None,
        }
    }
}

fn lookup<F: Copy>(names: Names<F>, name: &str) -> Option<F> {
    names.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, format)| *format)
}

fn name_of<F: Copy + PartialEq>(names: Names<F>, format: F) -> &'static str {
    names.iter().find(|(_, f)| *f == format).expect("every format has a name").0
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_for_formats() {
        for name in PointFormat::names() {
            let format = PointFormat::from_name(name).unwrap();
            assert_eq!(PointFormat::from_name(format.name()), Some(format));
        }
        for name in MeshFormat::names() {
            let format = MeshFormat::from_name(name).unwrap();
            assert_eq!(MeshFormat::from_name(format.name()), Some(format));
        }
        assert_eq!(MeshFormat::from_path(Path::new("a.b/c.MSH")), Some(MeshFormat::Msh41));
        assert_eq!(PointFormat::from_path(Path::new("geojson")), None);
    }

    #[test]
    fn lists_of_extensions_are_complete() {
        let of = |name: &str| format!(".{name}");
        for name in PointFormat::names().filter(|n| *n != "cgshop") {
            let sequence = ["geojsonl", "geojsons", "ndjson"].contains(&name);
            let written = PointFormat::from_name(name).unwrap().is_written() && !sequence;
            assert_eq!(PointFormat::EXTENSIONS.split(", ").any(|e| e == of(name)), written, "{name}");
            assert!(PointFormat::READABLE.split(", ").any(|e| e == of(name)), "{name}");
        }
        for name in MeshFormat::names().filter(|n| !["msh2", "msh4", "medit"].contains(n)) {
            let read = MeshFormat::from_name(name).unwrap().is_read();
            assert_eq!(MeshFormat::READABLE.split(", ").any(|e| e == of(name)), read, "{name}");
            assert!(MeshFormat::EXTENSIONS.split(", ").any(|e| e == of(name)), "{name}");
        }
    }
}
