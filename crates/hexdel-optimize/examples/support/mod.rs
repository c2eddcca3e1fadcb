//! Start meshes for the examples, benches and tests of this crate: a plain,
//! ordered-set implementation of the balanced hexagon grid and its dual with
//! the paper's templates at level transitions (paper, sections 3 to 5.4).
//! The product's grid engine lives in other crates; this one only has to be
//! right and short.

#![allow(
    dead_code,
    reason = "each user of this support module needs a part of it"
)]

use std::collections::{BTreeMap, BTreeSet};

use hexdel_geom::{DVec2, TriMesh, VertexId};
use hexdel_optimize::VertexKind;

pub(crate) mod points;

/// A hexagon address on one level's lattice.
type Hex = (i64, i64);
/// Level and address.
type Cell = (usize, Hex);

const DIRS: [Hex; 6] = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)];

fn add(a: Hex, b: Hex) -> Hex {
    (a.0 + b.0, a.1 + b.1)
}

/// Which occupied hexagons are kept apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rule {
    /// One point per leaf.
    D,
    /// No two occupied leaves are neighbours.
    C,
    /// No other site within this share of an occupied leaf's spacing.
    Apart(f64),
    /// No occupied leaf has a neighbour of another level, or an occupied one.
    B,
    /// As B, but occupied neighbours only within this share of the spacing.
    E(f64),
}

/// A start mesh with the kinds of its vertices; the sites come first.
pub(crate) struct Start {
    pub(crate) mesh: TriMesh,
    pub(crate) kinds: Vec<VertexKind>,
}

struct Grid {
    /// Subdivided hexagons per level.
    split: Vec<BTreeSet<Hex>>,
    /// Level-0 radius of the patch.
    radius: i64,
    /// Level-0 spacing.
    spacing: f64,
    origin: DVec2,
}

/// What became of a hexagon in the dual.
#[derive(Clone, Copy)]
struct Triple {
    /// Direction of the first fin.
    first: usize,
    top: Hex,
}

impl Grid {
    fn is_split(&self, k: usize, h: Hex) -> bool {
        self.split.get(k).is_some_and(|s| s.contains(&h))
    }

    fn exists(&self, k: usize, h: Hex) -> bool {
        if k == 0 {
            return h.0.abs() <= self.radius
                && h.1.abs() <= self.radius
                && (h.0 + h.1).abs() <= self.radius;
        }
        let [a, b] = parents(h);
        self.is_split(k - 1, a) && self.is_split(k - 1, b)
    }

    fn subdivide(&mut self, k: usize, h: Hex) {
        if self.is_split(k, h) {
            return;
        }
        for d in DIRS {
            let n = add(h, d);
            if !self.exists(k, n) {
                assert!(k > 0, "the patch is too small");
                for p in parents(n) {
                    self.subdivide(k - 1, p);
                }
            }
        }
        while self.split.len() <= k {
            self.split.push(BTreeSet::new());
        }
        self.split[k].insert(h);
    }

    fn centre(&self, k: usize, h: Hex) -> DVec2 {
        let s = self.spacing / (1u64 << k) as f64;
        let (q, r) = (h.0 as f64, h.1 as f64);
        self.origin + DVec2::new(s * (q + 0.5 * r), s * r * 0.5 * 3f64.sqrt())
    }

    fn nearest(&self, k: usize, p: DVec2) -> Hex {
        let s = self.spacing / (1u64 << k) as f64;
        let d = (p - self.origin) / s;
        let r = d.y * 2.0 / 3f64.sqrt();
        let q = d.x - 0.5 * r;
        let t = -q - r;
        let (mut rq, mut rr, rt) = (q.round(), r.round(), t.round());
        let (dq, dr, dt) = ((rq - q).abs(), (rr - r).abs(), (rt - t).abs());
        if dq > dr && dq > dt {
            rq = -rr - rt;
        } else if dr > dt {
            rr = -rq - rt;
        }
        (rq as i64, rr as i64)
    }

    /// The leaf that holds `p`, or the full hexagons whose subdivision would
    /// complete the semi-hexagon that does.
    fn locate(&self, p: DVec2) -> Result<Cell, (usize, [Hex; 2])> {
        let mut k = 0;
        loop {
            let h = self.nearest(k, p);
            if !self.exists(k, h) {
                return Err((k - 1, parents(h)));
            }
            if !self.is_split(k, h) {
                return Ok((k, h));
            }
            k += 1;
        }
    }

