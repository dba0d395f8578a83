//! An engine: its folder, and the files that it makes of a kernel.

use crate::context::{self, Context};
use crate::description::{Converted, Description, ShaderDescription, SizeSource};
use crate::error::EngineError;
use crate::fits::Misfit;
use crate::inputs::Inputs;
use crate::shader_context::{self, ShaderScope};
use crate::{builtin, engine_names, fits, spelling};
use std::collections::BTreeMap;
use std::path::Path;
use straightline_codegen::diagnostic::{Diagnostic, Errors};
use straightline_codegen::emit::{Emitted, Target, Texels, single_line_comment};
use straightline_codegen::{Compiled, EmitOptions, OptionInfo, Stage};
use straightline_manifest::Manifest;

/// Input of an engine: a kernel, and how to write it.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// The kernel.
    pub compiled: &'a Compiled,
    /// The kernel's options, which document its uniforms.
    pub options: &'a [OptionInfo],
    /// Name of the files, without extension.
    pub name: String,
    /// Options of the emitted text; the engine's own choices ([`FIXED`](crate::FIXED)) override them.
    pub emit: EmitOptions,
    /// Meaning of an input by its name, where its name does not say it: a [`Meaning`](crate::Meaning)'s name, or
    /// [`OWN`](crate::OWN) for an input that the user sets.
    pub binds: BTreeMap<String, String>,
}

impl<'a> Request<'a> {
    /// A kernel in full precision, in files of its name.
    pub fn new(compiled: &'a Compiled, options: &'a [OptionInfo]) -> Request<'a> {
        Request {
            compiled,
            options,
            name: compiled.kernel.clone(),
            emit: EmitOptions::new(),
            binds: BTreeMap::new(),
        }
    }

    /// Gives an input a meaning, or makes it the user's own.
    pub fn bind(mut self, input: &str, meaning: &str) -> Request<'a> {
        self.binds.insert(input.to_owned(), meaning.to_owned());
        self
    }
}

/// An engine.
#[derive(Clone, Debug)]
pub struct Engine {
    pub(crate) name: String,
    pub(crate) description: Description,
    /// Templates of a folder; a built-in engine's are looked up when they are rendered.
    pub(crate) templates: Option<BTreeMap<String, String>>,
}

impl Engine {
    /// The built-in engine of this name, or else the one in the folder of this path.
    ///
    /// # Errors
    ///
    /// There is neither, or the folder holds no engine.
    pub fn find(name: &str) -> Result<Engine, EngineError> {
        if let Some(engine) = Engine::builtin(name) {
            return Ok(engine);
        }
        let folder = Path::new(name);
        if folder.join("engine.toml").exists() {
            return Engine::from_folder(folder);
        }
        Err(EngineError::Unknown {
            name: name.to_owned(),
            known: engine_names().collect::<Vec<_>>().join(", "),
        })
    }

    /// The built-in engine of this name.
    pub fn builtin(name: &str) -> Option<Engine> {
        let (name, description) = builtin::DESCRIPTIONS.iter().find(|(known, _)| *known == name)?;
        Some(Engine {
            name: (*name).to_owned(),
            description: serde_json::from_str(description).ok()?,
            templates: None,
        })
    }

    /// Returns the engine's name: that of its folder.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the engine's description: its `engine.toml`.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// Returns the files of a kernel, by name.
    ///
    /// # Errors
    ///
    /// If the kernel does not fit, with a suggestion; or if a template fails.
    pub fn render_files(&self, request: &Request<'_>) -> Result<BTreeMap<String, Vec<u8>>, EngineError> {
        let context = serde_json::to_value(self.context(request)?);
        self.render(context.map_err(|e| self.description_error(e.to_string()))?)
    }

    /// Returns the context of the templates for a kernel.
    ///
    /// # Errors
    ///
    /// If the kernel does not fit, with a suggestion.
    pub fn context(&self, request: &Request<'_>) -> Result<Context, EngineError> {
        let (inputs, shaders) = self.emit_shaders(request).map_err(|unfit| {
            let compiled = request.compiled;
            let what = format!("`{}` does not fit {}", compiled.kernel, self.description.title);
            let instead = other_engines(self, |other| other.fits_kernel(request));
            unfit
                .of_subject("it")
                .into_errors(&what, instead, |error, input| compiled.locate_error(error, input))
        })?;
        Ok(self.context_of(request, &inputs, shaders))
    }

