//! Sessions keep the options they were made with, or refuse them by name.

#![cfg(feature = "serde")]

use hexdel::generate::{Kind, generate};
use hexdel::{
    AngleBounds, AnySession, DVec2, Domain, Effort, Error, Mesher, Method, Pslg, Session, SessionError, Size,
    TemplateSession,
};
use std::time::Duration;

fn points(n: usize) -> Vec<DVec2> {
    generate(Kind::Uniform, n, 3)
}

/// A session whose remeshing has no time is one of many triangles: the budget is kept.
#[test]
fn budgets_and_bounds_are_kept_when_all_is_meshed_anew() {
    let all = points(40);
    let wide = AngleBounds::new(30.0, 90.0).unwrap();
    let triangles = |mesher: &Mesher| {
        let mut session = Session::new(&all, mesher).unwrap();
        let before = session.counts()[2];
        session.grow().unwrap();
        let mut saved = Session::from_ron(&session.to_ron().unwrap()).unwrap();
        saved.renew().unwrap();
        assert_eq!(saved.counts()[2], session.counts()[2]);
        assert!(saved.certificate().holds());
        [before, session.counts()[2]]
    };
    let usual = triangles(&Mesher::new());
    let none = triangles(&Mesher::new().budget(Duration::ZERO));
    assert!(none[0] > 4 * usual[0] && none[1] > 4 * usual[1], "{none:?} {usual:?}");
    let least = triangles(&Mesher::new().bounds(wide));
    assert!(least[1] < usual[1], "{least:?} {usual:?}");
    let fast = triangles(&Mesher::new().effort(Effort::Fast));
    assert!(fast[1] > usual[1], "{fast:?} {usual:?}");
}

#[test]
fn threads_are_kept_across_saving() {
    let all = points(30);
    for method in [Method::Compact, Method::Templates] {
        let graph = Pslg::from_points(all.clone());
        let session = AnySession::new(&graph, &Mesher::new().method(method).threads(2)).unwrap();
        let text = session.to_ron().unwrap();
        assert!(text.contains("threads:Some(2)"), "{method:?}");
        let mut again = AnySession::from_ron(&text).unwrap();
        assert_eq!(again.to_ron().unwrap(), text);
        again.grow().unwrap();
        assert!(again.to_ron().unwrap().contains("threads:Some(2)"));
        let mut other = AnySession::new(&graph, &Mesher::new().method(method)).unwrap();
        other.grow().unwrap();
        assert_eq!(again.mesh().mesh, other.mesh().mesh, "{method:?}");
    }
}

/// A saved session may say any number.
#[test]
fn more_threads_than_there_may_be_are_refused() {
    let graph = Pslg::from_points(points(5));
    for method in [Method::Compact, Method::Templates] {
        let session = AnySession::new(&graph, &Mesher::new().method(method).threads(2)).unwrap();
        let text = session.to_ron().unwrap().replace("threads:Some(2)", "threads:Some(1025)");
        let refused = AnySession::from_ron(&text).unwrap_err();
        assert_eq!(refused, SessionError::Mesh(Error::Threads { threads: 1025 }), "{method:?}");
    }
    let refused = Mesher::new().threads(usize::MAX).triangulate(&points(5)).unwrap_err();
    let expected = format!("cannot start {} threads: at most 1024 are allowed", usize::MAX);
    assert_eq!(refused.to_string(), expected);
}

/// What is expected and what was given, and the way out.
#[test]
fn messages_say_what_is_expected() {
    let square = square();
    let mesh = |mesher: &Mesher| mesher.triangulate(&points(3)).unwrap_err().to_string();
    let graph = |mesher: &Mesher| mesher.triangulate_pslg(&square).unwrap_err().to_string();
    let mut session = Session::new(&points(3), &Mesher::new()).unwrap();
    let mut insert = |x: f64| session.insert(DVec2::new(x, 0.0)).unwrap_err().to_string();
    for (found, expected) in [
        (
            mesh(&Mesher::new().domain_radius(-1.0)),
            "the radius of the domain must be positive and finite, got -1.0",
        ),
        (
            graph(&Mesher::new().repair_within(-1.0)),
            "the tolerance must be finite and not negative, got -1.0",
        ),
        (graph(&Mesher::new().max_area(-1.0)), "the largest area must be positive and finite, got -1.0"),
        (
            Size::unlimited().with_gradation(-1.0).unwrap_err().to_string(),
            "the gradation must be positive and finite, got -1.0",
        ),
        (
            Session::empty(DVec2::ZERO, -1.0).unwrap_err().to_string(),
            "the radius of a domain must be positive, resolved by its coordinates and within 1e70, got -1.0 around \
             (0.0, 0.0)",
        ),
        (insert(f64::NAN), "the coordinates of a point must be finite, got (NaN, 0)"),
    ] {
        assert_eq!(found, expected);
    }
    assert!(insert(99.0).ends_with("which does not grow by itself: `grow` doubles it"));
}

