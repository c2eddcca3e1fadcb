//! `cargo xtask prove`: every triangle of the relocated dual keeps
//! `atan(5 / (3 sqrt 3))` = 43.89 to 90 degrees (paper, section 6.1, which leaves
//! the proof to the reader).
//!
//! All legal local configurations on which a triangle can depend are enumerated
//! with the product's own classification, templates, stars and rules, and every
//! angle is compared with the bounds in integers. `docs/proof.md`, which this
//! task writes, says why that is enough.
//!
//! | module | what |
//! |---|---|
//! | [`pattern`] | units of the dual, their patches, the order of decisions |
//! | [`support`] | what a rule's demand rests on |
//! | [`fires`] | when a rule certainly asks for something |
//! | [`search`] | the enumeration |
//! | [`tiling`] | why units neither overlap nor leave gaps |
//! | [`closure`] | whether a pattern occurs in a legal state |
//! | [`lemmas`] | why one level and one input point can be looked at alone |
//! | [`regions`] | occupied hexagons, the point anywhere |
//! | [`levels`] | a bound on the number of levels |
//! | [`ending`] | why closing a level ends |
//! | [`report`], [`figures`] | the document |

mod closure;
mod ending;
mod figures;
mod fires;
mod lemmas;
mod levels;
mod pattern;
mod regions;
mod report;
mod search;
mod support;
mod tiling;

use crate::Outcome;
use fires::Fires;
use hexdel_refine::RuleSet;
use pattern::Unit;
pub(crate) use report::FOLDER;
use search::Found;
use std::collections::BTreeMap;

/// Files by their names.
type Files = BTreeMap<String, Vec<u8>>;

/// All that was enumerated and checked.
pub(crate) struct Proof {
    found: Found,
    lemmas: Result<lemmas::Checked, lemmas::Fault>,
    support: Result<support::Checked, lemmas::Fault>,
    ending: Result<u64, lemmas::Fault>,
    closures: Result<Vec<ending::Closures>, lemmas::Fault>,
    regions: Vec<regions::Region>,
    levels: Vec<levels::Trial>,
}

impl Proof {
    /// Enumerates; `reduced`, one unit of each kind and a sample of the
    /// patterns for the facts that separate levels and points.
    pub(crate) fn make(rules: &RuleSet, reduced: bool) -> Result<Self, Box<dyn std::error::Error>> {
        let stride = if reduced { 7 } else { 1 };
        let lemmas = lemmas::check(rules, stride);
        let (support, ending) = (support::check(rules, stride), ending::check(rules));
        let fires = Fires::new(rules.clone());
        let units = if reduced { Unit::representatives() } else { Unit::all() };
        let mut found = Found::default();
        for unit in units {
            let mut part = search::search(unit, &fires);
            if !Unit::representatives().contains(&unit) {
                part.kinds.values_mut().for_each(|kind| kind.orbits = 0);
            }
            found.merge(part);
        }
        let levels = if reduced { Vec::new() } else { levels::trials()? };
        let closures = if reduced { Ok(Vec::new()) } else { ending::closures(rules) };
        Ok(Self { found, lemmas, support, ending, closures, regions: regions::all(), levels })
    }

    /// Whether nothing broke the bounds.
    pub(crate) fn holds(&self) -> bool {
        self.found.proved()
            && self.lemmas.is_ok()
            && self.support.is_ok()
            && self.ending.is_ok()
            && self.closures.is_ok()
            && self.found.shortest.is_some_and(is_long_enough)
            && self.regions.iter().all(|r| r.holds)
            && self.levels.iter().all(|t| t.finest <= t.bound)
    }
}

/// Whether the square of an edge's length, as [`Found::shortest`] has it, is at least that of
/// [`regions::SHORTEST`].
fn is_long_enough(square: i64) -> bool {
    let [p, q] = regions::SHORTEST;
    let unit = hexdel_classify::Offset::UNIT;
    q * q * square >= 2 * p * p * unit * unit
}

