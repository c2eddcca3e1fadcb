//! What there is of a session: points, counts, the mesh and its certificate.

use super::TemplateSession;
use crate::{PointId, SessionMesh};
use hexdel_geom::{Certificate, DVec2, VertexId};
use hexdel_grid::Address;

impl TemplateSession {
    /// The points that are there.
    pub fn points(&self) -> impl Iterator<Item = (PointId, DVec2)> + '_ {
        self.points.iter().map(|(id, order)| (id, self.grown.refiner.occupant(order as usize).point))
    }

    /// The same as two lists.
    pub(super) fn all_points(&self) -> (Vec<PointId>, Vec<DVec2>) {
        self.points().unzip()
    }

    /// Numbers of points, vertices and triangles.
    pub fn counts(&self) -> [usize; 3] {
        let [vertices, triangles] = self.grown.cells.counts;
        [self.points.len(), vertices, triangles]
    }

    /// Centre and circumradius of the domain.
    pub fn domain(&self) -> (DVec2, f64) {
        let lattice = self.grown.lattice();
        (lattice.origin(), f64::from(self.grown.steps()) * lattice.spacing(0))
    }

    /// The mesh as it stands.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh, but for sorting.
    pub fn mesh(&self) -> SessionMesh {
        let mut made = SessionMesh::default();
        self.fill(&mut made);
        made
    }

    fn fill(&self, made: &mut SessionMesh) {
        let (mesh, names, triangle_serials) = self.grown.cells.whole(&self.grown.pages());
        let serial = |&name: &u32| self.grown.cells.vertex(name).map_or(0, |v| v.1);
        made.vertex_serials = names.iter().map(serial).collect();
        let mut indices: Vec<(u32, usize)> = names.into_iter().zip(0..).collect();
        indices.sort_unstable();
        for (id, name) in self.names_of_points() {
            if let Ok(i) = indices.binary_search_by_key(&name, |n| n.0) {
                made.points.push((id, VertexId::new(indices[i].1)));
            }
        }
        (made.mesh, made.triangle_serials) = (mesh, triangle_serials);
    }

    /// The vertices of points.
    fn names_of_points(&self) -> impl Iterator<Item = (PointId, u32)> + '_ {
        self.points.iter().filter_map(|(id, order)| {
            let occupant = self.grown.refiner.occupant(order as usize);
            let at = Address::new(occupant.level, occupant.at.hex);
            Some((id, self.grown.dual.name_of(self.grown.refiner.grid(), at)?))
        })
    }

    /// The certificate of the whole mesh, made from scratch. What is said of the shortest edge
    /// by [`Session::certificate`](crate::Session::certificate) holds here, but that it is a size
    /// that goes, not a point, that makes the mesh anew, of any number of points.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn certificate(&self) -> Certificate {
        self.grown.certificate(&self.all_points().1)
    }
}
