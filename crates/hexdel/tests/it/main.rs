//! All tests of the facade but those of the records, which `cargo xtask regen` runs, in one program: it
//! links once.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[cfg(feature = "io")]
#[path = "../common/mod.rs"]
mod common;
#[cfg(all(feature = "io", feature = "serde"))]
#[path = "../common/sessions.rs"]
mod sessions;

mod bad_input;
mod compact;
mod drafts;
mod dual_edges;
mod fewest;
mod graph_sizes;
mod graphs;
mod monitor;
mod oracle;
mod poisson;
mod polygon_domains;
mod polygons;
mod promises;
mod properties;
mod session;
mod session_graphs;
mod session_options;
mod sizes;
mod spade;
mod template_session;
