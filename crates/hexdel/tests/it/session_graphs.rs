//! Sessions of PSLGs: segments stay, bounds hold by place, and what is refused.

#![cfg(all(feature = "io", feature = "serde"))]

use crate::sessions::{Copy, Tally, refused};
use hexdel::geom::{Region, point_on_segment};
use hexdel::{
    AnySession, DVec2, Domain, Mesher, Outcome, PointId, Pslg, Session, SessionError, SessionMesh, Size,
};
use proptest::prelude::*;

fn fixture(name: &str) -> Pslg {
    let path = format!("{}/../../fixtures/graphs/{name}.poly", env!("CARGO_MANIFEST_DIR"));
    hexdel::io::read_points(path).unwrap()
}

/// A square from (0, 0) to (4, 4), with a segment across that leans, in two
/// regions, and a point in one of them.
fn plate() -> Pslg {
    let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (1.3, 0.0), (2.9, 4.0), (0.7, 2.2)];
    let mut plate = Pslg::from_points(points.map(DVec2::from).to_vec());
    plate.segments = vec![[0, 4], [4, 1], [1, 2], [2, 5], [5, 3], [3, 0], [4, 5]];
    plate.segment_markers = vec![1, 1, 2, 3, 3, 4, 7];
    let region = |x, attribute| Region { point: DVec2::new(x, 1.0), attribute, max_area: None };
    plate.regions = vec![region(0.5, 1.0), region(3.5, 2.0)];
    plate
}

/// What every state keeps.
#[track_caller]
fn check(session: &Session) {
    let check = session.check();
    assert!(check.holds(), "{:?} {:?}", check.segments.missing, check.out_of_bounds);
    let made = session.mesh();
    assert_eq!(check.segments.edges.len(), made.edges.len());
    assert!(made.edges.iter().all(|e| check.segments.has_edge(e.ends)));
    for (id, v) in &made.points {
        let at = made.mesh.vertices[v.index()];
        assert!(session.points().any(|p| p == (*id, at)), "{id:?}");
    }
    if let Some(size) = session.size() {
        for t in &made.mesh.triangles {
            let corners = t.map(|v| made.mesh.vertices[v.index()]);
            assert!(hexdel::triangle_fits(size, corners), "an edge of {corners:?} is too long");
        }
    }
}

/// One call of a random sequence.
#[derive(Clone, Debug)]
enum Call {
    Insert(f64, f64),
    On(usize, f64),
    Near(usize, f64, f64),
    Remove(usize),
    Size(Option<f64>),
    Undo,
}

fn call() -> impl Strategy<Value = Call> {
    prop_oneof![
        6 => (-0.1..4.1, -0.1..4.1).prop_map(|(x, y)| Call::Insert(x, y)),
        3 => (0..100_usize, 0.05..0.95).prop_map(|(i, t)| Call::On(i, t)),
        2 => (0..100_usize, 0.1..0.9, 1.0..4.0).prop_map(|(i, t, e)| Call::Near(i, t, e)),
        4 => (0..100_usize).prop_map(Call::Remove),
        1 => prop::option::of(0.3..1.5).prop_map(Call::Size),
        2 => Just(Call::Undo),
    ]
}

fn run(session: &mut Session, graph: &Pslg, call: &Call) -> Result<Outcome, SessionError> {
    let ends = |i: usize| graph.segments[i % graph.segments.len()].map(|p| graph.points[p as usize]);
    match *call {
        Call::Insert(x, y) => session.insert(DVec2::new(x, y)),
        Call::On(i, t) => {
            let [a, b] = ends(i);
            session.insert(point_on_segment(a, b, t))
        }
        Call::Near(i, t, exponent) => {
            let [a, b] = ends(i);
            session.insert(a + t * (b - a) + (b - a).perp() * 10_f64.powf(-exponent))
        }
        Call::Remove(i) => {
            let all: Vec<PointId> = session.points().map(|p| p.0).collect();
            session.remove(&[all[i % all.len()]])
        }
        Call::Size(size) => session.set_size(size.map(|h| Size::constant(h).unwrap())),
        Call::Undo => session.undo(),
    }
}