    fn place(&mut self, points: &[DVec2], rule: Rule, strict: &[bool]) -> BTreeMap<Cell, usize> {
        loop {
            let mut changed = false;
            let mut occupied = BTreeMap::new();
            for (i, &p) in points.iter().enumerate() {
                match self.locate(p) {
                    Err((k, hs)) => {
                        for h in hs {
                            self.subdivide(k, h);
                        }
                        changed = true;
                    }
                    Ok(cell) => {
                        if occupied.insert(cell, i).is_some() {
                            self.subdivide(cell.0, cell.1);
                            changed = true;
                        }
                    }
                }
            }
            if changed {
                continue;
            }
            if rule == Rule::C {
                let near: Vec<Cell> = occupied
                    .keys()
                    .filter(|(k, h)| {
                        DIRS.iter()
                            .any(|&d| occupied.contains_key(&(*k, add(*h, d))))
                    })
                    .copied()
                    .collect();
                for (k, h) in &near {
                    self.subdivide(*k, *h);
                }
                if !near.is_empty() {
                    continue;
                }
            }
            if matches!(rule, Rule::B | Rule::E(_)) || !strict.is_empty() {
                let on = |i: usize| strict.is_empty() || strict[i];
                let near: Vec<Cell> = occupied
                    .iter()
                    .filter(|(_, i)| on(**i))
                    .map(|(c, _)| c)
                    .filter(|(k, h)| {
                        self.fins(*k, *h) != 0
                            || !matches!(rule, Rule::E(_))
                                && DIRS
                                    .iter()
                                    .any(|&d| occupied.contains_key(&(*k, add(*h, d))))
                    })
                    .copied()
                    .collect();
                let coarse: Vec<Cell> = occupied
                    .iter()
                    .filter(|(_, i)| on(**i))
                    .map(|(c, _)| c)
                    .filter(|(k, _)| *k > 0)
                    .flat_map(|&(k, h)| DIRS.map(|d| (k, add(h, d))))
                    .filter(|&(k, h)| !self.exists(k, h))
                    .flat_map(|(k, h)| parents(h).map(|p| (k - 1, p)))
                    .collect();
                for (k, h) in near.iter().chain(&coarse) {
                    self.subdivide(*k, *h);
                }
                if !near.is_empty() || !coarse.is_empty() {
                    continue;
                }
            }
            if let Rule::Apart(share) | Rule::E(share) = rule {
                let near = self.too_close(points, &occupied, share);
                for (k, h) in &near {
                    self.subdivide(*k, *h);
                }
                if !near.is_empty() {
                    continue;
                }
            }
            if !self.legalise(&occupied) {
                return occupied;
            }
        }
    }

    /// Occupied leaves with another site within `share` of their spacing, in
    /// a leaf of their level or the next coarser one.
    fn too_close(
        &self,
        points: &[DVec2],
        occupied: &BTreeMap<Cell, usize>,
        share: f64,
    ) -> Vec<Cell> {
        let mut near = Vec::new();
        for (&(k, h), &i) in occupied {
            let s = self.spacing / (1u64 << k) as f64;
            for d in 0..12 {
                let a = f64::from(d) * std::f64::consts::PI / 6.0;
                let probe = points[i] + share * s * DVec2::new(a.cos(), a.sin());
                let Ok(cell) = self.locate(probe) else {
                    continue;
                };
                let other = occupied.get(&cell).filter(|j| **j != i);
                if other.is_some_and(|&j| points[j].distance(points[i]) < share * s) {
                    near.push((k, h));
                    break;
                }
            }
        }
        near
    }

    fn fins(&self, k: usize, h: Hex) -> u8 {
        (0..6)
            .filter(|&i| self.is_split(k, add(h, DIRS[i])))
            .fold(0, |m, i| m | 1 << i)
    }

    /// Leaves at level `k` next to a subdivided hexagon.
    fn fronts(&self, k: usize) -> BTreeSet<Hex> {
        let Some(split) = self.split.get(k) else {
            return BTreeSet::new();
        };
        split
            .iter()
            .flat_map(|&h| DIRS.map(|d| add(h, d)))
            .filter(|&h| self.exists(k, h) && !self.is_split(k, h))
            .collect()
    }

