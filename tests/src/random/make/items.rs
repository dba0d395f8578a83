//! Items: constants, structures with methods, enums, functions, the kernel.

use super::types::{Enumeration, Param, Signature, Structure, Ty};
use super::{BUDGET, Feature, Hold, Maker, Want};

impl Maker {
    pub(super) fn items(&mut self) {
        for _ in 0..self.random.below(4) {
            self.constant();
        }
        if self.chance(Feature::Enums, 2) {
            self.enumeration();
        }
        for _ in 0..self.random.below(3) {
            self.structure();
        }
        for k in 0..self.structures.len() {
            self.methods(k);
        }
        if self.chance(Feature::Generics, 3) {
            self.generic();
        }
        for _ in 0..self.random.below(4) {
            match self.random.below(6) {
                0 => self.literal_function(),
                1 => self.recursive(),
                _ => self.function(None),
            }
        }
        self.options = self.chance(Feature::Options, 6);
        if self.options {
            self.line("options! {");
            self.line("    /// Choices.");
            self.line("    pub struct Cfg {");
            self.line("        /// One.");
            self.line("        pub one: i32 [0..=4] = 2,");
            self.line("        /// Two.");
            self.line("        pub two: u32 [0..=9] = 3,");
            self.line("        /// Amount.");
            self.line("        pub amount: f32 [0.0..=1.0] = 0.5,");
            self.line("        /// Gain.");
            self.line("        pub gain: f32 [0.0..=8.0] = uniform(1.5),");
            self.line("        /// Whether.");
            self.line("        pub whether: bool = true,");
            self.line("    }");
            self.line("}");
        }
    }

    fn constant(&mut self) {
        let name = self.fresh("C");
        let literals = Want {
            depth: 0,
            known: true,
            inferred: true,
        };
        let (ty, value, range) = match self.random.below(8) {
            0 => {
                let n = self.random.between(-4, 6);
                (Ty::I32, self.int_text(&Ty::I32, n, true), Some((n, n)))
            }
            1 | 2 => {
                let n = self.random.between(1, 6);
                (Ty::U32, self.int_text(&Ty::U32, n, true), Some((n, n)))
            }
            3 => {
                let n = self.random.between(1, 4);
                (Ty::Usize, self.int_text(&Ty::Usize, n, true), Some((n, n)))
            }
            4 => (Ty::F32, self.float_literal(), None),
            5 => {
                let of = self.random.pick(&[Ty::U32, Ty::I32, Ty::F32]);
                let parts: Vec<String> = (0..3)
                    .map(|_| match of {
                        Ty::F32 => self.float_literal(),
                        _ => self.int_literal(&of, true),
                    })
                    .collect();
                (Ty::array(of, 3), format!("[{}]", parts.join(", ")), None)
            }
            6 => {
                let (x, y) = (self.random.between(-2, 2), self.random.between(-2, 2));
                (Ty::Vec(super::types::Lane::I, 2), format!("ivec2({x}, {y})"), None)
            }
            _ => {
                let a = self.int_literal(&Ty::U32, literals.inferred);
                let b = self.float_literal();
                (Ty::Tuple(vec![Ty::U32, Ty::F32]), format!("({a}, {b})"), None)
            }
        };
        let text = format!("const {name}: {} = {value};", self.ty(&ty));
        self.line(text);
        self.constants.push((name, ty, range));
    }

    fn enumeration(&mut self) {
        let name = self.fresh("E");
        let variants: Vec<String> = (0..self.random.between(2, 4)).map(|k| format!("V{k}")).collect();
        self.line("#[derive(Clone, Copy, PartialEq, Eq)]");
        self.line(format!("enum {name} {{ {} }}", variants.join(", ")));
        self.enumerations.push(Enumeration { name, variants });
    }

    fn structure(&mut self) {
        let name = self.fresh("S");
        let copy = self.random.below(4) > 0;
        let tuple = self.random.once_in(4);
        let count = self.random.between(1, 3);
        let fields: Vec<(String, Ty)> = (0..count)
            .map(|k| {
                let ty = if k == 0 { self.plain_type() } else { self.part_type() };
                (if tuple { k.to_string() } else { format!("f{k}") }, ty)
            })
            .collect();
        if copy {
            self.line("#[derive(Clone, Copy)]");
        }
        if tuple {
            let fields: Vec<String> = fields.iter().map(|(_, ty)| self.ty(ty)).collect();
            self.line(format!("struct {name}({});", fields.join(", ")));
        } else {
            self.open(format!("struct {name} {{"));
            for (field, ty) in &fields {
                let text = format!("{field}: {},", self.ty(ty));
                self.line(text);
            }
            self.close("}");
        }
        self.structures.push(Structure {
            name,
            fields,
            tuple,
            copy,
        });
    }

