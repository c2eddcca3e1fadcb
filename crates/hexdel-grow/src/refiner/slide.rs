//! Vertices on segments: one dimension, solved exactly.

use hexdel_geom::DVec2;
use hexdel_optimize::edit::{Cavity, MOST_EDGES, NONE};

use super::place::Outline;
use super::search::DEPTH;
use super::{Candidate, Refiner};

/// Cavities looked at on each side.
const NODES: usize = 20;

/// Places found on each side.
const RANGES: usize = 5;

/// Parts of an edge at its ends that are left alone.
const ENDS: f64 = 1e-3;

/// The least width of a range that is taken, as part of the edge.
const WIDTH: f64 = 1e-4;

/// How far inside a bound the ends of a range are, as a cotangent.
const INSIDE: f64 = 1e-9;

/// Places on an edge that leave the fan in a cavity beside it within the bounds: those between two ends but for
/// some gaps, where an angle at the vertex would be obtuse.
#[derive(Clone, Copy)]
struct Range {
    cavity: Cavity,
    ends: [f64; 2],
    gaps: [[f64; 2]; MOST_EDGES],
    count: usize,
}

impl Range {
    /// Keeps places `s` with `a + b s >= 0`.
    fn keep(&mut self, a: f64, b: f64) {
        if b > 0.0 {
            self.ends[0] = self.ends[0].max(-a / b);
        } else if b < 0.0 {
            self.ends[1] = self.ends[1].min(-a / b);
        } else if a < 0.0 {
            self.ends[1] = -1.0;
        }
    }

    fn is_empty(&self) -> bool {
        self.ends[0] >= self.ends[1]
    }

    fn gaps(&self) -> &[[f64; 2]] {
        &self.gaps[..self.count]
    }

    /// Seen from the other side of the edge.
    fn mirrored(&self) -> Self {
        let mut other = *self;
        other.ends = [1.0 - self.ends[1], 1.0 - self.ends[0]];
        for gap in &mut other.gaps[..self.count] {
            *gap = [1.0 - gap[1], 1.0 - gap[0]];
        }
        other
    }

    /// The middle of the widest part that is in this range and another.
    fn widest(&self, other: Option<&Self>) -> Option<f64> {
        let [mut low, mut high] = self.ends;
        let mut gaps = [[0.0; 2]; 2 * MOST_EDGES];
        let mut count = self.count;
        gaps[..count].copy_from_slice(self.gaps());
        if let Some(other) = other {
            low = low.max(other.ends[0]);
            high = high.min(other.ends[1]);
            gaps[count..count + other.count].copy_from_slice(other.gaps());
            count += other.count;
        }
        let gaps = &mut gaps[..count];
        gaps.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let (mut widest, mut found) = (WIDTH, None);
        for gap in gaps.iter().chain([&[high, high]]) {
            let end = gap[0].min(high);
            if end - low > widest {
                (widest, found) = (end - low, Some(0.5 * (end + low)));
            }
            low = low.max(gap[1]);
        }
        found
    }
}

