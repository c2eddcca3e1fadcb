//! A patch: a set of movable vertices, all triangles at them, and what moves
//! the vertices until the angles hold.
//!
//! Two methods share the patch. `project` pushes one corner after the other
//! inside; it costs next to nothing and settles most patches that can be
//! settled. `newton` solves for all corners at once and finishes what comes
//! close. Neither touches the mesh: [`Patch::store`] writes back.

mod newton;
mod project;
mod skyline;

use hexdel_geom::DVec2;

use crate::angles::{Measure, Place};
use crate::constraints::Rules;
use crate::mesh::{Mesh, Motion, NONE};

pub(crate) use newton::Newton;
pub(crate) use project::{Push, Sweeps, Swept, WINDOW};

/// The share of the shortest edge at a vertex that is left where it all but meets another.
const NEARER: f64 = 1e-3;

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
    /// Sum of squared distances outside the target, square radians.
    pub(crate) energy: f64,
    /// Every triangle is strictly inside the bounds.
    pub(crate) solved: bool,
}

impl State {
    /// That of a patch that is not worth more work.
    pub(crate) const HOPELESS: Self = Self { energy: f64::INFINITY, solved: false };
}

/// A patch under work; storage is reused from patch to patch.
#[derive(Debug, Default)]
pub(crate) struct Patch {
    /// Local index of a mesh vertex, `NONE` for those not in the patch.
    slot: Vec<u32>,
    /// Mesh triangles of this patch carry the current epoch.
    seen: Vec<u32>,
    epoch: u32,
    /// Mesh vertices: the movable ones first, then the rim of the patch.
    verts: Vec<u32>,
    /// How many of `verts` are movable.
    movable: usize,
    /// Whether a movable vertex slides.
    slides: bool,
    /// Mesh triangles of the patch, in the order of `tris`.
    ids: Vec<u32>,
    /// Local corners of the triangles.
    tris: Vec<[u32; 3]>,
    /// Where each triangle lies; as long as `tris`.
    places: Vec<Place>,
    /// Whether each vertex is near a segment; empty if there are none.
    near: Vec<bool>,
    /// Positions, as long as `verts`.
    pos: Vec<DVec2>,
    /// Direction of a sliding vertex, zero for the others; as long as `verts`.
    along: Vec<DVec2>,
    /// Shortest edge of each vertex inside the patch, positive.
    unit: Vec<f64>,
    /// Square of `unit` for movable vertices, zero for the others.
    weight: Vec<f64>,
    /// Corners outside the target at `pos`, once evaluated.
    active: Vec<Active>,
    newton: Newton,
    /// Triangles that projection sweeps went over.
    visits: u64,
}

impl Patch {
    /// Takes a copy of the patch around `movable`, of which the fixed ones are
    /// left out.
    pub(crate) fn load(&mut self, mesh: &Mesh, movable: &[u32]) {
        self.clear();
        self.slot.resize(self.slot.len().max(mesh.pos.len()), NONE);
        self.seen.resize(self.seen.len().max(mesh.tri.len()), 0);
        for &v in movable {
            match mesh.motion[v as usize] {
                Motion::Fixed | Motion::Frozen => {}
                Motion::Free => self.enter(mesh, v, DVec2::ZERO),
                Motion::Along(d) => {
                    self.slides = true;
                    self.enter(mesh, v, d);
                }
                Motion::On(_) => {
                    self.slides = true;
                    self.enter(mesh, v, mesh.line(v).map_or(DVec2::ZERO, |l| l.along));
                }
            }
        }
        self.movable = self.verts.len();
        for i in 0..self.movable {
            let (ids, seen, epoch) = (&mut self.ids, &mut self.seen, self.epoch);
            mesh.around(self.verts[i], |t, _| {
                if seen[t as usize] != epoch {
                    seen[t as usize] = epoch;
                    ids.push(t);
                }
            });
        }
        for i in 0..self.ids.len() {
            let corners = mesh.tri[self.ids[i] as usize].v;
            for v in corners {
                self.enter(mesh, v, DVec2::ZERO);
            }
            self.tris.push(corners.map(|v| self.slot[v as usize]));
        }
        self.places.resize(self.tris.len(), Place::default());
        if mesh.is_constrained() {
            self.find_places(mesh);
        }
        self.measure_units();
        self.newton.restart();
    }

    fn clear(&mut self) {
        for &v in &self.verts {
            self.slot[v as usize] = NONE;
        }
        self.verts.clear();
        self.ids.clear();
        self.tris.clear();
        self.places.clear();
        self.pos.clear();
        self.along.clear();
        self.slides = false;
        self.epoch += 1;
    }

    #[inline]
    fn enter(&mut self, mesh: &Mesh, v: u32, along: DVec2) {
        if self.slot[v as usize] == NONE {
            self.slot[v as usize] = self.verts.len() as u32;
            self.verts.push(v);
            self.pos.push(mesh.pos[v as usize]);
            self.along.push(along);
        }
    }

