//! A new fixed vertex: where it is put among its neighbours, and how they make
//! room for it.
//!
//! A *seat* is a free vertex that moves to the point, or a disc of triangles
//! that is filled anew around it. Seats are ranked by what they do to degrees
//! and shapes; the first one whose neighbourhood settles is taken. Where none
//! does, the best few are handed to the search that repairs whole meshes.

use std::sync::Arc;

use hexdel_geom::{DVec2, orient2d};

use crate::angles::{Measure, Place};
use crate::change::outline;
use crate::constraints::Rules;
use crate::decimate::{PATIENT, Pass, settle};
use crate::live::cut::Cut;
use crate::mesh::{Mesh, Motion, NONE};
use crate::refill::{Refills, degree_cost};
use crate::repair::{repair, step};
use crate::sizing::Sizing;
use crate::work::Work;

/// What all work on parts shares.
#[derive(Clone, Debug)]
pub(crate) struct Tools {
    pub(crate) rules: Rules<'static>,
    pub(crate) refills: Refills,
    /// How long edges may be.
    pub(crate) sizing: Option<Arc<dyn Sizing>>,
    /// Triangles that sweeps may go over in the repair of one part.
    pub(crate) allowance: u64,
}

impl Tools {
    /// Work on a part that keeps edges as short as wanted.
    pub(crate) fn work(&self, mesh: Mesh, failed: Vec<u8>) -> Work<'_> {
        let mut work = self.free_work(mesh, failed);
        work.sizing = self.sizing.as_deref();
        work
    }

    /// Work on a part in which edges may be of any length.
    pub(crate) fn free_work(&self, mesh: Mesh, mut failed: Vec<u8>) -> Work<'_> {
        failed.resize(mesh.pos.len(), 0);
        let mut work = Work::new(mesh, &self.rules, &self.refills, failed, 0);
        work.allowance = self.allowance;
        work
    }
}

/// Where a new vertex may go.
#[derive(Clone, Debug, PartialEq)]
enum Seat {
    /// This vertex moves to the point.
    Vertex(u32),
    /// The outline of these triangles is joined to the point.
    Disc(Vec<u32>),
    /// A side of the rim or on a segment, opposite this corner of the triangle, is
    /// split.
    Side(u32, usize),
}

/// Triangles in a disc, at most: their outline has two corners more, and a
/// vertex no more triangles than eight.
const MOST_IN_DISC: usize = 6;

/// Seats that are tried.
const SEATS: usize = 24;

/// Seats that are searched from.
const FINALISTS: usize = 4;

/// Rounds of repair of a part: what they do not reach, a larger or finer part
/// does sooner.
const ROUNDS: usize = 13;

/// Triangles that sweeps may go over in the repair of one part: some 20 ms. Of the
/// parts that take longer few are ever settled.
pub(crate) const ALLOWANCE: u64 = 1_000_000;

/// The same for a draft.
pub(crate) const DRAFT_ALLOWANCE: u64 = 200_000;

/// Weight of the squared angles outside, as in `refill`.
const SHAPE_WEIGHT: f64 = 0.1;

/// How hard the neighbourhood of a new vertex is tried to be settled.
const SETTLE: Pass = Pass { rings: 4, refills: 1, max_cost: 0.0, near: 0.1, patience: PATIENT };

/// Where a point lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    /// A triangle that holds it.
    pub(crate) triangle: u32,
    /// The triangle's corner opposite the side it lies on, if that is on a
    /// segment.
    pub(crate) side: Option<usize>,
}

/// Puts a vertex at `p`, which lies where `spot` says by the part's names, and
/// gives its name in the part; none where no seat works out.
pub(crate) fn insert<'a>(
    cut: &Cut,
    tools: &'a Tools,
    spot: Spot,
    p: DVec2,
    search: bool,
) -> Option<(Work<'a>, u32)> {
    let mut work = start(cut, tools);
    let mut ranked = seats(&work, spot, p);
    ranked.truncate(SEATS);
    let mut tried: Vec<(f64, Seat)> = Vec::new();
    for (_, seat) in ranked {
        let mut verts = Vec::new();
        let Some(vertex) = take(&mut work, &seat, p, &mut verts) else {
            work.mesh.rollback();
            continue;
        };
        // Where nothing may move, a patch is settled as it stands.
        if settle(&mut work, &verts, SETTLE) && work.bad().is_empty() {
            work.commit();
            return Some((work, vertex));
        }
        tried.push((work.patch.state(work.rules).energy, seat));
        work.mesh.rollback();
    }
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    tried.truncate(if search { FINALISTS } else { 0 });
    tried.iter().find_map(|(_, seat)| search_from(cut, tools, seat, p))
}

fn start<'a>(cut: &Cut, tools: &'a Tools) -> Work<'a> {
    tools.work(cut.mesh.clone(), cut.failed.clone())
}

/// Repairs the part with the vertex in the seat.
fn search_from<'a>(cut: &Cut, tools: &'a Tools, seat: &Seat, p: DVec2) -> Option<(Work<'a>, u32)> {
    let mut work = start(cut, tools);
    let vertex = take(&mut work, seat, p, &mut Vec::new())?;
    work.commit();
    repair_rounds(&mut work).then_some((work, vertex))
}

/// Repairs a part; whether that succeeded.
pub(crate) fn repair_rounds(work: &mut Work) -> bool {
    (0..ROUNDS).any(|round| {
        repair(work, step(round));
        work.bad().is_empty()
    })
}

