//! Points and PSLGs that are meshed.

use crate::convert::{flat, json, points, rows};
use crate::errors;
use crate::options::Options;
use hexdel::geom::Region;
use hexdel::io::{PointFormat, PointReader, write_points_to};
use hexdel::pslg::validate;
use hexdel::{DVec2, Error, Mesher, Pslg};
use std::io::Cursor;
use wasm_bindgen::prelude::*;

/// Points, with segments, holes and regions or without.
#[wasm_bindgen]
pub struct RawGraph {
    pub(crate) pslg: Pslg,
    /// Which attribute of the points is their height, if one is.
    pub(crate) height: Option<usize>,
    warnings: Vec<String>,
    columns: Option<String>,
}

impl RawGraph {
    /// The heights of vertices, which are among their attributes, if the points have heights.
    pub(crate) fn heights(&self, of_vertices: &[f64]) -> Option<Vec<f64>> {
        let column = of_vertices.iter().skip(self.height?).step_by(self.pslg.attributes_per_point.max(1));
        Some(column.copied().collect())
    }

    /// The heights of the points, if they have some.
    pub(crate) fn of_points(&self) -> Option<Vec<f64>> {
        self.heights(&self.pslg.point_attributes)
    }
}

/// Heights of points, those that are not known, which are no numbers, linearly between the others.
fn filled(points: &[DVec2], mut heights: Vec<f64>) -> Result<Vec<f64>, JsValue> {
    if heights.len() != points.len() {
        let text = format!("heights: expected {} numbers, got {}", points.len(), heights.len());
        return Err(errors::plain("length", &text));
    }
    let (known, unknown): (Vec<usize>, Vec<usize>) = (0..points.len()).partition(|&i| !heights[i].is_nan());
    if known.is_empty() {
        return Ok(Vec::new());
    }
    if !unknown.is_empty() {
        let of_known = |i: &usize| points[*i];
        let plane = validate(&Pslg::from_points(known.iter().map(of_known).collect()))
            .map_err(|error| errors::of_mesh(&Error::from(error)))?;
        let values: Vec<f64> = known.iter().map(|&i| heights[i]).collect();
        let places: Vec<DVec2> = unknown.iter().map(of_known).collect();
        for (i, height) in unknown.into_iter().zip(plane.interpolate(&values, 1, &places)) {
            heights[i] = height;
        }
    }
    Ok(heights)
}

#[wasm_bindgen]
impl RawGraph {
    /// A graph of arrays. Regions are rows of x, y, attribute and largest area, where a number
    /// that is not positive stands for none. Heights are as many as points, or none; those that
    /// are no numbers are not known.
    #[wasm_bindgen(constructor)]
    pub fn new(
        of_points: &[f64],
        segments: &[u32],
        holes: &[f64],
        regions: &[f64],
        point_markers: &[i32],
        segment_markers: &[i32],
        heights: &[f64],
    ) -> Result<Self, JsValue> {
        let region = |[x, y, attribute, area]: [f64; 4]| Region {
            point: DVec2::new(x, y),
            attribute,
            max_area: (area > 0.0).then_some(area),
        };
        let points = points("points", of_points)?;
        let heights = if heights.is_empty() { Vec::new() } else { filled(&points, heights.to_vec())? };
        let height = (!heights.is_empty()).then_some(0);
        let pslg = Pslg {
            attributes_per_point: usize::from(height.is_some()),
            point_attributes: heights,
            points,
            segments: rows("segments", segments)?,
            holes: crate::convert::points("holes", holes)?,
            regions: rows("regions", regions)?.into_iter().map(region).collect(),
            point_markers: point_markers.to_vec(),
            segment_markers: segment_markers.to_vec(),
            ..Pslg::default()
        };
        Ok(Self { pslg, height, warnings: Vec::new(), columns: None })
    }

