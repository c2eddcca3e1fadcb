//! `hexdel generate`: test points.

use crate::exit::{Outcome, Verdict, unused};
use crate::input::{format_of_points, is_stream, names};
use crate::outputs::{Outputs, to_stdout};
use clap::builder::PossibleValuesParser;
use clap::builder::TypedValueParser as _;
use hexdel::generate::{Kind, generate};
use hexdel::geom::Pslg;
use std::io::Write;
use std::path::PathBuf;

/// More points than this are a slip of the keyboard: they take 1.6 GB here and
/// their mesh would have more vertices than 32-bit indices can tell apart.
const MAX_POINTS: u64 = 100_000_000;

/// Make test points
#[derive(clap::Args)]
#[command(after_help = "\
    The same kind, number and seed give the same file everywhere.\n\n\
    Example:\n  hexdel generate spiral 1000 --seed 7 -o spiral.node")]
pub(crate) struct Args {
    /// uniform, line, clusters, grid, jittered, circle, spiral, pairs or contrast
    #[arg(value_name = "KIND", value_parser = kinds(), hide_possible_values = true)]
    kind: Kind,
    /// How many points
    #[arg(value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MAX_POINTS))]
    n: u64,
    /// Seed of the random numbers
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
    /// Output: .node, .poly, .csv, .tsv, .xyz, .txt, .pts, .json, .ron or -
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Format of `-`
    #[arg(long, value_name = "NAME", value_parser = names(), hide_possible_values = true)]
    format: Option<String>,
}

fn kinds() -> impl clap::builder::TypedValueParser<Value = Kind> {
    PossibleValuesParser::new(Kind::ALL.map(Kind::name)).try_map(|name| name.parse::<Kind>())
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    let points = || Pslg::from_points(generate(args.kind, args.n as usize, args.seed));
    if is_stream(&args.output) {
        let format = format_of_points(args.format.as_ref())?;
        let write =
            |out: &mut dyn Write| Ok(hexdel_io::write_points_to(out, format, &points(), "standard output")?);
        return to_stdout(write).map(|()| Verdict::Holds);
    }
    if args.format.is_some() {
        return unused("--format", "it names the format of -, files have that of their extension");
    }
    let mut outputs = Outputs::default();
    outputs.add_points(&args.output)?;
    let points = points();
    outputs.write(|_, path| Ok(hexdel_io::write_points(path, &points)?))?;
    Ok(Verdict::Holds)
}
