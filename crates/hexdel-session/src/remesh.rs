//! All points meshed anew, where changes nearby do not suffice.

use super::{Before, Frame, Outcome, PointId, Session, SessionError, Undo};
use hexdel_geom::DVec2;
use hexdel_mesher::Error;
use hexdel_mesher::Size;
use hexdel_mesher::Triangulation;
use hexdel_mesher::for_sessions::MAX_COORDINATE;
use hexdel_mesher::for_sessions::Names;
use hexdel_optimize::live::LiveMesh;
use hexdel_optimize::{Sizing, VertexKind, kinds_of};
use hexdel_pslg::Feature;
use std::sync::Arc;

/// Up to so many points, when one of so many has changed, the mesh is compared with one made
/// at once, which takes about a millisecond for each point.
const COMPARED: [(usize, usize); 3] = [(64, 32), (256, 8), (1024, 2)];

/// The one made at once is taken if there are so many times its triangles.
const MORE: f64 = 1.05;

impl Session {
    /// Meshes all points anew, with more, in a larger domain where this one has too little room and grows.
    pub(super) fn insert_by_remeshing(&mut self, points: &[DVec2]) -> Result<Outcome, SessionError> {
        let anew = self.insert_anew(points, self.radius);
        self.or_in_larger_domain(anew, points)
    }

    /// What meshing anew has come to; where this domain has too little room and grows, what it comes to in a larger one.
    pub(super) fn or_in_larger_domain(
        &mut self,
        anew: Result<Outcome, SessionError>,
        points: &[DVec2],
    ) -> Result<Outcome, SessionError> {
        match anew {
            Err(SessionError::Mesh(Error::DomainTooSmall { least, .. })) if self.grows => {
                self.insert_by_growing(points, least.max(2.0 * self.radius))
            }
            outcome => outcome,
        }
    }

    /// Meshes all points anew, with more, in a domain of this radius.
    pub(super) fn insert_anew(&mut self, points: &[DVec2], radius: f64) -> Result<Outcome, SessionError> {
        let (ids, mut all) = self.present();
        for &at in points {
            if !at.is_finite() {
                return Err(SessionError::NotFinite { at });
            }
        }
        all.extend_from_slice(points);
        let first = self.points.len() as u64;
        let ids: Vec<PointId> = ids.into_iter().chain((first..).map(PointId).take(points.len())).collect();
        self.remesh(&ids, &all, radius, self.size.clone())
    }

    /// Meshes all points anew, with more, in a domain at least as large as said.
    pub(super) fn insert_by_growing(
        &mut self,
        points: &[DVec2],
        radius: f64,
    ) -> Result<Outcome, SessionError> {
        let reach = self.centre.abs().max_element() + radius;
        if reach >= MAX_COORDINATE {
            return Err(SessionError::InvalidDomain { centre: self.centre, radius });
        }
        self.insert_anew(points, radius)
    }

    /// Meshes the PSLG anew, with more points, one of which found no room.
    pub(super) fn insert_by_remeshing_graph(
        &mut self,
        frame: &Frame,
        points: &[DVec2],
        at: DVec2,
    ) -> Result<Outcome, SessionError> {
        if let Some(&at) = points.iter().find(|p| !p.is_finite()) {
            return Err(SessionError::NotFinite { at });
        }
        let anew = self.anew_with_segments(frame, points).map_err(|error| match error {
            // Its bounds do not hold either, or there is no such mesh.
            SessionError::NotCertified { .. } | SessionError::Mesh(Error::Pslg(_) | Error::Segments(_)) => {
                SessionError::NoRoom { at }
            }
            error => error,
        })?;
        Ok(self.replace_graph(anew))
    }

    /// Puts another mesh of the PSLG in the place of this one.
    pub(super) fn replace_graph(&mut self, anew: Self) -> Outcome {
        let slots = anew.of_slot.into_iter().map(|(slot, id)| (id, slot)).collect();
        self.replace((anew.live, anew.frame), slots, self.radius, self.size.clone())
    }

    /// Points and their places.
    pub(super) fn present(&self) -> (Vec<PointId>, Vec<DVec2>) {
        self.points().unzip()
    }

    /// Meshes points anew: those that are there and new ones.
    pub(super) fn remesh(
        &mut self,
        ids: &[PointId],
        points: &[DVec2],
        radius: f64,
        size: Option<Size>,
    ) -> Result<Outcome, SessionError> {
        let (live, slots) = self.made_at_once(ids, points, radius, size.as_ref())?;
        Ok(self.replace((live, None), slots, radius, size))
    }

