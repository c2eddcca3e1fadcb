//! What lies outside and in holes goes; regions are told apart.

use crate::locator::Locator;
use crate::net::{Kind, NONE, Net};
use crate::options::Extent;
use crate::validate::Validated;
use hexdel_geom::DVec2;

/// Takes away what can be reached from the rim without crossing a piece, if
/// `outside`, and from each hole.
pub(crate) fn carve(net: &mut Net, holes: &[DVec2], outside: bool) {
    let doomed = reached(net, holes, outside);
    if doomed.iter().any(|&d| d) {
        net.carve(&doomed);
        split_fans(net);
    }
}

/// What of a PSLG lies in holes or outside.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Carved {
    /// For each point whether nothing around it is left.
    pub points: Vec<bool>,
    /// For each of [`Validated::pieces`] whether nothing on either side is left.
    pub pieces: Vec<bool>,
}

impl Validated {
    /// What is taken away with the holes, and with the outside if `outside`.
    ///
    /// ```
    /// use hexdel_geom::{DVec2, Pslg};
    ///
    /// let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (2.0, 2.0)].map(|(x, y)| DVec2::new(x, y));
    /// let mut graph = Pslg::from_points(points.to_vec());
    /// graph.segments = vec![[0, 1], [1, 2], [2, 0], [1, 3]];
    /// let carved = hexdel_pslg::validate(&graph)?.carved(true);
    /// assert_eq!(carved.points, [false, false, false, true]);
    /// assert_eq!(carved.pieces, [false, false, false, true]);
    /// # Ok::<(), hexdel_pslg::ValidateError>(())
    /// ```
    pub fn carved(&self, outside: bool) -> Carved {
        let doomed = reached(&self.plane, &self.pslg.holes, outside);
        let mut pieces = vec![true; self.pieces.len()];
        let mut vertices = vec![true; self.plane.vertex_count() as usize];
        for t in self.plane.alive().filter(|&t| !doomed[t as usize]) {
            let tri = self.plane.tri(t);
            for i in 0..3 {
                vertices[tri.v[i] as usize] = false;
                if let Some(piece) = pieces.get_mut(tri.s[i] as usize) {
                    *piece = false;
                }
            }
        }
        let sites = self.points.site_of_input().iter();
        let points = sites.map(|&site| vertices[self.vertex_of_site[site as usize] as usize]).collect();
        Carved { points, pieces }
    }
}

/// Which parts of the plane a mesh will not cover: what is there is nothing to it.
pub(crate) struct Carving<'a> {
    input: &'a Validated,
    locator: Locator<'a>,
    /// By triangle of the plane.
    carved: Vec<bool>,
}

/// How far beside the middle between two features the plane is looked at, too, over their
/// distance: on a segment between them rounding decides which side is seen.
const BESIDE: f64 = 0.01;

impl<'a> Carving<'a> {
    /// `None` if all is covered.
    pub(crate) fn of(input: &'a Validated, extent: Extent) -> Option<Self> {
        let carved = reached(&input.plane, &input.pslg.holes, extent == Extent::Inside);
        let any = input.plane.alive().any(|t| carved[t as usize]);
        any.then(|| Self { input, locator: Locator::of(input), carved })
    }

    /// Whether the plane beside a site is carved in a direction.
    pub(crate) fn is_carved_at(&self, site: u32, angle: f64) -> bool {
        // Others are not of the plane.
        let Some(&v) = self.input.vertex_of_site.get(site as usize) else { return false };
        let (sin, cos) = libm::sincos(angle);
        let direction = DVec2::new(cos, sin);
        let plane = &self.input.plane;
        let mut star = Vec::with_capacity(8);
        plane.star(v, &mut star);
        let holds = |&&t: &&u32| {
            let Some(i) = plane.tri(t).corner(v) else { return false };
            let [b, c] = plane.tri(t).edge(i).map(|w| plane.at(w) - plane.at(v));
            b.perp_dot(direction) >= 0.0 && direction.perp_dot(c) >= 0.0
        };
        star.iter().find(holds).is_some_and(|&t| self.carved[t as usize])
    }

    /// Whether only what is carved lies between two places.
    pub(crate) fn parts(&self, p: DVec2, q: DVec2) -> bool {
        let (middle, aside) = (p.midpoint(q), BESIDE * (q - p).perp());
        let is_carved = |p| self.locator.triangle_at(p).is_some_and(|t| self.carved[t as usize]);
        [middle, middle + aside, middle - aside].into_iter().all(is_carved)
    }
}

/// By triangle: whether it can be reached from the rim, if `outside`, or from
/// a hole.
pub(crate) fn reached(net: &Net, holes: &[DVec2], outside: bool) -> Vec<bool> {
    let mut reached = vec![false; net.tri_count() as usize];
    let mut stack = Vec::new();
    if outside {
        stack.extend(net.alive().filter(|&t| {
            let tri = net.tri(t);
            (0..3).any(|i| tri.n[i] == NONE && !net.is_border(t, i))
        }));
    }
    let mut hint = NONE;
    for &hole in holes {
        // A hole that says no side of a segment, or none at all, is none.
        if let Some(t) = net.part_at(hole, hint) {
            stack.push(t);
            hint = t;
        }
    }
    flood(net, stack, |t| !std::mem::replace(&mut reached[t as usize], true));
    reached
}

/// Visits all triangles that can be reached from some without crossing a
/// piece, as long as `enter` says that one is new.
pub(crate) fn flood(net: &Net, mut stack: Vec<u32>, mut enter: impl FnMut(u32) -> bool) {
    stack.retain(|&t| enter(t));
    while let Some(t) = stack.pop() {
        let tri = net.tri(t);
        for i in 0..3 {
            if tri.n[i] != NONE && !net.is_border(t, i) && enter(tri.n[i]) {
                stack.push(tri.n[i]);
            }
        }
    }
}

/// Gives each fan of triangles at a vertex a vertex of its own: where holes or
/// the outside touch themselves in a point, the triangles around it are no
/// single fan any more.
fn split_fans(net: &mut Net) {
    let mut tris_of: Vec<u32> = vec![0; net.vertex_count() as usize];
    for t in net.alive() {
        for v in net.tri(t).v {
            tris_of[v as usize] += 1;
        }
    }
    let mut star = Vec::new();
    let pinched: Vec<u32> = (0..net.vertex_count())
        .filter(|&v| {
            if net.vertex(v).kind == Kind::Gone {
                return false;
            }
            net.star(v, &mut star);
            star.len() < tris_of[v as usize] as usize
        })
        .collect();
    if pinched.is_empty() {
        return;
    }
    let mut at_vertex: Vec<(u32, u32)> = net
        .alive()
        .flat_map(|t| net.tri(t).v.map(|v| (v, t)))
        .filter(|(v, _)| pinched.binary_search(v).is_ok())
        .collect();
    at_vertex.sort_unstable();
    for group in at_vertex.chunk_by(|a, b| a.0 == b.0) {
        let v = group[0].0;
        net.star(v, &mut star);
        let mut rest: Vec<u32> = group.iter().map(|g| g.1).filter(|t| !star.contains(t)).collect();
        while let Some(&t) = rest.first() {
            let copy = net.copy_vertex(v, t);
            net.fan(v, t, &mut star);
            for &s in &star {
                net.rename(s, v, copy);
            }
            rest.retain(|t| !star.contains(t));
        }
    }
}
