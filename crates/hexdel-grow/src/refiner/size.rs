//! Triangles that are too large: vertices are put in front of short edges, as far away as edges are wanted long.
//!
//! As triangles with the shortest edges come first, fronts spread from what is fine already, and most triangles come out
//! nearly equilateral. The idea of placing vertices there: Rebay, "Efficient unstructured mesh generation by means of
//! Delaunay triangulation and Bowyer-Watson algorithm", J. Comput. Phys. 106 (1993).

use hexdel_geom::{DVec2, Monitor};
use hexdel_optimize::edit::{Cavity, Kind};

use super::place::{Outline, TURNED};
use super::{Candidate, Refiner};
use crate::error::GrowError;
use crate::limits::{Shape, surely_turns_left};
use crate::options::Size;

/// Lengths aimed at over those allowed: some edges become longer than aimed at.
const AIM: f64 = 0.85;

/// What a triangle may exceed while the plane is filled: smoothing makes most of those smaller.
const SLACK: f64 = 1.15;

/// Sweeps of smoothing.
const SWEEPS: usize = 5;

/// Parts that an edge on a segment may be longer than aimed at.
const SPARE: f64 = 0.05;

/// An edge that is so many times as long as wanted has nothing to say about the next vertex's place.
const LONG: f64 = 1.2;

/// How near a vertex may come to another, as part of the length aimed at or of the shortest side, squared: in places
/// where triangles come out well, and in the middle of the longest side.
const NEAR_SQ: [f64; 2] = [0.4, 0.05];

/// Repairs of angles that a vertex made for size may ask for.
const REPAIRS: u64 = 2;

/// Looks at the whole mesh for triangles that motion has made too large.
const ROUNDS: usize = 4;

