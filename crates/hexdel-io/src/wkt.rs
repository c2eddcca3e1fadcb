//! Well-known text: reading geometries.
//!
//! A text is any number of geometries, each with or without `SRID=..;` before it,
//! separated by white space, commas or semicolons. All of the simple features are
//! read, with `Z`, `M` and `ZM` coordinates, of which measures are left; a `TRIANGLE`
//! is a polygon, a `TIN` or `POLYHEDRALSURFACE` a collection of them. Geometries are
//! numbered from 1, those of an outermost `GEOMETRYCOLLECTION` each for itself. What
//! becomes of them is said in [`shapes`](crate::shapes).
//!
//! The crate `wkt` takes a text as a whole, names no lines and follows nested
//! collections as deep as the stack goes, hence this parser. It reads token by token:
//! a coastline may well be one line of many megabytes.

use std::io::BufRead;

use hexdel_geom::DVec2;

use crate::error::ReadError;
use crate::lines::{clip, quote};
use crate::mend::Faults;
use crate::shapes::{Features, GraphBuilder, Place, Shape};

/// The longest word or number, bytes.
const MAX_WORD: usize = 1 << 10;

/// How deep collections may be nested.
const MAX_DEPTH: usize = 64;

/// Reads a text.
pub(crate) fn read_wkt(reader: impl BufRead, file: &str) -> Result<Features, ReadError> {
    let scanner = Scanner::new(reader, file)?;
    let mut parser = Parser { scanner, points: 0, is_measured: false, faults: Faults::default() };
    let mut builder = GraphBuilder::new(file);
    let read = read_geometries(&mut parser, &mut builder);
    // What is wrong with numbers was found before.
    parser.faults.take()?;
    read.map(|()| builder.finish())
}

fn read_geometries<R: BufRead>(parser: &mut Parser<R>, builder: &mut GraphBuilder) -> Result<(), ReadError> {
    while let Some(shape) = parser.next_geometry()? {
        let line = parser.scanner.line;
        match shape {
            Shape::Collection(shapes) if parser.scanner.was_collection => {
                shapes.into_iter().try_for_each(|shape| builder.feature(shape, line))?;
            }
            shape => builder.feature(shape, line)?,
        }
    }
    Ok(())
}

struct Parser<R> {
    scanner: Scanner<R>,
    /// Positions so far, for errors.
    points: u64,
    /// Whether third coordinates of the geometry are measures rather than heights.
    is_measured: bool,
    /// Of numbers.
    faults: Faults,
}

impl<R: BufRead> Parser<R> {
    fn next_geometry(&mut self) -> Result<Option<Shape>, ReadError> {
        while matches!(self.scanner.token, Token::Mark(b',' | b';')) {
            self.scanner.advance()?;
        }
        if self.scanner.token == Token::End {
            return Ok(None);
        }
        if self.scanner.is_word("SRID") {
            // The number of the coordinates' system, which is the user's business.
            self.scanner.advance()?;
            self.expect(b'=', "\"=\" after SRID")?;
            self.scanner.advance()?;
            self.expect(b';', "\";\" after SRID")?;
        }
        self.scanner.was_collection = self.scanner.is_word("GEOMETRYCOLLECTION");
        let was_collection = self.scanner.was_collection;
        let shape = self.geometry(0)?;
        self.scanner.was_collection = was_collection;
        Ok(Some(shape))
    }

