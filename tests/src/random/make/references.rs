//! Mutable references: locals, reborrows, patterns.

use super::types::Ty;
use super::{Hold, Maker};

impl Maker {
    /// Writes through a variable that is a mutable reference.
    pub(super) fn write_to(&mut self, name: &str) {
        let Some(local) = self.locals.iter().rev().find(|l| l.name == name).cloned() else {
            return;
        };
        let places: Vec<_> = {
            let hidden: Vec<String> = self
                .visible()
                .into_iter()
                .map(|l| l.name)
                .filter(|n| n != name)
                .collect();
            for other in &hidden {
                self.freeze(other, true);
            }
            let place = self.writable(None);
            for other in &hidden {
                self.freeze(other, false);
            }
            place.into_iter().collect()
        };
        match places.first() {
            Some(place) => self.assign_to(&place.text.clone(), &place.ty.clone(), &place.root.clone()),
            None => {
                debug_assert_eq!(local.hold, Hold::Mutable);
            }
        }
    }

    /// Writes through one of the parameters that are mutable references.
    pub(super) fn write_through(&mut self) {
        let visible = self.visible();
        let references: Vec<String> = visible
            .into_iter()
            .filter(|l| l.hold == Hold::Mutable)
            .map(|l| l.name)
            .collect();
        for name in references {
            if self.random.below(4) > 0 {
                self.write_to(&name);
            }
        }
    }

    /// A mutable reference to a variable or a part of it, used for a while.
    pub(super) fn reference(&mut self) {
        if self.random.once_in(4) {
            return self.taken_apart();
        }
        let Some(place) = self.writable(None) else {
            return self.assign();
        };
        let name = self.fresh("r");
        let value = match place.reference {
            Hold::Mutable if self.random.once_in(2) => format!("&mut *{}", place.root),
            _ => format!("&mut {}", place.text),
        };
        self.line(format!("let {name} = {value};"));
        self.freeze(&place.root, true);
        self.bind(&name, &place.ty, false);
        self.last().hold = Hold::Mutable;
        self.write_to(&name);
        if self.random.once_in(4) {
            // A reborrow, and the first again after it.
            let inner = self.fresh("r");
            self.line(format!("let {inner} = &mut *{name};"));
            self.freeze(&name, true);
            self.bind(&inner, &place.ty, false);
            self.last().hold = Hold::Mutable;
            self.write_to(&inner);
            self.forget(&inner);
            self.freeze(&name, false);
            self.write_to(&name);
        }
        // References stay out of the blocks of further statements, which would end after them.
        for _ in 0..self.random.below(2) {
            self.some_use();
        }
        self.forget(&name);
        self.freeze(&place.root, false);
    }

    fn some_use(&mut self) {
        match self.random.below(3) {
            0 => self.assign(),
            1 if !self.signatures.is_empty() => {
                let signature = self.random.pick(&self.signatures.clone());
                self.call_statement(&signature);
            }
            _ => self.statement(),
        }
    }

    /// Ends the use of a variable.
    fn forget(&mut self, name: &str) {
        if let Some(at) = self.locals.iter().rposition(|l| l.name == name) {
            self.locals.remove(at);
        }
    }

    /// `let S { x, .. } = &mut s;`, `let (x, y) = &mut t;`, `let [x, y] = &mut a;`
    fn taken_apart(&mut self) {
        let structured: Vec<_> = self
            .visible()
            .into_iter()
            .filter(|l| !l.counter && !l.known && (l.hold == Hold::Mutable || l.mutable && l.hold == Hold::Value))
            .filter(|l| match &l.ty {
                Ty::Struct(k) => !self.structures[*k].tuple,
                Ty::Tuple(parts) => parts.len() == 2,
                Ty::Array(_, len) => *len == 2,
                _ => false,
            })
            .collect();
        if structured.is_empty() {
            return self.assign();
        }
        let local = self.random.pick(&structured);
        let (x, y) = (self.fresh("r"), self.fresh("r"));
        let (pattern, bound): (String, Vec<(String, Ty)>) = match &local.ty {
            Ty::Struct(k) => {
                let structure = self.structures[*k].clone();
                let (field, ty) = self.random.pick(&structure.fields);
                if self.random.once_in(2) && !self.locals.iter().any(|l| l.name == field) {
                    (format!("{} {{ {field}, .. }}", structure.name), vec![(field, ty)])
                } else {
                    (format!("{} {{ {field}: {x}, .. }}", structure.name), vec![(x, ty)])
                }
            }
            Ty::Tuple(parts) => (
                format!("({x}, {y})"),
                vec![(x.clone(), parts[0].clone()), (y.clone(), parts[1].clone())],
            ),
            Ty::Array(of, _) => (
                format!("[{x}, {y}]"),
                vec![(x.clone(), (**of).clone()), (y.clone(), (**of).clone())],
            ),
            _ => return,
        };
        let value = match local.hold {
            Hold::Mutable => format!("&mut *{}", local.name),
            _ => format!("&mut {}", local.name),
        };
        self.line(format!("let {pattern} = {value};"));
        self.freeze(&local.name, true);
        for (name, ty) in &bound {
            self.bind(name, ty, false);
            self.last().hold = Hold::Mutable;
        }
        for (name, _) in &bound {
            self.write_to(name);
        }
        if self.random.once_in(2) {
            self.some_use();
        }
        for (name, _) in &bound {
            self.forget(name);
        }
        self.freeze(&local.name, false);
    }
}
