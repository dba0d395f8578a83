//! The kernel.

use super::types::{Lane, Signature, Ty};
use super::{BUDGET, Maker, Want};

impl Maker {
    pub(super) fn kernel(&mut self) {
        let mut params = Vec::new();
        if self.options {
            params.push("cfg: &Cfg".to_owned());
        }
        params.extend(self.shape.stated());
        params.extend(self.memories());
        let result = self.shape.result.clone();
        let unit = result == Ty::Tuple(Vec::new());
        let mut given = self.ty(&result);
        params.push(match self.shape.group {
            Some([width, height]) => {
                given = format!("PerThread<{given}>");
                format!("group: &Workgroup<{width}, {height}>")
            }
            None => "pixel: IVec2".to_owned(),
        });
        let arrow = if unit { String::new() } else { format!(" -> {given}") };
        self.open(format!("pub fn k({}){arrow} {{", params.join(", ")));
        let kernel = Signature {
            name: "k".to_owned(),
            receiver: None,
            inputs: self.shape.group.is_none(),
            params: Vec::new(),
            // A phase of all threads has no value that an early return could give.
            result: self.shape.group.is_none().then_some(result.clone()),
            known: false,
            cost: 0,
        };
        self.enter(&kernel, BUDGET);
        self.choices_of_options();
        if self.shape.group.is_some() {
            self.phases();
            return self.close("}");
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
        if self.writes() {
            self.write();
        }
        if !unit {
            let value = self.given(&result);
            self.line(value);
        }
        self.close("}");
    }

    /// Variables for the fields of the options.
    fn choices_of_options(&mut self) {
        if !self.options {
            return;
        }
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

    /// Value of the kernel, from as many variables as there are numbers in it.
    pub(super) fn given(&mut self, ty: &Ty) -> String {
        let want = Want {
            depth: 1,
            known: false,
            inferred: true,
        };
        match ty {
            Ty::Vec(Lane::F, n) => {
                let lanes: Vec<String> = (0..*n)
                    .map(|_| format!("({} + {})", self.seen(), self.seen()))
                    .collect();
                let rest = self.expr(ty, want);
                let own = self.visible().iter().any(|l| l.name == "acc" && l.ty == *ty);
                let acc = if own { "acc + " } else { "" };
                format!("{acc}vec{n}({}) + {rest} * 0.25", lanes.join(", "))
            }
            Ty::F32 => format!("({} + {}) * 0.5", self.seen(), self.expr(ty, want)),
            Ty::I32 | Ty::U32 => {
                let whole = self.ty(ty);
                let seen = self.seen();
                // A number that no integer holds is cut to the nearest, which a driver does for some of them alone.
                let seen = format!("(({seen} + 0.0f32).max(-4096.0).min(4096.0) as i32 as {whole})");
                format!("{seen} ^ {}", self.expr(ty, want.inferred(false)))
            }
            Ty::Tuple(parts) => {
                let parts: Vec<String> = parts.iter().map(|part| self.given(part)).collect();
                format!("({})", parts.join(", "))
            }
            Ty::Struct(k) => {
                let structure = self.structures[*k].clone();
                let fields = structure.fields.iter();
                let fields: Vec<String> = fields.map(|(name, ty)| format!("{name}: {}", self.given(ty))).collect();
                format!("{} {{ {} }}", structure.name, fields.join(", "))
            }
            _ => self.expr(ty, want),
        }
    }
}
