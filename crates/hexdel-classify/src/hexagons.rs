//! The hexagons behind a mesh, one by one: for pictures and for study.
//!
//! The classes here include what the input points make of a hexagon; the
//! layers that do the work ask sixty-four at a time and never need the list.

use crate::class::{Class, Classes, View};
use crate::dual::{Domain, Occupant};
use crate::relocate::ring_may_stay;
use hexdel_geom::DVec2;
use hexdel_grid::grid::hex_of;
use hexdel_grid::{Address, Direction, Grid, Hex, HexKind, TileId};
use std::collections::BTreeMap;

/// A full hexagon that is a leaf, or a semi-hexagon.
#[derive(Clone, Debug, PartialEq)]
pub struct Hexagon {
    /// Level and place.
    pub address: Address,
    /// The class of a leaf; `None` for a semi-hexagon.
    pub class: Option<Class>,
    /// Corners, counter-clockwise: six of a leaf, four of a semi-hexagon.
    pub corners: Vec<DVec2>,
}

/// All leaves and semi-hexagons of a patch, coarsest first.
///
/// # Complexity
///
/// A step per level for each hexagon.
pub fn hexagons(grid: &Grid, domain: Domain, occupants: &[Occupant]) -> Vec<Hexagon> {
    let rings = ring_classes(occupants);
    let mut all = Vec::new();
    for address in places(grid, domain) {
        let kind = kind(grid, domain, address);
        let class = match kind {
            HexKind::Leaf => Some(rings.get(&address).copied().unwrap_or_else(|| by_fins(grid, address))),
            HexKind::Semi { .. } => None,
            _ => continue,
        };
        all.push(Hexagon { address, class, corners: corners(grid, address, kind) });
    }
    all
}

/// For each point the index of the hexagon of `all` that holds it: a leaf if there
/// is one, else a semi-hexagon.
///
/// # Complexity
///
/// Sorting, and a search per point and level.
pub fn holders(grid: &Grid, all: &[Hexagon], points: &[DVec2]) -> Vec<Option<usize>> {
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_unstable_by_key(|&i| all[i].address);
    let levels = grid.tiles().levels() as u8;
    let at = |level: u8, point: DVec2| {
        let address = Address::new(level, grid.lattice().locate(level, point).hex);
        order.binary_search_by_key(&address, |&i| all[i].address).ok().map(|found| order[found])
    };
    let holder = |&point: &DVec2| {
        let mut found = (0..=levels).rev().filter_map(|level| at(level, point));
        let first = found.next()?;
        let is_leaf = |i: &usize| all[*i].class.is_some();
        Some(std::iter::once(first).chain(found).find(is_leaf).unwrap_or(first))
    };
    points.iter().map(holder).collect()
}

/// What stands at a place of the patch: its base level is full, whatever the
/// grid has on coarser ones.
fn kind(grid: &Grid, domain: Domain, at: Address) -> HexKind {
    match at.level == domain.base_level {
        true if grid.is_subdivided(at) => HexKind::Subdivided,
        true => HexKind::Leaf,
        false => grid.kind(at),
    }
}

/// Every address of the patch at which a hexagon or semi-hexagon can stand.
fn places(grid: &Grid, domain: Domain) -> Vec<Address> {
    let base = domain.base_level;
    let patch = Hex::ORIGIN.disc(domain.radius).map(|hex| Address::new(base, hex));
    let mut all: Vec<_> = patch.collect();
    for level in base..grid.tiles().levels() as u8 {
        let mut children = Vec::new();
        for (first, tile) in grid.tiles().placed(level) {
            for bit in hexdel_grid::window::ones(tile.subdivided) {
                children.extend((first + hex_of(bit)).scaled().disc(1));
            }
        }
        children.sort_unstable();
        children.dedup();
        all.extend(children.into_iter().map(|hex| Address::new(level + 1, hex)));
    }
    all
}

