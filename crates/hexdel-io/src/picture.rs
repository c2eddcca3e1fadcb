//! How a picture of a mesh looks, and what is drawn over it.

use crate::error::WriteError;
use hexdel_geom::DVec2;

/// Options of a picture.
///
/// # Examples
///
/// ```
/// let mut picture = hexdel_io::Picture::default();
/// picture.size_px = 400.0;
/// picture.angle_range_deg = [43.9, 60.0];
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Picture<'a> {
    /// Length of the longer side of the drawing without legend, pixels; kept
    /// between 16 and 100,000.
    pub size_px: f64,
    /// The smallest angles that the two ends of the colour scale stand for,
    /// degrees. Triangles below have a colour of their own.
    pub angle_range_deg: [f64; 2],
    /// Whether triangles are filled with the colour of their smallest angle.
    pub fill_triangles: bool,
    /// Whether edges are drawn.
    pub edges: bool,
    /// Whether input points are drawn, as far as the mesh view names them.
    pub input_points: bool,
    /// Polygons over the filled triangles, translucent, or under the edges if
    /// triangles are not filled.
    pub overlay: Option<&'a Overlay>,
}

impl Default for Picture<'_> {
    fn default() -> Self {
        Self {
            size_px: 1000.0,
            angle_range_deg: [30.0, 60.0],
            fill_triangles: true,
            edges: true,
            input_points: true,
            overlay: None,
        }
    }
}

/// Polygons with a legend.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// What stands above the legend.
    pub title: String,
    /// What polygons are told apart by.
    pub classes: Vec<OverlayClass>,
    /// The polygons, later ones of the same class and level above earlier ones.
    pub polygons: Vec<Polygon>,
}

/// A line of the legend of an [`Overlay`].
#[derive(Clone, Debug, PartialEq)]
pub struct OverlayClass {
    /// What the legend says.
    pub label: String,
    /// The colour of the polygons of the highest level.
    pub colour: Rgb,
}

/// A filled polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// The corners in order, in the coordinates of the mesh.
    pub corners: Vec<DVec2>,
    /// Index of its class in [`Overlay::classes`].
    pub class: usize,
    /// Its level: the higher, the darker.
    pub level: u32,
}

/// A colour: red, green and blue, 0 to 255.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

impl Rgb {
    /// The colour between `self` at 0 and `other` at 1.
    pub(crate) fn mix(self, other: Self, t: f64) -> Self {
        let channel = |i: usize| {
            let (from, to) = (f64::from(self.0[i]), f64::from(other.0[i]));
            (from + (to - from) * t).round() as u8
        };
        Self([channel(0), channel(1), channel(2)])
    }

    pub(crate) fn hex(self) -> String {
        let [r, g, b] = self.0;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// Colours of a scale from 0 to 1: five evenly spaced samples of viridis
/// (Smith and van der Walt 2015), which is even to the eye, also without colour
/// vision.
const SCALE: [Rgb; 5] = [
    Rgb([0x44, 0x01, 0x54]),
    Rgb([0x3b, 0x52, 0x8b]),
    Rgb([0x21, 0x91, 0x8c]),
    Rgb([0x5e, 0xc9, 0x62]),
    Rgb([0xfd, 0xe7, 0x25]),
];

/// The colour of the scale at `t` in 0 to 1.
pub(crate) fn scale_colour(t: f64) -> Rgb {
    let position = t.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
    let below = (position as usize).min(SCALE.len() - 2);
    SCALE[below].mix(SCALE[below + 1], position - below as f64)
}

impl Picture<'_> {
    pub(crate) fn check(&self, file: &str) -> Result<(), WriteError> {
        let Some(overlay) = self.overlay else {
            return Ok(());
        };
        let count = overlay.classes.len();
        for (index, polygon) in overlay.polygons.iter().enumerate() {
            if polygon.class >= count {
                return Err(WriteError::IndexOutOfRange {
                    file: file.to_owned(),
                    item: "polygon",
                    index,
                    target: polygon.class,
                    count,
                });
            }
            if let Some(p) = polygon.corners.iter().find(|p| !p.is_finite()) {
                return Err(WriteError::NonFinite {
                    file: file.to_owned(),
                    item: "polygon",
                    index,
                    x: p.x,
                    y: p.y,
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_passes_its_samples() {
        for (i, colour) in SCALE.into_iter().enumerate() {
            assert_eq!(scale_colour(i as f64 / 4.0), colour);
        }
        assert_eq!(scale_colour(-1.0), SCALE[0]);
        assert_eq!(scale_colour(7.0), SCALE[4]);
        assert_eq!(scale_colour(0.125), Rgb([0x40, 0x2a, 0x70]));
        assert_eq!(Rgb([1, 2, 255]).hex(), "#0102ff");
    }
}
