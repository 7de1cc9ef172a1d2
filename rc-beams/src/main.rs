//! The program `rc-beams`.

fn main() {}
