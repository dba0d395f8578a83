//! A kernel's source: its files, its options, and what they define.

use crate::compiled::Compiled;
use crate::emit::Emitted;
use crate::files::{self, shorten};
use crate::overridden::{self, Overridable, reads_override};
use crate::pipeline::{self, Change, Observer, Source, Start};
use crate::spec::{Settings, ShaderSpec};
use std::borrow::Cow;
use std::path::Path;
use std::sync::{Arc, OnceLock};
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors, File, Span};
use straightline_evaluator::eval::{self, OptionInfo};
use straightline_evaluator::front::chain;
use straightline_evaluator::front::testing::Test;
use straightline_evaluator::front::{self, Library, Parsed};
use straightline_evaluator::infer;
use straightline_evaluator::limits::Meter;
use straightline_evaluator::passes::clean_graph;
use straightline_kernels::{OptionText, OptionValues, Preset};

/// Name of the setting that stands for a set of options.
const PRESET: &str = "preset";

/// Longest file of a kernel that is read, in bytes.
const MAX_SOURCE: u64 = 1 << 24;

/// Function of the files that is the kernel, or is made one.
#[derive(Clone, Debug)]
enum Entry {
    /// The function that the source names.
    Function,
    /// A test.
    Test(Arc<Test>),
    /// The options of a chain, without its passes.
    ChainOptions,
}

/// A kernel's source: its files and which function it is.
#[derive(Clone, Debug)]
pub struct Kernel {
    source: Source,
    entry: Entry,
    /// Items of the files, read once for all variants.
    library: OnceLock<Arc<Library>>,
    described: OnceLock<Arc<[OptionInfo]>>,
}

impl Kernel {
    fn new(source: Source) -> Kernel {
        Kernel {
            source,
            entry: Entry::Function,
            library: OnceLock::new(),
            described: OnceLock::new(),
        }
    }

    /// A kernel that comes with Straightline.
    pub fn builtin(name: &str) -> Result<Kernel, Errors> {
        let Some(entry) = straightline_kernels::find(name) else {
            let known: Vec<&str> = straightline_kernels::CATALOGUE.iter().map(|e| e.name).collect();
            return Err(Errors::from_diagnostic(
                Diagnostic::new(Code::UnknownKernel, format!("there is no kernel `{name}`")).help(format!(
                    "built in: {}; for one of your own give FILE.rs::FUNCTION",
                    known.join(", ")
                )),
            ));
        };
        let files = entry.sources.iter().map(|s| File {
            path: s.path.to_owned(),
            text: s.text.to_owned(),
        });
        Ok(Kernel::new(Source {
            name: name.to_owned(),
            builtin: Some(entry),
            files: Arc::new(files.collect()),
        }))
    }

    /// Makes a kernel from the caller's text. `path` is only shown.
    pub fn from_text(path: &str, text: &str, function: &str) -> Kernel {
        let file = File {
            path: path.to_owned(),
            text: text.to_owned(),
        };
        Kernel::new(Source {
            name: front::unraw(function).to_owned(),
            builtin: None,
            files: Arc::new(vec![file]),
        })
    }

    /// Makes a kernel of a test of the first of `files`.
    pub(crate) fn from_test(files: &Arc<Vec<File>>, test: &Test) -> Kernel {
        let source = Source {
            name: front::unraw(&test.entry).to_owned(),
            builtin: None,
            files: Arc::clone(files),
        };
        Kernel {
            entry: Entry::Test(Arc::new(test.clone())),
            ..Kernel::new(source)
        }
    }

    /// Makes a kernel of the pass `entry` of a chain, which was lowered.
    ///
    /// # Errors
    ///
    /// As [`Kernel::typed_library`].
    pub(crate) fn from_pass(files: &Arc<Vec<File>>, entry: &str, parsed: Parsed) -> Result<Kernel, Errors> {
        let kernel = Kernel::of_chain(files, entry);
        kernel.type_library(parsed)?;
        Ok(kernel)
    }

