//! Tiles, or points, that wait for their turn.

use hexdel_grid::window::ones;

/// Several sets of ids, of which each is taken in order.
#[derive(Clone, Debug)]
pub(crate) struct Queues<const N: usize> {
    /// A bit per id, of each set.
    words: Vec<[u64; N]>,
    /// Which of the sets may hold something.
    any: [bool; N],
}

impl<const N: usize> Default for Queues<N> {
    fn default() -> Self {
        Self { words: Vec::new(), any: [false; N] }
    }
}

impl<const N: usize> Queues<N> {
    /// Adds an id to some of the sets.
    #[inline]
    pub(crate) fn push(&mut self, id: usize, to: [bool; N]) {
        let (word, bit) = (id / 64, id % 64);
        if word >= self.words.len() {
            self.grow(word);
        }
        let words = &mut self.words[word];
        for (set, to) in to.into_iter().enumerate() {
            words[set] |= u64::from(to) << bit;
            self.any[set] |= to;
        }
    }

    /// As a vector grows: ids are made one by one.
    #[cold]
    fn grow(&mut self, word: usize) {
        self.words.resize((word + 1).next_power_of_two(), [0; N]);
    }

    pub(crate) fn is_empty(&self, set: usize) -> bool {
        !self.any[set]
    }

    /// Empties a set; in order.
    pub(crate) fn take<T>(&mut self, set: usize, id: impl Fn(usize) -> T) -> Vec<T> {
        let mut all = Vec::new();
        if std::mem::take(&mut self.any[set]) {
            for (first, words) in (0..).step_by(64).zip(&mut self.words) {
                let bits = std::mem::take(&mut words[set]);
                all.extend(ones(bits).map(|bit| id(first + bit as usize)));
            }
        }
        all
    }

    /// Makes one set equal to another.
    pub(crate) fn copy(&mut self, from: usize, to: usize) {
        for words in &mut self.words {
            words[to] = words[from];
        }
        self.any[to] = self.any[from];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_come_once_and_in_order() {
        let mut queues = Queues::<2>::default();
        for i in [700, 3, 64, 3, 65, 0] {
            queues.push(i, [i > 3, true]);
        }
        assert!(!queues.is_empty(0) && !queues.is_empty(1));
        assert_eq!(queues.take(1, |id| id), [0, 3, 64, 65, 700]);
        assert!(queues.is_empty(1) && queues.take(1, |id| id).is_empty());
        queues.copy(0, 1);
        for set in 0..2 {
            assert_eq!(queues.take(set, |id| id), [64, 65, 700]);
        }
    }
}
