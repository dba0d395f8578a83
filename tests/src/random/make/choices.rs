//! Options, enums that hold values, blocks and loops that give values, operators and methods of traits.

use super::orders::Order;
use super::types::{Choice, Lane, Ty};
use super::{Maker, Want};

impl Maker {
    /// An enum that holds values.
    pub(super) fn choice(&mut self) {
        let name = self.fresh("H");
        let count = self.random.between(2, 4) as usize;
        let mut variants = Vec::new();
        for k in 0..count {
            let held = match k {
                0 => Vec::new(),
                _ => (0..self.random.between(1, 2)).map(|_| self.plain_type()).collect(),
            };
            variants.push((format!("V{k}"), held, self.random.once_in(3)));
        }
        let parts: Vec<Ty> = variants.iter().flat_map(|(_, held, _)| held.clone()).collect();
        let order = self.chosen_order(&parts);
        let derived = match order {
            Order::None => "PartialEq".to_owned(),
            _ => order.derived().join(", "),
        };
        self.line(format!("#[derive(Clone, Copy, {derived})]"));
        self.open(format!("enum {name} {{"));
        for (variant, held, named) in &variants {
            let types: Vec<String> = held.iter().map(|ty| self.ty(ty)).collect();
            let text = match (held.is_empty(), named) {
                (true, _) => format!("{variant},"),
                (false, false) => format!("{variant}({}),", types.join(", ")),
                (false, true) => {
                    let fields = types.iter().enumerate().map(|(k, ty)| format!("h{k}: {ty}"));
                    format!("{variant} {{ {} }},", fields.collect::<Vec<_>>().join(", "))
                }
            };
            self.line(text);
        }
        self.close("}");
        self.choices.push(Choice { name, variants, order });
    }

    /// A variant with what it holds: values, or names of a pattern.
    fn variant(&self, choice: &Choice, k: usize, inside: &[String]) -> String {
        let (variant, held, named) = &choice.variants[k];
        let path = format!("{}::{variant}", choice.name);
        match (held.is_empty(), named) {
            (true, _) => path,
            (false, false) => format!("{path}({})", inside.join(", ")),
            (false, true) => {
                let fields = inside.iter().enumerate().map(|(k, value)| format!("h{k}: {value}"));
                format!("{path} {{ {} }}", fields.collect::<Vec<_>>().join(", "))
            }
        }
    }

    /// A value of an enum that holds values.
    pub(super) fn chosen(&mut self, k: usize, want: Want) -> String {
        let choice = self.choices[k].clone();
        let variant = self.random.below(choice.variants.len());
        let held = choice.variants[variant].1.clone();
        let inside: Vec<String> = held
            .iter()
            .map(|ty| self.expr(ty, want.deeper().inferred(true)))
            .collect();
        let text = self.variant(&choice, variant, &inside);
        if choice.variants[variant].2 && !held.is_empty() {
            format!("({text})")
        } else {
            text
        }
    }

    /// An `Option`.
    pub(super) fn option(&mut self, of: &Ty, want: Want) -> String {
        let d = want.deeper();
        let own = Ty::Option(Box::new(of.clone()));
        match self.random.below(8) {
            7 if self.tries && *of == Ty::F32 && !want.known && d.depth > 0 => {
                let [a, b] = [0, 1].map(|_| self.expr(&own, d.inferred(true)));
                format!("both({a}, {b})")
            }
            0 if want.inferred => "None".to_owned(),
            1 if !want.known => {
                let (condition, value) = (self.condition(d), self.expr(of, d.inferred(false)));
                format!("({condition}).then_some({value})")
            }
            2 if !want.known && d.depth > 0 => {
                let (value, limit) = (self.receiver(&own, d), self.condition(d));
                format!("{value}.filter(|_| {limit})")
            }
            3 if !want.known && d.depth > 0 => {
                let word = self.random.pick(&["or", "xor", "and"]);
                // The argument of `and` may be of any type.
                let (a, b) = (self.receiver(&own, d), self.expr(&own, d.inferred(word != "and")));
                format!("{a}.{word}({b})")
            }
            _ => format!("Some({})", self.expr(of, d.inferred(want.inferred))),
        }
    }

