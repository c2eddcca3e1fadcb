use proptest::prelude::*;
use spade::{DelaunayTriangulation, Point2, Triangulation};

use super::*;

mod counts;

const WIDE: fn() -> AngleBounds = || AngleBounds::new(0.0, 180.0).unwrap();

fn mesh(vertices: &[[f64; 2]], triangles: &[[usize; 3]]) -> TriMesh {
    TriMesh {
        vertices: vertices.iter().map(|&p| p.into()).collect(),
        triangles: triangles.iter().map(|t| t.map(VertexId::new)).collect(),
    }
}

fn wide(mesh: &TriMesh) -> Certificate {
    certify(mesh, &CertifyOptions { bounds: WIDE(), ..CertifyOptions::default() })
}

/// Two triangles of the unit square and one more to the right.
fn sound() -> TriMesh {
    let vertices = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.75, 0.5]];
    mesh(&vertices, &[[0, 1, 2], [0, 2, 3], [1, 4, 2]])
}

/// A hexagon of equilateral triangles around vertex 0.
fn hexagon() -> TriMesh {
    let h = 0.75_f64.sqrt();
    let ring = [[1.0, 0.0], [0.5, h], [-0.5, h], [-1.0, 0.0], [-0.5, -h], [0.5, -h]];
    let vertices: Vec<_> = std::iter::once([0.0, 0.0]).chain(ring).collect();
    let triangles: Vec<_> = (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6]).collect();
    mesh(&vertices, &triangles)
}

fn spade_mesh(points: &[DVec2]) -> TriMesh {
    let points = points.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let delaunay = DelaunayTriangulation::<Point2<f64>>::bulk_load(points).unwrap();
    TriMesh {
        vertices: delaunay.vertices().map(|v| DVec2::new(v.position().x, v.position().y)).collect(),
        triangles: delaunay
            .inner_faces()
            .map(|f| f.vertices().map(|v| VertexId::new(v.fix().index())))
            .collect(),
    }
}

#[test]
fn a_sound_mesh_holds() {
    let c = wide(&sound());
    assert!(c.holds(), "{c:?}");
    assert_eq!((c.vertices, c.triangles, c.edges), (5, 3, 7));
    assert_eq!((c.boundary_edges, c.boundary_loops, c.euler_characteristic), (5, 1, 1));
    assert_eq!((c.min_angle_deg, c.max_angle_deg), (45.0, 90.0));
    assert!((c.shortest_edge - 0.8125_f64.sqrt()).abs() < 1e-15);
    assert!((c.max_aspect_ratio - 1.207_106_781_186_547_5).abs() < 1e-14);
    assert_eq!(c.violations, []);
    let c = certify(&hexagon(), &CertifyOptions::default());
    assert!(c.holds() && (c.max_aspect_ratio - 1.0).abs() < 1e-14);
}

/// One fault is enough, and none makes up for another.
#[test]
fn each_fault_alone_and_all_together_fail() {
    let sound = wide(&sound());
    let counts: [fn(&mut Certificate) -> &mut usize; 6] = [
        |c| &mut c.out_of_bounds,
        |c| &mut c.not_counter_clockwise,
        |c| &mut c.malformed,
        |c| &mut c.not_finite,
        |c| &mut c.stretched_triangles,
        |c| &mut c.short_triangles,
    ];
    for (i, one) in counts.iter().enumerate() {
        for other in &counts[i..] {
            let mut c = sound.clone();
            *one(&mut c) = 1;
            *other(&mut c) = 1;
            assert!(!c.holds(), "{c:?}");
            assert_eq!(c.min_edge_holds(), c.short_triangles == 0);
        }
    }
}

#[cfg(feature = "serde")]
#[test]
fn survives_json() {
    let mut m = sound();
    m.triangles[1].swap(0, 1);
    m.vertices[4] = DVec2::splat(f64::NAN);
    let c = wide(&m);
    assert!(c.violations.len() > 2 && c.not_finite == 1, "{c:?}");
    let text = serde_json::to_string(&c).unwrap();
    assert_eq!(serde_json::from_str::<Certificate>(&text).unwrap(), c);
}

