//! `hexdel session`: commands from a pipe, each answered with a line of JSON.

mod command;

use crate::exit::{Failure, Outcome as Ending, Verdict, print};
use crate::mesh::{EffortName, place, seconds};
use crate::outputs::{Content, Outputs};
use crate::sizing::size_of_file;
use command::{Command, SizeCommand, parse};
use hexdel::{AnySession, DVec2, Delta, Mesher, Method, Outcome, PointId, Pslg, RepairEntry, Size};
use hexdel_io::{Columns, MarkedEdge, MeshView, PointFile, PointReader, write_mesh};
use serde_json::{Value, json};
use std::io::{self, BufRead};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Change a mesh by commands on standard input; answers are lines of JSON
#[derive(clap::Args)]
#[command(
    override_usage = "hexdel session [OPTIONS] [FILE TO OPEN]",
    after_help = "\
    Commands:\n  \
    open FILE, load FILE         begin with the points or PSLG of a file; a saved session\n  \
    domain X Y RADIUS            begin with an empty hexagon\n  \
    insert X Y [X Y ..]          insert points, all or none; as first command, the domain grows\n  \
    insert-file FILE             insert the points of a file\n  \
    remove N [N ..]              remove points by the numbers that insert gave\n  \
    size H | none                set the longest edge wanted, everywhere\n  \
    size box X Y X Y H           the same in a box (also: polygon H X Y .., point X Y H, file FILE)\n  \
    size gradation G             growth per distance of the sizes that follow\n  \
    refine X Y X Y K             halve the edges in a box K times\n  \
    points, counts, certify      list the points; count; certify the mesh\n  \
    mesh FILE, save FILE         write the mesh; the session, for load\n  \
    grow, undo, quit             double the domain; undo the last change; end\n\n\
    Answers have \"ok\" and what changed, or an \"error\"; after an error the exit status is 2.\n\
    Example: printf 'insert .1 .2 .3 .1\\ninsert 2 1\\nmesh m.vtu\\n' | hexdel session"
)]
pub(crate) struct Args {
    /// The file to begin with, as by `open`
    #[arg(hide = true)]
    file: Option<PathBuf>,
    /// Columns of x and y in tables that are read
    #[arg(long, value_name = "X,Y")]
    columns: Option<Columns>,
    /// Answer with counts of what changed instead of lists
    #[arg(long)]
    brief: bool,
    /// compact, or templates: many triangles [default: compact]
    #[arg(long, value_enum, default_value_t, hide_possible_values = true, hide_default_value = true)]
    method: SessionMethod,
    /// How hard to optimise: fast, standard, best, fewest [default: standard]
    #[arg(long, value_enum, hide_possible_values = true)]
    effort: Option<EffortName>,
    /// Time limit of each call that meshes anew [default: none]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    budget: Option<Duration>,
    /// Number of threads [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

/// The methods that sessions know.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum SessionMethod {
    #[default]
    Compact,
    Templates,
}

impl Args {
    fn method(&self) -> Method {
        match self.method {
            SessionMethod::Compact => Method::Compact,
            SessionMethod::Templates => Method::Templates,
        }
    }

    /// What sessions are begun with.
    fn mesher(&self) -> Mesher {
        let mut mesher = Mesher::new().method(self.method()).effort(self.effort.unwrap_or_default().effort());
        if let Some(budget) = self.budget {
            mesher = mesher.budget(budget);
        }
        if let Some(threads) = self.threads {
            mesher = mesher.threads(usize::from(threads));
        }
        mesher
    }

    /// An option that is given, if any is, that only sessions of points and PSLGs have.
    fn option(&self) -> Option<&'static str> {
        let given = [
            ("--effort", self.effort.is_some()),
            ("--budget", self.budget.is_some()),
            ("--threads", self.threads.is_some()),
        ];
        given.into_iter().find(|(_, given)| *given).map(|(option, _)| option)
    }
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Ending {
    let mut talk = Talk {
        session: None,
        brief: args.brief,
        columns: args.columns.clone(),
        method: args.method(),
        mesher: args.mesher(),
        option: args.option(),
        inputs: Vec::new(),
    };
    let mut input = io::stdin().lock();
    let (mut line, mut failed) = (String::new(), 0);
    if let Some(file) = &args.file {
        let answer = talk.answer(Command::Open(file.clone())).map_err(|e| e.to_string());
        failed += usize::from(answer.is_err());
        tell(answer)?;
    }
    loop {
        line.clear();
        let answer = match input.read_line(&mut line) {
            Ok(0) => break,
            Ok(_) => match parse(&line) {
                Ok(None) => continue,
                Ok(Some(Command::Quit)) => break,
                Ok(Some(command)) => talk.answer(command).map_err(|e| e.to_string()),
                Err(message) => Err(message),
            },
            // Not text: the line has been read.
            Err(error) if error.kind() == io::ErrorKind::InvalidData => Err("not UTF-8 text".to_owned()),
            Err(error) => return Err(Failure::Stdin(error)),
        };
        failed += usize::from(answer.is_err());
        tell(answer)?;
    }
    if failed > 0 { Err(Failure::Commands { failed }) } else { Ok(Verdict::Holds) }
}

