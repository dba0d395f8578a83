//! The stages from a kernel's text to a scheduled graph, in order. A stage that is not asked for is left out; the graph is
//! verified after each.

use crate::compiled::{Compiled, Places, internal};
use crate::emit;
use crate::spec::Settings;
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors, File};
use straightline_evaluator::eval::{self, Evaluated};
use straightline_evaluator::front::Library;
use straightline_evaluator::ir::{Graph, Invocation, verify};
use straightline_evaluator::limits::{self, Meter};
use straightline_evaluator::passes::{self, Gathered, Sharing};
use straightline_evaluator::policy::{Math, ReadOrder, Share, Transport};
use straightline_kernels::Entry;

/// Callback that receives the graph after each stage, with the stage's name.
pub type Observer<'a> = dyn FnMut(&str, &Graph) + Send + 'a;

/// Threads that every device has in a workgroup.
const MOST_THREADS: u32 = 256;

/// Pixels that one invocation may compute.
const MAX_BLOCK: u32 = 64;

fn is_block([width, height]: [u32; 2]) -> bool {
    (1..=MAX_BLOCK).contains(&width.saturating_mul(height))
}

/// A kernel's text.
#[derive(Clone, Debug)]
pub struct Source {
    /// Name of the function.
    pub name: String,
    /// Entry of a built-in kernel.
    pub builtin: Option<&'static Entry>,
    pub files: Arc<Vec<File>>,
}

/// Compiles a kernel whose files define `library`. Which options are not at their defaults is left open.
///
/// # Errors
///
/// Everything that is wrong with the kernel under these settings.
pub fn compile(
    kernel: &Source,
    library: &Library,
    settings: &Settings,
    observer: &mut Observer<'_>,
) -> Result<Compiled, Errors> {
    let meter = Meter::open(settings.limits());
    let policy = settings.policy();
    policy.check().map_err(|what| {
        let help = "use full, none, or partial(N), and name each loop once";
        Errors::of(Diagnostic::new(Code::SettingValue, what).help(help))
    })?;
    let invocation = match settings.block {
        [1, 1] => Invocation::Pixel,
        _ => Invocation::MayBeOutside,
    };
    let mut evaluated = eval::evaluate(
        library,
        &kernel.files,
        &kernel.name,
        &settings.options,
        &policy,
        invocation,
    )?;
    let graph = std::mem::take(&mut evaluated.graph);
    let mut stages = Stages {
        kernel,
        settings,
        evaluated: &evaluated,
        observer,
    };
    let graph = stages.done("eval", graph)?;
    let graph = stages.exact(graph)?;
    let Lanes { graph, quad, transport } = stages.lanes(graph)?;
    let (graph, sharing) = stages.workgroup(graph)?;
    let (graph, gathered) = stages.gathers(graph)?;
    // After all that adds reads, so that their coordinates are shared too.
    let graph = stages.done("coordinates", passes::clean(&passes::by_component(&graph)))?;
    let schedule = passes::schedule(&graph, settings.reads);
    // Most of what is too long is known to be before it is written.
    stages.within_budget(emit::statements_at_least(&graph, &schedule))?;
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
        counts: passes::count(&graph, &schedule),
        graph,
        schedule,
        transport,
        sharing,
        gathered,
        quad,
        limits: settings.limits(),
        work: meter.work(),
        time: meter.time(),
        places: Arc::new(Places {
            files: Arc::clone(&kernel.files),
            // Of a built-in kernel a user's options are wrong, not its text.
            kernel: kernel.builtin.is_none().then_some(evaluated.span),
            inputs: match kernel.builtin {
                Some(_) => Vec::new(),
                None => evaluated.inputs.clone(),
            },
        }),
    };
    if emit::statements_at_most(&compiled.graph) > settings.budget {
        stages.within_budget(compiled.text_counts().statements)?;
    }
    Ok(compiled)
}

