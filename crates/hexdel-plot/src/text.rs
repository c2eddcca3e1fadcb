//! Fast text output.

use std::io::{self, Write};

/// Bytes gathered before they are handed on.
const CHUNK: usize = 1 << 16;

/// Gathers text for a writer.
pub(crate) struct TextWriter<'w> {
    out: &'w mut dyn Write,
    buffer: Vec<u8>,
}

impl<'w> TextWriter<'w> {
    pub(crate) fn new(out: &'w mut dyn Write) -> Self {
        Self { out, buffer: Vec::with_capacity(2 * CHUNK) }
    }

    pub(crate) fn text(&mut self, text: &str) -> &mut Self {
        self.buffer.extend_from_slice(text.as_bytes());
        self
    }

    fn integer(&mut self, integer: u64) -> &mut Self {
        let mut digits = itoa::Buffer::new();
        self.text(digits.format(integer))
    }

    /// A number of pixels, to a hundredth.
    pub(crate) fn pixels(&mut self, pixels: f64) -> &mut Self {
        self.hundredths((pixels * 100.0).round() as i64)
    }

    /// A hundredth of an integer.
    pub(crate) fn hundredths(&mut self, hundredths: i64) -> &mut Self {
        if hundredths < 0 {
            self.text("-");
        }
        let magnitude = hundredths.unsigned_abs();
        self.integer(magnitude / 100);
        match magnitude % 100 {
            0 => self,
            tenths if tenths % 10 == 0 => self.text(".").integer(tenths / 10),
            rest if rest < 10 => self.text(".0").integer(rest),
            rest => self.text(".").integer(rest),
        }
    }

    /// Hands the text on if there is enough of it. To be called often.
    pub(crate) fn breathe(&mut self) -> io::Result<()> {
        if self.buffer.len() >= CHUNK {
            self.finish()?;
        }
        Ok(())
    }

    /// Hands all text on.
    pub(crate) fn finish(&mut self) -> io::Result<()> {
        self.out.write_all(&self.buffer)?;
        self.buffer.clear();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_have_at_most_two_decimals() {
        for (pixels, text) in [
            (0.0, "0"),
            (-0.001, "0"),
            (12.0, "12"),
            (1.5, "1.5"),
            (-0.05, "-0.05"),
            (3.149, "3.15"),
            (99.999, "100"),
        ] {
            let mut out = Vec::new();
            TextWriter::new(&mut out).pixels(pixels).finish().unwrap();
            assert_eq!(out, text.as_bytes());
        }
    }
}
