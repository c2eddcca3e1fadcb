//! Random neutral changes that make removals possible.
use crate::decimate::{Pass, remove, settle};
use crate::work::Work;

pub(crate) fn shake(work: &mut Work, pass: Pass, tries: usize, mode: usize, after: usize) -> [usize; 4] {
    let mut count = [0; 4];
    let n = work.mesh.pos.len();
    for _ in 0..tries {
        let v = work.random.below(n) as u32;
        if !work.mesh.alive(v) || work.mesh.is_fixed(v) { continue; }
        count[0] += 1;
        let mut verts = Vec::new();
        let ok = if mode == 0 {
            // flip a random edge of the link or the star
            let (mut tris, mut ring) = (Vec::new(), Vec::new());
            work.mesh.ring(v, &mut tris, &mut ring);
            let t = tris[work.random.below(tris.len())];
            let k = work.random.below(3);
            let Some((_, d)) = work.mesh.diamond(t, k) else { continue };
            let cost: f64 = d.into_iter().enumerate().map(|(i, w)| {
                let n = work.mesh.degree(w);
                let n2 = if i == 0 || i == 3 { n + 1 } else { n - 1 };
                let s = work.mesh.sector[w as usize];
                crate::refill::degree_cost(work.limits, s, n2) - crate::refill::degree_cost(work.limits, s, n)
            }).sum();
            if cost > 0.5 { continue; }
            if !work.mesh.flip(t, k) { continue; }
            verts.extend(d);
            settle(work, &verts, pass)
        } else {
            // remove v, insert elsewhere nearby
            let (mut tris, mut ring) = (Vec::new(), Vec::new());
            if !work.mesh.ring(v, &mut tris, &mut ring) || ring.len() > 8 { continue; }
            let mut chosen = Vec::new();
            work.refills.choose(&work.mesh, work.limits, &ring, true, 4, &mut chosen);
            if chosen.is_empty() { continue; }
            let c = chosen[work.random.below(chosen.len())];
            if c.0 > 1.0 { continue; }
            let mut new = Vec::new();
            if !work.refills.triangles(&work.mesh, &ring, true, c.1, &mut new) { continue; }
            let mut made = Vec::new();
            work.mesh.replace(&tris, &new, &mut made);
            // insert near: a triangle around a random ring vertex
            let w = ring[work.random.below(ring.len())];
            let (mut t2, mut r2) = (Vec::new(), Vec::new());
            work.mesh.ring(w, &mut t2, &mut r2);
            let t = t2[work.random.below(t2.len())];
            let mut changes = Vec::new();
            crate::change::Finder { mesh: &work.mesh, limits: work.limits, refills: work.refills, out: &mut changes }.find(t);
            changes.retain(|c| matches!(c.action, crate::change::Action::Insert { .. }));
            if changes.is_empty() { work.mesh.rollback(); continue; }
            let pick = work.random.below(changes.len().min(3));
            let a = changes[pick].action;
            if !crate::change::apply(&mut work.mesh, work.refills, a, &mut verts) { work.mesh.rollback(); continue; }
            for x in ring { if !verts.contains(&x) { verts.push(x); } }
            settle(work, &verts, pass)
        };
        if !ok { work.mesh.rollback(); continue; }
        work.commit();
        count[1] += 1;
        if after > 0 {
            let near: Vec<u32> = work.solver.vertices().to_vec();
            for w in near {
                if work.mesh.alive(w) && !work.mesh.is_fixed(w) && work.failed[w as usize] < pass.rings {
                    count[2] += 1;
                    if remove(work, w, pass) { count[3] += 1; } else { work.failed[w as usize] = pass.rings; }
                }
            }
        }
    }
    count
}
