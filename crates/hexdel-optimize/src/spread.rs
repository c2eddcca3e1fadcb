//! Motion that spreads: projection sweeps over the stars of a few vertices, which take in
//! another vertex, with its triangles, when a push is about to move it.
//!
//! A removal that succeeds moves a dozen vertices in most cases, and one that fails is
//! given up after a few sweeps: a [`Patch`](crate::patch::Patch) of all vertices within
//! reach would mostly copy triangles that nothing happens to. Vertices are moved in the
//! mesh itself, under its journal.

use hexdel_geom::DVec2;

use crate::angles::{Measure, Place};
use crate::constraints::Rules;
use crate::mesh::{Mesh, Motion};
use crate::patch::{Push, Swept, WINDOW};

/// How far and how long to sweep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// Rings around the seeds that may move, theirs the first.
    pub(crate) rings: u8,
    /// Most sweeps.
    pub(crate) most: usize,
    /// Stop when the energy is not below this share of what it was [`WINDOW`] sweeps
    /// before.
    pub(crate) stall: f64,
    /// Give up when a sweep finds more energy than this: the second or third, the next
    /// four, the next four, a later one.
    pub(crate) hope: [f64; 4],
}

impl Reach {
    /// Rings that may move in a sweep: nineteen of twenty attempts with four or five are
    /// given up after the second, and need not have taken them all in.
    fn open(&self, sweep: usize) -> u8 {
        self.rings.min(sweep.max(2) as u8)
    }

    fn hope(&self, sweep: usize) -> f64 {
        self.hope[(sweep / WINDOW).min(3)]
    }
}

/// What the present motion knows of a vertex.
#[derive(Clone, Copy, Debug, Default)]
struct Mark {
    /// That of the motion that knows it.
    epoch: u32,
    /// The ring of a vertex that may move and has not, or zero.
    ring: u8,
    /// Whether it is near a segment.
    near: bool,
    /// The square of its shortest edge once it moves, or zero.
    weight: f64,
}

/// Vertices in motion; storage is reused.
#[derive(Debug, Default)]
pub(crate) struct Spread {
    epoch: u32,
    /// By vertex of the mesh.
    marks: Vec<Mark>,
    /// By triangle of the mesh: the epoch in which it was taken in.
    seen: Vec<u32>,
    /// All triangles at vertices that move.
    tris: Vec<u32>,
    /// Where they lie; empty in a mesh without segments.
    places: Vec<Place>,
    /// The vertices that move.
    moved: Vec<u32>,
    rings: u8,
    /// Those whose vertices may move in the present sweep.
    open: u8,
    slides: bool,
    /// Triangles swept over since the beginning.
    visits: u64,
}

impl Spread {
    /// Sweeps over the stars of `seeds`, and of the vertices that pushes move, until a
    /// sweep finds nothing outside the target. Leaves the motion in the journal.
    ///
    /// # Complexity
    ///
    /// A sweep is linear in the triangles at vertices that move.
    pub(crate) fn run(&mut self, mesh: &mut Mesh, rules: &Rules<'_>, seeds: &[u32], reach: Reach) -> Swept {
        self.begin(mesh, seeds, reach.rings);
        let mut before = f64::INFINITY;
        for sweep in 1..=reach.most {
            self.open = reach.open(sweep);
            let energy = self.sweep(mesh, rules);
            if energy == 0.0 {
                self.round_to_segments(mesh);
                return Swept::Settled;
            }
            if sweep > 1 && energy > reach.hope(sweep) || energy == f64::INFINITY {
                return Swept::Hopeless;
            }
            if sweep % WINDOW == 0 {
                if energy > reach.stall * before {
                    break;
                }
                before = energy;
            }
        }
        self.round_to_segments(mesh);
        Swept::Stalled
    }

    /// The triangles at vertices that moved.
    pub(crate) fn triangles(&self) -> &[u32] {
        &self.tris
    }

    /// The vertices that moved, or were to.
    pub(crate) fn moved(&self) -> &[u32] {
        &self.moved
    }

    /// Triangles swept over since the beginning.
    pub(crate) fn visits(&self) -> u64 {
        self.visits
    }

    fn begin(&mut self, mesh: &mut Mesh, seeds: &[u32], rings: u8) {
        self.epoch += 1;
        self.marks.resize(self.marks.len().max(mesh.pos.len()), Mark::default());
        self.seen.resize(self.seen.len().max(mesh.tri.len()), 0);
        self.tris.clear();
        self.places.clear();
        self.moved.clear();
        self.rings = rings;
        self.slides = false;
        for &v in seeds {
            self.approach(mesh, v, 1);
        }
        for &v in seeds {
            self.join(mesh, v);
        }
    }

