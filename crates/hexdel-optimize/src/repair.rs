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
