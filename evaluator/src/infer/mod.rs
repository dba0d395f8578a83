//! Type inference: the type of every expression of the functions that a kernel reaches, as rustc finds it.
//!
//! A literal without a suffix takes its type from what it meets anywhere in its function, not from its value; only inference
//! before evaluation can tell. On the way this refuses what rustc would refuse: types that do not match, assignments to
//! what is not `mut`, numbers that Rust takes for an `f64`. What it does not know (a method that only exists natively) it
//! leaves to the evaluator, which refuses it where it is reached.

mod apply;
mod calls;
mod closures;
mod constants;
mod declared;
mod exhaustive;
mod expr;
mod instances;
mod methods;
mod operators;
mod order;
mod overloads;
mod pattern;
mod places;
mod qualified;
mod shapes;
mod signature;
mod textures;
mod traits;
mod types;

use crate::diagnostic::{Code, Diagnostic, Span};
use crate::front::Library;
use crate::front::tree::{Const, Expr, Fields, Function, Generic, IntType, Type as SourceType};
use std::collections::{BTreeSet, HashMap};
use types::{Kind, Table, Ty};

pub use overloads::{operator_function, trait_of};

/// Results of inference for the expressions of an item, by their places.
#[derive(Default)]
struct Known {
    /// Types of integer literals.
    literals: HashMap<Span, IntType>,
    /// Library functions behind methods of numbers, vectors and the like, and behind calls that their types distinguish.
    methods: HashMap<Span, String>,
    /// Calls of functions with type parameters: the function's key, and the types.
    instances: HashMap<Span, (String, Vec<Option<SourceType>>)>,
}

/// Results of inference by the name of the item; those of expressions outside of items that the kernel reaches, by the empty name.
/// Places alone would not do: the functions that a trait provides for several types share theirs.
type KnownItems = HashMap<String, Known>;

/// Gives every literal of the functions, constants and options that are `reached` its type.
///
/// # Errors
///
/// Everything that rustc would refuse, of all functions.
pub fn infer_types(library: &mut Library, reached: &BTreeSet<String>) -> Result<(), Vec<Diagnostic>> {
    let (known, mut errors) = infer_items(library, reached);
    if errors.is_empty() {
        apply::apply_inferred(library, &known);
        return Ok(());
    }
    errors.sort_by_key(|error| error.span);
    errors.dedup();
    Err(errors)
}

/// Errors that rustc reports too, wherever it meets them.
const OF_RUST: [Code; 16] = [
    Code::UnknownField,
    Code::UnknownLabel,
    Code::DefinedTwice,
    Code::Immutable,
    Code::MismatchedTypes,
    Code::ArgumentCount,
    Code::NotAFunction,
    Code::IndexType,
    Code::LiteralRange,
    Code::NonExhaustive,
    Code::RefutablePattern,
    Code::QuestionMark,
    Code::Leaving,
    Code::TraitImplementation,
    Code::DivisionByZero,
    Code::Overflow,
];

/// Errors that rustc reports too, unless a name that the files do not show is meant.
const OF_NAMES: [Code; 3] = [Code::UnknownName, Code::UnknownFunction, Code::OperatorTypes];

/// Errors that rustc reports too, in functions and constants that the kernel does not reach. Other errors there do not
/// concern it, as these items need not be of the kernel language.
pub fn check_others(library: &Library, others: &BTreeSet<String>, unknown_names: bool) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    for name in others {
        infer_item(library, &mut Known::default(), &mut errors, |checker| {
            checker.unreached = true;
            if let Some(function) = library.functions.get(name) {
                checker.check_function(function);
            }
            if let Some(constant) = library.consts.get(name) {
                checker.check_constant(constant);
            }
        });
    }
    declared::check_declared(library, None, &mut errors);
    declared::check_owners(library, |_| true, &mut errors);
    for (_, generics, fields) in fields_of_types(library) {
        for (_, ty, span) in fields {
            infer_item(library, &mut Known::default(), &mut errors, |checker| {
                checker.declare_generics(generics, *span);
                checker.check_array_lengths(ty);
            });
        }
    }
    errors.retain(|error| {
        let is_in = |codes: &[Code]| error.code().is_some_and(|code| codes.contains(&code));
        is_in(&OF_RUST) || !unknown_names && is_in(&OF_NAMES)
    });
    errors.sort_by_key(|error| error.span);
    errors.dedup();
    errors
}

