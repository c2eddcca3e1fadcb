//! What has changed since a place in the journal, and whether it holds.
//!
//! Each changed triangle is asked what the certificate asks of it, by the same
//! predicates: its angles and orientation, its edges, the fans of its corners.
//! What has not changed was asked when it last did.

use hexdel_geom::delaunay::restore_constrained_delaunay;
use hexdel_geom::predicates::locally_delaunay;
use hexdel_geom::{AngleBounds, TriMesh, VertexId, keeps_bounds_at};

use crate::live::cut::{Cut, rings};
use crate::live::store::{Store, Triangle, Undo, Vertex};
use crate::mesh::{Motion, NONE};

/// The bounds of a mesh by place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    /// Of triangles with a vertex at most one edge away from a segment or a
    /// point that counts as one.
    pub(crate) near: AngleBounds,
    /// Of all others.
    pub(crate) far: AngleBounds,
}

/// Slots that were written since a place in the journal: ascending, with what
/// they held then, dead or alive.
pub(crate) struct Written {
    pub(crate) vertices: Vec<(u32, Vertex)>,
    pub(crate) triangles: Vec<(u32, Triangle)>,
}

impl Written {
    pub(crate) fn of(journal: &[Undo]) -> Self {
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        for undo in journal {
            match *undo {
                Undo::Vertex(v, old) => vertices.push((v, old)),
                Undo::Triangle(t, old) => triangles.push((t, old)),
                _ => {}
            }
        }
        // Stable: the first write of a slot has what it held before all.
        vertices.sort_by_key(|w| w.0);
        vertices.dedup_by_key(|w| w.0);
        triangles.sort_by_key(|w| w.0);
        triangles.dedup_by_key(|w| w.0);
        Self { vertices, triangles }
    }

    /// The same slots with what they hold now.
    pub(crate) fn now(self, store: &Store) -> Self {
        let vertex =
            |(v, _): (u32, Vertex)| (v, store.vertices.get(v as usize).copied().unwrap_or(Vertex::FREE));
        let triangle =
            |(t, _): (u32, Triangle)| (t, store.triangles.get(t as usize).copied().unwrap_or(Triangle::FREE));
        Self {
            vertices: self.vertices.into_iter().map(vertex).collect(),
            triangles: self.triangles.into_iter().map(triangle).collect(),
        }
    }

    /// Live triangles that are new or have a corner that moved, ascending.
    pub(crate) fn changed(&self, store: &Store) -> Vec<u32> {
        let is_new = |&&(t, old): &&(u32, Triangle)| {
            let now = store.triangles.get(t as usize);
            now.is_some_and(|now| now.alive() && now.serial != old.serial)
        };
        let mut changed: Vec<u32> = self.triangles.iter().filter(is_new).map(|w| w.0).collect();
        for &(v, old) in &self.vertices {
            let now = store.vertices.get(v as usize);
            if now.is_some_and(|now| now.alive() && (now.serial != old.serial || now.at != old.at)) {
                store.around(v, |t| changed.push(t));
            }
        }
        changed.sort_unstable();
        changed.dedup();
        changed
    }

