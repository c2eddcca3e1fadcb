//! Families of small PSLGs, by name and seed, for tests and examples.

#![allow(dead_code, reason = "each of them uses a part")]
#![allow(unreachable_pub, reason = "it is a module of several programs")]

use hexdel_geom::{AngleBounds, DVec2, Pslg, TriangleId, quality};
use std::f64::consts::TAU;

/// A small generator of pseudo-random numbers (splitmix64).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform between two numbers.
    pub fn within(&mut self, min: f64, max: f64) -> f64 {
        min + (max - min) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform below `n`.
    pub fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    pub fn point(&mut self, radius: f64) -> DVec2 {
        DVec2::new(self.within(-radius, radius), self.within(-radius, radius))
    }
}

/// The names of all families.
pub const FAMILIES: [&str; 13] = [
    "line",
    "corner",
    "square",
    "star36",
    "star60",
    "fan5",
    "fan6",
    "convex",
    "tee",
    "near miss",
    "parallels",
    "letter A",
    "letter R",
];

/// A member of a family.
pub fn family(name: &str, seed: u64) -> Pslg {
    let mut random = Random::new(seed);
    let at = random.point(0.2);
    let turn = random.within(0.0, TAU);
    let mut pslg = match name {
        "line" => chain(&[DVec2::new(-0.9, 0.0), DVec2::new(0.9, 0.0)], false),
        "corner" => corner(random.within(60.0, 300.0)),
        "square" => polygon(4, |_| 0.5),
        "star36" => star(5, 36.0),
        "star60" => star(6, 60.0),
        "fan5" => fan(5, &mut random),
        "fan6" => fan(6, &mut random),
        "convex" => convex(&mut random),
        "tee" => tee(0.0, &mut random),
        "near miss" => {
            let gap = random.within(0.02, 0.2);
            tee(gap, &mut random)
        }
        "parallels" => parallels(&mut random),
        "letter A" => letter_a(),
        "letter R" => letter_r(),
        _ => panic!("there is no family {name}"),
    };
    for p in &mut pslg.points {
        *p = DVec2::from_angle(turn).rotate(*p) + at;
    }
    // A frame of points, so that the lattice does not turn and move along.
    pslg.points.extend((0..6).map(|i| DVec2::from_angle(f64::from(i) * TAU / 6.0) * 2.0));
    pslg
}

pub(crate) fn chain<P: Copy + Into<DVec2>>(points: &[P], closed: bool) -> Pslg {
    let mut pslg = Pslg::from_points(points.iter().map(|&p| p.into()).collect());
    let n = points.len() as u32;
    pslg.segments = (0..n - u32::from(!closed)).map(|i| [i, (i + 1) % n]).collect();
    pslg
}

pub(crate) fn append(to: &mut Pslg, other: &Pslg) {
    let base = to.points.len() as u32;
    to.points.extend(&other.points);
    to.segments.extend(other.segments.iter().map(|s| s.map(|p| p + base)));
}

fn polygon(n: u32, radius: impl Fn(u32) -> f64) -> Pslg {
    let corner = |i| DVec2::from_angle(f64::from(i) * TAU / f64::from(n)) * radius(i);
    chain(&(0..n).map(corner).collect::<Vec<_>>(), true)
}

fn corner(angle_deg: f64) -> Pslg {
    chain(&[DVec2::X * 0.8, DVec2::ZERO, DVec2::from_angle(angle_deg.to_radians()) * 0.8], false)
}

/// A star whose tips have the given angle.
fn star(tips: u32, tip_deg: f64) -> Pslg {
    // In the triangle of centre, tip and notch the angle at the tip is half of
    // the tip's, that at the centre half of a turn over the tips.
    let (tip, centre) = (0.5 * tip_deg.to_radians(), 0.5 * TAU / f64::from(tips));
    let notch = 0.8 * tip.sin() / (tip + centre).sin();
    polygon(2 * tips, |i| if i % 2 == 0 { 0.8 } else { notch })
}