    /// The mesh of points made at once, and their slots.
    fn made_at_once(
        &self,
        ids: &[PointId],
        points: &[DVec2],
        radius: f64,
        size: Option<&Size>,
    ) -> Result<(LiveMesh, Vec<(PointId, u32)>), SessionError> {
        if points.is_empty() {
            let mut empty = Self::empty(self.centre, radius)?;
            empty.bounds = self.bounds;
            empty.set_size(size.cloned())?;
            return Ok((empty.live, Vec::new()));
        }
        let mesher = self.options.clone().bounds(self.bounds);
        let mesher = mesher.around(self.centre, radius);
        let mesher = size.iter().fold(mesher, |m, s| m.size((*s).clone()));
        // Points that are gone have numbers, too.
        let named = |p: usize| Feature::Point(ids[p].0 as usize);
        let names = Names { point: &named, segment: &Feature::Segment };
        let made = mesher.triangulate(points).map_err(|error| names.of_mesh(error))?;
        let inputs = made.input_of_vertex();
        for (i, v) in made.vertex_of_input.iter().enumerate() {
            if let Some(first) = inputs[v.index()].filter(|&first| first as usize != i) {
                return Err(SessionError::Duplicate { at: points[i], of: ids[first as usize] });
            }
        }
        let kinds = kinds(&made);
        let slots = made.vertex_of_input.iter().map(|v| v.index() as u32);
        let slots = ids.iter().copied().zip(slots).collect();
        let mut live =
            LiveMesh::new(made.mesh, &kinds, self.bounds).map_err(hexdel_mesher::Error::Optimize)?;
        live.assume_sizing(size.map(|s| Arc::new(s.clone()) as Arc<dyn Sizing>));
        Ok((live, slots))
    }

    /// After a call that has changed the points and not ended: the same by a mesh made at
    /// once, if so many have changed that this is in proportion and it has many triangles
    /// fewer, or if the call has left edges too short that it has not. `was_short` is whether
    /// there were such before or they are not asked for. `abandon` takes the call back.
    pub(super) fn improved(
        &mut self,
        changed: usize,
        was_short: bool,
        abandon: impl FnOnce(&mut Self),
    ) -> Option<Outcome> {
        self.changed += changed;
        let points = self.of_slot.len();
        let share = COMPARED.into_iter().find(|c| points <= c.0)?.1;
        if self.frame.is_some() || self.drafts {
            return None;
        }
        let too_short = !was_short && self.is_short(&self.live);
        let many = self.changed * share >= points;
        if !too_short && !many {
            return None;
        }
        self.changed = 0;
        let (ids, points) = self.present();
        let (live, slots) = self.made_at_once(&ids, &points, self.radius, self.size.as_ref()).ok()?;
        let fewer = self.live.counts()[1] as f64 > MORE * live.counts()[1] as f64;
        let better = fewer || too_short && !self.is_short(&live);
        if !better {
            return None;
        }
        abandon(self);
        Some(self.replace((live, None), slots, self.radius, self.size.clone()))
    }

    /// Whether there are edges too short already, or too many points to ask.
    pub(super) fn was_short(&self) -> bool {
        let small = self.frame.is_none() && self.of_slot.len() <= COMPARED[COMPARED.len() - 1].0;
        !small || self.is_short(&self.live)
    }

    /// Puts another mesh of points in the place of this one.
    fn replace(
        &mut self,
        (live, frame): (LiveMesh, Option<Arc<Frame>>),
        slots: Vec<(PointId, u32)>,
        radius: f64,
        size: Option<Size>,
    ) -> Outcome {
        let before = self.points.len();
        let (old, delta) = self.live.replace_by(live);
        let frame = std::mem::replace(&mut self.frame, frame);
        let mut points: Vec<Option<u32>> = vec![None; before];
        for &(id, slot) in &slots {
            let i = id.0 as usize;
            points.resize(points.len().max(i + 1), None);
            points[i] = Some(slot);
        }
        let olds = self.points.iter().copied().chain(std::iter::repeat(None));
        let undo = olds.take(points.len()).enumerate().map(|(i, s)| (PointId(i as u64), s)).collect();
        self.points = points;
        self.of_slot = slots.into_iter().map(|(id, slot)| (slot, id)).collect();
        let domain = (radius != self.radius).then_some((self.centre, radius));
        let olds = (std::mem::replace(&mut self.size, size), std::mem::replace(&mut self.radius, radius));
        let changed = std::mem::take(&mut self.changed);
        self.push(Undo {
            mesh: Before::Whole(Box::new(old), frame),
            points: undo,
            size: olds.0,
            radius: olds.1,
            changed,
        });
        let points = (before..self.points.len()).map(|i| PointId(i as u64)).collect();
        Outcome { points, delta, remeshed: true, domain }
    }
}

/// What the vertices of a mesh may do.
pub(super) fn kinds(made: &Triangulation) -> Vec<VertexKind> {
    let mut fixed = vec![false; made.mesh.vertices.len()];
    for v in &made.vertex_of_input {
        fixed[v.index()] = true;
    }
    kinds_of(&made.mesh, |v| fixed[v.index()])
}
