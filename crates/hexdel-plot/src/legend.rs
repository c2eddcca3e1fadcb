//! The legend of a picture: what colours mean, counts, and the histogram.

use crate::canvas::{Anchor, Canvas, Label, Style, hundredths, place, rectangle};
use crate::colour::{BEYOND, BLACK, Rgb, WHITE};
use crate::frame::Frame;
use crate::histogram::Histogram;
use crate::picture::{ColourBy, Overlay, OverlayClass};
use crate::plot::Plot;
use crate::survey::Survey;
use std::collections::BTreeSet;
use std::io;

// Lengths are in units, pixels of a picture of ordinary size.

/// Height of a line of text.
const LINE: f64 = 18.0;

/// Height of the angle scale.
const SCALE_HEIGHT: f64 = 180.0;

/// Steps between the labels of the angle scale.
const TICKS: usize = 6;

const FONT: f64 = 13.0;

/// A generous width of a character.
const CHARACTER: f64 = 7.5;

/// Space above a heading that is not the first, and between other things.
const GAP: f64 = 10.0;

/// Classes beyond these are summed up.
const MOST_CLASSES: usize = 16;

/// What stands at the start of a line.
enum Sign {
    None,
    Square(Rgb),
    Dot,
}

enum Item {
    Heading(String),
    Line(Sign, String),
    /// Labels of the angle scale from top to bottom.
    Scale(Vec<String>),
    Histogram,
    Gap,
}

/// A legend.
pub(crate) struct Legend {
    items: Vec<Item>,
}

impl Legend {
    /// Decides what the legend of a picture says; `dots` is the number of input
    /// points in view, `classes` are those of the overlay in view.
    pub(crate) fn new(
        plot: &Plot<'_>,
        frame: &Frame,
        survey: &Survey,
        dots: usize,
        classes: &BTreeSet<(u32, usize)>,
    ) -> Self {
        let mut items = Vec::new();
        if plot.picture.fill_triangles && !survey.looks.is_empty() {
            colour_items(&mut items, plot, survey);
        }
        if !plot.mesh.triangles.is_empty() {
            count_items(&mut items, plot, frame, survey);
        }
        if dots > 0 {
            let dot = if plot.picture.input_points { Sign::Dot } else { Sign::None };
            items.push(Item::Line(dot, format!("{} input points", grouped(dots))));
        }
        if let Some(overlay) = plot.picture.overlay {
            let filled = !plot.picture.fill_triangles;
            overlay_items(&mut items, overlay, classes, filled);
        }
        if plot.picture.histogram && !survey.looks.is_empty() {
            items.push(Item::Heading("angles, square root scale".to_owned()));
            items.push(Item::Histogram);
        }
        Self { items }
    }

    /// Width and height in units.
    pub(crate) fn size(&self) -> [f64; 2] {
        let width = self.items.iter().map(Item::width).fold(0.0, f64::max);
        [width, (0..self.items.len()).map(|i| self.height(i)).sum()]
    }

    fn height(&self, item: usize) -> f64 {
        let above = if item > 0 && matches!(self.items[item], Item::Heading(_)) { GAP } else { 0.0 };
        above + self.items[item].height()
    }

    /// Draws the legend with its upper left corner at `at` pixels, `unit` pixels to
    /// a unit.
    pub(crate) fn draw(
        &self,
        canvas: &mut dyn Canvas,
        plot: &Plot<'_>,
        histogram: &Histogram,
        at: [f64; 2],
        unit: f64,
    ) -> io::Result<()> {
        let mut y = 0.0;
        for (i, item) in self.items.iter().enumerate() {
            let bottom = y + self.height(i);
            let mut pen = Pen { canvas, at, unit, y: bottom - item.height() };
            match item {
                Item::Heading(text) => pen.text([0.0, 0.7 * LINE], text, true)?,
                Item::Line(sign, text) => {
                    let indent = pen.sign(sign)?;
                    pen.text([indent, 0.7 * LINE], text, false)?;
                }
                Item::Scale(labels) => pen.scale(labels)?,
                Item::Gap => {}
                Item::Histogram => {
                    let corner = pen.place([0.0, 0.0]);
                    histogram.draw(pen.canvas, plot.picture.bounds_deg, corner, unit)?;
                }
            }
            y = bottom;
        }
        Ok(())
    }
}

