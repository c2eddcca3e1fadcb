//! How fine the grid must be around points and segments.
//!
//! A leaf looks at what lies within `RHO` spacings of its centre. It is
//! subdivided if that is more than a mesh of its own size can follow: two
//! points, a point and a segment that does not end there, or two segments
//! without a common end. Segments that share an end never ask for more, so that
//! small angles do not cascade; neither does the level of one leaf ask anything
//! of the next along a segment, beyond what the rules of the grid do.
//!
//! The disc around a leaf's centre holds the discs around its children's, as
//! they lie half a spacing away at most and `RHO >= 1`. So a child looks at
//! what its parent saw and at nothing else: the work is near-linear.

use crate::embed::ask;
use crate::error::{Feature, PslgError};
use crate::geometry::distance_sq;
use crate::limits::positive;
use crate::validate::Piece;
use hexdel_geom::monitor::{Cancelled, Monitor, check};
use hexdel_geom::{Circle, DVec2};
use hexdel_grid::{Address, Direction, Grid, Hex, Lattice};
use hexdel_refine::{RefineError, Refiner, RuleSet};
use rustc_hash::FxHashSet;

/// Spacings around a leaf's centre in which it looks for features. Twice the
/// cell's circumradius (`1 / sqrt(3)`) sees to it that two features in it have
/// a hexagon between them; a smaller factor down to 1 would save a third of
/// the triangles and cost a few per cent of the placements.
const RHO: f64 = 1.154_700_538_4;

/// Spacings of the coarsest leaves at features in the input's radius: a single
/// segment is divided into a few parts at least.
const LEAST_SPACINGS: f64 = 4.0;

/// Last places of a coordinate in the finest spacing. An angle is then off by
/// a few times `2^-16` radians at the very worst.
const LAST_PLACES: f64 = 65536.0;

/// Hexagons of level 0 are this many radii of the input wide.
const LEVEL_0_RADII: f64 = 4.0;

/// A disc in which hexagons must not be wider than `spacing`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Demand {
    pub(crate) centre: DVec2,
    pub(crate) radius: f64,
    pub(crate) spacing: f64,
}

/// What the grid is to be fine enough for.
pub(crate) struct Features<'a> {
    pub(crate) sites: &'a [DVec2],
    pub(crate) pieces: &'a [Piece],
    pub(crate) input_of_site: &'a [u32],
    pub(crate) demands: &'a [Demand],
    /// The largest spacing allowed at a place, with points or segments near by or
    /// not, if there is a limit anywhere.
    pub(crate) limit: Option<&'a dyn Fn(DVec2, bool) -> f64>,
    /// The most triangles that may come to be.
    pub(crate) max_triangles: usize,
}

/// A leaf and what it sees: sites, then pieces, then demands, by one number.
struct Leaf {
    at: Address,
    seen: Vec<u32>,
}

/// The lattice for an input in a circle.
pub(crate) fn lattice_for(circle: Circle) -> Lattice {
    Lattice::new(circle.center, LEVEL_0_RADII * scale_of(circle))
}

/// The radius of a circle around an input; a single point has no scale.
pub(crate) fn scale_of(circle: Circle) -> f64 {
    if circle.radius > 0.0 { circle.radius } else { 1.0 }
}

/// Refines until every leaf is fine enough for what it sees.
///
/// # Errors
///
/// [`PslgError::TooClose`], [`PslgError::TooMany`], [`PslgError::Cancelled`].
pub(crate) fn refine(
    lattice: Lattice,
    features: &Features<'_>,
    monitor: &dyn Monitor,
) -> Result<Refiner, PslgError> {
    let mut refiner = Refiner::new(lattice, RuleSet::extended());
    let sizer = Sizer { lattice, features };
    let mut leaves: Vec<Leaf> = Hex::ORIGIN
        .disc(2)
        .map(|hex| sizer.leaf(Address::new(0, hex), &sizer.everything()))
        .filter(|leaf| sizer.is_concerned(leaf))
        .collect();
    let mut expanded = FxHashSet::default();
    loop {
        check(monitor)?;
        leaves = sizer.expand(leaves, refiner.grid(), &mut expanded, monitor)?;
        let mut wanted = Vec::new();
        for (done, leaf) in leaves.iter().enumerate() {
            ask(monitor, done)?;
            if sizer.wants(leaf)? {
                wanted.push(leaf.at);
            }
        }
        let Some(&finest) = wanted.iter().max() else { return Ok(refiner) };
        // A leaf at a feature stands for two triangles at least, and a
        // subdivision makes three more vertices.
        if 6 * (leaves.len() + wanted.len()) > features.max_triangles {
            return Err(PslgError::TooMany { limit: features.max_triangles, at: lattice.position(finest) });
        }
        refiner.subdivide_all(wanted, monitor).map_err(|error| match error {
            RefineError::Cancelled(c) => PslgError::Cancelled(c),
            _ => unreachable!("without sites nothing can be too close"),
        })?;
    }
}

struct Sizer<'a> {
    lattice: Lattice,
    features: &'a Features<'a>,
}

