//! From a valid PSLG to its mesh: the order of things.

mod fewest;

use crate::carve::{Carving, carve};
use crate::compact::{Kept, compact};
use crate::embed::embed;
use crate::error::PslgError;
use crate::estimate::refuse_too_many;
use crate::fans::{Fan, Scene, with_fans};
use crate::grown::{Grown, grown};
use crate::hull::{refuse_flat, with_hull};
use crate::judge::{Judge, Wedges};
use crate::limits::Limits;
use crate::net::Net;
use crate::options::{Deadline, Extent, Options, SegmentMethod, Timed};
use crate::output::{self, Parts};
use crate::paper;
use crate::result::PslgMesh;
use crate::rings::{count_rings, remove_starved};
use crate::sectors::Sectors;
use crate::sizing::{Demand, Features, lattice_for, refine};
use crate::validate::Validated;
use hexdel_classify::{Domain, DualError, Relocation, extract};
use hexdel_geom::monitor::check;
use hexdel_geom::{AngleBounds, DVec2, Monitor, TriMesh, VertexId, smallest_enclosing_circle};
use hexdel_grid::{Grid, Lattice};
use hexdel_optimize::{Effort, Sizing};
use hexdel_refine::Refiner;
use std::f64::consts::FRAC_PI_3;

/// Where a triangle has failed, hexagons are made this much smaller than its
/// edges; levels being powers of two, that is one level.
const REFINEMENT: f64 = 0.6;

/// Edge lengths around a failed triangle within which that happens.
const REFINED_RADIUS: f64 = 1.5;

/// Circumradius of the hexagon around an input that is not refined, in radii of the
/// input: its inscribed circle has some room.
const ROUGH_RADII: f64 = 1.25;

/// The same of the hexagon that a mesh grows in: room for triangles between the input and its sides.
const GROWN_RADII: f64 = 1.5;

/// Triangles out of the bounds after growth up to which they are repaired: of 34 meshes with up to 18 all
/// came out.
const MOST_LEFT: usize = 24;

/// Of a mesh that has grown to a size, a pass of removals that takes less than one triangle of so many is the last.
const WORTH: usize = 100;

/// The upper bound that growth keeps, degrees.
const RIGHT_DEG: f64 = 90.0;

/// Meshes a planar straight-line graph.
///
/// # Guarantees
///
/// Every input point in the extent is a vertex, bit for bit; every segment in
/// it is a union of edges, whose other vertices are the doubles nearest to
/// points of the segment. Every triangle is counter-clockwise, exactly, for the
/// coordinates as they are. Triangles that do not keep their bounds are listed
/// with the reason; that there are none is not guaranteed, but where segments
/// meet at 30 degrees or more it is what to expect. Same input, same bytes, at
/// any number of threads.
///
/// # Errors
///
/// [`PslgError`]. Work is bounded by [`Options::max_triangles`] and
/// [`Options::retries`].
///
/// # Complexity
///
/// Near-linear in the number of triangles.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, Pslg, Unwatched};
/// use hexdel_pslg::{Extent, Options, mesh, validate};
///
/// let mut square = Pslg::from_points(
///     [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y)).to_vec(),
/// );
/// square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
/// let made = mesh(&validate(&square)?, &Options::new().extent(Extent::Inside), &Unwatched)?;
/// assert!(made.holds() && made.certificate.max_angle_deg <= 90.0 + 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Holes and regions outside of the hull are to be left away before: [`Validated::confined`].
///
/// # Panics
///
/// Never; a broken invariant would be a defect of the library.
pub fn mesh(input: &Validated, options: &Options, monitor: &dyn Monitor) -> Result<PslgMesh, PslgError> {
    run(input, options, None, monitor).map_err(|error| error.measured(&input.pslg))
}

/// Like [`mesh`], with edges no longer than wanted at their ends and their
/// middles, those of segments included. Triangles with edges that are longer all
/// the same are listed as [`Reason::TooLong`](crate::Reason::TooLong).
///
/// # Errors
///
/// As [`mesh`], [`PslgError::InvalidSize`] and, of sizes that would take too many
/// triangles, [`PslgError::TooMany`].
///
/// # Complexity
///
/// As of [`mesh`], and some looks at the size for each triangle.
pub fn mesh_sized(
    input: &Validated,
    options: &Options,
    size: &dyn Sizing,
    monitor: &dyn Monitor,
) -> Result<PslgMesh, PslgError> {
    run(input, options, Some(size), monitor).map_err(|error| error.measured(&input.pslg))
}