    /// Learns of a vertex so many rings away.
    #[inline]
    fn approach(&mut self, mesh: &Mesh, v: u32, ring: u8) {
        let mark = &mut self.marks[v as usize];
        if mark.epoch != self.epoch {
            let moves = ring <= self.rings && !mesh.is_fixed(v);
            let near = mesh.is_constrained() && mesh.is_near(v);
            *mark = Mark { epoch: self.epoch, ring: if moves { ring } else { 0 }, near, weight: 0.0 };
        }
    }

    /// Sets a vertex free if it may move and has not, with all its triangles.
    fn join(&mut self, mesh: &mut Mesh, v: u32) {
        let ring = std::mem::take(&mut self.marks[v as usize].ring);
        if ring == 0 {
            return;
        }
        let p = mesh.pos[v as usize];
        let first = self.tris.len();
        let mut weight = f64::INFINITY;
        mesh.around(v, |t, k| {
            let corners = mesh.tri[t as usize].v;
            for w in [corners[(k + 1) % 3], corners[(k + 2) % 3]] {
                weight = weight.min((mesh.pos[w as usize] - p).length_squared());
            }
            if self.seen[t as usize] != self.epoch {
                self.seen[t as usize] = self.epoch;
                self.tris.push(t);
            }
        });
        for i in first..self.tris.len() {
            self.enter(mesh, self.tris[i], ring + 1);
        }
        // Coincident vertices still need a positive weight to part.
        self.marks[v as usize].weight = weight.max(f64::MIN_POSITIVE);
        self.slides |= mesh.motion[v as usize] != Motion::Free;
        self.moved.push(v);
        mesh.set_pos(v, p);
    }

    /// Learns of a triangle's corners, and where it lies.
    fn enter(&mut self, mesh: &Mesh, t: u32, ring: u8) {
        let tri = mesh.tri[t as usize];
        for w in tri.v {
            self.approach(mesh, w, ring);
        }
        if mesh.is_constrained() {
            let near = tri.v.iter().any(|&w| self.marks[w as usize].near);
            let place = if mesh.in_wedge(tri.v) { Place::in_wedge() } else { Place::new(near, tri.bound) };
            self.places.push(place);
        }
    }

    /// One sweep, over what joins on the way as well; returns the sum of squared motions
    /// in units of the shortest edges, infinity where none could help.
    fn sweep(&mut self, mesh: &mut Mesh, rules: &Rules<'_>) -> f64 {
        let mut energy = 0.0;
        let mut i = 0;
        while i < self.tris.len() {
            let corners = mesh.tri[self.tris[i] as usize].v;
            let [a, b, c] = corners.map(|v| mesh.pos[v as usize]);
            let place = self.places.get(i).copied().unwrap_or_default();
            let limits = rules.limits(place);
            let measure = Measure::of(a, b, c);
            if !limits.on_target(&measure) {
                let pushes = Push::inside(place.view(measure, limits), limits);
                energy += match pushes {
                    None => f64::INFINITY,
                    Some(pushes) => {
                        for v in corners {
                            if (1..=self.open).contains(&self.marks[v as usize].ring) {
                                self.join(mesh, v);
                            }
                        }
                        pushes.into_iter().flatten().map(|push| self.apply(mesh, corners, push)).sum()
                    }
                };
                if energy == f64::INFINITY {
                    break;
                }
            }
            i += 1;
        }
        self.visits += i as u64;
        energy
    }

    #[inline]
    fn apply(&self, mesh: &mut Mesh, corners: [u32; 3], push: Push) -> f64 {
        let v = push.order(corners);
        let pos = v.map(|v| mesh.pos[v as usize]);
        let weight = v.map(|v| self.marks[v as usize].weight);
        let along = self.slides.then(|| v.map(|v| direction(mesh, v)));
        let Some((by, energy)) = push.motion(pos, weight, along) else { return f64::INFINITY };
        for i in 0..3 {
            mesh.pos[v[i] as usize] += by[i];
        }
        energy
    }

    /// Puts the vertices on segments that moved onto the doubles nearest to points of them.
    fn round_to_segments(&self, mesh: &mut Mesh) {
        if self.slides {
            for &v in &self.moved {
                if let Some(line) = mesh.line(v) {
                    mesh.pos[v as usize] = line.nearest(mesh.pos[v as usize]);
                }
            }
        }
    }
}

/// The direction in which a vertex slides, or zero.
fn direction(mesh: &Mesh, v: u32) -> DVec2 {
    match mesh.motion[v as usize] {
        Motion::Along(d) => d,
        Motion::On(_) => mesh.line(v).map_or(DVec2::ZERO, |line| line.along),
        _ => DVec2::ZERO,
    }
}
