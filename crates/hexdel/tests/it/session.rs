//! Sessions: what holds after every call, and what a call that fails leaves.

#![cfg(all(feature = "io", feature = "serde"))]

use crate::sessions::{Copy, Tally, refused};
use hexdel::size::SizeError;
use hexdel::{DVec2, Effort, Mesher, Outcome, PointId, Session, SessionError, Size, generate};
use proptest::prelude::*;

fn points(n: usize, seed: u64) -> Vec<DVec2> {
    generate::generate(generate::Kind::Uniform, n, seed)
}

/// What every state keeps.
fn check(session: &Session) {
    let certificate = session.certificate();
    assert!(certificate.holds(), "{:?}", certificate.violations);
    let made = session.mesh();
    let there: Vec<(PointId, DVec2)> =
        made.points.iter().map(|&(id, v)| (id, made.mesh.vertices[v.index()])).collect();
    assert_eq!(there, session.points().collect::<Vec<_>>());
    if let Some(size) = session.size() {
        for t in &made.mesh.triangles {
            let corners = t.map(|v| made.mesh.vertices[v.index()]);
            assert!(hexdel::triangle_fits(size, corners), "an edge of {corners:?} is too long");
        }
    }
}

#[test]
fn a_mesh_that_was_made_begins_the_same_session() {
    let points = points(30, 5);
    let mesher = Mesher::new().effort(Effort::Fast).size(Size::constant(0.3).unwrap());
    let mut made = Session::of(mesher.triangulate(&points).unwrap(), &mesher).unwrap();
    let mut anew = Session::new(&points, &mesher).unwrap();
    assert_eq!(made.to_ron(), anew.to_ron());
    let at = DVec2::new(0.4, 0.6);
    assert_eq!(made.insert(at), anew.insert(at));
    check(&made);
    let twice = [points[0], points[1], points[0]];
    let refused = Session::of(mesher.triangulate(&twice).unwrap(), &mesher);
    assert!(matches!(refused, Err(SessionError::Duplicate { of: PointId(0), .. })));
}

/// One call of a random sequence.
#[derive(Clone, Debug)]
enum Call {
    Insert(f64, f64),
    Near(usize, f64, f64),
    Remove(usize),
    Size(Option<f64>),
    Box(f64, f64),
    Undo,
}

fn call() -> impl Strategy<Value = Call> {
    prop_oneof![
        6 => (-1.1..1.1, -1.0..1.0).prop_map(|(x, y)| Call::Insert(x, y)),
        2 => (0..100_usize, 0.0..6.3, 1.0..4.0).prop_map(|(i, a, e)| Call::Near(i, a, e)),
        3 => (0..100_usize).prop_map(Call::Remove),
        1 => prop::option::of(0.15..0.6).prop_map(Call::Size),
        1 => (-0.5..0.5, -0.5..0.5).prop_map(|(x, y)| Call::Box(x, y)),
        2 => Just(Call::Undo),
    ]
}

fn run(session: &mut Session, call: &Call) -> Result<Outcome, SessionError> {
    let all: Vec<(PointId, DVec2)> = session.points().collect();
    let pick = |i: usize| all.get(i % all.len().max(1)).copied();
    match *call {
        Call::Insert(x, y) => session.insert(DVec2::new(x, y)),
        Call::Near(i, angle, exponent) => {
            let at = pick(i).map_or(DVec2::ZERO, |p| p.1);
            session.insert(at + DVec2::from_angle(angle) * 10_f64.powf(-exponent))
        }
        Call::Remove(i) => session.remove(&[pick(i).map_or(PointId(7), |p| p.0)]),
        Call::Size(size) => session.set_size(size.map(|h| Size::constant(h).unwrap())),
        Call::Box(x, y) => session.refine_box(DVec2::new(x, y), DVec2::new(x + 0.1, y + 0.2), 1),
        Call::Undo => session.undo(),
    }
}

/// Of the calls on random sessions.
static TALLY: Tally = Tally::new();

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    #[test]
    fn every_state_holds_and_every_delta_tells(calls in prop::collection::vec(call(), 1..16)) {
        let mut session = Session::empty(DVec2::ZERO, 1.0).unwrap();
        let mut copy = Copy::of(&session);
        for call in &calls {
            let before = session.to_ron().unwrap();
            let done = run(&mut session, call);
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
        let next = Call::Insert(0.123, 0.456);
        prop_assert_eq!(run(&mut session, &next), run(&mut again, &next));
        prop_assert_eq!(again.to_ron().unwrap(), session.to_ron().unwrap());
    }
}

