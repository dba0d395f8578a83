//! State of a module between calls.

use crate::catalogue;
use crate::compiled::{Asked, KernelText};
use crate::errors::Refusal;
use crate::scene::Scene;
use crate::texels::Picture;
use std::sync::Arc;
use straightline_codegen::{Compiled, Kernel, Manifest};

/// Maximum number of cached kernels and compiled forms: as many as a page shows, and one being edited.
const KEPT: usize = 6;

/// Most pixels of a visitor's picture.
const MOST_PIXELS: u64 = 1 << 24;

/// State of a page.
#[derive(Default)]
pub struct State {
    kernels: Vec<(KernelText, Arc<Kernel>)>,
    compiled: Vec<(Asked, Arc<Compiled>)>,
    manifests: Vec<(Asked, Arc<Manifest>)>,
    /// The visitor's picture, if there is one.
    pub picture: Option<Picture>,
    /// The built-in scene, with what has been traced of it.
    pub scene: Scene,
}

impl State {
    /// The kernel of a text, read once.
    pub fn cached_kernel(&mut self, text: &KernelText) -> Result<Arc<Kernel>, Refusal> {
        if let Some((_, kernel)) = self.kernels.iter().find(|(known, _)| known == text) {
            return Ok(Arc::clone(kernel));
        }
        let kernel = Arc::new(match &text.files {
            None => catalogue::find_kernel(&text.id)?,
            Some(files) => {
                let (first, others) = files
                    .split_first()
                    .ok_or_else(|| Refusal::from_message("the kernel has no file"))?;
                let kernel = Kernel::from_text(&first.path, &first.text, &text.function);
                others
                    .iter()
                    .fold(kernel, |kernel, file| kernel.with_text(&file.path, &file.text))
            }
        });
        cache_entry(&mut self.kernels, text.clone(), Arc::clone(&kernel));
        Ok(kernel)
    }

    /// A kernel in one form, compiled once.
    pub fn cached_compiled(&mut self, asked: &Asked) -> Result<Arc<Compiled>, Refusal> {
        if let Some((_, compiled)) = self.compiled.iter().find(|(known, _)| known == asked) {
            return Ok(Arc::clone(compiled));
        }
        let kernel = self.cached_kernel(&asked.kernel)?;
        let compiled = Arc::new(asked.shader.compile(&kernel)?);
        cache_entry(&mut self.compiled, asked.clone(), Arc::clone(&compiled));
        Ok(compiled)
    }

    /// Returns the manifest of a kernel's compute shader.
    pub fn cached_manifest(&mut self, asked: &Asked) -> Result<Arc<Manifest>, Refusal> {
        if let Some((_, manifest)) = self.manifests.iter().find(|(known, _)| known == asked) {
            return Ok(Arc::clone(manifest));
        }
        let emitted = self
            .cached_compiled(asked)?
            .emit(&asked.shader.emit.clone().targets([]));
        let manifest = Arc::new(emitted?.manifest);
        cache_entry(&mut self.manifests, asked.clone(), Arc::clone(&manifest));
        Ok(manifest)
    }

    /// Takes a picture of 8-bit sRGB and alpha, or forgets the one that is there.
    pub fn set_picture(&mut self, width: u32, height: u32, bytes: &[u8]) -> Result<(), Refusal> {
        let pixels = u64::from(width) * u64::from(height);
        if pixels == 0 {
            self.picture = None;
            return Ok(());
        }
        if pixels > MOST_PIXELS || bytes.len() as u64 != 4 * pixels {
            return Err(Refusal::from_message(&format!(
                "a picture of {width}x{height} pixels has {} bytes: give 4 a pixel, and at most {MOST_PIXELS} pixels",
                bytes.len()
            )));
        }
        self.picture = Some(Picture::from_srgb([width, height], bytes));
        Ok(())
    }
}

/// Adds an entry, and forgets the oldest if there are too many.
fn cache_entry<K, V>(entries: &mut Vec<(K, V)>, key: K, value: V) {
    if entries.len() == KEPT {
        entries.remove(0);
    }
    entries.push((key, value));
}
