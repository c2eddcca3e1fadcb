#![no_main]

use hexdel::Error;
use hexdel::pslg::PslgError;
use hexdel_fuzz::{Bytes, check_graph};
use libfuzzer_sys::fuzz_target;

// PSLGs, repaired or not, in every domain: a mesh that certifies, with all that fails
// listed, or an error about the input.
fuzz_target!(|bytes: &[u8]| {
    let mut bytes = Bytes(bytes);
    let mesher = bytes.mesher();
    let graph = bytes.graph();
    match mesher.triangulate_pslg(&graph) {
        Ok(made) => check_graph(&made),
        Err(
            Error::Segments(_)
            | Error::Points(_)
            | Error::Pslg(
                PslgError::NothingEnclosed { .. }
                | PslgError::FlatHull { .. }
                | PslgError::TooClose { .. }
                | PslgError::TooMany { .. }
                | PslgError::NotRecovered { .. },
            ),
        ) => {}
        Err(error) => panic!("{error} {graph:?}"),
    }
});
