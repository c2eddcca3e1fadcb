//! Progress that only advances, and work that stops when asked to.

#![cfg(feature = "io")]

use crate::common;
use hexdel::geom::Cancelled;
use hexdel::{Error, Mesher, Method, Monitor, Phase};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Gives up at the question numbered `at`, from 0.
struct CancelAt {
    at: usize,
    asked: AtomicUsize,
}

impl Monitor for CancelAt {
    fn cancelled(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.at
    }
}

#[derive(Default)]
struct Log(Mutex<Vec<(Phase, u64, u64)>>);

impl Monitor for Log {
    fn progress(&self, phase: Phase, done: u64, total: u64) {
        self.0.lock().unwrap().push((phase, done, total));
    }
}

#[test]
fn work_stops_at_every_question() {
    let points = common::points("plane100");
    for method in [Method::Templates, Method::Simple, Method::Compact] {
        let mesher = Mesher::new().method(method);
        let never = CancelAt { at: usize::MAX, asked: AtomicUsize::new(0) };
        let made = mesher.triangulate_watched(&points, &never).unwrap();
        let questions = never.asked.into_inner();
        assert!(questions > 10, "asked {questions} times only");
        for at in 0..questions {
            let monitor = CancelAt { at, asked: AtomicUsize::new(0) };
            let error = mesher.triangulate_watched(&points, &monitor).unwrap_err();
            assert_eq!(error, Error::Cancelled(Cancelled));
            assert_eq!(monitor.asked.into_inner(), at + 1, "asked again after it said stop");
        }
        // Nothing is left behind that a later run would see.
        let again = mesher.triangulate(&points).unwrap();
        assert!(common::bits(&made) == common::bits(&again));
    }
}

#[test]
fn progress_only_advances() {
    for name in ["one_point", "two_close", "plane100", "contrast"] {
        for method in [Method::Templates, Method::Simple, Method::Compact] {
            let log = Log::default();
            Mesher::new().method(method).triangulate_watched(&common::points(name), &log).unwrap();
            let log = log.0.into_inner().unwrap();
            for pair in log.windows(2) {
                let [(before, done, _), (phase, more, _)] = [pair[0], pair[1]];
                assert!((before, done) <= (phase, more), "{name}: {pair:?}");
            }
            assert!(log.iter().all(|(_, done, total)| done <= total), "{name}");
            for phase in [Phase::Extract, Phase::Certify] {
                let (_, done, total) = *log.iter().rfind(|(p, ..)| *p == phase).unwrap();
                assert_eq!(done, total, "{name}: {phase:?} does not end");
            }
        }
    }
}
