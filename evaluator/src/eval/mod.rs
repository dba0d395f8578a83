//! The partial evaluator: runs a kernel on values some of which are compile-time constants and others runtime values.
//!
//! Known values are computed exactly as the code compiled by rustc computes them. Everything else becomes a node of
//! the graph.
//! Loops are unrolled or left in the shader, as the [`Unroll`](crate::policy::Unroll) policy says; calls are always inlined.

mod ascribe;
mod assertions;
mod assign;
mod binding;
mod blocks;
mod budget;
mod buffers;
mod call;
mod causes;
mod closures;
mod consts;
mod control;
mod demand;
mod departures;
mod effects;
mod entry;
mod enums;
mod expr;
mod functions;
mod generics;
mod integers;
mod iterators;
mod kept;
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
mod partial;
mod paths;
mod place;
mod points;
mod positions;
mod quad;
mod ranges;
mod resources;
mod results;
mod scope;
mod sequence;
mod shape;
mod slices;
mod stages;
mod states;
mod tables;
mod textures;
mod traits;
mod value;
mod whiles;
mod workgroups;

use crate::diagnostic::{Code, Diagnostic, Errors, File, Span};
use crate::front::Library;
use crate::ir::{Builder, Counter, Graph, Invocation, NodeId, Scalar, Type, usize_value};
use crate::limits;
use crate::passes::Exact;
use crate::passes::narrow::{Facts, Refusal, narrow_usize};
use crate::policy::{Math, Policy};
use rustc_hash::FxHashSet;
use scope::Scope;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet, VecDeque};
use std::sync::Arc;
use straightline_kernels::{OptionText, OptionValues};
use value::{Eval, Exit, Value};

pub use budget::{BUDGET_HELP, LoopReport, name_largest_loops};
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
    let mut unrolled = HashMap::new();
    let mut steps = 0;
    loop {
        let mut evaluator = Evaluator::new(library, files, policy);
        evaluator.loop_statements.clone_from(&looping);
        evaluator.forced_unrolls.clone_from(&unrolled);
        (evaluator.steps, evaluator.last_check) = (steps, steps);
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
        (unrolled, steps) = (evaluator.forced_unrolls, evaluator.steps);
    }
}

/// Result of narrowing every `usize` to 32 bits.
enum Narrowed {
    Fits(Box<Evaluated>),
    /// Errors of operations that may differ from the native ones, with the loops left in the shader on which each
    /// depends.
    Refused(Vec<(BTreeSet<Span>, Diagnostic)>),
}

/// Steps after which a kernel is assumed not to terminate.
const MAX_STEPS: u64 = 20_000_000;

/// Steps between two checks of time and memory.
const STEPS_BETWEEN_CHECKS: u64 = 1 << 10;

/// Nodes after which a loop is assumed to be unrolled by mistake.
const MAX_NODES: usize = 400_000;

/// Upper limit for the parts of one value.
const MAX_PARTS: usize = 1 << 18;

/// Call depth after which a recursion is assumed not to terminate.
const MAX_CALLS: usize = 200;

/// Depth of nested expressions, those of the calling functions included. WebAssembly uses its host's stack of about
/// one megabyte. Everywhere else the stack is deep enough for anything that the front end and [`MAX_CALLS`] allow.
const MAX_EXPRESSIONS: u32 = if cfg!(target_arch = "wasm32") { 700 } else { 100_000 };

