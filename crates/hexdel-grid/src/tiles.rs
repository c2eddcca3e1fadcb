//! The sparse store of hexagon sets: tiles of 8 x 8 hexagons in a quadtree.
//!
//! A tile covers the same lattice square of its level as four tiles of the
//! next finer level, so the tiles form a quadtree. Neighbouring tiles are
//! linked when they are made, found through the parents' links; no tile is
//! ever looked up by hashing, except the few roots.

use crate::axial::Hex;
use crate::window::{Window, ones};
use rustc_hash::FxHashMap;

/// Hexagons along a tile's side.
pub const SIDE: i64 = 8;

/// Index of a tile within its level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TileId(u32);

impl TileId {
    const NONE: Self = Self(u32::MAX);

    /// The id of the tile at `index` of its level.
    #[inline]
    pub const fn new(index: usize) -> Self {
        Self(index as u32)
    }

    /// The position in the level's array.
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    #[inline]
    fn some(self) -> Option<Self> {
        (self != Self::NONE).then_some(self)
    }
}

/// Eight by eight hexagons of one level. Bit `8 r + q` of each plane is the
/// hexagon `(q, r)` counted from the tile's first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tile {
    /// The hexagons that are subdivided.
    pub subdivided: u64,
    /// Two planes whose meaning the layers above define.
    pub marks: [u64; 2],
    /// The hexagons that the next finer level needs subdivided.
    pub needed: u64,
}

impl Tile {
    /// A tile that holds nothing.
    const EMPTY: Self = Self { subdivided: 0, marks: [0; 2], needed: 0 };
}

/// The 3 x 3 tiles around one, `3 row + column`, itself in the middle. Mutual:
/// a tile that exists is linked by all its existing neighbours.
type Around = [TileId; 9];

/// Where a tile is, and its place in the quadtree.
#[derive(Clone, Debug)]
struct Kin {
    /// The first hexagon's address divided by [`SIDE`].
    position: (i64, i64),
    /// The tile one level coarser whose square holds this one; `NONE` at
    /// level 0 only.
    parent: TileId,
    /// The four tiles one level finer within this square, `2 row + column`.
    children: [TileId; 4],
}

impl Kin {
    #[inline]
    const fn first(&self) -> Hex {
        Hex::new(self.position.0 * SIDE, self.position.1 * SIDE)
    }
}

/// The tiles of a level in the order they were made; ids are indices. What is
/// asked for together stands together: the less of the rest comes with it, the
/// more fits into the cache.
#[derive(Clone, Debug, Default)]
struct Level {
    tiles: Vec<Tile>,
    around: Vec<Around>,
    kin: Vec<Kin>,
}

/// The existing tiles of the 3 x 3 around one, and which of them a change in
/// it reaches.
#[derive(Clone, Copy, Debug)]
pub struct Margin {
    around: Around,
    /// A bit for each that exists.
    existing: u16,
    /// A bit for each that is reached.
    reached: u16,
}

impl Margin {
    /// The tiles, each with whether it is reached.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = (TileId, bool)> {
        let all = ones(u64::from(self.existing));
        all.map(|i| (self.around[i as usize], self.reached >> i & 1 == 1))
    }
}

/// All tiles of all levels.
#[derive(Clone, Debug, Default)]
pub struct Tiles {
    levels: Vec<Level>,
    /// Tiles of level 0 by position.
    roots: FxHashMap<(i64, i64), TileId>,
}

impl Tiles {
    /// One more than the finest level that holds a tile.
    pub fn levels(&self) -> usize {
        self.levels.len()
    }

    /// The tiles of a level, by id; none where the level is finer than all.
    pub fn level(&self, level: u8) -> &[Tile] {
        self.levels.get(usize::from(level)).map_or(&[], |level| &level.tiles)
    }

