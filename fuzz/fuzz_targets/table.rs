#![no_main]

use hexdel_io::{PointFormat, PointReader, read_points_from};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = read_points_from(bytes, PointFormat::Table, "fuzz");
    let _ = PointReader::new().read_from(bytes, PointFormat::Table, "fuzz");
});
