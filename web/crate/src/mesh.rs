//! Meshes: made of points or graphs, or as a session has them.

use crate::convert::{Record, flat, indices, json};
use crate::errors;
use crate::graph::RawGraph;
use crate::options::Options;
use crate::watch::Watch;
use hexdel::geom::{Voronoi, quality};
use hexdel::io::{
    MarkedEdge, MeshFormat, MeshView, Promised, PromisedDomain, write_mesh_pair_to, write_mesh_to,
};
use hexdel::plot::{Overlay, Picture};
use hexdel::{
    Certificate, DVec2, Domain, ExceptionEntry, Mesher, Pslg, PslgTriangulation, RepairEntry, SegmentMethod,
    SessionCheck, SessionMesh, TriMesh, Triangulation, VertexId,
};
use js_sys::{Float32Array, Float64Array, Function, Uint8Array, Uint32Array};
use std::io;
use wasm_bindgen::prelude::*;

/// A certified mesh.
#[wasm_bindgen]
pub struct RawMesh {
    pub(crate) made: Made,
    /// For each vertex the first input that it is, if any.
    input_of_vertex: Vec<Option<u32>>,
    vertex_of_input: Vec<Option<VertexId>>,
    /// Edges on segments and the boundary, of graphs.
    edges: Vec<MarkedEdge>,
    regions: Vec<f64>,
    heights: Option<Vec<f64>>,
}

/// How a mesh came to be.
pub(crate) enum Made {
    /// With the options, which a session of it goes on with.
    Points(Box<Triangulation>, Box<Mesher>),
    Graph(Box<PslgTriangulation>),
    Session(Box<SessionMesh>, Box<SessionCheck>),
}

/// Meshes points alone or a graph, whichever it is.
#[wasm_bindgen]
#[expect(unreachable_pub, reason = "JavaScript reaches it")]
pub fn mesh(graph: &RawGraph, options: &str, progress: Option<Function>) -> Result<RawMesh, JsValue> {
    let options = Options::read(options)?;
    let of_graph = graph.is_graph() || options.makes_graph();
    let mesher = options.mesher(of_graph)?;
    let watch = Watch::new(progress);
    if of_graph {
        let made = mesher.triangulate_pslg_watched(&graph.pslg, &watch);
        let made = made.map_err(|error| errors::of_mesh(&error))?;
        let heights = graph.height.and_then(|_| graph.heights(&made.vertex_attributes(&graph.pslg)));
        return Ok(RawMesh { heights, ..RawMesh::of_graph(made) });
    }
    let points = &graph.pslg.points;
    let made = mesher.triangulate_watched(points, &watch).map_err(|error| errors::of_mesh(&error))?;
    let heights = if graph.height.is_some() {
        let attributes = made.vertex_attributes(&graph.pslg).map_err(|error| errors::of_mesh(&error))?;
        graph.heights(&attributes)
    } else {
        None
    };
    Ok(RawMesh { heights, ..RawMesh::of_points(made, mesher) })
}

impl RawMesh {
    fn of_points(made: Triangulation, mesher: Mesher) -> Self {
        Self {
            input_of_vertex: made.input_of_vertex(),
            vertex_of_input: made.vertex_of_input.iter().copied().map(Some).collect(),
            edges: Vec::new(),
            regions: Vec::new(),
            heights: None,
            made: Made::Points(Box::new(made), Box::new(mesher)),
        }
    }

    fn of_graph(made: PslgTriangulation) -> Self {
        Self {
            input_of_vertex: made.input_of_vertex(),
            vertex_of_input: made.vertex_of_input(),
            edges: made.edges.iter().map(|e| MarkedEdge { ends: e.ends, marker: e.marker }).collect(),
            regions: if made.graph.regions.is_empty() { Vec::new() } else { made.region_attributes() },
            heights: None,
            made: Made::Graph(Box::new(made)),
        }
    }

