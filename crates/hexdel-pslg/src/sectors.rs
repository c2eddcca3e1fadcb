//! Corners of the input that are narrower than the bound.

use crate::net::Net;
use crate::validate::Piece;
use hexdel_geom::{DVec2, quality};
use std::f64::consts::TAU;

/// A corner between two neighbouring pieces at a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sector {
    pub(crate) site: u32,
    /// Less than the bound.
    pub(crate) angle_deg: f64,
}

/// All sectors narrower than `least_deg`.
pub(crate) fn narrow_sectors(sites: &[DVec2], pieces: &[Piece], least_deg: f64) -> Vec<Sector> {
    let mut rays: Vec<(u32, f64)> = pieces
        .iter()
        .flat_map(|piece| {
            let [a, b] = piece.ends;
            let direction = |from: u32, to: u32| {
                let u = sites[to as usize] - sites[from as usize];
                (from, libm_atan2(u))
            };
            [direction(a, b), direction(b, a)]
        })
        .collect();
    rays.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut sectors = Vec::new();
    for group in rays.chunk_by(|a, b| a.0 == b.0) {
        if group.len() < 2 {
            continue;
        }
        for (i, ray) in group.iter().enumerate() {
            let next = group[(i + 1) % group.len()].1;
            let angle_deg = (next - ray.1).rem_euclid(TAU).to_degrees();
            if angle_deg < least_deg {
                sectors.push(Sector { site: ray.0, angle_deg });
            }
        }
    }
    sectors
}

/// The direction of a vector, by the portable arc tangent of the angles.
fn libm_atan2(u: DVec2) -> f64 {
    quality::angles_rad([DVec2::ZERO, DVec2::X * u.length(), u])[0]
}

/// The sector that may be blamed for a triangle's angles, and how far away it
/// is.
///
/// At a distance `r` from the corner the sector is `r sin(angle)` wide; where
/// that is less than an edge nothing between its sides can have good angles.
/// A few edges beyond that the mesh has found back to its own size.
pub(crate) fn sector_near(net: &Net, t: u32, sectors: &[Sector], sites: &[DVec2]) -> Option<(Sector, f64)> {
    let [a, b, c] = net.corners(t);
    let centre = (a + b + c) / 3.0;
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    sectors
        .iter()
        .map(|s| (*s, sites[s.site as usize].distance(centre)))
        .filter(|(s, distance)| *distance <= longest * (3.0 + 1.0 / s.angle_deg.to_radians().sin()))
        .min_by(|x, y| x.1.total_cmp(&y.1))
}
