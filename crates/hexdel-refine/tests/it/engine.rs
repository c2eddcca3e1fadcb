//! What the engine promises: every rule holds afterwards, whatever the points,
//! and the result does not depend on threads.

use hexdel_classify::{Domain, Dual, Relocation, extract};
use hexdel_geom::{AngleBounds, DVec2, TriangleId, Unwatched};
use hexdel_grid::{Address, Hex, Lattice};
use hexdel_refine::{RefineError, Refiner, RuleSet};
use proptest::prelude::*;

/// A lattice around the points, as wide as callers choose it.
fn lattice(points: &[DVec2]) -> Lattice {
    let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    let reach = if low == high { 1.0 } else { (high - low).length() };
    Lattice::new((low + high) / 2.0, 2.0 * reach)
}

fn rules(extended: bool) -> RuleSet {
    if extended { RuleSet::extended() } else { RuleSet::simple() }
}

fn refined(points: &[DVec2], extended: bool, coarsening: bool, batch: usize) -> Refiner {
    let mut refiner = Refiner::new(lattice(points), rules(extended)).with_coarsening(coarsening);
    for some in points.chunks(batch) {
        refiner.insert(some, &Unwatched).expect("the points are far enough apart");
        assert_eq!(refiner.violation(), None);
    }
    refiner
}

fn dual(refiner: &mut Refiner, extended: bool) -> Dual {
    let domain = Domain::around(refiner.grid(), 0).expect("no point lies above level 0");
    let occupants = refiner.occupants();
    let relocation = if extended { Relocation::Full } else { Relocation::Occupied };
    extract(refiner.grid_mut(), &occupants, domain, relocation, &Unwatched).expect("the mesh is small")
}

/// Every rule holds, the grid is balanced, every point is a vertex bit by bit,
/// and every angle keeps the bounds.
fn check(points: &[DVec2], batch: usize) {
    for (extended, coarsening) in [(true, true), (true, false), (false, true), (false, false)] {
        let mut refiner = refined(points, extended, coarsening, batch);
        assert_eq!(refiner.grid().unbalanced(), None);
        let dual = dual(&mut refiner, extended);
        for (point, vertex) in points.iter().zip(&dual.vertex_of_occupant) {
            assert_eq!(dual.mesh.vertices[vertex.index()], *point);
        }
        let bounds = if extended { AngleBounds::EXTENDED } else { AngleBounds::SIMPLE };
        for t in 0..dual.mesh.triangles.len() {
            for angle in angles_deg(dual.mesh.corners(TriangleId::new(t))) {
                // Coordinates near 1 are rounded by 1e-16; the shortest edges,
                // between points 1e-9 apart, are about 1e-10 long.
                let slack = 1e-4;
                let inside = bounds.min_deg() - slack..=bounds.max_deg() + slack;
                assert!(inside.contains(&angle), "triangle {t}: {angle}");
            }
        }
    }
}

fn angles_deg(p: [DVec2; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let (u, w) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
        u.perp_dot(w).atan2(u.dot(w)).to_degrees()
    })
}

/// Without those that are there already.
fn distinct(points: impl IntoIterator<Item = DVec2>) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::new();
    for p in points {
        if !kept.contains(&p) {
            kept.push(p);
        }
    }
    kept
}

fn points(n: std::ops::Range<usize>) -> impl Strategy<Value = Vec<DVec2>> {
    let point = (-1.0..1.0_f64, -1.0..1.0_f64).prop_map(DVec2::from);
    proptest::collection::vec(point, n).prop_map(distinct)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn rules_hold_around_random_points(points in points(1..60), batch in 1..60_usize) {
        check(&points, batch);
    }

    #[test]
    fn rules_hold_around_clusters(
        centres in points(1..4),
        offsets in points(1..15),
        shrink in 1..8_i32,
        batch in 1..60_usize,
    ) {
        let scale = 10.0_f64.powi(-shrink);
        let all = centres.iter().flat_map(|c| offsets.iter().map(move |o| *c + *o * scale));
        check(&distinct(all), batch);
    }

    #[test]
    fn rules_hold_along_a_line(direction in 0.0..3.0_f64, n in 2..40, batch in 1..40_usize) {
        let along = DVec2::from_angle(direction);
        check(&(0..n).map(|i| along * f64::from(i)).collect::<Vec<_>>(), batch);
    }

    #[test]
    fn rules_hold_on_lattices(columns in 1..7, rows in 1..7, skew in 0.0..1.0_f64, batch in 1..40_usize) {
        let at = |i: i32| (f64::from(i % columns), f64::from(i / columns));
        let point = |(x, y): (f64, f64)| DVec2::new(x + skew * y, y);
        check(&(0..columns * rows).map(at).map(point).collect::<Vec<_>>(), batch);
    }

    #[test]
    fn rules_hold_around_points_that_nearly_coincide(
        places in points(1..6),
        angle in 0.0..6.0_f64,
        exponent in 3..10_i32,
    ) {
        let apart = DVec2::from_angle(angle) * 10.0_f64.powi(-exponent);
        check(&distinct(places.into_iter().flat_map(|p| [p, p + apart])), 100);
    }
}

