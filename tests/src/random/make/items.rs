//! Items: constants, enums, options, and which others there are.

use super::orders::Order;
use super::types::{Enumeration, Lane, Ty};
use super::{Feature, Maker, Want};

impl Maker {
    pub(super) fn items(&mut self) {
        // Kernels without the items of a feature are compiled sooner.
        for feature in [Feature::Objects, Feature::Held, Feature::Spaces] {
            if self.random.once_in(2) {
                self.features = self.features.without(feature);
            }
        }
        if [Feature::Closures, Feature::Lazy, Feature::Adaptors]
            .iter()
            .any(|of| self.on(*of))
        {
            self.line("fn same<T>(x: T) -> T { x }");
        }
        if self.on(Feature::Closures) {
            self.appliers();
        }
        if self.on(Feature::Objects) {
            self.object_items();
        }
        if self.on(Feature::Held) {
            self.held_items();
        }
        if self.on(Feature::Spaces) {
            self.space_items();
        }
        for _ in 0..self.random.below(4) {
            self.constant();
        }
        if self.chance(Feature::Enums, 2) {
            self.enumeration();
        }
        if self.chance(Feature::Choices, 2) {
            self.choice();
            self.tries = self.random.once_in(2);
            if self.tries {
                self.open("fn both(a: Option<f32>, b: Option<f32>) -> Option<f32> {");
                self.line("let a = a?;");
                self.line("Some(a * 0.5 + b?)");
                self.close("}");
                self.line("fn scaling(by: f32) -> impl Fn(f32) -> f32 { move |x| x * by }");
                self.open("fn ends(v: [f32; 3]) -> f32 {");
                self.line("let [first, .., last] = v;");
                self.line("first - last");
                self.close("}");
            }
        }
        for _ in 0..self.random.below(3) {
            self.structure();
        }
        if self.chance(Feature::Traits, 2) {
            self.traits();
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
                (Ty::Vec(Lane::I, 2), format!("ivec2({x}, {y})"), None)
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
        let order = self.chosen_order(&[]);
        let derived = match order {
            Order::None => "Clone, Copy, PartialEq, Eq".to_owned(),
            _ => format!("Clone, Copy, {}", order.derived().join(", ")),
        };
        self.line(format!("#[derive({derived})]"));
        let stated = self.discriminants(&variants);
        self.line(format!("enum {name} {{ {} }}", stated.join(", ")));
        self.enumerations.push(Enumeration { name, variants, order });
    }
}
