//! Attributes of vertices: those of the points given, and between them.

use super::prepare::PreparedPslg;
use super::result::PslgTriangulation;
use crate::error::Error;
use crate::triangulation::Triangulation;
use hexdel_geom::{DVec2, Pslg};
use hexdel_pslg::{RepairReport, validate};

impl Triangulation {
    /// The attributes of each vertex in a row, as many as the points `given` have: their own,
    /// linearly between them in their Delaunay triangulation, outside of it those of the nearest
    /// place on its hull. None if the points have none.
    ///
    /// ```
    /// # use hexdel::{DVec2, Pslg};
    /// let mut points = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y]);
    /// (points.attributes_per_point, points.point_attributes) = (1, vec![0.0, 1.0, 2.0]);
    /// let made = hexdel::triangulate(&points.points)?;
    /// let values = made.vertex_attributes(&points)?;
    /// assert_eq!(values[made.vertex_of_input[2].index()], 2.0);
    /// assert!(values.iter().all(|value| (0.0..=2.0).contains(value)));
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Segments`] and the like if the points are so large or so close together that a PSLG
    /// of them would not be meshed.
    ///
    /// # Panics
    ///
    /// If the mesh is not one of the points given.
    ///
    /// # Complexity
    ///
    /// That of [`validate`], and near-linear in the mesh; outside of the hull a look at all of its
    /// edges for each vertex.
    pub fn vertex_attributes(&self, given: &Pslg) -> Result<Vec<f64>, Error> {
        let n = given.attributes_per_point;
        if n == 0 {
            return Ok(Vec::new());
        }
        assert_eq!(given.points.len(), self.vertex_of_input.len(), "the points of the mesh");
        let plane = validate(&Pslg::from_points(given.points.clone()))?;
        let mut all = plane.interpolate(&given.point_attributes, n, &self.mesh.vertices);
        // Of points at the same place the first counts.
        for (i, vertex) in self.vertex_of_input.iter().enumerate().rev() {
            let v = vertex.index();
            all[v * n..(v + 1) * n].copy_from_slice(given.attributes(i));
        }
        Ok(all)
    }
}

impl PslgTriangulation {
    /// The attributes of each vertex in a row, as many as the points `given` have: their own,
    /// linearly between them in the constrained Delaunay triangulation of the PSLG. Along
    /// segments they are linear between its points. None if the points have none.
    ///
    /// ```
    /// # use hexdel::{DVec2, Pslg};
    /// let mut square = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    /// square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
    /// (square.attributes_per_point, square.point_attributes) = (1, vec![0.0, 1.0, 3.0, 2.0]);
    /// let made = hexdel::Mesher::new().max_area(0.01).triangulate_pslg(&square)?;
    /// // A linear function stays one.
    /// for (v, value) in made.mesh.vertices.iter().zip(made.vertex_attributes(&square)) {
    ///     assert!((value - (v.x + 2.0 * v.y)).abs() < 1e-12);
    /// }
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// If the mesh is not one of the PSLG given.
    ///
    /// # Complexity
    ///
    /// That of [`validate`], and near-linear in the mesh.
    pub fn vertex_attributes(&self, given: &Pslg) -> Vec<f64> {
        let n = given.attributes_per_point;
        if n == 0 {
            return Vec::new();
        }
        let of_points = of_points(&self.graph, self.repairs.as_ref(), given);
        let bare = Pslg {
            points: self.graph.points.clone(),
            segments: self.graph.segments.clone(),
            ..Pslg::default()
        };
        let plane = validate(&bare).expect("a graph that was meshed is valid");
        let between = plane.interpolate(&of_points, n, &self.mesh.vertices);
        let mut all = Vec::with_capacity(n * self.mesh.vertices.len());
        for (v, point) in self.point_of_vertex.iter().enumerate() {
            match *point {
                Some(p) => all.extend_from_slice(&of_points[p as usize * n..(p as usize + 1) * n]),
                None => all.extend_from_slice(&between[v * n..(v + 1) * n]),
            }
        }
        all
    }
}

impl PreparedPslg {
    /// The attributes of each point of the PSLG that is meshed in a row, as many as the points
    /// `given` have: their own, and where repair has put a point the mean along the segments
    /// there. None if the points have none.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Pslg};
    /// // The diagonals of a square cross.
    /// let mut given = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    /// given.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]];
    /// (given.attributes_per_point, given.point_attributes) = (1, vec![0.0, 2.0, 4.0, 2.0]);
    /// let prepared = Mesher::new().repair().prepared_pslg(&given)?;
    /// assert_eq!(prepared.point_attributes(&given), [0.0, 2.0, 4.0, 2.0, 2.0]);
    /// # Ok::<(), hexdel::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// If it is not made of the PSLG given.
    pub fn point_attributes(&self, given: &Pslg) -> Vec<f64> {
        of_points(&self.graph, self.repairs.as_ref(), given)
    }
}

/// The attributes of each point of a PSLG that repair has made of the one given.
fn of_points(graph: &Pslg, repairs: Option<&RepairReport>, given: &Pslg) -> Vec<f64> {
    let n = given.attributes_per_point;
    let Some(report) = repairs else {
        return given.point_attributes.clone();
    };
    let count = graph.points.len();
    let (mut all, mut known) = (vec![0.0; n * count], vec![false; count]);
    for (i, &p) in report.point_of_input.iter().enumerate() {
        let p = p as usize;
        if p < count && !std::mem::replace(&mut known[p], true) {
            all[p * n..(p + 1) * n].copy_from_slice(given.attributes(i));
        }
    }
    fill_crossings(graph, given, report, &known, &mut all);
    all
}

/// Where segments cross: the mean of what is there along each.
fn fill_crossings(graph: &Pslg, given: &Pslg, report: &RepairReport, known: &[bool], all: &mut [f64]) {
    let n = given.attributes_per_point;
    let mut through: Vec<(u32, u32)> = Vec::new();
    for (ends, sources) in graph.segments.iter().zip(&report.sources) {
        let new = ends.iter().filter(|&&p| !known[p as usize]);
        through.extend(new.flat_map(|&p| sources.iter().map(move |&s| (p, s))));
    }
    through.sort_unstable();
    through.dedup();
    for crossing in through.chunk_by(|a, b| a.0 == b.0) {
        let p = crossing[0].0 as usize;
        for &(_, segment) in crossing {
            let [a, b] = given.segments[segment as usize].map(|p| p as usize);
            let t = along(given.points[a], given.points[b], graph.points[p]);
            for k in 0..n {
                let value = (1.0 - t) * given.attributes(a)[k] + t * given.attributes(b)[k];
                all[p * n + k] += value / crossing.len() as f64;
            }
        }
    }
}

/// How far along the way from a to b a point is, in parts of one.
fn along(a: DVec2, b: DVec2, p: DVec2) -> f64 {
    let way = b - a;
    let length_sq = way.length_squared();
    if length_sq > 0.0 { ((p - a).dot(way) / length_sq).clamp(0.0, 1.0) } else { 0.0 }
}
