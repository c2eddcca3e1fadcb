//! Drafts: what follows a pointer keeps its bounds, and leaves nothing behind.

#![cfg(feature = "io")]

use crate::common::graph;
use hexdel::generate::{Kind, generate};
use hexdel::{AngleBounds, DVec2, Effort, Mesher, PointId, Session, SessionError, Size};

/// Places around a point, the last ones close to it.
fn places(around: DVec2, radius: f64) -> impl Iterator<Item = DVec2> {
    (0..6).map(move |i| {
        let (sin, cos) = (0.7 * f64::from(i)).sin_cos();
        around + radius * 0.8_f64.powi(i) * DVec2::new(cos, sin)
    })
}

#[test]
fn drafts_hold_and_undone_leave_the_mesh_as_it_was() {
    for kind in [Kind::Uniform, Kind::Clusters, Kind::Grid] {
        let points = generate(kind, 30, 5);
        let mut session = Session::new(&points, &Mesher::new()).unwrap();
        let before = session.mesh();
        session.draft(true);
        let (mut made, mut refused) = (0, 0);
        for dragged in [3, 21] {
            session.remove(&[PointId(dragged)]).unwrap();
            assert!(session.certificate().holds(), "{kind}");
            let lifted = session.mesh().mesh;
            for at in places(points[dragged as usize], 0.05 * session.domain().1) {
                match session.insert(at) {
                    Ok(outcome) => {
                        assert!(!outcome.remeshed);
                        assert!(session.certificate().holds(), "{kind} {at}");
                        assert_eq!(session.plain_mesh(), session.mesh().mesh);
                        session.undo().unwrap();
                        made += 1;
                    }
                    Err(SessionError::NoRoom { .. } | SessionError::Outside { .. }) => refused += 1,
                    Err(other) => panic!("{kind} {at}: {other}"),
                }
                assert_eq!(session.mesh().mesh, lifted, "{kind} {at}");
            }
            session.undo().unwrap();
        }
        assert!(made > refused, "{kind}: {made} made, {refused} refused");
        session.draft(false);
        assert_eq!(session.mesh().mesh, before.mesh);
        // What counts is as if there had been no drafts.
        let mut other = Session::new(&points, &Mesher::new()).unwrap();
        let at = points[3] + DVec2::splat(0.01);
        for session in [&mut session, &mut other] {
            session.remove(&[PointId(3)]).unwrap();
            session.insert(at).unwrap();
        }
        assert_eq!(session.mesh().mesh, other.mesh().mesh, "{kind}");
    }
}

#[test]
fn drafts_keep_a_size_and_leave_more_triangles() {
    let points = generate(Kind::Uniform, 40, 2);
    let mesher = Mesher::new().size(Size::constant(0.2).unwrap());
    let mut session = Session::new(&points, &mesher).unwrap();
    let longest = |session: &Session| {
        let mesh = session.mesh().mesh;
        let sides = |t: &[hexdel::VertexId; 3]| [(0, 1), (1, 2), (2, 0)].map(|(a, b)| [t[a], t[b]]);
        let edges = mesh.triangles.iter().flat_map(sides);
        let length =
            |e: [hexdel::VertexId; 2]| mesh.vertices[e[0].index()].distance(mesh.vertices[e[1].index()]);
        edges.map(length).fold(0.0, f64::max)
    };
    session.draft(true);
    let mut made = 0;
    for at in generate(Kind::Uniform, 6, 9) {
        made += usize::from(session.insert(at).is_ok());
        assert!(session.certificate().holds());
        assert!(longest(&session) <= 0.2 * (1.0 + 1e-8));
    }
    assert!(made > 3, "{made}");
    let drafted = session.counts()[2];
    session.draft(false);
    session.renew().unwrap();
    assert!(session.counts()[2] < drafted, "{} of {drafted}", session.counts()[2]);
}