/// The classes of occupied hexagons and their rings.
fn ring_classes(occupants: &[Occupant]) -> BTreeMap<Address, Class> {
    let mut classes = BTreeMap::new();
    let mut set = |level: u8, hexes: &mut dyn Iterator<Item = Hex>, class: Class| {
        for hex in hexes {
            let known = classes.entry(Address::new(level, hex)).or_insert(class);
            *known = (*known).min(class);
        }
    };
    for o in occupants {
        let hex = o.at.hex;
        if ring_may_stay(&o.at) {
            set(o.level, &mut hex.ring(0), Class::Occupied1);
            set(o.level, &mut hex.ring(1), Class::FixedCenterInRing);
        } else {
            set(o.level, &mut hex.ring(0), Class::Occupied2);
            set(o.level, &mut hex.ring(1), Class::MovedCenterInRing);
            set(o.level, &mut hex.ring(2), Class::FixedCenterInRing);
        }
    }
    classes
}

fn by_fins(grid: &Grid, at: Address) -> Class {
    let Some((id, bit)): Option<(TileId, u32)> = grid.tiles().find(at.level, at.hex) else {
        return Class::FixedCenterRegular;
    };
    Classes::of(View::of(grid, at.level, id).subdivided).class_of(hex_of(bit))
}

/// Corners of a full hexagon, or of the half of a semi-hexagon that was made:
/// the one on the side of the parent that is subdivided.
fn corners(grid: &Grid, at: Address, kind: HexKind) -> Vec<DVec2> {
    let spacing = grid.lattice().spacing(at.level);
    let centre = grid.lattice().position(at);
    // Corner i lies at 30 + 60 i degrees, 1 / sqrt(3) of a step from the centre.
    let corner = |i: usize| {
        let d = Direction::new(i);
        let third = crate::exact::Offset::fraction(d.step() + d.turned(1).step(), 1, 3);
        centre + third.cartesian() * spacing
    };
    match kind {
        HexKind::Semi { of } => {
            let outward = of.scaled() - at.hex;
            let d = Direction::ALL.into_iter().find(|d| d.step() == outward).unwrap_or(Direction::ALL[0]);
            // The long edge joins the corners a quarter turn from the way to
            // the parent that is not subdivided.
            (1..5).map(|i| corner(d.index() + i)).collect()
        }
        _ => (0..6).map(corner).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_grid::Lattice;

    fn area(corners: &[DVec2]) -> f64 {
        let next = |i: usize| corners[(i + 1) % corners.len()];
        corners.iter().enumerate().map(|(i, c)| c.perp_dot(next(i))).sum::<f64>() / 2.0
    }

    #[test]
    fn hexagons_and_semi_hexagons_fill_the_patch() {
        let mut grid = Grid::new(Lattice::new(DVec2::ZERO, 1.0));
        grid.subdivide(Address::new(2, Hex::new(3, -1)));
        for base_level in 0..3 {
            let domain = Domain::around(&grid, base_level).unwrap();
            let all = hexagons(&grid, domain, &[]);
            let total: f64 = all.iter().map(|h| area(&h.corners)).sum();
            let one = 0.5 * 3.0_f64.sqrt() * grid.lattice().spacing(base_level).powi(2);
            let hexes = f64::from(3 * domain.radius * (domain.radius + 1) + 1);
            assert!((total - one * hexes).abs() < 1e-9, "{total}");
            assert!(all.iter().any(|h| h.class.is_none()));
            assert!(all.iter().all(|h| area(&h.corners) > 0.0));
        }
    }

    #[test]
    fn every_hexagon_holds_its_middle() {
        let mut grid = Grid::new(Lattice::new(DVec2::new(0.3, 7.0), 1.0));
        grid.subdivide(Address::new(3, Hex::new(5, -2)));
        let all = hexagons(&grid, Domain::around(&grid, 0).unwrap(), &[]);
        let middle = |h: &Hexagon| h.corners.iter().sum::<DVec2>() / h.corners.len() as f64;
        let middles: Vec<DVec2> = all.iter().map(middle).collect();
        let holders = holders(&grid, &all, &middles);
        assert!(holders.into_iter().eq((0..all.len()).map(Some)));
        assert_eq!(super::holders(&grid, &all, &[DVec2::new(1e9, 0.0)]), [None]);
    }
}
