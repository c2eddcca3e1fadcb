//! Sessions of templates: what holds after every call, and what a call that
//! fails leaves.

#![cfg(all(feature = "io", feature = "serde"))]

use crate::sessions::{Copy, Tally, refused};
use hexdel::{
    DVec2, Mesher, Method, Outcome, PointId, SessionError, Size, SizeError, TemplateSession, VertexId,
    generate, triangle_fits,
};
use proptest::prelude::*;

fn points(n: usize, seed: u64) -> Vec<DVec2> {
    generate::generate(generate::Kind::Uniform, n, seed)
}

/// Triangles of the same points meshed at once, in the same domain.
fn at_once(session: &TemplateSession) -> usize {
    let points: Vec<DVec2> = session.points().map(|p| p.1).collect();
    TemplateSession::new(&points, &Mesher::new()).unwrap().counts()[2]
}

/// What every state keeps.
fn check(session: &TemplateSession) {
    let certificate = session.certificate();
    assert!(certificate.holds(), "{:?}", certificate.violations);
    let made = session.mesh();
    let there: Vec<(PointId, DVec2)> =
        made.points.iter().map(|&(id, v)| (id, made.mesh.vertices[v.index()])).collect();
    assert_eq!(there, session.points().collect::<Vec<_>>());
    assert_eq!(session.counts(), [there.len(), made.mesh.vertices.len(), made.mesh.triangles.len()]);
    let corners = |t: &[VertexId; 3]| t.map(|v| made.mesh.vertices[v.index()]);
    let fits = |t: &[VertexId; 3]| session.size().is_none_or(|size| triangle_fits(size, corners(t)));
    assert!(made.mesh.triangles.iter().all(fits), "an edge is too long");
}

/// One call of a random sequence.
#[derive(Clone, Debug)]
enum Call {
    Insert(f64, f64),
    Near(usize, f64, f64),
    Remove(usize),
    Size(Option<f64>),
    Point(f64, f64, f64),
    Refine(f64, f64),
    Undo,
    Grow,
}

fn call() -> impl Strategy<Value = Call> {
    prop_oneof![
        8 => (-1.1..1.1, -1.0..1.0).prop_map(|(x, y)| Call::Insert(x, y)),
        3 => (0..100_usize, 0.0..6.3, 1.0..6.0).prop_map(|(i, a, e)| Call::Near(i, a, e)),
        5 => (0..100_usize).prop_map(Call::Remove),
        1 => prop::option::of(0.1..1.0).prop_map(Call::Size),
        2 => (-1.1..1.1, -1.0..1.0, 0.02..0.5).prop_map(|(x, y, h)| Call::Point(x, y, h)),
        1 => (-0.9..0.9, -0.8..0.8).prop_map(|(x, y)| Call::Refine(x, y)),
        3 => Just(Call::Undo),
        1 => Just(Call::Grow),
    ]
}

fn run(session: &mut TemplateSession, call: &Call) -> Result<Outcome, SessionError> {
    let all: Vec<(PointId, DVec2)> = session.points().collect();
    let pick = |i: usize| all.get(i % all.len().max(1)).copied();
    match *call {
        Call::Insert(x, y) => session.insert(DVec2::new(x, y)),
        Call::Near(i, angle, exponent) => {
            let at = pick(i).map_or(DVec2::ZERO, |p| p.1);
            session.insert(at + DVec2::from_angle(angle) * 10_f64.powf(-exponent))
        }
        Call::Remove(i) => session.remove(&[pick(i).map_or(PointId(7), |p| p.0)]),
        Call::Size(h) => session.set_size(h.map(|h| Size::constant(h).unwrap())),
        Call::Point(x, y, h) => {
            let now = session.size().cloned().unwrap_or_else(Size::unlimited);
            session.set_size(Some(now.and_points(&[(DVec2::new(x, y), h)]).unwrap()))
        }
        Call::Refine(x, y) => session.refine_box(DVec2::new(x, y), DVec2::new(x + 0.1, y + 0.1), 1),
        Call::Undo => session.undo(),
        Call::Grow => session.grow(),
    }
}

