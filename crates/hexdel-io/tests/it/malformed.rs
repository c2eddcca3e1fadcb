//! Every way a file can be wrong is a typed error with its line.

use std::io::{BufReader, Read};

use hexdel_io::PointFormat::{self, Node, Poly, Table};
use hexdel_io::{PointReader, ReadError, read_mesh_pair, read_points_from};

fn error(format: PointFormat, text: &[u8]) -> ReadError {
    match read_points_from(text, format, "f") {
        Err(error) => error,
        Ok(pslg) => panic!("{:?} was read as {pslg:?}", String::from_utf8_lossy(text)),
    }
}

/// Asserts the message, which holds the line and all of the error's data, and that
/// the error is of one variant.
macro_rules! assert_error {
    ($format:expr, $text:expr, $variant:ident, $message:expr) => {
        let error = error($format, $text.as_ref());
        assert!(matches!(error, ReadError::$variant { .. }), "{error:?} for {:?}", $text);
        assert_eq!(error.to_string(), $message);
        let line = $message.split(':').nth(1).and_then(|l| l.parse().ok());
        assert_eq!(error.line(), line.filter(|&l: &u64| l > 0));
    };
}

#[test]
fn headers() {
    assert_error!(Node, "", MissingSection, "f:0: file ends before the number of points");
    assert_error!(Node, "# a\n\n# b\n", MissingSection, "f:0: file ends before the number of points");
    assert_error!(Node, "\n# c\nmany 2", Malformed, "f:3: expected the number of points, found \"many\"");
    assert_error!(Node, "-1 2 0 0", Malformed, "f:1: expected the number of points, found \"-1\"");
    assert_error!(Node, "1.5 2 0 0", Malformed, "f:1: expected the number of points, found \"1.5\"");
    assert_error!(Node, "1 3 0 0\n0 1 2 3", Malformed, "f:1: expected dimension 2, found \"3\"");
    assert_error!(Node, "1 2 x 0", Malformed, "f:1: expected the number of attributes, found \"x\"");
    assert_error!(Node, "1 2 0 2", Malformed, "f:1: expected 0 or 1 boundary markers, found \"2\"");
    assert_error!(Node, "1 2 0 0 7", Malformed, "f:1: expected end of line, found \"7\"");
    assert_error!(Poly, "0 2\n", PointsElsewhere, "f:1: the points are in another file");
}

/// Rows must have as many attributes as the header says, however many that are; only a few
/// that are missing are filled in.
#[test]
fn attributes_are_as_many_as_announced() {
    let row = |count: usize| format!("1 2 3000\n0 0.5 1{}\n", " 7".repeat(count));
    let pslg = read_points_from(row(3000).as_bytes(), Node, "f").unwrap();
    assert_eq!((pslg.attributes_per_point, pslg.attributes(0)), (3000, &vec![7.0; 3000][..]));
    assert_error!(Node, row(2999), Malformed, "f:2: expected an attribute, found end of line");
    let lenient = |text: &str| PointReader::new().read_from(text.as_bytes(), Node, "f");
    let filled = lenient("1 2 16\n0 0.5 1 7\n").unwrap();
    assert_eq!(
        (filled.pslg.attributes(0)[0], filled.pslg.attributes(0)[15], filled.warnings.len()),
        (7.0, 0.0, 1)
    );
    for (text, message) in [
        ("1 2 17\n0 0.5 1 7\n", "f:2: expected an attribute, found end of line"),
        // No memory is taken for what a header claims.
        ("1 2 4000000000\n0 0.5 1 7\n", "f:2: expected an attribute, found end of line"),
        ("1 2 18446744073709551615\n0 0.5 1\n", "f:2: expected an attribute, found end of line"),
        (
            "3 2 4000000000\n0 0 0\n1 1 0\n2 0 1\n",
            "f:2: expected an attribute, found end of line\nf:3: expected an attribute, found end of line\n\
             f:4: expected an attribute, found end of line",
        ),
    ] {
        assert_eq!(lenient(text).unwrap_err().to_string(), message);
    }
    assert!(lenient("0 2 4000000000\n").unwrap().pslg.points.is_empty());
}

