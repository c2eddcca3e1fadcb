#![allow(unreachable_pub, warnings, clippy::pedantic)]
mod support;
use hexdel_geom::{AngleBounds,DVec2};
fn main() {
    for (n, rule) in [(1000, support::Rule::D), (1000, support::Rule::C)] {
    let mut pts = support::points::uniform(n, 1);
    let mut s = support::start(&pts, rule);
    let mut hist = std::collections::BTreeMap::new();
    let mut deg = vec![0; s.mesh.vertices.len()];
    for t in &s.mesh.triangles { for v in t { deg[v.index()] += 1; } }
    for (i,d) in deg.iter().enumerate() { *hist.entry((*d, i<n)).or_insert(0) += 1; }
    println!("{hist:?}");
    let (mut bad_occ, mut bad_free) = (0, 0);
    let mut worst = std::collections::BTreeMap::new();
    for t in &s.mesh.triangles {
        let p = t.map(|v| s.mesh.vertices[v.index()]);
        let mut bad = false;
        let (mut mn, mut mx) = (180.0f64, 0.0f64);
        for k in 0..3 { let u = p[(k+1)%3]-p[k]; let w = p[(k+2)%3]-p[k]; let a = u.perp_dot(w).atan2(u.dot(w)).to_degrees(); mn = mn.min(a); mx = mx.max(a); }
        if mn < 43.8977 || mx > 90.0000001 { 
            if t.iter().any(|v| v.index() < n) { bad_occ += 1 } else { bad_free += 1; *worst.entry(((mn*10.).round() as i64, (mx*10.).round() as i64)).or_insert(0) += 1; }
        }
    }
    println!("{rule:?} tris {} bad at sites {bad_occ} elsewhere {bad_free}", s.mesh.triangles.len());
    let mut w: Vec<_> = worst.into_iter().collect(); w.sort_by_key(|x| -x.1); println!("{:?}", &w[..w.len().min(25)]);
    }
}