    /// Returns whether a kernel fits: every shader can be emitted, and all that it binds can be bound.
    pub fn fits_kernel(&self, request: &Request<'_>) -> bool {
        self.emit_shaders(request).is_ok()
    }

    /// The inputs that the engine provides to a kernel, and its shaders by the names of `engine.toml`.
    pub(crate) fn emit_shaders(&self, request: &Request<'_>) -> Result<(Inputs, BTreeMap<String, Shader>), Unfit> {
        // Errors of bindings are reported before those of a language: a user can understand them.
        let stage = self.description.shaders.values().next().map(ShaderDescription::stage);
        let probe = EmitOptions::new()
            .stage(stage.unwrap_or(Stage::Fragment))
            .precision(request.emit.precision)
            .accept_loss(request.emit.accept_loss);
        let limits = &self.description.limits;
        let manifest = match request.compiled.emit(&probe) {
            Ok(emitted) => emitted.manifest,
            Err(error) => return Err(error.into()),
        };
        let inputs = Inputs::resolve(&manifest, &self.description, &request.binds).map_err(Unfit::Engine)?;
        let misfit = fits::why_not(&manifest, &inputs, limits, &self.description.title)
            .or_else(|| inputs.find_unknown(&manifest, &self.description));
        if let Some(misfit) = misfit {
            return Err(Unfit::Engine(misfit));
        }
        let each = self.description.shaders.iter().map(|(name, description)| {
            let shader = Shader::from_request(&self.description, description, request, &inputs, &manifest)?;
            if let Some(misfit) = fits::find_filtered(&shader.manifest, &inputs, &self.description.title) {
                return Err(Unfit::Engine(misfit));
            }
            // An origin at the lower left needs the size where the kernel does not.
            if let Some(misfit) = fits::find_unknown_size(&shader.manifest, limits, &self.description.title) {
                return Err(Unfit::Engine(misfit));
            }
            Ok((name.clone(), shader))
        });
        let shaders = each.collect::<Result<_, Unfit>>()?;
        Ok((inputs, shaders))
    }

    pub(crate) fn context_of(
        &self,
        request: &Request<'_>,
        inputs: &Inputs,
        shaders: BTreeMap<String, Shader>,
    ) -> Context {
        let (compiled, name) = (request.compiled, &request.name);
        let first = shaders.values().next();
        let mut context = Context {
            name: name.clone(),
            kernel: compiled.kernel.clone(),
            class: spelling::class_name(name, &self.description.words),
            title: single_line_comment(&spelling::title(name)),
            summary: single_line_comment(&compiled.summary),
            generator: String::new(),
            engine: single_line_comment(&self.name),
            textures: Vec::new(),
            picture: None,
            given: Vec::new(),
            own: Vec::new(),
            samplers: Vec::new(),
            uniforms: Vec::new(),
            resolution: None,
            provided: context::provided_contexts(inputs, &self.description),
            meanings: context::used_meanings(inputs),
            block: None,
            outputs: Vec::new(),
            shaders: BTreeMap::new(),
            shader: None,
            changed: Vec::new(),
        };
        // The bindings are the same for every shader of a kernel.
        if let Some(Shader { manifest, .. }) = first {
            context.generator.clone_from(&manifest.generator);
            context.textures = context::texture_contexts(manifest, inputs);
            context.picture = context::filtered_texture(&context.textures);
            let given = context
                .textures
                .iter()
                .filter(|texture| !inputs.is_converted(&texture.name));
            context.given = given.cloned().collect();
            context.own = context.textures.iter().filter(|texture| texture.own).cloned().collect();
            context.samplers = context::sampler_contexts(manifest);
            (context.uniforms, context.block) = context::uniform_contexts(manifest, request.options);
            context.uniforms.retain(|uniform| inputs.meaning(&uniform.of).is_none());
            context.outputs = context::output_contexts(manifest);
        }
        let fills_size = self.description.limits.resolution == Some(SizeSource::Filled);
        if fills_size {
            let mut sized = shaders.values().map(|shader| context::size_context(&shader.manifest));
            context.resolution = sized.find_map(|size| size);
            context.uniforms.retain(|uniform| !uniform.is_size);
        }
        let changed = compiled
            .changed
            .iter()
            .filter_map(|name| Some((name, compiled.options.get(name)?)));
        context.changed = changed
            .map(|(name, value)| single_line_comment(&format!("{name}={value}")))
            .collect();
        context.shaders = shaders
            .into_iter()
            .map(|(name, shader)| {
                let scope = ShaderScope {
                    name: &name,
                    takes_uniforms: shader.takes_uniforms,
                    fills_size,
                    target: shader.target,
                    inputs,
                    meanings: &self.description.meanings,
                };
                let context = shader_context::shader_context(shader.text, &shader.manifest, &scope);
                (name, context)
            })
            .collect();
        if context.shaders.len() == 1 {
            context.shader = context.shaders.values().next().cloned();
        }
        context
    }

