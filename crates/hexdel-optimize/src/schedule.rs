//! The order of the work: rounds of repair, of removals, of shakes, each over
//! all parts of a new partition at once.

use web_time::Instant;

use hexdel_geom::monitor::check;
use hexdel_geom::par::current_num_threads;
use hexdel_geom::par::prelude::*;
use hexdel_geom::{Cancelled, Monitor, Phase, TriMesh};

use crate::area::{divide_large, divide_left};
use crate::constraints::{Constraints, Rules};
use crate::decimate::{PASSES, decimate};
use crate::error::OptimizeError;
use crate::import::{Exported, export, import};
use crate::mesh::Soup;
use crate::options::{Effort, Optimized, Options, Stats, VertexKind};
use crate::partition::{Cuts, Part, Seams, extract, merge, partition, spots};
use crate::random::Random;
use crate::refill::Refills;
use crate::repair::{self, search};
use crate::rescue::rescue;
use crate::shake::{SHAKES, shake};
use crate::sizing::{Sizing, triangle_fits};
use crate::work::Work;

/// Brings every angle of `mesh` inside the bounds and removes vertices while
/// they stay there.
///
/// `kinds` holds one kind for each vertex. Triangles may be inverted where
/// their vertices have been moved, but their topology must be that of a
/// surface with every triangle listed counter-clockwise.
///
/// # Guarantees
///
/// In the mesh returned every angle is inside the bounds (by 1e-7 degrees
/// where vertices have been moved, but for rounding where they have not), it
/// has the outline of the mesh given, every edge of a patch that was changed is
/// locally Delaunay (with right angles as upper bound: every edge), and fixed vertices have their coordinates bit for bit. Without a budget the
/// result depends on the input alone, not on the number of threads.
///
/// # Errors
///
/// An [`OptimizeError`] that names what is wrong with the input, or
/// [`OptimizeError::Unreached`] with the best mesh found where angles are left
/// outside the bounds: because the vertices that may not move leave no room, or
/// because the budget is spent; [`OptimizeError::Cancelled`] if the monitor
/// asks for it.
///
/// # Complexity
///
/// Near-linear in the number of vertices; each round's cuts cost `n log n`.
/// Runs on the current rayon thread pool.
pub fn optimize(
    mesh: TriMesh,
    kinds: &[VertexKind],
    options: &Options,
    monitor: &dyn Monitor,
) -> Result<Optimized, OptimizeError> {
    run(mesh, kinds, None, options, None, monitor)
}

/// Like [`optimize`], with edges no longer than wanted: what removals and
/// shakes change keeps to `sizing`. Repair does not, and edges that are longer
/// in the mesh given may stay so.
///
/// # Errors
///
/// As [`optimize`].
pub fn optimize_sized(
    mesh: TriMesh,
    kinds: &[VertexKind],
    options: &Options,
    sizing: &dyn Sizing,
    monitor: &dyn Monitor,
) -> Result<Optimized, OptimizeError> {
    run(mesh, kinds, None, options, Some(sizing), monitor)
}

/// [`optimize`] for a mesh with segments in it.
///
/// # Guarantees
///
/// As of [`optimize`], with the bounds that [`Constraints`] give by place. Every
/// edge that must stay is an edge of the mesh returned, or several that lay in
/// a row along one segment are one; vertices on a segment are the doubles
/// nearest to points of it. Triangles larger than allowed are divided where that
/// keeps the bounds; neither removals nor repair make one. Edges longer
/// than [`Constraints::sizing`] wants them are divided, too; repair may make such ones.
///
/// # Errors
///
/// As of [`optimize`], and where `constraints` name what is not there.
///
/// # Complexity
///
/// That of [`optimize`].
pub fn optimize_constrained(
    mesh: TriMesh,
    kinds: &[VertexKind],
    constraints: &Constraints<'_>,
    options: &Options,
    monitor: &dyn Monitor,
) -> Result<Optimized, OptimizeError> {
    run(mesh, kinds, Some(constraints), options, None, monitor)
}

