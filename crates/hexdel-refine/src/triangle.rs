//! The triangle rule, which section 5.2 lacks.
//!
//! Without it, angles down to 33.3 and up to 93.4 degrees remain where two
//! fronts face each other across a strip of two coarse hexagons, and where a
//! top touches a hexagon moved by another front. Since
//! relocations come from a small finite set, whether a triangle keeps the
//! bounds is decided exactly; where it does not, its most-moved corner is
//! subdivided.
//!
//! ```text
//!     *  *  *           two fronts: the hexagons 1 above and below are pulled
//!      1  1  1          apart, and the triangle between them, one corner moved
//!       1  1  1         up and two down, gets too flat an angle
//!        *  *  *
//! ```

use crate::rule::{Rule, Situation};
use hexdel_classify::{Class, Classes, ExactBounds, Offset};
use hexdel_grid::{Direction, Hex, Window};

/// The rules of this module.
pub static RULES: &[&dyn Rule] = &[&TriangleRule];

/// No triangle of hexagons of the same level breaks the bounds.
pub struct TriangleRule;

impl Rule for TriangleRule {
    fn name(&self) -> &'static str {
        "triangle"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        let c = &s.classes;
        let moved = c.moved1 | c.moved2 | c.moved4();
        let mut victims = Window::EMPTY;
        for d in [0, 1, 2].map(Direction::new) {
            let pairs = foreign_pairs(c, moved, d) & Window::with_margin(2);
            for h in pairs.iter() {
                for third in [1, 5] {
                    // Counter-clockwise with the third corner on the left.
                    let (a, b) = (h, h.neighbour(d));
                    let third = h.neighbour(d.turned(third));
                    let left = third == h.neighbour(d.turned(1));
                    let corners = if left { [a, b, third] } else { [b, a, third] };
                    if let Some(victim) = victim(c, corners) {
                        victims.insert(victim);
                    }
                }
            }
        }
        victims
    }
}

/// The corner that the rule asks for because of one lattice triangle,
/// counter-clockwise: what [`TriangleRule`] does for every triangle of a window.
pub fn victim_of(c: &Classes, corners: [Hex; 3]) -> Option<Hex> {
    let moved = c.moved1 | c.moved2 | c.moved4();
    let foreign = |a: Hex, b: Hex| {
        let along = Direction::ALL[..3].iter().find(|d| a.neighbour(**d) == b);
        along.is_some_and(|&d| foreign_pairs(c, moved, d).contains(a))
    };
    let [x, y, z] = corners;
    let any = [(x, y), (y, z), (z, x)].into_iter().any(|(a, b)| foreign(a, b) || foreign(b, a));
    if any { victim(c, corners) } else { None }
}

/// The hexagons that are moved by another front than their neighbour in
/// direction `d`: both are moved, they share no fin, and neither is the top of
/// a three-finned hexagon beside the other.
fn foreign_pairs(c: &Classes, moved: Window, d: Direction) -> Window {
    let side = |by: usize| d.turned(by);
    let shared = c.subdivided.at(side(1)) | c.subdivided.at(side(5));
    let under = |by: usize| c.under[side(by).index()];
    let top = under(1) | under(5) | (under(2) | under(4)).at(d);
    (moved & moved.at(d)).without(shared | top)
}

/// The corner to subdivide of a triangle that breaks the bounds.
fn victim(c: &Classes, corners: [Hex; 3]) -> Option<Hex> {
    if corners.iter().any(|&at| c.moved3.contains(at)) {
        return None;
    }
    let places = corners.map(|at| Offset::of(at) + c.relocation(at));
    if ExactBounds::EXTENDED.hold(places) {
        return None;
    }
    corners.into_iter().max_by_key(|&at| (rank(c.class_of(at)), at))
}

/// How much a class is moved, in the order victims are chosen.
fn rank(class: Class) -> u8 {
    match class {
        Class::MovedCenter2 => 3,
        Class::MovedCenter1 => 2,
        Class::MovedCenter4 => 1,
        _ => 0,
    }
}
