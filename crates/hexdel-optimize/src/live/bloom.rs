//! A few triangles made room in: each gets a vertex in its middle, and the edges
//! between them are exchanged for those between the middles.
//!
//! Edges become shorter by a factor of the root of three (Kobbelt, "Sqrt(3)-subdivision",
//! 2000). On the outline each vertex has one triangle more and each new one has five:
//! degrees that take less repair than the halved triangles around those cut in four
//! (`refine`). Sides of the rim and on segments are not divided, so that regions end
//! before them.

use hexdel_geom::DVec2;

use crate::live::cut::Cut;
use crate::live::insert::Tools;
use crate::mesh::{Mesh, Motion, NONE};
use crate::repair::{Step, repair};
use crate::work::Work;

/// What settles three of four regions. The others take several times as long, and
/// another region is settled sooner.
const STEPS: [Step; 3] = [
    Step::Search { changes: 5, rings: 2, wide: false },
    Step::Move { rings: 3 },
    Step::Search { changes: 20, rings: 3, wide: false },
];

/// The part with the triangles that `inner` marks made room in, and as many angles within the bounds again as
/// is reached soon; none where a side would have to be divided.
pub(crate) fn refine<'a>(cut: &Cut, tools: &'a Tools, inner: &[bool]) -> Option<Work<'a>> {
    let mut mesh = cut.mesh.clone();
    let region: Vec<u32> = (0..inner.len() as u32).filter(|&t| inner[t as usize]).collect();
    bloom(&mut mesh, &region)?;
    let mut work = tools.free_work(mesh, cut.failed.clone());
    for step in STEPS {
        repair(&mut work, step);
        if work.bad().is_empty() {
            break;
        }
    }
    Some(work)
}

/// Makes room in a region, in ascending order; none, and nothing done, where it ends at
/// a side that would have to be divided.
fn bloom(mesh: &mut Mesh, region: &[u32]) -> Option<()> {
    let is_inside = |n: u32| region.binary_search(&n).is_ok();
    let ends = |&t: &u32| mesh.tri[t as usize].bound != 0 || mesh.tri[t as usize].n.contains(&NONE);
    if region.iter().any(ends) {
        return None;
    }
    let mut middles = Vec::with_capacity(region.len());
    for &t in region {
        let at = mesh.tri[t as usize].v.map(|v| mesh.pos[v as usize]).into_iter().sum::<DVec2>() / 3.0;
        middles.push(mesh.add_vertex(at, Motion::Free, std::f64::consts::TAU));
    }
    let middle = |t: u32| region.binary_search(&t).map_or(NONE, |i| middles[i]);
    let mut new = Vec::with_capacity(3 * region.len());
    for &t in region {
        let tri = mesh.tri[t as usize];
        for k in 0..3 {
            let (a, b, n) = (tri.v[(k + 1) % 3], tri.v[(k + 2) % 3], tri.n[k]);
            // Each of two triangles at an edge makes the one at its own first end.
            new.push(if is_inside(n) { [a, middle(n), middle(t)] } else { [a, b, middle(t)] });
        }
    }
    mesh.replace(region, &new, &mut Vec::new());
    mesh.commit();
    Some(())
}
