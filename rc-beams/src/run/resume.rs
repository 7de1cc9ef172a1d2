//! Where a run begins: at the start, after the last step of an interrupted one, or not at all.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use serde_json::Value;

use super::RunError;
use crate::exit::Exit;
use crate::options::RunOptions;
use crate::results::checkpoint::{Checkpoint, CheckpointError};
use crate::results::folder::Folder;

/// Where a run begins.
pub(super) enum Beginning {
    /// With these records, if any.
    From(Folder, Box<Checkpoint>),
    /// It has ended before, in this way.
    Over(Exit),
}

/// Looks for what an earlier run of the same input has left; nothing is changed.
///
/// Returns nothing for a run from the start.
fn earlier(folder: &Path, input_hash: &str) -> Result<Option<Beginning>, RunError> {
    if Checkpoint::exists(folder) {
        let folder = Folder::resume(folder)?;
        let checkpoint = Checkpoint::read(&folder, input_hash)?;
        return Ok(Some(Beginning::From(folder, Box::new(checkpoint))));
    }
    let path = folder.join("summary.json");
    let text = match fs::read(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => {
            let reason = format!("it cannot be read: {error}");
            return Err(CheckpointError { path, reason }.into());
        }
    };
    let summary: Option<Value> = serde_json::from_slice(&text).ok();
    if let Some(summary) = summary.filter(|s| s["input_hash"] == input_hash) {
        return Ok(Some(Beginning::Over(match summary["stopped_early"] {
            Value::Bool(true) => Exit::StoppedEarly,
            _ => Exit::Done,
        })));
    }
    let reason = "it is damaged, or belongs to another specimen or other options".into();
    Err(CheckpointError { path, reason }.into())
}

/// Refuses what cannot be continued, before anything is run.
pub(super) fn check(name: &str, input_hash: &str, options: &RunOptions) -> Result<(), RunError> {
    if options.resume {
        earlier(&options.output.join(name), input_hash)?;
    }
    Ok(())
}

/// Where the run of a beam begins.
pub(super) fn begin(
    name: &str,
    input_hash: &str,
    options: &RunOptions,
) -> Result<Beginning, RunError> {
    if options.resume
        && let Some(beginning) = earlier(&options.output.join(name), input_hash)?
    {
        if let Beginning::From(folder, _) = &beginning {
            folder.remove_drafts()?;
        }
        return Ok(beginning);
    }
    let folder = Folder::create(&options.output, name)?;
    let checkpoint = Checkpoint::start(&folder, input_hash)?;
    Ok(Beginning::From(folder, Box::new(checkpoint)))
}
