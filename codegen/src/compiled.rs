//! A compiled kernel: the input of the interpreter and of emission.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors, File, Span};
use straightline_evaluator::eval::LoopReport;
use straightline_evaluator::ir::{Graph, verify};
use straightline_evaluator::limits::Limits;
use straightline_evaluator::passes::{self, Gathered, Schedule, Sharing};
use straightline_evaluator::policy::{Math, Policy, Transport};
use straightline_kernels::{Entry, HalfPrecision, OptionValues, PaperCounts};
use straightline_manifest::Counts;

/// A kernel after all compile-time decisions, ready to be emitted or interpreted.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The kernel's name.
    pub kernel: String,
    /// The entry of a built-in kernel.
    pub builtin: Option<&'static Entry>,
    /// Summary of the kernel in one line.
    pub summary: String,
    /// Value of every option.
    pub options: OptionValues,
    /// Names of the options that are not at their defaults.
    pub changed: Vec<String>,
    /// Policy requested for loops and branches.
    pub policy: Policy,
    /// Outcome for each loop.
    pub loops: Vec<LoopReport>,
    /// Graph of the remaining operations.
    pub graph: Graph,
    /// Order in which the graph's values are computed.
    pub schedule: Schedule,
    /// Operations that one invocation executes. `basic_blocks` counts the blocks of the kernel's own loops and branches;
    /// emission counts those of the shader. `statements` and `max_live` are 0: they are counted in the emitted text, by
    /// emission or by [`Compiled::text_counts`].
    pub counts: Counts,
    /// Transport requested for quad swaps between lanes.
    pub transport: Option<Transport>,
    /// Outcome of texel sharing for the requested reads.
    pub sharing: Option<Arc<Sharing>>,
    /// Graph before a workgroup shared its texels, if that was requested.
    pub unshared: Option<Arc<Graph>>,
    /// Reads that became gathers, if requested.
    pub gathered: Arc<[Gathered]>,
    /// Names of the values that are computed in half precision.
    pub half: BTreeSet<String>,
    /// For a kernel whose invocations are lanes: the graph in which one invocation computes the whole quad.
    pub quad: Option<Arc<Graph>>,
    /// Limits on compiling and emitting.
    pub limits: Limits,
    /// Work of compiling the kernel: expressions evaluated and operations visited by passes. Identical on every machine.
    pub work: u64,
    /// Compile time; 0 in WebAssembly, which has no clock.
    pub time: Duration,
    /// Source locations of the kernel and its inputs.
    pub places: Arc<Places>,
}

/// Source locations of a kernel and its inputs.
#[derive(Clone, Debug, Default)]
pub struct Places {
    /// The kernel's files.
    pub files: Arc<Vec<File>>,
    /// Name of the kernel; `None` for a graph without source.
    pub kernel: Option<Span>,
    /// Inputs by name.
    pub inputs: Vec<(String, Span)>,
}

impl Compiled {
    /// Returns the kernel's reads and stores with almost no arithmetic between: a lower bound on the time of every form
    /// ([`passes::build_floor`]). The result is useful only for timing.
    ///
    /// # Errors
    ///
    /// If a loop or branch is left.
    pub fn floor(&self) -> Result<Compiled, Errors> {
        let made = |graph: &Graph| -> Result<Graph, Errors> {
            let floor = passes::build_floor(graph).map_err(|why| {
                let what = format!("`{}` has no floor: {why}", self.kernel);
                Errors::from_diagnostic(
                    Diagnostic::new(Code::UnfitSetting, what)
                        .help("unroll it fully, and let its branches be selections"),
                )
            })?;
            let floor = passes::clean_graph(&floor);
            verify::verify_graph(&floor).map_err(|why| internal_error("floor", &why))?;
            Ok(floor)
        };
        let graph = made(&self.graph)?;
        let quad = self.quad.as_deref().map(made).transpose()?;
        let schedule = passes::schedule_graph(&graph, self.policy.reads);
        let floor = Compiled {
            counts: passes::count_operations(&graph, &schedule),
            graph,
            schedule,
            quad: quad.map(Arc::new),
            ..self.clone()
        };
        Ok(floor)
    }

    /// Returns the counts for a pixel that the publication of a built-in kernel states with these options; `None` also
    /// where one invocation computes several pixels.
    pub fn paper_counts(&self) -> Option<PaperCounts> {
        let entry = self.builtin.filter(|_| self.graph.invocation.block_size() == [1, 1])?;
        (entry.paper)(&self.options)
    }

    /// Returns the source lines whose order of operations drivers must not change, each with its file, its line from 1, and
    /// its computation. These are the sums whose meaning depends on the order, and the operations under an attribute. Empty
    /// if strict mathematics covers everything.
    pub fn exact_places(&self) -> Vec<(&str, u32, &str)> {
        if self.policy.math == Math::Strict {
            return Vec::new();
        }
        let places = passes::exact_places(&self.graph).into_iter();
        let file = |k: u32| self.graph.files.get(k as usize).map(String::as_str);
        places
            .filter_map(|origin| Some((file(origin.file)?, origin.line, &*origin.name)))
            .collect()
    }

    /// Returns the effect of half precision on the picture of a built-in kernel with these options. Options that a host
    /// sets are judged at their defaults.
    pub fn half_precision(&self) -> HalfPrecision {
        let half = self.builtin.map(|entry| (entry.half)(&self.options));
        half.unwrap_or(HalfPrecision::Unstudied)
    }

    /// Returns the kernel with one invocation for each whole quad, as compute shaders and the interpreter need it; any
    /// other kernel unchanged.
    pub fn in_blocks(&self) -> Cow<'_, Compiled> {
        let Some(graph) = &self.quad else {
            return Cow::Borrowed(self);
        };
        let graph = Graph::clone(graph);
        let schedule = passes::schedule_graph(&graph, self.policy.reads);
        let whole = Compiled {
            counts: passes::count_operations(&graph, &schedule),
            graph,
            schedule,
            quad: None,
            ..self.clone()
        };
        Cow::Owned(whole)
    }
}

/// Returns the error for a graph that breaks an invariant: a bug of the generator.
pub fn internal_error(stage: &str, why: &str) -> Errors {
    Errors::from_diagnostic(
        Diagnostic::new(
            Code::Internal,
            format!("the stage `{stage}` made a graph that breaks a rule: {why}"),
        )
        .help("this is a mistake in Straightline, not in the kernel: please report it with the kernel's source"),
    )
}
