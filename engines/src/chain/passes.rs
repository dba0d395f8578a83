//! The passes of a chain, each as a kernel of the engine, with what it reads and draws.

use super::context::{MemoryContext, PassContext, SourceContext};
use super::description::{ChainDescription, SizeForm};
use super::scale::{Scales, drawn_size};
use super::{ChainRequest, size};
use crate::context::Context;
use crate::engine::{Engine, Request, Unfit};
use crate::fits::Misfit;
use crate::inputs::{Inputs, whole_name};
use crate::meaning::OWN;
use crate::spelling;
use std::collections::BTreeMap;
use straightline_codegen::chain::{CompiledPass, EmittedChain, PicturePlan, SizeRule};
use straightline_codegen::{Compiled, Format};
use straightline_manifest::{BindingKind, Manifest};

/// The passes of a chain for an engine.
pub struct Passes<'c> {
    /// The engine as it takes passes.
    pub engine: &'c Engine,
    pub chain: &'c ChainDescription,
    pub request: &'c ChainRequest<'c>,
    /// The chain as it is emitted for any engine of this stage.
    pub emitted: &'c EmittedChain,
    /// Bindings of the caller.
    pub bound: &'c Manifest,
    /// Inputs among them that the engine provides.
    pub inputs: &'c Inputs,
}