    fn geometry(&mut self, depth: usize) -> Result<Shape, ReadError> {
        const EXPECTED: &str = "the name of a geometry";
        if depth > MAX_DEPTH {
            return Err(self.scanner.malformed("collections nested less deeply"));
        }
        let Token::Word(word) = &self.scanner.token else {
            return Err(self.scanner.malformed(EXPECTED));
        };
        let mut name = word.to_ascii_uppercase();
        if !NAMES.contains(&name.as_str()) {
            // "POINTZ" is as good as "POINT Z".
            name.truncate(name.trim_end_matches(['Z', 'M']).len());
        }
        if !NAMES.contains(&name.as_str()) {
            return Err(self.scanner.malformed(EXPECTED));
        }
        let dimension = word[name.len().min(word.len())..].to_ascii_uppercase();
        self.scanner.advance()?;
        self.is_measured = dimension == "M" || self.scanner.is_word("M");
        if ["Z", "M", "ZM"].iter().any(|dimension| self.scanner.is_word(dimension)) {
            self.scanner.advance()?;
        }
        match name.as_str() {
            "POINT" | "MULTIPOINT" => self.list(Self::loose_position).map(Shape::Points),
            "LINESTRING" => self.positions().map(Shape::Line),
            "POLYGON" | "TRIANGLE" => self.list(Self::positions).map(Shape::Polygon),
            "MULTILINESTRING" => self.list(|p| p.positions().map(Shape::Line)).map(Shape::Collection),
            "GEOMETRYCOLLECTION" => self.list(|p| p.geometry(depth + 1)).map(Shape::Collection),
            _ => self.list(|p| p.list(Self::positions).map(Shape::Polygon)).map(Shape::Collection),
        }
    }

    /// Items in parentheses, or `EMPTY`.
    fn list<T>(
        &mut self,
        mut item: impl FnMut(&mut Self) -> Result<T, ReadError>,
    ) -> Result<Vec<T>, ReadError> {
        if self.scanner.is_word("EMPTY") {
            self.scanner.advance()?;
            return Ok(Vec::new());
        }
        self.expect(b'(', "\"(\" or EMPTY")?;
        let mut items = vec![item(self)?];
        while self.scanner.token == Token::Mark(b',') {
            self.scanner.advance()?;
            items.push(item(self)?);
        }
        self.expect(b')', "\",\" or \")\"")?;
        Ok(items)
    }

    fn positions(&mut self) -> Result<Vec<Place>, ReadError> {
        self.list(Self::position)
    }

    /// A position of a `MULTIPOINT`, with or without parentheses.
    fn loose_position(&mut self) -> Result<Place, ReadError> {
        if self.scanner.token != Token::Mark(b'(') {
            return self.position();
        }
        self.scanner.advance()?;
        let position = self.position()?;
        self.expect(b')', "\")\"")?;
        Ok(position)
    }

    fn position(&mut self) -> Result<Place, ReadError> {
        let [x, y] = [self.number("the x coordinate")?, self.number("the y coordinate")?];
        // A height, a measure, or both.
        let mut height = None;
        for i in 0..2 {
            if matches!(self.scanner.token, Token::Word(_)) {
                let number = self.number("a coordinate")?;
                height = height.or((i == 0 && !self.is_measured).then_some(number));
            }
        }
        self.points += 1;
        Ok(Place { at: DVec2::new(x, y), height })
    }

    fn number(&mut self, expected: &'static str) -> Result<f64, ReadError> {
        let Token::Word(word) = &self.scanner.token else {
            return Err(self.scanner.malformed(expected));
        };
        let number = match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(ReadError::NonFinite {
                file: self.scanner.file.clone(),
                line: self.scanner.line,
                column: 0,
                item: "point",
                index: self.points,
                found: clip(word),
            }),
            Err(_) => Err(self.scanner.malformed(expected)),
        };
        // Whatever stands for one with a fault: nothing is made of the text.
        let number = self.faults.note(number)?.unwrap_or_default();
        self.scanner.advance()?;
        Ok(number)
    }

    fn expect(&mut self, mark: u8, expected: &'static str) -> Result<(), ReadError> {
        if self.scanner.token != Token::Mark(mark) {
            return Err(self.scanner.malformed(expected));
        }
        self.scanner.advance()
    }
}

const NAMES: [&str; 10] = [
    "POINT",
    "MULTIPOINT",
    "LINESTRING",
    "MULTILINESTRING",
    "POLYGON",
    "MULTIPOLYGON",
    "TRIANGLE",
    "TIN",
    "POLYHEDRALSURFACE",
    "GEOMETRYCOLLECTION",
];

