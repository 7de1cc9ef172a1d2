//! Where a generated document comes from.

use std::process::Command;

/// Short name of the commit that is checked out.
pub fn commit() -> String {
    let output = Command::new("git")
        .args(["rev-parse", "--short", "HEAD"])
        .output();
    let name = output.ok().filter(|o| o.status.success());
    name.map_or_else(
        || "unknown".into(),
        |o| String::from_utf8_lossy(&o.stdout).trim().to_owned(),
    )
}
