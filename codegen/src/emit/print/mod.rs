//! Printers: from a tree to text. Printers make no decisions; they write the tree as it is.

mod expr;
mod function;
mod glsl;
mod header;
mod hlsl;
mod lines;
mod opengl;
mod overrides;
mod vulkan;
mod wgsl;

use super::ast::{Builtin, Effect, Expr, Function, Module, Op, Source, Stmt, StmtKind, Ty, VarId};
use super::text::{Binds, Text, wrapped_comment};
use straightline_evaluator::ir::{self, Scalar, Span, UnaryOp};

pub use glsl::{Glsl, LOOSE_REGION};
pub use header::{GENERATOR, header_lines};
pub use hlsl::Hlsl;
pub use lines::{PrintedStatement, PrintedText};
pub use wgsl::Wgsl;

/// Returns a type in GLSL's spelling.
pub fn glsl_type(ty: Ty) -> String {
    glsl::type_name(ty)
}

/// Returns a type in HLSL's spelling.
pub fn hlsl_type(ty: Ty) -> String {
    hlsl::type_name(ty)
}

/// Returns a part of a buffer's element.
fn element_part(element: &Text, of: &ir::Element, field: u32, within: Option<&Text>) -> Text {
    let ir::Element::Struct(of) = of else {
        return element.clone();
    };
    let name = of.fields.get(field as usize).map_or("", |field| field.name.as_str());
    let field = Text::member(element, name);
    within.map_or(field.clone(), |within| Text::index(&field, within))
}

/// Qualifier of a variable in GLSL and HLSL whose value must be rounded as written.
pub const PRECISE: &str = "precise ";

/// A shading language.
pub trait Language {
    /// Spelling of a type.
    fn type_spelling(&self, ty: Ty) -> String;
    /// A scalar constant.
    fn scalar_literal(&self, kind: Scalar, half: bool, bits: u32) -> Text;
    /// An unsigned constant by its bits.
    fn hex_literal(&self, bits: u32) -> String {
        format!("{bits:#x}u")
    }
    /// Expression of a built-in value of the entry point.
    fn builtin_value(&self, builtin: Builtin) -> Text;
    /// Function for an operation on numbers; WGSL's name unless the language has another.
    fn function_name(&self, op: &ir::Op) -> &'static str {
        expr::wgsl_function(op)
    }
    /// Read of a resource or its size, or of another lane's value.
    fn resource_read(&self, op: &ir::Op, args: &[Text]) -> Text;
    /// Selection by a scalar boolean.
    fn scalar_select(&self, ty: Ty, condition: &Text, yes: &Text, no: &Text) -> Text;
    /// Selection by component.
    fn component_select(&self, condition: &Text, yes: &Text, no: &Text) -> Text;
    /// Reinterprets the bits as another type.
    fn bitcast(&self, to: Ty, x: &Text) -> Text {
        Text::call(&self.type_spelling(to), &[x])
    }
    /// A vector or array from its parts.
    fn construct(&self, ty: Ty, parts: &[&Text]) -> Text {
        Text::call(&self.type_spelling(ty), parts)
    }
    /// A vector of one constant in all components.
    fn splat(&self, ty: Ty, component: &Text) -> Text {
        self.construct(ty, &[component])
    }
    /// The spelling of `&` and `|` of booleans, or of numbers.
    fn logical_operator(&self, op: ir::BinaryOp, kind: Scalar) -> &'static str;

    /// Declaration of an immutable local, up to ` = value;`.
    fn let_head(&self, name: &str, ty: Ty) -> String;
    /// Declaration of a mutable local, up to its value if it `has_value`, else up to `;`.
    fn var_head(&self, name: &str, ty: Ty, has_value: bool) -> String;
    /// Declaration of a constant array at module scope, up to its value.
    fn table_head(&self, name: &str, ty: Ty) -> String;
    /// The value of a constant array.
    fn table_value(&self, ty: Ty, parts: &[&Text]) -> Text {
        self.construct(ty, parts)
    }
    /// The head of a loop, up to the opening brace.
    fn loop_head(&self, counter: &str, ty: Ty, start: &str, bound: &str) -> String;
    /// Head of an endless loop, left by `break`.
    fn endless_head(&self) -> &'static str {
        "while (true) {"
    }
    /// Text before and after the condition of a branch.
    fn if_head(&self) -> [&'static str; 2];
    /// The head of a function, up to the opening brace.
    fn function_head(&self, name: &str, params: &[(&str, Ty)], result: Ty) -> String;
    /// Write of a texel of an output.
    fn texel_store(&self, output: usize, place: &Text, value: &Text) -> Text;
    /// Write to memory: statements without their semicolons. `before` is the variable that receives the old value.
    fn effect_statement(&self, effect: &Effect, args: &[Text], before: Option<&str>) -> (String, Text);
    /// Number of elements of a buffer, unsigned.
    fn unsigned_length(&self, buffer: u32) -> Text;
    /// Returns whether the call of an atomic operation evaluates to the old value.
    fn gives_before(&self) -> bool {
        true
    }
    /// Barrier of the workgroup: statements, one a line.
    fn barrier_statements(&self, buffers: bool) -> &'static [&'static str];
    /// Assignments of the fragment's outputs, one value each: statements without their semicolons.
    fn output_statements(&self, values: &[Text]) -> Vec<(String, Text)>;
    /// Everything before the first function: header, directives, bindings.
    fn preamble(&self, header: &[String]) -> String;
    /// The head of the entry point or function, up to the opening brace.
    fn entry_head(&self) -> String;
    /// Directive before a statement that comes from a place in the source, if debug information was requested and the
    /// language has it.
    fn line_directive(&self, _: &Span) -> Option<String> {
        None
    }
    /// Text after a function that comes first.
    fn trailing_text(&self) -> Option<String> {
        None
    }
    /// Returns whether the entry point is a function that must come first: the header is inside it, and everything else
    /// after it.
    fn function_leads(&self) -> bool {
        false
    }
}

