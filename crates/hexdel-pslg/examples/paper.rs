//! Meshes PSLGs by the paper's own method for segments and says what angles it
//! leaves.
//!
//! ```text
//! cargo run --release -p hexdel-pslg --example paper -- [hexagon|inside|turns:N] NAME ...
//! ```
//!
//! A name is a `.poly` file, `line`, `square`, `FAMILY:SEED` or `sweep:SEEDS`. What
//! stands before it is for all that follow.
//!
//! Columns: triangles; smallest and largest angle; the same among triangles
//! without a corner on a point or segment; triangles that do not keep 30 to 90
//! degrees. With turns, the range of each column for a PSLG turned N times by the
//! N-th part of 60 degrees, as lines meet the lattice differently then. A sweep
//! goes through all families of small PSLGs with so many seeds each, and ten
//! times as many random PSLGs.

#[path = "../tests/support/mod.rs"]
mod support;

use hexdel_geom::{DVec2, Pslg, TriangleId, Unwatched, quality};
use hexdel_io::read_points;
use hexdel_pslg::{Extent, Options, PslgMesh, SegmentMethod, mesh, repair, validate};
use std::error::Error;
use std::f64::consts::FRAC_PI_3;
use std::io::Write;

fn main() -> Result<(), Box<dyn Error>> {
    let mut options = Options::new().method(SegmentMethod::Paper);
    let mut turns = 1;
    for name in std::env::args().skip(1) {
        match name.as_str() {
            "hexagon" => options = options.extent(Extent::Hexagon),
            "inside" => options = options.extent(Extent::Inside),
            _ => match name.split_once(':') {
                Some(("turns", n)) => turns = n.parse()?,
                Some(("sweep", seeds)) => sweep(seeds.parse()?, &options)?,
                _ => all_turns(&name, turns, &options)?,
            },
        }
    }
    Ok(())
}

fn all_turns(name: &str, turns: u32, options: &Options) -> Result<(), Box<dyn Error>> {
    let graph = graph(name)?;
    let mut columns: [[f64; 2]; 6] = [[f64::INFINITY, f64::NEG_INFINITY]; 6];
    let mut holds = true;
    for turn in 0..turns {
        let turned = turned(&graph, FRAC_PI_3 * f64::from(turn) / f64::from(turns));
        let made = mesh(&validate(&turned)?, options, &Unwatched)?;
        holds &= made.holds();
        let c = &made.certificate;
        let [least, most] = angles_away(&made);
        let (count, failed) = (c.triangles as f64, made.failed.len() as f64);
        let found = [count, c.min_angle_deg, c.max_angle_deg, least, most, failed];
        for (column, x) in columns.iter_mut().zip(found) {
            *column = [column[0].min(x), column[1].max(x)];
        }
    }
    let mut out = std::io::stdout();
    write!(out, "{name:40}")?;
    for ([min, max], digits) in columns.into_iter().zip([0, 1, 1, 4, 4, 0]) {
        write!(out, "  {min:.digits$}")?;
        if turns > 1 {
            write!(out, "..{max:.digits$}")?;
        }
    }
    writeln!(out, "  {}", if holds { "holds" } else { "DOES NOT HOLD" })?;
    Ok(())
}

fn turned(graph: &Pslg, by: f64) -> Pslg {
    let turn = DVec2::from_angle(by);
    let mut turned = graph.clone();
    let regions = turned.regions.iter_mut().map(|r| &mut r.point);
    for p in turned.points.iter_mut().chain(&mut turned.holes).chain(regions) {
        *p = turn.rotate(*p);
    }
    turned
}

fn graph(name: &str) -> Result<Pslg, Box<dyn Error>> {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y));
    Ok(match name.split_once(':') {
        Some((family, seed)) => support::family(family, seed.parse()?),
        None if name == "line" => {
            let mut line = Pslg::from_points(vec![corners[0], DVec2::new(1.0, 0.3)]);
            line.segments.push([0, 1]);
            line
        }
        None if name == "square" => {
            let mut square = Pslg::from_points(corners.to_vec());
            square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
            square
        }
        None => read_points(name)?,
    })
}

/// The smallest and largest angle of triangles that have no corner on a point
/// or segment.
fn angles_away(made: &PslgMesh) -> [f64; 2] {
    let mut near = vec![false; made.mesh.vertices.len()];
    for v in made.edges.iter().filter(|e| e.segment.is_some()).flat_map(|e| e.ends) {
        near[v.index()] = true;
    }
    for v in made.vertex_of_point.iter().flatten() {
        near[v.index()] = true;
    }
    let away = made.mesh.triangles.iter().enumerate().filter(|(_, t)| t.iter().all(|v| !near[v.index()]));
    away.flat_map(|(t, _)| quality::angles_deg(made.mesh.corners(TriangleId::new(t))))
        .fold([180.0, 0.0], |[least, most], a| [a.min(least), a.max(most)])
}

/// What came out for many PSLGs.
struct Tally {
    meshes: usize,
    refused: usize,
    /// Meshes that are invalid, or do not hold what the method promises.
    wrong: usize,
    least: f64,
    most: f64,
}

impl Tally {
    fn of(graphs: impl Iterator<Item = Pslg>, options: &Options) -> Result<Self, Box<dyn Error>> {
        let mut tally = Self { meshes: 0, refused: 0, wrong: 0, least: 180.0, most: 0.0 };
        for graph in graphs {
            let Ok(made) = mesh(&validate(&graph)?, options, &Unwatched) else {
                tally.refused += 1;
                continue;
            };
            tally.meshes += 1;
            tally.wrong += usize::from(!made.holds() || support::check(&graph, &made).is_err());
            tally.least = tally.least.min(made.certificate.min_angle_deg);
            tally.most = tally.most.max(made.certificate.max_angle_deg);
        }
        Ok(tally)
    }

    fn print(&self, name: &str) -> Result<(), Box<dyn Error>> {
        writeln!(
            std::io::stdout(),
            "{name:14} {:6} meshes, {:4} refused, {} wrong, {:6.2} to {:6.2} degrees",
            self.meshes,
            self.refused,
            self.wrong,
            self.least,
            self.most
        )?;
        Ok(())
    }
}

fn sweep(seeds: u64, options: &Options) -> Result<(), Box<dyn Error>> {
    let options = options.clone().max_triangles(200_000);
    for name in support::FAMILIES {
        Tally::of((0..seeds).map(|seed| support::family(name, seed)), &options)?.print(name)?;
    }
    let random = (0..10 * seeds).filter_map(|seed| {
        let mut graph = support::random_graph(seed);
        graph.holes.clear();
        if validate(&graph).is_ok() { Some(graph) } else { repair(&graph, 1e-6).ok().map(|r| r.0) }
    });
    Tally::of(random, &options)?.print("random")
}
