//! Progress: told to a function of JavaScript, which stops the work by returning `false` or
//! throwing.

use hexdel::{Monitor, Phase};
use js_sys::Function;
use std::cell::{Cell, RefCell};
use wasm_bindgen::JsValue;

thread_local! {
    /// Who is told. There is one thread, and one call at a time.
    static LISTENER: RefCell<Option<Function>> = const { RefCell::new(None) };
    static STOPPED: Cell<bool> = const { Cell::new(false) };
}

/// Watches the work of one call.
pub(crate) struct Watch;

impl Watch {
    pub(crate) fn new(listener: Option<Function>) -> Self {
        LISTENER.set(listener);
        STOPPED.set(false);
        Self
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        LISTENER.set(None);
    }
}

impl Monitor for Watch {
    fn progress(&self, phase: Phase, done: u64, total: u64) {
        // The function may call the library in its turn, so it is not borrowed meanwhile.
        let Some(listener) = LISTENER.with_borrow(Clone::clone) else { return };
        let name = match phase {
            Phase::Refine => "refine",
            Phase::Extract => "extract",
            Phase::Optimize => "optimize",
            _ => "certify",
        };
        let answer =
            listener.call3(&JsValue::NULL, &name.into(), &(done as f64).into(), &(total as f64).into());
        if answer.map_or(true, |answer| answer == JsValue::FALSE) {
            STOPPED.set(true);
        }
    }

    fn cancelled(&self) -> bool {
        STOPPED.get()
    }
}
