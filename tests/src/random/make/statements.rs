//! Statements.

use super::types::{Signature, Ty};
use super::{Feature, Hold, Maker, Want};

/// Blocks around a statement at most.
const NESTING: u32 = 4;

impl Maker {
    fn wish(&mut self, depth: u32) -> Want {
        Want {
            depth,
            known: false,
            inferred: false,
        }
    }

    /// One statement, or a few that belong together.
    pub(super) fn statement(&mut self) {
        if self.poor() {
            return self.assign();
        }
        let nested = self.nesting < NESTING;
        match self.random.below(40) {
            0..=9 => self.let_(),
            10..=15 => self.assign(),
            16..=17 if nested => self.runtime_if(),
            18 if nested => self.known_if(),
            19 if nested => self.block_statement(),
            20..=23 if nested => self.for_range(),
            24..=25 if nested => self.for_array(),
            26 if nested && self.on(Feature::While) => self.while_(),
            27..=30 if self.on(Feature::Mutable) => self.reference(),
            31..=33 => self.some_call(),
            34 if nested && self.on(Feature::Enums) => self.match_statement(),
            35 => self.destructure(),
            36 if self.on(Feature::Leaving) => self.leave(),
            37 => self.constant_inside(),
            38 => self.line("assert!(1 + 1 == 2, \"arithmetic\");"),
            _ => self.let_(),
        }
    }

    /// `let`, of all kinds.
    fn let_(&mut self) {
        if self.random.once_in(5) {
            return self.let_known();
        }
        if self.chance(Feature::Inferred, 8) {
            return self.let_inferred();
        }
        let ty = self.any_type();
        let mutable = self.random.below(3) > 0;
        let depth = 3;
        let written = self.random.once_in(3) || matches!(ty, Ty::F32 | Ty::Array(..) | Ty::Tuple(_));
        let want = Want {
            depth,
            known: false,
            inferred: written,
        };
        let value = self.with_effects(|m| m.expr(&ty, want));
        let name = self.name();
        let sign = if mutable { "mut " } else { "" };
        let attribute = value.starts_with("(if ") && whole(&value) && self.chance(Feature::Attributes, 3);
        if attribute {
            let word = self.random.pick(&["branch", "select"]);
            self.line(format!("#[cfg_attr(false, {word})]"));
        }
        let value = if attribute {
            value[1..value.len() - 1].to_owned()
        } else {
            value
        };
        let written = if written {
            format!(": {}", self.ty(&ty))
        } else {
            String::new()
        };
        self.line(format!("let {sign}{name}{written} = {value};"));
        self.bind(&name, &ty, mutable);
    }

    /// A value that is a compile-time constant.
    fn let_known(&mut self) {
        let ty = match self.random.below(8) {
            0 if !self.enumerations.is_empty() => Ty::Enum(self.random.below(self.enumerations.len())),
            1 => Ty::Bool,
            2 => Ty::array(Ty::U32, 2),
            3 => Ty::Usize,
            4..=5 => Ty::U32,
            _ => Ty::I32,
        };
        let want = Want {
            depth: 2,
            known: true,
            inferred: true,
        };
        let value = self.expr(&ty, want);
        let name = self.name();
        let written = self.ty(&ty);
        self.line(format!("let {name}: {written} = {value};"));
        self.bind(&name, &ty, false);
        self.last().known = true;
    }

    /// A literal whose type only a later use tells.
    fn let_inferred(&mut self) {
        let ty = self.random.pick(&[Ty::U32, Ty::U32, Ty::Usize, Ty::I32]);
        let name = self.fresh("i");
        let n = self.random.between(0, 7);
        let value = match self.random.below(4) {
            0 if ty == Ty::U32 => "!0".to_owned(),
            1 => format!("if pixel_or_not {{ {n} }} else {{ 2 }}").replace("pixel_or_not", &self.known_condition()),
            2 => format!("({n} + 1) * 2"),
            _ => n.to_string(),
        };
        let user = self.name();
        match self.random.below(3) {
            0 => {
                self.line(format!("let {name} = {value};"));
                let written = self.ty(&ty);
                self.line(format!("let {user}: {written} = {name};"));
                self.bind(&name, &ty, false);
                self.last().known = true;
                self.bind(&user, &ty, false);
                self.last().known = true;
            }
            1 => {
                let literals = format!("[{n}, {}, {value}]", self.random.below(30));
                let mutable = self.random.once_in(2);
                self.line(format!("let {}{user} = {literals};", if mutable { "mut " } else { "" }));
                let written = self.ty(&ty);
                self.line(format!("let {name}: {written} = {user}[1];"));
                self.bind(&name, &ty, false);
                self.last().known = true;
                self.bind(&user, &Ty::array(ty, 3), mutable);
            }
            _ => {
                self.line(format!("let mut {name} = {value};"));
                let by = self.expr(
                    &ty,
                    Want {
                        depth: 1,
                        known: false,
                        inferred: false,
                    },
                );
                if ty == Ty::Usize {
                    self.line(format!("{name} = {name} % 9 + {by} % 9;"));
                } else {
                    self.line(format!("{name} = {name} + {by};"));
                }
                self.bind(&name, &ty, true);
            }
        }
    }