    /// Makes a kernel that has nothing but the options of a chain.
    pub(crate) fn options_of_chain(files: &Arc<Vec<File>>, chain: &str) -> Kernel {
        Kernel {
            entry: Entry::ChainOptions,
            ..Kernel::of_chain(files, chain)
        }
    }

    fn of_chain(files: &Arc<Vec<File>>, name: &str) -> Kernel {
        Kernel::new(Source {
            name: front::unraw(name).to_owned(),
            builtin: None,
            files: Arc::clone(files),
        })
    }

    /// Reads a kernel from a file of the caller's. Without `function` it is the public function that has the file's name, or else the only
    /// public one with parameters and a result that a kernel can have.
    pub fn from_file(path: &Path, function: Option<&str>) -> Result<Kernel, Errors> {
        let shown = path.display().to_string();
        let text = read_source(path)?;
        let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or("kernel");
        let function = match function {
            Some(function) => function.to_owned(),
            None => front::kernel_of(&text, stem, &shown).map_err(|error| {
                let file = File {
                    path: shown.clone(),
                    text: text.clone(),
                };
                Errors::new(vec![*error], &Arc::new(vec![file]))
            })?,
        };
        Ok(Kernel::from_text(&shown, &text, &function))
    }

    /// Adds a file that the kernel calls functions of.
    pub fn with_file(self, path: &Path) -> Result<Kernel, Errors> {
        Ok(self.with_text(&path.display().to_string(), &read_source(path)?))
    }

    /// Adds the text of a file that the kernel calls functions of. `path` is only shown.
    pub fn with_text(mut self, path: &str, text: &str) -> Kernel {
        Arc::make_mut(&mut self.source.files).push(File {
            path: path.to_owned(),
            text: text.to_owned(),
        });
        self.library = OnceLock::new();
        self.described = OnceLock::new();
        self
    }

    /// Finds a kernel by its name on a command line: a built-in name, `FILE.rs` or `FILE.rs::FUNCTION`.
    pub fn from_argument(text: &str) -> Result<Kernel, Errors> {
        match text.split_once(".rs::") {
            Some((path, function)) => Kernel::from_file(Path::new(&format!("{path}.rs")), Some(function)),
            None if text.ends_with(".rs") => Kernel::from_file(Path::new(text), None),
            None => Kernel::builtin(text),
        }
    }

    /// The function's name.
    pub fn name(&self) -> &str {
        &self.source.name
    }

    /// The kernel's files.
    pub fn files(&self) -> &[File] {
        &self.source.files
    }

    /// Place of a parameter of the kernel.
    pub fn parameter_span(&self, name: &str) -> Option<Span> {
        let library = deep(|| self.typed_library()).ok()?;
        let function = library.functions.get(&self.source.name)?;
        function
            .params
            .iter()
            .find(|param| *param.name == *name)
            .map(|param| param.span)
    }

    /// Place of the kernel's name, or the first line of its file: the place of errors that concern all of it. `None` of an empty file.
    pub fn name_span(&self) -> Option<Span> {
        let library = deep(|| self.typed_library()).ok();
        let named = library.and_then(|library| library.functions.get(&self.source.name).map(|function| function.span));
        named.or_else(|| {
            let line = self.source.files.first()?.text.lines().next()?;
            Some(Span {
                end: line.len() as u32,
                line: 1,
                column: 1,
                ..Span::default()
            })
        })
    }

    /// The kernel's options in order of declaration.
    pub fn options(&self) -> Result<Vec<OptionInfo>, Errors> {
        deep(|| self.option_infos(&*self.typed_library()?).map(|infos| infos.to_vec()))
    }

