//! Expressions of any type.

use super::types::{Lane, Ty};
use super::{Feature, Maker, Want};

impl Maker {
    /// An expression of a type. Binary operators stand in parentheses, so that texts can be made smaller.
    pub(super) fn expr(&mut self, ty: &Ty, want: Want) -> String {
        self.spend(1);
        if want.depth == 0 || self.poor() {
            return self.leaf(ty, want);
        }
        if self.random.once_in(5) {
            return self.leaf(ty, want);
        }
        if self.random.once_in(9)
            && let Some(text) = self.any_if(ty, want)
        {
            return text;
        }
        if self.random.once_in(7)
            && let Some(text) = self.indexed(ty, want)
        {
            return text;
        }
        if self.random.once_in(4)
            && let Some(text) = self.call_of(ty, want)
        {
            return text;
        }
        if !want.known && self.repeats < 8 && ty.plain() && self.chance(Feature::Closures, 30) {
            return self.iterator(ty, want);
        }
        if !want.known && self.repeats < 8 && ty.plain() && self.chance(Feature::Adaptors, 30) {
            return self.adapted(ty, want);
        }
        if !want.known && self.inputs && self.repeats < 8 && ty.plain() && self.chance(Feature::Lazy, 30) {
            return self.lazy(ty, want);
        }
        if !want.known
            && self.random.once_in(6)
            && let Some(text) = self.largest(ty, want)
        {
            return text;
        }
        if !want.known && ty.plain() && self.repeats < 20 && self.chance(Feature::Choices, 12) {
            return self.out_of_choice(ty, want);
        }
        if let Ty::Struct(k) = ty
            && !want.known
            && let Some(text) = self.operated(*k, want)
        {
            return text;
        }
        match ty {
            Ty::F32 => self.float(want),
            Ty::I32 | Ty::U32 => self.integer(ty, want),
            Ty::Usize => self.size(want),
            Ty::Bool => self.condition(want),
            Ty::Vec(lane, n) => self.vector_expr(*lane, *n, want),
            Ty::Mat(n) => self.matrix(*n, want),
            _ => self.whole(ty, want),
        }
    }

    /// A receiver of a method: rustc must know its type from itself.
    pub(super) fn receiver(&mut self, ty: &Ty, want: Want) -> String {
        let text = self.expr(ty, want.inferred(false));
        if text.starts_with('(')
            || text.chars().all(|c| c.is_alphanumeric() || c == '_') && !text.starts_with(|c: char| c.is_ascii_digit())
        {
            text
        } else {
            format!("({text})")
        }
    }

    /// Something without further expressions in it.
    pub(super) fn leaf(&mut self, ty: &Ty, want: Want) -> String {
        if self.random.below(4) > 0
            && let Some(text) = self.read(ty, want.known)
        {
            return text;
        }
        if self.random.once_in(3)
            && let Some(text) = self.constant_of(ty)
        {
            return text;
        }
        if !want.known
            && self.inputs
            && self.random.below(3) > 0
            && let Some(text) = self.input(ty)
        {
            return text;
        }
        match ty {
            Ty::F32 => self.float_literal(),
            Ty::I32 | Ty::U32 | Ty::Usize => self.int_literal(ty, want.inferred),
            Ty::Bool => {
                if want.known && self.random.once_in(2) {
                    self.known_condition()
                } else {
                    self.random.pick(&["true", "false"]).to_owned()
                }
            }
            Ty::Vec(lane, n) => self.vector_leaf(*lane, *n, want),
            Ty::Mat(n) => format!("Mat{n}::IDENTITY"),
            Ty::Enum(k) => {
                let variants = self.enumerations[*k].variants.clone();
                format!("{}::{}", self.enumerations[*k].name, self.random.pick(&variants))
            }
            _ => self.whole(ty, Want { depth: 0, ..want }),
        }
    }

    /// An expression that reads an input of the kernel.
    fn input(&mut self, ty: &Ty) -> Option<String> {
        let further = match self.random.below(6) {
            0..=1 => self.further(ty),
            2 => self.atomic_read(ty),
            3 => self.memory_read(ty),
            _ => None,
        };
        if further.is_some() {
            return further;
        }
        Some(match ty {
            Ty::F32 => match self.random.below(5) {
                0 => "r".to_owned(),
                1 => {
                    let k = self.random.below(7);
                    format!("b.load({k})")
                }
                _ => {
                    let (x, y) = (self.random.between(-1, 1), self.random.between(-1, 1));
                    let lane = self.random.pick(&["x", "y", "z", "w"]);
                    format!("a.load(pixel + ivec2({x}, {y})).{lane}")
                }
            },
            Ty::I32 => self.random.pick(&["p", "pixel.x", "pixel.y"]).to_owned(),
            Ty::U32 => self.random.pick(&["q", "a.size().x", "pixel.as_uvec2().y"]).to_owned(),
            Ty::Vec(Lane::F, 4) => "a.load(pixel)".to_owned(),
            Ty::Vec(Lane::I, 2) => "pixel".to_owned(),
            Ty::Bool => "(p > 0)".to_owned(),
            _ => return None,
        })
    }

    fn constant_of(&mut self, ty: &Ty) -> Option<String> {
        let fit = self.constants.iter().filter(|(_, t, _)| t == ty);
        let fit: Vec<String> = fit.map(|(name, ..)| name.clone()).collect();
        (!fit.is_empty()).then(|| self.random.pick(&fit))
    }

    /// A tuple, array or structure from its parts.
    pub(super) fn whole(&mut self, ty: &Ty, want: Want) -> String {
        let d = want.deeper();
        match ty {
            Ty::Tuple(parts) => {
                let parts: Vec<String> = parts.iter().map(|p| self.expr(p, d)).collect();
                format!("({})", parts.join(", "))
            }
            Ty::Array(of, len) => {
                if self.copies(of) && self.random.once_in(3) {
                    return format!("[{}; {len}]", self.expr(of, d));
                }
                // rustc knows the type of all from one.
                let typed = self.random.below(*len);
                let parts: Vec<String> = (0..*len)
                    .map(|k| self.expr(of, d.inferred(d.inferred || k != typed)))
                    .collect();
                format!("[{}]", parts.join(", "))
            }
            Ty::Struct(k) => {
                let structure = self.structures[*k].clone();
                if structure.copy
                    && !structure.tuple
                    && self.random.once_in(3)
                    && let Some(base) = self.read(ty, want.known)
                {
                    let (name, ty) = self.random.pick(&structure.fields);
                    let value = self.expr(&ty, d.inferred(true));
                    return format!("{} {{ {name}: {value}, ..{base} }}", structure.name);
                }
                let fields: Vec<String> = structure
                    .fields
                    .iter()
                    .map(|(name, ty)| {
                        let value = self.expr(ty, d.inferred(true));
                        if structure.tuple {
                            value
                        } else {
                            format!("{name}: {value}")
                        }
                    })
                    .collect();
                match structure.tuple {
                    true => format!("{}({})", structure.name, fields.join(", ")),
                    false => format!("({} {{ {} }})", structure.name, fields.join(", ")),
                }
            }
            Ty::Option(of) => self.option(of, want),
            Ty::Choice(k) => self.chosen(*k, want),
            Ty::Enum(_) => self.leaf(ty, want),
            _ => self.leaf(ty, want),
        }
    }
}
