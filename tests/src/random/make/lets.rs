//! `let` in all its ways, and constants inside functions.

use super::types::Ty;
use super::{Feature, Maker, Want};

impl Maker {
    /// `let`, of all kinds.
    pub(super) fn let_(&mut self) {
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

    pub(super) fn plain_let(&mut self) {
        let ty = self.plain_type();
        let want = self.wish(1);
        let value = self.expr(&ty, want);
        let name = self.name();
        let written = self.ty(&ty);
        self.line(format!("let mut {name}: {written} = {value};"));
        self.bind(&name, &ty, true);
    }

    /// A variable of a value.
    pub(super) fn keep(&mut self, ty: &Ty, value: &str) {
        let name = self.name();
        let (mutable, written) = (self.random.once_in(2), self.ty(ty));
        let sign = if mutable { "mut " } else { "" };
        self.line(format!("let {sign}{name}: {written} = {value};"));
        self.bind(&name, ty, mutable);
    }

    /// An expression without calls that change variables, in place of a whole that may be of any type.
    pub(super) fn some(&mut self, ty: &Ty, depth: u32) -> String {
        let want = self.wish(depth).inferred(true);
        self.without_effects(|m| m.expr(ty, want))
    }

    /// `let` with a pattern.
    pub(super) fn destructure(&mut self) {
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

    pub(super) fn constant_inside(&mut self) {
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
}

/// Returns whether the parenthesis that begins a text ends it.
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
