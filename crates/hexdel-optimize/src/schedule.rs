//! The order of the work: rounds of repair, of removals, of shakes, each over
//! all parts of a new partition at once.

use std::time::{Duration, Instant};

use hexdel_geom::TriMesh;
use rayon::prelude::*;

use crate::angles::{Limits, Measure};
use crate::decimate::{PASSES, decimate};
use crate::error::OptimizeError;
use crate::import::{export, import};
use crate::mesh::Soup;
use crate::options::{Effort, Optimized, Options, Phase, Progress, Stats, VertexKind};
use crate::partition::{Part, Seams, extract, merge, partition};
use crate::random::Random;
use crate::refill::Refills;
use crate::repair::{self, repair};
use crate::shake::{SHAKES, shake};
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
/// because the work was stopped.
///
/// # Complexity
///
/// Near-linear in the number of vertices; each round's cuts cost `n log n`.
/// Runs on the current rayon thread pool.
pub fn optimize(
    mesh: TriMesh,
    kinds: &[VertexKind],
    options: &Options<'_>,
) -> Result<Optimized, OptimizeError> {
    let vertices = mesh.vertices.len();
    let soup = import(mesh, kinds)?;
    let mut run = Run::new(soup, options);
    run.all();
    run.finish(vertices)
}

/// Passes of removals before the last repairs.
const EARLY_PASSES: usize = 6;

/// Passes of removals at standard effort: the later ones take half as long
/// again for 3 to 4 % fewer triangles.
const STANDARD_PASSES: usize = 10;

/// The state between rounds.
struct Run<'a> {
    soup: Soup,
    options: &'a Options<'a>,
    limits: Limits,
    refills: Refills,
    deadline: Option<(Instant, Duration)>,
    stats: Stats,
    /// Set when the hook or the budget ends the work.
    stopped: bool,
}

impl<'a> Run<'a> {
    fn new(soup: Soup, options: &'a Options<'a>) -> Self {
        Self {
            soup,
            options,
            limits: Limits::new(options.bounds),
            refills: Refills::new(),
            deadline: options.budget.map(|b| (Instant::now(), b)),
            stats: Stats::default(),
            stopped: false,
        }
    }

    /// The phases in turn. Most of the removals come before the last repairs:
    /// what motion alone does not settle often goes with a vertex, and search
    /// is cheaper on the coarser mesh.
    fn all(&mut self) -> Option<()> {
        self.repair(0, repair::FIRST_ROUNDS)?;
        if self.options.effort == Effort::Fast {
            self.repair(repair::FIRST_ROUNDS, repair::FAST_ROUNDS)?;
            if self.bad().next().is_none() {
                return Some(());
            }
        }
        self.decimate(0, EARLY_PASSES)?;
        self.repair(repair::FIRST_ROUNDS, repair::ROUNDS)?;
        if self.options.effort == Effort::Fast {
            return Some(());
        }
        let best = self.options.effort == Effort::Best;
        self.decimate(
            EARLY_PASSES,
            if best { PASSES.len() } else { STANDARD_PASSES },
        )?;
        self.repair(repair::FIRST_ROUNDS, repair::ROUNDS)?;
        if best {
            for i in 0..SHAKES {
                self.round(Phase::Shake, i, shake)?;
            }
        }
        Some(())
    }

    fn decimate(&mut self, from: usize, to: usize) -> Option<()> {
        for (i, &pass) in PASSES.iter().enumerate().take(to).skip(from) {
            self.round(Phase::Decimate, i, |work| {
                decimate(work, pass);
            })?;
        }
        Some(())
    }

    fn repair(&mut self, from: usize, to: usize) -> Option<()> {
        for i in from..to {
            if self.bad().next().is_none() {
                break;
            }
            self.round(Phase::Repair, i, |work| repair(work, repair::step(i)))?;
        }
        Some(())
    }

    /// Triangles outside the bounds.
    fn bad(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.soup.tris.len()).filter(|&t| {
            let [a, b, c] = self.soup.tris[t].map(|v| self.soup.pos[v as usize]);
            !self.limits.loose(&Measure::of(a, b, c))
        })
    }

    /// Does `job` to every part of a new partition; none when the work is to
    /// stop, before anything is done.
    fn round(&mut self, phase: Phase, index: usize, job: impl Fn(&mut Work) + Sync) -> Option<()> {
        if !self.may_go_on(phase, index) {
            self.stopped = true;
            return None;
        }
        let round = self.stats.rounds;
        let cuts = partition(&self.soup, round);
        let seams = Seams::new(&self.soup, &cuts);
        let (soup, limits, refills) = (&self.soup, &self.limits, &self.refills);
        let seed = self.options.seed.wrapping_add((round as u64) << 32);
        let done: Vec<(Part, Stats)> = cuts
            .par_iter()
            .enumerate()
            .map(|(i, triangles)| {
                let part = extract(soup, &seams, triangles);
                // The generator's first output spreads neighbouring seeds.
                let seed = Random::new(seed.wrapping_add(i as u64)).next();
                let mut work = Work::new(part.mesh, limits, refills, part.failed, seed);
                job(&mut work);
                work.stats.steps = work.patch.steps();
                (
                    Part {
                        mesh: work.mesh,
                        global: part.global,
                        failed: work.failed,
                    },
                    work.stats,
                )
            })
            .collect();
        let mut parts = Vec::with_capacity(done.len());
        for (part, stats) in done {
            self.stats.add(&stats);
            parts.push(part);
        }
        self.soup = merge(&self.soup, &parts);
        self.stats.rounds += 1;
        Some(())
    }

    fn may_go_on(&self, phase: Phase, round: usize) -> bool {
        let in_time = self
            .deadline
            .is_none_or(|(start, budget)| start.elapsed() < budget);
        let progress = || Progress {
            phase,
            round,
            triangles: self.soup.tris.len(),
            bad: self.bad().count(),
        };
        in_time && self.options.hook.is_none_or(|hook| hook(progress()))
    }

    fn finish(self, vertices: usize) -> Result<Optimized, OptimizeError> {
        let bad: Vec<usize> = self.bad().collect();
        let corners = bad
            .first()
            .map(|&t| self.soup.tris[t].map(|v| self.soup.pos[v as usize]));
        let (mesh, kinds, map) = export(self.soup, vertices);
        let best = Optimized {
            mesh,
            vertices: map,
            kinds,
            stats: self.stats,
            finished: !self.stopped,
        };
        match corners {
            None => Ok(best),
            Some(corners) => Err(OptimizeError::Unreached {
                bad: bad.len(),
                corners,
                best: Box::new(best),
            }),
        }
    }
}