#[test]
fn an_empty_mesh_is_no_disk() {
    let c = wide(&TriMesh::default());
    assert!(!c.holds() && !c.disk && c.manifold && c.delaunay);
    assert_eq!((c.min_angle_deg, c.max_angle_deg, c.shortest_edge), (0.0, 0.0, 0.0));
    let c = certify(&TriMesh::default(), &CertifyOptions { require_disk: false, ..Default::default() });
    assert!(c.holds());
}

#[test]
fn angles_out_of_bounds() {
    let m = mesh(&[[0.0, 0.0], [1.0, 0.0], [0.4, 0.45]], &[[0, 1, 2]]);
    let c = certify(&m, &CertifyOptions::default());
    assert_eq!((c.out_of_bounds, c.rounding_limited), (1, 0));
    // 95 degrees at corner 2 is 5 too many, 36.9 at corner 1 is 7 too few.
    let [Violation::AngleBelow { corner: 1, angle_deg, .. }] = c.violations[..] else { panic!("{c:?}") };
    assert!((angle_deg - 36.869_897_645_844_02).abs() < 1e-12 && c.min_angle_deg == angle_deg);
    assert!(!c.holds());
    let above = AngleBounds::new(30.0, 90.0).unwrap();
    let c = certify(&m, &CertifyOptions { bounds: above, ..Default::default() });
    assert!(matches!(c.violations[..], [Violation::AngleAbove { corner: 2, .. }]));
}

#[test]
fn angles_below_the_templates_exact_bound_are_counted() {
    // Right triangles with a smallest angle between 43.8978 and the exact bound, on it, and
    // above it.
    let right = |angle_deg: f64| {
        let m = mesh(&[[0.0, 0.0], [1.0, 0.0], [0.0, libm::tan(angle_deg.to_radians())]], &[[0, 1, 2]]);
        let c = certify(&m, &CertifyOptions::default());
        (c.holds(), c.below_exact_bound)
    };
    assert_eq!(right(43.8979), (true, Some(0)));
    assert_eq!(right(AngleBounds::EXACT_MIN_DEG), (true, Some(0)));
    assert_eq!(right(43.89785), (true, Some(1)));
    assert_eq!(right(43.8), (false, Some(1)));
    assert_eq!(wide(&sound()).below_exact_bound, None);
}

#[test]
fn the_aspect_ratio_is_held_against_the_bound_that_the_angles_imply() {
    // The worst triangle within the bounds has the largest ratio allowed.
    let low = AngleBounds::EXTENDED.min_deg().to_radians();
    let m = mesh(&[[0.0, 0.0], [1.0, 0.0], [0.0, libm::tan(low)]], &[[0, 1, 2]]);
    let c = certify(&m, &CertifyOptions::default());
    let bound = c.max_aspect_bound.unwrap();
    assert!(c.holds() && c.stretched_triangles == 0 && (c.max_aspect_ratio - bound).abs() < 1e-9, "{c:?}");
    assert!((bound - 1.207_87).abs() < 1e-6);
    // One that is out of bounds is counted as that.
    let m = mesh(&[[0.0, 0.0], [1.0, 0.0], [0.4, 0.45]], &[[0, 1, 2]]);
    let c = certify(&m, &CertifyOptions::default());
    assert_eq!((c.out_of_bounds, c.stretched_triangles), (1, 0));
    assert!(c.max_aspect_ratio > bound);
    assert_eq!(wide(&sound()).max_aspect_bound, None);
}

