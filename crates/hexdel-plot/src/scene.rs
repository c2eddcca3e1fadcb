//! What a picture is made of, in the order of drawing.
//!
//! All that takes time or memory is found out once ([`Scene::new`]); drawing can
//! be repeated, which is how large pictures are painted in strips.

use crate::canvas::{Canvas, Place, Style, hundredths, rectangle};
use crate::colour::{BLACK, INK, Rgb, WHITE};
use crate::frame::Frame;
use crate::legend::Legend;
use crate::picture::{Overlay, Picture};
use crate::plot::Plot;
use crate::survey::Survey;
use hexdel_geom::TriangleId;
use std::collections::BTreeMap;
use std::io;

/// A picture that is ready to be drawn.
pub(crate) struct Scene<'a> {
    plot: &'a Plot<'a>,
    frame: Frame,
    survey: Survey,
    legend: Legend,
    /// The polygons in view by level and class.
    overlay: BTreeMap<(u32, usize), Vec<u32>>,
    /// The input points in view.
    dots: Vec<Place>,
}

impl<'a> Scene<'a> {
    /// # Complexity
    ///
    /// Linear but for sorting; 12 bytes per triangle in view.
    pub(crate) fn new(plot: &'a Plot<'a>, largest_px: f64) -> Self {
        let frame = Frame::new(plot, largest_px);
        let survey = Survey::new(plot, &frame);
        let overlay = overlay_in_view(plot, &frame);
        let dots = dots(plot, &frame);
        let legend = Legend::new(plot, &frame, &survey, dots.len(), &overlay.keys().copied().collect());
        Self { plot, frame, survey, legend, overlay, dots }
    }

    /// Width and height, pixels.
    pub(crate) fn size(&self) -> [f64; 2] {
        let (frame, [width, height]) = (&self.frame, self.legend.size().map(|s| s * self.frame.unit));
        [frame.width + width + 3.0 * frame.margin, frame.height.max(height) + 2.0 * frame.margin]
    }

    pub(crate) fn draw(&self, canvas: &mut dyn Canvas) -> io::Result<()> {
        if self.plot.picture.fill_triangles {
            self.triangles(canvas)?;
            self.overlay(canvas)?;
        } else {
            self.overlay(canvas)?;
            self.triangles(canvas)?;
        }
        self.segments(canvas)?;
        self.input_points(canvas)?;
        if self.frame.zoomed {
            self.cover(canvas)?;
        }
        canvas.open("legend");
        let corner = [self.frame.width + 2.0 * self.frame.margin, self.frame.margin];
        self.legend.draw(canvas, self.plot, &self.survey.histogram, corner, self.frame.unit)?;
        canvas.close();
        Ok(())
    }

    /// Shapes of one look for each size and shade.
    fn triangles(&self, canvas: &mut dyn Canvas) -> io::Result<()> {
        let Picture { fill_triangles: filled, edges, .. } = self.plot.picture;
        if !filled && !edges {
            return Ok(());
        }
        let mut places = Vec::new();
        canvas.open("triangles");
        let alike = |of: &[_; 2]| of[0] == of[1];
        let look = |l: &crate::survey::Look| (l.size, if filled { l.shade } else { 0 });
        for group in self.survey.looks.chunk_by(|a, b| alike(&[look(a), look(b)])) {
            let colour = self.survey.colours[group[0].shade as usize];
            // Without edges a seam of the background would show between
            // neighbours.
            let line = if edges { BLACK } else { colour };
            canvas
                .begin(Style { fill: filled.then_some(colour), stroke: Some((line, group[0].line_width())) });
            for look in group {
                let corners = self.plot.mesh.corners(TriangleId::new(look.triangle as usize));
                self.frame.polygon(&corners, &mut places);
                canvas.ring(&places, true)?;
            }
            canvas.end()?;
        }
        canvas.close();
        Ok(())
    }

