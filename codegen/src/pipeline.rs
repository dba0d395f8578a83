//! The stages from text to graph, in order.

use crate::diagnostic::{Diagnostic, Errors, File};
use crate::emit::{self, EmitError, Emitted, Target};
use crate::eval::{self, OptionInfo, Unroll};
use crate::front;
use crate::ir::{Graph, verify};
use crate::passes::{self, Schedule};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;
use straightline_manifest::{Counts, Format, Stage};

/// A kernel's source: its files and which function it is.
#[derive(Clone, Debug)]
pub struct Kernel {
    name: String,
    summary: String,
    files: Arc<Vec<File>>,
}

/// How a kernel is to be evaluated.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    /// Option and value; what is not named stays at its default, and of an option named twice the last counts.
    pub options: Vec<(String, String)>,
    /// What becomes of loops.
    pub unroll: Unroll,
}

/// A kernel with everything decided, ready to be emitted or interpreted.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The kernel's name.
    pub kernel: String,
    /// What it does, in a line.
    pub summary: String,
    /// Every option with its value.
    pub options: BTreeMap<String, String>,
    /// What became of loops.
    pub unroll: Unroll,
    /// What is left to compute.
    pub graph: Graph,
    /// In which order.
    pub schedule: Schedule,
    /// What one invocation executes; `statements` is 0 until it is emitted.
    pub counts: Counts,
}

impl Compiled {
    /// The kernel as a shader for a stage, with its result in `format`, in every language asked for.
    pub fn emit(&self, stage: Stage, format: Format, targets: &BTreeSet<Target>) -> Result<Emitted, EmitError> {
        emit::emit(self, stage, format, targets)
    }
}

/// A graph after a stage, for whoever looks on.
pub type Observer<'a> = dyn FnMut(&str, &Graph) + Send + 'a;

impl Kernel {
    /// A kernel that comes with Straightline.
    pub fn builtin(name: &str) -> Result<Kernel, Errors> {
        let Some(entry) = straightline_kernels::find(name) else {
            let known: Vec<&str> = straightline_kernels::CATALOGUE.iter().map(|e| e.name).collect();
            return Err(Errors::of(
                Diagnostic::new(format!("there is no kernel `{name}`")).help(format!(
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
            summary: entry.summary.to_owned(),
            files: Arc::new(files.collect()),
        })
    }

    /// A kernel of one's own, from its text. `path` is only shown.
    pub fn from_text(path: &str, text: &str, function: &str) -> Kernel {
        let file = File {
            path: path.to_owned(),
            text: text.to_owned(),
        };
        Kernel {
            name: function.to_owned(),
            summary: String::new(),
            files: Arc::new(vec![file]),
        }
    }

    /// A kernel of one's own, from a file. Without `function` it is the one that has the file's name.
    pub fn from_file(path: &Path, function: Option<&str>) -> Result<Kernel, Errors> {
        let shown = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| {
            Errors::of(Diagnostic::new(format!(
                "cannot read the kernel file `{shown}`: {error}"
            )))
        })?;
        let stem = path.file_stem().and_then(|s| s.to_str()).unwrap_or("kernel");
        Ok(Kernel::from_text(&shown, &text, function.unwrap_or(stem)))
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

    /// The kernel's options in order of declaration.
    pub fn options(&self) -> Result<Vec<OptionInfo>, Errors> {
        deep(|| {
            let library = front::parse(&self.files, &self.name)?;
            eval::describe(&library, &self.files, &self.name)
        })
    }

    /// Decides everything that can be decided now.
    pub fn compile(&self, settings: &Settings) -> Result<Compiled, Errors> {
        self.compile_observed(settings, &mut |_, _| {})
    }

    /// As [`Kernel::compile`], showing the graph after each stage. The graph is verified between stages.
    pub fn compile_observed(&self, settings: &Settings, observer: &mut Observer<'_>) -> Result<Compiled, Errors> {
        deep(|| self.stages(settings, observer))
    }

    fn stages(&self, settings: &Settings, observer: &mut Observer<'_>) -> Result<Compiled, Errors> {
        let library = front::parse(&self.files, &self.name)?;
        let evaluated = eval::evaluate(&library, &self.files, &self.name, &settings.options, settings.unroll)?;
        let mut stage = |name: &str, graph: Graph| -> Result<Graph, Errors> {
            verify::verify(&graph).map_err(|why| internal(name, &why))?;
            observer(name, &graph);
            Ok(graph)
        };
        let graph = stage("eval", evaluated.graph)?;
        let graph = stage("clean", passes::clean(&graph))?;
        let graph = stage("share-loads", passes::share_loads(&graph))?;
        // Sharing makes new common terms, and those leave others unused.
        let graph = stage("clean", passes::clean(&graph))?;
        let schedule = passes::schedule(&graph);
        let counts = passes::count(&graph, &schedule);
        let summary = if self.summary.is_empty() {
            first_sentence(&evaluated.docs)
        } else {
            self.summary.clone()
        };
        Ok(Compiled {
            kernel: self.name.clone(),
            summary,
            options: evaluated.options,
            unroll: settings.unroll,
            graph,
            schedule,
            counts,
        })
    }
}

fn internal(stage: &str, why: &str) -> Errors {
    Errors::of(
        Diagnostic::new(format!("the stage `{stage}` made a graph that breaks a rule: {why}"))
            .help("this is a mistake in Straightline, not in the kernel: please report it with the kernel's source"),
    )
}

fn first_sentence(docs: &str) -> String {
    docs.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}

/// Runs on a stack that is deep enough for every nesting that the front end lets through.
fn deep<T: Send>(work: impl FnOnce() -> Result<T, Errors> + Send) -> Result<T, Errors> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        match thread {
            Ok(handle) => handle.join().unwrap_or_else(|_| Err(internal("front", "it panicked"))),
            Err(error) => Err(Errors::of(Diagnostic::new(format!("cannot start a thread: {error}")))),
        }
    })
}

const STACK: usize = 256 << 20;
