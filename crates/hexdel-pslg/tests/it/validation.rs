//! What validation names, and what repair does about it.

use hexdel_geom::{DVec2, Pslg, PslgLayoutError};
use hexdel_pslg::{Repair, ValidateError, repair, validate, violations};

fn graph(points: &[(f64, f64)], segments: &[[u32; 2]]) -> Pslg {
    Pslg {
        segments: segments.to_vec(),
        ..Pslg::from_points(points.iter().map(|&(x, y)| DVec2::new(x, y)).collect())
    }
}

#[test]
fn every_crossing_is_named() {
    let hash = graph(
        &[(0.0, 1.0), (3.0, 1.0), (0.0, 2.0), (3.0, 2.0), (1.0, 0.0), (1.0, 3.0)],
        &[[0, 1], [2, 3], [4, 5]],
    );
    let crossing = |i, x, y| ValidateError::Crossing { segments: [i, 2], at: DVec2::new(x, y) };
    assert_eq!(violations(&hash), [crossing(0, 1.0, 1.0)]);
    let (mended, report) = repair(&hash, 0.0).unwrap();
    assert!(report.complete);
    assert_eq!(mended.segments.len(), 7);
    assert!(validate(&mended).is_ok());
    let made = |r: &&Repair| matches!(r, Repair::DividedAtCrossing { .. });
    assert_eq!(report.repairs.iter().filter(made).count(), 2);
}

#[test]
fn overlaps_duplicates_and_points_are_told_apart() {
    let line = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)];
    let faults = violations(&graph(&line, &[[0, 2], [1, 3]]));
    assert!(matches!(faults[..], [ValidateError::Overlap { segments: [0, 1], .. }]), "{faults:?}");
    let faults = violations(&graph(&line, &[[0, 1], [1, 0]]));
    assert!(matches!(faults[..], [ValidateError::Duplicate { segments: [0, 1], .. }]), "{faults:?}");
    let faults = violations(&graph(&line, &[[2, 2]]));
    assert_eq!(faults, [ValidateError::ZeroLength { segment: 0, at: DVec2::new(2.0, 0.0) }]);
    let valid = validate(&graph(&line, &[[0, 3]])).unwrap();
    let divided: Vec<_> = valid.divided().iter().map(|d| (d.segment, d.point)).collect();
    assert_eq!(divided, [(0, 1), (0, 2)]);
}

#[test]
fn bad_arrays_and_numbers_are_named() {
    let out = graph(&[(0.0, 0.0)], &[[0, 1]]);
    let layout = PslgLayoutError::SegmentEnd { segment: 0, point: 1, points: 1 };
    assert_eq!(validate(&out).err(), Some(ValidateError::Layout(layout)));
    assert!(matches!(validate(&graph(&[], &[])), Err(ValidateError::Points(_))));
    assert!(matches!(validate(&graph(&[(f64::NAN, 0.0)], &[])), Err(ValidateError::Points(_))));
    assert!(matches!(validate(&graph(&[(1e80, 0.0)], &[])), Err(ValidateError::OutOfRange { .. })));
    let mut hole = graph(&[(0.0, 0.0)], &[]);
    hole.holes.push(DVec2::splat(f64::INFINITY));
    assert!(matches!(validate(&hole), Err(ValidateError::NotFinite { item: "hole", .. })));
}

#[test]
fn near_duplicates_and_near_touches_are_merged_within_the_tolerance() {
    let gap = 1e-7;
    let bad = graph(
        &[(0.0, 0.0), (1.0, 0.0), (1.0 + gap, 0.0), (2.0, 1.0), (0.5, gap), (0.5, 1.0)],
        &[[0, 1], [2, 3], [4, 5]],
    );
    assert!(validate(&bad).is_ok());
    let (mended, report) = repair(&bad, 1e-6).unwrap();
    assert_eq!(mended.points.len(), 5);
    assert_eq!(report.point_of_input, [0, 1, 1, 2, 3, 4]);
    assert_eq!(mended.segments.len(), 4);
    let halves = report.sources.iter().filter(|s| **s == [0]).count();
    assert_eq!(halves, 2);
    assert!(report.repairs.iter().any(|r| matches!(r, Repair::MergedPoint { point: 2, into: 1, .. })));
}

#[test]
fn repair_keeps_markers_and_attributes() {
    let mut cross = graph(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)], &[[0, 1], [2, 3]]);
    cross.point_markers = vec![1, 2, 3, 4];
    cross.segment_markers = vec![0, 9];
    cross.point_attributes = vec![0.1, 0.2, 0.3, 0.4];
    cross.attributes_per_point = 1;
    let (mended, _) = repair(&cross, 0.0).unwrap();
    assert_eq!(mended.check_layout(), Ok(()));
    assert_eq!(mended.point_markers, [1, 2, 3, 4, 9]);
    assert_eq!(mended.point_attributes[4], 0.0);
    let mut markers = mended.segment_markers.clone();
    markers.sort_unstable();
    assert_eq!(markers, [0, 0, 9, 9]);
}

#[test]
fn a_thousand_spokes_are_near_linear() {
    // All pairs would be half a million tests on each of many levels.
    let mut spokes = graph(&[(0.0, 0.0)], &[]);
    for i in 0..1000 {
        spokes.points.push(DVec2::from_angle(f64::from(i) * 0.006) * (1.0 + f64::from(i % 7)));
        spokes.segments.push([0, i as u32 + 1]);
    }
    assert!(validate(&spokes).is_ok());
    assert!(repair(&spokes, 0.0).unwrap().1.repairs.is_empty());
}

#[test]
fn what_is_too_small_for_exact_arithmetic_is_named() {
    for scale in [1e-61, 1e-155, 1e-165, 1e-200, 1e-310] {
        let small = |p: &(f64, f64)| (p.0 * scale, p.1 * scale);
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.5, 0.0), (0.5, 0.7)];
        let points: Vec<(f64, f64)> = corners.iter().map(small).collect();
        let tiny = graph(&points, &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5]]);
        assert!(matches!(validate(&tiny), Err(ValidateError::TooSmall { .. })), "{scale}");
        // Only a part of the PSLG: whatever is said, there is no panic.
        let mut points = points;
        points.push((1.0, 2.0));
        let _ = validate(&graph(&points, &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5]]));
    }
    assert!(validate(&graph(&[(1e-300, 0.0)], &[])).is_ok());
}

#[test]
fn a_tolerance_below_all_coordinates_takes_no_longer() {
    let points: Vec<(f64, f64)> = (0..20_000).map(|i| (f64::from(i % 141), f64::from(i / 141))).collect();
    for tolerance in [1e-30, 1e-300] {
        let (mended, report) = repair(&graph(&points, &[]), tolerance).unwrap();
        assert_eq!((mended.points.len(), report.repairs.len()), (20_000, 0));
    }
    let close = graph(&[(1.0, 0.0), (1.0, 1e-31), (1.0, 3e-30)], &[]);
    assert_eq!(repair(&close, 1e-30).unwrap().0.points.len(), 2);
}