/// Infers all reached items: the results, and every error.
fn infer_items(library: &Library, reached: &BTreeSet<String>) -> (KnownItems, Vec<Diagnostic>) {
    let (mut items, mut errors) = (KnownItems::new(), Vec::new());
    for name in reached {
        if let Some(function) = library.functions.get(name) {
            let known = items.entry(name.clone()).or_default();
            infer_item(library, known, &mut errors, |checker| checker.check_function(function));
        }
        if let Some(constant) = library.consts.get(name) {
            let known = items.entry(name.clone()).or_default();
            infer_item(library, known, &mut errors, |checker| checker.check_constant(constant));
        }
    }
    declared::check_declared(library, Some(reached), &mut errors);
    declared::check_owners(library, |of| reached.contains(of), &mut errors);
    let mut known = Known::default();
    for (name, generics, fields) in fields_of_types(library) {
        for (_, ty, span) in fields {
            // A type that the kernel does not reach may hold anything.
            let mut unreached = Vec::new();
            let errors = if reached.contains(name) {
                &mut errors
            } else {
                &mut unreached
            };
            infer_item(library, &mut known, errors, |checker| {
                checker.declare_generics(generics, *span);
                checker.check_array_lengths(ty);
            });
        }
    }
    for field in library.options.values().flatten() {
        infer_item(library, &mut known, &mut errors, |checker| {
            let ty = checker.convert_type(&field.ty, field.span);
            checker.check_expr(&field.default, &ty);
            if let Some(range) = &field.range {
                let number = match ty {
                    Ty::Ref(_, list) | Ty::Array(list) => match *list {
                        Ty::Array(element) => *element,
                        other => other,
                    },
                    other => other,
                };
                checker.check_expr(range, &Ty::Range(Box::new(number)));
            }
        });
    }
    items.insert(String::new(), known);
    (items, errors)
}

/// Fields of structures and of the variants of enums, with the name and the generic parameters of each type.
fn fields_of_types(library: &Library) -> impl Iterator<Item = (&String, &[Generic], &Fields)> {
    let structs = library.structs.iter();
    let structs = structs.map(|(name, s)| (name, s.generics.as_slice(), &s.fields));
    let variants = library.enums.iter().flat_map(|(name, e)| {
        let variants = e.variants.iter();
        variants.map(move |variant| (name, e.generics.as_slice(), &variant.fields))
    });
    structs.chain(variants)
}

/// Looks at one item by itself.
fn infer_item<'l>(
    library: &'l Library,
    known: &mut Known,
    errors: &mut Vec<Diagnostic>,
    look: impl FnOnce(&mut Checker<'l>),
) {
    let mut checker = Checker::new(library);
    look(&mut checker);
    checker.finish(known, errors);
}

/// A local variable.
struct Local {
    name: String,
    ty: Ty,
    mutable: bool,
    /// `true` if it was declared without a value, so that it may be assigned once.
    deferred: bool,
    span: Span,
}

/// A loop or labelled block that a `break` may leave.
#[derive(Clone, Copy)]
struct Around<'l> {
    label: Option<&'l str>,
    /// `true` for a block, which only a `break` with its label can leave.
    block: bool,
}

/// An operator whose operands were not known yet.
struct Deferred<'l> {
    op: crate::ir::BinaryOp,
    left: Ty,
    right: Ty,
    result: Ty,
    expr: &'l Expr,
}

