//! The folder that holds the results of one beam.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tempfile::{Builder, NamedTempFile};

use super::claim::Claim;
use super::error::ResultsError;
use super::growing::Growing;
use crate::output::{self, OutputError};

/// Files written at the end of a run or not by every run; those of an earlier run would contradict the
/// tables of this one.
const NOT_STARTED_ANEW: [&str; 12] = [
    "checkpoint.json",
    "checkpoint.bin",
    "summary.json",
    "curve.svg",
    "curve.png",
    "crack.svg",
    "slip.svg",
    "sheet.svg",
    "sheet_map.csv",
    "sheets.csv",
    "events.csv",
    "fields.pvd",
];

/// How names of files begin until they are written whole.
const DRAFT: &str = ".draft-";

/// A folder known to be writable, and claimed if a run writes into it.
#[derive(Debug, Clone)]
pub struct Folder {
    path: PathBuf,
    _claim: Option<Arc<Claim>>,
    /// Whether the run in it is continued.
    resumed: bool,
}

impl Folder {
    /// Makes `root/name` with its parents if missing, tries to write there, and removes what the end of
    /// an earlier run left.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`] when the folder cannot be made or written, or another run writes into it.
    pub fn create(root: &Path, name: &str) -> Result<Self, ResultsError> {
        let folder = Self::open(&root.join(name))?.claimed()?;
        for file in NOT_STARTED_ANEW {
            folder.remove(file)?;
        }
        folder.remove_drafts()?;
        folder.remove_fields()?;
        Ok(folder)
    }

    /// Removes what a run that was killed left half-written.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn remove_drafts(&self) -> Result<(), ResultsError> {
        self.sweep(|name| name.starts_with(DRAFT))
    }

    /// Removes fields, which are to be written anew.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn remove_fields(&self) -> Result<(), ResultsError> {
        self.sweep(|name| {
            let stem = name
                .strip_prefix("fields_")
                .and_then(|n| n.strip_suffix(".vtu"));
            // `fields_0001.vtu`, `fields_bars_0001.vtu`: what else is there is somebody else's.
            let number = stem.and_then(|stem| stem.rsplit('_').next());
            number.is_some_and(|n| n.len() >= 4 && n.bytes().all(|c| c.is_ascii_digit()))
        })
    }

    fn sweep(&self, stale: fn(&str) -> bool) -> Result<(), ResultsError> {
        for entry in fs::read_dir(&self.path).map_err(|e| self.error("", e))? {
            let name = entry.map_err(|e| self.error("", e))?.file_name();
            let name = name.to_string_lossy();
            if stale(&name) {
                self.remove(&name)?;
            }
        }
        Ok(())
    }

    /// A folder that is there, with all that it holds; tries to write there.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`] when it cannot be written.
    pub fn open(path: &Path) -> Result<Self, ResultsError> {
        output::prepare(path)?;
        Ok(Self {
            path: path.into(),
            _claim: None,
            resumed: false,
        })
    }

    fn claimed(self) -> Result<Self, ResultsError> {
        let claim = Claim::on(&self.path).map_err(|e| self.error("", e))?;
        Ok(Self {
            _claim: Some(Arc::new(claim)),
            ..self
        })
    }

    /// A folder whose run is continued: [`Self::start`] keeps what its files hold.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`] when it cannot be written, or another run writes into it.
    pub fn resume(path: &Path) -> Result<Self, ResultsError> {
        Ok(Self {
            resumed: true,
            ..Self::open(path)?.claimed()?
        })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Opens a file that grows during the run; an older one is emptied, unless the run is continued.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn start(&self, name: &str) -> Result<Growing, ResultsError> {
        let path = self.path.join(name);
        let file = if self.resumed {
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            options.open(path).and_then(Growing::continued)
        } else {
            File::create(path).map(Growing::empty)
        };
        file.map_err(|e| self.error(name, e))
    }

    /// Removes a file, if it is there.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn remove(&self, name: &str) -> Result<(), ResultsError> {
        remove_if_there(&self.path.join(name)).map_err(|e| self.error(name, e))
    }

    /// Writes a file as a whole: readers see the old content or the new, never a part.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`], also for what `write` returns; the old content stays.
    pub fn replace(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), ResultsError> {
        self.replace_by_path(name, |path| {
            let mut out = BufWriter::new(File::create(path)?);
            write(&mut out)?;
            out.flush()
        })
    }

    /// As [`Self::replace`], for writers that open the file themselves. The path they are given ends like
    /// `name`.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`], also for what `write` returns; the old content stays.
    pub fn replace_by_path(
        &self,
        name: &str,
        write: impl FnOnce(&Path) -> io::Result<()>,
    ) -> Result<(), ResultsError> {
        let replace = || {
            let draft = self.draft(name)?;
            write(draft.path())?;
            draft.persist(self.path.join(name))?;
            Ok(())
        };
        replace().map_err(|e| self.error(name, e))
    }

    /// What a file of the folder suffers from.
    pub(super) fn error(&self, name: &str, source: io::Error) -> ResultsError {
        let path = self.path.join(name);
        OutputError { path, source }.into()
    }

    /// A file to be renamed to `name`, as readable by others as any new file.
    fn draft(&self, name: &str) -> io::Result<NamedTempFile> {
        let mut builder = Builder::new();
        builder.prefix(DRAFT);
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        builder.suffix(name).tempfile_in(&self.path)
    }
}

