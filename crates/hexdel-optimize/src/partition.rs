//! Cuts a mesh into parts that can be worked on side by side.
//!
//! A part is a set of triangles; the vertices it shares with others are frozen
//! while it is worked on. Each round cuts elsewhere and in another direction,
//! so that what lies on a seam now lies inside a part next time. Where only a
//! few triangles need work, the parts are the neighbourhoods of these. Cuts
//! depend on the mesh and the round alone, never on the number of threads.

use hexdel_geom::DVec2;

use crate::mesh::{Around, Mesh, Motion, NONE, Soup, Vertices};

/// Triangles in a part, at most. A part's arrays fill the second-level cache;
/// its seam is a tenth of its vertices.
const PART: usize = 4000;

/// Where a range of triangles is cut, in hundredths of its length, in turn
/// from round to round; near the middle but never at the same place.
const CUTS: [usize; 5] = [50, 41, 57, 45, 62];

/// Directions of the cuts, in turn; every other one is perpendicular. Where
/// triangles are much larger than elsewhere, moving a cut along its direction
/// is not enough to part it from the triangle it passes. Pythagorean, so the
/// vectors are as good as exact.
const DIRECTIONS: [DVec2; 7] = [
    DVec2::new(1.0, 0.0),
    DVec2::new(4.0 / 5.0, 3.0 / 5.0),
    DVec2::new(5.0 / 13.0, 12.0 / 13.0),
    DVec2::new(12.0 / 13.0, 5.0 / 13.0),
    DVec2::new(3.0 / 5.0, 4.0 / 5.0),
    DVec2::new(40.0 / 41.0, 9.0 / 41.0),
    DVec2::new(9.0 / 41.0, 40.0 / 41.0),
];

/// Which triangles are worked on, and with which others.
pub(crate) struct Cuts {
    /// The triangles of each part, ascending.
    pub(crate) parts: Vec<Vec<u32>>,
    /// The triangles that nobody works on, ascending.
    rest: Vec<u32>,
}

/// Triangles of one part and what is needed to merge it again.
pub(crate) struct Part {
    pub(crate) mesh: Mesh,
    /// Index in the soup of each vertex of the mesh as it was cut out.
    pub(crate) global: Vec<u32>,
    pub(crate) failed: Vec<u8>,
}

/// Cuts the whole mesh.
pub(crate) fn partition(soup: &Soup, round: usize) -> Cuts {
    Cuts { parts: cut(soup, 0..soup.tris.len() as u32, round), rest: Vec::new() }
}

/// The triangles up to `rings` rings around each of `bad`. Neighbourhoods that
/// touch are one part, unless that gets too large.
pub(crate) fn spots(soup: &Soup, bad: &[u32], rings: usize, round: usize) -> Cuts {
    let mut near = vec![false; soup.pos.len()];
    for &t in bad {
        for v in soup.tris[t as usize] {
            near[v as usize] = true;
        }
    }
    for _ in 1..rings {
        let mut next = near.clone();
        for t in soup.tris.iter().filter(|t| t.iter().any(|v| near[*v as usize])) {
            for &v in t {
                next[v as usize] = true;
            }
        }
        near = next;
    }
    let is_near = |t: &u32| soup.tris[*t as usize].iter().any(|v| near[*v as usize]);
    let (inside, rest): (Vec<u32>, Vec<u32>) = (0..soup.tris.len() as u32).partition(is_near);
    let parts = components(soup, &inside).into_iter().flat_map(|part| cut(soup, part, round)).collect();
    Cuts { parts, rest }
}

/// Triangles that share vertices, directly or through others, together; each
/// set ascending, the sets by their first triangle.
fn components(soup: &Soup, triangles: &[u32]) -> Vec<Vec<u32>> {
    let mut parent: Vec<u32> = (0..soup.pos.len() as u32).collect();
    for &t in triangles {
        let [a, b, c] = soup.tris[t as usize].map(|v| root(&mut parent, v));
        let least = a.min(b).min(c);
        for v in [a, b, c] {
            parent[v as usize] = least;
        }
    }
    let mut index = vec![NONE; soup.pos.len()];
    let mut sets: Vec<Vec<u32>> = Vec::new();
    for &t in triangles {
        let set = root(&mut parent, soup.tris[t as usize][0]) as usize;
        if index[set] == NONE {
            index[set] = sets.len() as u32;
            sets.push(Vec::new());
        }
        sets[index[set] as usize].push(t);
    }
    sets
}

