//! What changes of growing sessions of templates cost, and how their meshes
//! compare with those made at once.
//!
//! `cargo run --release -p hexdel --example template_sessions -- CHANGES POINTS ..`

use hexdel::{DVec2, Mesher, Method, PointId, SessionError, TemplateSession, generate};
use std::time::Instant;

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1).map(|a| a.parse::<usize>());
    let changes = args.next().unwrap_or(Ok(200))?;
    for n in args {
        let n = n?;
        let all = generate::generate(generate::Kind::Uniform, n + changes, 1);
        let mesher = Mesher::new().method(Method::Templates);
        let began = Instant::now();
        let mut session = TemplateSession::new(&all[..n], &mesher)?;
        let before = session.counts()[2];
        println!("{n} points, {before} triangles, made in {:.0} ms", ms(began));
        let (mut inserted, mut remeshed, mut changed) = (Vec::new(), 0, 0);
        for &p in &all[n..] {
            let began = Instant::now();
            let outcome = match session.insert(p) {
                Err(SessionError::Outside { .. }) => continue,
                outcome => outcome?,
            };
            inserted.push(ms(began));
            remeshed += usize::from(outcome.remeshed);
            changed += outcome.delta.triangles_added.len();
        }
        print("insert", &mut inserted);
        println!("  {} triangles new with each; {remeshed} meshed anew", changed / inserted.len());
        compare(&session, &mesher)?;
        let (mut removed, mut undone) = (Vec::new(), Vec::new());
        for id in (n as u64..).take(inserted.len()) {
            let began = Instant::now();
            session.remove(&[PointId(id)])?;
            removed.push(ms(began));
        }
        print("remove", &mut removed);
        println!("  {:.3} of the triangles before", session.counts()[2] as f64 / before as f64);
        compare(&session, &mesher)?;
        for _ in 0..inserted.len().min(200) {
            let began = Instant::now();
            session.undo()?;
            undone.push(ms(began));
        }
        print("undo", &mut undone);
    }
    Ok(())
}

/// Certifies a session and compares it with the mesh that is made at once.
#[allow(clippy::print_stdout, reason = "an example prints")]
fn compare(session: &TemplateSession, mesher: &Mesher) -> Result<(), hexdel::Error> {
    let points: Vec<DVec2> = session.points().map(|p| p.1).collect();
    let once = mesher.triangulate(&points)?.mesh.triangles.len();
    let now = session.counts()[2];
    let certified = session.certificate().holds();
    println!(
        "  {now} triangles, {:.3} of those made at once; certified: {certified}",
        now as f64 / once as f64
    );
    Ok(())
}

#[allow(clippy::print_stdout, reason = "an example prints")]
fn print(what: &str, ms: &mut [f64]) {
    ms.sort_by(f64::total_cmp);
    let at = |share: f64| ms[((ms.len() - 1) as f64 * share) as usize];
    println!("  {what}: median {:.2} ms, 90 % {:.2}, most {:.2}", at(0.5), at(0.9), at(1.0));
}

fn ms(began: Instant) -> f64 {
    began.elapsed().as_secs_f64() * 1e3
}
