//! One measurement, in a process of its own so that the peak of its memory is
//! its own, too.

use super::inputs::Input;
use crate::Outcome;
use hexdel_classify::{Domain, Relocation};
use hexdel_geom::{DVec2, Unwatched};
use hexdel_grid::Lattice;
use hexdel_refine::{Refiner, RuleSet};
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation as _};
use std::str::FromStr;
use std::time::Instant;

/// Who makes the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Mesher {
    /// This project.
    Hexdel,
    /// Ruppert's refinement, as spade has it.
    Spade,
    /// Nobody: pages of memory are written to, once.
    Memory,
}

/// What to measure.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) mesher: Mesher,
    pub(crate) input: Input,
    pub(crate) points: usize,
    pub(crate) threads: usize,
    /// Centre and radius of the hexagon to fill; only spade is told.
    pub(crate) hexagon: [f64; 3],
}

/// What was measured: one line of numbers between the two processes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Measured {
    pub(crate) triangles: f64,
    /// Wall time and processor time of refinement, seconds.
    pub(crate) refine: [f64; 2],
    /// The same of making vertices and triangles; none for spade.
    pub(crate) extract: [f64; 2],
    /// Tiles whose rules were asked.
    pub(crate) asked: f64,
    /// Tiles that hold a hexagon.
    pub(crate) tiles: f64,
    /// Most memory the process had, bytes.
    pub(crate) peak: f64,
    pub(crate) hexagon: [f64; 3],
}

impl Measured {
    pub(crate) fn wall(&self) -> f64 {
        self.refine[0] + self.extract[0]
    }

    pub(crate) fn cpu(&self) -> f64 {
        self.refine[1] + self.extract[1]
    }

    fn numbers(&self) -> [f64; 11] {
        let ([a, b], [c, d], [x, y, r]) = (self.refine, self.extract, self.hexagon);
        [self.triangles, a, b, c, d, self.asked, self.tiles, self.peak, x, y, r]
    }
}

impl std::fmt::Display for Measured {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.numbers().iter().try_for_each(|x| write!(f, "{x:?} "))
    }
}

impl FromStr for Measured {
    type Err = Box<dyn std::error::Error>;

    fn from_str(line: &str) -> Result<Self, Self::Err> {
        let numbers = line.split_whitespace().map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        let &[triangles, a, b, c, d, asked, tiles, peak, x, y, r] = numbers.as_slice() else {
            return Err(format!("not a measurement: {line:?}").into());
        };
        let (refine, extract, hexagon) = ([a, b], [c, d], [x, y, r]);
        Ok(Self { triangles, refine, extract, asked, tiles, peak, hexagon })
    }
}

impl Case {
    /// Measures and prints, for the process that asked.
    pub(crate) fn run(&self) -> Outcome {
        let points = self.input.points(self.points);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.threads).build()?;
        let mut measured = match self.mesher {
            Mesher::Hexdel => pool.install(|| hexdel(&points)).map_err(|e| e.to_string())?,
            Mesher::Spade => spade(&points, self.hexagon)?,
            Mesher::Memory => memory(self.points),
        };
        measured.peak = peak_memory()?;
        println!("{measured}");
        Ok(())
    }
}

fn hexdel(points: &[DVec2]) -> Result<Measured, Box<dyn std::error::Error + Send + Sync>> {
    let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    let centre = (low + high) / 2.0;
    let reach = points.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
    let mut refiner = Refiner::new(Lattice::new(centre, 4.0 * reach), RuleSet::extended());
    let clock = Clock::start();
    refiner.insert(points, &Unwatched)?;
    let refine = clock.read();
    let (clock, asked) = (Clock::start(), refiner.tiles_asked() as f64);
    let domain = Domain::around(refiner.grid(), 0).ok_or("a point lies above the base level")?;
    let dual = refiner.extract(domain, Relocation::Full, &Unwatched)?;
    let extract = clock.read();
    let tiles = refiner.grid().tiles();
    let tiles = (0..tiles.levels()).map(|level| tiles.level(level as u8).len() as f64).sum();
    let radius = f64::from(domain.radius) * refiner.grid().lattice().spacing(domain.base_level);
    let triangles = dual.mesh.triangles.len() as f64;
    let hexagon = [centre.x, centre.y, radius];
    Ok(Measured { triangles, refine, extract, asked, tiles, hexagon, ..Measured::default() })
}

/// Spade refines to 30 degrees inside the hexagon. Its Delaunay triangulation
/// of the points, from which it starts, is not counted.
fn spade(points: &[DVec2], [x, y, radius]: [f64; 3]) -> Result<Measured, Box<dyn std::error::Error>> {
    let corner = |i: usize| {
        let at = DVec2::new(x, y) + DVec2::from_angle(std::f64::consts::FRAC_PI_3 * i as f64) * radius;
        Point2::new(at.x, at.y)
    };
    let vertices = points.iter().map(|p| Point2::new(p.x, p.y)).chain((0..6).map(corner)).collect();
    let edges = (0..6).map(|i| [points.len() + i, points.len() + (i + 1) % 6]).collect();
    let mut mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::bulk_load_cdt(vertices, edges)?;
    let parameters = RefinementParameters::new()
        .with_angle_limit(AngleLimit::from_deg(30.0))
        .with_max_additional_vertices(100 * points.len() + 10_000)
        .exclude_outer_faces(true);
    let clock = Clock::start();
    let result = mesh.refine(parameters);
    let refine = clock.read();
    if !result.refinement_complete {
        return Err("spade ran out of vertices".into());
    }
    let triangles = (mesh.num_inner_faces() - result.excluded_faces.len()) as f64;
    Ok(Measured { triangles, refine, ..Measured::default() })
}

/// Writes fresh memory as large as the meshes of so many triangles: twelve
/// bytes each, and sixteen per vertex.
fn memory(triangles: usize) -> Measured {
    let clock = Clock::start();
    let mut pages = vec![0_u64; triangles * 20 / 8];
    for (i, word) in pages.iter_mut().enumerate() {
        *word = i as u64;
    }
    let refine = clock.read();
    std::hint::black_box(&pages);
    Measured { triangles: triangles as f64, refine, ..Measured::default() }
}

struct Clock {
    wall: Instant,
    cpu: f64,
}

impl Clock {
    fn start() -> Self {
        Self { wall: Instant::now(), cpu: cpu_seconds() }
    }

    /// Wall time and processor time since the start, seconds.
    fn read(&self) -> [f64; 2] {
        [self.wall.elapsed().as_secs_f64(), cpu_seconds() - self.cpu]
    }
}

/// Processor time of all threads so far; not a number where the system does
/// not tell.
fn cpu_seconds() -> f64 {
    let of_thread = |thread: std::io::Result<std::fs::DirEntry>| {
        let stat = std::fs::read_to_string(thread.ok()?.path().join("schedstat")).ok()?;
        stat.split_whitespace().next()?.parse::<f64>().ok()
    };
    let threads = std::fs::read_dir("/proc/self/task");
    threads.map_or(f64::NAN, |all| all.filter_map(of_thread).sum::<f64>() / 1e9)
}

/// The most memory this process had so far, bytes.
fn peak_memory() -> Result<f64, Box<dyn std::error::Error>> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:")).ok_or("no VmHWM")?;
    let kilobytes: f64 = line.trim().trim_end_matches("kB").trim().parse()?;
    Ok(kilobytes * 1024.0)
}
