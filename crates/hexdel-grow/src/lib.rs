//! Meshes that grow out of the Delaunay triangulation of their input.
//!
//! Acute refinement: beginning with the constrained Delaunay triangulation, triangles with an angle below a bound or
//! above 90 degrees are repaired one by one, shortest edge first, by the cheapest of a list of repairs that works: a flip, a vertex moved
//! to where its whole star is within the bounds, several vertices moved at once, a vertex inserted. Vertices are added only
//! where bounds ask for them, unlike in a mesh of the grid, which is fine first and thinned afterwards.
//!
//! Where sizes are limited ([`Size`]) the plane is filled to them first.
//!
//! The crate knows meshes, segments, bounds and sizes, and no hexagons. That growth succeeds is not proved: triangles that are left
//! out of the bounds are listed in [`Grown::left`], and work is limited. `docs/growing.md` says how it works in detail.
//!
//! | module | what |
//! |---|---|
//! | `options`, `error` | what the caller says and gets |
//! | `start` | the first triangulation |
//! | `limits` | bounds as polynomial tests |
//! | `queue` | which triangle is next |
//! | `refiner` | repairs |
//!
//! The idea that a vertex is best placed so that its surroundings are good, not only the triangle at hand: Erten & Ungor,
//! "Quality Triangulations with Locally Optimal Steiner Points", SIAM J. Sci. Comput. 31 (2009).

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod error;
mod fewest;
mod limits;
mod options;
mod queue;
mod refiner;
mod start;

use hexdel_geom::{DVec2, Monitor, Phase};
use hexdel_optimize::edit::{EditMesh, NONE};

pub use error::GrowError;
pub use fewest::fewest;
pub use hexdel_optimize::edit::Kind;
use limits::RANGE_DEG;
pub use options::{Grown, Input, Options, Role, Size, Stats};
use refiner::Refiner;

/// Grows a mesh out of points and segments.
///
/// # Guarantees
///
/// Every point that is not carved away is a vertex bit for bit, every segment a union of edges whose other vertices
/// are the doubles nearest to points of the segment. Triangles are counter-clockwise, exactly. Every angle is between the bound and 90
/// degrees but for those listed in [`Grown::left`], and for angles below the bound between two segments at a point. Same input, same
/// bytes.
///
/// # Errors
///
/// [`GrowError`].
///
/// # Panics
///
/// Never; a broken invariant would be a defect of the library.
///
/// # Complexity
///
/// About 0.01 to 0.06 milliseconds a point, from 30 to 43 degrees; the number of vertices made is limited to 50 a
/// point, and some more by the ratio of lengths in the input.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, Unwatched};
/// use hexdel_grow::{Input, Options, grow};
///
/// let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0), (1.0, 1.0)].map(|(x, y)| DVec2::new(x, y));
/// let segments = [[0, 1], [1, 2], [2, 3], [3, 0]];
/// let input = Input { points: &points, segments: &segments, inside: true, ..Input::default() };
/// let grown = grow(&input, &Options::new(30.0), &Unwatched)?;
/// assert!(grown.left.is_empty());
/// assert_eq!(grown.mesh.vertices[4], points[4]);
/// # Ok::<(), hexdel_grow::GrowError>(())
/// ```
pub fn grow(input: &Input<'_>, options: &Options, monitor: &dyn Monitor) -> Result<Grown, GrowError> {
    refuse(input, options)?;
    let first = start::first(input)?;
    let ends: Vec<[DVec2; 2]> = input.segments.iter().map(|s| s.map(|v| input.points[v as usize])).collect();
    // Among segments a patch that is half mended is divided further.
    let strict = 2 * input.segments.len() > input.points.len();
    let mut shrunk: Vec<f64> = Vec::new();
    let mut best: Option<Grown> = None;
    for attempt in 0..ATTEMPTS {
        let mesh = first.mesh.clone();
        let mut refiner = Refiner::new(mesh, &ends, options, input.size, strict);
        refiner.protect(&|v| shrunk.get(v as usize).copied().unwrap_or(1.0));
        // Progress only advances: what is grown anew is not told.
        let monitor: &dyn Monitor = if attempt == 0 { monitor } else { &Quiet(monitor) };
        match refiner.run(monitor) {
            Err(GrowError::OutOfTime) if best.is_some() => break,
            other => other?,
        }
        let grown = finished(&refiner, input, &first.point_of);
        let stuck = refiner.stuck(first.point_of.len() as u32);
        if best.as_ref().is_none_or(|best| grown.left.len() < best.left.len()) {
            best = Some(grown);
        } else if attempt > 0 {
            break;
        }
        if stuck.is_empty() {
            break;
        }
        shrunk.resize(first.point_of.len(), 1.0);
        for v in stuck {
            shrunk[v as usize] *= 0.5;
        }
    }
    Ok(best.expect("the first attempt is the best so far"))
}

