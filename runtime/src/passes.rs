//! Passes that are made when they are first used.

use crate::{Error, Pass, PassOptions, Shader};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use wgpu::Device;

/// Passes of several shaders on one device, each made when it is first asked for: for a set of shaders of which a program runs
/// a few.
///
/// ```no_run
/// # use straightline_runtime::{Error, PassOptions, Passes, Shader, wgpu::Device};
/// # fn frame(device: &Device, shader: &Shader<'_>) -> Result<(), Error> {
/// let mut passes = Passes::new(device, PassOptions::default());
/// let pass = passes.get(shader)?; // compiles
/// let pass = passes.get(shader)?; // the same pass
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Passes {
    device: Device,
    options: PassOptions,
    /// Passes by the hash of their shaders' texts.
    made: BTreeMap<u64, Pass>,
}

impl Passes {
    /// No pass yet. Each will be made with `options`.
    pub fn new(device: &Device, options: PassOptions) -> Self {
        Passes {
            device: device.clone(),
            options,
            made: BTreeMap::new(),
        }
    }

    /// Returns the pass of a shader. The first call for a shader compiles it.
    ///
    /// # Errors
    ///
    /// As [`Pass::from_shader`]. A later call tries again.
    pub fn get(&mut self, shader: &Shader<'_>) -> Result<&Pass, Error> {
        match self.made.entry(shader.hash) {
            Entry::Occupied(made) => Ok(made.into_mut()),
            Entry::Vacant(place) => Ok(place.insert(Pass::from_shader(&self.device, shader, &self.options)?)),
        }
    }

    /// Number of passes that were made.
    pub fn made(&self) -> usize {
        self.made.len()
    }
}
