#![no_main]

use hexdel_io::{PointFormat, read_points_from};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = read_points_from(bytes, PointFormat::Shapefile, "fuzz");
});