fn colour_items(items: &mut Vec<Item>, plot: &Plot<'_>, survey: &Survey) {
    let [low, high] = plot.picture.bounds_deg;
    match plot.picture.colour_by {
        ColourBy::SmallestAngle => scale_items(items, "smallest angle", low, "below", survey.beyond()),
        ColourBy::LargestAngle => scale_items(items, "largest angle", high, "above", survey.beyond()),
        ColourBy::Region => {
            let label = |r: &f64| OverlayClass { label: r.to_string(), colour: BLACK };
            class_items(items, "region", &survey.regions.iter().map(label).collect::<Vec<_>>(), survey);
        }
        ColourBy::Groups(groups) => class_items(items, &groups.title, &groups.classes, survey),
    }
}

fn scale_items(items: &mut Vec<Item>, title: &str, bound: f64, word: &str, beyond: usize) {
    let label = |i: usize| 60.0 + (bound - 60.0) * i as f64 / TICKS as f64;
    items.push(Item::Heading(title.to_owned()));
    items.push(Item::Scale((0..=TICKS).map(|i| format!("{}\u{b0}", short(label(i)))).collect()));
    if beyond > 0 {
        let label = format!("{word} {}\u{b0}: {}", short(bound), grouped(beyond));
        items.push(Item::Line(Sign::Square(BEYOND), label));
    }
}

/// The classes that occur, each with its number of triangles.
fn class_items(items: &mut Vec<Item>, title: &str, classes: &[OverlayClass], survey: &Survey) {
    items.push(Item::Heading(title.to_owned()));
    let occurring = || (0..classes.len()).filter(|&i| survey.counts[i] > 0);
    for i in occurring().take(MOST_CLASSES) {
        let label = format!("{}: {}", classes[i].label, grouped(survey.counts[i]));
        items.push(Item::Line(Sign::Square(survey.colours[i]), label));
    }
    more(items, occurring().count());
}

/// A line for the classes that there is no room for.
fn more(items: &mut Vec<Item>, classes: usize) {
    if classes > MOST_CLASSES {
        items.push(Item::Line(Sign::None, format!("and {} more", grouped(classes - MOST_CLASSES))));
    }
}

fn count_items(items: &mut Vec<Item>, plot: &Plot<'_>, frame: &Frame, survey: &Survey) {
    let (shown, all) = (grouped(survey.looks.len()), grouped(plot.mesh.triangles.len()));
    let triangles =
        if frame.zoomed { format!("{shown} of {all} triangles") } else { format!("{all} triangles") };
    if !items.is_empty() {
        items.push(Item::Gap);
    }
    items.push(Item::Line(Sign::None, triangles));
    let [min, max] = survey.angles_deg;
    if min <= max {
        items.push(Item::Line(Sign::None, format!("angles {min:.2}\u{b0} to {max:.2}\u{b0}")));
    }
}

fn overlay_items(items: &mut Vec<Item>, overlay: &Overlay, classes: &BTreeSet<(u32, usize)>, filled: bool) {
    if !filled {
        return;
    }
    let used: BTreeSet<usize> = classes.iter().map(|(_, class)| *class).collect();
    items.push(Item::Heading(overlay.title.clone()));
    for class in used.iter().take(MOST_CLASSES).map(|&class| &overlay.classes[class]) {
        items.push(Item::Line(Sign::Square(class.colour), class.label.clone()));
    }
    more(items, used.len());
    let levels = || classes.iter().map(|(level, _)| level);
    if let (Some(low), Some(high)) = (levels().min(), levels().max())
        && low < high
    {
        items.push(Item::Line(Sign::None, format!("level {low} light to {high} dark")));
    }
}

