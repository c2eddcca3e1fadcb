//! Sizes from files: rasters, and tables of points with a size each.

use crate::exit::Failure;
use hexdel::Size;
use std::path::Path;

/// A size with what a file adds: a raster (`.asc`), or a text table of points,
/// `x y size` in each line.
pub(crate) fn size_of_file(size: Size, path: &Path) -> Result<Size, Failure> {
    let of_size = |source| Failure::Size { file: path.display().to_string(), source };
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("asc")) {
        let raster = hexdel_io::read_raster(path)?;
        return size.and_raster(&raster).map_err(of_size);
    }
    let points = hexdel_io::read_sizes(path)?;
    size.and_points(&points).map_err(of_size)
}
