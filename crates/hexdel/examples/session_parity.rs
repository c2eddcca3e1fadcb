//! How many triangles a session comes to, over those of the same points meshed at once: all
//! kinds of point sets, built one by one from nothing, from a tenth and from half, and
//! with every other point taken out again.
//!
//! `cargo run --release -p hexdel --example session_parity -- templates|compact POINTS ..`

use hexdel::generate::{Kind, generate};
use hexdel::{AnySession, DVec2, Mesher, Method, PointId, Pslg, SessionError};

/// How a session comes to its points.
#[derive(Clone, Copy)]
enum Way {
    /// One by one from so many hundredths of them.
    From(usize),
    /// All at once, and every other one out again, one by one.
    Halved,
}

const WAYS: [(&str, Way); 4] =
    [("nothing", Way::From(0)), ("a tenth", Way::From(10)), ("half", Way::From(50)), ("halved", Way::Halved)];

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1).peekable();
    let templates = args.next_if(|a| a.parse::<usize>().is_err()).is_some_and(|a| a == "templates");
    let method = if templates { Method::Templates } else { Method::Compact };
    println!(
        "| kind | points | {} | meshed anew |",
        WAYS.map(|w| format!("{}: domain, tightest", w.0)).join(" | ")
    );
    println!("|---|---:|{}---:|", "---:|".repeat(WAYS.len()));
    let mut all = [Vec::new(), Vec::new()];
    for n in args {
        for kind in Kind::ALL {
            let points = generate(kind, n.parse()?, 1);
            let (mut cells, mut anew) = (Vec::new(), 0);
            for (_, way) in WAYS {
                let (session, remeshed) = run(&points, way, method)?;
                let ratios = compare(session, method)?;
                anew += remeshed;
                cells.push(format!("{:.3}, {:.3}", ratios[0], ratios[1]));
                all.iter_mut().zip(ratios).for_each(|(all, ratio)| all.push(ratio));
            }
            println!("| {} | {n} | {} | {anew} |", kind.name(), cells.join(" | "));
        }
    }
    for (name, ratios) in ["in the same domain", "in the tightest domain"].iter().zip(&mut all) {
        ratios.sort_by(f64::total_cmp);
        let at = |share: f64| ratios[((ratios.len() - 1) as f64 * share) as usize];
        let outside = ratios.iter().filter(|r| (*r - 1.0).abs() > 0.1).count();
        println!(
            "{name}: least {:.3}, median {:.3}, most {:.3}; {outside} of {} differ by more than a tenth",
            at(0.0),
            at(0.5),
            at(1.0),
            ratios.len()
        );
    }
    Ok(())
}

/// The session, and how often it was meshed anew.
fn run(points: &[DVec2], way: Way, method: Method) -> Result<(AnySession, usize), SessionError> {
    let mesher = Mesher::new().method(method);
    let first = match way {
        Way::From(hundredths) => points.len() * hundredths / 100,
        Way::Halved => points.len(),
    };
    // Room for those to come.
    let [low, high] = [DVec2::min, DVec2::max].map(|f| points.iter().copied().reduce(f).unwrap_or_default());
    let radius = 0.75 * (high - low).length();
    let mut session = if first == 0 {
        AnySession::empty(0.5 * (low + high), radius, method)?
    } else {
        let begun = |radius| {
            let mesher = mesher.clone().domain_radius(radius);
            AnySession::new(&Pslg::from_points(points[..first].to_vec()), &mesher)
        };
        if first < points.len() {
            begun(radius).or_else(|_| begun(2.0 * radius))?
        } else {
            AnySession::new(&Pslg::from_points(points.to_vec()), &mesher)?
        }
    };
    let mut remeshed = 0;
    for &p in &points[first..] {
        let outcome = loop {
            match session.insert(p) {
                Err(SessionError::Outside { .. } | SessionError::AtRim { .. }) => session.grow()?,
                outcome => break outcome?,
            };
        };
        remeshed += usize::from(outcome.remeshed);
    }
    if let Way::Halved = way {
        for i in (0..points.len()).step_by(2) {
            remeshed += usize::from(session.remove(&[PointId(i as u64)])?.remeshed);
        }
    }
    Ok((session, remeshed))
}

/// Triangles over those made at once, in the same domain and in the tightest.
fn compare(mut session: AnySession, method: Method) -> Result<[f64; 2], SessionError> {
    let now = session.counts()[2];
    let points: Vec<DVec2> = session.points().into_iter().map(|p| p.1).collect();
    session.renew()?;
    let tightest = Mesher::new().method(method).triangulate(&points)?.mesh.triangles.len();
    Ok([session.counts()[2], tightest].map(|once| now as f64 / once as f64))
}
