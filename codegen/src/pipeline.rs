//! The stages from text to graph, in order.

use crate::compiled::{Compiled, Places};
use crate::emit::{self, Emitted};
use crate::files;
use crate::spec::{Settings, ShaderSpec};
use std::path::Path;
use std::sync::{Arc, OnceLock};
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors, File, Span};
use straightline_evaluator::eval::{self, OptionInfo};
use straightline_evaluator::front::{self, Library, Parsed};
use straightline_evaluator::infer;
use straightline_evaluator::ir::{Graph, Invocation, verify};
use straightline_evaluator::limits::{self, Meter};
use straightline_evaluator::passes;
use straightline_evaluator::policy::{Math, ReadOrder, Share, Transport};
use straightline_kernels::{OptionText, OptionValues};

/// Longest file of a kernel that is read, in bytes.
const MAX_SOURCE: u64 = 1 << 24;

/// A kernel's source: its files and which function it is.
#[derive(Clone, Debug)]
pub struct Kernel {
    name: String,
    builtin: Option<&'static straightline_kernels::Entry>,
    summary: String,
    files: Arc<Vec<File>>,
    /// What the files define, read once for all variants.
    library: OnceLock<Arc<Library>>,
    described: OnceLock<Arc<[OptionInfo]>>,
}