    fn find_places(&mut self, mesh: &Mesh) {
        self.near.clear();
        self.near.extend(self.verts.iter().map(|&v| mesh.is_near(v)));
        for ((place, t), id) in self.places.iter_mut().zip(&self.tris).zip(&self.ids) {
            let near = t.iter().any(|&v| self.near[v as usize]);
            let tri = mesh.tri[*id as usize];
            *place = if mesh.in_wedge(tri.v) { Place::in_wedge() } else { Place::new(near, tri.bound) };
        }
    }

    fn measure_units(&mut self) {
        self.weight.clear();
        self.weight.resize(self.verts.len(), f64::INFINITY);
        for t in &self.tris {
            for k in 0..3 {
                let (i, j) = (t[k] as usize, t[(k + 1) % 3] as usize);
                let d = (self.pos[i] - self.pos[j]).length_squared();
                self.weight[i] = self.weight[i].min(d);
                self.weight[j] = self.weight[j].min(d);
            }
        }
        self.unit.clear();
        for (i, w) in self.weight.iter_mut().enumerate() {
            // Coincident vertices still need a positive unit to part.
            let square = w.max(f64::MIN_POSITIVE);
            self.unit.push(if i < self.movable { square.sqrt() } else { 0.0 });
            *w = if i < self.movable { square } else { 0.0 };
        }
    }

    /// The patch as it stands, and which of its corners are outside.
    pub(crate) fn state(&mut self, rules: &Rules<'_>) -> State {
        evaluate(rules, &self.tris, &self.places, &self.pos, &mut self.active)
    }

    /// Writes the positions back; those on segments are rounded to them.
    pub(crate) fn store(&self, mesh: &mut Mesh) {
        for (&v, &p) in self.verts[..self.movable].iter().zip(&self.pos) {
            let p = match mesh.line(v) {
                Some(line) if mesh.pos[v as usize] != p => line.nearest(p),
                _ => p,
            };
            if mesh.pos[v as usize] != p {
                mesh.set_pos(v, p);
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

    /// The triangles of the patch.
    pub(crate) fn triangles(&self) -> &[u32] {
        &self.ids
    }

    /// Whether a vertex has come so near to another that no motion parts them again.
    pub(crate) fn collapses(&self) -> bool {
        let is_near = |i: u32, j: u32| {
            let unit = self.unit[i as usize].max(self.unit[j as usize]);
            (self.pos[i as usize] - self.pos[j as usize]).length() < NEARER * unit
        };
        self.tris.iter().any(|&[a, b, c]| is_near(a, b) || is_near(b, c) || is_near(c, a))
    }

    /// Whether triangle `t` of the mesh belongs to the patch.
    pub(crate) fn holds(&self, t: u32) -> bool {
        self.seen.get(t as usize) == Some(&self.epoch)
    }

    /// Triangles that projection sweeps went over since the patch was made.
    pub(crate) fn visits(&self) -> u64 {
        self.visits
    }

    /// Newton steps since the patch was made.
    pub(crate) fn steps(&self) -> u64 {
        self.newton.steps()
    }
}

/// Energy and active corners at `pos`.
fn evaluate(
    rules: &Rules<'_>,
    tris: &[[u32; 3]],
    places: &[Place],
    pos: &[DVec2],
    active: &mut Vec<Active>,
) -> State {
    active.clear();
    let mut energy = 0.0;
    let mut solved = true;
    for (t, place) in tris.iter().zip(places) {
        let [a, b, c] = t.map(|v| pos[v as usize]);
        let limits = rules.limits(*place);
        let m = Measure::of(a, b, c);
        if limits.on_target(&m) {
            continue;
        }
        let m = place.view(m, limits);
        solved &= limits.strict(&m);
        if !m.cross.is_finite() {
            energy = f64::INFINITY;
        }
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

/// Gradients of the angle at `a` by the positions of `a`, `b` and `c`.
#[inline]
fn angle_gradient(a: DVec2, b: DVec2, c: DVec2) -> [DVec2; 3] {
    let (u, w) = (b - a, c - a);
    let at_b = -u.perp() / u.length_squared();
    let at_c = w.perp() / w.length_squared();
    [-(at_b + at_c), at_b, at_c]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradient_agrees_with_differences() {
        let p = [DVec2::new(0.1, 0.2), DVec2::new(1.3, -0.1), DVec2::new(0.4, 1.1)];
        let angle = |p: [DVec2; 3]| {
            let (u, w) = (p[1] - p[0], p[2] - p[0]);
            u.perp_dot(w).atan2(u.dot(w))
        };
        let gradient = angle_gradient(p[0], p[1], p[2]);
        let h = 1e-6;
        for i in 0..3 {
            for (d, want) in [(DVec2::X, gradient[i].x), (DVec2::Y, gradient[i].y)] {
                let (mut plus, mut minus) = (p, p);
                plus[i] += h * d;
                minus[i] -= h * d;
                let got = (angle(plus) - angle(minus)) / (2.0 * h);
                assert!((got - want).abs() < 1e-8, "vertex {i}: {got} {want}");
            }
        }
    }
}