    /// Values of all options of the kernel under `settings`, pairs of option and text, without compiling it: the same that
    /// [`Compiled::options`] has.
    ///
    /// # Errors
    ///
    /// Each setting that the kernel has no option for, that stands twice, or that is no value of its option; an error in the
    /// kernel's text.
    pub fn option_values(&self, settings: &[OptionText]) -> Result<OptionValues, Errors> {
        let library = deep(|| self.typed_library())?;
        let infos = deep(|| self.option_infos(&library))?;
        let settings = &*self.with_preset(settings)?;
        eval::parse_settings(&self.source.name, infos, settings).map_err(|found| Errors::new(found, &self.source.files))
    }

    fn option_infos(&self, library: &Library) -> Result<&[OptionInfo], Errors> {
        if let Some(infos) = self.described.get() {
            return Ok(infos);
        }
        let infos = eval::describe_options(library, &self.source.files, &self.source.name)?.into();
        Ok(self.described.get_or_init(|| infos))
    }

    /// Named sets of the kernel's options, for the setting `preset`. Only built-in kernels have some.
    pub fn presets(&self) -> &'static [Preset] {
        self.source.builtin.map_or(&[], |entry| entry.presets)
    }

    /// Settings with the options of a preset in its place, but those that are set beside it.
    fn with_preset<'a>(&self, settings: &'a [OptionText]) -> Result<Cow<'a, [OptionText]>, Errors> {
        let mut named = settings.iter().filter(|(name, _)| name == PRESET);
        let (Some((_, wanted)), [_, ..]) = (named.next(), self.presets()) else {
            return Ok(Cow::Borrowed(settings));
        };
        let refused =
            |what: String, help: String| Errors::from_diagnostic(Diagnostic::new(Code::OptionValue, what).help(help));
        if let Some((_, again)) = named.next() {
            let what = format!("two presets are set, `{}` and `{}`", shorten(wanted), shorten(again));
            return Err(refused(what, "set one, and options beside it".to_owned()));
        }
        let Some(preset) = self.presets().iter().find(|preset| preset.name == wanted) else {
            let names: Vec<&str> = self.presets().iter().map(|preset| preset.name).collect();
            let what = format!("`{}` is not a preset of the kernel `{}`", shorten(wanted), self.name());
            return Err(refused(what, format!("use one of {}", names.join(", "))));
        };
        let beside: Vec<&OptionText> = settings.iter().filter(|(name, _)| name != PRESET).collect();
        let is_set = |name: &str| beside.iter().any(|(known, _)| known == name);
        let own = preset.options().filter(|(name, _)| !is_set(name));
        let own = own.map(|(name, value)| (name.to_owned(), value.to_owned()));
        Ok(own.chain(beside.iter().map(|option| (*option).clone())).collect())
    }

    /// The tree of all of the kernel's files as its `Debug` form: for tests that ask which constructs a text has.
    #[doc(hidden)]
    pub fn debug_tree(&self) -> Result<String, Errors> {
        deep(|| self.typed_library().map(|library| format!("{library:?}")))
    }

    /// Checks the functions and constants that the kernel does not reach as rustc does. They may hold what is not part of the
    /// kernel language.
    ///
    /// # Errors
    ///
    /// Every error in them that rustc reports too, and the errors of the kernel's text.
    pub fn check_others(&self) -> Result<(), Errors> {
        deep(|| {
            let Parsed {
                library,
                others,
                unknown_names,
                errors: mut found,
                ..
            } = front::parse_whole(&self.source.files, &self.source.name)?;
            found.extend(infer::check_others(&library, &others, unknown_names));
            match found.is_empty() {
                true => Ok(()),
                false => Err(Errors::new(found, &self.source.files)),
            }
        })
    }

    /// Items of the files, with the type of every expression that the kernel reaches.
    ///
    /// # Errors
    ///
    /// Constructs that the language does not have, types that do not match, and parameters that a kernel cannot take: all at once.
    fn typed_library(&self) -> Result<Arc<Library>, Errors> {
        if let Some(library) = self.library.get() {
            return Ok(Arc::clone(library));
        }
        let (files, name) = (&self.source.files, &self.source.name);
        let parsed = match &self.entry {
            Entry::Function => front::parse(files, name)?,
            Entry::Test(test) => front::testing::parse_test(files, test)?,
            Entry::ChainOptions => chain::parse_options(files, name)?,
        };
        self.type_library(parsed)
    }

    /// Infers the types of lowered items, and keeps them.
    fn type_library(&self, parsed: Parsed) -> Result<Arc<Library>, Errors> {
        let Parsed {
            mut library,
            reached,
            mut errors,
            ..
        } = parsed;
        add(
            &mut errors,
            infer::infer_types(&mut library, &reached).err().unwrap_or_default(),
        );
        if !errors.is_empty() {
            let of_parameters = eval::parameter_errors(&library, &self.source.files, &self.source.name);
            add(&mut errors, of_parameters);
            errors.sort_by_key(|error| error.span);
            return Err(Errors::new(errors, &self.source.files));
        }
        let library = Arc::new(library);
        Ok(Arc::clone(self.library.get_or_init(|| library)))
    }

    /// Decides everything that can be decided now.
    pub fn compile(&self, settings: &Settings) -> Result<Compiled, Errors> {
        self.compile_observed(settings, &mut |_, _| {})
    }

    /// As [`Kernel::compile`], showing the graph after each stage. The graph is verified between stages.
    pub fn compile_observed(&self, settings: &Settings, observer: &mut Observer<'_>) -> Result<Compiled, Errors> {
        self.compile_changed(settings, observer, &Ok)
    }

    /// Evaluates the kernel alone.
    pub(crate) fn evaluate(&self, settings: &Settings) -> Result<Start, Errors> {
        deep(|| {
            let _meter = Meter::open(settings.limits());
            let library = self.typed_library()?;
            let resolved = self.resolved(settings)?;
            let evaluated = pipeline::evaluate(&self.source, &library, &resolved);
            let (start, _) = evaluated.map_err(|errors| {
                self.name_overrides(&resolved, errors, &|settings| {
                    pipeline::evaluate(&self.source, &library, settings).map(drop)
                })
            })?;
            Ok(start)
        })
    }

    /// As [`Kernel::compile_observed`], with a change of the kernel after its evaluation.
    pub(crate) fn compile_changed(
        &self,
        settings: &Settings,
        observer: &mut Observer<'_>,
        change: &Change<'_>,
    ) -> Result<Compiled, Errors> {
        deep(|| {
            let _meter = Meter::open(settings.limits());
            let library = self.typed_library()?;
            let settings = self.resolved(settings)?;
            let compiled = pipeline::compile(&self.source, &library, &settings, observer, change);
            let mut compiled = compiled.map_err(|errors| {
                self.name_overrides(&settings, errors, &|settings| {
                    pipeline::compile(&self.source, &library, settings, &mut |_, _| {}, change).map(drop)
                })
            })?;
            compiled.changed = self.changed_options(&library, &settings, &compiled.options)?;
            Ok(compiled)
        })
    }

    /// Settings with the options of their preset, and those to be overridden spelled as such.
    fn resolved<'a>(&self, settings: &'a Settings) -> Result<Cow<'a, Settings>, Errors> {
        let options = self.with_preset(&settings.options)?;
        if matches!(options, Cow::Borrowed(_)) && settings.overrides.is_empty() {
            return Ok(Cow::Borrowed(settings));
        }
        Ok(Cow::Owned(Settings {
            options: settings.with_overrides(options.into_owned()),
            ..settings.clone()
        }))
    }

    /// Errors that name the overrides to which they are due.
    fn name_overrides(
        &self,
        settings: &Settings,
        errors: Errors,
        compile: &dyn Fn(&Settings) -> Result<(), Errors>,
    ) -> Errors {
        match self.option_values(&settings.options) {
            Ok(values) => overridden::name_overrides(&settings.options, &values, errors, &|options| {
                compile(&Settings {
                    options,
                    ..settings.clone()
                })
            }),
            Err(_) => errors,
        }
    }

    /// Returns whether an option can be overridden, the other options at their defaults.
    ///
    /// # Errors
    ///
    /// All errors of the kernel without settings.
    pub fn overridable(&self, option: &str) -> Result<Overridable, Errors> {
        let start = self.evaluate(&Settings::new().override_options([option]));
        Overridable::from_outcome(start.map(|start| reads_override(&clean_graph(&start.graph))))
    }

    /// Names of the options whose values differ from those of a kernel without settings.
    fn changed_options(
        &self,
        library: &Library,
        settings: &Settings,
        values: &OptionValues,
    ) -> Result<Vec<String>, Errors> {
        if settings.options.is_empty() {
            return Ok(Vec::new());
        }
        let infos = self.option_infos(library)?.iter();
        let changed = infos.filter(|info| {
            values
                .get(&info.name)
                .is_some_and(|value| *value != info.default_value())
        });
        Ok(changed.map(|info| info.name.clone()).collect())
    }
}

