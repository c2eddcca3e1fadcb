//! `hexdel triangle`: the switches and file names of Shewchuk's Triangle.
//!
//! What each switch does is in `docs/triangle-users.md`.

mod numbered;
mod switches;

use crate::exit::{Failure, Outcome};
use crate::input::warn_of;
use crate::mesh::{About, Finished, failure, warn_of_repairs};
use crate::outputs::Outputs;
use crate::progress::Progress;
use hexdel::{AngleBounds, Domain, Mesher, Method, Pslg};
use hexdel_io::PointReader;
use std::path::{Path, PathBuf};
use switches::Switches;

pub(crate) use numbered::Numbered;

/// Mesh with Triangle's switches and file names
#[derive(clap::Args)]
#[command(
    override_usage = "hexdel triangle [-SWITCHES] FILE",
    after_help = "\
FILE is a .node or .poly. Output: FILE.1.node, FILE.1.ele and, for a .poly, FILE.1.poly. Input
points come first and in order; numbers start as in the input. Crossing segments are divided.
  -p        FILE is a .poly even if its name does not say so
  -q30      no angle below 30 degrees, the default at segments
  -a0.1     no triangle larger than 0.1; -a alone applies the areas of regions in the .poly
  -A        triangles carry the attributes of their regions
  -c        mesh the convex hull
  -e -n -v  write edges, neighbours, the Voronoi dual;  -g  write an .off
  -o2       triangles with nodes at the midpoints of their edges
  -B -P -j  write no markers, no .poly, no unused points;  -z  number from 0
  -Q        print nothing but warnings;  -D -C -i -F -l -s -X -V  have no effect
Not supported: -Y -S -r -u -I -N -E. docs/triangle-users.md has the details.

Examples:
  hexdel triangle -pq30a0.1 letters.poly
  hexdel triangle -pAaen plate"
)]
pub(crate) struct Args {
    /// Switches and the file
    #[arg(hide = true, required = true, allow_hyphen_values = true, trailing_var_arg = true)]
    arguments: Vec<String>,
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    let (given, files): (Vec<&str>, Vec<&str>) =
        args.arguments.iter().map(String::as_str).partition(|a| a.starts_with('-') && *a != "-");
    let mut switches = Switches::parse(given)?;
    let [file] = files[..] else {
        return Err(Failure::Switch { switch: files.join(" "), why: "one file is needed".to_owned() });
    };
    match Path::new(file).extension().and_then(|e| e.to_str()) {
        Some(e) if e.eq_ignore_ascii_case("poly") => switches.graph = true,
        Some(e) if e.eq_ignore_ascii_case("ele") => switches.refuse_refinement()?,
        _ => {}
    }
    let names = Names::of(file, &switches);
    let mut outputs = Outputs::default();
    outputs.protect_input(&names.input);
    for path in names.outputs(&switches) {
        if path.to_string_lossy().ends_with(".v.node") {
            outputs.add_dual(&path)?;
        } else {
            outputs.add_mesh(&path)?;
        }
    }
    let input = PointReader::new().read(&names.input)?;
    warn_of(&input);
    let graph = wanted_of(&input.pslg, &switches);
    let progress = Progress::new(switches.quiet);
    let made = mesher(&switches, graph.segments.is_empty())?.triangulate_pslg_watched(&graph, &progress);
    progress.finish();
    let file = names.input.display().to_string();
    let made = made.map_err(|source| failure(&file, source, &graph))?;
    warn_of_repairs(made.repairs.as_ref(), &file);
    let first_number = if switches.from_zero { 0 } else { input.first_number };
    let numbered = Numbered::new(&made, &input, switches.without_unused, first_number);
    let finished = Finished {
        made: &made,
        input: &input,
        numbered: Some(&numbered),
        file: &file,
        quiet: switches.quiet,
        with_regions: switches.regions,
        with_markers: !switches.without_markers,
        second_order: switches.second_order,
        epsg: None,
        about: &About::default(),
        picture: hexdel_plot::Picture::default(),
    };
    finished.write(&outputs)
}

/// What of the input is to be meshed.
fn wanted_of(input: &Pslg, switches: &Switches) -> Pslg {
    let mut graph = input.clone();
    if !switches.graph {
        graph.segments.clear();
        graph.segment_markers.clear();
        graph.holes.clear();
        graph.regions.clear();
    }
    for region in graph.regions.iter_mut().filter(|_| !switches.region_areas) {
        region.max_area = None;
    }
    graph
}

fn mesher(switches: &Switches, points: bool) -> Result<Mesher, Failure> {
    let mut mesher = Mesher::new().method(Method::Compact);
    if !points {
        // Triangle divides segments where they meet, and so do we, with a word on each. What only
        // comes near stays where it is.
        mesher = mesher.repair_within(0.0);
    }
    if switches.hull || points {
        mesher = mesher.domain(Domain::Hull);
    }
    if let Some(angle) = switches.min_angle {
        let max = AngleBounds::EXTENDED.max_deg();
        mesher = mesher.bounds(AngleBounds::new(angle, max)?);
    }
    if let Some(area) = switches.max_area {
        mesher = mesher.max_area(area);
    }
    Ok(mesher)
}

/// The names of files as Triangle makes them.
struct Names {
    input: PathBuf,
    /// Without extension.
    stem: PathBuf,
}

impl Names {
    /// `box`, `box.node`, `box.poly` lead to `box.1`, and `box.1` and its kind to
    /// `box.2`.
    fn of(file: &str, switches: &Switches) -> Self {
        let path = Path::new(file);
        let known = |e: &std::ffi::OsStr| ["node", "poly"].iter().any(|known| e.eq_ignore_ascii_case(known));
        let extension = if switches.graph { "poly" } else { "node" };
        let (input, stem) = if path.extension().is_some_and(known) {
            (path.to_owned(), path.with_extension(""))
        } else {
            (appended(path, extension), path.to_owned())
        };
        let number = stem.extension().and_then(|e| e.to_str()).and_then(|e| e.parse::<u32>().ok());
        let stem = match number {
            Some(number) => stem.with_extension(number.saturating_add(1).to_string()),
            None => appended(&stem, "1"),
        };
        Self { input, stem }
    }

    fn outputs(&self, switches: &Switches) -> Vec<PathBuf> {
        let wanted = [
            ("ele", true),
            ("poly", switches.graph && !switches.without_poly),
            ("edge", switches.edges),
            ("neigh", switches.neighbours),
            ("off", switches.off),
            ("v.node", switches.voronoi),
        ];
        wanted.iter().filter(|(_, wanted)| *wanted).map(|(e, _)| appended(&self.stem, e)).collect()
    }
}

fn appended(path: &Path, extension: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(extension);
    name.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_triangle() {
        for (file, switches, input, stem) in [
            ("box", "-p", "box.poly", "box.1"),
            ("box.1", "-pq", "box.1.poly", "box.2"),
            ("a/box.poly", "-p", "a/box.poly", "a/box.1"),
            ("box.1.poly", "-p", "box.1.poly", "box.2"),
            ("box.9", "", "box.9.node", "box.10"),
            ("dots.node", "", "dots.node", "dots.1"),
            ("v1.x.node", "", "v1.x.node", "v1.x.1"),
        ] {
            let names = Names::of(file, &Switches::parse([switches]).unwrap());
            assert_eq!((names.input, names.stem), (input.into(), stem.into()), "{file}");
        }
    }
}
