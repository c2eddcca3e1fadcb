//! Triangle's switches: letters in a row, some with a number after them.

use crate::exit::Failure;

/// What was asked for.
#[derive(Clone, Debug, Default, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch")]
pub(super) struct Switches {
    /// `-p`: the input is a PSLG, not only points.
    pub(super) graph: bool,
    /// `-q`, with the smallest angle if one is given.
    pub(super) min_angle: Option<f64>,
    /// `-a` with a number: the largest area.
    pub(super) max_area: Option<f64>,
    /// `-a` alone: the areas of regions count.
    pub(super) region_areas: bool,
    /// `-A`: triangles carry the attributes of regions.
    pub(super) regions: bool,
    /// `-c`: the convex hull.
    pub(super) hull: bool,
    /// `-e`
    pub(super) edges: bool,
    /// `-n`
    pub(super) neighbours: bool,
    /// `-v`
    pub(super) voronoi: bool,
    /// `-g`
    pub(super) off: bool,
    /// `-o2`
    pub(super) second_order: bool,
    /// `-B`: no markers.
    pub(super) without_markers: bool,
    /// `-P`: no `.poly`.
    pub(super) without_poly: bool,
    /// `-Q`
    pub(super) quiet: bool,
    /// `-z`: numbers start at 0, whatever those of the input do.
    pub(super) from_zero: bool,
    /// `-j`: points that are no vertices are not written.
    pub(super) without_unused: bool,
}

/// Switches that ask for what is so anyway, or choose between ways to the same:
/// Delaunay (`D`), all checks (`C`), algorithms (`i F l s X`), and more to read (`V`).
const WITHOUT_EFFECT: &str = "DCiFlsXV";

/// What cannot be.
const REFUSED: [(char, &str); 8] = [
    ('Y', "segments must be divided to keep the angle bounds"),
    ('S', "the number of vertices follows from the angles"),
    ('r', "meshes are not refined: mesh the points or the PSLG anew"),
    ('u', "there is no user-defined test of triangles"),
    ('I', "the input is not replaced"),
    ('N', "the files .node and .ele are written as a pair"),
    ('E', "the files .node and .ele are written as a pair"),
    ('o', "there are only elements of first and second order, -o2"),
];

impl Switches {
    /// Reads arguments like `-pq30a0.1`.
    pub(super) fn parse<'a>(arguments: impl IntoIterator<Item = &'a str>) -> Result<Self, Failure> {
        let mut switches = Self::default();
        for argument in arguments {
            let mut rest = argument.trim_start_matches('-');
            while let Some(letter) = rest.chars().next() {
                rest = &rest[letter.len_utf8()..];
                let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
                let takes_number = matches!(letter, 'q' | 'a' | 'o' | 'S');
                let number = if takes_number { &rest[..digits] } else { "" };
                rest = &rest[number.len()..];
                switches.take(letter, number)?;
            }
        }
        Ok(switches)
    }

    /// Refuses what a mesh as input asks for.
    pub(super) fn refuse_refinement(&mut self) -> Result<(), Failure> {
        self.take('r', "")
    }

    fn take(&mut self, letter: char, number: &str) -> Result<(), Failure> {
        let refuse =
            |why: &str| Err(Failure::Switch { switch: format!("{letter}{number}"), why: why.to_owned() });
        match (letter, number) {
            ('p', _) => self.graph = true,
            ('q' | 'a', "") => {
                self.region_areas |= letter == 'a';
            }
            ('q', number) => match number.parse() {
                Ok(value) => self.min_angle = Some(value),
                Err(_) => return refuse(&format!("the smallest angle must be a number, got {number}")),
            },
            ('a', number) => match number.parse() {
                Ok(value) if value > 0.0 => self.max_area = Some(value),
                _ => return refuse(&format!("the largest area must be positive, got {number}")),
            },
            ('A', _) => self.regions = true,
            ('c', _) => self.hull = true,
            ('e', _) => self.edges = true,
            ('n', _) => self.neighbours = true,
            ('v', _) => self.voronoi = true,
            ('g', _) => self.off = true,
            ('o', "2") => self.second_order = true,
            ('o', "1") => {}
            ('B', _) => self.without_markers = true,
            ('P', _) => self.without_poly = true,
            ('Q', _) => self.quiet = true,
            ('z', _) => self.from_zero = true,
            ('j', _) => self.without_unused = true,
            (letter, _) if WITHOUT_EFFECT.contains(letter) => {}
            (letter, _) => match REFUSED.iter().find(|(refused, _)| *refused == letter) {
                Some((_, why)) => return refuse(why),
                None => return refuse("no such switch"),
            },
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_in_a_row_and_apart_are_the_same() {
        let all = Switches::parse(["-pq33.5a.1aAeno2vzDQBPcg"]).unwrap();
        let apart = "-p -q33.5 -a.1 -a -A -e -n -o2 -v -z -D -Q -B -P -c -g".split(' ');
        assert_eq!(all, Switches::parse(apart).unwrap());
        assert_eq!((all.min_angle, all.max_area, all.region_areas), (Some(33.5), Some(0.1), true));
        assert!(all.graph && all.second_order && all.quiet && all.voronoi);
        assert_eq!(Switches::parse(["-q"]).unwrap(), Switches::default());
    }

    #[test]
    fn numbers_and_unused_points() {
        let switches = Switches::parse(["-pzj"]).unwrap();
        assert!(switches.from_zero && switches.without_unused);
    }

    #[test]
    fn what_does_not_fit_is_refused_by_name() {
        for (arguments, words) in [
            ("-pY", "-Y: segments must be divided"),
            ("-S100", "-S100: the number"),
            ("-pq30r", "-r: meshes"),
            ("-o3", "-o3: there are"),
            ("-a0", "-a0: the largest area must be positive, got 0"),
            ("-q1.2.3", "-q1.2.3: the smallest angle must be a number, got 1.2.3"),
            ("-k", "-k: no such switch"),
            ("-p\u{e9}", "no such switch"),
        ] {
            let error = Switches::parse([arguments]).unwrap_err().to_string();
            assert!(error.contains(words), "{arguments}: {error}");
        }
    }
}
