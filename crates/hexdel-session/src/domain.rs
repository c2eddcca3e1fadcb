//! Hexagons as domains: what is inside, and how far they grow.

use super::Session;
use hexdel_geom::DVec2;
use hexdel_mesher::for_sessions::MAX_COORDINATE;

/// How far from the centre points may be after growing, in parts of the way to the rim.
const ROOM: f64 = 0.75;

impl Session {
    /// Whether the domain grows by itself for points outside of it, which is not so unless it
    /// was said. That of a PSLG does not.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Session};
    /// let mut session = Session::new(&[DVec2::ZERO, DVec2::X], &Mesher::new())?.growing(true);
    /// let far = session.insert(DVec2::new(9.0, 7.0))?;
    /// let (_, radius) = far.domain.unwrap();
    /// assert!(radius > 11.0 && session.certificate().holds());
    /// # Ok::<(), hexdel::SessionError>(())
    /// ```
    #[must_use]
    pub fn growing(mut self, grows: bool) -> Self {
        self.grows = grows;
        self
    }
}

/// The radius of a domain doubled until points outside of it have room in it; none if
/// there are none. Points that are not finite are left to others.
pub(super) fn reaching((centre, radius): (DVec2, f64), points: &[DVec2]) -> Option<f64> {
    let finite = || points.iter().filter(|p| p.is_finite()).map(|&p| p - centre);
    if finite().all(|p| is_inside(p, radius)) {
        return None;
    }
    let mut wanted = 2.0 * radius;
    while wanted < MAX_COORDINATE && !finite().all(|p| is_inside(p, ROOM * wanted)) {
        wanted *= 2.0;
    }
    Some(wanted)
}

/// Whether a place is inside of the hexagon with corners east and west.
pub(super) fn is_inside(from_centre: DVec2, radius: f64) -> bool {
    let height = 0.5 * 3_f64.sqrt();
    let (x, y) = (from_centre.x.abs(), from_centre.y.abs());
    y < height * radius && height * x + 0.5 * y < height * radius
}