    fn methods(&mut self, k: usize) {
        let name = self.structures[k].name.clone();
        self.locals.clear();
        self.inputs = false;
        self.open(format!("impl {name} {{"));
        if self.random.once_in(3) && self.structures[k].copy {
            let constant = self.fresh("K");
            let want = Want {
                depth: 0,
                known: true,
                inferred: true,
            };
            // Enums are not compared in constants.
            let enumerations = std::mem::take(&mut self.enumerations);
            let value = self.leaf(&Ty::Struct(k), want);
            self.enumerations = enumerations;
            self.line(format!("const {constant}: Self = {value};"));
            self.constants
                .push((format!("{name}::{constant}"), Ty::Struct(k), None));
        }
        if self.random.once_in(2) {
            let function = self.fresh("make");
            let fields = self.structures[k].fields.clone();
            let params: Vec<String> = fields
                .iter()
                .enumerate()
                .map(|(n, (_, ty))| format!("n{n}: {}", self.ty(ty)))
                .collect();
            let values: Vec<String> = (0..fields.len()).map(|n| format!("n{n}")).collect();
            let value = if self.structures[k].tuple {
                format!("{name}({})", values.join(", "))
            } else {
                let pairs: Vec<String> = fields
                    .iter()
                    .zip(&values)
                    .map(|((f, _), v)| format!("{f}: {v}"))
                    .collect();
                format!("Self {{ {} }}", pairs.join(", "))
            };
            self.line(format!("fn {function}({}) -> Self {{ {value} }}", params.join(", ")));
            let params = fields.iter().enumerate().map(|(n, (_, ty))| Param {
                name: format!("n{n}"),
                ty: ty.clone(),
                hold: Hold::Value,
                known: None,
            });
            let params = params.collect();
            self.signatures.push(Signature {
                name: format!("{name}::{function}"),
                receiver: None,
                inputs: false,
                params,
                result: Some(Ty::Struct(k)),
                known: false,
                cost: 1,
            });
        }
        for _ in 0..1 + self.random.below(2) {
            let hold = match self.random.below(5) {
                0 if self.structures[k].copy => Hold::Value,
                0 | 1 => Hold::Shared,
                _ if self.on(Feature::Mutable) => Hold::Mutable,
                _ => Hold::Shared,
            };
            self.function(Some((Ty::Struct(k), hold)));
        }
        self.close("}");
    }

