//! Accepted steps on disk, from which an interrupted run is continued.
//!
//! `checkpoint.bin` holds one record per accepted step: its length in bytes (u32, little endian) and the step in
//! postcard format. It only grows. `checkpoint.json` says how much of it counts, with a checksum, and is replaced as
//! a whole after every step: whenever the program is killed, the two agree or the binary file holds more.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crc32fast::Hasher;
use fe_solver::journal::Entry;
use serde::{Deserialize, Serialize};

use super::claim::CLAIM;
use super::error::ResultsError;
use super::folder::Folder;

const STEPS: &str = "checkpoint.bin";
const HEADER: &str = "checkpoint.json";

/// What `checkpoint.bin` is, and how much of it counts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Header {
    /// Program: version and checksum of the executable.
    program: String,
    /// Fingerprint of specimen and options.
    input_hash: String,
    /// Accepted steps, self weight included.
    records: usize,
    bytes: usize,
    /// CRC-32 of these bytes.
    crc32: u32,
}

/// A checkpoint that must not be used.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[error("cannot resume from {}: {reason}", path.display())]
#[diagnostic(
    code(rc_beams::resume),
    help(
        "no table was changed; give the options of the earlier run, or start the beam anew without --resume"
    )
)]
pub struct CheckpointError {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub reason: String,
}

impl CheckpointError {
    /// Of a folder whose steps do not lead where they led.
    pub fn of(folder: &Folder, reason: String) -> Self {
        let path = folder.path().join(STEPS);
        Self { path, reason }
    }
}

/// The accepted steps of a run.
#[derive(Debug)]
pub struct Checkpoint {
    folder: Folder,
    file: File,
    header: Header,
    crc: Hasher,
    /// Records of the earlier run, and where the next one begins.
    earlier: (Vec<u8>, usize),
}