/// The stages after evaluation, and how each reports an error.
struct Stages<'s, 'o> {
    kernel: &'s Source,
    settings: &'s Settings,
    /// Loops, places and the like; its graph is taken.
    evaluated: &'s Evaluated,
    observer: &'s mut Observer<'o>,
}

/// A kernel by its invocations.
struct Lanes {
    graph: Graph,
    /// Graph in which one invocation computes a quad, of a kernel whose invocations are lanes.
    quad: Option<Arc<Graph>>,
    transport: Option<Transport>,
}

impl Stages<'_, '_> {
    /// The graph after a stage, verified and within the limits.
    fn done(&mut self, stage: &str, graph: Graph) -> Result<Graph, Errors> {
        limits::spend(graph.nodes.len() as u64);
        if let Some(excess) = limits::exceeded(graph.nodes.len()) {
            let what = format!("compiling `{}` takes {excess}", self.kernel.name);
            let error = Diagnostic::at(Code::Limit, self.evaluated.span, what)
                .label(format!("in the stage `{stage}`, with {} operations", graph.nodes.len()))
                .help(excess.help());
            return Err(self.with_loops(error));
        }
        verify::verify(&graph).map_err(|why| internal(stage, &why))?;
        (self.observer)(stage, &graph);
        Ok(graph)
    }

    /// Rules that change no bit of the result, and those that may where that is asked for.
    fn exact(&mut self, graph: Graph) -> Result<Graph, Errors> {
        let mut graph = self.done("clean", passes::clean(&graph))?;
        if !self.settings.repeat_loads {
            graph = self.done("share-loads", passes::share_loads(&graph))?;
            // Sharing makes new common terms, and those leave others unused.
            graph = self.done("clean", passes::clean(&graph))?;
        }
        // Before rules that change roundings, which must not touch the sums that it marks.
        graph = self.done("exactness", passes::exactness(&graph))?;
        if self.settings.math == Math::Fast {
            graph = self.done("fast", passes::clean(&passes::fast(&graph)))?;
        }
        Ok(graph)
    }

    /// The kernel as its invocations compute it: lanes of quads, quads, blocks of pixels, or single ones. Before texels are shared
    /// between invocations, since several pixels of one share them already.
    fn lanes(&mut self, graph: Graph) -> Result<Lanes, Errors> {
        let settings = self.settings;
        let name = &self.kernel.name;
        match (graph.invocation == Invocation::Lane, settings.transport, settings.block) {
            (true, ..) => self.quads(graph),
            (false, Some(_), _) => Err(self.refused(
                format!("`{name}` computes one pixel, and sends no messages"),
                "leave the transport out, or take `pixel: Quad<IVec2>` and give a `Quad<Vec4>`",
            )),
            (false, None, [1, 1]) => Ok(Lanes {
                graph,
                quad: None,
                transport: None,
            }),
            (false, None, [width, height]) if !is_block(settings.block) => Err(self.refused(
                format!("a block of {width}x{height} pixels"),
                "use blocks of 1 to 64 pixels, such as 2x1 or 2x2",
            )),
            (false, None, block) => {
                let expanded = passes::expand(&graph, block).map_err(|why| {
                    self.refused(
                        format!("the pixels of `{name}` cannot run in step: {why}"),
                        "unroll fully and select, so that no loop or branch is left, or compute one pixel at a time",
                    )
                })?;
                Ok(Lanes {
                    graph: self.done("block", passes::clean(&expanded))?,
                    quad: None,
                    transport: None,
                })
            }
        }
    }

