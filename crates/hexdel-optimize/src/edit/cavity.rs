//! Cavities: polygons of triangles that are refilled by a fan around one new vertex.

use hexdel_geom::DVec2;

use super::{EditMesh, Kind, NONE, next, prev};

/// The most edges of a cavity.
pub const MOST_EDGES: usize = 28;

/// The most triangles in a cavity.
const MOST_TRIANGLES: usize = 32;

/// The most vertices that a cavity encloses, which go with it.
pub const MOST_ENCLOSED: usize = 6;

/// A simple polygon of triangles of a mesh, by value: cavities grow by copies. It is good as long as the mesh
/// does not change.
#[derive(Clone, Copy, Debug)]
pub struct Cavity {
    edges: u8,
    triangles: u8,
    enclosed: u8,
    /// Whether edge 0 is on a segment that the new vertex comes onto. It has no triangle in the fan then.
    pub on_segment: bool,
    /// Start of each edge, counter-clockwise.
    ring: [u32; MOST_EDGES],
    /// The corner inside opposite each edge.
    inner: [u32; MOST_EDGES],
    inside: [u32; MOST_TRIANGLES],
    gone: [u32; MOST_ENCLOSED],
    /// Of the set of triangles, whatever their order.
    pub hash: u64,
}

/// Spreads the number of a triangle over all bits, so that sums of them tell sets apart.
fn spread(t: u32) -> u64 {
    (u64::from(t) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(29).wrapping_mul(0xBF58_476D_1CE4_E5B9)
}

impl Cavity {
    fn empty(on_segment: bool) -> Self {
        Self {
            edges: 0,
            triangles: 0,
            enclosed: 0,
            on_segment,
            ring: [NONE; MOST_EDGES],
            inner: [NONE; MOST_EDGES],
            inside: [NONE; MOST_TRIANGLES],
            gone: [NONE; MOST_ENCLOSED],
            hash: 0,
        }
    }

    /// How many edges it has.
    #[inline]
    pub fn len(&self) -> usize {
        usize::from(self.edges)
    }

    /// Whether it has no edges.
    pub fn is_empty(&self) -> bool {
        self.edges == 0
    }

    /// The vertices of its outline, counter-clockwise.
    #[inline]
    pub fn ring(&self) -> &[u32] {
        &self.ring[..self.len()]
    }

    /// The corner inside opposite edge `i`.
    #[inline]
    pub fn inner(&self, i: usize) -> u32 {
        self.inner[i]
    }

    /// The index after `i`.
    #[inline]
    pub fn after(&self, i: usize) -> usize {
        if i + 1 == self.len() { 0 } else { i + 1 }
    }

    /// The index before `i`.
    #[inline]
    pub fn before(&self, i: usize) -> usize {
        if i == 0 { self.len() - 1 } else { i - 1 }
    }

    /// The triangles inside.
    #[inline]
    pub fn triangles(&self) -> &[u32] {
        &self.inside[..usize::from(self.triangles)]
    }

    /// The vertices enclosed.
    #[inline]
    pub fn enclosed(&self) -> &[u32] {
        &self.gone[..usize::from(self.enclosed)]
    }

    /// Whether another cavity beyond edge 0 has a vertex in common with this one besides that edge's.
    pub fn touches(&self, other: &Self) -> bool {
        self.ring()[2..].iter().any(|v| other.ring()[2..].contains(v))
    }

    fn push(&mut self, from: u32, inner: u32) {
        let n = self.len();
        (self.ring[n], self.inner[n]) = (from, inner);
        self.edges += 1;
    }

    fn remove(&mut self, i: usize) {
        let n = self.len();
        self.ring.copy_within(i + 1..n, i);
        self.inner.copy_within(i + 1..n, i);
        self.edges -= 1;
    }

    fn insert(&mut self, i: usize, from: u32, inner: u32) {
        let n = self.len();
        self.ring.copy_within(i..n, i + 1);
        self.inner.copy_within(i..n, i + 1);
        (self.ring[i], self.inner[i]) = (from, inner);
        self.edges += 1;
    }

    fn add(&mut self, t: u32) {
        self.inside[usize::from(self.triangles)] = t;
        self.triangles += 1;
        self.hash = self.hash.wrapping_add(spread(t));
    }

    fn enclose(&mut self, v: u32) {
        self.gone[usize::from(self.enclosed)] = v;
        self.enclosed += 1;
    }
}

impl EditMesh {
    /// The cavity of one triangle.
    pub fn cavity_of(&self, t: u32) -> Cavity {
        let mut cavity = Cavity::empty(false);
        for c in 3 * t..3 * t + 3 {
            cavity.push(self.v(c), prev(c));
        }
        cavity.add(t);
        cavity
    }

    /// The cavity of the triangle of corner `c`, for a new vertex on the edge opposite it.
    pub fn cavity_on(&self, c: u32) -> Cavity {
        let mut cavity = Cavity::empty(true);
        cavity.push(self.v(next(c)), c);
        cavity.push(self.v(prev(c)), next(c));
        cavity.push(self.v(c), prev(c));
        cavity.add(c / 3);
        cavity
    }

    /// The triangles around a vertex inside the mesh; none if there are too many.
    pub fn cavity_around(&self, v: u32) -> Option<Cavity> {
        let mut cavity = Cavity::empty(false);
        let start = self.corner_of[v as usize];
        let mut c = start;
        loop {
            let beyond = self.twin[next(c) as usize];
            if cavity.len() + 1 >= MOST_EDGES || beyond == NONE {
                return None;
            }
            cavity.push(self.v(next(c)), c);
            cavity.add(c / 3);
            c = next(beyond);
            if c == start {
                break;
            }
        }
        cavity.enclose(v);
        Some(cavity)
    }

    /// The triangles on either side of a vertex on a segment, for its like on the same edge; the second is empty at
    /// the outline. None if there are too many, or not two marked edges at the vertex.
    pub fn cavities_beside(&self, v: u32) -> Option<[Cavity; 2]> {
        let mut halves = [Cavity::empty(true), Cavity::empty(true)];
        let mut c = self.corner_of[v as usize];
        for _ in 0..2 * MOST_EDGES {
            if self.is_marked(prev(c)) {
                break;
            }
            c = prev(self.twin[prev(c) as usize]);
        }
        if !self.is_marked(prev(c)) {
            return None;
        }
        let start = c;
        for (k, half) in halves.iter_mut().enumerate() {
            c = self.half(c, half)?;
            if k == 0 {
                half.enclose(v);
                if self.twin[next(c) as usize] == NONE {
                    // Beyond both edges, or the vertex is none of a segment.
                    return (self.twin[prev(start) as usize] == NONE).then_some(halves);
                }
            }
            c = match self.twin[next(c) as usize] {
                NONE => return None,
                beyond => next(beyond),
            };
        }
        (c == start).then_some(halves)
    }

    /// Fills in one half from a marked edge to the next, and says the last corner.
    fn half(&self, mut c: u32, half: &mut Cavity) -> Option<u32> {
        half.push(NONE, prev(c));
        loop {
            if half.len() + 2 >= MOST_EDGES {
                return None;
            }
            half.push(self.v(next(c)), c);
            half.add(c / 3);
            if self.is_marked(next(c)) {
                break;
            }
            c = next(self.twin[next(c) as usize]);
        }
        half.ring[0] = self.v(prev(c));
        Some(c)
    }

    /// The cavity with the triangle beyond edge `i`; none if a mark or the outline is in the way, a vertex would be
    /// enclosed that may not go, or it is too large.
    pub fn grown(&self, cavity: &Cavity, i: usize) -> Option<Cavity> {
        let inner = cavity.inner[i];
        let k = self.twin[inner as usize];
        let full = usize::from(cavity.triangles) + 2 >= MOST_TRIANGLES || cavity.len() + 1 >= MOST_EDGES;
        if self.is_marked(inner) || k == NONE || full || (cavity.on_segment && i == 0) {
            return None;
        }
        let apex = self.v(k);
        let (after, before) = (cavity.after(i), cavity.before(i));
        // Beyond, the edge runs the other way, from `next(k)` to `prev(k)`: the one is its end, the other its start.
        // The edge from the start to the apex is opposite the end, that from the apex to the end opposite the start.
        let (to_apex, from_apex) = (next(k), prev(k));
        let mut grown = *cavity;
        grown.add(k / 3);
        let n = cavity.len();
        let may_go = |j: usize| {
            let v = cavity.ring[j];
            self.kind[v as usize] == Kind::Free
                && usize::from(cavity.enclosed) < MOST_ENCLOSED
                && !(cavity.on_segment && j < 2)
        };
        if n > 3 && apex == cavity.ring[cavity.after(after)] {
            if !may_go(after) {
                return None;
            }
            grown.enclose(cavity.ring[after]);
            grown.inner[i] = to_apex;
            grown.remove(after);
            return Some(grown);
        }
        if n > 3 && apex == cavity.ring[before] {
            if !may_go(i) {
                return None;
            }
            grown.enclose(cavity.ring[i]);
            grown.inner[before] = from_apex;
            grown.remove(i);
            return Some(grown);
        }
        if cavity.ring().contains(&apex) {
            return None;
        }
        grown.inner[i] = to_apex;
        grown.insert(i + 1, apex, from_apex);
        Some(grown)
    }

    /// Refills a cavity, or the two on both sides of a segment, by a fan around a new vertex at `p`. Slots of the new
    /// triangles go to `slots`, which is cleared.
    pub fn refill(
        &mut self,
        cavity: &Cavity,
        other: Option<&Cavity>,
        p: DVec2,
        kind: Kind,
        slots: &mut Vec<u32>,
    ) -> u32 {
        let fan = self.fan_of(cavity, other);
        for cavity in std::iter::once(cavity).chain(other) {
            for &t in cavity.triangles() {
                self.free_slot(t);
            }
            for &v in cavity.enclosed() {
                self.remove_vertex(v);
            }
        }
        let v = self.add_vertex(p, kind);
        slots.clear();
        for _ in 0..fan.len {
            let slot = self.add_slot();
            slots.push(slot);
        }
        self.write_fan(v, &fan, slots);
        v
    }

    fn fan_of(&self, cavity: &Cavity, other: Option<&Cavity>) -> Fan {
        let mut fan = Fan { len: 0, edges: [FanEdge::default(); 2 * MOST_EDGES], last: None };
        let first = usize::from(cavity.on_segment);
        for (k, cavity) in std::iter::once(cavity).chain(other).enumerate() {
            let spoke = if cavity.on_segment { self.mark[cavity.inner[0] as usize] } else { 0 };
            for i in first..cavity.len() {
                let inner = cavity.inner[i] as usize;
                let spoke = if i == 1 { spoke } else { 0 };
                fan.edges[fan.len] =
                    FanEdge { from: cavity.ring[i], beyond: self.twin[inner], mark: self.mark[inner], spoke };
                fan.len += 1;
            }
            if k == 0 && cavity.on_segment && other.is_none() {
                fan.last = Some((cavity.ring[0], spoke));
            }
        }
        fan
    }

    /// Triangle `i` of a fan: the new vertex, start of edge `i`, its end.
    fn write_fan(&mut self, v: u32, fan: &Fan, slots: &[u32]) {
        let k = fan.len;
        for (i, (&t, edge)) in slots.iter().zip(&fan.edges).enumerate() {
            let j = if i + 1 == k { 0 } else { i + 1 };
            let before = if i == 0 { k - 1 } else { i - 1 };
            let is_last = i + 1 == k;
            let (to, twin, mark) = match fan.last {
                Some((to, mark)) if is_last => (to, NONE, mark),
                _ => (fan.edges[j].from, 3 * slots[j] + 2, fan.edges[j].spoke),
            };
            let at_start = if fan.last.is_some() && i == 0 { NONE } else { 3 * slots[before] + 1 };
            let c = 3 * t as usize;
            (self.vertex[c], self.vertex[c + 1], self.vertex[c + 2]) = (v, edge.from, to);
            (self.mark[c], self.mark[c + 1], self.mark[c + 2]) = (edge.mark, mark, edge.spoke);
            (self.twin[c + 1], self.twin[c + 2]) = (twin, at_start);
            self.pair(c as u32, edge.beyond);
            self.corner_of[edge.from as usize] = c as u32 + 1;
            if is_last && fan.last.is_some() {
                self.corner_of[to as usize] = c as u32 + 2;
            }
            self.touch(t);
        }
        self.corner_of[v as usize] = 3 * slots[0];
    }
}

/// An edge of a fan's outline.
#[derive(Clone, Copy, Default)]
struct FanEdge {
    from: u32,
    beyond: u32,
    mark: u32,
    /// Mark of the edge from the new vertex to the start.
    spoke: u32,
}

struct Fan {
    len: usize,
    edges: [FanEdge; 2 * MOST_EDGES],
    /// At the outline the fan is open: the vertex it ends at, and the mark of the edge to it.
    last: Option<(u32, u32)>,
}