    pub(crate) fn of_session(
        made: SessionMesh,
        check: SessionCheck,
        regions: Vec<f64>,
        heights: Option<Vec<f64>>,
    ) -> Self {
        let mut inputs = vec![None; made.mesh.vertices.len()];
        let count = made.points.last().map_or(0, |(id, _)| id.0 as usize + 1);
        let mut vertices = vec![None; count];
        for (id, v) in &made.points {
            inputs[v.index()] = Some(id.0 as u32);
            vertices[id.0 as usize] = Some(*v);
        }
        Self {
            input_of_vertex: inputs,
            vertex_of_input: vertices,
            edges: made.edges.iter().map(|e| MarkedEdge { ends: e.ends, marker: e.marker }).collect(),
            regions,
            heights,
            made: Made::Session(Box::new(made), Box::new(check)),
        }
    }

    /// The heights of the input points, if they have some.
    pub(crate) fn heights_of_points(&self) -> Option<Vec<f64>> {
        let heights = self.heights.as_ref()?;
        let of = |v: &Option<VertexId>| v.map_or(f64::NAN, |v| heights[v.index()]);
        Some(self.vertex_of_input.iter().map(of).collect())
    }

    fn mesh(&self) -> &TriMesh {
        match &self.made {
            Made::Points(made, ..) => &made.mesh,
            Made::Graph(made) => &made.mesh,
            Made::Session(made, _) => &made.mesh,
        }
    }

    fn proof(&self) -> &Certificate {
        match &self.made {
            Made::Points(made, ..) => &made.certificate,
            Made::Graph(made) => &made.certificate,
            Made::Session(_, check) => &check.certificate,
        }
    }

    fn markers(&self) -> &[i32] {
        match &self.made {
            Made::Points(..) => &[],
            Made::Graph(made) => &made.vertex_markers,
            Made::Session(made, _) => &made.vertex_markers,
        }
    }

    /// What the mesh was made to keep, if that is written into files.
    fn promised(&self) -> Option<Promised> {
        match &self.made {
            Made::Points(made, ..) => {
                let bounds = made.certificate.bounds;
                let domain = PromisedDomain::Hexagon;
                Some(Promised { near: bounds, far: bounds, domain, exempt: Vec::new() })
            }
            Made::Graph(made) if made.method != SegmentMethod::Paper => {
                let domain = match made.domain {
                    Domain::Hull => PromisedDomain::Hull,
                    Domain::Box => PromisedDomain::Box,
                    Domain::Inside => PromisedDomain::Inside,
                    _ => PromisedDomain::Hexagon,
                };
                let exempt = made.exempt.iter().map(|e| e.triangle.index() as u32).collect();
                Some(Promised { near: made.certificate.bounds, far: made.far_bounds, domain, exempt })
            }
            _ => None,
        }
    }

    /// All that the program writes of such a mesh.
    fn view<'a>(&'a self, promised: Option<&'a Promised>, overlay: Option<&'a Overlay>) -> MeshView<'a> {
        let mut picture = Picture::default();
        let bounds = self.proof().bounds;
        picture.bounds_deg = [bounds.min_deg(), bounds.max_deg()];
        picture.overlay = overlay;
        let mut view = MeshView::new(self.mesh())
            .with_input_indices(&self.input_of_vertex)
            .with_certificate(self.proof())
            .with_picture(picture);
        if !matches!(self.made, Made::Points(..)) {
            view = view.with_marked_edges(&self.edges).with_vertex_markers(self.markers());
        }
        if let Made::Graph(made) = &self.made {
            view = view.with_seeds(&made.graph.holes, &made.graph.regions);
        }
        if !self.regions.is_empty() {
            view = view.with_regions(&self.regions);
        }
        if let Some(heights) = &self.heights {
            view = view.with_heights(heights);
        }
        if let Some(promised) = promised {
            view = view.with_promised(promised);
        }
        view
    }

    /// What is to be said of a mesh of a graph, in words.
    fn notes_of(made: &PslgTriangulation) -> JsValue {
        let entries = |list: &[hexdel::pslg::Exception], graph: &Pslg| -> Vec<(String, DVec2)> {
            let entry = |e| ExceptionEntry::new(e, graph);
            list.iter().map(entry).map(|e| (e.to_string(), e.at)).collect()
        };
        let mut failed = entries(&made.failed, &made.graph);
        if let Some(found) = made.dual_edges.as_ref().filter(|found| !found.holds())
            && let Some(worst) = found.worst
        {
            let text =
                format!("{} dual edges are shorter than {} of their edges", found.below, found.min_ratio);
            failed.push((text, worst.ends[0].midpoint(worst.ends[1])));
        }
        let repairs = made.repairs.iter().flat_map(|report| &report.repairs).map(RepairEntry::new);
        let warnings = made.warnings.iter().map(|w| (w.to_string(), w.at()));
        Record::default()
            .with("failed", noted(failed))
            .with("exempt", noted(entries(&made.exempt, &made.graph)))
            .with("repairs", noted(repairs.map(|r| (r.to_string(), r.at)).collect()))
            .with("warnings", noted(warnings.collect()))
            .done()
    }
}

