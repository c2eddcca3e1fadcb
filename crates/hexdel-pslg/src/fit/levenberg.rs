//! Moves vertices until angles keep their bounds: damped least squares.
//!
//! Levenberg ("A method for the solution of certain non-linear problems in
//! least squares", 1944) and Marquardt (1963), on the angles past their bounds.
//! Free vertices move in the plane, those on a segment along it. Angles are
//! signed, so that a triangle that is turned over comes back.

use super::judge::{Judge, Limits, penalty_of};
use crate::net::{Kind, Net};
use hexdel_geom::{DVec2, quality};

/// Degrees that are aimed at beyond a bound. Success is judged without: the
/// right angles of the lattice cannot have them.
const SLACK_DEG: f64 = 0.2;

/// Damping in the units of the normal equations: an angle changes by about 57
/// degrees when its leg's end moves by the leg's length, so that their diagonal
/// is some thousands. One per cent of it.
const DAMPING: f64 = 30.0;

/// Bounds and factors of the damping parameter.
const LEAST_DAMPING: f64 = 1e-6;
const RELAX: f64 = 0.3;
const TIGHTEN: f64 = 4.0;

/// Degrees inside of what is aimed at from which on no angle has to be worked out.
const CLEAR_DEG: f64 = 1e-6;

/// Tries at a step, and steps without a gain of [`WORTHWHILE`] in a row.
const TRIES: u32 = 8;
const PATIENCE: u32 = 5;
const WORTHWHILE: f64 = 0.97;

/// A vertex of the problem.
#[derive(Clone, Copy)]
struct Local {
    at: DVec2,
    kind: Kind,
    /// Its first unknown; none if it is fixed.
    unknown: Option<usize>,
    /// The direction in which it moves, if it moves along a segment.
    along: Option<DVec2>,
}

/// A triangle of the problem.
struct Triangle {
    corners: [u32; 3],
    limits: [Limits; 3],
    clear: [Cot; 3],
}

impl Triangle {
    /// Its angles, degrees, unless all are clearly inside of what is aimed at.
    fn angles(&self, locals: &[Local]) -> Option<[f64; 3]> {
        let p = self.corners.map(|v| locals[v as usize].at);
        let is_clear = |i: usize| {
            let (u, w) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            let (cross, dot) = (u.perp_dot(w), u.dot(w));
            let [most, least] = self.clear[i];
            cross > 0.0 && dot < most * cross && dot > least * cross
        };
        (!(0..3).all(is_clear)).then(|| quality::angles_deg(p))
    }
}

/// The cotangents of the smallest and the largest angle that is clearly inside.
type Cot = [f64; 2];

/// The cotangents of limits.
#[derive(Default)]
struct Cots(Vec<(Limits, Cot)>);

impl Cots {
    /// Limits are few.
    fn of(&mut self, limits: Limits) -> Cot {
        if let Some(known) = self.0.iter().find(|known| known.0 == limits) {
            return known.1;
        }
        let cot = |deg: f64| {
            let (sin, cos) = libm::sincos(deg.to_radians());
            cos / sin
        };
        let [lo, hi] = limits;
        let inset = SLACK_DEG + CLEAR_DEG;
        // From 0 on any corner that is not turned over is clear.
        let clear = [if lo > 0.0 { cot(lo + inset) } else { f64::INFINITY }, cot(hi - inset)];
        self.0.push((limits, clear));
        clear
    }
}

/// A problem of least squares, with the memory of the last one used again.
#[derive(Default)]
pub(crate) struct Levenberg {
    /// By vertex of the net: its place in `locals`. Valid only while a problem
    /// is set up, and only for vertices that are in it.
    slots: Vec<u32>,
    locals: Vec<Local>,
    /// Vertices of the net, parallel to `locals`.
    names: Vec<u32>,
    tris: Vec<Triangle>,
    cots: Cots,
    unknowns: usize,
    scale: f64,
    /// The upper half of the normal equations' matrix, row by row.
    matrix: Vec<f64>,
    /// Its Cholesky factor, transposed, row by row.
    factor: Vec<f64>,
    gradient: Vec<f64>,
    step: Vec<f64>,
    sums: Vec<f64>,
    trial: Vec<Local>,
}

impl Levenberg {
    /// Moves `movable` for the sake of `tris`, which are all around them and
    /// maybe others. The net is changed only if that lowers their penalty, with
    /// the limits they have before.
    pub(crate) fn run(
        &mut self,
        net: &mut Net,
        judge: Judge<'_>,
        movable: &[u32],
        tris: &[u32],
        iterations: u32,
    ) {
        self.set_up(net, judge, movable, tris);
        let before = self.penalty(&self.locals);
        if before == 0.0 || self.unknowns == 0 {
            return;
        }
        self.descend(net, iterations);
        let after = self.penalty(&self.locals);
        if after >= before {
            return;
        }
        for (local, &v) in self.locals.iter().zip(&self.names) {
            if local.unknown.is_some() {
                net.move_to(v, local.at, local.kind);
            }
        }
    }

