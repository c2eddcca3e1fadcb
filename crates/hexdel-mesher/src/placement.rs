//! Where the hexagon grid is laid, and how fine it may get.
//!
//! Two points whose hexagons are four steps or more apart are in conflict with
//! no rule. Hexagons at most three steps apart hold points at most
//! `3 + 2 / sqrt(3)` spacings apart. So on a level whose spacing is that small a
//! part of the closest pair's distance nothing is subdivided, ever: that level
//! is the last. The spacing of level 0 is chosen as a power of two times it.

use crate::error::Error;
use crate::mesher::Method;
use hexdel_classify::{Domain, Relocation};
use hexdel_geom::{Circle, ClosestPair, DVec2, PointSet, closest_pair, smallest_enclosing_circle};
use hexdel_grid::{Grid, Lattice};

/// `3 + 2 / sqrt(3)`, rounded up: the largest distance, in spacings, of points
/// in hexagons three steps apart.
pub const CONFLICT_REACH: f64 = 4.154_700_539;

/// Largest coordinate: predicates take products of four, and of differences.
pub const MAX_COORDINATE: f64 = 1e70;

/// Steps of a session's domain that coordinates must resolve: a hundred levels
/// of halving would not be seen.
pub const FINEST: f64 = 1024.0;

/// Spacings of the finest level that a coordinate's last place must fit into.
/// An angle is then off by about `2^-15` radians, two thousandths of a degree,
/// at the very worst, and reported as limited by rounding.
const LAST_PLACES: f64 = 65536.0;

/// Hexagons of level 0 across the input: the base level is chosen later, and
/// coarser levels than the input's own size are never of use.
const LEVEL_0_SPACINGS: f64 = 4.0;

/// The fewest steps from the centre of level 0 to the rim, and the most for few points,
/// when a radius is prescribed: with these and powers of two, a spacing is never more than
/// 4/3 too fine, and the shortest edge stays above the paper's bound (6 / 4.15 = 1.44).
const STEPS: [u32; 2] = [3, 5];

/// The most for templates of so many points and more: a spacing is never more than 25/24, 13/12
/// and 7/6 too fine, and what more hexagons along the rim cost is a few hundredths.
const MOST_STEPS: [(usize, u32); 3] = [(2000, 47), (500, 23), (100, 11)];

/// Circumradius of the hexagon that a mesh grows in, in radii of the input: room for triangles between the input
/// and its sides.
const GROWN_RADII: f64 = 1.5;

/// Spacings are about the same up to this factor: a hundredth of one is less than what the
/// centre's place among the points does.
pub const ALIKE: f64 = 1.01;

/// The lattice for a set of sites.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placement {
    pub(crate) lattice: Lattice,
    /// The distance of the closest two sites, if there are two.
    pub(crate) closest: Option<f64>,
    /// Steps of level 0 to the rim, if the domain's radius is prescribed.
    steps: Option<u32>,
    /// The level that is never subdivided.
    last_level: u8,
}

impl Placement {
    /// Lays the grid around a centre, by default that of the sites' smallest
    /// enclosing circle, for a method.
    pub(crate) fn around(
        points: &PointSet,
        radius: Option<f64>,
        centre: Option<DVec2>,
        method: Method,
    ) -> Result<Self, Error> {
        check_range(points)?;
        if let Some(radius) = radius.filter(|r| !(r.is_finite() && *r > 0.0)) {
            return Err(Error::InvalidRadius { radius });
        }
        let sites = points.sites();
        let mut circle =
            smallest_enclosing_circle(sites).expect("a point set holds at least one finite point");
        if let Some(centre) = centre {
            let reach = sites.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
            circle = Circle { center: centre, radius: reach };
        }
        let Some(pair) = closest_pair(sites) else {
            return Self::of_one(circle.center, radius);
        };
        check_resolved(points, &pair)?;
        let finest = pair.distance / CONFLICT_REACH;
        let (spacing, steps, last_level) = match radius {
            None => {
                let levels = levels_between(LEVEL_0_SPACINGS * circle.radius, finest);
                (doubled(finest, levels), None, levels)
            }
            Some(radius) => {
                let steps = steps_for(radius, pair.distance, most_steps(method, sites.len()));
                let spacing = radius / f64::from(steps);
                (spacing, Some(steps), levels_between(spacing, finest))
            }
        };
        if last_level >= Grid::MAX_LEVELS {
            if let Some(radius) = radius.filter(|r| *r > LEVEL_0_SPACINGS * circle.radius) {
                return Err(Error::DomainTooLarge { radius, most: doubled(finest, Grid::MAX_LEVELS - 1) });
            }
            let least = halved(circle.radius * CONFLICT_REACH, Grid::MAX_LEVELS - 4);
            return Err(too_close(points, &pair, least));
        }
        let closest = Some(pair.distance);
        Ok(Self { lattice: Lattice::new(circle.center, spacing), closest, steps, last_level })
    }

