//! A mesh with as few Steiner points as a search finds.

use super::{Mesher, RIGHT_DEG};
use crate::error::PslgError;
use crate::grown::{Grown, fewest};
use crate::options::{Deadline, Options};
use crate::result::PslgMesh;
use crate::rings::count_rings;
use crate::validate::Validated;
use hexdel_geom::Monitor;
use hexdel_optimize::{Effort, Sizing};

/// The largest lower bound that is searched with, degrees.
const SEARCHED_DEG: f64 = 40.0;

/// The part of the time that a search may take: what is left is for the other ways if it finds nothing.
const SHARE: f64 = 0.75;

/// The mesh that a search finds. None where that is not asked for, where there are sizes or other bounds away from
/// segments, of which the search does not know, and where nothing that it found holds.
pub(super) fn searched(
    input: &Validated,
    options: &Options,
    size: Option<&dyn Sizing>,
    deadline: &Deadline,
    monitor: &dyn Monitor,
) -> Result<Option<PslgMesh>, PslgError> {
    let is_known = options.near == options.far
        && options.near.max_deg() >= RIGHT_DEG
        && options.near.min_deg() <= SEARCHED_DEG
        && size.is_none();
    if options.compact != Some(Effort::Fewest) || !is_known {
        return Ok(None);
    }
    let mesher = Mesher::new(input, options, None, deadline, false);
    if mesher.limits.is_some() { Ok(None) } else { mesher.fewest(monitor) }
}

/// Whether a mesh has fewer Steiner points than points were given, so that removals from a finer one will not come near.
pub(super) fn is_sparse(made: &PslgMesh, input: &Validated) -> bool {
    made.mesh.vertices.len() <= 2 * input.points.sites().len()
}

impl Mesher<'_> {
    fn fewest(&self, monitor: &dyn Monitor) -> Result<Option<PslgMesh>, PslgError> {
        let mut options = hexdel_grow::Options::new(self.options.near.min_deg());
        options.deadline = self.deadline.share(SHARE);
        let found = fewest(
            &self.scene,
            &self.input.pslg,
            self.options.extent,
            self.grown_corners(),
            &options,
            monitor,
        )?;
        let Some(Grown { mut net, left }) = found else { return Ok(None) };
        count_rings(&mut net);
        if left.iter().any(|&t| self.judge().is_out(&net, t)) {
            return Ok(None);
        }
        let made = self.finished(net, 0, monitor)?;
        Ok(made.holds().then_some(made))
    }
}
