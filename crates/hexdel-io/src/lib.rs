//! Mesh and point formats, pictures.
//!
//! The only library crate of the workspace that touches files. It knows points,
//! planar straight-line graphs and triangle meshes, and nothing of how meshes are
//! made.
//!
//! | extension | format | read | written |
//! |---|---|---|---|
//! | `.node` | Triangle's points | [`read_points`] | [`write_points`] |
//! | `.poly` | Triangle's planar straight-line graph | [`read_points`] | [`write_points`] |
//! | `.csv` `.tsv` `.xyz` `.txt` `.pts` | text tables | [`read_points`] | [`write_points`] |
//! | `.node` + `.ele` | Triangle's meshes | [`read_mesh`] | [`write_mesh`] |
//! | `.ron` | [`TriMesh`](hexdel_geom::TriMesh) in Rusty Object Notation | [`read_mesh`] | [`write_mesh`] |
//! | `.vtu` | VTK's unstructured grids | | [`write_mesh`] |
//! | `.svg` | pictures | | [`write_mesh`] |
//! | `.vtu`, `.v.node` + `.v.edge` | the Voronoi dual of a mesh | | [`write_dual`] |
//!
//! Readers trust nothing: every malformed file is a [`ReadError`] with file and
//! line, and memory grows with what a file holds, not with what it claims. Lines
//! may end in CR LF, a byte order mark is skipped, text must be UTF-8. Writers give
//! complete files or none, with coordinates that read back to the same bits.
//!
//! Not here: whether segments cross, points coincide or triangles are any good.

mod angles;
mod atomic;
mod dual;
mod error;
mod format;
mod legend;
mod lines;
mod mesh_ron;
mod picture;
mod read;
mod svg;
mod table;
mod text;
mod triangle;
mod triangle_out;
mod view;
mod vtu;
mod write;

pub use dual::write_dual;
pub use error::{ReadError, WriteError};
pub use format::{DualFormat, MeshFormat, PointFormat};
pub use picture::{Overlay, OverlayClass, Picture, Polygon, Rgb};
pub use read::{read_mesh, read_mesh_from, read_points, read_points_from};
pub use view::{MarkedEdge, MeshView};
pub use write::{write_mesh, write_mesh_to, write_points};