    /// Subdivides what has no template; true when it did.
    fn legalise(&mut self, occupied: &BTreeMap<Cell, usize>) -> bool {
        let mut wrong = Vec::new();
        for k in 0..self.split.len() {
            let mut tops: BTreeMap<Hex, Vec<usize>> = BTreeMap::new();
            for h in self.fronts(k) {
                let Some((first, n)) = run(self.fins(k, h)) else {
                    wrong.push((k, h));
                    continue;
                };
                if n < 3 {
                    continue;
                }
                let back = (first + 4) % 6;
                let top = add(h, DIRS[back]);
                let plain = self.exists(k, top)
                    && !self.is_split(k, top)
                    && self.fins(k, top) == 0
                    && !occupied.contains_key(&(k, top));
                if !plain || occupied.contains_key(&(k, h)) {
                    wrong.push((k, h));
                } else {
                    tops.entry(top).or_default().push((back + 3) % 6);
                }
            }
            for (top, mut at) in tops {
                at.sort_unstable();
                let mask = at.iter().fold(0u8, |m, i| m | 1 << i);
                if mask != 63 && run(mask).is_none() && !four(mask) {
                    wrong.push((k, top));
                }
            }
        }
        if wrong.is_empty() {
            wrong = self.facing(occupied);
        }
        for &(k, h) in &wrong {
            self.subdivide(k, h);
        }
        !wrong.is_empty()
    }

    /// Fronts must be compatible: of two neighbours that both move, without a
    /// fin in common, one is to be subdivided (the top of a run is
    /// compatible with the run and with what shares a fin with it).
    fn facing(&self, occupied: &BTreeMap<Cell, usize>) -> Vec<Cell> {
        let mut wrong = Vec::new();
        for k in 0..self.split.len() {
            let mut fins: BTreeMap<Hex, u8> = BTreeMap::new();
            let mut tops: BTreeSet<Hex> = BTreeSet::new();
            for h in self
                .fronts(k)
                .into_iter()
                .filter(|h| !occupied.contains_key(&(k, *h)))
            {
                let mask = self.fins(k, h);
                fins.insert(h, mask);
                if let Some((first, 3)) = run(mask) {
                    tops.insert(add(h, DIRS[(first + 4) % 6]));
                }
            }
            let of = |h: Hex| -> Vec<Hex> {
                (0..6)
                    .filter(|i| fins[&h] >> i & 1 == 1)
                    .map(|i| add(h, DIRS[i]))
                    .collect()
            };
            let share = |a: Hex, b: Hex| of(a).iter().any(|f| of(b).contains(f));
            let under = |h: Hex, top: Hex| {
                run(fins[&h]).is_some_and(|(f, n)| n == 3 && add(h, DIRS[(f + 4) % 6]) == top)
            };
            let with_top = |g: Hex, top: Hex| {
                under(g, top)
                    || DIRS
                        .iter()
                        .map(|d| add(top, *d))
                        .any(|m| fins.contains_key(&m) && under(m, top) && share(m, g))
            };
            for (&h, &mask) in &fins {
                for d in DIRS {
                    let g = add(h, d);
                    let clash = match fins.get(&g) {
                        Some(&other) => {
                            !share(h, g) && (mask.count_ones(), h) > (other.count_ones(), g)
                        }
                        None => tops.contains(&g) && !with_top(h, g),
                    };
                    if clash {
                        wrong.push((k, h));
                        break;
                    }
                }
            }
        }
        wrong
    }
}

/// The two parents of a hexagon; equal for a scaled centre.
fn parents(h: Hex) -> [Hex; 2] {
    let half = |x: i64| x.div_euclid(2);
    match (h.0.rem_euclid(2), h.1.rem_euclid(2)) {
        (0, 0) => [(half(h.0), half(h.1)); 2],
        (1, 0) => [(half(h.0), half(h.1)), (half(h.0) + 1, half(h.1))],
        (0, 1) => [(half(h.0), half(h.1)), (half(h.0), half(h.1) + 1)],
        _ => [(half(h.0) + 1, half(h.1)), (half(h.0), half(h.1) + 1)],
    }
}