    fn overlay(&self, canvas: &mut dyn Canvas) -> io::Result<()> {
        let Some(overlay) = self.plot.picture.overlay else {
            return Ok(());
        };
        let filled = !self.plot.picture.fill_triangles;
        let levels = || self.overlay.keys().map(|(level, _)| *level);
        let levels = [levels().min().unwrap_or(0), levels().max().unwrap_or(0)];
        let mut places = Vec::new();
        canvas.open("overlay");
        for ((level, class), polygons) in &self.overlay {
            let corners = |polygon: &u32| &overlay.polygons[*polygon as usize].corners;
            let size = polygons.iter().map(|i| self.frame.spread(corners(i))).fold(0.0, f64::max);
            let width = if filled { (0.01 * size).clamp(0.03, 1.0) } else { (0.045 * size).clamp(0.08, 2.0) };
            let fill = at_level(overlay.classes[*class].colour, *level, levels);
            canvas.begin(Style {
                fill: filled.then_some(fill),
                stroke: Some((Rgb([0x33; 3]), hundredths(width))),
            });
            for polygon in polygons {
                self.frame.polygon(corners(polygon), &mut places);
                canvas.ring(&places, true)?;
            }
            canvas.end()?;
        }
        canvas.close();
        Ok(())
    }

    /// Edges with markers, heavier than all others.
    fn segments(&self, canvas: &mut dyn Canvas) -> io::Result<()> {
        let edges = self.plot.marked_edges.unwrap_or_default();
        if edges.is_empty() || !self.plot.picture.edges {
            return Ok(());
        }
        let mut places = Vec::new();
        canvas.open("segments");
        canvas.begin(Style::line(BLACK, hundredths(1.3 * self.frame.unit)));
        for edge in edges {
            let ends = edge.ends.map(|v| self.plot.mesh.vertices[v.index()]);
            self.frame.polygon(&ends, &mut places);
            canvas.ring(&places, false)?;
        }
        canvas.end()?;
        canvas.close();
        Ok(())
    }

    fn input_points(&self, canvas: &mut dyn Canvas) -> io::Result<()> {
        if self.dots.is_empty() || !self.plot.picture.input_points {
            return Ok(());
        }
        let radius = (0.15 * spacing(&self.dots)).clamp(0.5, 3.0);
        let stroke = Some((BLACK, hundredths(0.4 * radius)));
        canvas.open("input-points");
        canvas.discs(Style { stroke, ..Style::filled(WHITE) }, radius, &self.dots)?;
        canvas.close();
        Ok(())
    }

    /// Covers what is drawn beyond the box, and frames it.
    fn cover(&self, canvas: &mut dyn Canvas) -> io::Result<()> {
        let Frame { margin, width, height, .. } = self.frame;
        let white = Style::filled(WHITE);
        let [all, tall] = [width + 2.0 * margin, height];
        canvas.open("frame");
        rectangle(canvas, white, [0.0, 0.0], [all, margin])?;
        rectangle(canvas, white, [0.0, margin + tall], [all, margin])?;
        rectangle(canvas, white, [0.0, margin], [margin, tall])?;
        rectangle(canvas, white, [margin + width, margin], [margin, tall])?;
        let border = Style::line(INK, hundredths(self.frame.unit));
        rectangle(canvas, border, [margin, margin], [width, height])?;
        canvas.close();
        Ok(())
    }
}

/// The colour of a class, mixed with white the more the lower the level.
fn at_level(colour: Rgb, level: u32, [low, high]: [u32; 2]) -> Rgb {
    let depth = f64::from(high - level) / f64::from((high - low).max(1));
    colour.mix(WHITE, 0.7 * depth)
}

fn overlay_in_view(plot: &Plot<'_>, frame: &Frame) -> BTreeMap<(u32, usize), Vec<u32>> {
    let mut groups: BTreeMap<_, Vec<u32>> = BTreeMap::new();
    let polygons: &[_] = plot.picture.overlay.map_or(&[], |Overlay { polygons, .. }| polygons);
    for (i, polygon) in polygons.iter().enumerate() {
        if frame.shows(&polygon.corners) {
            groups.entry((polygon.level, polygon.class)).or_default().push(i as u32);
        }
    }
    groups
}

/// How far points are apart if they are spread evenly, pixels.
fn spacing(dots: &[Place]) -> f64 {
    let extent = |axis: usize| {
        let along = || dots.iter().map(|dot| dot[axis]);
        let (min, max) = (along().min().unwrap_or(0), along().max().unwrap_or(0));
        (max - min) as f64 / 100.0
    };
    let (width, height, count) = (extent(0), extent(1), dots.len() as f64);
    if count < 2.0 { f64::INFINITY } else { (width * height / count).sqrt().max(width.max(height) / count) }
}

fn dots(plot: &Plot<'_>, frame: &Frame) -> Vec<Place> {
    let indices = plot.input_indices.unwrap_or_default();
    let inputs = plot.mesh.vertices.iter().zip(indices).filter(|(_, index)| index.is_some());
    inputs.filter_map(|(&p, _)| frame.place(p)).collect()
}
