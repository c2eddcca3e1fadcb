//! Levenberg-Marquardt on the angles outside the target (Marquardt, "An
//! algorithm for least-squares estimation of nonlinear parameters", 1963).
//!
//! Unknowns are the displacements in units of each vertex's shortest edge, so
//! graded patches are as well scaled as uniform ones.

use hexdel_geom::DVec2;

use super::skyline::Skyline;
use super::{Active, Patch, State, angle_gradient, evaluate};
use crate::constraints::Rules;

/// No vertex moves farther in one step than this share of its shortest edge:
/// half of it could turn a triangle over when both ends of an edge move.
const STEP_LIMIT: f64 = 0.4;
/// Added to the diagonal of the scaled normal equations at first.
const SHIFT_START: f64 = 1e-2;
const SHIFT_MIN: f64 = 1e-6;
const SHIFT_DOWN: f64 = 0.3;
const SHIFT_UP: f64 = 5.0;
const SHIFT_TRIES: usize = 6;

/// Storage of the method.
#[derive(Debug, Default)]
pub(crate) struct Newton {
    matrix: Skyline,
    /// First block column of each block row of the matrix.
    first: Vec<u32>,
    /// Right-hand side, two entries for each movable vertex.
    rhs: Vec<f64>,
    x: Vec<f64>,
    /// Positions and active corners after the step under trial.
    pos: Vec<DVec2>,
    active: Vec<Active>,
    /// Positive.
    shift: f64,
    steps: u64,
}

impl Newton {
    pub(super) fn restart(&mut self) {
        self.shift = SHIFT_START;
    }

    pub(super) fn steps(&self) -> u64 {
        self.steps
    }
}

impl Patch {
    /// At most `steps` steps; stops when solved or when no step helps.
    pub(crate) fn newton(&mut self, rules: &Rules<'_>, steps: usize) -> State {
        let mut state = self.state(rules);
        for _ in 0..steps {
            if state.solved || self.movable == 0 {
                break;
            }
            let Some(next) = self.step(rules, state) else {
                break;
            };
            state = next;
        }
        state
    }

    /// One step from the active corners of `state`; none where every length of
    /// step fails to lower the energy.
    fn step(&mut self, rules: &Rules<'_>, state: State) -> Option<State> {
        self.assemble();
        for _ in 0..SHIFT_TRIES {
            let newton = &mut self.newton;
            newton.steps += 1;
            newton.x.clear();
            newton.x.extend_from_slice(&newton.rhs);
            newton.matrix.solve(newton.shift, &mut newton.x);
            self.try_step();
            let newton = &mut self.newton;
            let next = evaluate(rules, &self.tris, &self.places, &newton.pos, &mut newton.active);
            if next.solved || next.energy < state.energy {
                std::mem::swap(&mut self.pos, &mut newton.pos);
                std::mem::swap(&mut self.active, &mut newton.active);
                newton.shift = (newton.shift * SHIFT_DOWN).max(SHIFT_MIN);
                return Some(next);
            }
            newton.shift *= SHIFT_UP;
        }
        None
    }

    fn try_step(&mut self) {
        let newton = &mut self.newton;
        let longest = newton.x.chunks_exact(2).map(|d| d[0] * d[0] + d[1] * d[1]).fold(0.0, f64::max).sqrt();
        let scale = if longest > STEP_LIMIT { STEP_LIMIT / longest } else { 1.0 };
        newton.pos.clear();
        newton.pos.extend_from_slice(&self.pos);
        for (i, d) in newton.x.chunks_exact(2).enumerate() {
            let by = DVec2::new(d[0], d[1]) * (scale * self.unit[i]);
            let along = self.along[i];
            // A sliding vertex stays on its line to the last bit it can.
            newton.pos[i] += if along == DVec2::ZERO { by } else { along * along.dot(by) };
        }
    }

    /// The normal equations of the active corners.
    fn assemble(&mut self) {
        let n = self.movable as u32;
        let newton = &mut self.newton;
        newton.first.clear();
        newton.first.extend(0..n);
        for c in &self.active {
            let low = c.v.into_iter().fold(n, u32::min);
            for v in c.v.into_iter().filter(|v| *v < n) {
                newton.first[v as usize] = newton.first[v as usize].min(low);
            }
        }
        newton.matrix.reset(&newton.first);
        newton.rhs.clear();
        newton.rhs.resize(2 * self.movable, 0.0);
        for c in &self.active {
            let v = c.v.map(|v| v as usize);
            let [pa, pb, pc] = v.map(|v| self.pos[v]);
            let g = angle_gradient(pa, pb, pc);
            let g: [DVec2; 3] = std::array::from_fn(|i| scaled(g[i], self.along[v[i]], self.unit[v[i]]));
            for i in (0..3).filter(|&i| v[i] < self.movable) {
                newton.rhs[2 * v[i]] -= c.residual * g[i].x;
                newton.rhs[2 * v[i] + 1] -= c.residual * g[i].y;
                for j in (0..3).filter(|&j| v[j] <= v[i]) {
                    newton.matrix.add(v[i], v[j], g[i], g[j]);
                }
            }
        }
    }
}

#[inline]
fn scaled(g: DVec2, along: DVec2, unit: f64) -> DVec2 {
    if along == DVec2::ZERO { g * unit } else { along * (along.dot(g) * unit) }
}