/// Texts with their places.
fn noted(list: Vec<(String, DVec2)>) -> js_sys::Array {
    let entry = |(text, at): (String, DVec2)| {
        Record::default().with("text", text).with("x", at.x).with("y", at.y).done()
    };
    list.into_iter().map(entry).collect()
}

#[wasm_bindgen]
impl RawMesh {
    /// x and y of the vertices by turns.
    #[wasm_bindgen(getter)]
    pub fn vertices(&self) -> Vec<f64> {
        flat(&self.mesh().vertices)
    }

    /// The corners of the triangles, three by three.
    #[wasm_bindgen(getter)]
    pub fn triangles(&self) -> Vec<u32> {
        self.mesh().triangles.iter().flat_map(|t| t.map(|v| v.index() as u32)).collect()
    }

    #[wasm_bindgen(getter)]
    pub fn input_of_vertex(&self) -> Vec<i32> {
        indices(self.input_of_vertex.iter().map(|i| i.map(|i| i as usize)))
    }

    #[wasm_bindgen(getter)]
    pub fn vertex_of_input(&self) -> Vec<i32> {
        indices(self.vertex_of_input.iter().map(|v| v.map(VertexId::index)))
    }

    #[wasm_bindgen(getter)]
    pub fn vertex_markers(&self) -> Vec<i32> {
        self.markers().to_vec()
    }

    /// The ends of the edges on segments and the boundary, two by two.
    #[wasm_bindgen(getter)]
    pub fn segment_edges(&self) -> Vec<u32> {
        self.edges.iter().flat_map(|e| e.ends.map(|v| v.index() as u32)).collect()
    }

    #[wasm_bindgen(getter)]
    pub fn segment_edge_markers(&self) -> Vec<i32> {
        self.edges.iter().map(|e| e.marker).collect()
    }

    /// The attribute of each triangle's region; empty if there are no regions.
    #[wasm_bindgen(getter)]
    pub fn regions(&self) -> Vec<f64> {
        self.regions.clone()
    }

    /// The height of each vertex; empty if the points have none.
    #[wasm_bindgen(getter)]
    pub fn vertex_heights(&self) -> Vec<f64> {
        self.heights.clone().unwrap_or_default()
    }

    #[wasm_bindgen(getter)]
    pub fn holds(&self) -> bool {
        match &self.made {
            Made::Points(made, ..) => made.certificate.holds(),
            Made::Graph(made) => made.holds(),
            Made::Session(_, check) => check.holds(),
        }
    }

    #[wasm_bindgen(getter)]
    pub fn budget_spent(&self) -> bool {
        match &self.made {
            Made::Points(made, ..) => made.budget_spent,
            Made::Graph(made) => made.budget_spent,
            Made::Session(..) => false,
        }
    }

    /// The certificate as JSON.
    #[wasm_bindgen(getter)]
    pub fn certificate(&self) -> Result<String, JsValue> {
        json(self.proof())
    }

    /// The report of the program as JSON; of a session the certificate.
    pub fn report(&self) -> Result<String, JsValue> {
        match &self.made {
            Made::Points(made, ..) => json(&made.report()),
            Made::Graph(made) => json(&made.report()),
            Made::Session(_, check) => json(&check.certificate),
        }
    }

    /// What is to be said of a graph: failed and exempt triangles, repairs, warnings.
    pub fn notes(&self) -> JsValue {
        match &self.made {
            Made::Graph(made) => Self::notes_of(made),
            _ => JsValue::UNDEFINED,
        }
    }