/// First direction and length of the one cyclic run of at most three bits.
fn run(mask: u8) -> Option<(usize, usize)> {
    (1..=3).find_map(|n| {
        (0..6).find_map(|i| {
            let m = (0..n).fold(0u8, |m, j| m | 1 << ((i + j) % 6));
            (m == mask).then_some((i, n))
        })
    })
}

fn four(mask: u8) -> bool {
    (0..6).any(|i| (0..4).fold(0u8, |m, j| m | 1 << ((i + j) % 6)) == mask)
}

/// Vertex numbers and triangles as they are emitted.
#[derive(Default)]
struct Dual {
    ids: BTreeMap<(usize, Hex, u8), usize>,
    pos: Vec<DVec2>,
    tris: Vec<[usize; 3]>,
}

impl Dual {
    fn id(&mut self, key: (usize, Hex, u8), at: DVec2) -> usize {
        if let Some(&i) = self.ids.get(&key) {
            return i;
        }
        self.ids.insert(key, self.pos.len());
        self.pos.push(at);
        self.pos.len() - 1
    }
}

struct Emit<'a> {
    grid: &'a Grid,
    occupied: &'a BTreeMap<Cell, usize>,
    triples: Vec<BTreeMap<Hex, Triple>>,
    dual: Dual,
}

