//! How many triangles a session comes to, over those of the same points meshed at once: all
//! kinds of point sets, built one by one from nothing, from a tenth and from half, and
//! with every other point taken out again.
//!
//! `cargo run --release -p hexdel --example session_parity -- templates|compact POINTS|KIND ..`

use hexdel::generate::{Kind, generate};
use hexdel::{AnySession, DVec2, Error, Mesher, Method, PointId, Pslg, SessionError};

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
    let (numbers, names): (Vec<String>, Vec<String>) = args.partition(|a| a.parse::<usize>().is_ok());
    for n in numbers {
        for kind in Kind::ALL.into_iter().filter(|k| names.is_empty() || names.iter().any(|n| n == k.name()))
        {
            let points = generate(kind, n.parse()?, 1);
            let (mut cells, mut anew) = (Vec::new(), 0);
            for (_, way) in WAYS {
                let (session, remeshed) = run(&points, way, method)?;
                let ratios = compare(session, method)?;
                anew += remeshed;
                cells.push(ratios.map(|r| r.map_or("-".to_owned(), |r| format!("{r:.3}"))).join(", "));
                all.iter_mut().zip(ratios).for_each(|(all, ratio)| all.extend(ratio));
            }
            println!("| {} | {n} | {} | {anew} |", kind.name(), cells.join(" | "));
        }
    }
    for (name, ratios) in ["in the same domain", "in the tightest domain"].iter().zip(&mut all) {
        ratios.sort_by(f64::total_cmp);
        let at = |share: f64| ratios[((ratios.len() - 1) as f64 * share) as usize];
        let [fewer, more] = [-1.0, 1.0].map(|s| ratios.iter().filter(|r| s * (*r - 1.0) > 0.1).count());
        println!(
            "{name}: least {:.3}, median {:.3}, most {:.3}; of {} {more} are more by a tenth, {fewer} fewer",
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
        // Few points may lie where a small domain has no room for hexagons.
        let mut begun = [1.0, 2.0, 4.0, 8.0].into_iter().map(|times| {
            let mesher = mesher.clone().domain_radius(times * radius);
            AnySession::new(&Pslg::from_points(points[..first].to_vec()), &mesher)
        });
        let all = || AnySession::new(&Pslg::from_points(points.to_vec()), &mesher);
        if first == points.len() { all()? } else { begun.find_map(Result::ok).map_or_else(all, Ok)? }
    };
    let mut remeshed = 0;
    for &p in &points[first..] {
        let outcome = loop {
            match session.insert(p) {
                Err(
                    SessionError::Outside { .. }
                    | SessionError::AtRim { .. }
                    | SessionError::Mesh(Error::DomainTooSmall { .. }),
                ) => session.grow()?,
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

/// Triangles over those made at once, in the same domain, if they fit, and in the tightest.
fn compare(mut session: AnySession, method: Method) -> Result<[Option<f64>; 2], SessionError> {
    let now = session.counts()[2];
    let points: Vec<DVec2> = session.points().into_iter().map(|p| p.1).collect();
    let tightest = Mesher::new().method(method).triangulate(&points)?.mesh.triangles.len();
    // Points close to the rim may leave no room for the hexagons of a mesh made at once.
    let here = session.renew().is_ok().then(|| session.counts()[2]);
    Ok([here, Some(tightest)].map(|once| once.map(|once| now as f64 / once as f64)))
}