/// Of the calls on random sessions.
static TALLY: Tally = Tally::new();

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, ..ProptestConfig::default() })]

    #[test]
    fn every_state_holds_and_every_delta_tells(calls in prop::collection::vec(call(), 1..14), which in 0..3_usize) {
        let graph = [plate(), fixture("square_with_hole"), fixture("t_junction")][which].clone();
        let mut session = Session::with_segments(&graph, &Mesher::new()).unwrap();
        let mut copy = Copy::of(&session);
        for call in &calls {
            let before = session.to_ron().unwrap();
            let done = run(&mut session, &graph, call);
            TALLY.note(&done);
            if let Ok(outcome) = done {
                copy.follow(&outcome.delta);
            } else {
                prop_assert_eq!(session.to_ron().unwrap(), before, "after {:?}", call);
            }
            check(&session);
            prop_assert!(copy == Copy::of(&session), "after {:?}", call);
        }
        let saved = session.to_ron().unwrap();
        let mut again = Session::from_ron(&saved).unwrap();
        prop_assert_eq!(again.to_ron().unwrap(), saved);
        let next = Call::On(0, 0.321);
        prop_assert_eq!(run(&mut session, &graph, &next), run(&mut again, &graph, &next));
        prop_assert_eq!(again.to_ron().unwrap(), session.to_ron().unwrap());
    }
}

#[test]
fn a_point_on_a_segment_divides_it_until_it_goes() {
    let graph = plate();
    let mut session = Session::with_segments(&graph, &Mesher::new()).unwrap();
    let before = session.counts()[2];
    let [a, b] = [graph.points[4], graph.points[5]];
    // As its caller rounds it: a last place away from the rounded point, perhaps.
    let on = [0.5 * (a + b), a + 0.123 * (b - a), point_on_segment(a, b, 0.77)];
    let ids = session.insert_all(&on).unwrap().points;
    check(&session);
    let made = session.mesh();
    let row: Vec<_> = made.edges.iter().filter(|e| e.segment == Some(6)).collect();
    assert!(row.windows(2).all(|w| w[0].ends[1] == w[1].ends[0]) && row.iter().all(|e| e.marker == 7));
    for p in on {
        let inner = |e: &&&hexdel::pslg::SegmentEdge| made.mesh.vertices[e.ends[1].index()] == p;
        assert_eq!(row.iter().filter(inner).count(), 1, "{p}");
    }
    session.remove(&ids).unwrap();
    check(&session);
    // The mesh made at once has 14 triangles, and a session takes out what it can without moving all of it.
    assert!(session.counts()[2] <= before + 8, "{before} triangles, then {:?}", session.counts());
}

#[test]
fn points_on_the_boundary_are_inside() {
    let mut triangle = Pslg::from_points([(0.1, 0.1), (1.2, 0.3), (0.4, 1.1)].map(DVec2::from).to_vec());
    triangle.segments = vec![[0, 1], [1, 2], [2, 0]];
    let mut session = Session::with_segments(&triangle, &Mesher::new()).unwrap();
    for (i, [a, b]) in triangle.segments.iter().map(|s| s.map(|p| triangle.points[p as usize])).enumerate() {
        for t in [0.5, 0.3, 0.81] {
            session.insert(a + t * (b - a)).unwrap_or_else(|e| panic!("{t} of {i}: {e}"));
            check(&session);
        }
    }
    assert_eq!(session.counts()[0], 12);
}

#[test]
fn regions_and_markers_follow() {
    let graph = plate();
    let mut session = Session::with_segments(&graph, &Mesher::new()).unwrap();
    session.insert_all(&[DVec2::new(2.0, 2.0), DVec2::new(3.0, 1.0), DVec2::new(2.9, 0.0)]).unwrap();
    session.remove(&[PointId(6)]).unwrap();
    let made = session.mesh();
    let [a, b] = [graph.points[4], graph.points[5]];
    for (t, region) in made.mesh.triangles.iter().zip(&made.region_of_triangle) {
        let centre = t.map(|v| made.mesh.vertices[v.index()]).into_iter().sum::<DVec2>() / 3.0;
        let left = (b - a).perp_dot(centre - a) > 0.0;
        assert_eq!(*region, Some(u32::from(!left)), "{centre}");
    }
    for edge in &made.edges {
        let segment = edge.segment.unwrap() as usize;
        assert_eq!((edge.marker, edge.boundary), (graph.segment_markers[segment], segment != 6));
    }
    let on_right = |v: &DVec2| v.x == 4.0 && v.y > 0.0 && v.y < 4.0;
    for (v, marker) in made.mesh.vertices.iter().zip(&made.vertex_markers) {
        assert!(!on_right(v) || *marker == 2);
    }
}

#[test]
fn domains_keep_their_sides() {
    let graph = plate();
    for domain in [Domain::Hexagon, Domain::Hull, Domain::Box, Domain::Inside] {
        let mut session = Session::with_segments(&graph, &Mesher::new().domain(domain)).unwrap();
        check(&session);
        let ids = session.insert_all(&[DVec2::new(0.3, 0.2), DVec2::new(3.1, 3.3)]).unwrap().points;
        check(&session);
        session.remove(&ids).unwrap();
        check(&session);
        let text = session.to_ron().unwrap();
        assert_eq!(Session::from_ron(&text).unwrap().to_ron().unwrap(), text, "{domain:?}");
    }
}

