//! The methods on the same points: triangles, angles, time.
//!
//! `cargo run --release -p hexdel-mesher --example methods`

use hexdel_geom::DVec2;
use hexdel_mesher::{Error, Mesher, Method};

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Error> {
    // Points along a spiral, denser towards its centre.
    let arms = (1..=200).map(|i| DVec2::from_angle(0.4 * f64::from(i)) * f64::from(i * i));
    let points: Vec<DVec2> = arms.collect();
    for method in [Method::Compact, Method::Templates, Method::Simple] {
        let made = Mesher::new().method(method).triangulate(&points)?;
        let (certificate, triangles) = (&made.certificate, made.mesh.triangles.len());
        println!(
            "{method:?}: {triangles} triangles, {:.2} to {:.2} degrees, {:.3} s",
            certificate.min_angle_deg, certificate.max_angle_deg, made.seconds.total
        );
    }
    Ok(())
}
