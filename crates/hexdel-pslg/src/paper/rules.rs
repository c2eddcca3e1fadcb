//! How fine hexagons along segments must be (paper, section 7.2).
//!
//! Hexagons that a segment passes, and their neighbours, are full hexagons of
//! one level, without fins and no tops of three-finned ones: no template but
//! that of the segment moves them. So a *chain*, all segments that hang
//! together, has one level everywhere. It is that of its points, which are
//! subject to the rules of points; then it is raised while
//!
//! * a hexagon is passed by segments that have no end in common,
//! * a hexagon with a point in it, or one beside it, is passed by a segment that
//!   does not end there,
//! * something else needs finer hexagons less than two steps away.
//!
//! The paper allows no more than two segments to a hexagon. Where three or more
//! meet in one point, there is no level on which this is so; here any number
//! may pass that have an end in common.
//!
//! The paper has no rule for hexagons beside one with a point in it. Without
//! one, a point and a segment may be as close as they like on both sides of an
//! edge between two hexagons.

use super::assign::passed;
use crate::error::{Feature, PslgError};
use crate::net::NONE;
use crate::validate::Piece;
use hexdel_classify::{Classes, View};
use hexdel_geom::monitor::{Monitor, check};
use hexdel_geom::{DVec2, closest_pair};
use hexdel_grid::{Address, Grid};
use hexdel_refine::{RefineError, Refiner};

/// What the rules are about.
pub(super) struct Scene<'a> {
    pub(super) sites: &'a [DVec2],
    pub(super) pieces: &'a [Piece],
    pub(super) input_of_site: &'a [u32],
    pub(super) max_triangles: usize,
}

/// A hexagon and the pieces that pass it, ascending.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Passed {
    pub(super) at: Address,
    pub(super) pieces: Vec<u32>,
}

/// Last places of a coordinate in the finest spacing: a vertex on a segment is
/// then off by a few times `2^-16` hexagons at the very worst.
const LAST_PLACES: f64 = 65536.0;

/// Triangles along a segment for each spacing of its length, at least: two in
/// each of the rows on its both sides.
const LEAST_TRIANGLES: f64 = 4.0;

/// Refines until all rules hold. Returns the hexagons that pieces pass, sorted.
///
/// # Errors
///
/// [`PslgError::TooClose`], [`PslgError::TooMany`], [`PslgError::Cancelled`].
pub(super) fn refine(
    refiner: &mut Refiner,
    scene: &Scene<'_>,
    monitor: &dyn Monitor,
) -> Result<Vec<Passed>, PslgError> {
    refiner.insert(scene.sites, monitor).map_err(|error| scene.refine_error(error))?;
    let mut chains = Chains::of(scene);
    // The level on which each chain's hexagons were last made to exist. What was
    // subdivided for them stays so.
    let mut requested = vec![u8::MAX; chains.level.len()];
    loop {
        check(monitor)?;
        chains.follow_sites(refiner);
        chains.check_size(scene, refiner.grid())?;
        let passed = chains.passed(scene, refiner.grid());
        let mut raises = conflicts(scene, refiner, &passed);
        if raises.is_empty() {
            let parents = parents(&passed, |i| requested[chains.chain(i)] != chains.level[chains.chain(i)]);
            if !parents.is_empty() {
                requested.copy_from_slice(&chains.level);
                refiner.subdivide_all(parents, monitor).map_err(|error| scene.refine_error(error))?;
                continue;
            }
            raises = disturbed(refiner.grid(), &passed);
        }
        if raises.is_empty() {
            return Ok(passed);
        }
        chains.raise(scene, refiner.grid(), &raises)?;
    }
}

