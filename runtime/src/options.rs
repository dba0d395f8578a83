//! Options of making and of binding a pass.

use crate::{OverrideValue, Region, UniformValue};
use wgpu::TextureFormat;

/// Choices that the manifest leaves open.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct PassOptions {
    /// Format of the colour target of a fragment pass, where it is not the manifest's; a swap chain's, say.
    /// For compute, the shader's text fixes the format, and another one here is an error.
    pub target_format: Option<TextureFormat>,
    /// Formats of single targets, by name, of a kernel that writes several.
    pub formats: Vec<(String, TextureFormat)>,
    /// `true` if loops run without wgpu's bound on their iterations, whose counter costs time. Only for shaders whose
    /// text shows that every loop ends, as emitted shaders do; all others are rejected.
    pub unbounded_loops: bool,
    /// Values of options that the shader takes when the pipeline is created, by name; the others have the manifest's
    /// defaults.
    pub overrides: Vec<(String, OverrideValue)>,
    /// Cache that the driver looks the pipeline up in, and adds it to.
    pub cache: Option<wgpu::PipelineCache>,
}

impl PassOptions {
    /// Sets an option of the kernel that the shader was emitted with as an override. Another value needs another pass,
    /// but no other shader.
    ///
    /// ```
    /// # use straightline_runtime::PassOptions;
    /// let options = PassOptions::default().override_option("tau", 300.0).override_option("radius", 2);
    /// ```
    pub fn override_option(mut self, name: &str, value: impl Into<OverrideValue>) -> Self {
        self.overrides.push((name.to_owned(), value.into()));
        self
    }

    /// Draws to targets of `format`.
    pub fn target_format(mut self, format: TextureFormat) -> Self {
        self.target_format = Some(format);
        self
    }

    /// Sets the format of the target that the kernel calls `name`.
    pub fn format_of(mut self, name: &str, format: TextureFormat) -> Self {
        self.formats.push((name.to_owned(), format));
        self
    }

    /// Looks pipelines up in a cache of the same device, and adds them to it: one of
    /// [`PipelineCacheFile::cache`](crate::PipelineCacheFile::cache), or of the caller's.
    pub fn pipeline_cache(mut self, cache: Option<&wgpu::PipelineCache>) -> Self {
        self.cache = cache.cloned();
        self
    }

    /// Sets whether loops run without wgpu's bound.
    pub fn unbounded_loops(mut self, unbounded: bool) -> Self {
        self.unbounded_loops = unbounded;
        self
    }
}

/// Options that a pass is bound with, besides its inputs and targets.
///
/// ```
/// # use straightline_runtime::{BindOptions, Region};
/// let options = BindOptions::default()
///     .uniform("tau", 300.0)
///     .uniform("grade", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
///     .region(Region::at([0, 0], [256, 256]));
/// ```
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct BindOptions<'a> {
    /// All uniforms as they lie in the buffer, where they do not start from the manifest's defaults.
    pub uniforms: Option<&'a [u8]>,
    /// Single uniforms by name; these count before `uniforms`.
    pub values: Vec<(&'a str, UniformValue)>,
    /// The rectangle to filter, of a shader for regions; all of the inputs otherwise.
    pub region: Option<Region>,
}

impl<'a> BindOptions<'a> {
    /// Starts with all uniforms as `bytes`, which are as long as the manifest's size: see
    /// [`Bound::write_uniforms`](crate::Bound::write_uniforms).
    pub fn uniforms(mut self, bytes: &'a [u8]) -> Self {
        self.uniforms = Some(bytes);
        self
    }

    /// Starts with this value for the uniform `name`.
    pub fn uniform(mut self, name: &'a str, value: impl Into<UniformValue>) -> Self {
        self.values.push((name, value.into()));
        self
    }

    /// Filters a rectangle. The shader must have been generated for regions.
    pub fn region(mut self, region: Region) -> Self {
        self.region = Some(region);
        self
    }
}
