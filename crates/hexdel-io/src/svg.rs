//! Pictures of meshes as SVG: triangles coloured by their smallest angle.
//!
//! Triangles of one colour and size are one path, in hundredths of a pixel and
//! relative steps, about 30 bytes each: a mesh of 100,000 triangles stays a file
//! that viewers open. Edges are the thinner the smaller the triangle, dots the
//! smaller the more there are. The legend is in
//! the module [`legend`].

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::io::{self, Write};

use hexdel_geom::{DVec2, TriangleId};

use crate::angles::angle_range_deg;
use crate::legend;
use crate::picture::{Overlay, Picture, Polygon, Rgb, scale_colour};
use crate::text::TextWriter;
use crate::view::MeshView;

/// Colours that the scale is cut into; steps are below what the eye tells apart.
const SHADES: u8 = 64;

/// The shade of triangles below the scale.
const BELOW: u8 = SHADES;

/// The colour of triangles below the scale: red, which the scale does not touch.
pub(crate) const BELOW_COLOUR: Rgb = Rgb([0xe0, 0x1e, 0x37]);

/// White space around drawing and legend, pixels.
pub(crate) const MARGIN: f64 = 12.0;

/// Writes the picture of a mesh.
pub(crate) fn write_svg(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let frame = Frame::new(view);
    let colouring = Colouring::new(view);
    let legend = legend::layout(view, &colouring);
    let width = frame.width + legend.width + 3.0 * MARGIN;
    let height = frame.height.max(legend.height) + 2.0 * MARGIN;

    let mut text = TextWriter::new(out);
    text.text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"");
    text.pixels(width).text("\" height=\"").pixels(height);
    text.text("\" viewBox=\"0 0 ").pixels(width).text(" ");
    text.pixels(height).text("\">\n");
    text.text("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
    if view.picture.fill_triangles {
        triangles(&mut text, view, &frame, &colouring)?;
        overlay(&mut text, &view.picture, &frame)?;
    } else {
        overlay(&mut text, &view.picture, &frame)?;
        triangles(&mut text, view, &frame, &colouring)?;
    }
    input_points(&mut text, view, &frame)?;
    legend.write(&mut text, frame.width + 2.0 * MARGIN);
    text.text("</svg>\n").finish()
}

/// The map from coordinates of the mesh to pixels.
struct Frame {
    /// Half the left and upper border of the drawing, in units of the mesh: halves
    /// as the difference of two coordinates may overflow.
    half_corner: DVec2,
    /// Half the longer side, in units of the mesh.
    half_side: f64,
    /// The longer side, pixels.
    size: f64,
    width: f64,
    height: f64,
}

