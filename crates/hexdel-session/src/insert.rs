//! Points put in: by changes nearby, by meshing all anew, or in a larger domain.

use super::domain::reaching;
use super::{Outcome, PointId, Session, SessionError};
use hexdel_geom::DVec2;
use hexdel_optimize::live::{LiveError, LiveMesh};

/// From so many new points on, and as many as there are, the whole is meshed
/// anew: point by point takes ten times as long.
const BATCH: usize = 64;

/// A way to make room for a point.
type Insert = fn(&mut LiveMesh, DVec2) -> Result<u32, LiveError>;

/// Why a point was not put in.
enum Refused {
    Error(SessionError),
    /// Nothing nearby made room for it.
    NoRoom {
        at: DVec2,
    },
}

impl From<SessionError> for Refused {
    fn from(error: SessionError) -> Self {
        Self::Error(error)
    }
}

impl Session {
    /// Puts a point in.
    ///
    /// # Errors
    ///
    /// As [`insert_all`](Self::insert_all).
    pub fn insert(&mut self, point: DVec2) -> Result<Outcome, SessionError> {
        self.insert_all(&[point])
    }

    /// Puts points in, all or none.
    ///
    /// # Errors
    ///
    /// [`SessionError`] for a point that is not finite, outside of a domain that does not
    /// [grow](Self::growing), there already or too close to another, or for which there is no room within the bounds.
    ///
    /// # Complexity
    ///
    /// For each point in proportion to the triangles that it changes; where
    /// changes nearby do not suffice, or there are more new points than
    /// points, the whole is meshed anew. Without segments, the mesh of up to 1,024 points is
    /// compared with one made at once now and then, and meshed anew if that is smaller: of up to
    /// 32 points after every call, of up to 64 after every other, of up to 256 when an eighth
    /// has changed, then half.
    pub fn insert_all(&mut self, points: &[DVec2]) -> Result<Outcome, SessionError> {
        let before = self.points.len();
        let present = self.of_slot.len();
        if self.grows
            && !self.drafts
            && self.frame.is_none()
            && let Some(radius) = reaching((self.centre, self.radius), points)
        {
            return self.insert_by_growing(points, radius);
        }
        if self.frame.is_none() && !self.drafts && points.len() >= BATCH && points.len() >= present {
            return self.insert_by_remeshing(points);
        }
        match self.insert_nearby(points, LiveMesh::insert_soon) {
            Err(Refused::NoRoom { at }) if self.drafts => return Err(SessionError::NoRoom { at }),
            Err(Refused::NoRoom { at }) => return self.insert_with_changes_elsewhere(points, at),
            Err(Refused::Error(error)) => return Err(error),
            Ok(()) => {}
        }
        Ok(self.inserted(before))
    }

    /// Puts points in for which changes nearby did not soon make room: meshes all anew and, where that fails, searches
    /// on nearby, then in a larger domain.
    fn insert_with_changes_elsewhere(
        &mut self,
        points: &[DVec2],
        at: DVec2,
    ) -> Result<Outcome, SessionError> {
        let before = self.points.len();
        let anew = match self.frame.clone() {
            Some(frame) => self.insert_by_remeshing_graph(&frame, points, at),
            None => self.insert_anew(points, self.radius),
        };
        if anew.is_err() && self.insert_nearby(points, LiveMesh::insert).is_ok() {
            return Ok(self.inserted(before));
        }
        self.or_in_larger_domain(anew, points)
    }

    /// What the points beyond `before`, which are in, have come to.
    fn inserted(&mut self, before: usize) -> Outcome {
        let (changed, new) = (self.changed, self.points.len() - before);
        let outcome = self.improved(new, true, |session| session.abandon(before)).unwrap_or_else(|| {
            let undo = (before..self.points.len()).map(|i| (PointId(i as u64), None)).collect();
            self.done(before, undo, self.size.clone())
        });
        self.counting_from(changed, outcome)
    }

    /// Puts points in by changes nearby, all or none.
    fn insert_nearby(&mut self, points: &[DVec2], insert: Insert) -> Result<(), Refused> {
        let before = self.points.len();
        let put = points.iter().try_for_each(|&at| self.insert_one(at, insert));
        if put.is_err() {
            self.abandon(before);
        }
        put
    }

    fn insert_one(&mut self, at: DVec2, insert: Insert) -> Result<(), Refused> {
        self.check_point(at)?;
        let id = PointId(self.points.len() as u64);
        let slot = match insert(&mut self.live, at) {
            Ok(slot) => slot,
            Err(LiveError::Occupied { slot, .. }) => match self.of_slot.get(&slot) {
                Some(&of) => return Err(SessionError::Duplicate { at, of }.into()),
                // A corner of the domain that is no point yet.
                None => slot,
            },
            Err(LiveError::Outside { .. }) if self.frame.is_some() => {
                return Err(SessionError::NotCovered { at }.into());
            }
            Err(LiveError::Outside { .. }) => {
                return Err(SessionError::Outside { at, radius: self.radius }.into());
            }
            Err(_) => return Err(Refused::NoRoom { at }),
        };
        self.points.push(Some(slot));
        self.of_slot.insert(slot, id);
        Ok(())
    }
}
