//! A file that grows during a run, begun anew or continued.

use std::cell::Cell;
use std::fs::File;
use std::io::{self, Error, ErrorKind, Read, Seek, SeekFrom, Write};

/// A file that only grows.
///
/// Continued, it is first written again from its start, without being touched: what is written must be what it
/// holds. [`Self::settle`] then cuts off what it holds beyond that, and from there on it grows.
#[derive(Debug)]
pub struct Growing {
    file: File,
    earlier: Vec<u8>,
    at: usize,
    settled: Cell<bool>,
}

impl Growing {
    /// Of a file that is empty.
    pub const fn empty(file: File) -> Self {
        Self {
            file,
            earlier: Vec::new(),
            at: 0,
            settled: Cell::new(true),
        }
    }

    /// Of a file that an earlier run left, open for reading and writing.
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn continued(mut file: File) -> io::Result<Self> {
        let mut earlier = Vec::new();
        file.read_to_end(&mut earlier)?;
        Ok(Self {
            file,
            earlier,
            at: 0,
            settled: Cell::new(false),
        })
    }

    /// Ends the part that was there before.
    ///
    /// # Errors
    ///
    /// An error of the system.
    pub fn settle(&self) -> io::Result<()> {
        if !self.settled.replace(true) && self.at < self.earlier.len() {
            self.file.set_len(self.at as u64)?;
            (&self.file).seek(SeekFrom::End(0))?;
        }
        Ok(())
    }

    fn mismatch(&self) -> Error {
        let before = &self.earlier[..self.at];
        let line = before.split(|&b| b == b'\n').count();
        Error::new(
            ErrorKind::InvalidData,
            format!(
                "line {line} is not what the checkpoint leads to: it was changed since, or the machine is another one"
            ),
        )
    }
}

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let rest = &self.earlier[self.at..];
        if self.settled.get() || rest.is_empty() {
            return self.file.write(bytes);
        }
        let known = rest.len().min(bytes.len());
        let same = rest.iter().zip(bytes).take_while(|(a, b)| a == b).count();
        self.at += same;
        if same < known {
            return Err(self.mismatch());
        }
        Ok(known)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

#[cfg(test)]
mod tests {
    //! Protects the tables of an earlier run: they are compared, never overwritten.
    use super::*;
    use std::fs::{self, OpenOptions};

    fn again(content: &str, write: &[&str]) -> (io::Result<()>, String) {
        let file = tempfile::NamedTempFile::new().unwrap();
        fs::write(file.path(), content).unwrap();
        let open = OpenOptions::new().read(true).write(true).open(file.path());
        let mut growing = Growing::continued(open.unwrap()).unwrap();
        let mut run = || {
            growing.write_all(write[0].as_bytes())?;
            growing.settle()?;
            growing.write_all(write[1].as_bytes())
        };
        let done = run();
        (done, fs::read_to_string(file.path()).unwrap())
    }

    #[test]
    fn a_file_grows_on_after_what_is_repeated() {
        for (content, repeated, rest) in [
            ("a\nb\n", "a\nb\n", "c\n"),
            ("a\nb", "a\nb\n", "c\n"),
            ("a\nb\nx\ny", "a\nb\n", "c\n"),
        ] {
            let (done, text) = again(content, &[repeated, rest]);
            done.unwrap();
            assert_eq!(text, "a\nb\nc\n");
        }
    }

    #[test]
    fn a_difference_is_refused_by_line_and_changes_nothing() {
        let (done, text) = again("a\nb\nx\n", &["a\nb\nc\n", "d"]);
        let message = done.unwrap_err().to_string();
        assert!(message.contains("line 3"), "{message}");
        assert_eq!(text, "a\nb\nx\n");
    }
}