    /// Those that have changed, and those that may have lost what made them near
    /// a segment; ascending.
    pub(crate) fn to_check(&self, store: &Store) -> Vec<u32> {
        let mut all = self.changed(store);
        if !store.constrained {
            return all;
        }
        let alive = |v: &u32| store.vertices.get(*v as usize).is_some_and(Vertex::alive);
        let mut corners: Vec<u32> = self.triangles.iter().flat_map(|(_, old)| old.v).filter(alive).collect();
        for &(v, old) in self.vertices.iter().filter(|(v, old)| alive(v) && old.serial != 0) {
            if store.vertex(v).source != old.source {
                store.around(v, |t| corners.extend(store.triangle(t).v));
            }
        }
        corners.sort_unstable();
        corners.dedup();
        for v in corners {
            store.around(v, |t| all.push(t));
        }
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// Whether a triangle keeps the bounds of its place as a certificate sees them,
/// but for corners whose angle is the input's.
pub(crate) fn keeps_bounds_here(store: &Store, bounds: Bounds, t: u32) -> bool {
    let corners = store.corners(t);
    if !store.constrained {
        return keeps_bounds_at(corners, bounds.far, [true; 3]);
    }
    let tri = store.triangle(t);
    let wider =
        bounds.near.min_deg() <= bounds.far.min_deg() && bounds.near.max_deg() >= bounds.far.max_deg();
    // Most keep both, and need not be asked where they are.
    if wider && keeps_bounds_at(corners, bounds.far, [true; 3]) {
        return true;
    }
    let is_sector = |k: usize| tri.is_bound((k + 1) % 3) && tri.is_bound((k + 2) % 3);
    let lower = if store.in_wedge(t) { [false; 3] } else { [0, 1, 2].map(|k| !is_sector(k)) };
    let near = lower.contains(&false) || tri.v.iter().any(|&v| store.is_near(v));
    keeps_bounds_at(corners, if near { bounds.near } else { bounds.far }, lower)
}

/// Triangles as a mesh of their own, with the slot of each vertex.
pub(crate) fn as_mesh(store: &Store, triangles: &[u32]) -> (TriMesh, Vec<u32>) {
    let mut slots: Vec<u32> = triangles.iter().flat_map(|&t| store.triangle(t).v).collect();
    slots.sort_unstable();
    slots.dedup();
    let name = |v: u32| VertexId::new(slots.binary_search(&v).expect("every corner was collected"));
    let mesh = TriMesh {
        vertices: slots.iter().map(|&v| store.at(v)).collect(),
        triangles: triangles.iter().map(|&t| store.triangle(t).v.map(name)).collect(),
    };
    (mesh, slots)
}

/// Whether everything that has changed holds. Edges that are not Delaunay, as
/// rounding leaves them now and then, are repaired on the way.
pub(crate) fn settle_changes(store: &mut Store, mark: usize, bounds: Bounds) -> bool {
    // A repair changes more; a second one is needed for next to no mesh.
    for _ in 0..4 {
        let written = Written::of(store.since(mark));
        let (changed, to_check) = (written.changed(store), written.to_check(store));
        if !to_check.iter().all(|&t| keeps_bounds_here(store, bounds, t)) || !fans_hold(store, &changed) {
            return false;
        }
        if changed.iter().all(|&t| is_delaunay(store, t)) {
            return true;
        }
        if !restore(store, &changed, bounds.near) {
            return false;
        }
    }
    false
}

/// Whether the edges of a triangle are Delaunay.
fn is_delaunay(store: &Store, t: u32) -> bool {
    let tri = store.triangle(t);
    (0..3).all(|k| {
        let Some(beyond) = (tri.n[k] != NONE).then(|| store.triangle(tri.n[k])) else {
            return true;
        };
        let (from, to) = (tri.v[(k + 1) % 3], tri.v[(k + 2) % 3]);
        let far = beyond.v.into_iter().find(|&v| v != from && v != to).expect("neighbours share a side");
        let [a, b, c, d] = [from, far, to, tri.v[k]].map(|v| store.at(v));
        locally_delaunay(a, b, c, d)
    })
}

/// Whether neighbours are mutual and the triangles at each vertex are one fan.
fn fans_hold(store: &Store, changed: &[u32]) -> bool {
    changed.iter().all(|&t| {
        let tri = store.triangle(t);
        (0..3).all(|k| {
            let mutual = tri.n[k] == NONE || store.triangle(tri.n[k]).n.contains(&t);
            let mut found = false;
            store.around(tri.v[k], |u| found |= u == t);
            mutual && found
        })
    })
}

/// Makes the changed triangles and two rings around them Delaunay.
fn restore(store: &mut Store, changed: &[u32], bounds: AngleBounds) -> bool {
    let cut = Cut::new(store, rings(store, changed, 2));
    let (mut mesh, slots) = as_mesh(store, &cut.triangles);
    debug_assert_eq!(slots, cut.vertices);
    let free = |v: VertexId| cut.mesh.motion[v.index()] == Motion::Free;
    let bound = cut.bound_sides();
    let flippable =
        |[a, b]: [VertexId; 2]| bound.binary_search(&[a.min(b), a.max(b)].map(|v| v.index() as u32)).is_err();
    if restore_constrained_delaunay(&mut mesh, bounds, free, flippable).is_err() {
        return false;
    }
    cut.put_mesh(store, &mesh);
    true
}
