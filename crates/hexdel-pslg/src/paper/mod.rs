//! The paper's own way with segments (section 7).
//!
//! Centres of hexagons that a segment passes are moved onto it. Segments are
//! unions of edges then, but the bounds are lost around them; one hexagon away
//! they are kept. The conforming method exists because of that; this one is
//! there to compare with.
//!
//! What the paper leaves open, and how it is read, is said where it matters and
//! summed up in `docs/pslg.md`. Two things are beyond the paper: a centre is not
//! moved if that would turn a triangle over, and where a segment is then no
//! union of edges, edges are flipped until it is.
//!
//! | module | what | section |
//! |---|---|---|
//! | [`assign`] | which hexagons a segment passes | 7.1 |
//! | [`rules`] | how fine they must be | 7.2 |
//! | [`project`] | where their centres go | 7.3 |
//! | [`place`] | moving and splitting them | 7.3, 7.4 |
//! | [`connect`] | segments become edges | |

mod assign;
mod connect;
mod place;
mod project;
mod rules;

use crate::carve::carve;
use crate::error::PslgError;
use crate::fans;
use crate::hull::with_hull;
use crate::judge::{Judge, Wedges};
use crate::limits::Limits;
use crate::mesher::demand_at;
use crate::net::{Kind, Net};
use crate::options::{Deadline, Extent, Options};
use crate::output::{self, Parts};
use crate::result::PslgMesh;
use crate::sectors::Sectors;
use crate::sizing::{Demand, Features, lattice_for, refine};
use crate::validate::Validated;
use hexdel_classify::{Domain, DualError, Occupant, Relocation, extract};
use hexdel_geom::monitor::check;
use hexdel_geom::{
    AngleBounds, Circle, DVec2, Monitor, VertexId, restore_delaunay, settle_rounding,
    smallest_enclosing_circle,
};
use hexdel_grid::{Lattice, Located};
use hexdel_optimize::Sizing;
use hexdel_refine::{Refiner, RuleSet};
use rules::{Passed, Scene};

/// Meshes a PSLG by the paper's method.
///
/// # Errors
///
/// [`PslgError`].
pub(crate) fn mesh(
    input: &Validated,
    options: &Options,
    size: Option<&dyn Sizing>,
    monitor: &dyn Monitor,
) -> Result<PslgMesh, PslgError> {
    let pieces = if options.extent == Extent::Hull { with_hull(input) } else { input.pieces.clone() };
    let scene = Scene {
        sites: input.points.sites(),
        pieces: &pieces,
        input_of_site: input.points.input_of_site(),
        max_triangles: options.max_triangles,
    };
    let circle = smallest_enclosing_circle(scene.sites).expect("a valid graph has a finite point");
    let limits = Limits::of(input, options, size, circle);
    limits.iter().try_for_each(|limits| limits.check(options.max_triangles))?;
    let mut demands = Vec::new();
    let mut attempt = 0;
    // Only limits ask for another attempt: angles are what they are.
    let net = loop {
        let refiner = start(circle, limits.as_ref(), &demands, options, monitor)?;
        let mut net = embedded(refiner, &scene, circle.radius, monitor)?;
        carve(&mut net, &input.pslg.holes, options.extent != Extent::Hexagon);
        let large = limits.as_ref().map_or_else(Vec::new, |limits| limits.exceeded(&net));
        if large.is_empty() || attempt == options.retries {
            break net;
        }
        demands.extend(large.iter().map(|&t| demand_at(&net, t)));
        attempt += 1;
    };
    if net.alive().next().is_none() {
        return Err(PslgError::nothing_enclosed(input));
    }
    check(monitor)?;
    let wedges = Wedges::default();
    let judge = Judge { near: options.near, far: options.far, wedges: &wedges };
    // Templates excuse more than narrow corners could.
    let sectors = Sectors::of(&[], &[], &[], 0.0, None);
    // Nothing here takes time that could be spared.
    let deadline = Deadline::after(None);
    let plain = fans::Scene::plain(input, pieces.clone());
    let parts = Parts {
        input,
        scene: &plain,
        sectors: &sectors,
        judge,
        method: options.method,
        deadline: &deadline,
        limits: limits.as_ref(),
    };
    output::finish(net, &parts, attempt, monitor)
}

