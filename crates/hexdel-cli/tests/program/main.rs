//! The program as its users call it: every command, exit codes, what is
//! written and what is not.

mod check;
mod generate;
mod mesh;
mod support;