/// At most one decimal.
pub(crate) fn short(angle_deg: f64) -> String {
    let text = format!("{angle_deg:.1}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

/// With commas between thousands.
fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

impl Item {
    fn width(&self) -> f64 {
        let text = |label: &str| CHARACTER * label.chars().count() as f64;
        match self {
            Self::Heading(label) => LINE + 1.1 * text(label),
            Self::Line(_, label) => LINE + text(label),
            Self::Scale(_) => 80.0,
            Self::Histogram => Histogram::size()[0],
            Self::Gap => 0.0,
        }
    }

    fn height(&self) -> f64 {
        match self {
            Self::Heading(_) | Self::Line(..) => LINE,
            Self::Scale(_) => SCALE_HEIGHT + LINE,
            Self::Histogram => Histogram::size()[1],
            Self::Gap => GAP,
        }
    }
}

/// Draws an item of the legend.
struct Pen<'c> {
    canvas: &'c mut dyn Canvas,
    /// The upper left corner of the legend, pixels.
    at: [f64; 2],
    unit: f64,
    /// Where the item begins, units below the corner.
    y: f64,
}

impl Pen<'_> {
    /// Pixels of a place given in units from the item's upper left corner.
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.at[0] + x * self.unit, self.at[1] + (self.y + y) * self.unit]
    }

    fn text(&mut self, at: [f64; 2], text: &str, bold: bool) -> io::Result<()> {
        let (at, size) = (place(self.place(at)), FONT * self.unit);
        self.canvas.label(Label { text, at, anchor: Anchor::Start, size, bold })
    }

    fn rectangle(&mut self, style: Style, at: [f64; 2], size: [f64; 2]) -> io::Result<()> {
        let at = self.place(at);
        rectangle(self.canvas, style, at, size.map(|s| s * self.unit))
    }

    /// Returns how far the text is moved to the right.
    fn sign(&mut self, sign: &Sign) -> io::Result<f64> {
        match sign {
            Sign::None => return Ok(0.0),
            Sign::Square(colour) => {
                let side = 0.7 * LINE;
                // The outline is for colours that are nearly white.
                let line = Some((Rgb([0x99; 3]), hundredths(0.5 * self.unit)));
                let style = Style { stroke: line, ..Style::filled(*colour) };
                self.rectangle(style, [0.0, 0.1 * LINE], [side, side])?;
            }
            Sign::Dot => {
                let centre = place(self.place([0.35 * LINE, 0.45 * LINE]));
                let style = Style { stroke: Some((BLACK, hundredths(self.unit))), ..Style::filled(WHITE) };
                self.canvas.discs(style, 3.0 * self.unit, &[centre])?;
            }
        }
        Ok(LINE)
    }

    fn scale(&mut self, labels: &[String]) -> io::Result<()> {
        const STEPS: usize = 60;
        const WIDTH: f64 = 20.0;
        let step = SCALE_HEIGHT / STEPS as f64;
        for i in 0..STEPS {
            let colour = Rgb::of_scale(1.0 - (i as f64 + 0.5) / STEPS as f64);
            // Half a pixel more than a step covers the seam to the next.
            let more = if i + 1 < STEPS { 0.5 } else { 0.0 };
            self.rectangle(Style::filled(colour), [0.0, 0.3 * LINE + i as f64 * step], [WIDTH, step + more])?;
        }
        for (i, label) in labels.iter().enumerate() {
            let y = 0.3 * LINE + SCALE_HEIGHT * i as f64 / TICKS as f64;
            self.text([WIDTH + 6.0, y + 0.25 * LINE], label, false)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_grouped() {
        assert_eq!([0, 999, 1000, 1_234_567].map(grouped), ["0", "999", "1,000", "1,234,567"]);
        assert_eq!([43.897, 60.0, 89.96].map(short), ["43.9", "60", "90"]);
    }
}
