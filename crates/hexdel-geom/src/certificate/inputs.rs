//! Whether every input point is a vertex.
//!
//! The inputs are sorted; each vertex is looked up. As most vertices are no
//! inputs, a bit map over a hash of the coordinates turns nearly all of them
//! away first.

use crate::par::prelude::*;
use glam::DVec2;

use super::{CHUNK, Violation, note};
use crate::mesh::TriMesh;
use crate::points::coordinate_key;

#[derive(Default)]
pub(super) struct Inputs {
    pub(super) count: usize,
    pub(super) kept: usize,
    pub(super) violations: Vec<Violation>,
}

pub(super) fn check(mesh: &TriMesh, inputs: &[DVec2], cap: usize) -> Inputs {
    let mut sum = Inputs { count: inputs.len(), ..Inputs::default() };
    if inputs.is_empty() {
        return sum;
    }
    let wanted = Wanted::new(inputs);
    let found: Vec<Vec<usize>> = mesh
        .vertices
        .par_chunks(CHUNK)
        .map(|chunk| chunk.iter().filter_map(|&p| wanted.position(p)).collect())
        .collect();
    let mut is_vertex = vec![false; wanted.keys.len()];
    for position in found.into_iter().flatten() {
        is_vertex[position] = true;
    }
    for (input, &at) in inputs.iter().enumerate() {
        if wanted.position(at).is_some_and(|position| is_vertex[position]) {
            sum.kept += 1;
        } else {
            note(&mut sum.violations, cap, || Violation::InputMissing { input, at });
        }
    }
    sum
}

/// A set of points.
struct Wanted {
    /// Coordinate keys, sorted and distinct.
    keys: Vec<[u64; 2]>,
    /// Bit map over hashes; the bit of every key is set.
    seen: Vec<u64>,
    /// 64 minus the binary logarithm of the number of bits.
    shift: u32,
}

impl Wanted {
    fn new(points: &[DVec2]) -> Self {
        let mut keys: Vec<[u64; 2]> = points.iter().map(|&p| coordinate_key(p)).collect();
        keys.par_sort_unstable();
        keys.dedup();
        // 16 to 32 bits per key let one vertex in 16 or fewer through.
        let log = (keys.len().ilog2() + 5).max(6);
        let mut wanted = Self { seen: vec![0; 1 << (log - 6)], shift: 64 - log, keys };
        for i in 0..wanted.keys.len() {
            let bit = wanted.bit(wanted.keys[i]);
            wanted.seen[bit >> 6] |= 1 << (bit & 63);
        }
        wanted
    }

    /// Position of `p` among the keys.
    fn position(&self, p: DVec2) -> Option<usize> {
        let key = coordinate_key(p);
        let bit = self.bit(key);
        if self.seen[bit >> 6] >> (bit & 63) & 1 == 0 {
            return None;
        }
        self.keys.binary_search(&key).ok()
    }

    /// Multiplicative hashing; coordinates differ in high bits as often as in
    /// low ones, so both words are folded by a product of their own.
    fn bit(&self, [x, y]: [u64; 2]) -> usize {
        let hash = (x ^ (x >> 32)).wrapping_mul(0x9e37_79b9_7f4a_7c15)
            ^ (y ^ (y >> 29)).wrapping_mul(0xc2b2_ae3d_27d4_eb4f).rotate_left(31);
        (hash.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> self.shift) as usize
    }
}
