//! The data arrays of VTK's XML formats: text, base64 or appended, compressed or not.
//!
//! A binary array is a block of bytes with its length before it, an unsigned integer of
//! 32 or 64 bits. A compressed one has the number of blocks, the length of a block, that
//! of the last one (0 if it is full), the compressed length of each, and the blocks. In
//! base64 the lengths may be encoded for themselves, with padding in the middle.
//!
//! Values are held as their bytes and read as doubles: every index and marker fits,
//! larger integers are none. Memory grows with what a file holds, compressed data with
//! what they decompress to, at most a thousandfold, and twice that where arrays share
//! their bytes.

use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;

const SHORT: &str = "an array is shorter than it says";

/// How a file stores its arrays.
pub(crate) struct Encoding {
    big_endian: bool,
    /// Bytes of a length: 4 or 8.
    header: usize,
    compressed: bool,
    /// Whether appended data are raw rather than base64.
    pub(crate) appended_raw: bool,
}

impl Encoding {
    pub(crate) fn new(
        byte_order: Option<&str>,
        header_type: Option<&str>,
        compressor: Option<&str>,
    ) -> Result<Self, String> {
        let big_endian = match byte_order {
            None | Some("LittleEndian") => false,
            Some("BigEndian") => true,
            Some(other) => return Err(format!("unknown byte order {other:?}")),
        };
        let header = match header_type {
            None | Some("UInt32") => 4,
            Some("UInt64") => 8,
            Some(other) => return Err(format!("unknown header type {other:?}")),
        };
        let compressed = match compressor {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => return Err(format!("compressor {other:?} is not known here, zlib is")),
        };
        Ok(Self { big_endian, header, compressed, appended_raw: true })
    }

    /// An unsigned integer of the header's size.
    fn length(&self, bytes: &[u8]) -> Option<u64> {
        let bytes = bytes.get(..self.header)?;
        let fold = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
        Some(if self.big_endian { bytes.iter().fold(0, fold) } else { bytes.iter().rev().fold(0, fold) })
    }

    /// The length of a block with its lengths, which are there.
    fn total(&self, bytes: &[u8]) -> Option<usize> {
        let first = usize::try_from(self.length(bytes)?).ok()?;
        if !self.compressed {
            return first.checked_add(self.header);
        }
        let start = first.checked_add(3)?.checked_mul(self.header)?;
        let lengths = bytes.get(3 * self.header..start)?.chunks_exact(self.header);
        lengths
            .map(|length| self.length(length))
            .try_fold(start, |sum, length| sum.checked_add(usize::try_from(length?).ok()?))
    }

    /// The values' bytes in a block with its lengths before it.
    fn block(&self, bytes: &[u8]) -> Result<Vec<u8>, String> {
        let first = self.length(bytes).ok_or(SHORT)?;
        if !self.compressed {
            let end = usize::try_from(first).ok().and_then(|length| self.header.checked_add(length));
            let data = end.and_then(|end| bytes.get(self.header..end));
            return data.map(<[u8]>::to_vec).ok_or_else(|| SHORT.to_owned());
        }
        let lengths = |i: usize| self.length(bytes.get(i.checked_mul(self.header)?..)?);
        let blocks = usize::try_from(first).map_err(|_| SHORT)?;
        let mut at = blocks.checked_add(3).and_then(|n| n.checked_mul(self.header)).ok_or(SHORT)?;
        if blocks == 0 {
            return Ok(Vec::new());
        }
        let (full, last) = (lengths(1).ok_or(SHORT)?, lengths(2).ok_or(SHORT)?);
        let mut out = Vec::new();
        for block in 0..blocks {
            let length = lengths(3 + block).and_then(|length| usize::try_from(length).ok()).ok_or(SHORT)?;
            let end = at.checked_add(length).ok_or(SHORT)?;
            let data = bytes.get(at..end).ok_or(SHORT)?;
            let expected = if block + 1 == blocks && last > 0 { last } else { full };
            let before = out.len();
            // One byte more would show that there is too much.
            let limited = ZlibDecoder::new(data).take(expected.saturating_add(1)).read_to_end(&mut out);
            limited.map_err(|error| format!("compressed data: {error}"))?;
            if (out.len() - before) as u64 != expected {
                return Err("compressed data are not as long as they say".to_owned());
            }
            at = end;
        }
        Ok(out)
    }
}

/// The type of an array's values.
#[derive(Clone, Copy)]
pub(crate) struct Kind {
    float: bool,
    signed: bool,
    bytes: usize,
}

