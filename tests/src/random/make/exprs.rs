//! Expressions: floats, conditions, tuples, arrays, structures, calls.

use super::types::{Signature, Ty};
use super::{Feature, Hold, Maker, Want};

impl Maker {
    /// An expression of a type. Binary operators stand in parentheses, so that texts can be made smaller.
    pub(super) fn expr(&mut self, ty: &Ty, want: Want) -> String {
        self.spend(1);
        if want.depth == 0 || self.poor() {
            return self.leaf(ty, want);
        }
        if self.random.once_in(5) {
            return self.leaf(ty, want);
        }
        if self.random.once_in(9)
            && let Some(text) = self.any_if(ty, want)
        {
            return text;
        }
        if self.random.once_in(7)
            && let Some(text) = self.indexed(ty, want)
        {
            return text;
        }
        if self.random.once_in(4)
            && let Some(text) = self.call_of(ty, want)
        {
            return text;
        }
        match ty {
            Ty::F32 => self.float(want),
            Ty::I32 | Ty::U32 => self.integer(ty, want),
            Ty::Usize => self.size(want),
            Ty::Bool => self.condition(want),
            Ty::Vec(lane, n) => self.vector_expr(*lane, *n, want),
            Ty::Mat(n) => self.matrix(*n, want),
            _ => self.whole(ty, want),
        }
    }

    /// A receiver of a method: rustc must know its type from itself.
    pub(super) fn receiver(&mut self, ty: &Ty, want: Want) -> String {
        let text = self.expr(ty, want.inferred(false));
        if text.starts_with('(')
            || text.chars().all(|c| c.is_alphanumeric() || c == '_') && !text.starts_with(|c: char| c.is_ascii_digit())
        {
            text
        } else {
            format!("({text})")
        }
    }

    /// Something without further expressions in it.
    pub(super) fn leaf(&mut self, ty: &Ty, want: Want) -> String {
        if self.random.below(4) > 0
            && let Some(text) = self.read(ty, want.known)
        {
            return text;
        }
        if self.random.once_in(3)
            && let Some(text) = self.constant_of(ty)
        {
            return text;
        }
        if !want.known
            && self.inputs
            && self.random.below(3) > 0
            && let Some(text) = self.input(ty)
        {
            return text;
        }
        match ty {
            Ty::F32 => self.float_literal(),
            Ty::I32 | Ty::U32 | Ty::Usize => self.int_literal(ty, want.inferred),
            Ty::Bool => {
                if want.known && self.random.once_in(2) {
                    self.known_condition()
                } else {
                    self.random.pick(&["true", "false"]).to_owned()
                }
            }
            Ty::Vec(lane, n) => self.vector_leaf(*lane, *n, want),
            Ty::Mat(n) => format!("Mat{n}::IDENTITY"),
            Ty::Enum(k) => {
                let variants = self.enumerations[*k].variants.clone();
                format!("{}::{}", self.enumerations[*k].name, self.random.pick(&variants))
            }
            _ => self.whole(ty, Want { depth: 0, ..want }),
        }
    }

    /// What the kernel reads.
    fn input(&mut self, ty: &Ty) -> Option<String> {
        Some(match ty {
            Ty::F32 => match self.random.below(5) {
                0 => "r".to_owned(),
                1 => {
                    let k = self.random.below(7);
                    format!("b.load({k})")
                }
                _ => {
                    let (x, y) = (self.random.between(-1, 1), self.random.between(-1, 1));
                    let lane = self.random.pick(&["x", "y", "z", "w"]);
                    format!("a.load(pixel + ivec2({x}, {y})).{lane}")
                }
            },
            Ty::I32 => self.random.pick(&["p", "pixel.x", "pixel.y"]).to_owned(),
            Ty::U32 => self.random.pick(&["q", "a.size().x", "pixel.as_uvec2().y"]).to_owned(),
            Ty::Vec(super::types::Lane::F, 4) => "a.load(pixel)".to_owned(),
            Ty::Vec(super::types::Lane::I, 2) => "pixel".to_owned(),
            Ty::Bool => "(p > 0)".to_owned(),
            _ => return None,
        })
    }

    fn constant_of(&mut self, ty: &Ty) -> Option<String> {
        let fit = self.constants.iter().filter(|(_, t, _)| t == ty);
        let fit: Vec<String> = fit.map(|(name, ..)| name.clone()).collect();
        (!fit.is_empty()).then(|| self.random.pick(&fit))
    }