impl Emit<'_> {
    fn leaf(&self, mut k: usize, mut h: Hex) -> Cell {
        while self.grid.is_split(k, h) {
            k += 1;
            h = (2 * h.0, 2 * h.1);
        }
        (k, h)
    }

    fn vertex(&mut self, k: usize, h: Hex) -> usize {
        let (k, h) = self.leaf(k, h);
        let at = self.relocated(k, h);
        self.dual.id((k, h, 0), at)
    }

    fn triple(&self, k: usize, h: Hex) -> Option<Triple> {
        self.triples.get(k).and_then(|m| m.get(&h)).copied()
    }

    fn relocated(&self, k: usize, h: Hex) -> DVec2 {
        let g = self.grid;
        let c = g.centre(k, h);
        if self.occupied.contains_key(&(k, h)) {
            return c;
        }
        if let Some(t) = self.triple(k, h) {
            return c * (2.0 / 3.0) + g.centre(k, t.top) / 3.0;
        }
        if let Some((i, n)) = run(g.fins(k, h)) {
            let a = add(h, DIRS[i]);
            if n == 1 {
                return c * (5.0 / 6.0) + g.centre(k, a) / 6.0;
            }
            let b = add(h, DIRS[(i + 1) % 6]);
            return c * 0.6 + 0.4 * g.centre(k + 1, add(a, b));
        }
        self.under_run(k, h, c)
    }

    /// The centre of a hexagon that is the top of a run.
    fn under_run(&self, k: usize, h: Hex, c: DVec2) -> DVec2 {
        let below = |i: usize| {
            let n = add(h, DIRS[i % 6]);
            self.triple(k, n).is_some_and(|t| t.top == h).then_some(n)
        };
        let mask = (0..6)
            .filter(|&i| below(i).is_some())
            .fold(0u8, |m, i| m | 1 << i);
        let start = (0..6).find(|&i| mask >> i & 1 == 1 && mask >> ((i + 5) % 6) & 1 == 0);
        let Some(start) = start else { return c };
        let at = |i: usize| self.grid.centre(k, add(h, DIRS[(start + i) % 6]));
        let hat = |i: usize| at(i) * (2.0 / 3.0) + c / 3.0;
        match mask.count_ones() {
            1 => c * 0.6 + at(0) * 0.4,
            2 => c * 1.25 - 0.125 * (hat(0) + hat(1)),
            3 => c * (7.0 / 6.0) - at(1) / 6.0,
            _ => c * (4.0 / 3.0) - (hat(1) + hat(2)) / 6.0,
        }
    }

    fn walk(&mut self) {
        let mut cells: Vec<Hex> = Vec::new();
        let r = self.grid.radius;
        for q in -r..=r {
            for s in -r..=r {
                if self.grid.exists(0, (q, s)) {
                    cells.push((q, s));
                }
            }
        }
        let mut k = 0;
        while !cells.is_empty() {
            for &h in &cells {
                for i in 0..2 {
                    let corners = [h, add(h, DIRS[i]), add(h, DIRS[i + 1])];
                    if corners.iter().all(|&c| self.grid.exists(k, c)) {
                        self.lattice_triangle(k, corners);
                    }
                }
            }
            let triples: Vec<(Hex, Triple)> = self
                .triples
                .get(k)
                .map_or(Vec::new(), |m| m.iter().map(|(h, t)| (*h, *t)).collect());
            for (h, t) in triples {
                self.star(k, h, t);
            }
            let mut next = BTreeSet::new();
            if let Some(split) = self.grid.split.get(k) {
                for &h in split {
                    next.insert((2 * h.0, 2 * h.1));
                    for d in DIRS {
                        if self.grid.is_split(k, add(h, d)) {
                            next.insert(add((2 * h.0, 2 * h.1), d));
                        }
                    }
                }
            }
            cells = next.into_iter().collect();
            k += 1;
        }
    }

    fn lattice_triangle(&mut self, k: usize, c: [Hex; 3]) {
        if c.iter().any(|&h| self.triple(k, h).is_some()) {
            return;
        }
        let split = c.map(|h| self.grid.is_split(k, h));
        match split.iter().filter(|s| **s).count() {
            0 | 1 => {
                let t = c.map(|h| self.vertex(k, h));
                self.dual.tris.push(t);
            }
            2 => {
                let i = split
                    .iter()
                    .position(|s| !*s)
                    .expect("one corner is a leaf");
                let (h, a, b) = (c[i], c[(i + 1) % 3], c[(i + 2) % 3]);
                let m = self.vertex(k + 1, add(a, b));
                let (h, a, b) = (self.vertex(k, h), self.vertex(k, a), self.vertex(k, b));
                self.dual.tris.push([h, a, m]);
                self.dual.tris.push([h, m, b]);
            }
            _ => {}
        }
    }

    /// The star of a hexagon with three fins.
    fn star(&mut self, k: usize, h: Hex, t: Triple) {
        let dir = |i: usize| add(h, DIRS[(t.first + i) % 6]);
        let (g_l, a, g_r) = (dir(5), [dir(0), dir(1), dir(2)], dir(3));
        let same = |n: Hex| self.triple(k, n).is_some_and(|o| o.top == t.top);
        let (prev, next) = (same(g_l), same(g_r));
        let p0 = self.fin_point(k, h, a[0], prev.then_some(g_l), prev || next);
        let p2 = self.fin_point(k, h, a[2], next.then_some(g_r), prev || next);
        let c = self.grid.centre(k, h);
        let far = self.grid.centre(k, a[1]);
        let at = if prev || next {
            c * 0.6 + far * 0.4
        } else {
            c * 0.4 + far * 0.6
        };
        let p1 = self.dual.id((k, h, 1), at);
        let m01 = self.vertex(k + 1, add(a[0], a[1]));
        let m12 = self.vertex(k + 1, add(a[1], a[2]));
        let (top, l, r) = (self.vertex(k, t.top), g_l, g_r);
        let a = a.map(|x| self.vertex(k, x));
        let mut out = vec![
            [p0, a[0], m01],
            [p0, m01, p1],
            [p1, m01, a[1]],
            [p1, a[1], m12],
            [p1, m12, p2],
            [p2, m12, a[2]],
        ];
        if !prev {
            let l = self.vertex(k, l);
            out.push([p0, l, a[0]]);
        }
        if !next {
            let r = self.vertex(k, r);
            out.push([p2, a[2], r]);
        }
        if prev || next {
            let hat = self.vertex(k, h);
            let (l, r) = (self.vertex(k, l), self.vertex(k, r));
            out.extend([[hat, p0, p1], [hat, p1, p2], [hat, p2, r], [hat, r, top]]);
            if !prev {
                out.extend([[hat, l, p0], [hat, top, l]]);
            }
        } else {
            let (l, r) = (self.vertex(k, l), self.vertex(k, r));
            out.extend([[p0, p1, p2], [p0, p2, top], [p0, top, l], [p2, r, top]]);
        }
        self.dual.tris.extend(out);
    }

    fn fin_point(
        &mut self,
        k: usize,
        h: Hex,
        fin: Hex,
        shared: Option<Hex>,
        in_run: bool,
    ) -> usize {
        let a = self.grid.centre(k, fin);
        let hat = self.relocated(k, h);
        let at = match shared {
            Some(o) => 0.225 * (hat + self.relocated(k, o)) + a * 0.55,
            None if in_run => hat * (25.0 / 52.0) + a * (27.0 / 52.0),
            None => self.grid.centre(k, h) * 0.6 + a * 0.4,
        };
        // The fin point of two hexagons is one vertex: key it by the edge.
        let key = match shared {
            Some(o) => (
                k + 1,
                add(h.min(o), h.max(o)),
                4 + u8::from(cross(h, o, fin)),
            ),
            None => (k + 1, add(h, fin), 2),
        };
        self.dual.id(key, at)
    }
}

