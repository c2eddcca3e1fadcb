//! A few rings of triangles cut out of the live mesh, to be worked on, and put
//! back where they changed.

use hexdel_geom::TriMesh;

use crate::live::store::{Store, Triangle, Vertex};
use crate::mesh::{Around, Mesh, Motion, NONE, Tri, Vertices};

/// Part of a live mesh.
#[derive(Clone, Debug)]
pub(crate) struct Cut {
    /// Slots of the triangles, ascending.
    pub(crate) triangles: Vec<u32>,
    /// Slots of the vertices, ascending: the first vertices of `mesh`.
    pub(crate) vertices: Vec<u32>,
    /// The part. Vertices that other triangles share are frozen.
    pub(crate) mesh: Mesh,
    /// As in `Soup::failed`, for each vertex.
    pub(crate) failed: Vec<u8>,
}

/// The triangles of so many rings around `seeds`, ascending.
pub(crate) fn rings(store: &Store, seeds: &[u32], rings: usize) -> Vec<u32> {
    let mut all: Vec<u32> = seeds.to_vec();
    all.sort_unstable();
    all.dedup();
    let mut front = all.clone();
    for _ in 0..rings {
        let mut vertices: Vec<u32> = front.iter().flat_map(|&t| store.triangle(t).v).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut next = Vec::new();
        for v in vertices {
            store.around(v, |t| next.push(t));
        }
        next.sort_unstable();
        next.dedup();
        next.retain(|t| all.binary_search(t).is_err());
        all.extend(&next);
        all.sort_unstable();
        front = next;
    }
    all
}

impl Cut {
    /// Cuts out triangles, ascending.
    pub(crate) fn new(store: &Store, triangles: Vec<u32>) -> Self {
        let mut vertices: Vec<u32> = triangles.iter().flat_map(|&t| store.triangle(t).v).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let local = |v: u32| vertices.binary_search(&v).expect("every corner was collected") as u32;
        let tris: Vec<[u32; 3]> = triangles.iter().map(|&t| store.triangle(t).v.map(local)).collect();
        let mut outside: Vec<u32> = vec![0; vertices.len()];
        for (i, &v) in vertices.iter().enumerate() {
            store.around(v, |_| outside[i] += 1);
        }
        for &v in tris.iter().flatten() {
            outside[v as usize] -= 1;
        }
        let motion = |(&v, &outside): (&u32, &u32)| {
            if outside > 0 { Motion::Frozen } else { store.vertex(v).motion }
        };
        let around = if store.constrained {
            let is_near = |(&v, &outside): (&u32, &u32)| outside > 0 && store.is_near(v);
            Around {
                source: vertices.iter().map(|&v| store.vertex(v).source).collect(),
                near: vertices.iter().zip(&outside).map(is_near).collect(),
                lines: store.lines.clone(),
            }
        } else {
            Around::default()
        };
        let parts = Vertices {
            pos: vertices.iter().map(|&v| store.at(v)).collect(),
            motion: vertices.iter().zip(&outside).map(motion).collect(),
            sector: vertices.iter().map(|&v| store.vertex(v).sector).collect(),
            outside,
            around,
        };
        let bound: Vec<u8> = triangles.iter().map(|&t| store.triangle(t).bound).collect();
        let failed = vertices.iter().map(|&v| store.vertex(v).failed).collect();
        let mesh = Mesh::build(parts, &tris, &bound).expect("a part of a manifold is one but for its seam");
        Self { triangles, vertices, mesh, failed }
    }

    /// The part's name of a triangle slot.
    pub(crate) fn local_triangle(&self, t: u32) -> Option<u32> {
        self.triangles.binary_search(&t).ok().map(|i| i as u32)
    }

    /// The part's name of a vertex slot that is in it.
    pub(crate) fn local_vertex(&self, v: u32) -> u32 {
        self.vertices.binary_search(&v).expect("a vertex of the part") as u32
    }

    /// Whether another state of the part is a disk if the part was: triangles
    /// are twice the vertices inside and once those on the rim, but for a
    /// constant.
    pub(crate) fn keeps_disk(&self, mesh: &Mesh) -> bool {
        let inside = |i: usize| mesh.sector[i] == std::f64::consts::TAU;
        let worth = |i: usize| if inside(i) { 2 } else { 1 };
        let mut balance = mesh.live().count() as i64 - self.triangles.len() as i64;
        for i in 0..mesh.pos.len() {
            let (was, is) = (i < self.vertices.len(), mesh.alive(i as u32));
            balance -= worth(i) * (i64::from(is) - i64::from(was));
        }
        balance == 0
    }

