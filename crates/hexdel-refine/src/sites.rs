//! Input points and the hexagons they occupy.

use hexdel_classify::Occupant;
use hexdel_classify::relocate::{RING_STAYS, ring_norm};
use hexdel_geom::DVec2;
use hexdel_geom::double_double::Double;
use hexdel_geom::par::prelude::*;
use hexdel_grid::{Hex, Lattice, Located, TileId};

/// An input point in the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// The point, as given.
    pub point: DVec2,
    /// The level of the leaf it occupies.
    pub level: u8,
    /// That leaf, and where in it the point lies, to a millionth.
    pub at: Located,
}

impl Site {
    /// A point in the hexagon of a level that holds it.
    pub fn new(lattice: &Lattice, level: u8, point: DVec2) -> Self {
        Self { point, level, at: lattice.locate(level, point) }
    }

    /// The same point one level down.
    #[must_use]
    pub fn below(&self, lattice: &Lattice) -> Self {
        let at = lattice.locate_below(self.level, &self.at, self.point);
        Self { point: self.point, level: self.level + 1, at }
    }

    /// The plane of tile marks that the hexagon belongs to: class `Occupied1`
    /// or `Occupied2`.
    pub fn plane(&self, lattice: &Lattice) -> usize {
        const DOUBTFUL: f64 = 1e-5;
        let norm = ring_norm(&self.at);
        let in_doubt = (norm - RING_STAYS).abs() < DOUBTFUL;
        let norm = if in_doubt { ring_norm(&lattice.locate(self.level, self.point)) } else { norm };
        usize::from(norm > RING_STAYS)
    }
}

/// All input points, by site id: along a space-filling curve, so that
/// neighbours in the plane are mostly neighbours in memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sites {
    all: Vec<Site>,
    /// The site id of each point, in the order of adding. A permutation.
    rank: Vec<u32>,
    /// The place of each site.
    places: Vec<Place>,
    /// The first site of each tile, by level and tile id, or [`NONE`]; none
    /// beyond the end. Together with `places` a list of each tile's occupants.
    heads: Vec<Vec<u32>>,
}

/// Where a site is among the tiles: apart from the [`Site`] itself, which is
/// larger and of which nothing else is asked when it leaves its hexagon.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// The tile of its hexagon; while it descends, of the last one.
    tile: TileId,
    /// The hexagon's bit there.
    bit: u32,
    /// The next site that occupies a hexagon of the same tile, or [`NONE`].
    next: u32,
}

const NONE: u32 = u32::MAX;

impl Sites {
    /// Adds points, all on level 0. Returns their ids, ascending.
    pub(crate) fn add(&mut self, lattice: &Lattice, points: &[DVec2]) -> Vec<u32> {
        let first = self.all.len();
        let order =
            points.par_iter().enumerate().map(|(i, &p)| (along_curve(lattice, p), i as u32)).collect();
        let order = sorted_by_key(order);
        self.all.par_extend(order.par_iter().map(|&(_, i)| Site::new(lattice, 0, points[i as usize])));
        self.places.resize(self.all.len(), Place { tile: TileId::new(0), bit: 0, next: NONE });
        self.rank.resize(self.all.len(), NONE);
        for (site, &(_, i)) in (first..).zip(&order) {
            self.rank[first + i as usize] = site as u32;
        }
        (first as u32..self.all.len() as u32).collect()
    }

    /// The points and the leaves they occupy, in the order of adding.
    pub(crate) fn occupants(&self, lattice: &Lattice) -> Vec<Occupant> {
        self.rank.par_iter().map(|&id| self.occupant(lattice, id)).collect()
    }

    /// The same, by site id.
    pub(crate) fn occupants_by_id(&self, lattice: &Lattice) -> Vec<Occupant> {
        (0..self.all.len() as u32).into_par_iter().map(|id| self.occupant(lattice, id)).collect()
    }

    fn occupant(&self, lattice: &Lattice, id: u32) -> Occupant {
        let &Site { point, level, .. } = self.get(id);
        Occupant { level, at: lattice.locate(level, point), tile: self.tile_of(id), point }
    }

    #[inline]
    pub(crate) fn get(&self, id: u32) -> &Site {
        &self.all[id as usize]
    }

    #[inline]
    pub(crate) fn get_mut(&mut self, id: u32) -> &mut Site {
        &mut self.all[id as usize]
    }

