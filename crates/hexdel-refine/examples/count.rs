//! Counts.
use hexdel_classify::{Domain, extract};
use hexdel_geom::{DVec2, Unwatched};
use hexdel_grid::Lattice;
use hexdel_refine::{Refiner, RuleSet};
use std::time::Instant;
fn read(path: &str) -> Vec<DVec2> {
    let s = std::fs::read_to_string(path).unwrap();
    s.lines()
        .skip(1)
        .filter(|l| !l.trim().is_empty() && !l.starts_with('#'))
        .map(|l| {
            let t: Vec<f64> = l.split_whitespace().map(|x| x.parse().unwrap()).collect();
            DVec2::new(t[1], t[2])
        })
        .collect()
}
fn cpu() -> f64 {
    std::fs::read_dir("/proc/self/task")
        .unwrap()
        .map(|t| std::fs::read_to_string(t.unwrap().path().join("schedstat")).unwrap())
        .map(|s| s.split(' ').next().unwrap().parse::<f64>().unwrap() / 1e9)
        .sum()
}
fn uniform(n: usize, seed: u64) -> Vec<DVec2> {
    let mut s = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut r = || {
        s ^= s << 13;
        s ^= s >> 7;
        s ^= s << 17;
        (s >> 11) as f64 / (1u64 << 53) as f64
    };
    for _ in 0..20 {
        r();
    }
    (0..n).map(|_| DVec2::new(r(), r())).collect()
}
fn run(name: &str, mut pts: Vec<DVec2>, out: Option<&str>, scale: f64) -> usize {
    let lo = pts.iter().copied().reduce(DVec2::min).unwrap();
    let hi = pts.iter().copied().reduce(DVec2::max).unwrap();
    let c = (lo + hi) / 2.0;
    let r = pts.iter().map(|p| p.distance(c)).fold(0.0, f64::max);
    pts.sort_by_key(|p| {
        let q = (*p - lo) / (hi - lo).max_element() * 65535.0;
        let q = (q.x as u64, q.y as u64);
        let sp = |mut x: u64| {
            x = (x | x << 16) & 0x0000ffff0000ffff;
            x = (x | x << 8) & 0x00ff00ff00ff00ff;
            x = (x | x << 4) & 0x0f0f0f0f0f0f0f0f;
            x = (x | x << 2) & 0x3333333333333333;
            (x | x << 1) & 0x5555555555555555
        };
        sp(q.0) | sp(q.1) << 1
    });
    let simple = std::env::var("SIMPLE").is_ok();
    let mut rules = if simple { RuleSet::simple() } else { RuleSet::extended() };
    if let Ok(w) = std::env::var("WITHOUT") {
        for n in w.split(',') {
            rules = rules.without(n);
        }
    }
    let t0 = Instant::now();
    let c0 = cpu();
    let mut refiner =
        Refiner::new(Lattice::new(c, r * scale), rules).with_coarsening(std::env::var("FINE").is_err());
    refiner.insert(&pts, &Unwatched).unwrap();
    let t1 = Instant::now();
    let c1 = cpu();
    if pts.len() < 5000 {
        if let Some(v) = refiner.violation() {
            println!("VIOLATION {v:?}");
        }
    }
    if std::env::var("STATS").is_ok() {
        stats(&refiner);
    }
    let occ = refiner.occupants();
    let mut best: Option<hexdel_classify::Dual> = None;
    let t2 = Instant::now();
    let c2 = cpu();
    for base in 0..6 {
        let Some(domain) = Domain::around(refiner.grid(), base) else {
            break;
        };
        if domain.radius > 40 {
            break;
        }
        let d = extract(refiner.grid_mut(), &occ, domain, !simple, &Unwatched).unwrap();
        if best.as_ref().is_none_or(|b| d.mesh.triangles.len() < b.mesh.triangles.len()) {
            best = Some(d);
        }
        if pts.len() > 5000 {
            break;
        }
    }
    let t3 = Instant::now();
    let c3 = cpu();
    let d = best.unwrap();
    let n = d.mesh.triangles.len();
    println!(
        "{name}: n={} tri={n} per pt {:.1} base {:?} levels {} refine {:.3}s extract {:.3}s  {:.2} Mtri/s",
        pts.len(),
        n as f64 / pts.len() as f64,
        d.domain,
        refiner.grid().tiles().levels(),
        (t1 - t0).as_secs_f64(),
        (t3 - t2).as_secs_f64(),
        n as f64 / (t1 - t0 + (t3 - t2)).as_secs_f64() / 1e6
    );
    println!(
        "cpu refine {:.3} extract {:.3} {:.2} Mtri/s",
        c1 - c0,
        c3 - c2,
        n as f64 / 1e6 / (c1 - c0 + c3 - c2)
    );
    if std::env::var("SUM").is_ok() {
        let h = |v: hexdel_geom::VertexId| {
            let p = d.mesh.vertices[v.index()];
            (p.x.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ p.y.to_bits().rotate_left(29))
                .wrapping_mul(0xD6E8_FEB8_6659_FD93)
        };
        let sum = d.mesh.triangles.iter().fold(0u64, |s, t| {
            let [a, b, c] = t.map(h);
            s.wrapping_add(a.wrapping_mul(b).wrapping_add(b.wrapping_mul(c)).wrapping_add(c.wrapping_mul(a)))
        });
        println!("checksum {sum:016x} vertices {}", d.mesh.vertices.len());
    }
    if let Some(out) = out {
        use std::fmt::Write;
        let mut s = format!("{} 2 0 0\n", d.mesh.vertices.len());
        for (i, v) in d.mesh.vertices.iter().enumerate() {
            writeln!(s, "{i} {:?} {:?}", v.x, v.y).unwrap();
        }
        std::fs::write(format!("{out}.node"), s).unwrap();
        let mut s = format!("{} 3 0\n", n);
        for (i, t) in d.mesh.triangles.iter().enumerate() {
            writeln!(s, "{i} {} {} {}", t[0].index(), t[1].index(), t[2].index()).unwrap();
        }
        std::fs::write(format!("{out}.ele"), s).unwrap();
    }
    n
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let scale: f64 = std::env::var("SCALE").ok().map_or(4.0, |s| s.parse().unwrap());
    if a[1] == "uniform" {
        let n: usize = a[2].parse().unwrap();
        let seeds: u64 = a[3].parse().unwrap();
        let mut sum = 0;
        for s in 1..=seeds {
            sum += run(&format!("uniform{s}"), uniform(n, s), None, scale);
        }
        println!("mean {}", sum as f64 / seeds as f64);
    } else {
        run(&a[1], read(&a[1]), a.get(2).map(String::as_str), scale);
    }
}
#[allow(dead_code)]
pub fn stats(r: &Refiner) {
    let (mut s, mut need) = (0u32, 0u32);
    for l in 0..r.grid().tiles().levels() as u8 {
        for t in r.grid().tiles().level(l) {
            s += t.subdivided.count_ones();
            need += (t.subdivided & t.needed).count_ones();
        }
    }
    let occ = r.occupants();
    let two = occ.iter().filter(|o| !hexdel_classify::relocate::ring_may_stay(&o.at)).count();
    // level relative to nearest neighbour
    let mut hist = [[0u32; 12]; 2];
    for (i, o) in occ.iter().enumerate() {
        let d = occ
            .iter()
            .enumerate()
            .filter(|(j, _)| *j != i)
            .map(|(_, p)| p.point.distance(o.point))
            .fold(f64::MAX, f64::min);
        let x = d / r.grid().lattice().spacing(o.level);
        let b = (x.max(1.0).log2() * 2.0) as usize;
        hist[usize::from(!hexdel_classify::relocate::ring_may_stay(&o.at))][b.min(11)] += 1;
    }
    println!("S {s} needed {need} occ2 {two} of {} nn/s hist by half-octave: {hist:?}", occ.len());
}