/// On which side of `a b` the hexagon `c` lies, independent of the order of a and b.
fn cross(a: Hex, b: Hex, c: Hex) -> bool {
    let (a, b) = (a.min(b), a.max(b));
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0) > 0
}

/// The start mesh of `points` under `rule`; the sites are the first vertices.
pub(crate) fn start(points: &[DVec2], rule: Rule) -> Start {
    start_where(points, rule, &[])
}

/// As `start`, with rule B at the sites that `strict` marks.
pub(crate) fn start_where(points: &[DVec2], rule: Rule, strict: &[bool]) -> Start {
    let (lo, hi) = points
        .iter()
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(l, h), &p| {
            (l.min(p), h.max(p))
        });
    let half = 0.5 * (hi - lo).length().max(1e-3);
    let mut grid = Grid {
        split: Vec::new(),
        radius: 12,
        spacing: 2.2 * half,
        origin: 0.5 * (lo + hi),
    };
    let occupied = grid.place(points, rule, strict);
    let reach = grid.split.first().map_or(0, |s| {
        s.iter()
            .map(|h| h.0.abs().max(h.1.abs()).max((h.0 + h.1).abs()))
            .max()
            .unwrap_or(0)
    });
    grid.radius = reach + 3;
    let mut triples = Vec::new();
    for k in 0..grid.split.len() {
        let mut m = BTreeMap::new();
        for h in grid.fronts(k) {
            if let Some((first, 3)) = run(grid.fins(k, h)) {
                m.insert(
                    h,
                    Triple {
                        first,
                        top: add(h, DIRS[(first + 4) % 6]),
                    },
                );
            }
        }
        triples.push(m);
    }
    let mut emit = Emit {
        grid: &grid,
        occupied: &occupied,
        triples,
        dual: Dual::default(),
    };
    emit.walk();
    let dual = emit.dual;
    finish(points, &grid, &occupied, &dual)
}

fn finish(points: &[DVec2], grid: &Grid, occupied: &BTreeMap<Cell, usize>, dual: &Dual) -> Start {
    let mut id = vec![usize::MAX; dual.pos.len()];
    for (&(k, h), &i) in occupied {
        id[dual.ids[&(k, h, 0)]] = i;
    }
    let mut vertices = points.to_vec();
    let mut kinds = vec![VertexKind::Fixed; points.len()];
    let mut keys = vec![(0, (0, 0), 0); dual.pos.len()];
    for (&key, &i) in &dual.ids {
        keys[i] = key;
    }
    for (i, &p) in dual.pos.iter().enumerate() {
        if id[i] == usize::MAX {
            id[i] = vertices.len();
            vertices.push(p);
            kinds.push(rim_kind(grid, keys[i]));
        }
    }
    let triangles = dual
        .tris
        .iter()
        .map(|t| t.map(|v| VertexId::new(id[v])))
        .collect();
    Start {
        mesh: TriMesh {
            vertices,
            triangles,
        },
        kinds,
    }
}

fn rim_kind(grid: &Grid, (k, (q, r), tag): (usize, Hex, u8)) -> VertexKind {
    let n = grid.radius;
    if k > 0 || tag > 0 {
        return VertexKind::Free;
    }
    let on = [q.abs() == n, r.abs() == n, (q + r).abs() == n];
    let y = 0.5 * 3f64.sqrt();
    match on {
        [false, false, false] => VertexKind::Free,
        [true, false, false] => VertexKind::Sliding(DVec2::new(0.5, y)),
        [false, true, false] => VertexKind::Sliding(DVec2::new(1.0, 0.0)),
        [false, false, true] => VertexKind::Sliding(DVec2::new(0.5, -y)),
        _ => VertexKind::Fixed,
    }
}