    /// Which point a site is, in the order of adding. Takes a search.
    pub(crate) fn index_of(&self, id: u32) -> usize {
        self.rank.iter().position(|&r| r == id).expect("every site was added")
    }

    /// The site id of each point, in the order of adding.
    pub(crate) fn ids(&self) -> &[u32] {
        &self.rank
    }

    /// The tile of the hexagon that a site was last put into, or sent on from.
    pub(crate) fn tile_of(&self, id: u32) -> TileId {
        self.places[id as usize].tile
    }

    /// Forgets the sites from `len` on, which occupy nothing.
    pub(crate) fn truncate(&mut self, len: usize) {
        self.all.truncate(len);
        self.rank.truncate(len);
        self.places.truncate(len);
    }

    /// The sites that occupy hexagons of a tile.
    pub(crate) fn of_tile(&self, level: u8, tile: TileId) -> impl Iterator<Item = u32> + '_ {
        let heads = self.heads.get(usize::from(level)).and_then(|heads| heads.get(tile.index()));
        let mut id = heads.copied().unwrap_or(NONE);
        std::iter::from_fn(move || {
            let found = (id != NONE).then_some(id)?;
            id = self.places[found as usize].next;
            Some(found)
        })
    }

    /// Notes that a site occupies its hexagon, which is one of `tile`.
    #[inline]
    pub(crate) fn enter(&mut self, id: u32, tile: TileId) {
        let (level, bit) = (usize::from(self.get(id).level), bit_of(self.get(id).at.hex));
        if level >= self.heads.len() {
            self.heads.resize(level + 1, Vec::new());
        }
        let heads = &mut self.heads[level];
        if tile.index() >= heads.len() {
            heads.resize((tile.index() + 1).next_power_of_two(), NONE);
        }
        let next = std::mem::replace(&mut heads[tile.index()], id);
        self.places[id as usize] = Place { tile, bit, next };
    }

    /// Notes the tile of a site's hexagon, which it does not occupy: it moves on.
    #[inline]
    pub(crate) fn pass(&mut self, id: u32, tile: TileId) {
        self.places[id as usize].tile = tile;
    }

    /// Forgets and returns the site that occupies a hexagon.
    #[inline]
    pub(crate) fn leave(&mut self, level: u8, tile: TileId, bit: u32) -> Option<u32> {
        let head = self.heads.get_mut(usize::from(level))?.get_mut(tile.index())?;
        let (mut before, mut id) = (NONE, *head);
        while id != NONE {
            let Place { bit: found, next: after, .. } = self.places[id as usize];
            if found == bit {
                *(if before == NONE { head } else { &mut self.places[before as usize].next }) = after;
                return Some(id);
            }
            (before, id) = (id, after);
        }
        None
    }
}

/// The bit of a hexagon in its tile.
#[inline]
fn bit_of(hex: Hex) -> u32 {
    (8 * (hex.r & 7) + (hex.q & 7)) as u32
}

/// Where a point lies along a Z-curve on the lattice's axes: as tiles are
/// nested, so are the curve's parts.
fn along_curve(lattice: &Lattice, point: DVec2) -> u64 {
    // Sixteen hexagons of level 0 in 32 bits; what lies outside is clamped,
    // which costs time at most.
    let scale = f64::from(1 << 28) / lattice.spacing(0);
    let v = (point - lattice.origin()) * scale;
    let r = v.y / Double::HALF_SQRT_3.hi;
    let q = v.x - 0.5 * r;
    let bits = |x: f64| spread((x + f64::from(1_u32 << 31)) as u32);
    bits(q) | bits(r) << 1
}

/// Sorts by the first of each pair; equal ones stay in order. Digit by digit, the
/// lowest first: in a fifth of the time that comparing takes.
fn sorted_by_key(mut pairs: Vec<(u64, u32)>) -> Vec<(u64, u32)> {
    const BITS: usize = 11;
    if pairs.len() < 1 << BITS {
        pairs.sort_by_key(|&(key, _)| key);
        return pairs;
    }
    let mut sorted = vec![(0, 0); pairs.len()];
    for shift in (0..u64::BITS).step_by(BITS) {
        let digit = |key: u64| (key >> shift) as usize % (1 << BITS);
        let mut places = [0_usize; 1 << BITS];
        for &(key, _) in &pairs {
            places[digit(key)] += 1;
        }
        if places.contains(&pairs.len()) {
            continue;
        }
        let mut next = 0;
        for place in &mut places {
            next += std::mem::replace(place, next);
        }
        for &pair in &pairs {
            let place = &mut places[digit(pair.0)];
            sorted[*place] = pair;
            *place += 1;
        }
        std::mem::swap(&mut pairs, &mut sorted);
    }
    pairs
}

