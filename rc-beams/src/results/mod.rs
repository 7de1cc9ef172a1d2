//! What a run leaves behind: tables, pictures, summary, progress.
//!
//! Everything here takes plain data; nothing knows a model. One folder per beam holds
//! `history.csv`, `gauges.csv`, `newton.csv`, `events.csv` and `sheets.csv`, complete up to the last accepted
//! step at any time, and `curve.svg`, `curve.png`, `crack.svg`, `slip.svg`, `sheet.svg`, `sheet_map.csv` and
//! `summary.json`, each whole or absent. A [`report`] puts the folders of several beams side by side.

pub mod checkpoint;
mod claim;
pub mod crack;
pub mod curve;
pub mod drawing;
pub mod error;
pub mod events;
pub mod evidence;
pub mod folder;
pub mod growing;
pub mod hash;
pub mod history;
pub mod interrupt;
pub mod mode;
pub mod numerical_error;
pub mod palette;
pub mod progress;
pub mod report;
pub mod resources;
pub mod sheets;
mod side_view;
mod strip;
pub mod summary;
mod table;