/// Of the calls on random sessions.
static TALLY: Tally = Tally::new();

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn every_state_holds_and_every_delta_tells(calls in prop::collection::vec(call(), 1..40)) {
        let mut session = TemplateSession::empty(DVec2::ZERO, 1.0).unwrap();
        let mut told = Copy::of(&session);
        for call in &calls {
            let before = session.to_ron().unwrap();
            let done = run(&mut session, call);
            TALLY.note(&done);
            if let Ok(outcome) = done {
                told.follow(&outcome.delta);
            } else {
                prop_assert_eq!(session.to_ron().unwrap(), before, "after {:?}", call);
            }
            check(&session);
            let is = Copy::of(&session);
            let first = told.triangles.iter().zip(&is.triangles).find(|(a, b)| a != b);
            prop_assert!(told.triangles == is.triangles, "triangles after {:?}: {:?}", call, first);
            let first = told.vertices.iter().zip(&is.vertices).find(|(a, b)| a != b);
            prop_assert!(told.vertices == is.vertices, "vertices after {:?}: {:?}", call, first);
        }
        let saved = session.to_ron().unwrap();
        let mut again = TemplateSession::from_ron(&saved).unwrap();
        prop_assert_eq!(again.to_ron().unwrap(), saved);
        prop_assert!(again.mesh() == session.mesh());
        for next in [Call::Insert(0.123, 0.456), Call::Remove(3), Call::Near(1, 1.0, 2.0)] {
            prop_assert_eq!(run(&mut session, &next), run(&mut again, &next));
            prop_assert_eq!(again.to_ron().unwrap(), session.to_ron().unwrap());
        }
    }
}

#[test]
fn a_size_that_goes_leaves_no_short_edges_behind() {
    let mut session = TemplateSession::empty(DVec2::ZERO, 2.0).unwrap();
    let size = Size::unlimited().and_points(&[(DVec2::ZERO, 0.02)]).unwrap();
    session.set_size(Some(size)).unwrap();
    session.insert_all(&[DVec2::ZERO, DVec2::new(0.0, 0.8)]).unwrap();
    let fine = session.counts();
    session.set_size(None).unwrap();
    check(&session);
    assert!(session.certificate().min_edge_bound.is_some());
    assert!(3 * session.counts()[2] < fine[2], "{:?}, before {fine:?}", session.counts());
    session.undo().unwrap();
    assert_eq!(session.counts(), fine);
    check(&session);
}

#[test]
fn one_by_one_and_back_is_as_good_as_at_once() {
    let all = points(300, 3);
    let made = TemplateSession::new(&all, &Mesher::new().domain_radius(1.5)).unwrap();
    let (centre, radius) = made.domain();
    let mut session = TemplateSession::empty(centre, radius).unwrap();
    for &p in &all {
        session.insert(p).unwrap();
    }
    check(&session);
    let near = |a: usize, b: usize| (a as f64 / b as f64 - 1.0).abs() < 0.1;
    assert!(near(session.counts()[2], made.counts()[2]), "{:?} {:?}", session.counts(), made.counts());
    for i in (0..300).filter(|i| i % 3 != 0) {
        session.remove(&[PointId(i)]).unwrap();
    }
    check(&session);
    assert!(near(session.counts()[2], at_once(&session)), "{:?} {}", session.counts(), at_once(&session));
}

/// A size at two points, around a point and none.
fn sizes() -> [Option<Size>; 3] {
    let points = [(DVec2::new(0.2, 0.3), 0.01), (DVec2::new(0.8, 0.6), 0.02)];
    let near = Size::unlimited().and_points(&points).unwrap();
    [Some(near), Some(Size::constant(0.05).unwrap()), None]
}

#[test]
fn sizes_that_come_and_go_are_as_good_as_at_once() {
    let all = points(100, 4);
    let mesher = Mesher::new().domain_radius(1.5);
    let mut session = TemplateSession::new(&all, &mesher).unwrap();
    let near = |a: usize, b: usize| (a as f64 / b as f64 - 1.0).abs() < 0.1;
    for size in sizes().into_iter().chain(sizes().into_iter().rev()) {
        session.set_size(size.clone()).unwrap();
        check(&session);
        let mut once = session.clone();
        once.renew().unwrap();
        check(&once);
        assert!(near(session.counts()[2], once.counts()[2]), "{:?} {:?}", session.counts(), once.counts());
    }
    let sized = sizes().into_iter().flatten().next().unwrap();
    let session = TemplateSession::new(&all, &mesher.clone().size(sized.clone())).unwrap();
    check(&session);
    let made = mesher.method(Method::Templates).size(sized).triangulate(&all).unwrap();
    assert!(
        near(session.counts()[2], made.mesh.triangles.len()),
        "{:?} {}",
        session.counts(),
        made.mesh.triangles.len()
    );
}

