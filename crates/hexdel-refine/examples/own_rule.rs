//! A rule of one's own beside those of the paper: hexagons near a front of refinement are
//! refined one step farther, so that sizes change more slowly.
//! `cargo run -p hexdel-refine --example own_rule`.
#![allow(clippy::print_stdout, reason = "what an example writes is its result")]

use hexdel_classify::{Domain, Relocation};
use hexdel_geom::{CertifyOptions, DVec2, Unwatched, certify};
use hexdel_grid::{Lattice, Window};
use hexdel_refine::{Refiner, Rule, RuleSet, Situation};
use std::error::Error;

/// Whatever is two steps from a subdivided hexagon exists on its level: every level is a
/// ring wider than it must be.
struct WideLevels;

impl Rule for WideLevels {
    fn name(&self) -> &'static str {
        "wide levels"
    }

    fn must_exist(&self, situation: &Situation) -> Window {
        situation.view.subdivided.dilated().dilated().dilated()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let points = [(0.0, 0.0), (0.03, 0.01), (0.7, -0.4), (-0.6, 0.5)].map(|(x, y)| DVec2::new(x, y));
    for (name, rules) in
        [("the paper's", RuleSet::extended()), ("with wide levels", RuleSet::extended().with(&WideLevels))]
    {
        let mut refiner = Refiner::new(Lattice::new(DVec2::ZERO, 4.0), rules);
        refiner.insert(&points, &Unwatched)?;
        assert_eq!(refiner.violation(), None, "every rule holds");
        let domain = Domain::smallest(refiner.grid(), Relocation::Full);
        let dual = refiner.extract(domain, Relocation::Full, &Unwatched)?;
        let found = certify(&dual.mesh, &CertifyOptions { inputs: Some(&points), ..Default::default() });
        println!(
            "{name}: {} triangles, {:.2} to {:.2} degrees, {} of {} points are vertices",
            found.triangles, found.min_angle_deg, found.max_angle_deg, found.inputs_kept, found.inputs
        );
        assert!(found.holds());
    }
    Ok(())
}
