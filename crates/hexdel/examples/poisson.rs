//! Poisson's equation by two-point fluxes on a mesh of a planar straight-line
//! graph, and how fast the error falls.
//!
//! On a square with a slanted hole, `-div grad u = f` with `u` given on the
//! boundary. Unknowns are the values at the vertices; the flux between two of
//! them is their difference times the transmissibility of their edge, the
//! length of the face between their Voronoi cells over their distance. Nothing
//! else is needed, as faces and edges cross at right angles; and as no
//! transmissibility is negative, the matrix is an M-matrix: no value lies
//! outside the range of those around it.
//!
//! ```sh
//! cargo run --release -p hexdel --example poisson
//! ```

#![allow(clippy::print_stdout, reason = "the table is what the example is for")]

use hexdel::geom::{Pslg, TriMesh, Voronoi};
use hexdel::{DVec2, Mesher, VertexId};
use std::error::Error;
use std::f64::consts::PI;

/// What one mesh gave.
#[derive(Clone, Copy, Debug)]
pub struct Solved {
    /// The longest edge.
    pub longest_edge: f64,
    /// Vertices off the boundary.
    pub unknowns: usize,
    /// The smallest transmissibility.
    pub min_transmissibility: f64,
    /// Root of the mean square error, weighed by the areas of the cells.
    pub error: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("| longest edge | unknowns | smallest transmissibility | error | order |");
    println!("|---:|---:|---:|---:|---:|");
    let mut before: Option<Solved> = None;
    for level in 0..5 {
        let area = 0.01 / 4_f64.powi(level);
        let solved = solve(area)?;
        let order = before.map_or_else(String::new, |before| format!("{:.2}", order(before, solved)));
        println!(
            "| {:.4} | {} | {:.1e} | {:.2e} | {order} |",
            solved.longest_edge, solved.unknowns, solved.min_transmissibility, solved.error
        );
        before = Some(solved);
    }
    Ok(())
}

/// The power of the mean edge length by which the error has fallen.
pub fn order(coarse: Solved, fine: Solved) -> f64 {
    // In the plane the number of unknowns goes with the square of the length.
    let refined = (fine.unknowns as f64 / coarse.unknowns as f64).sqrt();
    (coarse.error / fine.error).ln() / refined.ln()
}

/// A square with a slanted square hole.
fn domain() -> Pslg {
    let corners =
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.5, 0.3], [0.7, 0.5], [0.5, 0.7], [0.3, 0.5]];
    let mut graph = Pslg::from_points(corners.map(DVec2::from_array).to_vec());
    graph.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]];
    graph.holes = vec![DVec2::new(0.5, 0.5)];
    graph
}

/// The solution that the error is measured against.
fn exact(p: DVec2) -> f64 {
    (PI * p.x).sin() * (PI * p.y).sin() + p.x
}

/// What the equation asks of it: minus its Laplacian.
fn source(p: DVec2) -> f64 {
    2.0 * PI * PI * (PI * p.x).sin() * (PI * p.y).sin()
}

/// Solves on a mesh whose triangles are no larger than `area`.
///
/// # Errors
///
/// Whatever the mesher says.
pub fn solve(area: f64) -> Result<Solved, Box<dyn Error>> {
    let made = Mesher::new().max_area(area).triangulate_pslg(&domain())?;
    let dual = Voronoi::new(&made.mesh)?;
    let mut known = vec![false; made.mesh.vertices.len()];
    for edge in dual.edges.iter().filter(|edge| edge.is_boundary()) {
        for end in edge.ends {
            known[end.index()] = true;
        }
    }
    let values = conjugate_gradients(&made.mesh, &dual, &known);
    let squares = made.mesh.vertices.iter().zip(&values).zip(&dual.areas);
    let squared: f64 = squares.map(|((&p, value), area)| area * (value - exact(p)).powi(2)).sum();
    Ok(Solved {
        longest_edge: dual.edges.iter().map(|edge| edge.length).fold(0.0, f64::max),
        unknowns: known.iter().filter(|known| !**known).count(),
        min_transmissibility: dual.edges.iter().map(|edge| edge.weight).fold(f64::MAX, f64::min),
        error: (squared / dual.areas.iter().sum::<f64>()).sqrt(),
    })
}

/// Values at all vertices, those that are `known` being exact.
fn conjugate_gradients(mesh: &TriMesh, dual: &Voronoi<'_>, known: &[bool]) -> Vec<f64> {
    let free = |values: &mut Vec<f64>| {
        for (value, _) in values.iter_mut().zip(known).filter(|(_, known)| **known) {
            *value = 0.0;
        }
    };
    // The fluxes out of every cell.
    let outflow = |values: &[f64]| {
        let mut out = vec![0.0; values.len()];
        for edge in &dual.edges {
            let [a, b] = edge.ends.map(VertexId::index);
            let flux = edge.weight * (values[a] - values[b]);
            out[a] += flux;
            out[b] -= flux;
        }
        out
    };
    let mut values: Vec<f64> =
        mesh.vertices.iter().zip(known).map(|(&p, known)| if *known { exact(p) } else { 0.0 }).collect();
    let mut residual: Vec<f64> = outflow(&values)
        .iter()
        .zip(mesh.vertices.iter().zip(&dual.areas))
        .map(|(out, (&p, area))| area * source(p) - out)
        .collect();
    free(&mut residual);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut direction = residual.clone();
    let mut square = dot(&residual, &residual);
    let goal = 1e-20 * square;
    // In exact arithmetic as many steps as unknowns are enough.
    for _ in 0..10 * mesh.vertices.len() {
        if square <= goal {
            break;
        }
        let mut out = outflow(&direction);
        free(&mut out);
        let step = square / dot(&direction, &out);
        for i in 0..values.len() {
            values[i] += step * direction[i];
            residual[i] -= step * out[i];
        }
        let next = dot(&residual, &residual);
        for (d, r) in direction.iter_mut().zip(&residual) {
            *d = r + next / square * *d;
        }
        square = next;
    }
    values
}
