//! Input points and the hexagons they occupy.

use hexdel_classify::relocate::ring_may_stay;
use hexdel_geom::DVec2;
use hexdel_grid::{Lattice, Located};

/// An input point in the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// The point, as given.
    pub point: DVec2,
    /// The level of the leaf it occupies.
    pub level: u8,
    /// That leaf, and where in it the point lies.
    pub at: Located,
}

impl Site {
    /// A point in the hexagon of level 0 that holds it.
    pub fn new(lattice: &Lattice, point: DVec2) -> Self {
        Self { point, level: 0, at: lattice.locate(0, point) }
    }

    /// Moves the point to the hexagon of the next finer level that holds it.
    pub fn descend(&mut self, lattice: &Lattice) {
        self.level += 1;
        self.at = lattice.locate(self.level, self.point);
    }

    /// The plane of tile marks that the hexagon belongs to: class `Occupied1`
    /// or `Occupied2`.
    pub fn plane(&self) -> usize {
        usize::from(!ring_may_stay(&self.at))
    }
}
