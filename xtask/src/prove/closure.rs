//! Closing a pattern under the rules: whether the product would leave it as it
//! is.
//!
//! The pattern is laid on a level of which all hexagons exist, everything
//! around it unsubdivided, and the rules are obeyed until none asks for more.
//! If no hexagon of the pattern is among those subdivided on the way, the
//! pattern occurs in a legal state of the grid.

use super::pattern::{CENTRE, Plan};
use hexdel_classify::View;
use hexdel_grid::grid::hex_of;
use hexdel_grid::window::ones;
use hexdel_grid::{Address, Grid, Lattice, TileId, Window};
use hexdel_refine::{RuleSet, Situation};

/// Rounds after which closing is given up; a front that stays in sight of the
/// patch has settled long before.
const ROUNDS: usize = 40;

/// The pattern with what the rules add to it around a plan's unit; `None` if
/// they change the patch.
pub(crate) fn around(plan: &Plan, pattern: Window, rules: &RuleSet) -> Option<Window> {
    let grid = closed(pattern, rules, |grid| {
        plan.members.iter().all(|&at| grid.is_subdivided(Address::new(0, at)) == pattern.contains(at))
    })?;
    let reach = CENTRE.disc(6);
    Some(reach.filter(|&at| grid.is_subdivided(Address::new(0, at))).collect())
}

/// A grid whose level 0 holds a pattern and obeys the rules; `None` if it does
/// not satisfy `keeps` on the way, or does not settle.
pub(crate) fn closed(pattern: Window, rules: &RuleSet, keeps: impl Fn(&Grid) -> bool) -> Option<Grid> {
    let mut grid = Grid::new(Lattice::new(hexdel_geom::DVec2::ZERO, 1.0));
    for at in pattern.iter() {
        let (id, bit) = grid.tiles_mut().require(0, at);
        grid.tiles_mut().get_mut(0, id).subdivided |= 1 << bit;
    }
    for _ in 0..ROUNDS {
        if !keeps(&grid) {
            return None;
        }
        let with_bits: Vec<_> = tiles(&grid).map(|id| (id, grid.tiles().get(0, id).subdivided)).collect();
        for (id, bits) in with_bits {
            grid.tiles_mut().require_margin(0, id, bits);
        }
        let asked: Vec<_> = tiles(&grid)
            .map(|id| (id, rules.must_subdivide(&Situation::of(View::of(&grid, 0, id)))))
            .filter(|(_, bits)| *bits != 0)
            .collect();
        if asked.is_empty() {
            return Some(grid);
        }
        for (id, bits) in asked {
            for bit in ones(bits) {
                let at = grid.tiles().first(0, id) + hex_of(bit);
                let (id, bit) = grid.tiles_mut().require(0, at);
                grid.tiles_mut().get_mut(0, id).subdivided |= 1 << bit;
            }
        }
    }
    None
}

fn tiles(grid: &Grid) -> impl Iterator<Item = TileId> + use<> {
    (0..grid.tiles().level(0).len()).map(TileId::new)
}
