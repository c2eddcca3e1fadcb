//! The state of a live mesh as plain data, to be written and read.

use hexdel_geom::{AngleBounds, DVec2, TriMesh, VertexId};
use thiserror::Error;

use crate::constraints::{Constraints, Line, NOWHERE, POINT};
use crate::error::OptimizeError;
use crate::import::import;
use crate::live::store::{Serials, Store, Triangle, Vertex};
use crate::live::verify::Bounds;
use crate::live::{LiveMesh, cut};
use crate::mesh::{Motion, NONE, Soup};
use crate::options::VertexKind;

/// All that a [`LiveMesh`] depends on, but for its sizing.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LiveState {
    bounds: AngleBounds,
    /// Serial numbers given out last, of vertices and of triangles.
    serials: (u64, u64),
    /// Free slots in the order in which they became free.
    free_vertices: Vec<u32>,
    free_triangles: Vec<u32>,
    vertices: Vec<Option<VertexState>>,
    /// Serial number and corners.
    triangles: Vec<Option<(u64, [u32; 3])>>,
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    segments: Option<SegmentState>,
}

/// What a mesh with segments has besides.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct SegmentState {
    near: AngleBounds,
    /// Ends of each.
    lines: Vec<[DVec2; 2]>,
    /// Pairs without room between them.
    wedges: Vec<[usize; 2]>,
    /// Slots of the vertices between the ends of each.
    on: Vec<Vec<u32>>,
    /// Slots of fixed vertices that count as segments do.
    points: Vec<u32>,
    /// Sides on segments, as slots of their ends.
    edges: Vec<[u32; 2]>,
}

/// Serial number, position, kind, angle of the domain, a triangle at the
/// vertex, size of the patches in which its removal failed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct VertexState(u64, DVec2, Kind, f64, u32, u8);

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Kind {
    Fixed,
    Along(DVec2),
    Free,
}

/// Why data are no state of a live mesh.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StateError {
    /// A slot holds what it cannot hold.
    #[error("{what} {slot} is inconsistent")]
    Slot {
        /// Vertex or triangle.
        what: &'static str,
        /// The slot.
        slot: usize,
    },
    /// The lists of free slots are not those of the free slots.
    #[error("the list of free slots of {what} is inconsistent")]
    FreeList {
        /// Vertices or triangles.
        what: &'static str,
    },
    /// The triangles make no mesh.
    #[error(transparent)]
    Mesh(#[from] OptimizeError),
}

/// How far the angle of the domain at a vertex may be from what its
/// neighbours say, radians: they slide along rounded sides.
const SECTOR_TOLERANCE: f64 = 1e-6;

