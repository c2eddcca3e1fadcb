//! The adaptive hexagon grid (paper, section 3), as sets on lattices.
//!
//! Level `k` is the triangular lattice of spacing `s_0 / 2^k`; its Voronoi
//! cells are the hexagons of the level. The whole state of the grid is one set
//! per level: the hexagons that are *subdivided*. Which hexagons exist, which
//! are semi-hexagons, fins or leaves follows from these sets by lattice
//! algebra, sixty-four hexagons at a time.
//!
//! Nothing in here knows input points or what a subdivided hexagon is good
//! for; the layers above give the sets their meaning.
//!
//! | module | what |
//! |---|---|
//! | [`axial`] | integer addresses of hexagons and the six directions |
//! | [`lattice`] | from addresses to coordinates and back |
//! | [`window`] | 16 x 16 hexagons as one 256-bit word, and its set algebra |
//! | [`tiles`] | the sparse store: 8 x 8 hexagons a tile, linked in a quadtree |
//! | [`grid`] | existence, fins, neighbours, subdivision with balance, merging |

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod axial;
pub mod grid;
pub mod lattice;
pub mod tiles;
pub mod window;

pub use hexdel_geom::double_double as double;

pub use axial::{Address, Direction, Hex};
pub use grid::{Grid, HexKind, MergeError, Neighbour};
pub use lattice::{Lattice, Located};
pub use tiles::{Margin, Tile, TileId, Tiles};
pub use window::Window;