    /// The tiles of a level with the addresses of their first hexagons, by id.
    pub fn placed(&self, level: u8) -> impl Iterator<Item = (Hex, &Tile)> {
        let level = self.levels.get(usize::from(level));
        level.into_iter().flat_map(|Level { tiles, kin, .. }| kin.iter().map(Kin::first).zip(tiles))
    }

    /// A tile.
    ///
    /// # Panics
    ///
    /// If `id` is not of `level`.
    #[inline]
    pub fn get(&self, level: u8, id: TileId) -> &Tile {
        &self.levels[usize::from(level)].tiles[id.index()]
    }

    /// A tile, to change its planes.
    ///
    /// # Panics
    ///
    /// If `id` is not of `level`.
    #[inline]
    pub fn get_mut(&mut self, level: u8, id: TileId) -> &mut Tile {
        &mut self.levels[usize::from(level)].tiles[id.index()]
    }

    /// The address of a tile's first hexagon.
    ///
    /// # Panics
    ///
    /// If `id` is not of `level`.
    #[inline]
    pub fn first(&self, level: u8, id: TileId) -> Hex {
        self.kin(level, id).first()
    }

    #[inline]
    fn links(&self, level: u8, id: TileId) -> &Around {
        &self.levels[usize::from(level)].around[id.index()]
    }

    #[inline]
    fn kin(&self, level: u8, id: TileId) -> &Kin {
        &self.levels[usize::from(level)].kin[id.index()]
    }

    /// The tile that holds a hexagon and the hexagon's bit in it, if there is
    /// such a tile. Takes one step per level.
    pub fn find(&self, level: u8, hex: Hex) -> Option<(TileId, u32)> {
        let (position, bit) = split(hex);
        let up = |k: u8| (position.0 >> k, position.1 >> k);
        let mut id = *self.roots.get(&up(level))?;
        for k in (0..level).rev() {
            let p = up(k);
            id = self.child(level - k - 1, id, quadrant(p))?;
        }
        Some((id, bit))
    }

    /// The tile that holds a hexagon, made if it does not exist, and the
    /// hexagon's bit in it. Takes one step per level.
    pub fn require(&mut self, level: u8, hex: Hex) -> (TileId, u32) {
        let (position, bit) = split(hex);
        let mut id = self.require_root((position.0 >> level, position.1 >> level));
        for k in (0..level).rev() {
            id = self.require_child(level - k - 1, id, quadrant((position.0 >> k, position.1 >> k)));
        }
        (id, bit)
    }

    /// The same as [`require`](Self::require), of a hexagon in the tile `near` or
    /// beside it; `None` if it lies elsewhere.
    #[inline]
    pub fn require_near(&mut self, level: u8, near: TileId, hex: Hex) -> Option<(TileId, u32)> {
        let (position, bit) = split(hex);
        let from = self.kin(level, near).position;
        let (column, row) = (position.0 - from.0, position.1 - from.1);
        let adjacent = column.abs() <= 1 && row.abs() <= 1;
        adjacent.then(|| (self.require_beside(level, near, column, row), bit))
    }

    /// The same as [`require`](Self::require), faster if the hexagon lies under the
    /// tile `above` of the next coarser level or beside it.
    #[inline]
    pub fn require_under(&mut self, level: u8, above: TileId, hex: Hex) -> (TileId, u32) {
        let (position, bit) = split(hex);
        let from = self.kin(level - 1, above).position;
        let (column, row) = ((position.0 >> 1) - from.0, (position.1 >> 1) - from.1);
        if column.abs() > 1 || row.abs() > 1 {
            return self.require(level, hex);
        }
        let parent = self.require_beside(level - 1, above, column, row);
        (self.require_child(level - 1, parent, quadrant(position)), bit)
    }

    /// One of the 3 x 3 tiles around, `column` and `row` from -1 to 1.
    #[inline]
    pub fn beside(&self, level: u8, id: TileId, column: i64, row: i64) -> Option<TileId> {
        self.links(level, id)[(3 * (row + 1) + column + 1) as usize].some()
    }