#[test]
fn tolerance_and_rounding() {
    // The angle at the origin is 90 degrees and `past` times the tolerance.
    let tilted = |past: f64, at: f64, size: f64| {
        let lean = size * (past * ANGLE_TOLERANCE_DEG).to_radians();
        let m = mesh(&[[at, at], [at + size, at], [at - lean, at + size]], &[[0, 1, 2]]);
        let c = certify(&m, &CertifyOptions::default());
        (c.out_of_bounds, c.rounding_limited, c.holds())
    };
    assert_eq!(tilted(0.9, 0.0, 1.0), (0, 0, true));
    assert_eq!(tilted(1.1, 0.0, 1.0), (1, 0, false));
    // Far from the origin an ulp of 1.2e-10 is 7e-7 degrees over 0.01.
    assert_eq!(tilted(1e3, 1e6, 0.01), (0, 1, true));
    assert_eq!(tilted(1e5, 1e6, 0.01), (1, 0, false));
}

#[test]
fn rounding_excuses_what_rounding_does() {
    // Right triangles at random places, rounded: none may count as wrong.
    let mut limited = 0;
    for i in 0..2000 {
        let (sin, cos) = libm::sincos(f64::from(i));
        let at = DVec2::new(123_456.7 + f64::from(i), -98_765.4);
        let (u, w) = (DVec2::new(cos, sin) * 1e-3, DVec2::new(-sin, cos) * 0.8e-3);
        let corners = [at, at + u, at + w];
        match triangles::check_angles(corners, AngleBounds::new(0.0, 90.0).unwrap()) {
            triangles::Fit::Within => {}
            triangles::Fit::RoundingLimited { excess_deg } => {
                limited += 1;
                // Half an ulp of 1.5e-11 over 1e-3, in three points.
                assert!(excess_deg < 5e-6);
            }
            triangles::Fit::Outside { .. } => panic!("{corners:?}"),
        }
    }
    assert!(limited > 500, "{limited}");
}

#[test]
fn flipped_and_degenerate_triangles() {
    let mut m = hexagon();
    m.triangles[2].swap(1, 2);
    let c = wide(&m);
    assert_eq!(c.not_counter_clockwise, 1);
    assert!(matches!(c.violations[0], Violation::NotCounterClockwise { .. }));
    assert!(c.repeated_edges > 0 && !c.manifold && !c.holds());
    assert!(c.min_angle_deg < -59.0);
    let flat = mesh(&[[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]], &[[0, 1, 2]]);
    let exactly = orientation(&flat);
    assert_eq!(wide(&flat).not_counter_clockwise, usize::from(exactly <= 0.0));
}

/// Near a line the sign of a cross product in doubles is what rounding makes of it, in large triangles and in small ones.
#[test]
fn orientation_is_exact_where_rounding_lies() {
    let mut lies = 0;
    for i in 0..3000_u32 {
        let part = |k: f64| libm::sin(f64::from(i) * k).abs();
        let scale = 2f64.powi([-40, 0, 40][i as usize % 3]);
        let (a, b) = (DVec2::new(part(1.1), part(2.3)), DVec2::new(part(3.7), part(4.9)));
        let [a, b, c] = [a, b, a + part(5.3) * (b - a)].map(|p| scale * p);
        let m = mesh(&[a.into(), b.into(), c.into()], &[[0, 1, 2]]);
        let clockwise = orientation(&m) <= 0.0;
        lies += usize::from(clockwise == ((b - a).perp_dot(c - a) > 0.0));
        assert_eq!(wide(&m).not_counter_clockwise, usize::from(clockwise), "{a} {b} {c}");
    }
    assert!(lies > 300, "{lies}");
}

fn orientation(m: &TriMesh) -> f64 {
    crate::orient2d(m.vertices[0], m.vertices[1], m.vertices[2])
}

#[test]
fn duplicate_triangle() {
    let mut m = sound();
    m.triangles.push(m.triangles[2]);
    let c = wide(&m);
    assert_eq!((c.repeated_edges, c.edges), (3, 7));
    assert!(!c.manifold && !c.holds());
    let named =
        |v: &Violation| matches!(v, Violation::RepeatedEdge { triangle, .. } if triangle.index() == 3);
    assert_eq!(c.violations.iter().filter(|v| named(v)).count(), 3);
}

