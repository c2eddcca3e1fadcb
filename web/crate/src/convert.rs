//! Arrays in and out.

use crate::errors;
use hexdel::DVec2;
use js_sys::{Object, Reflect};
use serde::Serialize;
use wasm_bindgen::JsValue;

/// Numbers in rows of `N`.
pub(crate) fn rows<T: Copy, const N: usize>(what: &str, flat: &[T]) -> Result<Vec<[T; N]>, JsValue> {
    let (rows, rest) = flat.as_chunks::<N>();
    if rest.is_empty() {
        return Ok(rows.to_vec());
    }
    let text = format!("{what}: expected rows of {N} numbers, got {} numbers", flat.len());
    Err(errors::plain("length", &text))
}

/// Points from x and y by turns.
pub(crate) fn points(what: &str, flat: &[f64]) -> Result<Vec<DVec2>, JsValue> {
    Ok(rows::<f64, 2>(what, flat)?.into_iter().map(DVec2::from).collect())
}

/// Points as x and y by turns.
pub(crate) fn flat(points: &[DVec2]) -> Vec<f64> {
    points.iter().flat_map(|p| [p.x, p.y]).collect()
}

/// Indices that may be missing, as -1.
pub(crate) fn indices(indices: impl Iterator<Item = Option<usize>>) -> Vec<i32> {
    indices.map(|i| i.map_or(-1, |i| i as i32)).collect()
}

/// What serde makes of something, as text.
pub(crate) fn json(value: &impl Serialize) -> Result<String, JsValue> {
    serde_json::to_string(value).map_err(|error| errors::plain("internal", &error.to_string()))
}

/// An object of JavaScript that is being put together.
#[derive(Default)]
pub(crate) struct Record(Object);

impl Record {
    /// Adds a member. That does not fail on a plain object.
    pub(crate) fn with(self, name: &str, value: impl Into<JsValue>) -> Self {
        let _ = Reflect::set(&self.0, &name.into(), &value.into());
        self
    }

    pub(crate) fn done(self) -> JsValue {
        self.0.into()
    }
}
