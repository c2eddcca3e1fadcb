//! Moves the vertices of a patch until its angles hold: Levenberg-Marquardt
//! on the angles outside the target.
//!
//! The patch is a set of movable vertices and all triangles at them. Unknowns
//! are the displacements in units of each vertex's shortest edge, so graded
//! patches are as well scaled as uniform ones. The gradient of the angle at A
//! between u = B-A and w = C-A is `perp(w)/|w|^2` for C, `-perp(u)/|u|^2` for
//! B and minus their sum for A, with `perp(x, y) = (-y, x)`.

use hexdel_geom::DVec2;

use crate::angles::{Limits, Measure};
use crate::mesh::{Mesh, Motion, NONE};
use crate::skyline::Skyline;

/// No vertex moves farther in one step than this share of its shortest edge:
/// half of it could turn a triangle over when both ends of an edge move.
const STEP_LIMIT: f64 = 0.4;
const SHIFT_START: f64 = 1e-2;
const SHIFT_MIN: f64 = 1e-6;
const SHIFT_DOWN: f64 = 0.3;
const SHIFT_UP: f64 = 5.0;
const SHIFT_TRIES: usize = 6;

/// A corner outside the target.
#[derive(Clone, Copy, Debug)]
struct Active {
    /// Apex and the other two corners, counter-clockwise, local indices.
    v: [u32; 3],
    /// Distance outside, radians; negative below the lower bound.
    residual: f64,
}

/// How a patch stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    /// Sum of squared distances outside the target.
    pub(crate) energy: f64,
    /// Every triangle is strictly inside the bounds.
    pub(crate) solved: bool,
}

/// A patch under work; storage is reused from patch to patch.
#[derive(Debug, Default)]
pub(crate) struct Solver {
    /// Local index of a mesh vertex, `NONE` for those not in the patch.
    slot: Vec<u32>,
    /// Mesh triangles seen in this patch carry the current epoch.
    seen: Vec<u32>,
    epoch: u32,
    /// Mesh vertices: the movable ones first, then the rim of the patch.
    verts: Vec<u32>,
    movable: usize,
    /// Mesh triangles of the patch.
    pub(crate) ids: Vec<u32>,
    /// Local corners of the triangles.
    tris: Vec<[u32; 3]>,
    pos: Vec<DVec2>,
    trial: Vec<DVec2>,
    /// Direction of a sliding vertex, zero for a free one.
    along: Vec<DVec2>,
    /// Shortest edge of each movable vertex.
    unit: Vec<f64>,
    /// Square of `unit` for movable vertices, zero for the others.
    weight: Vec<f64>,
    active: Vec<Active>,
    active_trial: Vec<Active>,
    first: Vec<u32>,
    matrix: Skyline,
    rhs: Vec<f64>,
    x: Vec<f64>,
    shift: f64,
    /// Steps computed since the solver was made.
    pub(crate) steps: u64,
}

impl Solver {
    /// Takes a copy of the patch around `movable`, of which the fixed ones are
    /// left out.
    pub(crate) fn load(&mut self, mesh: &Mesh, movable: &[u32]) {
        self.clear();
        self.slot.resize(self.slot.len().max(mesh.pos.len()), NONE);
        self.seen.resize(self.seen.len().max(mesh.tri.len()), 0);
        for &v in movable {
            self.enter(mesh, v);
        }
        self.movable = self.verts.len();
        for i in 0..self.movable {
            let v = self.verts[i];
            let ids = &mut self.ids;
            let (seen, epoch) = (&mut self.seen, self.epoch);
            mesh.around(v, |t, _| {
                if seen[t as usize] != epoch {
                    seen[t as usize] = epoch;
                    ids.push(t);
                }
            });
        }
        for i in 0..self.ids.len() {
            let corners = mesh.tri[self.ids[i] as usize].v;
            let local = corners.map(|v| self.enter_rim(mesh, v));
            self.tris.push(local);
        }
        self.measure_units();
        self.shift = SHIFT_START;
    }

    fn clear(&mut self) {
        for &v in &self.verts {
            self.slot[v as usize] = NONE;
        }
        self.verts.clear();
        self.ids.clear();
        self.tris.clear();
        self.pos.clear();
        self.along.clear();
        self.epoch += 1;
    }

    fn enter(&mut self, mesh: &Mesh, v: u32) {
        let along = match mesh.motion[v as usize] {
            Motion::Fixed => return,
            Motion::Along(d) => d,
            Motion::Free => DVec2::ZERO,
        };
        if self.slot[v as usize] == NONE {
            self.slot[v as usize] = self.verts.len() as u32;
            self.verts.push(v);
            self.pos.push(mesh.pos[v as usize]);
            self.along.push(along);
        }
    }

