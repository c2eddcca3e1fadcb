//! Mesh and point formats.
//!
//! The only library crate of the workspace that touches files. It knows points,
//! planar straight-line graphs and triangle meshes, and nothing of how meshes are
//! made.
//!
//! | points and PSLGs | | read | written |
//! |---|---|---|---|
//! | `.node` | Triangle's points | yes | yes |
//! | `.poly` | Triangle's planar straight-line graph | yes | yes |
//! | `.csv` `.tsv` `.xyz` `.txt` `.pts` | text tables | yes | yes |
//! | `.geojson` | `GeoJSON`; sequences of it are read only | yes | yes |
//! | `.wkt` | well-known text | yes | |
//! | `.shp` | shapefiles, with the feature `shapefile` | yes | |
//! | `.2dm` `.14` | nodes of meshes of SMS and ADCIRC | yes | |
//! | `.json` | a [`Pslg`](hexdel_geom::Pslg); instances of CG:SHOP 2025 | yes | the former |
//! | `.ron` | a [`Pslg`](hexdel_geom::Pslg) in Rusty Object Notation | yes | yes |
//!
//! | meshes | | read | written |
//! |---|---|---|---|
//! | `.node` + `.ele` | Triangle's meshes | yes | yes |
//! | `.edge` `.neigh` `.poly` | Triangle's edges, neighbours, segments | | yes |
//! | `.vtu` | VTK's unstructured grids | yes | yes |
//! | `.msh` | Gmsh, versions 4.1 and 2.2 in text | yes | yes |
//! | `.obj` | Wavefront | yes | yes |
//! | `.off` | Geomview | yes | yes |
//! | `.mesh` | Medit in text | yes | yes |
//! | `.2dm` | SMS | yes | yes |
//! | `.14` | ADCIRC, `fort.14` | yes | yes |
//! | `.nc` | UGRID in NetCDF-3 | | yes |
//! | `.vtk` | VTK's legacy format | | yes |
//! | `.stl` | stereolithography | | yes |
//! | `.geojson` `.wkt` | triangles as polygons | | yes |
//! | `.json` `.ron` | a [`TriMesh`](hexdel_geom::TriMesh) and its data | yes | yes |
//! | `.svg` `.png` | pictures by `hexdel-plot`, with the features `plot` and `png` | | yes |
//! | `.vtu` `.geojson` `.wkt` `.nc` `.disv` `.mpas.nc`, `.v.node` + `.v.edge` | the Voronoi dual of a mesh, by [`write_dual`] | | yes |
//!
//! Points go through [`read_points`], or a [`PointReader`] that says more, and [`write_points`], meshes through
//! [`read_mesh_data`] and [`write_mesh`], streams through [`read_points_from`],
//! [`write_points_to`], [`read_mesh_from`] and [`write_mesh_to`] with the format named, or
//! [`write_mesh_pair_to`].
//!
//! [`read_raster`] reads rasters (`.asc`), [`read_sizes`] tables of points with sizes. With the feature `projection`,
//! `Projection` takes longitudes and latitudes to a plane and back, keeping angles.
//!
//! Readers trust nothing: every malformed file is a [`ReadError`] with file and
//! line, and memory grows with what a file holds, not with what it claims. Lines
//! may end in CR LF, a byte order mark is skipped, text must be UTF-8. Writers give
//! complete files or none, with coordinates that read back to the same bits.
//!
//! Not here: whether segments cross, points coincide or triangles are any good.

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod angles;
mod asc;
mod atomic;
mod boundary;
mod columns;
mod data;
mod disv;
mod dual;
mod error;
mod format;
mod fort14;
mod geojson;
mod graph_geojson;
mod graph_json;
mod graph_ron;
mod json;
mod lines;
mod medit;
mod mend;
mod mesh_json;
mod mesh_ron;
mod mpas;
mod msh;
mod msh_out;
mod netcdf;
mod numbered;
mod obj;
mod off;
mod point_file;
mod polygons_out;
#[cfg(feature = "projection")]
mod projection;
mod promised;
mod read;
mod second_order;
#[cfg(feature = "shapefile")]
mod shapefile;
mod shapes;
mod sizes;
mod stl;
mod table;
mod tags;
mod text;
mod tokens;
mod topology;
mod triangle;
mod triangle_out;
mod twodm;
mod ugrid;
mod view;
mod vtk;
mod vtu;
mod vtu_array;
mod vtu_in;
mod wkt;
mod write;

pub use asc::{parse_raster, read_raster};
pub use columns::{Column, Columns, ColumnsError, TakenColumn, TakenColumns};
pub use data::MeshData;
pub use dual::write_dual;
pub use error::{ReadError, WriteError};
pub use format::{DualFormat, MeshFormat, PointFormat};
pub use hexdel_geom::{MarkedEdge, Raster};
pub use mend::ReadWarning;
pub use point_file::{PointFile, PointReader, points_beside, read_points, read_points_from};
#[cfg(feature = "projection")]
pub use projection::{Projection, ProjectionError, ProjectionKind};
pub use promised::{NotPromised, Promised, PromisedDomain};
pub use read::{holds_mesh, read_mesh, read_mesh_data, read_mesh_from, read_mesh_pair};
pub use sizes::{parse_sizes, read_sizes};
pub use view::{Geographic, MeshView};
pub use write::{write_mesh, write_mesh_pair_to, write_mesh_to, write_points, write_points_to};
