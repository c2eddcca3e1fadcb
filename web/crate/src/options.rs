//! Options as JavaScript hands them over, as JSON.

use crate::errors;
use hexdel::{AngleBounds, DVec2, Domain, Effort, Mesher, Method, Overlaps, SegmentMethod, Size, SizeError};
use serde::Deserialize;
use std::time::Duration;
use wasm_bindgen::JsValue;

/// Options of all calls that make meshes. What does not belong to a call is refused by the
/// library.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase", deny_unknown_fields)]
pub(crate) struct Options {
    method: MethodName,
    effort: EffortName,
    min_angle: Option<f64>,
    max_angle: Option<f64>,
    min_dual_edge: Option<f64>,
    max_area: Option<f64>,
    /// Seconds.
    budget: Option<f64>,
    domain: Option<DomainName>,
    domain_radius: Option<f64>,
    /// Whether to repair, or the tolerance.
    repair: Option<Repair>,
    segment_method: Option<SegmentMethodName>,
    overlaps: Option<OverlapsName>,
    coarsening: Option<bool>,
    size: Option<Lengths>,
    gradation: Option<f64>,
}

#[derive(Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum MethodName {
    Templates,
    Simple,
    #[default]
    Compact,
}

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum EffortName {
    Draft,
    Fast,
    #[default]
    Standard,
    Best,
    Fewest,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum DomainName {
    Hexagon,
    Hull,
    Box,
    Inside,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SegmentMethodName {
    Conform,
    Paper,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum OverlapsName {
    Later,
    Refuse,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(untagged)]
enum Repair {
    Asked(bool),
    Within(f64),
}

/// How long edges may be: everywhere, or by place.
#[derive(Deserialize)]
#[serde(untagged)]
enum Lengths {
    Everywhere(f64),
    Parts(Vec<Part>),
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Part {
    Constant(f64),
    Polygon {
        polygon: Vec<[f64; 2]>,
        length: f64,
    },
    /// x, y and length of each.
    Points {
        points: Vec<[f64; 3]>,
    },
}

impl Options {
    pub(crate) fn read(json: &str) -> Result<Self, JsValue> {
        serde_json::from_str(json).map_err(|error| {
            let text = error.to_string();
            // The place in the JSON means nothing to who called.
            let text = text.rsplit_once(" at line ").map_or(text.as_str(), |(what, _)| what);
            errors::plain("option", text)
        })
    }

    /// The mesher of points, or of a graph.
    pub(crate) fn mesher(&self, of_graph: bool) -> Result<Mesher, JsValue> {
        let method = self.method();
        let mut mesher = Mesher::new().method(method).effort(self.effort());
        if self.min_angle.is_some() || self.max_angle.is_some() {
            let simple = method == Method::Simple && !of_graph;
            let usual = if simple { AngleBounds::SIMPLE } else { AngleBounds::EXTENDED };
            mesher = mesher.bounds(self.bounds([usual.min_deg(), usual.max_deg()])?);
            if of_graph {
                mesher = mesher.near_bounds(self.bounds([30.0, 90.0])?);
            }
        }
        if let Some(ratio) = self.min_dual_edge {
            mesher = mesher.min_dual_edge(ratio);
        }
        if let Some(coarsening) = self.coarsening {
            mesher = mesher.coarsening(coarsening);
        }
        if let Some(seconds) = self.budget {
            let budget = Duration::try_from_secs_f64(seconds)
                .map_err(|_| errors::plain("option", "the budget must be a number of seconds"))?;
            mesher = mesher.budget(budget);
        }
        if let Some(radius) = self.domain_radius {
            mesher = mesher.domain_radius(radius);
        }
        if let Some(size) = self.size(of_graph)? {
            mesher = mesher.size(size);
        }
        if of_graph && let Some(area) = self.max_area {
            mesher = mesher.max_area(area);
        }
        Ok(self.for_graphs(mesher))
    }

    /// Adds options that are for graphs.
    fn for_graphs(&self, mut mesher: Mesher) -> Mesher {
        if let Some(domain) = self.domain {
            mesher = mesher.domain(match domain {
                DomainName::Hexagon => Domain::Hexagon,
                DomainName::Hull => Domain::Hull,
                DomainName::Box => Domain::Box,
                DomainName::Inside => Domain::Inside,
            });
        }
        if let Some(way) = self.segment_method {
            mesher = mesher.segment_method(match way {
                SegmentMethodName::Conform => SegmentMethod::Conform,
                SegmentMethodName::Paper => SegmentMethod::Paper,
            });
        }
        if matches!(self.overlaps, Some(OverlapsName::Refuse)) {
            mesher = mesher.overlaps(Overlaps::Refuse);
        }
        match self.repair {
            None | Some(Repair::Asked(false)) => mesher,
            Some(Repair::Asked(true)) => mesher.repair(),
            Some(Repair::Within(tolerance)) => mesher.repair_within(tolerance),
        }
    }

    pub(crate) fn method(&self) -> Method {
        match self.method {
            MethodName::Templates => Method::Templates,
            MethodName::Simple => Method::Simple,
            MethodName::Compact => Method::Compact,
        }
    }

    /// Whether points need to be meshed as a graph without segments: in a domain that is no
    /// hexagon.
    pub(crate) fn makes_graph(&self) -> bool {
        self.domain.is_some_and(|domain| !matches!(domain, DomainName::Hexagon))
    }

    fn effort(&self) -> Effort {
        match self.effort {
            EffortName::Draft => Effort::Repair,
            EffortName::Fast => Effort::Fast,
            EffortName::Standard => Effort::Standard,
            EffortName::Best => Effort::Best,
            EffortName::Fewest => Effort::Fewest,
        }
    }

    fn bounds(&self, [min, max]: [f64; 2]) -> Result<AngleBounds, JsValue> {
        AngleBounds::new(self.min_angle.unwrap_or(min), self.max_angle.unwrap_or(max))
            .map_err(|error| errors::plain("bounds", &error.to_string()))
    }

    /// How long edges may be, if anything says so; of points by the largest area, too.
    pub(crate) fn size(&self, of_graph: bool) -> Result<Option<Size>, JsValue> {
        let area = self.max_area.filter(|_| !of_graph);
        if self.size.is_none() && area.is_none() {
            return Ok(None);
        }
        self.sized(area).map(Some).map_err(|error| errors::of_size(&error))
    }

    fn sized(&self, area: Option<f64>) -> Result<Size, SizeError> {
        let mut size = Size::unlimited();
        if let Some(gradation) = self.gradation {
            size = size.with_gradation(gradation)?;
        }
        size = match &self.size {
            None => size,
            Some(Lengths::Everywhere(length)) => size.and_constant(*length)?,
            Some(Lengths::Parts(parts)) => parts.iter().try_fold(size, |size, part| match part {
                Part::Constant(length) => size.and_constant(*length),
                Part::Polygon { polygon, length } => {
                    size.and_polygon(polygon.iter().copied().map(DVec2::from).collect(), *length)
                }
                Part::Points { points } => {
                    let points: Vec<_> = points.iter().map(|&[x, y, h]| (DVec2::new(x, y), h)).collect();
                    size.and_points(&points)
                }
            })?,
        };
        area.map_or(Ok(size.clone()), |area| Ok(size.and(Size::area(area)?)))
    }
}
