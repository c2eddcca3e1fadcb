#![no_main]

use hexdel_io::read_mesh_pair;
use libfuzzer_sys::fuzz_target;

/// The vertices that the triangles refer to.
const NODES: &[u8] = b"4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n";

fuzz_target!(|bytes: &[u8]| {
    let _ = read_mesh_pair((NODES, "fuzz.node"), (bytes, "fuzz.ele"));
});