    /// A single site has no scale of its own: a patch of radius 1 or, far away,
    /// as small as coordinates resolve there.
    fn of_one(site: DVec2, radius: Option<f64>) -> Result<Self, Error> {
        let least = finest_spacing(site).max(1.0 / MAX_COORDINATE);
        let (spacing, steps) = match radius {
            Some(radius) => (radius / f64::from(STEPS[0]), Some(STEPS[0])),
            None => (least.max(1.0), None),
        };
        if let Some(radius) = radius.filter(|_| spacing < least) {
            return Err(Error::DomainTooSmall { radius, least: least * f64::from(STEPS[0]) });
        }
        Ok(Self { lattice: Lattice::new(site, spacing), closest: None, steps, last_level: 0 })
    }

    /// The patch of the refined grid to cut the mesh out of: the one with the
    /// fewest triangles, or the coarsest of the radius prescribed.
    pub(crate) fn domain(&self, grid: &Grid, relocation: Relocation) -> Result<Domain, Error> {
        let Some(steps) = self.steps else {
            return Ok(Domain::smallest(grid, relocation));
        };
        let mut least = f64::INFINITY;
        for level in 0..=self.last_level {
            let Some(around) = Domain::around(grid, level) else { break };
            let asked = u64::from(steps) << level;
            if u64::from(around.radius) <= asked && asked <= u64::from(Domain::MAX_RADIUS) {
                return Ok(Domain { radius: asked as u32, ..around });
            }
            least = least.min(f64::from(around.radius) * self.lattice.spacing(level));
        }
        Err(Error::DomainTooSmall { radius: f64::from(steps) * self.lattice.spacing(0), least })
    }

    /// Circumradius of the hexagon for a mesh that is not of the grid.
    pub(crate) fn radius(&self, sites: &[DVec2]) -> f64 {
        let centre = self.lattice.origin();
        match self.steps {
            Some(steps) => f64::from(steps) * self.lattice.spacing(0),
            None => GROWN_RADII * sites.iter().map(|p| p.distance(centre)).fold(0.0, f64::max),
        }
    }
}

/// The corners of a regular hexagon, counter-clockwise from the east.
pub fn corners(centre: DVec2, radius: f64) -> [DVec2; 6] {
    let height = 0.5 * 3_f64.sqrt();
    [(1.0, 0.0), (0.5, height), (-0.5, height), (-1.0, 0.0), (-0.5, -height), (0.5, -height)]
        .map(|(x, y)| centre + radius * DVec2::new(x, y))
}

/// How many times `finest` must be doubled to reach `size`; at most 255.
fn levels_between(size: f64, finest: f64) -> u8 {
    // A length leaves the range of numbers long before the count leaves its own.
    let reaches = |&levels: &u8| doubled(finest, levels) >= size;
    (0..u8::MAX).find(reaches).unwrap_or(u8::MAX)
}

/// `length * 2^times`. Exact, and the same on every platform, which neither
/// powers nor logarithms of the standard library promise.
fn doubled(length: f64, times: u8) -> f64 {
    (0..times).fold(length, |length, _| 2.0 * length)
}

/// `length / 2^times`; exact as [`doubled`].
fn halved(length: f64, times: u8) -> f64 {
    (0..times).fold(length, |length, _| 0.5 * length)
}

/// The most steps of level 0 to the rim in a mesh of so many points, if a radius is prescribed.
pub fn most_steps(method: Method, points: usize) -> u32 {
    let most = MOST_STEPS.into_iter().find(|most| method == Method::Templates && points >= most.0);
    most.map_or(STEPS[1], |most| most.1)
}

/// How many times finer than the closest pair asks for the first level is that is fine
/// enough for it: from 1, as where no radius is prescribed, to 2.
pub fn excess(spacing: f64, pair: f64) -> f64 {
    let finest = pair / CONFLICT_REACH;
    finest / halved(spacing, levels_between(spacing, finest))
}

/// Steps to the rim of a radius, from the fewest there are to so many, with the least
/// [`excess`]; the fewest of those with about the same.
///
/// Points at regular distances are in conflict or not by hundredths of the spacing, and
/// take up to three times as many triangles with one as with another.
pub fn steps_for(radius: f64, pair: f64, most: u32) -> u32 {
    let excess = |steps: u32| excess(radius / f64::from(steps), pair);
    let all = STEPS[0]..=most.max(STEPS[0]);
    let least = all.clone().map(excess).fold(f64::INFINITY, f64::min);
    all.into_iter().find(|&steps| excess(steps) <= least * ALIKE).unwrap_or(STEPS[0])
}

