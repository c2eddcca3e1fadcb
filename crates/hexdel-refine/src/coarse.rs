//! Rules for coarse starts: grids on which a mesh is *not* within bounds yet.
//!
//! A mesh optimiser needs far fewer triangles than the templates around points,
//! but level transitions are what the templates settle best. So only the rules
//! stay that give every hexagon a class with a template and keep transitions
//! apart; those about the rings of occupied hexagons go, step by step:
//!
//! | start | around occupied hexagons |
//! |---|---|
//! | [`Start::Separate`] | they are full hexagons |
//! | [`Start::Apart`] | and no two are adjacent |
//! | [`Start::Among`] | and all their neighbours are full hexagons of the same level (section 4.1) |

use crate::extended::{SubdivideClass, TopOfTwoRuns, TopWithFins, TwoFinsBesideRun};
use crate::rule::{Rule, Situation};
use crate::simple::{AdjacentOccupied, Balance, OccupiedAmongFull, OccupiedBesideFiner};
use hexdel_grid::Window;

/// How coarse a start is, coarsest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Start {
    /// One point in each hexagon.
    Separate,
    /// No two adjacent hexagons occupied.
    Apart,
    /// Occupied hexagons surrounded by full ones of their level.
    Among,
}

/// The rules of a start.
pub(crate) fn rules(start: Start) -> Vec<&'static dyn Rule> {
    let mut rules: Vec<&'static dyn Rule> = vec![
        &Balance,
        &OccupiedFull,
        &SubdivideClass,
        &TopWithFins,
        &TopOfTwoRuns,
        &StarAmongFull,
        &OccupiedStar,
        &TwoFinsBesideRun,
        &MovedAmongFull,
    ];
    if start >= Start::Apart {
        rules.push(&AdjacentOccupied);
    }
    if start >= Start::Among {
        rules.extend([&OccupiedAmongFull as &dyn Rule, &OccupiedBesideFiner]);
    }
    rules
}

/// Rule 2 of section 4.1: an occupied hexagon is a full one.
pub struct OccupiedFull;

impl Rule for OccupiedFull {
    fn name(&self) -> &'static str {
        "occupied full"
    }

    fn must_exist(&self, s: &Situation) -> Window {
        s.view.occupied()
    }
}

/// The hexagons around the star of a `MovedCenter3` are full ones.
pub struct StarAmongFull;

impl Rule for StarAmongFull {
    fn name(&self) -> &'static str {
        "star among full"
    }

    fn must_exist(&self, s: &Situation) -> Window {
        s.classes.moved3.dilated()
    }
}

/// A `MovedCenter3` holds no point: its own centre may be left away.
pub struct OccupiedStar;

impl Rule for OccupiedStar {
    fn name(&self) -> &'static str {
        "occupied star"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        s.classes.moved3 & s.view.occupied()
    }
}

/// The hexagons around moved ones are full: transitions follow each other at a
/// distance at which the templates keep their angles. Seen from the finer
/// side, as in [`FixedBesideFins`](crate::extended::FixedBesideFins).
pub struct MovedAmongFull;

impl Rule for MovedAmongFull {
    fn name(&self) -> &'static str {
        "moved among full"
    }

    fn must_exist(&self, s: &Situation) -> Window {
        (s.view.subdivided.dilated() | s.classes.moved4()).dilated()
    }
}