fn run(
    mesh: TriMesh,
    kinds: &[VertexKind],
    constraints: Option<&Constraints<'_>>,
    options: &Options,
    sizing: Option<&dyn Sizing>,
    monitor: &dyn Monitor,
) -> Result<Optimized, OptimizeError> {
    let vertices = mesh.vertices.len();
    let soup = import(mesh, kinds, constraints)?;
    let rules = Rules::new(options.bounds, constraints);
    let divides = constraints.and_then(|c| c.sizing);
    let sizing = sizing.or(divides);
    let mut run = Run { sizing, divides, ..Run::new(soup, options, &rules, monitor) };
    match run.all() {
        Ok(()) | Err(Stop::OutOfTime) => run.finish(vertices),
        Err(Stop::Cancelled(c)) => Err(c.into()),
    }
}

/// Passes of removals at fast effort: up to a lower bound of [`EASY_DEG`], and above. A mesh
/// that has grown to easy bounds has few vertices too many.
const FAST_PASSES: [usize; 2] = [1, 3];

/// Degrees.
const EASY_DEG: f64 = 42.5;

/// Passes of removals at standard effort, one more in small meshes: the later ones take as
/// long again for a twentieth fewer triangles.
const STANDARD_PASSES: usize = 7;

/// Triangles up to which a mesh is small: one of some hundred points takes a tenth of a
/// second however hard it is tried to remove their vertices.
const SMALL: usize = 20_000;

/// Rings around bad triangles that are one part, in turn: as far as changes
/// reach, and some more with each round.
const SPOT_RINGS: [usize; 4] = [8, 9, 10, 12];

/// The same for rescues.
const RESCUE_RINGS: [usize; 4] = [10, 14, 18, 24];

/// Of so many triangles one may be bad for a rescue to be tried.
const HOPELESS: usize = 20;

/// Parts that a thread works on between two looks at clock and monitor: some
/// tenths of a second.
const BATCH: usize = 8;

/// Triangles that are rescued in a mesh with segments, at most: more of them share what
/// all together may take, and none has enough.
const FEW: usize = 60;

/// The same as one of so many.
const RARE: usize = 1000;

/// Triangles visited by projection sweeps for each of them, at most: those that
/// are rescued at all took a million in the median, five at most.
const RESCUE_VISITS: u64 = 4_000_000;

/// The same for all of them together, and as many more for each triangle of the mesh: a
/// small part of what removals visit.
const ALL_VISITS: u64 = 4 * RESCUE_VISITS;
const VISITS_PER_TRIANGLE: u64 = 50;

/// Rounds of search in a row that settle nothing in a mesh with segments, after which
/// no other has.
const IDLE_ROUNDS: usize = 2;

/// Rounds of search that hopeless triangles take part in.
const HOPEFUL_ROUNDS: usize = 2;

/// Rounds that divide edges, at the start and again at the end.
const DIVISIONS: usize = 4;

/// Those of them that may leave other edges too long.
const LOOSE_DIVISIONS: usize = 2;

/// Why the work ends early.
enum Stop {
    OutOfTime,
    Cancelled(Cancelled),
}

/// The state between rounds.
struct Run<'a> {
    soup: Soup,
    options: &'a Options,
    monitor: &'a dyn Monitor,
    sizing: Option<&'a dyn Sizing>,
    /// The same if edges that are too long are to be divided.
    divides: Option<&'a dyn Sizing>,
    /// The sizing where the present round keeps to it.
    guard: Option<&'a dyn Sizing>,
    rules: &'a Rules<'a>,
    refills: Refills,
    /// Whether the mesh given has few triangles.
    is_small: bool,
    start: Instant,
    stats: Stats,
    /// Set when the budget ends the work.
    stopped: bool,
}

