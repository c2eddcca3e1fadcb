//! What is written: a mesh and the data that goes with it, all borrowed.

use std::fmt;

use hexdel_geom::{DVec2, MarkedEdge, Region, TriMesh, TriangleId, VertexId};
#[cfg(feature = "plot")]
use hexdel_plot::{Picture, Plot};

use crate::error::WriteError;
use crate::format::MeshFormat;
use crate::promised::Promised;

/// A mesh whose coordinates are longitudes and latitudes, made in the plane of a projection: angles and areas are
/// those of the plane.
#[derive(Clone, Copy)]
pub struct Geographic<'a> {
    /// The same triangles in the plane.
    pub plane: &'a TriMesh,
    /// From the plane to degrees, for corners of dual cells.
    pub to_degrees: &'a dyn Fn(DVec2) -> DVec2,
}

/// A mesh to be written, with what is known about it.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, TriMesh, VertexId};
/// use hexdel_io::{MeshFormat, MeshView, write_mesh_to};
///
/// let mesh = TriMesh {
///     vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
///     triangles: vec![[0, 1, 2].map(VertexId::new)],
/// };
/// let view = MeshView::new(&mesh).with_input_indices(&[None, Some(0), Some(1)]);
/// let mut vtu = Vec::new();
/// write_mesh_to(&mut vtu, MeshFormat::Vtu, &view, "a.vtu")?;
/// assert!(vtu.starts_with(b"<?xml"));
/// # Ok::<(), hexdel_io::WriteError>(())
/// ```
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct MeshView<'a> {
    /// The mesh.
    pub mesh: &'a TriMesh,
    /// For each vertex the index of the input point it is, `None` for a Steiner
    /// point. Kept by `.node`, `.vtu` and `.ron`, drawn as a dot in pictures.
    pub input_indices: Option<&'a [Option<u32>]>,
    /// For each vertex a marker, in Triangle's sense: 0 inside, 1 on a boundary
    /// that has none of its own. Kept by `.node`, `.vtu` and `.ron`.
    pub vertex_markers: Option<&'a [i32]>,
    /// For each vertex its height, upwards, in any unit. Kept by `.vtu`, `.vtk`, `.2dm`, `.14` (as
    /// depths), `.nc`, `.geojson`, `.wkt`, `.json` and `.ron`.
    pub heights: Option<&'a [f64]>,
    /// For each triangle the attribute of its region, 0 if it is in none. Kept by
    /// `.ele`, `.vtu` and `.ron`.
    pub regions: Option<&'a [f64]>,
    /// The edges on input segments and on the boundary, with their markers.
    pub marked_edges: Option<&'a [MarkedEdge]>,
    /// What was certified of the mesh. Kept by `.ron`.
    pub certificate: Option<&'a dyn erased_serde::Serialize>,
    /// What it was made to keep. Kept by `.ele`, `.vtu`, `.msh`, `.json` and `.ron`.
    pub promised: Option<&'a Promised>,
    /// Whether triangles get nodes on the midpoints of their edges, as elements of
    /// second order. Kept by `.node` and `.ele`.
    pub second_order: bool,
    /// Attributes of each vertex in a row, as many for each. Kept by `.node` and the vertices
    /// of `.poly`, in the place of input indices.
    pub vertex_attributes: Option<(&'a [f64], usize)>,
    /// The number of the first vertex and triangle in Triangle's files: 0 or 1.
    pub first_number: u32,
    /// Points in holes, and those of regions, of the PSLG that was meshed. Kept by `.poly`.
    pub seeds: (&'a [DVec2], &'a [Region]),
    /// The number of the coordinate system in the register of EPSG. Kept by `.geojson` and `.nc`, of
    /// meshes and of duals.
    pub epsg: Option<u16>,
    /// The coordinate system as PROJ defines it, if it has no number. Kept by `.nc`.
    pub definition: Option<&'a str>,
    /// If coordinates are longitudes and latitudes, where angles and areas are told of. `.nc` names WGS 84 then,
    /// unless [`epsg`](Self::epsg) is another system.
    pub geographic: Option<Geographic<'a>>,
    /// How pictures look and what else is on them, with the feature `plot`.
    #[cfg(feature = "plot")]
    pub picture: Picture<'a>,
}