    /// Writes what has changed into the store; `mesh` and `failed` are what the
    /// work has made of the part's own. Returns the slot of each vertex of
    /// `mesh`, `NONE` for those that are gone.
    pub(crate) fn put_back(&self, store: &mut Store, mesh: &Mesh, failed: &[u8]) -> Vec<u32> {
        let slots = self.put_vertices(store, mesh, &self.remembered(mesh, failed));
        let triangle = |t: u32| {
            let tri = mesh.tri[t as usize];
            (tri.v.map(|v| slots[v as usize]), tri.bound)
        };
        self.put_triangles(store, mesh.live().map(triangle));
        self.free_dead(store, &slots);
        slots
    }

    /// Writes another state of the part, with the same vertices, into the
    /// store.
    pub(crate) fn put_mesh(&self, store: &mut Store, mesh: &TriMesh) {
        for (&v, &at) in self.vertices.iter().zip(&mesh.vertices) {
            let old = *store.vertex(v);
            store.write_vertex(v, Vertex { at, ..old });
        }
        let bound = self.bound_sides();
        let triangle = |t: [u32; 3]| {
            let on = |k: &usize| bound.binary_search(&sorted_pair(t[(k + 1) % 3], t[(k + 2) % 3])).is_ok();
            (t.map(|v| self.vertices[v as usize]), (0..3).filter(on).map(|k| 1 << k).sum())
        };
        let triangles = mesh.triangles.iter().map(|t| triangle(t.map(|v| v.index() as u32)));
        self.put_triangles(store, triangles);
    }

    /// The part's sides on segments, by its names of their ends; sorted.
    pub(crate) fn bound_sides(&self) -> Vec<[u32; 2]> {
        let mut bound = Vec::new();
        for tri in self.mesh.tri.iter().filter(|tri| tri.bound != 0) {
            let sides = (0..3).filter(|&k| tri.is_bound(k));
            bound.extend(sides.map(|k| sorted_pair(tri.v[(k + 1) % 3], tri.v[(k + 2) % 3])));
        }
        bound.sort_unstable();
        bound
    }

    /// What has failed at each vertex and need not be tried again: the optimiser forgets
    /// wherever something moves, but what failed before succeeds only where triangles
    /// have become others.
    fn remembered(&self, mesh: &Mesh, failed: &[u8]) -> Vec<u8> {
        let mut changed = vec![false; mesh.pos.len()];
        let mut differ = |tris: &[Tri], others: &[Tri]| {
            for (t, tri) in tris.iter().enumerate().filter(|(_, tri)| tri.alive()) {
                if others.get(t).is_none_or(|other| other.v != tri.v) {
                    tri.v.iter().for_each(|&v| changed[v as usize] = true);
                }
            }
        };
        differ(&mesh.tri, &self.mesh.tri);
        differ(&self.mesh.tri, &mesh.tri);
        let of = |failed: &[u8], i: usize| failed.get(i).copied().unwrap_or(0);
        let before = |i: usize| if changed[i] { 0 } else { of(&self.failed, i) };
        (0..mesh.pos.len()).map(|i| of(failed, i).max(before(i))).collect()
    }

    fn put_triangles(&self, store: &mut Store, new: impl Iterator<Item = ([u32; 3], u8)>) {
        let known = |&t: &u32| {
            let tri = store.triangle(t);
            (tri.v, tri.bound, t)
        };
        let old = sorted(self.triangles.iter().map(known));
        let new = sorted(new.map(|(v, bound)| (v, bound, NONE)));
        let outer = self.outer(store);
        let mut kept = Vec::with_capacity(new.len());
        let mut added = Vec::new();
        let (mut i, mut j) = (0, 0);
        while i < old.len() || j < new.len() {
            let order = match (old.get(i), new.get(j)) {
                (Some(a), Some(b)) => a.0.cmp(&b.0),
                (Some(_), None) => std::cmp::Ordering::Less,
                _ => std::cmp::Ordering::Greater,
            };
            match order {
                std::cmp::Ordering::Less => {
                    store.free_triangle(old[i].2);
                    i += 1;
                }
                std::cmp::Ordering::Greater => {
                    added.push((new[j].0, new[j].1));
                    j += 1;
                }
                std::cmp::Ordering::Equal => {
                    debug_assert_eq!(old[i].1, new[j].1, "a side is on a segment for good");
                    kept.push(old[i].2);
                    (i, j) = (i + 1, j + 1);
                }
            }
        }
        kept.extend(added.into_iter().map(|(v, bound)| store.add_triangle(v, bound)));
        link(store, &kept, &outer);
    }

