//! What is new in a mesh of templates, with the triangles around it: made
//! Delaunay where rounding spoilt that, and certified.

use super::cells::{Cells, Fresh, Replaced, place};
use hexdel_classify::KeptDual;
use hexdel_geom::delaunay::restore_constrained_delaunay;
use hexdel_geom::{
    AngleBounds, CertifyOptions, DVec2, TriMesh, VertexId, Violation, certify, settle_rounding,
};
use hexdel_grid::TileId;
use hexdel_refine::Refiner;
use std::collections::{BTreeMap, BTreeSet};

/// No triangle.
const NONE: u32 = u32::MAX;

/// The triangles of some tiles, and which of them meet at a vertex.
struct Patch<'a> {
    refiner: &'a Refiner,
    dual: &'a KeptDual,
    cells: &'a Cells,
    /// For each page met so far where its heads are.
    pages: BTreeMap<u32, usize>,
    /// For each name of those pages the last corner there: `3 t + k`.
    heads: Vec<[u32; KeptDual::PAGE as usize]>,
    /// For each corner another one at the same vertex.
    next: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    /// Tiles around which all triangles have been gathered.
    surrounded: BTreeSet<(u8, TileId)>,
    /// Pages whose triangles have been gathered.
    gathered: BTreeSet<u32>,
}

impl<'a> Patch<'a> {
    fn new(refiner: &'a Refiner, dual: &'a KeptDual, cells: &'a Cells) -> Self {
        Self {
            refiner,
            dual,
            cells,
            pages: BTreeMap::new(),
            heads: Vec::new(),
            next: Vec::new(),
            triangles: Vec::new(),
            surrounded: BTreeSet::new(),
            gathered: BTreeSet::new(),
        }
    }

    fn head(&mut self, name: u32) -> &mut u32 {
        let heads = self.heads.len();
        let i = *self.pages.entry(name / KeptDual::PAGE).or_insert(heads);
        if i == heads {
            self.heads.push([NONE; KeptDual::PAGE as usize]);
        }
        &mut self.heads[i][(name % KeptDual::PAGE) as usize]
    }

    /// Gathers all triangles with a corner in a tile: tiles around it own them,
    /// and those around the tile one level coarser.
    fn surround(&mut self, tile: (u8, TileId)) {
        if !self.surrounded.insert(tile) {
            return;
        }
        let (tiles, (level, id)) = (self.refiner.grid().tiles(), tile);
        let coarser = tiles.parent(level, id).map(|(parent, _)| (level - 1, parent));
        for (level, id) in [Some(tile), coarser].into_iter().flatten() {
            for owner in tiles.around(level, id) {
                if let Some(page) = self.dual.page(level, owner) {
                    self.gather(page);
                }
            }
        }
    }

    fn gather(&mut self, page: u32) {
        let Some(cell) = self.cells.cell(page).filter(|_| self.gathered.insert(page)) else {
            return;
        };
        for t in &cell.triangles {
            for (k, name) in t.corners.into_iter().enumerate() {
                let corner = (3 * self.triangles.len() + k) as u32;
                let before = std::mem::replace(self.head(name), corner);
                self.next.push(before);
            }
            self.triangles.push(t.corners);
        }
    }