impl Scene<'_> {
    pub(super) fn ends(&self, piece: u32) -> [DVec2; 2] {
        self.pieces[piece as usize].ends.map(|s| self.sites[s as usize])
    }

    fn meets(&self, piece: u32, site: u32) -> bool {
        self.pieces[piece as usize].ends.contains(&site)
    }

    fn point(&self, site: usize) -> Feature {
        Feature::Point(self.input_of_site[site] as usize)
    }

    fn segment(&self, piece: u32) -> Feature {
        match self.pieces[piece as usize].segment {
            NONE => Feature::Hull,
            segment => Feature::Segment(segment as usize),
        }
    }

    fn refine_error(&self, error: RefineError) -> PslgError {
        match error {
            RefineError::Cancelled(c) => PslgError::Cancelled(c),
            // Levels run out for the closest two points first.
            _ => match closest_pair(self.sites) {
                Some(pair) => PslgError::TooClose {
                    items: [self.point(pair.a), self.point(pair.b)],
                    at: self.sites[pair.a],
                    distance: Some(pair.distance),
                    spacing: pair.distance,
                },
                None => PslgError::too_many(self.max_triangles, self.sites[0]),
            },
        }
    }

    /// Two of several pieces that pass a hexagon and have no business there
    /// together.
    fn apart(&self, pieces: &[u32]) -> Option<[Feature; 2]> {
        let (&first, rest) = pieces.split_first()?;
        let shared = |site: &u32| rest.iter().all(|&p| self.meets(p, *site));
        let ends = self.pieces[first as usize].ends;
        if rest.is_empty() || ends.iter().any(shared) {
            return None;
        }
        // Three sides of a triangle meet each other and share no point: any
        // two are named then.
        let other = rest.iter().find(|&&p| !ends.iter().any(|&s| self.meets(p, s))).unwrap_or(&rest[0]);
        Some([self.segment(first), self.segment(*other)])
    }
}

/// A reason to raise the chain of a piece.
struct Raise {
    piece: u32,
    at: Address,
    /// Whose fault it is, if it is the input's.
    culprits: Option<[Feature; 2]>,
}

/// Pieces that hang together.
struct Chains {
    /// By piece.
    chain_of: Vec<u32>,
    /// By chain, like all that follows.
    level: Vec<u8>,
    length: Vec<f64>,
    /// By site: one of its pieces' chain, or `NONE`.
    chain_of_site: Vec<u32>,
}

impl Chains {
    fn of(scene: &Scene<'_>) -> Self {
        let mut leader: Vec<u32> = (0..scene.sites.len() as u32).collect();
        for piece in scene.pieces {
            let [a, b] = piece.ends.map(|s| find(&mut leader, s));
            leader[a.max(b) as usize] = a.min(b);
        }
        let mut number = vec![NONE; scene.sites.len()];
        let mut chains =
            Self { chain_of: Vec::new(), level: Vec::new(), length: Vec::new(), chain_of_site: Vec::new() };
        for (i, piece) in scene.pieces.iter().enumerate() {
            let first = find(&mut leader, piece.ends[0]) as usize;
            if number[first] == NONE {
                number[first] = chains.level.len() as u32;
                chains.level.push(0);
                chains.length.push(0.0);
            }
            let [a, b] = scene.ends(i as u32);
            chains.length[number[first] as usize] += a.distance(b);
            chains.chain_of.push(number[first]);
        }
        chains.chain_of_site =
            (0..scene.sites.len() as u32).map(|s| number[find(&mut leader, s) as usize]).collect();
        chains
    }

    fn chain(&self, piece: u32) -> usize {
        self.chain_of[piece as usize] as usize
    }

    /// A chain is as fine as the finest of its points.
    fn follow_sites(&mut self, refiner: &Refiner) {
        for (occupant, &chain) in refiner.occupants().iter().zip(&self.chain_of_site) {
            if chain != NONE {
                let level = &mut self.level[chain as usize];
                *level = occupant.level.max(*level);
            }
        }
    }

    /// Whether there is room for all chains.
    fn check_size(&self, scene: &Scene<'_>, grid: &Grid) -> Result<(), PslgError> {
        let least = least_spacing(scene);
        let mut triangles = 0.0;
        for (i, (&level, length)) in self.level.iter().zip(&self.length).enumerate() {
            let spacing = grid.lattice().spacing(level);
            triangles += LEAST_TRIANGLES * length / spacing;
            if triangles > scene.max_triangles as f64 || spacing < least {
                let piece = self.chain_of.iter().position(|&c| c as usize == i).unwrap_or(0);
                return Err(PslgError::too_many(scene.max_triangles, scene.ends(piece as u32)[0]));
            }
        }
        Ok(())
    }

    fn passed(&self, scene: &Scene<'_>, grid: &Grid) -> Vec<Passed> {
        let mut all: Vec<(Address, u32)> = Vec::new();
        for piece in 0..scene.pieces.len() as u32 {
            let level = self.level[self.chain(piece)];
            let hexagons = passed(grid.lattice(), level, scene.ends(piece));
            all.extend(hexagons.into_iter().map(|hex| (Address::new(level, hex), piece)));
        }
        all.sort_unstable();
        let group = |same: &[(Address, u32)]| Passed {
            at: same[0].0,
            pieces: same.iter().map(|&(_, piece)| piece).collect(),
        };
        all.chunk_by(|a, b| a.0 == b.0).map(group).collect()
    }

