//! Functions.

use super::types::{Param, Signature, Ty};
use super::{BUDGET, Feature, Hold, Maker, Want};

impl Maker {
    fn params(&mut self) -> Vec<Param> {
        let mut params = Vec::new();
        for k in 0..self.random.below(4) {
            let ty = self.any_type();
            let hold = match self.random.below(6) {
                0..=1 if self.on(Feature::Mutable) => Hold::Mutable,
                2 if matches!(ty, Ty::Array(..) | Ty::Struct(_)) => Hold::Shared,
                _ if !self.copies(&ty) => Hold::Shared,
                _ => Hold::Value,
            };
            let known = match ty {
                Ty::I32 | Ty::U32 | Ty::Usize if hold == Hold::Value && self.random.once_in(2) => Some((1, 4)),
                _ => None,
            };
            params.push(Param {
                name: format!("n{k}"),
                ty,
                hold,
                known,
            });
        }
        params
    }

    fn signature_text(&self, signature: &Signature) -> String {
        let mut all: Vec<String> = Vec::new();
        match signature.receiver {
            Some((_, Hold::Value)) => all.push("self".to_owned()),
            Some((_, Hold::Shared)) => all.push("&self".to_owned()),
            Some((_, Hold::Mutable)) => all.push("&mut self".to_owned()),
            None => {}
        }
        if signature.inputs {
            all.extend(self.shape.stated());
            all.push("pixel: IVec2".to_owned());
        }
        for param in &signature.params {
            let sign = match param.hold {
                Hold::Value => "",
                Hold::Shared => "&",
                Hold::Mutable => "&mut ",
            };
            all.push(format!("{}: {sign}{}", param.name, self.ty(&param.ty)));
        }
        let result = signature
            .result
            .as_ref()
            .map_or(String::new(), |ty| format!(" -> {}", self.ty(ty)));
        format!("fn {}({}){result} {{", signature.name, all.join(", "))
    }

    /// Binds parameters, and nothing else.
    pub(super) fn enter(&mut self, signature: &Signature, budget: u32) {
        self.locals.clear();
        self.cost = 0;
        self.budget = budget;
        self.inputs = signature.inputs;
        self.result.clone_from(&signature.result);
        if let Some((ty, hold)) = &signature.receiver {
            self.bind("self", &ty.clone(), false);
            self.last().hold = *hold;
        }
        for param in &signature.params {
            self.bind(&param.name, &param.ty, false);
            self.last().hold = param.hold;
            self.last().known = param.known.is_some();
            self.last().range = param.known;
        }
    }

    /// A function, or a method.
    pub(super) fn function(&mut self, receiver: Option<(Ty, Hold)>) {
        let params = self.params();
        let changes = params.iter().any(|p| p.hold == Hold::Mutable) || matches!(receiver, Some((_, Hold::Mutable)));
        let result = match self.random.below(6) {
            0 if changes => None,
            1 => Some(self.any_type()),
            _ => Some(self.plain_type()),
        };
        let mut signature = Signature {
            name: self.fresh(if receiver.is_some() { "m" } else { "f" }),
            receiver,
            inputs: self.random.once_in(3),
            params,
            result,
            known: false,
            cost: 0,
        };
        let text = self.signature_text(&signature);
        self.open(text);
        self.enter(&signature, BUDGET / 8);
        for _ in 0..self.random.below(3) {
            self.statement();
        }
        if changes {
            self.write_through();
        }
        if signature.result.is_some() && self.on(Feature::Leaving) && self.random.once_in(4) {
            self.early_return();
        }
        if let Some(ty) = &signature.result {
            let want = Want {
                depth: 2,
                known: false,
                inferred: true,
            };
            let value = self.expr(ty, want);
            self.line(value);
        }
        self.close("}");
        signature.cost = self.cost + 1;
        self.result = None;
        self.signatures.push(signature);
    }

    /// `return` under a condition.
    pub(super) fn early_return(&mut self) {
        let Some(ty) = self.result.clone() else { return };
        let condition = match self.on(Feature::RuntimeLeaving) && self.random.below(3) > 0 {
            true => {
                let want = self.wish(2);
                self.condition(want)
            }
            false => self.known_condition(),
        };
        let want = Want {
            depth: 1,
            known: false,
            inferred: true,
        };
        let value = self.expr(&ty, want);
        self.open(format!("if {condition} {{"));
        self.line(format!("return {value};"));
        self.close("}");
    }

    /// `fn three() -> u32 { 3 }`.
    pub(super) fn literal_function(&mut self) {
        let name = self.fresh("g");
        let ty = self.random.pick(&[Ty::U32, Ty::I32, Ty::Usize, Ty::array(Ty::U32, 3)]);
        let value = match &ty {
            Ty::Array(..) => "[1, 22, 333]".to_owned(),
            Ty::U32 if self.on(Feature::Inferred) && self.random.once_in(3) => "!0".to_owned(),
            ty => {
                let n = self.random.between(0, 5);
                self.int_text(ty, n, true)
            }
        };
        let value = if self.on(Feature::Inferred) {
            value
        } else {
            value.replace("[1,", "[1u32,").replace("22, 333", "22u32, 333u32")
        };
        let text = format!("fn {name}() -> {} {{ {value} }}", self.ty(&ty));
        self.line(text);
        self.signatures.push(Signature {
            name,
            receiver: None,
            inputs: false,
            params: Vec::new(),
            result: Some(ty),
            known: true,
            cost: 1,
        });
    }

    /// A function that calls itself until a known number is 0.
    pub(super) fn recursive(&mut self) {
        let ty = self.random.pick(&[Ty::I32, Ty::U32, Ty::Usize]);
        let name = self.fresh("f");
        let result = self.random.pick(&[Ty::F32, Ty::U32]);
        let (n, out) = (self.ty(&ty), self.ty(&result));
        self.open(format!("fn {name}(n0: {n}, n1: {out}) -> {out} {{"));
        self.line("if n0 == 0 {");
        self.line("    return n1;");
        self.line("}");
        let by = if result == Ty::F32 {
            "n1 * 0.5 + n0 as f32"
        } else {
            "n1 * 3 + n0 as u32"
        };
        self.line(format!("{name}(n0 - 1, {by})"));
        self.close("}");
        let param = |name: &str, ty: &Ty, known| Param {
            name: name.to_owned(),
            ty: ty.clone(),
            hold: Hold::Value,
            known,
        };
        self.signatures.push(Signature {
            name,
            receiver: None,
            inputs: false,
            params: vec![param("n0", &ty, Some((0, 4))), param("n1", &result, None)],
            result: Some(result),
            known: false,
            cost: 12,
        });
    }
}
