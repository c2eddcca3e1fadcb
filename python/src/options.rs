//! Options as Python hands them over.

use crate::errors;
use crate::sampled::Sampled;
use crate::watch::Watch;
use glam::DVec2;
use hexdel::geom::Raster;
use hexdel::{AngleBounds, Domain, Effort, Mesher, Method, Overlaps, SegmentMethod, Size};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use std::sync::Arc;
use std::time::Duration;

/// What a mesh is made of, which says where sizes may be asked for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Made {
    OfPoints,
    OfGraph,
    /// Of points, in a domain that may grow.
    InSession,
}

/// Options of all calls that make meshes. What does not belong to a call is refused
/// by the library. Words and ranges are checked by `_options.py`.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options<'py> {
    method: Option<String>,
    effort: Option<String>,
    min_angle: Option<f64>,
    max_angle: Option<f64>,
    min_dual_edge: Option<f64>,
    max_area: Option<f64>,
    budget: Option<f64>,
    domain: Option<String>,
    radius: Option<f64>,
    /// A tolerance, or a negative number for one in proportion to the PSLG.
    repair: Option<f64>,
    segment_method: Option<String>,
    overlaps: Option<String>,
    coarsening: Option<bool>,
    pub(crate) threads: Option<usize>,
    size: Vec<Part<'py>>,
    gradation: Option<f64>,
    pub(crate) progress: Option<Bound<'py, PyAny>>,
}

/// A part of a size.
#[derive(FromPyObject)]
enum Part<'py> {
    Points(PyReadonlyArray2<'py, f64>, PyReadonlyArray1<'py, f64>),
    /// Behind points: older versions of numpy turn an array of one number into that number.
    Polygon(PyReadonlyArray2<'py, f64>, f64),
    /// Values by rows from the south, centre of the cell in the south-west, side of a cell.
    Raster(PyReadonlyArray2<'py, f64>, f64, f64, f64),
    #[pyo3(transparent)]
    Constant(f64),
    /// A function of arrays and what its values are multiplied with.
    Function(Bound<'py, PyAny>, f64),
}

impl Options<'_> {
    /// The mesher of these options.
    pub(crate) fn mesher(
        &self,
        py: Python<'_>,
        points: &[DVec2],
        made: Made,
        watch: &Arc<Watch>,
    ) -> PyResult<Mesher> {
        let of_graph = made == Made::OfGraph;
        let mut mesher = Mesher::new().method(self.method()).effort(self.effort());
        if let Some(coarsening) = self.coarsening {
            mesher = mesher.coarsening(coarsening);
        }
        if self.min_angle.is_some() || self.max_angle.is_some() {
            let usual = if self.method() == Method::Simple && !of_graph {
                AngleBounds::SIMPLE
            } else {
                AngleBounds::EXTENDED
            };
            mesher = mesher.bounds(self.bounds(py, usual.min_deg(), usual.max_deg())?);
            if of_graph {
                mesher = mesher.near_bounds(self.bounds(py, 30.0, 90.0)?);
            }
        }
        if let Some(ratio) = self.min_dual_edge {
            mesher = mesher.min_dual_edge(ratio);
        }
        if let Some(seconds) = self.budget {
            let budget = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
            mesher = mesher.budget(budget);
        }
        if let Some(radius) = self.radius {
            mesher = mesher.domain_radius(radius);
        }
        if let Some(size) = self.size(py, points, made, watch)? {
            mesher = mesher.size(size);
        }
        if let Some(area) = self.max_area {
            mesher = mesher.max_area(area);
        }
        mesher = match self.domain.as_deref() {
            None => mesher,
            Some("hull") => mesher.domain(Domain::Hull),
            Some("box") => mesher.domain(Domain::Box),
            Some("inside") => mesher.domain(Domain::Inside),
            Some(_) => mesher.domain(Domain::Hexagon),
        };
        mesher = match self.segment_method.as_deref() {
            None => mesher,
            Some("paper") => mesher.segment_method(SegmentMethod::Paper),
            Some(_) => mesher.segment_method(SegmentMethod::Conform),
        };
        if self.overlaps.as_deref() == Some("refuse") {
            mesher = mesher.overlaps(Overlaps::Refuse);
        }
        Ok(match self.repair {
            None => mesher,
            Some(tolerance) if tolerance < 0.0 => mesher.repair(),
            Some(tolerance) => mesher.repair_within(tolerance),
        })
    }

    pub(crate) fn method(&self) -> Method {
        match self.method.as_deref() {
            Some("templates") => Method::Templates,
            Some("simple") => Method::Simple,
            _ => Method::Compact,
        }
    }

    fn effort(&self) -> Effort {
        match self.effort.as_deref() {
            Some("fast") => Effort::Fast,
            Some("best") => Effort::Best,
            Some("fewest") => Effort::Fewest,
            _ => Effort::Standard,
        }
    }

    fn bounds(&self, py: Python<'_>, min: f64, max: f64) -> PyResult<AngleBounds> {
        AngleBounds::new(self.min_angle.unwrap_or(min), self.max_angle.unwrap_or(max))
            .map_err(|error| errors::plain(py, "bounds", &error.to_string()))
    }

    /// How far the domain may be from the box around the points, over its longer side.
    fn beyond(&self, made: Made) -> f64 {
        match self.domain.as_deref() {
            Some("hull" | "inside") => 0.0,
            Some("box") => 0.1,
            None if made == Made::OfGraph => 0.0,
            _ if made == Made::InSession => f64::INFINITY,
            _ => 1.0 + self.radius.unwrap_or(0.0),
        }
    }

    /// How long edges may be, if anything says so.
    pub(crate) fn size(
        &self,
        py: Python<'_>,
        points: &[DVec2],
        made: Made,
        watch: &Arc<Watch>,
    ) -> PyResult<Option<Size>> {
        if self.size.is_empty() {
            return Ok(None);
        }
        let of_size = |error| errors::of_size(py, &error);
        let mut size = Size::unlimited();
        if let Some(gradation) = self.gradation {
            size = size.with_gradation(gradation).map_err(of_size)?;
        }
        for part in &self.size {
            size = match part {
                Part::Constant(length) => size.and_constant(*length).map_err(of_size)?,
                Part::Polygon(corners, length) => {
                    size.and_polygon(crate::convert::points_in(corners)?, *length).map_err(of_size)?
                }
                Part::Points(places, lengths) => {
                    let places = crate::convert::points_in(places)?;
                    let places: Vec<_> = places.into_iter().zip(lengths.as_array().iter().copied()).collect();
                    size.and_points(&places).map_err(of_size)?
                }
                Part::Raster(values, x, y, cell) => {
                    let values = values.as_array();
                    let raster = Raster {
                        columns: values.ncols(),
                        rows: values.nrows(),
                        low: DVec2::new(*x, *y),
                        cell: *cell,
                        values: values.iter().map(|v| v.is_finite().then_some(*v)).collect(),
                    };
                    size.and_raster(&raster).map_err(of_size)?
                }
                Part::Function(function, factor) => {
                    let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
                    let extent = points.iter().fold(start, |(low, high), p| (low.min(*p), high.max(*p)));
                    let function = function.clone().unbind();
                    let beyond = self.beyond(made);
                    let sampled = Sampled::new(function, *factor, extent, beyond, watch.clone());
                    size.and(Size::function(move |p| sampled.at(p)))
                }
            };
        }
        Ok(Some(size))
    }
}
