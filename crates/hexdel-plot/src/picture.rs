//! What a picture of a mesh shows: options, colourings, and what is drawn over it.

use crate::colour::Rgb;
use crate::error::PlotError;
use crate::plot::Plot;
use hexdel_geom::DVec2;

/// Options of a picture.
///
/// # Examples
///
/// ```
/// use hexdel_plot::{ColourBy, Picture};
///
/// let mut picture = Picture::default();
/// picture.size_px = 400.0;
/// picture.colour_by = ColourBy::LargestAngle;
/// picture.bounds_deg = [43.9, 90.0];
/// picture.histogram = true;
/// ```
#[derive(Clone, Copy, Debug)]
#[allow(clippy::struct_excessive_bools, reason = "each switches one layer")]
#[non_exhaustive]
pub struct Picture<'a> {
    /// Length of the longer side of the drawing without legend, pixels; kept
    /// between 16 and 100,000, in PNG 16,384.
    pub size_px: f64,
    /// The angles that are held to be good, degrees. The colour scale goes from
    /// these to 60 degrees, triangles beyond have a colour of their own, and the
    /// histogram marks them.
    pub bounds_deg: [f64; 2],
    /// What the colours of triangles say.
    pub colour_by: ColourBy<'a>,
    /// Whether triangles are filled with their colour.
    pub fill_triangles: bool,
    /// Whether edges are drawn, those with markers heavier than others.
    pub edges: bool,
    /// Whether input points are drawn, as far as the plot names them.
    pub input_points: bool,
    /// Whether the legend has a histogram of the angles.
    pub histogram: bool,
    /// Two opposite corners of the box to show, in the coordinates of the mesh:
    /// the smaller coordinates, the larger. All of the mesh if there is none.
    pub zoom: Option<[DVec2; 2]>,
    /// Polygons: their outlines over the filled triangles or, if triangles are not
    /// filled, in their own colours under the edges.
    pub overlay: Option<&'a Overlay>,
}

/// What the colours of triangles say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum ColourBy<'a> {
    /// The smallest angle, from the smaller bound to 60 degrees.
    #[default]
    SmallestAngle,
    /// The largest angle, from 60 degrees to the larger bound.
    LargestAngle,
    /// The region, of a plot that [has them](Plot::with_regions).
    Region,
    /// Groups of any meaning.
    Groups(&'a Groups),
}

/// Triangles in groups, each with its colour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Groups {
    /// What stands above the legend.
    pub title: String,
    /// What triangles are told apart by.
    pub classes: Vec<OverlayClass>,
    /// For each triangle the index of its class in [`Groups::classes`].
    pub of_triangle: Vec<u32>,
}

impl Default for Picture<'_> {
    fn default() -> Self {
        Self {
            size_px: 1000.0,
            bounds_deg: [30.0, 90.0],
            colour_by: ColourBy::SmallestAngle,
            fill_triangles: true,
            edges: true,
            input_points: true,
            histogram: false,
            zoom: None,
            overlay: None,
        }
    }
}

/// Polygons with a legend.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// What stands above the legend.
    pub title: String,
    /// What polygons are told apart by. The legend has those that occur.
    pub classes: Vec<OverlayClass>,
    /// The polygons, convex, later ones of the same class and level above earlier
    /// ones.
    pub polygons: Vec<Polygon>,
}

/// A line of the legend of an [`Overlay`] or of [`Groups`].
#[derive(Clone, Debug, PartialEq)]
pub struct OverlayClass {
    /// What the legend says.
    pub label: String,
    /// The colour; in an overlay that of the polygons of the highest level.
    pub colour: Rgb,
}

/// A filled polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// The corners in order, in the coordinates of the mesh.
    pub corners: Vec<DVec2>,
    /// Index of its class in [`Overlay::classes`].
    pub class: usize,
    /// Its level: the higher, the darker.
    pub level: u32,
}

/// Checks what a picture relies on, beyond its mesh.
pub(crate) fn check(plot: &Plot<'_>) -> Result<(), PlotError> {
    let picture = &plot.picture;
    let [low, high] = picture.bounds_deg;
    if !(0.0..=60.0).contains(&low) || !(60.0..=180.0).contains(&high) {
        return Err(PlotError::Bounds { low, high });
    }
    if let Some(zoom) = picture.zoom {
        check_zoom(zoom, &plot.mesh.vertices)?;
    }
    match picture.colour_by {
        ColourBy::Region if plot.regions.is_none() => Err(PlotError::NoRegions)?,
        ColourBy::Groups(groups) => check_groups(groups, plot.mesh.triangles.len())?,
        _ => {}
    }
    picture.overlay.map_or(Ok(()), check_overlay)
}

fn check_zoom([min, max]: [DVec2; 2], vertices: &[DVec2]) -> Result<(), PlotError> {
    let fault = if !(min.is_finite() && max.is_finite()) {
        "is not finite"
    } else if !(min.x < max.x && min.y < max.y) {
        "is empty"
    } else {
        let beside = |beyond: &dyn Fn(&DVec2) -> bool| vertices.iter().all(beyond);
        let apart = beside(&|p| p.x <= min.x)
            || beside(&|p| p.x >= max.x)
            || beside(&|p| p.y <= min.y)
            || beside(&|p| p.y >= max.y);
        if !apart {
            return Ok(());
        }
        "lies beside the mesh"
    };
    Err(PlotError::Zoom { min, max, fault })
}

fn check_groups(groups: &Groups, triangles: usize) -> Result<(), PlotError> {
    let (found, count) = (groups.of_triangle.len(), groups.classes.len());
    if found != triangles {
        return Err(PlotError::Length { array: "groups of triangles", expected: triangles, found });
    }
    match groups.of_triangle.iter().position(|&class| class as usize >= count) {
        None => Ok(()),
        Some(index) => {
            let target = groups.of_triangle[index] as usize;
            Err(PlotError::IndexOutOfRange { item: "triangle", index, target, count })
        }
    }
}

fn check_overlay(overlay: &Overlay) -> Result<(), PlotError> {
    let (item, count) = ("polygon", overlay.classes.len());
    for (index, polygon) in overlay.polygons.iter().enumerate() {
        if polygon.class >= count {
            return Err(PlotError::IndexOutOfRange { item, index, target: polygon.class, count });
        }
        if let Some(p) = polygon.corners.iter().find(|p| !p.is_finite()) {
            return Err(PlotError::NonFinite { item, index, x: p.x, y: p.y });
        }
    }
    Ok(())
}
