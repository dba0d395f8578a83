//! The stages from an evaluated graph to the graph that is scheduled: a list of passes, each with the reason for its
//! position.

mod half;
mod lanes;
mod sharing;

use crate::spec::Settings;
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;
use straightline_evaluator::diagnostic::{Code, Diagnostic, Span};
use straightline_evaluator::ir::{Graph, Invocation};
use straightline_evaluator::passes::{self, Gathered, Sharing};
use straightline_evaluator::policy::{Math, ReadOrder, Share, Transport};

/// A pass from graph to graph.
pub struct Stage {
    /// Name in messages and for observers.
    pub name: &'static str,
    /// Reason for the pass, and for its place in [`STAGES`].
    #[cfg_attr(not(test), expect(dead_code, reason = "read by people, and by the test of the list"))]
    pub reason: &'static str,
    /// Condition under which the pass runs.
    pub applies: fn(&Work<'_>) -> bool,
    /// The pass. Its graph is cleaned afterwards.
    pub run: fn(&mut Work<'_>) -> Result<Made, Refusal>,
}

/// Result of a stage.
pub enum Made {
    /// The kernel, replacing the previous graph.
    Kernel(Graph),
    /// The kernel with a whole quad per invocation, in addition to the graph whose invocations are lanes.
    Quad(Graph),
}

/// A kernel on its way through [`STAGES`].
pub struct Work<'s> {
    pub kernel: &'s str,
    pub settings: &'s Settings,
    /// Names of the values in half precision: first those of the kernel's attributes, after the stage all of them.
    pub half: BTreeSet<String>,
    pub graph: Graph,
    /// Transport of quad swaps: the requested one, or the one that blocks of quads imply.
    pub transport: Option<Transport>,
    /// For a kernel whose invocations are lanes: the graph in which one invocation computes a whole quad.
    pub quad: Option<Arc<Graph>>,
    /// Outcome of texel sharing by workgroups.
    pub sharing: Option<Arc<Sharing>>,
    /// Graph before texels are shared by workgroups.
    pub unshared: Option<Arc<Graph>>,
    /// Reads that became gathers.
    pub gathered: Arc<[Gathered]>,
}

impl<'s> Work<'s> {
    pub fn new(kernel: &'s str, settings: &'s Settings, half: BTreeSet<String>, graph: Graph) -> Self {
        Work {
            half,
            kernel,
            settings,
            graph,
            transport: settings.transport,
            quad: None,
            sharing: None,
            unshared: None,
            gathered: Arc::default(),
        }
    }

    fn is_of_lanes(&self) -> bool {
        self.graph.invocation == Invocation::Lane
    }

    /// Stores the cleaned graph of a stage.
    pub fn accept(&mut self, made: Made) {
        match made {
            Made::Kernel(graph) => self.graph = graph,
            Made::Quad(graph) => self.quad = Some(Arc::new(graph)),
        }
    }
}

impl Made {
    pub fn graph(&self) -> &Graph {
        match self {
            Made::Kernel(graph) | Made::Quad(graph) => graph,
        }
    }

    pub fn cleaned(self) -> Self {
        match self {
            Made::Kernel(graph) => Made::Kernel(passes::clean_graph(&graph)),
            Made::Quad(graph) => Made::Quad(passes::clean_graph(&graph)),
        }
    }
}

/// A setting that does not fit the kernel, with the setting to use instead.
pub struct Refusal {
    message: String,
    help: Cow<'static, str>,
}

impl Refusal {
    fn new(message: String, help: impl Into<Cow<'static, str>>) -> Self {
        let help = help.into();
        Refusal { message, help }
    }

