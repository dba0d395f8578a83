//! `match` on runtime values, with guards and bindings, and what is written in other ways: `if let`, `let ... else`,
//! `matches!`, `while let`.

use super::types::Ty;
use super::{Feature, Maker, Want};

/// A pattern, and what it binds.
struct Taken {
    pattern: String,
    bound: Vec<(String, Ty)>,
}

impl Taken {
    fn new(pattern: impl Into<String>) -> Taken {
        Taken {
            pattern: pattern.into(),
            bound: Vec::new(),
        }
    }
}

impl Maker {
    /// A runtime value, and patterns of which the last takes all that is left.
    fn runtime_subject(&mut self, depth: u32) -> (String, Vec<Taken>) {
        let want = Want {
            depth,
            known: false,
            inferred: false,
        };
        let name = self.fresh("n");
        let bound = |pattern: String, ty: Ty| Taken {
            pattern,
            bound: vec![(name.clone(), ty)],
        };
        match self.random.below(5) {
            0 => {
                let ty = self.random.pick(&[Ty::I32, Ty::U32]);
                let subject = self.expr(&ty, want);
                let low = if ty == Ty::I32 { "..-2" } else { "..2" };
                let patterns = vec![
                    Taken::new(low),
                    bound(format!("{name} @ (2 | 4..=9)"), ty.clone()),
                    Taken::new("3 | 10..20"),
                    bound(name.clone(), ty),
                ];
                (format!("({subject})"), patterns)
            }
            1 => {
                let (a, b) = (self.expr(&Ty::I32, want), self.condition(want));
                let patterns = vec![
                    Taken::new("(0 | 1, _)"),
                    bound(format!("({name}, true)"), Ty::I32),
                    Taken::new("(2..=5, false)"),
                    Taken::new("_"),
                ];
                (format!("({a}, {b})"), patterns)
            }
            2 => {
                let subject = self.float_receiver(want);
                let patterns = vec![
                    Taken::new("0.0..=0.5"),
                    bound(format!("{name} @ 1.0.."), Ty::F32),
                    bound(name.clone(), Ty::F32),
                ];
                (format!("({subject})"), patterns)
            }
            3 => {
                let ty = self.random.pick(&[Ty::I32, Ty::U32]);
                let (a, b) = (self.expr(&ty, want), self.expr(&ty, want.inferred(true)));
                let patterns = vec![
                    bound(format!("(1 | 2, {name}) | ({name}, 3)"), ty.clone()),
                    Taken {
                        pattern: format!("({name}, {name}b)"),
                        bound: vec![(name.clone(), ty.clone()), (format!("{name}b"), ty)],
                    },
                ];
                (format!("({a}, {b})"), patterns)
            }
            _ => {
                let (a, b) = (self.condition(want), self.condition(want));
                let patterns = ["[true, true]", "[false, false]", "_"].map(Taken::new);
                (format!("[{a}, {b}]"), patterns.into())
            }
        }
    }

    /// Runs something where the names of a pattern are in reach.
    fn with_names<T>(&mut self, taken: &Taken, run: impl FnOnce(&mut Maker) -> T) -> T {
        let mark = self.locals.len();
        for (name, ty) in &taken.bound {
            self.bind(name, ty, false);
        }
        let result = run(self);
        self.locals.truncate(mark);
        result
    }

    /// ` if condition`, at times; the last arm has none.
    fn guard(&mut self, taken: &Taken, last: bool) -> String {
        if last || !self.random.once_in(3) {
            return String::new();
        }
        let want = Want {
            depth: 1,
            known: false,
            inferred: false,
        };
        let condition = self.with_names(taken, |m| m.without_effects(|m| m.condition(want)));
        format!(" if {condition}")
    }

