//! Passes that are made when they are first used.

use crate::{Error, Pass, PassOptions, Shader};
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
    /// Passes with the hashes of their shaders' texts.
    made: Vec<(u64, Pass)>,
}

impl Passes {
    /// No pass yet. Each will be made with `options`.
    pub fn new(device: &Device, options: PassOptions) -> Self {
        Passes {
            device: device.clone(),
            options,
            made: Vec::new(),
        }
    }

    /// Returns the pass of a shader. The first call for a shader compiles it.
    ///
    /// # Errors
    ///
    /// As [`Pass::from_shader`]. A later call tries again.
    pub fn get(&mut self, shader: &Shader<'_>) -> Result<&Pass, Error> {
        // The same text with other defaults of its uniforms is another shader.
        let is_of = |(hash, pass): &(u64, Pass)| *hash == shader.hash && *pass.plan == shader.plan;
        let at = match self.made.iter().position(is_of) {
            Some(at) => at,
            None => {
                let pass = Pass::from_shader(&self.device, shader, &self.options)?;
                self.made.push((shader.hash, pass));
                self.made.len() - 1
            }
        };
        Ok(&self.made[at].1)
    }

    /// Number of passes that were made.
    pub fn made(&self) -> usize {
        self.made.len()
    }
}
