//! Points and segments go into a mesh that knows nothing of them.
//!
//! Points become vertices; segments are divided by the mesh's own size, with
//! equal distances from a point on all segments that end there; free vertices
//! too close to either are taken out; edges that are still missing are flipped
//! into place. What comes out is a valid mesh with every segment in it, whose
//! angles are for the optimiser to mend.

use crate::error::PslgError;
use crate::fans::{self, Scene};
use crate::field::Field;
use crate::geometry::distance_sq;
use crate::net::{Kind, NONE, Net};
use crate::validate::{Piece, spatial_order};
use hexdel_geom::DVec2;
use hexdel_geom::monitor::{Cancelled, Monitor, check};

/// A free vertex must keep this many local sizes away from points and
/// segments: between half of an equilateral triangle's height, where deleting
/// it leaves gaps too wide, and most of it, where flat triangles stay. From
/// 0.45 to 0.7 all values work alike.
const CLEARANCE: f64 = 0.55;

/// Embeds sites and pieces into a mesh that covers them with room to spare.
pub(crate) fn embed(mut net: Net, scene: &Scene, monitor: &dyn Monitor) -> Result<Net, PslgError> {
    let field = Field::of(&net);
    let (sites, pieces) = (&scene.sites, &scene.pieces);
    net.soft = Some(scene.soft);
    net.lines = pieces.iter().map(|p| p.ends.map(|s| sites[s as usize])).collect();
    let mut embedder = Embedder { net, field, sizes: Vec::new(), chains: Vec::new(), links: Vec::new() };
    let vertex_of_site = embedder.insert_sites(sites, monitor)?;
    embedder.divide(scene, &vertex_of_site, monitor)?;
    for fan in &scene.fans {
        fans::empty(&mut embedder.net, vertex_of_site[fan.site as usize], fan.radius);
    }
    embedder.clear(monitor)?;
    embedder.connect(pieces, monitor)?;
    Ok(embedder.net)
}

struct Embedder {
    net: Net,
    field: Field,
    /// The field's size at each vertex.
    sizes: Vec<f64>,
    /// The vertices along each piece, ends included.
    chains: Vec<Vec<u32>>,
    /// Neighbours of each vertex along pieces.
    links: Vec<Vec<u32>>,
}

impl Embedder {
    fn insert_sites(&mut self, sites: &[DVec2], monitor: &dyn Monitor) -> Result<Vec<u32>, Cancelled> {
        let mut vertex_of_site = vec![NONE; sites.len()];
        let (mut hint, mut place) = (NONE, NONE);
        self.sizes = (0..self.net.vertex_count()).map(|v| self.field.at_vertex(v)).collect();
        for (done, site) in spatial_order(sites).into_iter().enumerate() {
            ask(monitor, done)?;
            let p = sites[site as usize];
            let v = self.net.insert(p, Kind::Site(site), hint).expect("the domain holds all sites");
            let size;
            (size, place) = self.field.at(p, place);
            self.note_size(v, size);
            hint = self.net.some_triangle(v);
            vertex_of_site[site as usize] = v;
        }
        Ok(vertex_of_site)
    }

    fn note_size(&mut self, v: u32, size: f64) {
        if v as usize >= self.sizes.len() {
            self.sizes.resize(v as usize + 1, size);
        }
        self.sizes[v as usize] = size;
    }

    /// Inserts vertices along all pieces.
    fn divide(
        &mut self,
        scene: &Scene,
        vertex_of_site: &[u32],
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let mut place = NONE;
        for (i, piece) in scene.pieces.iter().enumerate() {
            let [a, b] = piece.ends.map(|s| vertex_of_site[s as usize]);
            if scene.whole[i] {
                self.chains.push(vec![a, b]);
                continue;
            }
            let [from, to] = piece.ends.map(|s| scene.sites[s as usize]);
            // Every walk begins where the last one ended: along the piece, from its start.
            let mut near = self.field.at(from, place).1;
            let profile = self.field.profile(from, to, near);
            place = profile.hint;
            let radii = [a, b].map(|v| self.sizes[v as usize]);
            let mut chain = vec![a];
            let mut hint = self.net.some_triangle(a);
            for (done, arc) in divisions(&profile, radii).into_iter().enumerate() {
                ask(monitor, done)?;
                let t = arc / profile.length();
                let kind = Kind::Along { piece: i as u32, t };
                let at = self.net.along(i as u32, t);
                let v = self.net.insert(at, kind, hint).expect("the domain holds all segments");
                // A vertex that is there already belongs to something else.
                if self.net.vertex(v).kind != kind {
                    continue;
                }
                let size;
                (size, near) = self.field.at(at, near);
                self.note_size(v, size);
                hint = self.net.some_triangle(v);
                chain.push(v);
            }
            chain.push(b);
            self.chains.push(chain);
        }
        self.links = vec![Vec::new(); self.net.vertex_count() as usize];
        for pair in self.chains.iter().flat_map(|chain| chain.windows(2)) {
            self.links[pair[0] as usize].push(pair[1]);
            self.links[pair[1] as usize].push(pair[0]);
        }
        check(monitor)
    }