    /// A kernel of quads: by lanes with its transport, and with a quad or several computed by one invocation.
    fn quads(&mut self, mut graph: Graph) -> Result<Lanes, Errors> {
        let (mut transport, block) = (self.settings.transport, self.settings.block);
        let name = &self.kernel.name;
        let mut size = [2, 2];
        if block != [1, 1] {
            let [width, height] = block;
            if width % 2 != 0 || height % 2 != 0 || !is_block(block) {
                return Err(self.refused(
                    format!("`{name}` computes quads, and a block of {width}x{height} pixels has other"),
                    "use whole quads, such as 4x2 or 8x2, and 64 pixels at most",
                ));
            }
            if transport.is_some_and(|transport| transport != Transport::Block) {
                return Err(self.refused(
                    format!("the lanes of `{name}` lie in one invocation, and send no messages"),
                    "leave the transport out, or the block",
                ));
            }
            transport = Some(Transport::Block);
            size = block;
        }
        if transport == Some(Transport::Derivatives) {
            let lowered = passes::by_derivatives(&graph)
                .map_err(|why| self.refused(why, "send floats, or use the transport `subgroup`"))?;
            graph = self.done("derivatives", passes::clean(&lowered))?;
        }
        let expanded = passes::expand(&graph, size).map_err(|why| {
            self.refused(
                format!("the lanes of `{name}` do not run in step: {why}"),
                "decide loops and branches by what the whole quad has in common; choose lane by lane with `select`",
            )
        })?;
        let expanded = self.done("quad", passes::clean(&expanded))?;
        Ok(match transport {
            Some(Transport::Block) => Lanes {
                graph: expanded,
                quad: None,
                transport,
            },
            _ => Lanes {
                graph,
                quad: Some(Arc::new(expanded)),
                transport,
            },
        })
    }

    /// Texels read once by a workgroup, where that is asked for.
    fn workgroup(&mut self, graph: Graph) -> Result<(Graph, Option<Arc<Sharing>>), Errors> {
        let Share::Workgroup(threads) = self.settings.share else {
            return Ok((graph, None));
        };
        let (tiled, found) = shared(&graph, threads, self.settings.block).map_err(|(why, help)| {
            let name = &self.kernel.name;
            self.refused(
                format!("the pixels of `{name}` cannot share texels by workgroup: {why}"),
                help,
            )
        })?;
        let graph = self.done("share-by-workgroup", passes::clean(&tiled))?;
        Ok((graph, Some(Arc::new(found))))
    }

    /// Four texels read at once, where that is asked for. After texels were shared: those of a workgroup's memory are none.
    fn gathers(&mut self, graph: Graph) -> Result<(Graph, Arc<[Gathered]>), Errors> {
        if self.settings.reads != ReadOrder::Gather {
            return Ok((graph, Arc::default()));
        }
        let (gathering, found) = passes::gathers(&graph).map_err(|why| {
            self.refused(
                format!("the reads of `{}` cannot be gathered: {why}", self.kernel.name),
                "leave `reads` out, or let one invocation compute whole pixels",
            )
        })?;
        Ok((self.done("gathers", passes::clean(&gathering))?, found.into()))
    }

    fn within_budget(&self, statements: u32) -> Result<(), Errors> {
        let (name, budget) = (&self.kernel.name, self.settings.budget);
        if statements <= budget {
            return Ok(());
        }
        let what = format!("`{name}` has {statements} statements, more than its budget of {budget}");
        let error = Diagnostic::at(Code::Budget, self.evaluated.span, what)
            .label("this kernel")
            .help(eval::BUDGET_HELP);
        Err(self.with_loops(error))
    }

    /// An error about size, which names the loops with the most work.
    fn with_loops(&self, error: Diagnostic) -> Errors {
        let error = eval::name_largest_loops(&self.evaluated.loops, error);
        Errors::new(vec![error], &self.kernel.files)
    }

    /// A setting that does not fit the kernel.
    fn refused(&self, what: String, help: &str) -> Errors {
        let error = Diagnostic::at(Code::UnfitSetting, self.evaluated.span, what)
            .label("this kernel")
            .help(help);
        Errors::new(vec![error], &self.kernel.files)
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

fn first_sentence(docs: &str) -> String {
    docs.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}
