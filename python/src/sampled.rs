//! A function of the caller's as a size: sampled in tiles, each by one call with
//! arrays, and interpolated between the samples.
//!
//! The mesher asks for the size of one place at a time, from any thread, many times
//! for each triangle. A call of Python for each would take longer than the mesh. So
//! the plane is cut into square tiles of `CELLS` by `CELLS` cells, sampled when the
//! first place in them is asked for. Where a corner of a cell wants edges shorter than
//! `FINE` cells, the quarter of the tile with the cell is a tile of its own:
//!
//! ```text
//!   +-------+-------+
//!   |       |       |      a function that changes no faster than the distance
//!   |       +-+-+---+      cannot hide a finer place between samples: it would
//!   |       +-+-+   |      have shown at the corners of its cell
//!   +-------+-+-+---+
//! ```
//!
//! The points of a mesh lie in one tile. Around it, out to where a domain may grow, lie
//! rings of twelve tiles, each half as wide as what is inside:
//!
//! ```text
//!   +---+---+---+---+
//!   |   |   |   |   |
//!   +---+---+---+---+      however far a place is, few tiles lead to it
//!   |   |points |   |
//!   +---+       +---+
//!   |   |       |   |
//!   +---+---+---+---+
//!   |   |   |   |   |
//!   +---+---+---+---+
//! ```
//!
//! What tiles hold depends on the function and on their places alone, not on the order
//! of questions, so that meshes are the same on any number of threads. That the mesh
//! keeps to the function itself is checked, and if need be mended, by `_size.py`.

use crate::errors;
use crate::watch::Watch;
use glam::DVec2;
use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Arc, PoisonError, RwLock};

/// Cells along a side of a tile.
const CELLS: usize = 32;

/// Samples along a side of a tile.
const SAMPLES: usize = CELLS + 1;

/// An edge wanted is so many cells long at least, where it is sampled.
const FINE: f64 = 4.0;

/// How much more than the least of its corners a cell may ask for: a function that
/// changes no faster than the distance does not get there, one that jumps does.
const JUMP: f64 = 1.35;

/// Levels of tiles: the finest cells are 2e-14 of the domain.
const MAX_LEVEL: u32 = 40;

/// A function and what it was found to be.
pub(crate) struct Sampled {
    function: Py<PyAny>,
    /// What the function's values are multiplied with.
    factor: f64,
    /// The tile in the middle, which the points are in.
    middle: Middle,
    /// The box around the points, and the one outside of which the function is not called.
    boxes: [[DVec2; 2]; 2],
    watch: Arc<Watch>,
    tiles: RwLock<Tiles>,
}

#[derive(Default)]
struct Tiles {
    /// The tiles that are no quarters of others.
    roots: BTreeMap<Root, usize>,
    all: Vec<Tile>,
}

/// The tile that the points are in.
#[derive(Clone, Copy)]
struct Middle {
    centre: DVec2,
    half: f64,
}

/// A tile that is no quarter of another one: its ring, 0 for the middle, and its column and
/// row in that, from -2 to 1.
type Root = (u32, [i8; 2]);

struct Tile {
    low: DVec2,
    side: f64,
    level: u32,
    /// Row by row from the south.
    samples: Vec<f64>,
    /// Its quarters: south-west, south-east, north-west, north-east.
    quarters: [Quarter; 4],
}

#[derive(Clone, Copy, Default)]
struct Quarter {
    tile: Option<usize>,
    /// Whether every cell in it is finer than sampled here, so that it need not be looked at.
    fine: bool,
}

/// What is known of a place.
enum Found {
    Size(f64),
    /// A tile to be sampled: its corner, side and level, and whose quarter it is.
    Missing(DVec2, f64, u32, Parent),
}

#[derive(Clone, Copy)]
enum Parent {
    Root(Root),
    Quarter(usize, usize),
}

