//! Tiles that wait for their turn.

use hexdel_grid::TileId;
use hexdel_grid::window::ones;

/// A set of tiles of one level, taken in the order of their ids.
#[derive(Clone, Debug)]
pub(crate) struct Queue {
    /// A bit per tile id; clear beyond the end.
    words: Vec<u64>,
    /// All words that are not zero lie from here ..
    start: usize,
    /// .. to before here; if there are none, this is 0 and the start is the
    /// largest of numbers, such that a word more is a minimum and a maximum.
    end: usize,
}

impl Default for Queue {
    fn default() -> Self {
        Self { words: Vec::new(), start: usize::MAX, end: 0 }
    }
}

impl Queue {
    #[inline]
    pub(crate) fn push(&mut self, id: TileId) {
        let (word, bit) = (id.index() / 64, id.index() % 64);
        if word >= self.words.len() {
            // As a vector grows: the level's tiles are made one by one.
            self.words.resize((word + 1).next_power_of_two(), 0);
        }
        self.words[word] |= 1 << bit;
        (self.start, self.end) = (self.start.min(word), self.end.max(word + 1));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.end == 0
    }

    /// The tiles, in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = TileId> {
        let words = (self.start..self.end).map(|word| (64 * word, self.words[word]));
        words.flat_map(|(first, word)| ones(word).map(move |bit| TileId::new(first + bit as usize)))
    }

    /// Empties the queue; in order.
    pub(crate) fn take(&mut self) -> Vec<TileId> {
        let tiles = self.iter().collect();
        if !self.is_empty() {
            self.words[self.start..self.end].fill(0);
            (self.start, self.end) = (usize::MAX, 0);
        }
        tiles
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_come_once_and_in_order() {
        let mut queue = Queue::default();
        assert!(queue.is_empty());
        for i in [700, 3, 64, 3, 65, 0] {
            queue.push(TileId::new(i));
        }
        assert!(!queue.is_empty());
        let taken: Vec<_> = queue.take().into_iter().map(TileId::index).collect();
        assert_eq!(taken, [0, 3, 64, 65, 700]);
        assert!(queue.is_empty());
        assert!(queue.take().is_empty());
    }
}