fn run(
    input: &Validated,
    options: &Options,
    size: Option<&dyn Sizing>,
    monitor: &dyn Monitor,
) -> Result<PslgMesh, PslgError> {
    refuse(input, options)?;
    if options.method == SegmentMethod::Paper {
        return paper::mesh(input, options, size, monitor);
    }
    let deadline = Deadline::after(options.budget);
    let mesher = Mesher::new(input, options, size, &deadline, true);
    mesher.limits.iter().try_for_each(|limits| limits.check(options.max_triangles))?;
    refuse_too_many(input, mesher.carving.as_ref(), &mesher.lattice, options.max_triangles)?;
    let found = fewest::searched(input, options, size, &deadline, monitor)?;
    if let Some(found) = found.as_ref().filter(|found| fewest::is_sparse(found, input)) {
        return Ok(found.clone());
    }
    let made = mesher.mesh(monitor)?;
    let is_better =
        |found: &PslgMesh| !made.holds() || found.mesh.triangles.len() < made.mesh.triangles.len();
    Ok(found.filter(is_better).unwrap_or(made))
}

/// An error if the options ask for what no method keeps, or the input for what it must be given first.
fn refuse(input: &Validated, options: &Options) -> Result<(), PslgError> {
    if !input.pslg.polygons.is_empty() {
        return Err(PslgError::NotSeeded);
    }
    if let Some(area) = options.max_area.filter(|a| !(a.is_finite() && *a > 0.0)) {
        return Err(PslgError::InvalidArea { area });
    }
    let (asked, kept) = (options.far, AngleBounds::EXTENDED);
    // Upper bounds below right angles are left to the optimiser, which the paper's way goes without.
    let least_upper = match options.method {
        SegmentMethod::Paper => kept.max_deg(),
        SegmentMethod::Conform => AngleBounds::LEAST_GRADED_MAX_DEG,
    };
    if asked.min_deg() > kept.min_deg() || asked.max_deg() < least_upper {
        return Err(PslgError::BoundsBeyondMethod { asked, kept });
    }
    if options.extent == Extent::Hull { refuse_flat(input) } else { Ok(()) }
}

/// The grid of an attempt.
struct Plan {
    demands: Vec<Demand>,
    lattice: Lattice,
}

/// With faults beside a ring, hexagons of level 0 are made this much smaller. Edges
/// of a ring stay as they are; those beside them are found or not found depending
/// on how they fall on hexagons, whose sizes are powers of two.
const SHRUNK: f64 = 0.84;

/// Retries in vain with another lattice, or with other triangles too large.
const VAIN: u32 = 2;

/// Triangles beside rings up to which another lattice is tried: all of them must come
/// out on the same one. One with 14 has; of those with more than 16 none was seen to.
const FEW_BESIDE_RINGS: usize = 16;

/// Lengths of a failed triangle's longest edge between it and the ring to blame.
const BESIDE_RING: f64 = 4.0;

/// Triangles that are not as they should be.
struct Faults {
    /// Beside a sector in which no mesh could keep the bounds.
    hopeless: usize,
    /// All others, those too large or too long included.
    elsewhere: Vec<u32>,
}

impl Faults {
    /// What is hopeless counts less than anything else.
    fn score(&self) -> usize {
        self.elsewhere.len() * 1_000_000 + self.hopeless
    }
}

/// A wish for smaller hexagons around a failed triangle.
pub(crate) fn demand_at(net: &Net, t: u32) -> Demand {
    let [a, b, c] = net.corners(t);
    let lengths = [a.distance(b), b.distance(c), c.distance(a)];
    let mean = lengths.iter().sum::<f64>() / 3.0;
    // Removals make long edges; it is the short ones that had no room.
    let shortest = lengths.into_iter().fold(mean, f64::min);
    Demand { centre: (a + b + c) / 3.0, radius: REFINED_RADIUS * mean, spacing: REFINEMENT * shortest }
}

