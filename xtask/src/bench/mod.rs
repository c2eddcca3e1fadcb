//! `cargo xtask bench`: time and memory, side by side with spade.
//!
//! Every case runs in a process of its own, which prints what it measured.

mod case;
mod inputs;
mod report;

use crate::Outcome;
use case::{Case, Measured, Mesher};
use inputs::Input;
use report::Row;
use std::process::Command;

/// Arguments of `cargo xtask bench`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Leave out the inputs of a million points
    #[arg(long)]
    quick: bool,
    /// Print the tables, but do not write docs/performance.md
    #[arg(long)]
    dry: bool,
    /// Measure these inputs alone, and write nothing
    #[arg(long, value_enum, value_delimiter = ',')]
    inputs: Vec<Input>,
    /// Measure these numbers of points alone, and write nothing
    #[arg(long, value_delimiter = ',')]
    sizes: Vec<usize>,
    /// Measure this mesher alone, in this process
    #[arg(long, value_enum)]
    case: Option<Mesher>,
    /// The input of the case
    #[arg(long, value_enum, default_value = "uniform")]
    input: Input,
    /// Points of the case
    #[arg(long, default_value_t = 100_000)]
    points: usize,
    /// Threads of the case
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// Centre and radius of the hexagon of the case, for spade
    #[arg(long, num_args = 3, allow_negative_numbers = true)]
    hexagon: Option<Vec<f64>>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    if let Some(mesher) = args.case {
        let hexagon = match args.hexagon.as_deref() {
            Some(&[x, y, radius]) => [x, y, radius],
            _ => [0.5, 0.5, 3.0],
        };
        return Case { mesher, input: args.input, points: args.points, threads: args.threads, hexagon }.run();
    }
    let partial = !args.inputs.is_empty() || !args.sizes.is_empty();
    let inputs = if args.inputs.is_empty() { &Input::ALL[..] } else { &args.inputs };
    let sizes = match args.sizes.as_slice() {
        [] if args.quick => &[1000, 10_000, 100_000][..],
        [] => &[1000, 10_000, 100_000, 1_000_000],
        sizes => sizes,
    };
    let threads = std::thread::available_parallelism()?.get();
    let mut rows = Vec::new();
    for &input in inputs {
        for &points in sizes {
            let row = measure_row(input, points, threads)?;
            println!("{}", row.summary());
            rows.push(row);
        }
    }
    let pages = [1_000_000, 10_000_000, 100_000_000].map(|triangles| {
        let case = Case {
            mesher: Mesher::Memory,
            input: Input::Uniform,
            points: triangles,
            threads: 1,
            hexagon: [0.0; 3],
        };
        measure(&case)
    });
    let mut memory = Vec::new();
    for measured in pages {
        memory.push(measured?);
    }
    let tables = report::tables(&rows, &memory, threads);
    println!("{tables}");
    if args.dry || partial { Ok(()) } else { report::write(&tables) }
}

fn measure_row(input: Input, points: usize, threads: usize) -> Result<Row, Box<dyn std::error::Error>> {
    let case = Case { mesher: Mesher::Hexdel, input, points, threads: 1, hexagon: [0.0; 3] };
    let one = measure(&case)?;
    let all = measure(&Case { threads, ..case.clone() })?;
    let spade = measure(&Case { mesher: Mesher::Spade, hexagon: one.hexagon, ..case })?;
    Ok(Row { input, points, one, all, spade })
}

/// The best of a few runs: what disturbs a measurement only ever adds to it.
fn measure(case: &Case) -> Result<Measured, Box<dyn std::error::Error>> {
    let mut best: Option<Measured> = None;
    for _ in 0..3 {
        let measured = measure_once(case)?;
        let time = |m: &Measured| if case.threads == 1 { m.cpu() } else { m.wall() };
        if best.is_none_or(|best| time(&measured) < time(&best)) {
            best = Some(measured);
        }
    }
    best.ok_or_else(|| "no run".into())
}

/// Starts this program again for one case.
fn measure_once(case: &Case) -> Result<Measured, Box<dyn std::error::Error>> {
    use clap::ValueEnum as _;
    let name = |value: Option<clap::builder::PossibleValue>| value.map(|v| v.get_name().to_owned());
    let [x, y, radius] = case.hexagon;
    let output = Command::new(std::env::current_exe()?)
        .arg("bench")
        .args(["--case".into(), name(case.mesher.to_possible_value()).unwrap_or_default()])
        .args(["--input".into(), name(case.input.to_possible_value()).unwrap_or_default()])
        .args(["--points".into(), case.points.to_string()])
        .args(["--threads".into(), case.threads.to_string()])
        .args(["--hexagon".into(), format!("{x:?}"), format!("{y:?}"), format!("{radius:?}")])
        .output()?;
    if !output.status.success() {
        return Err(format!("{case:?}: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    String::from_utf8(output.stdout)?.trim().parse()
}