    /// Something of a type out of an `Option`, an enum, a block or a loop.
    pub(super) fn out_of_choice(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        let own = Ty::Option(Box::new(ty.clone()));
        let name = self.fresh("o");
        let with = |m: &mut Maker, ty: &Ty, run: &mut dyn FnMut(&mut Maker) -> String| {
            let mark = m.locals.len();
            m.bind(&name, ty, false);
            let text = run(m);
            m.locals.truncate(mark);
            text
        };
        match self.random.below(8) {
            0 => {
                let (value, other) = (self.receiver(&own, d), self.expr(ty, d.inferred(true)));
                format!("{value}.unwrap_or({other})")
            }
            1 => {
                let value = self.receiver(&own, d);
                let mapped = with(self, ty, &mut |m| m.without_effects(|m| m.expr(ty, d)));
                let other = self.without_effects(|m| m.expr(ty, d.inferred(true)));
                match self.random.once_in(2) {
                    true => format!("{value}.map(|{name}| {mapped}).unwrap_or({other})"),
                    false => format!("{value}.map_or_else(|| {other}, |{name}| {mapped})"),
                }
            }
            2 => {
                let value = self.expr(&own, d.inferred(false));
                let yes = with(self, ty, &mut |m| m.expr(ty, d));
                let no = self.expr(ty, d);
                format!("(if let Some({name}) = ({value}) {{ {yes} }} else {{ {no} }})")
            }
            3 => {
                let value = self.expr(&own, d.inferred(false));
                let guard = self.without_effects(|m| m.condition(d));
                let yes = with(self, ty, &mut |m| m.expr(ty, d));
                let no = self.expr(ty, d);
                format!(
                    "(match ({value}) {{ Some({name}) if {guard} => {yes}, Some({name}) => {name}, None => {no} }})"
                )
            }
            4 if !self.choices.is_empty() => {
                let k = self.random.below(self.choices.len());
                let choice = self.choices[k].clone();
                let value = self.expr(&Ty::Choice(k), d.inferred(false));
                let mut arms = Vec::new();
                for (variant, (_, held, _)) in choice.variants.iter().enumerate() {
                    let names: Vec<String> = (0..held.len()).map(|n| format!("{name}{n}")).collect();
                    let mark = self.locals.len();
                    for (name, ty) in names.iter().zip(held) {
                        self.bind(name, ty, false);
                    }
                    let value = self.expr(ty, d);
                    self.locals.truncate(mark);
                    arms.push(format!("{} => {value}", self.variant(&choice, variant, &names)));
                }
                format!("(match ({value}) {{ {} }})", arms.join(", "))
            }
            5 => {
                let label = self.fresh("'b");
                let (condition, early, late) = (self.condition(d), self.expr(ty, d), self.expr(ty, d));
                format!("({label}: {{ if {condition} {{ break {label} {early}; }} {late} }})")
            }
            6 => {
                // rustc assumes that a loop has a second iteration.
                self.repeats *= 2;
                let (condition, early, late) = (self.condition(d), self.expr(ty, d), self.expr(ty, d));
                self.repeats /= 2;
                format!("(loop {{ if {condition} {{ break {early}; }} break {late}; }})")
            }
            _ => match self.of_trait(ty, d) {
                Some(text) => text,
                None => self.leaf(ty, want),
            },
        }
    }

    /// Two values of a type that are compared as wholes.
    pub(super) fn same(&mut self, want: Want) -> String {
        let d = want.deeper();
        let ty = match self.choices.len() {
            0 => Ty::Option(Box::new(self.plain_type())),
            n => Ty::Choice(self.random.below(n)),
        };
        let (a, b) = (self.expr(&ty, d.inferred(false)), self.expr(&ty, d.inferred(true)));
        let op = self.random.pick(&["==", "!="]);
        format!("(({a}) {op} ({b}))")
    }

    /// `if let` on what may hold a value, with statements.
    pub(super) fn if_some(&mut self) {
        let of = self.plain_type();
        let want = self.wish(2);
        let value = self.expr(&Ty::Option(Box::new(of.clone())), want);
        let name = self.fresh("o");
        let mutable = self.random.once_in(3);
        let sign = if mutable { "mut " } else { "" };
        self.open(format!("if let Some({sign}{name}) = ({value}) {{"));
        self.dynamic += 1;
        let mark = self.locals.len();
        self.bind(&name, &of, mutable);
        self.body(1);
        self.locals.truncate(mark);
        if self.random.once_in(2) {
            self.close("} else {");
            self.indent += 1;
            self.body(1);
        }
        self.dynamic -= 1;
        self.close("}");
    }