/// Segments from one point, at least 32 degrees apart.
fn fan(n: u32, random: &mut Random) -> Pslg {
    let least = 32.0_f64;
    let weights: Vec<f64> = (0..n).map(|_| random.within(0.05, 1.0)).collect();
    let spare = (360.0 - least * f64::from(n)) / weights.iter().sum::<f64>();
    let mut pslg = Pslg::from_points(vec![DVec2::ZERO]);
    let mut angle: f64 = 0.0;
    for (i, w) in weights.iter().enumerate() {
        let length = random.within(0.4, 0.9);
        pslg.points.push(DVec2::from_angle(angle.to_radians()) * length);
        pslg.segments.push([0, i as u32 + 1]);
        angle += least + w * spare;
    }
    pslg
}

/// A convex polygon of 5 to 9 corners on a circle, none narrower than 45
/// degrees.
fn convex(random: &mut Random) -> Pslg {
    let n = 5 + random.below(5) as u32;
    let least = 180.0 / f64::from(n);
    let weights: Vec<f64> = (0..n).map(|_| random.within(0.05, 1.0)).collect();
    let spare = 180.0 / weights.iter().sum::<f64>();
    let mut angle: f64 = 0.0;
    let mut points = Vec::new();
    for w in weights {
        points.push(DVec2::from_angle(angle.to_radians()) * 0.8);
        angle += least + w * spare;
    }
    chain(&points, true)
}

/// A segment and another that ends on it, or a gap before it.
fn tee(gap: f64, random: &mut Random) -> Pslg {
    let foot = random.within(-0.4, 0.4);
    let lean = random.within(50.0, 130.0_f64).to_radians();
    let mut pslg = chain(&[DVec2::new(-0.8, 0.0), DVec2::new(foot, 0.0), DVec2::new(0.8, 0.0)], false);
    let direction = DVec2::from_angle(lean);
    let start = DVec2::new(foot, 0.0) + direction * gap;
    if gap == 0.0 {
        pslg.points.push(direction * 0.7);
        pslg.points[3] += DVec2::new(foot, 0.0);
        pslg.segments.push([1, 3]);
    } else {
        pslg = chain(&[DVec2::new(-0.8, 0.0), DVec2::new(0.8, 0.0)], false);
        append(&mut pslg, &chain(&[start, start + direction * 0.6], false));
    }
    pslg
}

fn parallels(random: &mut Random) -> Pslg {
    let gap = random.within(0.03, 0.3);
    let mut pslg = Pslg::default();
    for i in 0..3 {
        let y = gap * f64::from(i);
        append(&mut pslg, &chain(&[DVec2::new(-0.7, y), DVec2::new(0.7, y)], false));
    }
    pslg
}

fn scaled(points: &[(f64, f64)]) -> Vec<DVec2> {
    points.iter().map(|&(x, y)| (DVec2::new(x, y) - DVec2::new(3.0, 4.0)) * 0.15).collect()
}

fn letter_a() -> Pslg {
    let outer =
        [(0.0, 0.0), (1.2, 0.0), (1.9, 2.0), (4.1, 2.0), (4.8, 0.0), (6.0, 0.0), (3.6, 8.0), (2.4, 8.0)];
    let inner = [(2.3, 3.1), (3.7, 3.1), (3.0, 6.0)];
    let mut pslg = chain(&scaled(&outer), true);
    append(&mut pslg, &chain(&scaled(&inner), true));
    pslg
}

fn letter_r() -> Pslg {
    let arc = |x: f64, y: f64, r: f64, n: u32| -> Vec<(f64, f64)> {
        (0..=n)
            .map(|i| {
                let (s, c) = (f64::from(i) / f64::from(n) * 0.5 * TAU - 0.25 * TAU).sin_cos();
                (x + r * c, y + r * s)
            })
            .collect()
    };
    let mut outer = vec![(0.0, 0.0), (1.2, 0.0), (1.2, 3.3), (2.4, 3.3), (4.4, 0.0), (5.8, 0.0), (3.6, 3.6)];
    outer.extend(arc(3.4, 5.8, 2.2, 9));
    outer.push((0.0, 8.0));
    let mut inner = vec![(1.2, 4.6)];
    inner.extend(arc(3.2, 5.7, 1.1, 7));
    inner.push((1.2, 6.8));
    let mut pslg = chain(&scaled(&outer), true);
    append(&mut pslg, &chain(&scaled(&inner), true));
    pslg
}

