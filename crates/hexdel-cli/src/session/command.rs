//! What a line asks for.

use hexdel::DVec2;
use std::path::PathBuf;

/// One command.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Command {
    Open(PathBuf),
    Domain(DVec2, f64),
    Load(PathBuf),
    Insert(Vec<DVec2>),
    InsertFile(PathBuf),
    Remove(Vec<u64>),
    Size(SizeCommand),
    Refine(DVec2, DVec2, u8),
    Grow,
    Undo,
    Points,
    Counts,
    Certify,
    Mesh(PathBuf),
    Save(PathBuf),
    Quit,
}

/// What a `size` command adds to the size, or that there is to be none.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum SizeCommand {
    None,
    Constant(f64),
    Box(DVec2, DVec2, f64),
    Polygon(f64, Vec<DVec2>),
    Point(DVec2, f64),
    File(PathBuf),
    Gradation(f64),
}

/// The commands, for the help and for who asks for another.
pub(crate) const KNOWN: &str = "open, domain, load, insert, insert-file, remove, size, refine, grow, undo, \
    points, counts, certify, mesh, save, quit";

/// Reads a line; none if there is nothing on it.
pub(crate) fn parse(line: &str) -> Result<Option<Command>, String> {
    let line = line.trim();
    if line.is_empty() || line.starts_with('#') {
        return Ok(None);
    }
    let (name, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let rest = rest.trim();
    let words: Vec<&str> = rest.split_whitespace().collect();
    let command = match name {
        "open" => Command::Open(path(name, rest)?),
        "load" => Command::Load(path(name, rest)?),
        "insert-file" => Command::InsertFile(path(name, rest)?),
        "mesh" => Command::Mesh(path(name, rest)?),
        "save" => Command::Save(path(name, rest)?),
        "domain" => {
            let [x, y, radius] = numbers(name, &words, "X Y RADIUS")?;
            Command::Domain(DVec2::new(x, y), radius)
        }
        "insert" => Command::Insert(points(name, &words)?),
        "remove" => Command::Remove(ids(&words)?),
        "size" => Command::Size(size(rest, &words)?),
        "refine" => refine(&words)?,
        "grow" => alone(name, &words, Command::Grow)?,
        "undo" => alone(name, &words, Command::Undo)?,
        "points" => alone(name, &words, Command::Points)?,
        "counts" => alone(name, &words, Command::Counts)?,
        "certify" => alone(name, &words, Command::Certify)?,
        "quit" => alone(name, &words, Command::Quit)?,
        _ => return Err(format!("unknown command {}, expected one of {KNOWN}", cut(name))),
    };
    Ok(Some(command))
}

fn size(rest: &str, words: &[&str]) -> Result<SizeCommand, String> {
    let usage = "size H, size none, size box X Y X Y H, size polygon H X Y X Y X Y .., size point X Y H, \
        size file FILE, or size gradation G";
    match words {
        ["none"] => Ok(SizeCommand::None),
        ["box", more @ ..] => {
            let [a, b, c, d, h] = numbers("size box", more, "X Y X Y H")?;
            Ok(SizeCommand::Box(DVec2::new(a, b), DVec2::new(c, d), h))
        }
        ["polygon", h, more @ ..] => Ok(SizeCommand::Polygon(number(h)?, points("size polygon", more)?)),
        ["point", more @ ..] => {
            let [x, y, h] = numbers("size point", more, "X Y H")?;
            Ok(SizeCommand::Point(DVec2::new(x, y), h))
        }
        ["file", _, ..] => Ok(SizeCommand::File(PathBuf::from(rest["file".len()..].trim()))),
        ["gradation", g] => Ok(SizeCommand::Gradation(number(g)?)),
        [h] => Ok(SizeCommand::Constant(number(h).map_err(|e| format!("{e}; expected {usage}"))?)),
        _ => Err(format!("expected {usage}")),
    }
}

fn refine(words: &[&str]) -> Result<Command, String> {
    let usage = "X Y X Y HALVINGS";
    let (corners, halvings) = words.split_at(words.len().min(4));
    let [a, b, c, d] = numbers("refine", corners, usage)?;
    let halvings = match halvings {
        [k] => k.parse().ok().filter(|k| *k <= 30),
        _ => None,
    };
    let halvings = halvings.ok_or_else(|| format!("expected refine {usage}, up to 30 halvings"))?;
    Ok(Command::Refine(DVec2::new(a, b), DVec2::new(c, d), halvings))
}

fn path(name: &str, rest: &str) -> Result<PathBuf, String> {
    if rest.is_empty() { Err(format!("expected {name} FILE")) } else { Ok(PathBuf::from(rest)) }
}

fn alone(name: &str, words: &[&str], command: Command) -> Result<Command, String> {
    if words.is_empty() { Ok(command) } else { Err(format!("{name} takes no arguments")) }
}

fn numbers<const N: usize>(name: &str, words: &[&str], usage: &str) -> Result<[f64; N], String> {
    let all: Vec<f64> = words.iter().map(|w| number(w)).collect::<Result<_, _>>()?;
    all.try_into().map_err(|_| format!("expected {name} {usage}"))
}

fn points(name: &str, words: &[&str]) -> Result<Vec<DVec2>, String> {
    if words.is_empty() || words.len() % 2 == 1 {
        return Err(format!("expected {name} with X Y of each point"));
    }
    words.chunks(2).map(|w| Ok(DVec2::new(number(w[0])?, number(w[1])?))).collect()
}

fn ids(words: &[&str]) -> Result<Vec<u64>, String> {
    if words.is_empty() {
        return Err("expected remove with the numbers of points".to_owned());
    }
    let wrong = |word| format!("the number of a point must be an integer from 0, got {}", cut(word));
    words.iter().map(|w| w.parse().map_err(|_| wrong(w))).collect()
}

fn number(word: &str) -> Result<f64, String> {
    word.parse().map_err(|_| format!("expected a number, got {}", cut(word)))
}

/// A word of a readable length.
fn cut(word: &str) -> String {
    const MOST: usize = 40;
    if word.chars().count() <= MOST {
        word.to_owned()
    } else {
        word.chars().take(MOST).chain("..".chars()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_commands() {
        let of = |line: &str| parse(line).unwrap();
        assert_eq!(of("  "), None);
        assert_eq!(of("# insert 1 2"), None);
        let two = vec![DVec2::new(1.0, -2.5), DVec2::new(3.0, 4.0)];
        assert_eq!(of("insert 1 -2.5\t3 4\r\n"), Some(Command::Insert(two)));
        assert_eq!(of("remove 3 0"), Some(Command::Remove(vec![3, 0])));
        assert_eq!(of("mesh my mesh.vtu"), Some(Command::Mesh("my mesh.vtu".into())));
        assert_eq!(of("size none"), Some(Command::Size(SizeCommand::None)));
        assert_eq!(of("size .5"), Some(Command::Size(SizeCommand::Constant(0.5))));
        assert_eq!(of("size file a b.asc"), Some(Command::Size(SizeCommand::File("a b.asc".into()))));
        assert_eq!(of("refine 0 0 1 1 3"), Some(Command::Refine(DVec2::ZERO, DVec2::ONE, 3)));
        assert_eq!(of("undo"), Some(Command::Undo));
    }

    #[test]
    fn other_lines_are_refused() {
        for (line, message) in [
            ("inser 1 2", "unknown command inser"),
            ("insert 1", "expected insert with X Y"),
            ("insert", "expected insert with X Y"),
            ("insert 1 x", "expected a number, got x"),
            ("remove -1", "the number of a point must be an integer from 0, got -1"),
            ("remove", "expected remove"),
            ("domain 0 0", "expected domain X Y RADIUS"),
            ("mesh", "expected mesh FILE"),
            ("undo 2", "undo takes no arguments"),
            ("size", "expected size H"),
            ("size box 1 2 3", "expected size box X Y X Y H"),
            ("refine 0 0 1 1", "expected refine"),
            ("refine 0 0 1 1 31", "up to 30"),
        ] {
            let error = parse(line).unwrap_err();
            assert!(error.contains(message), "{line}: {error}");
        }
    }
}