impl<'a> MeshView<'a> {
    /// A mesh alone.
    pub fn new(mesh: &'a TriMesh) -> Self {
        Self {
            mesh,
            input_indices: None,
            vertex_markers: None,
            heights: None,
            regions: None,
            marked_edges: None,
            certificate: None,
            promised: None,
            second_order: false,
            vertex_attributes: None,
            first_number: 0,
            seeds: (&[], &[]),
            epsg: None,
            definition: None,
            geographic: None,
            #[cfg(feature = "plot")]
            picture: Picture::default(),
        }
    }

    /// With the index of the input point that each vertex is.
    #[must_use]
    pub fn with_input_indices(self, input_indices: &'a [Option<u32>]) -> Self {
        Self { input_indices: Some(input_indices), ..self }
    }

    /// With a marker of each vertex.
    #[must_use]
    pub fn with_vertex_markers(self, vertex_markers: &'a [i32]) -> Self {
        Self { vertex_markers: Some(vertex_markers), ..self }
    }

    /// With the height of each vertex.
    #[must_use]
    pub fn with_heights(self, heights: &'a [f64]) -> Self {
        Self { heights: Some(heights), ..self }
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

    /// With a certificate, anything that serde serialises.
    #[must_use]
    pub fn with_certificate(self, certificate: &'a dyn erased_serde::Serialize) -> Self {
        Self { certificate: Some(certificate), ..self }
    }

    /// With attributes of vertices, so many for each.
    #[must_use]
    pub fn with_vertex_attributes(self, attributes: &'a [f64], per_vertex: usize) -> Self {
        Self { vertex_attributes: Some((attributes, per_vertex)), ..self }
    }

    /// With another number of the first vertex and triangle in Triangle's files than 0.
    #[must_use]
    pub fn with_first_number(self, first_number: u32) -> Self {
        Self { first_number, ..self }
    }

    /// With points in holes, and those of regions.
    #[must_use]
    pub fn with_seeds(self, holes: &'a [DVec2], regions: &'a [Region]) -> Self {
        Self { seeds: (holes, regions), ..self }
    }

    /// With what it was made to keep.
    #[must_use]
    pub fn with_promised(self, promised: &'a Promised) -> Self {
        Self { promised: Some(promised), ..self }
    }

    /// With the number of the coordinate system in the register of EPSG.
    #[must_use]
    pub fn with_epsg(self, epsg: u16) -> Self {
        Self { epsg: Some(epsg), ..self }
    }

    /// With nodes on the midpoints of edges, or without.
    #[must_use]
    pub fn with_second_order(self, second_order: bool) -> Self {
        Self { second_order, ..self }
    }

    /// With options for pictures, with the feature `plot`.
    #[cfg(feature = "plot")]
    #[must_use]
    pub fn with_picture(self, picture: Picture<'a>) -> Self {
        Self { picture, ..self }
    }

    /// What pictures show of it.
    #[cfg(feature = "plot")]
    pub(crate) fn plot(&self) -> Plot<'a> {
        let mut plot = Plot::new(self.mesh).with_picture(self.picture);
        plot.input_indices = self.input_indices;
        plot.regions = self.regions;
        plot.marked_edges = self.marked_edges;
        plot
    }

    /// The corners of a triangle where angles and areas are told of.
    pub(crate) fn measured(&self, t: TriangleId) -> [DVec2; 3] {
        self.geographic.map_or(self.mesh, |geographic| geographic.plane).corners(t)
    }

    /// The coordinates in the file of a corner of the dual.
    pub(crate) fn placed(&self, corner: DVec2) -> DVec2 {
        self.geographic.map_or(corner, |geographic| (geographic.to_degrees)(corner))
    }

