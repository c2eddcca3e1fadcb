//! Experiments.
#![allow(missing_docs)]
use crate::angles::Limits;
use crate::decimate::{Pass, decimate};
use crate::mesh::{Mesh, Motion};
use crate::refill::Refills;
use crate::work::Work;
use crate::{VertexKind};
use hexdel_geom::{AngleBounds, TriMesh};
#[derive(Clone, Copy)]
struct Instant(f64);
struct D(f64);
impl D { fn as_secs_f64(&self) -> f64 { self.0 } }
fn cpu() -> f64 { std::fs::read_to_string("/proc/thread-self/schedstat").unwrap().split(' ').next().unwrap().parse::<f64>().unwrap() * 1e-9 }
impl Instant { fn now() -> Self { Self(cpu()) } fn elapsed(&self) -> D { D(cpu() - self.0) } }


pub fn run(mesh: &TriMesh, kinds: &[VertexKind], bounds: AngleBounds, n: usize) {
    run2(mesh, kinds, bounds, n, None);
}
pub fn run2(mesh: &TriMesh, kinds: &[VertexKind], bounds: AngleBounds, n: usize, flags: Option<&mut Vec<bool>>) {
    let limits = Limits::new(bounds);
    let refills = Refills::new();
    let tris: Vec<[u32; 3]> = mesh.triangles.iter().map(|t| t.map(|v| v.index() as u32)).collect();
    let motion: Vec<Motion> = kinds
        .iter()
        .map(|k| match k {
            VertexKind::Fixed => Motion::Fixed,
            VertexKind::Sliding(d) => Motion::Along(*d),
            VertexKind::Free => Motion::Free,
        })
        .collect();
    let sector: Vec<f64> = motion.iter().map(|m| if matches!(m, Motion::Along(_)) { std::f64::consts::PI } else { std::f64::consts::TAU }).collect();
    let mut m = Mesh::build(mesh.vertices.clone(), motion, sector, &tris, &[]).expect("manifold");
    // corners of the domain
    for v in 0..m.pos.len() as u32 {
        let mut tr = vec![]; let mut rg = vec![];
        let closed = m.ring(v, &mut tr, &mut rg);
        if !closed && m.is_fixed(v) { m.sector[v as usize] = 2.0 * std::f64::consts::PI / 3.0; }
    }
    m.validate().expect("valid");
    let nv = m.pos.len();
    let mut w = Work::new(m, &limits, &refills, vec![0; nv], 1);
    let t0 = Instant::now();
    let report = |w: &Work, what: &str, t0: Instant| {
        println!(
            "{what:<22} tri/pt {:7.3} bad {:5} ms/pt {:.4} repairs {:?} removals {:?} steps {} ",
            w.mesh.live().count() as f64 / n as f64, w.bad().len(), t0.elapsed().as_secs_f64() * 1e3 / n as f64, w.stats.repairs, w.stats.removals, w.solver.steps
        );
    };
    report(&w, "start", t0);
    if std::env::var("TRACE").is_ok() {
        for &t in w.bad().iter().step_by(397) {
            let c = w.mesh.tri[t as usize].v;
            w.load(&c);
            println!("tri {t} {:?}", c.map(|v| (w.mesh.is_fixed(v), w.mesh.degree(v))));
            for r in 0..4 {
                if r > 0 { w.grow(); }
                let mut out = vec![];
                for _ in 0..12 { let s = w.solver.run(&limits, 1); out.push(format!("{:.1e}{}", s.energy, if s.solved {"!"} else {""})); if s.solved { break } }
                println!("  r{r} mov {} tris {}: {}", w.solver.movable().len(), w.solver.ids.len(), out.join(" "));
            }
        }
        return;
    }
    if std::env::var("EXP").is_ok() {
        let tight = |d: f64| Limits::with_slack(bounds, d);
        let variants: Vec<(&str, Vec<(f64, usize)>)> = vec![
            ("plain 8", vec![(0.05, 8)]), ("plain 30", vec![(0.05, 30)]), ("plain 100", vec![(0.05, 100)]),
            ("0.5 then", vec![(0.5, 8), (0.05, 8)]), ("2 then", vec![(2.0, 6), (0.05, 8)]), ("5 then", vec![(5.0, 4), (0.05, 8)]),
            ("5,2,.5 then", vec![(5.0, 4), (2.0,4), (0.5,4), (0.05, 8)]),
            ("12 then", vec![(12.0, 3), (0.05, 8)]), ("0.5 only", vec![(0.5, 16)]), ("0.01", vec![(0.01, 16)]), 
        ];
        if std::env::var("PBD").is_ok() {
        for (sl, over, stop, sweeps) in [(0.05, 1.0, 0.9, 40), (0.2, 1.0, 0.9, 40), (0.2, 1.5, 0.9, 40), (0.2, 1.0, 0.8, 40), (0.2, 1.0, 0.97, 100), (0.2, 0.7, 0.97, 100),(0.5, 1.3, 0.97, 100), (0.2,1.5,0.97,100), (0.2,1.7,0.97,100)] {
            for r in 1..4usize {
                let t0 = Instant::now();
                let bad = w.bad();
                let (mut ok, mut n, mut e, mut sw) = (0, 0, 0.0, 0);
                let l = tight(sl);
                for &t in bad.iter().step_by(3) {
                    let c = w.mesh.tri[t as usize].v;
                    w.load(&c);
                    for _ in 0..r { w.grow(); }
                    n += 1;
                    sw += w.solver.project(&l, sweeps, over, stop).1;
                    let s = w.solver.state(&limits);
                    if s.solved { ok += 1 }
                    e += s.energy;
                }
                println!("pbd {sl} {over} {stop} {sweeps} r{r} ok {ok}/{n} meanE {:.4} sweeps {} us {:.1}", e / n as f64, sw / n, t0.elapsed().as_secs_f64()*1e6 / n as f64);
            }
        }
        return;
        }
        for (name, seq) in variants {
            for r in 1..4usize {
                let t0 = Instant::now();
                let bad = w.bad();
                let (mut ok, mut n, mut e) = (0, 0, 0.0);
                for &t in bad.iter().step_by(3) {
                    let c = w.mesh.tri[t as usize].v;
                    w.load(&c);
                    for _ in 0..r { w.grow(); }
                    n += 1;
                    let mut s = w.solver.state(&limits);
                    for &(d, k) in &seq { s = w.solver.run(&tight(d), k); if s.solved { break; } }
                    if s.solved { ok += 1 }
                    e += s.energy;
                }
                println!("{name:<14} r{r} ok {ok}/{n} meanE {:.4} us {:.1}", e / n as f64, t0.elapsed().as_secs_f64()*1e6 / n as f64);
            }
        }
        return;
    }
    let env = |k: &str, d: f64| std::env::var(k).map_or(d, |s| s.parse().unwrap());
    let gs = Limits::with_slack(bounds, env("GSM", 0.5));
    for i in 0..env("GS", 30.) as usize {
        crate::repair::relax(&mut w, &gs);
        if i % 5 == 4 { report(&w, "relax", t0); }
    }
    for s in 0..env("REP", 8.) as usize {
        let aim = Limits::with_slack(bounds, env("SL", 0.05));
        let bad = if env("PREP", 1.) > 0. { crate::repair::push_sweep(&mut w, &aim, 1, if s < 1 { 2 } else { 3 }, env("RLM", 4.) as usize) } else { crate::repair::sweep(&mut w, if s < 2 { 2 } else { 3 }, 8) };
        report(&w, "repair", t0);
        if bad == 0 { break; }
    }
    if let Some(flags) = flags {
        let reach = env("REACH", 1.) as usize;
        let mut new = 0;
        for t in w.bad() {
            let c = w.mesh.tri[t as usize].v;
            w.load(&c);
            for r in 0..reach { if r > 0 { w.grow(); } }
            let mut hit = false;
            for r in 0..3 {
                for &v in w.solver.vertices() { if (v as usize) < n { hit = true; if !flags[v as usize] { flags[v as usize] = true; new += 1; } } }
                if hit { break; }
                w.grow();
            }
        }
        println!("flagged {new}");
        return;
    }
    for _ in 0..env("SEARCH", 3.) as usize {
        let mut tally = crate::repair::Tally::default();
        crate::repair::search(&mut w, &mut tally, env("RINGS", 2.) as usize, env("TOP", 30.) as usize, 3, 0.8);
        report(&w, "search", t0);
        println!("{tally:?}");
    }
    if env("DEC", 1.) == 0. { return; }
    let pass = Pass { rings: 1, refills: 1, max_cost: 10.0, steps: 6, turns: 3, give_up: env("GIVE", 1.0), aim: Limits::with_slack(bounds, env("SL", 0.05)), sweeps: env("SW", 30.) as usize, over: env("OVER", 1.6), stop: env("STOP", 0.6), near: env("NEAR", 0.0), pbd: env("PBD", 1.0) > 0., by_cost: env("BYCOST", 0.0) > 0., skip: env("SKIP", 0.) > 0., wide: 0, wide_cost: env("WC", 0.5), key: env("KEY", 0.) as u8 };
    if std::env::var("PLAN").is_ok() {
        for step in std::env::var("PLAN").unwrap().split(' ') {
            let x: Vec<f64> = step.split(',').map(|x| x.parse().unwrap()).collect();
            if x[0] >= 10.0 {
                let p = Pass { rings: x[2] as u8, turns: 3, steps: 6, refills: 1, max_cost: x[4], ..pass };
                let k = crate::shake::shake(&mut w, p, x[1] as usize, x[0] as usize - 10, x[3] as usize);
                report(&w, &format!("shake {step} {k:?}"), t0);
                continue;
            }
            if x[0] < 0.0 {
                let aim = Limits::with_slack(bounds, -x[0]);
                let k = crate::decimate::spread(&mut w, &aim, x[1] as usize);
                if x.len() > 2 { w.failed.iter_mut().for_each(|f| *f = 0); }
                report(&w, &format!("spread {step} {k}"), t0);
                continue;
            }
            let p = Pass { rings: x[0] as u8, steps: x[1] as usize, turns: x[2] as usize, refills: x[3] as usize, near: x[4], pbd: true, max_cost: x[5], wide: *x.get(6).unwrap_or(&0.) as usize, wide_cost: *x.get(7).unwrap_or(&x[5]), ..pass };
            let (s0, t1) = (w.stats.removals, t0.elapsed().as_secs_f64());
            let k = decimate(&mut w, p);
            let us = (t0.elapsed().as_secs_f64() - t1) * 1e6;
            report(&w, step, t0);
            if std::env::var("HIST").is_ok() { for (i, h) in w.hist.iter().enumerate() { if h[0] > 20 { print!("{:.2}:{}/{:.2} ", i as f64 / 20., h[0], h[1] as f64 / h[0] as f64); } } println!(); }
            w.hist = [[0; 2]; 40];
            println!("    attempts {} us/attempt {:.1} success {:.3} us/removal {:.1}", w.stats.removals[0] - s0[0], us / (w.stats.removals[0] - s0[0]) as f64, k as f64 / (w.stats.removals[0] - s0[0]) as f64, us / k as f64);
        }
        return;
    }
    for (rings, steps, turns, refills) in [(1, 6, 3, 1), (1, 6, 3, 1), (2, 6, 3, 1), (2, 6, 3, 2), (2, 6, 4, 2), (3, 6, 4, 2), (3, 6, 4, 3)] {
        let p = Pass { rings, steps, turns, refills, ..pass };
        let before = w.stats;
        let k = decimate(&mut w, p);
        report(&w, &format!("r{rings} s{steps} t{turns} k{refills}: {k}"), t0);
        let _ = before;
    }
    w.mesh.validate().expect("valid");
}