    fn set_up(&mut self, net: &Net, judge: Judge<'_>, movable: &[u32], tris: &[u32]) {
        const ABSENT: u32 = u32::MAX;
        self.slots.resize(net.vertex_count() as usize, ABSENT);
        self.locals.clear();
        self.names.clear();
        self.tris.clear();
        self.unknowns = 0;
        for &v in movable {
            let kind = net.vertex(v).kind;
            let (along, size) = match kind {
                Kind::Free => (None, 2),
                Kind::Along { piece, .. } => {
                    let [a, b] = net.lines[piece as usize];
                    (Some((b - a).normalize_or_zero()), 1)
                }
                _ => continue,
            };
            if self.slots[v as usize] != ABSENT {
                continue;
            }
            self.slots[v as usize] = self.locals.len() as u32;
            self.names.push(v);
            self.locals.push(Local { at: net.at(v), kind, unknown: Some(self.unknowns), along });
            self.unknowns += size;
        }
        let mut length = 0.0;
        for &t in tris {
            let corners = net.tri(t).v.map(|v| {
                if self.slots[v as usize] == ABSENT {
                    self.slots[v as usize] = self.locals.len() as u32;
                    self.names.push(v);
                    self.locals.push(Local {
                        at: net.at(v),
                        kind: net.vertex(v).kind,
                        unknown: None,
                        along: None,
                    });
                }
                self.slots[v as usize]
            });
            let limits = judge.limits(net, t);
            self.tris.push(Triangle { corners, limits, clear: limits.map(|l| self.cots.of(l)) });
            let [a, b, _] = net.corners(t);
            length += a.distance(b);
        }
        self.scale = length / tris.len().max(1) as f64;
        for &v in &self.names {
            self.slots[v as usize] = ABSENT;
        }
    }

    fn penalty(&self, locals: &[Local]) -> f64 {
        let of = |t: &Triangle| {
            t.angles(locals)
                .map_or(0.0, |angles| penalty_of(angles, t.limits, t.corners.map(|v| locals[v as usize].at)))
        };
        self.tris.iter().map(of).sum()
    }

    /// The cost that is minimised, with slack.
    fn cost(&self, locals: &[Local]) -> f64 {
        let of = |t: &Triangle| {
            let square = |(angle, limits)| residual(angle, limits).map_or(0.0, |(r, _)| r * r);
            t.angles(locals).map_or(0.0, |angles| angles.into_iter().zip(t.limits).map(square).sum())
        };
        self.tris.iter().map(of).sum()
    }

    fn descend(&mut self, net: &Net, iterations: u32) {
        let mut lambda: f64 = 1.0;
        let mut cost = self.cost(&self.locals);
        let mut slow = 0;
        for _ in 0..iterations {
            self.assemble();
            let Some(next) = self.attempt(net, cost, &mut lambda) else { return };
            if self.penalty(&self.locals) == 0.0 {
                return;
            }
            slow = if next > WORTHWHILE * cost { slow + 1 } else { 0 };
            cost = next;
            if slow >= PATIENCE {
                return;
            }
        }
    }

    /// Takes a step that lowers the cost, and returns the new one.
    fn attempt(&mut self, net: &Net, cost: f64, lambda: &mut f64) -> Option<f64> {
        for _ in 0..TRIES {
            if self.solve(DAMPING * *lambda) {
                self.trial.clone_from(&self.locals);
                for local in &mut self.trial {
                    advance(local, net, &self.step, self.scale);
                }
                let next = self.cost(&self.trial);
                if next < cost {
                    std::mem::swap(&mut self.locals, &mut self.trial);
                    *lambda = (*lambda * RELAX).max(LEAST_DAMPING);
                    return Some(next);
                }
            }
            *lambda *= TIGHTEN;
        }
        None
    }

    /// The normal equations at the present positions.
    fn assemble(&mut self) {
        let n = self.unknowns;
        self.matrix.clear();
        self.matrix.resize(n * n, 0.0);
        self.gradient.clear();
        self.gradient.resize(n, 0.0);
        let unit = self.scale.to_degrees();
        for t in &self.tris {
            let Some(angles) = t.angles(&self.locals) else { continue };
            let v = t.corners;
            let p = v.map(|v| self.locals[v as usize].at);
            for (i, angle) in angles.into_iter().enumerate() {
                let Some((r, sign)) = residual(angle, t.limits[i]) else { continue };
                let [a, b, c] = [i, (i + 1) % 3, (i + 2) % 3];
                let (u, w) = (p[b] - p[a], p[c] - p[a]);
                let to_c = w.perp() / w.length_squared();
                let to_b = -u.perp() / u.length_squared();
                let row = [(a, -(to_b + to_c)), (b, to_b), (c, to_c)]
                    .map(|(k, g)| (self.locals[v[k] as usize], g * (sign * unit)));
                add_row(&mut self.matrix, &mut self.gradient, n, &row, r);
            }
        }
    }

