//! Chains of several passes for engines: one host for all passes, which owns the pictures between them.
//!
//! An engine takes chains if its `engine.toml` has a table `[chain]` ([`ChainDescription`]). Every pass is then a kernel of the
//! engine, and the templates of the chain are given all of them, with what each reads and draws ([`ChainContext`]).

mod bound;
mod context;
mod description;
mod passes;
mod scale;
mod size;

pub use context::{ChainContext, ChainTextureContext, MemoryContext, PassContext, SourceContext};
pub use description::{ChainDescription, SizeForm};
pub use scale::ScaleContext;

use crate::context::{self as kernel_context};
use crate::description::ShaderDescription;
use crate::engine::{Engine, Request, Unfit, other_engines};
use crate::error::EngineError;
use crate::fits::{self, Misfit};
use crate::inputs::Inputs;
use crate::render::Sheet;
use crate::spelling;
use passes::Passes;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use straightline_codegen::chain::{ChainPlan, CompiledChain, EmittedChain, SizeRule};
use straightline_codegen::emit::single_line_comment;
use straightline_codegen::{EmitOptions, OptionInfo, Stage};
use straightline_manifest::Manifest;

/// Input of an engine: a chain, and how to write it.
#[derive(Clone, Debug)]
pub struct ChainRequest<'a> {
    /// The chain.
    pub compiled: &'a CompiledChain,
    /// The chain's options, which document its uniforms.
    pub options: &'a [OptionInfo],
    /// Name of the files, without extension.
    pub name: String,
    /// Options of the emitted texts; the engine's own choices ([`FIXED`](crate::FIXED)) override them, and each pass has its
    /// own format.
    pub emit: EmitOptions,
    /// Meaning of an input by its name in the chain, as of [`Request`].
    pub binds: BTreeMap<String, String>,
}

impl<'a> ChainRequest<'a> {
    /// A chain in full precision, in files of its name.
    pub fn new(compiled: &'a CompiledChain, options: &'a [OptionInfo]) -> ChainRequest<'a> {
        ChainRequest {
            compiled,
            options,
            name: compiled.name.clone(),
            emit: EmitOptions::new(),
            binds: BTreeMap::new(),
        }
    }

    /// Gives an input a meaning, or makes it the user's own.
    pub fn bind(mut self, input: &str, meaning: &str) -> ChainRequest<'a> {
        self.binds.insert(input.to_owned(), meaning.to_owned());
        self
    }
}

impl Engine {
    /// Returns the files of a chain, by name. One of a single pass is a kernel.
    ///
    /// # Errors
    ///
    /// If the chain does not fit, with a suggestion; or if a template fails.
    pub fn render_chain_files(&self, request: &ChainRequest<'_>) -> Result<BTreeMap<String, Vec<u8>>, EngineError> {
        if let ([pass], []) = (request.compiled.passes.as_slice(), request.compiled.shared.as_slice()) {
            let kernel = Request::new(request.compiled.kernel_of(pass), request.options);
            return self.render_files(&Request {
                name: request.name.clone(),
                emit: request.emit.clone().format(pass.format),
                binds: request.binds.clone(),
                ..kernel
            });
        }
        let context = self.chain_context(request)?;
        let wrong = |e: serde_json::Error| self.description_error(e.to_string());
        let whole = serde_json::to_value(&context).map_err(wrong)?;
        let description = self.description().chain.as_ref();
        let (files, pass_files) = description.map_or_else(Default::default, |chain| {
            (chain.files.clone(), chain.pass_files.clone())
        });
        let mut sheets = Vec::new();
        if !pass_files.is_empty() {
            for pass in &context.passes {
                let mut value = whole.clone();
                value["pass"] = json!(pass);
                value["shader"] = whole["shaders"].get(pass.shader).cloned().unwrap_or(Value::Null);
                sheets.push(Sheet {
                    files: pass_files.clone(),
                    context: value,
                });
            }
        }
        sheets.push(Sheet { files, context: whole });
        self.render_sheets(sheets)
    }

