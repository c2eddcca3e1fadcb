//! Work without the GIL, that Ctrl-C stops and that tells how far it is.
//!
//! Meshing runs on a thread of its own, in a pool of its own. The thread that Python
//! called on sleeps detached from the interpreter, and wakes up to look for signals
//! (which Python sees on its main thread only) and to run the callback. An exception
//! in either stops the work at the next question of its monitor.
//!
//! rayon's global pool is never used: in a child that was forked from a process that
//! did use it, its threads do not exist, and whoever waits for them waits for ever.

use crate::errors;
use hexdel::{Monitor, Phase};
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How long the calling thread sleeps between two looks for signals.
const TICK: Duration = Duration::from_millis(15);

/// How long work may take to notice that it is to stop.
const PATIENCE: Duration = Duration::from_millis(40);

/// Stack of the threads that work, bytes.
const STACK: usize = 8 << 20;

/// The pool of this process, by its id: a forked child makes one of its own.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// What the work says, and what is said to it.
#[derive(Default)]
pub(crate) struct Watch {
    stop: AtomicBool,
    progress: Mutex<Option<(Phase, u64, u64)>>,
    /// An exception on a thread of the work.
    failure: Mutex<Option<PyErr>>,
}

impl Watch {
    /// Stops the work because of an exception, the first one if there are more.
    pub(crate) fn fail(&self, error: PyErr) {
        let mut failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner);
        failure.get_or_insert(error);
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Whether the work is to stop.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Forgets what stopped work before.
    pub(crate) fn reset(&self) {
        self.failure();
        self.stop.store(false, Ordering::Relaxed);
    }

    /// The exception that stopped the work.
    pub(crate) fn failure(&self) -> Option<PyErr> {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Calls back with how far the work is, if it is further than the last time.
    fn report(&self, callback: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let Some(callback) = callback else { return Ok(()) };
        let now = self.progress.lock().unwrap_or_else(PoisonError::into_inner).take();
        match now {
            Some((phase, done, total)) => callback.call1((name(phase), done, total)).map(|_| ()),
            None => Ok(()),
        }
    }
}

impl Monitor for Watch {
    fn progress(&self, phase: Phase, done: u64, total: u64) {
        *self.progress.lock().unwrap_or_else(PoisonError::into_inner) = Some((phase, done, total));
    }

    fn cancelled(&self) -> bool {
        self.is_stopped()
    }
}

fn name(phase: Phase) -> &'static str {
    match phase {
        Phase::Refine => "refine",
        Phase::Extract => "extract",
        Phase::Optimize => "optimize",
        _ => "certify",
    }
}

/// Threads to work on: the process's own, or as many as asked for.
fn pool(py: Python<'_>, threads: Option<usize>) -> PyResult<Arc<ThreadPool>> {
    let build = |threads: usize| {
        let built = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build();
        built.map(Arc::new).map_err(|_| errors::threads(py, threads))
    };
    if let Some(threads) = threads {
        return build(threads);
    }
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some((of, pool)) = &*pool
        && *of == process
    {
        return Ok(pool.clone());
    }
    let anew = build(0)?;
    // The threads of the pool of a parent are not here to be ended.
    std::mem::forget(pool.replace((process, anew.clone())));
    Ok(anew)
}

/// Runs work on other threads.
///
/// Work that was stopped and does not notice it within `PATIENCE` is left to end by
/// itself: what comes of it is thrown away.
///
/// # Errors
///
/// What signals, the callback and `Watch::fail` raise; a panic of the work.
pub(crate) fn run<T: Send + 'static>(
    py: Python<'_>,
    threads: Option<usize>,
    watch: &Watch,
    callback: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let pool = pool(py, threads)?;
    let (tell, mut told) = sync_channel(1);
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(move || {
        let done = catch_unwind(AssertUnwindSafe(|| pool.install(work)));
        // Nobody receives what was given up.
        let _ = tell.send(done);
    });
    let thread = thread.map_err(|_| errors::threads(py, 1))?;
    let mut stopped: Option<Instant> = None;
    loop {
        let (answer, back) = py.detach(move || (told.recv_timeout(TICK), told));
        told = back;
        if stopped.is_none() {
            // Once the work has ended Python looks for signals itself, after the call.
            let signals = if answer.is_ok() { Ok(()) } else { py.check_signals() };
            signals.and_then(|()| watch.report(callback)).unwrap_or_else(|error| watch.fail(error));
        }
        if watch.is_stopped() {
            stopped.get_or_insert_with(Instant::now);
        }
        let given_up = stopped.is_some_and(|since| since.elapsed() > PATIENCE);
        let ended = match answer {
            Err(RecvTimeoutError::Timeout) if !given_up => continue,
            Err(RecvTimeoutError::Timeout) => None,
            Ok(done) => Some(done.map_err(|panic| errors::panicked(py, panic.as_ref()))),
            Err(RecvTimeoutError::Disconnected) => Some(Err(errors::panicked(py, &()))),
        };
        if ended.is_some() {
            // It has nothing left to do.
            py.detach(move || thread.join().is_ok());
        }
        let failure = watch.failure();
        return match (failure, ended) {
            (Some(failure), _) => Err(failure),
            (None, Some(ended)) => ended,
            (None, None) => Err(errors::plain(py, "cancelled", "cancelled")),
        };
    }
}
