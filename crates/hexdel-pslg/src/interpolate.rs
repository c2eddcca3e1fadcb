//! Values at points, linearly between them.

use crate::hull::plane_with_hull;
use crate::net::insert::Place;
use crate::net::{Kind, Net};
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
    /// A walk through the triangles for each place, from the one before; outside of the hull
    /// a look at all of its edges.
    pub fn interpolate(&self, values: &[f64], per_point: usize, at: &[DVec2]) -> Vec<f64> {
        assert_eq!(values.len(), per_point * self.pslg.points.len(), "values of each point");
        let hulled = plane_with_hull(self);
        let surface = match &hulled {
            Some((plane, hull)) => Surface { of: self, plane, hull },
            // Points in a row, or one alone.
            None => Surface { of: self, plane: &self.plane, hull: &[] },
        };
        let mut all = Vec::with_capacity(per_point * at.len());
        let mut hint = 0;
        for &p in at {
            let weights = surface.weights(p, &mut hint);
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
}

/// What places are looked up in.
struct Surface<'a> {
    of: &'a Validated,
    /// The triangulation, with the hull in it.
    plane: &'a Net,
    /// The edges of the hull, from site to site.
    hull: &'a [[u32; 2]],
}

impl Surface<'_> {
    /// The sites that a place lies between, with weights that add up to one.
    fn weights(&self, p: DVec2, hint: &mut u32) -> Vec<(u32, f64)> {
        let t = match self.plane.locate(p, *hint) {
            Place::Inside(t) | Place::Edge(t, _) => t,
            Place::Vertex(v) => self.plane.some_triangle(v),
            Place::Outside => return self.on_hull(p),
        };
        *hint = t;
        let site = |v: u32| match self.plane.vertex(v).kind {
            Kind::Site(site) => Some((site, self.plane.at(v))),
            _ => None,
        };
        let [Some((a, at_a)), Some((b, at_b)), Some((c, at_c))] = self.plane.tri(t).v.map(site) else {
            return self.on_hull(p);
        };
        let area = |q: DVec2, r: DVec2| (q - p).perp_dot(r - p).max(0.0);
        let areas = [area(at_b, at_c), area(at_c, at_a), area(at_a, at_b)];
        let sum: f64 = areas.iter().sum();
        if sum > 0.0 {
            [a, b, c].into_iter().zip(areas.map(|area| area / sum)).collect()
        } else {
            self.on_hull(p)
        }
    }

    /// The sites that the nearest place on the hull lies between, or the nearest site.
    fn on_hull(&self, p: DVec2) -> Vec<(u32, f64)> {
        let sites = self.of.points.sites();
        let foot = |&[a, b]: &[u32; 2]| {
            let [from, to] = [a, b].map(|site| sites[site as usize]);
            let way = to - from;
            let t = ((p - from).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            ((from + t * way).distance_squared(p), [a, b], t)
        };
        if let Some((_, [a, b], t)) = self.hull.iter().map(foot).min_by(|x, y| x.0.total_cmp(&y.0)) {
            return vec![(a, 1.0 - t), (b, t)];
        }
        let distance = |i: &usize| sites[*i].distance_squared(p);
        let nearest = (0..sites.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.map(|site| (site as u32, 1.0)).into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validate::validate;
    use hexdel_geom::Pslg;

    /// A linear function stays one in the whole hull, along sides that are almost flat too.
    #[test]
    fn linear_functions_are_reproduced_up_to_the_hull() {
        let points = [(0.0, 0.0), (8.0, 0.0), (4.0, 0.01), (5.0, 3.0), (3.0, 0.02), (4.0, -0.005)];
        let mut graph = Pslg::from_points(points.map(|(x, y)| DVec2::new(x, y)).to_vec());
        graph.segments = vec![[3, 4]];
        let plane = validate(&graph).unwrap();
        let function = |p: &DVec2| 1.0 + 2.0 * p.x - 3.0 * p.y;
        let values: Vec<f64> = graph.points.iter().map(function).collect();
        let at: Vec<DVec2> = (1..40).map(|i| DVec2::new(0.2 * f64::from(i), 1e-3)).collect();
        for (found, p) in plane.interpolate(&values, 1, &at).iter().zip(&at) {
            assert!((found - function(p)).abs() < 1e-12, "{p}: {found}");
        }
        // Outside, as at the nearest place.
        assert_eq!(plane.interpolate(&values, 1, &[DVec2::new(9.0, -1.0)]), [17.0]);
    }
}