struct Mesher<'a> {
    input: &'a Validated,
    options: &'a Options,
    lattice: Lattice,
    /// Radius of the disc that the domain must hold.
    reach: f64,
    scene: Scene,
    sectors: Sectors,
    wedges: Wedges,
    limits: Option<Limits<'a>>,
    carving: Option<Carving<'a>>,
    deadline: &'a Deadline,
}

impl<'a> Mesher<'a> {
    fn new(
        input: &'a Validated,
        options: &'a Options,
        size: Option<&'a dyn Sizing>,
        deadline: &'a Deadline,
        fans: bool,
    ) -> Self {
        let circle =
            smallest_enclosing_circle(input.points.sites()).expect("a valid graph has a finite point");
        let pieces = if options.extent == Extent::Hull { with_hull(input) } else { input.pieces.clone() };
        let limits = Limits::of(input, options, size, circle);
        let most = |p: DVec2| limits.as_ref().map_or(f64::INFINITY, |limits| limits.radius_at(p));
        let carving = Carving::of(input, options.extent);
        let scene = if fans {
            with_fans(input, pieces, options.near, carving.as_ref(), &most)
        } else {
            Scene::plain(input, pieces)
        };
        let least = options.near.min_deg();
        let sectors = Sectors::of(&scene.sites, &scene.pieces, &scene.fans, least, carving.as_ref());
        let wedges = sectors.wedges(&scene.pieces);
        let reach = scene.sites.iter().map(|p| p.distance(circle.center)).fold(circle.radius, f64::max);
        let lattice = lattice_for(circle);
        Self { input, options, lattice, reach, scene, sectors, wedges, limits, carving, deadline }
    }