impl ShaderSpec {
    /// Compiles a kernel.
    ///
    /// # Errors
    ///
    /// As [`Kernel::compile`].
    pub fn compile(&self, kernel: &Kernel) -> Result<Compiled, Errors> {
        kernel.compile(&self.dispatched_settings())
    }

    /// The settings for workgroups of the size that is dispatched, which share texels.
    pub(crate) fn dispatched_settings(&self) -> Settings {
        let mut settings = self.settings.clone();
        if let Some(size) = self.emit.workgroup {
            settings.share = settings.share.of_size(size);
        }
        settings
    }

    /// Compiles a kernel and writes its shader.
    ///
    /// # Errors
    ///
    /// As [`Kernel::compile`] and [`Compiled::emit`].
    pub fn emit(&self, kernel: &Kernel) -> Result<(Compiled, Emitted), Errors> {
        let compiled = self.compile(kernel)?;
        let emitted = compiled.emit(&self.emit)?;
        Ok((compiled, emitted))
    }
}

/// Adds what a later stage found, but at places where an earlier one found something.
fn add(errors: &mut Vec<Diagnostic>, found: Vec<Diagnostic>) {
    let places: Vec<Option<Span>> = errors.iter().map(|error| error.span).collect();
    errors.extend(found.into_iter().filter(|error| !places.contains(&error.span)));
}

