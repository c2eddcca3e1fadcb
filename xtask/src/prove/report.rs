//! What `prove` prints, and the document it writes.

use super::Proof;
use super::figures;
use super::lemmas::Checked;
use super::search::Witness;
use hexdel_classify::Classes;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::RangeInclusive;

/// The document's text, with places for tables.
const TEMPLATE: &str = include_str!("proof.template.md");

/// A few lines per kind of triangle.
pub(crate) fn summary(proof: &Proof) -> String {
    let mut out = String::new();
    for (name, k) in &proof.found.kinds {
        let (low, high) = k.range_deg.unwrap_or_default();
        let _ = writeln!(
            out,
            "{:>7} patterns {:>7} up to symmetry {:>8} triangles  {low:>9.4} .. {high:>9.4}  {name}",
            k.patterns, k.orbits, k.triangles
        );
    }
    for r in &proof.regions {
        let (low, high) = (r.least.angle_deg, r.greatest.angle_deg);
        let _ = writeln!(out, "{:>7} cases, {low:.4} .. {high:.4}  {}", r.cases, r.name);
    }
    for c in proof.closures.iter().flatten() {
        let _ = writeln!(out, "rows beyond the hull, {}: {:?}", c.name, c.by_rows);
    }
    for t in &proof.levels {
        let _ = writeln!(out, "finest level {:>2}, bound {:>2}  {}", t.finest, t.bound, t.name);
    }
    let lines = [
        proof.lemmas.clone().map(|c| {
            format!(
                "levels: {} cases, fronts: {}, pairs of points: {}, implied rules: {}",
                c.levels, c.fronts, c.pairs, c.implied
            )
        }),
        proof
            .support
            .clone()
            .map(|c| format!("what demands rest on: {} patterns, classes: {}", c.demands, c.classes)),
        proof.ending.clone().map(|views| format!("views of a lattice hexagon: {views}")),
        proof.closures.clone().map(|kinds| format!("kinds of sets that are closed: {}", kinds.len())),
    ];
    for line in lines {
        let _ = writeln!(out, "{}", line.unwrap_or_else(|fault| format!("NOT so: {fault}")));
    }
    let _ = writeln!(
        out,
        "units that fit: {} patterns, {} do not; shortest edge {:.6} spacings of the finest level",
        proof.found.fitted,
        proof.found.gaps.len(),
        shortest(proof)
    );
    for gap in proof.found.gaps.iter().take(5) {
        let _ = writeln!(out, "GAP {gap}");
    }
    let f = &proof.found;
    let _ = writeln!(
        out,
        "{} patterns in {} steps; {} break the bounds in no legal state; angles that break them: {} in legal states, {} left open; {} unprotected corners",
        f.kinds.values().map(|k| k.patterns).sum::<u64>(),
        f.steps,
        f.refused,
        f.counterexamples.len(),
        f.undecided.len(),
        f.unprotected.len(),
    );
    for (name, (count, worst)) in counterexamples(proof) {
        let at: Vec<_> = worst.subdivided.iter().map(|h| (h.q, h.r)).collect();
        let _ = writeln!(
            out,
            "COUNTEREXAMPLES {count:>6}, worst {:.4} degrees: {name}, subdivided {at:?}",
            worst.angle_deg
        );
    }
    out
}

/// The shortest edge of the patterns without points, in spacings of the finest level.
fn shortest(proof: &Proof) -> f64 {
    let unit = hexdel_classify::Offset::UNIT as f64;
    proof.found.shortest.map_or(f64::NAN, |square| (square as f64 / 2.0).sqrt() / unit)
}

/// Counterexamples by kind: how many, and the worst.
fn counterexamples(proof: &Proof) -> BTreeMap<String, (u64, Witness)> {
    let off = |w: &Witness| (w.angle_deg - 60.0).abs();
    let mut kinds = BTreeMap::new();
    for w in &proof.found.counterexamples {
        let side = if w.angle_deg < 60.0 { "small" } else { "large" };
        let name = format!("{side} angle, {}", w.unit.kind(&Classes::of(w.subdivided)));
        let (count, worst) = kinds.entry(name).or_insert((0, *w));
        *count += 1;
        if off(w) > off(worst) {
            *worst = *w;
        }
    }
    kinds
}

/// Where the figures lie, below the documents.
pub(crate) const FOLDER: &str = "figures/proof";

/// The document and its figures, by their paths below the documents; `weaker` is what is found
/// without the rules that the paper lacks.
pub(crate) fn files(proof: &Proof, weaker: &Proof) -> BTreeMap<String, Vec<u8>> {
    let mut figures = Figures::default();
    let checked = proof.lemmas.clone().unwrap_or_default();
    let support = proof.support.clone().unwrap_or_default();
    let text = TEMPLATE
        .replace("{{totals}}", &totals(proof))
        .replace("{{kinds}}", &kinds(proof))
        .replace("{{witnesses}}", &witnesses(proof, &mut figures))
        .replace("{{facts}}", &facts(&checked))
        .replace("{{regions}}", &regions(proof, &mut figures))
        .replace(
            "{{support}}",
            &format!(
                "{} patterns of causes, and {} of a hexagon's class and place.",
                support.demands, support.classes
            ),
        )
        .replace(
            "{{tiling}}",
            &format!("{} patterns, {} faults.", proof.found.fitted, proof.found.gaps.len()),
        )
        .replace("{{shortest}}", &format!("{:.4}", shortest(proof)))
        .replace("{{ending}}", &format!("{} views", proof.ending.clone().unwrap_or_default()))
        .replace("{{closures}}", &closures(proof))
        .replace("{{levels}}", &levels(proof))
        .replace("{{counterexamples}}", &weaker_table(weaker, &mut figures));
    let mut files = figures.files;
    files.insert("proof.md".to_owned(), text.into_bytes());
    files
}

