#![no_main]

use hexdel_io::parse_raster;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = parse_raster(bytes, "fuzz");
});
