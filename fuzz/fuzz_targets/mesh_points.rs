#![no_main]

use hexdel::{AngleBounds, Error, Mesher, Method};
use hexdel_fuzz::Bytes;
use libfuzzer_sys::fuzz_target;

// Points by every method: a mesh that certifies, or an error about the input.
fuzz_target!(|bytes: &[u8]| {
    let mut bytes = Bytes(bytes);
    let method = [Method::Compact, Method::Templates, Method::Simple][usize::from(bytes.below(3))];
    let mut mesher = Mesher::new().method(method).threads(1);
    if method == Method::Compact && bytes.below(2) == 0 {
        let [min, max] = [[0.0, 90.0], [30.0, 90.0], [30.0, 120.0], [40.0, 100.0]][usize::from(bytes.below(4))];
        mesher = mesher.bounds(AngleBounds::new(min, max).expect("these are bounds"));
    }
    let points = bytes.points(12);
    match mesher.triangulate(&points) {
        Ok(made) => {
            let options = hexdel::geom::CertifyOptions {
                bounds: made.certificate.bounds,
                inputs: Some(&points),
                ..Default::default()
            };
            let certificate = hexdel::geom::certify(&made.mesh, &options);
            assert!(certificate.holds(), "{:?}", certificate.violations);
        }
        Err(Error::TooClose { .. }) => {}
        Err(error) => panic!("{error} {points:?}"),
    }
});