/// Puts the vertex into its seat; the vertices that should make room are put
/// into `verts`. None where the topology forbids it.
fn take(work: &mut Work, seat: &Seat, p: DVec2, verts: &mut Vec<u32>) -> Option<u32> {
    let mut made = Vec::new();
    match seat {
        Seat::Vertex(v) => {
            work.mesh.ring(*v, &mut Vec::new(), verts);
            work.mesh.fix(*v, p);
            Some(*v)
        }
        Seat::Disc(disc) => {
            *verts = outline(&work.mesh, disc)?;
            let v = work.mesh.add_vertex(p, Motion::Free, std::f64::consts::TAU);
            work.mesh.fix(v, p);
            let n = verts.len();
            let new: Vec<[u32; 3]> = (0..n).map(|i| [v, verts[i], verts[(i + 1) % n]]).collect();
            work.mesh.replace(disc, &new, &mut made);
            Some(v)
        }
        Seat::Side(t, k) => {
            let v = work.mesh.split_edge(*t, *k, &mut made)?;
            work.mesh.fix(v, p);
            work.mesh.ring(v, &mut Vec::new(), verts);
            Some(v)
        }
    }
}

/// The seats at a spot, best first.
fn seats(work: &Work, spot: Spot, p: DVec2) -> Vec<(f64, Seat)> {
    let mesh = &work.mesh;
    let t = spot.triangle;
    let corners = mesh.tri[t as usize].v;
    let at = corners.map(|v| mesh.pos[v as usize]);
    let on_rim = || {
        (0..3).find(|&k| {
            mesh.tri[t as usize].n[k] == NONE && orient2d(at[(k + 1) % 3], at[(k + 2) % 3], p) == 0.0
        })
    };
    let mut seats = Vec::new();
    if let Some(k) = spot.side.or_else(on_rim) {
        seats.push((0.0, Seat::Side(t, k)));
        for v in [corners[(k + 1) % 3], corners[(k + 2) % 3]] {
            if matches!(mesh.motion[v as usize], Motion::Along(_) | Motion::On(_)) {
                seats.push((vertex_cost(work, v, p), Seat::Vertex(v)));
            }
        }
    } else {
        let mut near: Vec<u32> = Vec::new();
        for v in corners {
            let mut ring = Vec::new();
            if work.mesh.motion[v as usize] != Motion::Frozen {
                mesh.ring(v, &mut Vec::new(), &mut ring);
            }
            near.extend(ring);
        }
        near.sort_unstable();
        near.dedup();
        near.retain(|&v| mesh.motion[v as usize] == Motion::Free);
        seats.extend(near.into_iter().map(|v| (vertex_cost(work, v, p), Seat::Vertex(v))));
        for disc in discs(mesh, t) {
            if let Some(cost) = disc_cost(work, &disc, p) {
                seats.push((cost, Seat::Disc(disc)));
            }
        }
    }
    // Stable: equal costs keep the order in which they were found.
    seats.sort_by(|a, b| a.0.total_cmp(&b.0));
    seats
}

/// Discs of up to so many triangles that hold `t`.
fn discs(mesh: &Mesh, t: u32) -> Vec<Vec<u32>> {
    let mut all: Vec<Vec<u32>> = vec![vec![t]];
    let mut first = 0;
    for size in 2..=MOST_IN_DISC {
        let last = all.len();
        for i in first..last {
            let mut beyond: Vec<u32> = all[i].iter().flat_map(|&u| mesh.tri[u as usize].n).collect();
            beyond.sort_unstable();
            beyond.dedup();
            for n in beyond {
                if n != NONE && !all[i].contains(&n) {
                    let mut disc = all[i].clone();
                    disc.push(n);
                    disc.sort_unstable();
                    debug_assert_eq!(disc.len(), size);
                    all.push(disc);
                }
            }
        }
        let mut grown = all.split_off(last);
        grown.sort_unstable();
        grown.dedup();
        all.extend(grown);
        first = last;
    }
    all
}

fn vertex_cost(work: &Work, v: u32, p: DVec2) -> f64 {
    let (mesh, limits) = (&work.mesh, work.rules.limits(Place::default()));
    let (mut shape, mut old) = (0.0, 0.0);
    mesh.around(v, |t, k| {
        let c = mesh.tri[t as usize].v;
        let [a, b] = [c[(k + 1) % 3], c[(k + 2) % 3]].map(|w| mesh.pos[w as usize]);
        shape += limits.energy(&Measure::of(p, a, b));
        old += limits.energy(&mesh.measure(t));
    });
    SHAPE_WEIGHT * (shape - old)
}

fn disc_cost(work: &Work, disc: &[u32], p: DVec2) -> Option<f64> {
    let (mesh, limits) = (&work.mesh, work.rules.limits(Place::default()));
    let outline = outline(mesh, disc)?;
    let mut cost = degree_cost(limits, std::f64::consts::TAU, outline.len());
    let mut shape = 0.0;
    for (i, &v) in outline.iter().enumerate() {
        let inside = disc.iter().filter(|&&t| mesh.tri[t as usize].v.contains(&v)).count();
        let (sector, degree) = (mesh.sector[v as usize], mesh.degree(v));
        cost += degree_cost(limits, sector, degree + 2 - inside) - degree_cost(limits, sector, degree);
        let next = outline[(i + 1) % outline.len()];
        shape += limits.energy(&Measure::of(p, mesh.pos[v as usize], mesh.pos[next as usize]));
    }
    let old: f64 = disc.iter().map(|&t| limits.energy(&mesh.measure(t))).sum();
    cost += SHAPE_WEIGHT * (shape - old);
    (cost < 100.0).then_some(cost)
}