fn tell(answer: Result<Value, String>) -> Result<(), Failure> {
    let answer = answer.unwrap_or_else(|message| json!({ "ok": false, "error": message }));
    print(&format!("{answer}\n"))
}

/// Why a command was not done.
type Refusal = Box<dyn std::error::Error>;

struct Talk {
    session: Option<AnySession>,
    brief: bool,
    columns: Option<Columns>,
    method: Method,
    mesher: Mesher,
    /// An option that has no effect where a session begins without points, or is loaded.
    option: Option<&'static str>,
    /// Points that were read, which no mesh may replace.
    inputs: Vec<PathBuf>,
}

impl Talk {
    fn answer(&mut self, command: Command) -> Result<Value, Refusal> {
        match command {
            Command::Open(path) => {
                let file = PointReader::new().columns(self.columns.clone()).read(&path)?;
                let name = path.display().to_string();
                self.inputs.push(path);
                let session = AnySession::new(&file.pslg, &self.mesher)?;
                let points_alone = file.pslg.segments.is_empty();
                let more = if points_alone { unused(&file.pslg) } else { told(&session, &name, &file) };
                let repairs = session.repairs().map_or(&[][..], |report| &report.repairs);
                let repairs: Vec<String> = repairs.iter().map(|r| RepairEntry::new(r).to_string()).collect();
                let mut answer = with_file(self.begin(session)?, &file, more);
                if !repairs.is_empty() {
                    answer["repairs"] = repairs.into();
                }
                Ok(answer)
            }
            Command::Domain(..) | Command::Load(_) if self.option.is_some() => {
                let option = self.option.unwrap_or_default();
                Err(format!("{option} has no effect: it is for sessions that begin with open or insert")
                    .into())
            }
            Command::Domain(centre, radius) => self.begin(AnySession::empty(centre, radius, self.method)?),
            Command::Load(path) => {
                let text = std::fs::read_to_string(&path)
                    .map_err(|source| Failure::Output { file: path.clone(), source })?;
                self.begin(AnySession::from_ron(&text)?)
            }
            Command::Insert(points) if self.session.is_none() => self.begin_with(&points),
            Command::InsertFile(path) if self.session.is_none() => {
                let file = PointReader::new().columns(self.columns.clone()).read(&path)?;
                self.inputs.push(path);
                Ok(with_file(self.begin_with(&file.pslg.points)?, &file, unused(&file.pslg)))
            }
            other => self.answer_in_session(other),
        }
    }

    /// Begins with points, in a domain that follows them.
    fn begin_with(&mut self, points: &[DVec2]) -> Result<Value, Refusal> {
        let (session, outcome) = AnySession::begin(points, &self.mesher)?;
        let answer = changed_answer(&session, &outcome, self.brief);
        self.session = Some(session);
        Ok(answer)
    }

    fn begin(&mut self, session: AnySession) -> Result<Value, Refusal> {
        self.session = Some(session);
        self.answer_in_session(Command::Counts)
    }

    fn answer_in_session(&mut self, command: Command) -> Result<Value, Refusal> {
        let brief = self.brief;
        let session =
            self.session.as_mut().ok_or("no session yet: begin with insert, open, domain or load")?;
        let outcome = match command {
            Command::Insert(points) => session.insert_all(&points)?,
            Command::InsertFile(path) => {
                let file = PointReader::new().columns(self.columns.clone()).read(&path)?;
                self.inputs.push(path);
                let outcome = session.insert_all(&file.pslg.points)?;
                return Ok(with_file(changed_answer(session, &outcome, brief), &file, unused(&file.pslg)));
            }
            Command::Remove(ids) => session.remove(&ids.into_iter().map(PointId).collect::<Vec<_>>())?,
            Command::Size(size) => {
                let size = changed(session.size().cloned(), size)?;
                session.set_size(size)?
            }
            Command::Refine(a, b, halvings) => session.refine_box(a, b, halvings)?,
            Command::Grow => session.grow()?,
            Command::Undo => session.undo()?,
            Command::Points => return Ok(points(session)),
            Command::Certify => {
                let check = session.check();
                return Ok(json!({
                    "ok": true, "holds": check.holds(), "certificate": check.certificate,
                    "segments_missing": check.segments.missing.len(),
                }));
            }
            Command::Mesh(path) => return write(session, &path, &self.inputs),
            Command::Save(path) => return save(session, &path),
            _ => return Ok(counts(session)),
        };
        Ok(changed_answer(session, &outcome, brief))
    }
}

