//! Takes bad triangles from a queue and repairs them one by one.

mod insert;
mod patch;
pub(crate) mod place;
pub(crate) mod search;
mod size;
mod slide;
mod split;
mod tips;
mod walk;

use web_time::Instant;

use hexdel_geom::monitor::check;
use hexdel_geom::{DVec2, Monitor, Phase, orient2d, point_on_segment};
use hexdel_optimize::edit::{Cavity, EditMesh, Kind, NONE, next, prev};

use crate::error::GrowError;
use crate::limits::{Limits, Shape};
use crate::options::{Options, Size, Stats};
use crate::queue::{Level, Queue};
use patch::Scratch;

/// Least angle of triangles that are not urgent, degrees. Whatever is worse comes from the input, and what cures it
/// often cures what is only out of the bounds.
const URGENT_DEG: f64 = 33.0;

/// Insertions that may leave bad triangles around them: so many for each point, for each doubling from the shortest edge
/// of the first triangulation to the longest, and so many more.
const FALLBACKS: [u64; 3] = [25, 150, 500];

/// Vertices made for each such insertion.
const VERTICES: u64 = 2;

/// Triangles visited for each vertex that may be made.
const VISITS: u64 = 4;

/// Visits between two looks at the clock and the monitor.
const LOOK: u64 = 4096;

/// How near a fallback may come to a vertex, as part of the bad triangle's shortest edge, squared: in the first pass and in
/// the last.
const NEAR_SQ: [f64; 2] = [0.4, 0.1];

/// An edge is flipped if a corner is inside the circle by this part of the fourth power of lengths: four points
/// nearly on one circle are not flipped to and fro.
const FLIP: f64 = 1e-11;

/// The mesh under refinement.
pub(crate) struct Refiner<'a> {
    pub(crate) mesh: EditMesh,
    pub(crate) limits: Limits,
    /// The ends of each segment.
    pub(crate) segments: &'a [[DVec2; 2]],
    /// How large triangles may be.
    size: Option<&'a dyn Size>,
    most_for_size: u64,
    /// Triangles are divided from so much excess on.
    slack: f64,
    pub(crate) stats: Stats,
    queue: Queue,
    /// How urgent the triangle at hand is.
    level: Level,
    near_sq: f64,
    /// Whether motion must mend the whole patch, or only more than it spoils.
    strict: bool,
    /// Triangles given up in this pass.
    given_up: u64,
    made: u64,
    most_made: u64,
    most_fallbacks: u64,
    pub(crate) slots: Vec<u32>,
    pub(crate) cavities: Vec<Cavity>,
    /// Corners opposite edges of segments that were in the way.
    pub(crate) segments_met: Vec<u32>,
    scratch: Scratch,
    deadline: Option<Instant>,
}

/// A cavity, or two on both sides of a segment, and a place for a vertex in it.
#[derive(Clone, Copy)]
pub(crate) struct Candidate {
    pub(crate) cavity: Cavity,
    pub(crate) other: Option<Cavity>,
    pub(crate) at: DVec2,
}

impl Candidate {
    pub(crate) fn new(cavity: &Cavity, at: DVec2) -> Self {
        Self { cavity: *cavity, other: None, at }
    }
}

/// What an off-centre has come to.
struct Trial {
    /// What could be inserted.
    candidate: Option<Candidate>,
    /// A corner opposite the edge of a segment in the way.
    hit: u32,
}

impl<'a> Refiner<'a> {
    pub(crate) fn new(
        mesh: EditMesh,
        segments: &'a [[DVec2; 2]],
        options: &Options,
        size: Option<&'a dyn Size>,
        strict: bool,
    ) -> Self {
        let most_fallbacks =
            FALLBACKS[0] * mesh.pos.len() as u64 + FALLBACKS[1] * doublings(&mesh) + FALLBACKS[2];
        Self {
            limits: Limits::new(options.min_deg, URGENT_DEG),
            segments,
            size,
            most_for_size: options.most_for_size,
            slack: 1.0,
            stats: Stats::default(),
            queue: Queue::new(),
            level: Level::Urgent,
            near_sq: NEAR_SQ[0],
            strict,
            given_up: 0,
            made: 0,
            most_made: VERTICES * most_fallbacks,
            most_fallbacks,
            slots: Vec::new(),
            cavities: Vec::new(),
            segments_met: Vec::new(),
            scratch: Scratch::default(),
            deadline: options.deadline,
            mesh,
        }
    }

