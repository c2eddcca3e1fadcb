//! Tasks that fill the mesh, each with its part of both arrays.

use super::layout::Layout;
use super::{triangles, vertices};
use hexdel_geom::par::prelude::*;
use hexdel_geom::{DVec2, TriMesh, VertexId};
use hexdel_grid::TileId;
use std::ops::Range;

/// Triangles of one task, about: enough work to be worth handing out, and
/// little enough that its part of the mesh stays in the cache.
const TRIANGLES_PER_TASK: u32 = 1 << 13;

/// Tiles of a level, and the parts of the mesh that they own.
struct Task<'a> {
    level: u8,
    tiles: Range<usize>,
    vertices: &'a mut [[f64; 2]],
    triangles: &'a mut [[u32; 3]],
}

/// Fills the mesh, tile by tile.
pub(super) fn mesh(layout: &Layout) -> TriMesh {
    // Plain numbers, since the system hands out zeroed pages only when they
    // are first written to, here by all threads. Giving them their meaning
    // afterwards moves nothing.
    let mut vertices = vec![[0.0; 2]; layout.vertices() as usize];
    let mut triangles = vec![[0; 3]; layout.triangles() as usize];
    let fill = |task| fill(layout, task);
    tasks(layout, &mut vertices, &mut triangles).into_par_iter().for_each(fill);
    TriMesh {
        vertices: vertices.into_iter().map(|[x, y]| DVec2::new(x, y)).collect(),
        triangles: triangles
            .into_iter()
            .map(|[a, b, c]: [u32; 3]| {
                [VertexId::new(a as usize), VertexId::new(b as usize), VertexId::new(c as usize)]
            })
            .collect(),
    }
}

fn tasks<'a>(
    layout: &Layout,
    mut vertices: &'a mut [[f64; 2]],
    mut triangles: &'a mut [[u32; 3]],
) -> Vec<Task<'a>> {
    let mut tasks = Vec::new();
    for (level, blocks) in layout.levels() {
        let mut first = 0;
        while first < blocks.len() {
            let (mut end, mut owned) = (first, (0, 0));
            while end < blocks.len() && owned.1 < TRIANGLES_PER_TASK {
                owned.0 += blocks[end].vertices.count_ones();
                owned.1 += blocks[end].triangles;
                end += 1;
            }
            tasks.push(Task {
                level,
                tiles: first..end,
                vertices: split_off(&mut vertices, owned.0),
                triangles: split_off(&mut triangles, owned.1),
            });
            first = end;
        }
    }
    tasks
}

/// Takes the first `count` of a slice.
#[expect(clippy::mut_mut, reason = "the slice itself grows shorter")]
fn split_off<'a, T>(slice: &mut &'a mut [T], count: u32) -> &'a mut [T] {
    slice.split_off_mut(..count as usize).expect("tiles own no more than the mesh holds")
}

fn fill(layout: &Layout, task: Task) {
    let Task { level, tiles, mut vertices, mut triangles } = task;
    for id in tiles.map(TileId::new) {
        let block = layout.block(level, id);
        if block.vertices != 0 {
            vertices::fill_tile(layout, level, id, split_off(&mut vertices, block.vertices.count_ones()));
        }
        triangles::fill_tile(layout, level, id, split_off(&mut triangles, block.triangles));
    }
}
