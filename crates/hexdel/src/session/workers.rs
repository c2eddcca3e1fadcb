//! The threads that a session was made with.

use crate::error::Error;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::Arc;

/// So many threads as were asked for, or those of whoever calls.
#[derive(Clone, Debug, Default)]
pub(super) struct Workers(Option<Arc<ThreadPool>>);

impl Workers {
    /// # Errors
    ///
    /// [`Error::Threads`].
    pub(super) fn new(threads: Option<usize>) -> Result<Self, Error> {
        let Some(threads) = threads else {
            return Ok(Self(None));
        };
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        Ok(Self(Some(Arc::new(pool.map_err(|_| Error::Threads { threads })?))))
    }

    /// Works on them.
    pub(super) fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match &self.0 {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}
