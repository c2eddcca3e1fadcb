//! `--project`: longitudes and latitudes are meshed in the plane of a conformal projection, and come back.
//!
//! The bounds of the mesh hold in the plane, and so do sizes and areas, in metres. What is written is in degrees again,
//! unless it is to stay projected; vertices that are input points have the input's coordinates, bit for bit.

use crate::exit::{Failure, warn};
use hexdel::geom::{Region, TriangleId};
use hexdel::{DVec2, TriMesh};
use hexdel_io::{
    DualFormat, Geographic, MeshFormat, MeshView, PointFile, Projection, ProjectionError, ProjectionKind,
};
use serde::Serialize;
use std::path::Path;

/// Options of projections.
#[derive(clap::Args)]
pub(crate) struct PlaneArgs {
    /// Mesh degrees in a plane: mercator, lambert, polar-stereographic, +proj=..
    #[arg(long, value_name = "NAME", value_parser = kind)]
    project: Option<ProjectionKind>,
    /// Write the metres of the projection, not degrees
    #[arg(long, hide = true, requires = "project")]
    keep_projected: bool,
}

fn kind(text: &str) -> Result<ProjectionKind, String> {
    text.parse()
}

/// The plane that a mesh is made in.
pub(crate) struct Plane {
    projection: Projection,
    /// Longitudes and latitudes of the input points.
    given: Vec<DVec2>,
    keep: bool,
    /// The least and the largest scale at the points.
    scale: [f64; 2],
}

/// What a report says of a projection.
#[derive(Serialize)]
pub(crate) struct PlaneFigures<'a> {
    /// PROJ's parameters.
    definition: &'a str,
    /// What coordinates in files are; those of pictures, `.disv` and `.mpas.nc` always are of the plane.
    output: &'static str,
    /// What angles, areas and lengths are of.
    figures: &'static str,
    /// The least and the largest ratio of lengths in the plane to those on the ellipsoid, at the input points.
    scale: [f64; 2],
}

impl PlaneArgs {
    /// Takes the input to the plane, if that was asked for.
    pub(crate) fn take(&self, input: &mut PointFile, path: &Path) -> Result<Option<Plane>, Failure> {
        let Some(kind) = &self.project else { return Ok(None) };
        let at_fault = |source| Failure::Projection { file: path.display().to_string(), source };
        let given = std::mem::take(&mut input.pslg.points);
        let projection = Projection::new(kind, &given).map_err(at_fault)?;
        input.pslg.points.clone_from(&given);
        input.pslg = projection.project(&input.pslg).map_err(at_fault)?;
        input.degrees = false;
        let scales = given.iter().filter_map(|&p| projection.scale(p));
        let scale = scales.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], k| [low.min(k), high.max(k)]);
        Ok(Some(Plane { projection, given, keep: self.keep_projected, scale }))
    }
}

