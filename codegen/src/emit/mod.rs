//! From a scheduled graph to text that reads as if written by a careful person.
//!
//! No decision about the computation is taken here: every step of the schedule becomes a statement or part of one.
//! WGSL and GLSL come from the emitter of this room; SPIR-V, HLSL and MSL are translated from the WGSL by naga,
//! which also validates every text before it is given out.

mod arrays;
mod bindings;
mod body;
mod dialect;
mod error;
mod glsl;
mod layout;
mod names;
mod plan;
mod resources;
mod shell;
mod target;
mod text;
mod translate;
mod wgsl;

use crate::pipeline::Compiled;
use std::collections::{BTreeMap, BTreeSet};
use straightline_manifest::{Format, Manifest, Stage};

pub use bindings::{Module, bindings};
pub use error::EmitError;
pub use target::Target;

/// One shader in the languages asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Emitted {
    /// What a host must know; the file names in it are set by [`Emitted::named`].
    pub manifest: Manifest,
    /// Contents by language.
    pub files: BTreeMap<Target, Vec<u8>>,
}

impl Emitted {
    /// Files by name, with the manifest that names them: `stem.wgsl`, `stem.json`, ...
    pub fn named(&self, stem: &str) -> BTreeMap<String, Vec<u8>> {
        let mut manifest = self.manifest.clone();
        let mut files = BTreeMap::new();
        for (target, bytes) in &self.files {
            let name = format!("{stem}.{}", target.extension(manifest.stage));
            manifest.files.insert(target.to_string(), name.clone());
            files.insert(name, bytes.clone());
        }
        files.insert(format!("{stem}.json"), manifest.to_json().into_bytes());
        files
    }
}

/// Emits a kernel for a stage, its result in `format`. Nothing is given out that naga does not validate.
pub fn emit(
    compiled: &Compiled,
    stage: Stage,
    format: Format,
    targets: &BTreeSet<Target>,
) -> Result<Emitted, EmitError> {
    let resources = resources::Resources::of(compiled, stage, format)?;
    let wgsl = shell::render(compiled, &resources, &wgsl::Wgsl { resources: &resources })?;
    let mut manifest = resources.manifest(compiled);
    manifest.counts.statements = wgsl.statements;
    let module = translate::Module::parse_wgsl(&compiled.kernel, &wgsl.text)?;
    let mut files = BTreeMap::new();
    for target in targets {
        let bytes = match target {
            Target::Wgsl => wgsl.text.clone().into_bytes(),
            Target::Glsl450 => {
                let glsl = shell::render(compiled, &resources, &glsl::Glsl { resources: &resources })?;
                translate::check_glsl(&compiled.kernel, stage, &glsl.text)?;
                glsl.text.into_bytes()
            }
            Target::Spirv => module.spirv(&resources)?,
            Target::Hlsl => module.hlsl(&resources)?.into_bytes(),
            Target::Msl => module.msl(&resources)?.into_bytes(),
        };
        files.insert(*target, bytes);
    }
    Ok(Emitted { manifest, files })
}
