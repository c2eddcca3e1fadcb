//! Hexagons that stay subdivided because the caller wants it, in a grid whose points
//! come and go: for sizes.

use super::live::is_far;
use super::{RefineError, Refiner, RestoreError};
use hexdel_geom::{Monitor, Unwatched};
use hexdel_grid::grid::hex_of;
use hexdel_grid::window::ones;
use hexdel_grid::{Address, Grid, Hex, TileId};

impl Refiner {
    /// Subdivides leaves, which stay subdivided until they are
    /// [dropped](Self::drop_wanted), and refines until every rule holds again.
    ///
    /// # Errors
    ///
    /// As [`insert`](Self::insert); [`revert`](Self::revert) then restores the grid.
    pub fn want(&mut self, leaves: &[Address]) -> Result<(), RefineError> {
        for &at in leaves {
            if at.level + 1 >= Grid::MAX_LEVELS {
                return Err(RefineError::TooFine { levels: Grid::MAX_LEVELS });
            }
            let (id, bit) = self.grid.tile_of(at);
            self.note(at.level, id);
            self.note_wanted(at.level, id);
            *self.wanted.entry((at.level, id)).or_default() |= 1 << bit;
            self.grid.tiles_mut().get_mut(at.level, id).needed |= 1 << bit;
            self.subdivide(at.level, id, 1 << bit);
        }
        self.finish(&Unwatched)
    }

    /// No longer wants the hexagons that `keep` refuses subdivided. What nobody else
    /// needs is merged.
    ///
    /// # Errors
    ///
    /// As [`want`](Self::want).
    ///
    /// # Complexity
    ///
    /// A look at each hexagon wanted, and work in proportion to what changes.
    pub fn drop_wanted(&mut self, keep: impl Fn(Address) -> bool) -> Result<(), RefineError> {
        let all: Vec<((u8, TileId), u64)> = self.wanted.iter().map(|(&tile, &bits)| (tile, bits)).collect();
        for ((level, id), bits) in all {
            let first = self.grid.tiles().first(level, id);
            let dropped = ones(bits).filter(|&bit| !keep(Address::new(level, first + hex_of(bit))));
            let dropped: u64 = dropped.map(|bit| 1 << bit).sum();
            if dropped != 0 {
                self.drop_from(level, id, dropped);
            }
        }
        self.finish(&Unwatched)
    }

    /// Forgets that hexagons of a tile are wanted. The tiles of the next finer level that
    /// may need them are asked again; where there are none, nobody does.
    fn drop_from(&mut self, level: u8, id: TileId, dropped: u64) {
        self.note(level, id);
        self.note_wanted(level, id);
        let left = self.wanted_in(level, id) & !dropped;
        if left == 0 {
            self.wanted.remove(&(level, id));
        } else {
            self.wanted.insert((level, id), left);
        }
        let first = self.grid.tiles().first(level, id);
        let mut lost = 0;
        for bit in ones(dropped) {
            let at = first + hex_of(bit);
            match self.grid.tiles().find(level + 1, Hex::new(2 * at.q, 2 * at.r)) {
                Some((finer, _)) => {
                    let k = usize::from(level) + 1;
                    self.waiting.resize_with(self.waiting.len().max(k + 1), Default::default);
                    self.waiting[k].push(finer.index(), [false, true, true]);
                }
                None => lost |= 1 << bit,
            }
        }
        self.grid.tiles_mut().get_mut(level, id).needed &= !lost;
        if lost != 0 {
            self.reset(level, vec![(id, lost)]);
        }
    }

    fn finish(&mut self, monitor: &dyn Monitor) -> Result<(), RefineError> {
        self.sink()?;
        self.close(monitor)
    }

    /// The hexagons wanted, tile by tile: level, first hexagon and bits.
    pub fn wanted(&self) -> impl Iterator<Item = (u8, Hex, u64)> + '_ {
        self.wanted.iter().map(|(&(level, id), &bits)| (level, self.grid.tiles().first(level, id), bits))
    }

    /// The hexagons of a tile that are wanted.
    pub(super) fn wanted_in(&self, level: u8, id: TileId) -> u64 {
        self.wanted.get(&(level, id)).copied().unwrap_or(0)
    }

    fn note_wanted(&mut self, level: u8, id: TileId) {
        let bits = self.wanted_in(level, id);
        if let Some(live) = &mut self.live {
            live.wanted.entry((level, id)).or_insert(bits);
        }
    }

    /// Wants what was wanted when the grid was left, of a grid
    /// [restored](Self::restored) from then.
    ///
    /// # Errors
    ///
    /// [`RestoreError::OutOfRange`] for hexagons that are not subdivided.
    pub fn restore_wanted(
        &mut self,
        wanted: impl IntoIterator<Item = (u8, Hex, u64)>,
    ) -> Result<(), RestoreError> {
        for (level, first, bits) in wanted {
            let found =
                (level < Grid::MAX_LEVELS && !is_far(first) && (first.q | first.r).trailing_zeros() >= 3)
                    .then(|| self.grid.tiles().find(level, first))
                    .flatten();
            let id =
                found.map(|f| f.0).filter(|&id| bits & !self.grid.tiles().get(level, id).subdivided == 0);
            let id = id.ok_or(RestoreError::OutOfRange { level, first })?;
            self.wanted.insert((level, id), bits);
            self.grid.tiles_mut().get_mut(level, id).needed |= bits;
        }
        Ok(())
    }
}
