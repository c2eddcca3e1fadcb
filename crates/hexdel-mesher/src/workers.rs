//! The threads that work.

use crate::error::Error;
use hexdel_geom::par::Pool;
use std::sync::Arc;

/// Most threads that may be asked for: more than any machine has use for, and few enough to start.
pub(crate) const MAX_THREADS: usize = 1024;

/// So many threads as were asked for, or those of whoever calls.
#[derive(Clone, Debug, Default)]
pub struct Workers(Option<Arc<Pool>>);

impl Workers {
    /// As many as were asked for; those of whoever calls, if none were.
    ///
    /// # Errors
    ///
    /// [`Error::Threads`].
    pub fn new(threads: Option<usize>) -> Result<Self, Error> {
        let Some(threads) = threads else {
            return Ok(Self(None));
        };
        check_threads(threads)?;
        let pool = Pool::new(threads).ok_or(Error::Threads { threads })?;
        Ok(Self(Some(Arc::new(pool))))
    }

    /// Works on them.
    pub fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match &self.0 {
            Some(pool) => pool.run(work),
            None => work(),
        }
    }
}

/// Refuses more threads than there may be.
///
/// # Errors
///
/// [`Error::Threads`].
pub fn check_threads(threads: usize) -> Result<(), Error> {
    if threads <= MAX_THREADS { Ok(()) } else { Err(Error::Threads { threads }) }
}
