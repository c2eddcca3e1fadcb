//! Coarsening where single removals are stuck: many vertices go at once, and
//! the part is repaired.
//!
//! What an insertion has refined is graded, level by level, and jammed: no vertex
//! can go alone. Without most of its vertices a part is far outside the bounds,
//! but so is the coarse start of any mesh, and repair finds its way from there.

use hexdel_geom::DVec2;

use crate::decimate::drop_vertex;
use crate::live::cut::{Cut, rings};
use crate::live::insert::{Tools, repair_rounds};
use crate::live::store::Store;
use crate::mesh::Motion;
use crate::sizing::triangle_fits;
use crate::work::Work;

/// Rings whose vertices go, in the order of trying.
const INNER: [usize; 6] = [5, 4, 3, 2, 1, 0];

/// Rings around those that may move.
const MARGIN: usize = 3;

/// Where and how often it is tried.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Try {
    /// Vertices that may go for each that may not, at least.
    pub(crate) excess: usize,
    /// Attempts, at most.
    pub(crate) most: usize,
}

/// A compact mesh has four or five vertices for each point: with twelve, nine of
/// ten attempts succeed, and with ordinary points around none is made.
pub(crate) const USUAL: Try = Try { excess: 12, most: INNER.len() };

/// Where the removal of a point has left next to all that it had brought. Most
/// attempts fail, and take some tens of times a removal.
pub(crate) const STUCK: Try = Try { excess: 6, most: 2 };

/// Takes out vertices around the vertex nearest to `p` of triangle `t` and repairs
/// what is left, if there are fewer triangles then.
pub(crate) fn coarsen(store: &mut Store, tools: &Tools, (t, p): (u32, DVec2), how: Try) -> bool {
    let corners = store.triangle(t).v;
    let distance = |v: &u32| store.at(*v).distance_squared(p);
    let nearest = corners.into_iter().min_by(|v, w| distance(v).total_cmp(&distance(w)));
    let mut seeds = Vec::new();
    store.around(nearest.unwrap_or(corners[0]), |t| seeds.push(t));
    let fine = INNER.into_iter().map(|inner| rings(store, &seeds, inner));
    let fine: Vec<Vec<u32>> = fine.filter(|inside| is_fine(store, inside, how.excess)).collect();
    fine.iter().take(how.most).any(|inside| {
        let cut = Cut::new(store, rings(store, inside, MARGIN));
        let Some(work) = coarsened(store, tools, &cut, inside) else { return false };
        cut.put_back(store, &work.mesh, &work.failed);
        true
    })
}

/// Whether triangles have many more vertices that may go than points would need.
fn is_fine(store: &Store, triangles: &[u32], excess: usize) -> bool {
    let mut vertices: Vec<u32> = triangles.iter().flat_map(|&t| store.triangle(t).v).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let fixed = vertices.iter().filter(|&&v| store.vertex(v).motion == Motion::Fixed).count();
    vertices.len() - fixed >= excess * (fixed + 1)
}

/// The part without what can go of the vertices of triangles `inside`, repaired.
fn coarsened<'a>(store: &Store, tools: &'a Tools, cut: &Cut, inside: &[u32]) -> Option<Work<'a>> {
    let mut work = tools.work(cut.mesh.clone(), cut.failed.clone());
    let mut gone: Vec<(f64, u32)> = inside
        .iter()
        .flat_map(|&t| store.triangle(t).v)
        .map(|v| cut.local_vertex(v))
        .filter(|&v| !work.mesh.is_fixed(v))
        .map(|v| (work.mesh.shortest_edge(v), v))
        .collect();
    gone.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    gone.dedup();
    for (_, v) in gone {
        drop_vertex(&mut work, v);
    }
    let before = cut.triangles.len();
    if work.mesh.live().count() >= before || !repair_rounds(&mut work) {
        return None;
    }
    let corners = |t: u32| work.mesh.tri[t as usize].v.map(|v| work.mesh.pos[v as usize]);
    let fits = |t: u32| tools.sizing.as_deref().is_none_or(|s| triangle_fits(s, corners(t)));
    let fewer = work.mesh.live().count() < before;
    (fewer && work.mesh.live().all(fits) && cut.keeps_disk(&work.mesh)).then_some(work)
}