impl ShaderSpec {
    /// Compiles a kernel.
    ///
    /// # Errors
    ///
    /// As [`Kernel::compile`].
    pub fn compile(&self, kernel: &Kernel) -> Result<Compiled, Errors> {
        let mut settings = self.settings.clone();
        // A workgroup that shares texels is the one that is dispatched.
        if let Some(size) = self.emit.workgroup {
            settings.share = settings.share.of_size(size);
        }
        kernel.compile(&settings)
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

impl Compiled {
    /// The kernel's reads and stores with next to no arithmetic between: a lower bound of every form
    /// ([`passes::floor`]). It computes nothing of use, and is there to be timed.
    ///
    /// # Errors
    ///
    /// If a loop or branch is left.
    pub fn floor(&self) -> Result<Compiled, Errors> {
        let made = |graph: &Graph| -> Result<Graph, Errors> {
            let floor = passes::floor(graph).map_err(|why| {
                let what = format!("`{}` has no floor: {why}", self.kernel);
                Errors::of(
                    Diagnostic::new(Code::UnfitSetting, what)
                        .help("unroll it fully, and let its branches be selections"),
                )
            })?;
            let floor = passes::clean(&floor);
            verify::verify(&floor).map_err(|why| internal("floor", &why))?;
            Ok(floor)
        };
        let graph = made(&self.graph)?;
        let quad = self.quad.as_deref().map(made).transpose()?;
        let schedule = passes::schedule(&graph, self.policy.reads);
        let floor = Compiled {
            counts: passes::count(&graph, &schedule),
            graph,
            schedule,
            quad: quad.map(Arc::new),
            ..self.clone()
        };
        Ok(floor)
    }
}

/// Threads that every device has in a workgroup.
const MOST_THREADS: u32 = 256;

/// Pixels that one invocation may compute.
const MAX_BLOCK: u32 = 64;

fn is_block([width, height]: [u32; 2]) -> bool {
    (1..=MAX_BLOCK).contains(&width.saturating_mul(height))
}

/// A graph after a stage, for whoever looks on.
pub type Observer<'a> = dyn FnMut(&str, &Graph) + Send + 'a;

impl Kernel {
    /// A kernel that comes with Straightline.
    pub fn builtin(name: &str) -> Result<Kernel, Errors> {
        let Some(entry) = straightline_kernels::find(name) else {
            let known: Vec<&str> = straightline_kernels::CATALOGUE.iter().map(|e| e.name).collect();
            return Err(Errors::of(
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
        Ok(Kernel {
            name: name.to_owned(),
            builtin: Some(entry),
            summary: entry.summary.to_owned(),
            files: Arc::new(files.collect()),
            library: OnceLock::new(),
            described: OnceLock::new(),
        })
    }

    /// A kernel of one's own, from its text. `path` is only shown.
    pub fn from_text(path: &str, text: &str, function: &str) -> Kernel {
        let file = File {
            path: path.to_owned(),
            text: text.to_owned(),
        };
        Kernel {
            name: front::unraw(function).to_owned(),
            builtin: None,
            summary: String::new(),
            files: Arc::new(vec![file]),
            library: OnceLock::new(),
            described: OnceLock::new(),
        }
    }

    /// A kernel of one's own, from a file. Without `function` it is the public function that has the file's name, or else the only
    /// public one that takes and gives what a kernel does.
    pub fn from_file(path: &Path, function: Option<&str>) -> Result<Kernel, Errors> {
        let shown = path.display().to_string();
        let text = read(path)?;
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

    /// The same kernel with a further file that it calls functions of.
    pub fn with_file(self, path: &Path) -> Result<Kernel, Errors> {
        Ok(self.with_text(&path.display().to_string(), &read(path)?))
    }

    /// The same kernel with the text of a further file that it calls functions of. `path` is only shown.
    pub fn with_text(mut self, path: &str, text: &str) -> Kernel {
        Arc::make_mut(&mut self.files).push(File {
            path: path.to_owned(),
            text: text.to_owned(),
        });
        self.library = OnceLock::new();
        self.described = OnceLock::new();
        self
    }

    /// What a command line or a `build.rs` calls a kernel: a built-in name, `FILE.rs` or `FILE.rs::FUNCTION`.
    pub fn locate(text: &str) -> Result<Kernel, Errors> {
        match text.split_once(".rs::") {
            Some((path, function)) => Kernel::from_file(Path::new(&format!("{path}.rs")), Some(function)),
            None if text.ends_with(".rs") => Kernel::from_file(Path::new(text), None),
            None => Kernel::builtin(text),
        }
    }

    /// The function's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The kernel's files.
    pub fn files(&self) -> &[File] {
        &self.files
    }

    /// Where the kernel's name stands, or the first line of its file: the place of errors that concern all of it. `None` of an empty file.
    pub fn place(&self) -> Option<Span> {
        let library = deep(|| self.library()).ok();
        let named = library.and_then(|library| library.functions.get(&self.name).map(|function| function.span));
        named.or_else(|| {
            let line = self.files.first()?.text.lines().next()?;
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
        deep(|| self.described(&*self.library()?).map(|infos| infos.to_vec()))
    }

    /// Values of all options of the kernel under `settings`, pairs of option and text, without compiling it: the same that
    /// [`Compiled::options`] has.
    ///
    /// # Errors
    ///
    /// Each setting that the kernel has no option for, that stands twice, or that is no value of its option; an error in the
    /// kernel's text.
    pub fn option_values(&self, settings: &[OptionText]) -> Result<OptionValues, Errors> {
        let library = deep(|| self.library())?;
        let infos = deep(|| self.described(&library))?;
        eval::parse_settings(&self.name, infos, settings).map_err(|found| Errors::new(found, &self.files))
    }

    fn described(&self, library: &Library) -> Result<&[OptionInfo], Errors> {
        if let Some(infos) = self.described.get() {
            return Ok(infos);
        }
        let infos = eval::describe(library, &self.files, &self.name)?.into();
        Ok(self.described.get_or_init(|| infos))
    }

    /// The tree of all of the kernel's files as its `Debug` form: for tests that ask which constructs a text has.
    #[doc(hidden)]
    pub fn tree(&self) -> Result<String, Errors> {
        deep(|| self.library().map(|library| format!("{library:?}")))
    }

    /// Looks at the types of the functions that the kernel does not reach, as rustc does: what else they hold does not concern it.
    ///
    /// # Errors
    ///
    /// Every two types in them that do not match, and what is wrong with the kernel's text.
    pub fn check_others(&self) -> Result<(), Errors> {
        deep(|| {
            let Parsed { library, others, .. } = front::parse(&self.files, &self.name)?;
            let found = infer::mismatches(&library, &others);
            match found.is_empty() {
                true => Ok(()),
                false => Err(Errors::new(found, &self.files)),
            }
        })
    }

    fn library(&self) -> Result<Arc<Library>, Errors> {
        if let Some(library) = self.library.get() {
            return Ok(Arc::clone(library));
        }
        let Parsed {
            mut library, reached, ..
        } = front::parse(&self.files, &self.name)?;
        infer::infer(&mut library, &reached).map_err(|found| Errors::new(found, &self.files))?;
        let library = Arc::new(library);
        Ok(Arc::clone(self.library.get_or_init(|| library)))
    }

    /// Decides everything that can be decided now.
    pub fn compile(&self, settings: &Settings) -> Result<Compiled, Errors> {
        self.compile_observed(settings, &mut |_, _| {})
    }

    /// As [`Kernel::compile`], showing the graph after each stage. The graph is verified between stages.
    pub fn compile_observed(&self, settings: &Settings, observer: &mut Observer<'_>) -> Result<Compiled, Errors> {
        deep(|| self.stages(settings, observer))
    }

    /// Names of the options whose values differ from those of a kernel without settings.
    fn changed(&self, library: &Library, settings: &Settings, values: &OptionValues) -> Result<Vec<String>, Errors> {
        if settings.options.is_empty() {
            return Ok(Vec::new());
        }
        let infos = self.described(library)?.iter();
        let changed = infos.filter(|info| values.get(&info.name).is_some_and(|value| *value != info.unset()));
        Ok(changed.map(|info| info.name.clone()).collect())
    }

    fn stages(&self, settings: &Settings, observer: &mut Observer<'_>) -> Result<Compiled, Errors> {
        let meter = Meter::open(settings.limits());
        let library = self.library()?;
        let policy = settings.policy();
        policy.check().map_err(|what| {
            let help = "use full, none, or partial(N), and name each loop once";
            Errors::of(Diagnostic::new(Code::SettingValue, what).help(help))
        })?;
        let invocation = match settings.block {
            [1, 1] => Invocation::Pixel,
            _ => Invocation::MayBeOutside,
        };
        let evaluated = eval::evaluate(
            &library,
            &self.files,
            &self.name,
            &settings.options,
            &policy,
            invocation,
        )?;
        let mut stage = |name: &str, graph: Graph| -> Result<Graph, Errors> {
            limits::spend(graph.nodes.len() as u64);
            if let Some(excess) = limits::exceeded(graph.nodes.len()) {
                let what = format!("compiling `{}` takes {excess}", self.name);
                let error = Diagnostic::at(Code::Limit, evaluated.span, what)
                    .label(format!("in the stage `{name}`, with {} operations", graph.nodes.len()))
                    .help(excess.help());
                return Err(Errors::new(vec![eval::blame(&evaluated.loops, error)], &self.files));
            }
            verify::verify(&graph).map_err(|why| internal(name, &why))?;
            observer(name, &graph);
            Ok(graph)
        };
        let graph = stage("eval", evaluated.graph)?;
        let mut graph = stage("clean", passes::clean(&graph))?;
        if !settings.repeat_loads {
            graph = stage("share-loads", passes::share_loads(&graph))?;
            // Sharing makes new common terms, and those leave others unused.
            graph = stage("clean", passes::clean(&graph))?;
        }
        graph = stage("exactness", passes::exactness(&graph))?;
        if settings.math == Math::Fast {
            graph = stage("fast", passes::clean(&passes::fast(&graph)))?;
        }
        let refused = |what: String, help: &str| {
            let error = Diagnostic::at(Code::UnfitSetting, evaluated.span, what)
                .label("this kernel")
                .help(help);
            Errors::new(vec![error], &self.files)
        };
        let mut quad = None;
        let (mut transport, mut quads) = (settings.transport, [2, 2]);
        if graph.invocation == Invocation::Lane {
            if settings.block != [1, 1] {
                let [width, height] = settings.block;
                if width % 2 != 0 || height % 2 != 0 || !is_block(settings.block) {
                    return Err(refused(
                        format!(
                            "`{}` computes quads, and a block of {width}x{height} pixels has other",
                            self.name
                        ),
                        "use whole quads, such as 4x2 or 8x2, and 64 pixels at most",
                    ));
                }
                if transport.is_some_and(|transport| transport != Transport::Block) {
                    return Err(refused(
                        format!(
                            "the lanes of `{}` lie in one invocation, and send no messages",
                            self.name
                        ),
                        "leave the transport out, or the block",
                    ));
                }
                transport = Some(Transport::Block);
                quads = settings.block;
            }
            if transport == Some(Transport::Derivatives) {
                let lowered = passes::by_derivatives(&graph)
                    .map_err(|why| refused(why, "send floats, or use the transport `subgroup`"))?;
                graph = stage("derivatives", passes::clean(&lowered))?;
            }
            let expanded = passes::expand(&graph, quads).map_err(|why| {
                refused(
                    format!("the lanes of `{}` do not run in step: {why}", self.name),
                    "decide loops and branches by what the whole quad has in common; choose lane by lane with `select`",
                )
            })?;
            let expanded = stage("quad", passes::clean(&expanded))?;
            if transport == Some(Transport::Block) {
                graph = expanded;
            } else {
                quad = Some(Arc::new(expanded));
            }
        } else if transport.is_some() {
            return Err(refused(
                format!("`{}` computes one pixel, and sends no messages", self.name),
                "leave the transport out, or take `pixel: Quad<IVec2>` and give a `Quad<Vec4>`",
            ));
        } else if settings.block != [1, 1] {
            let [width, height] = settings.block;
            if !is_block(settings.block) {
                return Err(refused(
                    format!("a block of {width}x{height} pixels"),
                    "use blocks of 1 to 64 pixels, such as 2x1 or 2x2",
                ));
            }
            let expanded = passes::expand(&graph, settings.block).map_err(|why| {
                refused(
                    format!("the pixels of `{}` cannot run in step: {why}", self.name),
                    "unroll fully and select, so that no loop or branch is left, or compute one pixel at a time",
                )
            })?;
            graph = stage("block", passes::clean(&expanded))?;
        }
        let mut sharing = None;
        if let Share::Workgroup(threads) = settings.share {
            let (tiled, found) = shared(&graph, threads, settings.block).map_err(|(why, help)| {
                refused(
                    format!("the pixels of `{}` cannot share texels by workgroup: {why}", self.name),
                    help,
                )
            })?;
            graph = stage("share-by-workgroup", passes::clean(&tiled))?;
            sharing = Some(Arc::new(found));
        }
        let mut gathered = Arc::default();
        if settings.reads == ReadOrder::Gather {
            let (graph_of, found) = passes::gathers(&graph).map_err(|why| {
                refused(
                    format!("the reads of `{}` cannot be gathered: {why}", self.name),
                    "leave `reads` out, or let one invocation compute whole pixels",
                )
            })?;
            graph = stage("gathers", passes::clean(&graph_of))?;
            gathered = found.into();
        }
        let graph = stage("coordinates", passes::clean(&passes::by_component(&graph)))?;
        let schedule = passes::schedule(&graph, settings.reads);
        let within_budget = |statements: u32| {
            if statements <= settings.budget {
                return Ok(());
            }
            let what = format!(
                "`{}` has {statements} statements, more than its budget of {}",
                self.name, settings.budget
            );
            let error = Diagnostic::at(Code::Budget, evaluated.span, what)
                .label("this kernel")
                .help(eval::BUDGET_HELP);
            Err(Errors::new(vec![eval::blame(&evaluated.loops, error)], &self.files))
        };
        // Most of what is too long is known to be before it is written.
        within_budget(emit::statements_at_least(&graph, &schedule))?;
        let counts = passes::count(&graph, &schedule);
        let summary = if self.summary.is_empty() {
            first_sentence(&evaluated.docs)
        } else {
            self.summary.clone()
        };
        let compiled = Compiled {
            kernel: self.name.clone(),
            builtin: self.builtin,
            summary,
            changed: self.changed(&library, settings, &evaluated.options)?,
            options: evaluated.options.clone(),
            policy,
            loops: evaluated.loops.clone(),
            graph,
            schedule,
            counts,
            transport,
            sharing,
            gathered,
            quad,
            limits: settings.limits(),
            work: meter.work(),
            time: meter.time(),
            places: Arc::new(Places {
                files: Arc::clone(&self.files),
                // Of a built-in kernel a user's options are wrong, not its text.
                kernel: self.builtin.is_none().then_some(evaluated.span),
                inputs: match self.builtin {
                    Some(_) => Vec::new(),
                    None => evaluated.inputs.clone(),
                },
            }),
        };
        if emit::statements_at_most(&compiled.graph) > settings.budget {
            within_budget(compiled.statements())?;
        }
        Ok(compiled)
    }
}

/// The kernel with texels in the memory of workgroups, and what has become of its reads; else why not, and what to do.
fn shared(
    graph: &Graph,
    threads: [u32; 2],
    block: [u32; 2],
) -> Result<(Graph, passes::Sharing), (String, &'static str)> {
    let apart = "let invocations share by themselves: leave `share` out";
    let [width, height] = threads;
    if !(1..=MOST_THREADS).contains(&width.saturating_mul(height)) {
        let what = format!("a workgroup of {width}x{height} threads");
        return Err((what, "use 1 to 256 threads, such as 16x16 or 32x8"));
    }
    if block != [1, 1] {
        let [width, height] = block;
        let what = format!("an invocation computes {width}x{height} of them");
        return Err((what, "share by blocks or by workgroups: leave one of the two out"));
    }
    passes::by_workgroup(graph, threads).map_err(|why| (why, apart))
}

fn read(path: &Path) -> Result<String, Errors> {
    files::read_text(path, MAX_SOURCE).map_err(|error| {
        let what = format!("cannot read the kernel file `{}`: {error}", path.display());
        Errors::of(
            Diagnostic::new(Code::UnreadableFile, what)
                .help("paths are taken from the folder that the build runs in: the crate's own")
                .caused_by(error),
        )
    })
}

fn internal(stage: &str, why: &str) -> Errors {
    Errors::of(
        Diagnostic::new(
            Code::Internal,
            format!("the stage `{stage}` made a graph that breaks a rule: {why}"),
        )
        .help("this is a mistake in Straightline, not in the kernel: please report it with the kernel's source"),
    )
}

fn first_sentence(docs: &str) -> String {
    docs.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}

/// Runs on a stack that is deep enough for every nesting that the front end lets through.
#[cfg(not(target_arch = "wasm32"))]
fn deep<T: Send>(work: impl FnOnce() -> Result<T, Errors> + Send) -> Result<T, Errors> {
    const STACK: usize = 256 << 20;
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        match thread {
            Ok(handle) => handle.join().unwrap_or_else(|_| Err(internal("front", "it panicked"))),
            Err(error) => {
                let what = format!("cannot start a thread: {error}");
                Err(Errors::of(Diagnostic::new(Code::Limit, what).caused_by(error)))
            }
        }
    })
}

/// Runs on the host's stack: WebAssembly has no threads of its own, and the front end lets less nesting through there
/// (`front/depth.rs`).
#[cfg(target_arch = "wasm32")]
fn deep<T: Send>(work: impl FnOnce() -> Result<T, Errors> + Send) -> Result<T, Errors> {
    work()
}