#[test]
fn points_one_by_one_and_all_at_once_are_both_obeyed() {
    let points = scattered(150);
    for batch in [1, 7, 150] {
        check(&points, batch);
    }
}

#[test]
fn points_that_no_level_tells_apart_are_named() {
    let close = [DVec2::new(1.0, 0.0), DVec2::new(0.5, 0.5), DVec2::new(0.5, 0.5_f64.next_up())];
    let mut refiner = Refiner::new(Lattice::new(DVec2::ZERO, 1e4), RuleSet::extended());
    match refiner.insert(&close, &Unwatched) {
        Err(RefineError::TooClose { site, point, .. }) => {
            assert!(site == 1 || site == 2);
            assert_eq!(point, close[site]);
        }
        other => panic!("{other:?}"),
    }
}

/// Points without pattern, of uneven density.
fn scattered(n: u32) -> Vec<DVec2> {
    let unit = |i: u32, by: f64| (f64::from(i) * by).fract();
    (0..n)
        .map(|i| {
            DVec2::from_angle(std::f64::consts::TAU * unit(i, 0.754_877_666)) * unit(i, 0.569_840_291).powi(3)
        })
        .collect()
}

#[test]
fn the_same_bytes_at_one_two_and_eight_threads() {
    let points = scattered(3000);
    for extended in [true, false] {
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("threads can be started").install(|| {
                let mut refiner = Refiner::new(lattice(&points), rules(extended));
                for some in points.chunks(2000) {
                    refiner.insert(some, &Unwatched).expect("the points are far enough apart");
                }
                dual(&mut refiner, extended)
            })
        };
        let one = run(1);
        let bits = |dual: &Dual| -> Vec<_> {
            dual.mesh.vertices.iter().map(|v| (v.x.to_bits(), v.y.to_bits())).collect()
        };
        for threads in [2, 8] {
            let many = run(threads);
            assert_eq!(bits(&one), bits(&many));
            assert_eq!(one.mesh.triangles, many.mesh.triangles);
            assert_eq!(one.vertex_of_occupant, many.vertex_of_occupant);
        }
    }
}

/// By how many steps the closure of some hexagons of a level leaves the
/// smallest lattice hexagon around them, over all six sides.
fn excess_of_closure(seeds: &[Hex]) -> i64 {
    const LEVEL: u8 = 7;
    let mut refiner =
        Refiner::new(Lattice::new(DVec2::ZERO, 1.0), RuleSet::extended()).with_coarsening(false);
    let seeds_at = seeds.iter().map(|&hex| Address::new(LEVEL, hex));
    refiner.subdivide_all(seeds_at, &Unwatched).expect("there are levels enough");
    assert_eq!(refiner.violation(), None);
    let closure: Vec<Hex> =
        refiner.grid().subdivided().filter(|at| at.level == LEVEL).map(|at| at.hex).collect();
    assert!(closure.len() >= seeds.len());
    let sides = [|h: &Hex| h.q, |h: &Hex| h.r, |h: &Hex| h.q + h.r];
    let excess = sides.into_iter().flat_map(|x| {
        let reach = |set: &[Hex], sign: i64| set.iter().map(|h| sign * x(h)).max().unwrap_or(0);
        [1, -1].map(|sign| reach(&closure, sign) - reach(seeds, sign))
    });
    excess.max().unwrap_or(0)
}

#[test]
fn a_level_closes_about_within_the_hexagon_around_what_it_began_with() {
    let mut worst = 0;
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    for i in 0..300 {
        let (radius, share) = (3 + i % 9, 1 + u64::from(i / 9 % 12));
        let mut pick = |_: &Hex| {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            (random >> 33) % 13 < share
        };
        // Discs, rings and arcs with holes in them.
        let from = if i % 2 == 0 { 0 } else { radius - radius.min(2) };
        let seeds: Vec<Hex> = (from..=radius).flat_map(|n| Hex::ORIGIN.ring(n)).filter(&mut pick).collect();
        if !seeds.is_empty() {
            worst = worst.max(excess_of_closure(&seeds));
        }
    }
    assert!(worst <= 2, "{worst} steps out");
}