impl LiveMesh {
    /// The state as data.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn state(&self) -> LiveState {
        let store = &self.store;
        let vertex = |v: &Vertex| {
            let kind = match v.motion {
                Motion::Fixed | Motion::Frozen => Kind::Fixed,
                Motion::Along(d) => Kind::Along(d),
                Motion::Free | Motion::On(_) => Kind::Free,
            };
            v.alive().then_some(VertexState(v.serial, v.at, kind, v.sector, v.anchor, v.failed))
        };
        LiveState {
            bounds: self.bounds.far,
            serials: (store.serials.vertex, store.serials.triangle),
            free_vertices: store.free_vertices.clone(),
            free_triangles: store.free_triangles.clone(),
            vertices: store.vertices.iter().map(vertex).collect(),
            triangles: store.triangles.iter().map(|t| t.alive().then_some((t.serial, t.v))).collect(),
            segments: store.constrained.then(|| self.segment_state()),
        }
    }

    fn segment_state(&self) -> SegmentState {
        let store = &self.store;
        let mut on = vec![Vec::new(); store.lines.len()];
        for v in store.live_vertices() {
            if let Some(line) = store.line_of_vertex(v) {
                on[line as usize].push(v);
            }
        }
        let wedge = |(i, line): (usize, &Line)| {
            let after = |&&j: &&u32| j as usize > i;
            line.wedges.iter().filter(after).map(|&j| [i, j as usize]).collect::<Vec<_>>()
        };
        let edges = self.bound_sides().into_iter().map(|(t, k)| store.triangle(t).side(k));
        SegmentState {
            near: self.bounds.near,
            lines: store.lines.iter().map(|line| line.ends).collect(),
            wedges: store.lines.iter().enumerate().flat_map(wedge).collect(),
            on,
            points: store.live_vertices().filter(|&v| store.vertex(v).source == POINT).collect(),
            edges: edges.collect(),
        }
    }

    /// The live mesh of a state, without sizing. Whether it is within its
    /// bounds is not checked.
    ///
    /// # Errors
    ///
    /// [`StateError`] for data that are no state.
    pub fn restore(state: LiveState) -> Result<Self, StateError> {
        check_list(&state.free_vertices, &state.vertices, "vertices")?;
        check_list(&state.free_triangles, &state.triangles, "triangles")?;
        let vertices = state.vertices.iter().flatten().map(|v| v.0);
        check_serials(vertices, state.serials.0, "vertices")?;
        let triangles = state.triangles.iter().flatten().map(|t| t.0);
        check_serials(triangles, state.serials.1, "triangles")?;
        let soup = check_mesh(&state)?;
        let serials = Serials { vertex: state.serials.0, triangle: state.serials.1 };
        let (mut live, mut bound) = (0.., soup.bound.iter());
        let mut vertex = |v: VertexState| {
            let i: usize = live.next().unwrap_or_default();
            let VertexState(serial, at, _, sector, anchor, failed) = v;
            let source = soup.source.get(i).copied().unwrap_or(NOWHERE);
            Vertex { at, motion: soup.motion[i], sector, anchor, failed, source, serial }
        };
        let vertices = state.vertices.iter().map(|v| v.map_or(Vertex::FREE, &mut vertex)).collect();
        let mut triangle = |(serial, v)| {
            let bound = bound.next().copied().unwrap_or_default();
            Triangle { v, n: [NONE; 3], bound, serial }
        };
        let triangles = state.triangles.iter().map(|t| t.map_or(Triangle::FREE, &mut triangle)).collect();
        let free = [state.free_vertices, state.free_triangles];
        let mut store = Store::of(vertices, triangles, free, serials);
        (store.constrained, store.lines) = (soup.is_constrained(), soup.lines.clone());
        let all: Vec<u32> = store.live_triangles().collect();
        cut::link(&mut store, &all, &[]);
        store.take_journal();
        let near = state.segments.map_or(state.bounds, |s| s.near);
        Ok(Self::of(store, Bounds { near, far: state.bounds }))
    }
}

fn check_list<T>(free: &[u32], slots: &[Option<T>], what: &'static str) -> Result<(), StateError> {
    let mut listed: Vec<u32> = free.to_vec();
    listed.sort_unstable();
    let empty = (0..slots.len() as u32).filter(|&i| slots[i as usize].is_none());
    if listed.into_iter().eq(empty) { Ok(()) } else { Err(StateError::FreeList { what }) }
}

fn check_serials(
    serials: impl Iterator<Item = u64>,
    last: u64,
    what: &'static str,
) -> Result<(), StateError> {
    let mut all: Vec<u64> = serials.collect();
    all.sort_unstable();
    let twice = all.windows(2).find(|w| w[0] == w[1]).map(|w| w[0]);
    let beyond = all.iter().copied().find(|&s| s == 0 || s > last);
    match twice.or(beyond) {
        Some(serial) => Err(StateError::Slot { what, slot: serial as usize }),
        None => Ok(()),
    }
}

