//! What `prove` prints, and the document it writes.

use super::Proof;
use super::figures;
use super::lemmas::Checked;
use super::search::Witness;
use hexdel_classify::Classes;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

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
    for t in &proof.levels {
        let _ = writeln!(out, "finest level {:>2}, bound {:>2}  {}", t.finest, t.bound, t.name);
    }
    match &proof.lemmas {
        Ok(c) => {
            let _ = writeln!(
                out,
                "levels: {} cases, fronts: {}, pairs of points: {}",
                c.levels, c.fronts, c.pairs
            );
        }
        Err(fault) => {
            let _ = writeln!(out, "NOT separate: {fault}");
        }
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

/// Writes the document and its figures; `weaker` is what is found without the
/// rules that the paper lacks.
pub(crate) fn write(docs: &Path, proof: &Proof, weaker: &Proof) -> std::io::Result<()> {
    let folder = docs.join("figures");
    std::fs::create_dir_all(&folder)?;
    let mut figures = Figures { folder: &folder, count: 0 };
    let checked = proof.lemmas.clone().unwrap_or_default();
    let text = TEMPLATE
        .replace("{{totals}}", &totals(proof))
        .replace("{{kinds}}", &kinds(proof))
        .replace("{{witnesses}}", &witnesses(proof, &mut figures)?)
        .replace("{{facts}}", &facts(&checked))
        .replace("{{regions}}", &regions(proof, &mut figures)?)
        .replace("{{levels}}", &levels(proof))
        .replace("{{counterexamples}}", &weaker_table(weaker, &mut figures)?);
    std::fs::write(docs.join("proof.md"), text)
}

struct Figures<'a> {
    folder: &'a Path,
    count: usize,
}

impl Figures<'_> {
    /// Writes a figure and returns the Markdown that shows it.
    fn add(&mut self, svg: &str, caption: &str) -> std::io::Result<String> {
        self.count += 1;
        let name = format!("proof-{:02}.svg", self.count);
        std::fs::write(self.folder.join(&name), svg)?;
        Ok(format!("![{caption}](figures/{name})"))
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

fn witnesses(proof: &Proof, figures: &mut Figures) -> std::io::Result<String> {
    let mut out = String::from("| kind | smallest angle | largest angle |\n|---|---|---|\n");
    for (name, k) in &proof.found.kinds {
        let (Some(least), Some(greatest)) = (k.least, k.greatest) else { continue };
        let mut show = |w: &Witness| {
            let caption = format!("{:.4} degrees", w.angle_deg);
            figures.add(&figures::witness(w), &caption).map(|figure| format!("{figure}<br>{caption}"))
        };
        let _ = writeln!(out, "| {name} | {} | {} |", show(&least)?, show(&greatest)?);
    }
    Ok(out)
}

fn facts(c: &Checked) -> String {
    format!(
        "Checked: {} patterns and places for fact 1, {} for fact 2, {} legal pairs of occupied hexagons for fact 3.",
        c.levels, c.fronts, c.pairs
    )
}

fn regions(proof: &Proof, figures: &mut Figures) -> std::io::Result<String> {
    let mut out = String::from("| triangles | cases | angles | smallest |\n|---|---|---|---|\n");
    for r in &proof.regions {
        let figure = figures.add(&figures::occupied(&r.least), r.name)?;
        let (low, high) = (r.least.angle_deg, r.greatest.angle_deg);
        let _ = writeln!(out, "| {} | {} | {low:.4} .. {high:.4} | {figure} |", r.name, r.cases);
    }
    Ok(out)
}

fn levels(proof: &Proof) -> String {
    let mut out =
        String::from("| input | points | `d_min / s_0` | finest level | bound |\n|---|---|---|---|---|\n");
    for t in &proof.levels {
        let _ = writeln!(out, "| {} | {} | {:.3e} | {} | {} |", t.name, t.points, t.d_min, t.finest, t.bound);
    }
    out
}

fn weaker_table(weaker: &Proof, figures: &mut Figures) -> std::io::Result<String> {
    let mut out = String::from("| kind | patterns | worst angle | |\n|---|---|---|---|\n");
    for (name, (count, worst)) in counterexamples(weaker) {
        let figure = figures.add(&figures::witness(&worst), &name)?;
        let _ = writeln!(out, "| {name} | {count} | {:.4} | {figure} |", worst.angle_deg);
    }
    Ok(out)
}
