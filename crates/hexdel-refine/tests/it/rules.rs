//! Every rule asks for what its documentation says, hexagon by hexagon.

use hexdel_classify::class::middle_fin;
use hexdel_classify::{Class, View};
use hexdel_grid::{Direction, Hex, Window};
use hexdel_refine::{Rule, RuleSet, Situation, Start, coarse, extended, simple, triangle};

/// Situations with discs of subdivided hexagons or of others, whole or without what two of them share, or with a
/// hole of a disc and some hexagons around it, and some occupied hexagons.
fn situations() -> impl Iterator<Item = Situation> {
    (0..8000_u64).map(|seed| {
        // Multiplied once they would be spread evenly, and hardly ever adjacent.
        let mixed = |i: u64| {
            let spread = (seed * 64 + i + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            (spread ^ spread >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93) >> 40
        };
        let place = |i: u64| Hex::new((mixed(i) % 16) as i64 - 4, (mixed(i) / 16 % 16) as i64 - 4);
        let inside = |h: &Hex| (-4..12).contains(&h.q) && (-4..12).contains(&h.r);
        let disc = |i: u64| place(i).disc(((seed + i) % 4) as u32);
        let around = |i: u64| place(0).disc(2).nth((mixed(i) % 19) as usize);
        let mut discs = Window::EMPTY;
        for hex in (0..3).flat_map(disc).filter(inside) {
            if seed % 8 < 3 && discs.contains(hex) {
                discs.remove(hex);
            } else {
                discs.insert(hex);
            }
        }
        let hole = || place(0).disc(1).chain((1..4).filter_map(around)).filter(inside);
        let subdivided = match seed % 4 {
            0 => !discs,
            1 => !hole().collect::<Window>(),
            _ => discs,
        };
        let [occupied1, occupied2] =
            [10, 30].map(|k| (k..k + 3 + 9 * (seed % 2)).map(place).collect::<Window>().without(subdivided));
        Situation::of(View { subdivided, occupied1, occupied2: occupied2.without(occupied1) })
    })
}

/// One hexagon of a situation.
struct At<'a> {
    of: &'a Situation,
    hex: Hex,
}

impl<'a> At<'a> {
    fn class(&self) -> Class {
        self.of.classes.class_of(self.hex)
    }

    fn is_moved(&self) -> bool {
        self.class() != Class::FixedCenterRegular
    }

    fn has_fins(&self) -> bool {
        use Class as C;
        matches!(self.class(), C::MovedCenter1 | C::MovedCenter2 | C::MovedCenter3 | C::Subdivide)
    }

    fn neighbour(&self, d: Direction) -> Self {
        At { of: self.of, hex: self.hex.neighbour(d) }
    }