/// Checks topology, kinds, sectors, anchors and segments; returns live vertices
/// and triangles in order.
fn check_mesh(state: &LiveState) -> Result<Soup, StateError> {
    let mut name = vec![VertexId::new(0); state.vertices.len()];
    let live: Vec<usize> = (0..name.len()).filter(|&v| state.vertices[v].is_some()).collect();
    for (i, &v) in live.iter().enumerate() {
        name[v] = VertexId::new(i);
    }
    for (slot, t) in state.triangles.iter().enumerate() {
        let alive = |v: u32| state.vertices.get(v as usize).is_some_and(Option::is_some);
        if t.is_some_and(|(_, v)| !v.into_iter().all(alive)) {
            return Err(StateError::Slot { what: "triangle", slot });
        }
    }
    let mut kinds: Vec<VertexKind> = state.vertices.iter().flatten().map(kind).collect();
    let mesh = TriMesh {
        vertices: state.vertices.iter().flatten().map(|v| v.1).collect(),
        triangles: state.triangles.iter().flatten().map(|t| t.1.map(|v| name[v as usize])).collect(),
    };
    let soup = match &state.segments {
        None => import(mesh, &kinds, None)?,
        Some(segments) => {
            let constraints = segments.constraints(state, &name)?;
            let on = segments.on(state, &name)?;
            for &(v, line) in &on {
                if kinds[v] == VertexKind::Free {
                    kinds[v] = VertexKind::OnSegment(line);
                }
            }
            let mut soup = import(mesh, &kinds, Some(&constraints))?;
            for (v, line) in on {
                soup.source[v] = line as u32;
            }
            soup
        }
    };
    for (i, &slot) in live.iter().enumerate() {
        let VertexState(_, _, _, sector, anchor, _) = state.vertices[slot].expect("listed as live");
        let anchored = state.triangles.get(anchor as usize).copied().flatten();
        let holds = anchored.is_some_and(|(_, v)| v.contains(&(slot as u32)));
        let off = (sector - soup.sector[i]).abs();
        if !holds || off.is_nan() || off > SECTOR_TOLERANCE {
            return Err(StateError::Slot { what: "vertex", slot });
        }
    }
    Ok(soup)
}

fn kind(v: &VertexState) -> VertexKind {
    match v.2 {
        Kind::Fixed => VertexKind::Fixed,
        Kind::Along(d) => VertexKind::Sliding(d),
        Kind::Free => VertexKind::Free,
    }
}

impl SegmentState {
    /// What is kept, by the names of vertices.
    fn constraints(&self, state: &LiveState, name: &[VertexId]) -> Result<Constraints<'static>, StateError> {
        let named = |slot: u32| vertex_in(state, slot).map(|_| name[slot as usize]);
        if let Some(line) = self.lines.iter().position(|[a, b]| !(a.is_finite() && b.is_finite() && a != b)) {
            return Err(StateError::Slot { what: "segment", slot: line });
        }
        let edges: Result<Vec<[VertexId; 2]>, StateError> =
            self.edges.iter().map(|&[a, b]| Ok([named(a)?, named(b)?])).collect();
        Ok(Constraints {
            segments: self.lines.clone(),
            edges: edges?,
            points: self.points.iter().map(|&slot| named(slot)).collect::<Result<_, _>>()?,
            near: self.near,
            wedges: self.wedges.clone(),
            ..Constraints::default()
        })
    }

    /// Vertices between the ends of segments, and which.
    fn on(&self, state: &LiveState, name: &[VertexId]) -> Result<Vec<(usize, usize)>, StateError> {
        let mut all = Vec::new();
        for (i, (slots, &ends)) in self.on.iter().zip(&self.lines).enumerate() {
            let line = Line::new(ends);
            for &slot in slots {
                let vertex = vertex_in(state, slot)?;
                if matches!(vertex.2, Kind::Along(_)) || !line.holds(vertex.1) {
                    return Err(StateError::Slot { what: "vertex", slot: slot as usize });
                }
                all.push((name[slot as usize].index(), i));
            }
        }
        Ok(all)
    }
}

fn vertex_in(state: &LiveState, slot: u32) -> Result<VertexState, StateError> {
    let vertex = state.vertices.get(slot as usize).copied().flatten();
    vertex.ok_or(StateError::Slot { what: "vertex", slot: slot as usize })
}