/// Proves, prints what was found, and writes `docs/proof.md` with its figures
/// if nothing was left away.
pub(crate) fn run(without: &[String], reduced: bool) -> Outcome {
    let all = RuleSet::extended();
    if let Some(name) = without.iter().find(|n| all.iter().all(|r| r.name() != n.as_str())) {
        let names: Vec<_> = all.iter().map(hexdel_refine::Rule::name).collect();
        return Err(format!("there is no rule \"{name}\"; the rules are {names:?}").into());
    }
    let rules = without.iter().fold(all, |rules, name| rules.without(name));
    let proof = Proof::make(&rules, reduced)?;
    print!("{}", report::summary(&proof));
    if !proof.holds() {
        return Err("the bounds do not hold".into());
    }
    if without.is_empty() && !reduced {
        let docs = crate::tidy::root().join("docs");
        std::fs::create_dir_all(docs.join(FOLDER))?;
        for (name, bytes) in document(&proof)? {
            std::fs::write(docs.join(name), bytes)?;
        }
    }
    Ok(())
}

/// The figures of the paper that come from patterns, by name: what "two fins beside run" is
/// for (Fig. 6), and the regions of points (Fig. 8).
pub(crate) fn paper_figures() -> Result<Files, Box<dyn std::error::Error>> {
    let rules = RuleSet::extended();
    let fires = Fires::new(rules.clone().without("two fins beside run"));
    let found = search::search(Unit::representatives()[1], &fires);
    let off = |w: &search::Witness| (w.angle_deg - 60.0).abs();
    let few = found.counterexamples.iter().map(|w| w.subdivided.count()).min().unwrap_or_default();
    let fewest = found.counterexamples.iter().filter(|w| w.subdivided.count() == few);
    let worst = fewest.max_by(|a, b| off(a).total_cmp(&off(b))).ok_or("the rule is for nothing")?;
    let closed = closure::closed(worst.subdivided, &rules, |_| true).ok_or("the pattern does not close")?;
    let near = hexdel_grid::Window::with_margin(3);
    let after = near.iter().filter(|&at| closed.is_subdivided(hexdel_grid::Address::new(0, at))).collect();
    let figures = [
        ("fig-06-two-fins-beside-run.svg", figures::pattern(worst.subdivided, pattern::CENTRE, Some(worst))),
        ("fig-06-subdivided.svg", figures::pattern(after, pattern::CENTRE, None)),
        ("fig-08-regions.svg", regions::figure()),
    ];
    Ok(figures.map(|(name, svg)| (name.to_owned(), svg.into_bytes())).into())
}

/// `docs/proof.md` and its figures, by their paths below `docs`.
pub(crate) fn files() -> Result<Files, Box<dyn std::error::Error>> {
    let proof = Proof::make(&RuleSet::extended(), false)?;
    if !proof.holds() {
        return Err(format!("the bounds do not hold\n{}", report::summary(&proof)).into());
    }
    document(&proof)
}

