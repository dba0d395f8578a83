//! Expressions and statements.

mod generics;
mod ranges;

use super::choice::has_let;
use super::name::Name;
use super::names::Names;
use super::parts::takes_apart;
use super::targets::{BreakKind, BreakTarget};
use super::token_span;
use super::tree::{Expr, ExprKind, ForLoop, Generic, Type};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::{BinaryOp, UnaryOp};
use std::collections::HashMap;
use std::rc::Rc;
use syn::spanned::Spanned;

use generics::with_trait;
pub use generics::{held_by_none, names_instance};
use ranges::{open_start, range_in_brackets};

/// Deepest nesting of expressions.
pub const DEPTH: u32 = 128;

/// `true` if the links of a chain (`a + b + c`, `a.b().c()`, `else if`) count as nested. They do only where the host determines the stack's
/// size; elsewhere `depth.rs` limits their number.
pub const COUNTS_LINKS: bool = cfg!(target_arch = "wasm32");

/// Lowers one item of one file, gathering errors.
pub struct Lower {
    file: u32,
    /// Type that `Self` stands for.
    self_type: Option<Type>,
    names: Rc<Names>,
    /// Names of types that were followed to come here.
    pub aliases: u32,
    /// Types that other names stand for: `Self::Output` of an implementation, a type parameter of its trait.
    pub stands: HashMap<String, Type>,
    /// Parameters of a type that a trait alone tells, `impl Trait`: names for those types, and the traits.
    pub anonymous: Vec<(String, Vec<String>)>,
    /// Type parameters around.
    pub parameters: Vec<String>,
    /// `true` while the types of a function's parameters are lowered.
    pub in_parameters: bool,
    depth: u32,
    /// Loops and labelled blocks that a `break` may leave, outermost first.
    pub targets: Vec<BreakTarget>,
    /// Type parameters that are called, with their types, and by [`super::closure::conversion_of`] what `into` of them gives.
    pub functions: HashMap<String, Type>,
    /// Names of the values that attributes put into half precision.
    pub half: Vec<String>,
    /// Everything that was found wrong.
    pub errors: Vec<Diagnostic>,
}

impl Lower {
    /// For items of `file`, inside `impl self_type`.
    pub fn new(file: u32, self_type: Option<Type>, names: Rc<Names>) -> Self {
        Lower {
            file,
            self_type,
            names,
            aliases: 0,
            stands: HashMap::new(),
            anonymous: Vec::new(),
            parameters: Vec::new(),
            in_parameters: false,
            depth: 0,
            targets: Vec::new(),
            functions: HashMap::new(),
            half: Vec::new(),
            errors: Vec::new(),
        }
    }

    /// Names that stand for other names.
    pub fn names(&self) -> Rc<Names> {
        Rc::clone(&self.names)
    }

    /// The file that the items are of.
    pub fn file(&self) -> u32 {
        self.file
    }

    /// The place of a token.
    pub fn token_span(&self, span: proc_macro2::Span) -> Span {
        token_span(self.file, span)
    }

    /// Notes that something is not part of the kernel language, and what to write instead.
    pub fn note_unsupported(&mut self, span: proc_macro2::Span, what: &str, instead: &str) {
        let span = self.token_span(span);
        self.errors.push(
            Diagnostic::error_at(
                Code::NotInLanguage,
                span,
                format!("{what} is not part of the kernel language"),
            )
            .label("not supported")
            .help(instead),
        );
    }

    /// `Self` by its name.
    pub fn self_name(&self, name: String) -> String {
        match self.self_type.as_ref().map(Type::peel_refs) {
            Some(ty) if name == "Self" => ty.listed_name().unwrap_or(name),
            _ => name,
        }
    }

    /// Type that `Self` stands for, with its arguments.
    pub fn self_type(&self) -> Option<&Type> {
        self.self_type.as_ref()
    }

    /// Lets `Self` stand for a type.
    pub fn stands_in(&mut self, ty: &Type) {
        self.self_type = Some(ty.clone());
    }

