//! The partial evaluator: runs a kernel on values some of which are compile-time constants and others runtime values.
//!
//! Known values are computed exactly as the code compiled by rustc computes them. Everything else becomes a node of
//! the graph.
//! Loops are unrolled or left in the shader, as the [`Unroll`](crate::policy::Unroll) policy says; calls are always inlined.

mod ascribe;
mod assertions;
mod assign;
mod binding;
mod buffers;
mod call;
mod checkpoint;
mod closures;
mod consts;
mod control;
mod effects;
mod endless;
mod entry;
mod enums;
mod expr;
mod functions;
mod generics;
mod integers;
mod iterators;
mod lazy;
mod library;
mod loops;
mod matching;
mod math;
mod matrix;
mod methods;
mod naming;
mod objects;
mod operators;
mod options;
mod order;
mod paths;
mod place;
mod positions;
mod quad;
mod ranges;
mod report;
mod resources;
mod results;
mod scope;
mod sequence;
mod shape;
mod slices;
mod stages;
mod tables;
mod textures;
mod traits;
mod types;
mod value;
mod workgroups;

use crate::diagnostic::{Code, Diagnostic, Errors, File, Span};
use crate::front::Library;
use crate::ir::{Builder, Graph, Invocation, NodeId, Scalar, Type, usize_value};
use crate::passes::Exact;
use crate::passes::narrow::{Facts, Refusal, narrow_usize};
use crate::policy::{Math, Policy};
use control::ControlState;
use loops::{ForcedUnrolls, LoopState};
use report::Report;
use resources::InputState;
use scope::Scope;
use std::collections::{BTreeSet, HashMap, VecDeque};
use std::sync::Arc;
use straightline_kernels::{OptionText, OptionValues};
use value::{Eval, Exit, Jump, Value};

pub use loops::{BUDGET_HELP, LoopReport, name_largest_loops};
pub use options::{Numeric, OptionInfo, OptionKind, describe_options, override_text, parse_settings};

/// An evaluated kernel, with its options resolved.
pub struct Evaluated {
    /// The remaining computation.
    pub graph: Graph,
    /// Value of every option.
    pub options: OptionValues,
    /// First paragraph of the kernel's documentation.
    pub docs: String,
    /// Every loop in source order, with its outcome.
    pub loops: Vec<LoopReport>,
    /// Span of the kernel's name.
    pub span: Span,
    /// Names of the inputs, with the span of each declaration.
    pub inputs: Vec<(String, Span)>,
}

/// Returns the errors in the parameters of the function `entry` that do not depend on its body. Used for kernels in
/// which other errors were found.
pub fn parameter_errors(library: &Library, files: &Arc<Vec<File>>, entry: &str) -> Vec<Diagnostic> {
    Evaluator::new(library, files, &Policy::default()).parameter_errors(&crate::front::raw_name(entry))
}

/// Evaluates the function `entry` with the given options; all others have their defaults.
///
/// `invocation` is the unit of work of one invocation, unless the kernel's parameters make it a lane of a quad.
///
/// Variables assigned in a loop left in the shader become runtime values. Where later code needs one of them as a
/// constant, evaluation returns to the loop and unrolls it. The range of each `usize` is known only at the end. If
/// one does not fit, the whole kernel is evaluated again, each time with at least one more loop unrolled.
pub fn evaluate_kernel(
    library: &Library,
    files: &Arc<Vec<File>>,
    entry: &str,
    settings: &[OptionText],
    policy: &Policy,
    invocation: Invocation,
) -> Result<Evaluated, Errors> {
    let entry = &*crate::front::raw_name(entry);
    let looping = crate::front::looping_statements(library, entry, policy);
    let mut forced = ForcedUnrolls::new();
    let mut steps = 0;
    loop {
        let mut evaluator = Evaluator::new(library, files, policy);
        evaluator.loops = LoopState::new(looping.clone(), forced);
        evaluator.report = Report::new(files, steps);
        evaluator.builder.graph_mut().invocation = invocation;
        let refused = match evaluator.whole_kernel(entry, settings)? {
            Narrowed::Fits(evaluated) => return Ok(*evaluated),
            Narrowed::Refused(refused) => refused,
        };
        if refused.iter().all(|(loops, _)| loops.is_empty()) {
            let errors = refused.into_iter().map(|(_, error)| error);
            return Err(Errors::new(errors.collect(), files));
        }
        for (loops, error) in refused {
            evaluator.unroll_for(loops, error);
        }
        steps = evaluator.report.steps();
        forced = evaluator.loops.into_forced();
    }
}

