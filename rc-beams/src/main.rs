//! rc-beams
fn main() {}
