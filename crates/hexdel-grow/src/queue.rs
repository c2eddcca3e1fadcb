//! The queue: by urgency, then by the length of the shortest edge in steps of a tenth.

/// Bits of a squared length that make its bucket: exponent and two of the mantissa.
const SHIFT: u32 = 50;

/// Buckets of one level.
const BUCKETS: usize = 1 << (63 - SHIFT);

/// How urgent a triangle is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Level {
    /// The triangle is too large.
    Large,
    /// An angle is far below what a start of the mesh has: the cheap repairs only.
    Urgent,
    /// All repairs.
    Rest,
    /// All repairs, after all others: segments would have to be divided.
    Late,
}

const LEVELS: [Level; 4] = [Level::Large, Level::Urgent, Level::Rest, Level::Late];

/// Triangles with the stamps they had, in buckets.
#[derive(Debug)]
pub(crate) struct Queue {
    buckets: Vec<Vec<(u32, u32)>>,
    /// A bit for each bucket that is not empty.
    filled: Vec<u64>,
    /// No bucket before it is filled.
    low: usize,
}

impl Queue {
    pub(crate) fn new() -> Self {
        let all = LEVELS.len() * BUCKETS;
        Self { buckets: vec![Vec::new(); all], filled: vec![0; all / 64], low: all }
    }

    pub(crate) fn push(&mut self, t: u32, stamp: u32, level: Level, length_sq: f64) {
        let k = ((length_sq.to_bits() >> SHIFT) as usize & (BUCKETS - 1)) + BUCKETS * level as usize;
        self.buckets[k].push((t, stamp));
        self.filled[k / 64] |= 1 << (k % 64);
        self.low = self.low.min(k);
    }

    /// Takes the first triangle that still has the stamp it came with.
    pub(crate) fn pop(&mut self, stamps: &[u32]) -> Option<(u32, Level)> {
        loop {
            let k = self.first()?;
            self.low = k;
            while let Some((t, stamp)) = self.buckets[k].pop() {
                if stamps[t as usize] == stamp {
                    let level = LEVELS[k / BUCKETS];
                    return Some((t, level));
                }
            }
            self.filled[k / 64] &= !(1 << (k % 64));
        }
    }

    fn first(&self) -> Option<usize> {
        let mut word = self.low / 64;
        let mut bits = *self.filled.get(word)? & (u64::MAX << (self.low % 64));
        while bits == 0 {
            word += 1;
            bits = *self.filled.get(word)?;
        }
        Some(64 * word + bits.trailing_zeros() as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn urgent_and_short_first() {
        let mut queue = Queue::new();
        let stamps = vec![0; 5];
        queue.push(0, 0, Level::Rest, 1e-8);
        queue.push(1, 0, Level::Urgent, 4.0);
        queue.push(2, 0, Level::Urgent, 0.5);
        queue.push(3, 7, Level::Urgent, 0.1);
        queue.push(4, 0, Level::Late, 1e-20);
        let mut order = Vec::new();
        while let Some((t, _)) = queue.pop(&stamps) {
            order.push(t);
        }
        assert_eq!(order, [2, 1, 0, 4]);
        queue.push(0, 0, Level::Urgent, 1.0);
        assert_eq!(queue.pop(&stamps), Some((0, Level::Urgent)));
        assert_eq!(queue.pop(&stamps), None);
    }
}
