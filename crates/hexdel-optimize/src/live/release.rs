//! A fixed vertex that becomes free, and what goes with it.

use hexdel_geom::DVec2;

use crate::constraints::NOWHERE;
use crate::live::coarsen::{STUCK, Try, USUAL, coarsen};
use crate::live::cut::{Cut, rings};
use crate::live::insert::repair_rounds;
use crate::live::store::Vertex;
use crate::live::verify::{Written, keeps_bounds_here, settle_changes};
use crate::live::{INNER_RINGS, LiveError, LiveMesh, RINGS, thin};
use crate::mesh::{Motion, NONE};

/// Rounds of removals after one change, at most: each coarsens by half what is
/// too fine.
const MOST_THINNINGS: usize = 16;

/// Rounds of coarsening after one change, at most.
const MOST_COARSENINGS: usize = 8;

/// A removal that takes no more triangles away is stuck: a vertex has two.
const FEW: usize = 2;

/// Sine of the turn up to which a rim goes straight on, as for a whole outline.
const STRAIGHT: f64 = 1e-3;

/// Triangles that are brought inside the bounds one by one after a point near
/// which others held is gone.
const MOST_MENDED: usize = 64;

/// What a vertex becomes that is no longer fixed.
struct Freedom {
    motion: Motion,
    /// Angle of the domain there.
    sector: f64,
    source: u32,
}

impl LiveMesh {
    /// Gives a fixed vertex free, and removes what has become superfluous
    /// around it, most of the time with the vertex itself. A corner of the
    /// domain or an end of a segment stays.
    ///
    /// # Errors
    ///
    /// [`LiveError::NoRoom`] where the bounds around a point of a PSLG cannot be
    /// made those of places without one; the mesh is then as it was.
    ///
    /// # Panics
    ///
    /// If there is no vertex in the slot.
    pub fn release(&mut self, slot: u32) -> Result<(), LiveError> {
        let old = *self.store.vertex(slot);
        assert!(old.alive(), "no vertex in slot {slot}");
        let Some(Freedom { motion, sector, source }) = self.freedom(slot) else {
            return Ok(());
        };
        let (mark, serials) = (self.store.mark(), self.store.serials);
        self.store.write_vertex(slot, Vertex { motion, sector, source, failed: 0, ..old });
        let count = self.store.counts()[1];
        let freed = (self.store.mark(), self.store.serials);
        self.forget_failures(slot);
        if self.drafts && settle_changes(&mut self.store, mark, self.bounds) {
            return Ok(());
        }
        thin::thin(&mut self.store, &self.tools, slot, old.at);
        if self.mend(mark) && self.shorten(mark, false).is_ok() {
            self.thin_changed(mark, MOST_THINNINGS);
            let gone = count.saturating_sub(self.store.counts()[1]);
            self.coarsen_around(old.at, mark, if gone > FEW { USUAL } else { STUCK });
            if settle_changes(&mut self.store, mark, self.bounds) {
                return Ok(());
            }
        }
        // What is superfluous may stay, if it is within the bounds as it is.
        self.reset(freed.0, freed.1);
        if settle_changes(&mut self.store, mark, self.bounds) {
            return Ok(());
        }
        self.reset(mark, serials);
        Err(LiveError::NoRoom { at: old.at })
    }

    /// Brings triangles inside the bounds that the points and segments left near
    /// them no longer excuse.
    fn mend(&mut self, mark: usize) -> bool {
        for _ in 0..MOST_MENDED {
            let suspects = Written::of(self.store.since(mark)).to_check(&self.store);
            let bad = |t: &u32| !keeps_bounds_here(&self.store, self.bounds, *t);
            let Some(t) = suspects.into_iter().find(bad) else { return true };
            if !self.repair_around(t) && !INNER_RINGS.into_iter().any(|inner| self.refine_around(t, inner)) {
                return false;
            }
        }
        false
    }

    /// Takes many vertices out at once around `p`, for as long as that succeeds.
    fn coarsen_around(&mut self, p: DVec2, mark: usize, how: Try) {
        for _ in 0..MOST_COARSENINGS {
            let Ok(spot) = self.locate(p) else { return };
            if !coarsen(&mut self.store, &self.tools, (spot.triangle, p), how) {
                return;
            }
            self.thin_changed(mark, MOST_THINNINGS);
        }
    }

    fn repair_around(&mut self, t: u32) -> bool {
        let cut = Cut::new(&self.store, rings(&self.store, &[t], RINGS));
        let mut work = self.tools.free_work(cut.mesh.clone(), cut.failed.clone());
        let holds = repair_rounds(&mut work) && cut.keeps_disk(&work.mesh);
        if holds {
            cut.put_back(&mut self.store, &work.mesh, &work.failed);
        }
        holds
    }

    /// Removes vertices wherever something has changed since `mark`, for as long
    /// as that succeeds, in so many rounds at most: each reaches farther.
    pub(super) fn thin_changed(&mut self, mark: usize, rounds: usize) {
        for _ in 0..rounds {
            let before = self.store.counts();
            let written = Written::of(self.store.since(mark)).vertices;
            let slots: Vec<u32> = written.into_iter().map(|w| w.0).collect();
            thin::thin_all(&mut self.store, &self.tools, &slots);
            if self.store.counts() == before {
                break;
            }
        }
    }

    /// Removals around a vertex that have failed may succeed now that it is
    /// free.
    fn forget_failures(&mut self, slot: u32) {
        let mut seeds = Vec::new();
        self.store.around(slot, |t| seeds.push(t));
        for t in rings(&self.store, &seeds, RINGS - 1) {
            for v in self.store.triangle(t).v {
                let old = *self.store.vertex(v);
                self.store.write_vertex(v, Vertex { failed: 0, ..old });
            }
        }
    }

    /// What a vertex may do that is not fixed; none for a corner of the domain
    /// or an end of a segment.
    fn freedom(&self, slot: u32) -> Option<Freedom> {
        let sector = self.store.vertex(slot).sector;
        if let Some(line) = self.store.line_of_vertex(slot) {
            return Some(Freedom { motion: Motion::On(line), sector, source: line });
        }
        let (mut first, mut last, mut bound) = (NONE, NONE, false);
        self.store.around(slot, |t| {
            let tri = self.store.triangle(t);
            let k = tri.corner(slot);
            bound |= tri.is_bound((k + 1) % 3) || tri.is_bound((k + 2) % 3);
            if tri.n[(k + 2) % 3] == NONE {
                first = tri.v[(k + 1) % 3];
            }
            if tri.n[(k + 1) % 3] == NONE {
                last = tri.v[(k + 2) % 3];
            }
        });
        if bound {
            return None;
        }
        if first == NONE {
            return Some(Freedom { motion: Motion::Free, sector: std::f64::consts::TAU, source: NOWHERE });
        }
        let along = (self.store.at(first) - self.store.at(last)).normalize_or_zero();
        let here = (self.store.at(first) - self.store.at(slot)).normalize_or_zero();
        let straight = along.perp_dot(here).abs() < STRAIGHT;
        let motion = Motion::Along(along);
        straight.then_some(Freedom { motion, sector: std::f64::consts::PI, source: NOWHERE })
    }
}
