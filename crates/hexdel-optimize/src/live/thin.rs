//! Removal of what has become superfluous around a change, for as long as that
//! succeeds.

use hexdel_geom::DVec2;

use crate::decimate::{PATIENT, Pass, decimate};
use crate::live::cut::{Cut, rings};
use crate::live::insert::Tools;
use crate::live::store::{Store, Vertex};
use crate::mesh::Motion;

/// Passes over one part, as in batches; what has failed before and has nothing
/// new around is not tried again. A pass of four rings takes half as long
/// again for a hundredth fewer triangles.
const PASSES: [Pass; 2] = [
    Pass { rings: 2, refills: 1, max_cost: 0.5, near: 0.0, patience: PATIENT },
    Pass { rings: 3, refills: 4, max_cost: 0.6, near: 0.01, patience: PATIENT },
];

/// Parts that are worked on after one change, at most: what a removed point
/// leaves coarsens by half with each.
const MOST_PARTS: usize = 24;

/// Rings around a change within which vertices are removed.
const RINGS: usize = 5;

/// The same where many vertices next to each other have changed: each has its
/// own turn.
const RINGS_OF_MANY: usize = 3;

/// Removes vertices around the vertex `at`, which was changed at `p`.
pub(crate) fn thin(store: &mut Store, tools: &Tools, at: u32, p: DVec2) {
    thin_rings(store, tools, at, p, RINGS);
}

fn thin_rings(store: &mut Store, tools: &Tools, mut at: u32, p: DVec2, size: usize) {
    for _ in 0..MOST_PARTS {
        let mut seeds = Vec::new();
        store.around(at, |t| seeds.push(t));
        let cut = Cut::new(store, rings(store, &seeds, size));
        let mut work = tools.work(cut.mesh.clone(), cut.failed.clone());
        work.patient = true;
        let removed: usize = PASSES.into_iter().map(|pass| decimate(&mut work, pass)).sum();
        cut.put_back(store, &work.mesh, &work.failed);
        if removed == 0 {
            break;
        }
        if !store.vertex(at).alive() {
            at = nearest(store, &cut, p).unwrap_or(at);
        }
    }
}

/// Removes vertices wherever that was not tried since `failed` was last
/// cleared, among the slots given.
pub(crate) fn thin_all(store: &mut Store, tools: &Tools, slots: &[u32]) {
    for &v in slots {
        let waits = |v: &Vertex| v.alive() && v.failed == 0 && v.motion != Motion::Fixed;
        if store.vertices.get(v as usize).is_some_and(waits) {
            thin_rings(store, tools, v, store.at(v), RINGS_OF_MANY);
        }
    }
}

/// The vertex of the part that is left nearest to `p`.
fn nearest(store: &Store, cut: &Cut, p: DVec2) -> Option<u32> {
    let alive = cut.vertices.iter().copied().filter(|&v| store.vertex(v).alive());
    alive.min_by(|&a, &b| {
        store.at(a).distance_squared(p).total_cmp(&store.at(b).distance_squared(p)).then(a.cmp(&b))
    })
}