    fn judge(&self) -> Judge<'_> {
        Judge { near: self.options.near, far: self.options.far, wedges: &self.wedges }
    }

    fn sites(&self) -> &[DVec2] {
        &self.scene.sites
    }

    /// Whether a triangle lies where no mesh could keep the bounds.
    fn is_hopeless(&self, net: &Net, t: u32) -> bool {
        self.sectors.near(net.corners(t)).is_some_and(|(s, _)| s.is_hopeless())
    }

    /// The mesh that grows, if it is as it should be; otherwise one out of a grid, made anew while that helps.
    fn mesh(&self, monitor: &dyn Monitor) -> Result<PslgMesh, PslgError> {
        let plan = Plan { demands: Vec::new(), lattice: self.lattice };
        let first = Timed::new(monitor, self.deadline, false);
        // What is too near for coordinates, or takes too many triangles, is found on the grid, whatever comes next.
        let mut refined = self.refined(&plan, None, &first);
        let grown = if refined.is_ok() { self.grown(monitor)? } else { None };
        if let Some(net) = grown.as_ref().filter(|net| self.faults(net).score() == 0) {
            let made = self.finished(net.clone(), 0, monitor)?;
            if made.holds() {
                return Ok(made);
            }
        }
        if self.limits.is_some() {
            refined = refined.and_then(|_| self.refined(&plan, self.limits.as_ref(), &first));
        }
        let net = match refined.and_then(|refiner| self.embedded(refiner, &first)) {
            Ok(net) => net,
            Err(PslgError::Cancelled(_)) if first.has_stopped() => {
                let net = grown.map_or_else(|| self.rough(monitor), Ok)?;
                return self.finished(net, 0, monitor);
            }
            Err(error) => return Err(error),
        };
        self.deadline.note_first_mesh();
        let (net, retries) = self.retried(self.improved(net, monitor)?, plan, monitor)?;
        check(monitor)?;
        let net = self.divided(&net, monitor)?.unwrap_or(net);
        let score = self.faults(&net).score();
        let best = grown.filter(|grown| self.faults(grown).score() < score).unwrap_or(net);
        self.finished(self.thinned(best, monitor)?, retries, monitor)
    }

    /// The best mesh of several attempts, each on a grid that is finer where the one before has failed, and the
    /// number of attempts after the first.
    fn retried(&self, mut best: Net, mut plan: Plan, monitor: &dyn Monitor) -> Result<(Net, u32), PslgError> {
        let (mut retries, mut vain) = (0, 0);
        let mut faults = self.faults(&best);
        while !faults.elsewhere.is_empty() && retries < self.options.retries && !self.deadline.is_over() {
            // Smaller triangles next time are for what this does not mend.
            let mended = self.divided(&best, monitor)?;
            if let Some(net) = mended.filter(|net| self.faults(net).elsewhere.is_empty()) {
                return Ok((net, retries));
            }
            let ringed = self.note(&best, &faults.elsewhere, &mut plan);
            if ringed > FEW_BESIDE_RINGS {
                break;
            }
            let Some(net) = self.again(&plan, monitor)? else { break };
            retries += 1;
            let now = self.faults(&net);
            // Of triangles that are only too large others are left each time, until all around is fine enough.
            let large = now.elsewhere.iter().all(|&t| !self.judge().is_out(&net, t));
            if now.score() < faults.score() {
                (best, faults) = (net, now);
            } else if (ringed > 0 || large) && vain < VAIN {
                if large {
                    self.note(&net, &now.elsewhere, &mut plan);
                }
                vain += 1;
            } else {
                // What one more level has not helped is not for the next to help.
                break;
            }
        }
        Ok((best, retries))
    }

    /// Another mesh out of a grid; none if there is no finer one, or no time for it.
    fn again(&self, plan: &Plan, monitor: &dyn Monitor) -> Result<Option<Net>, PslgError> {
        let timed = Timed::new(monitor, self.deadline, true);
        let refined = self.refined(plan, self.limits.as_ref(), &timed);
        let net = refined.and_then(|refiner| self.embedded(refiner, &timed));
        match net.and_then(|net| self.improved(net, monitor)) {
            Ok(net) => Ok(Some(net)),
            Err(PslgError::Cancelled(c)) if !timed.has_stopped() => Err(c.into()),
            Err(_) => Ok(None),
        }
    }

    /// A mesh optimised and compacted.
    fn improved(&self, mut net: Net, monitor: &dyn Monitor) -> Result<Net, PslgError> {
        count_rings(&mut net);
        remove_starved(&mut net);
        compact(net, &self.kept(), self.options.compact.unwrap_or(Effort::Repair), monitor)
    }

    /// A mesh that no retry has brought within its bounds without the vertices that it can do without.
    fn thinned(&self, net: Net, monitor: &dyn Monitor) -> Result<Net, PslgError> {
        match self.options.compact {
            Some(effort) if !self.faults(&net).elsewhere.is_empty() && !self.deadline.is_over() => {
                compact(net, &Kept { bounds_first: false, ..self.kept() }, effort, monitor)
            }
            _ => Ok(net),
        }
    }

    /// A better mesh where triangles are too large or too long, if upper bounds are below right angles; none where
    /// nothing helps. A run of the optimiser divides before removals and at its end, and little while a mesh made for
    /// right angles is far from its bounds, so that more runs divide more.
    fn divided(&self, net: &Net, monitor: &dyn Monitor) -> Result<Option<Net>, PslgError> {
        let mut better: Option<Net> = None;
        if self.limits.is_none() || self.options.near.max_deg() >= RIGHT_DEG {
            return Ok(better);
        }
        let mut faults = self.faults(net);
        while !faults.elsewhere.is_empty() && !self.deadline.is_over() {
            let before = better.as_ref().unwrap_or(net).clone();
            let next = compact(before, &self.kept(), Effort::Repair, monitor)?;
            let of_next = self.faults(&next);
            if of_next.score() >= faults.score() {
                break;
            }
            (faults, better) = (of_next, Some(next));
        }
        Ok(better)
    }

    /// The mesh that grows out of the input, optimised; none where growth does not know what is asked for, or time
    /// was up before there was one.
    fn grown(&self, monitor: &dyn Monitor) -> Result<Option<Net>, PslgError> {
        let Some(effort) = self.options.compact else { return Ok(None) };
        let first = Timed::new(monitor, self.deadline, false);
        let mut options = hexdel_grow::Options::new(self.options.near.min_deg());
        options.most_for_size = self.options.max_triangles as u64 / 2;
        let size = self.limits.as_ref().map(|limits| limits as &dyn hexdel_grow::Size);
        let net = match grown(
            &self.scene,
            &self.input.pslg,
            self.options.extent,
            self.grown_corners(),
            &options,
            size,
            &first,
        ) {
            Err(PslgError::Cancelled(_)) if first.has_stopped() => return Ok(None),
            net => net?,
        };
        let Some(Grown { mut net, left }) = net else { return Ok(None) };
        self.deadline.note_first_mesh();
        count_rings(&mut net);
        let is_left = |t: u32| self.judge().is_out(&net, t) && !self.is_hopeless(&net, t);
        // Growth that has spent its limit leaves too many to repair; it knows no bound below right angles, so that
        // what is past one says nothing.
        let judged = self.options.near.max_deg() >= RIGHT_DEG;
        if judged && left.iter().filter(|&&t| is_left(t)).count() > MOST_LEFT {
            return Ok(None);
        }
        if self.limits.is_none() {
            return compact(net, &self.kept(), effort, monitor).map(Some);
        }
        // With sizes there is little to remove.
        let effort = if effort == Effort::Fast { Effort::Repair } else { effort };
        compact(net, &Kept { worth: WORTH, ..self.kept() }, effort, monitor).map(Some)
    }

    /// The corners of the hexagon that a mesh grows in.
    fn grown_corners(&self) -> [DVec2; 6] {
        self.hexagon(GROWN_RADII)
    }

    /// The corners of a hexagon around the input, whose circumradius is so many radii of that.
    fn hexagon(&self, radii: f64) -> [DVec2; 6] {
        let radius = radii * if self.reach > 0.0 { self.reach } else { 1.0 };
        std::array::from_fn(|i| {
            let (sin, cos) = libm::sincos(i as f64 * FRAC_PI_3);
            self.lattice.origin() + radius * DVec2::new(cos, sin)
        })
    }

    /// The sites and pieces with no other vertices than those of a hexagon around them:
    /// what there is time for when there is none for a grid.
    fn rough(&self, monitor: &dyn Monitor) -> Result<Net, PslgError> {
        let corners = self.hexagon(ROUGH_RADII);
        let hexagon = TriMesh {
            vertices: std::iter::once(self.lattice.origin()).chain(corners).collect(),
            triangles: (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6].map(VertexId::new)).collect(),
        };
        let mut scene = Scene::plain(self.input, self.scene.pieces[..self.scene.soft as usize].to_vec());
        scene.sites.clone_from(&self.scene.sites);
        scene.input_of_site.clone_from(&self.scene.input_of_site);
        scene.whole.fill(true);
        let net = embed(Net::of(&hexagon), &scene, monitor)?;
        self.without_holes(net)
    }

    /// What is not carved away.
    fn without_holes(&self, mut net: Net) -> Result<Net, PslgError> {
        carve(&mut net, &self.input.pslg.holes, self.options.extent != Extent::Hexagon);
        if net.alive().next().is_none() {
            return Err(PslgError::nothing_enclosed(self.input));
        }
        Ok(net)
    }

    /// Notes what would help triangles that are left: another lattice beside rings,
    /// smaller hexagons elsewhere. How many there are beside rings.
    fn note(&self, net: &Net, left: &[u32], plan: &mut Plan) -> usize {
        let (ringed, others): (Vec<u32>, Vec<u32>) =
            left.iter().partition(|&&t| self.judge().is_out(net, t) && self.is_beside_ring(net.corners(t)));
        plan.demands.extend(others.into_iter().map(|t| demand_at(net, t)));
        if !ringed.is_empty() {
            let lattice = plan.lattice;
            plan.lattice = Lattice::new(lattice.origin(), SHRUNK * lattice.spacing(0));
        }
        ringed.len()
    }

    /// Whether a triangle is beside the ring of a fan.
    fn is_beside_ring(&self, [a, b, c]: [DVec2; 3]) -> bool {
        let centre = (a + b + c) / 3.0;
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let off = |fan: &Fan| (self.sites()[fan.site as usize].distance(centre) - fan.radius).abs();
        self.scene.fans.iter().any(|fan| off(fan) <= BESIDE_RING * longest)
    }

    fn faults(&self, net: &Net) -> Faults {
        let bad: Vec<u32> = net.alive().filter(|&t| self.judge().is_out(net, t)).collect();
        let (hopeless, mut elsewhere): (Vec<u32>, Vec<u32>) =
            bad.iter().partition(|&&t| self.is_hopeless(net, t));
        elsewhere.extend(self.limits.iter().flat_map(|limits| limits.exceeded(net)));
        Faults { hopeless: hopeless.len(), elsewhere }
    }

    fn kept(&self) -> Kept<'_> {
        Kept {
            pieces: &self.scene.pieces,
            sectors: &self.sectors,
            judge: self.judge(),
            limits: self.limits.as_ref(),
            strict: false,
            bounds_first: true,
            worth: 0,
            deadline: self.deadline,
        }
    }

    /// The result; without right angles near segments if rounding took some of
    /// them from Delaunay.
    fn finished(&self, net: Net, retries: u32, monitor: &dyn Monitor) -> Result<PslgMesh, PslgError> {
        let parts = Parts {
            input: self.input,
            scene: &self.scene,
            sectors: &self.sectors,
            judge: self.judge(),
            method: self.options.method,
            deadline: self.deadline,
            limits: self.limits.as_ref(),
        };
        let made = output::finish(net.clone(), &parts, retries, monitor)?;
        if made.certificate.delaunay || !made.failed.is_empty() || made.budget_spent {
            return Ok(made);
        }
        let again = compact(net, &Kept { strict: true, ..self.kept() }, Effort::Repair, monitor)?;
        let again = output::finish(again, &parts, retries, monitor)?;
        Ok(if again.certificate.delaunay && again.failed.is_empty() { again } else { made })
    }

    /// The patch at a base level as fine as sizes along its rim want it.
    fn with_fine_rim(&self, mut domain: Domain, lattice: &Lattice) -> Domain {
        let Some(limits) = self.limits.as_ref().filter(|_| self.options.extent == Extent::Hexagon) else {
            return domain;
        };
        let wanted = limits.along_rim(f64::from(domain.radius) * lattice.spacing(domain.base_level));
        while lattice.spacing(domain.base_level) > wanted
            && 2 * domain.radius <= Domain::MAX_RADIUS
            && domain.base_level + 1 < Grid::MAX_LEVELS
        {
            domain = Domain { base_level: domain.base_level + 1, radius: 2 * domain.radius };
        }
        domain
    }

    /// A grid as fine as sites and pieces ask for, and limits.
    fn refined(
        &self,
        plan: &Plan,
        limits: Option<&Limits<'_>>,
        monitor: &dyn Monitor,
    ) -> Result<Refiner, PslgError> {
        let spacing =
            |p: DVec2, is_seen: bool| limits.map_or(f64::INFINITY, |limits| limits.spacing_at(p, is_seen));
        let features = Features {
            sites: self.sites(),
            pieces: &self.scene.pieces,
            input_of_site: &self.scene.input_of_site,
            demands: &plan.demands,
            carving: self.carving.as_ref(),
            limit: limits.map(|_| &spacing as &dyn Fn(DVec2, bool) -> f64),
            max_triangles: self.options.max_triangles,
        };
        refine(plan.lattice, &features, monitor)
    }

    /// A mesh with all sites and pieces in it, out of a grid.
    fn embedded(&self, mut refiner: Refiner, monitor: &dyn Monitor) -> Result<Net, PslgError> {
        let domain = Domain::smallest_reaching(refiner.grid(), Relocation::Full, self.reach);
        let domain = self.with_fine_rim(domain, refiner.grid().lattice());
        let too_many = || PslgError::too_many(self.options.max_triangles, None);
        let dual =
            extract(refiner.grid_mut(), &[], domain, Relocation::Full, monitor).map_err(|e| match e {
                DualError::Cancelled(c) => PslgError::Cancelled(c),
                _ => too_many(),
            })?;
        if dual.mesh.triangles.len() > self.options.max_triangles {
            return Err(too_many());
        }
        self.without_holes(embed(Net::of(&dual.mesh), &self.scene, monitor)?)
    }
}