    /// Repairs for whoever chooses triangles and changes the mesh: none are queued.
    pub(crate) fn unqueued(segments: &'a [[DVec2; 2]], options: &Options) -> Self {
        let refiner = Self::new(EditMesh::default(), segments, options, None, true);
        Self { slack: f64::INFINITY, ..refiner }
    }

    /// Repairs all that can be repaired within the limit of work.
    pub(crate) fn run(&mut self, monitor: &dyn Monitor) -> Result<(), GrowError> {
        self.look(monitor)?;
        self.fill(monitor)?;
        for near_sq in NEAR_SQ {
            self.near_sq = near_sq;
            self.given_up = 0;
            self.push_all();
            self.work(monitor)?;
            if self.given_up == 0 {
                break;
            }
        }
        self.grade(monitor)?;
        monitor.progress(Phase::Extract, self.most_made, self.most_made);
        Ok(())
    }

    fn push_all(&mut self) {
        for t in 0..self.mesh.slots() {
            if self.mesh.alive(t) {
                self.push_if_bad(t);
            }
        }
    }

    fn work(&mut self, monitor: &dyn Monitor) -> Result<(), GrowError> {
        let mut look = 0;
        while let Some((t, level)) = self.queue.pop(&self.mesh.stamp) {
            if !self.mesh.alive(t) || level != Level::Large && !self.is_bad(t) {
                continue;
            }
            self.level = level;
            let (stamp, given_up) = (self.mesh.stamp[t as usize], self.given_up);
            if level == Level::Large {
                self.divide(t);
            } else {
                self.repair(t);
            }
            if self.given_up == given_up && self.mesh.alive(t) && self.mesh.stamp[t as usize] == stamp {
                self.push_if_bad(t);
            }
            look += 1;
            if look == LOOK {
                look = 0;
                self.look(monitor)?;
            }
        }
        Ok(())
    }

    fn look(&self, monitor: &dyn Monitor) -> Result<(), GrowError> {
        monitor.progress(Phase::Extract, self.made.min(self.most_made), self.most_made);
        check(monitor)?;
        let over = self.deadline.is_some_and(|end| Instant::now() >= end);
        if over { Err(GrowError::OutOfTime) } else { Ok(()) }
    }

    /// Whether a triangle has an angle out of the bounds.
    pub(crate) fn is_bad(&self, t: u32) -> bool {
        is_bad(&self.mesh, &self.limits, t)
    }

    fn is_exempt(&self, c: u32) -> bool {
        is_exempt(&self.mesh, c)
    }

    fn push_if_bad(&mut self, t: u32) {
        if self.is_too_large(t) {
            let shape = Shape::of(self.mesh.corners(t));
            self.queue.push(t, self.mesh.stamp[t as usize], Level::Large, shape.shortest_sq);
        } else if self.slack <= 1.0 && self.is_bad(t) {
            self.enqueue(t, false);
        }
    }

    fn enqueue(&mut self, t: u32, late: bool) {
        let shape = Shape::of(self.mesh.corners(t));
        let least = self.limits.urgent * shape.cross;
        let level = match late {
            true => Level::Late,
            false if shape.dots.iter().all(|&d| d <= least) => Level::Rest,
            false => Level::Urgent,
        };
        self.queue.push(t, self.mesh.stamp[t as usize], level, shape.shortest_sq);
    }

    /// One repair of a bad triangle: the cheapest that works.
    fn repair(&mut self, t: u32) {
        self.stats.visits += 1;
        if self.made > self.most_made || self.stats.visits > VISITS * self.most_made {
            self.given_up += 1;
            return;
        }
        self.segments_met.clear();
        let all = self.level > Level::Urgent;
        if self.flip(t) || self.move_one(t) || self.slide_one(t) || all && self.move_patch(t, 0) {
            return;
        }
        let mut trial = Trial { candidate: None, hit: NONE };
        if self.off_centre(t, &mut trial)
            && let Some(good) = &trial.candidate
        {
            self.insert(good);
            return;
        }
        if all && (self.move_patch(t, 1) || self.insert_in_cavity(t)) || self.insert_on_segments(t) {
            return;
        }
        if trial.hit != NONE && !all {
            let stamp = &mut self.mesh.stamp[t as usize];
            *stamp = stamp.wrapping_add(1);
            self.enqueue(t, true);
            return;
        }
        self.fall_back(&trial);
    }

