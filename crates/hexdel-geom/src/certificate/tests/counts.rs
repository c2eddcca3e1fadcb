//! What is counted and listed: stretched triangles, violations up to the cap, meshes of several chunks.

use super::*;

/// The verdict on a triangle that is `past` times the tolerance past both of the default bounds, so as stretched
/// as can be: out of bounds, limited by rounding, stretched, whether it all holds.
fn past_both_bounds(past: f64, at: f64, size: f64) -> (usize, usize, usize, bool) {
    let [low, high] = [43.8978 - past * ANGLE_TOLERANCE_DEG, 90.0 + past * ANGLE_TOLERANCE_DEG];
    let at = DVec2::splat(at);
    let side = size * libm::sin(low.to_radians()) / libm::sin((180.0 - low - high).to_radians());
    let (sin, cos) = libm::sincos(high.to_radians());
    let corners = [at, at + DVec2::new(size, 0.0), at + side * DVec2::new(cos, sin)];
    let c = certify(&mesh(&corners.map(DVec2::into), &[[0, 1, 2]]), &CertifyOptions::default());
    (c.out_of_bounds, c.rounding_limited, c.stretched_triangles, c.holds())
}

/// Neither within a thousandth of the tolerance nor where rounding of an ulp of 1.2e-10 is all that is wrong.
#[test]
fn what_the_angles_are_granted_the_aspect_ratio_is_granted_too() {
    assert_eq!(past_both_bounds(0.999, 0.0, 1.0), (0, 0, 0, true));
    assert_eq!(past_both_bounds(1.001, 0.0, 1.0), (1, 0, 0, false));
    assert_eq!(past_both_bounds(1e3, 1e6, 0.01), (0, 1, 0, true));
}

/// Squares of lengths of `unit` are the smallest positive double: sides of 1.4 and 1.23 units have the same square,
/// and the angles of 41 and 49 degrees look like 45. Lengths themselves are as exact as any.
#[test]
fn a_triangle_whose_angles_look_better_than_they_are_is_stretched() {
    let unit = 2f64.powi(-537);
    // The large triangle keeps coordinates from being scaled.
    let vertices = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.4 * unit, 0.0], [0.0, 1.23 * unit]];
    let small = [0, 3, 4].map(|v| DVec2::from(vertices[v]));
    assert_eq!(crate::quality::angles_deg(small), [90.0, 45.0, 45.0]);
    let c = certify(&mesh(&vertices, &[[0, 1, 2], [0, 3, 4]]), &CertifyOptions::default());
    assert_eq!((c.out_of_bounds, c.stretched_triangles, c.holds()), (0, 1, false));
    let Violation::AspectAbove { triangle, aspect_ratio, corners } = c.violations[0] else { panic!("{c:?}") };
    assert_eq!((triangle.index(), corners), (1, small));
    // Circumradius over twice the inradius, in units.
    let hypotenuse = 1.4_f64.hypot(1.23);
    assert!((aspect_ratio - 0.5 * hypotenuse / (1.4 + 1.23 - hypotenuse)).abs() < 1e-12, "{aspect_ratio}");
    // Bounds that allow such a ratio are kept by it.
    let bounds = AngleBounds::new(40.0, 90.0).unwrap();
    let c =
        certify(&mesh(&vertices, &[[0, 1, 2], [0, 3, 4]]), &CertifyOptions { bounds, ..Default::default() });
    assert_eq!(c.stretched_triangles, 0);
}

/// It is counter-clockwise by `d^2`, which is lost in doubles: the ratio is infinite, and so is the bound.
#[test]
fn without_a_bound_on_angles_no_triangle_is_stretched_however_thin() {
    let d = 2f64.powi(-30);
    let thin = mesh(&[[0.0, 0.0], [1.0 - d, 1.0], [1.0 - 2.0 * d, 1.0 - d]], &[[0, 1, 2]]);
    assert!(orientation(&thin) > 0.0);
    let c = wide(&thin);
    assert_eq!((c.max_aspect_ratio, c.stretched_triangles, c.holds()), (f64::INFINITY, 0, true));
}

/// Triangles and vertices are handled a chunk at a time.
#[test]
fn the_list_is_the_beginning_of_all_violations_in_order_whatever_the_cap() {
    let n = 2 * CHUNK + 3;
    let m = mesh(&vec![[0.0, 0.0]; n], &vec![[7, 7, 9]; n]);
    let repeated = |i| Violation::RepeatedCorner { triangle: TriangleId::new(i), vertex: VertexId::new(7) };
    let unused = |i| Violation::UnusedVertex { vertex: VertexId::new(i) };
    let all: Vec<Violation> = (0..n).map(repeated).chain((0..n).map(unused)).collect();
    for max_violations in
        [0, 1, CHUNK - 1, CHUNK, CHUNK + 1, n - 1, n, n + 1, n + CHUNK + 1, 2 * n, 2 * n + 1, usize::MAX]
    {
        let c = certify(&m, &CertifyOptions { max_violations, ..Default::default() });
        assert_eq!((c.malformed, c.unused_vertices), (n, n));
        assert!(c.violations == all[..max_violations.min(2 * n)], "{max_violations}");
    }
}
