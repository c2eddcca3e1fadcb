//! What a tile's subdivided hexagons bring forth one level finer.
//!
//! ```text
//!   (2q, 2r+1)    (2q+1, 2r+1)       even places are scaled centres; the
//!       r+1           x              others lie in the middle of two
//!         \          / \             neighbours, and are full hexagons if
//!          \        /   \            both are subdivided
//!         (q,r) --- (q+1, r)
//!   (2q, 2r)      (2q+1, 2r)
//! ```
//!
//! A tile's square is covered by four tiles one level finer. Their bits are
//! made from the four kinds of places, each a plane of the coarser tile.

use super::star;
use crate::class::Classes;
use hexdel_grid::{Direction, Window};

/// Bits of the four tiles one level finer, by quadrant.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Brood {
    /// Full hexagons.
    pub(super) exists: [u64; 4],
    /// Semi-hexagons on which a `MovedCenter3` inserts a point.
    pub(super) inserted: [u64; 4],
}

impl Brood {
    /// The full hexagons under a tile.
    pub(super) fn of(subdivided: Window) -> Self {
        let [east, up] = [0, 1].map(|d| subdivided.at(Direction::new(d)));
        let planes = [subdivided, subdivided & east, subdivided & up, east & up];
        Self { exists: interleaved(planes.map(Window::centre)), inserted: [0; 4] }
    }

    /// Adds the points that `MovedCenter3` insert.
    pub(super) fn insert(&mut self, classes: &Classes) {
        let on_fin = star::fins_with_vertex(classes);
        let [east, up] = [0, 1].map(Direction::new);
        // The fin in a direction of one parent is the other parent.
        let planes = [
            Window::EMPTY,
            on_fin[0] | on_fin[3].at(east),
            on_fin[1] | on_fin[4].at(up),
            on_fin[2].at(east) | on_fin[5].at(up),
        ];
        self.inserted = interleaved(planes.map(Window::centre));
    }
}

/// Four planes of a tile to their places one level finer: plane `i` to the
/// places with column and row parity `(i % 2, i / 2)`.
fn interleaved(planes: [u64; 4]) -> [u64; 4] {
    std::array::from_fn(|quadrant| {
        let corner = 32 * (quadrant >> 1) + 4 * (quadrant & 1);
        let [a, b, c, d] = planes.map(|plane| doubled(plane >> corner));
        a | b << 1 | c << 8 | d << 9
    })
}

/// Four by four of a tile's bits to twice their addresses.
const fn doubled(bits: u64) -> u64 {
    // Rows of four from eight apart to sixteen apart, then columns.
    let x = bits & 0x0f0f_0f0f;
    let x = (x | x << 16) & 0x0000_0f0f_0000_0f0f;
    let x = (x | x << 8) & 0x000f_000f_000f_000f;
    let x = (x | x << 2) & 0x0033_0033_0033_0033;
    (x | x << 1) & 0x0055_0055_0055_0055
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_grid::Hex;
    use hexdel_grid::grid::hex_of;
    use hexdel_grid::window::ones;

    /// A window without pattern.
    fn scattered(seed: i64) -> Window {
        Window::FULL.iter().filter(|h| (h.q * 7 + h.r * 13 + h.q * h.r * seed).rem_euclid(5) < 3).collect()
    }

    #[test]
    fn a_hexagon_exists_if_its_parents_are_subdivided() {
        for seed in 0..50 {
            let subdivided = scattered(seed);
            let brood = Brood::of(subdivided);
            for quadrant in 0..4_usize {
                let corner = Hex::new(8 * (quadrant as i64 & 1), 8 * (quadrant as i64 >> 1));
                for bit in 0..64 {
                    let (a, b) = (corner + hex_of(bit)).parents();
                    let expected = subdivided.contains(a) && b.is_none_or(|b| subdivided.contains(b));
                    assert_eq!(brood.exists[quadrant] >> bit & 1 == 1, expected);
                }
            }
        }
    }

    #[test]
    fn points_are_inserted_between_a_fin_and_its_three_finned_hexagon() {
        let mut found = 0;
        for seed in 0..200_i64 {
            // Holes, whose corners have three fins.
            let centre = |i: i64| Hex::new((seed * 7 + i * 5) % 16 - 4, (seed * 3 + i * 11) % 16 - 4);
            let disc = |i: i64| centre(i).disc(((seed + i) % 3 + 1) as u32);
            let inside = |h: &Hex| Window::with_margin(4).iter().any(|w| w == *h);
            let subdivided = !(0..4).flat_map(disc).filter(inside).collect::<Window>();
            let classes = Classes::of(subdivided);
            let mut brood = Brood::of(subdivided);
            brood.insert(&classes);
            for quadrant in 0..4_usize {
                let corner = Hex::new(8 * (quadrant as i64 & 1), 8 * (quadrant as i64 >> 1));
                for at in ones(brood.inserted[quadrant]).map(|bit| corner + hex_of(bit)) {
                    let (a, b) = at.parents();
                    let b = b.expect("a semi-hexagon has two parents");
                    let by = |h, fin| classes.moved3.contains(h) && subdivided.contains(fin);
                    assert!(by(a, b) || by(b, a));
                    found += 1;
                }
            }
        }
        assert!(found > 100);
    }
}
