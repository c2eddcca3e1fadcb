//! What insertions into sessions of growing size cost, in CPU time, how their
//! meshes compare with those made at once, and what removals leave.
//!
//! `cargo run --release -p hexdel --example sessions -- INSERTIONS POINTS|FILE.poly ..`

use hexdel::{DVec2, Mesher, Method, PointId, Pslg, Session, SessionError, generate};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let insertions = args.next().map_or(Ok(200), |a| a.parse::<usize>())?;
    for what in args {
        match what.parse::<usize>() {
            Ok(n) => points(n, insertions)?,
            Err(_) => graph(&what, insertions)?,
        }
    }
    Ok(())
}

/// Uniform points in a domain that has room for those to come.
fn points(n: usize, insertions: usize) -> Result<(), Box<dyn Error>> {
    let all = generate::generate(generate::Kind::Uniform, n + insertions, 1);
    let began = (Instant::now(), cpu_ms());
    let mut session = Session::new(&all[..n], &Mesher::new().threads(1))?;
    started(&format!("{n} points"), &session, began);
    run(&mut session, &all[n..])?;
    let present: Vec<DVec2> = session.points().map(|p| p.1).collect();
    let once = Mesher::new().method(Method::Compact).triangulate(&present)?;
    compare(&session, once.mesh.triangles.len());
    remove(&mut session, n)
}

/// Points spread over the box around a PSLG.
fn graph(file: &str, insertions: usize) -> Result<(), Box<dyn Error>> {
    let graph = hexdel::io::read_points(file)?;
    let began = (Instant::now(), cpu_ms());
    let mut session = Session::with_segments(&graph, &Mesher::new().threads(1))?;
    started(file, &session, began);
    let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = graph.points.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)));
    let spread = generate::generate(generate::Kind::Uniform, insertions, 1);
    let spread: Vec<DVec2> =
        spread.into_iter().map(|p| low + (high - low) * p.clamp(DVec2::ZERO, DVec2::ONE)).collect();
    let first = graph.points.len();
    run(&mut session, &spread)?;
    let mut more: Pslg = graph;
    more.points.extend(session.points().filter(|p| p.0.0 as usize >= first).map(|p| p.1));
    more.point_markers.clear();
    (more.point_attributes, more.attributes_per_point) = (Vec::new(), 0);
    compare(&session, Mesher::new().triangulate_pslg(&more)?.mesh.triangles.len());
    remove(&mut session, first)
}

#[allow(clippy::print_stdout, reason = "an example prints")]
fn started(what: &str, session: &Session, (wall, cpu): (Instant, f64)) {
    let [points, _, triangles] = session.counts();
    let (wall, cpu) = (wall.elapsed().as_secs_f64(), (cpu_ms() - cpu) * 1e-3);
    println!(
        "{what}: {points} points, {triangles} triangles; begun in {wall:.1} s, {cpu:.1} s here; {}",
        memory()
    );
}

/// Puts points in one by one.
#[allow(clippy::print_stdout, reason = "an example prints")]
fn run(session: &mut Session, points: &[DVec2]) -> Result<(), Box<dyn Error>> {
    let (mut times, mut remeshed, mut changed, mut outside, mut no_room) = (Vec::new(), 0, 0, 0, 0);
    for &p in points {
        let began = cpu_ms();
        match session.insert(p) {
            Err(SessionError::Outside { .. } | SessionError::NotCovered { .. }) => outside += 1,
            Err(SessionError::NoRoom { at }) => {
                no_room += 1;
                println!("  no room at {at}");
            }
            outcome => {
                let outcome = outcome?;
                times.push(cpu_ms() - began);
                remeshed += usize::from(outcome.remeshed);
                changed += outcome.delta.triangles_added.len();
            }
        }
    }
    println!(
        "  {} insertions, {remeshed} by meshing anew; {outside} outside, {no_room} without room",
        times.len()
    );
    print("insert", &mut times);
    println!(
        "  {} triangles changed by each; holds: {}",
        changed / times.len().max(1),
        session.check().holds()
    );
    Ok(())
}

#[allow(clippy::print_stdout, reason = "an example prints")]
fn compare(session: &Session, once: usize) {
    let now = session.counts()[2];
    println!("  {now} triangles, {:.3} of the {once} made at once; {}", now as f64 / once as f64, memory());
}

/// Takes the points from number `first` on out, one by one.
#[allow(clippy::print_stdout, reason = "an example prints")]
fn remove(session: &mut Session, first: usize) -> Result<(), Box<dyn Error>> {
    let ids: Vec<PointId> = session.points().map(|p| p.0).filter(|id| id.0 as usize >= first).collect();
    let (mut times, mut no_room) = (Vec::new(), 0);
    for id in ids {
        let began = cpu_ms();
        match session.remove(&[id]) {
            Err(SessionError::NoRoom { .. }) => no_room += 1,
            outcome => {
                outcome?;
                times.push(cpu_ms() - began);
            }
        }
    }
    print("remove", &mut times);
    let now = session.counts()[2];
    println!("  {now} triangles again; {no_room} stay; holds: {}", session.check().holds());
    Ok(())
}

#[allow(clippy::print_stdout, reason = "an example prints")]
fn print(what: &str, ms: &mut [f64]) {
    ms.sort_by(f64::total_cmp);
    let at = |share: f64| {
        ms.get((ms.len().saturating_sub(1) as f64 * share) as usize).copied().unwrap_or(f64::NAN)
    };
    let (median, nine, most) = (at(0.5), at(0.9), at(1.0));
    println!("  {what}: median {median:.2} ms, 90 % {nine:.2}, 99 % {:.2}, most {most:.2}", at(0.99));
}

/// Milliseconds that this thread has run, by the system's account.
fn cpu_ms() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|ns| ns.parse::<f64>().ok()).unwrap_or(f64::NAN) * 1e-6
}

/// The most memory in use so far.
fn memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:")).unwrap_or("").trim().to_owned();
    format!("{peak} at most")
}