    /// Returns the context of the templates for a chain.
    ///
    /// # Errors
    ///
    /// If the chain does not fit, with a suggestion.
    pub fn chain_context(&self, request: &ChainRequest<'_>) -> Result<ChainContext, EngineError> {
        let context = self.fit_chain(request).map_err(|unfit| {
            let compiled = request.compiled;
            let what = format!("`{}` does not fit {}", compiled.name, self.description().title);
            let instead = other_engines(self, |other| other.fits_chain(request));
            unfit.into_errors(&what, instead, |error, _| compiled.locate_error(error))
        })?;
        Ok(context)
    }

    /// Returns whether a chain fits: every shader can be emitted, and all that it binds can be bound.
    pub fn fits_chain(&self, request: &ChainRequest<'_>) -> bool {
        self.fit_chain(request).is_ok()
    }

    fn fit_chain(&self, request: &ChainRequest<'_>) -> Result<ChainContext, Unfit> {
        let title = &self.description().title;
        if let Some(shared) = request.compiled.shared.first() {
            let last = shared.cascade.tiles.last().map_or("", |tile| &tile.name);
            let why =
                format!("computes `{last}` and others in the memory of workgroups, and {title} draws single pictures");
            let help = "leave `share` out of `--fuse`".to_owned();
            return Err(Unfit::Engine(Misfit::new(format!("it {why}")).help(help)));
        }
        let (Some(engine), Some(chain)) = (self.of_passes(), &self.description().chain) else {
            let why = format!("it has {} passes, and {title} takes one", request.compiled.passes.len());
            let help = "`--fuse all` makes one pass of pictures that no sampler reads";
            return Err(Unfit::Engine(Misfit::new(why).help(help.to_owned())));
        };
        let unfit = |misfit: Misfit| Unfit::Engine(misfit).of_subject("it");
        let count = request.compiled.passes.len();
        if let Some(most) = chain.passes.filter(|most| count > *most) {
            return Err(unfit(Misfit::new(format!(
                "has {count} passes, and {title} takes {most}"
            ))));
        }
        let stage = engine.description().shaders.values().next();
        let probe = EmitOptions::new()
            .stage(stage.map_or(Stage::Fragment, ShaderDescription::stage))
            .precision(request.emit.precision)
            .accept_loss(request.emit.accept_loss);
        let emitted = request.compiled.emit_as(&probe)?;
        let bound = bound::bound_manifest(request.compiled, &emitted);
        let bound = bound.ok_or_else(|| unfit(Misfit::new("draws no picture".to_owned())))?;
        let inputs = Inputs::resolve(&bound, engine.description(), &request.binds).map_err(unfit)?;
        // Each pass has the engine's textures for itself.
        let mut limits = engine.description().limits.clone();
        limits.textures = None;
        let misfit = fits::why_not(&bound, &inputs, &limits, title)
            .or_else(|| inputs.find_unknown(&bound, engine.description()))
            .or_else(|| unknown_format(&emitted.plan, chain, title))
            .or_else(|| other_target(&emitted.plan, chain, &inputs, title));
        if let Some(misfit) = misfit {
            return Err(unfit(misfit));
        }
        let passes = Passes {
            engine: &engine,
            chain,
            request,
            emitted: &emitted,
            bound: &bound,
            inputs: &inputs,
        };
        let shaders = passes.shader_contexts()?;
        let scales = passes.scales().map_err(unfit)?;
        let mut context = self.context_around(request, &bound, &inputs, &emitted);
        context.multiple = scales.as_ref().map(|scales| scales.multiple);
        context.passes = passes.pass_contexts(&shaders, scales.as_ref());
        context.results = passes.result_contexts(&shaders);
        context.memory = passes.memory_contexts(&shaders);
        let last = context.passes.iter().rfind(|pass| pass.result.is_some());
        let last = last.and_then(|pass| shaders.get(pass.shader)?.shaders.values().next_back());
        context.function = last.map_or_else(|| request.compiled.name.clone(), |text| text.function.clone());
        context.shaders = shaders;
        context.name_inputs([&self.description().words, &chain.words]);
        Ok(context)
    }

