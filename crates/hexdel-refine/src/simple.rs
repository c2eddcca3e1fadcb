//! The rules of sections 3.3 and 4.1.
//!
//! Rule 1, "subdivide any hexagon occupied by several input points", is obeyed
//! when points are put into the grid ([`crate::sites`]): a hexagon never holds
//! two.

use crate::rule::{Rule, Situation};
use hexdel_grid::Window;

/// The rules of this module, in the paper's order.
pub static RULES: &[&dyn Rule] = &[&Balance, &AdjacentOccupied, &OccupiedAmongFull, &OccupiedBesideFiner];

/// Those of them that ask for occupied hexagons.
pub static ABOUT_POINTS: &[&dyn Rule] = &[&AdjacentOccupied, &OccupiedBesideFiner];

/// Section 3.3: a subdivided hexagon is surrounded by hexagons of its level.
pub struct Balance;

impl Rule for Balance {
    fn name(&self) -> &'static str {
        "balance"
    }

    fn must_exist(&self, s: &Situation) -> Window {
        s.view.subdivided.dilated()
    }
}

/// Rule 3: subdivide an occupied hexagon if any adjacent neighbour is occupied
/// as well.
pub struct AdjacentOccupied;

impl Rule for AdjacentOccupied {
    fn name(&self) -> &'static str {
        "adjacent occupied"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        let occupied = s.view.occupied();
        if !occupied.holds_several() || !s.holds_points() {
            return Window::EMPTY;
        }
        occupied & occupied.others_within::<1>()
    }
}

/// Rules 2 and 4: an occupied hexagon and its neighbours are full hexagons. A
/// point in a semi-hexagon, or beside one, has the full hexagon at its long
/// edge subdivided.
pub struct OccupiedAmongFull;

impl Rule for OccupiedAmongFull {
    fn name(&self) -> &'static str {
        "occupied among full"
    }

    fn must_exist(&self, s: &Situation) -> Window {
        s.view.occupied().dilated()
    }
}

/// Rule 5: subdivide an occupied hexagon if any adjacent neighbour is of higher
/// level.
pub struct OccupiedBesideFiner;

impl Rule for OccupiedBesideFiner {
    fn name(&self) -> &'static str {
        "occupied beside finer"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        if !s.holds_points() {
            return Window::EMPTY;
        }
        s.view.occupied() & s.view.subdivided.others_within::<1>()
    }
}
