//! Brings all angles inside the bounds.

use crate::work::Work;

pub(crate) fn sweep(work: &mut Work, rings: usize, turns: usize) -> usize {
    let bad = work.bad();
    let mut touched = vec![false; work.mesh.pos.len()];
    for t in bad {
        if !work.mesh.tri[t as usize].alive() || work.is_good(t) {
            continue;
        }
        let corners = work.mesh.tri[t as usize].v;
        work.load(&corners);
        let mut before = work.solver.state(work.limits);
        let mut state = before;
        for r in 0..rings {
            if r > 0 {
                work.mesh.rollback();
                work.load(&corners);
                for _ in 0..r {
                    work.grow();
                }
                before = work.solver.state(work.limits);
            }
            state = work.solve(turns, 4);
            work.stats.repairs[0] += 1;
            if state.solved {
                break;
            }
        }
        if state.solved && work.changes_hold() || state.energy < 0.9 * before.energy {
            work.stats.repairs[1] += u64::from(state.solved);
            work.commit();
        } else {
            work.mesh.rollback();
        }
        let _ = &mut touched;
    }
    work.bad().len()
}

pub(crate) fn relax(work: &mut Work, limits: &crate::angles::Limits) -> usize {
    let bad: Vec<u32> = work.mesh.live().filter(|&t| !limits.strict(&work.mesh.measure(t))).collect();
    let mut mark = vec![false; work.mesh.pos.len()];
    for &t in &bad { for v in work.mesh.tri[t as usize].v { mark[v as usize] = true; } }
    let mut mark2 = mark.clone();
    for t in work.mesh.live() { let c = work.mesh.tri[t as usize].v; if c.iter().any(|&v| mark[v as usize]) { for v in c { mark2[v as usize] = true; } } }
    let verts: Vec<u32> = (0..mark2.len() as u32).filter(|&v| mark2[v as usize]).collect();
    for v in verts {
        if work.mesh.is_fixed(v) || !work.mesh.alive(v) { continue; }
        work.solver.load(&work.mesh, &[v]);
        work.solver.run(limits, 1);
        work.solver.store(&mut work.mesh);
        work.mesh.commit();
    }
    for t in bad {
        if !work.mesh.tri[t as usize].alive() || work.is_good(t) { continue; }
        let c = work.mesh.tri[t as usize].v;
        work.load(&c);
        crate::flip::flip_patch(&mut work.mesh, &work.solver);
        work.mesh.commit();
    }
    work.bad().len()
}

pub(crate) fn push_sweep(work: &mut Work, aim: &crate::angles::Limits, from: usize, to: usize, steps: usize) -> usize {
    for t in work.bad() {
        if !work.mesh.tri[t as usize].alive() || work.is_good(t) {
            continue;
        }
        let corners = work.mesh.tri[t as usize].v;
        for r in from..=to {
            work.load(&corners);
            for _ in 1..r { work.grow(); }
            let before = work.solver.state(work.limits).energy;
            work.stats.repairs[0] += 1;
            let last = r == to;
            let state = work.quick(aim, 40, 1.5, 0.7, 2, 0.3, if last { steps } else { 0 });
            if state.solved && work.changes_hold() {
                work.stats.repairs[1] += 1;
                work.commit();
                break;
            }
            if last && state.energy < 0.9 * before {
                work.commit();
                break;
            }
            work.mesh.rollback();
        }
    }
    work.bad().len()
}

/// Statistics per action.
#[derive(Default, Debug)]
pub(crate) struct Tally { pub tried: [u64; 3], pub won: [u64; 3], pub rank: Vec<u64> }

fn which(a: &crate::change::Action) -> usize {
    match a { crate::change::Action::Remove{..} => 0, crate::change::Action::Insert{..} => 1, crate::change::Action::Flip{..} => 2 }
}

pub(crate) fn search(work: &mut Work, tally: &mut Tally, rings: usize, top: usize, turns: usize, factor: f64) -> usize {
    let bad = work.bad();
    for t in bad {
        if !work.mesh.tri[t as usize].alive() || work.is_good(t) {
            continue;
        }
        let corners = work.mesh.tri[t as usize].v;
        work.load(&corners);
        for _ in 1..rings { work.grow(); }
        let before = work.solver.state(work.limits).energy;
        let state = work.solve(turns, 6);
        work.stats.repairs[0] += 1;
        if state.solved && work.changes_hold() { work.stats.repairs[1] += 1; work.commit(); continue; }
        let mut best = state.energy;
        work.mesh.rollback();
        let mut changes = Vec::new();
        crate::change::Finder { mesh: &work.mesh, limits: work.limits, refills: work.refills, out: &mut changes }.find(t);
        let mut verts = Vec::new();
        let mut win = None;
        for (rank, c) in changes.iter().take(top).enumerate() {
            if !crate::change::apply(&mut work.mesh, work.refills, c.action, &mut verts) { work.mesh.rollback(); continue; }
            tally.tried[which(&c.action)] += 1;
            for v in corners { if work.mesh.alive(v) && !verts.contains(&v) { verts.push(v); } }
            work.load(&verts);
            let state = work.solve(turns, 6);
            let mut solved = state.solved;
            let mut e = state.energy;
            if !solved && rings > 1 {
                work.grow();
                let s = work.solve(turns, 6);
                solved = s.solved; e = s.energy;
            }
            if solved && work.changes_hold() {
                tally.won[which(&c.action)] += 1;
                if tally.rank.len() <= rank { tally.rank.resize(rank + 1, 0); }
                tally.rank[rank] += 1;
                work.commit();
                win = Some(0);
                break;
            }
            let _ = &mut best; let _ = e; let _ = before; let _ = factor;
            work.mesh.rollback();
        }
        let _ = win;
    }
    work.bad().len()
}