impl Frame {
    fn new(view: &MeshView<'_>) -> Self {
        let polygons = view.picture.overlay.map_or(&[][..], |o| &o.polygons);
        let corners = polygons.iter().flat_map(|polygon| &polygon.corners);
        let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for &p in view.mesh.vertices.iter().chain(corners) {
            (min, max) = (min.min(p), max.max(p));
        }
        let half_extent = (max * 0.5 - min * 0.5).max(DVec2::ZERO);
        let half_side = half_extent.max_element();
        let size = match view.picture.size_px {
            finite if finite.is_finite() => finite.clamp(16.0, 100_000.0),
            _ => Picture::default().size_px,
        };
        let mut frame =
            Self { half_corner: DVec2::new(min.x, max.y) * 0.5, half_side, size, width: 0.0, height: 0.0 };
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

    /// A position in hundredths of a pixel, y downwards.
    fn place(&self, p: DVec2) -> [i64; 2] {
        let half = p * 0.5 - self.half_corner;
        [half.x, -half.y].map(|c| ((self.length(c) + MARGIN) * 100.0).round() as i64)
    }

    /// The side of a square if `count` of them fill the drawing, pixels.
    fn spacing(&self, count: usize) -> f64 {
        (self.width.max(1.0) * self.height.max(1.0) / count.max(1) as f64).sqrt()
    }
}

/// The shade of each triangle and the angles of all.
pub(crate) struct Colouring {
    /// One shade per triangle, at most [`BELOW`].
    shades: Vec<u8>,
    /// The smallest and the largest angle of the mesh, degrees.
    pub(crate) angles_deg: [f64; 2],
    /// How many triangles are below the scale.
    pub(crate) below: usize,
}

impl Colouring {
    fn new(view: &MeshView<'_>) -> Self {
        let [low, high] = view.picture.angle_range_deg;
        let mut colouring = Self {
            shades: Vec::with_capacity(view.mesh.triangles.len()),
            angles_deg: [180.0, 0.0],
            below: 0,
        };
        for t in 0..view.mesh.triangles.len() {
            let [min, max] = angle_range_deg(view.mesh.corners(TriangleId::new(t)));
            colouring.angles_deg[0] = colouring.angles_deg[0].min(min);
            colouring.angles_deg[1] = colouring.angles_deg[1].max(max);
            colouring.below += usize::from(min < low);
            colouring.shades.push(if min < low {
                BELOW
            } else {
                let t = ((min - low) / (high - low)).clamp(0.0, 1.0);
                ((t * f64::from(SHADES)) as u8).min(SHADES - 1)
            });
        }
        colouring
    }
}

fn shade_colour(shade: u8) -> Rgb {
    match shade {
        BELOW => BELOW_COLOUR,
        _ => scale_colour((f64::from(shade) + 0.5) / f64::from(SHADES)),
    }
}

/// A path for each size and shade, large triangles first so that the fine lines of
/// small ones are on top.
fn triangles(
    text: &mut TextWriter<'_>,
    view: &MeshView<'_>,
    frame: &Frame,
    colouring: &Colouring,
) -> io::Result<()> {
    let Picture { fill_triangles: filled, edges, .. } = view.picture;
    if !filled && !edges {
        return Ok(());
    }
    let places = |t| {
        let corners = view.mesh.corners(TriangleId::new(t));
        corners.map(|p| frame.place(p))
    };
    let styles: Vec<(u8, u8)> = (0..colouring.shades.len())
        .map(|t| (size_class(places(t)), colouring.shades[t]))
        .map(|(size, shade)| (size, if filled { shade } else { 0 }))
        .collect();
    let mut order: Vec<usize> = (0..styles.len()).collect();
    order.sort_by_key(|&t| (Reverse(styles[t].0), styles[t].1));

    text.text("<g id=\"triangles\" stroke-linejoin=\"round\"");
    text.text(if filled { "" } else { " fill=\"none\"" });
    text.text(if edges { " stroke=\"#000\">\n" } else { ">\n" });
    for of_style in order.chunk_by(|&t, &u| styles[t] == styles[u]) {
        let (size, shade) = styles[of_style[0]];
        text.text("<path stroke-width=\"").hundredths(line_width(size));
        if filled {
            let colour = shade_colour(shade).hex();
            text.text("\" fill=\"").text(&colour);
            if !edges {
                // A seam of the background would show between neighbours.
                text.text("\" stroke=\"").text(&colour);
            }
        }
        text.text("\" d=\"");
        for &t in of_style {
            ring(text, places(t));
            text.breathe()?;
        }
        text.text("\"/>\n");
    }
    text.text("</g>\n");
    Ok(())
}

/// The binary logarithm of a triangle's size in hundredths of a pixel, where size
/// is the side of a square twice as large. In integers, as a logarithm of floats
/// would differ between platforms.
fn size_class([a, b, c]: [[i64; 2]; 3]) -> u8 {
    // Sizes of a third of a pixel and below, and of 20 pixels and above, are drawn
    // alike.
    const CLASSES: std::ops::RangeInclusive<u32> = 5..=11;
    let ([ux, uy], [vx, vy]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let twice_area = (ux * vy - uy * vx).unsigned_abs().max(1);
    (twice_area.ilog2() / 2).clamp(*CLASSES.start(), *CLASSES.end()) as u8
}

/// The width of edges in hundredths of a pixel, a thirty-second of the size: edges
/// take up about a tenth of the area in coarse and in fine parts of a mesh.
fn line_width(size_class: u8) -> i64 {
    1 << (size_class - 5)
}

/// A closed polygon; none if it is smaller than the resolution.
fn ring(text: &mut TextWriter<'_>, places: impl AsRef<[[i64; 2]]>) {
    let places = places.as_ref();
    let Some((first, rest)) = places.split_first() else {
        return;
    };
    if rest.iter().all(|place| place == first) {
        return;
    }
    text.text("M").hundredths(first[0]);
    pair_end(text, first[1]);
    text.text("l");
    for (i, step) in places.windows(2).enumerate() {
        let (dx, dy) = (step[1][0] - step[0][0], step[1][1] - step[0][1]);
        if i > 0 && dx >= 0 {
            text.text(" ");
        }
        text.hundredths(dx);
        pair_end(text, dy);
    }
    text.text("z");
}

/// The second number of a pair; a minus sign separates as well as a space.
fn pair_end(text: &mut TextWriter<'_>, hundredths: i64) {
    if hundredths >= 0 {
        text.text(" ");
    }
    text.hundredths(hundredths);
}

fn overlay(text: &mut TextWriter<'_>, picture: &Picture<'_>, frame: &Frame) -> io::Result<()> {
    let Some(overlay) = picture.overlay else {
        return Ok(());
    };
    let mut groups: BTreeMap<(u32, usize), Vec<&Polygon>> = BTreeMap::new();
    for polygon in &overlay.polygons {
        let group = groups.entry((polygon.level, polygon.class));
        group.or_default().push(polygon);
    }
    let width = (0.04 * frame.spacing(overlay.polygons.len())).clamp(0.03, 1.2);
    text.text("<g id=\"overlay\" stroke=\"#333\" stroke-width=\"");
    text.pixels(width).text("\" fill-opacity=\"");
    text.text(if picture.fill_triangles { "0.45" } else { "1" });
    text.text("\">\n");
    for ((level, class), polygons) in groups {
        let colour = overlay_colour(overlay, class, level);
        text.text("<path fill=\"").text(&colour.hex());
        text.text("\" d=\"");
        for polygon in polygons {
            let places: Vec<_> = polygon.corners.iter().map(|&p| frame.place(p)).collect();
            ring(text, places);
            text.breathe()?;
        }
        text.text("\"/>\n");
    }
    text.text("</g>\n");
    Ok(())
}

/// The lowest and the highest level.
pub(crate) fn level_range(overlay: &Overlay) -> Option<[u32; 2]> {
    let levels = || overlay.polygons.iter().map(|polygon| polygon.level);
    Some([levels().min()?, levels().max()?])
}

/// The colour of a class, mixed with white the more the lower the level.
fn overlay_colour(overlay: &Overlay, class: usize, level: u32) -> Rgb {
    let [low, high] = level_range(overlay).unwrap_or_default();
    let depth = f64::from(high - level) / f64::from((high - low).max(1));
    overlay.classes[class].colour.mix(Rgb([255; 3]), 0.7 * depth)
}

fn input_points(text: &mut TextWriter<'_>, view: &MeshView<'_>, frame: &Frame) -> io::Result<()> {
    let indices = view.input_indices.unwrap_or_default();
    let count = indices.iter().flatten().count();
    if count == 0 || !view.picture.input_points {
        return Ok(());
    }
    let radius = (0.15 * frame.spacing(count)).clamp(0.4, 3.0);
    text.text("<g id=\"input-points\" fill=\"#fff\" stroke=\"#000\" stroke-width=\"");
    text.pixels(0.4 * radius).text("\">\n");
    for (&p, _) in view.mesh.vertices.iter().zip(indices).filter(|(_, i)| i.is_some()) {
        let [x, y] = frame.place(p);
        text.text("<circle cx=\"").hundredths(x);
        text.text("\" cy=\"").hundredths(y);
        text.text("\" r=\"").pixels(radius).text("\"/>\n").breathe()?;
    }
    text.text("</g>\n");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_a_thirty_second_of_the_triangle() {
        let right = |leg: i64| [[7, -9], [7 + leg, -9], [7, leg - 9]];
        for (leg, width) in [(1, 1), (63, 1), (64, 2), (320, 8), (2048, 64), (1 << 30, 64)] {
            assert_eq!(line_width(size_class(right(leg))), width, "{leg}");
            let [a, b, c] = right(leg);
            assert_eq!(line_width(size_class([a, c, b])), width, "{leg}");
        }
    }
}