    /// One level finer.
    fn raise(&mut self, scene: &Scene<'_>, grid: &Grid, raises: &[Raise]) -> Result<(), PslgError> {
        let before = self.level.clone();
        for raise in raises {
            let chain = self.chain(raise.piece);
            let level = before[chain] + 1;
            let (at, spacing) = (grid.lattice().position(raise.at), grid.lattice().spacing(level));
            if level >= Grid::MAX_LEVELS || spacing < least_spacing(scene) {
                return Err(match raise.culprits {
                    Some(items) => PslgError::TooClose { items, at, distance: None, spacing },
                    None => PslgError::too_many(scene.max_triangles, at),
                });
            }
            self.level[chain] = level;
        }
        Ok(())
    }
}

/// Spacings below this cannot be told apart by the coordinates.
fn least_spacing(scene: &Scene<'_>) -> f64 {
    let largest = scene.sites.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    largest * f64::EPSILON * LAST_PLACES
}

/// The leader of a site's set, with paths halved on the way.
fn find(leader: &mut [u32], mut site: u32) -> u32 {
    while leader[site as usize] != site {
        let next = leader[leader[site as usize] as usize];
        leader[site as usize] = next;
        site = next;
    }
    site
}

/// Segments and points that share a hexagon, or are in neighbouring ones, and
/// must not.
fn conflicts(scene: &Scene<'_>, refiner: &Refiner, passed: &[Passed]) -> Vec<Raise> {
    let mut raises = Vec::new();
    for p in passed {
        if let Some(items) = scene.apart(&p.pieces) {
            raises.extend(p.pieces.iter().map(|&piece| Raise { piece, at: p.at, culprits: Some(items) }));
        }
    }
    for (site, occupant) in refiner.occupants().iter().enumerate() {
        for hex in occupant.at.hex.disc(1) {
            let at = Address::new(occupant.level, hex);
            let Ok(i) = passed.binary_search_by_key(&at, |p| p.at) else { continue };
            let strangers = passed[i].pieces.iter().filter(|&&p| !scene.meets(p, site as u32));
            raises.extend(strangers.map(|&piece| Raise {
                piece,
                at,
                culprits: Some([scene.point(site), scene.segment(piece)]),
            }));
        }
    }
    raises
}

