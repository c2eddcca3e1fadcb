//! What can go wrong when a file is written.

use std::io;

use hexdel_geom::PslgLayoutError;
use thiserror::Error;

/// Why a file was not written.
///
/// A file of that name from before, if any, is untouched.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The system refused.
    #[error("{file}: {source}")]
    Io {
        /// The file.
        file: String,
        /// What the system says.
        source: io::Error,
    },
    /// The file name does not tell a format that can be written here.
    #[error("{file}: unknown extension, expected one of {known}")]
    UnknownExtension {
        /// The file.
        file: String,
        /// The extensions that can be written.
        known: &'static str,
    },
    /// Something other than a plain file has the name, a directory or a device.
    #[error("{file}: not a plain file, will not be replaced")]
    NotAFile {
        /// The path.
        file: String,
    },
    /// The format takes two files, but one stream was given.
    #[error("{file}: the format {format} takes two files")]
    TwoFiles {
        /// The name of the stream.
        file: String,
        /// The format.
        format: &'static str,
    },
    /// The format is read only.
    #[error("{file}: the format {format} is read, not written")]
    ReadOnly {
        /// The file.
        file: String,
        /// The format.
        format: &'static str,
    },
    /// The format has no way to write a number.
    #[error("{file}: {item} {index} is {found}, which {format} cannot hold")]
    Unrepresentable {
        /// The file.
        file: String,
        /// The format.
        format: &'static str,
        /// "attribute", "region" or "height".
        item: &'static str,
        /// Its position in the array.
        index: usize,
        /// The number.
        found: f64,
    },
    /// The format knows areas by holes and regions only.
    #[error("{file}: the format holds no polygons, only holes and regions")]
    Polygons {
        /// The file.
        file: String,
    },
    /// The format knows areas by polygons only.
    #[error("{file}: the format has polygons, not {item}")]
    Seeds {
        /// The file.
        file: String,
        /// "holes" or "regions".
        item: &'static str,
    },
    /// A ring of a polygon is no path that ends where it begins.
    #[error("{file}: a ring of polygon {polygon} is not one closed path")]
    Ring {
        /// The file.
        file: String,
        /// The polygon.
        polygon: usize,
    },
    /// The format does not hold segments, holes or regions.
    #[error("{file}: the format holds points only, not {item}")]
    PointsOnly {
        /// The file.
        file: String,
        /// What would be lost.
        item: &'static str,
    },
    /// A coordinate is infinite or not a number.
    #[error("{file}: {item} {index} at ({x}, {y}) is not finite")]
    NonFinite {
        /// The file.
        file: String,
        /// "point", "vertex", "hole" or "region".
        item: &'static str,
        /// Its index.
        index: usize,
        /// Its coordinates.
        x: f64,
        /// Its coordinates.
        y: f64,
    },
    /// A triangle or edge refers to something that is not there.
    #[error("{file}: {item} {index} refers to number {target} of {count}")]
    IndexOutOfRange {
        /// The file.
        file: String,
        /// "triangle", "edge" or "segment".
        item: &'static str,
        /// Its index.
        index: usize,
        /// The vertex it names.
        target: usize,
        /// How many vertices there are.
        count: usize,
    },
    /// The arrays of the PSLG do not fit together.
    #[error("{file}: {source}")]
    Layout {
        /// The file.
        file: String,
        /// Which do not.
        source: PslgLayoutError,
    },
    /// A picture cannot be drawn as wanted, with the feature `plot`.
    #[cfg(feature = "plot")]
    #[error("{file}: {source}")]
    Picture {
        /// The file.
        file: String,
        /// Why.
        source: hexdel_plot::PlotError,
    },
    /// The format has no meshes without triangles, or without vertices.
    #[error("{file}: {format} cannot hold a mesh without {item}")]
    Empty {
        /// The file.
        file: String,
        /// The format.
        format: &'static str,
        /// "vertices" or "triangles".
        item: &'static str,
    },
    /// There are more items than the format has numbers for.
    #[error("{file}: {format} cannot hold {count} {item}, it ends at {limit}")]
    TooMany {
        /// The file.
        file: String,
        /// The format.
        format: &'static str,
        /// "vertices" or "triangles".
        item: &'static str,
        /// How many there are.
        count: usize,
        /// How many it can hold.
        limit: usize,
    },
    /// An array has neither one entry per item nor none.
    #[error("{file}: {found} {array} instead of {expected}")]
    Length {
        /// The file.
        file: String,
        /// What the array holds.
        array: &'static str,
        /// The length that would fit.
        expected: usize,
        /// The length it has.
        found: usize,
    },
}

impl WriteError {
    /// The same of a file by another name, as that of a draft is not to be told.
    #[must_use]
    pub fn renamed(mut self, name: &str) -> Self {
        match &mut self {
            #[cfg(feature = "plot")]
            Self::Picture { file, .. } => name.clone_into(file),
            Self::Io { file, .. }
            | Self::UnknownExtension { file, .. }
            | Self::NotAFile { file, .. }
            | Self::TwoFiles { file, .. }
            | Self::ReadOnly { file, .. }
            | Self::Unrepresentable { file, .. }
            | Self::Polygons { file, .. }
            | Self::Seeds { file, .. }
            | Self::Ring { file, .. }
            | Self::PointsOnly { file, .. }
            | Self::NonFinite { file, .. }
            | Self::IndexOutOfRange { file, .. }
            | Self::Layout { file, .. }
            | Self::Empty { file, .. }
            | Self::TooMany { file, .. }
            | Self::Length { file, .. } => name.clone_into(file),
        }
        self
    }

    pub(crate) fn io(file: &str) -> impl Fn(io::Error) -> Self {
        move |source| Self::Io { file: file.to_owned(), source }
    }
}