/// The first of the vertices that are known to hang together with `v`.
fn root(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}

/// Halves a set of triangles until the parts are small.
fn cut(soup: &Soup, triangles: impl IntoIterator<Item = u32>, round: usize) -> Vec<Vec<u32>> {
    let axis = DIRECTIONS[round % DIRECTIONS.len()];
    // In the frame of the direction.
    let place = |t: u32| {
        let sum = soup.tris[t as usize].iter().map(|v| soup.pos[*v as usize]).sum::<DVec2>();
        (DVec2::new(axis.dot(sum), axis.perp_dot(sum)), t)
    };
    let mut items: Vec<(DVec2, u32)> = triangles.into_iter().map(place).collect();
    let mut parts = Vec::new();
    halve(&mut items, CUTS[round % CUTS.len()], &mut parts);
    parts
}

/// Halves `items` along their longer extent until the parts are small.
fn halve(items: &mut [(DVec2, u32)], at: usize, parts: &mut Vec<Vec<u32>>) {
    if items.len() <= PART {
        let mut part: Vec<u32> = items.iter().map(|i| i.1).collect();
        part.sort_unstable();
        parts.push(part);
        return;
    }
    let (lo, hi) =
        items.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(l, h), i| (l.min(i.0), h.max(i.0)));
    let wide = hi.x - lo.x >= hi.y - lo.y;
    let key = |p: DVec2| if wide { p.x } else { p.y };
    let middle = items.len() * at / 100;
    items.select_nth_unstable_by(middle, |a, b| key(a.0).total_cmp(&key(b.0)).then(a.1.cmp(&b.1)));
    let (left, right) = items.split_at_mut(middle);
    halve(left, at, parts);
    halve(right, at, parts);
}

/// What the parts need to know of the whole.
pub(crate) struct Seams {
    /// Triangles at each vertex of the soup.
    degree: Vec<u32>,
    /// Whether each vertex of the soup is in more than one part.
    shared: Vec<bool>,
    /// As [`Soup::near`] says.
    near: Vec<bool>,
    /// The vertices that are in no other part, for each part, ascending; the
    /// last list is that of the triangles nobody works on.
    own: Vec<Vec<u32>>,
    /// Where each vertex that is not shared stands in its part's list.
    place: Vec<u32>,
}

impl Seams {
    pub(crate) fn new(soup: &Soup, cuts: &Cuts) -> Self {
        let mut degree = vec![0u32; soup.pos.len()];
        let mut owner = vec![NONE; soup.pos.len()];
        let mut shared = vec![false; soup.pos.len()];
        for (p, part) in cuts.parts.iter().chain([&cuts.rest]).enumerate() {
            for &v in part.iter().flat_map(|&t| &soup.tris[t as usize]) {
                let v = v as usize;
                degree[v] += 1;
                shared[v] |= owner[v] != NONE && owner[v] != p as u32;
                owner[v] = p as u32;
            }
        }
        let mut own = vec![Vec::new(); cuts.parts.len() + 1];
        let mut place = vec![NONE; soup.pos.len()];
        for v in (0..soup.pos.len()).filter(|&v| !shared[v] && owner[v] != NONE) {
            let list: &mut Vec<u32> = &mut own[owner[v] as usize];
            place[v] = list.len() as u32;
            list.push(v as u32);
        }
        Self { degree, shared, own, place, near: soup.near() }
    }
}

