//! The legend of a picture: angle scale, counts, overlay classes.

use crate::picture::{Rgb, scale_colour};
use crate::svg::{BELOW_COLOUR, Colouring, MARGIN, level_range};
use crate::text::TextWriter;
use crate::view::MeshView;

/// Height of a line of text, pixels.
const LINE: f64 = 18.0;

/// Height of the angle scale, pixels.
const SCALE_HEIGHT: f64 = 180.0;

/// Steps between the labels of the angle scale.
const TICKS: usize = 6;

/// A generous width of a character of the 13 pixel font, pixels.
const CHARACTER: f64 = 7.5;

/// What stands at the start of a line.
enum Sign {
    None,
    Square(Rgb),
    Dot,
}

enum Item {
    Line(Sign, String),
    /// Labels of the angle scale from top to bottom.
    Scale(Vec<String>),
}

/// A legend with known size.
pub(crate) struct Legend {
    items: Vec<Item>,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

/// Decides what the legend of a picture says.
pub(crate) fn layout(view: &MeshView<'_>, colouring: &Colouring) -> Legend {
    let mut items = Vec::new();
    if !view.mesh.triangles.is_empty() {
        angle_items(&mut items, view, colouring);
    }
    let inputs = view.input_indices.unwrap_or_default().iter().flatten().count();
    if inputs > 0 {
        let dot = if view.picture.input_points { Sign::Dot } else { Sign::None };
        items.push(Item::Line(dot, format!("{inputs} input points")));
    }
    overlay_items(&mut items, view);
    Legend {
        width: items.iter().map(Item::width).fold(0.0, f64::max),
        height: items.iter().map(Item::height).sum(),
        items,
    }
}

fn angle_items(items: &mut Vec<Item>, view: &MeshView<'_>, colouring: &Colouring) {
    let [low, high] = view.picture.angle_range_deg;
    if view.picture.fill_triangles {
        let labels = (0..=TICKS).map(|i| {
            let label = high + (low - high) * i as f64 / TICKS as f64;
            format!("{}\u{b0}", short(label))
        });
        items.push(Item::Line(Sign::None, "smallest angle".to_owned()));
        items.push(Item::Scale(labels.collect()));
        if colouring.below > 0 {
            let label = format!("below {}\u{b0}: {}", short(low), colouring.below);
            items.push(Item::Line(Sign::Square(BELOW_COLOUR), label));
        }
    }
    let [min, max] = colouring.angles_deg;
    for line in [
        format!("{} triangles", view.mesh.triangles.len()),
        format!("angles {min:.2}\u{b0} to {max:.2}\u{b0}"),
    ] {
        items.push(Item::Line(Sign::None, line));
    }
}

fn overlay_items(items: &mut Vec<Item>, view: &MeshView<'_>) {
    let Some(overlay) = view.picture.overlay else {
        return;
    };
    items.push(Item::Line(Sign::None, overlay.title.clone()));
    for class in &overlay.classes {
        items.push(Item::Line(Sign::Square(class.colour), class.label.clone()));
    }
    if let Some([low, high]) = level_range(overlay)
        && low < high
    {
        let line = format!("level {low} light to {high} dark");
        items.push(Item::Line(Sign::None, line));
    }
}

/// At most one decimal.
fn short(angle_deg: f64) -> String {
    let text = format!("{angle_deg:.1}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

impl Item {
    fn width(&self) -> f64 {
        match self {
            Self::Line(_, label) => LINE + CHARACTER * label.chars().count() as f64,
            Self::Scale(_) => 80.0,
        }
    }

    fn height(&self) -> f64 {
        match self {
            Self::Line(..) => LINE,
            Self::Scale(_) => SCALE_HEIGHT + LINE,
        }
    }
}

impl Legend {
    /// Writes the legend with its left side at `x` pixels.
    pub(crate) fn write(&self, text: &mut TextWriter<'_>, x: f64) {
        text.text("<g id=\"legend\" font-family=\"sans-serif\" font-size=\"13\">\n");
        let mut y = MARGIN;
        for item in &self.items {
            match item {
                Item::Line(sign, label) => {
                    let indent = write_sign(text, sign, x, y);
                    label_at(text, x + indent, y + 0.7 * LINE, label);
                }
                Item::Scale(labels) => write_scale(text, labels, x, y + 0.3 * LINE),
            }
            y += item.height();
        }
        text.text("</g>\n");
    }
}

/// Returns how far the label is moved to the right.
fn write_sign(text: &mut TextWriter<'_>, sign: &Sign, x: f64, y: f64) -> f64 {
    match sign {
        Sign::None => return 0.0,
        Sign::Square(colour) => {
            let side = 0.7 * LINE;
            rectangle(text, [x, y + 0.1 * LINE], [side, side], &colour.hex());
        }
        Sign::Dot => {
            text.text("<circle cx=\"").pixels(x + 0.35 * LINE);
            text.text("\" cy=\"").pixels(y + 0.45 * LINE);
            text.text("\" r=\"3\" fill=\"#fff\" stroke=\"#000\"/>\n");
        }
    }
    LINE
}

fn write_scale(text: &mut TextWriter<'_>, labels: &[String], x: f64, y: f64) {
    const STEPS: usize = 60;
    const WIDTH: f64 = 20.0;
    let step = SCALE_HEIGHT / STEPS as f64;
    for i in 0..STEPS {
        let colour = scale_colour(1.0 - (i as f64 + 0.5) / STEPS as f64).hex();
        // Half a pixel more than a step covers the seam to the next.
        let place = [x, y + i as f64 * step];
        rectangle(text, place, [WIDTH, step + 0.5], &colour);
    }
    for (i, label) in labels.iter().enumerate() {
        let at = y + SCALE_HEIGHT * i as f64 / TICKS as f64;
        label_at(text, x + WIDTH + 6.0, at + 0.25 * LINE, label);
    }
}

fn rectangle(text: &mut TextWriter<'_>, place: [f64; 2], size: [f64; 2], colour: &str) {
    text.text("<rect x=\"").pixels(place[0]);
    text.text("\" y=\"").pixels(place[1]);
    text.text("\" width=\"").pixels(size[0]);
    text.text("\" height=\"").pixels(size[1]);
    text.text("\" fill=\"").text(colour).text("\"/>\n");
}

fn label_at(text: &mut TextWriter<'_>, x: f64, y: f64, label: &str) {
    text.text("<text x=\"").pixels(x).text("\" y=\"").pixels(y);
    text.text("\">").text(&escape(label)).text("</text>\n");
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