    /// Takes out free vertices that are too close to points or segments.
    fn clear(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let bound = |v: &u32| matches!(self.net.vertex(*v).kind, Kind::Site(_) | Kind::Along { .. });
        let mut stack: Vec<u32> = (0..self.net.vertex_count()).rev().filter(bound).collect();
        let (mut star, mut again) = (Vec::new(), Vec::new());
        let mut done = 0;
        while let Some(s) = stack.pop() {
            ask(monitor, done)?;
            done += 1;
            self.net.star(s, &mut star);
            let near = star.iter().flat_map(|&t| self.net.tri(t).v).find(|&v| self.is_too_close(v, s));
            let Some(v) = near else { continue };
            again.clear();
            self.net.star(v, &mut star);
            again.extend(star.iter().flat_map(|&t| self.net.tri(t).v));
            if self.net.remove(v) {
                again.retain(|&w| matches!(self.net.vertex(w).kind, Kind::Site(_) | Kind::Along { .. }));
                again.sort_unstable();
                again.dedup();
                stack.extend(&again);
            }
        }
        check(monitor)
    }

    fn is_too_close(&self, v: u32, s: u32) -> bool {
        if self.net.vertex(v).kind != Kind::Free {
            return false;
        }
        let least = CLEARANCE * self.sizes[v as usize].min(self.sizes[s as usize]);
        let (p, q) = (self.net.at(v), self.net.at(s));
        p.distance_squared(q) < least * least
            || self.links[s as usize].iter().any(|&n| distance_sq(p, q, self.net.at(n)) < least * least)
    }

    /// Makes all links edges, and marks them.
    fn connect(&mut self, pieces: &[Piece], monitor: &dyn Monitor) -> Result<(), PslgError> {
        for (i, piece) in pieces.iter().enumerate() {
            ask(monitor, i)?;
            let chain = std::mem::take(&mut self.chains[i]);
            for pair in chain.windows(2) {
                let linked = self.net.link(pair[0], pair[1], i as u32);
                linked.map_err(|at| PslgError::NotRecovered { item: piece.feature(), at })?;
            }
        }
        Ok(())
    }
}

/// Items between two questions whether to stop.
const BETWEEN_QUESTIONS: usize = 1024;

/// Asks the monitor now and then.
pub(crate) fn ask(monitor: &dyn Monitor, done: usize) -> Result<(), Cancelled> {
    if done.is_multiple_of(BETWEEN_QUESTIONS) { check(monitor) } else { Ok(()) }
}

/// The arc lengths at which a segment is divided: at the radii of its ends, and
/// in between evenly by the field.
fn divisions(profile: &crate::field::Profile, radii: [f64; 2]) -> Vec<f64> {
    let total = profile.total();
    if total < 1.5 {
        return Vec::new();
    }
    if total < 2.5 {
        return vec![profile.arc_at(0.5 * total)];
    }
    let length = profile.length();
    let (first, last) = (radii[0].min(0.5 * length), (length - radii[1]).max(0.5 * length));
    let [from, to] = [first, last].map(|arc| profile.count_at(arc));
    if to - from < 0.5 {
        return vec![0.5 * (first + last)];
    }
    let gaps = (to - from).round().max(1.0);
    let inner = (1..gaps as u32).map(|i| profile.arc_at(from + (to - from) * f64::from(i) / gaps));
    std::iter::once(first).chain(inner).chain([last]).collect()
}