#[test]
fn numbers() {
    assert_error!(Node, "1 2\n0 1.0 2.0e", Malformed, "f:2: expected the y coordinate, found \"2.0e\"");
    assert_error!(Node, "1 2\n0 1,5 2", Malformed, "f:2: expected the x coordinate, found \"1,5\"");
    assert_error!(Node, "1 2\n0 1.0", Malformed, "f:2: expected the y coordinate, found end of line");
    assert_error!(Node, "1 2\n0", Malformed, "f:2: expected the x coordinate, found end of line");
    assert_error!(Node, "1 2\n0 0x10 1", Malformed, "f:2: expected the x coordinate, found \"0x10\"");
    assert_error!(Node, "1 2\n0 1 2 3", Malformed, "f:2: expected end of line, found \"3\"");
    assert_error!(Node, "1 2 2 0\n0 1 2 3", Malformed, "f:2: expected an attribute, found end of line");
    assert_error!(Node, "1 2 0 1\n0 1 2", Malformed, "f:2: expected a boundary marker, found end of line");
    assert_error!(
        Node,
        "1 2 0 1\n0 1 2 3000000000",
        Malformed,
        "f:2: expected a boundary marker, found \"3000000000\""
    );
    assert_error!(Table, "1,2\n3", Malformed, "f:2: expected the y coordinate, found end of line");
    assert_error!(Table, "x,y\n1,2\n\n3,four", Malformed, "f:4: expected the y coordinate, found \"four\"");
    assert_error!(Table, "x,y\na,b", Malformed, "f:2: expected the x coordinate, found \"a\"");
    let long = format!("1 2\n0 {} 1", "é".repeat(1000));
    let message = format!("f:2: expected the x coordinate, found \"{}..\"", "é".repeat(40));
    assert_error!(Node, long, Malformed, message);
}

#[test]
fn coordinates_that_are_not_finite() {
    for found in ["NaN", "nan", "inf", "-inf", "infinity", "1e309", "-1e999"] {
        let text = format!("2 2\n1 0 0\n2 {found} 1");
        let message = format!("f:3: coordinate {found} of point 2 is not finite");
        assert_error!(Node, text, NonFinite, message);
        let text = format!("x y\n0 0\n1 {found}");
        let message = format!("f:3: coordinate {found} of point 1 is not finite");
        assert_error!(Table, text, NonFinite, message);
    }
    let poly = "1 2\n0 0 0\n0 0\n1\n0 inf 0\n";
    assert_error!(Poly, poly, NonFinite, "f:5: coordinate inf of hole 0 is not finite");
    let poly = "1 2\n0 0 0\n0 0\n0\n1\n1 0 NaN 3\n";
    assert_error!(Poly, poly, NonFinite, "f:6: coordinate NaN of region 1 is not finite");
}

#[test]
fn row_numbers() {
    assert_error!(Node, "3 2\n0 0 0\n1 0 1\n3 1 1", NonConsecutive, "f:4: expected row number 2, found 3");
    assert_error!(Node, "2 2\n1 0 0\n1 0 1", NonConsecutive, "f:3: expected row number 2, found 1");
    assert_error!(Node, "1 2\n2 0 0", NonConsecutive, "f:2: expected row number 0, found 2");
    assert_error!(Node, "1 2\n-1 0 0", NonConsecutive, "f:2: expected row number 0, found -1");
    assert_error!(Node, "1 2\n0.5 0.5", Malformed, "f:2: expected the number of the row, found \"0.5\"");
}

#[test]
fn files_that_end_early_or_late() {
    assert_error!(Node, "3 2\n0 0 0\n1 1 1\n\n", Truncated, "f:4: file ends after 2 of 3 points");
    assert_error!(
        Node,
        "1 2\n0 0 0\n# c\n1 1 1",
        TrailingRow,
        "f:4: expected the end of the file after the points, found \"1\""
    );
    assert_error!(Poly, "1 2\n0 0 0", MissingSection, "f:2: file ends before the number of segments");
    assert_error!(Poly, "1 2\n0 0 0\n1 0", Truncated, "f:3: file ends after 0 of 1 segments");
    assert_error!(Poly, "1 2\n0 0 0\n0 0\n", MissingSection, "f:3: file ends before the number of holes");
    assert_error!(Poly, "1 2\n0 0 0\n0 0\n2\n0 1 1", Truncated, "f:5: file ends after 1 of 2 holes");
    assert_error!(Poly, "1 2\n0 0 0\n0 0\n0\n1", Truncated, "f:5: file ends after 0 of 1 regions");
    assert_error!(
        Poly,
        "1 2\n0 0 0\n0 0\n0\n0\nend",
        TrailingRow,
        "f:6: expected the end of the file after the regions, found \"end\""
    );
}

#[test]
fn segments_to_points_that_are_not_there() {
    let poly = |first: u32, ends: &str| format!("2 2\n{first} 0 0\n{} 1 1\n1 0\n0 {ends}\n0\n", first + 1);
    for (first, ends, bad) in [
        (0, "0 2", 2),
        (1, "0 1", 0),
        (1, "1 3", 3),
        (0, "-1 1", -1),
        (1, "1 9223372036854775807", i64::MAX),
        (1, "-9223372036854775808 1", i64::MIN),
    ] {
        let message = format!("f:5: no point {bad}, there are 2 counted from {first}");
        assert_error!(Poly, poly(first, ends), IndexOutOfRange, message);
    }
    assert_error!(Poly, poly(0, "0"), Malformed, "f:5: expected the index of a point, found end of line");
    assert_error!(Poly, poly(0, "0 1 1"), Malformed, "f:5: expected end of line, found \"1\"");
}

