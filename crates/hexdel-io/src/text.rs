//! Fast text output of numbers.
//!
//! Doubles are written as the shortest decimal that reads back to the same bits
//! (the crate `zmij`), with no formatting machinery per number.

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

    pub(crate) fn integer(&mut self, integer: impl itoa::Integer) -> &mut Self {
        let mut digits = itoa::Buffer::new();
        self.text(digits.format(integer))
    }

    /// A number, shortest round trip.
    pub(crate) fn number(&mut self, number: f64) -> &mut Self {
        let mut digits = zmij::Buffer::new();
        self.text(digits.format(number))
    }

    /// A position as a JSON array.
    pub(crate) fn position(&mut self, p: hexdel_geom::DVec2) -> &mut Self {
        self.text("[").number(p.x).text(", ").number(p.y).text("]")
    }

    /// The items of a JSON array, each on a line of its own.
    pub(crate) fn rows<T>(
        &mut self,
        items: impl IntoIterator<Item = T>,
        mut write: impl FnMut(&mut Self, T),
    ) -> io::Result<()> {
        for (i, item) in items.into_iter().enumerate() {
            self.text(if i == 0 { "\n" } else { ",\n" });
            write(self, item);
            self.breathe()?;
        }
        Ok(())
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