    pub(super) fn float_literal(&mut self) -> String {
        let text = match self.random.below(10) {
            0 => "0.0".to_owned(),
            1 => "1.0".to_owned(),
            2 if self.on(Feature::Coarse) => self
                .random
                .pick(&["0.1", "3.3", "1e-3", "12345.678", "0.7f32"])
                .to_owned(),
            3 => self
                .random
                .pick(&["0.5", "2.0", "4.0f32", "1_0.25", "3f32", "5."])
                .to_owned(),
            _ => format!("{:?}", self.random.between(1, 64) as f32 / 16.0),
        };
        if self.random.once_in(4) {
            format!("(-{text})")
        } else {
            text
        }
    }

    /// A float literal whose type is written, which a method can be called of.
    fn float(&mut self, want: Want) -> String {
        let d = want.deeper();
        let coarse = self.on(Feature::Coarse);
        match self.random.below(30) {
            0..=8 => {
                let op = self.random.pick(&["+", "-", "*", "+", "-"]);
                let (a, b) = (self.expr(&Ty::F32, d), self.expr(&Ty::F32, d));
                format!("({a} {op} {b})")
            }
            9..=10 if coarse => {
                let (a, b) = (self.expr(&Ty::F32, d), self.float_receiver(d));
                format!("({a} / ({b}.abs() + 0.75))")
            }
            11 => format!("(-{})", self.expr(&Ty::F32, d)),
            12 => {
                let name = self.random.pick(&["abs", "floor", "ceil", "trunc", "round_ties_even"]);
                format!("{}.{name}()", self.float_receiver(d))
            }
            13 => {
                let name = self.random.pick(&["min", "max"]);
                let (a, b) = (self.float_receiver(d), self.expr(&Ty::F32, d));
                format!("{a}.{name}({b} + 0.03125)")
            }
            14 => format!("{}.clamp(-2.0, 8.5)", self.float_receiver(d)),
            15 if coarse => {
                let name = self.random.pick(&["sqrt", "recip", "to_radians", "to_degrees"]);
                format!("({}.abs() + 0.25).{name}()", self.float_receiver(d))
            }
            16 => format!(
                "{}.clamp(-3.0, 3.0).powi({})",
                self.float_receiver(d),
                self.random.between(1, 3)
            ),
            17 => {
                let from = self.random.pick(&[Ty::I32, Ty::U32, Ty::Usize]);
                let e = self.expr(&from, d.inferred(false));
                match from {
                    Ty::Usize => format!("({e} as f32)"),
                    _ if coarse && self.random.once_in(2) => format!("({e} as f32)"),
                    _ => format!("(({e} & 0xfff) as f32)"),
                }
            }
            18 => {
                let e = self.expr(&Ty::Bool, d);
                format!("({e} as i32 as f32)")
            }
            19..=20 => {
                let ty = self.vector_type_of_floats();
                let e = self.receiver(&ty, d);
                self.vector_to_float(&e, &ty, d)
            }
            21 => {
                let (name, n) = self.random.pick(&[
                    ("saturate", 1),
                    ("fract", 1),
                    ("sign", 1),
                    ("round", 1),
                    ("mix", 3),
                    ("step", 2),
                    ("smoothstep", 9),
                    ("inverse_sqrt", 8),
                ]);
                match n {
                    8 if coarse => format!("inverse_sqrt({}.abs() + 0.5)", self.float_receiver(d)),
                    8 | 9 if !coarse => self.leaf(&Ty::F32, want),
                    9 => format!("smoothstep(-1.0, 3.0, {})", self.expr(&Ty::F32, d)),
                    _ => {
                        let args: Vec<String> = (0..n).map(|_| self.expr(&Ty::F32, d)).collect();
                        format!("{name}({})", args.join(", "))
                    }
                }
            }
            22 => {
                let e = self.float_receiver(d);
                format!("f32::from_bits(({e}.clamp(-64.0, 64.0) + 0.0).to_bits() & 0xffff_fff0)")
            }
            23 if !want.known => format!("tally(\"seen\", {})", self.expr(&Ty::F32, d)),
            24 => {
                let e = self.expr(&Ty::F32, d);
                let v = self.fresh("t");
                format!("{{ let {v} = {e}; {v} * 0.5 }}")
            }
            25 if self.random.once_in(3) => self.random.pick(&["std::f32::consts::PI", "f32::EPSILON"]).to_owned(),
            26 => {
                let index = self.index(5, want.known, 1);
                if self.inputs && !want.known {
                    format!("b.load({index})")
                } else {
                    format!("[1.0, 0.5, 2.0, -1.5, 3.0][{index}]")
                }
            }
            27 => {
                let e = self.float_receiver(d);
                let other = self.expr(&Ty::F32, d);
                format!("(if {e}.is_finite() {{ {other} }} else {{ 0.25 }})")
            }
            _ => self.leaf(&Ty::F32, want),
        }
    }

