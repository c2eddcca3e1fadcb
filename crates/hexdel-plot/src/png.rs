//! Pictures as PNG, painted with `tiny-skia`.
//!
//! Strips of the picture are painted four times as large in both directions, fills
//! without smoothing, and each pixel is the mean of its sixteen samples. So no seam
//! shows between neighbours, and triangles smaller than a pixel give its mean
//! colour. Memory is bounded by the strip, whatever the size. `tiny-skia` is built
//! without vector instructions, so that pictures are the same bytes everywhere.

use crate::canvas::{Anchor, Canvas, Label, Place, Style};
use crate::colour::{INK, Rgb};
use crate::glyphs;
use crate::plot::Plot;
use crate::scene::Scene;
use std::io::{self, Write};
use tiny_skia::{Color, FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, Transform};

/// The largest drawing, pixels.
const LARGEST: f64 = 16_384.0;

/// Samples to a pixel in each direction.
const SAMPLES: u32 = 4;

/// Pixels of a strip, as many as a whole row at least: 16 MiB of samples.
const STRIP: u32 = 1 << 18;

/// Writes the picture of a mesh.
pub(crate) fn write_png(out: &mut dyn Write, plot: &Plot<'_>) -> io::Result<()> {
    let scene = Scene::new(plot, LARGEST);
    let [width, height] = scene.size().map(|s| s.ceil() as u32);
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().map_err(io::Error::from)?;
    let mut rows = writer.stream_writer().map_err(io::Error::from)?;
    let strip = (STRIP / width).max(1);
    for top in (0..height).step_by(strip as usize) {
        let mut painter = Painter::new(width, top, strip.min(height - top))?;
        scene.draw(&mut painter)?;
        painter.write(&mut rows)?;
    }
    rows.finish().map_err(io::Error::from)
}

/// A strip of the picture.
struct Painter {
    samples: Pixmap,
    /// The first row, pixels.
    top: u32,
    /// The look of the shapes that are gathered.
    style: Style,
    path: PathBuilder,
    /// How far an outline reaches beyond its shape, hundredths of a pixel.
    reach: i64,
}

impl Painter {
    fn new(width: u32, top: u32, rows: u32) -> io::Result<Self> {
        let samples = Pixmap::new(width * SAMPLES, rows * SAMPLES);
        let mut samples = samples.ok_or_else(|| io::Error::other("no memory for a picture of this size"))?;
        samples.fill(Color::WHITE);
        let style = Style { fill: None, stroke: None };
        Ok(Self { samples, top, style, path: PathBuilder::new(), reach: 0 })
    }

    /// Whether something between two heights is in the strip.
    fn holds(&self, top: i64, bottom: i64) -> bool {
        let first = 100 * i64::from(self.top);
        let last = first + 100 * i64::from(self.samples.height() / SAMPLES);
        bottom + self.reach >= first && top - self.reach <= last
    }

    /// The sample at a place.
    fn sample(&self, [x, y]: Place) -> [f32; 2] {
        let hundredth = SAMPLES as f32 / 100.0;
        [x as f32 * hundredth, (y - 100 * i64::from(self.top)) as f32 * hundredth]
    }

    /// Paints the shapes that were gathered.
    fn paint(&mut self, cap: LineCap) {
        let gathered = std::mem::replace(&mut self.path, PathBuilder::new());
        let Some(path) = gathered.finish() else {
            return;
        };
        let whole = Transform::identity();
        if let Some(colour) = self.style.fill {
            let mut paint = solid(colour);
            paint.anti_alias = false;
            self.samples.fill_path(&path, &paint, FillRule::Winding, whole, None);
        }
        // Where there are no edges outlines close seams, of which there are none.
        if let Some((colour, width)) =
            self.style.stroke.filter(|(colour, _)| self.style.fill != Some(*colour))
        {
            let width = width as f32 * SAMPLES as f32 / 100.0;
            let stroke = Stroke { width, line_cap: cap, line_join: LineJoin::Round, ..Stroke::default() };
            self.samples.stroke_path(&path, &solid(colour), &stroke, whole, None);
        }
    }

    /// Writes the rows of the strip, three bytes to a pixel.
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let (data, samples) = (self.samples.data(), SAMPLES as usize);
        let pitch = 4 * self.samples.width() as usize;
        let mut row = vec![0; 3 * self.samples.width() as usize / samples];
        let mut sums = vec![0_u16; row.len()];
        for lines in data.chunks_exact(pitch * samples) {
            sums.fill(0);
            for line in lines.chunks_exact(pitch) {
                for (sum, pixel) in sums.chunks_exact_mut(3).zip(line.chunks_exact(4 * samples)) {
                    for sample in pixel.chunks_exact(4) {
                        (0..3).for_each(|channel| sum[channel] += u16::from(sample[channel]));
                    }
                }
            }
            for (mean, sum) in row.iter_mut().zip(&sums) {
                *mean = ((sum + 8) / 16) as u8;
            }
            out.write_all(&row)?;
        }
        Ok(())
    }
}

fn solid(Rgb([r, g, b]): Rgb) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(r, g, b, 255);
    paint
}

impl Canvas for Painter {
    fn open(&mut self, _: &str) {}

    fn close(&mut self) {}

    fn begin(&mut self, style: Style) {
        self.style = style;
        self.reach = style.stroke.map_or(0, |(_, width)| width) + 100;
    }

    fn ring(&mut self, places: &[Place], closed: bool) -> io::Result<()> {
        let heights = || places.iter().map(|[_, y]| *y);
        let (Some(top), Some(bottom)) = (heights().min(), heights().max()) else {
            return Ok(());
        };
        if !self.holds(top, bottom) || places.iter().all(|place| *place == places[0]) {
            return Ok(());
        }
        for (i, &place) in places.iter().enumerate() {
            let [x, y] = self.sample(place);
            if i == 0 { self.path.move_to(x, y) } else { self.path.line_to(x, y) }
        }
        if closed {
            self.path.close();
        }
        Ok(())
    }

    fn end(&mut self) -> io::Result<()> {
        self.paint(LineCap::Butt);
        Ok(())
    }

    fn discs(&mut self, style: Style, radius: f64, centres: &[Place]) -> io::Result<()> {
        self.begin(style);
        let reach = (radius * 100.0).ceil() as i64;
        for &centre in centres {
            if self.holds(centre[1] - reach, centre[1] + reach) {
                let [x, y] = self.sample(centre);
                self.path.push_circle(x, y, radius as f32 * SAMPLES as f32);
                // One by one, as they may overlap.
                self.paint(LineCap::Butt);
            }
        }
        Ok(())
    }

    fn label(&mut self, label: Label<'_>) -> io::Result<()> {
        let weight = if label.bold { 1.45 } else { 1.0 };
        self.begin(Style::line(INK, (label.size * glyphs::STROKE * weight * 100.0).round() as i64));
        let tall = (label.size * 100.0) as i64;
        if self.holds(label.at[1] - tall, label.at[1] + tall) {
            let size = label.size as f32 * SAMPLES as f32;
            let [x, y] = self.sample(label.at);
            let left =
                if label.anchor == Anchor::Middle { x - 0.5 * size * glyphs::width(label.text) } else { x };
            glyphs::write(&mut self.path, label.text, [left, y], size);
            self.paint(LineCap::Round);
        }
        Ok(())
    }
}
