//! The `hexdel` program.

fn main() {}
