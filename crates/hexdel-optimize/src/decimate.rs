//! Removal of vertices, one at a time, each kept only where every angle holds.

use crate::mesh::Motion;
use crate::refill::MAX_CORNERS;
use crate::work::Work;

/// How hard one pass tries.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pass {
    /// Rings around the hole that may move in the end.
    pub(crate) rings: u8,
    /// Refills tried for each vertex.
    pub(crate) refills: usize,
    /// Refills that cost more are not tried.
    pub(crate) max_cost: f64,
    pub(crate) steps: usize,
    pub(crate) turns: usize,
    pub(crate) give_up: f64,
    pub(crate) aim: crate::angles::Limits,
    pub(crate) sweeps: usize,
    pub(crate) over: f64,
    pub(crate) stop: f64,
    pub(crate) near: f64,
    pub(crate) pbd: bool,
    pub(crate) by_cost: bool,
    pub(crate) skip: bool,
    pub(crate) wide: usize,
    pub(crate) wide_cost: f64,
    pub(crate) key: u8,
}

/// Tries every vertex once.
pub(crate) fn decimate(work: &mut Work, pass: Pass) -> usize {
    let mut order: Vec<(f64, u32)> = Vec::new();
    for v in 0..work.mesh.pos.len() as u32 {
        if work.mesh.alive(v) && !work.mesh.is_fixed(v) && work.failed[v as usize] < pass.rings {
            let key = if pass.by_cost { cost(work, v) } else {
                match pass.key {
                    0 => work.mesh.shortest_edge(v),
                    1 => { let mut m = 0.0f64; let p = work.mesh.pos[v as usize]; work.mesh.around(v, |t, k| { let c = work.mesh.tri[t as usize].v; m = m.max((work.mesh.pos[c[(k+1)%3] as usize] - p).length()); }); m }
                    2 => { let mut m = 0.0f64; work.mesh.around(v, |t, _| m += work.mesh.measure(t).cross); m }
                    _ => { let mut m = 0.0f64; work.mesh.around(v, |t, _| m += work.mesh.measure(t).cross); m / (work.mesh.degree(v) as f64).powi(2) }
                }
            };
            if !pass.by_cost || key <= pass.max_cost { order.push((key, v)); }
        }
    }
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut removed = 0;
    for (_, v) in order {
        if work.mesh.alive(v) && work.failed[v as usize] < pass.rings {
            let c0 = work.stats.removals[0];
            if remove(work, v, pass) {
                removed += 1;
            } else if work.stats.removals[0] > c0 {
                work.failed[v as usize] = pass.rings;
            }
        }
    }
    removed
}

