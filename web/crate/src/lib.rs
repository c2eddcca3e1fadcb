//! hexdel in browsers and Node: what `web/package` calls.
//!
//! Arrays go in and out as typed arrays, options and certificates as JSON. Errors are thrown
//! as JSON, too, and made exceptions by the package (`errors.ts`). Nothing here is an
//! interface for users: that is the package, with its types.
//!
//! Everything runs on the thread that called, without files. The same input gives the same
//! bytes as the program.

mod convert;
mod errors;
mod graph;
mod mesh;
mod options;
mod session;
mod watch;

use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = console, js_name = error)]
    fn console_error(text: &str);
}

/// Lets a panic, which is a defect, be seen before the module traps.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|info| console_error(&format!("a defect of hexdel: {info}"))));
}

/// The version of the library.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// The names of the formats that meshes are written in.
#[wasm_bindgen]
pub fn mesh_formats() -> Vec<String> {
    hexdel::io::MeshFormat::names().map(ToOwned::to_owned).collect()
}

/// Test points of a kind, as x and y by turns.
#[wasm_bindgen]
pub fn generate(kind: &str, count: u32, seed: u32) -> Result<Vec<f64>, JsValue> {
    let kind: hexdel::generate::Kind = kind
        .parse()
        .map_err(|error: hexdel::generate::UnknownKind| errors::plain("option", &error.to_string()))?;
    Ok(convert::flat(&hexdel::generate::generate(kind, count as usize, u64::from(seed))))
}
