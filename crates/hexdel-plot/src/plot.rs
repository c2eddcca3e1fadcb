//! What is drawn: a mesh and the data that goes with it, all borrowed.

use crate::error::PlotError;
use crate::picture::{self, Picture};
use crate::svg;
use hexdel_geom::{MarkedEdge, TriMesh, VertexId};
use std::io::Write;

/// A mesh to be drawn, with what is known about it.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, TriMesh, VertexId};
/// use hexdel_plot::{ColourBy, Plot};
///
/// let mesh = TriMesh {
///     vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
///     triangles: vec![[0, 1, 2].map(VertexId::new)],
/// };
/// let mut plot = Plot::new(&mesh).with_input_indices(&[None, Some(0), Some(1)]);
/// plot.picture.colour_by = ColourBy::LargestAngle;
/// let mut svg = Vec::new();
/// plot.write_svg(&mut svg)?;
/// assert!(svg.starts_with(b"<svg"));
/// # Ok::<(), hexdel_plot::PlotError>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Plot<'a> {
    /// The mesh.
    pub mesh: &'a TriMesh,
    /// For each vertex the index of the input point it is, `None` for a Steiner point. Input points
    /// are drawn as dots.
    pub input_indices: Option<&'a [Option<u32>]>,
    /// For each triangle the attribute of its region, for [`ColourBy::Region`](crate::ColourBy::Region).
    pub regions: Option<&'a [f64]>,
    /// The edges on input segments and on the boundary, drawn heavier than others.
    pub marked_edges: Option<&'a [MarkedEdge]>,
    /// How the picture looks and what else is on it.
    pub picture: Picture<'a>,
}

impl<'a> Plot<'a> {
    /// A mesh alone.
    pub fn new(mesh: &'a TriMesh) -> Self {
        Self { mesh, input_indices: None, regions: None, marked_edges: None, picture: Picture::default() }
    }

    /// With the index of the input point that each vertex is.
    #[must_use]
    pub fn with_input_indices(self, input_indices: &'a [Option<u32>]) -> Self {
        Self { input_indices: Some(input_indices), ..self }
    }

    /// With the attribute of each triangle's region.
    #[must_use]
    pub fn with_regions(self, regions: &'a [f64]) -> Self {
        Self { regions: Some(regions), ..self }
    }

    /// With the edges that have markers.
    #[must_use]
    pub fn with_marked_edges(self, marked_edges: &'a [MarkedEdge]) -> Self {
        Self { marked_edges: Some(marked_edges), ..self }
    }

    /// With options of the picture.
    #[must_use]
    pub fn with_picture(self, picture: Picture<'a>) -> Self {
        Self { picture, ..self }
    }

    /// Draws an SVG.
    ///
    /// The same arguments give the same bytes on every platform.
    ///
    /// # Errors
    ///
    /// As [`Plot::check`], before anything is written; [`PlotError::Io`] if the stream refuses.
    ///
    /// # Complexity
    ///
    /// Linear but for sorting; 12 bytes per triangle in view.
    pub fn write_svg(&self, out: &mut dyn Write) -> Result<(), PlotError> {
        self.check()?;
        Ok(svg::write_svg(out, self)?)
    }

    /// Paints a PNG, with the feature `png`.
    ///
    /// # Errors
    ///
    /// As [`Plot::write_svg`].
    ///
    /// # Complexity
    ///
    /// As [`Plot::write_svg`], and linear in the number of pixels; memory for a strip of them.
    #[cfg(feature = "png")]
    pub fn write_png(&self, out: &mut dyn Write) -> Result<(), PlotError> {
        self.check()?;
        Ok(crate::png::write_png(out, self)?)
    }

    /// Checks all that drawing relies on, so that it can fail for no other reason than the system's.
    ///
    /// # Errors
    ///
    /// Every [`PlotError`] but [`PlotError::Io`].
    pub fn check(&self) -> Result<(), PlotError> {
        let (vertices, triangles) = (&self.mesh.vertices, &self.mesh.triangles);
        let arrays = [
            ("input indices", vertices.len(), self.input_indices.map(<[_]>::len)),
            ("regions", triangles.len(), self.regions.map(<[_]>::len)),
        ];
        for (array, expected, found) in arrays {
            if let Some(found) = found
                && found != expected
            {
                return Err(PlotError::Length { array, expected, found });
            }
        }
        if let Some(index) = vertices.iter().position(|p| !p.is_finite()) {
            let (x, y) = (vertices[index].x, vertices[index].y);
            return Err(PlotError::NonFinite { item: "vertex", index, x, y });
        }
        for (index, corners) in triangles.iter().enumerate() {
            self.check_indices("triangle", index, corners)?;
        }
        for (index, edge) in self.marked_edges.unwrap_or(&[]).iter().enumerate() {
            self.check_indices("edge", index, &edge.ends)?;
        }
        picture::check(self)
    }

    fn check_indices(
        &self,
        item: &'static str,
        index: usize,
        vertices: &[VertexId],
    ) -> Result<(), PlotError> {
        let count = self.mesh.vertices.len();
        match vertices.iter().find(|v| v.index() >= count) {
            None => Ok(()),
            Some(bad) => Err(PlotError::IndexOutOfRange { item, index, target: bad.index(), count }),
        }
    }
}