    /// Inserts something that leaves bad triangles.
    fn fall_back(&mut self, trial: &Trial) {
        if self.stats.others >= self.most_fallbacks {
            self.given_up += 1;
            return;
        }
        self.stats.others += 1;
        if let Some(candidate) = &trial.candidate {
            self.commit(candidate);
        } else if trial.hit == NONE || !self.split(trial.hit) {
            self.given_up += 1;
        }
    }

    /// Inserts something that leaves none.
    fn insert(&mut self, candidate: &Candidate) {
        self.stats.good += 1;
        self.commit(candidate);
    }

    pub(crate) fn commit(&mut self, candidate: &Candidate) -> u32 {
        let mut slots = std::mem::take(&mut self.slots);
        let Candidate { cavity, other, at } = candidate;
        let kind = if cavity.on_segment { Kind::OnSegment } else { Kind::Free };
        let v = self.mesh.refill(cavity, other.as_ref(), *at, kind, &mut slots);
        self.made += 1;
        for &t in &slots {
            self.push_if_bad(t);
        }
        self.slots = slots;
        v
    }

    /// Flips an edge of a triangle that is not Delaunay, if there is one.
    fn flip(&mut self, t: u32) -> bool {
        for c in 3 * t..3 * t + 3 {
            if self.may_flip(c) {
                self.stats.flips += 1;
                for t in self.mesh.flip(c) {
                    self.push_if_bad(t);
                }
                return true;
            }
        }
        false
    }

    /// Whether the edge opposite a corner is not Delaunay, clearly, and may be flipped.
    pub(crate) fn may_flip(&self, c: u32) -> bool {
        let mesh = &self.mesh;
        let k = mesh.twin[c as usize];
        if mesh.is_marked(c) || k == NONE {
            return false;
        }
        let e = mesh.at(mesh.v(k));
        let [a, b, d] = [c, next(c), prev(c)].map(|c| mesh.at(mesh.v(c)));
        let [u, v, w] = [a, b, d].map(|p| p - e);
        let inside = u.length_squared() * v.perp_dot(w)
            + v.length_squared() * w.perp_dot(u)
            + w.length_squared() * u.perp_dot(v);
        let length_sq = (b - a).length_squared() + (d - a).length_squared();
        inside > FLIP * length_sq * length_sq && orient2d(a, b, e) > 0.0 && orient2d(a, e, d) > 0.0
    }

    /// The rounded point of a segment nearest to `p`.
    fn on_segment(&self, segment: u32, p: DVec2) -> DVec2 {
        let [a, b] = self.segments[segment as usize];
        let d = b - a;
        point_on_segment(a, b, ((p - a).dot(d) / d.length_squared()).clamp(0.0, 1.0))
    }
}

/// Whether a triangle has an angle out of the bounds.
pub(crate) fn is_bad(mesh: &EditMesh, limits: &Limits, t: u32) -> bool {
    let shape = Shape::of(mesh.corners(t));
    let (high, low) = (limits.hi * shape.cross, limits.lo * shape.cross);
    if shape.cross <= 0.0 || shape.dots.iter().any(|&d| d < high) {
        return true;
    }
    (0..3).any(|i| shape.dots[i] > low && !is_exempt(mesh, 3 * t + i as u32))
}

/// Whether the lower bound is not asked of a corner: it is one of the input's.
fn is_exempt(mesh: &EditMesh, c: u32) -> bool {
    mesh.kind[mesh.v(c) as usize] == Kind::Fixed
        && mesh.segment(next(c)).is_some()
        && mesh.segment(prev(c)).is_some()
}

/// How often the shortest edge must be doubled to be as long as the longest.
fn doublings(mesh: &EditMesh) -> u64 {
    let (mut least, mut most) = (f64::MAX, 0.0_f64);
    for t in mesh.triangles() {
        let [a, b, c] = mesh.corners(t);
        for side_sq in [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)] {
            (least, most) = (least.min(side_sq), most.max(side_sq));
        }
    }
    let exponent = |x: f64| (x.to_bits() >> 52) as i64;
    ((exponent(most) - exponent(least)) / 2 + 1).max(1) as u64
}
