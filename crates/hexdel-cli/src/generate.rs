//! `hexdel generate`: test points.

use crate::exit::{Outcome, Verdict};
use crate::input::{Formats, is_stream};
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

/// Make points to test with
#[derive(clap::Args)]
#[command(mut_arg("columns", |arg| arg.hide(true)), after_help = "\
    The same kind, number and seed give the same file everywhere.\n\n\
    Example:\n  hexdel generate spiral 1000 --seed 7 -o spiral.node")]
pub(crate) struct Args {
    /// uniform, line, clusters, grid, jittered, circle, spiral, pairs or contrast
    #[arg(value_name = "KIND", value_parser = kinds(), hide_possible_values = true)]
    kind: Kind,
    /// How many points
    #[arg(value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MAX_POINTS))]
    n: u64,
    /// Another seed, other points
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
    /// Where to: .node, .poly, .csv, .tsv, .xyz, .txt, .pts, .json, .ron or -
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    formats: Formats,
}

fn kinds() -> impl clap::builder::TypedValueParser<Value = Kind> {
    PossibleValuesParser::new(Kind::ALL.map(Kind::name)).try_map(|name| name.parse::<Kind>())
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    let points = || Pslg::from_points(generate(args.kind, args.n as usize, args.seed));
    if is_stream(&args.output) {
        let format = args.formats.of_points()?;
        let write =
            |out: &mut dyn Write| Ok(hexdel_io::write_points_to(out, format, &points(), "standard output")?);
        return to_stdout(write).map(|()| Verdict::Holds);
    }
    let mut outputs = Outputs::default();
    outputs.add_points(&args.output)?;
    let points = points();
    outputs.write(|_, path| Ok(hexdel_io::write_points(path, &points)?))?;
    Ok(Verdict::Holds)
}