/// Prints a module in a language, under a header.
pub fn print_module<'g>(language: &dyn Language, module: &Module<'g>, header: &[String]) -> PrintedText<'g> {
    Printed::new(language, module).with_header(language, header)
}

/// A module as text, without its header.
pub struct Printed<'g> {
    /// The constants, and each function except the entry point.
    beside: Vec<String>,
    /// The entry point's statements.
    body: PrintedText<'g>,
}

impl<'g> Printed<'g> {
    /// Prints a module in a language.
    pub fn new(language: &dyn Language, module: &Module<'g>) -> Printed<'g> {
        let printer = Printer { language, module };
        let mut body = PrintedText::default();
        printer.print_block(&module.body, 1, &mut body);
        Printed {
            beside: printer.tables_and_functions(),
            body,
        }
    }

    /// Returns the whole text under a header, in the same language.
    pub fn with_header(&self, language: &dyn Language, header: &[String]) -> PrintedText<'g> {
        let mut out = PrintedText::default();
        let head = language.entry_head() + "\n";
        if language.function_leads() {
            out.push_text(&head);
            header
                .iter()
                .for_each(|line| out.push_text(&(wrapped_comment(line, 4) + "\n")));
            out.push_text("\n");
        } else {
            let before = std::iter::once(language.preamble(header)).chain(self.beside.iter().cloned());
            before.for_each(|part| out.push_text(&(part + "\n")));
            out.push_text(&head);
        }
        out.append(&self.body);
        out.push_text("}\n");
        if language.function_leads() {
            let behind = self.beside.iter().cloned().chain(language.trailing_text());
            behind.for_each(|part| out.push_text(&("\n".to_owned() + &part)));
        }
        out
    }
}

/// Formats a header as comments, one line each.
pub fn header_comment(header: &[String]) -> String {
    header.iter().map(|line| wrapped_comment(line, 0) + "\n").collect()
}

/// Printer of a module's trees.
struct Printer<'m, 'g> {
    language: &'m dyn Language,
    module: &'m Module<'g>,
}