    /// A float whose type rustc knows from itself.
    pub(super) fn float_receiver(&mut self, want: Want) -> String {
        let text = self.expr(&Ty::F32, want);
        // Only a part that says its type would do, and `+ 0.0f32` says it without a change but of -0.
        format!("({text} + 0.0f32)")
    }

    pub(super) fn condition(&mut self, want: Want) -> String {
        let d = want.deeper();
        if want.known {
            return self.known_condition();
        }
        match self.random.below(14) {
            0..=2 => {
                let op = self.random.pick(&["<", "<=", ">", ">="]);
                let (a, b) = (self.float_receiver(d), self.expr(&Ty::F32, d));
                format!("({a} {op} {b})")
            }
            3..=6 => {
                let ty = self.random.pick(&[Ty::I32, Ty::U32, Ty::I32, Ty::U32, Ty::Usize]);
                let op = self.random.pick(&["<", "<=", ">", ">=", "==", "!="]);
                let (a, b) = (self.expr(&ty, d.inferred(false)), self.expr(&ty, d.inferred(true)));
                // `a < b` after a cast would be read as generic arguments.
                format!("(({a}) {op} {b})")
            }
            7..=8 => {
                let op = self.random.pick(&["&&", "||"]);
                let a = self.expr(&Ty::Bool, d);
                let b = self.with_effects(|m| m.expr(&Ty::Bool, d));
                format!("({a} {op} {b})")
            }
            9 => {
                let op = self.random.pick(&["&", "|", "^", "==", "!="]);
                let (a, b) = (self.expr(&Ty::Bool, d), self.expr(&Ty::Bool, d));
                format!("({a} {op} {b})")
            }
            10 => format!("(!{})", self.expr(&Ty::Bool, d)),
            11 => {
                let (e, name) = (self.float_receiver(d), self.random.pick(&["is_nan", "is_finite"]));
                format!("{e}.{name}()")
            }
            12 => {
                let ty = self.random.pick(&[Ty::I32, Ty::U32]);
                let e = self.expr(&ty, d.inferred(false));
                let low = self.random.between(0, 3);
                match ty {
                    Ty::I32 => format!("(-{low}..9).contains(&({e}))"),
                    Ty::U32 if self.random.once_in(3) => {
                        format!(
                            "({}_u32.is_multiple_of({}))",
                            self.random.between(0, 9),
                            self.random.between(1, 4)
                        )
                    }
                    _ => format!("({low}..9).contains(&({e} & 15))"),
                }
            }
            _ => self.leaf(&Ty::Bool, want),
        }
    }

    /// A condition that is decided when the shader is made.
    pub(super) fn known_condition(&mut self) -> String {
        let want = Want {
            depth: 1,
            known: true,
            inferred: false,
        };
        if !self.enumerations.is_empty() && self.random.once_in(4) {
            let ty = Ty::Enum(self.random.below(self.enumerations.len()));
            let (a, b) = (self.leaf(&ty, want), self.leaf(&ty, want));
            return format!("({a} {} {b})", self.random.pick(&["==", "!="]));
        }
        let ty = self.random.pick(&[Ty::I32, Ty::U32, Ty::I32, Ty::Usize]);
        let a = self.leaf(&ty, want);
        let n = self.random.between(0, 4);
        match self.random.below(4) {
            0 => format!("(({a} & 1) == {})", n & 1),
            1 => format!("(({a}) != {n})"),
            _ => format!("(({a}) {} {n})", self.random.pick(&["<", ">", "==", ">="])),
        }
    }

    /// `if` as an expression, or `match`.
    fn any_if(&mut self, ty: &Ty, want: Want) -> Option<String> {
        if !self.copies(ty) || matches!(ty, Ty::Enum(_)) && !want.known {
            return None;
        }
        let d = want.deeper();
        if self.on(Feature::Enums) && self.random.once_in(3) {
            return Some(self.match_expr(ty, want));
        }
        let condition = if want.known || self.random.once_in(4) {
            self.known_condition()
        } else {
            self.condition(Want { known: false, ..d })
        };
        let (a, b) = (self.expr(ty, d), self.expr(ty, d));
        Some(format!("(if {condition} {{ {a} }} else {{ {b} }})"))
    }