    /// Makes one of the 3 x 3 tiles around exist, `column` and `row` from -1
    /// to 1.
    pub fn require_beside(&mut self, level: u8, id: TileId, column: i64, row: i64) -> TileId {
        if let Some(there) = self.beside(level, id, column, row) {
            return there;
        }
        let tile = self.kin(level, id);
        let position = (tile.position.0 + column, tile.position.1 + row);
        if level == 0 {
            return self.require_root(position);
        }
        let parent = tile.parent;
        let from = self.kin(level - 1, parent).position;
        let parent =
            self.require_beside(level - 1, parent, (position.0 >> 1) - from.0, (position.1 >> 1) - from.1);
        self.require_child(level - 1, parent, quadrant(position))
    }

    /// The tile one level finer in one quarter of this one's square,
    /// `quadrant` = `2 row + column`.
    #[inline]
    pub fn child(&self, level: u8, id: TileId, quadrant: usize) -> Option<TileId> {
        self.kin(level, id).children[quadrant].some()
    }

    /// Makes the tile one level finer in one quarter of this one's square.
    pub fn require_child(&mut self, level: u8, id: TileId, quadrant: usize) -> TileId {
        if let Some(child) = self.child(level, id, quadrant) {
            return child;
        }
        let (q, r) = self.kin(level, id).position;
        let position = (2 * q + (quadrant as i64 & 1), 2 * r + (quadrant as i64 >> 1));
        let child = self.push(level + 1, position, id);
        self.levels[usize::from(level)].kin[id.index()].children[quadrant] = child;
        self.link_child(level + 1, child, quadrant);
        child
    }

    /// The tile one level coarser and the quarter of it that this one covers,
    /// `2 row + column`; `None` at level 0.
    #[inline]
    pub fn parent(&self, level: u8, id: TileId) -> Option<(TileId, usize)> {
        let tile = self.kin(level, id);
        Some((tile.parent.some()?, quadrant(tile.position)))
    }

    /// The window of a tile for one plane.
    #[inline]
    pub fn window(&self, level: u8, id: TileId, plane: impl Fn(&Tile) -> u64) -> Window {
        let Level { tiles, around, .. } = &self.levels[usize::from(level)];
        let around = &around[id.index()];
        let bits = |i: usize| around[i].some().map_or(0, |t| plane(&tiles[t.index()]));
        Window::gather(&[
            [bits(0), bits(1), bits(2)],
            [bits(3), bits(4), bits(5)],
            [bits(6), bits(7), bits(8)],
        ])
    }

    /// The windows of a tile for several planes at once.
    #[inline]
    pub fn windows<const N: usize>(
        &self,
        level: u8,
        id: TileId,
        planes: impl Fn(&Tile) -> [u64; N],
    ) -> [Window; N] {
        let Level { tiles, around, .. } = &self.levels[usize::from(level)];
        let around = &around[id.index()];
        let mut bits = [[[0; 3]; 3]; N];
        let mut any = [0; N];
        for (i, there) in around.iter().enumerate() {
            if let Some(there) = there.some() {
                for (plane, word) in planes(&tiles[there.index()]).into_iter().enumerate() {
                    bits[plane][i / 3][i % 3] = word;
                    any[plane] |= word;
                }
            }
        }
        std::array::from_fn(
            |plane| {
                if any[plane] == 0 { Window::EMPTY } else { Window::gather(&bits[plane]) }
            },
        )
    }

    /// The existing tiles among the 3 x 3 around, itself included.
    pub fn around(&self, level: u8, id: TileId) -> impl Iterator<Item = TileId> {
        self.links(level, id).iter().copied().filter_map(TileId::some)
    }

