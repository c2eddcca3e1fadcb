//! The dual mesh (paper, sections 4.2 and 5.4).
//!
//! Vertices are the centres of the leaves, relocated by class, and the points
//! that three-finned hexagons insert on their fins. Triangles come from walking
//! every lattice triangle whose three corners exist on its level:
//!
//! | corners subdivided | emitted |
//! |---|---|
//! | 0 or 1 | the triangle; a subdivided corner stands for its scaled centre |
//! | 2 (`a`, `b`; `h` is not) | `(h, a, m)` and `(h, m, b)`, `m` the hexagon joined between `a` and `b` |
//! | 3 | nothing: its four children are walked one level finer |
//!
//! Lattice triangles at a `MovedCenter3` are replaced by its [`star`].
//!
//! Nothing is looked up by hashing. Each tile's vertices are a bit set, a
//! vertex's id is its tile's first id plus its rank among the set's bits, and
//! vertices and triangles are counted before they are written, so that tiles
//! are filled independently and in a fixed order.
//!
//! | module | what |
//! |---|---|
//! | [`domain`] | the hexagonal patch that the mesh covers |
//! | [`layout`] | which vertices and how many triangles each tile has |
//! | `brood` | what subdivided hexagons bring forth one level finer |
//! | `fill` | tasks, each with its part of both arrays |
//! | [`vertices`] | coordinates |
//! | [`triangles`] | index triples |
//! | [`star`] | the triangles around a three-finned hexagon |
//! | [`kept`] | a mesh that is kept tile by tile while the grid changes |
//! | [`local`] | the triangles around one place, in exact coordinates |

mod brood;
pub mod domain;
mod fill;
pub mod kept;
pub mod layout;
pub mod local;
pub mod star;
pub mod triangles;
pub mod vertices;

pub use domain::Domain;
pub use kept::{KeptDual, Touched};
pub use layout::Layout;

use hexdel_geom::monitor::{Cancelled, Monitor, Phase, check};
use hexdel_geom::{DVec2, TriMesh, VertexId};
use hexdel_grid::{Grid, Located, TileId};
use thiserror::Error;

/// An input point and the leaf it occupies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occupant {
    /// The leaf's level.
    pub level: u8,
    /// The leaf and the place in it.
    pub at: Located,
    /// The tile that holds the leaf.
    pub tile: TileId,
    /// The point, as given.
    pub point: DVec2,
}

/// The dual mesh of a grid.
#[derive(Clone, Debug)]
pub struct Dual {
    /// Vertices and counter-clockwise triangles.
    pub mesh: TriMesh,
    /// The vertex of each occupant, in the order given.
    pub vertex_of_occupant: Vec<VertexId>,
    /// What the mesh covers.
    pub domain: Domain,
}

/// Which vertices leave their hexagon's centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relocation {
    /// Occupied ones, onto their points (section 4.2).
    Occupied,
    /// Those that a template moves by its fins, and occupied ones: a start for
    /// an optimiser.
    Fins,
    /// All that section 5.4 moves, rings of occupied hexagons included.
    Full,
}

/// Why a dual mesh cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum DualError {
    /// Ids are 32 bits wide.
    #[error("the mesh would have {count} vertices, more than an index can hold")]
    TooManyVertices {
        /// How many it would have.
        count: u64,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Makes the dual mesh of a grid whose rules all hold.
///
/// Tiles for the leaves are added to the grid's store; its sets do not change.
///
/// # Errors
///
/// [`DualError::TooManyVertices`] from 2^32 vertices on;
/// [`DualError::Cancelled`] if the monitor asks for it.
///
/// # Complexity
///
/// Linear in the mesh; parallel over tiles, the result independent of threads.
pub fn extract(
    grid: &mut Grid,
    occupants: &[Occupant],
    domain: Domain,
    relocation: Relocation,
    monitor: &dyn Monitor,
) -> Result<Dual, DualError> {
    check(monitor)?;
    let layout = Layout::new(grid, domain, relocation != Relocation::Occupied)?;
    let total = layout.triangles();
    monitor.progress(Phase::Extract, total / 4, total);
    check(monitor)?;
    let mut mesh = fill::mesh(&layout);
    monitor.progress(Phase::Extract, total - total / 8, total);
    check(monitor)?;
    let vertex_of_occupant = vertices::place_occupants(&layout, occupants, relocation, &mut mesh.vertices);
    monitor.progress(Phase::Extract, total, total);
    Ok(Dual { mesh, vertex_of_occupant, domain })
}
