//! What a session's mesh is found to keep.

use super::Session;
use hexdel_geom::{Certificate, CertifyOptions, TriMesh, certify};
use hexdel_mesher::for_sessions::{has_shorter_edge, shortest_edge};
use hexdel_optimize::live::LiveMesh;

impl Session {
    /// The certificate of the whole mesh, made from scratch.
    ///
    /// The shortest edge is held against the paper's `l_min` of the closest two of points and
    /// corners of the domain, of the distance of points to its sides, or of the least size,
    /// whichever is least. Points and sizes that have gone may leave shorter edges behind: then
    /// nothing is promised of them (`min_edge_bound` is none) until the mesh is made anew
    /// ([`renew`](Self::renew)). Up to 1,024 points [`remove`](Self::remove) makes it anew itself
    /// where it would leave such edges, if the domain has room for a mesh without.
    ///
    /// The mesh of a PSLG is held against the bounds near segments, with exempt triangles out
    /// of bounds: [`check`](Self::check) knows them.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn certificate(&self) -> Certificate {
        let (_, points) = self.present();
        if self.frame.is_some() {
            return self.certificate_of_graph(&points);
        }
        let mesh = self.live.snapshot().mesh;
        let min_edge = self.shortest_edge_allowed(&mesh).filter(|&edge| !has_shorter_edge(&mesh, edge));
        let options =
            CertifyOptions { bounds: self.bounds, inputs: Some(&points), min_edge, ..Default::default() };
        certify(&mesh, &options)
    }

    /// Whether a mesh of the points has an edge shorter than they allow, as the session's own after
    /// points have gone that were close to others.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub(super) fn is_short(&self, live: &LiveMesh) -> bool {
        let mesh = live.snapshot().mesh;
        self.shortest_edge_allowed(&mesh).is_some_and(|edge| has_shorter_edge(&mesh, edge))
    }

    fn shortest_edge_allowed(&self, mesh: &TriMesh) -> Option<f64> {
        let (domain, points) = ((self.centre, self.radius), self.present().1);
        shortest_edge(&points, domain, mesh, self.size.as_ref())
    }
}