    /// `fn three() -> u32 { 3 }`.
    fn literal_function(&mut self) {
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
            all.extend(
                [
                    "a: &Frame<Vec4>",
                    "b: &Buffer<f32>",
                    "p: i32",
                    "q: u32",
                    "r: f32",
                    "pixel: IVec2",
                ]
                .map(str::to_owned),
            );
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
    fn enter(&mut self, signature: &Signature, budget: u32) {
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
    fn function(&mut self, receiver: Option<(Ty, Hold)>) {
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

    /// `return` under a condition that is known.
    pub(super) fn early_return(&mut self) {
        let Some(ty) = self.result.clone() else { return };
        let condition = self.known_condition();
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

    /// A function that calls itself until a known number is 0.
    fn recursive(&mut self) {
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

    fn generic(&mut self) {
        let name = self.fresh("h");
        let (text, params, result) = match self.random.below(5) {
            0 => (
                format!(
                    "fn {name}<const N: usize>(v: [u32; N]) -> u32 {{\n    let mut s = 0;\n    for k in 0..N {{\n        s += v[k] >> k;\n    }}\n    s\n}}"
                ),
                vec![(Ty::array(Ty::U32, 3), Hold::Value)],
                Some(Ty::U32),
            ),
            1 if self.on(Feature::Mutable) => (
                format!(
                    "fn {name}<const N: usize>(v: &mut [f32; N], by: f32) {{\n    for e in v.iter_mut() {{\n        *e = *e * 0.5 + by;\n    }}\n}}"
                ),
                vec![(Ty::array(Ty::F32, 2), Hold::Mutable), (Ty::F32, Hold::Value)],
                None,
            ),
            2 => (
                format!("fn {name}<T: std::ops::Add<Output = T> + Copy>(x: T) -> T {{\n    x + x\n}}"),
                vec![(Ty::Vec(super::types::Lane::F, 3), Hold::Value)],
                Some(Ty::Vec(super::types::Lane::F, 3)),
            ),
            3 if self.on(Feature::Mutable) => (
                format!("fn {name}<T: Copy>(x: &mut T, y: &mut T) {{\n    let t = *x;\n    *x = *y;\n    *y = t;\n}}"),
                vec![(Ty::F32, Hold::Mutable), (Ty::F32, Hold::Mutable)],
                None,
            ),
            _ => (
                format!(
                    "fn {name}<const N: usize>(v: &[f32; N]) -> f32 {{\n    let mut s = 0.0;\n    for x in v {{\n        s += x;\n    }}\n    s * N as f32\n}}"
                ),
                vec![(Ty::array(Ty::F32, 3), Hold::Shared)],
                Some(Ty::F32),
            ),
        };
        for line in text.lines() {
            self.line(line);
        }
        let params = params.into_iter().enumerate().map(|(k, (ty, hold))| Param {
            name: format!("n{k}"),
            ty,
            hold,
            known: None,
        });
        let params = params.collect();
        self.signatures.push(Signature {
            name,
            receiver: None,
            inputs: false,
            params,
            result,
            known: false,
            cost: 8,
        });
        if self.random.once_in(2) {
            let name = self.fresh("h");
            self.line(format!("fn {name}<const N: usize>(x: f32) -> f32 {{"));
            self.line("    let mut y = 1.0;");
            self.line("    for _ in 0..N {");
            self.line("        y = y * 0.5 + x;");
            self.line("    }");
            self.line("    y");
            self.line("}");
            let n = self.random.between(0, 4);
            self.signatures.push(Signature {
                name: format!("{name}::<{n}>"),
                receiver: None,
                inputs: false,
                params: vec![Param {
                    name: "x".to_owned(),
                    ty: Ty::F32,
                    hold: Hold::Value,
                    known: None,
                }],
                result: Some(Ty::F32),
                known: false,
                cost: 8,
            });
        }
    }

    pub(super) fn kernel(&mut self) {
        let cfg = if self.options { "cfg: &Cfg, " } else { "" };
        self.open(format!(
            "pub fn k({cfg}a: &Frame<Vec4>, b: &Buffer<f32>, p: i32, q: u32, r: f32, pixel: IVec2) -> Vec4 {{"
        ));
        let kernel = Signature {
            name: "k".to_owned(),
            receiver: None,
            inputs: true,
            params: Vec::new(),
            result: Some(Ty::Vec(super::types::Lane::F, 4)),
            known: false,
            cost: 0,
        };
        self.enter(&kernel, BUDGET);
        if self.options {
            for (field, ty) in [
                ("one", Ty::I32),
                ("two", Ty::U32),
                ("amount", Ty::F32),
                ("whether", Ty::Bool),
            ] {
                let name = self.name();
                self.line(format!("let {name} = cfg.{field};"));
                self.bind(&name, &ty, false);
                self.last().known = true;
                self.last().range = ty.integer().then_some(if field == "one" { (2, 2) } else { (3, 3) });
            }
            let name = self.name();
            self.line(format!("let {name} = cfg.gain * 2.0;"));
            self.bind(&name, &Ty::F32, false);
        }
        self.line("let mut acc = Vec4::ZERO;");
        self.bind("acc", &Ty::Vec(super::types::Lane::F, 4), true);
        for _ in 0..3 + self.random.below(6) {
            self.statement();
        }
        // Functions that nothing calls yet are called.
        for signature in self.signatures.clone() {
            let called = format!("{}(", signature.name.rsplit("::").next().unwrap_or_default());
            let called = called.replace('<', "::<");
            let begin = self.lines.iter().rposition(|l| l.starts_with("pub fn k(")).unwrap_or(0);
            if !self.lines[begin..].iter().any(|l| l.contains(&called)) {
                self.budget += 40;
                self.call_statement(&signature);
            }
        }
        self.budget += 200;
        self.repeats = 1;
        let lanes: Vec<String> = (0..4).map(|_| format!("({} + {})", self.seen(), self.seen())).collect();
        let rest = self.expr(
            &Ty::Vec(super::types::Lane::F, 4),
            Want {
                depth: 1,
                known: false,
                inferred: true,
            },
        );
        self.line(format!("acc + vec4({}) + {rest} * 0.25", lanes.join(", ")));
        self.close("}");
    }
}