    /// What the view has and a format does not carry, in words.
    ///
    /// # Examples
    ///
    /// ```
    /// # let mesh = hexdel_geom::TriMesh::default();
    /// use hexdel_io::{MeshFormat, MeshView};
    ///
    /// let view = MeshView::new(&mesh).with_regions(&[]);
    /// assert_eq!(view.lost_in(MeshFormat::Off), ["regions"]);
    /// assert!(view.lost_in(MeshFormat::Vtu).is_empty());
    /// ```
    pub fn lost_in(&self, format: MeshFormat) -> Vec<&'static str> {
        use MeshFormat as F;
        // Those that keep all of it but attributes.
        let ours = [F::Msh41, F::Msh22, F::Json, F::Ron];
        let carry = |formats: &[F]| ours.contains(&format) || formats.contains(&format);
        let vtk = [F::Vtu, F::Vtk, F::Ugrid];
        let inputs = carry(&[F::NodeEle, F::Poly]) || vtk.contains(&format) || format.is_svg();
        let markers = carry(&[F::NodeEle, F::Poly, F::Medit]) || vtk.contains(&format);
        let regions = carry(&[F::NodeEle, F::Medit, F::GeoJson, F::TwoDm]) || vtk.contains(&format);
        let edges = carry(&[F::Edge, F::Poly, F::Medit, F::TwoDm, F::Fort14, F::Ugrid]);
        let heights = vtk.contains(&format)
            || [F::GeoJson, F::Wkt, F::TwoDm, F::Fort14, F::Json, F::Ron].contains(&format);
        let attributes = [F::NodeEle, F::Poly].contains(&format);
        let all = [
            ("input indices", self.input_indices.is_some(), inputs),
            ("vertex markers", self.vertex_markers.is_some(), markers),
            ("heights", self.heights.is_some(), heights),
            ("regions", self.regions.is_some(), regions),
            ("marked edges", self.marked_edges.is_some(), edges),
            ("vertex attributes", self.vertex_attributes.is_some_and(|(_, n)| n > 0), attributes),
        ];
        let lost = all.iter().filter(|(_, there, carried)| *there && !carried);
        lost.map(|(name, ..)| *name).collect()
    }

    /// Checks what every format relies on, so that no writer can fail half-way
    /// for another reason than the system's.
    pub(crate) fn check(&self, file: &str) -> Result<(), WriteError> {
        self.check_lengths(file)?;
        let vertices = &self.mesh.vertices;
        if let Some(index) = vertices.iter().position(|p| !p.is_finite()) {
            return Err(WriteError::NonFinite {
                file: file.to_owned(),
                item: "vertex",
                index,
                x: vertices[index].x,
                y: vertices[index].y,
            });
        }
        let heights = self.heights.unwrap_or(&[]);
        if let Some(index) = heights.iter().position(|z| !z.is_finite()) {
            let (file, item) = (file.to_owned(), "height of vertex");
            return Err(WriteError::Unrepresentable {
                file,
                format: "a mesh",
                item,
                index,
                found: heights[index],
            });
        }
        for (index, corners) in self.mesh.triangles.iter().enumerate() {
            self.check_indices(file, "triangle", index, corners)?;
        }
        for (index, edge) in self.marked_edges.unwrap_or(&[]).iter().enumerate() {
            self.check_indices(file, "edge", index, &edge.ends)?;
        }
        Ok(())
    }

    fn check_lengths(&self, file: &str) -> Result<(), WriteError> {
        let (vertices, triangles) = (self.mesh.vertices.len(), self.mesh.triangles.len());
        let arrays = [
            ("input indices", vertices, self.input_indices.map(<[_]>::len)),
            ("vertex markers", vertices, self.vertex_markers.map(<[_]>::len)),
            ("heights", vertices, self.heights.map(<[_]>::len)),
            ("regions", triangles, self.regions.map(<[_]>::len)),
            (
                "vertex attributes",
                self.vertex_attributes.map_or(0, |(_, per_vertex)| per_vertex.saturating_mul(vertices)),
                self.vertex_attributes.map(|(all, _)| all.len()),
            ),
        ];
        for (array, expected, found) in arrays {
            if let Some(found) = found
                && found != expected
            {
                return Err(WriteError::Length { file: file.to_owned(), array, expected, found });
            }
        }
        Ok(())
    }

    fn check_indices(
        &self,
        file: &str,
        item: &'static str,
        index: usize,
        vertices: &[VertexId],
    ) -> Result<(), WriteError> {
        let count = self.mesh.vertices.len();
        match vertices.iter().find(|v| v.index() >= count) {
            None => Ok(()),
            Some(bad) => Err(WriteError::IndexOutOfRange {
                file: file.to_owned(),
                item,
                index,
                target: bad.index(),
                count,
            }),
        }
    }
}

impl fmt::Debug for MeshView<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut view = f.debug_struct("MeshView");
        view.field("vertices", &self.mesh.vertices.len())
            .field("triangles", &self.mesh.triangles.len())
            .field("input_indices", &self.input_indices.is_some())
            .field("vertex_markers", &self.vertex_markers.is_some())
            .field("heights", &self.heights.is_some())
            .field("regions", &self.regions.is_some())
            .field("marked_edges", &self.marked_edges.map(<[_]>::len))
            .field("certificate", &self.certificate.is_some())
            .field("promised", &self.promised)
            .field("epsg", &self.epsg)
            .field("definition", &self.definition)
            .field("geographic", &self.geographic.is_some());
        #[cfg(feature = "plot")]
        view.field("picture", &self.picture);
        view.finish()
    }
}