    fn match_expr(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        let (subject, patterns) = self.known_match();
        let arms: Vec<String> = patterns
            .into_iter()
            .map(|pattern| format!("{pattern} => {}", self.expr(ty, d)))
            .collect();
        format!("(match {subject} {{ {} }})", arms.join(", "))
    }

    /// A subject that is a compile-time constant, and patterns that take all of its type.
    pub(super) fn known_match(&mut self) -> (String, Vec<String>) {
        let want = Want {
            depth: 0,
            known: true,
            inferred: false,
        };
        if !self.enumerations.is_empty() && self.random.once_in(2) {
            let k = self.random.below(self.enumerations.len());
            let subject = self.leaf(&Ty::Enum(k), want);
            let e = self.enumerations[k].clone();
            let mut patterns: Vec<String> = e.variants.iter().map(|v| format!("{}::{v}", e.name)).collect();
            if self.random.once_in(3) && patterns.len() > 2 {
                let last = patterns.pop().expect("a variant");
                let before = patterns.pop().expect("a variant");
                patterns.push(format!("{before} | {last}"));
            } else if self.random.once_in(2) {
                patterns.pop();
                patterns.push("_".to_owned());
            }
            return (subject, patterns);
        }
        let ty = self.random.pick(&[Ty::I32, Ty::U32, Ty::I32, Ty::Usize]);
        let subject = self.leaf(&ty, want);
        let named: Vec<String> = self
            .constants
            .iter()
            .filter(|(_, t, _)| *t == ty)
            .map(|(name, ..)| name.clone())
            .collect();
        match self.random.below(4) {
            0 => {
                let other = self.leaf(&Ty::I32, want);
                let patterns = ["(0, 1)", "(1 | 2, 0..=3)", "(_, 2)", "_"].map(str::to_owned);
                (format!("({subject}, {other})"), patterns.to_vec())
            }
            1 if !named.is_empty() => {
                let name = self.random.pick(&named);
                (subject, vec![name, "_".to_owned()])
            }
            2 if ty == Ty::I32 => (subject, ["-3..=0", "1 | 5", "2..=4", "_"].map(str::to_owned).to_vec()),
            _ => (subject, ["0", "1 | 2", "3..=6", "_"].map(str::to_owned).to_vec()),
        }
    }

    /// A tuple, array or structure from its parts.
    fn whole(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        match ty {
            Ty::Tuple(parts) => {
                let parts: Vec<String> = parts.iter().map(|p| self.expr(p, d)).collect();
                format!("({})", parts.join(", "))
            }
            Ty::Array(of, len) => {
                if self.copies(of) && self.random.once_in(3) {
                    return format!("[{}; {len}]", self.expr(of, d));
                }
                // rustc knows the type of all from one.
                let typed = self.random.below(*len);
                let parts: Vec<String> = (0..*len)
                    .map(|k| self.expr(of, d.inferred(d.inferred || k != typed)))
                    .collect();
                format!("[{}]", parts.join(", "))
            }
            Ty::Struct(k) => {
                let structure = self.structures[*k].clone();
                if structure.copy
                    && !structure.tuple
                    && self.random.once_in(3)
                    && let Some(base) = self.read(ty, want.known)
                {
                    let (name, ty) = self.random.pick(&structure.fields);
                    let value = self.expr(&ty, d.inferred(true));
                    return format!("{} {{ {name}: {value}, ..{base} }}", structure.name);
                }
                let fields: Vec<String> = structure
                    .fields
                    .iter()
                    .map(|(name, ty)| {
                        let value = self.expr(ty, d.inferred(true));
                        if structure.tuple {
                            value
                        } else {
                            format!("{name}: {value}")
                        }
                    })
                    .collect();
                match structure.tuple {
                    true => format!("{}({})", structure.name, fields.join(", ")),
                    false => format!("({} {{ {} }})", structure.name, fields.join(", ")),
                }
            }
            Ty::Enum(_) => self.leaf(ty, want),
            _ => self.leaf(ty, want),
        }
    }

    /// Runs something that may call what changes variables.
    pub(super) fn with_effects(&mut self, run: impl FnOnce(&mut Maker) -> String) -> String {
        let before = self.effects;
        self.effects = self.on(Feature::Effects) && self.on(Feature::Mutable);
        let text = run(self);
        self.effects = before;
        text
    }