    /// The triangles with a corner at one of the vertices, ascending.
    fn around(&mut self, names: &BTreeSet<u32>) -> Vec<u32> {
        let mut found = Vec::new();
        for &name in names {
            self.surround(self.dual.tile_of(name / KeptDual::PAGE));
            let mut corner = *self.head(name);
            while corner != NONE {
                found.push(corner / 3);
                corner = self.next[corner as usize];
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    fn corners(&self, triangles: &[u32]) -> BTreeSet<u32> {
        triangles.iter().flat_map(|&t| self.triangles[t as usize]).collect()
    }

    /// Triangles as a mesh of their own, with the names of its vertices: both in
    /// the order of tiles in the plane. None if a corner is no vertex.
    fn mesh_of(&self, triangles: &[u32]) -> Option<(TriMesh, Vec<u32>)> {
        let mut pages: Vec<u32> = self.pages.keys().copied().collect();
        pages.sort_unstable_by_key(|&page| place(self.refiner, self.dual.tile_of(page)));
        let mut rank = BTreeMap::new();
        for (i, page) in (0_u32..).zip(pages) {
            rank.insert(page, i);
        }
        let ordered = |name: u32| rank[&(name / KeptDual::PAGE)] * KeptDual::PAGE + name % KeptDual::PAGE;
        let mut names: Vec<(u32, u32)> =
            triangles.iter().flat_map(|&t| self.triangles[t as usize]).map(|n| (ordered(n), n)).collect();
        names.sort_unstable();
        names.dedup();
        let index = |name: u32| names.binary_search_by_key(&ordered(name), |n| n.0).map(VertexId::new);
        let mut mesh = TriMesh::default();
        for &(_, name) in &names {
            mesh.vertices.push(self.cells.vertex(name)?.0);
        }
        for &t in triangles {
            let [a, b, c] = self.triangles[t as usize].map(index);
            mesh.triangles.push([a.ok()?, b.ok()?, c.ok()?]);
        }
        // The order of gathering depends on the names of pages.
        mesh.triangles.sort_unstable();
        Some((mesh, names.into_iter().map(|n| n.1).collect()))
    }

    /// Whether each side of the new triangles has exactly one triangle beyond
    /// it, or is part of the rim.
    fn is_closed(&self, fresh: &[u32]) -> bool {
        fresh.iter().all(|&t| {
            let [a, b, c] = self.triangles[t as usize];
            [[a, b], [b, c], [c, a]].into_iter().all(|[from, to]| {
                let beyond = self.with_side([to, from]);
                let on_rim = |name| is_on_rim(self.refiner, self.dual, name);
                beyond == 1 || beyond == 0 && on_rim(from) && on_rim(to)
            })
        })
    }

    /// How many triangles have a side in this direction.
    fn with_side(&self, [from, to]: [u32; 2]) -> usize {
        let Some(&heads) = self.pages.get(&(from / KeptDual::PAGE)) else {
            return 0;
        };
        let (mut count, mut corner) = (0, self.heads[heads][(from % KeptDual::PAGE) as usize]);
        while corner != NONE {
            let (t, k) = (corner as usize / 3, corner as usize % 3);
            count += usize::from(self.triangles[t][(k + 1) % 3] == to);
            corner = self.next[corner as usize];
        }
        count
    }
}

/// Whether a vertex may be moved: it is no point, and not on the rim.
pub(super) fn is_free(refiner: &Refiner, dual: &KeptDual, name: u32) -> bool {
    let (level, id) = dual.tile_of(name / KeptDual::PAGE);
    let marks = refiner.grid().tiles().get(level, id).marks;
    (marks[0] | marks[1]) >> (name % KeptDual::PAGE) & 1 == 0 && !is_on_rim(refiner, dual, name)
}

fn is_on_rim(refiner: &Refiner, dual: &KeptDual, name: u32) -> bool {
    let (at, domain) = (dual.address(refiner.grid(), name), dual.domain());
    at.level == domain.base_level && at.hex.norm() == u64::from(domain.radius)
}

/// Makes what is new Delaunay and certifies it with all that touches it. False
/// if it does not hold; then some vertices may have been moved.
pub(super) fn settle(
    refiner: &Refiner,
    dual: &KeptDual,
    cells: &mut Cells,
    fresh: &Fresh,
    replaced: &mut Replaced,
) -> bool {
    match settled(refiner, dual, cells, fresh) {
        Some(moves) => {
            for (name, to) in moves {
                cells.displace(name, to, replaced);
            }
            true
        }
        None => false,
    }
}

/// The vertices that must be moved; none if no moves help.
fn settled(refiner: &Refiner, dual: &KeptDual, cells: &Cells, fresh: &Fresh) -> Option<Vec<(u32, DVec2)>> {
    let bounds = AngleBounds::EXTENDED;
    let mut patch = Patch::new(refiner, dual, cells);
    let moved: BTreeSet<u32> = fresh.moved.iter().copied().collect();
    let mut changed: BTreeSet<u32> = fresh.triangles.iter().flatten().copied().collect();
    let around_moved = patch.around(&moved);
    changed.extend(patch.corners(&around_moved));
    if changed.is_empty() {
        return Some(Vec::new());
    }
    let inner = patch.around(&changed);
    let complete = patch.corners(&inner);
    let outer = patch.around(&complete);
    if !patch.is_closed(&inner) {
        return None;
    }
    let (mut mesh, names) = patch.mesh_of(&outer)?;
    let before = mesh.vertices.clone();
    let free = |v: VertexId| {
        let name = names[v.index()];
        changed.contains(&name) && is_free(refiner, dual, name)
    };
    settle_rounding(&mut mesh, bounds, free);
    restore_constrained_delaunay(&mut mesh, bounds, free, |_| false).ok()?;
    let options =
        CertifyOptions { bounds, require_disk: false, max_violations: usize::MAX, ..Default::default() };
    let certificate = certify(&mesh, &options);
    let excused = |violation: &Violation| match violation {
        // Where the patch ends, triangles may meet at a vertex only.
        Violation::BranchingVertex { vertex, .. } => !complete.contains(&names[vertex.index()]),
        _ => false,
    };
    if !certificate.violations.iter().all(excused) {
        return None;
    }
    let moves = names.into_iter().zip(mesh.vertices).zip(before);
    Some(moves.filter(|((_, now), was)| now != was).map(|(moved, _)| moved).collect())
}