    /// A trait, and what implements it: numbers, and structures by their fields; operators of structures of floats.
    pub(super) fn traits(&mut self) {
        self.line("trait Tr {");
        self.line("    const K: f32;");
        self.line("    fn tr(&self, x: f32) -> f32;");
        self.line("    fn twice(&self, x: f32) -> f32 { self.tr(self.tr(x)) * Self::K }");
        self.line("}");
        self.line("impl Tr for f32 { const K: f32 = 0.5; fn tr(&self, x: f32) -> f32 { *self - x } }");
        self.line("impl Tr for Vec2 { const K: f32 = 0.25; fn tr(&self, x: f32) -> f32 { self.x * x + self.y } }");
        self.line("fn through<T: Tr>(t: &T, x: f32) -> f32 { t.twice(x) + T::K }");
        self.line("fn dynamic(t: &impl Tr, u: &impl Tr, x: f32) -> f32 { t.tr(x) - u.twice(x) }");
        for k in 0..self.structures.len() {
            let s = self.structures[k].clone();
            let floats = s
                .fields
                .iter()
                .all(|(_, ty)| matches!(ty, Ty::F32 | Ty::Vec(Lane::F, _)));
            if !s.copy || !floats {
                continue;
            }
            let name = &s.name;
            let each = |part: &dyn Fn(&str) -> String| {
                let parts: Vec<String> = s.fields.iter().map(|(f, _)| format!("{f}: {}", part(f))).collect();
                format!("{name} {{ {} }}", parts.join(", "))
            };
            let (sum, scaled, negated) = (
                each(&|f| format!("self.{f} + o.{f}")),
                each(&|f| format!("self.{f} * o")),
                each(&|f| format!("-self.{f}")),
            );
            let own = format!("type Output = {name};");
            self.line(format!(
                "impl std::ops::Add for {name} {{ {own} fn add(self, o: Self) -> Self {{ {sum} }} }}"
            ));
            self.line(format!(
                "impl std::ops::Mul<f32> for {name} {{ {own} fn mul(self, o: f32) -> Self {{ {scaled} }} }}"
            ));
            self.line(format!(
                "impl std::ops::Mul<{name}> for f32 {{ {own} fn mul(self, o: {name}) -> {name} {{ o * self }} }}"
            ));
            self.line(format!(
                "impl std::ops::Neg for {name} {{ {own} fn neg(self) -> Self {{ {negated} }} }}"
            ));
            self.line(format!(
                "impl std::ops::AddAssign for {name} {{ fn add_assign(&mut self, o: Self) {{ *self = *self + o; }} }}"
            ));
            self.line(format!(
                "impl From<f32> for {name} {{ fn from(x: f32) -> Self {{ {} }} }}",
                {
                    let parts = s.fields.iter().map(|(f, ty)| match ty {
                        Ty::F32 => format!("{f}: x"),
                        other => format!("{f}: {}::splat(x)", self.ty(other)),
                    });
                    format!("{name} {{ {} }}", parts.collect::<Vec<_>>().join(", "))
                }
            ));
            let (first, ty) = &s.fields[0];
            let lane = if *ty == Ty::F32 { "" } else { ".x" };
            self.line(format!(
                "impl Tr for {name} {{ const K: f32 = 2.0; fn tr(&self, x: f32) -> f32 {{ self.{first}{lane} * x }} }}"
            ));
            self.structures[k].operators = true;
        }
        self.traits = true;
    }

    /// A structure by the operators of its type.
    pub(super) fn operated(&mut self, k: usize, want: Want) -> Option<String> {
        if !self.structures[k].operators || want.depth == 0 {
            return None;
        }
        let (d, ty) = (want.deeper(), Ty::Struct(k));
        Some(match self.random.below(6) {
            0 => format!("({} + {})", self.expr(&ty, d), self.expr(&ty, d)),
            1 => format!("({} * {})", self.expr(&ty, d), self.expr(&Ty::F32, d.inferred(false))),
            2 => format!("({} * {})", self.float_receiver(d), self.expr(&ty, d)),
            3 => format!("(-{})", self.receiver(&ty, d)),
            4 => {
                let value = self.expr(&Ty::F32, d);
                format!("{}::from({value})", self.structures[k].name)
            }
            _ => return None,
        })
    }

    /// A float by a method of the trait.
    fn of_trait(&mut self, ty: &Ty, d: Want) -> Option<String> {
        if !self.traits || *ty != Ty::F32 {
            return None;
        }
        let own: Vec<usize> = (0..self.structures.len())
            .filter(|k| self.structures[*k].operators)
            .collect();
        let of = match self.random.below(4) {
            0 => Ty::F32,
            1 => Ty::Vec(Lane::F, 2),
            _ if own.is_empty() => Ty::F32,
            _ => Ty::Struct(self.random.pick(&own)),
        };
        let value = match of {
            Ty::F32 => self.float_receiver(d),
            _ => self.expr(&of, d.inferred(false)),
        };
        let x = self.without_effects(|m| m.expr(&Ty::F32, d));
        Some(match self.random.below(3) {
            0 => format!("({value}).twice({x})"),
            1 => format!("through(&({value}), {x})"),
            _ => format!("dynamic(&({value}), &0.5_f32, {x})"),
        })
    }
}
