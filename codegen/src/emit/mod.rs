//! From a scheduled graph to text that reads as if written by a careful person.
//!
//! Emission makes no decisions about the computation: every step of the schedule becomes a statement or part of one. The
//! printers of this module write WGSL, GLSL and HLSL. naga validates the WGSL, and translates it to SPIR-V and MSL.

mod ast;
mod bindings;
mod comments;
mod derived;
mod entry;
mod function;
mod half;
mod host_reads;
mod language_bindings;
mod layout;
mod legalise;
mod literals;
mod liveness;
mod lower;
mod manifest;
mod missing;
mod names;
mod origin;
mod outputs;
mod own_words;
mod places;
mod print;
mod prose;
mod refusal;
mod resources;
mod shader;
mod source_map;
mod spelled;
mod spirv;
mod statements;
mod text;
mod tidy;
mod translate;
mod variables;
mod words;

pub use crate::spec::{DebugInfo, EmitOptions, Parameters, Register, Target, Texels};

use crate::compiled::Compiled;
use refusal::Refusal;
use shader::{Shader, Wgsl, kernel_tree, shader_tree};
use statements::count_text;
use std::borrow::Cow;
use std::collections::BTreeMap;
use straightline_evaluator::diagnostic::{Code, Errors};
use straightline_evaluator::eval::LoopReport;
use straightline_evaluator::ir::Invocation;
use straightline_evaluator::limits::{self, Meter};
use straightline_evaluator::policy::Transport;
use straightline_kernels::HalfPrecision;
use straightline_manifest::{Counts, Format, Manifest, Precision, SourceMap, Stage, hash_of_bytes, hash_of_text};

pub use bindings::{
    Axis, CandidatesModule, ChainModule, Module, Modules, VariantsModule, render_bindings, render_plain_bindings,
    value_words,
};
pub use prose::single_line_comment;
pub use statements::{statements_at_least, statements_at_most};
pub use words::is_among;

/// A shader in the requested languages.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Emitted {
    /// Description for the host; the file names in it are set by [`Emitted::named_files`].
    pub manifest: Manifest,
    /// Contents by language.
    pub files: BTreeMap<Target, Vec<u8>>,
    /// Places of the texts' statements in the kernel's source, if debug information was requested.
    pub source_map: Option<SourceMap>,
}

impl Emitted {
    /// Returns the text in WGSL; empty if it was not requested.
    pub fn wgsl(&self) -> &str {
        let bytes = self.files.get(&Target::Wgsl).map(Vec::as_slice).unwrap_or_default();
        std::str::from_utf8(bytes).unwrap_or_default()
    }

    /// Returns the files by name, and the manifest with these names: `stem.wgsl`, `stem.json`, and with
    /// debug information `stem.map.json`.
    pub fn named_files(&self, stem: &str) -> BTreeMap<String, Vec<u8>> {
        let mut manifest = self.manifest.clone();
        let mut files = BTreeMap::new();
        for (target, bytes) in &self.files {
            let name = format!("{stem}.{}", target.extension(manifest.stage, manifest.form));
            manifest.files.insert(target.to_string(), name.clone());
            files.insert(name, bytes.clone());
        }
        files.insert(format!("{stem}.json"), manifest.to_json().into_bytes());
        if let Some(map) = &self.source_map {
            files.insert(format!("{stem}.map.json"), map.to_json().into_bytes());
        }
        files
    }
}

/// Returns the kernel in the form that invocations of the stage compute.
fn for_stage(compiled: &Compiled, stage: Stage) -> Result<Cow<'_, Compiled>, Refusal> {
    let kernel = &compiled.kernel;
    let refused = |why: String, help: &str| {
        let what = format!("`{kernel}` {why}");
        Err(Refusal::new(Code::StageUnfit, what).help(help))
    };
    match (compiled.graph.invocation, stage) {
        (Invocation::Lane, Stage::Compute) => match compiled.transport {
            None => Ok(compiled.in_blocks()),
            Some(transport) => refused(
                format!("sends messages by {transport}, and compute shaders have no pixel quads"),
                "emit it for fragment, or use the transport `block`",
            ),
        },
        (Invocation::Group(_), Stage::Fragment) if compiled.sharing.is_some() => refused(
            "shares texels by workgroup, and fragments and functions are in none".to_owned(),
            "emit it for compute, or leave `share` out",
        ),
        (Invocation::Group(_), Stage::Fragment) => refused(
            "is a kernel of workgroups, which fragments and functions are not in".to_owned(),
            "emit it for compute",
        ),
        (Invocation::Block(size), Stage::Fragment) if size != [1, 1] => refused(
            "computes a block of pixels, and a fragment writes one".to_owned(),
            "emit it for compute",
        ),
        _ => Ok(Cow::Borrowed(compiled)),
    }
}