    /// The last two segments of a path, without generic arguments; of a name that stands for a path, that path.
    pub fn path_segments(&mut self, path: &syn::Path) -> Vec<String> {
        let names: Vec<String> = path
            .segments
            .iter()
            .map(|s| self.self_name(s.ident.to_string()))
            .collect();
        match names.as_slice() {
            [name] => match self.names.aliased_path(name) {
                Some(path) => path.to_vec(),
                None => vec![self.type_name(name.clone())],
            },
            [parameter, of, name] if self.parameters.contains(parameter) => {
                vec![format!("{parameter}::{of}"), name.clone()]
            }
            [.., of, name] => vec![self.type_name(of.clone()), name.clone()],
            [] => names,
        }
    }

    /// The last two segments of a path; of `<Type as Trait>::name` the type and the name. `None` if the type has no name.
    fn of_type(&mut self, e: &syn::ExprPath) -> Option<Vec<String>> {
        let Some(own) = &e.qself else {
            return Some(self.path_segments(&e.path));
        };
        let ty = match (&*own.ty, self.lower_type(&own.ty)) {
            // An associated type of a type parameter.
            (syn::Type::Path(path), Type::Name(inferred, _)) if inferred == "_" => {
                self.path_segments(&path.path).join("::")
            }
            (_, ty) => ty.listed_name()?,
        };
        Some(vec![ty, e.path.segments.last()?.ident.to_string()])
    }

    /// Generic parameters; lifetimes are dropped.
    pub fn lower_generics(&mut self, generics: &syn::Generics) -> Vec<Generic> {
        let types = generics.params.iter().filter_map(|p| match p {
            syn::GenericParam::Type(t) => Some(t.ident.to_string()),
            _ => None,
        });
        self.parameters.extend(types);
        let each = generics.params.iter().filter_map(|p| match p {
            syn::GenericParam::Const(c) => Some(Generic::Const(c.ident.to_string(), self.lower_type(&c.ty))),
            syn::GenericParam::Type(t) => Some(Generic::Type(t.ident.to_string())),
            syn::GenericParam::Lifetime(_) => None,
        });
        each.collect()
    }

    /// A path as an expression.
    pub fn path_expr(&self, segments: Vec<String>, span: proc_macro2::Span) -> Expr {
        Expr {
            kind: ExprKind::Path(segments),
            span: self.token_span(span),
        }
    }

    /// An expression; what is not supported becomes `()` and an error.
    pub fn lower_expr(&mut self, expr: &syn::Expr) -> Expr {
        let span = self.token_span(expr.span());
        if self.depth >= DEPTH {
            let what = format!("expressions are nested more than {DEPTH} deep");
            if self.errors.iter().all(|e| e.message != what) {
                self.errors.push(
                    Diagnostic::error_at(Code::TooDeep, span, what)
                        .label("too deep")
                        .help("give parts of it a name with `let`"),
                );
            }
            return Expr {
                kind: ExprKind::Tuple(Vec::new()),
                span,
            };
        }
        self.depth += 1;
        let kind = self.lower_expr_kind(expr);
        self.depth -= 1;
        Expr { kind, span }
    }

    pub fn boxed(&mut self, expr: &syn::Expr) -> Box<Expr> {
        Box::new(self.lower_expr(expr))
    }

    /// The part of an expression that a chain of operators, calls, fields or `else if` goes on in.
    pub fn lower_link(&mut self, expr: &syn::Expr) -> Box<Expr> {
        let depth = self.depth;
        if !COUNTS_LINKS {
            self.depth = depth.saturating_sub(1);
        }
        let link = self.boxed(expr);
        self.depth = depth;
        link
    }

