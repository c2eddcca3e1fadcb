//! How short edges of the Voronoi dual may be: the option, the angles that it takes, and
//! what is found on the finished mesh.

use crate::error::Error;
use crate::mesher::Mesher;
use hexdel_geom::certificate::{DualCheck, check_dual_edges, max_angle_of_ratio};
use hexdel_geom::{AngleBounds, TriMesh, TriangleId};

/// The largest ratio that a graded mesh can keep: the cotangent of 72 degrees
/// ([`AngleBounds::LEAST_GRADED_MAX_DEG`]), rounded down.
pub const MOST_DUAL_EDGE: f64 = 0.324_919;

impl Mesher {
    /// How short the edges of the Voronoi dual may be over the edges that they cross, from
    /// above 0 to [`MOST_DUAL_EDGE`]; by default 0 is the least.
    ///
    /// Dual edges, the faces of finite volumes, shrink to nothing where right angles face each other. With
    /// angles `a` and `b` opposite an edge the ratio is `(cot a + cot b) / 2`, so no angle
    /// may be larger than `acot(ratio)`; that or the largest angle of the bounds is asked for, whichever is
    /// smaller. The ratio of each edge is then checked from scratch on the mesh. On the boundary, where half of the
    /// dual edge is cut off, it is held against half the bound
    /// ([`DualEdge::ratio`](hexdel_geom::certificate::DualEdge::ratio)).
    ///
    /// Bounds below 90 degrees are tried, and may not be reached ([`Error::Unreached`]; of PSLGs the triangles and
    /// the number of edges are reported).
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher};
    /// let points = [DVec2::ZERO, DVec2::X, DVec2::new(0.2, 0.7)];
    /// let made = Mesher::new().min_dual_edge(0.1).triangulate(&points)?;
    /// let found = made.dual_edges.as_ref().and_then(|found| found.worst);
    /// assert!(found.is_some_and(|edge| edge.ratio >= 0.1 - 1e-9));
    /// assert!(made.certificate.max_angle_deg <= 84.2895);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    #[must_use]
    pub fn min_dual_edge(mut self, ratio: f64) -> Self {
        self.min_dual_edge = Some(ratio);
        self
    }

    /// Refuses ratios that no graded mesh keeps.
    pub(crate) fn refuse_dual_edges(&self) -> Result<(), Error> {
        match self.min_dual_edge {
            Some(ratio) if !(ratio > 0.0 && ratio <= MOST_DUAL_EDGE) => Err(Error::NoDualEdge { ratio }),
            _ => Ok(()),
        }
    }

    /// Bounds with the largest angle that dual edges leave.
    pub(crate) fn lowered(&self, bounds: AngleBounds) -> AngleBounds {
        let most = self.min_dual_edge.map_or(180.0, max_angle_of_ratio);
        AngleBounds::new(bounds.min_deg(), bounds.max_deg().min(most)).unwrap_or(bounds)
    }

    /// What is found of dual edges, if anything was asked for.
    pub(crate) fn dual_edges(&self, mesh: &TriMesh, excused: &[TriangleId]) -> Option<DualCheck> {
        self.min_dual_edge.map(|ratio| check_dual_edges(mesh, ratio, excused))
    }
}
