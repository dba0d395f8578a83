//! Generics over constants, and associated types.

use super::Maker;
use super::types::Ty;

impl Maker {
    /// A generic structure, generic functions, and a trait with an associated type.
    pub(super) fn space_items(&mut self) {
        self.line("#[derive(Clone, Copy)]");
        self.line("struct Ring<const N: usize> { at: [f32; N], used: u32 }");
        self.line("impl<const N: usize> Ring<N> {");
        self.line("    fn new(x: f32) -> Self { Ring { at: std::array::from_fn(|k| x * k as f32), used: N as u32 } }");
        self.line("    fn put(&mut self, k: usize, x: f32) { self.at[k % N] = x; self.used += 1; }");
        self.line("    fn sum(&self) -> f32 { let mut s = 0.0; for x in &self.at { s = s * 0.5 + x; } s }");
        self.line("}");
        self.line("fn steps<const N: usize>(x: f32) -> [f32; N] { std::array::from_fn(|k| x - k as f32) }");
        self.line("fn filled<T: Copy, const N: usize>(x: T) -> [T; N] { [x; N] }");
        self.line("struct Wide<T = f32> { v: T }");
        self.line("fn wide(w: Wide) -> f32 { w.v * 0.5 }");
        self.line("fn into_f32(x: impl Into<f32>) -> f32 { x.into() }");
        self.line("trait Space { const W: f32; fn to(x: f32) -> f32; }");
        self.line("struct Near;");
        self.line("struct Far;");
        self.line("impl Space for Near { const W: f32 = 0.5; fn to(x: f32) -> f32 { x + 1.0 } }");
        self.line("impl Space for Far { const W: f32 = 2.0; fn to(x: f32) -> f32 { 3.0 - x } }");
        self.line("trait Path { type Space: Space; fn at(&self, x: f32) -> f32; }");
        self.line("struct Line { by: f32 }");
        self.line("struct Bent<S> { by: f32, _of: S }");
        self.line("impl Path for Line { type Space = Near; fn at(&self, x: f32) -> f32 { x * self.by } }");
        self.line(
            "impl<S: Space> Path for Bent<S> { type Space = S; fn at(&self, x: f32) -> f32 { S::to(x) - self.by } }",
        );
        self.line("fn along<P: Path>(p: &P, x: f32) -> f32 { P::Space::to(p.at(x)) * P::Space::W }");
    }

    pub(super) fn space_statement(&mut self) {
        let (x, name) = (self.some(&Ty::F32, 1), self.fresh("gen"));
        let n = self.random.between(1, 4);
        let value = match self.random.below(9) {
            0 => {
                let index = self.without_effects(|m| m.index(4, false, 1));
                let put = self.some(&Ty::F32, 1);
                self.line(format!("let mut {name} = Ring::<{n}>::new({x});"));
                self.line(format!("{name}.put({index}, {put});"));
                format!("{name}.sum() + {name}.used as f32")
            }
            1 => {
                self.line(format!("let {name}: Ring<{n}> = Ring::new({x});"));
                format!("{name}.sum() * {name}.at.len() as f32")
            }
            2 => {
                self.line(format!("let {name}: [f32; 3] = steps({x});"));
                format!("{name}[2] - {name}[1] * 0.5")
            }
            3 => format!("steps::<{n}>({x})[{}]", self.random.below(n as usize)),
            4 => format!("filled::<_, {n}>({x}).iter().sum::<f32>()"),
            5 => format!("wide(Wide {{ v: {x} }}) + into_f32(Wide {{ v: 3_u8 }}.v)"),
            6 => format!("along(&Line {{ by: {x} }}, 0.75)"),
            7 => format!("along(&Bent {{ by: {x}, _of: Near }}, 0.5)"),
            _ => format!("along(&Bent {{ by: {x}, _of: Far }}, 0.25)"),
        };
        self.keep(&Ty::F32, &value);
    }
}