#[derive(Clone, Debug, PartialEq)]
enum Token {
    /// A word or number.
    Word(String),
    /// One of `(`, `)`, `,`, `;`, `=`.
    Mark(u8),
    End,
}

/// Cuts a text into tokens, of which it holds one.
struct Scanner<R> {
    reader: R,
    file: String,
    token: Token,
    /// The line of the token, from 1.
    line: u64,
    /// The line that has been reached.
    reached: u64,
    /// Whether the outermost geometry is a collection.
    was_collection: bool,
}

impl<R: BufRead> Scanner<R> {
    /// A scanner at the first token.
    fn new(reader: R, file: &str) -> Result<Self, ReadError> {
        let (line, reached) = (1, 1);
        let token = Token::End;
        let mut scanner = Self { reader, file: file.to_owned(), token, line, reached, was_collection: false };
        scanner.advance()?;
        if let Token::Word(word) = &mut scanner.token
            && let Some(rest) = word.strip_prefix('\u{feff}')
        {
            *word = rest.to_owned();
            if word.is_empty() {
                scanner.advance()?;
            }
        }
        Ok(scanner)
    }

    fn advance(&mut self) -> Result<(), ReadError> {
        let mut word = Vec::new();
        while let Some(byte) = self.peek()? {
            let mark = matches!(byte, b'(' | b')' | b',' | b';' | b'=');
            if !word.is_empty() && (mark || byte.is_ascii_whitespace()) {
                break;
            }
            self.reader.consume(1);
            self.reached += u64::from(byte == b'\n');
            if mark {
                self.line = self.reached;
                self.token = Token::Mark(byte);
                return Ok(());
            }
            if !byte.is_ascii_whitespace() {
                self.line = self.reached;
                word.push(byte);
            }
            if word.len() > MAX_WORD {
                return Err(ReadError::LineTooLong {
                    file: self.file.clone(),
                    line: self.line,
                    limit: MAX_WORD,
                });
            }
        }
        self.token = if word.is_empty() {
            self.line = self.reached;
            Token::End
        } else {
            let not_text = |_| ReadError::NotUtf8 { file: self.file.clone(), line: self.line };
            Token::Word(String::from_utf8(word).map_err(not_text)?)
        };
        Ok(())
    }

    fn peek(&mut self) -> Result<Option<u8>, ReadError> {
        loop {
            match self.reader.fill_buf() {
                Ok(buffer) => return Ok(buffer.first().copied()),
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => {}
                Err(source) => return Err(ReadError::Io { file: self.file.clone(), source }),
            }
        }
    }

    /// Whether the token is that word, in upper or lower case.
    fn is_word(&self, expected: &str) -> bool {
        matches!(&self.token, Token::Word(word) if word.eq_ignore_ascii_case(expected))
    }

