//! What a picture says of the triangles in view: their colours, and the angles of
//! all of them.

use crate::canvas::Place;
use crate::colour::{BEYOND, Rgb, palette};
use crate::frame::Frame;
use crate::histogram::Histogram;
use crate::picture::ColourBy;
use crate::plot::Plot;
use hexdel_geom::TriangleId;
use hexdel_geom::quality::unsigned_angles_deg;
use std::cmp::Reverse;

/// Colours that the scale is cut into; steps are below what the eye tells apart.
const SHADES: u32 = 64;

/// The shade of triangles beyond the scale.
const BEYOND_SHADE: u32 = SHADES;

/// An angle is beyond a bound by more than this, degrees: far above what is lost
/// in computing it, far below what can be seen.
const TOLERANCE_DEG: f64 = 1e-6;

/// A triangle in view and how it is drawn. The order is that of drawing: large
/// triangles first so that the fine lines of small ones are on top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Look {
    pub(crate) size: Reverse<u8>,
    /// Index of its colour in [`Survey::colours`].
    pub(crate) shade: u32,
    pub(crate) triangle: u32,
}

/// The triangles in view.
pub(crate) struct Survey {
    /// In the order of drawing.
    pub(crate) looks: Vec<Look>,
    pub(crate) colours: Vec<Rgb>,
    /// How many triangles have each colour.
    pub(crate) counts: Vec<usize>,
    /// The smallest and the largest angle in view, degrees.
    pub(crate) angles_deg: [f64; 2],
    pub(crate) histogram: Histogram,
    /// The attributes of regions, if they are what colours say.
    pub(crate) regions: Vec<f64>,
}

impl Survey {
    pub(crate) fn new(plot: &Plot<'_>, frame: &Frame) -> Self {
        let regions = regions(plot);
        let colours = colours(plot.picture.colour_by, regions.len());
        let mut survey = Self {
            looks: Vec::new(),
            counts: vec![0; colours.len()],
            colours,
            angles_deg: [180.0, 0.0],
            histogram: Histogram::default(),
            regions,
        };
        let mut places = Vec::new();
        for triangle in 0..plot.mesh.triangles.len() {
            let corners = plot.mesh.corners(TriangleId::new(triangle));
            if !frame.shows(&corners) {
                continue;
            }
            let angles = unsigned_angles_deg(corners);
            let shade = survey.shade(plot, triangle, angles);
            frame.polygon(&corners, &mut places);
            let size = Reverse(size_class(&places));
            survey.looks.push(Look { size, shade, triangle: triangle as u32 });
            survey.counts[shade as usize] += 1;
            for angle in angles {
                survey.histogram.add(angle);
                let [min, max] = survey.angles_deg;
                survey.angles_deg = [min.min(angle), max.max(angle)];
            }
        }
        survey.looks.sort_unstable();
        survey
    }

    /// How many triangles have an angle beyond the scale, where colours are angles.
    pub(crate) fn beyond(&self) -> usize {
        self.counts[BEYOND_SHADE as usize]
    }

    fn shade(&self, plot: &Plot<'_>, triangle: usize, angles: [f64; 3]) -> u32 {
        let [low, high] = plot.picture.bounds_deg;
        let fold = |f: fn(f64, f64) -> f64| f(f(angles[0], angles[1]), angles[2]);
        match plot.picture.colour_by {
            ColourBy::SmallestAngle => on_scale(fold(f64::min), low),
            ColourBy::LargestAngle => on_scale(fold(f64::max), high),
            ColourBy::Region => {
                let region = plot.regions.map_or(0.0, |regions| regions[triangle]);
                self.regions.partition_point(|r| r.total_cmp(&region).is_lt()) as u32
            }
            ColourBy::Groups(groups) => groups.of_triangle[triangle],
        }
    }
}

/// The shade of an angle on the scale from a bound to 60 degrees.
fn on_scale(angle: f64, bound: f64) -> u32 {
    let beyond = if bound < 60.0 { bound - angle } else { angle - bound };
    if beyond > TOLERANCE_DEG {
        return BEYOND_SHADE;
    }
    let t = ((angle - bound) / (60.0 - bound)).clamp(0.0, 1.0);
    ((t * f64::from(SHADES)) as u32).min(SHADES - 1)
}

/// The attributes of all regions in order, if colours are to tell them apart.
fn regions(plot: &Plot<'_>) -> Vec<f64> {
    if plot.picture.colour_by != ColourBy::Region {
        return Vec::new();
    }
    let mut regions = plot.regions.unwrap_or_default().to_vec();
    regions.sort_unstable_by(f64::total_cmp);
    regions.dedup_by(|a, b| a.total_cmp(b).is_eq());
    regions
}

