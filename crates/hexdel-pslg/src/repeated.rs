//! Segments without length and those that are there twice: nothing is lost without them.

use crate::repair::{Repair, RepairReport};
use hexdel_geom::{PointSet, Pslg};
use rustc_hash::FxHashMap;
use std::collections::hash_map::Entry;

/// The PSLG without segments that have no length or the ends of another, if there are any,
/// and what became of which. Points at the same place count as one. Of several segments that
/// are the same the first stays, with the first marker that is not 0.
///
/// ```
/// use hexdel_geom::{DVec2, Pslg};
/// use hexdel_pslg::drop_repeated;
///
/// let mut graph = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::X]);
/// graph.segments = vec![[0, 1], [1, 2], [2, 0]];
/// let (dropped, report) = drop_repeated(&graph).unwrap();
/// assert_eq!(dropped.segments, [[0, 1]]);
/// assert_eq!(report.repairs.len(), 2);
/// assert!(drop_repeated(&dropped).is_none());
/// ```
///
/// # Complexity
///
/// Near-linear.
pub fn drop_repeated(pslg: &Pslg) -> Option<(Pslg, RepairReport)> {
    // What is wrong with arrays and points validation says.
    pslg.check_layout().ok()?;
    let points = PointSet::new(&pslg.points).ok()?;
    let site = |p: u32| points.site_of_input()[p as usize];
    let mut report = RepairReport::default();
    let mut kept: Vec<usize> = Vec::with_capacity(pslg.segments.len());
    let mut markers = pslg.segment_markers.clone();
    // By segment given: which it is now.
    let mut number: Vec<Option<u32>> = Vec::with_capacity(pslg.segments.len());
    let mut first: FxHashMap<[u32; 2], usize> = FxHashMap::default();
    for (i, ends) in pslg.segments.iter().enumerate() {
        let [a, b] = ends.map(site);
        if a == b {
            let at = pslg.points[ends[0] as usize];
            report.repairs.push(Repair::DroppedSegment { segment: i as u32, at });
            number.push(None);
            continue;
        }
        match first.entry([a.min(b), a.max(b)]) {
            Entry::Vacant(entry) => {
                number.push(Some(kept.len() as u32));
                entry.insert(kept.len());
                kept.push(i);
                report.sources.push(vec![i as u32]);
            }
            Entry::Occupied(entry) => {
                number.push(Some(*entry.get() as u32));
                let same = kept[*entry.get()];
                let ends = ends.map(|p| pslg.points[p as usize]);
                report.repairs.push(Repair::MergedSegments { segments: [same as u32, i as u32], ends });
                report.sources[*entry.get()].push(i as u32);
                if markers.get(same) == Some(&0) {
                    markers[same] = markers[i];
                }
            }
        }
    }
    if report.repairs.is_empty() {
        return None;
    }
    report.point_of_input = (0..pslg.points.len() as u32).collect();
    report.complete = true;
    let mut graph = pslg.clone();
    graph.segments = kept.iter().map(|&i| pslg.segments[i]).collect();
    for ring in graph.polygons.iter_mut().flat_map(|polygon| &mut polygon.rings) {
        *ring = ring.iter().filter_map(|&segment| number[segment as usize]).collect();
    }
    graph.segment_markers = kept.iter().filter_map(|&i| markers.get(i).copied()).collect();
    Some((graph, report))
}