    fn lower_expr_kind(&mut self, expr: &syn::Expr) -> ExprKind {
        match expr {
            syn::Expr::Paren(e) => self.lower_expr_kind(&e.expr),
            syn::Expr::Group(e) => self.lower_expr_kind(&e.expr),
            syn::Expr::Reference(e) => ExprKind::Ref(e.mutability.is_some(), self.boxed(&e.expr)),
            syn::Expr::Lit(e) => self.lower_literal(&e.lit, e.span()).kind,
            syn::Expr::Path(e) if held_by_none(&e.path).is_some() => {
                let held = held_by_none(&e.path)
                    .map(|ty| self.lower_type(ty))
                    .unwrap_or(Type::Tuple(Vec::new()));
                self.typed_none(held, e.span())
            }
            syn::Expr::Path(e) if let Some(constant) = self.owned_constant(e) => constant,
            syn::Expr::Path(e) if names_instance(&e.path) => self.lower_instance(e),
            syn::Expr::Path(e) => match (self.of_type(e), self.stated_type(&e.path)) {
                (Some(path), Some(ty)) => self.typed(ExprKind::Path(path), ty, e.span()),
                (Some(path), None) => ExprKind::Path(path),
                (None, _) => self.refuse_expr(expr),
            },
            syn::Expr::Unary(e) => self.lower_unary(e),
            syn::Expr::Binary(e) => self.lower_binary(e),
            syn::Expr::Assign(e) if takes_apart(&e.left) => self.lower_destructuring(e),
            syn::Expr::Assign(e) => ExprKind::Assign(self.boxed(&e.left), None, self.boxed(&e.right)),
            syn::Expr::Call(e) => self.lower_call(e),
            syn::Expr::MethodCall(e) => {
                let receiver = self.lower_link(&e.receiver);
                // Values alone tell the type of a sum.
                let is_sum = e.method == "sum" || e.method == "product";
                let stated = e.turbofish.as_ref().filter(|_| !is_sum);
                ExprKind::Method(
                    receiver,
                    e.method.to_string(),
                    stated.map(|list| self.listed_arguments(list)).unwrap_or_default(),
                    e.args.iter().map(|a| self.lower_expr(a)).collect(),
                )
            }
            syn::Expr::Field(e) => {
                let name = member_name(&e.member);
                ExprKind::Field(self.lower_link(&e.base), name)
            }
            syn::Expr::Index(e) => {
                let base = self.lower_link(&e.expr);
                match range_in_brackets(&e.index) {
                    Some(range) => ExprKind::Slice(base, self.lower_bounds(range)),
                    None => ExprKind::Index(base, self.boxed(&e.index)),
                }
            }
            syn::Expr::If(e) if has_let(&e.cond) => self.if_let(e),
            syn::Expr::If(e) => {
                let condition = self.boxed(&e.cond);
                let then = self.lower_block(&e.then_branch);
                let otherwise = e.else_branch.as_ref().map(|(_, other)| self.lower_link(other));
                ExprKind::If(condition, then, otherwise, self.branch_attribute(&e.attrs))
            }
            syn::Expr::Match(e) => self.lower_match(e),
            syn::Expr::Block(e) if e.label.is_none() => ExprKind::Block(self.lower_block(&e.block)),
            syn::Expr::Block(e) => self.lower_labelled(e),
            syn::Expr::Tuple(e) => ExprKind::Tuple(e.elems.iter().map(|e| self.lower_expr(e)).collect()),
            syn::Expr::Array(e) => ExprKind::Array(e.elems.iter().map(|e| self.lower_expr(e)).collect()),
            syn::Expr::Repeat(e) => ExprKind::Repeat(self.boxed(&e.expr), self.boxed(&e.len)),
            syn::Expr::Struct(e) => self.lower_struct(e),
            syn::Expr::Cast(e) => ExprKind::Cast(self.lower_link(&e.expr), self.lower_type(&e.ty)),
            syn::Expr::Range(e) => self.lower_range(e),
            syn::Expr::ForLoop(e) if let Some(start) = open_start(&e.expr) => self.lower_open_for(e, start),
            syn::Expr::ForLoop(e) => {
                let over = self.lower_expr(&e.expr);
                let label = label_name(e.label.as_ref().map(|l| &l.name));
                let (unroll, pattern) = (self.unroll_attribute(&e.attrs), self.lower_pattern(&e.pat));
                let (body, _) = self.with_target(label.clone(), BreakKind::Other("for"), |lower| {
                    lower.lower_block(&e.body)
                });
                ExprKind::For(Box::new(ForLoop {
                    label,
                    unroll,
                    pattern,
                    over,
                    body,
                    bounded: false,
                }))
            }
            syn::Expr::While(e) if has_let(&e.cond) => self.while_let(e),
            syn::Expr::While(e) => {
                let label = label_name(e.label.as_ref().map(|l| &l.name));
                let condition = self.lower_expr(&e.cond);
                let (body, _) = self.with_target(label.clone(), BreakKind::Other("while"), |lower| {
                    lower.lower_block(&e.body)
                });
                self.lower_while(condition, body, label, &e.attrs)
            }
            syn::Expr::Loop(e) => self.lower_loop(e),
            syn::Expr::Try(e) => ExprKind::Try(self.lower_link(&e.expr)),
            syn::Expr::Return(e) => ExprKind::Return(e.expr.as_ref().map(|e| self.boxed(e))),
            syn::Expr::Break(e) => self.lower_break(e),
            syn::Expr::Continue(e) => ExprKind::Continue(label_name(e.label.as_ref())),
            syn::Expr::Macro(e) => self.macro_call(&e.mac),
            syn::Expr::Closure(e) => self.lower_closure(e),
            other => self.refuse_expr(other),
        }
    }

