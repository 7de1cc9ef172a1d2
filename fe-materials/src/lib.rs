//! fe-materials
