//! Points with sizes, each of which grows with the distance: the minimum of
//! many cones, in a tree that leaves out what cannot be the least.

use super::SizeError;
use hexdel_geom::DVec2;

/// Points below one node at which the tree ends.
const LEAF: usize = 8;

/// The cones.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Cones {
    slope: f64,
    /// In the order of the tree: a node's range is halved at its middle.
    points: Vec<(DVec2, f64)>,
    /// Box and least size of each node's range; the children of node `i` are
    /// `2 i + 1` and `2 i + 2`. Follows from `points`.
    #[cfg_attr(feature = "serde", serde(skip))]
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    low: DVec2,
    high: DVec2,
    least: f64,
}

impl Cones {
    pub(super) fn new(mut points: Vec<(DVec2, f64)>, slope: f64) -> Self {
        sort(&mut points);
        let mut cones = Self { slope, points, nodes: Vec::new() };
        cones.build(0, 0, cones.points.len());
        cones
    }

    /// Makes what is not saved.
    pub(super) fn rebuilt(self) -> Self {
        Self::new(self.points, self.slope)
    }

    pub(super) fn check(&self) -> Result<(), SizeError> {
        let bad = |&&(at, size): &&(DVec2, f64)| !(at.is_finite() && size > 0.0 && size.is_finite());
        match self.points.iter().find(bad) {
            Some(&(_, size)) => Err(SizeError::NotPositive { what: "a point".to_owned(), size }),
            None if self.slope > 0.0 => Ok(()),
            None => Err(SizeError::Gradation { gradation: self.slope }),
        }
    }

    pub(super) fn least(&self) -> f64 {
        self.points.iter().map(|p| p.1).fold(f64::INFINITY, f64::min)
    }

    fn build(&mut self, node: usize, from: usize, to: usize) {
        let range = &self.points[from..to];
        let made = Node {
            low: range.iter().fold(DVec2::INFINITY, |l, p| l.min(p.0)),
            high: range.iter().fold(DVec2::NEG_INFINITY, |h, p| h.max(p.0)),
            least: range.iter().map(|p| p.1).fold(f64::INFINITY, f64::min),
        };
        if self.nodes.len() <= node {
            self.nodes.resize(node + 1, made);
        }
        self.nodes[node] = made;
        if to - from > LEAF {
            let middle = from.midpoint(to);
            self.build(2 * node + 1, from, middle);
            self.build(2 * node + 2, middle, to);
        }
    }

    /// The least size at `p`.
    pub(super) fn at(&self, p: DVec2) -> f64 {
        let mut best = f64::INFINITY;
        self.search(0, 0, self.points.len(), p, &mut best);
        best
    }

    fn bound(&self, node: usize, p: DVec2) -> f64 {
        let node = &self.nodes[node];
        node.least + self.slope * p.distance(p.clamp(node.low, node.high))
    }

    fn search(&self, node: usize, from: usize, to: usize, p: DVec2, best: &mut f64) {
        if from == to || self.bound(node, p) >= *best {
            return;
        }
        if to - from <= LEAF {
            for &(at, size) in &self.points[from..to] {
                *best = best.min(size + self.slope * p.distance(at));
            }
            return;
        }
        let middle = from.midpoint(to);
        let children = [(2 * node + 1, from, middle), (2 * node + 2, middle, to)];
        let first = usize::from(self.bound(children[1].0, p) < self.bound(children[0].0, p));
        for (child, from, to) in [children[first], children[1 - first]] {
            self.search(child, from, to, p, best);
        }
    }
}

/// Puts points in the order of the tree.
fn sort(points: &mut [(DVec2, f64)]) {
    if points.len() <= LEAF {
        return;
    }
    let (low, high) =
        points.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(l, h), p| (l.min(p.0), h.max(p.0)));
    let wide = high.x - low.x >= high.y - low.y;
    let key = |p: DVec2| if wide { (p.x, p.y) } else { (p.y, p.x) };
    let middle = 0_usize.midpoint(points.len());
    points.select_nth_unstable_by(middle, |a, b| {
        let (ka, kb) = (key(a.0), key(b.0));
        ka.0.total_cmp(&kb.0).then(ka.1.total_cmp(&kb.1)).then(a.1.total_cmp(&b.1))
    });
    let (left, right) = points.split_at_mut(middle);
    sort(left);
    sort(right);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_finds_the_least() {
        let points: Vec<(DVec2, f64)> = (0..300)
            .map(|i| (DVec2::new(f64::from(i * 37 % 101), f64::from(i * 53 % 97)), f64::from(1 + i % 17)))
            .collect();
        let cones = Cones::new(points.clone(), 0.4);
        for i in 0..200 {
            let p = DVec2::new(f64::from(i * 7 % 131) - 15.0, f64::from(i * 11 % 127) - 15.0);
            let naive = points.iter().map(|(at, h)| h + 0.4 * p.distance(*at)).fold(f64::INFINITY, f64::min);
            assert_eq!(cones.at(p), naive);
        }
        assert_eq!(Cones::new(Vec::new(), 1.0).at(DVec2::ZERO), f64::INFINITY);
    }
}
