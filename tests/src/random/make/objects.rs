//! `&dyn Trait`: in variables, arrays, structures and parameters, chosen by conditions and by indices.

use super::Maker;
use super::types::{Lane, Ty};

impl Maker {
    /// A trait without constants, and types that implement it.
    pub(super) fn object_items(&mut self) {
        self.line("trait Ob {");
        self.line("    fn ob(&self, x: f32) -> f32;");
        self.line("    fn weight(&self) -> u32 { 3 }");
        self.line("    fn both(&self, x: f32) -> f32 { self.ob(x) * 0.5 + self.weight() as f32 }");
        self.line("}");
        self.line("#[derive(Clone, Copy)]");
        self.line("struct Ball { by: f32 }");
        self.line("struct Slab(Vec2, u32);");
        self.line("impl Ob for Ball { fn ob(&self, x: f32) -> f32 { self.by - x } }");
        self.line("impl Ob for Slab {");
        self.line("    fn ob(&self, x: f32) -> f32 { self.0.x * x + self.0.y }");
        self.line("    fn weight(&self) -> u32 { self.1 & 7 }");
        self.line("}");
        self.line("impl Ob for i32 { fn ob(&self, x: f32) -> f32 { x + (*self & 15) as f32 } }");
        self.line("struct Lit<'a> { ob: &'a dyn Ob, gain: f32 }");
        self.line("impl Lit<'_> { fn at(&self, x: f32) -> f32 { self.ob.both(x) * self.gain } }");
        self.line("fn by_object(ob: &dyn Ob, x: f32) -> f32 { ob.ob(x) - ob.weight() as f32 }");
        self.line("fn by_objects(all: &[&dyn Ob], x: f32) -> f32 {");
        self.line("    let mut y = x;");
        self.line("    for ob in all {");
        self.line("        y = y * 0.5 + ob.both(x);");
        self.line("    }");
        self.line("    y");
        self.line("}");
    }

    pub(super) fn object_statement(&mut self) {
        let [ball, slab, whole, ob] = ["a", "b", "w", "d"].map(|prefix| self.fresh(&format!("ob_{prefix}")));
        let (by, at) = (self.some(&Ty::F32, 1), self.some(&Ty::Vec(Lane::F, 2), 1));
        let (by, at) = (
            format!("Ball {{ by: {by} }}"),
            format!("Slab({at}, {})", self.some(&Ty::U32, 1)),
        );
        self.line(format!("let {ball} = {by};"));
        self.line(format!("let {slab} = {at};"));
        let of = self.some(&Ty::I32, 1);
        self.line(format!("let {whole}: i32 = {of};"));
        let want = self.wish(1);
        let condition = self.without_effects(|m| m.condition(want));
        let x = self.some(&Ty::F32, 1);
        let all = [format!("&{ball}"), format!("&{slab}"), format!("&{whole}")];
        let [first, second] = [0, 1].map(|_| self.random.pick(&all));
        let value = match self.random.below(8) {
            0 => {
                self.line(format!(
                    "let {ob}: &dyn Ob = if {condition} {{ {first} }} else {{ {second} }};"
                ));
                format!("{ob}.ob({x}) + {ob}.weight() as f32")
            }
            1 => {
                self.line(format!("let mut {ob}: &dyn Ob = {first};"));
                self.open(format!("if {condition} {{"));
                self.line(format!("{ob} = {second};"));
                self.close("}");
                format!("{ob}.both({x})")
            }
            2 => {
                self.line(format!("let {ob}: [&dyn Ob; 3] = [{}, {first}, {second}];", all[1]));
                let index = self.without_effects(|m| m.index(3, false, 1));
                format!("{ob}[{index}].both({x})")
            }
            3 => {
                let sum = self.fresh("ob_s");
                self.line(format!("let mut {sum}: f32 = {x};"));
                self.line(format!("let {ob}: [&dyn Ob; 2] = [{first}, {second}];"));
                self.open(format!("for ob in {ob} {{"));
                self.line(format!("{sum} = ob.ob({sum});"));
                self.close("}");
                sum
            }
            4 => format!("by_object(if {condition} {{ {first} }} else {{ {second} }}, {x})"),
            5 => format!("by_objects(&[{first}, {second}, {}], {x})", all[0]),
            6 => {
                self.line(format!(
                    "let {ob} = Lit {{ ob: if {condition} {{ {first} }} else {{ {second} }}, gain: 0.5 }};"
                ));
                format!("{ob}.at({x})")
            }
            _ => {
                let subject = self.some(&Ty::I32, 1);
                let arms = format!("0 | 1 => {first}, -5..=-1 => {second}, _ => {}", all[0]);
                self.line(format!("let {ob}: &dyn Ob = match ({subject}) {{ {arms} }};"));
                format!("by_object({ob}, {x})")
            }
        };
        self.keep(&Ty::F32, &value);
    }
}
