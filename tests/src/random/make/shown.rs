//! Code that shows the values of variables in the picture.

use super::types::Ty;
use super::{Hold, Maker};

impl Maker {
    /// Adds something of what is in reach to what lives longer.
    pub(super) fn carry(&mut self) {
        let Some(place) = self.writable(Some(&Ty::F32)) else {
            return;
        };
        self.freeze(&place.root, true);
        let seen = self.seen();
        self.freeze(&place.root, false);
        self.line(format!("{} += {seen};", place.text));
    }

    /// A float that shows the value of some variable.
    pub(super) fn seen(&mut self) -> String {
        let visible = self.visible();
        if visible.is_empty() {
            return "0.5".to_owned();
        }
        // The newest are looked at most.
        let k = self.random.below(visible.len()).min(self.random.below(visible.len()));
        let local = visible[k].clone();
        let text = match local.hold {
            Hold::Value => local.name.clone(),
            _ if local.ty.plain() || matches!(local.ty, Ty::Usize | Ty::Bool) => format!("(*{})", local.name),
            _ => local.name.clone(),
        };
        self.shown(&text, &local.ty)
    }

    fn shown(&mut self, text: &str, ty: &Ty) -> String {
        match ty {
            Ty::F32 => text.to_owned(),
            Ty::I32 | Ty::U32 => match self.random.below(3) {
                0 => format!("(({text} >> 12) as f32)"),
                _ => format!("(({text} & 0xffff) as f32)"),
            },
            Ty::Usize => format!("({text} as f32)"),
            Ty::Bool => format!("({text} as u32 as f32)"),
            Ty::Vec(_, n) => {
                let lane = &"xyzw"[self.random.below(*n as usize)..][..1];
                let lane_ty = ty.lane().expect("a vector has lanes");
                self.shown(&format!("{text}.{lane}"), &lane_ty)
            }
            Ty::Mat(_) => format!("{text}.x_axis.y"),
            Ty::Array(of, len) => {
                let k = self.random.below(*len);
                self.shown(&format!("{text}[{k}]"), of)
            }
            Ty::Tuple(parts) => {
                let k = self.random.below(parts.len());
                self.shown(&format!("{text}.{k}"), &parts[k])
            }
            Ty::Struct(k) => {
                let (field, ty) = self.random.pick(&self.structures[*k].fields.clone());
                self.shown(&format!("{text}.{field}"), &ty)
            }
            Ty::Option(of) => {
                let inside = self.shown("x", of);
                format!("{text}.map_or(0.25, |x| {inside})")
            }
            Ty::Choice(k) => {
                let choice = self.choices[*k].clone();
                let mut arms = Vec::new();
                for (n, (variant, held, named)) in choice.variants.iter().enumerate() {
                    let path = format!("{}::{variant}", choice.name);
                    arms.push(match (held.first(), named) {
                        (None, _) => format!("{path} => {n}.5"),
                        (Some(ty), false) => {
                            let rest = if held.len() > 1 { ", .." } else { "" };
                            format!("{path}(x{rest}) => {}", self.shown("x", ty))
                        }
                        (Some(ty), true) => format!("{path} {{ h0: x, .. }} => {}", self.shown("x", ty)),
                    });
                }
                format!("(match {text}.clone() {{ {} }})", arms.join(", "))
            }
            Ty::Enum(k) => {
                let e = &self.enumerations[*k];
                format!("(({text} == {}::{}) as u32 as f32)", e.name, e.variants[0])
            }
        }
    }
}