struct Evaluator<'a> {
    library: &'a Library,
    /// Types that implement the kernel's traits.
    implementers: Vec<&'a str>,
    builder: Builder<'a>,
    /// Policy for loops and branches in the function that is being evaluated.
    policy: Policy,
    /// The kernel's files, for excerpts.
    files: Arc<Vec<File>>,
    /// Loops unrolled regardless of the policy, because a constant is needed that they assign.
    forced_unrolls: HashMap<Span, demand::UnrollReason>,
    /// Number of times evaluation has returned to a loop.
    restarts: usize,
    /// Statements that may leave an unrollable loop in the shader.
    loop_statements: FxHashSet<Span>,
    /// `true` if every loop that can be unrolled is unrolled.
    unrolls_all: bool,
    loops: budget::LoopTracker,
    structured_loops: demand::StructuredLoops,
    scope: Scope,
    /// Counters of the enclosing unrolled loops, outermost first.
    counters: Arc<[Counter]>,
    /// Functions being evaluated, innermost last.
    calls: Vec<Cow<'a, str>>,
    errors: Vec<Diagnostic>,
    /// The structures whose parts were named last, and after which parameter. Most structures are passed on from
    /// function to function.
    named: VecDeque<naming::NamedStruct>,
    /// Constants evaluated so far, with the node count at that time.
    consts: HashMap<String, (usize, Value)>,
    /// Reads made so far.
    last_site: u32,
    /// `true` inside a phase of a workgroup.
    in_phase: bool,
    /// Names of the kernel's parameters and of the fields of parameters that are structures, with the number of uses
    /// of each name.
    parameters: BTreeMap<String, usize>,
    /// Element type of each buffer.
    elements: Vec<crate::front::tree::Type>,
    /// Steps of work, earlier attempts at the kernel included.
    steps: u64,
    /// Step count at the last check of time and memory.
    last_check: u64,
    /// Upper limit for the number of nodes.
    most_nodes: usize,
    /// `true` after a limit has been reached.
    exhausted: bool,
    /// Type stated for the next call.
    expected: Option<Box<crate::front::tree::Type>>,
    /// Depth of nested expressions.
    depth: u32,
    /// Early exits from the enclosing blocks, first to last.
    early_exits: Vec<departures::EarlyExit>,
    /// Number of enclosing loops left in the shader.
    loop_depth: u32,
    /// `true` if the place that is being resolved will be written.
    writing: bool,
    /// Conditions under which the current place is reached, each with its required value: those of the selected sides
    /// of branches, and those of exits taken before the enclosing branches and loops.
    path_conditions: Vec<(NodeId, bool)>,
    /// Runtime conditions of the enclosing branches, with the number of calls around each.
    branch_conditions: Vec<(usize, NodeId)>,
    /// Runtime counters of type `usize`, with the start and end of their ranges.
    counters_of_usize: HashMap<NodeId, (NodeId, NodeId)>,
    /// Differences of `usize` that wrap intentionally.
    wrapping: HashSet<NodeId>,
    /// Source span of each node.
    places: Vec<Span>,
    /// The kernel's inputs, with the span of each declaration.
    inputs: Vec<(String, Span)>,
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
            builder,
            policy: policy.clone(),
            files: Arc::clone(files),
            forced_unrolls: HashMap::new(),
            restarts: 0,
            loop_statements: FxHashSet::default(),
            branch_conditions: Vec::new(),
            unrolls_all: false,
            loops: budget::LoopTracker::default(),
            structured_loops: demand::StructuredLoops::default(),
            scope: Scope::default(),
            counters: Arc::default(),
            calls: Vec::new(),
            parameters: BTreeMap::new(),
            errors: Vec::new(),
            named: VecDeque::new(),
            consts: HashMap::new(),
            last_site: 0,
            in_phase: false,
            elements: Vec::new(),
            steps: 0,
            last_check: 0,
            most_nodes: MAX_NODES,
            exhausted: false,
            expected: None,
            depth: 0,
            early_exits: Vec::new(),
            loop_depth: 0,
            writing: false,
            path_conditions: Vec::new(),
            counters_of_usize: HashMap::new(),
            wrapping: HashSet::new(),
            places: Vec::new(),
            inputs: Vec::new(),
        }
    }
}