    fn malformed(&self, expected: &'static str) -> ReadError {
        let found = match &self.token {
            Token::Word(word) => quote(word),
            Token::Mark(mark) => format!("\"{}\"", char::from(*mark)),
            Token::End => "the end of the file".to_owned(),
        };
        ReadError::Malformed { file: self.file.clone(), line: self.line, column: 0, expected, found }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::Pslg;

    fn read(text: &str) -> Result<Pslg, ReadError> {
        read_wkt(text.as_bytes(), "f").map(|features| features.pslg)
    }

    #[test]
    fn third_coordinates_are_heights_but_for_measures() {
        for (text, expected) in [
            ("POINT (1 2 3) POINT ZM (4 5 6 7)", Some(vec![3.0, 6.0])),
            ("POINTZ (1 2 3)", Some(vec![3.0])),
            ("POINT M (1 2 3) POINTM (4 5 6)", None),
            ("MULTIPOINT Z (1 2 0, 4 5 0)", None),
        ] {
            let heights = read_wkt(text.as_bytes(), "f").unwrap().heights("f").unwrap();
            assert_eq!(heights, expected, "{text}");
        }
    }

    #[test]
    fn geometries_of_every_kind() {
        for (text, points, segments, polygons) in [
            ("", 0, 0, 0),
            ("POINT EMPTY", 0, 0, 0),
            ("point(1 2)", 1, 0, 0),
            ("\u{feff}POINT ZM (1 2 3 4)\nPOINTZ (1 2 4)", 1, 0, 0),
            ("MULTIPOINT (1 2, (3 4), 5 6)", 3, 0, 0),
            ("SRID=4326;LINESTRING (1 2, 3 4,\n\t5 6 ) ; POINT(1e0 2.)", 3, 2, 0),
            ("MULTILINESTRING ((1 2, 3 4), EMPTY, (3 4, 1 2))", 2, 1, 0),
            ("POLYGON ((0 0, 4 0, 0 4, 0 0), (1 1, 2 1, 1 2, 1 1))", 6, 6, 1),
            ("MULTIPOLYGON (((0 0, 4 0, 0 4, 0 0)), ((4 0, 4 4, 0 4, 4 0)))", 4, 5, 2),
            ("TIN Z (((0 0 1, 4 0 1, 0 4 1, 0 0 1)), ((4 0 1, 4 4 1, 0 4 1, 4 0 1)))", 4, 5, 2),
            ("GEOMETRYCOLLECTION (POINT (1 2), GEOMETRYCOLLECTION (POINT M (2 3 4), POINT EMPTY))", 2, 0, 0),
        ] {
            let pslg = read(text).unwrap();
            let found = (pslg.points.len(), pslg.segments.len(), pslg.polygons.len());
            assert_eq!(found, (points, segments, polygons), "{text}");
        }
        let pslg = read("GEOMETRYCOLLECTION (POINT (1 2), MULTIPOINT (3 4, 5 6)) POINT (7 8)").unwrap();
        assert_eq!(pslg.point_markers, [1, 2, 2, 3]);
    }

    #[test]
    fn faults_have_lines() {
        for (text, message) in [
            ("POINT", "f:1: expected \"(\" or EMPTY, found the end of the file"),
            ("\nCIRCLE (1 2)", "f:2: expected the name of a geometry, found \"CIRCLE\""),
            ("POINT (1\n,2)", "f:2: expected the y coordinate, found \",\""),
            ("POINT (1 2 3 4 5)", "f:1: expected \",\" or \")\", found \"5\""),
            ("LINESTRING (1 2,\n\n 3 x)", "f:3: expected the y coordinate, found \"x\""),
            ("LINESTRING (1 2, inf 0)", "f:1: coordinate inf of point 1 is not finite"),
            (
                "LINESTRING (a 2, 3 b,\n c d, 1 2), POINT (e f",
                "f:1: expected the x coordinate, found \"a\"\nf:1: expected the y coordinate, found \"b\"\n\
                 f:2: expected the x coordinate, found \"c\"\nf:2: expected the y coordinate, found \"d\"\n\
                 f:2: expected the x coordinate, found \"e\"\nand 1 more of this kind",
            ),
            ("POLYGON (1 2, 3 4)", "f:1: expected \"(\" or EMPTY, found \"1\""),
            ("POINT (1 2))", "f:1: expected the name of a geometry, found \")\""),
            ("SRID 4326;POINT (1 2)", "f:1: expected \"=\" after SRID, found \"4326\""),
        ] {
            assert_eq!(read(text).unwrap_err().to_string(), message);
        }
        let deep = "GEOMETRYCOLLECTION (".repeat(100_000);
        let message = "f:1: expected collections nested less deeply, found \"GEOMETRYCOLLECTION\"";
        assert_eq!(read(&deep).unwrap_err().to_string(), message);
        let endless = std::io::BufReader::new(std::io::repeat(b'1'));
        assert!(matches!(read_wkt(endless, "f"), Err(ReadError::LineTooLong { .. })));
    }
}
