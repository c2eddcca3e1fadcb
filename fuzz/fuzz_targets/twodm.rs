#![no_main]

use hexdel_io::{MeshFormat, read_mesh_from};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = read_mesh_from(bytes, MeshFormat::TwoDm, "fuzz");
});
