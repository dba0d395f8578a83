//! Generic functions.

use super::types::{Lane, Param, Signature, Ty};
use super::{Feature, Hold, Maker};

impl Maker {
    pub(super) fn generic(&mut self) {
        let name = self.fresh("h");
        let (text, params, result) = match self.random.below(5) {
            0 => (
                format!(
                    "fn {name}<const N: usize>(v: [u32; N]) -> u32 {{\n    let mut s = 0;\n    for k in 0..N {{\n        s += v[k] >> k;\n    }}\n    s\n}}"
                ),
                vec![(Ty::array(Ty::U32, 3), Hold::Value)],
                Some(Ty::U32),
            ),
            1 if self.on(Feature::Mutable) => (
                format!(
                    "fn {name}<const N: usize>(v: &mut [f32; N], by: f32) {{\n    for e in v.iter_mut() {{\n        *e = *e * 0.5 + by;\n    }}\n}}"
                ),
                vec![(Ty::array(Ty::F32, 2), Hold::Mutable), (Ty::F32, Hold::Value)],
                None,
            ),
            2 => (
                format!("fn {name}<T: std::ops::Add<Output = T> + Copy>(x: T) -> T {{\n    x + x\n}}"),
                vec![(Ty::Vec(Lane::F, 3), Hold::Value)],
                Some(Ty::Vec(Lane::F, 3)),
            ),
            3 if self.on(Feature::Mutable) => (
                format!("fn {name}<T: Copy>(x: &mut T, y: &mut T) {{\n    let t = *x;\n    *x = *y;\n    *y = t;\n}}"),
                vec![(Ty::F32, Hold::Mutable), (Ty::F32, Hold::Mutable)],
                None,
            ),
            _ => (
                format!(
                    "fn {name}<const N: usize>(v: &[f32; N]) -> f32 {{\n    let mut s = 0.0;\n    for x in v {{\n        s += x;\n    }}\n    s * N as f32\n}}"
                ),
                vec![(Ty::array(Ty::F32, 3), Hold::Shared)],
                Some(Ty::F32),
            ),
        };
        for line in text.lines() {
            self.line(line);
        }
        let params = params.into_iter().enumerate().map(|(k, (ty, hold))| Param {
            name: format!("n{k}"),
            ty,
            hold,
            known: None,
        });
        let params = params.collect();
        self.signatures.push(Signature {
            name,
            receiver: None,
            inputs: false,
            params,
            result,
            known: false,
            cost: 8,
        });
        if self.random.once_in(2) {
            let name = self.fresh("h");
            self.line(format!("fn {name}<const N: usize>(x: f32) -> f32 {{"));
            self.line("    let mut y = 1.0;");
            self.line("    for _ in 0..N {");
            self.line("        y = y * 0.5 + x;");
            self.line("    }");
            self.line("    y");
            self.line("}");
            let n = self.random.between(0, 4);
            self.signatures.push(Signature {
                name: format!("{name}::<{n}>"),
                receiver: None,
                inputs: false,
                params: vec![Param {
                    name: "x".to_owned(),
                    ty: Ty::F32,
                    hold: Hold::Value,
                    known: None,
                }],
                result: Some(Ty::F32),
                known: false,
                cost: 8,
            });
        }
    }
}