#[test]
fn sizes_hold_while_points_come_and_go() {
    let mut session = TemplateSession::new(&points(60, 9), &Mesher::new().domain_radius(1.5)).unwrap();
    let [size, ..] = sizes();
    session.set_size(size).unwrap();
    for id in 0..60 {
        session.remove(&[PointId(id)]).unwrap();
        check(&session);
    }
    for p in points(20, 10) {
        session.insert(p).unwrap();
        check(&session);
    }
}

#[test]
fn a_lattice_of_which_half_goes_is_as_good_as_at_once() {
    for side in [10, 16, 24] {
        let all = generate::generate(generate::Kind::Grid, side * side, 0);
        let mut session = TemplateSession::empty(DVec2::splat(0.5), 1.0).unwrap();
        session.insert_all(&all).unwrap();
        for i in (0..side * side).filter(|i| (i / side + i) % 2 == 0) {
            session.remove(&[PointId(i as u64)]).unwrap();
        }
        check(&session);
        let left = session.counts()[2];
        session.renew().unwrap();
        let once = session.counts()[2];
        assert!(left as f64 <= 1.1 * once as f64, "{left} triangles, {once} at once");
    }
}

#[test]
fn the_lattice_follows_the_points() {
    use generate::Kind::{Circle, Grid, Jittered, Spiral};
    for kind in [Grid, Jittered, Circle, Spiral] {
        let all = generate::generate(kind, 150, 2);
        let mut session = TemplateSession::empty(DVec2::splat(0.5), 1.0).unwrap();
        let near_at_once = |session: &TemplateSession| {
            check(session);
            let points: Vec<DVec2> = session.points().map(|p| p.1).collect();
            let mut once = TemplateSession::empty(DVec2::splat(0.5), 1.0).unwrap();
            once.insert_all(&points).unwrap();
            let [now, once] = [session, &once].map(|s| s.counts()[2] as f64);
            assert!((now / once - 1.0).abs() < 0.1, "{kind:?}: {now} triangles, {once} at once");
        };
        for &p in &all {
            session.insert(p).unwrap();
        }
        near_at_once(&session);
        for i in (0..150).step_by(2) {
            session.remove(&[PointId(i)]).unwrap();
        }
        near_at_once(&session);
    }
}

#[test]
fn what_points_have_left_behind_can_be_taken_away() {
    // Half of a square lattice: its points hold each other down across all of it.
    let all = generate::generate(generate::Kind::Grid, 100, 0);
    let mut session = TemplateSession::empty(DVec2::splat(0.5), 1.0).unwrap();
    session.insert_all(&all).unwrap();
    for i in (0..100).filter(|i| (i / 10 + i) % 2 == 0) {
        session.remove(&[PointId(i)]).unwrap();
    }
    let before = session.counts()[2];
    assert!(session.renew().unwrap().remeshed);
    check(&session);
    let (mut once, left) = (TemplateSession::empty(DVec2::splat(0.5), 1.0).unwrap(), session.points());
    once.insert_all(&left.map(|p| p.1).collect::<Vec<_>>()).unwrap();
    assert!(session.counts()[2] <= before && session.counts() == once.counts());
}

#[test]
fn the_mesh_is_the_one_of_the_method() {
    let all = points(200, 8);
    let session = TemplateSession::new(&all, &Mesher::new()).unwrap();
    let made = Mesher::new().method(Method::Templates).triangulate(&all).unwrap();
    assert_eq!(session.counts()[1..], [made.mesh.vertices.len(), made.mesh.triangles.len()]);
    assert_eq!(session.domain(), (made.patch.centre, made.patch.radius));
}

