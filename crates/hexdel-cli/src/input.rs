//! Reading points, and saying what of a file is left out.

use crate::exit::{Failure, warn};
use hexdel::DVec2;
use std::path::Path;

/// The points of a file. Warns of anything else in it, which is not meshed.
pub(crate) fn read_points(path: &Path) -> Result<Vec<DVec2>, Failure> {
    let graph = hexdel_io::read_points(path)?;
    let others =
        [(graph.segments.len(), "segments"), (graph.holes.len(), "holes"), (graph.regions.len(), "regions")];
    let ignored: Vec<String> = others
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    if !ignored.is_empty() {
        let ignored = ignored.join(", ");
        warn(&format!("{}: only points are used so far; ignored: {ignored}", path.display()));
    }
    Ok(graph.points)
}
