//! Errors of the kernels of a chain.

use std::collections::BTreeSet;
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Diagnostic, Errors, File};

/// Errors of several kernels of one set of files.
#[derive(Default)]
pub struct Failures {
    /// Kernels that have errors.
    pub entries: BTreeSet<String>,
    found: Vec<Diagnostic>,
    /// Errors of the first kernel, if it is the only one.
    first: Option<Errors>,
}

impl Failures {
    pub fn add(&mut self, entry: &str, errors: Errors) {
        for error in &errors.diagnostics {
            if !self.found.contains(error) {
                self.found.push(error.clone());
            }
        }
        self.entries.insert(entry.to_owned());
        self.first.get_or_insert(errors);
    }

    /// Returns the errors, if there are any.
    pub fn none(self, files: &Arc<Vec<File>>) -> Result<(), Errors> {
        match (self.first, self.entries.len()) {
            (None, _) => Ok(()),
            (Some(first), 1) => Err(first),
            (Some(_), _) => Err(Errors::new(self.found, files)),
        }
    }
}
