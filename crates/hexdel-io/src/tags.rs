//! Numbers that a file gives its items, in any order and with gaps.

use std::collections::HashMap;

/// The numbers of items and their positions.
///
/// While numbers follow on each other only the first is kept.
#[derive(Default)]
pub(crate) struct Tags {
    first: u64,
    count: usize,
    /// All numbers, in order, and their positions, as soon as one does not follow.
    sparse: Option<(Vec<u64>, HashMap<u64, u32>)>,
}

impl Tags {
    /// Adds the number of the next item; false if it was there before.
    pub(crate) fn add(&mut self, tag: u64) -> bool {
        if self.count == 0 {
            self.first = tag;
        }
        let follows = tag.checked_sub(self.first) == Some(self.count as u64);
        if !follows && self.sparse.is_none() {
            let tags: Vec<u64> = (0..self.count as u64).map(|i| self.first + i).collect();
            let positions = tags.iter().enumerate().map(|(i, &tag)| (tag, i as u32)).collect();
            self.sparse = Some((tags, positions));
        }
        if let Some((tags, positions)) = &mut self.sparse {
            if positions.insert(tag, self.count as u32).is_some() {
                return false;
            }
            tags.push(tag);
        }
        self.count += 1;
        true
    }

    /// The number of the item at `index`; 0 if there is none.
    pub(crate) fn tag(&self, index: usize) -> u64 {
        match &self.sparse {
            Some((tags, _)) => tags.get(index).copied().unwrap_or(0),
            None => self.first.wrapping_add(index as u64),
        }
    }

    /// The position of the item with that number.
    pub(crate) fn index(&self, tag: u64) -> Option<usize> {
        match &self.sparse {
            Some((_, positions)) => positions.get(&tag).map(|&i| i as usize),
            None => tag.checked_sub(self.first).map(|i| i as usize).filter(|&i| i < self.count),
        }
    }
}

/// Items that are wanted in the order of their numbers.
pub(crate) struct Sorted<T> {
    tags: Vec<u64>,
    items: Vec<T>,
}

impl<T> Default for Sorted<T> {
    fn default() -> Self {
        Self { tags: Vec::new(), items: Vec::new() }
    }
}

impl<T: Copy> Sorted<T> {
    pub(crate) fn push(&mut self, tag: u64, item: T) {
        self.tags.push(tag);
        self.items.push(item);
    }

    /// Numbers and items; items of equal number as they came.
    pub(crate) fn sorted(self) -> (Vec<u64>, Vec<T>) {
        if self.tags.is_sorted() {
            return (self.tags, self.items);
        }
        let mut order: Vec<usize> = (0..self.tags.len()).collect();
        order.sort_by_key(|&i| self.tags[i]);
        (order.iter().map(|&i| self.tags[i]).collect(), order.iter().map(|&i| self.items[i]).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_and_disorder() {
        let mut tags = Tags::default();
        for tag in [5, 6, 7] {
            assert!(tags.add(tag));
        }
        assert_eq!((tags.index(7), tags.index(8), tags.index(4)), (Some(2), None, None));
        assert!(tags.sparse.is_none());
        assert!(tags.add(u64::MAX) && tags.add(1));
        assert!(!tags.add(6));
        assert_eq!((tags.index(5), tags.index(u64::MAX), tags.index(1)), (Some(0), Some(3), Some(4)));
        assert_eq!((tags.tag(3), tags.tag(9)), (u64::MAX, 0));
        let mut last = Tags::default();
        assert!(last.add(u64::MAX) && last.add(0));
        assert_eq!(last.index(0), Some(1));
    }

    #[test]
    fn items_are_sorted_by_number() {
        let mut items = Sorted::default();
        for (tag, item) in [(3, 'c'), (1, 'a'), (3, 'd'), (2, 'b')] {
            items.push(tag, item);
        }
        assert_eq!(items.sorted(), (vec![1, 2, 3, 3], vec!['a', 'b', 'c', 'd']));
    }
}
