//! The grid itself: which hexagons exist, and the two operations on it.
//!
//! ```text
//!      ___ ___            A and B are subdivided, h is not. Each keeps its
//!     / A | B \           scaled centre; between A and B two semi-hexagons
//!     \__/ \__/           join to the full hexagon m = A + B (one level
//!        \h/              finer); the ones towards h stay semi-hexagons:
//!                         the fins of h.
//! ```
//!
//! **Balance** (paper, section 3.3): a hexagon may be subdivided only if all
//! six of its lattice neighbours exist on its level.

use crate::axial::{Address, Direction, Hex};
use crate::lattice::{Lattice, Located};
use crate::tiles::{TileId, Tiles};
use glam::DVec2;
use thiserror::Error;

/// What stands at a place of a level's lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HexKind {
    /// Nothing: the region is covered by coarser hexagons.
    Absent,
    /// A semi-hexagon, half of which was never made: a fin of the hexagon
    /// `of`, one level coarser, which is not subdivided.
    Semi {
        /// The hexagon whose fin this is, one level coarser.
        of: Hex,
    },
    /// A full hexagon that is not subdivided: a vertex of the dual.
    Leaf,
    /// A full hexagon that is subdivided.
    Subdivided,
}

/// What lies beyond one of a leaf's six sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Neighbour {
    /// A leaf of the same level.
    Same(Address),
    /// A fin; beyond it the scaled centre of the subdivided neighbour.
    Finer(Address),
    /// A semi-hexagon; beyond it the coarser leaf whose fin it is.
    Coarser(Address),
}

/// Why a hexagon cannot be merged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MergeError {
    /// The hexagon is not subdivided.
    #[error("hexagon {0:?} is not subdivided")]
    NotSubdivided(Address),
    /// A hexagon that the merge would remove is subdivided, or is a neighbour
    /// of one that is.
    #[error("merging {hexagon:?} would remove {needed:?}, which finer hexagons need")]
    Needed {
        /// The hexagon to merge.
        hexagon: Address,
        /// The hexagon that is still needed.
        needed: Address,
    },
}

/// The adaptive hexagon grid over the whole plane.
///
/// Level 0 exists everywhere and is unsubdivided where nothing asks for more.
#[derive(Clone, Debug)]
pub struct Grid {
    lattice: Lattice,
    /// Invariant (balance): where a hexagon is subdivided, its six neighbours
    /// exist. Callers that set planes themselves restore it before they hand
    /// the grid on.
    tiles: Tiles,
}

impl Grid {
    /// Levels are numbered below this; spacings then span 15 decimal digits,
    /// as many as a coordinate has.
    pub const MAX_LEVELS: u8 = 50;

    /// A grid of level-0 hexagons on `lattice`.
    pub fn new(lattice: Lattice) -> Self {
        Self { lattice, tiles: Tiles::default() }
    }

    /// Where the grid lies in the plane.
    pub const fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// The store of the sets.
    pub const fn tiles(&self) -> &Tiles {
        &self.tiles
    }

    /// The store of the sets, to change many hexagons at once. Balance is the
    /// caller's to restore.
    pub const fn tiles_mut(&mut self) -> &mut Tiles {
        &mut self.tiles
    }

    /// Whether a hexagon is in its level's set of subdivided ones.
    pub fn is_subdivided(&self, at: Address) -> bool {
        self.tiles
            .find(at.level, at.hex)
            .is_some_and(|(id, bit)| self.tiles.get(at.level, id).subdivided >> bit & 1 == 1)
    }

    /// Whether a full hexagon stands at a place.
    pub fn exists(&self, at: Address) -> bool {
        matches!(self.kind(at), HexKind::Leaf | HexKind::Subdivided)
    }

    /// What stands at a place. Takes a step per level.
    pub fn kind(&self, at: Address) -> HexKind {
        let full = |at| {
            if self.is_subdivided(at) { HexKind::Subdivided } else { HexKind::Leaf }
        };
        let Some(coarser) = at.level.checked_sub(1) else {
            return full(at);
        };
        let made = |parent| self.is_subdivided(Address::new(coarser, parent));
        match at.hex.parents() {
            (a, None) if made(a) => full(at),
            (_, None) => HexKind::Absent,
            (a, Some(b)) => match (made(a), made(b)) {
                (true, true) => full(at),
                (true, false) => HexKind::Semi { of: b },
                (false, true) => HexKind::Semi { of: a },
                (false, false) => HexKind::Absent,
            },
        }
    }

    /// The fins of a leaf: the directions in which its lattice neighbour is
    /// subdivided, bit `i` for direction `i`.
    pub fn fins(&self, at: Address) -> u8 {
        Direction::ALL
            .into_iter()
            .filter(|&d| self.is_subdivided(Address::new(at.level, at.hex.neighbour(d))))
            .fold(0, |fins, d| fins | 1 << d.index())
    }