/// Time must not be quadratic in the triangles at a vertex.
#[test]
fn a_crowded_vertex() {
    let n = 200_000;
    let spokes: Vec<DVec2> = (0..n)
        .map(|i| libm::sincos(f64::from(i) * 3.0 / f64::from(n)))
        .map(|(sin, cos)| DVec2::new(cos, sin))
        .collect();
    let vertices = std::iter::once(DVec2::ZERO).chain(spokes).collect();
    let fan = (1..n as usize).map(|i| [0, i, i + 1].map(VertexId::new));
    let mut m = TriMesh { vertices, triangles: fan.collect() };
    let c = wide(&m);
    assert!(c.manifold && c.disk && c.edges == 2 * n as usize - 1);
    m.triangles.extend(vec![m.triangles[7]; n as usize]);
    let c = wide(&m);
    assert_eq!((c.repeated_edges, c.edges), (3 * n as usize, 2 * n as usize - 1));
}

#[test]
fn three_triangles_on_an_edge() {
    let m = mesh(
        &[[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, -1.0], [0.5, 0.5]],
        &[[0, 1, 2], [1, 0, 3], [0, 1, 4]],
    );
    let c = wide(&m);
    assert_eq!((c.repeated_edges, c.edges), (1, 7));
    assert!(!c.holds());
}

#[test]
fn hole_and_two_components() {
    let mut annulus = hexagon();
    // Subdivide so that the hole's edges are not on the outer boundary.
    annulus.vertices = (0..12)
        .map(|i| {
            let (sin, cos) = libm::sincos(f64::from(i % 6) * std::f64::consts::FRAC_PI_3);
            DVec2::new(cos, sin) * if i < 6 { 1.0 } else { 2.0 }
        })
        .collect();
    annulus.triangles = (0..6)
        .flat_map(|i| {
            let j = (i + 1) % 6;
            [[i, i + 6, j], [j, i + 6, j + 6]].map(|t| t.map(VertexId::new))
        })
        .collect();
    let c = wide(&annulus);
    assert!(c.manifold && !c.disk && !c.holds());
    assert_eq!((c.boundary_loops, c.euler_characteristic), (2, 0));

    let mut two = hexagon();
    let n = two.vertices.len();
    two.vertices.extend(hexagon().vertices.iter().map(|p| *p + DVec2::X * 9.0));
    two.triangles.extend(hexagon().triangles.iter().map(|t| t.map(|v| VertexId::new(v.index() + n))));
    let c = wide(&two);
    assert!(c.manifold && !c.disk);
    assert_eq!((c.boundary_loops, c.euler_characteristic), (2, 2));
    let c = certify(&two, &CertifyOptions { require_disk: false, ..Default::default() });
    assert!(c.holds());
}

#[test]
fn bow_tie() {
    let m = mesh(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0]], &[[0, 1, 2], [0, 3, 4]]);
    let c = wide(&m);
    assert_eq!((c.branching_vertices, c.repeated_edges, c.boundary_loops), (1, 0, 1));
    assert!(matches!(c.violations[..], [Violation::BranchingVertex { vertex, .. }] if vertex.index() == 0));
    assert!(!c.manifold && !c.holds());
}

#[test]
fn edges_at_a_branching_vertex_are_delaunay_or_not_if_two_triangles_share_them() {
    // The sum of the angles opposite the edge 0-2 is more than 300 degrees.
    let kite = [[0.0, 0.0], [1.0, -0.2], [2.0, 0.0], [1.0, 0.2]];
    let vertices = [&kite[..], &[[-1.0, 0.5], [-1.0, -0.5], [1.0, 0.6]]].concat();
    let mut triangles = vec![[0, 1, 2], [0, 2, 3], [0, 4, 5]];
    let c = wide(&mesh(&vertices[..6], &triangles));
    assert_eq!((c.branching_vertices, c.repeated_edges, c.non_delaunay_edges), (1, 0, 1));
    triangles.push([0, 2, 6]);
    let c = wide(&mesh(&vertices, &triangles));
    assert_eq!((c.repeated_edges, c.non_delaunay_edges), (1, 0));
}