    /// The graph in a file, by the name of its format; `name` is what errors call it.
    pub fn read(bytes: &[u8], format: &str, name: &str) -> Result<Self, JsValue> {
        let format = PointFormat::from_name(format).ok_or_else(|| {
            let text = format!("{name}: the extension is not one of {}", PointFormat::READABLE);
            errors::plain("file", &text)
        })?;
        let read = PointReader::new().read_from(Cursor::new(bytes), format, name);
        let file = read.map_err(|error| errors::of_reading(&error))?;
        Ok(Self {
            pslg: file.pslg,
            height: file.height_attribute,
            warnings: file.warnings.iter().map(ToString::to_string).collect(),
            columns: file.columns.map(|columns| columns.to_string()),
        })
    }

    /// The same with holes and regions in place of polygons.
    pub fn prepared(&self, options: &str) -> Result<Self, JsValue> {
        let mesher: Mesher = Options::read(options)?.mesher(true)?;
        let prepared = mesher.prepared_pslg(&self.pslg).map_err(|error| errors::of_mesh(&error))?;
        let mut warnings = self.warnings.clone();
        warnings.extend(prepared.warnings.iter().map(ToString::to_string));
        let heights = self.heights(&prepared.point_attributes(&self.pslg));
        let (height, columns) = (heights.as_ref().map(|_| 0), self.columns.clone());
        let pslg = Pslg {
            attributes_per_point: usize::from(height.is_some()),
            point_attributes: heights.unwrap_or_default(),
            ..prepared.graph
        };
        Ok(Self { pslg, height, warnings, columns })
    }

    /// The graph as a file in a format.
    pub fn write(&self, format: &str) -> Result<Vec<u8>, JsValue> {
        let format = PointFormat::from_name(format)
            .ok_or_else(|| errors::plain("file", &format!("there is no format {format:?}")))?;
        let mut bytes = Vec::new();
        write_points_to(&mut bytes, format, &self.pslg, "the file")
            .map_err(|error| errors::plain("file", &error.to_string()))?;
        Ok(bytes)
    }

    /// Whether it is more than points.
    #[wasm_bindgen(getter)]
    pub fn is_graph(&self) -> bool {
        !(self.pslg.segments.is_empty() && self.pslg.polygons.is_empty())
    }

    /// Whether it has polygons, which [`prepared`](Self::prepared) replaces.
    #[wasm_bindgen(getter)]
    pub fn has_polygons(&self) -> bool {
        !self.pslg.polygons.is_empty()
    }

    #[wasm_bindgen(getter)]
    pub fn points(&self) -> Vec<f64> {
        flat(&self.pslg.points)
    }

    #[wasm_bindgen(getter)]
    pub fn segments(&self) -> Vec<u32> {
        self.pslg.segments.as_flattened().to_vec()
    }

    #[wasm_bindgen(getter)]
    pub fn holes(&self) -> Vec<f64> {
        flat(&self.pslg.holes)
    }

    #[wasm_bindgen(getter)]
    pub fn regions(&self) -> Vec<f64> {
        let row = |r: &Region| [r.point.x, r.point.y, r.attribute, r.max_area.unwrap_or(-1.0)];
        self.pslg.regions.iter().flat_map(row).collect()
    }

    #[wasm_bindgen(getter)]
    pub fn point_markers(&self) -> Vec<i32> {
        self.pslg.point_markers.clone()
    }

    #[wasm_bindgen(getter)]
    pub fn segment_markers(&self) -> Vec<i32> {
        self.pslg.segment_markers.clone()
    }

    /// The heights of the points; empty if they have none.
    #[wasm_bindgen(getter)]
    pub fn point_heights(&self) -> Vec<f64> {
        self.of_points().unwrap_or_default()
    }

    /// What was mended while it was read, or could have been meant otherwise, as JSON.
    #[wasm_bindgen(getter)]
    pub fn warnings(&self) -> Result<String, JsValue> {
        json(&self.warnings)
    }

    /// Which columns of a table were taken.
    #[wasm_bindgen(getter)]
    pub fn columns(&self) -> Option<String> {
        self.columns.clone()
    }
}