/// Result of narrowing every `usize` to 32 bits.
enum Narrowed {
    Fits(Box<Evaluated>),
    /// Errors of operations that may differ from the native ones, with the loops left in the shader on which each
    /// depends.
    Refused(Vec<(BTreeSet<Span>, Diagnostic)>),
}

/// Upper limit for the parts of one value.
const MAX_PARTS: usize = 1 << 18;

/// Number of components copied in the time of one step.
const PARTS_PER_STEP: usize = 8;

/// Evaluation of one kernel. Each part of its state that has rules of its own is a structure with private fields.
struct Evaluator<'a> {
    library: &'a Library,
    /// Types that implement the kernel's traits.
    implementers: Vec<&'a str>,
    /// Policy for loops and branches in the function that is being evaluated.
    policy: Policy,
    builder: Builder<'a>,
    scope: Scope,
    loops: LoopState,
    control: ControlState,
    report: Report<'a>,
    inputs: InputState,
    /// Facts about values of type `usize`.
    facts: Facts,
    /// The structures whose parts were named last, and after which parameter. Most structures are passed on from
    /// function to function.
    named: VecDeque<naming::NamedStruct>,
    /// Constants evaluated so far, with the node count at that time.
    consts: HashMap<String, (usize, Value)>,
    /// Reads made so far.
    last_site: u32,
    /// Type stated for the next call.
    expected: Option<Box<crate::front::tree::Type>>,
    /// `true` if the place that is being resolved will be written.
    writing: bool,
}

impl<'a> Evaluator<'a> {
    fn new(library: &'a Library, files: &Arc<Vec<File>>, policy: &Policy) -> Self {
        let mut builder = Builder::new(&Exact);
        builder.graph_mut().files = files.iter().map(|f| f.path.clone()).collect();
        builder.graph_mut().purposes = Arc::clone(&library.purposes);
        builder.set_exact(policy.math == Math::Strict);
        Evaluator {
            library,
            implementers: objects::implementers(library),
            policy: policy.clone(),
            builder,
            scope: Scope::default(),
            loops: LoopState::default(),
            control: ControlState::default(),
            report: Report::new(files, 0),
            inputs: InputState::default(),
            facts: Facts::default(),
            named: VecDeque::new(),
            consts: HashMap::new(),
            last_site: 0,
            expected: None,
            writing: false,
        }
    }
}