    /// Makes the tiles exist whose window shows one of `bits`, and says which of
    /// them lie within [`Window::MARGIN`] steps of one.
    #[inline]
    pub fn require_margin(&mut self, level: u8, id: TileId, bits: u64) -> Margin {
        let shown = reach(bits, &QUARTERS);
        let existing = existing(self.links(level, id));
        for i in ones(u64::from(shown & !existing)) {
            self.require_beside(level, id, i64::from(i) % 3 - 1, i64::from(i) / 3 - 1);
        }
        let reached = shown & reach(bits, &CORNERS);
        Margin { around: *self.links(level, id), existing: existing | shown, reached }
    }

    fn require_root(&mut self, position: (i64, i64)) -> TileId {
        if let Some(&root) = self.roots.get(&position) {
            return root;
        }
        let root = self.push(0, position, TileId::NONE);
        self.roots.insert(position, root);
        for i in 0..9 {
            let beside = (position.0 + i as i64 % 3 - 1, position.1 + i as i64 / 3 - 1);
            if let Some(&other) = self.roots.get(&beside) {
                self.link(0, root, other, i);
            }
        }
        root
    }

    fn push(&mut self, level: u8, position: (i64, i64), parent: TileId) -> TileId {
        let level = usize::from(level);
        if level == self.levels.len() {
            self.levels.push(Level::default());
        }
        let Level { tiles, around, kin } = &mut self.levels[level];
        let id = TileId::new(tiles.len());
        tiles.push(Tile::EMPTY);
        around.push([TileId::NONE; 9]);
        kin.push(Kin { position, parent, children: [TileId::NONE; 4] });
        id
    }

    /// Links a new tile in a quadrant of its parent with its existing
    /// neighbours, which are children of the parent and of its neighbours.
    fn link_child(&mut self, level: u8, id: TileId, quadrant: usize) {
        let parents = *self.links(level - 1, self.kin(level, id).parent);
        for i in 0..9 {
            let (column, row) = (quadrant % 2 + i % 3 + 1, quadrant / 2 + i / 3 + 1);
            if let Some(parent) = parents[3 * (row / 2) + column / 2].some()
                && let Some(other) = self.child(level - 1, parent, 2 * (row % 2) + column % 2)
            {
                self.link(level, id, other, i);
            }
        }
    }

    /// Links two tiles, the second being the one at `place` of the first.
    #[inline]
    fn link(&mut self, level: u8, id: TileId, other: TileId, place: usize) {
        self.levels[usize::from(level)].around[id.index()][place] = other;
        self.levels[usize::from(level)].around[other.index()][8 - place] = id;
    }
}

/// Bits of a tile, and a bit for each of the 3 x 3 tiles around.
type Reach = (u64, u16);

/// The windows that show a quarter of the tile: its own, those of the tiles
/// beside the quarter and of the one across its corner.
const QUARTERS: [Reach; 4] = [
    (0x0000_0000_0f0f_0f0f, 0b000_011_011),
    (0x0000_0000_f0f0_f0f0, 0b000_110_110),
    (0x0f0f_0f0f_0000_0000, 0b011_011_000),
    (0xf0f0_f0f0_0000_0000, 0b110_110_000),
];

/// The same by steps: across two of the corners it is as far in steps as in
/// rows and columns together, so that six hexagons are near.
const CORNERS: [Reach; 3] = [
    (u64::MAX, 0b011_111_110),
    (0x0000_0000_0001_0307, 0b000_000_001),
    (0xe0c0_8000_0000_0000, 0b100_000_000),
];

/// A bit for each tile that exists.
#[inline]
fn existing(around: &Around) -> u16 {
    (0..9).fold(0, |all, i| all | u16::from(around[i] != TileId::NONE) << i)
}

/// What some bits of a tile reach.
#[inline]
fn reach(bits: u64, parts: &[Reach]) -> u16 {
    parts.iter().fold(0, |all, (part, reached)| all | reached & u16::from(bits & part != 0).wrapping_neg())
}

