//! Closures, functions that take them, and the adaptors of iterators.

use super::types::Ty;
use super::{Hold, Maker, Want};

impl Maker {
    /// A closure that is called where it is, or given to a function.
    pub(super) fn closure_statement(&mut self) {
        let (of, ty) = (self.plain_type(), self.plain_type());
        let (name, x) = (self.fresh("c"), self.fresh("x"));
        let mark = self.locals.len();
        self.bind(&x, &of, false);
        let body = self.without_effects(|m| {
            let want = m.wish(2).inferred(true);
            m.expr(&ty, want)
        });
        self.locals.truncate(mark);
        let (of_text, ty_text) = (self.ty(&of), self.ty(&ty));
        let argument = self.without_effects(|m| {
            let want = m.wish(1).inferred(true);
            m.expr(&of, want)
        });
        let result = self.name();
        let moves = if self.random.once_in(4) && !self.would_move(&body) {
            "move "
        } else {
            ""
        };
        match self.random.below(4) {
            0 => {
                self.line(format!(
                    "let {name} = {moves}|{x}: {of_text}| -> {ty_text} {{ {body} }};"
                ));
                self.line(format!("let {result} = {name}({argument});"));
            }
            1 => self.line(format!(
                "let {result} = apply({moves}|{x}: {of_text}| -> {ty_text} {{ {body} }}, {argument});"
            )),
            2 => self.line(format!(
                "let {result} = apply_dyn(&|{x}: {of_text}| -> {ty_text} {{ {body} }}, {argument});"
            )),
            _ => {
                self.line(format!(
                    "let {name} = |({x}, _): ({of_text}, u32)| -> {ty_text} {{ {body} }};"
                ));
                self.line(format!("let {result} = {name}(({argument}, 1));"));
            }
        }
        self.bind(&result, &ty, false);
    }

    /// Returns whether a closure that takes the variables that it mentions by value would move some.
    fn would_move(&self, body: &str) -> bool {
        let mut words = body.split(|c: char| !c.is_alphanumeric() && c != '_');
        words.any(|word| {
            let local = self.locals.iter().rev().find(|l| l.name == word);
            local.is_some_and(|l| matches!(l.hold, Hold::Mutable) || !self.copies(&l.ty))
        })
    }

    /// A closure that changes a variable.
    pub(super) fn writing_closure(&mut self) {
        let Some(place) = self.writable(None) else {
            return self.assign();
        };
        if !self.copies(&place.ty) || place.text.contains('[') {
            return self.assign();
        }
        let (name, x) = (self.fresh("c"), self.fresh("x"));
        let written = self.ty(&place.ty);
        let value = self.without_effects(|m| {
            let want = m.wish(1).inferred(true);
            m.expr(&place.ty, want)
        });
        self.line(format!(
            "let mut {name} = |{x}: {written}| -> {written} {{ std::mem::replace(&mut {}, {x}) }};",
            place.text
        ));
        let mark = self.locals.len();
        self.freeze(&place.root, true);
        let other = self.without_effects(|m| {
            let want = m.wish(1).inferred(true);
            m.expr(&place.ty, want)
        });
        self.freeze(&place.root, false);
        self.locals.truncate(mark);
        // The argument was computed before the closure borrowed.
        let last = self.lines.pop().expect("a line was just written");
        let argument = self.fresh("v");
        self.line(format!("let {argument}: {written} = {value};"));
        self.lines.push(last);
        let result = self.fresh("v");
        if self.random.once_in(2) {
            self.line(format!("let {result} = {name}({argument});"));
        } else {
            self.line(format!("let {result} = apply_mut(&mut {name}, {argument}, {other});"));
        }
        self.bind(&result, &place.ty, false);
    }

