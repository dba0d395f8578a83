//! Shaders that travel: text and manifest are read, and compared, when the program runs.

use crate::error::Error;
use crate::plan::Plan;
use crate::shader::{Loops, LoopsEnd};
use crate::source::locate_error;
use crate::{Draw, DrawOptions, Pass, PassOptions, Shader};
use straightline_manifest::{Manifest, SCHEMA, SourceMap, hash_of_text, text_hash};
use wgpu::Device;

impl<'a> Shader<'a> {
    /// The shader `wgsl` that `manifest` describes.
    ///
    /// # Errors
    ///
    /// [`Error::BadManifest`], [`Error::Hash`], [`Error::Mismatch`] and [`Error::Shader`] if the two are damaged or do not
    /// belong together; [`Error::Manifest`] for a manifest of another schema.
    pub fn from_manifest(manifest: &Manifest, wgsl: &'a str) -> Result<Self, Error> {
        let plan = read_plan(manifest)?;
        check_hash(manifest, wgsl)?;
        let kernel = || plan.kernel.to_string();
        let parsed = straightline_reflect::Shader::parse(wgsl).map_err(|description| Error::Shader {
            kernel: kernel(),
            description,
        })?;
        parsed.check(manifest, &plan).map_err(|problem| Error::Mismatch {
            kernel: kernel(),
            problem,
        })?;
        let loops = match parsed.check_loops() {
            Ok(()) => Loops::End(proven_loops_end()),
            Err(problem) => Loops::Unproven(problem.into()),
        };
        let hash = text_hash(wgsl);
        Ok(Shader {
            plan,
            wgsl,
            loops,
            hash,
            source_map: None,
        })
    }

    /// [`from_manifest`](Self::from_manifest) with the text's source map, which the setting `debug` writes beside it.
    /// [`Error::Shader`] and [`Error::Pipeline`] then also name the place in the kernel's source, here and where a pass
    /// is made of the shader.
    ///
    /// ```no_run
    /// # use straightline_runtime::{Error, Pass, PassOptions, Shader, manifest::{Manifest, SourceMap}, wgpu::Device};
    /// # fn load(device: &Device, [manifest, wgsl, map]: [&str; 3]) -> Result<Pass, Error> {
    /// let shader = Shader::with_source_map(&Manifest::from_json(manifest)?, wgsl, SourceMap::from_json(map)?)?;
    /// Pass::from_shader(device, &shader, &PassOptions::default())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// Errors of [`from_manifest`](Self::from_manifest).
    pub fn with_source_map(manifest: &Manifest, wgsl: &'a str, map: SourceMap) -> Result<Self, Error> {
        let shader = Self::from_manifest(manifest, wgsl).map_err(|error| locate_error(error, &map))?;
        Ok(Shader {
            source_map: Some(map.into()),
            ..shader
        })
    }

    /// [`from_manifest`](Self::from_manifest) for a manifest as it lies on disk.
    ///
    /// # Errors
    ///
    /// Those of [`from_manifest`](Self::from_manifest), and [`Error::Manifest`] if `manifest_json` is not a manifest.
    pub fn from_json(manifest_json: &str, wgsl: &'a str) -> Result<Self, Error> {
        Self::from_manifest(&Manifest::from_json(manifest_json)?, wgsl)
    }
}

impl Pass {
    /// A pass of the shader `wgsl` that `manifest` describes, with default options.
    ///
    /// # Errors
    ///
    /// Those of [`Shader::from_manifest`] and of [`from_shader`](Self::from_shader).
    pub fn new(device: &Device, manifest: &Manifest, wgsl: &str) -> Result<Self, Error> {
        Self::with_options(device, manifest, wgsl, &PassOptions::default())
    }

    /// [`new`](Self::new) for a manifest as it lies on disk.
    ///
    /// # Errors
    ///
    /// Those of [`new`](Self::new), and [`Error::Manifest`] if `manifest_json` is not a manifest or of another schema.
    pub fn from_json(device: &Device, manifest_json: &str, wgsl: &str) -> Result<Self, Error> {
        Self::new(device, &Manifest::from_json(manifest_json)?, wgsl)
    }

    /// [`new`](Self::new) with options.
    ///
    /// # Errors
    ///
    /// Those of [`new`](Self::new); [`Error::TargetFormat`] if the shader cannot write the format asked for, and
    /// [`Error::UnboundedLoop`] if loops are to go without a bound and one may not end.
    pub fn with_options(
        device: &Device,
        manifest: &Manifest,
        wgsl: &str,
        options: &PassOptions,
    ) -> Result<Self, Error> {
        Self::from_shader(device, &Shader::from_manifest(manifest, wgsl)?, options)
    }
}

impl Draw {
    /// The fragment shader `wgsl` that `manifest` describes, behind the vertex shader of `options`.
    ///
    /// # Errors
    ///
    /// Those of [`Shader::from_manifest`] and of [`from_shader`](Self::from_shader).
    pub fn new(device: &Device, manifest: &Manifest, wgsl: &str, options: &DrawOptions<'_>) -> Result<Self, Error> {
        Self::from_shader(device, &Shader::from_manifest(manifest, wgsl)?, options)
    }

    /// [`new`](Self::new) for a manifest as it lies on disk.
    ///
    /// # Errors
    ///
    /// Those of [`new`](Self::new), and [`Error::Manifest`] if `manifest_json` is not a manifest or of another schema.
    pub fn from_json(
        device: &Device,
        manifest_json: &str,
        wgsl: &str,
        options: &DrawOptions<'_>,
    ) -> Result<Self, Error> {
        Self::new(device, &Manifest::from_json(manifest_json)?, wgsl, options)
    }
}

/// The plan of a manifest of this schema.
pub(crate) fn read_plan(manifest: &Manifest) -> Result<Plan, Error> {
    if manifest.schema != SCHEMA {
        return Err(straightline_manifest::Error::Schema { found: manifest.schema }.into());
    }
    Plan::from_manifest(manifest).map_err(|contradiction| Error::BadManifest {
        kernel: manifest.kernel.clone(),
        place: contradiction.place,
        problem: contradiction.problem,
    })
}

/// Refuses a text that is not the one that the manifest was written for, though it may bind the same. A manifest without a
/// hash of it claims nothing.
fn check_hash(manifest: &Manifest, wgsl: &str) -> Result<(), Error> {
    let found = hash_of_text(wgsl);
    match manifest.hashes.get("wgsl") {
        Some(wanted) if *wanted != found => Err(Error::Hash {
            kernel: manifest.kernel.clone(),
            wanted: wanted.clone(),
            found,
        }),
        _ => Ok(()),
    }
}

/// The witness for a text whose loops [`straightline_reflect::Shader::check_loops`] has shown to end.
#[allow(unsafe_code)]
fn proven_loops_end() -> LoopsEnd {
    // SAFETY: the only caller has just shown it.
    unsafe { LoopsEnd::new() }
}
