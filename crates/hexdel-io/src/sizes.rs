//! Tables of points with a size each: `x y size` in each line, separated by
//! spaces, tabs, commas or semicolons; `#` begins a comment.

use std::io::BufRead;
use std::path::Path;

use hexdel_geom::DVec2;

use crate::error::ReadError;
use crate::lines::{Comments, Lines};

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
pub fn parse_sizes(reader: impl BufRead, file: &str) -> Result<Vec<(DVec2, f64)>, ReadError> {
    let mut all = Vec::new();
    let mut lines = Lines::new(reader, file, Comments::Anywhere);
    while let Some(row) = lines.next_row()? {
        let separates = |c: char| c.is_whitespace() || c == ',' || c == ';';
        let words = row.text.split(separates).filter(|word| !word.is_empty());
        let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
        match numbers.as_deref() {
            Some([]) => {}
            Some(&[x, y, size]) => all.push((DVec2::new(x, y), size)),
            _ => return Err(row.malformed("x, y and a size", Some(row.text))),
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_have_three_numbers() {
        let read = parse_sizes("# sizes\n1 2 3\n\n4,5;6 # more\r\n".as_bytes(), "t").unwrap();
        assert_eq!(read, [(DVec2::new(1.0, 2.0), 3.0), (DVec2::new(4.0, 5.0), 6.0)]);
        let endless = parse_sizes(std::io::BufReader::new(std::io::repeat(b'1')), "t");
        assert!(matches!(endless, Err(ReadError::LineTooLong { line: 1, .. })));
        for bad in ["1 2\n", "1 2 3 4\n", "1 2 x\n"] {
            let error = parse_sizes(format!("0 0 1\n{bad}").as_bytes(), "t");
            assert!(matches!(error, Err(ReadError::Malformed { line: 2, .. })), "{bad}");
        }
    }
}
