//! Values at points, linearly between them.

use crate::net::Kind;
use crate::net::insert::Place;
use crate::validate::Validated;
use hexdel_geom::DVec2;

impl Validated {
    /// Values of the input points, `per_point` of each in a row, at other places: linear in
    /// each triangle of the constrained Delaunay triangulation, outside of it those of the
    /// nearest place on its hull.
    ///
    /// ```
    /// use hexdel_geom::{DVec2, Pslg};
    /// use hexdel_pslg::validate;
    ///
    /// let graph = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y]);
    /// let plane = validate(&graph)?;
    /// let at = [DVec2::new(0.5, 0.25), DVec2::new(0.5, -1.0)];
    /// assert_eq!(plane.interpolate(&[0.0, 1.0, 2.0], 1, &at), [1.0, 0.5]);
    /// # Ok::<(), hexdel_pslg::ValidateError>(())
    /// ```
    ///
    /// # Panics
    ///
    /// If there are not `per_point` values of each point.
    ///
    /// # Complexity
    ///
    /// A walk through the triangles for each place, from the one before.
    pub fn interpolate(&self, values: &[f64], per_point: usize, at: &[DVec2]) -> Vec<f64> {
        assert_eq!(values.len(), per_point * self.pslg.points.len(), "values of each point");
        let mut all = Vec::with_capacity(per_point * at.len());
        let mut hint = 0;
        for &p in at {
            let weights = self.weights(p, &mut hint);
            for k in 0..per_point {
                let value = |&(site, weight): &(u32, f64)| {
                    let point = self.points.input_of_site()[site as usize] as usize;
                    weight * values[point * per_point + k]
                };
                all.push(weights.iter().map(value).sum());
            }
        }
        all
    }

    /// The sites that a place lies between, with weights that add up to one.
    fn weights(&self, p: DVec2, hint: &mut u32) -> Vec<(u32, f64)> {
        let t = match self.plane.locate(p, *hint) {
            Place::Inside(t) | Place::Edge(t, _) => t,
            Place::Vertex(v) => self.plane.some_triangle(v),
            Place::Outside => return self.nearest(p).into_iter().collect(),
        };
        *hint = t;
        let corners = self.plane.tri(t).v;
        let sites: Vec<(u32, DVec2)> = corners
            .into_iter()
            .filter_map(|v| match self.plane.vertex(v).kind {
                Kind::Site(site) => Some((site, self.plane.at(v))),
                _ => None,
            })
            .collect();
        match sites[..] {
            [(a, at_a), (b, at_b), (c, at_c)] => {
                let area = |q: DVec2, r: DVec2| (q - p).perp_dot(r - p).max(0.0);
                let areas = [area(at_b, at_c), area(at_c, at_a), area(at_a, at_b)];
                let sum: f64 = areas.iter().sum();
                if sum > 0.0 {
                    return [a, b, c].into_iter().zip(areas.map(|area| area / sum)).collect();
                }
                self.nearest(p).into_iter().collect()
            }
            [(a, at_a), (b, at_b)] => {
                let way = at_b - at_a;
                let t = ((p - at_a).dot(way) / way.length_squared()).clamp(0.0, 1.0);
                vec![(a, 1.0 - t), (b, t)]
            }
            [(a, _)] => vec![(a, 1.0)],
            _ => self.nearest(p).into_iter().collect(),
        }
    }

    fn nearest(&self, p: DVec2) -> Option<(u32, f64)> {
        let distance = |i: &usize| self.points.sites()[*i].distance_squared(p);
        let all = 0..self.points.sites().len();
        all.min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|site| (site as u32, 1.0))
    }
}
