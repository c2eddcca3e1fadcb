//! Breadth-first search over cavities around a bad triangle.

use hexdel_optimize::edit::Cavity;

use super::place::Outline;
use super::{Candidate, Refiner};

/// Cavities looked at.
const NODES: usize = 20;

/// Triangles up to which a cavity that cannot hold a vertex is grown.
pub(crate) const DEPTH: usize = 8;

impl Refiner<'_> {
    /// Inserts a vertex in a cavity grown from the triangle if one leaves no bad triangle.
    pub(super) fn insert_in_cavity(&mut self, t: u32) -> bool {
        let mut cavities = std::mem::take(&mut self.cavities);
        cavities.clear();
        cavities.push(self.mesh.cavity_of(t));
        let found = self.search(&mut cavities);
        self.cavities = cavities;
        let Some(candidate) = found else { return false };
        self.insert(&candidate);
        true
    }

    fn search(&mut self, cavities: &mut Vec<Cavity>) -> Option<Candidate> {
        let mut i = 0;
        while i < cavities.len().min(NODES) {
            let cavity = cavities[i];
            i += 1;
            match self.outline(&cavity) {
                Outline::Fits if cavity.len() >= 4 && cavity.len() <= self.limits.most_around => {
                    if let Some(x) = self.place(&cavity, self.middle(&cavity)) {
                        return Some(Candidate::new(&cavity, x));
                    }
                    if cavities.len() < NODES {
                        for edge in 0..cavity.len() {
                            self.grow(cavities, &cavity, edge);
                        }
                    }
                }
                Outline::Corner(j) if cavity.triangles().len() < DEPTH => {
                    self.grow(cavities, &cavity, j);
                    self.grow(cavities, &cavity, cavity.before(j));
                }
                _ => {}
            }
        }
        None
    }

    /// Adds the cavity with the triangle beyond an edge, if it is a new one. A segment in the way is noted.
    pub(crate) fn grow(&mut self, cavities: &mut Vec<Cavity>, cavity: &Cavity, edge: usize) {
        let inner = cavity.inner(edge);
        let own = cavity.on_segment && edge == 0;
        if self.mesh.is_marked(inner) && !self.mesh.is_locked(inner) && !own {
            self.meet(inner);
        }
        if let Some(grown) = self.mesh.grown(cavity, edge)
            && !cavities.iter().any(|c| c.hash == grown.hash)
        {
            cavities.push(grown);
        }
    }
}
