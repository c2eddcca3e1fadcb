//! What sizes come to: triangles, angles, the longest edge over the one wanted.
//!
//! `cargo run --release -p hexdel --example sizes`

use hexdel::{DVec2, Mesher, Method, Size, generate};

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let points = generate::generate(generate::Kind::Uniform, 200, 1);
    let sizes = [
        ("constant 0.1", Size::constant(0.1)?),
        ("constant 0.02", Size::constant(0.02)?),
        ("box 0.005", Size::unlimited().and_box(DVec2::splat(0.4), DVec2::splat(0.5), 0.005)?),
        ("point 0.001", Size::unlimited().and_points(&[(DVec2::splat(0.3), 0.001)])?),
        ("function", Size::function(|p| 0.01 + 0.1 * (p.x - 0.5).abs())),
    ];
    for method in [Method::Templates, Method::Compact] {
        for (name, size) in &sizes {
            let made = Mesher::new().method(method).size(size.clone()).triangulate(&points);
            match made {
                Ok(made) => println!(
                    "{method:?}, {name}: {} triangles, {:.4} to {:.4} degrees, longest edge {:.4} of what is wanted, {:.2} s",
                    made.mesh.triangles.len(),
                    made.certificate.min_angle_deg,
                    made.certificate.max_angle_deg,
                    made.size_ratio.unwrap_or(0.0),
                    made.seconds.total
                ),
                Err(error) => println!("{method:?}, {name}: {error}"),
            }
        }
    }
    Ok(())
}
