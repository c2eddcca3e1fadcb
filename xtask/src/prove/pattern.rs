//! Patterns of subdivided hexagons, and the order in which they are decided.
//!
//! A *unit* is what the dual is made of at one place of one level: a lattice
//! triangle, or the star of a `MovedCenter3`. Its *patch* is every hexagon that
//! the places of its corners can depend on: a hexagon's own fins lie one step
//! away, the fins of the `MovedCenter3` that it is the top of, two.
//!
//! ```text
//!       . . . .                 . . .
//!      . . . . .               . * * .       * decided beforehand:
//!     . . c . . .             . * x * .        the fins of the star
//!      . c c . .               . . t .
//!       . . . .                 . . .
//!    a triangle: 27       the star of x: 19, around its top t
//! ```

use hexdel_classify::dual::local;
use hexdel_classify::dual::local::LocalTriangle;
use hexdel_classify::{Class, Classes};
use hexdel_grid::{Direction, Hex, Window};

/// The middle of the window's tile, where units are laid.
pub(crate) const CENTRE: Hex = Hex::new(3, 3);

/// What the dual is made of at one place of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    /// A lattice triangle, pointing up or down.
    Triangle {
        /// Whether it points up.
        up: bool,
    },
    /// The star of a `MovedCenter3`, by the direction of its middle fin.
    Star {
        /// The direction of the middle fin.
        middle: Direction,
    },
}

impl Unit {
    /// All units of a level, up to translation.
    pub(crate) fn all() -> Vec<Self> {
        let triangles = [true, false].map(|up| Self::Triangle { up });
        let stars = Direction::ALL.map(|middle| Self::Star { middle });
        triangles.into_iter().chain(stars).collect()
    }

    /// One unit of each kind: the others are its images.
    pub(crate) fn representatives() -> Vec<Self> {
        vec![Self::Triangle { up: true }, Self::Star { middle: Direction::ALL[0] }]
    }

    /// The corners of the lattice triangle, counter-clockwise; for a star,
    /// three times its hexagon's top.
    pub(crate) fn anchors(self) -> [Hex; 3] {
        let step = |i| Direction::new(i).step();
        match self {
            Self::Triangle { up: true } => [CENTRE, CENTRE + step(0), CENTRE + step(1)],
            Self::Triangle { up: false } => [CENTRE + step(0), CENTRE + step(0) + step(1), CENTRE + step(1)],
            Self::Star { .. } => [CENTRE; 3],
        }
    }

    /// The hexagons decided before the search, with their states.
    fn given(self) -> Vec<(Hex, bool)> {
        let Self::Star { middle } = self else {
            return Vec::new();
        };
        let x = CENTRE + middle.step();
        let fin = |d: Direction| [5, 0, 1].contains(&((d.index() + 6 - middle.index()) % 6));
        let around = Direction::ALL.into_iter().map(|d| (x.neighbour(d), fin(d)));
        std::iter::once((x, false)).chain(around).collect()
    }

    /// The triangles that the unit stands for in a pattern.
    pub(crate) fn triangles(self, classes: &Classes, push: impl FnMut(LocalTriangle)) {
        match self {
            Self::Triangle { .. } => local::of_lattice_triangle(classes, self.anchors(), push),
            Self::Star { middle } => local::of_star(classes, CENTRE + middle.step(), push),
        }
    }

    /// The maps of the plane that leave the unit's place as it is.
    fn symmetries(self) -> Vec<Box<dyn Fn(Hex) -> Hex>> {
        let affine = |from: [Hex; 3], to: [Hex; 3]| -> Box<dyn Fn(Hex) -> Hex> {
            let (u, v) = (from[1] - from[0], from[2] - from[0]);
            let det = u.q * v.r - u.r * v.q;
            Box::new(move |at| {
                let w = at - from[0];
                let i = (w.q * v.r - w.r * v.q) / det;
                let j = (u.q * w.r - u.r * w.q) / det;
                to[0] + (to[1] - to[0]) * i + (to[2] - to[0]) * j
            })
        };
        match self {
            Self::Triangle { .. } => {
                let c = self.anchors();
                let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
                orders.into_iter().map(|o| affine(c, o.map(|i| c[i]))).collect()
            }
            Self::Star { middle } => {
                let (left, right) = (CENTRE.neighbour(middle.turned(1)), CENTRE.neighbour(middle.turned(5)));
                vec![
                    affine([CENTRE, left, right], [CENTRE, left, right]),
                    affine([CENTRE, left, right], [CENTRE, right, left]),
                ]
            }
        }
    }

    /// A name for the configuration: what kind of triangle it is, by the
    /// classes of its corners on this level.
    pub(crate) fn kind(self, classes: &Classes) -> String {
        match self {
            Self::Triangle { .. } => kind_of_triangle(classes, self.anchors()),
            Self::Star { .. } => match classes.under_of(CENTRE).count_ones() {
                1 => "star of a single MovedCenter3".to_owned(),
                n => format!("stars of a run of {n} MovedCenter3"),
            },
        }
    }
}