impl Kind {
    fn new(name: Option<&str>) -> Result<Self, String> {
        let kind = |float, signed, bytes| Ok(Self { float, signed, bytes });
        match name.unwrap_or_default() {
            "Float32" => kind(true, true, 4),
            "Float64" => kind(true, true, 8),
            "Int8" => kind(false, true, 1),
            "Int16" => kind(false, true, 2),
            "Int32" => kind(false, true, 4),
            "Int64" => kind(false, true, 8),
            "UInt8" => kind(false, false, 1),
            "UInt16" => kind(false, false, 2),
            "UInt32" => kind(false, false, 4),
            "UInt64" => kind(false, false, 8),
            other => Err(format!("unknown type {other:?} of an array")),
        }
    }

    /// The value of as many bytes.
    fn value(self, bytes: &[u8], big_endian: bool) -> f64 {
        let fold = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
        let bits = if big_endian { bytes.iter().fold(0, fold) } else { bytes.iter().rev().fold(0, fold) };
        match (self.float, self.bytes) {
            (true, 4) => f64::from(f32::from_bits(bits as u32)),
            (true, _) => f64::from_bits(bits),
            (false, n) if self.signed => {
                let shift = 64 - 8 * n as u32;
                ((bits << shift) as i64 >> shift) as f64
            }
            _ => bits as f64,
        }
    }
}

/// The values of an array.
pub(crate) enum Values {
    Numbers(Vec<f64>),
    /// Whole values of a kind, one after the other.
    Bytes {
        bytes: Vec<u8>,
        kind: Kind,
        big_endian: bool,
    },
}

impl Values {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Numbers(numbers) => numbers.len(),
            Self::Bytes { bytes, kind, .. } => bytes.len() / kind.bytes,
        }
    }

    pub(crate) fn get(&self, index: usize) -> f64 {
        match self {
            Self::Numbers(numbers) => numbers[index],
            Self::Bytes { bytes, kind, big_endian } => {
                let at = index * kind.bytes;
                kind.value(&bytes[at..at + kind.bytes], *big_endian)
            }
        }
    }
}

/// An array of a file.
pub(crate) struct Array {
    kind: Kind,
    content: Content,
}

enum Content {
    Text(Vec<f64>),
    /// Base64 as it stands, without white space.
    Base64(Vec<u8>),
    /// Where it begins in the appended data.
    Appended(usize),
}

impl Array {
    pub(crate) fn new(
        kind: Option<&str>,
        format: Option<&str>,
        offset: Option<&str>,
    ) -> Result<Self, String> {
        let content = match format {
            None | Some("ascii") => Content::Text(Vec::new()),
            Some("binary") => Content::Base64(Vec::new()),
            Some("appended") => {
                let offset = offset.and_then(|text| text.trim_ascii().parse().ok());
                Content::Appended(offset.ok_or("an appended array without its offset")?)
            }
            Some(other) => return Err(format!("unknown format {other:?} of an array")),
        };
        Ok(Self { kind: Kind::new(kind)?, content })
    }

    /// Adds a piece of the text between the array's tags.
    pub(crate) fn text(&mut self, text: &[u8]) -> Result<(), String> {
        match &mut self.content {
            Content::Text(values) => {
                for word in text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()) {
                    let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
                    let number = number.ok_or_else(|| {
                        let word = String::from_utf8_lossy(&word[..word.len().min(40)]);
                        format!("expected a number, found {word:?}")
                    })?;
                    values.push(number);
                }
            }
            Content::Base64(letters) => {
                letters.extend(text.iter().filter(|b| !b.is_ascii_whitespace()));
            }
            Content::Appended(_) => {}
        }
        Ok(())
    }

    /// The array's values.
    pub(crate) fn values(self, encoding: &Encoding, appended: &mut Appended) -> Result<Values, String> {
        let bytes = match self.content {
            Content::Text(values) => return Ok(Values::Numbers(values)),
            Content::Base64(letters) if letters.is_empty() => return Ok(Values::Numbers(Vec::new())),
            Content::Base64(letters) => encoding.block(&from_base64(&letters, usize::MAX)?)?,
            Content::Appended(offset) => appended.block(offset, encoding)?,
        };
        if !bytes.len().is_multiple_of(self.kind.bytes) {
            return Err(format!("the length must be a whole number of values, got {} bytes", bytes.len()));
        }
        Ok(Values::Bytes { bytes, kind: self.kind, big_endian: encoding.big_endian })
    }
}

/// The bytes that arrays are cut from.
pub(crate) struct Appended {
    bytes: Vec<u8>,
    /// How many bytes arrays may still take: a file whose arrays share their bytes
    /// many times over would else take far more memory than it has bytes.
    left: usize,
}

impl Appended {
    pub(crate) fn new(bytes: Vec<u8>) -> Self {
        let left = bytes.len().saturating_mul(2);
        Self { bytes, left }
    }