impl<'a> Run<'a> {
    fn new(soup: Soup, options: &'a Options, rules: &'a Rules<'a>, monitor: &'a dyn Monitor) -> Self {
        Self {
            is_small: soup.tris.len() <= SMALL,
            soup,
            options,
            monitor,
            sizing: None,
            divides: None,
            guard: None,
            rules,
            refills: Refills::new(),
            start: Instant::now(),
            stats: Stats::default(),
            stopped: false,
        }
    }

    /// The phases in turn. Motion and removals come before search: what motion
    /// alone does not settle often goes with a vertex, and search is cheaper on
    /// the coarser mesh. Where there are segments repair comes first: removals take
    /// the room that what is left needs.
    fn all(&mut self) -> Result<(), Stop> {
        if self.repairs_first() {
            self.repair(true)?;
            if self.options.bounds_first && !self.hopeful(false).is_empty() {
                return Ok(());
            }
        }
        self.shorten()?;
        let passes = self.passes();
        self.decimate(0, passes)?;
        self.repair(passes == 0)?;
        if self.options.effort >= Effort::Best {
            self.decimate(self.passes(), PASSES.len())?;
            self.guard = self.sizing;
            for _ in 0..SHAKES {
                self.round(shake)?;
            }
            self.repair(false)?;
        }
        self.shorten()
    }

    /// Search, after motion if that is wanted. Where edges are divided none becomes too long at first, and only what
    /// that leaves is repaired without such care.
    fn repair(&mut self, moves: bool) -> Result<(), Stop> {
        let guarded = self.divides.map(Some);
        for guard in guarded.into_iter().chain([None]) {
            self.guard = guard;
            if moves {
                self.move_all()?;
            }
            self.search()?;
        }
        Ok(())
    }

    /// Divides edges longer than wanted, and what is too large with them.
    fn shorten(&mut self) -> Result<(), Stop> {
        let Some(sizing) = self.divides else { return self.divide() };
        for i in 0..DIVISIONS {
            let corners = |t: &[u32; 3]| t.map(|v| self.soup.pos[v as usize]);
            let fits = |t: &[u32; 3]| {
                let corners = corners(t);
                self.rules.is_small(corners) && triangle_fits(sizing, corners)
            };
            if self.soup.tris.iter().all(fits) {
                break;
            }
            if i < LOOSE_DIVISIONS {
                self.guard = None;
                self.round(|work| divide_large(work, Some(sizing)))?;
            } else {
                self.guard = Some(sizing);
                self.round(|work| divide_left(work, sizing))?;
            }
        }
        Ok(())
    }

    /// Divides triangles larger than allowed.
    fn divide(&mut self) -> Result<(), Stop> {
        let mut least = usize::MAX;
        for _ in 0..DIVISIONS {
            let corners = |t: u32| self.soup.tris[t as usize].map(|v| self.soup.pos[v as usize]);
            let large = |t: &u32| !self.rules.is_small(corners(*t));
            let large: Vec<u32> = (0..self.soup.tris.len() as u32).filter(large).collect();
            if large.is_empty() || large.len() >= least {
                break;
            }
            least = large.len();
            self.guard = None;
            let cuts = spots(&self.soup, &large, SPOT_RINGS[0], self.stats.rounds);
            self.round_of(&cuts, |work| divide_large(work, None))?;
        }
        Ok(())
    }

    /// Passes of removals before the first search.
    fn passes(&self) -> usize {
        match self.options.effort {
            Effort::Repair => 0,
            Effort::Fast => FAST_PASSES[usize::from(self.options.bounds.min_deg() > EASY_DEG)],
            Effort::Standard | Effort::Best | Effort::Fewest => STANDARD_PASSES + usize::from(self.is_small),
        }
    }

    fn repairs_first(&self) -> bool {
        self.soup.is_constrained() && self.passes() > 0
    }