fn document(proof: &Proof) -> Result<Files, Box<dyn std::error::Error>> {
    // What the paper's rules leave open is part of the document.
    let weaker = Proof::make(&RuleSet::extended().without("triangle").without("top with fins"), true)?;
    Ok(report::files(proof, &weaker))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All of the enumeration, which must be what the document and its figures say.
    #[test]
    fn the_rules_keep_the_bounds() {
        let proof = Proof::make(&RuleSet::extended(), false).unwrap();
        assert!(proof.holds(), "{}", report::summary(&proof));
        let least = proof.found.kinds.values().filter_map(|k| k.least).map(|w| w.angle_deg);
        assert!((least.fold(180.0, f64::min) - 43.897_886_248_013_98).abs() < 1e-9);
        let docs = crate::tidy::root().join("docs");
        for (name, bytes) in document(&proof).unwrap() {
            let found = std::fs::read(docs.join(&name)).unwrap();
            assert!(found == bytes, "docs/{name} differs; run `cargo xtask prove`");
        }
    }

    /// The enumeration's triangles are those that the product writes: every
    /// witness is found in the mesh of a grid that holds its pattern.
    #[test]
    fn witnesses_are_triangles_of_extracted_meshes() {
        let rules = RuleSet::extended();
        let fires = Fires::new(rules.clone());
        let mut count = 0;
        for unit in Unit::representatives() {
            let found = search::search(unit, &fires);
            let witnesses = found.kinds.values().flat_map(|k| [k.least, k.greatest]);
            for w in witnesses.flatten() {
                let mut grid = closure::closed(w.subdivided, &rules, |_| true).unwrap();
                let mut domain = hexdel_classify::Domain::around(&grid, 0).unwrap();
                // Where nothing is subdivided, the unit as well.
                domain.radius = domain.radius.max(10);
                let dual = hexdel_classify::extract(
                    &mut grid,
                    &[],
                    domain,
                    hexdel_classify::Relocation::Full,
                    &hexdel_geom::Unwatched,
                )
                .unwrap();
                let corners = w.corners.map(hexdel_classify::Offset::cartesian);
                let at = |t: &[hexdel_geom::VertexId; 3]| t.map(|v| dual.mesh.vertices[v.index()]);
                let same = |t: &[hexdel_geom::DVec2; 3], i: usize| {
                    (0..3).all(|k| t[(i + k) % 3].distance(corners[k]) < 1e-12)
                };
                let found = dual.mesh.triangles.iter().map(at).any(|t| (0..3).any(|i| same(&t, i)));
                assert!(found, "{w:?}");
                count += 1;
            }
        }
        assert!(count > 40, "{count}");
    }

    #[test]
    fn without_the_triangle_rule_the_known_counterexamples_appear() {
        let fires = Fires::new(RuleSet::extended().without("triangle"));
        let found = search::search(Unit::Triangle { up: true }, &fires);
        assert!(!found.proved());
        let angles = || found.counterexamples.iter().map(|w| w.angle_deg);
        let (least, greatest) = (angles().fold(180.0, f64::min), angles().fold(0.0, f64::max));
        // The worst that the other rules let pass; two fronts across a strip of
        // two coarse hexagons give 39.5, and more where they turn.
        assert!((least - 33.2556).abs() < 1e-4, "{least}");
        assert!((greatest - 93.3585).abs() < 1e-4, "{greatest}");
    }

    #[test]
    fn four_fins_in_a_row_have_no_template() {
        let rules = RuleSet::extended().without("class subdivide");
        let fins = [0, 1, 2, 3].map(|d| pattern::CENTRE.neighbour(hexdel_grid::Direction::new(d)));
        let fins: hexdel_grid::Window = fins.into_iter().collect();
        // The other rules leave them as they are.
        let plan = pattern::Plan::new(Unit::Triangle { up: true });
        assert_eq!(closure::around(&plan, fins, &rules), Some(fins));
        let mut angles = Vec::new();
        Unit::Triangle { up: true }.triangles(&hexdel_classify::Classes::of(fins), |t| {
            let p = t.corners.map(hexdel_classify::Offset::cartesian);
            angles.push((p[1] - p[0]).angle_to(p[2] - p[0]).to_degrees());
        });
        assert!(angles.iter().any(|angle| (angle - 30.0).abs() < 1e-9), "{angles:?}");
        assert!(closure::around(&plan, fins, &RuleSet::extended()).is_none());
    }

    #[test]
    fn a_top_with_fins_is_the_worst_that_the_papers_rules_leave() {
        let fires = Fires::new(RuleSet::extended().without("triangle").without("top with fins"));
        let found = search::search(Unit::representatives()[1], &fires);
        let least = found.counterexamples.iter().map(|w| w.angle_deg).fold(180.0, f64::min);
        assert!((least - 28.4465).abs() < 1e-4, "{least}");
    }
}
