//! From a mesh, and back.

use hexdel_geom::{DVec2, TriMesh, VertexId};

use super::curve::Frame;
use super::{EditMesh, Kind, NONE, next, prev};

/// A finished mesh.
#[derive(Clone, Debug, Default)]
pub struct Exported {
    /// Vertices first that were there before, in their order, then new ones.
    pub mesh: TriMesh,
    /// For each vertex of the mesh its number in the editable one.
    pub vertices: Vec<u32>,
}

impl EditMesh {
    /// Makes the mesh editable. Vertices and triangles are numbered along a curve; `order[v]` is the vertex of `mesh` that
    /// vertex `v` is. `kinds` are by vertex of `mesh`.
    ///
    /// `None` if three triangles have an edge in common or two have it in the same direction.
    ///
    /// # Complexity
    ///
    /// `n log n` in the number of triangles.
    pub fn from_mesh(mesh: &TriMesh, kinds: &[Kind]) -> Option<(Self, Vec<u32>)> {
        let frame = Frame::of(&mesh.vertices);
        let order = frame.order(&mesh.vertices);
        let mut number = vec![NONE; order.len()];
        for (new, &old) in order.iter().enumerate() {
            number[old as usize] = new as u32;
        }
        let middles: Vec<DVec2> = mesh.triangles.iter().map(|t| middle(mesh, t)).collect();
        let triangles = frame.order(&middles);
        let mut made = Self {
            pos: order.iter().map(|&v| mesh.vertices[v as usize]).collect(),
            kind: order.iter().map(|&v| kinds[v as usize]).collect(),
            ..Self::default()
        };
        made.set_triangles(triangles.iter().map(|&t| mesh.triangles[t as usize].map(|v| number[v.index()])))?;
        Some((made, order))
    }

    /// Gives a mesh of vertices alone its triangles. `None` as of [`from_mesh`](Self::from_mesh).
    pub fn set_triangles(&mut self, triangles: impl Iterator<Item = [u32; 3]>) -> Option<()> {
        self.vertex = triangles.flatten().collect();
        let corners = self.vertex.len();
        self.stamp = vec![0; corners / 3];
        self.mark = vec![0; corners];
        self.twin = vec![NONE; corners];
        self.corner_of = vec![NONE; self.pos.len()];
        for (c, &v) in self.vertex.iter().enumerate() {
            self.corner_of[v as usize] = c as u32;
        }
        self.find_twins()
    }

    /// Pairs corners by the edges opposite them: lists of corners by the edge's lower end.
    fn find_twins(&mut self) -> Option<()> {
        let lower = |m: &Self, c: u32| m.v(next(c)).min(m.v(prev(c)));
        let mut first = vec![NONE; self.pos.len()];
        let mut chain = vec![NONE; self.vertex.len()];
        for c in 0..self.vertex.len() as u32 {
            let low = lower(self, c) as usize;
            let [a, b] = self.edge(c);
            let (mut found, mut link) = (first[low], NONE);
            while found != NONE && self.edge(found) != [b, a] {
                if self.edge(found) == [a, b] {
                    return None;
                }
                (link, found) = (found, chain[found as usize]);
            }
            if found == NONE {
                chain[c as usize] = first[low];
                first[low] = c;
                continue;
            }
            self.pair(c, found);
            let after = chain[found as usize];
            if link == NONE { first[low] = after } else { chain[link as usize] = after }
        }
        Some(())
    }

    /// The mesh as it is, with vertices in the order of `keep` as far as they are alive, and then all others.
    pub fn export(&self, keep: impl Iterator<Item = u32>) -> Exported {
        let mut number = vec![NONE; self.pos.len()];
        let mut vertices = Vec::with_capacity(self.vertex_count());
        let alive = (0..self.pos.len() as u32).filter(|&v| self.kind[v as usize] != Kind::Dead);
        for v in keep.filter(|&v| self.kind[v as usize] != Kind::Dead).chain(alive) {
            if number[v as usize] == NONE {
                number[v as usize] = vertices.len() as u32;
                vertices.push(v);
            }
        }
        let id = |v: u32| VertexId::new(number[v as usize] as usize);
        let triangles = self.triangles().map(|t| self.vertices(t).map(id)).collect();
        let mesh = TriMesh { vertices: vertices.iter().map(|&v| self.at(v)).collect(), triangles };
        Exported { mesh, vertices }
    }
}

fn middle(mesh: &TriMesh, t: &[VertexId; 3]) -> DVec2 {
    t.iter().map(|v| mesh.vertices[v.index()]).sum::<DVec2>() / 3.0
}