    /// `place = value` or `place op= value`.
    pub(super) fn assign(&mut self) {
        let Some(place) = self.writable(None) else {
            return self.plain_let();
        };
        self.assign_to(&place.text, &place.ty, &place.root);
    }

    fn plain_let(&mut self) {
        let ty = self.plain_type();
        let want = self.wish(1);
        let value = self.expr(&ty, want);
        let name = self.name();
        let written = self.ty(&ty);
        self.line(format!("let mut {name}: {written} = {value};"));
        self.bind(&name, &ty, true);
    }

    pub(super) fn assign_to(&mut self, place: &str, ty: &Ty, root: &str) {
        let want = self.wish(if self.poor() { 1 } else { 2 }).inferred(true);
        let plain = ty.plain() || *ty == Ty::Usize;
        if plain && self.random.below(3) > 0 {
            let op = match ty {
                Ty::F32 | Ty::Vec(super::types::Lane::F, _) => self.random.pick(&["+", "-", "*"]),
                Ty::Usize => "+",
                Ty::Vec(..) => self.random.pick(&["+", "-", "*"]),
                _ => self.random.pick(&["+", "-", "*", "^", "|", "&", "<<", ">>", "/", "%"]),
            };
            if op == "<<" || op == ">>" {
                let by = self.random.between(0, 9);
                return self.line(format!("{place} {op}= {by};"));
            }
            if op == "/" || op == "%" {
                let by = self.random.between(2, 9);
                return self.line(format!("{place} {op}= {by};"));
            }
            let scalar = match ty.lane() {
                Some(lane) if self.random.once_in(3) => lane,
                _ => ty.clone(),
            };
            // An operator on vectors borrows its left side first; on numbers it is read after the right side.
            let blocked = ty.lane().is_some();
            if blocked {
                self.freeze(root, true);
            }
            let value = if blocked {
                self.expr(&scalar, want.inferred(scalar == *ty))
            } else {
                self.with_effects(|m| m.expr(&scalar, want))
            };
            if blocked {
                self.freeze(root, false);
            }
            let value = if *ty == Ty::Usize {
                format!("({value} % 9)")
            } else {
                value
            };
            return self.line(format!("{place} {op}= {value};"));
        }
        let value = self.with_effects(|m| m.expr(ty, want));
        self.line(format!("{place} = {value};"));
    }

    /// Statements in braces, whose variables end with them.
    pub(super) fn body(&mut self, statements: usize) {
        let (mark, indent) = (self.locals.len(), self.indent);
        self.nesting += 1;
        for _ in 0..statements {
            self.statement();
        }
        // What was computed inside is carried out.
        if self.random.below(3) > 0 && self.locals.len() > mark {
            self.carry();
        }
        self.nesting -= 1;
        debug_assert_eq!(indent, self.indent);
        self.locals.truncate(mark);
    }

    /// Adds something of what is in reach to what lives longer.
    fn carry(&mut self) {
        let Some(place) = self.writable(Some(&Ty::F32)) else {
            return;
        };
        self.freeze(&place.root, true);
        let seen = self.seen();
        self.freeze(&place.root, false);
        self.line(format!("{} += {seen};", place.text));
    }

