//! Values of points, heights say, at all vertices of a session's mesh.

use super::{PointId, Session, SessionError, SessionMesh};
use hexdel_geom::Pslg;
use hexdel_mesher::Error;
use hexdel_pslg::validate;
use std::collections::BTreeMap;

impl Session {
    /// A value at each vertex of a mesh of this session: that of its point, linearly between
    /// points that have one in their Delaunay triangulation, along segments between their ends,
    /// and outside of it that of the nearest place on its hull. None if no point has a value.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, PointId, Session};
    /// let mut session = Session::new(&[DVec2::ZERO, DVec2::X, DVec2::Y], &Mesher::new())?;
    /// session.insert(DVec2::new(0.5, 0.25))?;
    /// let made = session.mesh();
    /// let heights = [Some(0.0), Some(1.0), Some(2.0), None];
    /// let values = session.vertex_values(&made, |id| heights[id.0 as usize])?.ok_or("no heights")?;
    /// let (_, vertex) = made.points[3];
    /// assert_eq!(values[vertex.index()], 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SessionError::Mesh`] if the points with values are so close together that a PSLG of them
    /// would not be meshed.
    ///
    /// # Complexity
    ///
    /// As of [`Triangulation::vertex_attributes`](hexdel_mesher::Triangulation::vertex_attributes).
    pub fn vertex_values(
        &self,
        made: &SessionMesh,
        of_point: impl Fn(PointId) -> Option<f64>,
    ) -> Result<Option<Vec<f64>>, SessionError> {
        let mut known: BTreeMap<PointId, u32> = BTreeMap::new();
        let (mut bare, mut values) = (Pslg::default(), Vec::new());
        for &(id, vertex) in &made.points {
            if let Some(value) = of_point(id) {
                known.insert(id, bare.points.len() as u32);
                bare.points.push(made.mesh.vertices[vertex.index()]);
                values.push(value);
            }
        }
        if values.is_empty() {
            return Ok(None);
        }
        let name = |p: u32| known.get(&PointId(u64::from(p))).copied();
        let segments = self.frame.iter().flat_map(|frame| &frame.graph.segments);
        bare.segments = segments.filter_map(|&[a, b]| Some([name(a)?, name(b)?])).collect();
        let plane = validate(&bare).map_err(Error::from)?;
        let mut all = plane.interpolate(&values, 1, &made.mesh.vertices);
        for (id, vertex) in &made.points {
            if let Some(&i) = known.get(id) {
                all[vertex.index()] = values[i as usize];
            }
        }
        Ok(Some(all))
    }
}
