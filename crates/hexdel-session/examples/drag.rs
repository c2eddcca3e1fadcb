//! A point that moves across a mesh, and what of the mesh changes with it.
//!
//! `cargo run --release -p hexdel-session --example drag`

use hexdel_geom::DVec2;
use hexdel_mesher::Mesher;
use hexdel_session::{Session, SessionError};

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), SessionError> {
    let spiral = (1..=100).map(|i| DVec2::from_angle(0.4 * f64::from(i)) * f64::from(i));
    let points: Vec<DVec2> = spiral.collect();
    let mut session = Session::new(&points, &Mesher::new())?;
    println!("{} triangles", session.counts()[2]);
    for step in 0..10 {
        let at = DVec2::new(10.0 * f64::from(step) - 45.0, 2.5);
        let delta = session.insert(at)?.delta;
        let (gone, new) = (delta.triangles_removed.len(), delta.triangles_added.len());
        println!("at ({}, {}): {gone} triangles gone, {new} new", at.x, at.y);
        session.undo()?;
    }
    Ok(())
}