impl Compiled {
    /// Texel formats of everything that the kernel writes, in the order of the shader's outputs; `colour` is that of three and
    /// four floats.
    pub fn target_formats(&self, colour: Format) -> Vec<Format> {
        let targets = self.graph.written_targets();
        targets
            .map(|target| outputs::BoundOutput::new(target, colour).format)
            .collect()
    }

    /// Returns the counts, including those of the kernel body's text, which are the same in every language and stage.
    pub fn text_counts(&self) -> Counts {
        let mut counts = self.counts.clone();
        count_text(&kernel_tree(self, Precision::F32), &self.graph, &mut counts);
        counts
    }

    /// Returns the manifest of the shader that [`Compiled::emit`] would write, without texts, files and hashes. Much faster
    /// than emission, since nothing is validated.
    ///
    /// # Errors
    ///
    /// As for [`Compiled::emit`].
    pub fn describe(&self, options: &EmitOptions) -> Result<Manifest, Errors> {
        let described = || {
            let _meter = Meter::resume(self.limits, self.time);
            let (compiled, resources) = plan_emission(self, options)?;
            let (_, counts) = shader_tree(&compiled, &resources);
            within_limits(&compiled, counts.statements, limits::exceeded_limit(0))?;
            resources.build_manifest(&compiled, &counts)
        };
        described().map_err(|refusal: Refusal| refusal.into_errors(self))
    }

    /// Emits the kernel as a shader, in every requested language.
    ///
    /// # Errors
    ///
    /// Codes E07xx: a feature that the stage or the language lacks, at the input that needs it or at the kernel.
    pub fn emit(&self, options: &EmitOptions) -> Result<Emitted, Errors> {
        emit_compiled(self, options).map_err(|refusal| refusal.into_errors(self))
    }
}

/// Fails if a limit is exceeded.
fn within_limits(compiled: &Compiled, statements: u32, excess: Option<limits::Excess>) -> Result<(), Refusal> {
    let Some(excess) = excess else { return Ok(()) };
    let largest = compiled.loops.iter().max_by_key(|report| report.operations);
    let named = |report: &LoopReport| {
        format!(
            ", most of them of the loop `{}` with {} copies",
            report.policy_path(),
            report.copies
        )
    };
    let what = format!(
        "emitting `{}` takes {excess}, with {statements} statements{}",
        compiled.kernel,
        largest.map(named).unwrap_or_default()
    );
    Err(Refusal::new(Code::Limit, what).help(excess.help()))
}

/// Returns the kernel in the form to be written, and the shader's bindings.
fn plan_emission<'c>(
    compiled: &'c Compiled,
    options: &EmitOptions,
) -> Result<(Cow<'c, Compiled>, resources::Resources), Refusal> {
    if let Some([x, y]) = options.workgroup
        && (x == 0 || y == 0 || x.saturating_mul(y) > 1024)
    {
        let what = format!("a workgroup of {x}x{y} is not possible");
        return Err(Refusal::new(Code::WorkgroupSize, what)
            .help("each side is at least 1, and both together at most 1024 invocations"));
    }
    if options.workgroup.is_some() && (options.stage == Stage::Fragment || options.is_function()) {
        let what = format!(
            "`{}` is to be a fragment shader or a function, which have no workgroup",
            compiled.kernel
        );
        return Err(Refusal::new(Code::StageUnfit, what).help("leave `workgroup` out, or emit it for compute"));
    }
    if !options.is_function() && (options.texels == Texels::Functions || options.global_uniforms) {
        let what = format!(
            "`{}` is to be a whole shader, which binds what it reads itself",
            compiled.kernel
        );
        return Err(Refusal::new(Code::UnfitSetting, what)
            .help("leave `texels` and `global-uniforms` out, or emit the form `function`"));
    }
    if options.precision == Precision::F16
        && !options.accept_loss
        && let HalfPrecision::Lost(reason) = compiled.half_precision()
    {
        let what = format!("`{}` in f16 does not keep what can be seen: {reason}", compiled.kernel);
        return Err(Refusal::new(Code::VisibleLoss, what).help(
            "emit it in f32, or with options that keep it (`study hard --precision f16` tells which do); where your scenes do not \
             show the loss, which `tune` measures, accept it: `--accept-loss`, or `.accept_loss(true)` in build.rs",
        ));
    }
    if options.precision == Precision::F16 && !compiled.gathered.is_empty() {
        let what = format!(
            "`{}` gathers texels, and half precision does not hold where they lie",
            compiled.kernel
        );
        return Err(Refusal::new(Code::HalfGathers, what).help("leave `reads` or the precision out"));
    }
    let mut options = options.clone();
    if options.is_function() {
        options.stage = Stage::Fragment;
    }
    let compiled = match for_stage(compiled, options.stage)? {
        Cow::Borrowed(compiled) => origin::apply_origin(compiled, &options)?,
        Cow::Owned(compiled) => Cow::Owned(origin::apply_origin(&compiled, &options)?.into_owned()),
    };
    let resources = resources::Resources::from_compiled(&compiled, &options)?;
    if options.is_function() {
        function::check_function_form(&compiled, &resources)?;
        host_reads::check_host_reads(&compiled, &resources)?;
    }
    Ok((compiled, resources))
}

