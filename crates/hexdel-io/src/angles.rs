//! Angles of a triangle for display.
//!
//! Accurate to a few units in the last place and the same on every platform; no
//! verdict on a mesh rests on them, that is the certificate's business.

use hexdel_geom::DVec2;

/// The angles of a triangle at its corners, degrees; zeros for coincident corners.
pub(crate) fn angles_deg(corners: [DVec2; 3]) -> [f64; 3] {
    // Halved before the subtraction and scaled after it, no difference overflows
    // and no product under- or overflows that matters.
    let [a, b, c] = corners.map(|p| p * 0.5);
    let sides = [b - a, c - b, a - c];
    let scale = sides.iter().map(|s| s.abs().max_element()).fold(0.0, f64::max);
    if scale == 0.0 {
        return [0.0; 3];
    }
    let [ab, bc, ca] = sides.map(|s| s / scale);
    [between(ab, -ca), between(bc, -ab), between(ca, -bc)]
}

/// The smallest and the largest of them.
pub(crate) fn angle_range_deg(corners: [DVec2; 3]) -> [f64; 2] {
    let [x, y, z] = angles_deg(corners);
    [x.min(y).min(z), x.max(y).max(z)]
}

/// The angle between two directions, degrees.
fn between(u: DVec2, v: DVec2) -> f64 {
    libm::atan2(u.perp_dot(v).abs(), u.dot(v)).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_triangles() {
        let half_height = 3f64.sqrt() / 2.0;
        let equilateral = [DVec2::ZERO, DVec2::X, DVec2::new(0.5, half_height)];
        let right = [DVec2::ZERO, DVec2::X, DVec2::Y];
        for scale in [1.0, 1e-200, 1e200, 1e308] {
            let [min, max] = angle_range_deg(equilateral.map(|p| p * scale));
            assert!((min - 60.0).abs() < 1e-12 && (max - 60.0).abs() < 1e-12);
            let [min, max] = angle_range_deg(right.map(|p| p * scale));
            assert!((min - 45.0).abs() < 1e-12 && (max - 90.0).abs() < 1e-12);
        }
    }

    #[test]
    fn degenerate_triangles() {
        let flat = [DVec2::ZERO, DVec2::X, DVec2::X * 2.0];
        assert_eq!(angle_range_deg(flat), [0.0, 180.0]);
        assert_eq!(angle_range_deg([DVec2::X; 3]), [0.0, 0.0]);
    }
}
