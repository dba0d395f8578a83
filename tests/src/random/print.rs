//! A random kernel as Rust text.

use super::ast::*;

/// The program's text, whose kernel is `k`.
pub fn print(program: &Program) -> String {
    let mut p = Printer {
        out: String::new(),
        indent: 0,
    };
    for (index, fields) in program.structs.iter().enumerate() {
        p.line("#[derive(Clone, Copy)]");
        p.line(&format!("struct S{index} {{"));
        for (k, field) in fields.iter().enumerate() {
            p.line(&format!("    f{k}: {},", ty(field)));
        }
        p.line("}");
    }
    for (k, value) in program.consts.iter().enumerate() {
        p.line(&format!("const C{k}: {} = {};", ty(&value.ty), p.expr(value)));
    }
    for (k, function) in program.functions.iter().enumerate() {
        let mut params = vec!["a: &Frame<Vec4>".to_owned(), "pixel: IVec2".to_owned()];
        params.extend(
            function
                .params
                .iter()
                .map(|(v, t)| format!("{}: {}", name(v.name), ty(t))),
        );
        let head = format!("fn f{k}({}) -> {}", params.join(", "), ty(&function.result));
        let body = p.block(&function.body);
        p.line(&format!("{head} {body}"));
    }
    let body = p.block(&program.body);
    p.line(&format!("pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {body}"));
    p.out
}

/// A type's name.
pub fn ty(t: &Ty) -> String {
    match t {
        Ty::Bool => "bool".to_owned(),
        Ty::I32 => "i32".to_owned(),
        Ty::U32 => "u32".to_owned(),
        Ty::F32 => "f32".to_owned(),
        Ty::Vec(n) => format!("Vec{n}"),
        Ty::IVec(n) => format!("IVec{n}"),
        Ty::UVec2 => "UVec2".to_owned(),
        Ty::Array(element, n) => format!("[{}; {n}]", ty(element)),
        Ty::Tuple(parts) => format!("({})", parts.iter().map(ty).collect::<Vec<_>>().join(", ")),
        Ty::Struct(k) => format!("S{k}"),
    }
}

struct Printer {
    out: String,
    indent: usize,
}

impl Printer {
    fn line(&mut self, text: &str) {
        self.out.push_str(text);
        self.out.push('\n');
    }

    fn pad(&self) -> String {
        "    ".repeat(self.indent)
    }

    fn block(&mut self, block: &Block) -> String {
        if block.statements.is_empty() && block.value.is_none() {
            return "{}".to_owned();
        }
        self.indent += 1;
        let mut text = "{\n".to_owned();
        for statement in &block.statements {
            let line = self.statement(statement);
            text.push_str(&format!("{}{line}\n", self.pad()));
        }
        if let Some(value) = &block.value {
            let value = self.nested(value);
            text.push_str(&format!("{}{value}\n", self.pad()));
        }
        self.indent -= 1;
        text.push_str(&format!("{}}}", self.pad()));
        text
    }

