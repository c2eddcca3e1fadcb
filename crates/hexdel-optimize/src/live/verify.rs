//! What has changed since a place in the journal, and whether it holds.
//!
//! Each changed triangle is asked what the certificate asks of it, by the same
//! predicates: its angles and orientation, its edges, the fans of its corners.
//! What has not changed was asked when it last did.

use hexdel_geom::predicates::locally_delaunay;
use hexdel_geom::{AngleBounds, DVec2, TriMesh, VertexId, keeps_bounds, restore_delaunay};

use crate::live::cut::{Cut, rings};
use crate::live::store::{Store, Undo};
use crate::mesh::{Motion, NONE};

/// Slots that were written since a place in the journal: ascending, with what
/// they held then, dead or alive.
pub(crate) struct Written {
    pub(crate) vertices: Vec<(u32, u64, DVec2)>,
    pub(crate) triangles: Vec<(u32, u64, [u32; 3])>,
}

impl Written {
    pub(crate) fn of(journal: &[Undo]) -> Self {
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        for undo in journal {
            match *undo {
                Undo::Vertex(v, old) => vertices.push((v, old.serial, old.at)),
                Undo::Triangle(t, old) => triangles.push((t, old.serial, old.v)),
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
        let vertex = |(v, _, _): (u32, u64, DVec2)| {
            store.vertices.get(v as usize).map_or((v, 0, DVec2::ZERO), |now| (v, now.serial, now.at))
        };
        let triangle = |(t, _, _): (u32, u64, [u32; 3])| {
            store.triangles.get(t as usize).map_or((t, 0, [NONE; 3]), |now| (t, now.serial, now.v))
        };
        Self {
            vertices: self.vertices.into_iter().map(vertex).collect(),
            triangles: self.triangles.into_iter().map(triangle).collect(),
        }
    }

    /// Live triangles that are new or have a corner that moved, ascending.
    pub(crate) fn changed(&self, store: &Store) -> Vec<u32> {
        let is_new = |&&(t, serial, _): &&(u32, u64, [u32; 3])| {
            let now = store.triangles.get(t as usize);
            now.is_some_and(|now| now.alive() && now.serial != serial)
        };
        let mut changed: Vec<u32> = self.triangles.iter().filter(is_new).map(|w| w.0).collect();
        for &(v, serial, at) in &self.vertices {
            let now = store.vertices.get(v as usize);
            if now.is_some_and(|now| now.alive() && (now.serial != serial || now.at != at)) {
                store.around(v, |t| changed.push(t));
            }
        }
        changed.sort_unstable();
        changed.dedup();
        changed
    }
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
pub(crate) fn settle_changes(store: &mut Store, mark: usize, bounds: AngleBounds) -> bool {
    // A repair changes more; a second one is needed for next to no mesh.
    for _ in 0..4 {
        let changed = Written::of(store.since(mark)).changed(store);
        if !changed.iter().all(|&t| keeps_bounds(store.corners(t), bounds)) || !fans_hold(store, &changed) {
            return false;
        }
        if changed.iter().all(|&t| is_delaunay(store, t)) {
            return true;
        }
        if !restore(store, &changed, bounds) {
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
    if restore_delaunay(&mut mesh, bounds, free).is_err() {
        return false;
    }
    cut.put_mesh(store, &mesh);
    true
}