    /// An iterator with adaptors, and what is made of it.
    pub(super) fn iterator(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        let array = Ty::array(ty.clone(), 3);
        let (x, acc) = (self.fresh("x"), self.fresh("s"));
        let text = self.ty(ty);
        let source = self.expr(&array, d.inferred(true));
        let other = self.expr(&array, d.inferred(true));
        let mark = self.locals.len();
        self.bind(&x, ty, false);
        let body = self.without_effects(|m| m.expr(ty, d.inferred(true)));
        let condition = self.without_effects(|m| m.condition(d));
        self.locals.truncate(mark);
        let adaptor = match self.random.below(8) {
            0 => ".skip(1)".to_owned(),
            1 => ".take(2)".to_owned(),
            2 => ".rev()".to_owned(),
            3 => ".step_by(2)".to_owned(),
            4 => format!(
                ".zip(same::<[{text}; 3]>({other})).map(|(l, r): ({text}, {text})| if l == r {{ l }} else {{ r }})"
            ),
            5 => format!(".chain(same::<[{text}; 3]>({other}))"),
            6 => format!(".enumerate().map(|(k, v): (usize, {text})| if k == 1 {{ v }} else {{ v + v }})"),
            _ => String::new(),
        };
        let source = format!("same::<[{text}; 3]>({source}).into_iter(){adaptor}");
        let mapped = format!(".map(|{x}: {text}| -> {text} {{ {body} }})");
        let last = match self.random.below(6) {
            0 => format!("{source}{mapped}.sum::<{text}>()"),
            1 => format!("{source}{mapped}.product::<{text}>()"),
            2 => format!(
                "if {source}.all(|{x}: {text}| {condition}) {{ same::<{text}>({body_of}) }} else {{ {leaf} }}",
                body_of = self.leaf(ty, d.inferred(true)),
                leaf = self.leaf(ty, d.inferred(true))
            ),
            3 => format!(
                "if {source}.any(|{x}: {text}| {condition}) {{ same::<{text}>({body_of}) }} else {{ {leaf} }}",
                body_of = self.leaf(ty, d.inferred(true)),
                leaf = self.leaf(ty, d.inferred(true))
            ),
            4 => format!(
                "same::<[{text}; 3]>({}).map(|{x}: {text}| -> {text} {{ {body} }})[{}]",
                self.leaf(&array, d.inferred(true)),
                self.random.below(3)
            ),
            _ => {
                let first = self.leaf(ty, d.inferred(true));
                format!(
                    "{source}.fold(same::<{text}>({first}), |{acc}: {text}, {x}: {text}| -> {text} {{ {acc} + {body} }})"
                )
            }
        };
        format!("({last})")
    }

    /// An assignment to two places.
    pub(super) fn swap_by_assignment(&mut self) {
        let ty = self.plain_type();
        let (a, b) = (self.fresh("v"), self.fresh("v"));
        let text = self.ty(&ty);
        let values: Vec<String> = (0..3)
            .map(|_| {
                let want = self.wish(1).inferred(true);
                self.expr(&ty, want)
            })
            .collect();
        self.line(format!(
            "let (mut {a}, mut {b}): ({text}, {text}) = ({}, {});",
            values[0], values[1]
        ));
        self.bind(&a, &ty, true);
        self.bind(&b, &ty, true);
        match self.random.below(3) {
            0 => self.line(format!("({a}, {b}) = ({b}, {});", values[2])),
            1 => self.line(format!("[{a}, {b}] = [{}, {a}];", values[2])),
            _ => self.line(format!("(({a}, _), {b}) = ordered(({b}, {}));", values[2])),
        }
    }

    /// Functions that take closures, which most kernels have.
    pub(super) fn appliers(&mut self) {
        self.line("fn ordered<T: Copy>((x, y): (T, T)) -> ((T, T), T) { ((y, x), x) }");
        self.line("fn apply<A, B, F: Fn(A) -> B>(f: F, x: A) -> B { f(x) }");
        self.line("fn apply_dyn<A, B>(f: &dyn Fn(A) -> B, x: A) -> B { f(x) }");
        self.line("fn apply_mut<A>(f: &mut impl FnMut(A) -> A, x: A, y: A) -> A { f(x); f(y) }");
    }
}