impl Sampled {
    /// A function of arrays x and y, to be asked for in the box around some points, and
    /// beyond it by so many times its longer side.
    pub(crate) fn new(
        function: Py<PyAny>,
        factor: f64,
        (low, high): (DVec2, DVec2),
        beyond: f64,
        watch: Arc<Watch>,
    ) -> Self {
        let side = (high - low).max_element();
        let side = if side > 0.0 && side.is_finite() { side } else { 1.0 };
        // The sides of the tile are beyond the domain of most meshes.
        let middle = Middle { centre: 0.5 * (low + high), half: side };
        let boxes = [[low, high], [low - beyond * side, high + beyond * side]];
        Self { function, factor, middle, boxes, watch, tiles: RwLock::default() }
    }

    /// The size at a place.
    pub(crate) fn at(&self, p: DVec2) -> f64 {
        // Beyond the box the size is that of its nearest place.
        let p = p.clamp(self.boxes[1][0], self.boxes[1][1]);
        loop {
            if self.watch.is_stopped() {
                // Whatever comes of it is thrown away.
                return self.middle.half;
            }
            let found = self.tiles.read().unwrap_or_else(PoisonError::into_inner).find(p, self.middle);
            match found {
                Found::Size(size) => return size,
                Found::Missing(low, side, level, parent) => match self.sample(low, side) {
                    Ok(samples) => {
                        let tile = Tile::new(low, side, level, samples);
                        self.tiles.write().unwrap_or_else(PoisonError::into_inner).add(tile, parent);
                    }
                    Err(error) => self.watch.fail(error),
                },
            }
        }
    }

    /// The function at the corners of a tile's cells.
    fn sample(&self, low: DVec2, side: f64) -> PyResult<Vec<f64>> {
        let cell = side / CELLS as f64;
        let at = |i: usize| low + cell * DVec2::new((i % SAMPLES) as f64, (i / SAMPLES) as f64);
        let [inner, outer] = self.boxes;
        let places: Vec<DVec2> = (0..SAMPLES * SAMPLES).map(|i| at(i).clamp(outer[0], outer[1])).collect();
        Python::attach(|py| {
            let mut lengths = self.call(py, &places)?;
            // Beyond the points a function may have no sense, nor the mesh be there.
            let is_none = |h: f64| h.is_nan() || h <= 0.0;
            let outside: Vec<usize> = (0..places.len())
                .filter(|&i| is_none(lengths[i]) && places[i] != places[i].clamp(inner[0], inner[1]))
                .collect();
            if !outside.is_empty() {
                let nearest: Vec<DVec2> =
                    outside.iter().map(|&i| places[i].clamp(inner[0], inner[1])).collect();
                for (i, length) in outside.into_iter().zip(self.call(py, &nearest)?) {
                    lengths[i] = length;
                }
            }
            if let Some(i) = lengths.iter().position(|&h| is_none(h)) {
                return Err(errors::bad_length(py, places[i].clamp(inner[0], inner[1]), lengths[i]));
            }
            // Infinite lengths are no limit; they must not spoil interpolation.
            let most = 1e6 * (self.middle.half + (low - self.middle.centre).abs().max_element());
            Ok(lengths.into_iter().map(|h| (h * self.factor).min(most)).collect())
        })
    }

    fn call(&self, py: Python<'_>, places: &[DVec2]) -> PyResult<Vec<f64>> {
        let [x, y] = [|p: &DVec2| p.x, |p: &DVec2| p.y].map(|of| places.iter().map(of).collect::<Vec<f64>>());
        let lengths = self.function.bind(py).call1((x.into_pyarray(py), y.into_pyarray(py)))?;
        let lengths = lengths.cast_into::<PyArray1<f64>>().map_err(PyErr::from)?.readonly();
        let lengths = lengths.as_array();
        if lengths.len() == places.len() {
            Ok(lengths.to_vec())
        } else {
            Err(errors::impossible("a function of sizes gave too few numbers"))
        }
    }
}