    fn refuse_expr(&mut self, expr: &syn::Expr) -> ExprKind {
        let (what, instead) = match expr {
            syn::Expr::Let(_) => (
                "a `let` here",
                "let the condition of an `if` begin with it, and nest another `if` where there is more than one",
            ),
            syn::Expr::Unsafe(_) => ("`unsafe`", "use the prelude's textures and arrays"),
            syn::Expr::Async(_) | syn::Expr::Await(_) => ("`async`", "a kernel computes its value at once"),
            syn::Expr::Const(_) => ("a `const` block", "name the constant: `const NAME: f32 = ...;`"),
            syn::Expr::Infer(_) => ("`_` as a value", "write `let _ = value;`, or leave the statement out"),
            syn::Expr::RawAddr(_) => ("a raw pointer", "use the value itself"),
            syn::Expr::TryBlock(_) => ("`try`", "a kernel has no errors: compute a value for every pixel"),
            syn::Expr::Yield(_) => ("`yield`", "a kernel computes its value at once"),
            syn::Expr::Path(_) => ("a type in `<>`", "name the type alone: `f32::MAX`"),
            _ => (
                "this expression",
                "see the kernel language's documentation for what there is",
            ),
        };
        self.note_unsupported(expr.span(), what, instead);
        ExprKind::Tuple(Vec::new())
    }

    fn lower_unary(&mut self, e: &syn::ExprUnary) -> ExprKind {
        match e.op {
            syn::UnOp::Neg(_) => ExprKind::Unary(UnaryOp::Neg, self.boxed(&e.expr)),
            syn::UnOp::Not(_) => ExprKind::Unary(UnaryOp::Not, self.boxed(&e.expr)),
            syn::UnOp::Deref(_) => ExprKind::Deref(self.boxed(&e.expr)),
            _ => {
                self.note_unsupported(e.span(), "this operator", "use `-` or `!`");
                ExprKind::Tuple(Vec::new())
            }
        }
    }

