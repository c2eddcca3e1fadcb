//! Subdivides the grid around a place and writes it as SVG to standard output:
//! `cargo run -p hexdel-grid --example draw_grid -- 4 > grid.svg`, with the level to go to.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "what an example writes is its result")]

use hexdel_geom::DVec2;
use hexdel_grid::{Address, Direction, Grid, Hex, HexKind, Lattice, Neighbour};
use std::collections::BTreeSet;

fn main() {
    let level = std::env::args().nth(1).and_then(|level| level.parse().ok()).unwrap_or(4_u8).clamp(1, 9);
    let place = DVec2::new(0.3, 0.2);
    let mut grid = Grid::new(Lattice::new(DVec2::ZERO, 1.0));
    // Until a leaf of that level holds the place. Balance subdivides what else must be.
    loop {
        match grid.locate(place) {
            (at, found, HexKind::Leaf) if at < level => grid.subdivide(Address::new(at, found.hex)),
            // Half a hexagon: the one whose fin it is makes it whole.
            (at, _, HexKind::Semi { of }) => grid.subdivide(Address::new(at - 1, of)),
            _ => break,
        }
    }

    println!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-4 -4 8 8\" width=\"720\" height=\"720\">");
    // Coarse ones first: what the finer ones leave of a subdivided hexagon is its semi-hexagons.
    for at in standing(&grid) {
        let (centre, size) = (grid.lattice().position(at), grid.lattice().spacing(at.level));
        let corner = |i: i32| {
            let p = centre + DVec2::from_angle(f64::from(30 + 60 * i).to_radians()) * (size / 3_f64.sqrt());
            format!("{:.4},{:.4}", p.x, -p.y)
        };
        let points: Vec<String> = (0..6).map(corner).collect();
        let shade = 100 - 8 * u32::from(at.level + u8::from(grid.is_subdivided(at)));
        println!(
            "<polygon points=\"{}\" fill=\"hsl(210 60% {shade}%)\" stroke=\"#475569\" stroke-width=\"{:.4}\"/>",
            points.join(" "),
            0.03 * size
        );
    }
    println!("</svg>");
    let leaves: Vec<Address> = standing(&grid).into_iter().filter(|&at| !grid.is_subdivided(at)).collect();
    let finer = |at: &&Address| {
        Direction::ALL.iter().any(|&d| matches!(grid.neighbour(**at, d), Some(Neighbour::Finer(_))))
    };
    eprintln!("{} leaves, {} of them beside finer ones", leaves.len(), leaves.iter().filter(finer).count());
}

/// All full hexagons within three steps of level 0, each once, by level.
fn standing(grid: &Grid) -> BTreeSet<Address> {
    let mut waiting: Vec<Address> = Hex::ORIGIN.disc(3).map(|hex| Address::new(0, hex)).collect();
    let mut standing = BTreeSet::new();
    while let Some(at) = waiting.pop() {
        if !matches!(grid.kind(at), HexKind::Leaf | HexKind::Subdivided) || !standing.insert(at) {
            continue;
        }
        if grid.is_subdivided(at) {
            // Its scaled centre, and what has been joined at its sides.
            waiting.extend(at.hex.scaled().disc(1).map(|hex| Address::new(at.level + 1, hex)));
        }
    }
    standing
}
