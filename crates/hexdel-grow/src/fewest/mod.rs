//! As few Steiner points as can be found: ruin and recreate under simulated annealing.
//!
//! A step takes a window, some dozens of triangles around a spot, out of the mesh as a mesh of its own. In it some
//! Steiner points next to the spot are removed (`ruin`), and others inserted where triangles are bad, no more of them than
//! a few (`recreate`). The window goes back where that cost less than before, or little more: by the count of Steiner
//! points, and several for each bad triangle. A bad triangle costs more and more, and worse windows are taken less and
//! less. The first mesh is the constrained Delaunay triangulation, with all its bad triangles; if that leads to none
//! without, a mesh that has grown.
//!
//! Schrimpf, Schneider, Stamm-Wilbrandt & Dueck, "Record Breaking Optimization Results Using the Ruin and Recreate
//! Principle", J. Comput. Phys. 159 (2000).

mod candidates;
mod delaunay;
mod recreate;
mod ruin;
mod window;

use web_time::Instant;

use hexdel_geom::monitor::check;
use hexdel_geom::{DVec2, Monitor, Phase};
use hexdel_optimize::edit::{EditMesh, Kind, Random};

use crate::error::GrowError;
use crate::limits::RANGE_DEG;
use crate::options::{Grown, Input, Options};
use crate::refiner::Refiner;
use crate::{Quiet, finished, refuse, start};
use delaunay::is_bad;

/// What a bad triangle costs in Steiner points, at the start and at the end.
const WEIGHT: [f64; 2] = [3.0, 20.0];

/// By how many Steiner points more a window is taken with probability 1/e, at the start and at the end.
const TEMPERATURE: [f64; 2] = [0.3, 0.1];

/// Triangles of a window, at least and at most.
const WINDOW: [usize; 2] = [20, 60];

/// Of so many spots one is anywhere while triangles are bad.
const ANYWHERE: usize = 4;

/// One of so many windows without bad triangles may get one Steiner point more than it lost.
const ONE_MORE: usize = 3;

/// Steps in vain on bad triangles for each further Steiner point that a window with bad triangles may get.
const VAIN: usize = 3;

/// How many those are at most.
const MOST_MORE: usize = 12;

/// Fewer points than these have as many steps.
const FEW_POINTS: u64 = 50;

/// Rounds while triangles are bad, at most.
const ROUNDS: u64 = 3;

/// Steps between two looks at the clock and the monitor.
const LOOK: u64 = 64;

/// A copy of the best mesh is made at most once in a step for so many triangles.
const COPY: u64 = 8;

