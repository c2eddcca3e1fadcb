//! The histogram of angles in a legend, with the bounds marked.
//!
//! Bars are centred on whole degrees: angles at 30, 60 and 90 degrees, which
//! meshes of a lattice are full of, fall into one bar whatever their rounding, and
//! bounds at whole degrees run through the middle of a bar. Heights are square
//! roots of counts: most angles of a large mesh may be of 60 degrees.

use crate::canvas::{Anchor, Canvas, Label, Style, hundredths, line, place};
use crate::colour::{BARS, BEYOND, INK};
use std::io;

/// Counts of angles.
pub(crate) struct Histogram {
    /// How many angles round to each degree from 0 to 180.
    counts: [u64; 181],
}

impl Default for Histogram {
    fn default() -> Self {
        Self { counts: [0; 181] }
    }
}

/// Height of the bars, units of the legend.
const BAR_HEIGHT: f64 = 96.0;

/// Room for the labels of the bounds above.
const ABOVE: f64 = 18.0;

/// Room for the labels of the axis below.
const BELOW: f64 = 20.0;

/// Room for half a label.
const LEFT: f64 = 10.0;

const WIDTH: f64 = 190.0;

const SMALL: f64 = 11.0;

impl Histogram {
    pub(crate) fn add(&mut self, angle_deg: f64) {
        self.counts[angle_deg.round().clamp(0.0, 180.0) as usize] += 1;
    }

    #[cfg(test)]
    pub(crate) fn total(&self) -> u64 {
        self.counts.iter().sum()
    }

    #[cfg(test)]
    pub(crate) fn at(&self, degree: usize) -> u64 {
        self.counts[degree]
    }

    /// Width and height, in units of the legend.
    pub(crate) const fn size() -> [f64; 2] {
        [WIDTH + 2.0 * LEFT, ABOVE + BAR_HEIGHT + BELOW]
    }

    /// The range of degrees shown: tens around all angles, 30 to 90 and the bounds.
    fn range(&self, bounds_deg: [f64; 2]) -> [usize; 2] {
        let first = self.counts.iter().position(|&n| n > 0).unwrap_or(60);
        let last = self.counts.iter().rposition(|&n| n > 0).unwrap_or(60);
        let low = (first as f64 - 1.0).min(bounds_deg[0]).clamp(0.0, 30.0);
        let high = (last as f64 + 1.0).max(bounds_deg[1]).clamp(100.0, 180.0);
        [(low / 10.0).floor() as usize * 10, (high / 10.0).ceil() as usize * 10]
    }

    /// Draws the histogram with its upper left corner at `at` pixels, `unit` pixels
    /// to a unit.
    pub(crate) fn draw(
        &self,
        canvas: &mut dyn Canvas,
        bounds_deg: [f64; 2],
        at: [f64; 2],
        unit: f64,
    ) -> io::Result<()> {
        let axes = Axes { range: self.range(bounds_deg), at, unit };
        bounds_deg.into_iter().try_for_each(|bound| axes.mark(canvas, bound))?;
        self.bars(canvas, &axes)?;
        axes.axis(canvas)
    }

    fn bars(&self, canvas: &mut dyn Canvas, axes: &Axes) -> io::Result<()> {
        let most = self.counts.iter().copied().max().unwrap_or(0).max(1);
        canvas.begin(Style::filled(BARS));
        for degree in axes.range[0]..=axes.range[1] {
            let count = self.counts[degree];
            if count == 0 {
                continue;
            }
            let height = (count as f64 / most as f64).sqrt();
            let [left, right] = [-0.45, 0.45].map(|half| axes.x(degree as f64 + half));
            let [top, bottom] = [axes.y(height), axes.y(0.0)];
            canvas.ring(&[[left, top], [right, top], [right, bottom], [left, bottom]].map(place), true)?;
        }
        canvas.end()
    }
}

/// Where degrees and heights are on the page.
struct Axes {
    range: [usize; 2],
    at: [f64; 2],
    unit: f64,
}

impl Axes {
    fn x(&self, degree: f64) -> f64 {
        // A degree of room on each side.
        let [low, high] = self.range.map(|d| d as f64);
        self.at[0] + (LEFT + (degree - low + 1.0) / (high - low + 2.0) * WIDTH) * self.unit
    }

    /// A height of 0 to 1.
    fn y(&self, height: f64) -> f64 {
        self.at[1] + (ABOVE + BAR_HEIGHT * (1.0 - height)) * self.unit
    }

    fn axis(&self, canvas: &mut dyn Canvas) -> io::Result<()> {
        let [low, high] = self.range;
        let ink = Style::line(INK, hundredths(self.unit));
        let ends = [low as f64 - 1.0, high as f64 + 1.0];
        line(canvas, ink, [self.x(ends[0]), self.y(0.0)], [self.x(ends[1]), self.y(0.0)])?;
        for degree in (low..=high).filter(|degree| degree % 30 == 0) {
            let x = self.x(degree as f64);
            line(canvas, ink, [x, self.y(0.0)], [x, self.y(0.0) + 4.0 * self.unit])?;
            self.label(canvas, &format!("{degree}\u{b0}"), [x, self.y(0.0) + 16.0 * self.unit])?;
        }
        Ok(())
    }

    /// A bound as a red line with its value on top.
    fn mark(&self, canvas: &mut dyn Canvas, bound: f64) -> io::Result<()> {
        let x = self.x(bound);
        let red = Style::line(BEYOND, hundredths(1.2 * self.unit));
        line(canvas, red, [x, self.y(0.0)], [x, self.y(1.0) - 3.0 * self.unit])?;
        let text = format!("{}\u{b0}", super::legend::short(bound));
        self.label(canvas, &text, [x, self.y(1.0) - 6.0 * self.unit])
    }

    fn label(&self, canvas: &mut dyn Canvas, text: &str, at: [f64; 2]) -> io::Result<()> {
        let (size, anchor) = (SMALL * self.unit, Anchor::Middle);
        canvas.label(Label { text, at: place(at), anchor, size, bold: false })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_counted_at_their_whole_degree() {
        let mut histogram = Histogram::default();
        for angle in [0.0, 43.9, 59.999_999, 60.000_001, 89.6, 90.0, 90.4, 180.0, f64::NAN] {
            histogram.add(angle);
        }
        assert_eq!(histogram.total(), 9);
        assert_eq!([44, 60, 90, 180].map(|d| histogram.counts[d]), [1, 2, 3, 1]);
    }

    #[test]
    fn the_range_holds_angles_and_bounds() {
        let mut histogram = Histogram::default();
        assert_eq!(histogram.range([43.9, 90.0]), [30, 100]);
        histogram.add(44.0);
        histogram.add(90.0);
        assert_eq!(histogram.range([43.9, 90.0]), [30, 100]);
        assert_eq!(histogram.range([20.0, 140.0]), [20, 140]);
        histogram.add(3.0);
        histogram.add(171.5);
        assert_eq!(histogram.range([43.9, 90.0]), [0, 180]);
    }
}
