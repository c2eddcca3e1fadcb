//! What pictures are drawn on: the few shapes that SVG and PNG have to know.

use crate::colour::Rgb;
use std::io;

/// A position in hundredths of a pixel from the upper left corner, y downwards.
pub(crate) type Place = [i64; 2];

/// How shapes look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Style {
    pub(crate) fill: Option<Rgb>,
    /// Colour and width in hundredths of a pixel of the outline.
    pub(crate) stroke: Option<(Rgb, i64)>,
}

impl Style {
    pub(crate) const fn filled(colour: Rgb) -> Self {
        Self { fill: Some(colour), stroke: None }
    }

    pub(crate) const fn line(colour: Rgb, width: i64) -> Self {
        Self { fill: None, stroke: Some((colour, width)) }
    }
}

/// Which part of a text is at the place given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
}

/// A line of text.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Label<'a> {
    pub(crate) text: &'a str,
    /// On the base line.
    pub(crate) at: Place,
    pub(crate) anchor: Anchor,
    /// Height of the letters in the typographer's sense, pixels.
    pub(crate) size: f64,
    pub(crate) bold: bool,
}

/// Something to draw on, later shapes over earlier ones.
pub(crate) trait Canvas {
    /// Begins a part of the picture.
    fn open(&mut self, part: &str);

    /// Ends it.
    fn close(&mut self);

    /// Begins shapes of one look.
    fn begin(&mut self, style: Style);

    /// One of them, closed or a line. Less than two different places are nothing.
    fn ring(&mut self, places: &[Place], closed: bool) -> io::Result<()>;

    /// Ends them.
    fn end(&mut self) -> io::Result<()>;

    /// Discs of one look and radius, pixels.
    fn discs(&mut self, style: Style, radius: f64, centres: &[Place]) -> io::Result<()>;

    /// A line of text.
    fn label(&mut self, label: Label<'_>) -> io::Result<()>;
}

/// A rectangle by its upper left corner and its size, pixels.
pub(crate) fn rectangle(
    canvas: &mut dyn Canvas,
    style: Style,
    [x, y]: [f64; 2],
    [width, height]: [f64; 2],
) -> io::Result<()> {
    let corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
    canvas.begin(style);
    canvas.ring(&corners.map(place), true)?;
    canvas.end()
}

/// A straight line, pixels.
pub(crate) fn line(canvas: &mut dyn Canvas, style: Style, from: [f64; 2], to: [f64; 2]) -> io::Result<()> {
    canvas.begin(style);
    canvas.ring(&[place(from), place(to)], false)?;
    canvas.end()
}

/// The place at a position in pixels.
pub(crate) fn place(pixels: [f64; 2]) -> Place {
    pixels.map(hundredths)
}

/// Pixels in hundredths.
pub(crate) fn hundredths(pixels: f64) -> i64 {
    (pixels * 100.0).round() as i64
}