/// Looks for a mesh with as few Steiner points as possible.
///
/// A round of [`Options::steps`] for each point begins with the constrained Delaunay triangulation. Where it leaves bad
/// triangles, there are up to two more: one from a mesh that has grown, and one that begins anew. With a deadline, rounds go
/// on until it is over, from the best mesh if there is one without bad triangles. The best mesh of all is what comes back.
/// Sizes are not looked at. Lower bounds below 1 degree count as 1.
///
/// # Guarantees
///
/// As of [`grow`](crate::grow). How near the result is to the fewest points possible is not known. Same input, same bytes, without a
/// deadline.
///
/// # Errors
///
/// [`GrowError`]; [`GrowError::OutOfTime`] does not come.
///
/// # Panics
///
/// Never; a broken invariant would be a defect of the library.
///
/// # Complexity
///
/// About 0.1 milliseconds a step, 10 a point.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, Unwatched};
/// use hexdel_grow::{Input, Options, fewest};
///
/// // A triangle with an obtuse angle takes one Steiner point, the foot of its altitude.
/// let points = [(0.0, 0.0), (4.0, 0.0), (1.0, 1.0)].map(|(x, y)| DVec2::new(x, y));
/// let input = Input { points: &points, segments: &[[0, 1], [1, 2], [2, 0]], inside: true, ..Input::default() };
/// let made = fewest(&input, &Options::new(0.0), &Unwatched)?;
/// assert!(made.left.is_empty());
/// assert_eq!(made.mesh.vertices.len(), 4);
/// # Ok::<(), hexdel_grow::GrowError>(())
/// ```
pub fn fewest(input: &Input<'_>, options: &Options, monitor: &dyn Monitor) -> Result<Grown, GrowError> {
    let options = &Options { min_deg: options.min_deg.max(RANGE_DEG[0]), ..*options };
    refuse(input, options)?;
    let first = start::first(input)?;
    let ends: Vec<[DVec2; 2]> = input.segments.iter().map(|s| s.map(|v| input.points[v as usize])).collect();
    let refiner = Refiner::unqueued(&ends, options);
    let steps = options.steps * (input.points.len() as u64).max(FEW_POINTS);
    let mut search = Search::new(refiner, steps);
    for round in 0.. {
        let is_new = search.best.is_none() && round % 2 == 0;
        if is_new {
            search.begin_at(first.mesh.clone());
        } else if search.best.is_none() {
            search.begin_at(grown(first.mesh.clone(), &ends, options, monitor)?);
        }
        search.round(round, is_new, options.deadline, monitor)?;
        if search.is_done(round + 1, options.deadline) {
            break;
        }
    }
    let Search { mut refiner, whole, best, .. } = search;
    refiner.mesh = best.map_or(whole, |best| best.mesh);
    Ok(finished(&refiner, input, &first.point_of))
}

/// A mesh without bad triangles.
struct Best {
    vertices: usize,
    mesh: EditMesh,
}

/// The state between steps.
struct Search<'a> {
    /// Its mesh is the window.
    refiner: Refiner<'a>,
    whole: EditMesh,
    random: Random,
    /// Triangles that are bad, and some that were.
    bad: Vec<u32>,
    bad_count: usize,
    /// Bad triangles of the window.
    bad_here: Vec<u32>,
    /// Steps of a round.
    steps: u64,
    /// Steps in a row that made no bad triangle go, less half of them for each one that did.
    vain: usize,
    best: Option<Best>,
    /// Steps since the best mesh was copied.
    since_copy: u64,
}

impl<'a> Search<'a> {
    fn new(refiner: Refiner<'a>, steps: u64) -> Self {
        Self {
            refiner,
            whole: EditMesh::default(),
            random: Random::new(0),
            bad: Vec::new(),
            bad_count: 0,
            bad_here: Vec::new(),
            steps,
            vain: 0,
            best: None,
            since_copy: u64::MAX,
        }
    }

    /// Goes on from a mesh.
    fn begin_at(&mut self, mesh: EditMesh) {
        self.whole = mesh;
        self.vain = 0;
        self.find_bad();
        self.bad_count = self.bad.len();
        self.note_best();
    }

    /// Whether so many rounds are enough.
    fn is_done(&self, rounds: u64, deadline: Option<Instant>) -> bool {
        let is_over = |end| self.steps == 0 || Instant::now() >= end;
        deadline.map_or(self.best.is_some() || rounds == ROUNDS, is_over)
    }

    /// The steps of a round; fewer where the deadline comes before, and it cools sooner then. In a new mesh bad triangles
    /// cost little at first.
    fn round(
        &mut self,
        round: u64,
        is_new: bool,
        deadline: Option<Instant>,
        monitor: &dyn Monitor,
    ) -> Result<(), GrowError> {
        let start = Instant::now();
        let mut spent = 0.0;
        for step in 0..self.steps {
            if step % LOOK == 0 {
                let total = ROUNDS.max(round + 1) * self.steps;
                monitor.progress(Phase::Optimize, round * self.steps + step, total);
                check(monitor)?;
                spent = deadline.map_or(0.0, |end| share(start, end));
            }
            if spent >= 1.0 {
                break;
            }
            let part = (step as f64 / self.steps as f64).max(spent);
            let weight = between(WEIGHT, if is_new { part } else { 1.0 });
            self.step(weight, between(TEMPERATURE, part));
        }
        self.since_copy = u64::MAX;
        self.note_best();
        Ok(())
    }

