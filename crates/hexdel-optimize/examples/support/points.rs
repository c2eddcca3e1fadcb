//! Seeded point sets.

use hexdel_geom::DVec2;

/// The splitmix64 generator.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

pub(crate) fn uniform(n: usize, seed: u64) -> Vec<DVec2> {
    let mut r = Random(seed);
    (0..n).map(|_| DVec2::new(r.unit(), r.unit())).collect()
}

pub(crate) fn line(n: usize, seed: u64) -> Vec<DVec2> {
    let mut r = Random(seed);
    (0..n)
        .map(|_| {
            let t = r.unit();
            DVec2::new(t, 0.3 + 0.37 * t)
        })
        .collect()
}

pub(crate) fn two_close() -> Vec<DVec2> {
    vec![DVec2::new(0.0, 0.0), DVec2::new(0.02, 0.0)]
}

pub(crate) fn grid(n: usize) -> Vec<DVec2> {
    (0..n * n).map(|i| DVec2::new((i % n) as f64, (i / n) as f64)).collect()
}

pub(crate) fn circle(n: usize) -> Vec<DVec2> {
    (0..n)
        .map(|i| {
            let a = i as f64 * 2.399_963;
            DVec2::new(a.cos(), a.sin())
        })
        .collect()
}

pub(crate) fn pairs(n: usize, gap: f64, seed: u64) -> Vec<DVec2> {
    let mut r = Random(seed);
    (0..n)
        .flat_map(|_| {
            let p = DVec2::new(r.unit(), r.unit());
            let a = r.unit() * std::f64::consts::TAU;
            [p, p + gap * DVec2::new(a.cos(), a.sin())]
        })
        .collect()
}

pub(crate) fn clusters(n: usize, seed: u64) -> Vec<DVec2> {
    let mut r = Random(seed);
    let centres: Vec<DVec2> = (0..5).map(|_| DVec2::new(r.unit(), r.unit())).collect();
    (0..n)
        .map(|i| {
            let s = 0.2 * r.unit() * r.unit() * r.unit();
            let a = r.unit() * std::f64::consts::TAU;
            centres[i % 5] + s * DVec2::new(a.cos(), a.sin())
        })
        .collect()
}
