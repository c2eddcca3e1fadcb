//! The size that a mesh has by itself at every place, and how many edges of
//! that size a segment is long.

use crate::net::insert::Place;
use crate::net::{NONE, Net};
use hexdel_geom::DVec2;

/// The mean edge length around each vertex of a mesh, linear in its triangles.
pub(crate) struct Field {
    net: Net,
    /// By vertex; positive.
    sizes: Vec<f64>,
}

impl Field {
    pub(crate) fn of(net: &Net) -> Self {
        let mut sums = vec![(0.0, 0_u32); net.vertex_count() as usize];
        for t in net.alive() {
            for i in 0..3 {
                let [a, b] = net.tri(t).edge(i);
                let length = net.at(a).distance(net.at(b));
                for v in [a, b] {
                    let sum = &mut sums[v as usize];
                    *sum = (sum.0 + length, sum.1 + 1);
                }
            }
        }
        let sizes = sums.into_iter().map(|(sum, n)| sum / f64::from(n.max(1))).collect();
        Self { net: net.clone(), sizes }
    }

    /// The size at a vertex of the mesh.
    pub(crate) fn at_vertex(&self, v: u32) -> f64 {
        self.sizes[v as usize]
    }

    /// The size at a place, and the triangle there as a hint for the next.
    pub(crate) fn at(&self, p: DVec2, hint: u32) -> (f64, u32) {
        match self.net.locate(p, hint) {
            Place::Vertex(v) => (self.sizes[v as usize], self.net.some_triangle(v)),
            Place::Inside(t) | Place::Edge(t, _) => (self.interpolate(p, t), t),
            Place::Outside => (self.sizes[0], NONE),
        }
    }

    fn interpolate(&self, p: DVec2, t: u32) -> f64 {
        let v = self.net.tri(t).v;
        let [a, b, c] = self.net.corners(t);
        let whole = (b - a).perp_dot(c - a);
        let [wb, wc] =
            [(p - a).perp_dot(c - a), (b - a).perp_dot(p - a)].map(|w| (w / whole).clamp(0.0, 1.0));
        let wa = (1.0 - wb - wc).max(0.0);
        let [sa, sb, sc] = v.map(|v| self.sizes[v as usize]);
        (wa * sa + wb * sb + wc * sc) / (wa + wb + wc)
    }

    /// Measures a segment in units of the local size.
    pub(crate) fn profile(&self, a: DVec2, b: DVec2, hint: u32) -> Profile {
        let length = a.distance(b);
        let mut profile = Profile { arcs: vec![0.0], counts: vec![0.0], ends: [0.0; 2], hint };
        let (mut size, mut t) = self.at(a, hint);
        profile.ends[0] = size;
        let (mut arc, mut count) = (0.0, 0.0);
        while arc < length {
            // Sizes of neighbouring vertices differ by a factor of two at
            // most: a quarter of an edge is a fine enough step.
            let next = if arc + 0.3 * size >= length { length } else { arc + 0.25 * size };
            let (there, found) = self.at(a + (b - a) * (next / length), t);
            count += (next - arc) * 0.5 * (1.0 / size + 1.0 / there);
            (arc, size, t) = (next, there, found);
            profile.arcs.push(arc);
            profile.counts.push(count);
        }
        profile.ends[1] = size;
        profile.hint = t;
        profile
    }
}

/// How many edges of the local size lie between the start of a segment and
/// each place on it: piecewise linear and increasing.
pub(crate) struct Profile {
    arcs: Vec<f64>,
    counts: Vec<f64>,
    /// The size at both ends.
    pub(crate) ends: [f64; 2],
    /// A triangle of the field at the end.
    pub(crate) hint: u32,
}

impl Profile {
    /// The length of the segment, in input units.
    pub(crate) fn length(&self) -> f64 {
        self.arcs.last().copied().unwrap_or(0.0)
    }

    /// The same in edges of the local size.
    pub(crate) fn total(&self) -> f64 {
        self.counts.last().copied().unwrap_or(0.0)
    }

    /// Edges up to an arc length.
    pub(crate) fn count_at(&self, arc: f64) -> f64 {
        interpolate(&self.arcs, &self.counts, arc)
    }

    /// The arc length that takes so many edges.
    pub(crate) fn arc_at(&self, count: f64) -> f64 {
        interpolate(&self.counts, &self.arcs, count)
    }
}

fn interpolate(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let i = xs.partition_point(|&p| p < x).clamp(1, xs.len() - 1);
    let part = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
    ys[i - 1] + (ys[i] - ys[i - 1]) * part.clamp(0.0, 1.0)
}