impl Sizer<'_> {
    fn everything(&self) -> Vec<u32> {
        let f = self.features;
        (0..(f.sites.len() + f.pieces.len() + f.demands.len()) as u32).collect()
    }

    /// A leaf and what of `among` it sees.
    fn leaf(&self, at: Address, among: &[u32]) -> Leaf {
        let c = self.lattice.position(at);
        let reach = RHO * self.lattice.spacing(at.level);
        let f = self.features;
        let sees = |&&i: &&u32| {
            let i = i as usize;
            if let Some(site) = f.sites.get(i) {
                return site.distance_squared(c) <= reach * reach;
            }
            if let Some(piece) = f.pieces.get(i - f.sites.len()) {
                let [a, b] = piece.ends.map(|s| f.sites[s as usize]);
                return distance_sq(c, a, b) <= reach * reach;
            }
            let demand = &f.demands[i - f.sites.len() - f.pieces.len()];
            demand.centre.distance(c) <= reach + demand.radius
        };
        Leaf { at, seen: among.iter().filter(sees).copied().collect() }
    }

    fn is_concerned(&self, leaf: &Leaf) -> bool {
        !leaf.seen.is_empty() || self.features.limit.is_some()
    }

    /// Replaces what is subdivided by its children, down to leaves.
    fn expand(
        &self,
        mut todo: Vec<Leaf>,
        grid: &Grid,
        expanded: &mut FxHashSet<Address>,
        monitor: &dyn Monitor,
    ) -> Result<Vec<Leaf>, Cancelled> {
        let mut leaves = Vec::new();
        while let Some(leaf) = todo.pop() {
            ask(monitor, leaves.len() + expanded.len())?;
            if !grid.is_subdivided(leaf.at) {
                leaves.push(leaf);
                continue;
            }
            expanded.insert(leaf.at);
            let finer = leaf.at.level + 1;
            let mut child = |hex| {
                let child = self.leaf(Address::new(finer, hex), &leaf.seen);
                if self.is_concerned(&child) {
                    todo.push(child);
                }
            };
            child(leaf.at.hex.scaled());
            // A hexagon between two comes from whichever is expanded later.
            // One that never is sees nothing, and so does what lies between.
            for d in Direction::ALL {
                let beside = leaf.at.hex.neighbour(d);
                if expanded.contains(&Address::new(leaf.at.level, beside)) {
                    child(leaf.at.hex + beside);
                }
            }
        }
        Ok(leaves)
    }

    fn wants(&self, leaf: &Leaf) -> Result<bool, PslgError> {
        let spacing = self.lattice.spacing(leaf.at.level);
        let culprits = self.culprits(leaf);
        let at = self.lattice.position(leaf.at);
        if culprits.is_none() && !self.is_coarse(leaf, spacing) && spacing <= self.limit(leaf, at)? {
            return Ok(false);
        }
        let largest = at.abs().max_element();
        let least = largest * f64::EPSILON * LAST_PLACES;
        if 0.5 * spacing >= least && leaf.at.level + 1 < Grid::MAX_LEVELS {
            return Ok(true);
        }
        // Only what the input asks for is its fault; a mere wish is left.
        match culprits {
            Some(items) => Err(PslgError::TooClose { items, at, spacing }),
            None => Ok(false),
        }
    }

    /// The largest spacing of a leaf at a place.
    fn limit(&self, leaf: &Leaf, at: DVec2) -> Result<f64, PslgError> {
        let f = self.features;
        let Some(limit) = f.limit else { return Ok(f64::INFINITY) };
        let solid = (f.sites.len() + f.pieces.len()) as u32;
        positive(at, limit(at, leaf.seen.first().is_some_and(|&i| i < solid)))
    }

    /// Whether the leaf is coarser than a feature may have it by itself.
    fn is_coarse(&self, leaf: &Leaf, spacing: f64) -> bool {
        let f = self.features;
        let solid = (f.sites.len() + f.pieces.len()) as u32;
        let least_level = (LEVEL_0_RADII * LEAST_SPACINGS).log2().ceil() as u8;
        leaf.seen.iter().any(|&i| {
            if i < solid {
                leaf.at.level < least_level
            } else {
                spacing > f.demands[(i - solid) as usize].spacing
            }
        })
    }

    /// Two features that the leaf cannot serve both.
    fn culprits(&self, leaf: &Leaf) -> Option<[Feature; 2]> {
        let f = self.features;
        let sites = f.sites.len() as u32;
        let split = leaf.seen.partition_point(|&i| i < sites);
        let (points, rest) = leaf.seen.split_at(split);
        let end = rest.partition_point(|&i| i < sites + f.pieces.len() as u32);
        let pieces = &rest[..end];
        let point = |s: u32| Feature::Point(f.input_of_site[s as usize] as usize);
        let segment = |i: u32| f.pieces[(i - sites) as usize].feature();
        let ends = |i: u32| f.pieces[(i - sites) as usize].ends;
        match *points {
            [a, b, ..] => Some([point(a), point(b)]),
            [a] => pieces.iter().find(|&&i| !ends(i).contains(&a)).map(|&i| [point(a), segment(i)]),
            [] => apart(pieces, ends).map(|[i, j]| [segment(i), segment(j)]),
        }
    }
}

/// Two pieces without a common end, if there are any. Linear: pieces that all
/// meet pairwise without such a pair share one end or are a triangle.
fn apart(pieces: &[u32], ends: impl Fn(u32) -> [u32; 2]) -> Option<[u32; 2]> {
    let meet = |i: u32, j: u32| ends(i).iter().any(|e| ends(j).contains(e));
    let (&first, rest) = pieces.split_first()?;
    if let Some(&j) = rest.iter().find(|&&j| !meet(first, j)) {
        return Some([first, j]);
    }
    // All meet the first, each at one of its two ends: two that meet it at
    // different ends are apart unless they close a triangle.
    let [a, b] = ends(first);
    let at = |end| rest.iter().copied().filter(|&j| ends(j).contains(&end)).collect::<Vec<u32>>();
    let (at_a, at_b) = (at(a), at(b));
    at_a.iter().take(3).chain(at_a.last()).find_map(|&i| at_b.iter().find(|&&j| !meet(i, j)).map(|&j| [i, j]))
}