/// Removes `v` if a refill of its hole can be brought inside the bounds.
pub(crate) fn remove(work: &mut Work, v: u32, pass: Pass) -> bool {
    let mut s = std::mem::take(&mut work.scratch);
    let closed = work.mesh.ring(v, &mut s.tris, &mut s.ring);
    let corners = s.ring.len();
    let sliding = matches!(work.mesh.motion[v as usize], Motion::Along(_));
    let mut done = false;
    if corners <= MAX_CORNERS && corners >= 3 && closed != sliding {
        work.refills.choose(&work.mesh, work.limits, &s.ring, closed, pass.refills, &mut s.chosen);
        for &(cost, index) in &s.chosen {
            if cost > pass.max_cost || !work.refills.triangles(&work.mesh, &s.ring, closed, index, &mut s.new) {
                continue;
            }
            s.made.clear();
            work.mesh.replace(&s.tris, &s.new, &mut s.made);
            work.stats.removals[0] += 1;
            let bin = ((cost * 20.0) as usize).min(39) ;
            work.hist[bin][0] += 1;
            if settle(work, &s.ring, pass) {
                work.hist[bin][1] += 1;
                work.stats.removals[1] += 1;
                work.commit();
                done = true;
                break;
            }
            work.mesh.rollback();
        }
    }
    if !done && pass.wide > 0 && closed && corners <= MAX_CORNERS && corners >= 3 && !sliding {
        let mut list = Vec::new();
        work.refills.choose_wide(&work.mesh, work.limits, &s.tris, v, &s.ring, pass.wide_cost, &mut list);
        let base = s.chosen.first().map_or(f64::INFINITY, |c| c.0);
        let ring = s.ring.clone();
        let tris = s.tris.clone();
        for &(cost, side, index) in list.iter().take(pass.wide) {
            if cost > base { break; }
            let n = ring.len();
            let tri = work.mesh.tri[tris[side] as usize];
            let beyond = tri.n[tri.corner(v)];
            let (a, b) = (ring[side], ring[(side + 1) % n]);
            let Some(x) = work.mesh.tri[beyond as usize].v.into_iter().find(|w| *w != a && *w != b) else { continue };
            let mut r = ring.clone();
            r.insert(side + 1, x);
            if !work.refills.triangles(&work.mesh, &r, true, index, &mut s.new) { continue; }
            let mut old = tris.clone();
            old.push(beyond);
            s.made.clear();
            work.mesh.replace(&old, &s.new, &mut s.made);
            work.stats.removals[0] += 1;
            let bin = ((cost * 20.0) as usize).min(39) ;
            work.hist[bin][0] += 1;
            if settle(work, &r, pass) {
                work.hist[bin][1] += 1;
                work.stats.removals[1] += 1;
                work.commit();
                done = true;
                break;
            }
            work.mesh.rollback();
        }
    }
    work.scratch = s;
    done
}

/// Moves ever more rings around `verts` until everything holds.
pub(crate) fn settle(work: &mut Work, verts: &[u32], pass: Pass) -> bool {
    work.load(verts);
    if pass.skip {
        work.grow();
    }
    for ring in (if pass.skip { 2 } else { 1 })..=pass.rings {
        if ring > 1 + u8::from(pass.skip) {
            work.grow();
        }
        let state = if pass.pbd { work.quick(&pass.aim, pass.sweeps, pass.over, pass.stop, pass.turns, pass.near, pass.steps) } else { work.solve(pass.turns, pass.steps) };
        if state.solved {
            return work.changes_hold();
        }
        if state.energy > pass.give_up {
            return false;
        }
    }
    false
}

/// Cost of the cheapest refill.
fn cost(work: &mut Work, v: u32) -> f64 {
    let mut s = std::mem::take(&mut work.scratch);
    let closed = work.mesh.ring(v, &mut s.tris, &mut s.ring);
    let corners = s.ring.len();
    let sliding = matches!(work.mesh.motion[v as usize], Motion::Along(_));
    let mut c = f64::INFINITY;
    if corners <= MAX_CORNERS && corners >= 3 && closed != sliding {
        work.refills.choose(&work.mesh, work.limits, &s.ring, closed, 1, &mut s.chosen);
        if let Some(x) = s.chosen.first() { c = x.0; }
    }
    work.scratch = s;
    c
}

/// Moves every vertex away from the bounds where that keeps them.
pub(crate) fn spread(work: &mut Work, aim: &crate::angles::Limits, rounds: usize) -> usize {
    let mut moved = 0;
    for _ in 0..rounds {
        for v in 0..work.mesh.pos.len() as u32 {
            if !work.mesh.alive(v) || work.mesh.is_fixed(v) { continue; }
            work.load(&[v]);
            let before = work.solver.state(aim).energy;
            if before == 0.0 { continue; }
            work.solver.project(aim, 2, 1.0, 2.0); let state = work.solver.state(aim);
            if state.energy < before && work.solver.state(work.limits).solved {
                work.solver.store(&mut work.mesh);
                work.mesh.commit();
                work.failed[v as usize] = 0;
                moved += 1;
            }
        }
    }
    moved
}