    /// A call of a function that gives a type.
    pub(super) fn call_of(&mut self, ty: &Ty, want: Want) -> Option<String> {
        let fits = |s: &Signature| {
            s.result.as_ref() == Some(ty)
                && (s.known || !want.known)
                && (!s.inputs || self.inputs)
                && (!s.changes() || self.effects)
        };
        let all: Vec<Signature> = self.signatures.iter().filter(|s| fits(s)).cloned().collect();
        let signature = (!all.is_empty()).then(|| self.random.pick(&all))?;
        self.call(&signature, want)
    }

    /// A call of a function; `None` if there is nothing to borrow for it, or it costs too much.
    pub(super) fn call(&mut self, signature: &Signature, want: Want) -> Option<String> {
        let cost = signature.cost.saturating_mul(self.repeats);
        if self.cost.saturating_add(cost) > self.budget {
            return None;
        }
        self.cost += cost;
        let mut frozen: Vec<String> = Vec::new();
        let text = self.arguments(signature, want, &mut frozen);
        for name in frozen {
            self.freeze(&name, false);
        }
        text
    }

    fn arguments(&mut self, signature: &Signature, want: Want, frozen: &mut Vec<String>) -> Option<String> {
        let d = want.deeper();
        let mut receiver = None;
        if let Some((ty, hold)) = &signature.receiver {
            receiver = Some(match hold {
                Hold::Mutable => {
                    let place = self.writable(Some(ty))?;
                    // What is called may read the rest of its receiver in its arguments: a two-phase borrow.
                    let others = signature.params.iter().any(|p| p.hold == Hold::Mutable);
                    if self.random.below(3) > 0 || others || place.text.contains('[') {
                        self.freeze(&place.root, true);
                        frozen.push(place.root.clone());
                    }
                    match place.text.starts_with('*') {
                        true => place.root,
                        false => place.text,
                    }
                }
                _ => match self.receiver_of(ty) {
                    Some(text) => {
                        let name = text.trim_start_matches(['(', '*']);
                        let end = name
                            .find(|c: char| !c.is_alphanumeric() && c != '_')
                            .unwrap_or(name.len());
                        let root = name[..end].to_owned();
                        if signature.params.iter().any(|p| p.hold == Hold::Mutable)
                            && self.visible().iter().any(|l| l.name == root)
                        {
                            self.freeze(&root, true);
                            frozen.push(root);
                        }
                        text
                    }
                    None => format!("({})", self.whole(ty, d)),
                },
            });
        }
        let mut args: Vec<Option<String>> = vec![None; signature.params.len()];
        for (k, param) in signature.params.iter().enumerate() {
            if param.hold == Hold::Mutable {
                let (text, root) = self.borrow(&param.ty)?;
                self.freeze(&root, true);
                frozen.push(root);
                args[k] = Some(text);
            }
        }
        let effects = std::mem::replace(&mut self.effects, false);
        for (k, param) in signature.params.iter().enumerate() {
            if args[k].is_some() {
                continue;
            }
            args[k] = Some(match param.known {
                Some((low, high)) => self.bounded(&param.ty, low, high),
                None => {
                    let value = self.expr(&param.ty, d.inferred(true));
                    match param.hold {
                        Hold::Shared => format!("&{value}"),
                        _ => value,
                    }
                }
            });
        }
        self.effects = effects;
        let mut all: Vec<String> = Vec::new();
        if signature.inputs {
            all.extend(["a", "b", "p", "q", "r", "pixel"].map(str::to_owned));
        }
        all.extend(args.into_iter().flatten());
        let args = all.join(", ");
        Some(match receiver {
            Some(receiver) => format!("{receiver}.{}({args})", signature.name),
            None => format!("{}({args})", signature.name),
        })
    }

    /// Something in reach to call a method of that takes it by value or by reference.
    fn receiver_of(&mut self, ty: &Ty) -> Option<String> {
        if !self.copies(ty) {
            let name = self.visible().into_iter().find(|l| l.ty == *ty).map(|l| l.name);
            return name;
        }
        self.read(ty, false)
    }

    /// A known integer between two, inclusive.
    pub(super) fn bounded(&mut self, ty: &Ty, low: i64, high: i64) -> String {
        let fit: Vec<String> = self
            .visible()
            .into_iter()
            .filter(|l| l.ty == *ty && l.known && l.hold == Hold::Value)
            .filter(|l| l.range.is_some_and(|(a, b)| a >= low && b <= high))
            .map(|l| l.name)
            .collect();
        if !fit.is_empty() && self.random.once_in(2) {
            return self.random.pick(&fit);
        }
        let n = self.random.between(low, high);
        self.int_text(ty, n, true)
    }
}
