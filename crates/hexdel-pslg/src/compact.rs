//! Fewer triangles under the same bounds: vertices go as long as every angle
//! near what is left keeps its bounds.
//!
//! The work is that of `hexdel-optimize`; here a net becomes a mesh with
//! constraints, and a net again.

use crate::error::PslgError;
use crate::geometry::fraction;
use crate::judge::Judge;
use crate::limits::Limits;
use crate::net::{Kind, NONE, Net};
use crate::options::Deadline;
use crate::rings::count_rings;
use crate::sectors::Sectors;
use crate::validate::Piece;
use hexdel_geom::{DVec2, Monitor, TriMesh, VertexId};
use hexdel_optimize::{
    Constraints, Effort, OptimizeError, Optimized, Options, VertexKind, kinds_of, optimize_constrained,
};
use rustc_hash::FxHashMap;

/// What the mesh must keep.
pub(crate) struct Kept<'a> {
    pub(crate) pieces: &'a [Piece],
    pub(crate) sectors: &'a Sectors,
    pub(crate) judge: Judge<'a>,
    pub(crate) limits: Option<&'a Limits<'a>>,
    /// Whether right angles near segments are to go, too.
    pub(crate) strict: bool,
    /// Whether vertices are only taken out of a net that keeps its bounds.
    pub(crate) bounds_first: bool,
    /// A pass of removals that takes less than one triangle of so many is the last; 0 is for all passes.
    pub(crate) worth: usize,
    pub(crate) deadline: &'a Deadline,
}

/// Takes vertices out of a net. It stays as it was if more triangles would be
/// out of bounds in the end.
pub(crate) fn compact(
    net: Net,
    kept: &Kept<'_>,
    effort: Effort,
    monitor: &dyn Monitor,
) -> Result<Net, PslgError> {
    let taken = Taken::of(&net);
    let limit = |p: DVec2| kept.limits.map_or(f64::INFINITY, |limits| limits.area_at(p));
    let hopeless = |corners: [DVec2; 3]| kept.sectors.near(corners).is_some_and(|(s, _)| s.is_hopeless());
    let constraints = Constraints {
        segments: net.lines.clone(),
        edges: taken.edges.clone(),
        points: taken.sites(),
        near: kept.judge.near,
        strict: kept.strict,
        wedges: kept.sectors.wedge_pairs().iter().map(|pair| pair.map(|p| p as usize)).collect(),
        hopeless: Some(&hopeless),
        max_area: kept.limits.filter(|limits| limits.limits_areas()).map(|_| &limit as _),
        sizing: kept.limits.and_then(Limits::size),
    };
    let mut options = Options::new(kept.judge.far, effort);
    options.budget = kept.deadline.left();
    options.bounds_first = kept.bounds_first;
    options.worth = kept.worth;
    let mesh = taken.mesh.clone();
    let made = match optimize_constrained(mesh, &taken.vertex_kinds(), &constraints, &options, monitor) {
        Ok(made) => made,
        Err(OptimizeError::Unreached { best, .. }) => *best,
        Err(OptimizeError::Cancelled(c)) => return Err(c.into()),
        // Nothing else is refused of a net that keeps its invariants.
        Err(error) => return Err(PslgError::Refused(Box::new(error))),
    };
    if !made.finished {
        kept.deadline.spend();
    }
    let mut compacted = taken.rebuild(&net, &made, kept.pieces);
    count_rings(&mut compacted);
    let bad = |net: &Net| net.alive().filter(|&t| kept.judge.is_out(net, t)).count();
    Ok(if bad(&compacted) <= bad(&net) { compacted } else { net })
}

/// A net as a mesh.
struct Taken {
    mesh: TriMesh,
    /// By vertex of the mesh.
    kinds: Vec<Kind>,
    /// Edges that are part of a piece.
    edges: Vec<[VertexId; 2]>,
}

impl Taken {
    fn of(net: &Net) -> Self {
        let mut ids = vec![NONE; net.vertex_count() as usize];
        let mut taken = Self { mesh: TriMesh::default(), kinds: Vec::new(), edges: Vec::new() };
        for v in (0..net.vertex_count()).filter(|&v| net.vertex(v).kind != Kind::Gone) {
            ids[v as usize] = taken.kinds.len() as u32;
            taken.kinds.push(net.vertex(v).kind);
            taken.mesh.vertices.push(net.at(v));
        }
        let id = |v: u32| VertexId::new(ids[v as usize] as usize);
        for t in net.alive() {
            let tri = net.tri(t);
            taken.mesh.triangles.push(tri.v.map(id));
            for i in (0..3).filter(|&i| tri.s[i] != NONE && (tri.n[i] == NONE || tri.n[i] > t)) {
                taken.edges.push(tri.edge(i).map(id));
            }
        }
        taken
    }

    fn sites(&self) -> Vec<VertexId> {
        let is_site = |&v: &usize| matches!(self.kinds[v], Kind::Site(_));
        (0..self.kinds.len()).filter(is_site).map(VertexId::new).collect()
    }

    fn vertex_kinds(&self) -> Vec<VertexKind> {
        // Those on the sides of the hexagon slide.
        let bound = |v: VertexId| matches!(self.kinds[v.index()], Kind::Site(_) | Kind::Along { .. });
        let outline = kinds_of(&self.mesh, bound);
        let kind = |(kind, outline): (&Kind, VertexKind)| match *kind {
            Kind::Along { piece, .. } => VertexKind::OnSegment(piece as usize),
            Kind::Free => VertexKind::Free,
            _ => outline,
        };
        self.kinds.iter().zip(outline).map(kind).collect()
    }

    /// The net of an optimised mesh.
    fn rebuild(&self, before: &Net, made: &Optimized, pieces: &[Piece]) -> Net {
        let mut net = Net::of(&made.mesh);
        net.lines.clone_from(&before.lines);
        net.soft = before.soft;
        for (v, kind) in made.kinds.iter().enumerate() {
            let at = made.mesh.vertices[v];
            let kind = match *kind {
                VertexKind::OnSegment(piece) => {
                    Kind::Along { piece: piece as u32, t: fraction(before.lines[piece], at) }
                }
                VertexKind::Free => Kind::Free,
                _ => Kind::Rim,
            };
            net.move_to(v as u32, at, kind);
        }
        for (kind, now) in self.kinds.iter().zip(&made.vertices) {
            if let (Kind::Site(_), Some(now)) = (kind, now) {
                net.move_to(now.index() as u32, net.at(now.index() as u32), *kind);
            }
        }
        let whole: FxHashMap<[u32; 2], u32> = pieces.iter().map(|p| sorted(p.ends)).zip(0..).collect();
        for edge in &made.edges {
            let [a, b] = edge.map(|v| v.index() as u32);
            let piece = match [a, b].map(|v| net.vertex(v).kind) {
                [Kind::Along { piece, .. }, _] | [_, Kind::Along { piece, .. }] => Some(piece),
                [Kind::Site(a), Kind::Site(b)] => whole.get(&sorted([a, b])).copied(),
                _ => None,
            };
            net.constrain(a, b, piece.expect("an edge of a piece has a vertex on it or is all of it"));
        }
        net
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