#[test]
fn malformed_triangles_do_not_count_for_the_euler_characteristic() {
    let mut m = sound();
    let whole = wide(&m);
    m.triangles.push([0, 0, 1].map(VertexId::new));
    let c = wide(&m);
    assert_eq!((c.malformed, c.euler_characteristic, c.disk), (1, whole.euler_characteristic, false));
}

/// Its Euler characteristic is that of a disk.
#[test]
fn a_disk_and_an_annulus_are_no_disk() {
    let outer = [[0.0, 0.0], [6.0, 0.0], [3.0, 5.0]];
    let inner = [[2.0, 1.0], [4.0, 1.0], [3.0, 2.0]];
    let apart = [[10.0, 0.0], [11.0, 0.0], [10.0, 1.0]];
    let vertices = [outer, inner, apart].concat();
    let ring = [[0, 1, 3], [3, 1, 4], [1, 2, 4], [4, 2, 5], [2, 0, 5], [5, 0, 3]];
    let m = mesh(&vertices, &[&ring[..], &[[6, 7, 8]]].concat());
    let c = wide(&m);
    assert_eq!((c.manifold, c.euler_characteristic, c.boundary_loops, c.disk), (true, 1, 3, false));
}

#[test]
fn t_junction() {
    // Vertex 4 lies on the edge 0-2 of the first triangle.
    let m = mesh(
        &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.5]],
        &[[0, 1, 2], [0, 4, 3], [4, 2, 3]],
    );
    let c = wide(&m);
    assert!(!c.holds() && !c.disk, "{c:?}");
    // The slit 0-2, 2-4, 4-0 touches the outer boundary.
    assert_eq!((c.branching_vertices, c.boundary_edges), (2, 7));
}

#[test]
fn missing_inputs_and_unused_vertices() {
    let mut m = sound();
    let inputs = [DVec2::new(-0.0, 1.0), DVec2::new(1.0_f64.next_up(), 0.0), DVec2::ONE, DVec2::ONE];
    let request = CertifyOptions { bounds: WIDE(), inputs: Some(&inputs), ..Default::default() };
    let c = certify(&m, &request);
    assert_eq!((c.inputs, c.inputs_kept), (4, 3));
    assert_eq!(c.violations, [Violation::InputMissing { input: 1, at: inputs[1] }]);
    assert!(!c.holds());
    m.vertices.push(DVec2::splat(3.0));
    let c = wide(&m);
    assert_eq!(c.violations, [Violation::UnusedVertex { vertex: VertexId::new(5) }]);
    assert!(!c.manifold && !c.holds() && c.euler_characteristic == 1);
}

#[test]
fn bad_indices_and_coordinates() {
    let mut m = sound();
    m.triangles.push([VertexId::new(1), VertexId::new(2), VertexId::new(u32::MAX as usize)]);
    m.triangles.push([VertexId::new(3), VertexId::new(0), VertexId::new(3)]);
    m.vertices[4] = DVec2::new(f64::NEG_INFINITY, 0.0);
    let c = wide(&m);
    assert_eq!((c.malformed, c.not_finite), (2, 1));
    assert!(matches!(c.violations[..], [
        Violation::CornerNotFinite { vertex, .. },
        Violation::CornerOutOfRange { corner: 2, .. },
        Violation::RepeatedCorner { .. },
    ] if vertex.index() == 4));
    assert!(!c.holds());
    for twice in [[3, 3, 0], [0, 3, 3], [3, 0, 3]] {
        let c = wide(&mesh(&[[0.0, 0.0]; 4], &[twice]));
        let named = Violation::RepeatedCorner { triangle: TriangleId::new(0), vertex: VertexId::new(3) };
        assert_eq!(c.violations[0], named);
    }
    let lone = TriMesh { vertices: Vec::new(), triangles: m.triangles };
    assert_eq!(wide(&lone).malformed, 5);
}