impl Checkpoint {
    /// Starts one for a run from the beginning.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn start(folder: &Folder, input_hash: &str) -> Result<Self, ResultsError> {
        let file = File::create(folder.path().join(STEPS));
        let checkpoint = Self {
            file: file.map_err(|e| folder.error(STEPS, e))?,
            folder: folder.clone(),
            header: Header {
                program: PROGRAM.clone(),
                input_hash: input_hash.to_owned(),
                records: 0,
                bytes: 0,
                crc32: 0,
            },
            crc: Hasher::new(),
            earlier: (Vec::new(), 0),
        };
        checkpoint.write_header()?;
        Ok(checkpoint)
    }

    /// Whether a folder holds one. Records without a byte and a header are what a run leaves that was killed at its very start.
    pub fn exists(folder: &Path) -> bool {
        let holds = |name: &str| fs::metadata(folder.join(name)).is_ok_and(|m| m.len() > 0);
        folder.join(HEADER).exists() || holds(STEPS)
    }

    /// Reads the one of a folder and checks all of it; nothing is written.
    ///
    /// # Errors
    ///
    /// [`CheckpointError`] for one that is damaged or of another run.
    pub fn read(folder: &Folder, input_hash: &str) -> Result<Self, CheckpointError> {
        let refuse = |name: &str, reason: String| CheckpointError {
            path: folder.path().join(name),
            reason,
        };
        let text = fs::read(folder.path().join(HEADER));
        let text = text.map_err(|e| refuse(HEADER, e.to_string()))?;
        let header: Header = serde_json::from_slice(&text)
            .map_err(|e| refuse(HEADER, format!("it is damaged: {e}")))?;
        if header.input_hash != input_hash {
            let reason = format!(
                "it belongs to another specimen or other options (fingerprint {} for {input_hash})",
                header.input_hash
            );
            return Err(refuse(HEADER, reason));
        }
        if header.program != *PROGRAM {
            let reason = format!(
                "it was written by another build of the program ({} for {})",
                header.program, *PROGRAM
            );
            return Err(refuse(HEADER, reason));
        }
        let wrong = |reason: String| refuse(STEPS, reason);
        let path = folder.path().join(STEPS);
        let mut steps = fs::read(&path).map_err(|e| wrong(e.to_string()))?;
        if steps.len() < header.bytes {
            let (has, wanted) = (steps.len(), header.bytes);
            return Err(wrong(format!("it is truncated: {has} bytes of {wanted}")));
        }
        steps.truncate(header.bytes);
        let mut crc = Hasher::new();
        crc.update(&steps);
        if crc.clone().finalize() != header.crc32 {
            return Err(wrong("it is damaged: its checksum is another one".into()));
        }
        let file = OpenOptions::new().append(true).open(&path);
        let mut checkpoint = Self {
            folder: folder.clone(),
            file: file.map_err(|e| wrong(e.to_string()))?,
            header,
            crc,
            earlier: (steps, 0),
        };
        let mut records = 0;
        while checkpoint
            .recall()
            .map_err(|e| wrong(e.to_string()))?
            .is_some()
        {
            records += 1;
        }
        if records != checkpoint.header.records {
            return Err(wrong("it is damaged: steps are missing".into()));
        }
        checkpoint.earlier.1 = 0;
        Ok(checkpoint)
    }

    /// Steps of the earlier run.
    pub const fn records(&self) -> usize {
        self.header.records
    }

    /// The next step of the earlier run.
    ///
    /// # Errors
    ///
    /// An error of kind [`io::ErrorKind::InvalidData`].
    pub fn recall(&mut self) -> io::Result<Option<Entry>> {
        let (steps, at) = &mut self.earlier;
        let rest = &steps[*at..];
        if rest.is_empty() {
            return Ok(None);
        }
        let record = rest.split_first_chunk().and_then(|(length, rest)| {
            let length = u32::from_le_bytes(*length) as usize;
            postcard::from_bytes(rest.get(..length)?)
                .ok()
                .map(|entry| (4 + length, entry))
        });
        let Some((length, entry)) = record else {
            let text = "it is damaged: a step cannot be read";
            return Err(io::Error::new(io::ErrorKind::InvalidData, text));
        };
        *at += length;
        Ok(Some(entry))
    }

    /// Makes what follows the last step of the earlier run end there.
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn settle(&mut self) -> io::Result<()> {
        self.earlier = (Vec::new(), 0);
        self.file.set_len(self.header.bytes as u64)
    }

    /// Adds an accepted step.
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn add(&mut self, entry: &Entry) -> io::Result<()> {
        let mut record = vec![0; 4];
        record = postcard::to_extend(entry, record).map_err(io::Error::other)?;
        let length = (record.len() - 4) as u32;
        record[..4].copy_from_slice(&length.to_le_bytes());
        let written = self.file.write_all(&record);
        written.map_err(|e| self.folder.error(STEPS, e))?;
        self.crc.update(&record);
        self.header.records += 1;
        self.header.bytes += record.len();
        self.header.crc32 = self.crc.clone().finalize();
        Ok(self.write_header()?)
    }

    /// Removes the one of a folder, if there is one, and what claims the folder.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn remove(folder: &Folder) -> Result<(), ResultsError> {
        [HEADER, STEPS, CLAIM]
            .iter()
            .try_for_each(|name| folder.remove(name))
    }

    fn write_header(&self) -> Result<(), ResultsError> {
        self.folder.replace(HEADER, |out| {
            serde_json::to_writer_pretty(&mut *out, &self.header)?;
            out.write_all(b"\n")
        })
    }
}

/// Version and checksum of the executable: only the same program repeats a run to the last bit.
static PROGRAM: LazyLock<String> = LazyLock::new(|| {
    let sum = std::env::current_exe().and_then(|path| checksum(&path));
    format!("{} {:08x}", env!("CARGO_PKG_VERSION"), sum.unwrap_or(0))
});

/// CRC-32 of a file, read piece by piece.
fn checksum(path: &Path) -> io::Result<u32> {
    let mut reader = BufReader::new(File::open(path)?);
    let mut hasher = Hasher::new();
    loop {
        let piece = reader.fill_buf()?;
        if piece.is_empty() {
            return Ok(hasher.finalize());
        }
        hasher.update(piece);
        let length = piece.len();
        reader.consume(length);
    }
}
