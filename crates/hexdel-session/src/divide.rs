//! A PSLG with points more or fewer, its segments divided at those on them.

use super::PointId;
use hexdel_geom::{DVec2, Pslg};

/// What the points and segments of a divided PSLG are.
#[derive(Clone, Debug)]
pub(super) struct Divided {
    /// The number of each point in the session.
    pub(super) ids: Vec<PointId>,
    /// The segment that each segment is a part of, ascending.
    pub(super) whole: Vec<u32>,
    /// Points between the ends of whole segments.
    pub(super) joints: Vec<u32>,
}

impl Divided {
    /// A PSLG as it is.
    pub(super) fn none(graph: &Pslg) -> Self {
        Self {
            ids: (0..graph.points.len() as u64).map(PointId).collect(),
            whole: (0..graph.segments.len() as u32).collect(),
            joints: Vec::new(),
        }
    }
}

/// A PSLG that points are added to.
#[derive(Clone, Debug)]
pub(super) struct Divider {
    graph: Pslg,
    ids: Vec<PointId>,
    /// Points on segments: the segment, how far along, and the point.
    joints: Vec<(u32, f64, u32)>,
}

impl Divider {
    /// A PSLG without the points that are gone, but for ends of segments.
    pub(super) fn of(graph: &Pslg, is_there: impl Fn(usize) -> bool) -> Self {
        let mut kept: Vec<bool> = (0..graph.points.len()).map(is_there).collect();
        graph.segments.iter().flatten().for_each(|&p| kept[p as usize] = true);
        let left: Vec<usize> = (0..kept.len()).filter(|&i| kept[i]).collect();
        let name = |p: u32| left.partition_point(|&i| i < p as usize) as u32;
        let thinned = Pslg {
            points: left.iter().map(|&i| graph.points[i]).collect(),
            segments: graph.segments.iter().map(|s| s.map(name)).collect(),
            holes: graph.holes.clone(),
            regions: graph.regions.clone(),
            ..Pslg::default()
        };
        Self {
            graph: thinned,
            ids: left.into_iter().map(|i| PointId(i as u64)).collect(),
            joints: Vec::new(),
        }
    }

    /// Adds a point, on a segment of the PSLG if one is named.
    pub(super) fn add(&mut self, id: PointId, at: DVec2, on: Option<u32>) {
        let point = self.graph.points.len() as u32;
        self.graph.points.push(at);
        self.ids.push(id);
        if let Some(segment) = on {
            let [a, b] = self.graph.segments[segment as usize].map(|p| self.graph.points[p as usize]);
            self.joints.push((segment, (at - a).dot(b - a), point));
        }
    }

    /// The PSLG with its segments divided.
    pub(super) fn divided(mut self) -> (Pslg, Divided) {
        self.joints.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        let (mut segments, mut whole) = (Vec::new(), Vec::new());
        for (s, &[from, to]) in (0..).zip(&self.graph.segments) {
            let on = self.joints.iter().filter(|joint| joint.0 == s).map(|joint| joint.2);
            let stops: Vec<u32> = std::iter::once(from).chain(on).chain([to]).collect();
            segments.extend(stops.windows(2).map(|w| [w[0], w[1]]));
            whole.resize(segments.len(), s);
        }
        self.graph.segments = segments;
        let joints = self.joints.into_iter().map(|joint| joint.2).collect();
        (self.graph, Divided { ids: self.ids, whole, joints })
    }
}