    pub(crate) fn description_error(&self, message: String) -> EngineError {
        EngineError::Description {
            engine: self.name.clone(),
            message,
        }
    }
}

/// A shader of a kernel.
pub(crate) struct Shader {
    text: String,
    takes_uniforms: bool,
    target: Target,
    manifest: Manifest,
}

impl Shader {
    /// `bound` is the manifest of the kernel for any engine.
    fn from_request(
        engine: &Description,
        description: &ShaderDescription,
        request: &Request<'_>,
        inputs: &Inputs,
        bound: &Manifest,
    ) -> Result<Shader, Unfit> {
        let unknown = |why: String| Unfit::Engine(Misfit::new(why));
        let mut options = description.emit_options(&request.emit).map_err(unknown)?;
        options.reserved.clone_from(&engine.words);
        // Names are clear of every language of the engine: a host has one name for a resource in all of its shaders.
        let languages = engine.shaders.values().map(|shader| shader.target().map_err(unknown));
        options.clear_of = languages.collect::<Result<_, _>>()?;
        options.bindings = description
            .numbers
            .map_or_else(Vec::new, |numbers| numbers.number_bindings(bound));
        let converts = bound.bindings.iter().any(|binding| inputs.is_converted(&binding.name));
        if converts && description.converted == Converted::Functions {
            options.texels = Texels::Functions;
        }
        let emitted = request.compiled.emit(&options)?;
        let target = description.target().map_err(unknown)?;
        Ok(Shader {
            text: shader_text(&emitted, target),
            target,
            takes_uniforms: !options.global_uniforms,
            manifest: emitted.manifest,
        })
    }
}

fn shader_text(emitted: &Emitted, target: Target) -> String {
    let bytes = emitted.files.get(&target).cloned().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}

/// Reason why a kernel or chain does not fit.
pub(crate) enum Unfit {
    /// The engine cannot bind a resource of it.
    Engine(Misfit),
    /// The generator cannot emit it in this form.
    Emit(Errors),
}

impl From<Errors> for Unfit {
    fn from(errors: Errors) -> Unfit {
        Unfit::Emit(errors)
    }
}

impl Unfit {
    /// Says of what a misfit is stated: of `it`, or of a pass.
    pub(crate) fn of_subject(mut self, subject: &str) -> Unfit {
        if let Unfit::Engine(misfit) = &mut self {
            misfit.why = format!("{subject} {}", misfit.why);
        }
        self
    }

    /// The error at its place, with the engines that would fit. `what` is the beginning of the message, `locate` adds the place.
    pub(crate) fn into_errors(
        self,
        what: &str,
        instead: String,
        locate: impl FnOnce(Diagnostic, Option<&str>) -> Errors,
    ) -> Errors {
        match self {
            Unfit::Engine(Misfit { why, input, code, help }) => {
                let mut error = Diagnostic::new(code, format!("{what}: {why}"));
                match help {
                    Some(help) => {
                        error.notes.push(instead);
                        error = error.help(help);
                    }
                    None => error = error.help(instead),
                }
                locate(error, input.as_deref())
            }
            Unfit::Emit(mut errors) => {
                for error in &mut errors.diagnostics {
                    error.message = format!("{what}: {}", error.message);
                    error.notes.push(instead.clone());
                }
                errors
            }
        }
    }
}

/// Lists the other built-in engines that fit.
pub(crate) fn other_engines(engine: &Engine, fits: impl Fn(&Engine) -> bool) -> String {
    let others = engine_names().filter(|name| *name != engine.name);
    let fitting = others.filter(|name| Engine::builtin(name).is_some_and(|other| fits(&other)));
    match fitting.collect::<Vec<_>>().join(", ") {
        none if none.is_empty() => "no built-in engine takes it: `--target` writes the shader alone".to_owned(),
        some => format!("these engines take it: {some}"),
    }
}