    /// The most rounds there can be.
    fn rounds(&self) -> usize {
        let divides = self.divides.is_some() || self.rules.limits_areas();
        let divisions = if divides { 2 * DIVISIONS } else { 0 };
        let repair = repair::MOVES.len() + repair::SEARCH.len() + RESCUE_RINGS.len();
        let repair = repair * (1 + usize::from(self.divides.is_some()));
        let once = divisions + repair * (1 + usize::from(self.repairs_first()));
        match self.options.effort {
            Effort::Repair | Effort::Fast | Effort::Standard => once + self.passes(),
            Effort::Best | Effort::Fewest => once + PASSES.len() + SHAKES + repair,
        }
    }

    fn decimate(&mut self, from: usize, to: usize) -> Result<(), Stop> {
        self.guard = self.sizing;
        for (&pass, i) in PASSES[from..to].iter().zip(from..) {
            let before = self.soup.tris.len();
            self.round(|work| {
                repair::moves(work, i);
                decimate(work, pass);
            })?;
            if before.saturating_sub(self.soup.tris.len())
                < before.checked_div(self.options.worth).unwrap_or(0)
            {
                break;
            }
        }
        Ok(())
    }

    /// Motion alone, over the whole mesh.
    fn move_all(&mut self) -> Result<(), Stop> {
        for i in 0..repair::MOVES.len() {
            let bad = self.bad();
            if bad.is_empty() {
                break;
            }
            let cuts = if self.soup.is_constrained() {
                spots(&self.soup, &bad, SPOT_RINGS[0], self.stats.rounds)
            } else {
                partition(&self.soup, self.stats.rounds)
            };
            self.round_of(&cuts, |work| repair::moves(work, i))?;
        }
        Ok(())
    }

    /// Changes of topology where triangles are left outside.
    fn search(&mut self) -> Result<(), Stop> {
        let constrained = self.soup.is_constrained();
        let (mut least, mut idle) = (usize::MAX, 0);
        for (i, steps) in repair::SEARCH.into_iter().enumerate() {
            let bad = self.hopeful(i < HOPEFUL_ROUNDS);
            idle = if bad.len() < least { 0 } else { idle + 1 };
            if bad.is_empty() || constrained && idle >= IDLE_ROUNDS {
                break;
            }
            least = bad.len();
            let rings = SPOT_RINGS[i.min(SPOT_RINGS.len() - 1)];
            let cuts = spots(&self.soup, &bad, rings, self.stats.rounds);
            self.round_of(&cuts, |work| {
                work.hopeful_only = i >= HOPEFUL_ROUNDS;
                search(work, steps);
            })?;
        }
        self.rescue()
    }

    /// More vertices where search has given up.
    fn rescue(&mut self) -> Result<(), Stop> {
        let constrained = self.soup.is_constrained();
        let mut least = usize::MAX;
        for rings in RESCUE_RINGS {
            let bad = self.hopeful(false);
            // PSLGs with many bad spots, or some that stay as they are, are
            // better made anew with a finer start.
            let few = FEW.max(self.soup.tris.len() / RARE);
            let elsewhere = constrained && (bad.len() > few || bad.len() >= least);
            if elsewhere || bad.is_empty() || bad.len() > self.soup.tris.len() / HOPELESS {
                break;
            }
            least = bad.len();
            let cuts = spots(&self.soup, &bad, rings, self.stats.rounds);
            let all = ALL_VISITS + VISITS_PER_TRIANGLE * self.soup.tris.len() as u64;
            let allowance = RESCUE_VISITS.min(all / bad.len() as u64);
            self.round_of(&cuts, |work| rescue(work, allowance))?;
        }
        Ok(())
    }

    /// Triangles outside the bounds for which there is hope, or all.
    fn hopeful(&self, all: bool) -> Vec<u32> {
        let corners = |t: u32| self.soup.tris[t as usize].map(|v| self.soup.pos[v as usize]);
        let mut bad = self.bad();
        bad.retain(|&t| all || !self.rules.is_hopeless(corners(t)));
        bad
    }