/// What must be subdivided for hexagons along pieces and their neighbours to
/// exist.
fn parents(passed: &[Passed], wanted: impl Fn(u32) -> bool) -> Vec<Address> {
    let concerned = passed.iter().filter(|p| p.at.level > 0 && p.pieces.iter().any(|&i| wanted(i)));
    let around = concerned.flat_map(|p| {
        p.at.hex.disc(1).flat_map(move |hex| {
            let (a, b) = hex.parents();
            std::iter::once(a).chain(b).map(move |hex| Address::new(p.at.level - 1, hex))
        })
    });
    let mut all: Vec<Address> = around.collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Hexagons along pieces that something finer has come too close to.
fn disturbed(grid: &Grid, passed: &[Passed]) -> Vec<Raise> {
    let mut raises = Vec::new();
    let tile = |p: &Passed| (p.at.level, p.at.hex.q >> 3, p.at.hex.r >> 3);
    let mut order: Vec<usize> = (0..passed.len()).collect();
    order.sort_unstable_by_key(|&i| tile(&passed[i]));
    for group in order.chunk_by(|&i, &j| tile(&passed[i]) == tile(&passed[j])) {
        let at = passed[group[0]].at;
        // Where there is no tile nothing is subdivided.
        let Some((id, _)) = grid.tiles().find(at.level, at.hex) else { continue };
        let view = View::of(grid, at.level, id);
        let classes = Classes::of(view.subdivided);
        let moved = view.subdivided | classes.finned() | classes.moved4();
        let near = moved.dilated();
        let first = grid.tiles().first(at.level, id);
        for &i in group {
            if near.contains(passed[i].at.hex - first) {
                raises.extend(passed[i].pieces.iter().map(|&piece| Raise {
                    piece,
                    at: passed[i].at,
                    culprits: None,
                }));
            }
        }
    }
    raises
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::Unwatched;
    use hexdel_grid::{Direction, Lattice};
    use hexdel_refine::RuleSet;

    fn refined(sites: &[DVec2], ends: &[[u32; 2]]) -> Result<(Refiner, Vec<Passed>), PslgError> {
        let pieces: Vec<Piece> =
            ends.iter().zip(0..).map(|(&ends, segment)| Piece { ends, segment }).collect();
        let input_of_site: Vec<u32> = (0..sites.len() as u32).collect();
        let scene = Scene { sites, pieces: &pieces, input_of_site: &input_of_site, max_triangles: 50_000 };
        let mut refiner = Refiner::new(Lattice::new(DVec2::ZERO, 8.0), RuleSet::extended());
        let passed = refine(&mut refiner, &scene, &Unwatched)?;
        Ok((refiner, passed))
    }

    /// Two chains, one of them with points close together, and a point alone.
    fn scene(seed: u32) -> (Vec<DVec2>, Vec<[u32; 2]>) {
        let turn = DVec2::from_angle(f64::from(seed) * 0.37);
        let points =
            [(-1.5, 0.0), (0.1, 0.2), (1.5, 0.1), (-1.0, 1.0), (-0.9, 1.02), (0.8, 1.3), (0.3, -0.6)];
        let sites = points.map(|(x, y)| turn.rotate(DVec2::new(x, y)) + DVec2::splat(0.01)).to_vec();
        (sites, vec![[0, 1], [1, 2], [3, 4], [4, 5]])
    }

    #[test]
    fn chains_have_one_level_and_full_surroundings() {
        for seed in 0..20 {
            let (sites, ends) = scene(seed);
            let (refiner, passed) = refined(&sites, &ends).unwrap();
            assert_eq!(refiner.violation(), None, "{seed}");
            let grid = refiner.grid();
            let levels = |of: [u32; 2]| {
                let own = passed.iter().filter(move |p| p.pieces.iter().any(|i| of.contains(i)));
                own.map(|p| p.at.level).collect::<std::collections::BTreeSet<_>>()
            };
            assert_eq!((levels([0, 1]).len(), levels([2, 3]).len()), (1, 1), "{seed}");
            assert!(levels([0, 1]) < levels([2, 3]), "{seed}");
            for p in &passed {
                for hex in p.at.hex.disc(1) {
                    let at = Address::new(p.at.level, hex);
                    assert!(grid.exists(at) && !grid.is_subdivided(at), "{seed} {at:?}");
                    assert_eq!(grid.fins(at), 0, "{seed} {at:?}");
                    for d in Direction::ALL {
                        let below = Address::new(at.level, hex.neighbour(d));
                        let fins = grid.fins(below);
                        let is_top = (0..6).all(|i| {
                            let by = (i + 6 - d.index()) % 6;
                            (fins >> i & 1 == 1) == [0, 1, 5].contains(&by)
                        });
                        assert!(!is_top, "{seed} {at:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn points_are_alone_with_their_segments() {
        for seed in 0..20 {
            let (sites, ends) = scene(seed);
            let (refiner, passed) = refined(&sites, &ends).unwrap();
            for (site, occupant) in refiner.occupants().iter().enumerate() {
                for p in passed.iter().filter(|p| p.at.level == occupant.level) {
                    if p.at.hex.distance(occupant.at.hex) < 2 {
                        assert!(p.pieces.iter().all(|&i| ends[i as usize].contains(&(site as u32))));
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_too_close_or_too_much_is_named() {
        let at = |points: [(f64, f64); 3]| points.map(|(x, y)| DVec2::new(x, y));
        let long = at([(-1.0, 0.0), (1.0, 0.0), (0.1, 1e-14)]);
        let refused = refined(&long, &[[0, 1]]).err();
        assert!(matches!(refused, Some(PslgError::TooMany { limit: 50_000, .. })), "{refused:?}");
        // A short one is within the budget on every level: precision ends.
        let short = at([(1.0, 1.0), (1.0 + 4e-9, 1.0), (1.0 + 2e-9, 1.0 + 2e-12)]);
        let refused = refined(&short, &[[0, 1]]).err();
        let items = [Feature::Point(2), Feature::Segment(0)];
        assert!(matches!(refused, Some(PslgError::TooClose { items: i, .. }) if i == items), "{refused:?}");
    }
}