/// Two segments that meet at an angle, of lengths that differ.
pub fn wedge(angle_deg: f64, seed: u64) -> Pslg {
    let mut random = Random::new(seed);
    let turn = random.within(0.0, TAU);
    let ends = [0.0, angle_deg.to_radians()].map(|a| DVec2::from_angle(turn + a) * random.within(0.5, 1.0));
    chain(&[ends[0], DVec2::ZERO, ends[1]], false)
}

/// What [`needle`] knows.
pub const NEEDLES: [&str; 7] = ["open", "even", "nearly even", "closed", "blunt", "kite", "on the side"];

/// A frame of 8 by 6 with two segments in it, or a closed splinter, that meet at a
/// small angle. Every other one is parallel to the frame. A closed one has its
/// third side nearly along the others; a blunt one nearly across.
pub fn needle(name: &str, angle_deg: f64, seed: u64) -> Pslg {
    let mut random = Random::new(seed);
    let angle = angle_deg.to_radians();
    let mut pslg = chain(&[(0.0, 0.0), (8.0, 0.0), (8.0, 6.0), (0.0, 6.0)], true);
    if name == "on the side" {
        let (from, length) = (random.within(1.0, 3.0), random.within(1.0, 4.0));
        pslg.points.extend([DVec2::new(from, 0.0), DVec2::new(from + length, length * angle.tan())]);
        pslg.segments.push([4, 5]);
        return pslg;
    }
    let turn = if seed.is_multiple_of(2) { 0.0 } else { random.within(0.0, TAU) };
    let at = DVec2::new(random.within(3.0, 5.0), random.within(2.5, 3.5));
    let point = |length: f64, angle: f64| at + DVec2::from_angle(turn + angle) * length;
    let part = match name {
        "even" => 1.0 / angle.cos(),
        "nearly even" | "blunt" => 1.0 + angle * random.within(0.0, 4.0),
        _ => random.within(0.5, 1.0),
    };
    let ends = [point(1.0, 0.0), at, point(part, angle)];
    match name {
        "closed" | "blunt" => append(&mut pslg, &chain(&ends, true)),
        "kite" => {
            // The corner at the far end is no narrower.
            let far = point(part * random.within(1.5, 1.9), 0.5 * angle);
            append(&mut pslg, &chain(&[at, point(part, 0.0), far, point(part, angle)], true));
        }
        _ => append(&mut pslg, &chain(&ends, false)),
    }
    pslg
}

/// A needle without the frame around it; not one on its side.
pub fn without_frame(mut needle: Pslg) -> Pslg {
    needle.points.drain(..4);
    needle.segments.drain(..4);
    needle.segments.iter_mut().flatten().for_each(|p| *p -= 4);
    needle
}

/// Segments of different lengths from one point, evenly around it.
pub fn rays(n: u32, seed: u64) -> Pslg {
    let mut random = Random::new(seed);
    let turn = random.within(0.0, TAU);
    let mut pslg = Pslg::from_points(vec![DVec2::ZERO]);
    for i in 0..n {
        let direction = DVec2::from_angle(turn + f64::from(i) * TAU / f64::from(n));
        pslg.points.push(direction * random.within(0.5, 1.0));
        pslg.segments.push([0, i + 1]);
    }
    pslg
}

/// A closed curve of `6 * 2^k` segments, at least `least`: a hexagon whose sides
/// are divided again and again, each middle moved across by 4 to 11 per cent of
/// the length. A side and all that comes of it stay in a rhombus whose height to
/// either side is a quarter of the side, so that the curve does not cross itself.
pub fn coastline(least: usize, seed: u64) -> Pslg {
    let mut random = Random::new(seed);
    let mut points: Vec<DVec2> = (0..6).map(|i| DVec2::from_angle(f64::from(i) * TAU / 6.0)).collect();
    while points.len() < least {
        let n = points.len();
        points = (0..n)
            .flat_map(|i| {
                let (a, b) = (points[i], points[(i + 1) % n]);
                let across = random.within(0.04, 0.11) * if random.below(2) == 0 { 1.0 } else { -1.0 };
                [a, a.midpoint(b) + (b - a).perp() * across]
            })
            .collect();
    }
    chain(&points, true)
}