impl Refiner<'_> {
    /// Whether a triangle is to be divided.
    pub(super) fn is_too_large(&self, t: u32) -> bool {
        self.size.is_some_and(|size| size.excess(self.mesh.corners(t)) > self.slack)
    }

    /// Fills the plane with vertices about as far from each other as wanted, before any angle is looked at.
    pub(super) fn fill(&mut self, monitor: &dyn Monitor) -> Result<(), GrowError> {
        let Some(size) = self.size else { return Ok(()) };
        self.slack = SLACK;
        self.push_all();
        self.work(monitor)?;
        for _ in 0..SWEEPS {
            self.smooth(size);
            self.restore_delaunay();
            self.look(monitor)?;
        }
        self.slack = 1.0;
        Ok(())
    }

    /// Moves each free vertex to the mean of the circumcentres around it, so that edges become more alike, unless a
    /// triangle becomes too large or turns over. Source: Chen, "Mesh smoothing schemes based on optimal Delaunay
    /// triangulations", 13th International Meshing Roundtable, 2004.
    fn smooth(&mut self, size: &dyn Size) {
        for v in 0..self.mesh.pos.len() as u32 {
            if self.mesh.kind[v as usize] != Kind::Free {
                continue;
            }
            let Some(star) = self.mesh.cavity_around(v) else { continue };
            let at = |i: usize| self.mesh.at(star.ring()[i]);
            let worst = |x: DVec2| {
                let excess = |i: usize| {
                    let [p, q] = [at(i), at(star.after(i))];
                    if surely_turns_left(q - p, x - p) { size.excess([p, q, x]) } else { f64::MAX }
                };
                (0..star.len()).map(excess).fold(0.0, f64::max)
            };
            let old = self.mesh.at(v);
            let x = self.mean_of_centres(&star, old);
            if x.is_finite() && worst(x) <= worst(old).max(1.0) {
                self.mesh.move_to(v, x);
            }
        }
    }

    /// The mean of the circumcentres of the triangles around a vertex, each with its area in squares of the length aimed
    /// at there. Not finite where any length will do.
    fn mean_of_centres(&self, star: &Cavity, old: DVec2) -> DVec2 {
        let (mut sum, mut all) = (DVec2::ZERO, 0.0);
        for i in 0..star.len() {
            let [p, q] = [i, star.after(i)].map(|i| self.mesh.at(star.ring()[i]) - old);
            let aim = self.aim_at(old + (p + q) / 3.0);
            // The circumcentre of a triangle at the origin is this over twice its cross product.
            let centre = q.length_squared() * p.perp() - p.length_squared() * q.perp();
            sum += centre / (2.0 * aim * aim);
            all += p.perp_dot(q) / (aim * aim);
        }
        old + sum / all
    }

    /// Whether a cavity loses vertices to a fan with a triangle that is too large.
    pub(super) fn loses_size(&self, cavity: &Cavity, x: DVec2) -> bool {
        let Some(size) = self.size.filter(|_| !cavity.enclosed().is_empty()) else { return false };
        let at = |i: usize| self.mesh.at(cavity.ring()[i]);
        (usize::from(cavity.on_segment)..cavity.len())
            .any(|i| size.excess([at(i), at(cavity.after(i)), x]) > self.slack)
    }

    /// Divides what motion has made too large since it was looked at.
    pub(super) fn grade(&mut self, monitor: &dyn Monitor) -> Result<(), GrowError> {
        if self.size.is_none() {
            return Ok(());
        }
        for _ in 0..ROUNDS {
            let before = self.stats.for_size;
            self.push_all();
            self.work(monitor)?;
            if self.stats.for_size == before {
                break;
            }
        }
        Ok(())
    }

    /// Makes a triangle that is too large smaller by one vertex, which may leave angles out of the bounds.
    pub(super) fn divide(&mut self, t: u32) {
        self.stats.visits += 1;
        if self.stats.for_size >= self.most_for_size {
            self.given_up += 1;
            return;
        }
        let done = self.divide_side(t)
            || self.places_for_size(t).into_iter().any(|(x, near_sq)| self.insert_for_size(t, x, near_sq));
        if done {
            self.stats.for_size += 1;
            self.most_fallbacks += REPAIRS;
            self.most_made += 4 * REPAIRS;
        } else {
            self.given_up += 1;
            if self.slack <= 1.0 && self.is_bad(t) {
                self.enqueue(t, false);
            }
        }
    }

    /// Divides a side that is on a segment and too long, so that all its parts come out equal.
    fn divide_side(&mut self, t: u32) -> bool {
        let parts = |c: u32| {
            let [a, b] = self.mesh.edge(c).map(|v| self.mesh.at(v));
            let aim = [a, b, 0.5 * (a + b)].map(|p| self.aim_at(p)).into_iter().fold(f64::MAX, f64::min);
            (a.distance(b) / aim - SPARE).ceil()
        };
        let sides: Vec<(u32, f64)> =
            (3 * t..3 * t + 3).filter(|&c| self.mesh.is_marked(c)).map(|c| (c, parts(c))).collect();
        sides.into_iter().any(|(c, n)| n > 1.0 && (self.split_at(c, (0.5 * n).floor() / n) || self.split(c)))
    }

    /// Places for a vertex in a triangle, the preferred one first, and how near they may be to another vertex: in front
    /// of the shortest side, the circumcentre, the middle of the longest side.
    fn places_for_size(&self, t: u32) -> [(DVec2, f64); 3] {
        let p = self.mesh.corners(t);
        let length_sq = |i: usize| p[i].distance_squared(p[(i + 1) % 3]);
        let k = (0..3).fold(0, |k, i| if length_sq(i) < length_sq(k) { i } else { k });
        let (a, b, c) = (p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
        let (ab, ac) = (b - a, c - a);
        let circum = 0.5 * ac.dot(c - b) / ab.perp_dot(ac);
        let at = |height: f64| a + 0.5 * ab + height * ab.perp();
        let aim = self.aim_at((a + b + c) / 3.0) / ab.length();
        let height = if aim * LONG < 1.0 { f64::MAX } else { (aim * aim - 0.25).max(0.25).sqrt() };
        let middle = 0.5 * if a.distance_squared(c) > b.distance_squared(c) { a + c } else { b + c };
        [
            (at(height.min(self.off_height()).min(circum)), NEAR_SQ[0]),
            (at(circum), NEAR_SQ[0]),
            (middle, NEAR_SQ[1]),
        ]
    }

    /// How long edges around a place are to be.
    pub(super) fn aim_at(&self, p: DVec2) -> f64 {
        AIM * self.size.map_or(f64::INFINITY, |size| size.aim(p))
    }

    /// Inserts a vertex, if nothing is too near to it; divides a segment that is in the way instead.
    fn insert_for_size(&mut self, t: u32, x: DVec2, near_sq: f64) -> bool {
        let cavity = match self.find_cavity(x, t) {
            Ok(Some(cavity)) => cavity,
            Ok(None) => return false,
            Err(c) => return self.split(c),
        };
        let aim = self.aim_at(x);
        let least_sq = near_sq * Shape::of(self.mesh.corners(t)).shortest_sq.min(aim * aim);
        let near = |&v: &u32| self.mesh.at(v).distance_squared(x) < least_sq;
        if cavity.ring().iter().any(near) {
            return false;
        }
        let bad = self.fan_bad(&cavity, x);
        let mut at = (bad < TURNED && cavity.triangles().contains(&t)).then_some(x);
        if bad > 0 && cavity.len() <= self.limits.most_around && self.outline(&cavity) == Outline::Fits {
            at = self.place(&cavity, x).or(at);
        }
        let Some(at) = at else { return false };
        self.commit(&Candidate::new(&cavity, at));
        true
    }
}
