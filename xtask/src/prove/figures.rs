//! Pictures of witnesses, as SVG.

use super::regions::Extreme;
use super::search::Witness;
use hexdel_classify::dual::local::LocalTriangle;
use hexdel_classify::{Classes, Offset};
use hexdel_grid::{Direction, Hex, Window};
use std::fmt::Write as _;

/// Pixels per lattice step.
const STEP: f64 = 48.0;

/// A picture: shapes in lattice steps, y upwards, with the box they fill.
#[derive(Default)]
struct Picture {
    shapes: String,
    low: [f64; 2],
    high: [f64; 2],
}

impl Picture {
    fn new() -> Self {
        Self { shapes: String::new(), low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] }
    }

    fn polygon(&mut self, points: &[[f64; 2]], style: &str) {
        let mut path = String::new();
        for &p in points {
            self.low = [self.low[0].min(p[0]), self.low[1].min(p[1])];
            self.high = [self.high[0].max(p[0]), self.high[1].max(p[1])];
            let _ = write!(path, "{:.2},{:.2} ", p[0] * STEP, -p[1] * STEP);
        }
        let _ = writeln!(self.shapes, "<polygon points=\"{}\" {style}/>", path.trim_end());
    }

    fn hexagon(&mut self, centre: [f64; 2], size: f64, style: &str) {
        let corners = [30_f64, 90.0, 150.0, 210.0, 270.0, 330.0].map(|a| {
            let (s, c) = a.to_radians().sin_cos();
            let r = size / 3.0_f64.sqrt();
            [centre[0] + r * c, centre[1] + r * s]
        });
        self.polygon(&corners, style);
    }

    fn dot(&mut self, at: [f64; 2]) {
        let (x, y) = (at[0] * STEP, -at[1] * STEP);
        let _ = writeln!(self.shapes, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3\" fill=\"#c2410c\"/>");
    }

    fn finish(self) -> String {
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

const LEAF: &str = "fill=\"#ffffff\" stroke=\"#94a3b8\" stroke-width=\"1\"";
const PATCH: &str = "fill=\"#e0f2fe\" stroke=\"#94a3b8\" stroke-width=\"1\"";
const SUBDIVIDED: &str = "fill=\"#cbd5e1\" stroke=\"#64748b\" stroke-width=\"1\"";
const SCALED: &str = "fill=\"#f1f5f9\" stroke=\"#64748b\" stroke-width=\"1\"";
const DUAL: &str = "fill=\"none\" stroke=\"#0f172a\" stroke-width=\"1.2\"";
const MARKED: &str = "fill=\"#fb923c\" fill-opacity=\"0.6\" stroke=\"#c2410c\" stroke-width=\"2\"";
const REGION: &str = "fill=\"#bbf7d0\" stroke=\"#15803d\" stroke-width=\"1\"";

/// A witness: the hexagons, subdivided ones grey with their scaled centres, the
/// patch blue, the unit's triangles, and the one with the extreme angle, a dot
/// at its corner.
pub(crate) fn witness(w: &Witness) -> String {
    let mut picture = Picture::new();
    let shown: Window = w.patch.dilated() & Window::with_margin(3);
    for at in shown.iter() {
        let style = match (w.subdivided.contains(at), w.patch.contains(at)) {
            (true, _) => SUBDIVIDED,
            (false, true) => PATCH,
            (false, false) => LEAF,
        };
        picture.hexagon(centre(at), 1.0, style);
        if w.subdivided.contains(at) {
            picture.hexagon(centre(at), 0.5, SCALED);
        }
    }
    let classes = Classes::of(w.subdivided);
    w.unit.triangles(&classes, |t: LocalTriangle| picture.polygon(&t.corners.map(cartesian), DUAL));
    picture.polygon(&w.corners.map(cartesian), MARKED);
    picture.dot(cartesian(w.corners[w.corner]));
    picture.finish()
}

/// A triangle at an occupied hexagon, the ring's hexagons and the half-size
/// hexagon.
pub(crate) fn occupied(e: &Extreme) -> String {
    let mut picture = Picture::new();
    for at in Hex::ORIGIN.disc(2) {
        picture.hexagon(centre(at), 1.0, if at.norm() < 2 { PATCH } else { LEAF });
    }
    let dodecagon: Vec<_> = Direction::ALL
        .into_iter()
        .flat_map(|d| {
            let (a, b) = (d.step(), d.step() + d.turned(1).step());
            [centre(a).map(|x| x * 2.0 / 7.0), centre(b).map(|x| x / 6.0)]
        })
        .collect();
    picture.polygon(&dodecagon, REGION);
    picture.polygon(&e.corners, MARKED);
    picture.dot(e.corners[e.corner]);
    picture.finish()
}

fn centre(at: Hex) -> [f64; 2] {
    cartesian(Offset::of(at))
}

fn cartesian(o: Offset) -> [f64; 2] {
    let v = o.cartesian();
    [v.x, v.y]
}