#[test]
fn undo_goes_back_step_by_step() {
    let mut session = TemplateSession::new(&points(30, 2), &Mesher::new().domain_radius(1.0)).unwrap();
    let mut states = vec![session.mesh()];
    let inserted = session.insert(DVec2::new(0.5, 0.5)).unwrap();
    states.push(session.mesh());
    session.remove(&[PointId(3), inserted.points[0]]).unwrap();
    states.push(session.mesh());
    session.insert_all(&[DVec2::new(0.51, 0.5), DVec2::new(0.1, 0.9)]).unwrap();
    states.push(session.mesh());
    assert!(session.grow().unwrap().remeshed);
    for state in states.into_iter().rev() {
        session.undo().unwrap();
        assert!(session.mesh() == state);
        check(&session);
    }
    assert_eq!(session.undo(), Err(SessionError::NothingToUndo));
    // No number is used again.
    assert_eq!(session.insert(DVec2::new(0.5, 0.5)).unwrap().points, [PointId(33)]);
}

#[test]
fn bad_calls_are_refused_and_change_nothing() {
    let mut session = TemplateSession::empty(DVec2::ZERO, 1.0).unwrap();
    session.insert_all(&[DVec2::new(0.1, 0.2), DVec2::new(-0.3, 0.1)]).unwrap();
    let mut insert = |points: &[DVec2]| refused(&mut session, |s| s.insert_all(points));
    let (first, inside) = (DVec2::new(0.1, 0.2), DVec2::new(0.4, 0.4));
    assert!(matches!(insert(&[inside, DVec2::NAN]), SessionError::NotFinite { .. }));
    assert!(matches!(insert(&[inside, DVec2::new(2.0, 0.0)]), SessionError::Outside { .. }));
    assert!(matches!(insert(&[first]), SessionError::Duplicate { of: PointId(0), .. }));
    assert!(matches!(insert(&[inside, inside]), SessionError::Duplicate { of: PointId(2), .. }));
    assert!(matches!(insert(&[first + DVec2::new(1e-15, 0.0)]), SessionError::TooClose { .. }));
    assert!(matches!(insert(&[inside, inside + 1e-15]), SessionError::TooClose { .. }));
    assert!(matches!(insert(&[DVec2::new(0.0, 0.866)]), SessionError::AtRim { .. }));
    let size = refused(&mut session, |s| s.set_size(Some(Size::constant(1e-17).unwrap())));
    assert!(matches!(size, SessionError::Size(SizeError::BelowResolution { .. })), "{size}");
    let size = refused(&mut session, |s| s.set_size(Some(Size::constant(1e-9).unwrap())));
    assert!(matches!(size, SessionError::Size(SizeError::TooMany { .. })), "{size}");
    let size = refused(&mut session, |s| s.refine_box(DVec2::ZERO, DVec2::splat(0.1), 200));
    assert!(matches!(size, SessionError::Size(_)), "{size}");
    let unknown = refused(&mut session, |s| s.remove(&[PointId(0), PointId(9)]));
    assert_eq!(unknown, SessionError::UnknownPoint { id: PointId(9) });
    let twice = refused(&mut session, |s| s.remove(&[PointId(1), PointId(1)]));
    assert_eq!(twice, SessionError::UnknownPoint { id: PointId(1) });
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300] {
        let error = TemplateSession::empty(DVec2::ONE, radius).unwrap_err();
        assert!(matches!(error, SessionError::InvalidDomain { .. }), "{radius}");
    }
    assert!(TemplateSession::new(&[], &Mesher::new()).is_err());
}

#[test]
fn text_that_is_no_session_is_refused() {
    let mut session = TemplateSession::empty(DVec2::ZERO, 1.0).unwrap();
    session.insert_all(&[DVec2::new(0.1, 0.2), DVec2::new(0.12, 0.2)]).unwrap();
    let saved = session.to_ron().unwrap();
    assert!(TemplateSession::is_saved_in(&saved));
    assert!(TemplateSession::from_ron("").is_err());
    // Every number replaced by others: refused or a session, but no panic.
    let mut at = 0;
    while let Some(start) = saved[at..].find(|c: char| c.is_ascii_digit()).map(|i| i + at) {
        let end = saved[start..].find(|c: char| !c.is_ascii_digit()).map_or(saved.len(), |i| i + start);
        for other in ["0", "1", "7", "255", "4294967295", "4294967296", "18446744073709551615"] {
            let text = format!("{}{other}{}", &saved[..start], &saved[end..]);
            if let Ok(session) = TemplateSession::from_ron(&text) {
                check(&session);
            }
        }
        at = end;
    }
}