impl<'g> Printer<'_, 'g> {
    fn variable_name(&self, var: VarId) -> &str {
        &self.module.variables[var.0 as usize].name
    }

    /// Returns a declaration with the qualifier that keeps compilers from changing roundings.
    fn qualify_precise(&self, var: VarId, declared: String) -> String {
        match self.module.variables[var.0 as usize].precise {
            true => format!("{PRECISE}{declared}"),
            false => declared,
        }
    }

    /// Prints the constants, and each function except the entry point.
    fn tables_and_functions(&self) -> Vec<String> {
        let table = |(var, value): &(VarId, Expr)| {
            let declared = self
                .language
                .table_head(self.variable_name(*var), self.module.variable_type(*var));
            let value = match value.ty.shape {
                straightline_evaluator::ir::Type::Array { .. } => self.print_elements(value),
                _ => self.print_expr(value),
            };
            Self::line(0, &format!("{declared} = "), &value, ";") + "\n"
        };
        let tables: String = self.module.tables.iter().map(table).collect();
        let mut functions: Vec<String> = self
            .module
            .functions
            .iter()
            .map(|f| self.print_function(f) + "\n")
            .collect();
        functions.sort();
        if !tables.is_empty() {
            functions.insert(0, tables);
        }
        functions
    }

    fn print_function(&self, function: &Function<'_>) -> String {
        let params: Vec<(&str, Ty)> = function
            .params
            .iter()
            .map(|var| (self.variable_name(*var), self.module.variable_type(*var)))
            .collect();
        let head = self.language.function_head(&function.name, &params, function.result);
        let comment = match function.comment.as_str() {
            "" => String::new(),
            text => format!("// {text}\n"),
        };
        let mut body = PrintedText::default();
        self.print_block(&function.body, 1, &mut body);
        format!("{comment}{head}\n{}}}", body.text)
    }

    fn print_block(&self, block: &[Stmt<'g>], depth: usize, out: &mut PrintedText<'g>) {
        let mut rest = block;
        while let [stmt, behind @ ..] = rest {
            rest = behind;
            // Declares the variable for the old value in the statement of the atomic operation.
            if let (StmtKind::Var(var, None), [next, after @ ..]) = (&stmt.kind, behind)
                && let StmtKind::Effect(effect) = &next.kind
                && effect.before == Some(*var)
                && self.language.gives_before()
            {
                let declared = match after.iter().any(|stmt| stmt.assigns(*var)) {
                    true => self
                        .language
                        .var_head(self.variable_name(*var), self.module.variable_type(*var), true),
                    false => self
                        .language
                        .let_head(self.variable_name(*var), self.module.variable_type(*var)),
                };
                let text = self.print_effect(effect, Some(&declared), depth);
                self.push(out, &text, next.source, self.variable_name(*var));
                rest = after;
                continue;
            }
            self.print_statement(stmt, depth, out);
        }
    }

    /// Adds a statement, with the directive of its line.
    fn push(&self, out: &mut PrintedText<'g>, text: &str, source: Source<'g>, name: &str) {
        if let Some(directive) = source.place.and_then(|place| self.language.line_directive(&place.span)) {
            out.push_statement(&directive, Source::default(), "");
        }
        out.push_statement(text, source, name);
    }

    /// Prints a write to memory; `before` receives the old value.
    fn print_effect(&self, effect: &Effect, before: Option<&str>, depth: usize) -> String {
        let args: Vec<Text> = effect.args.iter().map(|arg| self.print_expr(arg)).collect();
        let (before, text) = self.language.effect_statement(effect, &args, before);
        Self::line(depth, &before, &text, ";")
    }

    /// Prints a line, wrapped if it is too wide.
    fn line(depth: usize, before: &str, value: &Text, behind: &str) -> String {
        let indent = 4 * depth;
        let value = value.wrap_lines(indent + before.len(), behind.len(), indent);
        format!("{}{before}{value}{behind}", " ".repeat(indent))
    }

    fn print_statement(&self, stmt: &Stmt<'g>, depth: usize, out: &mut PrintedText<'g>) {
        let indent = "    ".repeat(depth);
        let l = self.language;
        let set = |before: &str, value: &Expr| Self::line(depth, &format!("{before} = "), &self.print_expr(value), ";");
        let text = match &stmt.kind {
            StmtKind::Let(var, value) => {
                let declared = l.let_head(self.variable_name(*var), self.module.variable_type(*var));
                set(&self.qualify_precise(*var, declared), value)
            }
            StmtKind::Var(var, value) => {
                let declared = l.var_head(
                    self.variable_name(*var),
                    self.module.variable_type(*var),
                    value.is_some(),
                );
                let declared = self.qualify_precise(*var, declared);
                match value {
                    Some(value) if value.op == Op::Construct && value.ty.is_array() => {
                        Self::line(depth, &format!("{declared} = "), &self.print_elements(value), ";")
                    }
                    Some(value) => set(&declared, value),
                    None => format!("{indent}{declared};"),
                }
            }
            StmtKind::Assign(place, op, value) => {
                let op = op.map_or("", |op| expr::spell_operator(l, op, Scalar::F32).0);
                let before = format!("{} {op}= ", self.print_expr(place).code);
                Self::line(depth, &before, &self.print_expr(value), ";")
            }
            StmtKind::Store(output, place, value) => Self::line(
                depth,
                "",
                &l.texel_store(*output, &self.print_expr(place), &self.print_expr(value)),
                ";",
            ),
            StmtKind::Effect(effect) => {
                self.print_effect(effect, effect.before.map(|var| self.variable_name(var)), depth)
            }
            StmtKind::Barrier { buffers } => {
                let lines = l
                    .barrier_statements(*buffers)
                    .iter()
                    .map(|line| format!("{indent}{line}"));
                lines.collect::<Vec<_>>().join("\n")
            }
            StmtKind::Output(values) => {
                let values: Vec<Text> = values.iter().map(|value| self.print_expr(value)).collect();
                let lines = l.output_statements(&values);
                let lines = lines
                    .iter()
                    .map(|(before, value)| Self::line(depth, before, value, ";"));
                lines.collect::<Vec<_>>().join("\n")
            }
            StmtKind::Return(None) => format!("{indent}return;"),
            StmtKind::Return(Some(value)) => Self::line(depth, "return ", &self.print_expr(value), ";"),
            StmtKind::Comment(text) => wrapped_comment(text, 4 * depth),
            StmtKind::For {
                counter,
                start,
                end,
                body,
            } => {
                let name = self.variable_name(*counter);
                let bound = Text::infix(&Text::name(name), "<", &self.print_expr(end), Binds::Comparison);
                let head = l.loop_head(name, start.ty, &self.print_expr(start).code, &bound.code);
                self.push(out, &format!("{indent}{head}"), stmt.source, "");
                self.print_block(body, depth + 1, out);
                format!("{indent}}}")
            }
            StmtKind::Loop(body) => {
                let [before, behind] = l.if_head();
                let (head, body) = match body.split_first().map(|(first, rest)| (goes_on(first), rest)) {
                    Some((Some(condition), rest)) => {
                        let before = before.replacen("if", "while", 1);
                        (Self::line(depth, &before, &self.print_expr(condition), behind), rest)
                    }
                    _ => (format!("{indent}{}", l.endless_head()), &body[..]),
                };
                self.push(out, &head, stmt.source, "");
                self.print_block(body, depth + 1, out);
                format!("{indent}}}")
            }
            StmtKind::Break => format!("{indent}break;"),
            StmtKind::If {
                condition,
                then,
                otherwise,
            } => {
                let [before, behind] = l.if_head();
                let head = Self::line(depth, before, &self.print_expr(condition), behind);
                self.push(out, &head, stmt.source, "");
                self.print_block(then, depth + 1, out);
                let mut last = otherwise;
                while let [
                    Stmt {
                        kind:
                            StmtKind::If {
                                condition,
                                then,
                                otherwise,
                            },
                        source,
                    },
                ] = last.as_slice()
                {
                    let before = format!("}} else {before}");
                    let head = Self::line(depth, &before, &self.print_expr(condition), behind);
                    self.push(out, &head, *source, "");
                    self.print_block(then, depth + 1, out);
                    last = otherwise;
                }
                if !last.is_empty() {
                    out.push_statement(&format!("{indent}}} else {{"), Source::default(), "");
                    self.print_block(last, depth + 1, out);
                }
                format!("{indent}}}")
            }
        };
        let (source, name) = match &stmt.kind {
            StmtKind::Let(var, _) | StmtKind::Var(var, _) => (stmt.source, self.variable_name(*var)),
            StmtKind::Assign(place, ..) => (stmt.source, place.as_var().map_or("", |var| self.variable_name(var))),
            // The closing brace.
            StmtKind::For { .. } | StmtKind::Loop(_) | StmtKind::If { .. } => (Source::default(), ""),
            _ => (stmt.source, ""),
        };
        self.push(out, &text, source, name);
    }

    /// Prints the elements of an array in its declaration.
    fn print_elements(&self, array: &Expr) -> Text {
        let parts: Vec<Text> = array.args.iter().map(|part| self.print_expr(part)).collect();
        self.language.table_value(array.ty, &parts.iter().collect::<Vec<_>>())
    }

    fn print_expr(&self, expr: &Expr) -> Text {
        if let Op::Var(var) = expr.op {
            return Text::name(self.variable_name(var));
        }
        let args: Vec<Text> = expr.args.iter().map(|arg| self.print_expr(arg)).collect();
        expr::print(self.language, expr, &args)
    }
}

/// Returns the negated exit condition, if a loop's first statement is a conditional exit.
fn goes_on<'s>(first: &'s Stmt<'_>) -> Option<&'s Expr> {
    match &first.kind {
        StmtKind::If {
            condition,
            then,
            otherwise,
        } if condition.op == Op::Ir(ir::Op::Unary(UnaryOp::Not))
            && otherwise.is_empty()
            && matches!(then.as_slice(), [stmt] if stmt.kind == StmtKind::Break) =>
        {
            condition.args.first()
        }
        _ => None,
    }
}
