//! From a kernel's source to a scheduled graph: evaluation, then the list of [`STAGES`]. The graph is verified after each
//! stage.

use crate::compiled::{Compiled, Places, internal_error};
use crate::emit;
use crate::spec::Settings;
use crate::stages::{STAGES, Work};
use std::collections::BTreeSet;
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors, File};
use straightline_evaluator::eval::{self, Evaluated};
use straightline_evaluator::front::Library;
use straightline_evaluator::ir::{Graph, Invocation, verify};
use straightline_evaluator::limits::{self, Meter};
use straightline_evaluator::passes;
use straightline_kernels::Entry;

/// Callback that receives the graph after each stage, with the stage's name.
pub type Observer<'a> = dyn FnMut(&str, &Graph) + Send + 'a;

/// A kernel's text.
#[derive(Clone, Debug)]
pub struct Source {
    /// Name of the function.
    pub name: String,
    /// Entry of a built-in kernel.
    pub builtin: Option<&'static Entry>,
    pub files: Arc<Vec<File>>,
}

/// A kernel as it was evaluated, before any stage.
#[derive(Clone, Debug)]
pub struct Start {
    pub graph: Graph,
    /// Names of the values that attributes put into half precision.
    pub half: BTreeSet<String>,
}

/// A change of a kernel between its evaluation and the stages.
pub type Change<'a> = dyn Fn(Start) -> Result<Start, Errors> + Sync + 'a;

/// Evaluates a kernel whose files define `library`.
///
/// # Errors
///
/// All errors of the kernel under these settings.
pub fn evaluate(kernel: &Source, library: &Library, settings: &Settings) -> Result<(Start, Evaluated), Errors> {
    let policy = settings.policy();
    policy.check().map_err(|what| {
        let help = "use full, none, or partial(N), and name each loop once";
        Errors::from_diagnostic(Diagnostic::new(Code::SettingValue, what).help(help))
    })?;
    let invocation = match settings.block {
        [1, 1] => Invocation::Pixel,
        _ => Invocation::MayBeOutside,
    };
    let mut evaluated = eval::evaluate_kernel(
        library,
        &kernel.files,
        &kernel.name,
        &settings.options,
        &policy,
        invocation,
    )?;
    let graph = std::mem::take(&mut evaluated.graph);
    let functions = library.functions.values();
    let half = functions.flat_map(|function| function.half.iter().cloned()).collect();
    Ok((Start { graph, half }, evaluated))
}

/// Compiles a kernel whose files define `library`, with `change` after its evaluation. The list of changed options is left
/// empty.
///
/// # Errors
///
/// All errors of the kernel under these settings, and those of `change`.
pub fn compile(
    kernel: &Source,
    library: &Library,
    settings: &Settings,
    observer: &mut Observer<'_>,
    change: &Change<'_>,
) -> Result<Compiled, Errors> {
    let meter = Meter::open(settings.limits());
    let policy = settings.policy();
    let (start, evaluated) = evaluate(kernel, library, settings)?;
    let Start { graph, half } = change(start)?;
    let mut pipeline = Pipeline {
        kernel,
        settings,
        evaluated: &evaluated,
        observer,
    };
    let Work {
        graph,
        transport,
        quad,
        sharing,
        unshared,
        gathered,
        half,
        ..
    } = pipeline.run_stages(graph, half)?;
    let schedule = passes::schedule_graph(&graph, settings.reads);
    // Most oversized kernels are rejected here, before their text is generated.
    pipeline.check_budget(emit::statements_at_least(&graph, &schedule))?;
    let compiled = Compiled {
        kernel: kernel.name.clone(),
        builtin: kernel.builtin,
        summary: match kernel.builtin {
            Some(entry) => entry.summary.to_owned(),
            None => first_sentence(&evaluated.docs),
        },
        changed: Vec::new(),
        options: evaluated.options.clone(),
        policy,
        loops: evaluated.loops.clone(),
        counts: passes::count_operations(&graph, &schedule),
        graph,
        schedule,
        transport,
        sharing,
        unshared,
        gathered,
        half,
        quad,
        limits: settings.limits(),
        work: meter.work(),
        time: meter.time(),
        places: Arc::new(Places {
            files: Arc::clone(&kernel.files),
            // For a built-in kernel the user's options are wrong, not its source.
            kernel: kernel.builtin.is_none().then_some(evaluated.span),
            inputs: match kernel.builtin {
                Some(_) => Vec::new(),
                None => evaluated.inputs.clone(),
            },
        }),
    };
    if emit::statements_at_most(&compiled.graph) > settings.budget {
        pipeline.check_budget(compiled.text_counts().statements)?;
    }
    Ok(compiled)
}

/// A kernel between evaluation and scheduling, with the context of its errors.
struct Pipeline<'s, 'o> {
    kernel: &'s Source,
    settings: &'s Settings,
    /// Loops and locations; the graph has been moved out.
    evaluated: &'s Evaluated,
    observer: &'s mut Observer<'o>,
}

impl<'s> Pipeline<'s, '_> {
    /// Runs every stage that applies.
    fn run_stages(&mut self, graph: Graph, half: BTreeSet<String>) -> Result<Work<'s>, Errors> {
        self.check("eval", &graph)?;
        let mut work = Work::new(&self.kernel.name, self.settings, half, graph);
        for stage in STAGES {
            if !(stage.applies)(&work) {
                continue;
            }
            let made = (stage.run)(&mut work).map_err(|refusal| {
                let error = refusal.into_diagnostic(self.evaluated.span);
                Errors::new(vec![error], &self.kernel.files)
            })?;
            let made = made.cleaned();
            self.check(stage.name, made.graph())?;
            work.accept(made);
        }
        Ok(work)
    }

    /// Verifies the graph after a stage, and compares it with the limits.
    fn check(&mut self, stage: &str, graph: &Graph) -> Result<(), Errors> {
        limits::count_work(graph.nodes.len() as u64);
        if let Some(excess) = limits::exceeded_limit(graph.nodes.len()) {
            let what = format!("compiling `{}` takes {excess}", self.kernel.name);
            let error = Diagnostic::error_at(Code::Limit, self.evaluated.span, what)
                .label(format!("in the stage `{stage}`, with {} operations", graph.nodes.len()))
                .help(excess.help());
            return Err(self.with_loops(error));
        }
        verify::verify_graph(graph).map_err(|why| internal_error(stage, &why))?;
        (self.observer)(stage, graph);
        Ok(())
    }

    fn check_budget(&self, statements: u32) -> Result<(), Errors> {
        let (name, budget) = (&self.kernel.name, self.settings.budget);
        if statements <= budget {
            return Ok(());
        }
        let what = format!("`{name}` has {statements} statements, more than its budget of {budget}");
        let error = Diagnostic::error_at(Code::Budget, self.evaluated.span, what)
            .label("this kernel")
            .help(eval::BUDGET_HELP);
        Err(self.with_loops(error))
    }

    /// Returns an error about size, with the loops that have the most work.
    fn with_loops(&self, error: Diagnostic) -> Errors {
        let error = eval::name_largest_loops(&self.evaluated.loops, error);
        Errors::new(vec![error], &self.kernel.files)
    }
}

/// Returns the first sentence of a documentation.
pub fn first_sentence(docs: &str) -> String {
    docs.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}