/// Cuts part `index` out of the soup: its own vertices, then those on seams.
pub(crate) fn extract(soup: &Soup, seams: &Seams, cuts: &Cuts, index: usize) -> Part {
    let (triangles, own) = (&cuts.parts[index], &seams.own[index]);
    let corners = triangles.iter().flat_map(|&t| soup.tris[t as usize]);
    let mut seam: Vec<u32> = corners.filter(|&v| seams.shared[v as usize]).collect();
    seam.sort_unstable();
    seam.dedup();
    let local = |v: u32| {
        if seams.shared[v as usize] {
            (own.len() + seam.binary_search(&v).expect("every corner was collected")) as u32
        } else {
            seams.place[v as usize]
        }
    };
    let global: Vec<u32> = own.iter().chain(&seam).copied().collect();
    let tris: Vec<[u32; 3]> = triangles.iter().map(|&t| soup.tris[t as usize].map(local)).collect();
    let mut outside: Vec<u32> = global.iter().map(|&v| seams.degree[v as usize]).collect();
    for &v in tris.iter().flatten() {
        outside[v as usize] -= 1;
    }
    let motion = |v: u32| {
        if seams.shared[v as usize] { Motion::Frozen } else { soup.motion[v as usize] }
    };
    let vertices = Vertices {
        pos: global.iter().map(|&v| soup.pos[v as usize]).collect(),
        motion: global.iter().map(|&v| motion(v)).collect(),
        sector: global.iter().map(|&v| soup.sector[v as usize]).collect(),
        outside,
        around: Around {
            source: of(&global, &soup.source),
            near: of(&global, &seams.near),
            lines: soup.lines.clone(),
        },
    };
    let bound: Vec<u8> = triangles.iter().map(|&t| soup.bound[t as usize]).collect();
    let failed = global.iter().map(|&v| soup.failed[v as usize]).collect();
    let mesh = Mesh::build(vertices, &tris, &bound).expect("a part of a manifold is one but for its seam");
    Part { mesh, global, failed }
}

/// The values of some vertices; none where there are none of any.
fn of<T: Copy>(vertices: &[u32], values: &[T]) -> Vec<T> {
    if values.is_empty() { Vec::new() } else { vertices.iter().map(|&v| values[v as usize]).collect() }
}

/// Puts the parts and the rest together again: the vertices that are left keep
/// their order, new ones follow, part by part.
pub(crate) fn merge(soup: &Soup, cuts: &Cuts, parts: &[Part]) -> Soup {
    let mut pos = soup.pos.clone();
    let mut failed = soup.failed.clone();
    let mut dead = vec![false; soup.pos.len()];
    for part in parts {
        for (i, &g) in part.global.iter().enumerate() {
            let g = g as usize;
            dead[g] |= !part.mesh.alive(i as u32);
            if part.mesh.motion[i] == Motion::Frozen {
                failed[g] = failed[g].min(part.failed[i]);
            } else {
                pos[g] = part.mesh.pos[i];
                failed[g] = part.failed[i];
            }
        }
    }
    let mut out = Soup { lines: soup.lines.clone(), ..Soup::default() };
    let mut renamed = vec![NONE; soup.pos.len()];
    for g in (0..soup.pos.len()).filter(|&g| !dead[g]) {
        renamed[g] = out.pos.len() as u32;
        out.push(pos[g], soup.motion[g], soup.sector[g], soup.origin[g], failed[g]);
        out.source.extend(soup.source.get(g));
    }
    for part in parts {
        let old = part.global.len();
        let mut names: Vec<u32> = part.global.iter().map(|&g| renamed[g as usize]).collect();
        for i in old..part.mesh.pos.len() {
            names.push(out.pos.len() as u32);
            if part.mesh.alive(i as u32) {
                out.push(part.mesh.pos[i], part.mesh.motion[i], part.mesh.sector[i], NONE, part.failed[i]);
                if soup.is_constrained() {
                    out.source.push(part.mesh.source(i as u32));
                }
            }
        }
        for tri in part.mesh.live().map(|t| part.mesh.tri[t as usize]) {
            out.tris.push(tri.v.map(|v| names[v as usize]));
            out.bound.push(tri.bound);
        }
    }
    for t in cuts.rest.iter().map(|&t| t as usize) {
        out.tris.push(soup.tris[t].map(|v| renamed[v as usize]));
        out.bound.push(soup.bound[t]);
    }
    out
}

impl Soup {
    fn push(&mut self, pos: DVec2, motion: Motion, sector: f64, origin: u32, failed: u8) {
        self.pos.push(pos);
        self.motion.push(motion);
        self.sector.push(sector);
        self.origin.push(origin);
        self.failed.push(failed);
    }
}