#[test]
fn short_edges() {
    let holds = |min_edge: f64| {
        let c = certify(&hexagon(), &CertifyOptions { min_edge: Some(min_edge), ..Default::default() });
        (c.short_triangles, c.holds())
    };
    assert_eq!(holds(1.0), (0, true));
    assert_eq!(holds(1.0 + 1e-9), (6, false));
    assert_eq!(holds(f64::NAN), (6, false));
    assert_eq!(holds(1.0 + 0.5 * LENGTH_TOLERANCE), (0, true));
    assert_eq!(holds(1.0 + 2.0 * LENGTH_TOLERANCE), (6, false));
    // A clockwise one is looked at more closely.
    let mut clockwise = hexagon();
    clockwise.triangles = vec![[0, 2, 1].map(VertexId::new)];
    let short = |more: f64| {
        let min_edge = Some(1.0 + more * LENGTH_TOLERANCE);
        certify(&clockwise, &CertifyOptions { min_edge, ..Default::default() }).short_triangles
    };
    assert_eq!([short(0.5), short(2.0)], [0, 1]);
}

/// Extreme coordinates are scaled for the arithmetic, and told as they are.
#[test]
fn short_edges_are_told_in_units_of_the_mesh() {
    for unit in [2f64.powi(-200), 1.0, 2f64.powi(200)] {
        let vertices = [[0.0, 0.0], [1.5 * unit, 0.0], [0.0, 2.0 * unit]];
        let request = CertifyOptions { bounds: WIDE(), min_edge: Some(1.75 * unit), ..Default::default() };
        let c = certify(&mesh(&vertices, &[[0, 1, 2]]), &request);
        let [Violation::EdgeTooShort { length, corners, .. }] = c.violations[..] else { panic!("{c:?}") };
        assert_eq!((length, corners), (1.5 * unit, vertices.map(DVec2::from)));
    }
}

/// Coordinates around 1e6 are rounded to 1.2e-10: half of that both ways at both ends, twice, is 3.3e-10.
#[test]
fn edges_that_rounding_has_shortened_are_not_too_short() {
    let m = mesh(&[[1e6, 1e6], [1e6 + 0.25, 1e6], [1e6, 1e6 + 0.5]], &[[0, 1, 2]]);
    let short = |more: f64| {
        let bounds = WIDE();
        certify(&m, &CertifyOptions { bounds, min_edge: Some(0.25 + more), ..Default::default() })
            .short_triangles
    };
    assert_eq!([short(2.5e-10), short(4e-10)], [0, 1]);
}

#[test]
fn flat_triangles_have_a_shortest_edge_and_nothing_to_be_too_short_for() {
    for turn in 0..3 {
        let mut line = [[1.0, 1.0], [4.0, 4.0], [6.0, 6.0]];
        line.rotate_left(turn);
        let c = wide(&mesh(&line, &[[0, 1, 2]]));
        assert!((c.shortest_edge - 8.0_f64.sqrt()).abs() < 1e-14, "{c:?}");
    }
    let c = wide(&mesh(&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0]], &[[0, 1, 2]]));
    assert_eq!((c.not_counter_clockwise, c.short_triangles, c.shortest_edge), (1, 0, 0.0));
}

#[test]
fn one_ulp_from_delaunay() {
    let mut m = sound();
    m.vertices[3].y = 1.0_f64.next_down();
    let c = wide(&m);
    assert_eq!(c.non_delaunay_edges, 1);
    assert!(matches!(c.violations[..], [Violation::NotDelaunay { .. }]));
    assert!(!c.delaunay && !c.holds());
    m.vertices[3].y = 1.0_f64.next_up();
    assert!(wide(&m).delaunay);
}

#[test]
fn extreme_magnitudes() {
    for scale in [1e-300, 1e-160, 1e160, 1e300] {
        let mut m = hexagon();
        m.vertices.iter_mut().for_each(|p| *p *= scale);
        let c = certify(&m, &CertifyOptions::default());
        assert!(c.holds(), "{scale}: {c:?}");
        assert!((c.shortest_edge / scale - 1.0).abs() < 1e-12);
        m.vertices[0] = DVec2::new(0.0, 0.9 * scale);
        let c = certify(&m, &CertifyOptions::default());
        assert!(c.not_counter_clockwise == 1 && !c.holds(), "{c:?}");
    }
}