#[test]
fn drafts_mesh_nothing_anew() {
    let points = generate(Kind::Uniform, 20, 1);
    let mut session = Session::new(&points, &Mesher::new()).unwrap().growing(true);
    let domain = session.domain();
    session.draft(true);
    let far = DVec2::splat(50.0);
    assert!(matches!(session.insert(far), Err(SessionError::Outside { .. })));
    // With so few points every call would be compared with a mesh made at once.
    assert!(!session.insert(DVec2::new(0.47, 0.53)).unwrap().remeshed);
    assert_eq!(session.domain(), domain);
    session.draft(false);
    assert!(session.insert(far).unwrap().domain.is_some());
}

#[test]
fn graphs_are_drafted_within_the_bounds_near_segments() {
    let draft = Mesher::new().effort(Effort::Repair).bounds(AngleBounds::new(30.0, 90.0).unwrap());
    for name in ["letters", "airfoil", "square_with_hole", "regions"] {
        let graph = graph(name);
        let made = draft.triangulate_pslg(&graph).unwrap();
        assert!(made.holds(), "{name}");
        assert!(made.certificate.delaunay && made.certificate.min_angle_deg >= 30.0 - 1e-8, "{name}");
        let whole = Mesher::new().triangulate_pslg(&graph).unwrap();
        assert_eq!(made.certificate.inputs_kept, whole.certificate.inputs_kept, "{name}");
    }
}

#[test]
fn what_a_draft_cannot_mesh_is_refused_as_ever() {
    let draft = Mesher::new().effort(Effort::Repair);
    for name in ["crossing", "needle"] {
        let graph = graph(name);
        let [drafted, usual] =
            [&draft, &Mesher::new()].map(|mesher| mesher.triangulate_pslg(&graph).unwrap_err());
        assert_eq!(drafted.to_string(), usual.to_string(), "{name}");
        assert_eq!(drafted.fault(), usual.fault(), "{name}");
        assert!(drafted.fault().location.is_some() && drafted.fault().item.is_some(), "{name}");
    }
}

#[test]
fn errors_of_sessions_say_what_they_are_about() {
    let mut session = Session::new(&generate(Kind::Uniform, 9, 1), &Mesher::new()).unwrap();
    let at = session.points().nth(4).unwrap().1;
    let duplicate = session.insert(at).unwrap_err().fault();
    assert_eq!((duplicate.kind, duplicate.item), ("duplicate", Some("point")));
    assert_eq!((duplicate.index, duplicate.location), (vec![4], Some(at)));
    let unknown = session.remove(&[PointId(77)]).unwrap_err().fault();
    assert_eq!((unknown.kind, unknown.index, unknown.location), ("unknown_point", vec![77], None));
    let size = session.set_size(Some(Size::constant(1e-300).unwrap())).unwrap_err().fault();
    assert_eq!(size.kind, "size");
    assert!(size.least.is_some_and(|least| least > 1e-300));
}

#[test]
fn values_of_points_are_at_their_vertices_and_linear_between() {
    let points = generate(Kind::Jittered, 64, 4);
    let plane = |p: DVec2| 3.0 - p.x + 2.0 * p.y;
    let mut session = Session::new(&points, &Mesher::new()).unwrap();
    session.remove(&[PointId(20)]).unwrap();
    let inside = session.insert(DVec2::new(0.5, 0.5)).unwrap().points[0];
    let made = session.mesh();
    let height = |id: PointId| points.get(id.0 as usize).map(|p| plane(*p));
    let values = session.vertex_values(&made, height).unwrap().unwrap();
    assert_eq!(values.len(), made.mesh.vertices.len());
    for &(id, v) in &made.points {
        let (value, at) = (values[v.index()], made.mesh.vertices[v.index()]);
        match height(id) {
            Some(height) => assert_eq!(value, height),
            None => assert!(id == inside && (value - plane(at)).abs() < 1e-12, "{value}"),
        }
    }
    assert_eq!(session.vertex_values(&made, |_| None).unwrap(), None);
}
