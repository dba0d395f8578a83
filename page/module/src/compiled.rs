//! A kernel's shaders, counts and options.

use crate::errors::Refusal;
use crate::options;
use crate::state::State;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, EmitOptions, Settings, Stage};

/// A kernel: one of the catalogue, or the text that the page's visitor has made of it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct KernelText {
    /// Its name in the catalogue.
    pub id: String,
    /// The function that is the kernel; of the catalogue's own text it need not be given.
    #[serde(default)]
    pub function: String,
    /// Its files, where they have been changed.
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

/// A kernel in one form, in the words of the command line.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Asked {
    /// Which kernel.
    pub kernel: KernelText,
    /// Options that are not at their defaults.
    #[serde(default)]
    pub options: BTreeMap<String, String>,
    /// `full`, `none` or a factor; without one, `full`.
    #[serde(default)]
    pub unroll: Option<String>,
    /// `as-loops`, `keep` or `select`.
    #[serde(default)]
    pub branches: Option<String>,
    /// `strict`, `exact` or `fast`.
    #[serde(default)]
    pub math: Option<String>,
    /// `subgroup`, `derivatives` or `block`.
    #[serde(default)]
    pub transport: Option<String>,
    /// Pixels of an invocation.
    #[serde(default)]
    pub block: Option<[u32; 2]>,
}

/// A kernel in one form, and the shaders that are wanted of it.
#[derive(Deserialize)]
pub struct CompileRequest {
    #[serde(flatten)]
    asked: Asked,
    /// A shader for each.
    #[serde(default)]
    shaders: Vec<ShaderAsked>,
}

/// A shader in some languages.
#[derive(Deserialize)]
struct ShaderAsked {
    stage: Stage,
    format: String,
    targets: Vec<String>,
}

impl KernelText {
    /// The kernel's function and files.
    pub fn source(&self, state: &mut State) -> Result<Value, Refusal> {
        let kernel = state.kernel(self)?;
        let files = kernel.files().iter();
        let files = files.map(|file| json!({ "path": file.path, "text": file.text }));
        Ok(json!({ "function": kernel.name(), "files": files.collect::<Vec<_>>() }))
    }
}

impl Asked {
    /// As the generator takes them.
    pub fn settings(&self) -> Result<Settings, Refusal> {
        fn parsed<T: std::str::FromStr<Err = String>>(text: &Option<String>) -> Result<Option<T>, Refusal> {
            text.as_ref()
                .map(|text| text.parse().map_err(|why: String| Refusal::of(&why)))
                .transpose()
        }
        let options = self.options.iter();
        Ok(Settings {
            options: options.map(|(name, value)| (name.clone(), value.clone())).collect(),
            unroll: parsed(&self.unroll)?.unwrap_or_default(),
            branches: parsed(&self.branches)?.unwrap_or_default(),
            math: parsed(&self.math)?.unwrap_or_default(),
            transport: parsed(&self.transport)?,
            block: self.block.unwrap_or([1, 1]),
            ..Settings::default()
        })
    }
}

/// Compiles a kernel and emits it.
pub fn compile(state: &mut State, request: &CompileRequest) -> Result<Value, Refusal> {
    let kernel = state.kernel(&request.asked.kernel)?;
    let infos: Vec<Value> = kernel.options()?.iter().map(options::to_json).collect();
    let compiled = state.compiled(&request.asked)?;
    let shaders = request.shaders.iter().map(|asked| shader(&compiled, asked));
    let shaders = shaders.collect::<Result<Vec<Value>, Refusal>>()?;
    let loops = compiled.loops.iter().map(|report| {
        json!({
            "loop": report.path(), "unroll": report.unroll.to_string(), "copies": report.copies,
            "operations": report.operations, "reason": report.reason,
        })
    });
    Ok(json!({
        "kernel": compiled.kernel,
        "summary": compiled.summary,
        "options": infos,
        "values": compiled.options.spelled(),
        "paper": paper(&compiled),
        "loops": loops.collect::<Vec<_>>(),
        "quad": compiled.quad.is_some() || compiled.transport.is_some(),
        "shaders": shaders,
    }))
}

/// The counts of a built-in kernel's publication, for one pixel.
fn paper(compiled: &Compiled) -> Value {
    compiled.paper().map_or(
        Value::Null,
        |counts| json!({ "texture_reads": counts.texture_reads, "weight_evaluations": counts.weight_evaluations }),
    )
}

/// One shader: its manifest and texts, and the languages that cannot have it with the reason.
fn shader(compiled: &Compiled, asked: &ShaderAsked) -> Result<Value, Refusal> {
    let options = EmitOptions {
        enable_subgroups: true,
        ..EmitOptions::new()
            .stage(asked.stage)
            .format(asked.format.parse().map_err(|why: String| Refusal::of(&why))?)
    };
    let emitted = |targets: &[Target]| compiled.emit(&options.clone().targets(targets.iter().copied()));
    let parsed = asked.targets.iter().map(|name| name.parse());
    let targets = parsed.collect::<Result<Vec<Target>, String>>();
    let targets = targets.map_err(|why| Refusal::of(&why))?;
    let (mut texts, mut refused) = (Map::new(), Map::new());
    let mut take = |files: BTreeMap<Target, Vec<u8>>| {
        for (target, text) in files {
            texts.insert(target.to_string(), json!(String::from_utf8_lossy(&text)));
        }
    };
    // All at once, which is quick; one by one where a language does not have what the kernel needs.
    let manifest = match emitted(&targets) {
        Ok(all) => {
            take(all.files);
            json!(all.manifest)
        }
        Err(_) => {
            let mut common = emitted(&[]).ok().map(|all| all.manifest);
            for target in &targets {
                match (emitted(&[*target]), &mut common) {
                    (Ok(one), Some(manifest)) => {
                        manifest.entry_points.extend(one.manifest.entry_points);
                        manifest.hashes.extend(one.manifest.hashes);
                        take(one.files);
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
    Ok(json!({ "stage": asked.stage, "manifest": manifest, "texts": texts, "refused": refused }))
}

/// The first error with its help, in a line.
fn in_a_line(errors: &Errors) -> String {
    let help = errors.diagnostics.first().and_then(|first| first.help.as_deref());
    let help = help.map_or_else(String::new, |help| format!("; {help}"));
    errors.first_message().to_owned() + &help
}