pub(crate) fn read_source(path: &Path) -> Result<String, Errors> {
    files::read_text(path, MAX_SOURCE).map_err(|error| {
        let what = format!("cannot read the kernel file `{}`: {error}", path.display());
        Errors::from_diagnostic(
            Diagnostic::new(Code::UnreadableFile, what)
                .help("paths are taken from the folder that the build runs in: the crate's own")
                .caused_by(error),
        )
    })
}

/// Runs on a stack that is deep enough for every nesting that the front end lets through.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn deep<T: Send>(work: impl FnOnce() -> Result<T, Errors> + Send) -> Result<T, Errors> {
    const STACK: usize = 256 << 20;
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        match thread {
            Ok(handle) => handle
                .join()
                .unwrap_or_else(|_| Err(crate::compiled::internal_error("front", "it panicked"))),
            Err(error) => {
                let what = format!("cannot start a thread: {error}");
                Err(Errors::from_diagnostic(
                    Diagnostic::new(Code::Limit, what).caused_by(error),
                ))
            }
        }
    })
}

/// Runs on the host's stack: WebAssembly has no threads of its own, and the front end lets less nesting through there
/// (`front/depth.rs`).
#[cfg(target_arch = "wasm32")]
pub(crate) fn deep<T: Send>(work: impl FnOnce() -> Result<T, Errors> + Send) -> Result<T, Errors> {
    work()
}