/// Bounds that growth does not reach, and segments that end nowhere.
fn refuse(input: &Input<'_>, options: &Options) -> Result<(), GrowError> {
    let [least, most] = RANGE_DEG;
    if !(least..=most).contains(&options.min_deg) {
        return Err(GrowError::Bound { asked: options.min_deg, kept: RANGE_DEG });
    }
    let points = input.points.len();
    let beyond = |s: &[u32; 2]| s.iter().map(|&v| v as usize).find(|&v| v >= points);
    match input.segments.iter().enumerate().find_map(|(i, s)| beyond(s).map(|point| (i, point))) {
        Some((segment, point)) => Err(GrowError::NoSuchPoint { segment, point, points }),
        None => Ok(()),
    }
}

/// How often a mesh is grown at most: anew with smaller tips where triangles beside them are bad.
const ATTEMPTS: u32 = 4;

/// A monitor that hears of nothing and may stop the work.
struct Quiet<'a>(&'a dyn Monitor);

impl Monitor for Quiet<'_> {
    fn progress(&self, _: Phase, _: u64, _: u64) {}

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// The mesh in arrays.
fn finished(refiner: &Refiner<'_>, input: &Input<'_>, point_of: &[u32]) -> Grown {
    let mesh = &refiner.mesh;
    let mut by_point: Vec<u32> = (0..point_of.len() as u32).collect();
    by_point.sort_unstable_by_key(|&v| (point_of[v as usize], v));
    let point_at = |v: u32| point_of.get(v as usize).copied().filter(|&point| point != NONE);
    let is_input = |v: &u32| point_at(*v).is_some();
    let exported = mesh.export(by_point.into_iter().filter(is_input));
    let mut made = Grown { mesh: exported.mesh, stats: refiner.stats, ..Grown::default() };
    for (new, &v) in exported.vertices.iter().enumerate() {
        let point = point_at(v);
        // Bit for bit, the sign of zero included.
        if let Some(point) = point {
            made.mesh.vertices[new] = input.points[point as usize];
        }
        made.point_of_vertex.push(point);
        made.kinds.push(mesh.kind[v as usize]);
    }
    made.edges = edges(mesh, &made);
    made.left = left(refiner);
    made
}

/// The marked edges, in the numbers of the finished mesh.
fn edges(mesh: &EditMesh, made: &Grown) -> Vec<([hexdel_geom::VertexId; 2], u32)> {
    let mut edges = Vec::new();
    for (t, ids) in mesh.triangles().zip(&made.mesh.triangles) {
        for i in 0..3 {
            let c = 3 * t + i;
            let twin = mesh.twin[c as usize];
            if let Some(segment) = mesh.segment(c).filter(|_| twin == NONE || twin > c) {
                let [a, b] = [1, 2].map(|k| ids[(i as usize + k) % 3]);
                edges.push(([a, b], segment));
            }
        }
    }
    edges
}

/// Bad triangles, in the numbers of the finished mesh.
fn left(refiner: &Refiner<'_>) -> Vec<u32> {
    let alive = refiner.mesh.triangles().zip(0..);
    alive.filter(|&(t, _)| refiner.is_bad(t)).map(|(_, number)| number).collect()
}
