//! Sessions: a copy kept by deltas, and calls that are refused.

use hexdel::Delta;
use hexdel::{DVec2, Outcome, Session, SessionError, SessionMesh, TemplateSession, VertexId};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What tests ask of sessions of both kinds.
pub(crate) trait Calls {
    fn whole(&self) -> SessionMesh;
    fn text(&self) -> String;
}

macro_rules! calls {
    ($session:ty) => {
        impl Calls for $session {
            fn whole(&self) -> SessionMesh {
                self.mesh()
            }

            fn text(&self) -> String {
                self.to_ron().unwrap()
            }
        }
    };
}

calls!(Session);
calls!(TemplateSession);

/// A copy of a mesh that is kept by deltas alone.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Copy {
    pub(crate) vertices: BTreeMap<u64, DVec2>,
    pub(crate) triangles: BTreeMap<u64, [u64; 3]>,
}

impl Copy {
    pub(crate) fn of(session: &impl Calls) -> Self {
        let made = session.whole();
        let serial = |t: &[VertexId; 3]| t.map(|v| made.vertex_serials[v.index()]);
        Self {
            vertices: made.vertex_serials.iter().copied().zip(made.mesh.vertices.clone()).collect(),
            triangles: made
                .triangle_serials
                .iter()
                .copied()
                .zip(made.mesh.triangles.iter().map(serial))
                .collect(),
        }
    }

    pub(crate) fn follow(&mut self, delta: &Delta) {
        for t in &delta.triangles_removed {
            assert!(self.triangles.remove(t).is_some(), "triangle {t} was not there");
        }
        for v in &delta.vertices_removed {
            assert!(self.vertices.remove(v).is_some(), "vertex {v} was not there");
        }
        for &(v, at) in &delta.vertices_added {
            assert!(self.vertices.insert(v, at).is_none(), "vertex {v} was there");
        }
        for &(v, at) in &delta.vertices_moved {
            assert!(self.vertices.insert(v, at).is_some_and(|old| old != at), "vertex {v} did not move");
        }
        for &(t, corners) in &delta.triangles_added {
            assert!(self.triangles.insert(t, corners).is_none(), "triangle {t} was there");
        }
    }
}

/// Counts what random calls come to. A test in which all are refused tests nothing.
pub(crate) struct Tally {
    done: AtomicUsize,
    refused: AtomicUsize,
}

/// Calls from which on a share is no chance.
const MANY_CALLS: usize = 40;

impl Tally {
    pub(crate) const fn new() -> Self {
        Self { done: AtomicUsize::new(0), refused: AtomicUsize::new(0) }
    }

    /// Notes a call; half of all calls so far must have been done.
    #[track_caller]
    pub(crate) fn note<T>(&self, call: &Result<T, SessionError>) {
        let count = if call.is_ok() { &self.done } else { &self.refused };
        count.fetch_add(1, Ordering::Relaxed);
        let [done, refused] = [&self.done, &self.refused].map(|n| n.load(Ordering::Relaxed));
        assert!(done + refused < MANY_CALLS || done >= refused, "{done} calls done, {refused} refused");
    }
}

/// Asserts that a call is refused and has changed nothing.
#[track_caller]
pub(crate) fn refused<S: Calls>(
    session: &mut S,
    call: impl FnOnce(&mut S) -> Result<Outcome, SessionError>,
) -> SessionError {
    let before = session.text();
    let error = call(session).expect_err("the call is refused");
    assert_eq!(session.text(), before, "after {error}");
    error
}
