//! Line drawings of hexagons and triangles, as SVG.

use std::fmt::Write as _;

/// Pixels per lattice step.
const STEP: f64 = 48.0;

/// A picture: shapes in lattice steps, y upwards, with the box they fill.
pub(crate) struct Picture {
    shapes: String,
    /// Added to everything drawn.
    origin: [f64; 2],
    low: [f64; 2],
    high: [f64; 2],
}

impl Picture {
    pub(crate) fn new() -> Self {
        Self {
            shapes: String::new(),
            origin: [0.0; 2],
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
        }
    }

    /// A closed polygon.
    pub(crate) fn polygon(&mut self, points: &[[f64; 2]], style: &str) {
        let path = self.path(points);
        let _ = writeln!(self.shapes, "<polygon points=\"{}\" {style}/>", path.trim_end());
    }

    /// A hexagon with corners to the north and south, `size` between opposite sides.
    pub(crate) fn hexagon(&mut self, centre: [f64; 2], size: f64, style: &str) {
        let corners = [30_f64, 90.0, 150.0, 210.0, 270.0, 330.0].map(|a| {
            let (s, c) = a.to_radians().sin_cos();
            let r = size / 3.0_f64.sqrt();
            [centre[0] + r * c, centre[1] + r * s]
        });
        self.polygon(&corners, style);
    }

    /// A point.
    pub(crate) fn dot(&mut self, at: [f64; 2]) {
        let [x, y] = self.place(at);
        let _ = writeln!(self.shapes, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3\" fill=\"#c2410c\"/>");
    }

    /// Everything drawn from now on is moved by this.
    pub(crate) fn move_to(&mut self, origin: [f64; 2]) {
        self.origin = origin;
    }

    /// A line along points.
    pub(crate) fn line(&mut self, points: &[[f64; 2]], style: &str) {
        let path = self.path(points);
        let _ = writeln!(self.shapes, "<polyline points=\"{}\" fill=\"none\" {style}/>", path.trim_end());
    }

    /// A circle.
    pub(crate) fn circle(&mut self, centre: [f64; 2], radius: f64, style: &str) {
        for sign in [-1.0, 1.0] {
            self.place([centre[0] + sign * radius, centre[1] + sign * radius]);
        }
        let [x, y] = self.place(centre);
        let r = radius * STEP;
        let _ = writeln!(self.shapes, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{r:.2}\" {style}/>");
    }

    /// A word, its middle at a place; `size` in steps.
    pub(crate) fn text(&mut self, at: [f64; 2], size: f64, text: &str) {
        let [x, y] = self.place(at);
        let (y, size) = (y + 0.35 * size * STEP, size * STEP);
        let _ = writeln!(
            self.shapes,
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size:.1}\" text-anchor=\"middle\" \
             font-family=\"sans-serif\" fill=\"#0f172a\">{text}</text>"
        );
    }

    fn path(&mut self, points: &[[f64; 2]]) -> String {
        let mut path = String::new();
        for &p in points {
            let [x, y] = self.place(p);
            let _ = write!(path, "{x:.2},{y:.2} ");
        }
        path
    }

    /// Where a place is drawn, y downwards; the picture grows to hold it.
    fn place(&mut self, p: [f64; 2]) -> [f64; 2] {
        let p = [p[0] + self.origin[0], p[1] + self.origin[1]];
        self.low = [self.low[0].min(p[0]), self.low[1].min(p[1])];
        self.high = [self.high[0].max(p[0]), self.high[1].max(p[1])];
        [p[0] * STEP, -p[1] * STEP]
    }

    /// The picture as SVG.
    pub(crate) fn finish(self) -> String {
        let [x, y] = [self.low[0] * STEP - 4.0, -self.high[1] * STEP - 4.0];
        let size = [0, 1].map(|i| (self.high[i] - self.low[i]) * STEP + 8.0);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w:.0}\" height=\"{h:.0}\" \
             viewBox=\"{x:.1} {y:.1} {w:.1} {h:.1}\" stroke-linejoin=\"round\">\n{}</svg>\n",
            self.shapes,
            w = size[0],
            h = size[1],
        )
    }
}