/// The answer to a command that has changed the mesh.
fn changed_answer(session: &AnySession, outcome: &Outcome, brief: bool) -> Value {
    let mut answer = counts(session);
    answer["points_inserted"] = outcome.points.iter().map(|p| p.0).collect();
    answer["remeshed"] = outcome.remeshed.into();
    answer["delta"] = if brief { brief_delta(&outcome.delta) } else { json!(outcome.delta) };
    if let Some((centre, radius)) = outcome.domain {
        answer["domain"] = json!({ "centre": [centre.x, centre.y], "radius": radius });
    }
    answer
}

/// With what was found out about a file that was read, and more of it.
fn with_file(mut answer: Value, file: &PointFile, more: Vec<String>) -> Value {
    if let Some(columns) = &file.columns {
        answer["columns"] = columns.to_string().into();
    }
    let warnings: Vec<String> = file.warnings.iter().map(ToString::to_string).chain(more).collect();
    if !warnings.is_empty() {
        answer["warnings"] = warnings.into();
    }
    answer
}

/// What was to be said of a PSLG, with the file and the line if it is known.
fn told(session: &AnySession, name: &str, file: &PointFile) -> Vec<String> {
    session.warnings().iter().map(|warning| format!("{}: {warning}", place(warning, name, file))).collect()
}

/// What is not used of a file of which points alone are.
fn unused(graph: &Pslg) -> Vec<String> {
    let parts = [
        ("segments", graph.segments.len()),
        ("holes", graph.holes.len()),
        ("regions", graph.regions.len()),
        ("polygons", graph.polygons.len()),
    ];
    let parts: Vec<String> =
        parts.iter().filter(|p| p.1 > 0).map(|(what, count)| format!("{count} {what}")).collect();
    if parts.is_empty() {
        Vec::new()
    } else {
        vec![format!("only points are used, not {}", parts.join(", "))]
    }
}

fn counts(session: &AnySession) -> Value {
    let [points, vertices, triangles] = session.counts();
    let (centre, radius) = session.domain();
    json!({
        "ok": true, "points": points, "vertices": vertices, "triangles": triangles,
        "centre": [centre.x, centre.y], "radius": radius,
    })
}

fn points(session: &AnySession) -> Value {
    let all: Vec<Value> = session.points().into_iter().map(|(id, at)| json!([id.0, at.x, at.y])).collect();
    json!({ "ok": true, "points": all })
}

fn brief_delta(delta: &Delta) -> Value {
    json!({
        "vertices_removed": delta.vertices_removed.len(),
        "vertices_added": delta.vertices_added.len(),
        "vertices_moved": delta.vertices_moved.len(),
        "triangles_removed": delta.triangles_removed.len(),
        "triangles_added": delta.triangles_added.len(),
    })
}

/// The size with what a command adds.
fn changed(size: Option<Size>, command: SizeCommand) -> Result<Option<Size>, Refusal> {
    let size = size.unwrap_or_else(Size::unlimited);
    Ok(Some(match command {
        SizeCommand::None => return Ok(None),
        SizeCommand::Constant(h) => size.and_constant(h)?,
        SizeCommand::Box(a, b, h) => size.and_box(a, b, h)?,
        SizeCommand::Polygon(h, corners) => size.and_polygon(corners, h)?,
        SizeCommand::Point(at, h) => size.and_points(&[(at, h)])?,
        SizeCommand::File(path) => size_of_file(size, &path)?,
        SizeCommand::Gradation(g) => size.with_gradation(g)?,
    }))
}

fn write(session: &AnySession, path: &Path, inputs: &[PathBuf]) -> Result<Value, Refusal> {
    let mut outputs = Outputs::default();
    for input in inputs {
        outputs.protect_input(input);
    }
    outputs.add_mesh(path)?;
    let made = session.mesh();
    let mut inputs = vec![None; made.mesh.vertices.len()];
    for &(id, v) in &made.points {
        inputs[v.index()] = u32::try_from(id.0).ok();
    }
    let certificate = session.certificate();
    let mut view = MeshView::new(&made.mesh).with_input_indices(&inputs).with_certificate(&certificate);
    let edges: Vec<MarkedEdge> =
        made.edges.iter().map(|e| MarkedEdge { ends: e.ends, marker: e.marker }).collect();
    let regions = session.region_attributes(&made);
    if !edges.is_empty() {
        view = view.with_marked_edges(&edges).with_vertex_markers(&made.vertex_markers);
    }
    if regions.iter().any(|a| *a != 0.0) {
        view = view.with_regions(&regions);
    }
    outputs.write(|_, path| Ok(write_mesh(path, &view)?))?;
    Ok(written(path))
}

fn save(session: &AnySession, path: &Path) -> Result<Value, Refusal> {
    let text = session.to_ron()?;
    let mut outputs = Outputs::default();
    outputs.add_text(path)?;
    outputs.write(|content, path| {
        debug_assert_eq!(content, Content::Text);
        let written = std::fs::write(path, &text);
        written.map_err(|source| Failure::Output { file: PathBuf::from(path), source })
    })?;
    Ok(written(path))
}

fn written(path: &Path) -> Value {
    json!({ "ok": true, "file": path.display().to_string() })
}