fn remove_if_there(file: &Path) -> io::Result<()> {
    match fs::remove_file(file) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => Err(e),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    //! Protects results already on disk, and the promise that nothing runs before the folder is known to
    //! be writable.
    use super::*;

    #[test]
    fn a_folder_below_a_file_is_refused_with_its_path_and_a_remedy() {
        let file = NamedTempFile::new().unwrap();
        let error = Folder::create(file.path(), "A-SO3-1").unwrap_err();
        assert!(error.to_string().contains("A-SO3-1"), "{error}");
        let help = miette::Diagnostic::help(&error).unwrap().to_string();
        assert!(help.contains("--output"), "{help}");
    }

    #[test]
    fn a_failed_replacement_keeps_the_old_file_and_leaves_no_draft() {
        let root = tempfile::tempdir().unwrap();
        let folder = Folder::create(root.path(), "beam").unwrap();
        folder
            .replace("summary.json", |out| out.write_all(b"old"))
            .unwrap();
        let failed = folder.replace("summary.json", |out| {
            out.write_all(b"half of the new")?;
            Err(io::Error::other("disk full"))
        });
        assert!(
            io::Error::from(failed.unwrap_err())
                .to_string()
                .contains("disk full")
        );
        let files: Vec<_> = fs::read_dir(folder.path()).unwrap().collect();
        assert_eq!(files.len(), 2, "the old file and the claim");
        assert_eq!(
            fs::read(folder.path().join("summary.json")).unwrap(),
            b"old"
        );
    }

    #[test]
    fn a_new_run_removes_results_of_an_earlier_one_and_nothing_else() {
        let root = tempfile::tempdir().unwrap();
        let folder = Folder::create(root.path(), "beam").unwrap();
        for name in ["summary.json", "sheets.csv", "fields_0007.vtu", "notes.txt"] {
            folder
                .replace(name, |out| out.write_all(b"earlier"))
                .unwrap();
        }
        let error = Folder::create(root.path(), "beam").unwrap_err();
        let error = io::Error::from(error).to_string();
        assert!(error.contains("another run"), "{error}");
        assert!(folder.path().join("summary.json").exists());
        drop(folder);
        let folder = Folder::create(root.path(), "beam").unwrap();
        assert!(!folder.path().join("summary.json").exists());
        assert!(!folder.path().join("sheets.csv").exists());
        assert!(!folder.path().join("fields_0007.vtu").exists());
        assert!(folder.path().join("notes.txt").exists());
    }
}