    /// The smallest angle of each triangle, degrees.
    pub fn smallest_angles(&self) -> Float32Array {
        let smallest = |t: &[VertexId; 3]| {
            let angles = quality::angles_deg(t.map(|v| self.mesh().vertices[v.index()]));
            angles.into_iter().fold(f64::INFINITY, f64::min) as f32
        };
        let all: Vec<f32> = self.mesh().triangles.iter().map(smallest).collect();
        Float32Array::from(&all[..])
    }

    /// How many angles there are in each of so many equal parts of 180 degrees.
    pub fn histogram(&self, bins: u32) -> Vec<u32> {
        let bins = bins.clamp(1, 18_000);
        let mut counts = vec![0; bins as usize];
        for t in &self.mesh().triangles {
            for angle in quality::angles_deg(t.map(|v| self.mesh().vertices[v.index()])) {
                let bin = (angle / 180.0 * f64::from(bins)) as usize;
                counts[bin.min(bins as usize - 1)] += 1;
            }
        }
        counts
    }

    /// The Voronoi dual: circumcentres by triangle; areas and corners of cells by vertex.
    pub fn dual(&self) -> Result<JsValue, JsValue> {
        let dual = Voronoi::new(self.mesh()).map_err(|error| errors::plain("dual", &error.to_string()))?;
        let mut offsets: Vec<u32> = vec![0];
        let mut corners: Vec<DVec2> = Vec::new();
        for v in 0..self.mesh().vertices.len() {
            corners.extend(dual.cell(VertexId::new(v)));
            offsets.push(corners.len() as u32);
        }
        Ok(Record::default()
            .with("circumcentres", Float64Array::from(&flat(&dual.circumcentres)[..]))
            .with("areas", Float64Array::from(&dual.areas[..]))
            .with("cellOffsets", Uint32Array::from(&offsets[..]))
            .with("cellCorners", Float64Array::from(&flat(&corners)[..]))
            .done())
    }

    /// The hexagons behind a mesh of points, if it has any: offsets into their corners, levels
    /// from the coarsest, and classes with their names.
    pub fn hexagons(&self) -> JsValue {
        let Made::Points(made, ..) = &self.made else { return JsValue::UNDEFINED };
        let Overlay { classes, polygons, .. } = made.overlay();
        if polygons.is_empty() {
            return JsValue::UNDEFINED;
        }
        let mut offsets: Vec<u32> = vec![0];
        let mut corners: Vec<DVec2> = Vec::new();
        for polygon in &polygons {
            corners.extend(&polygon.corners);
            offsets.push(corners.len() as u32);
        }
        let levels: Vec<u32> = polygons.iter().map(|p| p.level).collect();
        let of_polygon: Vec<u8> = polygons.iter().map(|p| p.class as u8).collect();
        let names: js_sys::Array = classes.into_iter().map(|class| JsValue::from(class.label)).collect();
        Record::default()
            .with("offsets", Uint32Array::from(&offsets[..]))
            .with("corners", Float64Array::from(&flat(&corners)[..]))
            .with("levels", Uint32Array::from(&levels[..]))
            .with("classes", Uint8Array::from(&of_polygon[..]))
            .with("classNames", names)
            .done()
    }

    /// The mesh as a file in a format, as the program writes it; `node` and `ele` are the two
    /// files of Triangle's pair.
    pub fn write(&self, format: &str) -> Result<Vec<u8>, JsValue> {
        let known = MeshFormat::from_name(format)
            .ok_or_else(|| errors::plain("file", &format!("there is no format {format:?}")))?;
        let promised = self.promised();
        let view = self.view(promised.as_ref(), None);
        let mut bytes = Vec::new();
        let name = "the file";
        let written = match (known, format) {
            (MeshFormat::NodeEle, "node") => write_mesh_pair_to(&mut bytes, &mut io::sink(), &view, name),
            (MeshFormat::NodeEle, _) => write_mesh_pair_to(&mut io::sink(), &mut bytes, &view, name),
            _ => write_mesh_to(&mut bytes, known, &view, name),
        };
        written.map_err(|error| errors::plain("file", &error.to_string()))?;
        Ok(bytes)
    }
}
