//! The triangles around one place, in exact coordinates.
//!
//! What [`extract`](super::extract) writes as floats and indices, answered for
//! a single lattice triangle or star of a window, with the same stars and
//! templates: for machine proofs and for debugging. Input points play no part.

use super::star::{self, Corners, Star};
use crate::class::Classes;
use crate::exact::Offset;
use hexdel_grid::Hex;

/// Where the corner of a triangle comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// A leaf of the level.
    Leaf(Hex),
    /// A full hexagon one level finer, or a semi-hexagon on which a
    /// `MovedCenter3` inserts a point.
    Finer(Hex),
}

/// A triangle of the dual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LocalTriangle {
    /// What stands at the corners, counter-clockwise.
    pub places: [Place; 3],
    /// Where the corners lie, relative to the window's tile.
    pub corners: [Offset; 3],
}

/// The triangles that a lattice triangle, counter-clockwise, stands for: none
/// if a corner is a `MovedCenter3` (its star covers it) or all are subdivided.
///
/// # Panics
///
/// Never: leaves without a vertex are left to their stars.
pub fn of_lattice_triangle(classes: &Classes, corners: [Hex; 3], mut push: impl FnMut(LocalTriangle)) {
    if corners.iter().any(|&at| classes.moved3.contains(at)) {
        return;
    }
    let subdivided = corners.map(|at| classes.subdivided.contains(at));
    let place =
        |i: usize| if subdivided[i] { Place::Finer(corners[i].scaled()) } else { Place::Leaf(corners[i]) };
    match subdivided.iter().filter(|&&s| s).count() {
        0 | 1 => push(located(classes, [place(0), place(1), place(2)])),
        2 => {
            let whole = (0..3).find(|&i| !subdivided[i]).expect("one corner is a leaf");
            let [h, a, b] = [0, 1, 2].map(|i| corners[(whole + i) % 3]);
            let joined = Place::Finer(a + b);
            push(located(classes, [Place::Leaf(h), Place::Finer(a.scaled()), joined]));
            push(located(classes, [Place::Leaf(h), joined, Place::Finer(b.scaled())]));
        }
        _ => {}
    }
}

/// The triangles of the star of a `MovedCenter3`; none for any other hexagon.
///
/// # Panics
///
/// If a corner has no vertex, which no legal grid shows: a hexagon beside the
/// star of a `MovedCenter3` that is itself a single one of another run.
pub fn of_star(classes: &Classes, at: Hex, mut push: impl FnMut(LocalTriangle)) {
    if let Some(star) = Star::of(classes.subdivided, at) {
        star::emit(star, at, &Coded, |ids| push(located(classes, ids.map(decoded))));
    }
}

/// Where a place's vertex lies; `None` if there is none: at a subdivided
/// hexagon, a `MovedCenter3` that drops its centre, or a semi-hexagon without a
/// point.
pub fn position(classes: &Classes, place: Place) -> Option<Offset> {
    match place {
        Place::Leaf(at) => {
            let dropped = Star::of(classes.subdivided, at).is_some_and(Star::single);
            let is_vertex = !classes.subdivided.contains(at) && !dropped;
            is_vertex.then(|| Offset::of(at) + classes.relocation(at))
        }
        Place::Finer(at) => match at.parents() {
            (a, None) => classes.subdivided.contains(a).then(|| Offset::of(a)),
            (a, Some(b)) if classes.subdivided.contains(a) && classes.subdivided.contains(b) => {
                Some(Offset::fraction(a + b, 1, 2))
            }
            (a, Some(b)) => star::inserted_between(classes.subdivided, a, b),
        },
    }
}

fn located(classes: &Classes, places: [Place; 3]) -> LocalTriangle {
    let corners =
        places.map(|p| position(classes, p).unwrap_or_else(|| panic!("there is no vertex at {p:?}")));
    LocalTriangle { places, corners }
}

/// Places as vertex ids: leaves by their place in the window, finer ones after
/// them by theirs in the window of twice the size.
struct Coded;

impl Corners for Coded {
    fn leaf(&self, at: Hex) -> u32 {
        ((at.r + 4) * 16 + at.q + 4) as u32
    }

    fn finer(&self, at: Hex) -> u32 {
        (256 + (at.r + 8) * 32 + at.q + 8) as u32
    }
}

fn decoded(id: u32) -> Place {
    let i = i64::from(id);
    match i - 256 {
        finer @ 0.. => Place::Finer(Hex::new(finer % 32 - 8, finer / 32 - 8)),
        _ => Place::Leaf(Hex::new(i % 16 - 4, i / 16 - 4)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_grid::Window;

    #[test]
    fn places_are_coded_and_decoded() {
        for at in Window::FULL.iter() {
            assert_eq!(decoded(Coded.leaf(at)), Place::Leaf(at));
            for finer in [at.scaled(), at.scaled() + Hex::new(1, 1)] {
                assert_eq!(decoded(Coded.finer(finer)), Place::Finer(finer));
            }
        }
    }

    #[test]
    fn a_single_star_has_twelve_triangles_with_area() {
        let centre = Hex::new(4, 4);
        let classes =
            Classes::of([(5, 4), (4, 5), (5, 3)].map(|(q, r)| Hex::new(q, r)).into_iter().collect());
        let mut count = 0;
        of_star(&classes, centre, |t| {
            count += 1;
            let [a, b, c] = t.corners;
            assert!((b - a).det(c - a) > 0, "{t:?}");
        });
        assert_eq!(count, 12);
        assert_eq!(position(&classes, Place::Leaf(centre)), None);
    }
}