/// The tile position of a hexagon and its bit within the tile.
#[inline]
fn split(hex: Hex) -> ((i64, i64), u32) {
    let bit = 8 * (hex.r & 7) + (hex.q & 7);
    ((hex.q >> 3, hex.r >> 3), bit as u32)
}

/// Which quarter of its parent's square a tile covers.
#[inline]
fn quadrant(position: (i64, i64)) -> usize {
    ((position.1 & 1) * 2 + (position.0 & 1)) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_do_not_depend_on_the_order_of_making() {
        let hexes: Vec<_> = Hex::new(-3, 5).disc(30).collect();
        for stride in [1, 7, 11] {
            let mut tiles = Tiles::default();
            for i in 0..hexes.len() {
                tiles.require(3, hexes[i * stride % hexes.len()]);
            }
            for &h in &hexes {
                let (id, _) = tiles.find(3, h).unwrap();
                for i in 0..9 {
                    let (column, row) = (i % 3 - 1, i / 3 - 1);
                    let there = h + Hex::new(SIDE * column, SIDE * row);
                    assert_eq!(tiles.beside(3, id, column, row), tiles.find(3, there).map(|(t, _)| t));
                    assert_eq!(tiles.require_near(3, id, h), tiles.find(3, h));
                }
                // Whatever tile of the next coarser level it is said to lie under.
                let coarse = (0..tiles.level(2).len()).map(TileId::new);
                for above in coarse.step_by(5).chain(tiles.parent(3, id).map(|(above, _)| above)) {
                    assert_eq!(Some(tiles.require_under(3, above, h)), tiles.find(3, h));
                }
                assert_eq!(tiles.require_near(3, id, h + Hex::new(2 * SIDE, 0)), None);
            }
        }
    }

    #[test]
    fn windows_show_the_hexagons_around_a_tile() {
        let mut tiles = Tiles::default();
        let set: Vec<_> = Hex::new(4, 4).disc(9).filter(|h| (h.q * 5 + h.r * 3) % 4 == 0).collect();
        for &h in &set {
            let (id, bit) = tiles.require(2, h);
            tiles.get_mut(2, id).subdivided |= 1 << bit;
        }
        let (id, _) = tiles.find(2, Hex::ORIGIN).unwrap();
        let window = tiles.window(2, id, |t| t.subdivided);
        for at in Window::with_margin(4).iter() {
            assert_eq!(window.contains(at), set.contains(&at), "{at:?}");
        }
    }

    #[test]
    fn margins_are_made_where_bits_reach_them() {
        let mut tiles = Tiles::default();
        let (id, bit) = tiles.require(1, Hex::new(1, 6));
        let reached = tiles.require_margin(1, id, 1 << bit);
        assert_eq!(reached.iter().filter(|(_, reached)| *reached).count(), tiles.level(1).len());
        let made: Vec<_> = tiles.placed(1).map(|(first, _)| first).collect();
        let mut expected = [Hex::new(0, 0), Hex::new(-8, 0), Hex::new(0, 8), Hex::new(-8, 8)];
        let mut made_sorted = made;
        made_sorted.sort();
        expected.sort();
        assert_eq!(made_sorted, expected);
    }

    #[test]
    fn tiles_are_reached_within_four_steps() {
        let mut tiles = Tiles::default();
        let (id, _) = tiles.require(1, Hex::ORIGIN);
        tiles.require_margin(1, id, u64::MAX);
        for bit in 0..64 {
            let at = Hex::new(bit % 8, bit / 8);
            let margin = tiles.require_margin(1, id, 1 << bit);
            assert_eq!(margin.iter().count(), 9);
            for (tile, reached) in margin.iter() {
                let first = tiles.first(1, tile);
                let hexes = (0..64).map(|i| first + Hex::new(i % 8, i / 8));
                let nearest = hexes.map(|h| h.distance(at)).min();
                assert_eq!(reached, nearest <= Some(Window::MARGIN as u64), "{at:?}, {first:?}");
            }
        }
    }
}