fn kind_of_triangle(classes: &Classes, corners: [Hex; 3]) -> String {
    let mut names: Vec<_> = corners
        .iter()
        .filter_map(|&at| match classes.class_of(at) {
            Class::Subdivided => None,
            Class::MovedCenter4 => Some(format!("MovedCenter4 of {}", classes.under_of(at).count_ones())),
            Class::FixedCenterRegular => Some("Fixed".to_owned()),
            other => Some(format!("{other:?}")),
        })
        .collect();
    names.sort();
    let sort = match names.len() {
        3 => "three leaves",
        2 => "one subdivided",
        _ => "two subdivided",
    };
    format!("{sort}: {}", names.join(", "))
}

/// The order in which the hexagons around a unit are decided.
///
/// All patterns decided to the same depth know the same hexagons.
pub(crate) struct Plan {
    /// The unit in the middle.
    pub(crate) unit: Unit,
    /// Hexagons decided beforehand that are subdivided.
    pub(crate) given: Window,
    /// Hexagons in the order they are decided: first the patch, then those
    /// around it.
    pub(crate) order: Vec<Hex>,
    /// How many of `order` belong to the patch.
    pub(crate) patch: usize,
    /// By depth: what is decided, and the hexagons within it whose
    /// neighbours are decided as well, out to one and to two steps.
    pub(crate) known: Vec<[Window; 3]>,
    /// The patch, those decided beforehand included.
    pub(crate) members: Vec<Hex>,
    /// For each map that leaves the unit's place: where each member goes.
    images: Vec<Vec<usize>>,
}

/// How many steps beyond the patch a pattern can be continued: as far as the
/// window reaches.
const BEYOND: u64 = 2;

impl Plan {
    /// The order for a unit.
    pub(crate) fn new(unit: Unit) -> Self {
        let anchors = unit.anchors();
        let near = |at: Hex| anchors.iter().map(|a| a.distance(at)).min().unwrap_or(0);
        // Ring by ring, each in the order of the angle around the first
        // anchor, so that neighbourhoods are complete as early as possible.
        let turn = |at: Hex| {
            let v = hexdel_classify::Offset::of(at - anchors[0]).cartesian();
            (v.y.atan2(v.x) * 1e6) as i64
        };
        let given = unit.given();
        let is_given = |at: Hex| given.iter().any(|&(g, _)| g == at);
        let mut order: Vec<_> = Window::FULL
            .iter()
            .filter(|&at| near(at) <= 2 + BEYOND && !is_given(at))
            .map(|at| (near(at), turn(at), at))
            .collect();
        order.sort_unstable();
        let patch = order.iter().filter(|(n, _, _)| *n <= 2).count();
        let order: Vec<_> = order.into_iter().map(|(_, _, at)| at).collect();
        let start: Window = given.iter().map(|&(at, _)| at).collect();
        let known = (0..=order.len())
            .map(|n| {
                let known = start | order[..n].iter().copied().collect();
                let inner = |w: Window| !(!w).dilated();
                [known, inner(known), inner(inner(known))]
            })
            .collect();
        let mut members: Vec<_> = given.iter().map(|&(at, _)| at).collect();
        members.extend(&order[..patch]);
        let place =
            |at| members.iter().position(|&m| m == at).expect("a patch has the symmetries of its unit");
        let images =
            unit.symmetries().iter().map(|map| members.iter().map(|&at| place(map(at))).collect()).collect();
        let given = given.iter().filter(|(_, s)| *s).map(|&(at, _)| at).collect();
        Self { unit, given, order, patch, known, members, images }
    }

    /// Whether a pattern of the patch is the least of its images: one of each
    /// orbit is.
    pub(crate) fn is_least(&self, subdivided: Window) -> bool {
        let bits: Vec<bool> = self.members.iter().map(|&at| subdivided.contains(at)).collect();
        let mask =
            |image: &[usize]| image.iter().zip(&bits).fold(0_u64, |m, (&to, &bit)| m | u64::from(bit) << to);
        let own = mask(&self.images[0]);
        self.images[1..].iter().all(|image| own <= mask(image))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_have_the_sizes_of_the_sketch() {
        for unit in Unit::all() {
            let plan = Plan::new(unit);
            let size = if matches!(unit, Unit::Triangle { .. }) { 27 } else { 19 };
            assert_eq!(plan.members.len(), size);
            assert!(plan.images.iter().all(|i| {
                let mut sorted = i.clone();
                sorted.sort_unstable();
                sorted.iter().copied().eq(0..size)
            }));
        }
    }

    #[test]
    fn one_of_each_orbit_is_least() {
        let plan = Plan::new(Unit::Triangle { up: true });
        let corners = plan.unit.anchors();
        let single = corners.iter().filter(|&&at| plan.is_least(Window::from_iter([at]))).count();
        assert_eq!(single, 1);
    }
}
