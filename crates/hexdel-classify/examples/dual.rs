//! The dual mesh of a grid made by hand, with the classes that its hexagons have:
//! `cargo run -p hexdel-classify --example dual`.
#![allow(clippy::print_stdout, reason = "what an example writes is its result")]

use hexdel_classify::hexagons::hexagons;
use hexdel_classify::{Domain, Relocation, extract};
use hexdel_geom::{AngleBounds, CertifyOptions, DVec2, Unwatched, certify};
use hexdel_grid::{Address, Grid, Hex, Lattice};
use std::collections::BTreeMap;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    // A ring of twelve subdivided hexagons: the six inside make a blossom.
    let mut grid = Grid::new(Lattice::new(DVec2::ZERO, 1.0));
    for hex in Hex::ORIGIN.ring(2) {
        grid.subdivide(Address::new(0, hex));
    }
    let domain = Domain::around(&grid, 0).ok_or("nothing lies above level 0")?;

    let mut classes = BTreeMap::new();
    for hexagon in hexagons(&grid, domain, &[]) {
        *classes.entry(hexagon.class).or_insert(0) += 1;
    }
    for (class, count) in classes {
        println!("{count:>4} {}", class.map_or("semi-hexagons".to_owned(), |class| format!("{class:?}")));
    }

    // The paper's plain dual, and the one with its vertices moved by class.
    for (name, relocation) in [("plain", Relocation::Occupied), ("relocated", Relocation::Full)] {
        let dual = extract(&mut grid, &[], domain, relocation, &Unwatched)?;
        let bounds = AngleBounds::SIMPLE;
        let found = certify(&dual.mesh, &CertifyOptions { bounds, ..CertifyOptions::default() });
        println!(
            "{name}: {} triangles, {:.2} to {:.2} degrees",
            found.triangles, found.min_angle_deg, found.max_angle_deg
        );
    }
    Ok(())
}
