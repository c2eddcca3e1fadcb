//! One mesh under work: the state the operations share.

use hexdel_geom::orient2d;

use crate::constraints::Rules;
use crate::flip::{flip_patch, wants_flip};
use crate::mesh::{Mesh, Motion, Tri};
use crate::options::Stats;
use crate::patch::{Patch, State, Sweeps, Swept};
use crate::random::Random;
use crate::refill::Refills;
use crate::sizing::{Sizing, triangle_fits};
use crate::spread::{Reach, Spread};

/// How long one patch is worked on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    pub(crate) sweeps: Sweeps,
    /// How often the sweeps are repeated after flips.
    pub(crate) turns: usize,
    /// Energy below which Newton steps follow, square radians.
    pub(crate) near: f64,
    /// Newton steps.
    pub(crate) steps: usize,
}

/// A mesh, what it must become, and reused storage.
pub(crate) struct Work<'a> {
    pub(crate) mesh: Mesh,
    pub(crate) rules: &'a Rules<'a>,
    pub(crate) refills: &'a Refills,
    /// How long the edges of what changes may be, if that matters.
    pub(crate) sizing: Option<&'a dyn Sizing>,
    pub(crate) patch: Patch,
    spread: Spread,
    /// Whether the last motion was that of `spread`, not of `patch`.
    spreads: bool,
    pub(crate) random: Random,
    /// As in `Soup::failed`; as long as the mesh's vertices after a commit.
    pub(crate) failed: Vec<u8>,
    pub(crate) stats: Stats,
    pub(crate) scratch: Scratch,
    /// Repair stops once sweeps have gone over so many triangles.
    pub(crate) allowance: u64,
    /// Whether removals take their time: among segments, where fewer vertices can go and
    /// more are fixed, and in small meshes.
    pub(crate) patient: bool,
    /// Whether repair leaves triangles alone for which there is no hope.
    pub(crate) hopeful_only: bool,
    /// Vertices handed to the patch.
    seeds: Vec<u32>,
}

/// Storage reused between operations.
#[derive(Default)]
pub(crate) struct Scratch {
    pub(crate) tris: Vec<u32>,
    pub(crate) ring: Vec<u32>,
    pub(crate) made: Vec<u32>,
    pub(crate) chosen: Vec<(f64, usize)>,
    pub(crate) new: Vec<[u32; 3]>,
}

impl<'a> Work<'a> {
    pub(crate) fn new(
        mesh: Mesh,
        rules: &'a Rules<'a>,
        refills: &'a Refills,
        failed: Vec<u8>,
        seed: u64,
    ) -> Self {
        Self {
            patient: mesh.is_constrained(),
            mesh,
            rules,
            refills,
            sizing: None,
            patch: Patch::default(),
            spread: Spread::default(),
            spreads: false,
            random: Random::new(seed),
            failed,
            stats: Stats::default(),
            scratch: Scratch::default(),
            allowance: u64::MAX,
            hopeful_only: false,
            seeds: Vec::new(),
        }
    }

    /// Loads the patch around `verts`.
    pub(crate) fn load(&mut self, verts: &[u32]) {
        self.spreads = false;
        self.patch.load(&self.mesh, verts);
    }

    /// Loads the patch whose movable vertices are all of the loaded one's.
    pub(crate) fn grow(&mut self) {
        self.seeds.clear();
        self.seeds.extend_from_slice(self.patch.vertices());
        self.patch.load(&self.mesh, &self.seeds);
    }

    /// Loads the same movable vertices after a change of topology.
    fn reload(&mut self) {
        self.seeds.clear();
        self.seeds.extend_from_slice(self.patch.movable());
        self.patch.load(&self.mesh, &self.seeds);
    }

    /// Moves `verts` and what they push.
    pub(crate) fn spread(&mut self, verts: &[u32], reach: Reach) -> Swept {
        self.spreads = true;
        self.spread.run(&mut self.mesh, self.rules, verts, reach)
    }

    /// Flips and moves what [`Work::spread`] has moved in vain.
    pub(crate) fn finish(&mut self, effort: Effort) -> State {
        self.spreads = false;
        self.patch.load(&self.mesh, self.spread.moved());
        let state = if flip_patch(&mut self.mesh, &self.patch) > 0 {
            self.reload();
            self.solve(Effort { near: 0.0, ..effort })
        } else {
            self.patch.state(self.rules)
        };
        if state.solved { state } else { self.close_in(state, effort) }
    }

    /// Moves and flips the loaded patch in turn until it is solved, nothing
    /// flips, or the effort is spent. Motion comes first: flipping first would
    /// undo the choice of degrees that made the patch promising. A hopeless patch is
    /// left unfinished.
    pub(crate) fn solve(&mut self, effort: Effort) -> State {
        let mut state = State::HOPELESS;
        for turn in 0..effort.turns {
            if turn > 0 {
                self.patch.store(&mut self.mesh);
                if flip_patch(&mut self.mesh, &self.patch) == 0 {
                    break;
                }
                self.reload();
            }
            match self.patch.project(self.rules, effort.sweeps) {
                Swept::Settled => state = State { energy: 0.0, solved: true },
                Swept::Stalled => state = self.patch.state(self.rules),
                Swept::Hopeless => return State::HOPELESS,
            }
            if state.solved {
                break;
            }
        }
        self.close_in(state, effort)
    }

    /// Newton steps where the loaded patch is near enough.
    fn close_in(&mut self, state: State, effort: Effort) -> State {
        let near = !state.solved && state.energy < effort.near;
        let state = if near { self.patch.newton(self.rules, effort.steps) } else { state };
        self.patch.store(&mut self.mesh);
        state
    }

