//! Tiles, or points, that wait for their turn.

use hexdel_grid::window::ones;

/// A set of tiles of one level, or of points, by their ids; taken in order.
#[derive(Clone, Debug)]
pub(crate) struct Queue {
    /// A bit per id; clear beyond the end.
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
    pub(crate) fn push(&mut self, id: usize) {
        let (word, bit) = (id / 64, id % 64);
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

    /// Empties the queue; in order.
    pub(crate) fn take<T>(&mut self, id: impl Fn(usize) -> T) -> Vec<T> {
        let mut all = Vec::new();
        for word in self.start..self.end {
            let bits = std::mem::take(&mut self.words[word]);
            all.extend(ones(bits).map(|bit| id(64 * word + bit as usize)));
        }
        (self.start, self.end) = (usize::MAX, 0);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_come_once_and_in_order() {
        let mut queue = Queue::default();
        assert!(queue.is_empty());
        for i in [700, 3, 64, 3, 65, 0] {
            queue.push(i);
        }
        assert!(!queue.is_empty());
        assert_eq!(queue.take(|id| id), [0, 3, 64, 65, 700]);
        assert!(queue.is_empty());
        assert!(queue.take(|id| id).is_empty());
    }
}
