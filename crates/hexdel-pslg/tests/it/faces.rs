//! Areas by attribute of random polygons, against boolean operations of `i_overlay`.
//!
//! `HEXDEL_POLYGON_SETS=10000` sets how many sets of polygons are tried.

#![allow(clippy::print_stderr, reason = "the count is to be seen with --nocapture")]

use crate::support::Random;
use hexdel_geom::{DVec2, Polygon, Pslg, Unwatched};
use hexdel_pslg::{Extent, Options, PslgError, Validated, mesh, repair, validate};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use std::collections::BTreeMap;

type Ring = Vec<[f64; 2]>;
type Shapes = Vec<Vec<Ring>>;

/// A polygon: its outer ring and its holes.
type Rings = Vec<Ring>;

/// One set in so many is meshed, too.
const MESHED: u64 = 50;

/// What areas may differ by, of a square of 1600.
const TOLERANCE: f64 = 1e-5;

#[test]
fn attributes_follow_faces() {
    let sets = std::env::var("HEXDEL_POLYGON_SETS").ok().and_then(|n| n.parse().ok()).unwrap_or(300);
    let (mut meshed, mut overlapping) = (0, 0);
    for seed in 0..sets {
        let mut random = Random::new(seed);
        let polygons = polygons(&mut random);
        let graph = graph(&polygons, &mut random);
        let expected = by_overlay(&polygons);
        let (mended, report) = repair(&graph, 0.0).unwrap();
        assert!(report.complete, "seed {seed}");
        let (seeded, cover) = validate(&mended).unwrap().seeded(Extent::Inside);
        overlapping += u64::from(!cover.overlaps.is_empty());
        let areas = seeded.areas(Extent::Inside);
        let regions = seeded.pslg().regions.iter().zip(&areas.of_region);
        let found = sums(regions.map(|(region, &area)| (region.attribute, area)));
        assert!(areas.of_none.abs() < TOLERANCE, "seed {seed}: {areas:?}");
        compare(seed, "faces", &expected, &found);
        let unused = seeded.unused_seeds(Extent::Inside);
        assert!(unused.is_empty(), "seed {seed}: {unused:?}");
        if seed % MESHED == 0 {
            meshed += u64::from(meshes_as(seed, &seeded, &expected));
        }
    }
    eprintln!("{sets} sets, {overlapping} with overlaps; {meshed} meshed");
    assert!(overlapping > sets / 4 && meshed > sets / MESHED / 2);
}

/// Meshes a PSLG, if that takes no more triangles than it should here.
fn meshes_as(seed: u64, seeded: &Validated, expected: &BTreeMap<u64, f64>) -> bool {
    let options = Options::new().extent(Extent::Inside).compact(None).retries(0).max_triangles(100_000);
    let made = match mesh(seeded, &options, &Unwatched) {
        Ok(made) => made,
        Err(PslgError::TooMany { .. } | PslgError::TooClose { .. }) => return false,
        Err(PslgError::NothingEnclosed { .. }) => return true,
        Err(error) => panic!("seed {seed}: {error}"),
    };
    let triangles = made.mesh.triangles.iter().zip(&made.region_of_triangle);
    let found = sums(triangles.map(|(corners, region)| {
        let [a, b, c] = corners.map(|v| made.mesh.vertices[v.index()]);
        let attribute = region.map_or(0.0, |r| seeded.pslg().regions[r as usize].attribute);
        (attribute, 0.5 * (b - a).perp_dot(c - a))
    }));
    compare(seed, "mesh", expected, &found);
    true
}

#[track_caller]
fn compare(seed: u64, what: &str, expected: &BTreeMap<u64, f64>, found: &BTreeMap<u64, f64>) {
    for attribute in expected.keys().chain(found.keys()) {
        let [e, f] = [expected, found].map(|areas| areas.get(attribute).copied().unwrap_or(0.0));
        assert!((e - f).abs() < TOLERANCE, "seed {seed}, {what}: {expected:?} expected, {found:?} found");
    }
}

fn sums(areas: impl Iterator<Item = (f64, f64)>) -> BTreeMap<u64, f64> {
    let mut sums = BTreeMap::new();
    areas.for_each(|(attribute, area)| *sums.entry(attribute as u64).or_insert(0.0) += area);
    sums
}

/// The area of each attribute: the later polygon wins.
fn by_overlay(polygons: &[(Rings, f64)]) -> BTreeMap<u64, f64> {
    let mut taken: Shapes = Vec::new();
    let mut areas = BTreeMap::new();
    let nothing: Shapes = Vec::new();
    for (rings, attribute) in polygons.iter().rev() {
        let mut shape = vec![vec![rings[0].clone()]];
        shape = shape.overlay_as::<i64>(&nothing, OverlayRule::Subject, FillRule::EvenOdd);
        for hole in &rings[1..] {
            shape = shape.overlay_as::<i64>(hole, OverlayRule::Difference, FillRule::EvenOdd);
        }
        let own = shape.overlay_as::<i64>(&taken, OverlayRule::Difference, FillRule::EvenOdd);
        *areas.entry(*attribute as u64).or_insert(0.0) += area(&own);
        taken = taken.overlay_as::<i64>(&shape, OverlayRule::Union, FillRule::EvenOdd);
    }
    areas
}

