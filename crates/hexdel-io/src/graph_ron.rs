//! Planar straight-line graphs in Rusty Object Notation: what serde makes of a
//! [`Pslg`].

use std::io::{self, Write};

use hexdel_geom::Pslg;

use crate::error::ReadError;
use crate::graph_json::GraphDocument;
use crate::json::Source;
use crate::mesh_ron::{parse_ron, to_ron};

/// Reads a PSLG.
pub(crate) fn read_graph_ron(source: &Source<'_>) -> Result<Pslg, ReadError> {
    parse_ron::<GraphDocument>(source)?.graph(source.file)
}

/// Writes a PSLG.
pub(crate) fn write_graph_ron(out: &mut dyn Write, pslg: &Pslg) -> io::Result<()> {
    to_ron(out, pslg)
}