    fn lower_binary(&mut self, e: &syn::ExprBinary) -> ExprKind {
        use syn::BinOp as B;
        let (left, right) = (self.lower_link(&e.left), self.boxed(&e.right));
        let op = match e.op {
            B::And(_) => return ExprKind::Lazy(true, left, right),
            B::Or(_) => return ExprKind::Lazy(false, left, right),
            B::Add(_) | B::AddAssign(_) => BinaryOp::Add,
            B::Sub(_) | B::SubAssign(_) => BinaryOp::Sub,
            B::Mul(_) | B::MulAssign(_) => BinaryOp::Mul,
            B::Div(_) | B::DivAssign(_) => BinaryOp::Div,
            B::Rem(_) | B::RemAssign(_) => BinaryOp::Rem,
            B::BitXor(_) | B::BitXorAssign(_) => BinaryOp::Xor,
            B::BitAnd(_) | B::BitAndAssign(_) => BinaryOp::And,
            B::BitOr(_) | B::BitOrAssign(_) => BinaryOp::Or,
            B::Shl(_) | B::ShlAssign(_) => BinaryOp::Shl,
            B::Shr(_) | B::ShrAssign(_) => BinaryOp::Shr,
            B::Eq(_) => BinaryOp::Eq,
            B::Ne(_) => BinaryOp::Ne,
            B::Lt(_) => BinaryOp::Lt,
            B::Le(_) => BinaryOp::Le,
            B::Gt(_) => BinaryOp::Gt,
            B::Ge(_) => BinaryOp::Ge,
            _ => {
                self.note_unsupported(e.span(), "this operator", "use the operators of numbers and booleans");
                return ExprKind::Tuple(Vec::new());
            }
        };
        match is_assignment(&e.op) {
            false => ExprKind::Binary(op, left, right),
            true => ExprKind::Assign(left, Some(op), right),
        }
    }

    fn lower_call(&mut self, e: &syn::ExprCall) -> ExprKind {
        let args = e.args.iter().map(|a| self.lower_expr(a)).collect();
        match &*e.func {
            syn::Expr::Path(path) if self.of_type(path).is_some() => {
                let mut constants = self.generic_arguments(&path.path);
                let called = self.of_type(path).unwrap_or_default();
                let count = path.path.segments.len();
                let is_type = path
                    .path
                    .segments
                    .last()
                    .is_some_and(|last| is_made(&last.ident.to_string()));
                if count == 1
                    && is_type
                    && let Some(ty) = self.stated_type(&path.path)
                {
                    return self.typed(ExprKind::Call(called, Vec::new(), args), ty, e.span());
                }
                constants.extend(self.owner_argument(path));
                ExprKind::Call(with_trait(path, called), constants, args)
            }
            other => ExprKind::Invoke(self.lower_link(other), args),
        }
    }

    fn lower_struct(&mut self, e: &syn::ExprStruct) -> ExprKind {
        let path = self.path_segments(&e.path);
        let mut fields = Vec::new();
        for field in &e.fields {
            fields.push((member_name(&field.member), self.lower_expr(&field.expr)));
        }
        let made = ExprKind::Struct(path, fields, e.rest.as_ref().map(|rest| self.boxed(rest)));
        match self.stated_type(&e.path) {
            Some(ty) => self.typed(made, ty, e.span()),
            None => made,
        }
    }
}

/// Name of the sequence `start..`, which no kernel can write.
pub const COUNTED: &str = "#counted";

/// Placeholder for a generic argument that is `_`.
pub const INFERRED: &str = "_";

/// Returns whether a call by a name of one word makes a structure: `Window::<3>(x)`, but not `Some::<f32>(x)`.
fn is_made(name: &str) -> bool {
    name.starts_with(char::is_uppercase) && !matches!(name, "Some" | "Ok" | "Err")
}

/// The name of a field, or its number.
pub fn member_name(member: &syn::Member) -> Name {
    match member {
        syn::Member::Named(name) => name.to_string().into(),
        syn::Member::Unnamed(index) => index.index.to_string().into(),
    }
}

pub fn label_name(label: Option<&syn::Lifetime>) -> Option<String> {
    label.map(|l| l.ident.to_string())
}

/// Returns whether an operator assigns its result to its left side.
fn is_assignment(op: &syn::BinOp) -> bool {
    use syn::BinOp as B;
    matches!(
        op,
        B::AddAssign(_)
            | B::SubAssign(_)
            | B::MulAssign(_)
            | B::DivAssign(_)
            | B::RemAssign(_)
            | B::BitXorAssign(_)
            | B::BitAndAssign(_)
            | B::BitOrAssign(_)
            | B::ShlAssign(_)
            | B::ShrAssign(_)
    )
}
