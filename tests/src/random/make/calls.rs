//! Calls of functions and methods, and what their arguments borrow.

use super::types::{Signature, Ty};
use super::{Feature, Hold, Maker, Want};

impl Maker {
    /// Runs something that may call what changes variables.
    pub(super) fn with_effects(&mut self, run: impl FnOnce(&mut Maker) -> String) -> String {
        let before = self.effects;
        self.effects = self.on(Feature::Effects) && self.on(Feature::Mutable);
        let text = run(self);
        self.effects = before;
        text
    }

    /// Runs something that may not call what changes variables.
    pub(super) fn without_effects(&mut self, run: impl FnOnce(&mut Maker) -> String) -> String {
        let before = std::mem::replace(&mut self.effects, false);
        let text = run(self);
        self.effects = before;
        text
    }

    /// A call of a function that gives a type.
    pub(super) fn call_of(&mut self, ty: &Ty, want: Want) -> Option<String> {
        let fits = |s: &Signature| {
            s.result.as_ref() == Some(ty)
                && (s.known || !want.known)
                && (!s.inputs || self.inputs)
                && (!s.changes() || self.effects)
        };
        let all: Vec<Signature> = self.signatures.iter().filter(|s| fits(s)).cloned().collect();
        let signature = (!all.is_empty()).then(|| self.random.pick(&all))?;
        self.call(&signature, want)
    }

    /// A call of a function; `None` if there is nothing to borrow for it, or it costs too much.
    fn call(&mut self, signature: &Signature, want: Want) -> Option<String> {
        let cost = signature.cost.saturating_mul(self.repeats);
        if self.cost.saturating_add(cost) > self.budget {
            return None;
        }
        self.cost += cost;
        let mut frozen: Vec<String> = Vec::new();
        let text = self.arguments(signature, want, &mut frozen);
        for name in frozen {
            self.freeze(&name, false);
        }
        text
    }

    fn arguments(&mut self, signature: &Signature, want: Want, frozen: &mut Vec<String>) -> Option<String> {
        let d = want.deeper();
        let mut receiver = None;
        if let Some((ty, hold)) = &signature.receiver {
            receiver = Some(match hold {
                Hold::Mutable => {
                    let place = self.writable(Some(ty))?;
                    // Arguments may read what the receiver borrows (a two-phase borrow), but not borrow it themselves.
                    let others = signature.params.iter().any(|p| p.hold != Hold::Value);
                    if self.random.below(3) > 0 || others || place.text.contains('[') {
                        self.freeze(&place.root, true);
                        frozen.push(place.root.clone());
                    }
                    match place.text.starts_with('*') {
                        true => place.root,
                        false => place.text,
                    }
                }
                _ => match self.receiver_of(ty) {
                    Some(text) => {
                        let name = text.trim_start_matches(['(', '*']);
                        let end = name
                            .find(|c: char| !c.is_alphanumeric() && c != '_')
                            .unwrap_or(name.len());
                        let root = name[..end].to_owned();
                        if signature.params.iter().any(|p| p.hold == Hold::Mutable)
                            && self.visible().iter().any(|l| l.name == root)
                        {
                            self.freeze(&root, true);
                            frozen.push(root);
                        }
                        text
                    }
                    None => format!("({})", self.whole(ty, d)),
                },
            });
        }
        let mut args: Vec<Option<String>> = vec![None; signature.params.len()];
        for (k, param) in signature.params.iter().enumerate() {
            if param.hold == Hold::Mutable {
                let (text, root) = self.borrow(&param.ty)?;
                self.freeze(&root, true);
                frozen.push(root);
                args[k] = Some(text);
            }
        }
        for (arg, param) in args.iter_mut().zip(&signature.params) {
            if arg.is_some() {
                continue;
            }
            *arg = Some(match param.known {
                Some((low, high)) => self.bounded(&param.ty, low, high),
                None => {
                    let value = self.without_effects(|m| m.expr(&param.ty, d.inferred(true)));
                    match param.hold {
                        Hold::Shared => format!("&{value}"),
                        _ => value,
                    }
                }
            });
        }
        let mut all: Vec<String> = Vec::new();
        if signature.inputs {
            all.extend(self.shape.named());
            all.push("pixel".to_owned());
        }
        all.extend(args.into_iter().flatten());
        let args = all.join(", ");
        Some(match receiver {
            Some(receiver) => format!("{receiver}.{}({args})", signature.name),
            None => format!("{}({args})", signature.name),
        })
    }

    /// Something in reach to call a method of that takes it by value or by reference.
    fn receiver_of(&mut self, ty: &Ty) -> Option<String> {
        if !self.copies(ty) {
            let name = self.visible().into_iter().find(|l| l.ty == *ty).map(|l| l.name);
            return name;
        }
        self.read(ty, false)
    }

    /// A known integer between two, inclusive.
    fn bounded(&mut self, ty: &Ty, low: i64, high: i64) -> String {
        let fit: Vec<String> = self
            .visible()
            .into_iter()
            .filter(|l| l.ty == *ty && l.known && l.hold == Hold::Value)
            .filter(|l| l.range.is_some_and(|(a, b)| a >= low && b <= high))
            .map(|l| l.name)
            .collect();
        if !fit.is_empty() && self.random.once_in(2) {
            return self.random.pick(&fit);
        }
        let n = self.random.between(low, high);
        self.int_text(ty, n, true)
    }

    pub(super) fn some_call(&mut self) {
        if self.signatures.is_empty() {
            return self.assign();
        }
        let signature = self.random.pick(&self.signatures.clone());
        self.call_statement(&signature);
    }

    /// A call as a statement, its result kept if there is one.
    pub(super) fn call_statement(&mut self, signature: &Signature) {
        if signature.inputs && !self.inputs {
            return;
        }
        let want = self.wish(2);
        // There is something to borrow for it.
        let mut needed: Vec<Ty> = Vec::new();
        if let Some((ty, Hold::Mutable)) = &signature.receiver {
            needed.push(ty.clone());
        }
        needed.extend(
            signature
                .params
                .iter()
                .filter(|p| p.hold == Hold::Mutable)
                .map(|p| p.ty.clone()),
        );
        for ty in needed {
            if self.random.once_in(2) || self.writable(Some(&ty)).is_none() {
                let value = self.expr(&ty, want.inferred(true));
                let name = self.fresh("v");
                let written = self.ty(&ty);
                self.line(format!("let mut {name}: {written} = {value};"));
                self.bind(&name, &ty, true);
            }
        }
        let Some(call) = self.call(signature, want) else {
            return;
        };
        match &signature.result {
            Some(ty) if self.random.below(6) > 0 => {
                let name = self.name();
                let mutable = self.random.once_in(2);
                self.line(format!("let {}{name} = {call};", if mutable { "mut " } else { "" }));
                self.bind(&name, ty, mutable);
            }
            Some(_) => self.line(format!("let _ = {call};")),
            None => self.line(format!("{call};")),
        }
    }
}