impl Evaluator<'_> {
    /// Evaluates a kernel and narrows every `usize`.
    fn whole_kernel(&mut self, entry: &str, settings: &[OptionText]) -> Result<Narrowed, Errors> {
        let result = self.eval_kernel(entry, settings);
        if result.is_ok() && self.report.error_count() == 0 {
            self.check_loop_paths();
            for error in self.loops.take_deferred() {
                self.report.push_error(error);
            }
        }
        let (outputs, options, docs) = match result {
            Ok(parts) if self.report.error_count() == 0 => parts,
            Ok(_) => return Err(self.report.take_located()),
            Err(Exit::Left(Jump::Unreachable(span))) => {
                let error = Diagnostic::error_at(Code::Assertion, span, "`unreachable!()` is reached")
                    .label("for every pixel")
                    .help("give a value here, or correct the condition that leads here");
                self.record_error(error.into());
                return Err(self.report.take_located());
            }
            Err(Exit::Left(_)) => {
                return Err(Errors::from_diagnostic(Diagnostic::new(
                    Code::KernelResult,
                    format!("`{}` does not end with a value", crate::front::unraw(entry)),
                )));
            }
            Err(exit) => {
                self.record_error(exit);
                return Err(self.report.take_located());
            }
        };
        let span = self.library.functions[entry].span;
        let facts = std::mem::take(&mut self.facts);
        let whole = std::mem::replace(&mut self.builder, Builder::new(&Exact)).finish(outputs);
        let narrowed = match narrow_usize(&whole, &facts) {
            Ok(narrowed) => narrowed,
            Err(refused) => {
                let each = refused.into_iter().map(|Refusal { node, mut error }| {
                    if error.span == Some(Span::default()) {
                        error.span = Some(span);
                    }
                    (self.loops.loops_feeding(&whole, &[node]), error)
                });
                return Ok(Narrowed::Refused(each.collect()));
            }
        };
        Ok(Narrowed::Fits(Box::new(Evaluated {
            loops: self.loops.sorted_reports(),
            span,
            inputs: std::mem::take(&mut self.inputs.declared),
            graph: narrowed.unwrap_or(whole),
            options,
            docs,
        })))
    }

    /// Counts a step of work, so that evaluation terminates.
    fn count_step(&mut self, span: Span) -> Eval<()> {
        self.count_steps(1, span)
    }

    /// Counts the work of copying or comparing a value with `parts` components. Without this, copies of large arrays in
    /// loops would not exhaust the budget.
    fn count_copy(&mut self, parts: usize, span: Span) -> Eval<()> {
        self.count_steps(1 + (parts / PARTS_PER_STEP) as u64, span)
    }

    fn count_steps(&mut self, steps: u64, span: Span) -> Eval<()> {
        self.report.count_work(steps);
        let nodes = self.builder.graph().nodes.len();
        let within = self.report.check_limits(nodes, loops::BUDGET_HELP, span);
        within.map_err(|error| self.loops.name_largest(*error).into())
    }

    /// Records an error unless it has been recorded already.
    fn record_error(&mut self, exit: Exit) -> Exit {
        self.report.record_exit(exit)
    }

    /// Returns a value for a message: the number itself if known, else the kind.
    fn describe_known(&self, value: &Value) -> String {
        match (self.known_int(value), value) {
            (Some(n), _) => n.to_string(),
            (None, Value::Enum(choice)) => match self.known_variant(choice) {
                Some(k) => format!("`{}::{}`", choice.ty, self.library.enums[&*choice.ty].variants[k].name),
                None => value.describe(),
            },
            (None, Value::Tuple(parts)) if !parts.is_empty() => {
                let parts: Vec<String> = parts.iter().map(|part| self.describe_known(part)).collect();
                format!("({})", parts.join(", "))
            }
            (None, other) => other.describe(),
        }
    }

    fn ty(&self, id: NodeId) -> Type {
        self.builder.graph().ty(id)
    }

    /// Returns a boolean if it is known.
    fn known_bool(&self, id: NodeId) -> Option<bool> {
        self.builder.graph().constant_bits(id).map(|bits| bits[0] != 0)
    }

    /// Returns an integer of any type if it is known.
    fn known_int(&self, value: &Value) -> Option<i64> {
        match value {
            Value::Int(n) => Some(*n),
            Value::Node(id) => {
                let bits = self.builder.graph().constant_bits(*id)?[0];
                match self.ty(*id) {
                    Type::I32 => Some(i64::from(bits as i32)),
                    Type::U32 => Some(i64::from(bits)),
                    Type::USIZE => {
                        let bits = self.builder.graph().constant_bits(*id)?;
                        i64::try_from(usize_value(&bits)).ok()
                    }
                    _ => None,
                }
            }
            _ => None,
        }
    }

    /// Returns a value as a node.
    fn value_node(&mut self, value: &Value, span: Span) -> Eval<NodeId> {
        match value {
            Value::Node(id) => Ok(*id),
            Value::Int(n) => self.int_node(*n, Scalar::Usize, span),
            Value::Ref(_) => {
                let value = self.deref_value(value.clone(), span)?;
                self.value_node(&value, span)
            }
            Value::Poison => Err(Exit::Noted),
            other => Err(Diagnostic::error_at(
                Code::MismatchedTypes,
                span,
                format!("{} where a number is needed", other.describe()),
            )
            .into()),
        }
    }

    /// Returns a known integer as a node of a scalar kind.
    fn int_node(&mut self, n: i64, kind: Scalar, span: Span) -> Eval<NodeId> {
        let bits = match kind {
            Scalar::I32 => i32::try_from(n).map(|n| n as u32).ok(),
            Scalar::U32 => u32::try_from(n).ok(),
            Scalar::Usize => return Ok(self.builder.usize(n as u64)),
            Scalar::F32 | Scalar::Bool => {
                return Err(Diagnostic::error_at(
                    Code::MismatchedTypes,
                    span,
                    format!("the integer {n} where {kind} is needed"),
                )
                .label("an integer")
                .help(format!("write `{n}.0`, or convert with `as f32`"))
                .into());
            }
        };
        match bits {
            Some(bits) => Ok(self.builder.constant(Type::scalar(kind), [bits, 0, 0, 0])),
            None => Err(
                Diagnostic::error_at(Code::LiteralRange, span, format!("{n} does not fit into {kind}"))
                    .label("too large for a shader")
                    .into(),
            ),
        }
    }
}