    /// The values' bytes of the array at `offset`.
    fn block(&mut self, offset: usize, encoding: &Encoding) -> Result<Vec<u8>, String> {
        let rest = self.bytes.get(offset..).ok_or("an offset beyond the appended data")?;
        // Lengths first: they tell how much of the rest is the array's.
        let lengths = |size: usize| {
            if encoding.appended_raw {
                return Ok(rest[..size.min(rest.len())].to_vec());
            }
            from_base64(rest, size)
        };
        let mut size = encoding.header;
        if encoding.compressed {
            let blocks = encoding.length(&lengths(size)?).unwrap_or(0).min(rest.len() as u64) as usize;
            size = (blocks + 3) * encoding.header;
        }
        let total = encoding.total(&lengths(size)?).filter(|&total| total <= rest.len());
        let total = total.ok_or(SHORT)?;
        match self.left.checked_sub(total.max(size)) {
            Some(left) => self.left = left,
            None => return Err("arrays overlap in the appended data".to_owned()),
        }
        encoding.block(&lengths(total)?)
    }
}

/// Decodes the first letters, to `size` bytes or a few more, with padding in the
/// middle or not, up to the first that is no letter.
fn from_base64(letters: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let is_letter = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'+' | b'/' | b'=');
    let mut rest = letters;
    let mut bytes = Vec::with_capacity((letters.len() / 4 * 3).min(size));
    while !rest.is_empty() && bytes.len() < size {
        let wanted = (size - bytes.len()).div_ceil(3).saturating_mul(4).min(rest.len());
        let part = &rest[..wanted];
        let end = part.iter().position(|b| !is_letter(b));
        let part = &part[..end.unwrap_or(wanted)];
        // Padding ends a group of four.
        let padding = part.iter().position(|&b| b == b'=');
        let part = &part[..padding.map_or(part.len(), |at| (at / 4 + 1) * 4).min(part.len())];
        bytes.extend(STANDARD.decode(part).map_err(|error| format!("base64: {error}"))?);
        if part.is_empty() {
            break;
        }
        rest = &rest[part.len()..];
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_all_types() {
        let value = |name, bytes: &[u8]| Kind::new(Some(name)).unwrap().value(bytes, false);
        assert_eq!(value("Int8", &[0xff]), -1.0);
        assert_eq!(value("UInt8", &[0xff]), 255.0);
        assert_eq!(value("Int16", &[0xfe, 0xff]), -2.0);
        assert_eq!(value("Int64", &(-5i64).to_le_bytes()), -5.0);
        assert_eq!(value("UInt32", &7u32.to_le_bytes()), 7.0);
        assert_eq!(value("Float32", &0.5f32.to_le_bytes()), 0.5);
        assert_eq!(value("Float64", &5e-324f64.to_le_bytes()), 5e-324);
        assert_eq!(Kind::new(Some("Int32")).unwrap().value(&(-9i32).to_be_bytes(), true), -9.0);
        assert!(Kind::new(Some("String")).is_err());
    }

    #[test]
    fn padding_may_stand_in_the_middle() {
        let letters =
            [STANDARD.encode([1, 2, 3, 4]), STANDARD.encode([5]), STANDARD.encode([6, 7, 8])].concat();
        let all = usize::MAX;
        assert_eq!(from_base64(letters.as_bytes(), all).unwrap(), [1, 2, 3, 4, 5, 6, 7, 8]);
        assert_eq!(from_base64(letters.as_bytes(), 5).unwrap(), [1, 2, 3, 4, 5]);
        assert_eq!(from_base64(b"AQID</AppendedData>", all).unwrap(), [1, 2, 3]);
        for bad in [&b"A"[..], b"=", b"A==="] {
            assert!(from_base64(bad, all).is_err());
        }
    }

    #[test]
    fn lengths_that_lie() {
        for compressor in [None, Some("vtkZLibDataCompressor")] {
            for header in ["UInt32", "UInt64"] {
                let encoding = Encoding::new(None, Some(header), compressor).unwrap();
                for bytes in [&[][..], &[1; 3], &[0xff; 8], &[0xff; 64], &[1; 64]] {
                    assert!(encoding.block(bytes).is_err(), "{bytes:?}");
                }
            }
        }
        let mut encoding = Encoding::new(None, None, None).unwrap();
        for raw in [true, false] {
            encoding.appended_raw = raw;
            let bytes = if raw { vec![1, 0, 0, 0, 9] } else { STANDARD.encode([1, 0, 0, 0, 9]).into_bytes() };
            let mut appended = Appended::new(bytes);
            let taken = (0..100).take_while(|_| appended.block(0, &encoding).is_ok_and(|b| b == [9])).count();
            assert!((1..20).contains(&taken), "{taken} arrays of the same bytes");
            assert!(appended.block(99, &encoding).is_err());
        }
        assert_eq!(encoding.block(&[1, 0, 0, 0, 9]).unwrap(), [9]);
        assert!(Encoding::new(Some("Middle"), None, None).is_err());
        assert!(Encoding::new(None, Some("UInt16"), None).is_err());
        assert!(Encoding::new(None, None, Some("vtkLZ4DataCompressor")).is_err());
    }
}