    fn runtime_if(&mut self) {
        let want = self.wish(2);
        let condition = self.with_effects(|m| m.condition(want));
        if self.chance(Feature::Attributes, 3) {
            let word = self.random.pick(&["branch", "select"]);
            self.line(format!("#[cfg_attr(false, {word})]"));
        }
        self.open(format!("if {condition} {{"));
        self.dynamic += 1;
        let count = 1 + self.random.below(2);
        self.body(count);
        if self.random.once_in(4) {
            let condition = self.condition(want);
            self.close(&format!("}} else if {condition} {{"));
            self.indent += 1;
            self.body(1);
        }
        if self.random.once_in(2) {
            self.close("} else {");
            self.indent += 1;
            let count = 1 + self.random.below(2);
            self.body(count);
        }
        self.dynamic -= 1;
        self.close("}");
    }

    fn known_if(&mut self) {
        let condition = self.known_condition();
        self.open(format!("if {condition} {{"));
        self.body(1);
        if self.random.once_in(2) {
            self.close("} else {");
            self.indent += 1;
            self.body(1);
        }
        self.close("}");
    }

    fn block_statement(&mut self) {
        self.open("{");
        self.body(2);
        self.close("}");
    }

    fn match_statement(&mut self) {
        let (subject, patterns) = self.known_match();
        self.open(format!("match {subject} {{"));
        for pattern in patterns {
            self.open(format!("{pattern} => {{"));
            self.body(1);
            self.close("}");
        }
        self.close("}");
    }

    /// `break`, `continue` or `return` under a condition that is known.
    fn leave(&mut self) {
        let free: Vec<Option<String>> = self
            .loops
            .iter()
            .enumerate()
            .filter(|(k, l)| l.dynamic == self.dynamic && (l.label.is_some() || *k + 1 == self.loops.len()))
            .map(|(_, l)| l.label.clone())
            .collect();
        if free.is_empty() {
            if self.dynamic == 0 && self.loops.is_empty() && self.result.is_some() && self.random.once_in(3) {
                self.early_return();
            }
            return;
        }
        let label = self.random.pick(&free).map_or(String::new(), |l| format!(" {l}"));
        let condition = self.known_condition();
        let word = self.random.pick(&["break", "continue"]);
        self.open(format!("if {condition} {{"));
        self.line(format!("{word}{label};"));
        self.close("}");
    }

    fn constant_inside(&mut self) {
        let name = self.fresh("D");
        let n = self.random.between(1, 4);
        let ty = self.random.pick(&[Ty::U32, Ty::I32, Ty::Usize]);
        let (written, value) = (self.ty(&ty), self.int_text(&ty, n, true));
        self.line(format!("const {name}: {written} = {value};"));
        self.bind(&name, &ty, false);
        self.last().known = true;
        self.last().range = Some((n, n));
        self.last().counter = true;
    }

    /// `let` with a pattern.
    fn destructure(&mut self) {
        let want = self.wish(2).inferred(true);
        match self.random.below(4) {
            0 => {
                let ty = Ty::array(self.plain_type(), 2);
                let value = self.expr(&ty, want);
                let (x, y) = (self.fresh("v"), self.fresh("v"));
                let written = self.ty(&ty);
                self.line(format!("let [{x}, mut {y}]: {written} = {value};"));
                let Ty::Array(of, _) = ty else { return };
                self.bind(&x, &of, false);
                self.bind(&y, &of, true);
            }
            1 if !self.structures.is_empty() => {
                let k = self.random.below(self.structures.len());
                let structure = self.structures[k].clone();
                if structure.tuple {
                    return self.let_();
                }
                let value = self.expr(&Ty::Struct(k), want);
                let (field, ty) = self.random.pick(&structure.fields);
                let name = self.fresh("v");
                self.line(format!(
                    "let {} {{ {field}: mut {name}, .. }} = {value};",
                    structure.name
                ));
                self.bind(&name, &ty, true);
            }
            2 => {
                let ty = Ty::Tuple(vec![Ty::Tuple(vec![Ty::F32, Ty::U32]), Ty::I32]);
                let value = self.expr(&ty, want);
                let (x, y) = (self.fresh("v"), self.fresh("v"));
                let written = self.ty(&ty);
                self.line(format!("let ((mut {x}, {y}), _): {written} = {value};"));
                self.bind(&x, &Ty::F32, true);
                self.bind(&y, &Ty::U32, false);
            }
            _ => {
                let parts = vec![self.part_type(), self.part_type()];
                let ty = Ty::Tuple(parts.clone());
                let value = self.expr(&ty, want);
                let (x, y) = (self.fresh("v"), self.fresh("v"));
                let written = self.ty(&ty);
                self.line(format!("let (mut {x}, {y}): {written} = {value};"));
                self.bind(&x, &parts[0], true);
                self.bind(&y, &parts[1], false);
            }
        }
    }

