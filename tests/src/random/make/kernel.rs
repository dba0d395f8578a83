//! The kernel.

use super::types::{Lane, Signature, Ty};
use super::{BUDGET, Maker, Want};

impl Maker {
    pub(super) fn kernel(&mut self) {
        let cfg = if self.options { "cfg: &Cfg, " } else { "" };
        self.open(format!(
            "pub fn k({cfg}a: &Frame<Vec4>, b: &Buffer<f32>, p: i32, q: u32, r: f32, pixel: IVec2) -> Vec4 {{"
        ));
        let kernel = Signature {
            name: "k".to_owned(),
            receiver: None,
            inputs: true,
            params: Vec::new(),
            result: Some(Ty::Vec(Lane::F, 4)),
            known: false,
            cost: 0,
        };
        self.enter(&kernel, BUDGET);
        if self.options {
            for (field, ty) in [
                ("one", Ty::I32),
                ("two", Ty::U32),
                ("amount", Ty::F32),
                ("whether", Ty::Bool),
            ] {
                let name = self.name();
                self.line(format!("let {name} = cfg.{field};"));
                self.bind(&name, &ty, false);
                self.last().known = true;
                self.last().range = ty.integer().then_some(if field == "one" { (2, 2) } else { (3, 3) });
            }
            let name = self.name();
            self.line(format!("let {name} = cfg.gain * 2.0;"));
            self.bind(&name, &Ty::F32, false);
        }
        self.line("let mut acc = Vec4::ZERO;");
        self.bind("acc", &Ty::Vec(Lane::F, 4), true);
        for _ in 0..3 + self.random.below(6) {
            self.statement();
        }
        // Functions that nothing calls yet are called.
        for signature in self.signatures.clone() {
            let called = format!("{}(", signature.name.rsplit("::").next().unwrap_or_default());
            let called = called.replace('<', "::<");
            let begin = self.lines.iter().rposition(|l| l.starts_with("pub fn k(")).unwrap_or(0);
            if !self.lines[begin..].iter().any(|l| l.contains(&called)) {
                self.budget += 40;
                self.call_statement(&signature);
            }
        }
        self.budget += 200;
        self.repeats = 1;
        let lanes: Vec<String> = (0..4).map(|_| format!("({} + {})", self.seen(), self.seen())).collect();
        let rest = self.expr(
            &Ty::Vec(Lane::F, 4),
            Want {
                depth: 1,
                known: false,
                inferred: true,
            },
        );
        self.line(format!("acc + vec4({}) + {rest} * 0.25", lanes.join(", ")));
        self.close("}");
    }
}