    /// The triangles at vertices that the last motion could move.
    fn touched(&self) -> &[u32] {
        if self.spreads { self.spread.triangles() } else { self.patch.triangles() }
    }

    /// Triangles that sweeps went over.
    pub(crate) fn visits(&self) -> u64 {
        self.patch.visits() + self.spread.visits()
    }

    /// Whether everything changed since the last commit keeps the bounds, and
    /// the patch is Delaunay where the bounds do not imply it, its edges as short
    /// as wanted.
    pub(crate) fn changes_hold(&self) -> bool {
        let mut ok = true;
        self.mesh.changed(|t| ok = ok && self.is_good(t));
        ok && self.changes_fit()
            && (!self.rules.check_delaunay() || self.patch_is_delaunay())
            && (!self.mesh.is_constrained() || self.places_hold())
            && (!self.rules.limits_areas() || self.areas_hold())
    }

    /// Whether nothing that changed since the last commit is clockwise, flat,
    /// larger than allowed or longer than wanted. A mesh with segments comes without such triangles, so that
    /// no step towards the bounds may make one; other starts may have some to be repaired.
    pub(crate) fn stays_valid(&self) -> bool {
        let mesh = &self.mesh;
        if !mesh.is_constrained() {
            return true;
        }
        let turns_left = |t: u32| {
            let [a, b, c] = mesh.tri[t as usize].v.map(|v| mesh.pos[v as usize]);
            !mesh.tri[t as usize].alive() || orient2d(a, b, c) > 0.0
        };
        let mut valid = self.touched().iter().all(|&t| turns_left(t));
        mesh.changed(|t| valid = valid && turns_left(t));
        valid
            && !self.patch.collapses()
            && self.changes_fit()
            && (!self.rules.limits_areas() || self.areas_hold())
    }

    /// Whether what has been near a segment and is no more keeps the bounds
    /// that hold farther away. A vertex on a seam must stay near.
    fn places_hold(&self) -> bool {
        let mesh = &self.mesh;
        let mut lost: Vec<u32> = Vec::new();
        mesh.overwritten(|old| {
            let sources = old.iter().filter(|&&v| mesh.is_on_source(v)).count();
            // The other corners touch a source by this triangle.
            lost.extend(old.iter().filter(|&&v| sources > 0 && !mesh.is_on_source(v)));
        });
        lost.sort_unstable();
        lost.dedup();
        lost.retain(|&v| mesh.alive(v) && !mesh.touches_source(v));
        lost.iter().all(|&v| {
            let mut holds = mesh.motion[v as usize] != Motion::Frozen;
            mesh.around(v, |t, _| holds = holds && self.is_good(t));
            holds
        })
    }

    fn areas_hold(&self) -> bool {
        let corners = |t: u32| self.mesh.tri[t as usize].v.map(|v| self.mesh.pos[v as usize]);
        let mut hold = true;
        self.mesh.changed(|t| hold = hold && self.rules.is_small(corners(t)));
        let is_small = |&t: &u32| !self.mesh.tri[t as usize].alive() || self.rules.is_small(corners(t));
        hold && self.touched().iter().all(is_small)
    }

    /// Whether no edge that changed is longer than wanted.
    fn changes_fit(&self) -> bool {
        let Some(sizing) = self.sizing else {
            return true;
        };
        let fits = |t: u32| {
            let corners = self.mesh.tri[t as usize].v;
            triangle_fits(sizing, corners.map(|v| self.mesh.pos[v as usize]))
        };
        let mut ok = self.touched().iter().all(|&t| fits(t));
        self.mesh.changed(|t| ok = ok && fits(t));
        ok
    }

    fn patch_is_delaunay(&self) -> bool {
        let wrong =
            |t: u32, k: usize| self.mesh.diamond(t, k).is_some_and(|(_, d)| wants_flip(&self.mesh, d));
        !self.touched().iter().any(|&t| (0..3).any(|k| wrong(t, k)))
    }

    /// Makes the changes final.
    pub(crate) fn commit(&mut self) {
        self.mesh.commit();
        self.failed.resize(self.mesh.pos.len(), 0);
        if self.spreads {
            let touched = self.spread.triangles().iter().map(|&t| self.mesh.tri[t as usize]);
            for v in touched.filter(Tri::alive).flat_map(|tri| tri.v) {
                self.failed[v as usize] = 0;
            }
        } else {
            for &v in self.patch.vertices() {
                self.failed[v as usize] = 0;
            }
        }
        debug_assert_eq!(self.mesh.validate(), Ok(()));
    }

    /// Whether triangle `t` is alive and outside the bounds.
    pub(crate) fn is_bad(&self, t: u32) -> bool {
        self.mesh.tri[t as usize].alive() && !self.is_good(t)
    }

    /// Whether no mesh is expected to bring `t` within the bounds.
    pub(crate) fn is_hopeless(&self, t: u32) -> bool {
        self.rules.is_hopeless(self.mesh.tri[t as usize].v.map(|v| self.mesh.pos[v as usize]))
    }

    fn is_good(&self, t: u32) -> bool {
        self.rules.is_good(&self.mesh, t) && !self.mesh.has_wrong_side(t)
    }

    /// Triangles outside the bounds, ascending.
    pub(crate) fn bad(&self) -> Vec<u32> {
        self.mesh.live().filter(|&t| !self.is_good(t)).collect()
    }
}

#[cfg(test)]
mod tests;