    fn enter_rim(&mut self, mesh: &Mesh, v: u32) -> u32 {
        if self.slot[v as usize] == NONE {
            self.slot[v as usize] = self.verts.len() as u32;
            self.verts.push(v);
            self.pos.push(mesh.pos[v as usize]);
            self.along.push(DVec2::ZERO);
        }
        self.slot[v as usize]
    }

    fn measure_units(&mut self) {
        self.unit.clear();
        self.unit.resize(self.verts.len(), f64::INFINITY);
        for t in &self.tris {
            for k in 0..3 {
                let (i, j) = (t[k] as usize, t[(k + 1) % 3] as usize);
                let d = (self.pos[i] - self.pos[j]).length_squared();
                self.unit[i] = self.unit[i].min(d);
                self.unit[j] = self.unit[j].min(d);
            }
        }
        for u in &mut self.unit {
            // Coincident vertices still need a positive unit to part.
            *u = u.sqrt().max(f64::MIN_POSITIVE.sqrt());
        }
        self.weight.clear();
        let n = self.movable;
        self.weight.extend(self.unit.iter().enumerate().map(|(i, u)| if i < n { u * u } else { 0.0 }));
    }

    /// The patch as it stands.
    pub(crate) fn state(&mut self, limits: &Limits) -> State {
        evaluate(limits, &self.tris, &self.pos, &mut self.active)
    }

    /// At most `steps` steps; stops when solved or when no step helps.
    pub(crate) fn run(&mut self, limits: &Limits, steps: usize) -> State {
        let mut state = self.state(limits);
        for _ in 0..steps {
            if state.solved || self.movable == 0 {
                break;
            }
            let Some(next) = self.step(limits, state) else { break };
            state = next;
        }
        state
    }

    /// Projects the corners outside the target onto it, one after the other, for
    /// at most `sweeps` sweeps over the patch; returns the energy met in the
    /// last sweep, zero when nothing was outside.
    pub(crate) fn project(&mut self, limits: &Limits, sweeps: usize, over: f64, stop: f64) -> (f64, usize) {
        let mut energy = 0.0;
        let mut mark = f64::INFINITY;
        for sweep in 0..sweeps {
            energy = 0.0;
            for i in 0..self.tris.len() {
                let t = self.tris[i].map(|v| v as usize);
                let [a, b, c] = t.map(|v| self.pos[v]);
                let m = Measure::of(a, b, c);
                let (low, high) = limits.outside(&m);
                if let Some((k, g)) = low {
                    energy += self.push(t, k, g, limits.lower_turn(), over);
                }
                if let Some((k, g)) = high {
                    energy += self.push(t, k, g, limits.upper_turn(), over);
                }
            }
            if energy == 0.0 {
                return (0.0, sweep);
            }
            if sweep % 4 == 3 {
                if energy > stop * mark {
                    return (energy, sweep);
                }
                mark = energy;
            }
        }
        (energy, sweeps)
    }

    /// Moves the corners of `t` so that `g = cross * turn.x + dot * turn.y`,
    /// given at corner `k` and negative, vanishes to first order.
    #[inline]
    fn push(&mut self, t: [usize; 3], k: usize, g: f64, turn: DVec2, over: f64) -> f64 {
        let v = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
        let [a, b, c] = v.map(|v| self.pos[v]);
        let (u, w) = (b - a, c - a);
        let at_c = turn.x * u.perp() + turn.y * u;
        let at_b = turn.y * w - turn.x * w.perp();
        let mut d = [-(at_b + at_c), at_b, at_c];
        let mut norm = 0.0;
        for i in 0..3 {
            let weight = self.weight[v[i]];
            let along = self.along[v[i]];
            if along != DVec2::ZERO {
                d[i] = along * along.dot(d[i]);
            }
            norm += weight * d[i].length_squared();
            d[i] *= weight;
        }
        if norm <= 0.0 {
            return f64::INFINITY;
        }
        let cap = 0.15 * (u.length_squared() + w.length_squared());
        let step = over * (-g).min(cap) / norm;
        for i in 0..3 {
            self.pos[v[i]] += d[i] * step;
        }
        g * g / norm
    }

