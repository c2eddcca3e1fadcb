//! A mesh that points are put into, moved and taken out of.

use crate::convert::{Record, flat, points};
use crate::errors;
use crate::graph::RawGraph;
use crate::mesh::{Made, RawMesh};
use crate::options::Options;
use hexdel::{DVec2, Outcome, PointId, Session, SessionError};
use js_sys::{Array, Float64Array};
use wasm_bindgen::prelude::*;

/// A session.
#[wasm_bindgen]
pub struct RawSession {
    session: Session,
    /// The height of each point by its number, as far as points have some. Those that are not
    /// known, which are no numbers, are between those of others.
    heights: Vec<f64>,
    /// How many steps of the session each call took, the last one at the end.
    steps: Vec<u8>,
}

#[wasm_bindgen]
impl RawSession {
    /// The mesh of points or a graph as a session.
    #[wasm_bindgen(constructor)]
    pub fn new(graph: &RawGraph, options: &str) -> Result<Self, JsValue> {
        let mesher = Options::read(options)?.mesher(graph.is_graph())?;
        let session = if graph.is_graph() {
            Session::with_segments(&graph.pslg, &mesher)
        } else {
            Session::new(&graph.pslg.points, &mesher)
        };
        let session = session.map_err(|error| errors::of_session(&error))?;
        Ok(Self { heights: graph.of_points().unwrap_or_default(), ..Self::of(session) })
    }

    /// A mesh that has been made of points, as a session.
    pub fn of_mesh(mesh: &RawMesh) -> Result<Self, JsValue> {
        let Made::Points(made, mesher) = &mesh.made else {
            return Err(errors::plain("option", "only the mesh of points becomes a session"));
        };
        let session = Session::of((**made).clone(), mesher).map_err(|error| errors::of_session(&error))?;
        Ok(Self { heights: mesh.heights_of_points().unwrap_or_default(), ..Self::of(session) })
    }

    /// A hexagonal domain without points.
    pub fn empty(x: f64, y: f64, radius: f64) -> Result<Self, JsValue> {
        let session = Session::empty(DVec2::new(x, y), radius);
        session.map(Self::of).map_err(|error| errors::of_session(&error))
    }

    /// A saved session.
    pub fn of_text(text: &str) -> Result<Self, JsValue> {
        Session::from_ron(text).map(Self::of).map_err(|error| errors::of_session(&error))
    }

    /// The session as text.
    pub fn text(&self) -> Result<String, JsValue> {
        self.session.to_ron().map_err(|error| errors::of_session(&error))
    }

    /// Whether calls from now on make drafts.
    pub fn draft(&mut self, drafts: bool) {
        self.session.draft(drafts);
    }

    /// Puts points in, all or none, with their heights if they have some.
    pub fn insert(&mut self, flat: &[f64], heights: &[f64]) -> Result<JsValue, JsValue> {
        let points = points("points", flat)?;
        self.change(heights, |session| Ok(vec![session.insert_all(&points)?]))
    }

    /// Takes points out, all or none.
    pub fn remove(&mut self, ids: &[u32]) -> Result<JsValue, JsValue> {
        let ids: Vec<PointId> = ids.iter().map(|&id| PointId(u64::from(id))).collect();
        self.change(&[], |session| Ok(vec![session.remove(&ids)?]))
    }

    /// Takes points out and puts others in: all of it or nothing. If these are as many and come
    /// without heights, they keep those of the points before.
    pub fn replace(&mut self, ids: &[u32], flat: &[f64], heights: &[f64]) -> Result<JsValue, JsValue> {
        let points = points("points", flat)?;
        let kept: Vec<f64> = if heights.is_empty() && ids.len() == points.len() {
            ids.iter().map_while(|&id| self.heights.get(id as usize).copied()).collect()
        } else {
            heights.to_vec()
        };
        let ids: Vec<PointId> = ids.iter().map(|&id| PointId(u64::from(id))).collect();
        self.change(&kept, |session| {
            let removed = session.remove(&ids)?;
            match session.insert_all(&points) {
                Ok(inserted) => Ok(vec![removed, inserted]),
                Err(error) => {
                    // The call that has just succeeded.
                    let _ = session.undo();
                    Err(error)
                }
            }
        })
    }

    /// Takes the last call back.
    pub fn undo(&mut self) -> Result<JsValue, JsValue> {
        let steps = self.steps.pop().unwrap_or(1);
        let undone: Result<Vec<Outcome>, SessionError> = (0..steps).map(|_| self.session.undo()).collect();
        undone.map(outcomes_out).map_err(|error| errors::of_session(&error))
    }