    fn put_vertices(&self, store: &mut Store, mesh: &Mesh, failed: &[u8]) -> Vec<u32> {
        let mut slots = Vec::with_capacity(mesh.pos.len());
        for i in 0..mesh.pos.len() {
            let alive = mesh.alive(i as u32);
            let known = self.vertices.get(i).copied();
            let failed = failed.get(i).copied().unwrap_or(0);
            slots.push(match known {
                _ if !alive => NONE,
                Some(v) => {
                    let old = *store.vertex(v);
                    let frozen = mesh.motion[i] == Motion::Frozen;
                    let motion = if frozen { old.motion } else { mesh.motion[i] };
                    let failed = if frozen { failed.min(old.failed) } else { failed };
                    let source = mesh.source(i as u32);
                    store.write_vertex(v, Vertex { at: mesh.pos[i], motion, failed, source, ..old });
                    v
                }
                None => store.add_vertex(Vertex {
                    at: mesh.pos[i],
                    motion: mesh.motion[i],
                    sector: mesh.sector[i],
                    anchor: NONE,
                    failed,
                    source: mesh.source(i as u32),
                    serial: 0,
                }),
            });
        }
        slots
    }

    /// The directed sides of the part that other triangles lie beyond of.
    fn outer(&self, store: &Store) -> Vec<([u32; 2], u32)> {
        let mut outer = Vec::new();
        for &t in &self.triangles {
            let tri = store.triangle(t);
            for k in 0..3 {
                if tri.n[k] != NONE && self.triangles.binary_search(&tri.n[k]).is_err() {
                    outer.push(([tri.v[(k + 1) % 3], tri.v[(k + 2) % 3]], tri.n[k]));
                }
            }
        }
        outer.sort_unstable();
        outer
    }

    fn free_dead(&self, store: &mut Store, slots: &[u32]) {
        for (i, &v) in self.vertices.iter().enumerate() {
            if slots[i] == NONE {
                store.free_vertex(v);
            }
        }
    }
}

/// Corners, sides on segments, and slot.
type Named = ([u32; 3], u8, u32);

/// The corners of triangles from the lowest on, in order.
fn sorted(triangles: impl Iterator<Item = Named>) -> Vec<Named> {
    let mut all: Vec<Named> = triangles
        .map(|(v, bound, t)| {
            let low = (0..3).min_by_key(|&k| v[k]).expect("three corners");
            let turned = (bound >> low | bound << (3 - low)) & 0b111;
            ([v[low], v[(low + 1) % 3], v[(low + 2) % 3]], turned, t)
        })
        .collect();
    all.sort_unstable();
    all
}

fn sorted_pair(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Makes neighbours of triangles that share a side, with each other and with
/// what lies beyond `outer`, and anchors of their vertices.
pub(crate) fn link(store: &mut Store, triangles: &[u32], outer: &[([u32; 2], u32)]) {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * triangles.len());
    for &t in triangles {
        let v = store.triangle(t).v;
        sides.extend((0..3).map(|k| ([v[(k + 1) % 3], v[(k + 2) % 3]], t)));
    }
    sides.sort_unstable();
    let find = |list: &[([u32; 2], u32)], side: [u32; 2]| {
        list.binary_search_by(|s| s.0.cmp(&side)).ok().map(|i| list[i].1)
    };
    for &t in triangles {
        let old = *store.triangle(t);
        let mut n = [NONE; 3];
        for (k, n) in n.iter_mut().enumerate() {
            let (from, to) = (old.v[(k + 1) % 3], old.v[(k + 2) % 3]);
            if let Some(u) = find(&sides, [to, from]) {
                *n = u;
            } else if let Some(u) = find(outer, [from, to]) {
                *n = u;
                let mut beyond = *store.triangle(u);
                let j = (0..3).find(|&j| beyond.v[(j + 1) % 3] == to && beyond.v[(j + 2) % 3] == from);
                beyond.n[j.expect("neighbours share a side")] = t;
                store.write_triangle(u, beyond);
            }
        }
        store.write_triangle(t, Triangle { n, ..old });
        for v in old.v {
            let old = *store.vertex(v);
            if !store.triangle_has(old.anchor, v) {
                store.write_vertex(v, Vertex { anchor: t, ..old });
            }
        }
    }
}

impl Store {
    fn triangle_has(&self, t: u32, v: u32) -> bool {
        self.triangles.get(t as usize).is_some_and(|tri| tri.alive() && tri.v.contains(&v))
    }
}
