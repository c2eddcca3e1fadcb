//! Pictures of witnesses, as SVG.

use super::regions::Extreme;
use super::search::Witness;
use crate::drawing::Picture;
use hexdel_classify::dual::local::{self, LocalTriangle};
use hexdel_classify::{Classes, Offset};
use hexdel_grid::{Direction, Hex, Window};

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

/// A pattern with nothing marked: the units around a top, and those of all lattice triangles
/// near it.
pub(crate) fn pattern(subdivided: Window, top: Hex, worst: Option<&Witness>) -> String {
    let mut picture = Picture::new();
    for at in top.disc(3) {
        let style = if subdivided.contains(at) { SUBDIVIDED } else { LEAF };
        picture.hexagon(centre(at), 1.0, style);
        if subdivided.contains(at) {
            picture.hexagon(centre(at), 0.5, SCALED);
        }
    }
    let classes = Classes::of(subdivided);
    let mut push = |t: LocalTriangle| picture.polygon(&t.corners.map(cartesian), DUAL);
    for at in top.disc(1) {
        local::of_star(&classes, at, &mut push);
        for d in [0, 1] {
            let (d, next) = (Direction::new(d), Direction::new(d + 1));
            local::of_lattice_triangle(&classes, [at, at.neighbour(d), at.neighbour(next)], &mut push);
        }
    }
    if let Some(w) = worst {
        picture.polygon(&w.corners.map(cartesian), MARKED);
        picture.dot(cartesian(w.corners[w.corner]));
    }
    picture.finish()
}

/// Where the point of an occupied hexagon may lie (paper, Fig. 8): with the ring at its
/// place, the half-size hexagon within; nearest to one corner, with the ring shifted.
pub(crate) fn regions(dodecagon: &[[f64; 2]], kites: &[Vec<[f64; 2]>; 2], shift: [f64; 2]) -> String {
    let mut picture = Picture::new();
    for (i, shifted) in [false, true].into_iter().enumerate() {
        picture.move_to([4.2 * i as f64, 0.0]);
        for at in Hex::ORIGIN.disc(1) {
            picture.hexagon(centre(at), 1.0, if at.norm() == 0 { PATCH } else { LEAF });
        }
        if shifted {
            for kite in kites {
                picture.polygon(kite, REGION);
            }
        } else {
            picture.polygon(dodecagon, REGION);
            picture.hexagon([0.0; 2], 0.5, DUAL);
        }
        for d in Direction::ALL {
            let [x, y] = centre(d.step());
            picture.dot(if shifted { [x + shift[0], y + shift[1]] } else { [x, y] });
        }
    }
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
