//! Where the mesh lies in a picture: from its coordinates to pixels, and what of
//! it is in view.
//!
//! Places are hundredths of a pixel, y downwards. A picture that shows a box of
//! the mesh only is drawn from polygons cut a little outside of it, so that no
//! coordinate is far from the page; what is outside is then covered.

use crate::canvas::Place;
use crate::picture::Picture;
use crate::plot::Plot;
use hexdel_geom::DVec2;

/// White space around drawing and legend, pixels of a picture of ordinary size.
const MARGIN: f64 = 12.0;

/// How far beyond the box polygons are cut, pixels: more than half an edge's
/// width, less than the margin.
const BEYOND: f64 = 4.0;

/// Pictures larger than this have larger letters.
const ORDINARY_SIZE: f64 = 1000.0;

/// The map from coordinates of the mesh to pixels.
pub(crate) struct Frame {
    /// Half the left and upper border of the drawing, in units of the mesh: halves
    /// as the difference of two coordinates may overflow.
    half_corner: DVec2,
    /// Half the longer side, in units of the mesh.
    half_side: f64,
    /// The longer side, pixels.
    size: f64,
    /// Of the drawing, pixels.
    pub(crate) width: f64,
    pub(crate) height: f64,
    /// Pixels that lengths of the legend are multiples of.
    pub(crate) unit: f64,
    /// White space around drawing and legend, pixels.
    pub(crate) margin: f64,
    /// Whether a box is shown that may cut triangles.
    pub(crate) zoomed: bool,
}

impl Frame {
    pub(crate) fn new(plot: &Plot<'_>, largest_px: f64) -> Self {
        let [min, max] = plot.picture.zoom.unwrap_or_else(|| extent(plot));
        let half_extent = (max * 0.5 - min * 0.5).max(DVec2::ZERO);
        let half_side = half_extent.max_element();
        let size = match plot.picture.size_px {
            finite if finite.is_finite() => finite.clamp(16.0, largest_px),
            _ => Picture::default().size_px,
        };
        let unit = (size / ORDINARY_SIZE).max(1.0);
        let mut frame = Self {
            half_corner: DVec2::new(min.x, max.y) * 0.5,
            half_side,
            size,
            width: 0.0,
            height: 0.0,
            unit,
            margin: MARGIN * unit,
            zoomed: plot.picture.zoom.is_some(),
        };
        frame.width = frame.length(half_extent.x);
        frame.height = frame.length(half_extent.y);
        frame
    }

    /// Pixels of half a length. Without extent everything is in one place.
    fn length(&self, half: f64) -> f64 {
        if self.half_side == 0.0 {
            return 0.0;
        }
        half / self.half_side * self.size
    }

    /// A position in pixels from the upper left corner of the drawing.
    fn pixel(&self, p: DVec2) -> DVec2 {
        let half = p * 0.5 - self.half_corner;
        DVec2::new(self.length(half.x), -self.length(half.y))
    }

    fn settled(&self, pixel: DVec2) -> Place {
        [pixel.x, pixel.y].map(|c| ((c + self.margin) * 100.0).round() as i64)
    }

    /// Where a point is on the page, if it is in view.
    pub(crate) fn place(&self, p: DVec2) -> Option<Place> {
        let pixel = self.pixel(p);
        let outside = self.zoomed && [0, 1, 2, 3].into_iter().any(|side| self.inside(side, pixel) < 0.0);
        (!outside).then(|| self.settled(pixel))
    }

    /// The places of a convex polygon's corners, cut a little outside of the view.
    pub(crate) fn polygon(&self, corners: &[DVec2], places: &mut Vec<Place>) {
        places.clear();
        let mut pixels: Vec<DVec2> = corners.iter().map(|&p| self.pixel(p)).collect();
        if self.zoomed {
            for side in 0..4 {
                pixels = self.cut(side, &pixels);
            }
        }
        places.extend(pixels.into_iter().map(|p| self.settled(p)));
    }

    /// How far inside of a side of the view a point is, pixels; the view a little
    /// larger than the box. Sides are left, right, top and bottom.
    fn inside(&self, side: u8, p: DVec2) -> f64 {
        match side {
            0 => p.x + BEYOND,
            1 => self.width + BEYOND - p.x,
            2 => p.y + BEYOND,
            _ => self.height + BEYOND - p.y,
        }
    }

    /// The part of a convex polygon inside of a side of the view.
    fn cut(&self, side: u8, polygon: &[DVec2]) -> Vec<DVec2> {
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &p) in polygon.iter().enumerate() {
            let next = polygon[(i + 1) % polygon.len()];
            let (here, there) = (self.inside(side, p), self.inside(side, next));
            if here >= 0.0 {
                kept.push(p);
            }
            if (here >= 0.0) != (there >= 0.0) {
                kept.push(p + (next - p) * (here / (here - there)));
            }
        }
        kept
    }

    /// Whether a convex polygon has a point in common with the view's inside.
    pub(crate) fn shows(&self, corners: &[DVec2]) -> bool {
        if !self.zoomed {
            return true;
        }
        let pixels: Vec<DVec2> = corners.iter().map(|&p| self.pixel(p)).collect();
        let beside = |beyond: fn(&DVec2, DVec2) -> bool| {
            let far = DVec2::new(self.width, self.height);
            pixels.iter().all(|p| beyond(p, far))
        };
        let apart = beside(|p, _| p.x <= 0.0)
            || beside(|p, far| p.x >= far.x)
            || beside(|p, _| p.y <= 0.0)
            || beside(|p, far| p.y >= far.y);
        !apart && !self.beyond_an_edge(&pixels)
    }

    /// Whether an edge's line parts the view from the convex polygon it is of.
    fn beyond_an_edge(&self, pixels: &[DVec2]) -> bool {
        let view = [DVec2::ZERO, DVec2::new(self.width, 0.0), DVec2::new(self.width, self.height)];
        let view = [view[0], view[1], view[2], DVec2::new(0.0, self.height)];
        (0..pixels.len()).any(|i| {
            let (p, next) = (pixels[i], pixels[(i + 1) % pixels.len()]);
            let side = |q: &DVec2| (next - p).perp_dot(*q - p);
            let of_polygon =
                pixels.iter().map(side).fold(0.0, |far, s| if s.abs() > f64::abs(far) { s } else { far });
            of_polygon != 0.0 && view.iter().all(|q| side(q) * of_polygon.signum() <= 0.0)
        })
    }

    /// How wide or high a polygon is, whichever is more, pixels.
    pub(crate) fn spread(&self, corners: &[DVec2]) -> f64 {
        let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for &p in corners {
            (min, max) = (min.min(p), max.max(p));
        }
        self.length((max * 0.5 - min * 0.5).max_element().max(0.0))
    }
}

/// The box around mesh and overlay.
fn extent(plot: &Plot<'_>) -> [DVec2; 2] {
    let polygons = plot.picture.overlay.map_or(&[][..], |o| &o.polygons);
    let corners = polygons.iter().flat_map(|polygon| &polygon.corners);
    let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for &p in plot.mesh.vertices.iter().chain(corners) {
        (min, max) = (min.min(p), max.max(p));
    }
    if min.x > max.x { [DVec2::ZERO; 2] } else { [min, max] }
}