    fn some_call(&mut self) {
        if self.signatures.is_empty() {
            return self.assign();
        }
        let signature = self.random.pick(&self.signatures.clone());
        self.call_statement(&signature);
    }

    /// A call as a statement, its result kept if there is one.
    pub(super) fn call_statement(&mut self, signature: &Signature) {
        if signature.inputs && !self.inputs {
            return;
        }
        let want = self.wish(2);
        // There is something to borrow for it.
        let mut needed: Vec<Ty> = Vec::new();
        if let Some((ty, Hold::Mutable)) = &signature.receiver {
            needed.push(ty.clone());
        }
        needed.extend(
            signature
                .params
                .iter()
                .filter(|p| p.hold == Hold::Mutable)
                .map(|p| p.ty.clone()),
        );
        for ty in needed {
            if self.random.once_in(2) || self.writable(Some(&ty)).is_none() {
                let value = self.expr(&ty, want.inferred(true));
                let name = self.fresh("v");
                let written = self.ty(&ty);
                self.line(format!("let mut {name}: {written} = {value};"));
                self.bind(&name, &ty, true);
            }
        }
        let Some(call) = self.call(signature, want) else {
            return;
        };
        match &signature.result {
            Some(ty) if self.random.below(6) > 0 => {
                let name = self.name();
                let mutable = self.random.once_in(2);
                self.line(format!("let {}{name} = {call};", if mutable { "mut " } else { "" }));
                self.bind(&name, ty, mutable);
            }
            Some(_) => self.line(format!("let _ = {call};")),
            None => self.line(format!("{call};")),
        }
    }

    /// A float that shows the value of some variable.
    pub(super) fn seen(&mut self) -> String {
        let visible = self.visible();
        if visible.is_empty() {
            return "0.5".to_owned();
        }
        // The newest are looked at most.
        let k = self.random.below(visible.len()).min(self.random.below(visible.len()));
        let local = visible[k].clone();
        let text = match local.hold {
            Hold::Value => local.name.clone(),
            _ if local.ty.plain() || matches!(local.ty, Ty::Usize | Ty::Bool) => format!("(*{})", local.name),
            _ => local.name.clone(),
        };
        self.shown(&text, &local.ty)
    }

    fn shown(&mut self, text: &str, ty: &Ty) -> String {
        match ty {
            Ty::F32 => text.to_owned(),
            Ty::I32 | Ty::U32 => match self.random.below(3) {
                0 => format!("(({text} >> 12) as f32)"),
                _ => format!("(({text} & 0xffff) as f32)"),
            },
            Ty::Usize => format!("({text} as f32)"),
            Ty::Bool => format!("({text} as u32 as f32)"),
            Ty::Vec(_, n) => {
                let lane = &"xyzw"[self.random.below(*n as usize)..][..1];
                let lane_ty = ty.lane().expect("a vector has lanes");
                self.shown(&format!("{text}.{lane}"), &lane_ty)
            }
            Ty::Mat(_) => format!("{text}.x_axis.y"),
            Ty::Array(of, len) => {
                let k = self.random.below(*len);
                self.shown(&format!("{text}[{k}]"), of)
            }
            Ty::Tuple(parts) => {
                let k = self.random.below(parts.len());
                self.shown(&format!("{text}.{k}"), &parts[k])
            }
            Ty::Struct(k) => {
                let (field, ty) = self.random.pick(&self.structures[*k].fields.clone());
                self.shown(&format!("{text}.{field}"), &ty)
            }
            Ty::Enum(k) => {
                let e = &self.enumerations[*k];
                format!("(({text} == {}::{}) as u32 as f32)", e.name, e.variants[0])
            }
        }
    }
}

/// Whether the parenthesis that begins a text ends it.
fn whole(text: &str) -> bool {
    let mut depth = 0;
    for (k, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return k + 1 == text.len();
        }
    }
    false
}
