//! Pictures as SVG.
//!
//! Shapes of one look are one path, in hundredths of a pixel and relative steps,
//! about 30 bytes for a triangle: a mesh of 100,000 triangles stays a file that
//! viewers open.

use crate::canvas::{Anchor, Canvas, Label, Place, Style};
use crate::plot::Plot;
use crate::scene::Scene;
use crate::text::TextWriter;
use std::io::{self, Write};

/// The largest drawing, pixels.
const LARGEST: f64 = 100_000.0;

/// Writes the picture of a mesh.
pub(crate) fn write_svg(out: &mut dyn Write, plot: &Plot<'_>) -> io::Result<()> {
    let scene = Scene::new(plot, LARGEST);
    let [width, height] = scene.size();
    let mut text = TextWriter::new(out);
    text.text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"");
    text.pixels(width).text("\" height=\"").pixels(height);
    text.text("\" viewBox=\"0 0 ").pixels(width).text(" ");
    text.pixels(height).text("\" stroke-linejoin=\"round\">\n");
    text.text("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
    let mut svg = Svg { text };
    scene.draw(&mut svg)?;
    svg.text.text("</svg>\n").finish()
}

struct Svg<'w> {
    text: TextWriter<'w>,
}

impl Svg<'_> {
    fn style(&mut self, style: Style) {
        let text = &mut self.text;
        match style.fill {
            Some(colour) => text.text(" fill=\"").text(&colour.hex()).text("\""),
            None => text.text(" fill=\"none\""),
        };
        if let Some((colour, width)) = style.stroke {
            text.text(" stroke=\"").text(&colour.hex());
            text.text("\" stroke-width=\"").hundredths(width).text("\"");
        }
    }

    /// The second number of a pair; a minus sign separates as well as a space.
    fn pair_end(&mut self, hundredths: i64) {
        if hundredths >= 0 {
            self.text.text(" ");
        }
        self.text.hundredths(hundredths);
    }
}

impl Canvas for Svg<'_> {
    fn open(&mut self, part: &str) {
        self.text.text("<g id=\"").text(part).text("\">\n");
    }

    fn close(&mut self) {
        self.text.text("</g>\n");
    }

    fn begin(&mut self, style: Style) {
        self.text.text("<path");
        self.style(style);
        self.text.text(" d=\"");
    }

    fn ring(&mut self, places: &[Place], closed: bool) -> io::Result<()> {
        let Some((first, rest)) = places.split_first() else {
            return Ok(());
        };
        if rest.iter().all(|place| place == first) {
            return Ok(());
        }
        self.text.text("M").hundredths(first[0]);
        self.pair_end(first[1]);
        self.text.text("l");
        for (i, step) in places.windows(2).enumerate() {
            let (dx, dy) = (step[1][0] - step[0][0], step[1][1] - step[0][1]);
            if i > 0 && dx >= 0 {
                self.text.text(" ");
            }
            self.text.hundredths(dx);
            self.pair_end(dy);
        }
        self.text.text(if closed { "z" } else { "" }).breathe()
    }

    fn end(&mut self) -> io::Result<()> {
        self.text.text("\"/>\n").breathe()
    }

    fn discs(&mut self, style: Style, radius: f64, centres: &[Place]) -> io::Result<()> {
        self.text.text("<g");
        self.style(style);
        self.text.text(">\n");
        for [x, y] in centres {
            self.text.text("<circle cx=\"").hundredths(*x);
            self.text.text("\" cy=\"").hundredths(*y);
            self.text.text("\" r=\"").pixels(radius).text("\"/>\n").breathe()?;
        }
        self.text.text("</g>\n").breathe()
    }

    fn label(&mut self, label: Label<'_>) -> io::Result<()> {
        let text = &mut self.text;
        text.text("<text x=\"").hundredths(label.at[0]);
        text.text("\" y=\"").hundredths(label.at[1]);
        text.text("\" font-family=\"sans-serif\" font-size=\"").pixels(label.size);
        text.text("\" fill=\"").text(&crate::colour::INK.hex());
        text.text(if label.bold { "\" font-weight=\"bold" } else { "" });
        text.text(if label.anchor == Anchor::Middle { "\" text-anchor=\"middle" } else { "" });
        text.text("\">").text(&escape(label.text)).text("</text>\n").breathe()
    }
}

/// A label as text of XML, which has no control characters.
fn escape(label: &str) -> String {
    let mut escaped = String::with_capacity(label.len());
    for c in label.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}
