//! One mesh under work: the state the operations share.

use crate::angles::{Limits, Measure};
use crate::flip::{flip_patch, wants_flip};
use crate::mesh::Mesh;
use crate::options::Stats;
use crate::random::Random;
use crate::refill::Refills;
use crate::solve::{Solver, State};

/// A mesh, what it must become, and reused storage.
pub(crate) struct Work<'a> {
    pub(crate) mesh: Mesh,
    pub(crate) limits: &'a Limits,
    pub(crate) refills: &'a Refills,
    pub(crate) solver: Solver,
    pub(crate) random: Random,
    /// As in `Soup::failed`; as long as the mesh's vertices.
    pub(crate) failed: Vec<u8>,
    pub(crate) stats: Stats,
    pub(crate) hist: [[u32; 2]; 40],
    pub(crate) scratch: Scratch,
}

/// Storage reused between operations.
#[derive(Default)]
pub(crate) struct Scratch {
    pub(crate) tris: Vec<u32>,
    pub(crate) ring: Vec<u32>,
    pub(crate) made: Vec<u32>,
    pub(crate) verts: Vec<u32>,
    pub(crate) chosen: Vec<(f64, usize)>,
    pub(crate) new: Vec<[u32; 3]>,
}

impl<'a> Work<'a> {
    pub(crate) fn new(mesh: Mesh, limits: &'a Limits, refills: &'a Refills, failed: Vec<u8>, seed: u64) -> Self {
        Self {
            mesh,
            limits,
            refills,
            solver: Solver::default(),
            random: Random::new(seed),
            failed,
            stats: Stats::default(),
            hist: [[0; 2]; 40],
            scratch: Scratch::default(),
        }
    }

    /// Loads the patch around `verts`.
    pub(crate) fn load(&mut self, verts: &[u32]) {
        self.solver.load(&self.mesh, verts);
    }

    /// Loads the patch whose movable vertices are all of the loaded one's.
    pub(crate) fn grow(&mut self) {
        let mut verts = std::mem::take(&mut self.scratch.verts);
        verts.clear();
        verts.extend_from_slice(self.solver.vertices());
        self.solver.load(&self.mesh, &verts);
        self.scratch.verts = verts;
    }

    /// Loads the same movable vertices after a change of topology.
    pub(crate) fn reload(&mut self) {
        let mut verts = std::mem::take(&mut self.scratch.verts);
        verts.clear();
        verts.extend_from_slice(self.solver.movable());
        self.solver.load(&self.mesh, &verts);
        self.scratch.verts = verts;
    }

    /// Flips and moves the loaded patch in turn, at most `turns` times, giving
    /// up when a turn gains less than 3 % and flips nothing.
    pub(crate) fn solve(&mut self, turns: usize, steps: usize) -> State {
        let mut state = self.solver.state(self.limits);
        let mut before = state.energy;
        for turn in 0..turns {
            if state.solved {
                break;
            }
            if turn == 0 {
                state = self.solver.run(self.limits, steps);
                self.solver.store(&mut self.mesh);
                continue;
            }
            let flips = flip_patch(&mut self.mesh, &self.solver);
            if flips > 0 {
                self.reload();
            }
            state = self.solver.run(self.limits, steps);
            self.solver.store(&mut self.mesh);
            if flips == 0 && state.energy > 0.97 * before {
                break;
            }
            before = state.energy;
        }
        state
    }

    /// Projects the loaded patch, flips, projects again; falls back on steps when near.
    pub(crate) fn quick(&mut self, aim: &Limits, sweeps: usize, over: f64, stop: f64, turns: usize, near: f64, steps: usize) -> State {
        let mut state = State { energy: f64::INFINITY, solved: false };
        for turn in 0..turns {
            if turn > 0 {
                self.solver.store(&mut self.mesh);
                if flip_patch(&mut self.mesh, &self.solver) == 0 {
                    break;
                }
                self.reload();
            }
            self.solver.project(aim, sweeps, over, stop);
            state = self.solver.state(self.limits);
            if state.solved {
                break;
            }
        }
        if !state.solved && state.energy < near && steps > 0 {
            state = self.solver.run(aim, steps);
        }
        self.solver.store(&mut self.mesh);
        state
    }

    /// Whether everything changed since the last commit keeps the bounds.
    pub(crate) fn changes_hold(&self) -> bool {
        let mut ok = true;
        self.mesh.changed(|t| ok = ok && self.limits.loose(&self.mesh.measure(t)));
        ok && (!self.limits.check_delaunay || self.patch_is_delaunay())
    }

    fn patch_is_delaunay(&self) -> bool {
        let flippable = |t: u32, k: usize| {
            self.mesh.diamond(t, k).is_some_and(|(_, d)| wants_flip(&self.mesh, d))
        };
        !self.solver.ids.iter().any(|&t| (0..3).any(|k| flippable(t, k)))
    }

    /// Makes the changes final.
    pub(crate) fn commit(&mut self) {
        self.mesh.commit();
        self.failed.resize(self.mesh.pos.len(), 0);
        for &v in self.solver.vertices() {
            self.failed[v as usize] = 0;
        }
        debug_assert_eq!(self.mesh.validate(), Ok(()));
    }

    /// Triangles outside the bounds, ascending.
    pub(crate) fn bad(&self) -> Vec<u32> {
        self.mesh.live().filter(|&t| !self.is_good(t)).collect()
    }

    pub(crate) fn is_good(&self, t: u32) -> bool {
        self.limits.loose(&self.mesh.measure(t))
    }

    /// Energy of the corners of the triangles at `verts`.
    pub(crate) fn energy(&self, t: u32) -> f64 {
        let [a, b, c] = self.mesh.tri[t as usize].v.map(|v| self.mesh.pos[v as usize]);
        self.limits.energy(&Measure::of(a, b, c))
    }
}