    /// `match` on a runtime value, or `matches!`.
    pub(super) fn runtime_match_expr(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        let (subject, patterns) = self.runtime_subject(d.depth);
        if *ty == Ty::Bool && self.random.once_in(2) {
            let taken = &patterns[0];
            let guard = self.guard(taken, false);
            return format!("matches!({subject}, {}{guard})", taken.pattern);
        }
        if self.random.once_in(4) {
            let taken = &patterns[0];
            let yes = self.with_names(taken, |m| m.expr(ty, d));
            let no = self.expr(ty, d);
            return format!("(if let {} = {subject} {{ {yes} }} else {{ {no} }})", taken.pattern);
        }
        let mut arms = Vec::new();
        for (k, taken) in patterns.iter().enumerate() {
            let guard = self.guard(taken, k + 1 == patterns.len());
            let value = self.with_names(taken, |m| m.expr(ty, d));
            arms.push(format!("{}{guard} => {value}", taken.pattern));
        }
        format!("(match {subject} {{ {} }})", arms.join(", "))
    }

    /// `match` on a runtime value as a statement, `if let`, or `let ... else`.
    pub(super) fn runtime_match(&mut self) {
        let (subject, patterns) = self.runtime_subject(2);
        if self.random.once_in(4) {
            return self.let_else();
        }
        if self.random.once_in(5) {
            return self.while_let();
        }
        if self.random.once_in(4) {
            let taken = &patterns[0];
            let and = match self.random.once_in(3) {
                true => self.guard(taken, false).replace(" if ", " && "),
                false => String::new(),
            };
            self.open(format!("if let {} = {subject}{and} {{", taken.pattern));
            self.dynamic += 1;
            self.with_names(taken, |m| m.body(1));
            if self.random.once_in(2) {
                self.close("} else {");
                self.indent += 1;
                self.body(1);
            }
            self.dynamic -= 1;
            return self.close("}");
        }
        if self.chance(Feature::Attributes, 3) {
            let word = self.random.pick(&["branch", "select"]);
            self.line(format!("#[cfg_attr(false, {word})]"));
        }
        self.open(format!("match {subject} {{"));
        self.dynamic += 1;
        for (k, taken) in patterns.iter().enumerate() {
            let guard = self.guard(taken, k + 1 == patterns.len());
            self.open(format!("{}{guard} => {{", taken.pattern));
            self.with_names(taken, |m| m.body(1));
            self.close("}");
        }
        self.dynamic -= 1;
        self.close("}");
    }

    /// `let ... else` of what is known, in a function that may be left.
    fn let_else(&mut self) {
        let Some(ty) = self
            .result
            .clone()
            .filter(|_| self.dynamic == 0 && self.loops.is_empty())
        else {
            return self.assign();
        };
        let want = Want {
            depth: 1,
            known: true,
            inferred: false,
        };
        let (known, name) = (self.leaf(&Ty::I32, want), self.fresh("v"));
        let other = self.expr(&Ty::U32, Want { known: false, ..want });
        let value = self.expr(
            &ty,
            Want {
                known: false,
                inferred: true,
                depth: 1,
            },
        );
        self.line(format!(
            "let (-2..=4, mut {name}): (i32, u32) = ({known}, {other}) else {{ return {value} }};"
        ));
        self.bind(&name, &Ty::U32, true);
    }

    /// A `while let` of a few iterations.
    fn while_let(&mut self) {
        if self.repeats > 8 {
            return self.assign();
        }
        let (counter, name) = (self.fresh("w"), self.fresh("n"));
        self.line(format!("let mut {counter} = 0i32;"));
        self.open(format!("while let {name} @ 0..3 = {counter} {{"));
        let (mark, loops) = (self.locals.len(), std::mem::take(&mut self.loops));
        self.bind(&name, &Ty::I32, false);
        self.repeats *= 3;
        self.body(1);
        self.repeats /= 3;
        self.loops = loops;
        self.locals.truncate(mark);
        self.line(format!("{counter} += 1;"));
        self.close("}");
    }
}
