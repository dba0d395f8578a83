//! A kernel's shaders, counts and options.

use crate::errors::Refusal;
use crate::options;
use crate::state::State;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, Overrides, ShaderSpec};
use straightline_manifest::SourceMap;

/// A kernel: one of the catalogue, or the text that the page's visitor has made of it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct KernelText {
    /// Name in the catalogue.
    pub id: String,
    /// The function that is the kernel; of the catalogue's own text it need not be given.
    #[serde(default)]
    pub function: String,
    /// Changed files, if there are any.
    #[serde(default)]
    pub files: Option<Vec<SourceText>>,
}

/// A file of a kernel.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct SourceText {
    /// Only ever shown.
    pub path: String,
    /// Contents.
    pub text: String,
}

/// A kernel in one form.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Asked {
    /// The kernel asked about.
    pub kernel: KernelText,
    /// Settings of its shaders, by the names of the command line: `{ "set": { "pattern": "latin16" }, "unroll": "none" }`.
    #[serde(default)]
    pub shader: ShaderSpec,
}

/// A kernel in one form, and the shaders that are wanted of it.
#[derive(Deserialize)]
pub struct CompileRequest {
    #[serde(flatten)]
    asked: Asked,
    /// Options of each shader's text: `{ "stage": "fragment", "target": ["wgsl"] }`.
    #[serde(default)]
    shaders: Vec<Overrides>,
}

impl KernelText {
    /// The kernel's function and files.
    pub fn source_json(&self, state: &mut State) -> Result<Value, Refusal> {
        let kernel = state.cached_kernel(self)?;
        let files = kernel.files().iter();
        let files = files.map(|file| json!({ "path": file.path, "text": file.text }));
        Ok(json!({ "function": kernel.name(), "files": files.collect::<Vec<_>>() }))
    }
}

/// Compiles a kernel and emits it.
pub fn compile_kernel(state: &mut State, request: &CompileRequest) -> Result<Value, Refusal> {
    let kernel = state.cached_kernel(&request.asked.kernel)?;
    let infos: Vec<Value> = kernel.options()?.iter().map(options::to_json).collect();
    let compiled = state.cached_compiled(&request.asked)?;
    let shaders = request
        .shaders
        .iter()
        .map(|written| shader_json(&compiled, &request.asked.shader, written));
    let shaders = shaders.collect::<Result<Vec<Value>, Refusal>>()?;
    let loops = compiled.loops.iter().map(|report| {
        json!({
            "loop": report.policy_path(), "unroll": report.unroll.to_string(), "copies": report.copies,
            "operations": report.operations, "reason": report.reason,
        })
    });
    Ok(json!({
        "kernel": compiled.kernel,
        "summary": compiled.summary,
        "options": infos,
        "values": compiled.options.spelled(),
        "paper": paper_json(&compiled),
        "loops": loops.collect::<Vec<_>>(),
        "quad": compiled.quad.is_some() || compiled.transport.is_some(),
        "shaders": shaders,
    }))
}

/// The counts of a built-in kernel's publication, for one pixel.
fn paper_json(compiled: &Compiled) -> Value {
    compiled.paper_counts().map_or(
        Value::Null,
        |counts| json!({ "texture_reads": counts.texture_reads, "weight_evaluations": counts.weight_evaluations }),
    )
}

/// Makes one shader: its manifest and texts, and the languages that cannot have it with the reason.
fn shader_json(compiled: &Compiled, spec: &ShaderSpec, written: &Overrides) -> Result<Value, Refusal> {
    let options = written.apply(spec.clone()).emit.enable_subgroups(true);
    let emitted = |targets: &[Target]| compiled.emit(&options.clone().targets(targets.iter().copied()));
    let targets: Vec<Target> = options.targets.iter().copied().collect();
    let (mut texts, mut refused) = (Map::new(), Map::new());
    let mut source_map: Option<SourceMap> = None;
    let mut take = |files: BTreeMap<Target, Vec<u8>>, own: Option<SourceMap>| {
        for (target, text) in files {
            texts.insert(target.to_string(), json!(String::from_utf8_lossy(&text)));
        }
        match (&mut source_map, own) {
            (Some(map), Some(own)) => map.texts.extend(own.texts),
            (map, own) => *map = map.take().or(own),
        }
    };
    // All at once, which is quick; one by one where a language does not have what the kernel needs.
    let manifest = match emitted(&targets) {
        Ok(all) => {
            take(all.files, all.source_map);
            json!(all.manifest)
        }
        Err(_) => {
            let mut common = emitted(&[]).ok().map(|all| all.manifest);
            for target in &targets {
                match (emitted(&[*target]), &mut common) {
                    (Ok(one), Some(manifest)) => {
                        manifest.entry_points.extend(one.manifest.entry_points);
                        manifest.hashes.extend(one.manifest.hashes);
                        take(one.files, one.source_map);
                    }
                    (Ok(_), None) => {}
                    (Err(why), _) => {
                        refused.insert(target.to_string(), json!(in_a_line(&why)));
                    }
                }
            }
            json!(common)
        }
    };
    let mut shader = json!({ "stage": options.stage, "manifest": manifest, "texts": texts, "refused": refused });
    if let Some(map) = source_map {
        shader["source_map"] = json!(map);
    }
    Ok(shader)
}

/// The first error with its help, in a line.
fn in_a_line(errors: &Errors) -> String {
    let help = errors.diagnostics.first().and_then(|first| first.help.as_deref());
    let help = help.map_or_else(String::new, |help| format!("; {help}"));
    errors.first_message().to_owned() + &help
}
