//! The invariants of the mesh, checked in debug builds after every step.

use super::{Mesh, Motion, NONE};

impl Mesh {
    /// The first broken invariant, if any.
    ///
    /// 1. A live triangle has three distinct live corners.
    /// 2. Neighbours are live, mutual, and share the side, in opposite
    ///    directions.
    /// 3. A vertex's anchor is a live triangle at the vertex.
    /// 4. Neighbours agree on whether the side between them must stay.
    /// 5. The triangles at a vertex that is not frozen form one fan.
    /// 6. A vertex that is not frozen has as many triangles as its degree says.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub(crate) fn validate(&self) -> Result<(), String> {
        let mut at = vec![0usize; self.pos.len()];
        for t in self.live() {
            let tri = self.tri[t as usize];
            for k in 0..3 {
                let v = tri.v[k];
                at[v as usize] += 1;
                if v == tri.v[(k + 1) % 3] || !self.alive(v) {
                    return Err(format!("triangle {t} has corners {:?}", tri.v));
                }
                let n = tri.n[k];
                if n != NONE && !self.mutual(t, k) {
                    return Err(format!("triangles {t} and {n} are no neighbours"));
                }
            }
        }
        for v in 0..self.pos.len() as u32 {
            if !self.alive(v) {
                continue;
            }
            let anchor = self.tri[self.anchor[v as usize] as usize];
            if !anchor.v.contains(&v) {
                return Err(format!("vertex {v} is not in its anchor"));
            }
            let mut fan = 0;
            self.around(v, |_, _| fan += 1);
            if self.motion[v as usize] != Motion::Frozen && fan != at[v as usize] {
                return Err(format!("vertex {v} has {} triangles, {fan} in one fan", at[v as usize]));
            }
            if self.motion[v as usize] != Motion::Frozen && fan != self.degree(v) {
                return Err(format!("vertex {v} has {fan} triangles, not {}", self.degree(v)));
            }
        }
        Ok(())
    }

    fn mutual(&self, t: u32, k: usize) -> bool {
        let tri = self.tri[t as usize];
        let other = self.tri[tri.n[k] as usize];
        let (from, to) = (tri.v[(k + 1) % 3], tri.v[(k + 2) % 3]);
        (0..3).any(|j| {
            other.v[(j + 1) % 3] == to
                && other.v[(j + 2) % 3] == from
                && other.n[j] == t
                && other.is_bound(j) == tri.is_bound(k)
        })
    }
}
