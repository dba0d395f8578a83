//! Iterators over ranges with runtime bounds.

use super::types::Ty;
use super::{Maker, Want};

/// Most values of such a range.
const VALUES: u32 = 4;

impl Maker {
    /// A range with runtime bounds, of at most four values, and the type of its values.
    pub(super) fn runtime_range(&mut self) -> (Ty, String) {
        let of = |ty, text: &str| (ty, text.to_owned());
        match self.random.below(8) {
            0 => of(Ty::I32, "(0..p.clamp(0, 4))"),
            1 => of(Ty::I32, "(-1..=(p & 3))"),
            2 => of(Ty::U32, "(0..(q & 3))"),
            3 => of(Ty::U32, "(1..=(q >> 30))"),
            4 => of(Ty::Usize, "(0..(q % 4) as usize)"),
            5 => of(Ty::I32, "((p & 3)..3)"),
            6 => of(Ty::I32, "(-2..=2 - (p & 7))"),
            _ => of(Ty::I32, "(pixel.x..pixel.x + 3)"),
        }
    }

    /// Adaptors that choose and turn a range's values.
    pub(super) fn choosing(&mut self, range: &str) -> String {
        let rev = self.random.once_in(4);
        let mut text = if rev { ".rev()" } else { "" }.to_owned();
        // rustc knows no length of a range that ends in `..=`, so that `rev` comes first.
        let all = if range.contains("..=") { 5 } else { 6 };
        for _ in 0..self.random.below(3) {
            text += self
                .random
                .pick(&[".skip(1)", ".take(2)", ".step_by(2)", ".take(3)", ".skip(2)", ".rev()"][..all]);
        }
        text
    }

    /// A number or vector of an iterator over a range with runtime bounds.
    pub(super) fn lazy(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        let repeats = self.repeats;
        self.repeats *= VALUES;
        let (of, range) = self.runtime_range();
        let choosing = self.choosing(&range);
        let range = format!("{range}{choosing}");
        let (x, s) = (self.fresh("x"), self.fresh("s"));
        let (of_text, text) = (self.ty(&of), self.ty(ty));
        let mark = self.locals.len();
        self.bind(&x, &of, false);
        let condition = self.without_effects(|m| m.condition(d));
        let own = self.random.below(3);
        let mut body = self.without_effects(|m| m.expr(ty, d.inferred(true)));
        // The body has the value in it.
        if own > 0 {
            body = match ty {
                Ty::F32 => format!("({body} + {x} as f32 * 0.5)"),
                Ty::I32 | Ty::U32 => format!("(({body}) ^ ({x} as {text}))"),
                _ => format!(
                    "({text}::splat({x} as {}) - {body})",
                    self.ty(&ty.lane().unwrap_or(Ty::F32))
                ),
            };
        }
        self.locals.truncate(mark);
        let first = self.leaf(ty, d.inferred(true));
        let map = format!(".map(|{x}: {of_text}| -> {text} {{ {body} }})");
        let mapped = match self.random.below(6) {
            0 => format!("{range}.filter(|&{x}: &{of_text}| {condition}){map}"),
            1 => {
                format!("{range}.filter_map(|{x}: {of_text}| -> Option<{text}> {{ ({condition}).then_some({body}) }})")
            }
            2 => format!(
                "{range}.enumerate().map(|({s}, {x}): (usize, {of_text})| -> {text} {{ if {s} == 1 {{ {body} }} else {{ {first} }} }})"
            ),
            3 => {
                let (other, with) = self.runtime_range();
                let with = match self.random.below(3) {
                    0 => ("[7i32, -2, 5]".to_owned(), "i32".to_owned()),
                    1 => ("(2..6u32)".to_owned(), "u32".to_owned()),
                    _ => (with, self.ty(&other)),
                };
                format!(
                    "{range}.zip({}).map(|({x}, {s}): ({of_text}, {})| -> {text} {{ if {s} == 3 {{ {first} }} else {{ {body} }} }})",
                    with.0, with.1
                )
            }
            _ => format!("{range}{map}"),
        };
        let integer = matches!(ty, Ty::I32 | Ty::U32);
        let found = match self.random.below(10) {
            0 => format!("{mapped}.product::<{text}>()"),
            1 => format!("{mapped}.last().unwrap_or({first})"),
            2 => format!("{mapped}.nth(1).unwrap_or({first})"),
            3 if integer => format!("{mapped}.{}().unwrap_or({first})", self.random.pick(&["min", "max"])),
            4 => format!("{mapped}.reduce(|{s}: {text}, {x}: {text}| {s} - {x}).unwrap_or({first})"),
            5 => {
                let name = self.random.pick(&["any", "all"]);
                let test = format!("{range}.{name}(|{x}: {of_text}| {condition})");
                format!(
                    "if {test} {{ same::<{text}>({first}) }} else {{ same::<{text}>({}) }}",
                    self.leaf(ty, d.inferred(true))
                )
            }
            6 if integer => match self.random.below(3) {
                0 => format!("{range}.filter(|&{x}: &{of_text}| {condition}).count() as {text}"),
                1 => format!("{range}.position(|{x}: {of_text}| {condition}).map_or(-1, |n| n as i32) as {text}"),
                _ => format!("{range}.find(|&{x}: &{of_text}| {condition}).map_or({first}, |n| n as {text})"),
            },
            7 | 8 => {
                format!("{mapped}.fold(same::<{text}>({first}), |{s}: {text}, {x}: {text}| -> {text} {{ {s} - {x} }})")
            }
            _ => format!("{mapped}.sum::<{text}>()"),
        };
        self.repeats = repeats;
        format!("({found})")
    }

    /// What a `for` over a range with runtime bounds runs over: the names that it binds, with their types.
    pub(super) fn lazy_head(&mut self) -> (String, Vec<(String, Ty)>) {
        let (of, range) = self.runtime_range();
        let choosing = self.choosing(&range);
        let range = format!("{range}{choosing}");
        let name = self.fresh("k");
        let one = vec![(name.clone(), of.clone())];
        match self.random.below(5) {
            0 => (format!("for {name} in {range}.filter(|{name}| {name} % 3 != 1)"), one),
            1 => (format!("for {name} in {range}.map(|{name}| {name} * 2 + 1)"), one),
            2 => {
                let n = self.fresh("k");
                (
                    format!("for ({n}, {name}) in {range}.enumerate()"),
                    vec![(n, Ty::Usize), (name, of)],
                )
            }
            3 => {
                let n = self.fresh("k");
                let (with, other) = self.runtime_range();
                (
                    format!("for ({n}, {name}) in {other}.zip({range})"),
                    vec![(n, with), (name, of)],
                )
            }
            _ => (format!("for {name} in {range}"), one),
        }
    }
}
