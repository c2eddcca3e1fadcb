use super::*;

const SEEDS: std::ops::Range<u64> = 0..5;
const COUNTS: [usize; 8] = [0, 1, 2, 3, 10, 99, 900, 2000];

#[test]
fn every_kind_gives_as_many_distinct_finite_points_as_asked() {
    for kind in Kind::ALL {
        for (n, seed) in COUNTS.into_iter().flat_map(|n| SEEDS.map(move |seed| (n, seed))) {
            let mut points = generate(kind, n, seed);
            assert_eq!(points.len(), n, "{kind} {n} {seed}");
            assert!(points.iter().all(|p| p.is_finite()), "{kind} {n} {seed}");
            points.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
            points.dedup();
            assert_eq!(points.len(), n, "duplicates in {kind} {n} {seed}");
        }
    }
}

#[test]
fn seeds_and_kinds_are_unrelated() {
    for kind in Kind::ALL {
        let (one, other) = (generate(kind, 50, 1), generate(kind, 50, 2));
        assert_eq!(one == other, kind == Kind::Grid, "{kind}");
    }
    let uniform = generate(Kind::Uniform, 50, 1);
    let line = generate(Kind::Line, 50, 1);
    assert_ne!(uniform[0].x, line[0].x);
}

/// The bits of the points as FNV-1a (Fowler, Noll, Vo), to pin them down on
/// every platform the tests run on.
fn fingerprint(points: &[DVec2]) -> u64 {
    let bytes = points.iter().flat_map(|p| [p.x, p.y]).flat_map(|c| c.to_bits().to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[test]
fn the_bits_are_pinned() {
    let found = Kind::ALL.map(|kind| (kind, fingerprint(&generate(kind, 500, 7))));
    let pinned = [
        (Kind::Uniform, 17_585_240_047_543_785_556),
        (Kind::Line, 16_972_934_691_067_477_120),
        (Kind::Clusters, 3_152_706_471_465_963_745),
        (Kind::Grid, 11_975_494_970_410_104_848),
        (Kind::Jittered, 8_538_055_379_714_405_310),
        (Kind::Circle, 11_297_740_985_786_479_266),
        (Kind::Spiral, 5_267_427_928_356_252_043),
        (Kind::Pairs, 2_503_755_654_378_314_097),
        (Kind::Contrast, 6_113_173_884_042_568_353),
    ];
    assert_eq!(found, pinned);
}

#[test]
fn names_parse_back() {
    for kind in Kind::ALL {
        assert_eq!(kind.to_string().parse(), Ok(kind));
    }
    let error = "hexagons".parse::<Kind>().unwrap_err();
    assert_eq!(error.name, "hexagons");
    assert!(error.to_string().contains("uniform, line, clusters"), "{error}");
}

fn spread(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), v| (min.min(v), max.max(v)))
}

#[test]
fn grid_is_the_exact_lattice() {
    let points = generate(Kind::Grid, 900, 0);
    assert_eq!(points[31], DVec2::new(1.0 / 30.0, 1.0 / 30.0));
    assert_eq!(lattice_side(900), 30);
    assert_eq!(lattice_side(901), 31);
    for (p, q) in points.iter().zip(generate(Kind::Jittered, 900, 3)) {
        let moved = (q - *p).abs().max_element();
        assert!(moved <= 0.25 / 30.0 + 1e-15, "{moved}");
    }
}

#[test]
fn pairs_span_two_decades() {
    let points = generate(Kind::Pairs, 2001, 3);
    let (min, max) = spread(points.chunks_exact(2).map(|p| p[0].distance(p[1])));
    assert!((1e-4 * 0.999..1.2e-4).contains(&min), "{min}");
    assert!((0.8e-2..1e-2 * 1.001).contains(&max), "{max}");
}

#[test]
fn contrast_spans_six_decades() {
    let points = generate(Kind::Contrast, 2000, 3);
    let (min, max) = spread(points.iter().map(|p| p.length()));
    assert!((1e-6 * 0.999..1.2e-6).contains(&min), "{min}");
    assert!((0.8..1.001).contains(&max), "{max}");
    let inner = points.iter().filter(|p| p.length() < 1e-3).count();
    assert!((900..1100).contains(&inner), "{inner}");
}

#[test]
fn curves_keep_their_shape() {
    let centre = DVec2::splat(0.5);
    for p in generate(Kind::Circle, 500, 1) {
        // Each coordinate is rounded a few times at magnitude below 1.
        assert!((p.distance(centre) - 0.5).abs() < 4.0 * f64::EPSILON, "{p}");
    }
    let spiral = generate(Kind::Spiral, 500, 1);
    assert!(spiral.windows(2).all(|w| w[0].distance(centre) < w[1].distance(centre)));
    assert!(generate(Kind::Line, 500, 1).iter().all(|p| p.y == 0.5));
}

#[test]
fn clusters_are_denser_than_uniform() {
    let points = generate(Kind::Clusters, 1000, 1);
    let own: f64 = (0..900).map(|i| points[i].distance(points[i + 10])).sum();
    // Points ten apart share one of the ten clusters: their mean distance is
    // sqrt(pi) deviations, 0.035, against 0.52 in the unit square.
    assert!((0.030..0.041).contains(&(own / 900.0)), "{}", own / 900.0);
}