    /// Meshes all points anew.
    pub fn renew(&mut self) -> Result<JsValue, JsValue> {
        self.change(&[], |session| Ok(vec![session.renew()?]))
    }

    /// Sets how long edges may be, by options of which others are left.
    pub fn set_size(&mut self, options: &str) -> Result<JsValue, JsValue> {
        let size = Options::read(options)?.size(false)?;
        self.change(&[], |session| Ok(vec![session.set_size(size)?]))
    }

    /// Numbers of the points that are there.
    #[wasm_bindgen(getter)]
    pub fn ids(&self) -> Vec<u32> {
        self.session.points().map(|(id, _)| id.0 as u32).collect()
    }

    /// Places of the points that are there.
    #[wasm_bindgen(getter)]
    pub fn points(&self) -> Vec<f64> {
        let places: Vec<DVec2> = self.session.points().map(|(_, p)| p).collect();
        flat(&places)
    }

    /// Centre and circumradius of the domain.
    #[wasm_bindgen(getter)]
    pub fn domain(&self) -> Vec<f64> {
        let (centre, radius) = self.session.domain();
        vec![centre.x, centre.y, radius]
    }

    /// The mesh as it stands.
    pub fn mesh(&self) -> Result<RawMesh, JsValue> {
        let made = self.session.mesh();
        let height = |id: PointId| self.heights.get(id.0 as usize).copied().filter(|height| !height.is_nan());
        let heights = self.session.vertex_values(&made, height);
        let heights = heights.map_err(|error| errors::of_session(&error))?;
        let regions = self.session.region_attributes(&made);
        let regions = if regions.iter().all(|&r| r == 0.0) { Vec::new() } else { regions };
        Ok(RawMesh::of_session(made, self.session.check(), regions, heights))
    }

    /// The arrays of the mesh as it stands, without its certificate.
    pub fn arrays(&self) -> JsValue {
        let mesh = self.session.plain_mesh();
        let triangles: Vec<u32> = mesh.triangles.iter().flat_map(|t| t.map(|v| v.index() as u32)).collect();
        Record::default()
            .with("vertices", Float64Array::from(&flat(&mesh.vertices)[..]))
            .with("triangles", js_sys::Uint32Array::from(&triangles[..]))
            .done()
    }
}

impl RawSession {
    /// The domain follows points out of it, unless it is that of a graph.
    fn of(session: Session) -> Self {
        Self { session: session.growing(true), heights: Vec::new(), steps: Vec::new() }
    }

    /// A call that puts points in with these heights.
    fn change(
        &mut self,
        heights: &[f64],
        call: impl FnOnce(&mut Session) -> Result<Vec<Outcome>, SessionError>,
    ) -> Result<JsValue, JsValue> {
        let outcomes = call(&mut self.session).map_err(|error| errors::of_session(&error))?;
        self.steps.push(outcomes.len() as u8);
        let inserted = outcomes.last().map_or(&[][..], |outcome| &outcome.points);
        for (PointId(id), &height) in inserted.iter().zip(heights) {
            let id = *id as usize;
            self.heights.resize(self.heights.len().max(id + 1), f64::NAN);
            self.heights[id] = height;
        }
        Ok(outcomes_out(outcomes))
    }
}

fn outcomes_out(outcomes: Vec<Outcome>) -> JsValue {
    outcomes.into_iter().map(outcome_out).collect::<Array>().into()
}

fn outcome_out(outcome: Outcome) -> JsValue {
    let Outcome { points, delta, remeshed, .. } = outcome;
    let numbers = |list: &[u64]| {
        let list: Vec<f64> = list.iter().map(|&n| n as f64).collect();
        Float64Array::from(&list[..])
    };
    let moved = |list: &[(u64, DVec2)]| {
        let (ids, places): (Vec<u64>, Vec<DVec2>) = list.iter().copied().unzip();
        Record::default()
            .with("ids", numbers(&ids))
            .with("places", Float64Array::from(&flat(&places)[..]))
            .done()
    };
    let (ids, corners): (Vec<u64>, Vec<[u64; 3]>) = delta.triangles_added.iter().copied().unzip();
    let triangles =
        Record::default().with("ids", numbers(&ids)).with("corners", numbers(corners.as_flattened())).done();
    let points: Vec<u64> = points.iter().map(|id| id.0).collect();
    Record::default()
        .with("points", numbers(&points))
        .with("remeshed", remeshed)
        .with("verticesRemoved", numbers(&delta.vertices_removed))
        .with("verticesAdded", moved(&delta.vertices_added))
        .with("verticesMoved", moved(&delta.vertices_moved))
        .with("trianglesRemoved", numbers(&delta.triangles_removed))
        .with("trianglesAdded", triangles)
        .done()
}