    /// Returns the error, located at the kernel's name.
    pub fn into_diagnostic(self, kernel: Span) -> Diagnostic {
        Diagnostic::error_at(Code::UnfitSetting, kernel, self.message)
            .label("this kernel")
            .help(self.help)
    }
}

/// Every stage, in order. After each, unused nodes are removed and the graph is verified.
pub const STAGES: &[Stage] = &[
    Stage {
        name: "clean",
        reason: "Evaluation leaves terms that no output uses; all later passes visit every node.",
        applies: |_| true,
        run: |work| Ok(Made::Kernel(std::mem::take(&mut work.graph))),
    },
    Stage {
        name: "share-loads",
        reason: "After clean, which merges equal coordinates: equal reads are found by equal operands. \
                 Cleaning afterwards merges the terms that were equal but for their reads.",
        applies: |work| !work.settings.repeat_loads,
        run: |work| Ok(Made::Kernel(passes::share_loads(&work.graph))),
    },
    Stage {
        name: "exactness",
        reason: "Before fast, which must not touch the sums that are marked here; after share-loads, since a sum that \
                 cancels is found by equal operands.",
        applies: |_| true,
        run: |work| Ok(Made::Kernel(passes::mark_exact_ops(&work.graph))),
    },
    Stage {
        name: "fast",
        reason: "Before lanes and pixels are put into one invocation, so that every form has the same roundings.",
        applies: |work| work.settings.math == Math::Fast,
        run: |work| Ok(Made::Kernel(passes::apply_fast_math(&work.graph))),
    },
    Stage {
        name: "half",
        reason: "After fast, which must see constants as they are written; before lanes and pixels are put into one \
                 invocation, so that every form has the same roundings.",
        applies: |work| !work.settings.half.is_empty() || !work.half.is_empty(),
        run: half::lower_to_half,
    },
    Stage {
        name: "block",
        reason: "Before texels are shared or gathered: the pixels of one invocation share equal reads by themselves.",
        applies: |work| !work.is_of_lanes() && (work.settings.transport.is_some() || work.settings.block != [1, 1]),
        run: lanes::expand_block,
    },
    Stage {
        name: "derivatives",
        reason: "Before quad, which puts the lanes into one invocation, where no swaps are left to lower.",
        applies: lanes::swaps_by_derivatives,
        run: lanes::lower_to_derivatives,
    },
    Stage {
        name: "quad",
        reason: "After derivatives, so that the interpreter runs the swaps that are emitted; before sharing, as block.",
        applies: |work| work.is_of_lanes(),
        run: lanes::expand_quad,
    },
    Stage {
        name: "share-by-workgroup",
        reason: "After block and quad, which decide the pixels of an invocation; before gathers, which would hide reads.",
        applies: |work| work.settings.share != Share::Invocation,
        run: sharing::share_by_workgroup,
    },
    Stage {
        name: "gathers",
        reason: "After share-by-workgroup: texels in a workgroup's memory are not gathered.",
        applies: |work| work.settings.reads == ReadOrder::Gather,
        run: sharing::gather_reads,
    },
    Stage {
        name: "coordinates",
        reason: "After every pass that adds reads, so that the coordinates of all reads share their columns and rows.",
        applies: |_| true,
        run: |work| Ok(Made::Kernel(passes::by_component(&work.graph))),
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kernel;

    #[test]
    fn names_are_unique_and_reasons_are_sentences() {
        for (k, stage) in STAGES.iter().enumerate() {
            assert!(
                STAGES[..k].iter().all(|other| other.name != stage.name),
                "{}",
                stage.name
            );
            assert!(stage.reason.ends_with('.'), "{}", stage.name);
        }
    }

    /// Returns the stages that run for a built-in kernel.
    fn stages_of(kernel: &str, settings: &Settings) -> Vec<String> {
        let mut seen = Vec::new();
        let kernel = Kernel::builtin(kernel).unwrap();
        let compiled = kernel.compile_observed(settings, &mut |name, _| seen.push(name.to_owned()));
        compiled.unwrap_or_else(|errors| panic!("{errors}"));
        seen
    }

    #[test]
    fn stages_run_in_the_order_of_the_list() {
        let all = Settings::new();
        let mut never_run: Vec<&str> = STAGES.iter().map(|stage| stage.name).collect();
        for (kernel, settings) in [
            ("sraa", all.clone().math(Math::Fast).half(["weights"]).block(2, 1)),
            ("sraa", all.clone().share(Share::WORKGROUP)),
            ("sraa", all.clone().reads(ReadOrder::Gather)),
            ("quad_convolution", all.transport(Transport::Derivatives)),
        ] {
            let seen = stages_of(kernel, &settings);
            assert_eq!(seen[0], "eval");
            let mut rest = STAGES.iter().map(|stage| stage.name);
            for name in &seen[1..] {
                assert!(rest.any(|stage| stage == name), "{name} runs out of order: {seen:?}");
            }
            never_run.retain(|stage| !seen.iter().any(|name| name == stage));
        }
        assert!(never_run.is_empty(), "no kernel runs {never_run:?}");
    }
}