/// State of the inference of one function.
struct Checker<'l> {
    library: &'l Library,
    table: Table,
    locals: Vec<Local>,
    /// Type parameters of the function.
    params: Vec<String>,
    /// The traits that they have.
    bounds: Option<&'l HashMap<String, Vec<String>>>,
    /// The types that `into` of them gives.
    conversions: Option<&'l HashMap<String, SourceType>>,
    /// Type and trait of the default function or constant that is checked.
    default_of: Option<(&'l str, &'l str)>,
    /// Calls of which the function follows from what it has to give.
    pending: Vec<traits::Pending>,
    /// Type parameters of calls that have to have traits.
    bounded: Vec<traits::Bound>,
    /// Calls of functions with type parameters.
    instances: Vec<instances::Instance>,
    /// Type of the function's result.
    result: Ty,
    /// The loops around, and blocks with labels, outermost first.
    loops: Vec<Around<'l>>,
    /// Integer literals and their types.
    integers: Vec<(Span, Ty, i64)>,
    /// Float literals and their types.
    floats: Vec<(Span, Ty)>,
    /// Types of values that are compared or cast, which shows whether a number is natively an `f64` or an `f32`.
    observed: Vec<Ty>,
    /// Operands of a minus sign: the place of the sign, the type, and the place of the operand.
    negated: Vec<(Span, Ty, Span)>,
    /// Operators between two literals: where, which, and the literals with the type of the result.
    computed: Vec<(Span, crate::ir::BinaryOp, [i64; 2], Ty)>,
    deferred: Vec<Deferred<'l>>,
    /// Methods that stand for functions of the library.
    methods: HashMap<Span, String>,
    /// `true` in an item that the kernel does not reach: it may use what Rust and glam have and the language has not.
    unreached: bool,
    errors: Vec<Diagnostic>,
}

impl<'l> Checker<'l> {
    fn new(library: &'l Library) -> Self {
        Checker {
            library,
            table: Table::default(),
            locals: Vec::new(),
            params: Vec::new(),
            bounds: None,
            conversions: None,
            default_of: None,
            pending: Vec::new(),
            bounded: Vec::new(),
            instances: Vec::new(),
            loops: Vec::new(),
            result: Ty::UNIT,
            integers: Vec::new(),
            floats: Vec::new(),
            observed: Vec::new(),
            negated: Vec::new(),
            computed: Vec::new(),
            deferred: Vec::new(),
            methods: HashMap::new(),
            unreached: false,
            errors: Vec::new(),
        }
    }

    fn check_function(&mut self, function: &'l Function) {
        self.bounds = Some(&function.bounds);
        self.conversions = Some(&function.conversions);
        self.default_of = match (&function.of, &function.default_of) {
            (Some(SourceType::Name(ty, _)), Some(of)) => Some((ty, of)),
            _ => None,
        };
        self.declare_generics(&function.generics, function.span);
        for name in function.bounds.keys().filter(|name| name.starts_with("dyn ")) {
            self.check_trait_object(name, function.span);
        }
        for (k, param) in function.params.iter().enumerate() {
            if function.params[..k].iter().any(|other| other.name == param.name) {
                self.bound_twice(&param.name, param.span, "parameter list");
            }
            let ty = self.convert_type(&param.ty, param.span);
            self.declare_local(&param.name, ty, param.mutable, false, param.span);
        }
        self.result = self.convert_type(&function.result, function.span);
        let wanted = self.result.clone();
        let found = self.infer_block(&function.body, Some(&wanted));
        let at = function.body.value.as_ref().map_or(function.span, |value| value.span);
        self.coerce(&wanted, &found, at);
    }

    /// Declares type parameters and constants.
    fn declare_generics(&mut self, generics: &'l [Generic], span: Span) {
        for generic in generics {
            match generic {
                Generic::Type(name) => self.params.push(name.clone()),
                Generic::Const(name, ty) => {
                    let ty = self.convert_type(ty, span);
                    self.declare_local(name, ty, false, false, span);
                }
            }
        }
    }

    fn bound_twice(&mut self, name: &str, span: Span, list: &str) {
        self.errors.push(
            Diagnostic::error_at(
                Code::DefinedTwice,
                span,
                format!("identifier `{name}` is bound more than once in this {list}"),
            )
            .label("bound again")
            .help("give it another name"),
        );
    }

    fn check_constant(&mut self, constant: &'l Const) {
        self.bounds = Some(&constant.bounds);
        self.default_of = match (&constant.of, &constant.default_of) {
            (Some(SourceType::Name(ty, _)), Some(of)) => Some((ty, of)),
            _ => None,
        };
        self.declare_generics(&constant.generics, constant.value.span);
        let ty = self.convert_type(&constant.ty, constant.value.span);
        self.check_expr(&constant.value, &ty);
    }

