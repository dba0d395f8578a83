//! Inputs of several shaders, on the device once.

use super::{Bench, ExecuteError, Inputs, Uploaded};
use std::rc::Rc;
use straightline_manifest::{Binding, BindingKind, Manifest};

/// Puts inputs onto a device; shaders that read the same share them.
#[derive(Debug)]
pub struct Uploads<'a> {
    bench: &'a Bench,
    inputs: &'a Inputs,
    uploaded: Vec<(Vec<Binding>, Rc<Uploaded>)>,
}

impl<'a> Uploads<'a> {
    /// Nothing on it yet.
    pub fn new(bench: &'a Bench, inputs: &'a Inputs) -> Self {
        Uploads {
            bench,
            inputs,
            uploaded: Vec::new(),
        }
    }

    /// Uploads the inputs that a manifest asks for.
    ///
    /// # Errors
    ///
    /// If something is missing, or the device refuses it.
    pub fn upload_shared(&mut self, manifest: &Manifest) -> Result<Rc<Uploaded>, ExecuteError> {
        let is_resource = |b: &&Binding| !matches!(b.kind, BindingKind::Uniform { .. });
        let wanted: Vec<Binding> = manifest.bindings.iter().filter(is_resource).cloned().collect();
        if let Some((_, uploaded)) = self.uploaded.iter().find(|(known, _)| *known == wanted) {
            return Ok(Rc::new(self.bench.share_inputs(manifest, self.inputs, uploaded)?));
        }
        let uploaded = Rc::new(self.bench.upload(manifest, self.inputs)?);
        self.uploaded.push((wanted, Rc::clone(&uploaded)));
        Ok(uploaded)
    }
}
