//! The program as its users call it: every command, exit codes, what is
//! written and what is not.

#![expect(clippy::unwrap_used, reason = "a test that cannot run fails")]

mod check;
mod convert;
mod dual;
mod generate;
mod graph;
mod mesh;
mod messages;
mod ocean;
mod plot;
mod projection;
mod session;
mod streams;
mod support;
mod tables;
mod triangle;
