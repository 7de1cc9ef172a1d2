//! RON files whose mistakes are shown with their place.

mod error;
mod places;

use std::sync::Arc;

use miette::NamedSource;
use ron::extensions::Extensions;
use ron::{Deserializer, Options};
use serde::de::DeserializeOwned;

pub use error::RonError;

/// Name and text of a file.
#[derive(Debug, Clone)]
pub struct RonFile(Arc<NamedSource<String>>);

impl RonFile {
    /// A file; `name` stands for it in messages.
    pub fn new(name: &str, text: &str) -> Self {
        Self(Arc::new(NamedSource::new(name, text.to_string())))
    }

    /// Reads a value; what is optional in it may be written without `Some`.
    ///
    /// # Errors
    ///
    /// The first thing that cannot be read.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, RonError> {
        let options = Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
        let mut text = Deserializer::from_str_with_options(self.0.inner(), &options)
            .map_err(|error| RonError::parse(&self.0, "", &error))?;
        let value = serde_path_to_error::deserialize(&mut text).map_err(|error| {
            let path = error.path().to_string();
            RonError::parse(&self.0, &path, &text.span_error(error.into_inner()))
        })?;
        text.end()
            .map_err(|error| RonError::parse(&self.0, "", &text.span_error(error)))?;
        Ok(value)
    }

    /// An error of the value at `path`, such as `bars[0].axis.y_mm`, found after reading.
    pub fn error(&self, path: &str, what: String, help: Option<String>) -> RonError {
        RonError::found(&self.0, path, what, help)
    }
}