#[test]
fn narrow_corners_stay_exempt() {
    let mut sliver = Pslg::from_points([(0.0, 0.0), (4.0, 0.0), (4.0, 1.2)].map(DVec2::from).to_vec());
    sliver.segments = vec![[0, 1], [1, 2], [2, 0]];
    let mut session = Session::with_segments(&sliver, &Mesher::new()).unwrap();
    let ids = session.insert_all(&[DVec2::new(3.0, 0.4), DVec2::new(2.0, 0.3)]).unwrap().points;
    check(&session);
    assert_eq!(session.certificate().out_of_bounds, 1);
    session.remove(&ids).unwrap();
    check(&session);
}

#[test]
fn fans_stay_in_narrow_corners() {
    let mut graph = fixture("narrow");
    graph.regions = vec![Region { point: DVec2::new(3.0, 1.0), attribute: 5.0, max_area: None }];
    let mut session = Session::with_segments(&graph, &Mesher::new()).unwrap();
    let regions = |made: &SessionMesh| made.region_of_triangle.iter().filter(|r| r.is_some()).count();
    let at_once = Mesher::new().triangulate_pslg(&graph).unwrap();
    let parts = at_once.region_of_triangle.iter().filter(|r| r.is_some()).count();
    assert_eq!(regions(&session.mesh()), parts, "fans divide no region");
    let edges = session.mesh().edges;
    assert!(edges.iter().all(|e| e.segment.is_some() || e.boundary), "edges of fans are no segments");
    let before = session.certificate().out_of_bounds;
    assert!(before > 3);
    // Inside of a fan, beside it, and far away.
    for at in [(6.9, 3.0), (6.2, 3.0), (3.0, 1.0)] {
        match session.insert(DVec2::from(at)) {
            Ok(change) => {
                check(&session);
                session.remove(&change.points).unwrap();
            }
            Err(error) => assert!(matches!(error, SessionError::NoRoom { .. }), "{error}"),
        }
        check(&session);
    }
    assert_eq!(session.certificate().out_of_bounds, before);
}

#[test]
fn where_there_is_no_room_the_graph_is_meshed_anew() {
    let mut session = Session::with_segments(&fixture("narrow"), &Mesher::new()).unwrap();
    session.insert_all(&[DVec2::new(3.0, 1.0), DVec2::new(5.0, 0.0)]).unwrap();
    // In a fan: its triangles are as they are.
    let fan = DVec2::new(6.9, 3.0);
    let mut copy = Copy::of(&session);
    let before = session.mesh();
    let change = session.insert(fan).unwrap();
    assert!(change.remeshed);
    check(&session);
    copy.follow(&change.delta);
    assert!(copy == Copy::of(&session));
    let text = session.to_ron().unwrap();
    assert_eq!(Session::from_ron(&text).unwrap().to_ron().unwrap(), text);
    copy.follow(&session.undo().unwrap().delta);
    assert!(copy == Copy::of(&session) && session.mesh() == before);
    check(&session);
    let again = session.insert(fan).unwrap();
    session.remove(&again.points).unwrap();
    check(&session);
}

#[test]
fn points_on_segments_are_no_ends_of_them_when_the_graph_is_meshed_anew() {
    let graph = plate();
    let mut session = Session::with_segments(&graph, &Mesher::new()).unwrap();
    let [a, b] = [graph.points[4], graph.points[5]];
    let on = [0.5 * (a + b), a + 0.123 * (b - a), DVec2::new(0.4, 0.0), DVec2::new(2.0, 1.0)];
    let ids = session.insert_all(&on).unwrap().points;
    session.remove(&[PointId(6)]).unwrap();
    let before = session.mesh();
    let mut copy = Copy::of(&session);
    let change = session.renew().unwrap();
    assert!(change.remeshed);
    copy.follow(&change.delta);
    assert!(copy == Copy::of(&session));
    check(&session);
    let made = session.mesh();
    let ends = |made: &SessionMesh| -> Vec<PointId> { made.points.iter().map(|p| p.0).collect() };
    assert_eq!(ends(&made), ends(&before));
    let row: Vec<_> = made.edges.iter().filter(|e| e.segment == Some(6)).collect();
    assert!(row.windows(2).all(|w| w[0].ends[1] == w[1].ends[0]) && row.iter().all(|e| e.marker == 7));
    assert_eq!(session.check().segments.segments, 7);
    session.remove(&ids).unwrap();
    check(&session);
    for _ in 0..2 {
        session.undo().unwrap();
        check(&session);
    }
    assert!(session.mesh() == before);
}

