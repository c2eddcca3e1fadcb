//! Which points there are, by the numbers that a session gave them.

use crate::PointId;
use std::collections::BTreeMap;

/// Each point's place in the order in which the refiner got them. Memory is taken by those
/// that are there, however many there were.
#[derive(Clone, Debug, Default)]
pub(super) struct Orders {
    /// All keys are below `named`.
    of: BTreeMap<u64, u32>,
    named: u64,
}

impl Orders {
    /// None yet, of so many that ever were.
    pub(super) fn new(named: u64) -> Self {
        Self { of: BTreeMap::new(), named }
    }

    /// Points that ever were: the number of the next.
    pub(super) fn named(&self) -> u64 {
        self.named
    }

    /// Points that are there.
    pub(super) fn len(&self) -> usize {
        self.of.len()
    }

    pub(super) fn get(&self, id: PointId) -> Option<u32> {
        self.of.get(&id.0).copied()
    }

    /// Gives a point its place, or takes it away.
    pub(super) fn set(&mut self, id: PointId, order: Option<u32>) {
        self.named = self.named.max(id.0 + 1);
        match order {
            Some(order) => self.of.insert(id.0, order),
            None => self.of.remove(&id.0),
        };
    }

    /// Points and places, by number.
    pub(super) fn iter(&self) -> impl Iterator<Item = (PointId, u32)> + '_ {
        self.of.iter().map(|(&id, &order)| (PointId(id), order))
    }
}