fn colours(by: ColourBy<'_>, regions: usize) -> Vec<Rgb> {
    match by {
        ColourBy::SmallestAngle | ColourBy::LargestAngle => {
            let scale = (0..SHADES).map(|i| Rgb::of_scale((f64::from(i) + 0.5) / f64::from(SHADES)));
            scale.chain([BEYOND]).collect()
        }
        ColourBy::Region => (0..regions).map(palette).collect(),
        ColourBy::Groups(groups) => groups.classes.iter().map(|class| class.colour).collect(),
    }
}

/// The binary logarithm of a polygon's size in hundredths of a pixel, where size
/// is the side of a square of twice its area. In integers, as a logarithm of floats
/// would differ between platforms.
fn size_class(places: &[Place]) -> u8 {
    // Sizes of a third of a pixel and below, and of 20 pixels and above, are drawn
    // alike.
    const CLASSES: std::ops::RangeInclusive<u32> = 5..=11;
    let Some(&[x, y]) = places.first() else {
        return *CLASSES.start() as u8;
    };
    let cross = |pair: &[Place]| {
        let ([ux, uy], [vx, vy]) = ([pair[0][0] - x, pair[0][1] - y], [pair[1][0] - x, pair[1][1] - y]);
        ux * vy - uy * vx
    };
    let twice_area = places.windows(2).map(cross).sum::<i64>().unsigned_abs().max(1);
    (twice_area.ilog2() / 2).clamp(*CLASSES.start(), *CLASSES.end()) as u8
}

impl Look {
    /// The width of edges in hundredths of a pixel, a thirty-second of the size:
    /// edges take up about a tenth of the area in coarse and in fine parts of a mesh.
    pub(crate) fn line_width(&self) -> i64 {
        1 << (self.size.0 - 5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::{DVec2, TriMesh, VertexId};

    #[test]
    fn lines_are_a_thirty_second_of_the_triangle() {
        let right = |leg: i64| [[7, -9], [7 + leg, -9], [7, leg - 9]];
        let width =
            |places: &[Place]| Look { size: Reverse(size_class(places)), shade: 0, triangle: 0 }.line_width();
        for (leg, expected) in [(1, 1), (63, 1), (64, 2), (320, 8), (2048, 64), (1 << 30, 64)] {
            assert_eq!(width(&right(leg)), expected, "{leg}");
            let [a, b, c] = right(leg);
            assert_eq!(width(&[a, c, b]), expected, "{leg}");
        }
    }

    #[test]
    fn three_angles_are_counted_per_triangle_in_view() {
        let vertices = (0..9).map(|i| DVec2::new(f64::from(i % 3), f64::from(i / 3))).collect();
        let cells = [0, 1, 3, 4].into_iter();
        let halves = cells.flat_map(|i| [[i, i + 1, i + 4], [i, i + 4, i + 3]]);
        let mesh = TriMesh { vertices, triangles: halves.map(|t| t.map(VertexId::new)).collect() };
        let mut plot = Plot::new(&mesh);
        for (zoom, triangles) in [
            (None, 8),
            (Some([DVec2::ZERO, DVec2::ONE]), 2),
            (Some([DVec2::new(0.6, 0.1), DVec2::new(0.9, 0.4)]), 1),
            (Some([DVec2::splat(-9.0), DVec2::splat(9.0)]), 8),
        ] {
            plot.picture.zoom = zoom;
            let survey = Survey::new(&plot, &Frame::new(&plot, 1000.0));
            assert_eq!(survey.looks.len(), triangles);
            assert_eq!(survey.counts.iter().sum::<usize>(), triangles);
            assert_eq!(survey.histogram.total(), 3 * triangles as u64);
            assert_eq!(survey.histogram.at(45), 2 * triangles as u64);
            assert_eq!(survey.histogram.at(90), triangles as u64);
        }
    }

    #[test]
    fn the_scale_ends_at_the_bounds() {
        for (angle, bound, shade) in [
            (43.9, 43.9, 0),
            (43.9 - 1e-9, 43.9, 0),
            (43.8, 43.9, BEYOND_SHADE),
            (60.0, 43.9, SHADES - 1),
            (90.0 + 1e-9, 90.0, 0),
            (90.1, 90.0, BEYOND_SHADE),
            (60.0, 90.0, SHADES - 1),
            (75.0, 90.0, SHADES / 2),
            (60.0, 60.0, 0),
        ] {
            assert_eq!(on_scale(angle, bound), shade, "{angle} {bound}");
        }
    }
}