    /// One step from the active corners of `state`; none where every length of
    /// step fails to lower the energy.
    fn step(&mut self, limits: &Limits, state: State) -> Option<State> {
        self.assemble();
        for _ in 0..SHIFT_TRIES {
            self.steps += 1;
            self.x.clear();
            self.x.extend_from_slice(&self.rhs);
            self.matrix.solve(self.shift, &mut self.x);
            self.try_step();
            let next = evaluate(limits, &self.tris, &self.trial, &mut self.active_trial);
            if next.solved || next.energy < state.energy {
                std::mem::swap(&mut self.pos, &mut self.trial);
                std::mem::swap(&mut self.active, &mut self.active_trial);
                self.shift = (self.shift * SHIFT_DOWN).max(SHIFT_MIN);
                return Some(next);
            }
            self.shift *= SHIFT_UP;
        }
        None
    }

    fn try_step(&mut self) {
        let mut longest = 0.0f64;
        for d in self.x.chunks_exact(2) {
            longest = longest.max(d[0] * d[0] + d[1] * d[1]);
        }
        let longest = longest.sqrt();
        let scale = if longest > STEP_LIMIT { STEP_LIMIT / longest } else { 1.0 };
        self.trial.clear();
        self.trial.extend_from_slice(&self.pos);
        for (i, d) in self.x.chunks_exact(2).enumerate() {
            let by = DVec2::new(d[0], d[1]) * (scale * self.unit[i]);
            let along = self.along[i];
            // A sliding vertex stays on its line to the last bit it can.
            self.trial[i] += if along == DVec2::ZERO { by } else { along * along.dot(by) };
        }
    }

    /// The normal equations of the active corners.
    fn assemble(&mut self) {
        let n = self.movable as u32;
        self.first.clear();
        self.first.extend(0..n);
        for c in &self.active {
            let low = c.v.into_iter().min().unwrap_or(0);
            for v in c.v.into_iter().filter(|v| *v < n) {
                self.first[v as usize] = self.first[v as usize].min(low);
            }
        }
        self.matrix.reset(&self.first);
        self.rhs.clear();
        self.rhs.resize(2 * self.movable, 0.0);
        for c in &self.active {
            let [a, b, w] = c.v.map(|v| self.pos[v as usize]);
            let (u, w) = (b - a, w - a);
            let at_b = -u.perp() / u.length_squared();
            let at_w = w.perp() / w.length_squared();
            let g = [-(at_b + at_w), at_b, at_w];
            for i in 0..3 {
                let vi = c.v[i] as usize;
                if vi >= self.movable {
                    continue;
                }
                let gi = scaled(g[i], self.along[vi], self.unit[vi]);
                self.rhs[2 * vi] -= c.residual * gi.x;
                self.rhs[2 * vi + 1] -= c.residual * gi.y;
                for j in 0..3 {
                    let vj = c.v[j] as usize;
                    if vj <= vi {
                        self.matrix.add(vi, vj, gi, scaled(g[j], self.along[vj], self.unit[vj]));
                    }
                }
            }
        }
    }

    /// Writes the positions back.
    pub(crate) fn store(&self, mesh: &mut Mesh) {
        for i in 0..self.movable {
            let v = self.verts[i];
            if mesh.pos[v as usize] != self.pos[i] {
                mesh.set_pos(v, self.pos[i]);
            }
        }
    }

    /// The movable vertices of the patch.
    pub(crate) fn movable(&self) -> &[u32] {
        &self.verts[..self.movable]
    }

    /// All vertices of the patch.
    pub(crate) fn vertices(&self) -> &[u32] {
        &self.verts
    }

    /// Whether triangle `t` of the mesh belongs to the patch.
    pub(crate) fn holds(&self, t: u32) -> bool {
        self.seen.get(t as usize) == Some(&self.epoch)
    }
}

#[inline]
fn scaled(g: DVec2, along: DVec2, unit: f64) -> DVec2 {
    if along == DVec2::ZERO { g * unit } else { along * (along.dot(g) * unit) }
}

/// Energy and active corners at `pos`.
fn evaluate(limits: &Limits, tris: &[[u32; 3]], pos: &[DVec2], active: &mut Vec<Active>) -> State {
    active.clear();
    let mut energy = 0.0;
    let mut solved = true;
    for t in tris {
        let [a, b, c] = t.map(|v| pos[v as usize]);
        let m = Measure::of(a, b, c);
        if limits.on_target(&m) {
            continue;
        }
        solved &= limits.strict(&m);
        for k in 0..3 {
            let residual = limits.residual(&m, k);
            if residual != 0.0 {
                energy += residual * residual;
                active.push(Active { v: [t[k], t[(k + 1) % 3], t[(k + 2) % 3]], residual });
            }
        }
    }
    State { energy, solved }
}