#[test]
fn triangles() {
    let nodes = "3 2\n1 0 0\n2 1 0\n3 0 1\n";
    for (elements, message) in [
        ("", "e:0: file ends before the number of triangles"),
        ("1 6 0\n1 1 2 3 1 2 3", "e:1: expected 3 corners per triangle, found \"6\""),
        ("1 3 0\n1 1 2", "e:2: expected the index of a point, found end of line"),
        ("1 3 0\n1 1 2 4", "e:2: no point 4, there are 3 counted from 1"),
        ("1 3 0\n1 0 1 2", "e:2: no point 0, there are 3 counted from 1"),
        ("1 3 1\n1 1 2 3", "e:2: expected an attribute, found end of line"),
        ("2 3 0\n1 1 2 3", "e:2: file ends after 1 of 2 triangles"),
        ("1 3 0\n1 1 2 3\n2 1 2 3", "e:3: expected the end of the file after the triangles, found \"2\""),
    ] {
        let found = read_mesh_pair((nodes.as_bytes(), "n"), (elements.as_bytes(), "e"));
        assert_eq!(found.unwrap_err().to_string(), message);
    }
    let found = read_mesh_pair((&b"0 2\n"[..], "n"), (&b"1\n0 0 0 0\n"[..], "e"));
    assert!(matches!(found, Err(ReadError::IndexOutOfRange { points: 0, .. })));
}

#[test]
fn text_that_is_not_utf8() {
    assert_error!(Node, b"1 2\n0 0 0\n# caf\xe9\n", NotUtf8, "f:3: not UTF-8 text");
    assert_error!(Node, b"1 2\n0 \xff 0\n", NotUtf8, "f:2: not UTF-8 text");
    // UTF-16 with its byte order mark.
    assert_error!(Table, b"\xff\xfe1\x00,\x002\x00", NotUtf8, "f:1: not UTF-8 text");
}

#[test]
fn headers_that_claim_too_much_allocate_nothing() {
    for claim in ["4294967295", "1000000000000"] {
        let text = format!("{claim} 2 {claim} 1\n0 1 2\n");
        let found = error(Node, text.as_bytes());
        assert!(matches!(found, ReadError::Malformed { .. } | ReadError::TooMany { .. }), "{found:?}");
        let text = format!("{claim} 2\n0 1 2\n");
        let found = error(Node, text.as_bytes());
        assert!(matches!(found, ReadError::Truncated { .. } | ReadError::TooMany { .. }), "{found:?}");
    }
    assert_error!(Node, "1000000000000 2", TooMany, "f:1: more than 4294967295 points");
    assert_error!(
        Poly,
        "1 2\n0 0 0\n18446744073709551615 1\n",
        Truncated,
        "f:3: file ends after 0 of 18446744073709551615 segments"
    );
    assert_error!(
        Node,
        "18446744073709551616 2",
        Malformed,
        "f:1: expected the number of points, found \"18446744073709551616\""
    );
}

#[test]
fn a_line_without_end_is_given_up() {
    for byte in [b'1', b' ', b'#'] {
        let endless = BufReader::new(std::io::repeat(byte));
        let found = read_points_from(endless, Table, "f").unwrap_err();
        assert_eq!(found.to_string(), "f:1: line longer than 1048576 bytes");
    }
    // An endless file of short lines ends at the first that is wrong.
    let text = b"1 2\n".chain(BufReader::new(std::io::repeat(b'\0')));
    let found = read_points_from(text, Table, "f").unwrap_err();
    assert_eq!(found.line(), Some(2));
}

#[test]
fn line_ends_byte_order_marks_and_signs() {
    let variants: [&[u8]; 4] = [
        b"2 2 0 0\n0 +1 -2.\n1 .5 1e-3\n",
        b"\xef\xbb\xbf2 2 0 0\r\n0 +1 -2.\r\n1 .5 1e-3\r\n",
        b"2\r\n\r\n\t0\t+1.0e0\t-2.0#c\r\n# c\r\n1 0.5 0.001",
        b"2 2\n1 1 -2\n2 0.5 1E-3",
    ];
    for text in variants {
        let pslg = read_points_from(text, Node, "f").unwrap();
        let found: Vec<[f64; 2]> = pslg.points.iter().map(|&p| p.into()).collect();
        assert_eq!(found, [[1.0, -2.0], [0.5, 1e-3]]);
    }
    let empty = read_points_from(&b"0 2 0 0\n"[..], Node, "f").unwrap();
    assert!(empty.points.is_empty());
}
