#![no_main]

use hexdel::{Error, Mesher, PointId, Session, SessionError};
use hexdel_fuzz::{Bytes, check_session};
use libfuzzer_sys::fuzz_target;

// Points come to and go from a session of points or of a PSLG; every state holds, and
// what is refused changes nothing.
fuzz_target!(|bytes: &[u8]| {
    let mut bytes = Bytes(bytes);
    let mesher = Mesher::new().threads(1);
    let started = if bytes.below(2) == 0 {
        Session::new(&bytes.points(6), &mesher)
    } else {
        Session::with_segments(&bytes.graph(), &mesher.repair())
    };
    let Ok(mut session) = started else { return };
    check_session(&session);
    for _ in 0..6 {
        if bytes.is_over() {
            return;
        }
        let before = session.counts();
        let done = match bytes.below(4) {
            0 | 1 => session.insert(bytes.place()),
            2 => {
                let ids: Vec<PointId> = session.points().map(|p| p.0).collect();
                let Some(&id) = ids.get(usize::from(bytes.next()) % ids.len().max(1)) else { return };
                session.remove(&[id])
            }
            _ => session.undo(),
        };
        match done {
            Ok(_) => {}
            Err(SessionError::Mesh(Error::TooClose { .. })) => assert_eq!(session.counts(), before),
            Err(error @ (SessionError::Mesh(_) | SessionError::NotCertified { .. })) => panic!("{error}"),
            Err(_) => assert_eq!(session.counts(), before),
        }
        check_session(&session);
    }
});