impl Refiner<'_> {
    /// Moves a vertex of a triangle along its segment to where all triangles around it are within the bounds; the cavity
    /// may take more triangles than its own.
    pub(crate) fn slide_one(&mut self, t: u32) -> bool {
        for v in self.mesh.vertices(t) {
            if !self.mesh.kind[v as usize].slides() {
                continue;
            }
            let Some([left, right]) = self.mesh.cavities_beside(v) else { continue };
            let right = (!right.is_empty()).then_some(right);
            if let Some(candidate) = self.on_edge(&left, right.as_ref()) {
                self.stats.moves += 1;
                self.commit(&candidate);
                return true;
            }
        }
        false
    }

    /// Inserts a vertex on one of the triangle's own or other segments that were met, if that leaves no bad triangle.
    pub(super) fn insert_on_segments(&mut self, t: u32) -> bool {
        let own = (3 * t..3 * t + 3).filter(|&c| self.mesh.segment(c).is_some() && !self.mesh.is_locked(c));
        let mut met: Vec<u32> = own.collect();
        met.extend(self.segments_met.iter().filter(|c| *c / 3 != t));
        for c in met {
            let twin = self.mesh.twin[c as usize];
            let other = (twin != NONE).then(|| self.mesh.cavity_on(twin));
            if let Some(candidate) = self.on_edge(&self.mesh.cavity_on(c), other.as_ref()) {
                self.insert(&candidate);
                return true;
            }
        }
        false
    }

    /// A place on an edge that is good for a cavity on each side, grown from these.
    pub(crate) fn on_edge(&mut self, one: &Cavity, other: Option<&Cavity>) -> Option<Candidate> {
        let segment = self.mesh.segment(one.inner(0)).filter(|_| !self.mesh.is_locked(one.inner(0)))?;
        let place = |m: &Self, cavity: &Cavity, s: f64| {
            let [a, b] = [0, 1].map(|i| m.mesh.at(cavity.ring()[i]));
            m.on_segment(segment, a + s * (b - a))
        };
        let ranges = self.ranges(one);
        if ranges.is_empty() {
            return None;
        }
        let Some(other) = other else {
            return ranges.iter().find_map(|range| {
                let at = place(self, &range.cavity, range.widest(None)?);
                (self.fan_bad(&range.cavity, at) == 0).then(|| Candidate::new(&range.cavity, at))
            });
        };
        for beyond in self.ranges(other) {
            let mirrored = beyond.mirrored();
            for range in &ranges {
                let Some(s) = range.widest(Some(&mirrored)) else { continue };
                let at = place(self, &range.cavity, s);
                let good = self.fan_bad(&range.cavity, at) == 0 && self.fan_bad(&beyond.cavity, at) == 0;
                if good && !range.cavity.touches(&beyond.cavity) {
                    return Some(Candidate { cavity: range.cavity, other: Some(beyond.cavity), at });
                }
            }
        }
        None
    }

    /// Cavities grown from one with places in them, by breadth.
    fn ranges(&mut self, seed: &Cavity) -> Vec<Range> {
        let (mut cavities, mut found) = (vec![*seed], Vec::new());
        let mut i = 0;
        while i < cavities.len().min(NODES) && found.len() < RANGES {
            let cavity = cavities[i];
            i += 1;
            match self.outline(&cavity) {
                Outline::Fits => {
                    found.extend(self.range(&cavity).filter(|range| range.widest(None).is_some()));
                    for edge in 1..cavity.len() {
                        self.grow(&mut cavities, &cavity, edge);
                    }
                }
                Outline::Corner(j) if cavity.triangles().len() < DEPTH => {
                    if j != 0 {
                        self.grow(&mut cavities, &cavity, j);
                    }
                    if j != 1 {
                        self.grow(&mut cavities, &cavity, cavity.before(j));
                    }
                }
                _ => {}
            }
        }
        found
    }

    /// The places on edge 0 of a cavity that leave its fan within the bounds.
    fn range(&self, cavity: &Cavity) -> Option<Range> {
        let at = |i: usize| self.mesh.at(cavity.ring()[i]);
        let (start, d) = (at(0), at(1) - at(0));
        let mut range =
            Range { cavity: *cavity, ends: [ENDS, 1.0 - ENDS], gaps: [[0.0; 2]; MOST_EDGES], count: 0 };
        let n = cavity.len();
        for i in 1..n {
            let (p, e) = (at(i), at(cavity.after(i)) - at(i));
            self.restrict(&mut range, start - p, d, e, [i != 1, i + 1 != n])?;
        }
        Some(range)
    }

    /// Leaves the places `s` for which the triangle over edge `e` with the apex `from + s d`, seen from the edge's start, is
    /// within the bounds; at the edge's `ends` only if asked.
    fn restrict(&self, range: &mut Range, from: DVec2, d: DVec2, e: DVec2, ends: [bool; 2]) -> Option<()> {
        let (lo, hi) = (self.limits.lo * (1.0 - INSIDE), INSIDE);
        // Dot and cross products with the edge are linear in s.
        let length_sq = e.length_squared();
        let (dot, by_dot) = (e.dot(from), e.dot(d));
        let (cross, by_cross) = (e.perp_dot(from), e.perp_dot(d));
        if ends[0] {
            range.keep(dot - hi * cross, by_dot - hi * by_cross);
            range.keep(lo * cross - dot, lo * by_cross - by_dot);
        }
        if ends[1] {
            range.keep(length_sq - dot - hi * cross, -by_dot - hi * by_cross);
            range.keep(lo * cross - length_sq + dot, lo * by_cross + by_dot);
        }
        if range.is_empty() {
            return None;
        }
        // The dot product at the apex is quadratic.
        let (a, b, c) = (d.length_squared(), 2.0 * d.dot(from) - by_dot, from.length_squared() - dot);
        for (cot, is_inside) in [(hi, false), (lo, true)] {
            let (b, c) = (b - cot * by_cross, c - cot * cross);
            let discriminant = b * b - 4.0 * a * c;
            if discriminant <= 0.0 {
                if is_inside {
                    return None;
                }
                continue;
            }
            let root = discriminant.sqrt();
            let [low, high] = [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)];
            if is_inside {
                range.ends = [range.ends[0].max(low), range.ends[1].min(high)];
            } else if range.count < MOST_EDGES && high > 0.0 && low < 1.0 {
                range.gaps[range.count] = [low, high];
                range.count += 1;
            }
        }
        if range.is_empty() { None } else { Some(()) }
    }
}