    /// Whether any hexagon up to so many steps away is so, itself included.
    fn any_within(&self, steps: u32, is: impl Fn(&At<'a>) -> bool) -> bool {
        self.hex.disc(steps).any(|hex| is(&At { of: self.of, hex }))
    }

    fn other_within(&self, steps: u32, is: impl Fn(&At<'a>) -> bool) -> bool {
        self.any_within(steps, |other| other.hex != self.hex && is(other))
    }

    fn occupied1(&self) -> bool {
        self.of.view.occupied1.contains(self.hex)
    }

    fn occupied2(&self) -> bool {
        self.of.view.occupied2.contains(self.hex)
    }

    fn occupied(&self) -> bool {
        self.occupied1() || self.occupied2()
    }

    fn subdivided(&self) -> bool {
        self.of.view.subdivided.contains(self.hex)
    }
}

/// Compares over the tiles of all situations, in some of which the rule asks and in some of which it does not.
fn check(
    rule: &dyn Rule,
    asks: impl Fn(&dyn Rule, &Situation) -> Window,
    documented: impl Fn(&At<'_>) -> bool,
) {
    let mut answers = [0, 0];
    for of in situations() {
        let asked = asks(rule, &of);
        for hex in Window::with_margin(0).iter() {
            let expected = documented(&At { of: &of, hex });
            assert_eq!(asked.contains(hex), expected, "{}: {hex:?} in {:?}", rule.name(), of.view);
            answers[usize::from(expected)] += 1;
        }
    }
    assert!(answers.into_iter().all(|n| n > 20), "{}: {answers:?}", rule.name());
}

fn subdivides(rule: &dyn Rule, documented: impl Fn(&At<'_>) -> bool) {
    check(rule, |rule, of| rule.must_subdivide(of), documented);
}

fn wants(rule: &dyn Rule, documented: impl Fn(&At<'_>) -> bool) {
    check(rule, |rule, of| rule.must_exist(of), documented);
}

#[test]
fn rules_about_points() {
    subdivides(&simple::AdjacentOccupied, |at| at.occupied() && at.other_within(1, At::occupied));
    subdivides(&simple::OccupiedBesideFiner, |at| at.occupied() && at.other_within(1, At::subdivided));
    subdivides(&extended::MovedInRing, |at| {
        at.occupied1() && at.any_within(1, At::is_moved) || at.occupied2() && at.any_within(2, At::is_moved)
    });
    subdivides(&extended::OccupiedRings, |at| {
        let one = at.occupied1() && (at.other_within(1, At::occupied1) || at.other_within(2, At::occupied2));
        one || at.occupied2() && (at.other_within(2, At::occupied1) || at.other_within(3, At::occupied2))
    });
    subdivides(&coarse::OccupiedStar, |at| at.occupied() && at.class() == Class::MovedCenter3);
}

#[test]
fn rules_about_classes() {
    subdivides(&extended::SubdivideClass, |at| at.class() == Class::Subdivide);
    subdivides(&extended::TopWithFins, |at| {
        let middle = middle_fin(at.of.view.subdivided, at.hex);
        middle.is_some_and(|d| at.neighbour(d.turned(3)).has_fins())
    });
    // Of a run of five there is no template either.
    subdivides(&extended::TopOfTwoRuns, |at| {
        let under = at.of.classes.under_of(at.hex);
        let starts = under & !(under << 1 | under >> 5);
        at.class() == Class::MovedCenter4 && (starts.count_ones() > 1 || under.count_ones() == 5)
    });
}

/// Around the top of a run of two, beyond the hexagon with two fins on either side.
#[test]
fn two_fins_beside_run() {
    let beyond = |top: &At<'_>, hex: Hex| {
        let under = |d: Direction| top.of.classes.under_of(top.hex) >> d.index() & 1 == 1;
        let has_two = |d: Direction| top.neighbour(d).class() == Class::MovedCenter2;
        Direction::ALL.into_iter().filter(|&d| under(d) && under(d.turned(1))).any(|d| {
            let (before, after) = (d.turned(5), d.turned(2));
            let next = |from: Direction, on: Direction| top.neighbour(from).neighbour(on).hex;
            has_two(before) && next(before, d.turned(4)) == hex
                || has_two(after) && next(after, d.turned(3)) == hex
        })
    };
    subdivides(&extended::TwoFinsBesideRun, |at| at.any_within(2, |top| beyond(top, at.hex)));
}

#[test]
fn triangle_rule() {
    let corner = |at: &At<'_>, d: Direction| {
        let [a, b, c] = [at.hex, at.hex.neighbour(d), at.hex.neighbour(d.turned(1))];
        [[a, b, c], [b, c, a], [c, a, b]]
            .into_iter()
            .any(|corners| triangle::victim_of(&at.of.classes, corners) == Some(at.hex))
    };
    subdivides(&triangle::TriangleRule, |at| Direction::ALL.into_iter().any(|d| corner(at, d)));
}

#[test]
fn rules_about_what_must_exist() {
    wants(&simple::Balance, |at| at.any_within(1, At::subdivided));
    wants(&simple::OccupiedAmongFull, |at| at.any_within(1, At::occupied));
    wants(&coarse::OccupiedFull, |at| at.occupied1() || at.occupied2());
    wants(&coarse::StarAmongFull, |at| at.any_within(1, |near| near.class() == Class::MovedCenter3));
    wants(&coarse::MovedAmongFull, |at| at.any_within(1, At::is_moved));
    wants(&extended::FixedBesideFins, |at| {
        at.any_within(1, |near| near.is_moved() || near.any_within(1, At::occupied2))
    });
}

fn names(rules: &RuleSet) -> Vec<&'static str> {
    rules.iter().map(Rule::name).collect()
}

#[test]
fn sets_have_the_rules_of_their_sections_by_name() {
    let simple = ["balance", "adjacent occupied", "occupied among full", "occupied beside finer"];
    assert_eq!(names(&RuleSet::simple()), simple);
    let extended = [
        "class subdivide",
        "moved in ring",
        "rings of two occupied",
        "fixed beside fins",
        "top of two runs",
        "top with fins",
        "two fins beside run",
        "triangle",
    ];
    let all = [&simple[..], &extended].concat();
    assert_eq!(names(&RuleSet::extended()), all);
    assert_eq!(format!("{:?}", RuleSet::extended()), format!("{all:?}"));
    // Coarsest first, each with more than the one before.
    let [separate, apart, among] = [Start::Separate, Start::Apart, Start::Among].map(RuleSet::coarse);
    assert!(names(&separate).contains(&"occupied full") && !names(&separate).contains(&"adjacent occupied"));
    assert_eq!(names(&apart), [names(&separate), vec!["adjacent occupied"]].concat());
    let more = vec!["occupied among full", "occupied beside finer"];
    assert_eq!(names(&among), [names(&apart), more].concat());
}

/// A set asks for what any of its rules asks for, and without one for what the others do.
#[test]
fn sets_are_what_their_rules_are_together() {
    let rules = RuleSet::extended();
    let (mut asked, mut less) = (0, 0);
    for of in situations().take(2000) {
        let open = |asked: Window| asked.without(of.view.subdivided).centre();
        let any = rules.iter().fold(0, |all, rule| all | open(rule.must_subdivide(&of)));
        assert_eq!((rules.must_subdivide(&of), rules.hold(&of)), (any, any == 0));
        let exist = rules.iter().fold(Window::EMPTY, |all, rule| all | rule.must_exist(&of));
        assert_eq!(rules.must_exist(&of), exist);
        asked += any.count_ones();
        for rule in rules.iter() {
            let without = rules.clone().without(rule.name());
            assert!(!names(&without).contains(&rule.name()));
            let points = of.view.occupied().centre();
            let others = rules.iter().filter(|other| other.name() != rule.name());
            let of_points = others.fold(0, |all, other| all | open(other.must_subdivide(&of))) & points;
            // Rules about points cover those about classes only together.
            if ["moved in ring", "rings of two occupied", "triangle"].contains(&rule.name()) {
                let found = without.must_subdivide_occupied(&of);
                assert_eq!(found & !of_points, 0, "{}", rule.name());
                less += (any & points & !found).count_ones();
            }
        }
    }
    assert!(asked > 1000 && less > 0, "{asked} {less}");
}