/// Emits a kernel. Only text validated by naga is returned.
fn emit_compiled(compiled: &Compiled, options: &EmitOptions) -> Result<Emitted, Refusal> {
    let _meter = Meter::resume(compiled.limits, compiled.time);
    let (compiled, resources) = plan_emission(compiled, options)?;
    let (compiled, options) = (&*compiled, &resources.options);
    let (tree, counts) = shader_tree(compiled, &resources);
    let statements = counts.statements;
    within_limits(
        compiled,
        statements,
        limits::would_exceed(translate::time_to_parse(statements)),
    )?;
    let shader = Shader {
        compiled,
        resources: &resources,
        tree: &tree,
        wgsl: Wgsl::new(&tree, &resources, false)?,
    };
    let module = shader.validated_module(&counts, false)?;
    let mut manifest = resources.build_manifest(compiled, &counts)?;
    let mut files = BTreeMap::new();
    let mut source_map = (options.debug != DebugInfo::None).then(|| source_map::empty_map(&resources));
    let mut map = |target: Target, text: print::PrintedText<'_>| {
        if let Some(map) = &mut source_map {
            source_map::add_text(map, target, &text, compiled);
        }
        text.text.into_bytes()
    };
    for target in &options.targets {
        within_limits(compiled, statements, limits::exceeded_limit(0))?;
        let bytes = match target {
            Target::Wgsl => map(Target::Wgsl, shader.print_wgsl(&counts)?),
            Target::Glsl450 | Target::Glsl430 | Target::Glsl330 | Target::Essl310 | Target::Essl300 => {
                missing::check_features(compiled, &resources, *target)?;
                if !options.is_function() {
                    manifest.entry_points.insert(target.to_string(), "main".to_owned());
                }
                let (text, is_validated) = shader.print_glsl(*target, &counts)?;
                manifest.validated.extend(is_validated.then(|| target.to_string()));
                map(*target, text)
            }
            Target::Spirv => {
                let words = match tree.has_exact() || !resources.overrides.is_empty() {
                    true => shader.validated_module(&counts, true)?.to_spirv(&resources, compiled)?,
                    false => module.to_spirv(&resources, compiled)?,
                };
                words.iter().flat_map(|word| word.to_le_bytes()).collect()
            }
            Target::Hlsl => map(Target::Hlsl, shader.print_hlsl(&counts)?),
            Target::Msl if let Some((_, bound)) = resources.overrides.first() => {
                let what = format!(
                    "`{}` overrides `{}`, and msl has its options as constants",
                    compiled.kernel, bound.of.name
                );
                let help = "set it for this text, or let it be a uniform: `--set OPTION=uniform`; wgpu makes pipelines of the WGSL on Metal \
                            too";
                return Err(Refusal::new(Code::NotInTarget, what).help(help));
            }
            Target::Msl if compiled.transport == Some(Transport::Derivatives) => {
                let what = format!(
                    "`{}` sends messages by fine derivatives, which msl does not have",
                    compiled.kernel
                );
                return Err(Refusal::new(Code::NotInTarget, what).help("use the transport `subgroup` or `block`"));
            }
            Target::Msl => {
                let (text, name) = module.to_msl(&resources)?;
                if name != resources.entry {
                    manifest.entry_points.insert(target.to_string(), name);
                }
                let mut header = print::header_lines(compiled, &counts, &resources);
                if !options.strip_comments {
                    header.push(
                        "Translated by naga; resources are bound at the numbers of the manifest, each kind by itself."
                            .to_owned(),
                    );
                }
                format!("{}\n{text}", print::header_comment(&header)).into_bytes()
            }
        };
        let hash = match std::str::from_utf8(&bytes) {
            Ok(text) if *target != Target::Spirv => hash_of_text(text),
            _ => hash_of_bytes(&bytes),
        };
        // SPIR-V and MSL are translations of the validated module.
        if matches!(target, Target::Wgsl | Target::Spirv | Target::Msl) {
            manifest.validated.insert(target.to_string());
        }
        manifest.hashes.insert(target.to_string(), hash);
        files.insert(*target, bytes);
    }
    Ok(Emitted {
        manifest,
        files,
        source_map,
    })
}