#[test]
fn the_list_is_capped_and_the_counts_are_not() {
    let m = mesh(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[[0, 2, 1]; 300]);
    let c = wide(&m);
    assert_eq!((c.not_counter_clockwise, c.violations.len()), (300, 100));
    let c = certify(&m, &CertifyOptions { max_violations: 0, ..Default::default() });
    assert_eq!((c.not_counter_clockwise, c.violations.len()), (300, 0));
}

#[test]
fn threads_make_no_difference() {
    let points: Vec<DVec2> = (0..20_000)
        .map(|i| DVec2::new(libm::sin(f64::from(i) * 12.9898) * 437.0 % 1.0, f64::from(i) * 0.618_034 % 1.0))
        .collect();
    let mut m = spade_mesh(&points);
    for t in (0..m.triangles.len()).step_by(997) {
        m.triangles[t].rotate_left(1);
        m.triangles[t].swap(0, t % 3);
    }
    let request = CertifyOptions { inputs: Some(&points), ..Default::default() };
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| certify(&m, &request))
    };
    let one = run(1);
    assert!(one.out_of_bounds > 0 && one.repeated_edges > 0);
    assert_eq!(one, run(2));
    assert_eq!(one, run(7));
}

proptest! {
    /// The Delaunay triangulation of another library is one, and no longer if
    /// an edge is flipped.
    #[test]
    fn agrees_with_spade(raw in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64), 3..200)) {
        let points: Vec<DVec2> = raw.iter().map(|&(x, y)| DVec2::new(x, y)).collect();
        let mut m = spade_mesh(&points);
        prop_assume!(!m.triangles.is_empty());
        let request = CertifyOptions { bounds: WIDE(), inputs: Some(&points), ..Default::default() };
        let c = certify(&m, &request);
        prop_assert!(c.holds(), "{:?}", c);
        let angles = (0..m.triangles.len())
            .flat_map(|t| crate::quality::angles_deg(m.corners(TriangleId::new(t))));
        let least = angles.clone().fold(f64::INFINITY, f64::min);
        prop_assert!((c.min_angle_deg - least).abs() < 1e-9);
        prop_assert!((c.max_angle_deg - angles.fold(0.0, f64::max)).abs() < 1e-9);
        let edge = m.triangles.iter().enumerate().find_map(|(i, &[a, b, c])| {
            m.triangles[..i].iter().position(|t| (0..3).any(|k| t[k] == c && t[(k + 1) % 3] == a)).map(|j| (i, j, a, b, c))
        });
        if let Some((i, j, a, b, c)) = edge {
            let d = *m.triangles[j].iter().find(|&&v| v != a && v != c).unwrap();
            m.triangles[i] = [a, b, d];
            m.triangles[j] = [b, c, d];
            // A quadrilateral that is not convex has a clockwise triangle now.
            let broken = certify(&m, &request);
            prop_assert!(!broken.holds());
            prop_assert!(broken.non_delaunay_edges + broken.not_counter_clockwise > 0);
        }
    }

    /// Whatever the indices and coordinates, there is a certificate.
    #[test]
    fn never_panics(
        vertices in prop::collection::vec(prop::array::uniform2(prop::num::f64::ANY), 0..8),
        triangles in prop::collection::vec(prop::array::uniform3(0_usize..9), 0..40),
    ) {
        let m = mesh(&vertices, &triangles);
        let request = CertifyOptions { inputs: Some(&m.vertices), min_edge: Some(0.1), ..Default::default() };
        let c = certify(&m, &request);
        prop_assert_eq!(c.inputs_kept, m.vertices.len());
        prop_assert!(triangles.len() < 2 || !c.holds() || c.out_of_bounds == 0);
    }
}
