//! The invariants of the editable mesh.

use hexdel_geom::orient2d;
use thiserror::Error;

use super::{EditMesh, Kind, NONE, next, prev};

/// An invariant that does not hold: a defect of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Broken {
    /// A corner's twin is dead, or has another twin.
    #[error("corner {0} is not its twin's twin")]
    Twin(u32),
    /// Two twins have different edges or different marks.
    #[error("corner {0} and its twin differ in the edge opposite")]
    Edge(u32),
    /// A vertex is dead and in use, or its corner is none of its own.
    #[error("vertex {0} has a corner that is not its own, or is dead")]
    Vertex(u32),
    /// A triangle is clockwise or has no area, exactly.
    #[error("triangle {0} is not counter-clockwise")]
    Turned(u32),
}

impl EditMesh {
    /// The first broken invariant: twins are mutual and agree in edge and mark, corners belong to vertices that are
    /// alive, triangles are counter-clockwise.
    ///
    /// # Errors
    ///
    /// [`Broken`], with the item.
    ///
    /// # Complexity
    ///
    /// Linear.
    pub fn check(&self) -> Result<(), Broken> {
        for c in (0..self.vertex.len() as u32).filter(|c| self.alive(c / 3)) {
            let twin = self.twin[c as usize];
            if self.kind[self.v(c) as usize] == Kind::Dead {
                return Err(Broken::Vertex(self.v(c)));
            }
            if twin == NONE {
                continue;
            }
            if !self.alive(twin / 3) || self.twin[twin as usize] != c {
                return Err(Broken::Twin(c));
            }
            let differ = self.v(next(c)) != self.v(prev(twin)) || self.v(prev(c)) != self.v(next(twin));
            if differ || self.mark[c as usize] != self.mark[twin as usize] {
                return Err(Broken::Edge(c));
            }
        }
        for v in (0..self.pos.len() as u32).filter(|&v| self.kind[v as usize] != Kind::Dead) {
            let c = self.corner_of[v as usize];
            if c != NONE && (!self.alive(c / 3) || self.v(c) != v) {
                return Err(Broken::Vertex(v));
            }
        }
        let turned = |&t: &u32| {
            let [a, b, c] = self.corners(t);
            orient2d(a, b, c) <= 0.0
        };
        self.triangles().find(turned).map_or(Ok(()), |t| Err(Broken::Turned(t)))
    }
}
