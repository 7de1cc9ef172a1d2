//! fe-solver