    /// Solves for the step by Cholesky's method; `false` if rounding got in
    /// the way.
    fn solve(&mut self, damping: f64) -> bool {
        let n = self.unknowns;
        if !self.factorise(damping) {
            return false;
        }
        let l = &self.factor;
        self.step.clear();
        self.step.extend(self.gradient.iter().map(|g| -g));
        self.sums.clear();
        self.sums.resize(n, -0.0);
        for i in 0..n {
            let solved = (self.step[i] - self.sums[i]) / l[i * n + i];
            self.step[i] = solved;
            add_multiple(&mut self.sums[i + 1..], &l[i * n + i + 1..][..n - i - 1], solved);
        }
        for i in (0..n).rev() {
            let dot: f64 = (i + 1..n).map(|k| l[i * n + k] * self.step[k]).sum();
            self.step[i] = (self.step[i] - dot) / l[i * n + i];
        }
        self.step.iter().all(|x| x.is_finite())
    }

    /// The damped matrix's factor. Its rows are summed up side by side, each entry
    /// in the order of a dot product.
    fn factorise(&mut self, damping: f64) -> bool {
        let n = self.unknowns;
        self.factor.clear();
        self.factor.resize(n * n, 0.0);
        for j in 0..n {
            let (done, row) = self.factor.split_at_mut(j * n);
            self.sums.clear();
            self.sums.resize(n - j, -0.0);
            // Vertices that are far apart know nothing of each other.
            for above in done.chunks_exact(n).filter(|above| above[j] != 0.0) {
                add_multiple(&mut self.sums, &above[j..], above[j]);
            }
            let given = &self.matrix[j * n + j..][..n - j];
            let rest = given[0] + damping - self.sums[0];
            if rest.is_nan() || rest <= 0.0 {
                return false;
            }
            let pivot = rest.sqrt();
            row[j] = pivot;
            for ((to, a), sum) in row[j + 1..n].iter_mut().zip(&given[1..]).zip(&self.sums[1..]) {
                *to = (a - sum) / pivot;
            }
        }
        true
    }
}

/// Adds a multiple of a row to another.
fn add_multiple(to: &mut [f64], row: &[f64], factor: f64) {
    for (to, x) in to.iter_mut().zip(row) {
        *to += x * factor;
    }
}

/// What an angle is past its bound by, with slack, and in which direction.
fn residual(angle: f64, [lo, hi]: Limits) -> Option<(f64, f64)> {
    let (below, above) = (lo + SLACK_DEG - angle, angle - hi + SLACK_DEG);
    // A corner between two segments has the angle it has, unless turned over.
    if below > 0.0 && (lo > 0.0 || angle < 0.0) {
        Some((below, -1.0))
    } else if above > 0.0 {
        Some((above, 1.0))
    } else {
        None
    }
}

/// Adds one residual and its derivatives to the normal equations (the upper
/// half of the matrix).
fn add_row(matrix: &mut [f64], gradient: &mut [f64], n: usize, row: &[(Local, DVec2); 3], r: f64) {
    let mut entries = [(0, 0.0); 6];
    let mut count = 0;
    for (local, g) in row {
        let Some(unknown) = local.unknown else { continue };
        if let Some(along) = local.along {
            entries[count] = (unknown, g.dot(along));
            count += 1;
        } else {
            entries[count] = (unknown, g.x);
            entries[count + 1] = (unknown + 1, g.y);
            count += 2;
        }
    }
    for &(i, gi) in &entries[..count] {
        gradient[i] += gi * r;
        for &(j, gj) in &entries[..count] {
            if j >= i {
                matrix[i * n + j] += gi * gj;
            }
        }
    }
}

/// Moves a vertex by its part of the step.
fn advance(local: &mut Local, net: &Net, step: &[f64], scale: f64) {
    let Some(unknown) = local.unknown else { return };
    match local.kind {
        Kind::Along { piece, t } => {
            let [a, b] = net.lines[piece as usize];
            // Never onto the ends: whoever comes too close has bad angles.
            let to = (t + step[unknown] * scale / a.distance(b)).clamp(f64::EPSILON, 1.0 - f64::EPSILON);
            local.kind = Kind::Along { piece, t: to };
            local.at = net.along(piece, to);
        }
        _ => local.at += DVec2::new(step[unknown], step[unknown + 1]) * scale,
    }
}