#[test]
fn a_size_given_at_the_beginning_is_that_of_a_mesh_made_at_once() {
    let size = Size::constant(0.4).unwrap();
    let mesher = Mesher::new().size(size);
    let session = Session::with_segments(&plate(), &mesher).unwrap();
    check(&session);
    let made = mesher.triangulate_pslg(&plate()).unwrap();
    assert_eq!(session.counts()[1..], [made.mesh.vertices.len(), made.mesh.triangles.len()]);
}

#[test]
fn bad_calls_are_named_and_change_nothing() {
    let graph = fixture("square_with_hole");
    let mut session = Session::with_segments(&graph, &Mesher::new()).unwrap();
    let s = &mut session;
    for outside in [DVec2::splat(1.5), DVec2::new(-1.0, 1.0)] {
        assert_eq!(refused(s, |s| s.insert(outside)), SessionError::NotCovered { at: outside });
    }
    let near = DVec2::new(2.0, 1e-13);
    assert!(matches!(refused(s, |s| s.insert(near)), SessionError::TooClose { .. }));
    let corner = graph.points[4];
    assert_eq!(refused(s, |s| s.insert(corner)), SessionError::Duplicate { at: corner, of: PointId(4) });
    assert_eq!(refused(s, |s| s.remove(&[PointId(4)])), SessionError::SegmentEnd { id: PointId(4) });
    assert!(matches!(refused(s, Session::grow), SessionError::NotForSessions { .. }));
    let limited = Session::with_segments(&fixture("regions"), &Mesher::new());
    assert!(matches!(limited, Err(SessionError::NotForSessions { .. })));
    let mut crossing = fixture("square_with_hole");
    crossing.segments.push([0, 5]);
    assert!(matches!(Session::with_segments(&crossing, &Mesher::new()), Err(SessionError::Mesh(_))));
}

#[test]
fn texts_that_are_no_sessions_are_refused() {
    let mut session = Session::with_segments(&plate(), &Mesher::new()).unwrap();
    session.insert_all(&[DVec2::new(0.4, 1.7), DVec2::new(1.9, 0.0)]).unwrap();
    let text = session.to_ron().unwrap();
    for (from, to) in [
        ("min_deg:30", "min_deg:50"),
        ("lines:[((0.0,0.0)", "lines:[((0.5,0.0)"),
        ("lines:[(", "lines:[((0.0,0.0),(0.0,0.0)),("),
        ("edges:[(", "edges:[(0,77777),("),
        ("segment_of_line:[Some(0)", "segment_of_line:[Some(70)"),
        ("frame:Some(", "fram:Some("),
    ] {
        assert!(text.contains(from), "{from} in {text}");
        assert!(Session::from_ron(&text.replacen(from, to, 1)).is_err(), "{from} to {to}");
    }
    for i in (0..text.len()).step_by(59).filter(|&i| text.as_bytes()[i].is_ascii_digit()) {
        let mut bytes = text.clone().into_bytes();
        bytes[i] = b'0' + (bytes[i] - b'0' + 5) % 10;
        if let Ok(session) = Session::from_ron(std::str::from_utf8(&bytes).unwrap()) {
            check(&session);
        }
    }
}

/// A box or hexagon is not meshed anew, and that is what is said.
#[test]
fn what_is_not_meshed_anew_is_refused_as_such() {
    for domain in [Domain::Box, Domain::Hexagon] {
        let mut session = Session::with_segments(&fixture("narrow"), &Mesher::new().domain(domain)).unwrap();
        // In a fan, whose triangles are as they are.
        let error = refused(&mut session, |s| s.insert(DVec2::new(6.9, 3.0)));
        assert!(matches!(error, SessionError::NotForSessions { .. }), "{domain:?}: {error}");
        check(&session);
    }
}

/// What the mesh of a PSLG is warned of, its session is.
#[test]
fn sessions_have_the_warnings_and_repairs_of_the_mesh() {
    let mut graph = plate();
    graph.segments.push([1, 4]);
    graph.segment_markers.push(0);
    graph.holes = vec![DVec2::new(9.0, 9.0)];
    graph.regions.push(Region { point: DVec2::new(2.0, 4.0), attribute: 3.0, max_area: None });
    let made = Mesher::new().triangulate_pslg(&graph).unwrap();
    assert_eq!((made.warnings.len(), made.repairs.as_ref().unwrap().repairs.len()), (2, 1));
    let any = AnySession::new(&graph, &Mesher::new()).unwrap();
    assert_eq!((any.warnings(), any.repairs()), (&made.warnings[..], made.repairs.as_ref()));
    let mut session = Session::with_segments(&graph, &Mesher::new()).unwrap();
    session.renew().unwrap();
    assert_eq!((session.warnings(), session.repairs()), (&made.warnings[..], made.repairs.as_ref()));
    let sized = Mesher::new().size(Size::constant(0.3).unwrap());
    assert_eq!(Session::with_segments(&graph, &sized).unwrap().warnings(), made.warnings);
}