impl Passes<'_> {
    fn passes(&self) -> &[CompiledPass] {
        &self.request.compiled.passes
    }

    fn shader_names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for pass in self.passes() {
            if !names.contains(&pass.shader.as_str()) {
                names.push(&pass.shader);
            }
        }
        names
    }

    /// Emits each shader once.
    pub fn shader_contexts(&self) -> Result<Vec<Context>, Unfit> {
        // Pictures of earlier passes are textures too.
        let mut engine = self.engine.clone();
        engine.description.limits.own_textures = None;
        let mut contexts: Vec<Context> = Vec::new();
        for name in self.shader_names() {
            let Some(pass) = self.passes().iter().find(|pass| pass.shader == name) else {
                continue;
            };
            let compiled = self.request.compiled.kernel_of(pass);
            let request = self.shader_request(pass, compiled);
            let picture = pass
                .draws
                .first()
                .map_or(name, |index| &self.request.compiled.pictures[*index].name);
            let of_pass = |unfit: Unfit| unfit.of_subject(&format!("its pass `{picture}`"));
            let (inputs, shaders) = engine.emit_shaders(&request).map_err(of_pass)?;
            contexts.push(engine.context_of(&request, &inputs, shaders));
        }
        Ok(contexts)
    }

    /// The kernel of a pass, whose textures are the user's as far as the engine knows.
    fn shader_request<'a>(&'a self, pass: &CompiledPass, compiled: &'a Compiled) -> Request<'a> {
        let manifest = &self.emitted.shaders[&pass.shader].emitted.manifest;
        let mut binds = BTreeMap::new();
        for binding in &manifest.bindings {
            match &binding.kind {
                BindingKind::Texture { .. } => {
                    binds.insert(binding.name.clone(), OWN.to_owned());
                }
                BindingKind::Uniform { fields, .. } if !binding.is_region() => {
                    for field in fields.iter().filter(|field| !field.frame_size) {
                        let name = whole_name(field);
                        let word = self.inputs.meaning(name).map_or(OWN, |meaning| meaning.name);
                        binds.insert(name.to_owned(), word.to_owned());
                    }
                }
                _ => {}
            }
        }
        Request {
            name: pass.shader.clone(),
            emit: self.request.emit.clone().format(pass.format),
            binds,
            ..Request::new(compiled, self.request.options)
        }
    }

    /// Scales of all passes, for an engine that takes sizes so.
    pub fn scales(&self) -> Result<Option<Scales>, Misfit> {
        if self.chain.sizes != SizeForm::Scale {
            return Ok(None);
        }
        let mut provided = self.inputs.iter();
        let picture = provided.find(|(_, meaning)| meaning.is_picture());
        let title = &self.engine.description().title;
        Scales::of_chain(&self.emitted.plan, picture.map(|(name, _)| name), title).map(Some)
    }

    /// Index among the results.
    fn result_of(&self, picture: &str) -> Option<usize> {
        self.emitted.plan.results().position(|result| result.name == picture)
    }

    fn format(&self, format: Format) -> String {
        // A result has the format of the caller's target.
        self.chain.format(format).unwrap_or(format.wgsl_name()).to_owned()
    }

    /// The passes. `shaders` is the result of [`Passes::shader_contexts`].
    pub fn pass_contexts(&self, shaders: &[Context], scales: Option<&Scales>) -> Vec<PassContext> {
        let plan = &self.emitted.plan;
        let each = self.passes().iter().zip(plan.passes.iter()).enumerate();
        let each = each.filter_map(|(index, (compiled, planned))| {
            let picture = plan.picture(&planned.name)?;
            let shader = shaders.iter().position(|shader| shader.name == compiled.shader)?;
            let kernel = shaders.get(shader)?;
            let reads = compiled.reads.iter().filter(|(name, _)| {
                let first = kernel.shaders.values().next();
                let bound = first.and_then(|shader| shader.manifest["bindings"].as_array());
                bound.into_iter().flatten().any(|binding| binding["name"] == **name)
            });
            let reads: BTreeMap<String, SourceContext> = reads
                .map(|(name, source)| (name.clone(), self.source(self.request.compiled.source_name(source))))
                .collect();
            let size = drawn_size(plan, planned)?;
            let framed = kernel.textures.iter().find(|texture| {
                let source = reads.get(&texture.name);
                source.is_some_and(|source| self.size_of(&source.name).as_ref() == Some(size))
            });
            let mut textures: Vec<SourceContext> = Vec::new();
            for source in kernel.textures.iter().filter_map(|texture| reads.get(&texture.name)) {
                if textures.iter().all(|known| known.name != source.name) {
                    textures.push(source.clone());
                }
            }
            let texts = kernel.shaders.values();
            let mut filtered = texts.flat_map(|text| &text.combined).filter(|c| c.filter != "nearest");
            Some(PassContext {
                index,
                name: planned.name.to_string(),
                file: format!("{index}-{}", spelling::spelled_out(&planned.name)),
                shader,
                textures,
                uniforms: Vec::new(),
                memory: picture.memory,
                result: self.result_of(&planned.name),
                format: self.format(picture.format),
                width: size::javascript(size, 0),
                height: size::javascript(size, 1),
                scale: scales.and_then(|scales| scales.passes.get(index).cloned()),
                framed: framed.map(|texture| texture.name.clone()),
                sampled: filtered.next().map(|combined| combined.texture.clone()),
                reads,
            })
        });
        each.collect()
    }

    /// Size of an input or picture.
    fn size_of(&self, name: &str) -> Option<SizeRule> {
        match self.emitted.plan.picture(name) {
            Some(picture) => Some(picture.size.clone()),
            None => self.bound.binding(name).map(|_| SizeRule::of_input(name)),
        }
    }

    fn source(&self, name: &str) -> SourceContext {
        let plan = &self.emitted.plan;
        let picture = plan.picture(name);
        SourceContext {
            name: name.to_owned(),
            spelled: name.to_owned(),
            input: picture.is_none(),
            picture: picture.is_none() && self.inputs.meaning(name).is_some_and(|meaning| meaning.is_picture()),
            memory: picture.and_then(|picture| picture.memory),
            result: self.result_of(name),
            pass: plan
                .passes
                .iter()
                .position(|pass| pass.writes.iter().any(|write| write == name)),
        }
    }

    /// Textures between the passes.
    pub fn memory_contexts(&self, shaders: &[Context]) -> Vec<MemoryContext> {
        let pictures = &self.emitted.plan.pictures;
        let count = pictures.iter().filter_map(|picture| picture.memory).max();
        let numbers = 0..count.map_or(0, |last| last + 1);
        let each = numbers.filter_map(|number| {
            let mut held = pictures.iter().filter(|picture| picture.memory == Some(number));
            let first = held.next()?;
            let mut context = self.memory_context(first, shaders);
            for picture in held {
                context.pictures.push(picture.name.to_string());
                context.filtered |= self.is_filtered(picture, shaders);
            }
            Some(context)
        });
        each.collect()
    }

    /// Textures of the results, which are the caller's.
    pub fn result_contexts(&self, shaders: &[Context]) -> Vec<MemoryContext> {
        let results = self.emitted.plan.results();
        results.map(|picture| self.memory_context(picture, shaders)).collect()
    }

    /// Returns whether a pass reads a picture by a sampler that filters.
    fn is_filtered(&self, picture: &PicturePlan, shaders: &[Context]) -> bool {
        self.passes().iter().any(|pass| {
            let shader = shaders.iter().find(|shader| shader.name == pass.shader);
            let texts = shader.iter().flat_map(|shader| shader.shaders.values());
            let mut filtered = texts.flat_map(|text| &text.combined).filter(|c| c.filter != "nearest");
            filtered.any(|combined| {
                let mut reads = pass.reads.iter();
                let read = reads.find(|(name, _)| *name == combined.texture);
                read.is_some_and(|(_, source)| self.request.compiled.source_name(source) == picture.name)
            })
        })
    }

    fn memory_context(&self, picture: &PicturePlan, shaders: &[Context]) -> MemoryContext {
        let mut passes = self.emitted.plan.passes.iter();
        MemoryContext {
            pictures: vec![picture.name.to_string()],
            format: self.format(picture.format),
            width: size::javascript(&picture.size, 0),
            height: size::javascript(&picture.size, 1),
            size: picture.size.to_string(),
            read: passes.any(|pass| pass.reads.iter().any(|read| read.from == picture.name)),
            filtered: self.is_filtered(picture, shaders),
        }
    }
}