    /// What lies beyond side `d` of a leaf, or `None` if `at` is no leaf.
    pub fn neighbour(&self, at: Address, d: Direction) -> Option<Neighbour> {
        if self.kind(at) != HexKind::Leaf {
            return None;
        }
        let there = Address::new(at.level, at.hex.neighbour(d));
        Some(match self.kind(there) {
            HexKind::Leaf => Neighbour::Same(there),
            HexKind::Subdivided => Neighbour::Finer(Address::new(at.level + 1, there.hex.scaled())),
            HexKind::Semi { of } => Neighbour::Coarser(Address::new(at.level - 1, of)),
            // A full hexagon has a subdivided parent, and every neighbour of it
            // lies on one of that parent's sides: in balance or not, half of
            // it at least was made.
            HexKind::Absent => unreachable!("{there:?} beside the full hexagon {at:?} is absent"),
        })
    }

    /// How often a hexagon was subdivided since two semi-hexagons joined to
    /// make it (paper, section 3.2); for scaled centres of level-0 hexagons,
    /// since the beginning. Only at counter 0 may it be broken.
    pub fn split_counter(at: Address) -> u8 {
        let even = at.hex.q.trailing_zeros().min(at.hex.r.trailing_zeros());
        at.level.min(even as u8)
    }

    /// The finest place whose cell holds a point: a leaf or, between a leaf
    /// and a subdivided hexagon, a semi-hexagon.
    pub fn locate(&self, point: DVec2) -> (u8, Located, HexKind) {
        let mut level = 0;
        loop {
            let found = self.lattice.locate(level, point);
            match self.kind(Address::new(level, found.hex)) {
                HexKind::Subdivided => level += 1,
                kind => return (level, found, kind),
            }
        }
    }

    /// Subdivides a leaf (paper, sections 3.1 and 3.3), and first whatever
    /// balance asks for. Does nothing if it is subdivided already.
    ///
    /// # Complexity
    ///
    /// One step per level for each hexagon subdivided and looked at; a single
    /// call may trigger `O(levels)` rings of others.
    pub fn subdivide(&mut self, at: Address) {
        if self.is_subdivided(at) {
            return;
        }
        self.require(at);
        for hex in at.hex.neighbours() {
            self.require(Address::new(at.level, hex));
        }
        let (id, bit) = self.tiles.require(at.level, at.hex);
        self.tiles.get_mut(at.level, id).subdivided |= 1 << bit;
    }

    /// Makes a full hexagon exist by subdividing its parents.
    fn require(&mut self, at: Address) {
        if let Some(coarser) = at.level.checked_sub(1) {
            let (a, b) = at.hex.parents();
            for parent in std::iter::once(a).chain(b) {
                self.subdivide(Address::new(coarser, parent));
            }
        }
    }

    /// The reverse of [`subdivide`](Self::subdivide) (paper, section 3.2):
    /// breaks the hexagons that were joined at its sides and scales the centre
    /// up again.
    ///
    /// # Errors
    ///
    /// [`MergeError`] if the hexagon is not subdivided, or if one of the seven
    /// hexagons that would vanish is subdivided or next to one that is. The
    /// grid is then unchanged.
    pub fn merge(&mut self, at: Address) -> Result<(), MergeError> {
        let Some((id, bit)) = self.tiles.find(at.level, at.hex).filter(|_| self.is_subdivided(at)) else {
            return Err(MergeError::NotSubdivided(at));
        };
        for child in at.hex.scaled().disc(1).map(|h| Address::new(at.level + 1, h)) {
            let needed = child.hex.disc(1).any(|h| self.is_subdivided(Address::new(child.level, h)));
            if needed && self.exists(child) {
                return Err(MergeError::Needed { hexagon: at, needed: child });
            }
        }
        self.tiles.get_mut(at.level, id).subdivided &= !(1 << bit);
        Ok(())
    }

    /// All subdivided hexagons, level by level.
    pub fn subdivided(&self) -> impl Iterator<Item = Address> {
        (0..self.tiles.levels() as u8).flat_map(move |level| {
            self.tiles.placed(level).flat_map(move |(first, tile)| {
                crate::window::ones(tile.subdivided).map(move |bit| Address::new(level, first + hex_of(bit)))
            })
        })
    }

    /// The first hexagon that breaks balance: a subdivided one with a
    /// neighbour that does not exist.
    pub fn unbalanced(&self) -> Option<Address> {
        self.subdivided().find(|at| at.hex.disc(1).any(|hex| !self.exists(Address::new(at.level, hex))))
    }

    /// The id and bit of a hexagon's tile, the tile made if need be.
    pub fn tile_of(&mut self, at: Address) -> (TileId, u32) {
        self.tiles.require(at.level, at.hex)
    }
}

/// The hexagon of a tile's bit, relative to the tile's first.
#[inline]
pub const fn hex_of(bit: u32) -> Hex {
    Hex::new(bit as i64 & 7, bit as i64 >> 3)
}
