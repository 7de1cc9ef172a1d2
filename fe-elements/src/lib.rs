//! fe-elements