impl Tiles {
    fn find(&self, p: DVec2, middle: Middle) -> Found {
        let root = middle.root(p);
        let Some(&root) = self.roots.get(&root) else {
            let (low, side) = middle.place(root);
            return Found::Missing(low, side, 0, Parent::Root(root));
        };
        let mut index = root;
        loop {
            let tile = &self.all[index];
            let half = 0.5 * tile.side;
            let upper = [p.x >= tile.low.x + half, p.y >= tile.low.y + half].map(usize::from);
            let quarter = upper[0] + 2 * upper[1];
            let Quarter { tile: next, fine } = tile.quarters[quarter];
            if !fine || tile.level == MAX_LEVEL {
                let (size, least) = tile.at(p);
                if least >= FINE * tile.side / CELLS as f64 || tile.level == MAX_LEVEL {
                    return Found::Size(size);
                }
            }
            let Some(next) = next else {
                let low = tile.low + half * DVec2::new(upper[0] as f64, upper[1] as f64);
                return Found::Missing(low, half, tile.level + 1, Parent::Quarter(index, quarter));
            };
            index = next;
        }
    }

    /// Adds a tile, unless another thread has been faster.
    fn add(&mut self, tile: Tile, parent: Parent) {
        let index = self.all.len();
        match parent {
            Parent::Root(root) => {
                if self.roots.contains_key(&root) {
                    return;
                }
                self.roots.insert(root, index);
            }
            Parent::Quarter(of, quarter) => {
                let place = &mut self.all[of].quarters[quarter].tile;
                if place.is_some() {
                    return;
                }
                *place = Some(index);
            }
        }
        self.all.push(tile);
    }
}

impl Middle {
    /// The tile that a place is in.
    fn root(self, p: DVec2) -> Root {
        let place = (p - self.centre) / self.half;
        let distance = place.abs().max_element();
        let (mut ring, mut width) = (0, 1.0);
        while distance > width {
            (ring, width) = (ring + 1, 2.0 * width);
        }
        // Tiles of a ring are half as wide as what it encloses; what is no number is in the middle.
        let of = |x: f64| if ring == 0 { 0 } else { (2.0 * x / width).floor().clamp(-2.0, 1.0) as i8 };
        (ring, [of(place.x), of(place.y)])
    }

    /// Corner and side of a tile.
    fn place(self, (ring, [column, row]): Root) -> (DVec2, f64) {
        if ring == 0 {
            return (self.centre - self.half, 2.0 * self.half);
        }
        let side = 0.5 * self.half * f64::from(ring).exp2();
        (self.centre + side * DVec2::new(f64::from(column), f64::from(row)), side)
    }
}

impl Tile {
    fn new(low: DVec2, side: f64, level: u32, samples: Vec<f64>) -> Self {
        let fine = FINE * side / CELLS as f64;
        let half = CELLS / 2;
        let quarter = |i: usize| {
            let (column, row) = (i % 2 * half, i / 2 * half);
            let rows = (row..=row + half).map(|row| &samples[row * SAMPLES + column..][..=half]);
            Quarter { tile: None, fine: rows.flatten().all(|h| *h < fine) }
        };
        let quarters = std::array::from_fn(quarter);
        Self { low, side, level, samples, quarters }
    }

    /// The size at a place of this tile, and the least at the corners of its cell.
    fn at(&self, p: DVec2) -> (f64, f64) {
        let last = (CELLS - 1) as f64;
        let place = (p - self.low) * (CELLS as f64 / self.side);
        let cell = place.floor().clamp(DVec2::ZERO, DVec2::splat(last));
        let DVec2 { x: u, y: v } = (place - cell).clamp(DVec2::ZERO, DVec2::ONE);
        let (column, row) = (cell.x as usize, cell.y as usize);
        let corner = |dx: usize, dy: usize| self.samples[(row + dy) * SAMPLES + column + dx];
        let (a, b, c, d) = (corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1));
        let least = a.min(b).min(c).min(d);
        let size = (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * c + u * d);
        (size.min(JUMP * least), least)
    }
}