/// Outer rings are counter-clockwise, holes clockwise, or the other way round.
fn area(shapes: &Shapes) -> f64 {
    let ring = |ring: &Ring| {
        let next = ring.iter().skip(1).chain(ring.first());
        0.5 * ring.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
    };
    shapes.iter().map(|shape| shape.iter().map(ring).sum::<f64>().abs()).sum()
}

/// One to six polygons: apart, nested, overlapping, touching, the same; some of them
/// cross themselves.
fn polygons(random: &mut Random) -> Vec<(Rings, f64)> {
    let mut all: Vec<(Rings, f64)> = Vec::new();
    for attribute in 1..=1 + random.below(6) {
        let mut rings = vec![ring(random, &all)];
        for _ in 0..random.below(4) {
            rings.push(hole(random, &rings));
        }
        // Some features have several parts.
        let attribute = if random.below(5) == 0 { attribute.max(2) - 1 } else { attribute };
        all.push((rings, attribute as f64));
    }
    all
}

fn ring(random: &mut Random, before: &[(Rings, f64)]) -> Ring {
    let place = |random: &mut Random| [0, 1].map(|_| random.below(41) as f64);
    let corners: Vec<[f64; 2]> =
        before.iter().flat_map(|(rings, _)| rings.iter().flatten().copied()).collect();
    match random.below(8) {
        0 | 1 => rectangle(place(random), [0, 1].map(|_| (1 + random.below(20)) as f64)),
        2 | 3 => {
            let n = 3 + random.below(7);
            star(random, place, n)
        }
        // As some of the corners of others have it.
        4 if corners.len() > 3 => {
            (0..3 + random.below(3)).map(|_| corners[random.below(corners.len() as u64) as usize]).collect()
        }
        5 if !before.is_empty() => {
            before[random.below(before.len() as u64) as usize].0.last().unwrap().clone()
        }
        // Two squares that touch in a corner, in one go.
        6 => {
            let [x, y] = place(random);
            let s = (1 + random.below(9)) as f64;
            vec![
                [x, y],
                [x + s, y],
                [x + s, y + s],
                [x + 2.0 * s, y + s],
                [x + 2.0 * s, y + 2.0 * s],
                [x + s, y + 2.0 * s],
                [x + s, y + s],
                [x, y + s],
            ]
        }
        _ => (0..3 + random.below(5)).map(|_| place(random)).collect(),
    }
}

fn hole(random: &mut Random, rings: &[Ring]) -> Ring {
    let outer = &rings[0];
    match random.below(4) {
        // At a corner of the outer ring.
        0 => rectangle(outer[random.below(outer.len() as u64) as usize], [1.0, 2.0]),
        1 => rings.last().unwrap().clone(),
        _ => {
            let [a, b, c] = [0, 1, 2].map(|_| outer[random.below(outer.len() as u64) as usize]);
            let middle = [0, 1].map(|k| ((a[k] + b[k] + c[k]) / 3.0).round());
            rectangle(middle, [0, 1].map(|_| (1 + random.below(6)) as f64))
        }
    }
}

fn rectangle([x, y]: [f64; 2], [w, h]: [f64; 2]) -> Ring {
    vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]]
}

fn star(random: &mut Random, place: impl Fn(&mut Random) -> [f64; 2], n: u64) -> Ring {
    let centre = place(random);
    let mut ring: Ring = (0..n).map(|_| place(random)).collect();
    let angle = |p: &[f64; 2]| (p[1] - centre[1] - 0.3).atan2(p[0] - centre[0] - 0.4);
    ring.sort_by(|p, q| angle(p).total_cmp(&angle(q)));
    ring
}

/// The PSLG of polygons, with points and segments once each, and some lines.
fn graph(polygons: &[(Rings, f64)], random: &mut Random) -> Pslg {
    let mut graph = Pslg::default();
    for (rings, attribute) in polygons {
        let rings = rings.iter().map(|ring| path(&mut graph, ring, true)).collect();
        graph.polygons.push(Polygon { rings, attribute: *attribute, max_area: None });
    }
    for _ in 0..random.below(3) {
        let line: Ring = (0..3).map(|_| [0, 1].map(|_| random.below(41) as f64)).collect();
        path(&mut graph, &line, false);
    }
    graph
}

fn path(graph: &mut Pslg, corners: &[[f64; 2]], closed: bool) -> Vec<u32> {
    let mut point = |p: [f64; 2]| {
        let p = DVec2::from(p);
        let known = graph.points.iter().position(|&q| q == p);
        known.unwrap_or_else(|| {
            graph.points.push(p);
            graph.points.len() - 1
        }) as u32
    };
    let points: Vec<u32> = corners.iter().map(|&p| point(p)).collect();
    let ends = points.iter().zip(points.iter().skip(1).chain(points.first())).map(|(&a, &b)| [a, b]);
    let mut segments = Vec::new();
    for [a, b] in ends.take(if closed { points.len() } else { points.len() - 1 }).filter(|[a, b]| a != b) {
        let known = graph.segments.iter().position(|&s| s == [a, b] || s == [b, a]);
        segments.push(known.unwrap_or(graph.segments.len()) as u32);
        if known.is_none() {
            graph.segments.push([a, b]);
        }
    }
    segments
}
