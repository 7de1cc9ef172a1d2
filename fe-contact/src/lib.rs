//! fe-contact