    fn statement(&mut self, statement: &Stmt) -> String {
        match statement {
            Stmt::Let {
                var,
                mutable,
                typed,
                init,
            } => {
                let mutable = if *mutable { "mut " } else { "" };
                let shown = if *typed {
                    format!(": {}", ty(&init.ty))
                } else {
                    String::new()
                };
                let value = match init.kind {
                    // What a `let` states is the literal's type.
                    Kind::Uint(n) if *typed => n.to_string(),
                    _ => self.nested(init),
                };
                format!("let {mutable}{}{shown} = {value};", name(var.name))
            }
            Stmt::LetTuple(vars, value) => {
                let names: Vec<String> = vars.iter().map(|v| name(v.name)).collect();
                format!("let ({}) = {};", names.join(", "), self.nested(value))
            }
            Stmt::Assign(place, op, value) => {
                let op = op.map_or("", operator);
                let value = self.nested(value);
                format!("{} {op}= {value};", self.place(place))
            }
            Stmt::If(condition, then, otherwise) => {
                let head = format!("if {} {}", self.nested(condition), self.block(then));
                if *otherwise == Block::default() {
                    head
                } else if let ([inner @ Stmt::If(..)], None) = (&otherwise.statements[..], &otherwise.value) {
                    format!("{head} else {}", self.statement(inner))
                } else {
                    format!("{head} else {}", self.block(otherwise))
                }
            }
            Stmt::For(var, range, body) => {
                let over = self.range(range);
                format!("for {} in {over} {}", name(var.name), self.block(body))
            }
            Stmt::ForArray(var, array, by_reference, body) => {
                let array = self.nested(array);
                let head = if *by_reference {
                    format!("for &{} in {array}.iter()", name(var.name))
                } else {
                    format!("for {} in {array}", name(var.name))
                };
                format!("{head} {}", self.block(body))
            }
            Stmt::While(condition, body) => format!("while {} {}", self.nested(condition), self.block(body)),
            Stmt::Match(subject, arms) => {
                let arms: Vec<String> = arms
                    .iter()
                    .map(|(values, body)| format!("{} => {}", values_of(values), self.block(body)))
                    .collect();
                format!("match {} {{ {} }}", self.nested(subject), arms.join(", "))
            }
            Stmt::Block(block) => self.block(block),
            Stmt::Break => "break;".to_owned(),
            Stmt::Continue => "continue;".to_owned(),
            Stmt::Return(value) => format!("return {};", self.nested(value)),
        }
    }

    fn range(&mut self, range: &Range) -> String {
        let dots = if range.inclusive { "..=" } else { ".." };
        let mut text = format!("{}{dots}{}", self.nested(&range.start), self.nested(&range.end));
        if range.step > 1 || range.reversed {
            text = format!("({text})");
        }
        if range.step > 1 {
            text.push_str(&format!(".step_by({})", range.step));
        }
        if range.reversed {
            text.push_str(".rev()");
        }
        text
    }

    fn place(&mut self, place: &Place) -> String {
        let mut text = name(place.var.name);
        for step in &place.path {
            text.push_str(&match step {
                Step::Lane(k) => format!(".{}", lane(*k)),
                Step::Part(k) => format!(".{k}"),
                Step::Field(k) => format!(".f{k}"),
                Step::Index(index) => format!("[{} as usize]", self.nested(index)),
            });
        }
        text
    }

    fn list(&mut self, exprs: &[Expr]) -> String {
        exprs.iter().map(|e| self.nested(e)).collect::<Vec<_>>().join(", ")
    }

    /// For use outside of a statement, where nothing is indented.
    fn expr(&self, expr: &Expr) -> String {
        Printer {
            out: String::new(),
            indent: 0,
        }
        .nested(expr)
    }

