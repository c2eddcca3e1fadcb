//! Tables of points with a size each: `x y size` in each line, separated by
//! spaces, tabs, commas or semicolons; `#` begins a comment.

use std::io::BufRead;
use std::path::Path;

use hexdel_geom::DVec2;

use crate::error::ReadError;

/// Reads points with sizes from a file, in any extension. Whether the sizes
/// are positive is not checked.
///
/// # Errors
///
/// [`ReadError`] with the file and the line.
pub fn read_sizes(path: &Path) -> Result<Vec<(DVec2, f64)>, ReadError> {
    let file = std::fs::File::open(path).map_err(|source| ReadError::open(path, source))?;
    parse_sizes(std::io::BufReader::new(file), &path.display().to_string())
}

/// Reads points with sizes; `file` is its name in errors.
///
/// # Errors
///
/// As [`read_sizes`].
pub fn parse_sizes(mut reader: impl BufRead, file: &str) -> Result<Vec<(DVec2, f64)>, ReadError> {
    let (mut all, mut bytes, mut line) = (Vec::new(), Vec::new(), 0);
    loop {
        bytes.clear();
        let read = reader.read_until(b'\n', &mut bytes);
        if read.map_err(|source| ReadError::Io { file: file.to_owned(), source })? == 0 {
            return Ok(all);
        }
        line += 1;
        let text = std::str::from_utf8(&bytes);
        let text = text.map_err(|_| ReadError::NotUtf8 { file: file.to_owned(), line })?;
        let text = text.split('#').next().unwrap_or("").trim_start_matches('\u{feff}');
        let separates = |c: char| c.is_whitespace() || c == ',' || c == ';';
        let words: Vec<&str> = text.split(separates).filter(|w| !w.is_empty()).collect();
        if words.is_empty() {
            continue;
        }
        let numbers: Vec<f64> = words.iter().filter_map(|w| w.parse().ok()).collect();
        match (words.len(), numbers.as_slice()) {
            (3, &[x, y, size]) => all.push((DVec2::new(x, y), size)),
            _ => {
                return Err(ReadError::Malformed {
                    file: file.to_owned(),
                    line,
                    expected: "x, y and a size".into(),
                    found: text.trim().chars().take(40).collect(),
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_have_three_numbers() {
        let read = parse_sizes("# sizes\n1 2 3\n\n4,5;6 # more\r\n".as_bytes(), "t").unwrap();
        assert_eq!(read, [(DVec2::new(1.0, 2.0), 3.0), (DVec2::new(4.0, 5.0), 6.0)]);
        for bad in ["1 2\n", "1 2 3 4\n", "1 2 x\n"] {
            let error = parse_sizes(format!("0 0 1\n{bad}").as_bytes(), "t");
            assert!(matches!(error, Err(ReadError::Malformed { line: 2, .. })), "{bad}");
        }
    }
}