/// A small random PSLG: sometimes on a coarse grid, so that points coincide
/// and segments overlap, touch and cross.
pub fn random_graph(seed: u64) -> Pslg {
    let mut random = Random::new(seed ^ 0xabcd_ef01);
    let n = 2 + random.below(9);
    let grid = random.below(3) == 0;
    let thin = [1.0, 1.0, 0.3, 0.03][random.below(4) as usize];
    let mut pslg = Pslg::default();
    for _ in 0..n {
        let p = if grid {
            DVec2::new(random.below(5) as f64, random.below(5) as f64)
        } else {
            random.point(1.0) * DVec2::new(1.0, thin)
        };
        pslg.points.push(p);
    }
    for _ in 0..random.below(n + 3) {
        pslg.segments.push([random.below(n) as u32, random.below(n) as u32]);
    }
    if random.below(4) == 0 {
        pslg.holes.push(random.point(1.0));
    }
    pslg
}

/// How many triangles have all corners two edges or more away from points and
/// segments, and how many of those do not keep the bounds of the plain mesh.
pub fn far_triangles(made: &hexdel_pslg::PslgMesh) -> (u32, u32) {
    let mut ring = vec![u32::MAX; made.mesh.vertices.len()];
    for v in made.edges.iter().filter(|e| e.segment.is_some()).flat_map(|e| e.ends) {
        ring[v.index()] = 0;
    }
    for v in made.vertex_of_point.iter().flatten() {
        ring[v.index()] = 0;
    }
    for step in 1..3 {
        for t in &made.mesh.triangles {
            if t.iter().any(|v| ring[v.index()] == step - 1) {
                for v in t {
                    ring[v.index()] = ring[v.index()].min(step);
                }
            }
        }
    }
    let far = (0..made.mesh.triangles.len())
        .filter(|&t| made.mesh.triangles[t].iter().all(|v| ring[v.index()] >= 2));
    let least = AngleBounds::EXTENDED.min_deg() - 1e-9;
    far.fold((0, 0), |(far, out), t| {
        let angles = quality::angles_deg(made.mesh.corners(TriangleId::new(t)));
        (far + 1, out + u32::from(!angles.iter().all(|&a| a >= least && a <= 90.0 + 1e-9)))
    })
}

/// Whether a mesh is valid and has all points and segments of a PSLG in it,
/// if nothing was carved away.
pub fn check(pslg: &Pslg, made: &hexdel_pslg::PslgMesh) -> Result<(), String> {
    let c = &made.certificate;
    let faults = [
        (c.not_counter_clockwise, "triangles are not counter-clockwise"),
        (c.malformed + c.not_finite, "triangles are malformed"),
        (c.repeated_edges, "edges occur twice"),
        (c.unused_vertices, "vertices are unused"),
        (c.inputs - c.inputs_kept, "points are missing"),
    ];
    if let Some((n, what)) = faults.iter().find(|f| f.0 > 0) {
        return Err(format!("{n} {what}"));
    }
    for (i, &[a, b]) in pslg.segments.iter().enumerate() {
        let [from, to] = [a, b].map(|p| made.vertex_of_point[p as usize]);
        let (Some(from), Some(to)) = (from, to) else { return Err(format!("segment {i} has no end")) };
        let mut at = from;
        let [p, q] = [a, b].map(|p| pslg.points[p as usize]);
        for edge in made.edges.iter().filter(|e| e.segment == Some(i as u32)) {
            if edge.ends[0] != at {
                return Err(format!("segment {i} has a gap"));
            }
            at = edge.ends[1];
            let v = made.mesh.vertices[at.index()];
            let off = (q - p).perp_dot(v - p).abs() / p.distance(q);
            let last_place = v.abs().max_element().max(p.abs().max_element()) * f64::EPSILON;
            if off > 4.0 * last_place {
                return Err(format!("segment {i} is left by {off}"));
            }
        }
        if at != to {
            return Err(format!("segment {i} does not end"));
        }
    }
    Ok(())
}
