//! Start meshes for examples and tests: the hexagon engine's, around points.

#![allow(dead_code, reason = "each program uses its own part")]

pub(crate) mod points;

use hexdel_classify::{Domain, Relocation, extract};
use hexdel_geom::{DVec2, PointSet, TriMesh, Unwatched, VertexId, closest_pair, smallest_enclosing_circle};
use hexdel_grid::Lattice;
use hexdel_optimize::{VertexKind, kinds_of};
use hexdel_refine::{Refiner, RuleSet, Start as Coarse};

/// `3 + 2 / sqrt(3)`, rounded up: as many spacings apart, two points are in
/// conflict with no rule.
const CONFLICT_REACH: f64 = 4.154_700_539;

/// How the start is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rule {
    /// All rules and templates: within 43.89 and 90 degrees.
    Templates,
    /// Legal classes only: not within any bounds yet.
    Coarse(Coarse),
}

/// A mesh and what its vertices may do.
pub(crate) struct Start {
    pub(crate) mesh: TriMesh,
    pub(crate) kinds: Vec<VertexKind>,
}

/// The engine's mesh of `points`, two or more.
pub(crate) fn start(points: &[DVec2], rule: Rule) -> Start {
    let (rules, relocation) = match rule {
        Rule::Templates => (RuleSet::extended(), Relocation::Full),
        Rule::Coarse(start) => (RuleSet::coarse(start), Relocation::Fins),
    };
    let set = PointSet::new(points).expect("finite points");
    let circle = smallest_enclosing_circle(set.sites()).expect("a point");
    let pair = closest_pair(set.sites()).expect("two points");
    let mut spacing = pair.distance / CONFLICT_REACH;
    while spacing < 4.0 * circle.radius {
        spacing *= 2.0;
    }
    let mut refiner = Refiner::new(Lattice::new(circle.center, spacing), rules);
    refiner.insert(set.sites(), &Unwatched).expect("the points can be told apart");
    let occupants = refiner.occupants();
    let domain = Domain::smallest(refiner.grid(), relocation);
    let dual = extract(refiner.grid_mut(), &occupants, domain, relocation, &Unwatched).expect("a small mesh");
    let mut fixed = vec![false; dual.mesh.vertices.len()];
    for v in &dual.vertex_of_occupant {
        fixed[v.index()] = true;
    }
    let kinds = kinds_of(&dual.mesh, |v: VertexId| fixed[v.index()]);
    Start { mesh: dual.mesh, kinds }
}