/// Bit `i` of 32 to bit `2 i`.
fn spread(x: u32) -> u64 {
    let x = u64::from(x);
    let x = (x | x << 16) & 0x0000_ffff_0000_ffff;
    let x = (x | x << 8) & 0x00ff_00ff_00ff_00ff;
    let x = (x | x << 4) & 0x0f0f_0f0f_0f0f_0f0f;
    let x = (x | x << 2) & 0x3333_3333_3333_3333;
    (x | x << 1) & 0x5555_5555_5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> Lattice {
        Lattice::new(DVec2::ZERO, 1.0)
    }

    #[test]
    fn points_keep_their_order_whatever_the_curve_does() {
        let points: Vec<_> =
            (0..50).map(|i| DVec2::new(f64::from(i * 37 % 50) * 0.1, f64::from(i * 11 % 50) * 0.1)).collect();
        let mut sites = Sites::default();
        assert_eq!(sites.add(&lattice(), &points[..20]), (0..20).collect::<Vec<_>>());
        assert_eq!(sites.add(&lattice(), &points[20..]), (20..50).collect::<Vec<_>>());
        let back: Vec<_> = sites.occupants(&lattice()).into_iter().map(|o| o.point).collect();
        assert_eq!(back, points);
        for id in 0..50 {
            assert_eq!(points[sites.index_of(id)], sites.get(id).point);
        }
    }

    #[test]
    fn the_plane_of_a_point_is_the_same_however_it_came_there() {
        const LEVEL: u8 = 12;
        let lattice = lattice();
        let plane = |point| Site::new(&lattice, LEVEL, point).plane(&lattice);
        let descended =
            |point| (0..LEVEL).fold(Site::new(&lattice, 0, point), |site, _| site.below(&lattice));
        let spacing = lattice.spacing(LEVEL);
        let mut crossings = 0;
        for i in 0..400 {
            let start = DVec2::new(f64::from(i % 20) * 0.0817, f64::from(i / 20) * 0.0643);
            let step = DVec2::from_angle(f64::from(i)) * (0.05 * spacing);
            // Where the plane changes along the step, if it does.
            let (mut low, mut high) = (0.0, 1.0);
            if plane(start) == plane(start + step) {
                continue;
            }
            crossings += 1;
            while high - low > 1e-13 {
                let middle = f64::midpoint(low, high);
                if plane(start + middle * step) == plane(start) { low = middle } else { high = middle }
            }
            for beside in (0..60).map(|k| 0.5_f64.powi(10 + k / 2) * f64::from(1 - k % 2 * 2)) {
                let point = start + (low + beside) * step;
                assert_eq!(descended(point).plane(&lattice), plane(point), "{i} {beside:e}");
            }
        }
        assert!(crossings > 20, "{crossings}");
    }

    #[test]
    fn pairs_are_sorted_by_key_and_equal_ones_stay_in_order() {
        for (count, key) in [(100, u64::MAX), (5000, u64::MAX), (5000, 0xfff0_0000_0f00_00ff), (3000, 0)] {
            let mixed = |i: u32| (u64::from(i) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let pairs: Vec<_> = (0..count).map(|i| (mixed(i) & key, i)).collect();
            let mut expected = pairs.clone();
            expected.sort_unstable();
            assert_eq!(sorted_by_key(pairs), expected);
        }
    }

    #[test]
    fn occupants_leave_in_any_order() {
        let points = [DVec2::new(0.0, 0.0), DVec2::new(1.0, 0.0), DVec2::new(2.0, 0.0)];
        let tile = TileId::new(5);
        for order in [[0, 1, 2], [2, 1, 0], [1, 0, 2], [1, 2, 0]] {
            let mut sites = Sites::default();
            for id in sites.add(&lattice(), &points) {
                sites.enter(id, tile);
            }
            for i in order {
                let left = sites.leave(0, tile, bit_of(Hex::new(i, 0)));
                assert_eq!(left.map(|id| sites.index_of(id)), Some(i as usize));
                assert_eq!(sites.leave(0, tile, bit_of(Hex::new(i, 0))), None);
            }
        }
    }
}
