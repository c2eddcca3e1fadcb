//! Letters as strokes, so that PNG pictures have text on machines without fonts.
//!
//! Drawn for this crate on a grid of 20 units to the font's size: capitals are 14
//! high, small letters 10, tails reach 4 below the base line. A glyph is its width
//! and a path of
//!
//! | command | |
//! |---|---|
//! | `M x y` | begin at a point |
//! | `L x y` | straight to a point |
//! | `h x y` | a quarter of an ellipse to a point, leaving level |
//! | `v x y` | the same, leaving upright |
//! | `Q a b x y` | a curve to `x y`, leaving and arriving along the lines through `a b` |

use tiny_skia::PathBuilder;

/// Units to the size of the font.
const UNITS: f32 = 20.0;

/// Space between the strokes of two letters, units.
const SPACING: f32 = 3.3;

/// Width of strokes, units.
pub(crate) const STROKE: f64 = 1.7 / 20.0;

/// How far control points lie on the tangents of a quarter ellipse.
const KAPPA: f32 = 0.552_284_8;

/// Width and path of the characters 33 to 126 of ASCII.
const GLYPHS: [(f32, &str); 94] = [
    (1.0, "M.5 14L.5 4.5M.5 .6L.5 .4"),
    (3.5, "M0 14L0 10M3.5 14L3.5 10"),
    (10.0, "M3.5 14L2 0M8.5 14L7 0M.5 9.5L10 9.5M0 4.5L9.5 4.5"),
    (8.5, "M8 11.7Q7 14 4.3 14h.4 10.7v4.3 7.2h8.5 3.6v4.2 0Q1.2 0 .2 2.5M4.3 16L4.3 -2"),
    (13.0, "M11.5 14L1.5 0M0 10.9v2.8 14h5.6 10.9v2.8 7.8h0 10.9M7.4 3.1v10.2 6.2h13 3.1v10.2 0h7.4 3.1"),
    (11.5, "M11.5 0L3 9.2Q2 10.4 2 11.4v4.4 14h6.8 11.6Q6.8 9.8 4 8Q0 6 0 3.7v4.1 0Q8.6 0 10.2 6"),
    (0.5, "M.2 14L.2 10"),
    (3.0, "M3 16Q0 11.5 0 6Q0 .5 3 -4"),
    (3.0, "M0 16Q3 11.5 3 6Q3 .5 0 -4"),
    (6.0, "M3 14L3 8M.4 12.5L5.6 9.5M5.6 12.5L.4 9.5"),
    (9.0, "M4.5 10L4.5 1M0 5.5L9 5.5"),
    (1.0, "M1 .6L0 -2.6"),
    (5.0, "M0 5.2L5 5.2"),
    (1.0, "M.5 .6L.5 .3"),
    (6.0, "M6 14.5L0 -2"),
    (8.5, "M0 7v4.25 14h8.5 7v4.25 0h0 7"),
    (8.5, "M1.5 11.2L5 14L5 0"),
    (8.5, "M.4 10.3v4.3 14h8.2 10.3Q8.2 8.2 6 5.8L.3 0L8.6 0"),
    (8.5, "M.6 11.2v4.1 14h7.8 10.7v4.2 7.4L3.2 7.4M4.2 7.4h8.5 3.7v4.1 0h.2 2.9"),
    (8.5, "M6.5 0L6.5 14L0 4L8.8 4"),
    (8.5, "M7.8 14L1.3 14L.7 7.6Q2 9 4.2 9h8.5 4.5v4 0h.2 2.8"),
    (8.5, "M7.9 12Q6.8 14 4.6 14h0 6.5L0 4.5v4.25 0h8.5 4.5v4.25 9h0 4.5"),
    (8.5, "M0 14L8.5 14L3 0"),
    (8.5, "M.6 10.8v4.25 14h7.9 10.8v4.25 7.6h.6 10.8M0 3.8v4.25 7.6h8.5 3.8v4.25 0h0 3.8"),
    (8.5, "M.6 2Q1.7 0 3.9 0h8.5 7.5L8.5 9.5v4.25 14h0 9.5v4.25 5h8.5 9.5"),
    (1.0, "M.5 .6L.5 .3M.5 8.9L.5 8.6"),
    (1.0, "M1 .6L0 -2.6M1 8.9L1 8.6"),
    (8.0, "M8 10.5L0 5.5L8 .5"),
    (9.0, "M0 7.5L9 7.5M0 3.5L9 3.5"),
    (8.0, "M0 10.5L8 5.5L0 .5"),
    (7.0, "M0 10.8v3.5 14h7 10.6Q7 8.7 5 7.3Q3.4 6.2 3.4 4M3.4 .6L3.4 .3"),
    (14.0, "M12.5 -.7Q10.5 -2 7.5 -2h0 6v7 14h14 6v12 3.2h10 5.5L10 9.5M10 6.3v7 9.5h4 6.3v7 3h10 6.3"),
    (10.5, "M0 0L5.25 14L10.5 0M1.8 4.8L8.7 4.8"),
    (9.0, "M0 0L0 14L4.5 14h8.2 10.7v4.5 7.4L0 7.4M4.5 7.4h9 3.7v4.5 0L0 0"),
    (10.5, "M10.5 11Q9 14 5.8 14h0 7v5.8 0Q9 0 10.5 3"),
    (10.0, "M0 0L0 14L4 14h10 7v4 0L0 0"),
    (8.0, "M8 14L0 14L0 0L8 0M0 7.3L7 7.3"),
    (8.0, "M8 14L0 14L0 0M0 7.2L7 7.2"),
    (11.0, "M10.6 11Q9.2 14 5.8 14h0 7v5.8 0h11 5L11 6.5L6.2 6.5"),
    (9.5, "M0 0L0 14M9.5 0L9.5 14M0 7.2L9.5 7.2"),
    (0.5, "M.2 0L.2 14"),
    (6.0, "M6 14L6 4v3 0h0 3.5"),
    (9.0, "M0 0L0 14M8.8 14L0 5.2M3.4 8.6L9.2 0"),
    (7.5, "M0 14L0 0L7.5 0"),
    (12.0, "M0 0L0 14L6 4L12 14L12 0"),
    (9.5, "M0 0L0 14L9.5 0L9.5 14"),
    (11.5, "M0 7v5.75 14h11.5 7v5.75 0h0 7"),
    (8.8, "M0 0L0 14L4.7 14h8.8 10.2v4.7 6.4L0 6.4"),
    (11.5, "M0 7v5.75 14h11.5 7v5.75 0h0 7M7.5 3.5L11.5 -.8"),
    (9.0, "M0 0L0 14L4.7 14h8.8 10.2v4.7 6.4L0 6.4M4.4 6.4L9 0"),
    (8.6, "M8 11.7Q7 14 4.3 14h.4 10.7v4.3 7.2h8.6 3.6v4.2 0Q1.2 0 .2 2.5"),
    (10.0, "M0 14L10 14M5 14L5 0"),
    (9.5, "M0 14L0 4.7v4.75 0h9.5 4.7L9.5 14"),
    (10.5, "M0 14L5.25 0L10.5 14"),
    (15.0, "M0 14L3.6 0L7.5 13L11.4 0L15 14"),
    (9.5, "M0 14L9.5 0M9.5 14L0 0"),
    (10.0, "M0 14L5 7L10 14M5 7L5 0"),
    (9.0, "M0 14L9 14L0 0L9 0"),
    (3.0, "M3 16L0 16L0 -4L3 -4"),
    (6.0, "M0 14.5L6 -2"),
    (3.0, "M0 16L3 16L3 -4L0 -4"),
    (7.0, "M0 9L3.5 14L7 9"),
    (9.0, "M0 -2.5L9 -2.5"),
    (2.5, "M0 14.5L2.5 11.5"),
    (7.6, "M.6 8.2Q1.6 10 4 10h7.6 6.6L7.6 0M7.6 5.9L3.6 5.9h0 2.9v3.2 0Q6 0 7.6 2.6"),
    (8.2, "M0 0L0 14.5M0 5v4.1 10h8.2 5v4.1 0h0 5"),
    (7.2, "M7.2 8Q6.2 10 4.1 10h0 5v4.1 0Q6.2 0 7.2 2"),
    (8.2, "M8.2 0L8.2 14.5M8.2 5v4.1 10h0 5v4.1 0h8.2 5"),
    (8.0, "M.1 5.2L8 5.2v4.1 10h0 5v4.1 0Q6.6 0 7.7 2"),
    (4.6, "M5 14.2h2 11.5L2 0M0 9.6L4.6 9.6"),
    (8.2, "M8.2 10L8.2 -.3v4 -4.2Q1.6 -4.2 .8 -2.4M8.2 5v4.1 10h0 5v4.1 0h8.2 5"),
    (7.6, "M0 0L0 14.5M0 6v4 10h7.6 6.2L7.6 0"),
    (0.5, "M.2 0L.2 9.8M.2 13.8L.2 13.5"),
    (2.2, "M2 9.8L2 -1.6v-.6 -4.2M2 13.8L2 13.5"),
    (7.4, "M0 0L0 14.5M7 10L0 3.6M2.8 6.2L7.4 0"),
    (0.5, "M.2 0L.2 14.5"),
    (12.6, "M0 0L0 10M0 6.4v3.4 10h6.3 6.4L6.3 0M6.3 6.4v9.6 10h12.6 6.4L12.6 0"),
    (7.6, "M0 0L0 10M0 6v4 10h7.6 6.2L7.6 0"),
    (8.4, "M0 5v4.2 10h8.4 5v4.2 0h0 5"),
    (8.2, "M0 10L0 -4.2M0 5v4.1 10h8.2 5v4.1 0h0 5"),
    (8.2, "M8.2 10L8.2 -4.2M8.2 5v4.1 10h0 5v4.1 0h8.2 5"),
    (4.2, "M0 0L0 10M0 6Q.6 10 4.4 9.8"),
    (6.6, "M6.2 8.3Q5.4 10 3.3 10h.4 7.6v3.3 5.3h6.6 2.6v3.3 0Q1 0 .1 1.8"),
    (4.6, "M1.8 13.2L1.8 2.8v4.8 0M0 9.6L4.6 9.6"),
    (7.6, "M0 10L0 3.8v3.6 0h7.6 4M7.6 10L7.6 0"),
    (7.6, "M0 10L3.8 0L7.6 10"),
    (11.4, "M0 10L2.9 0L5.7 9.5L8.5 0L11.4 10"),
    (7.4, "M0 10L7.4 0M7.4 10L0 0"),
    (7.6, "M0 10L3.9 0M7.6 10L3.4 -2.2Q2.6 -4.2 .4 -4.1"),
    (6.8, "M0 10L6.8 10L0 0L6.8 0"),
    (3.5, "M3.5 16h1.5 13L1.5 8.5v0 6h1.5 3.5L1.5 -1v3.5 -4"),
    (0.5, "M.2 15L.2 -4"),
    (3.5, "M0 16h2 13L2 8.5v3.5 6h2 3.5L2 -1v0 -4"),
    (8.0, "M0 5Q2 8 4 6Q6 4 8 7"),
];