#[test]
fn what_is_not_kept_is_refused_by_name() {
    let all = points(5);
    let simple = Mesher::new().method(Method::Simple);
    let name = |error: SessionError| error.to_string();
    assert!(name(Session::new(&all, &simple).unwrap_err()).contains("the simple method"));
    let graph = square();
    assert!(name(Session::with_segments(&graph, &simple).unwrap_err()).contains("the simple method"));
    let fine = Mesher::new().coarsening(false);
    assert!(name(TemplateSession::new(&all, &fine).unwrap_err()).contains("without coarsening"));
    let tight = Mesher::new().bounds(AngleBounds::new(48.0, 84.0).unwrap());
    let refused = TemplateSession::new(&all, &tight).unwrap_err();
    assert!(matches!(refused, SessionError::Mesh(Error::BoundsBeyondMethod { .. })), "{refused}");
    let areas = Mesher::new().max_area(1.0);
    for refused in [
        TemplateSession::new(&all, &areas).unwrap_err(),
        Session::new(&all, &areas).unwrap_err(),
        Session::with_segments(&graph, &areas).unwrap_err(),
    ] {
        assert!(name(refused).contains("a limit on areas"));
    }
}

fn square() -> Pslg {
    let mut graph =
        Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y, DVec2::new(0.5, 1.5)]);
    graph.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
    graph
}

#[test]
fn the_domain_of_a_graph_stays_when_it_is_meshed_anew() {
    let graph = square();
    let area = |session: &Session| {
        let made = session.mesh().mesh;
        let at = |v: hexdel::geom::VertexId| made.vertices[v.index()];
        let of = |t: &[hexdel::geom::VertexId; 3]| 0.5 * (at(t[1]) - at(t[0])).perp_dot(at(t[2]) - at(t[0]));
        made.triangles.iter().map(of).sum::<f64>()
    };
    for (domain, expected) in [(Domain::Inside, 1.0), (Domain::Hull, 1.25)] {
        let mut session = Session::with_segments(&graph, &Mesher::new().domain(domain)).unwrap();
        assert!((area(&session) - expected).abs() < 1e-12);
        session.renew().unwrap();
        assert!((area(&session) - expected).abs() < 1e-12, "{domain:?}");
        assert!(session.check().holds());
    }
    for domain in [Domain::Box, Domain::Hexagon] {
        let mut session = Session::with_segments(&graph, &Mesher::new().domain(domain)).unwrap();
        let before = area(&session);
        let refused = session.renew().unwrap_err();
        assert!(matches!(refused, SessionError::NotForSessions { .. }), "{refused}");
        assert_eq!(area(&session), before);
    }
}

/// Points that come one by one, each farther than the last: the domain grows, one call at a
/// time is taken back, and what is saved goes on.
#[test]
fn a_domain_that_follows_grows_and_shrinks_again() {
    for method in [Method::Compact, Method::Templates] {
        let mesher = Mesher::new().method(method).size(Size::constant(40.0).unwrap());
        let (mut session, first) = AnySession::begin(&[DVec2::new(7.0, -3.0)], &mesher).unwrap();
        let (centre, least) = first.domain.unwrap();
        assert_eq!(first.delta.triangles_added.len(), session.counts()[2]);
        assert_eq!(first.delta.vertices_added.len(), session.counts()[1]);
        let mut radii = vec![least];
        for k in 0..4 {
            let at = DVec2::new(7.0, -3.0) + 5_f64.powi(k) * DVec2::new(0.6, -1.3);
            let radius = session.domain().1;
            let done = session.insert(at).unwrap();
            let (still, now) = done.domain.unwrap_or(session.domain());
            assert!(still.distance(centre) < 1e-9 && now >= radius * (1.0 - 1e-9));
            assert!(session.certificate().holds(), "{method:?} {k}");
            radii.push(session.domain().1);
        }
        assert!(radii[4] > 100.0 * radii[0], "{radii:?}");
        let mut loaded = AnySession::from_ron(&session.to_ron().unwrap()).unwrap();
        assert!(loaded.insert(DVec2::new(600.0, 0.0)).unwrap().domain.is_some());
        for k in (0..4).rev() {
            let radius = session.domain().1;
            let back = session.undo().unwrap();
            assert!((session.domain().1 / radii[k] - 1.0).abs() < 1e-9);
            assert_eq!(back.domain.is_some(), (session.domain().1 / radius - 1.0).abs() > 1e-9);
        }
        assert_eq!(session.counts()[0], 1);
        let far = session.insert(DVec2::new(1e71, 0.0)).unwrap_err();
        assert!(matches!(far, SessionError::InvalidDomain { .. }), "{far}");
        assert!(matches!(session.insert(DVec2::NAN), Err(SessionError::NotFinite { .. })));
        let twice = session.insert_all(&[DVec2::new(50.0, 50.0), DVec2::new(50.0, 50.0)]);
        assert!(matches!(twice, Err(SessionError::Duplicate { .. })), "{twice:?}");
        assert_eq!(session.counts()[0], 1);
    }
    let fixed = Session::new(&points(3), &Mesher::new()).unwrap().insert(DVec2::splat(99.0));
    assert!(fixed.unwrap_err().to_string().contains("does not grow by itself"));
}
