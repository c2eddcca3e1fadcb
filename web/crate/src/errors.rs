//! Errors of the library as they are thrown: JSON with a kind, the library's words, and the
//! items and the place that they are about.

use hexdel::io::ReadError;
use hexdel::{Error, Fault, SessionError, SizeError};
use serde::Serialize;
use wasm_bindgen::JsValue;

#[derive(Serialize)]
struct Thrown<'a> {
    #[serde(flatten)]
    fault: Fault,
    message: &'a str,
}

fn thrown(fault: Fault, message: &str) -> JsValue {
    // Numbers that are not finite become null.
    serde_json::to_string(&Thrown { fault, message }).unwrap_or_else(|_| message.to_owned()).into()
}

/// A failure that only the kind and a message tell of.
pub(crate) fn plain(kind: &'static str, message: &str) -> JsValue {
    thrown(Fault::new(kind), message)
}

/// Why points or a graph were not meshed.
pub(crate) fn of_mesh(error: &Error) -> JsValue {
    thrown(error.fault(), &error.to_string())
}

/// Why a size is none.
pub(crate) fn of_size(error: &SizeError) -> JsValue {
    thrown(error.fault(), &error.to_string())
}

/// Why a file was not read.
pub(crate) fn of_reading(error: &ReadError) -> JsValue {
    thrown(Fault::of_reading(error), &error.to_string())
}

/// Why a session did not do what was asked.
pub(crate) fn of_session(error: &SessionError) -> JsValue {
    thrown(error.fault(), &error.to_string())
}
