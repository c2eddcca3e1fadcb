//! Point sets for tests, benchmarks and demonstrations.
//!
//! Each [`Kind`] provokes one phenomenon that meshers stumble over: collinear
//! points, cocircular points, near pairs, steep gradings. The same kind, count
//! and seed give the same bytes on every platform: the random numbers are those
//! of PCG64 (`XSL RR 128/64`, `O'Neill` 2014), whose stream is published, and of
//! floating point there are only the exactly rounded operations and the software
//! `sin`, `cos`, `exp` and `ln` of the crate `libm`, as those of operating
//! systems differ in the last bit. The kinds follow the experiments in the paper,
//! section 7; reading real data is left to the formats.

use std::f64::consts::{LN_10, TAU};
use std::fmt;
use std::str::FromStr;

use hexdel_geom::DVec2;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;
use thiserror::Error;

/// A kind of point set.
///
/// Parsed from and shown as its lower-case name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Kind {
    /// Uniform in the unit square.
    Uniform,
    /// Uniform on the horizontal line `y = 1/2`, hence exactly collinear.
    Line,
    /// Gaussian clusters of about 100 points and standard deviation 0.02, their
    /// centres uniform in the unit square.
    Clusters,
    /// The first points, row by row, of the square lattice that divides the unit
    /// square into `ceil(sqrt n)` columns and rows: four cocircular points
    /// everywhere. Takes no seed.
    Grid,
    /// [`Kind::Grid`] with each point moved by at most a quarter of the spacing
    /// along either axis.
    Jittered,
    /// Evenly spaced on the circle around `(1/2, 1/2)` of radius 1/2, as cocircular
    /// as rounding allows. The seed turns it.
    Circle,
    /// Six turns of an Archimedean spiral inside the circle of [`Kind::Circle`],
    /// spaced about evenly along the curve. The seed turns it.
    Spiral,
    /// Pairs with midpoints uniform in the unit square, their distances
    /// log-uniform between 1e-4 and 1e-2. An odd last point stays alone.
    Pairs,
    /// Radii log-uniform between 1e-6 and 1 around the origin, angles uniform.
    Contrast,
}

/// The name of no [`Kind`].
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("unknown kind of point set \"{name}\", expected one of {}", names())]
pub struct UnknownKind {
    /// The name given.
    pub name: String,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 9] = [
        Self::Uniform,
        Self::Line,
        Self::Clusters,
        Self::Grid,
        Self::Jittered,
        Self::Circle,
        Self::Spiral,
        Self::Pairs,
        Self::Contrast,
    ];

    /// The name that [`FromStr`] understands.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Line => "line",
            Self::Clusters => "clusters",
            Self::Grid => "grid",
            Self::Jittered => "jittered",
            Self::Circle => "circle",
            Self::Spiral => "spiral",
            Self::Pairs => "pairs",
            Self::Contrast => "contrast",
        }
    }
}

/// `n` points of a `kind`.
///
/// # Guarantees
///
/// Exactly `n` finite points, the same bits for the same arguments on every
/// platform. Duplicates are possible in the random kinds, but as unlikely as two
/// equal draws of 53 bits.
///
/// # Complexity
///
/// Linear in `n`.
///
/// # Examples
///
/// ```
/// use hexdel::generate::{Kind, generate};
///
/// let kind: Kind = "contrast".parse()?;
/// let points = generate(kind, 100, 42);
/// assert_eq!(points.len(), 100);
/// assert_eq!(points, generate(kind, 100, 42));
/// assert_ne!(points, generate(kind, 100, 43));
/// # Ok::<(), hexdel::generate::UnknownKind>(())
/// ```
pub fn generate(kind: Kind, n: usize, seed: u64) -> Vec<DVec2> {
    let mut random = Random::new(kind, seed);
    match kind {
        Kind::Uniform => (0..n).map(|_| random.in_square()).collect(),
        Kind::Line => (0..n).map(|_| DVec2::new(random.unit(), 0.5)).collect(),
        Kind::Clusters => clusters(n, &mut random),
        Kind::Grid => grid(n).collect(),
        Kind::Jittered => jittered(n, &mut random),
        Kind::Circle => circle(n, &mut random),
        Kind::Spiral => spiral(n, &mut random),
        Kind::Pairs => pairs(n, &mut random),
        Kind::Contrast => (0..n).map(|_| random.direction() * random.power_of_ten(-6.0, 0.0)).collect(),
    }
}

