#![allow(unreachable_pub, warnings, clippy::pedantic)]
//! Experiments.
#![allow(missing_docs, clippy::print_stdout)]
mod support;
use hexdel_geom::AngleBounds;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n: usize = a.get(1).map_or(1000, |s| s.parse().unwrap());
    let rule = match a.get(2).map(String::as_str) { Some("D") => support::Rule::D, Some("C") => support::Rule::C, Some(x) if x.starts_with("E") => support::Rule::E(x[1..].parse().unwrap()), Some("B") => support::Rule::B, Some(x) => support::Rule::Apart(x.parse().unwrap()), None => support::Rule::D };
    let lo: f64 = a.get(3).map_or(43.897_886_248_013_98, |s| s.parse().unwrap());
    if let Ok(k) = std::env::var("SELECT") {
        let pts = support::points::uniform(n, 1);
        let mut flags = vec![false; n];
        for _ in 0..k.parse::<usize>().unwrap() {
            let s = support::start_where(&pts, rule, &flags);
            hexdel_optimize::lab::run2(&s.mesh, &s.kinds, AngleBounds::new(lo, 90.0).unwrap(), n, Some(&mut flags));
        }
        let s = support::start_where(&pts, rule, &flags);
        hexdel_optimize::lab::run(&s.mesh, &s.kinds, AngleBounds::new(lo, 90.0).unwrap(), n);
        return;
    }
    let s = support::start(&support::points::uniform(n, 1), rule);
    hexdel_optimize::lab::run(&s.mesh, &s.kinds, AngleBounds::new(lo, 90.0).unwrap(), n);
}