    fn nested(&mut self, e: &Expr) -> String {
        match &e.kind {
            Kind::Float(x) if x.is_sign_negative() => format!("({x:?}f32)"),
            Kind::Float(x) => format!("{x:?}f32"),
            Kind::Int(n) if *n < 0 => format!("({n}i32)"),
            Kind::Int(n) => format!("{n}i32"),
            Kind::Uint(n) => format!("{n}u32"),
            Kind::Bool(b) => b.to_string(),
            Kind::Var(var) => name(var.name),
            Kind::Const(k) => format!("C{k}"),
            Kind::Pixel => "pixel".to_owned(),
            Kind::Size => "a.size()".to_owned(),
            Kind::Load(coordinate) => format!("a.load({})", self.nested(coordinate)),
            Kind::Unary(op, x) => {
                let sign = if *op == Unary::Neg { "-" } else { "!" };
                format!("({sign}{})", self.nested(x))
            }
            // What rustc sees to overflow it refuses: between two literals the first stands in a block.
            Kind::Binary(op, x, y)
                if matches!(
                    (&x.kind, &y.kind),
                    (Kind::Int(_) | Kind::Uint(_), Kind::Int(_) | Kind::Uint(_))
                ) =>
            {
                format!("({{ {} }} {} {})", self.nested(x), operator(*op), self.nested(y))
            }
            Kind::Binary(op, x, y) => format!("({} {} {})", self.nested(x), operator(*op), self.nested(y)),
            Kind::Method(method, args) => self.method(*method, args, &e.ty),
            Kind::Swizzle(x, lanes) => {
                let lanes: String = lanes.iter().map(|k| lane(*k)).collect();
                format!("{}.{lanes}()", self.nested(x))
            }
            Kind::Lane(x, k) => format!("{}.{}", self.nested(x), lane(*k)),
            Kind::Part(x, k) if matches!(x.ty, Ty::Struct(_)) => format!("{}.f{k}", self.nested(x)),
            Kind::Part(x, k) => format!("{}.{k}", self.nested(x)),
            Kind::Index(array, index) => format!("{}[{} as usize]", self.nested(array), self.nested(index)),
            Kind::Cast(x) => format!("({} as {})", self.nested(x), ty(&e.ty)),
            Kind::Compose(parts) => format!("{}({})", ty(&e.ty).to_lowercase(), self.list(parts)),
            Kind::Splat(x) => format!("{}::splat({})", ty(&e.ty), self.nested(x)),
            Kind::Many(parts) => match &e.ty {
                Ty::Struct(k) => {
                    let fields = parts.iter().enumerate();
                    let fields: Vec<String> = fields.map(|(k, x)| format!("f{k}: {}", self.nested(x))).collect();
                    format!("(S{k} {{ {} }})", fields.join(", "))
                }
                Ty::Array(..) => format!("[{}]", self.list(parts)),
                _ => format!("({})", self.list(parts)),
            },
            Kind::Repeat(x) => {
                let Ty::Array(_, len) = &e.ty else { return String::new() };
                format!("[{}; {len}]", self.nested(x))
            }
            Kind::Call(k, args) if args.is_empty() => format!("f{k}(a, pixel)"),
            Kind::Call(k, args) => format!("f{k}(a, pixel, {})", self.list(args)),
            Kind::If(condition, then, otherwise) => format!(
                "(if {} {} else {})",
                self.nested(condition),
                self.block(then),
                self.block(otherwise)
            ),
            Kind::Match(subject, arms) => {
                let arms: Vec<String> = arms
                    .iter()
                    .map(|(values, body)| format!("{} => {}", values_of(values), self.nested(body)))
                    .collect();
                format!("(match {} {{ {} }})", self.nested(subject), arms.join(", "))
            }
            Kind::Block(block) => format!("({})", self.block(block)),
        }
    }

    fn method(&mut self, method: Method, args: &[Expr], result: &Ty) -> String {
        let name = match method {
            Method::As => format!("as_{}", ty(result).to_lowercase()),
            Method::Len => return format!("({}.len() as i32)", self.nested(&args[0])),
            other => method_name(other).to_owned(),
        };
        let receiver = self.nested(&args[0]);
        format!("{receiver}.{name}({})", self.list(&args[1..]))
    }
}

fn values_of(values: &[i32]) -> String {
    if values.is_empty() {
        return "_".to_owned();
    }
    values.iter().map(i32::to_string).collect::<Vec<_>>().join(" | ")
}

fn lane(k: u8) -> char {
    ['x', 'y', 'z', 'w'][k as usize]
}

fn operator(op: Binary) -> &'static str {
    use Binary::*;
    match op {
        Add => "+",
        Sub => "-",
        Mul => "*",
        Div => "/",
        Rem => "%",
        And => "&",
        Or => "|",
        Xor => "^",
        Shl => "<<",
        Shr => ">>",
        Eq => "==",
        Ne => "!=",
        Lt => "<",
        Le => "<=",
        Gt => ">",
        Ge => ">=",
        LazyAnd => "&&",
        LazyOr => "||",
    }
}

fn method_name(method: Method) -> &'static str {
    use Method::*;
    match method {
        Abs => "abs",
        Floor => "floor",
        Ceil => "ceil",
        Trunc => "trunc",
        RoundTiesEven => "round_ties_even",
        Sqrt => "sqrt",
        Exp2 => "exp2",
        Recip => "recip",
        Min => "min",
        Max => "max",
        Clamp => "clamp",
        Dot => "dot",
        Cross => "cross",
        LengthSquared => "length_squared",
        Length => "length",
        DistanceSquared => "distance_squared",
        Lerp => "lerp",
        Extend => "extend",
        Truncate => "truncate",
        MinElement => "min_element",
        MaxElement => "max_element",
        ElementSum => "element_sum",
        Powi => "powi",
        As | Len => "",
    }
}
