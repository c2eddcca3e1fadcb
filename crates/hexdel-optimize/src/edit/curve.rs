//! A curve that fills the plane: what is near along it is near in memory.

use hexdel_geom::DVec2;

/// Bits of each coordinate.
const BITS: u32 = 16;

/// The rectangle that the curve fills.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    low: DVec2,
    scale: f64,
}

impl Frame {
    /// The frame of some points.
    pub fn of(points: &[DVec2]) -> Self {
        let low = points.iter().fold(DVec2::INFINITY, |m, p| m.min(*p));
        let high = points.iter().fold(DVec2::NEG_INFINITY, |m, p| m.max(*p));
        let side = (high - low).max_element();
        let steps = f64::from((1_u32 << BITS) - 1);
        Self { low, scale: if side > 0.0 { steps / side } else { 0.0 } }
    }

    /// How far along the Hilbert curve a point is.
    pub fn along(&self, p: DVec2) -> u32 {
        let q = (p - self.low) * self.scale;
        hilbert(q.x as u32, q.y as u32)
    }

    /// The indices of points along the curve; those at the same place by index.
    pub fn order(&self, points: &[DVec2]) -> Vec<u32> {
        let mut keys: Vec<(u32, u32)> = points.iter().zip(0..).map(|(p, i)| (self.along(*p), i)).collect();
        keys.sort_unstable();
        keys.into_iter().map(|(_, i)| i).collect()
    }
}

/// The place of a cell of a grid of `2^16` by `2^16` cells along the Hilbert curve.
fn hilbert(x: u32, y: u32) -> u32 {
    let most = (1 << BITS) - 1;
    let (mut x, mut y) = (x.min(most), y.min(most));
    let mut d = 0;
    let mut s = 1 << (BITS - 1);
    while s > 0 {
        let (rx, ry) = (u32::from(x & s > 0), u32::from(y & s > 0));
        d += s * s * ((3 * rx) ^ ry);
        if ry == 0 {
            if rx == 1 {
                (x, y) = (most - x, most - y);
            }
            std::mem::swap(&mut x, &mut y);
        }
        s >>= 1;
    }
    d
}