impl Plane {
    pub(crate) fn figures(&self) -> PlaneFigures<'_> {
        PlaneFigures {
            definition: self.projection.definition(),
            output: if self.keep { "plane" } else { "degrees" },
            figures: "angles, areas and lengths are those of the plane, metres",
            scale: self.scale,
        }
    }

    /// The lines of a summary.
    pub(crate) fn lines(&self) -> String {
        let [low, high] = self.scale;
        format!(
            "projected  {}\n           angles hold in this plane; its lengths are {low:.4} to {high:.4} of those on the \
             ellipsoid\n",
            self.projection.definition()
        )
    }

    /// The place in the plane of a longitude and latitude.
    pub(crate) fn project(&self, at: DVec2) -> Option<DVec2> {
        self.projection.to_plane(at)
    }

    /// Longitude and latitude of a place in the plane.
    pub(crate) fn degrees(&self, at: DVec2) -> DVec2 {
        self.projection.to_degrees(at)
    }

    /// PROJ's parameters, if files have coordinates of the plane.
    pub(crate) fn definition(&self) -> Option<&str> {
        self.keep.then(|| self.projection.definition())
    }

    /// What files in degrees hold; none if they are to have coordinates of the plane.
    pub(crate) fn unprojected(&self, view: &MeshView<'_>) -> Option<Unprojected> {
        if self.keep {
            return None;
        }
        let input = |v: usize| {
            let &index = view.input_indices?.get(v)?.as_ref()?;
            self.given.get(index as usize).copied()
        };
        let vertex = |(v, &at): (usize, &DVec2)| match input(v) {
            // Repair may have moved it.
            Some(given) if self.project(given) == Some(at) => given,
            _ => self.degrees(at),
        };
        let vertices = view.mesh.vertices.iter().enumerate().map(vertex).collect();
        let mesh = TriMesh { vertices, triangles: view.mesh.triangles.clone() };
        let (holes, regions) = view.seeds;
        let region = |region: &Region| Region { point: self.degrees(region.point), ..*region };
        Some(Unprojected {
            mesh,
            holes: holes.iter().map(|&p| self.degrees(p)).collect(),
            regions: regions.iter().map(region).collect(),
        })
    }

    /// Warns of what files cannot say or show as it is.
    pub(crate) fn warn_of(&self, unprojected: Option<&Unprojected>, epsg: Option<u16>, files: &[&Path]) {
        if let Some(torn) = unprojected.map(Unprojected::torn).filter(|&torn| torn > 0) {
            warn(&format!(
                "{torn} triangles cross the meridian of 180 degrees and look torn in degrees; --keep-projected writes the \
                 plane"
            ));
        }
        let nameless = |path: &&&Path| {
            MeshFormat::from_path(path) == Some(MeshFormat::GeoJson)
                || DualFormat::from_path(path) == Some(DualFormat::GeoJson)
        };
        if let Some(path) = files.iter().find(nameless).filter(|_| self.keep && epsg.is_none()) {
            warn(&format!(
                "{}: GeoJSON without --crs is taken for longitudes and latitudes, and this is projected",
                path.display()
            ));
        }
    }
}

/// Whether a file has coordinates of the plane even if others are in degrees: pictures, and grids whose models know
/// nothing of degrees.
pub(crate) fn stays_in_plane(path: &Path) -> bool {
    MeshFormat::from_path(path).is_some_and(MeshFormat::is_picture)
        || matches!(DualFormat::from_path(path), Some(DualFormat::Disv | DualFormat::Mpas))
}

/// A mesh in degrees, with the seeds of its PSLG.
pub(crate) struct Unprojected {
    mesh: TriMesh,
    holes: Vec<DVec2>,
    regions: Vec<Region>,
}

impl Unprojected {
    /// A view with this mesh in its place. What was promised and certified is of the plane, and left.
    pub(crate) fn view<'a>(
        &'a self,
        view: &MeshView<'a>,
        to_degrees: &'a dyn Fn(DVec2) -> DVec2,
    ) -> MeshView<'a> {
        let mut all = *view;
        all.mesh = &self.mesh;
        all.seeds = (&self.holes, &self.regions);
        (all.promised, all.certificate) = (None, None);
        all.geographic = Some(Geographic { plane: view.mesh, to_degrees });
        all
    }

    /// Triangles with corners on both sides of 180 degrees.
    fn torn(&self) -> usize {
        let wide = |t: &usize| {
            let [a, b, c] = self.mesh.corners(TriangleId::new(*t)).map(|p| p.x);
            a.max(b).max(c) - a.min(b).min(c) > 180.0
        };
        (0..self.mesh.triangles.len()).filter(wide).count()
    }
}

/// What would help, in options.
pub(crate) fn remedy(error: &ProjectionError) -> Option<&'static str> {
    use ProjectionError as E;
    match error {
        E::Equator { .. } => Some("--project mercator is for what is around the equator"),
        E::Cut { .. } => Some("--project polar-stereographic is for what is around a pole"),
        E::Outside { why, .. } if why.contains("side") => Some("--project mercator or lambert is for both"),
        E::Outside { .. } => Some("--project polar-stereographic is for the poles"),
        E::NotDegrees { .. } => Some("without --project coordinates are taken for those of a plane"),
        E::NotConformal { .. } => Some("--project mercator, polar-stereographic or lambert keep angles"),
        _ => None,
    }
}
