//! A part of the mesh as a mesh of its own.

use hexdel_geom::DVec2;
use hexdel_optimize::edit::{EditMesh, Kind, LOCKED, NONE, next, prev};

use super::Search;
use super::delaunay::is_bad;

/// Where a window is in the whole mesh.
pub(super) struct Window {
    /// The number in the whole of each vertex of the window.
    vertices: Vec<u32>,
    triangles: Vec<u32>,
    /// The middle of its first triangle.
    pub(super) centre: DVec2,
}

impl Search<'_> {
    /// Makes some triangles around a first one the refiner's mesh. Edges and vertices that other triangles have too stay as
    /// they are.
    pub(super) fn extract(&mut self, seed: u32, size: usize) -> Window {
        let whole = &self.whole;
        let triangles = around(whole, seed, size);
        let mut vertices: Vec<u32> = triangles.iter().flat_map(|&t| whole.vertices(t)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let local = |v: u32| vertices.binary_search(&v).expect("a vertex of the window") as u32;
        let mut mesh = EditMesh::default();
        mesh.pos = vertices.iter().map(|&v| whole.at(v)).collect();
        mesh.kind = vertices.iter().map(|&v| whole.kind[v as usize]).collect();
        mesh.set_triangles(triangles.iter().map(|&t| whole.vertices(t).map(local)))
            .expect("a part of a surface");
        for (c, d) in triangles.iter().flat_map(|&t| 3 * t..3 * t + 3).zip(0_u32..) {
            let is_rim = mesh.twin[d as usize] == NONE && whole.twin[c as usize] != NONE;
            mesh.mark[d as usize] = whole.mark[c as usize] | if is_rim { LOCKED } else { 0 };
            for v in [next(d), prev(d)].map(|d| mesh.v(d) as usize) {
                if is_rim && mesh.kind[v] != Kind::Fixed {
                    mesh.kind[v] = Kind::Held;
                }
            }
        }
        self.refiner.mesh = mesh;
        let centre = whole.corners(seed).iter().sum::<DVec2>() / 3.0;
        Window { vertices, triangles, centre }
    }

    /// Puts the refiner's mesh in the place of the window's triangles.
    pub(super) fn splice(&mut self, window: &Window) {
        let Self { refiner, whole, .. } = self;
        let mesh = &refiner.mesh;
        // All others get new numbers: their slots may be those of vertices that are gone.
        let stays = |v: usize| v < window.vertices.len() && matches!(mesh.kind[v], Kind::Fixed | Kind::Held);
        let mut number = vec![NONE; mesh.pos.len()];
        for (v, number) in number.iter_mut().enumerate() {
            if stays(v) {
                *number = window.vertices[v];
            } else if mesh.kind[v] != Kind::Dead {
                *number = whole.add_vertex(mesh.pos[v], mesh.kind[v]);
            }
        }
        let new: Vec<[u32; 3]> =
            mesh.triangles().map(|t| mesh.vertices(t).map(|v| number[v as usize])).collect();
        let slots = &mut refiner.slots;
        // Triangles beyond the rim may be Delaunay with the old ones and not with the new ones.
        let beyond = neighbours(whole, &window.triangles);
        let count = |whole: &EditMesh, own: &[u32]| {
            own.iter().chain(&beyond).filter(|&&t| is_bad(whole, &refiner.limits, t)).count()
        };
        let before = count(whole, &window.triangles);
        whole.replace(&window.triangles, &new, slots, None);
        for (t, &slot) in mesh.triangles().zip(slots.iter()) {
            for (c, d) in (3 * t..3 * t + 3).zip(3 * slot..) {
                // The rim has its marks already, and without the lock.
                if mesh.is_marked(c) && !(mesh.is_locked(c) && mesh.twin[c as usize] == NONE) {
                    whole.mark[d as usize] = mesh.mark[c as usize];
                }
            }
        }
        for (_, &v) in window.vertices.iter().enumerate().filter(|(v, _)| !stays(*v)) {
            whole.remove_vertex(v);
        }
        let now_bad = slots.iter().chain(&beyond).filter(|&&t| is_bad(whole, &refiner.limits, t));
        self.bad.extend(now_bad);
        self.bad_count = self.bad_count + count(whole, slots) - before;
    }

    /// Collects the window's bad triangles, and says how many they are. None if the mesh is not to be used: it has a
    /// sliver between two edges of one segment.
    pub(super) fn count_bad_here(&mut self) -> Option<usize> {
        let mesh = &self.refiner.mesh;
        self.bad_here.clear();
        self.bad_here.extend(mesh.triangles().filter(|&t| is_bad(mesh, &self.refiner.limits, t)));
        let is_sliver = |&t: &u32| {
            let [a, b, c] = [0, 1, 2].map(|k| mesh.segment(3 * t + k));
            a.is_some() && (a == b || a == c) || b.is_some() && b == c
        };
        if self.bad_here.iter().any(is_sliver) { None } else { Some(self.bad_here.len()) }
    }
}

/// Triangles that have an edge in common with some of those given, and are none of them.
fn neighbours(mesh: &EditMesh, triangles: &[u32]) -> Vec<u32> {
    let twins = triangles.iter().flat_map(|&t| 3 * t..3 * t + 3).map(|c| mesh.twin[c as usize]);
    let mut found: Vec<u32> = twins.filter(|&c| c != NONE).map(|c| c / 3).collect();
    found.sort_unstable();
    found.dedup();
    found.retain(|t| !triangles.contains(t));
    found
}

/// The first triangles by breadth.
fn around(mesh: &EditMesh, seed: u32, size: usize) -> Vec<u32> {
    let mut found = vec![seed];
    let mut i = 0;
    while i < found.len() && found.len() < size {
        for c in 3 * found[i]..3 * found[i] + 3 {
            let twin = mesh.twin[c as usize];
            if twin != NONE && !found.contains(&(twin / 3)) {
                found.push(twin / 3);
            }
        }
        i += 1;
    }
    found
}