    fn declare_local(&mut self, name: &str, ty: Ty, mutable: bool, deferred: bool, span: Span) {
        self.locals.push(Local {
            name: name.to_owned(),
            ty,
            mutable,
            deferred,
            span,
        });
    }

    /// Literals that nothing decides become `i32`, as in Rust; what is left is checked.
    fn finish(mut self, known: &mut Known, errors: &mut Vec<Diagnostic>) {
        self.solve_deferred();
        let integers = std::mem::take(&mut self.integers);
        for (_, ty, _) in &integers {
            if self.table.variable_kind(ty) == Some(Kind::Integer) {
                self.table.unify(ty, &Ty::I32);
            }
        }
        self.solve_deferred();
        let minus: HashMap<Span, Span> = self
            .negated
            .iter()
            .map(|(sign, _, operand)| (*operand, *sign))
            .collect();
        for (span, ty, value) in integers {
            let Ty::Int(kind) = self.table.resolve_shallow(&ty) else {
                continue;
            };
            let largest = match kind {
                IntType::Usize => i64::from(u32::MAX),
                kind if minus.contains_key(&span) => -kind.range().0,
                kind => kind.range().1,
            };
            if value > largest {
                let at = minus.get(&span).copied().unwrap_or(span);
                self.errors.push(
                    Diagnostic::error_at(
                        Code::LiteralRange,
                        at,
                        format!("literal out of range for `{}`", Ty::Int(kind)),
                    )
                    .label(format!("this is more than {largest}"))
                    .help(format!(
                        "write `{value}_u32`, and convert it where another type is needed"
                    )),
                );
            }
            known.literals.insert(span, kind);
        }
        for (sign, ty, _) in std::mem::take(&mut self.negated) {
            if let ty @ Ty::Int(kind) = self.table.resolve_shallow(&ty)
                && kind.range().0 == 0
            {
                self.errors.push(
                    Diagnostic::error_at(
                        Code::OperatorTypes,
                        sign,
                        format!("cannot apply unary operator `-` to type `{ty}`"),
                    )
                    .label("unsigned")
                    .help("use `wrapping_neg`, or compute in i32"),
                );
            }
        }
        for (span, op, [a, b], ty) in std::mem::take(&mut self.computed) {
            if let Ty::Int(kind) = self.table.resolve_shallow(&ty)
                && operators::literals_overflow(op, a, b, kind)
            {
                if b == 0 && op != crate::ir::BinaryOp::Sub {
                    self.errors.push(
                        Diagnostic::error_at(Code::DivisionByZero, span, "attempt to divide by zero")
                            .label("the divisor is always 0")
                            .help("divide only where the divisor is not 0: `if n != 0 { ... }`"),
                    );
                    continue;
                }
                self.errors.push(
                    Diagnostic::error_at(Code::Overflow, span, "this arithmetic operation will overflow")
                        .label(format!("beyond the range of `{}`", Ty::Int(kind)))
                        .help("compute it in another type, or with `wrapping_mul` and its like where it is to wrap"),
                );
            }
        }
        let observed: Vec<Ty> = self.observed.iter().map(|ty| self.table.resolve_shallow(ty)).collect();
        let mut named = Vec::new();
        for (span, ty) in std::mem::take(&mut self.floats) {
            // Reports a single error for all literals of the same type.
            let ty = self.table.resolve_shallow(&ty);
            if self.table.variable_kind(&ty) == Some(Kind::Float) && observed.contains(&ty) && !named.contains(&ty) {
                named.push(ty);
                self.errors.push(
                    Diagnostic::error_at(
                        Code::TypeNeeded,
                        span,
                        "nothing says that this number is an `f32`, so that Rust makes it an `f64`",
                    )
                    .label("an `f64`")
                    .help("write `_f32` behind it, or state the type of its variable: `let x: f32 = ...`"),
                );
            }
        }
        self.settle_traits();
        known.instances.extend(self.named_instances());
        known.methods.extend(self.methods);
        errors.append(&mut self.errors);
    }
}
