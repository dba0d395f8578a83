//! Closures and functions in structures and arrays.

use super::Maker;
use super::types::Ty;

impl Maker {
    /// Structures that hold functions, and functions for them.
    pub(super) fn held_items(&mut self) {
        self.line("fn halved(x: f32) -> f32 { x * 0.5 }");
        self.line("fn turned(x: f32) -> f32 { 1.0 - x }");
        self.line("struct Holds<F: Fn(f32) -> f32> { f: F, by: f32 }");
        self.line("impl<F: Fn(f32) -> f32> Holds<F> {");
        self.line("    fn applied(&self, x: f32) -> f32 { (self.f)(x) + self.by }");
        self.line("}");
        self.line("#[derive(Clone, Copy)]");
        self.line("struct Curve { f: fn(f32) -> f32, by: f32 }");
        self.line("impl Curve {");
        self.line("    fn of(&self, x: f32) -> f32 { (self.f)(x) * self.by }");
        self.line("}");
        self.line("struct Lent<'a> { f: &'a dyn Fn(f32) -> f32, by: f32 }");
    }

    pub(super) fn held_statement(&mut self) {
        let (name, x) = (self.fresh("held"), self.fresh("x"));
        let mark = self.locals.len();
        self.bind(&x, &Ty::F32, false);
        let body = self.some(&Ty::F32, 2);
        self.locals.truncate(mark);
        let (argument, by) = (self.some(&Ty::F32, 1), self.some(&Ty::F32, 1));
        let want = self.wish(1);
        let condition = self.without_effects(|m| m.condition(want));
        let functions = ["halved", "turned", "f32::abs", "f32::floor"];
        let [f, g] = [0, 1].map(|_| self.random.pick(&functions));
        let value = match self.random.below(7) {
            0 => {
                self.line(format!(
                    "let {name} = Holds {{ f: |{x}: f32| -> f32 {{ {body} }}, by: {by} }};"
                ));
                format!("({name}.f)({argument}) - {name}.by")
            }
            1 => {
                self.line(format!(
                    "let {name} = Holds {{ f: |{x}: f32| -> f32 {{ {body} }}, by: {by} }};"
                ));
                format!("{name}.applied({argument})")
            }
            2 => {
                self.line(format!(
                    "let {name} = Lent {{ f: &|{x}: f32| -> f32 {{ {body} }}, by: {by} }};"
                ));
                format!("({name}.f)({argument}) - {name}.by")
            }
            3 => {
                self.line(format!("let mut {name} = Curve {{ f: {f}, by: {by} }};"));
                self.open(format!("if {condition} {{"));
                self.line(format!("{name}.f = {g};"));
                self.close("}");
                format!("{name}.of({argument})")
            }
            4 => {
                self.line(format!("let {name}: [fn(f32) -> f32; 3] = [{f}, {g}, turned];"));
                let index = self.without_effects(|m| m.index(3, false, 1));
                format!("{name}[{index}]({argument})")
            }
            5 => {
                let (c, d) = (
                    format!("Curve {{ f: {f}, by: {by} }}"),
                    format!("Curve {{ f: {g}, by: 2.0 }}"),
                );
                self.line(format!("let {name} = [{c}, {d}];"));
                let index = self.without_effects(|m| m.index(2, false, 1));
                format!("{name}[{index}].of({argument})")
            }
            _ => {
                self.line(format!(
                    "let {name}: &dyn Fn(f32) -> f32 = \
                     if {condition} {{ &|{x}: f32| -> f32 {{ {body} }} }} else {{ &{f} }};"
                ));
                format!("{name}({argument})")
            }
        };
        self.keep(&Ty::F32, &value);
    }
}