#[test]
fn a_point_beside_a_side_leaves_no_short_edges_behind() {
    let mut session = Session::empty(DVec2::ZERO, 1.0).unwrap();
    let near = session.insert(DVec2::new(-0.5922, -0.5928)).unwrap().points;
    session.insert(DVec2::ZERO).unwrap();
    session.undo().unwrap();
    session.remove(&near).unwrap();
    check(&session);
    assert!(session.certificate().min_edge_bound.is_some());
    assert_eq!(session.counts(), [0, 7, 6]);
    session.undo().unwrap();
    assert_eq!(session.counts()[0], 1);
    check(&session);
}

#[test]
fn points_that_come_and_go_leave_as_many_triangles_as_there_were() {
    let all = points(120, 3);
    let mut session = Session::new(&all[..100], &Mesher::new()).unwrap();
    let before = session.counts()[2] as f64;
    let ids = session.insert_all(&all[100..]).map(|o| o.points);
    let ids = match ids {
        Ok(ids) => ids,
        // The tight domain of the first hundred has not room for all.
        Err(SessionError::Outside { .. }) => {
            session.grow().unwrap();
            session.insert_all(&all[100..]).unwrap().points
        }
        Err(error) => panic!("{error}"),
    };
    check(&session);
    session.remove(&ids).unwrap();
    check(&session);
    let after = session.counts()[2] as f64;
    assert!((after / before - 1.0).abs() < 0.1, "{before} triangles, then {after}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, ..ProptestConfig::default() })]

    #[test]
    fn what_comes_and_goes_leaves_no_more_than_a_tenth(
        seed in 0..1000_u64,
        calls in prop::collection::vec(prop_oneof![
            (-1.4..1.4, -1.2..1.2).prop_map(|(x, y)| Call::Insert(x, y)),
            (0..100_usize, 0.0..6.3, 1.0..2.5).prop_map(|(i, a, e)| Call::Near(i, a, e)),
        ], 1..6),
    ) {
        let mesher = Mesher::new().domain_radius(1.5);
        let mut session = Session::new(&points(40, seed), &mesher).unwrap();
        let before = session.counts()[2] as f64;
        let mut ids = Vec::new();
        for call in &calls {
            ids.extend(run(&mut session, call).map_or(Vec::new(), |o| o.points));
        }
        session.remove(&ids).unwrap();
        check(&session);
        let after = session.counts()[2] as f64;
        // Fewer are as good: what is made at once is not the least.
        prop_assert!(after / before - 1.0 <= 0.1, "{} triangles, then {}", before, after);
    }
}

#[test]
fn one_by_one_is_as_good_as_at_once() {
    let all = points(60, 5);
    let made = Session::new(&all, &Mesher::new().domain_radius(1.5)).unwrap();
    let (centre, radius) = made.domain();
    let mut session = Session::empty(centre, radius).unwrap();
    for &p in &all {
        session.insert(p).unwrap();
    }
    check(&session);
    let (one, once) = (session.counts()[2] as f64, made.counts()[2] as f64);
    assert!(one < 1.1 * once, "{one} triangles one by one, {once} at once");
}

#[test]
fn undo_goes_back_step_by_step() {
    let mut session = Session::new(&points(30, 2), &Mesher::new().domain_radius(1.0)).unwrap();
    let mut states = vec![session.mesh()];
    let inserted = session.insert(DVec2::new(0.5, 0.5)).unwrap();
    states.push(session.mesh());
    session.remove(&[PointId(3), inserted.points[0]]).unwrap();
    states.push(session.mesh());
    session.set_size(Some(Size::constant(0.2).unwrap())).unwrap();
    states.push(session.mesh());
    assert!(session.grow().unwrap().remeshed);
    for state in states.into_iter().rev() {
        session.undo().unwrap();
        assert!(session.mesh() == state);
        check(&session);
    }
    assert_eq!(session.undo(), Err(SessionError::NothingToUndo));
    // No number is used again.
    assert_eq!(session.insert(DVec2::new(0.5, 0.5)).unwrap().points, [PointId(31)]);
}

#[test]
fn bad_calls_are_named_and_change_nothing() {
    let mut session = Session::empty(DVec2::new(2.0, 1.0), 1.0).unwrap();
    let at = DVec2::new(2.1, 1.2);
    session.insert(at).unwrap();
    let s = &mut session;
    let nan = refused(s, |s| s.insert(DVec2::new(f64::NAN, 0.0)));
    assert!(matches!(nan, SessionError::NotFinite { .. }));
    assert!(matches!(refused(s, |s| s.insert(DVec2::ZERO)), SessionError::Outside { .. }));
    let again = refused(s, |s| s.insert_all(&[DVec2::new(2.0, 1.1), at]));
    assert_eq!(again, SessionError::Duplicate { at, of: PointId(0) });
    let next = DVec2::new(at.x.next_up(), at.y);
    assert!(matches!(refused(s, |s| s.insert(next)), SessionError::TooClose { .. }));
    for ids in [vec![PointId(1)], vec![PointId(0), PointId(0)], vec![PointId(u64::MAX)]] {
        assert!(matches!(refused(s, |s| s.remove(&ids)), SessionError::UnknownPoint { .. }));
    }
    let tiny = Size::constant(1e-14).unwrap();
    assert!(matches!(refused(s, |s| s.set_size(Some(tiny))), SessionError::Size(_)));
    for bad in [0.0, -1.0, f64::NAN, 1e-9] {
        let size = Size::function(move |_| bad);
        assert!(matches!(refused(s, |s| s.set_size(Some(size))), SessionError::Size(_)));
    }
    // Far finer than any triangle that there is before would tell.
    let hidden = Size::unlimited().and_box(at, at + 0.02, 1e-6).unwrap();
    assert!(matches!(
        refused(s, |s| s.set_size(Some(hidden))),
        SessionError::Size(SizeError::TooMany { .. })
    ));
    for (centre, radius) in
        [(DVec2::ZERO, 5e-324), (DVec2::ZERO, 0.0), (DVec2::ZERO, f64::NAN), (DVec2::splat(1e20), 1.0)]
    {
        let refused = Session::empty(centre, radius);
        assert!(matches!(refused, Err(SessionError::InvalidDomain { .. })), "{radius}");
    }
}

#[test]
fn points_may_lie_on_sides_corners_and_vertices() {
    let mut session = Session::empty(DVec2::ZERO, 1.0).unwrap();
    let made = session.mesh().mesh.vertices;
    let top = made[1].y;
    let on = [DVec2::new(1.0, 0.0), DVec2::ZERO, DVec2::new(0.2, top)];
    let mut ids = Vec::new();
    for at in on {
        ids.extend(session.insert(at).unwrap_or_else(|e| panic!("{at}: {e}")).points);
        check(&session);
    }
    session.insert(DVec2::new(-0.3, top - 1e-3)).unwrap();
    check(&session);
    session.undo().unwrap();
    // As close to a side as this there is no room, except in a larger domain.
    let near = DVec2::new(-0.3, top.next_down());
    let error = refused(&mut session, |s| s.insert(near));
    assert!(matches!(error, SessionError::Mesh(hexdel::Error::DomainTooSmall { .. })), "{error}");
    for id in ids {
        session.remove(&[id]).unwrap();
        check(&session);
    }
    assert!(session.counts()[2] < 40, "{:?}", session.counts());
}

#[test]
fn a_box_is_refined_and_the_rest_left() {
    let mut session = Session::new(&points(300, 4), &Mesher::new().effort(Effort::Fast)).unwrap();
    let before = session.mesh();
    let (low, high) = (DVec2::splat(0.1), DVec2::splat(0.15));
    let outcome = session.refine_box(low, high, 2).unwrap();
    check(&session);
    assert!(outcome.delta.triangles_added.len() > 100);
    // Edges of a twentieth, some rings of them.
    let far = |p: &DVec2| p.min_element() > 0.6 && p.max_element() < 1.0;
    for (serial, at) in before.vertex_serials.iter().zip(&before.mesh.vertices).filter(|(_, p)| far(p)) {
        assert!(!outcome.delta.vertices_removed.contains(serial), "{at}");
        assert!(!outcome.delta.vertices_moved.iter().any(|v| v.0 == *serial), "{at}");
    }
}

#[test]
fn texts_that_are_no_sessions_are_refused() {
    let mut session = Session::new(&points(5, 1), &Mesher::new()).unwrap();
    session.set_size(Some(Size::constant(0.3).unwrap().and_points(&[(DVec2::ONE, 0.1)]).unwrap())).unwrap();
    session.remove(&[PointId(1)]).unwrap();
    let text = session.to_ron().unwrap();
    assert_eq!(Session::from_ron(&text).unwrap().to_ron().unwrap(), text);
    for (from, to) in [
        ("version:1", "version:2"),
        ("radius:", "radius:-"),
        ("slope:0.5", "slope:0.0"),
        ("Constant(0.3)", "Constant(0.0)"),
        ("Constant(0.3)", "Constant(0.2)"),
        ("Constant(0.3)", "Constant(1e-30)"),
        ("max_deg:90.0", "max_deg:NaN"),
        ("max_deg:90.0", "max_deg:inf"),
        ("free_vertices:[", "free_vertices:[0,"),
        ("Fixed", "Free"),
        ("points:[Some(", "points:[Some(9"),
        ("Some((1,(", "Some((2,("),
        ("(", ")"),
    ] {
        assert!(text.contains(from), "{from}");
        let broken = text.replacen(from, to, 1);
        assert!(Session::from_ron(&broken).is_err(), "{from} to {to}");
    }
    // Whatever digit is changed, a session comes of it that holds, or none.
    for i in (0..text.len()).step_by(97).filter(|&i| text.as_bytes()[i].is_ascii_digit()) {
        let mut bytes = text.clone().into_bytes();
        bytes[i] = b'0' + (bytes[i] - b'0' + 5) % 10;
        if let Ok(session) = Session::from_ron(std::str::from_utf8(&bytes).unwrap()) {
            assert!(session.certificate().holds());
        }
    }
    let by_function = Size::function(|_| 0.5);
    session.set_size(Some(by_function)).unwrap();
    assert_eq!(session.to_ron(), Err(SessionError::CannotSave));
}

#[test]
fn small_sessions_have_hardly_more_triangles_than_meshes_made_at_once() {
    // Close pairs leave finely graded triangles behind.
    let all = generate::generate(generate::Kind::Pairs, 12, 1);
    let mut session = Session::empty(DVec2::splat(0.5), 1.0).unwrap();
    let mut remeshed = 0;
    for &p in &all {
        let mut copy = Copy::of(&session);
        let outcome = session.insert(p).unwrap();
        copy.follow(&outcome.delta);
        assert!(copy == Copy::of(&session));
        remeshed += usize::from(outcome.remeshed);
        check(&session);
    }
    assert!(remeshed > 0);
    let saved = session.to_ron().unwrap();
    let now = session.counts()[2];
    session.renew().unwrap();
    assert!(now as f64 <= 1.1 * session.counts()[2] as f64, "{now} triangles, {:?}", session.counts());
    for _ in 0..=all.len() {
        session.undo().unwrap();
        check(&session);
    }
    assert_eq!(session.undo(), Err(SessionError::NothingToUndo));
    let mut again = Session::from_ron(&saved).unwrap();
    again.remove(&[PointId(3)]).unwrap();
    check(&again);
}

/// So many points are meshed at once, for which the domain has to be larger than they reach.
#[test]
fn a_domain_that_grows_makes_room_for_many_points_near_its_rim() {
    let rim = 0.5 * 3f64.sqrt();
    let ring: Vec<DVec2> =
        (0..80).map(|i| 0.999 * rim * DVec2::from_angle(f64::from(i) * 4.5_f64.to_radians())).collect();
    let empty = || Session::empty(DVec2::ZERO, 1.0).unwrap();
    let refused = empty().insert_all(&ring);
    assert!(matches!(refused, Err(SessionError::Mesh(hexdel::Error::DomainTooSmall { .. }))), "{refused:?}");
    let mut session = empty().growing(true);
    let outcome = session.insert_all(&ring).unwrap();
    assert_eq!(outcome.domain, Some((DVec2::ZERO, 2.0)));
    check(&session);
    session.undo().unwrap();
    assert_eq!(session.points().count(), 0);
}