    /// One window.
    fn step(&mut self, weight: f64, temperature: f64) {
        let seed = self.spot();
        let size = WINDOW[0] + self.random.below(WINDOW[1] - WINDOW[0] + 1);
        let window = self.extract(seed, size);
        let (before, vertices) = (self.count_bad_here(), self.refiner.mesh.vertex_count());
        let Some(before) = before else { return };
        let removed = self.ruin(&window);
        let more = if before > 0 {
            1 + self.random.below(2 + (self.vain / VAIN).min(MOST_MORE))
        } else {
            usize::from(self.random.below(ONE_MORE) == 0)
        };
        let Some(after) = self.recreate(removed + more, before) else { return };
        if after < before {
            self.vain /= 2;
        } else if before > 0 {
            self.vain += 1;
        }
        let change = weight * (after as f64 - before as f64) + self.refiner.mesh.vertex_count() as f64
            - vertices as f64;
        if change <= -temperature * libm::log(1.0 - self.random.unit()) {
            self.splice(&window);
            self.note_best();
        }
        self.since_copy = self.since_copy.saturating_add(1);
    }

    /// A triangle to work at: a bad one mostly, if there is one.
    fn spot(&mut self) -> u32 {
        if self.bad_count > 0 && self.random.below(ANYWHERE) > 0 {
            if self.bad.len() > ANYWHERE * self.bad_count {
                self.find_bad();
            }
            while !self.bad.is_empty() {
                let i = self.random.below(self.bad.len());
                let t = self.bad[i];
                if self.whole.alive(t) && is_bad(&self.whole, &self.refiner.limits, t) {
                    return t;
                }
                self.bad.swap_remove(i);
            }
        }
        loop {
            let t = self.random.below(self.whole.slots() as usize) as u32;
            if self.whole.alive(t) {
                return t;
            }
        }
    }

    fn find_bad(&mut self) {
        let Self { whole, refiner, bad, .. } = self;
        bad.clear();
        bad.extend(whole.triangles().filter(|&t| is_bad(whole, &refiner.limits, t)));
    }

    /// Copies the mesh if it is the best so far, unless one was copied a moment ago.
    fn note_best(&mut self) {
        let vertices = self.whole.vertex_count();
        let is_best = self.bad_count == 0 && self.best.as_ref().is_none_or(|best| vertices < best.vertices);
        if is_best && self.since_copy >= u64::from(self.whole.slots()) / COPY {
            self.since_copy = 0;
            self.best = Some(Best { vertices, mesh: self.whole.clone() });
        }
    }
}

/// The share of the time between a start and an end that is over.
fn share(start: Instant, end: Instant) -> f64 {
    let all = end.saturating_duration_since(start).as_secs_f64();
    if all > 0.0 { start.elapsed().as_secs_f64() / all } else { 1.0 }
}

/// What is between two values, as powers.
fn between([from, to]: [f64; 2], part: f64) -> f64 {
    from * libm::pow(to / from, part)
}

/// A mesh that has grown, with all of its vertices free to move and go but the points. It may have bad triangles, and
/// is what there is at the deadline.
fn grown(
    mesh: EditMesh,
    ends: &[[DVec2; 2]],
    options: &Options,
    monitor: &dyn Monitor,
) -> Result<EditMesh, GrowError> {
    let mut refiner = Refiner::new(mesh, ends, options, None, true);
    match refiner.run(&Quiet(monitor)) {
        Ok(()) | Err(GrowError::OutOfTime) => {}
        Err(error) => return Err(error),
    }
    let mut mesh = refiner.mesh;
    for kind in mesh.kind.iter_mut().filter(|kind| **kind == Kind::Held) {
        *kind = Kind::OnSegment;
    }
    Ok(mesh)
}

/// Whether a vertex may go.
fn is_steiner(kind: Kind) -> bool {
    kind == Kind::Free || kind.slides()
}
