//! Edges made as short as wanted, and vertices removed where they may be
//! longer than before.

use std::sync::Arc;

use hexdel_geom::DVec2;

use crate::live::store::Vertex;
use crate::live::verify::{Written, settle_changes};
use crate::live::{INNER_RINGS, LiveError, LiveMesh, refine, thin};
use crate::mesh::Motion;
use crate::sizing::{Sizing, edge_fits, triangle_fits};

/// Rounds of refinement. Each halves edges; rounds that only mend what repair
/// has lengthened come on top.
const ROUNDS: usize = 96;

/// Triangles that sizing may lead to: some gigabytes, what takes them back
/// included.
const MOST_TRIANGLES: f64 = 2e7;

impl LiveMesh {
    /// How long edges may be.
    pub fn sizing(&self) -> Option<&Arc<dyn Sizing>> {
        self.tools.sizing.as_ref()
    }

    /// Sets the sizing without a look at the mesh, which must keep to it.
    pub fn assume_sizing(&mut self, sizing: Option<Arc<dyn Sizing>>) {
        self.tools.sizing = sizing;
    }

    /// Makes every edge as short as wanted, and removes vertices where edges
    /// may be longer than before.
    ///
    /// # Errors
    ///
    /// [`LiveError::Unsized`] where that is not reached within the bounds,
    /// [`LiveError::TooMany`] as soon as that shows; the mesh and its sizing
    /// are then as they were.
    ///
    /// # Complexity
    ///
    /// A look at every edge, and work in proportion to what changes.
    pub fn set_sizing(&mut self, sizing: Option<Arc<dyn Sizing>>) -> Result<(), LiveError> {
        let (mark, serials) = (self.store.mark(), self.store.serials);
        let old = std::mem::replace(&mut self.tools.sizing, sizing);
        let done = self.shorten(mark, true).and_then(|()| {
            self.relax(old.as_deref());
            let holds = settle_changes(&mut self.store, mark, self.bounds);
            if holds { Ok(()) } else { Err(self.unsized_somewhere()) }
        });
        if done.is_err() {
            self.reset(mark, serials);
            self.tools.sizing = old;
        }
        done
    }

    /// Refuses sizes that would take too many triangles, as far as can be told
    /// from those that are too `long`: one with an edge `n` times too long
    /// becomes `n^2`. What is fine in a place that no triangle has seen yet
    /// shows in a later round.
    fn check_count(&self, long: &[u32]) -> Result<(), LiveError> {
        let Some(sizing) = self.tools.sizing.as_deref() else {
            return Ok(());
        };
        let mut triangles = self.counts()[1] as f64;
        for &t in long {
            let [a, b, c] = self.store.corners(t);
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            let places = [a, b, c, (a + b + c) / 3.0];
            // What is not positive, or no number, wants infinitely many.
            let wanted = places
                .map(|p| sizing.at(p))
                .into_iter()
                .fold(f64::INFINITY, |l, h| if h > 0.0 { l.min(h) } else { 0.0 });
            triangles += (longest / wanted).powi(2).max(1.0) - 1.0;
        }
        if triangles > MOST_TRIANGLES { Err(LiveError::TooMany { triangles }) } else { Ok(()) }
    }

    /// Triangles with an edge that is too long, of all or of those changed since
    /// `mark`; ascending.
    fn too_long(&self, mark: usize, everywhere: bool) -> Vec<u32> {
        let Some(sizing) = self.tools.sizing.as_deref() else {
            return Vec::new();
        };
        let long = |t: &u32| !triangle_fits(sizing, self.store.corners(*t));
        if everywhere {
            return self.store.live_triangles().filter(long).collect();
        }
        Written::of(self.store.since(mark)).changed(&self.store).into_iter().filter(long).collect()
    }

    /// Refines until no edge is too long, then removes what that does not need.
    pub(super) fn shorten(&mut self, mark: usize, everywhere: bool) -> Result<(), LiveError> {
        for round in 0..ROUNDS {
            let long = self.too_long(mark, everywhere);
            let Some(&first) = long.first() else {
                if round > 0 {
                    self.thin_changed(mark, 1);
                }
                return Ok(());
            };
            self.check_count(&long)?;
            if self.refine_all(&long) {
                continue;
            }
            // One at a time, where they do not go together.
            let mut done = false;
            for t in long {
                let tri = *self.store.triangle(t);
                let fits = |s: &dyn Sizing| triangle_fits(s, self.store.corners(t));
                if tri.alive() && !self.tools.sizing.as_deref().is_some_and(fits) {
                    done |= INNER_RINGS.into_iter().any(|inner| self.refine_around(t, inner));
                }
            }
            if !done {
                return Err(self.unsized_at(first));
            }
        }
        Err(self.unsized_somewhere())
    }

    /// Cuts all these triangles in four at once.
    fn refine_all(&mut self, inside: &[u32]) -> bool {
        self.work_inside(inside.to_vec(), refine::refine)
    }

    /// Removes vertices where the sizing allows longer edges than `old` did.
    fn relax(&mut self, old: Option<&dyn Sizing>) {
        let Some(old) = old else { return };
        let new = self.tools.sizing.clone();
        let at = |p: DVec2| new.as_deref().map_or(f64::INFINITY, |s| s.at(p));
        let is_wider = |v: &u32| {
            let vertex = self.store.vertex(*v);
            vertex.motion != Motion::Fixed && old.at(vertex.at) < at(vertex.at)
        };
        let wider: Vec<u32> = self.store.live_vertices().filter(is_wider).collect();
        for &v in &wider {
            let vertex = *self.store.vertex(v);
            self.store.write_vertex(v, Vertex { failed: 0, ..vertex });
        }
        thin::thin_all(&mut self.store, &self.tools, &wider);
    }

    fn unsized_somewhere(&self) -> LiveError {
        let long = self.too_long(0, true);
        let any = long.first().copied().or_else(|| self.store.live_triangles().next());
        self.unsized_at(any.expect("a mesh has triangles"))
    }

    /// The error for triangle `t`.
    fn unsized_at(&self, t: u32) -> LiveError {
        let c = self.store.corners(t);
        let long = |k: &usize| {
            let (a, b) = (c[*k], c[(k + 1) % 3]);
            self.tools.sizing.as_deref().is_some_and(|s| !edge_fits(s, a, b))
        };
        let k = (0..3).find(long).unwrap_or(0);
        LiveError::Unsized { at: 0.5 * (c[k] + c[(k + 1) % 3]), length: c[k].distance(c[(k + 1) % 3]) }
    }
}
