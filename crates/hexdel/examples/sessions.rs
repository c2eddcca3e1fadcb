//! What insertions into sessions of growing size cost, in CPU time, and how
//! their meshes compare with those made at once.
//!
//! `cargo run --release -p hexdel --example sessions -- INSERTIONS POINTS ..`

use hexdel::{DVec2, Effort, Mesher, Method, PointId, Session, generate};

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1).map(|a| a.parse::<usize>());
    let insertions = args.next().unwrap_or(Ok(200))?;
    for n in args {
        let n = n?;
        let all = generate::generate(generate::Kind::Uniform, n + insertions, 1);
        let mesher = Mesher::new().effort(Effort::Standard);
        let mut session = Session::new(&all[..n], &mesher)?;
        let before = session.counts()[2];
        let (mut inserted, mut remeshed, mut changed) = (Vec::new(), 0, 0);
        for &p in &all[n..] {
            let began = cpu_ms();
            let outcome = match session.insert(p) {
                Err(hexdel::SessionError::Outside { .. }) => continue,
                outcome => outcome?,
            };
            inserted.push(cpu_ms() - began);
            remeshed += usize::from(outcome.remeshed);
            changed += outcome.delta.triangles_added.len();
        }
        let after = session.counts();
        let certified = session.certificate().holds();
        let points: Vec<DVec2> = session.points().map(|p| p.1).collect();
        let once = mesher.method(Method::Compact).triangulate(&points)?.mesh.triangles.len();
        println!("{n} points, {before} triangles; {} insertions, {remeshed} by meshing anew", inserted.len());
        print("insert", &mut inserted);
        println!("  {} triangles changed by each; certified: {certified}", changed / inserted.len());
        println!("  {} triangles, {:.3} of the {once} made at once", after[2], after[2] as f64 / once as f64);
        let mut removed = Vec::new();
        for id in n..n + inserted.len() {
            let began = cpu_ms();
            session.remove(&[PointId(id as u64)])?;
            removed.push(cpu_ms() - began);
        }
        print("remove", &mut removed);
        let back = session.counts()[2];
        println!(
            "  {back} triangles again, {:.3} of before; certified: {}",
            back as f64 / before as f64,
            session.certificate().holds()
        );
    }
    Ok(())
}

#[allow(clippy::print_stdout, reason = "an example prints")]
fn print(what: &str, ms: &mut [f64]) {
    ms.sort_by(f64::total_cmp);
    let at = |share: f64| ms[((ms.len() - 1) as f64 * share) as usize];
    println!(
        "  {what}: median {:.2} ms, 90 % {:.2}, 99 % {:.2}, most {:.2}",
        at(0.5),
        at(0.9),
        at(0.99),
        at(1.0)
    );
}

/// Milliseconds that this thread has run, by the system's account.
fn cpu_ms() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|ns| ns.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-6
}
