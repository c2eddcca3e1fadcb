#![no_main]

use hexdel_io::parse_sizes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = parse_sizes(bytes, "fuzz");
});