fn clusters(n: usize, random: &mut Random) -> Vec<DVec2> {
    const POINTS_PER_CLUSTER: usize = 100;
    const DEVIATION: f64 = 0.02;
    let centres: Vec<DVec2> = (0..n.div_ceil(POINTS_PER_CLUSTER)).map(|_| random.in_square()).collect();
    (0..n).map(|i| centres[i % centres.len()] + random.gaussian() * DEVIATION).collect()
}

/// Coordinates are quotients `i / side`, each rounded once, so that rows and
/// columns are exactly straight.
fn grid(n: usize) -> impl Iterator<Item = DVec2> {
    let side = lattice_side(n);
    (0..n).map(move |i| DVec2::new((i % side) as f64, (i / side) as f64) / side as f64)
}

fn jittered(n: usize, random: &mut Random) -> Vec<DVec2> {
    let reach = 0.5 / lattice_side(n) as f64;
    grid(n).map(|p| p + (random.in_square() - 0.5) * reach).collect()
}

/// `ceil(sqrt n)`, at least 1 so that it divides.
fn lattice_side(n: usize) -> usize {
    let floor = n.isqrt();
    (floor + usize::from(floor * floor < n)).max(1)
}

fn circle(n: usize, random: &mut Random) -> Vec<DVec2> {
    let phase = random.unit();
    (0..n).map(|i| on_circle(phase + i as f64 / n as f64, 0.5)).collect()
}

fn spiral(n: usize, random: &mut Random) -> Vec<DVec2> {
    const TURNS: f64 = 6.0;
    let phase = random.unit();
    (0..n)
        .map(|i| {
            // The length of an Archimedean spiral grows with the square of its
            // radius, so the square root spaces the points evenly.
            let t = ((i as f64 + 0.5) / n as f64).sqrt();
            on_circle(phase + TURNS * t, 0.5 * t)
        })
        .collect()
}

/// The point at `turns` full turns on the circle around `(1/2, 1/2)`.
fn on_circle(turns: f64, radius: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(turns * TAU);
    DVec2::new(cos, sin) * radius + 0.5
}

fn pairs(n: usize, random: &mut Random) -> Vec<DVec2> {
    let mut points = Vec::with_capacity(n);
    for _ in 0..n / 2 {
        let middle = random.in_square();
        let half = random.direction() * (0.5 * random.power_of_ten(-4.0, -2.0));
        points.extend([middle - half, middle + half]);
    }
    if n % 2 == 1 {
        points.push(random.in_square());
    }
    points
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Kind {
    type Err = UnknownKind;

    fn from_str(name: &str) -> Result<Self, UnknownKind> {
        let found = Self::ALL.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| UnknownKind { name: name.to_owned() })
    }
}

fn names() -> String {
    Kind::ALL.map(Kind::name).join(", ")
}

/// Distributions over one random stream.
struct Random(Pcg64);

impl Random {
    /// Each kind has a stream of its own, so that kinds of one seed are unrelated.
    fn new(kind: Kind, seed: u64) -> Self {
        Self(Pcg64::new(u128::from(seed), kind as u128))
    }

    /// Uniform in `[0, 1)`: the upper 53 bits, which a double holds exactly.
    fn unit(&mut self) -> f64 {
        const SCALE: f64 = 1.0 / (1u64 << 53) as f64;
        (self.0.next_u64() >> 11) as f64 * SCALE
    }

    fn in_square(&mut self) -> DVec2 {
        let x = self.unit();
        DVec2::new(x, self.unit())
    }

    /// Uniform in the unit disc without its centre, with its squared distance
    /// from there. Rejects 21 % of the draws.
    fn in_disc(&mut self) -> (DVec2, f64) {
        loop {
            let p = self.in_square() * 2.0 - 1.0;
            let square = p.x * p.x + p.y * p.y;
            if square > 0.0 && square < 1.0 {
                return (p, square);
            }
        }
    }

    /// Uniform on the unit circle.
    fn direction(&mut self) -> DVec2 {
        let (p, square) = self.in_disc();
        p / square.sqrt()
    }

    /// Two independent standard normals (Marsaglia and Bray 1964).
    fn gaussian(&mut self) -> DVec2 {
        let (p, square) = self.in_disc();
        p * (-2.0 * libm::log(square) / square).sqrt()
    }

    /// `10^e` with `e` uniform in `[from, to)`.
    fn power_of_ten(&mut self, from: f64, to: f64) -> f64 {
        libm::exp((from + (to - from) * self.unit()) * LN_10)
    }
}

#[cfg(test)]
mod tests;