const DEGREE: (f32, &str) = (4.4, "M0 11.8v2.2 14h4.4 11.8v2.2 9.6h0 11.8");

/// What stands for characters that are not drawn.
const UNKNOWN: (f32, &str) = (8.0, "M0 0L0 14L8 14L8 0L0 0");

const BLANK: (f32, &str) = (3.0, "");

fn glyph(c: char) -> (f32, &'static str) {
    match c {
        '!'..='~' => GLYPHS[c as usize - 33],
        '\u{b0}' => DEGREE,
        c if c.is_whitespace() || c.is_control() => BLANK,
        _ => UNKNOWN,
    }
}

/// The width of a text of size 1.
pub(crate) fn width(text: &str) -> f32 {
    text.chars().map(|c| glyph(c).0 + SPACING).sum::<f32>() / UNITS
}

/// Adds the strokes of a text that begins at a place on its base line.
pub(crate) fn write(path: &mut PathBuilder, text: &str, [mut x, y]: [f32; 2], size: f32) {
    let scale = size / UNITS;
    for c in text.chars() {
        let (width, strokes) = glyph(c);
        let left = x + 0.5 * SPACING * scale;
        draw(path, strokes, |[u, v]| [left + u * scale, y - v * scale]);
        x += (width + SPACING) * scale;
    }
}