    /// Triangles outside the bounds.
    fn bad(&self) -> Vec<u32> {
        let near = self.soup.near();
        let wrong = self.soup.beside_wrong_sides();
        let is_bad = |&t: &u32| {
            let t = t as usize;
            let corners = self.soup.tris[t].map(|v| self.soup.pos[v as usize]);
            !self.rules.is_within(self.soup.place(t, &near), corners)
                || wrong.binary_search(&(t as u32)).is_ok()
        };
        (0..self.soup.tris.len() as u32).filter(is_bad).collect()
    }

    /// Does `job` to every part of a new partition. When time is over the
    /// parts that are left stay as they are.
    fn round(&mut self, job: impl Fn(&mut Work) + Sync) -> Result<(), Stop> {
        let cuts = partition(&self.soup, self.stats.rounds);
        self.round_of(&cuts, job)
    }

    /// Does `job` to every part.
    fn round_of(&mut self, cuts: &Cuts, job: impl Fn(&mut Work) + Sync) -> Result<(), Stop> {
        self.look()?;
        let round = self.stats.rounds;
        let seams = Seams::new(&self.soup, cuts);
        let seed = self.options.seed.wrapping_add((round as u64) << 32);
        let mut parts = Vec::with_capacity(cuts.parts.len());
        let batch = BATCH * current_num_threads();
        for first in (0..cuts.parts.len()).step_by(batch) {
            let idle = match self.look() {
                Err(Stop::Cancelled(c)) => return Err(Stop::Cancelled(c)),
                looked => looked.is_err(),
            };
            let work = |i: usize| {
                let part = extract(&self.soup, &seams, cuts, i);
                if idle {
                    return (part, Stats::default());
                }
                self.work(part, seed.wrapping_add(i as u64), &job)
            };
            let last = (first + batch).min(cuts.parts.len());
            let done: Vec<(Part, Stats)> = (first..last).into_par_iter().map(work).collect();
            for (part, stats) in done {
                self.stats.add(&stats);
                parts.push(part);
            }
        }
        self.soup = merge(&self.soup, cuts, &parts);
        self.stats.rounds += 1;
        self.look()
    }

    /// Does `job` to one part.
    fn work(&self, part: Part, seed: u64, job: &impl Fn(&mut Work)) -> (Part, Stats) {
        // The generator's first output spreads neighbouring seeds.
        let seed = Random::new(seed).next();
        let mut work = Work::new(part.mesh, self.rules, &self.refills, part.failed, seed);
        work.sizing = self.guard;
        work.patient |= self.is_small || self.options.effort >= Effort::Best;
        job(&mut work);
        work.stats.steps = work.patch.steps();
        (Part { mesh: work.mesh, global: part.global, failed: work.failed }, work.stats)
    }

    /// Tells the monitor how far the work is, and whether it may go on.
    fn look(&mut self) -> Result<(), Stop> {
        let total = self.rounds() as u64;
        self.monitor.progress(Phase::Optimize, self.stats.rounds as u64, total);
        check(self.monitor).map_err(Stop::Cancelled)?;
        if self.options.budget.is_some_and(|budget| self.start.elapsed() >= budget) {
            self.stopped = true;
            return Err(Stop::OutOfTime);
        }
        Ok(())
    }

    fn finish(self, vertices: usize) -> Result<Optimized, OptimizeError> {
        let bad = self.bad();
        let corners = bad.first().map(|&t| self.soup.tris[t as usize].map(|v| self.soup.pos[v as usize]));
        let Exported { mesh, kinds, vertices, edges } = export(self.soup, vertices);
        let best = Optimized { mesh, vertices, kinds, edges, stats: self.stats, finished: !self.stopped };
        match corners {
            None => Ok(best),
            Some(corners) => Err(OptimizeError::Unreached { bad: bad.len(), corners, best: Box::new(best) }),
        }
    }
}