    /// The context without passes.
    fn context_around(
        &self,
        request: &ChainRequest<'_>,
        bound: &Manifest,
        inputs: &Inputs,
        emitted: &EmittedChain,
    ) -> ChainContext {
        let (compiled, name) = (request.compiled, &request.name);
        let textures = kernel_context::texture_contexts(bound, inputs);
        let (mut uniforms, _) = kernel_context::uniform_contexts(bound, request.options);
        uniforms.retain(|uniform| inputs.meaning(&uniform.of).is_none());
        let sized = emitted.sized_inputs();
        let textures = textures.into_iter().map(|texture| ChainTextureContext {
            sized: sized.contains(texture.name.as_str()),
            texture,
        });
        let textures: Vec<ChainTextureContext> = textures.collect();
        let picture = textures.iter().find(|texture| texture.texture.meaning == Some("color"));
        let changed = compiled.changed.iter();
        ChainContext {
            name: name.clone(),
            chain: compiled.name.clone(),
            function: String::new(),
            class: spelling::class_name(name, &self.description().words),
            title: single_line_comment(&spelling::title(name)),
            summary: single_line_comment(&compiled.summary),
            generator: bound.generator.clone(),
            engine: single_line_comment(self.name()),
            changed: changed
                .map(|(name, value)| single_line_comment(&format!("{name}={value}")))
                .collect(),
            picture: picture.cloned(),
            own: textures.iter().filter(|texture| texture.texture.own).cloned().collect(),
            textures,
            samplers: kernel_context::sampler_contexts(bound),
            uniforms,
            bindings: json!(bound.bindings),
            features: bound.features.clone(),
            provided: kernel_context::provided_contexts(inputs, self.description()),
            meanings: kernel_context::used_meanings(inputs),
            multiple: None,
            shaders: Vec::new(),
            passes: Vec::new(),
            memory: Vec::new(),
            results: Vec::new(),
        }
    }
}

/// Returns the misfit of a picture whose format the engine does not have.
fn unknown_format(plan: &ChainPlan, chain: &ChainDescription, title: &str) -> Option<Misfit> {
    let mut pictures = plan.pictures.iter().filter(|picture| picture.memory.is_some());
    let picture = pictures.find(|picture| chain.format(picture.format).is_none())?;
    let known: Vec<&str> = chain.formats.iter().flatten().map(|(name, _)| name.as_str()).collect();
    let why = format!(
        "stores `{}` in {}, and {title} takes {}",
        picture.name,
        picture.format,
        known.join(", ")
    );
    Some(Misfit::new(why))
}

/// Returns the misfit of a result that does not have the picture's size, or that the last pass does not draw, of an engine
/// whose target is that of the picture.
fn other_target(plan: &ChainPlan, chain: &ChainDescription, inputs: &Inputs, title: &str) -> Option<Misfit> {
    let mut provided = inputs.iter();
    let picture = provided.find(|(_, meaning)| meaning.is_picture()).map(|(name, _)| name);
    if !chain.draws_picture {
        return None;
    }
    if let (Some(result), Some(last)) = (plan.results().next(), plan.passes.last())
        && !last.writes.contains(&result.name)
    {
        let why = format!("draws `{}` after `{}`, which it returns", last.name, result.name);
        return Some(Misfit::new(format!(
            "{why}, and {title} takes what the last pass draws"
        )));
    }
    let has_size = |size: &SizeRule| picture.is_some_and(|picture| *size == SizeRule::of_input(picture));
    let mut others = plan.results().filter(|result| !has_size(&result.size));
    let result = others.next()?;
    let why = format!(
        "returns `{}` of size `{}`, and {title} draws to a target of the picture's size",
        result.name, result.size
    );
    Some(Misfit::new(why))
}