fn draw(path: &mut PathBuilder, strokes: &str, place: impl Fn([f32; 2]) -> [f32; 2]) {
    let mut from = [0.0; 2];
    for (command, numbers) in commands(strokes) {
        let pair = |i: usize| [numbers[i], numbers[i + 1]];
        let to = pair(if command == 'Q' { 2 } else { 0 });
        let [x, y] = place(to);
        let tangent = |start: f32, end: f32| start + KAPPA * (end - start);
        match command {
            'M' => path.move_to(x, y),
            'L' => path.line_to(x, y),
            'Q' => {
                let [a, b] = place(pair(0));
                path.quad_to(a, b, x, y);
            }
            _ => {
                let (level, upright) = ([to[0], from[1]], [from[0], to[1]]);
                let corner = if command == 'h' { level } else { upright };
                let near = |end: [f32; 2]| [tangent(end[0], corner[0]), tangent(end[1], corner[1])];
                let ([a, b], [c, d]) = (place(near(from)), place(near(to)));
                path.cubic_to(a, b, c, d, x, y);
            }
        }
        from = to;
    }
}

/// The commands of a path with their numbers.
fn commands(strokes: &str) -> impl Iterator<Item = (char, [f32; 4])> {
    let begins = strokes.char_indices().filter(|(_, c)| c.is_ascii_alphabetic());
    begins.map(|(at, command)| {
        let rest = &strokes[at + 1..];
        let end = rest.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let mut numbers = [0.0; 4];
        for (number, word) in numbers.iter_mut().zip(rest[..end].split(' ')) {
            *number = word.parse().unwrap_or(0.0);
        }
        (command, numbers)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_glyph_is_well_formed_and_keeps_its_place() {
        let all = GLYPHS.iter().chain([&DEGREE, &UNKNOWN]);
        for (i, (width, strokes)) in all.enumerate() {
            let begins = strokes.matches(|c: char| c.is_ascii_alphabetic()).count();
            assert!(strokes.starts_with('M') && commands(strokes).count() == begins, "{i}");
            let numbers: Vec<_> =
                strokes.split(|c: char| c.is_ascii_alphabetic() || c == ' ').skip(1).collect();
            assert!(numbers.iter().all(|word| word.parse::<f32>().is_ok()), "{i} {strokes}");
            let quadratic = strokes.matches('Q').count();
            assert_eq!(numbers.len(), 2 * begins + 2 * quadratic, "{i} {strokes}");
            let mut path = PathBuilder::new();
            draw(&mut path, strokes, |p| p);
            let bounds = path.finish().unwrap().compute_tight_bounds().unwrap();
            assert!(bounds.left() >= -0.7 && bounds.right() <= width + 0.5, "{i} {bounds:?}");
            assert!(bounds.top() >= -4.3 && bounds.bottom() <= 16.1, "{i} {bounds:?}");
        }
    }

    #[test]
    fn texts_are_as_wide_as_their_letters() {
        assert_eq!(width(""), 0.0);
        assert!((width("00") - 2.0 * (8.5 + SPACING) / UNITS).abs() < 1e-6);
        assert!(width("\u{b0}") < width("\u{4e2d}"));
    }
}
