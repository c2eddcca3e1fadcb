//! `--crs`: the coordinate system that files are told.
//!
//! Nothing is projected: coordinates stay as they are.

use crate::exit::{Failure, unused};
use hexdel_io::{DualFormat, MeshFormat};

/// The number of a code like `EPSG:25832`.
pub(crate) fn epsg(text: &str) -> Result<u16, String> {
    let number = text.split_once(':').filter(|(authority, _)| authority.eq_ignore_ascii_case("EPSG"));
    let number = number.and_then(|(_, number)| number.parse().ok()).filter(|&number: &u16| number > 0);
    number.ok_or_else(|| "must be a code like EPSG:25832".to_owned())
}

/// An error if a system is given and none of the outputs holds one.
pub(crate) fn refuse_unused(
    crs: Option<u16>,
    meshes: impl IntoIterator<Item = Option<MeshFormat>>,
    duals: impl IntoIterator<Item = Option<DualFormat>>,
) -> Result<(), Failure> {
    let held = meshes.into_iter().flatten().any(MeshFormat::holds_crs)
        || duals.into_iter().flatten().any(DualFormat::holds_crs);
    if crs.is_some() && !held {
        return unused("--crs", "it is for .geojson and .nc, and no output is one");
    }
    Ok(())
}
