//! Parallel work: that of rayon with the feature `rayon`, else the same on one thread.
//!
//! The crates of the workspace take what they need of rayon from here. Without the feature the few methods that they
//! use are those of plain iterators and slices, by the same names. Results are the same either way, to the last bit:
//! parallel work is mapped and collected in order, and what is sorted has no two elements that compare equal and differ.
//!
//! This is not for users: it is hidden from the documentation and may change with any version.

#[cfg(not(feature = "rayon"))]
pub use on_one::{Pool, current_num_threads, on_a_thread};
#[cfg(feature = "rayon")]
pub use on_threads::{Pool, current_num_threads, on_a_thread};

/// The methods, to be brought in as a whole.
pub mod prelude {
    #[cfg(not(feature = "rayon"))]
    pub use super::on_one::{IntoParallelIterator, ParallelExtend, ParallelIterator, ParallelSlice};
    #[cfg(feature = "rayon")]
    pub use rayon::prelude::*;
}

#[cfg(feature = "rayon")]
mod on_threads {
    pub use rayon::current_num_threads;

    /// Threads of one's own.
    #[derive(Debug)]
    pub struct Pool(rayon::ThreadPool);

    impl Pool {
        /// So many threads, if they can be started.
        pub fn new(threads: usize) -> Option<Self> {
            rayon::ThreadPoolBuilder::new().num_threads(threads).build().ok().map(Self)
        }

        /// Works on them.
        pub fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
            self.0.install(work)
        }
    }

    /// Works on one of the threads that work in parallel: handing them many small tasks from outside takes longer.
    pub fn on_a_thread<T: Send>(work: impl FnOnce() -> T + Send) -> T {
        rayon::scope(|_| work())
    }
}

#[cfg(not(feature = "rayon"))]
mod on_one {
    use std::cmp::Ordering;
    use std::slice::{Chunks, Iter, IterMut};

    /// How many threads work.
    pub fn current_num_threads() -> usize {
        1
    }

    /// The thread of whoever calls.
    #[derive(Debug)]
    pub struct Pool(());

    impl Pool {
        /// One thread, however many are asked for.
        pub fn new(_threads: usize) -> Option<Self> {
            Some(Self(()))
        }

        /// Works on it.
        pub fn run<T>(&self, work: impl FnOnce() -> T) -> T {
            work()
        }
    }

    /// Works on it.
    pub fn on_a_thread<T>(work: impl FnOnce() -> T) -> T {
        work()
    }

    /// What becomes an iterator.
    pub trait IntoParallelIterator: IntoIterator + Sized {
        /// [`IntoIterator::into_iter`].
        fn into_par_iter(self) -> Self::IntoIter {
            self.into_iter()
        }
    }

    impl<I: IntoIterator> IntoParallelIterator for I {}

    /// What iterators of rayon have and others have not, or by another name.
    pub trait ParallelIterator: Iterator + Sized {
        /// The iterator as it is.
        #[must_use]
        fn with_min_len(self, _len: usize) -> Self {
            self
        }

        /// [`Iterator::flat_map`].
        fn flat_map_iter<J: IntoIterator>(
            self,
            f: impl FnMut(Self::Item) -> J,
        ) -> impl Iterator<Item = J::Item> {
            self.flat_map(f)
        }

        /// [`Iterator::map`] with scratch space.
        fn map_init<S, T>(
            self,
            init: impl FnOnce() -> S,
            mut f: impl FnMut(&mut S, Self::Item) -> T,
        ) -> impl Iterator<Item = T> {
            let mut scratch = init();
            self.map(move |item| f(&mut scratch, item))
        }
    }

    impl<I: Iterator> ParallelIterator for I {}

    /// What slices of rayon have, by other names.
    pub trait ParallelSlice<T> {
        /// [`slice::iter`].
        fn par_iter(&self) -> Iter<'_, T>;
        /// [`slice::iter_mut`].
        fn par_iter_mut(&mut self) -> IterMut<'_, T>;
        /// [`slice::chunks`].
        fn par_chunks(&self, len: usize) -> Chunks<'_, T>;
        /// [`slice::sort_unstable`].
        fn par_sort_unstable(&mut self)
        where
            T: Ord;
        /// [`slice::sort_unstable_by`].
        fn par_sort_unstable_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering);
        /// [`slice::sort_unstable_by_key`].
        fn par_sort_unstable_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K);
    }

    impl<T> ParallelSlice<T> for [T] {
        fn par_iter(&self) -> Iter<'_, T> {
            self.iter()
        }

        fn par_iter_mut(&mut self) -> IterMut<'_, T> {
            self.iter_mut()
        }

        fn par_chunks(&self, len: usize) -> Chunks<'_, T> {
            self.chunks(len)
        }

        fn par_sort_unstable(&mut self)
        where
            T: Ord,
        {
            self.sort_unstable();
        }

        fn par_sort_unstable_by(&mut self, compare: impl FnMut(&T, &T) -> Ordering) {
            self.sort_unstable_by(compare);
        }

        fn par_sort_unstable_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K) {
            self.sort_unstable_by_key(key);
        }
    }

    /// What grows by the items of an iterator.
    pub trait ParallelExtend<T>: Extend<T> {
        /// [`Extend::extend`].
        fn par_extend(&mut self, items: impl IntoIterator<Item = T>) {
            self.extend(items);
        }
    }

    impl<T, V: Extend<T>> ParallelExtend<T> for V {}
}
