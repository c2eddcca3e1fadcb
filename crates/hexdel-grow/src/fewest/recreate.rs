//! Putting Steiner points in where triangles are bad.

use super::Search;
use super::candidates::Offer;
use crate::refiner::Refiner;

/// Motions of one step that mend something, at most.
const MOVES: usize = 6;

/// Rings around a bad triangle that motion may move, at most.
const RINGS: usize = 2;

/// Bad triangles, more than were there before, that are hopeless: for each Steiner point left to insert, and as many more.
const HOPELESS: [usize; 2] = [3, 6];

impl Search<'_> {
    /// Mends bad triangles, at random one by one, by motion or a Steiner point, at most so many of them. How many are
    /// bad in the end; none if the window is not to be used.
    pub(super) fn recreate(&mut self, most: usize, before: usize) -> Option<usize> {
        let (mut left, mut moves) = (most, MOVES);
        let mut offers: Vec<Offer> = Vec::new();
        loop {
            let bad = self.count_bad_here()?;
            if bad == 0 {
                return Some(0);
            }
            let t = self.bad_here[self.random.below(bad)];
            if moves > 0 && self.refiner.move_around(t) {
                moves -= 1;
                continue;
            }
            if left == 0 || bad > before + HOPELESS[0] * left + HOPELESS[1] {
                if moves > 0 && self.move_any() {
                    moves -= 1;
                    continue;
                }
                return Some(bad);
            }
            offers.clear();
            self.refiner.offers(t, &mut offers);
            // Equal ones at random.
            let keyed = offers.iter().map(|offer| (offer.bad_more, self.random.unit(), offer));
            let Some((_, _, best)) = keyed.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))) else {
                return Some(bad);
            };
            self.refiner.commit(&best.candidate);
            left -= 1;
        }
    }

    /// Mends one of the bad triangles by motion.
    fn move_any(&mut self) -> bool {
        self.bad_here.iter().any(|&t| self.refiner.move_around(t))
    }
}

impl Refiner<'_> {
    /// Mends a triangle by motion of its vertices, or of those around it.
    fn move_around(&mut self, t: u32) -> bool {
        self.flip_cocircular(t)
            || self.move_one(t)
            || self.slide_one(t)
            || (0..RINGS).any(|rings| self.move_patch(t, rings))
    }
}