#[derive(Default)]
struct Figures {
    files: BTreeMap<String, Vec<u8>>,
}

impl Figures {
    /// Keeps a figure and returns the Markdown that shows it.
    fn add(&mut self, svg: String, caption: &str) -> String {
        let name = format!("{FOLDER}/{:02}.svg", self.files.len() + 1);
        self.files.insert(name.clone(), svg.into_bytes());
        format!("![{caption}]({name})")
    }
}

fn totals(proof: &Proof) -> String {
    let sum = |of: fn(&super::search::Kind) -> u64| proof.found.kinds.values().map(of).sum::<u64>();
    format!(
        "{} patterns of complete patches ({} up to the symmetries of their unit), {} triangles, {} decisions; \
         {} patterns break the bounds.",
        sum(|k| k.patterns),
        sum(|k| k.orbits),
        sum(|k| k.triangles),
        proof.found.steps,
        proof.found.refused + proof.found.counterexamples.len() as u64 + proof.found.undecided.len() as u64,
    )
}

fn kinds(proof: &Proof) -> String {
    let mut out = String::from(
        "| kind | patterns | up to symmetry | triangles | angles over all patterns | attained in a legal state |\n|---|---|---|---|---|---|\n",
    );
    for (name, k) in &proof.found.kinds {
        let (low, high) = k.range_deg.unwrap_or_default();
        let attained = match (k.least, k.greatest) {
            (Some(l), Some(g)) => format!("{:.4} .. {:.4}", l.angle_deg, g.angle_deg),
            _ => "none found".to_owned(),
        };
        let _ = writeln!(
            out,
            "| {name} | {} | {} | {} | {low:.4} .. {high:.4} | {attained} |",
            k.patterns, k.orbits, k.triangles
        );
    }
    out
}

fn witnesses(proof: &Proof, figures: &mut Figures) -> String {
    let mut out = String::from("| kind | smallest angle | largest angle |\n|---|---|---|\n");
    for (name, k) in &proof.found.kinds {
        let (Some(least), Some(greatest)) = (k.least, k.greatest) else { continue };
        let mut show = |w: &Witness| {
            let caption = format!("{:.4} degrees", w.angle_deg);
            format!("{}<br>{caption}", figures.add(figures::witness(w), &caption))
        };
        let _ = writeln!(out, "| {name} | {} | {} |", show(&least), show(&greatest));
    }
    out
}

fn facts(c: &Checked) -> String {
    format!(
        "Checked: {} patterns and places for fact 1, {} for fact 2, {} legal pairs of occupied hexagons for fact 3.",
        c.levels, c.fronts, c.pairs
    )
}

fn regions(proof: &Proof, figures: &mut Figures) -> String {
    let mut out = String::from(
        "| triangles | cases | angles | shortest edge | smallest angle |\n|---|---|---|---|---|\n",
    );
    for r in &proof.regions {
        let figure = figures.add(figures::occupied(&r.least), r.name);
        let (low, high) = (r.least.angle_deg, r.greatest.angle_deg);
        let _ = writeln!(
            out,
            "| {} | {} | {low:.4} .. {high:.4} | {:.4} | {figure} |",
            r.name, r.cases, r.shortest
        );
    }
    out
}

fn closures(proof: &Proof) -> String {
    let mut out = String::from(
        "| what is subdivided to begin with | sets | closed within their hull | one row beyond | two | more |\n\
         |---|---|---|---|---|---|\n",
    );
    for closures in proof.closures.iter().flatten() {
        let sum = |of: RangeInclusive<i64>| closures.by_rows.range(of).map(|(_, n)| n).sum::<u64>();
        let name = closures.name;
        let [all, none, one, two, more] = [0..=i64::MAX, 0..=0, 1..=1, 2..=2, 3..=i64::MAX].map(sum);
        let _ = writeln!(out, "| {name} | {all} | {none} | {one} | {two} | {more} |");
    }
    out
}

fn levels(proof: &Proof) -> String {
    let mut out =
        String::from("| input | points | `d_min / s_0` | finest level | bound |\n|---|---|---|---|---|\n");
    for t in &proof.levels {
        let _ = writeln!(out, "| {} | {} | {:.3e} | {} | {} |", t.name, t.points, t.d_min, t.finest, t.bound);
    }
    out
}

fn weaker_table(weaker: &Proof, figures: &mut Figures) -> String {
    let mut out = String::from("| kind | patterns | worst angle | |\n|---|---|---|---|\n");
    for (name, (count, worst)) in counterexamples(weaker) {
        let figure = figures.add(figures::witness(&worst), &name);
        let _ = writeln!(out, "| {name} | {count} | {:.4} | {figure} |", worst.angle_deg);
    }
    out
}