fn check_range(points: &PointSet) -> Result<(), Error> {
    let beyond = |p: &DVec2| p.abs().max_element() > MAX_COORDINATE;
    match points.sites().iter().position(beyond) {
        Some(site) => Err(Error::OutOfRange {
            index: points.input_of_site()[site] as usize,
            point: points.sites()[site],
            limit: MAX_COORDINATE,
        }),
        None => Ok(()),
    }
}

/// The finest spacing that coordinates resolve at a point.
pub fn finest_spacing(at: DVec2) -> f64 {
    at.abs().max_element() * f64::EPSILON * LAST_PLACES
}

/// Whether all pairs are far enough apart for the coordinates where they lie,
/// and for the predicates; up to a factor of two for all but the closest.
///
/// Coordinates resolve less the larger they are, so the pair that is too close
/// need not be the closest. Sites are looked at from the largest coordinates
/// down, doubling by doubling: of those beyond a size the closest pair, until
/// even the closest of all would do at that size. In most inputs it does at
/// every size.
fn check_resolved(points: &PointSet, pair: &ClosestPair) -> Result<(), Error> {
    check_pair(points, pair)?;
    let sites = points.sites();
    let size = |site: &DVec2| site.abs().max_element();
    let mut beyond = sites.iter().map(size).fold(0.0, f64::max);
    let mut looked_at = 0;
    while pair.distance < finest_spacing(DVec2::splat(beyond)) * CONFLICT_REACH {
        beyond *= 0.5;
        let indices: Vec<usize> = (0..sites.len()).filter(|&i| size(&sites[i]) >= beyond).collect();
        // The same points have the same closest pair.
        if std::mem::replace(&mut looked_at, indices.len()) == indices.len() {
            continue;
        }
        let far: Vec<DVec2> = indices.iter().map(|&i| sites[i]).collect();
        if let Some(found) = closest_pair(&far) {
            check_pair(points, &ClosestPair { a: indices[found.a], b: indices[found.b], ..found })?;
        }
    }
    Ok(())
}

fn check_pair(points: &PointSet, pair: &ClosestPair) -> Result<(), Error> {
    let finest = [pair.a, pair.b].map(|i| finest_spacing(points.sites()[i]));
    let least = (finest[0].max(finest[1]) * CONFLICT_REACH).max(1.0 / MAX_COORDINATE);
    if pair.distance < least { Err(too_close(points, pair, least)) } else { Ok(()) }
}

fn too_close(points: &PointSet, pair: &ClosestPair, least: f64) -> Error {
    Error::TooClose {
        a: points.input_of_site()[pair.a] as usize,
        b: points.input_of_site()[pair.b] as usize,
        points: [points.sites()[pair.a], points.sites()[pair.b]],
        distance: pair.distance,
        least,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_what_they_are_derived_from() {
        let sqrt = f64::sqrt;
        assert!(CONFLICT_REACH >= 3.0 + 2.0 / sqrt(3.0));
        assert!(CONFLICT_REACH < 3.0 + 2.0 / sqrt(3.0) + 1e-8);
    }

    #[test]
    fn levels_are_as_many_as_doublings() {
        for levels in 0..60 {
            let size = doubled(0.3, levels);
            assert_eq!(levels_between(size, 0.3), levels);
            assert_eq!(levels_between(size.next_up(), 0.3), levels + 1);
            assert_eq!(halved(size, levels), 0.3);
        }
        assert_eq!((levels_between(0.0, 1.0), levels_between(f64::INFINITY, 1e300)), (0, 28));
    }

    #[test]
    fn a_domain_beyond_all_levels_is_named() {
        let points = PointSet::new(&[DVec2::ZERO, DVec2::X]).unwrap();
        let Err(Error::DomainTooLarge { radius, most }) =
            Placement::around(&points, Some(1e100), None, Method::Compact)
        else {
            panic!("1e100 is a large domain for points 1 apart");
        };
        assert!(radius == 1e100 && most < 1e100);
        assert!(Placement::around(&points, Some(most), None, Method::Compact).is_ok());
    }

    #[test]
    fn a_prescribed_radius_makes_the_last_level_just_fine_enough() {
        for (most, times) in [(5, 4.0 / 3.0), (11, 7.0 / 6.0), (23, 13.0 / 12.0), (47, 25.0 / 24.0)] {
            for i in 1..200 {
                let (radius, finest) = (3.7, 0.013 * f64::from(i));
                let steps = steps_for(radius, finest * CONFLICT_REACH, most);
                let spacing = radius / f64::from(steps);
                let last = halved(spacing, levels_between(spacing, finest));
                assert!(steps <= most && last <= finest);
                let levels = levels_between(radius, finest);
                assert!(levels < 6 || last * times * ALIKE >= finest, "{last} {finest}");
            }
        }
    }
}
