//! Angles of a triangle for display.
//!
//! Accurate to a few units in the last place and the same on every platform; no
//! verdict on a mesh rests on them, that is the certificate's business.

use hexdel_geom::DVec2;
use hexdel_geom::quality::unsigned_angles_deg;

/// The smallest and the largest angle of a triangle, degrees; zeros for coincident corners.
pub(crate) fn angle_range_deg(corners: [DVec2; 3]) -> [f64; 2] {
    let [x, y, z] = unsigned_angles_deg(corners);
    [x.min(y).min(z), x.max(y).max(z)]
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