impl Evaluator<'_> {
    /// Evaluates a kernel and narrows every `usize`.
    fn whole_kernel(&mut self, entry: &str, settings: &[OptionText]) -> Result<Narrowed, Errors> {
        let result = self.eval_kernel(entry, settings);
        if result.is_ok() && self.errors.is_empty() {
            self.check_loop_paths();
            let deferred = self.loops.take_deferred();
            self.errors.extend(deferred);
        }
        let (outputs, options, docs) = match result {
            Ok(parts) if self.errors.is_empty() => parts,
            Ok(_) => return Err(self.all_errors()),
            Err(Exit::Left(_)) => {
                return Err(Errors::from_diagnostic(Diagnostic::new(
                    Code::KernelResult,
                    format!("`{}` does not end with a value", crate::front::unraw(entry)),
                )));
            }
            Err(exit) => {
                self.record_error(exit);
                return Err(self.all_errors());
            }
        };
        let span = self.library.functions[entry].span;
        let facts = Facts {
            counters: std::mem::take(&mut self.counters_of_usize),
            wrapping: std::mem::take(&mut self.wrapping),
            places: std::mem::take(&mut self.places),
        };
        let whole = std::mem::replace(&mut self.builder, Builder::new(&Exact)).finish(outputs);
        let narrowed = match narrow_usize(&whole, &facts) {
            Ok(narrowed) => narrowed,
            Err(refused) => {
                let each = refused.into_iter().map(|Refusal { node, mut error }| {
                    if error.span == Some(Span::default()) {
                        error.span = Some(span);
                    }
                    (self.structured_loops.loops_feeding(&whole, &[node]), error)
                });
                return Ok(Narrowed::Refused(each.collect()));
            }
        };
        Ok(Narrowed::Fits(Box::new(Evaluated {
            loops: self.loops.sorted_reports(),
            span,
            inputs: std::mem::take(&mut self.inputs),
            graph: narrowed.unwrap_or(whole),
            options,
            docs,
        })))
    }

    fn all_errors(&mut self) -> Errors {
        Errors::new(std::mem::take(&mut self.errors), &self.files)
    }

    /// Counts a step of work, so that evaluation terminates.
    fn count_step(&mut self, span: Span) -> Eval<()> {
        self.steps += 1;
        limits::count_work(1);
        let made = self.builder.graph().nodes.len();
        let (code, what, help) = if self.steps > MAX_STEPS {
            let what = format!("evaluation takes more than {MAX_STEPS} steps");
            (Code::Budget, what, budget::BUDGET_HELP)
        } else if made > self.most_nodes {
            let what = format!("the kernel unrolls to more than {} operations", self.most_nodes);
            (Code::Budget, what, budget::BUDGET_HELP)
        } else {
            let due = self.steps >= self.last_check + STEPS_BETWEEN_CHECKS;
            let Some(excess) = due.then(|| limits::exceeded_limit(made)).flatten() else {
                self.last_check = if due { self.steps } else { self.last_check };
                return Ok(());
            };
            (Code::Limit, format!("evaluation takes {excess}"), excess.help())
        };
        self.exhausted = true;
        let function = self.calls.last().cloned().unwrap_or_default();
        let error = Diagnostic::error_at(code, span, what)
            .label(format!("reached here, in `{function}`"))
            .help(help);
        Err(self.loops.name_largest(error).into())
    }

    /// Records an error unless it has been recorded already.
    fn record_error(&mut self, exit: Exit) -> Exit {
        let errors = match exit {
            Exit::Error(error) => vec![*error],
            Exit::Demand(needs) => needs.into_iter().map(|need| need.error).collect(),
            other => return other,
        };
        for error in errors {
            if !self.errors.contains(&error) {
                self.errors.push(error);
            }
        }
        Exit::Noted
    }

    /// Returns the runtime conditions that control evaluation inside the outermost call of a function.
    fn decides_within(&self, function: &str) -> Vec<NodeId> {
        let outermost = self.calls.iter().position(|name| *name == function).unwrap_or(0);
        let inside = self.branch_conditions.iter().filter(|(calls, _)| *calls > outermost);
        inside.map(|(_, condition)| *condition).collect()
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
