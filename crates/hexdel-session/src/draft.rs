//! Changes for the time being, while a point is dragged.

use super::Session;

impl Session {
    /// Whether calls from now on make drafts: they do what bounds and sizes ask for and no more,
    /// in a fraction of the time. Vertices that become superfluous stay, and nothing is meshed
    /// anew: a point outside of the domain or without room is refused. For what follows a pointer:
    /// [`undo`](Self::undo) the drafts, then make the call that counts.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Session, generate};
    /// let points = generate::generate(generate::Kind::Uniform, 50, 1);
    /// let mut session = Session::new(&points, &Mesher::new())?;
    /// session.draft(true);
    /// for x in [0.4, 0.5, 0.6] {
    ///     if session.insert(DVec2::new(x, 0.5)).is_ok() {
    ///         assert!(session.certificate().holds());
    ///         session.undo()?;
    ///     }
    /// }
    /// session.draft(false);
    /// session.insert(DVec2::new(0.6, 0.5))?;
    /// # Ok::<(), hexdel::SessionError>(())
    /// ```
    pub fn draft(&mut self, drafts: bool) {
        self.drafts = drafts;
        self.live.draft(drafts);
    }
}