/// A grid that knows nothing of points and segments, fine enough for limits on
/// areas and lengths.
fn start(
    circle: Circle,
    limits: Option<&Limits<'_>>,
    demands: &[Demand],
    options: &Options,
    monitor: &dyn Monitor,
) -> Result<Refiner, PslgError> {
    let lattice = lattice_for(circle);
    let Some(limits) = limits else { return Ok(Refiner::new(lattice, RuleSet::extended())) };
    let spacing = |p: DVec2, _| limits.spacing_at(p, true);
    let features = Features {
        sites: &[],
        pieces: &[],
        input_of_site: &[],
        demands,
        carving: None,
        limit: Some(&spacing),
        max_triangles: options.max_triangles,
    };
    refine(lattice, &features, monitor)
}

/// The dual mesh of a grid around all segments, with the segments in it.
fn embedded(
    mut refiner: Refiner,
    scene: &Scene<'_>,
    reach: f64,
    monitor: &dyn Monitor,
) -> Result<Net, PslgError> {
    let passed = rules::refine(&mut refiner, scene, monitor)?;
    let Plain { mut net, vertex_of_site, vertices } = plain(&mut refiner, scene, &passed, reach, monitor)?;
    check(monitor)?;
    let lattice = refiner.grid().lattice();
    let records = project::records(&net, lattice, scene, &passed, &vertices);
    place::place(&mut net, scene, &records, &vertices);
    check(monitor)?;
    connect::connect(&mut net, scene, &vertex_of_site)?;
    place::settle(&mut net, lattice, &passed, &vertices);
    Ok(net)
}

/// The mesh before segments go into it, within the bounds of points.
struct Plain {
    net: Net,
    vertex_of_site: Vec<u32>,
    /// Those of the hexagons that pieces pass, but for those with a point.
    vertices: Vec<Option<u32>>,
}

fn plain(
    refiner: &mut Refiner,
    scene: &Scene<'_>,
    passed: &[Passed],
    reach: f64,
    monitor: &dyn Monitor,
) -> Result<Plain, PslgError> {
    let lattice = *refiner.grid().lattice();
    let too_many = || PslgError::too_many(scene.max_triangles, None);
    let domain = Domain::smallest_reaching(refiner.grid(), Relocation::Full, reach);
    let occupants = refiner.occupants();
    // All that is passed gets a vertex to ask for; points come last, so that
    // their rings are where the points shift them.
    let mut all: Vec<Occupant> = passed.iter().map(|p| standing(refiner, &lattice, p)).collect();
    all.extend(&occupants);
    let mut dual =
        extract(refiner.grid_mut(), &all, domain, Relocation::Full, monitor).map_err(|e| match e {
            DualError::Cancelled(c) => PslgError::Cancelled(c),
            _ => too_many(),
        })?;
    if dual.mesh.triangles.len() > scene.max_triangles {
        return Err(too_many());
    }
    let (hexagons, points) = dual.vertex_of_occupant.split_at(passed.len());
    let mut is_point = vec![false; dual.mesh.vertices.len()];
    for v in points {
        is_point[v.index()] = true;
    }
    let free = |v: VertexId| !is_point[v.index()];
    settle_rounding(&mut dual.mesh, AngleBounds::EXTENDED, free);
    // Where that fails the certificate says so.
    let _ = restore_delaunay(&mut dual.mesh, AngleBounds::EXTENDED, free);
    let mut net = Net::of(&dual.mesh);
    net.lines = (0..scene.pieces.len() as u32).map(|p| scene.ends(p)).collect();
    for (site, v) in points.iter().enumerate() {
        net.move_to(v.index() as u32, scene.sites[site], Kind::Site(site as u32));
    }
    let number = |v: &VertexId| Some(v.index() as u32).filter(|_| free(*v));
    let vertices = hexagons.iter().map(number).collect();
    Ok(Plain { vertex_of_site: points.iter().map(|v| v.index() as u32).collect(), vertices, net })
}

/// A hexagon as if a point lay in its centre.
fn standing(refiner: &mut Refiner, lattice: &Lattice, passed: &Passed) -> Occupant {
    let (tile, _) = refiner.grid_mut().tile_of(passed.at);
    let at = Located { hex: passed.at.hex, offset: DVec2::ZERO };
    Occupant { level: passed.at.level, at, tile, point: lattice.position(passed.at) }
}
