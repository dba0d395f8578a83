//! Statements: which there are, assignments, blocks.

use super::types::{Lane, Ty};
use super::{Feature, Maker, Want};

/// Blocks around a statement at most.
const NESTING: u32 = 4;

impl Maker {
    pub(super) fn wish(&mut self, depth: u32) -> Want {
        Want {
            depth,
            known: false,
            inferred: false,
        }
    }

    /// Writes a statement, or a few that belong together.
    pub(super) fn statement(&mut self) {
        if self.poor() {
            return self.assign();
        }
        let nested = self.nesting < NESTING;
        if self.writes() && self.random.once_in(6) {
            return self.write();
        }
        if self.inputs && self.shape.is_wide() && self.random.once_in(10) {
            return self.read_further();
        }
        match self.random.below(52) {
            44..=45 if self.on(Feature::Objects) => self.object_statement(),
            46..=47 if self.on(Feature::Held) => self.held_statement(),
            48..=49 if self.on(Feature::Adaptors) => self.slice_statement(),
            50 if self.on(Feature::Spaces) => self.space_statement(),
            43 if self.on(Feature::Closures) => self.swap_by_assignment(),
            40..=41 if self.on(Feature::Closures) => self.closure_statement(),
            42 if self.on(Feature::Closures) && self.on(Feature::Mutable) => self.writing_closure(),
            0..=9 => self.let_(),
            10..=15 => self.assign(),
            16..=17 if nested => self.runtime_if(),
            18 if nested => self.known_if(),
            19 if nested => self.block_statement(),
            20..=23 if nested => self.for_range(),
            24..=25 if nested => self.for_array(),
            26 if nested && self.on(Feature::While) => self.while_(),
            27..=30 if self.on(Feature::Mutable) => self.reference(),
            31..=33 => self.some_call(),
            34 if nested && self.on(Feature::Enums) => self.match_statement(),
            39 if nested && self.on(Feature::Matching) => self.runtime_match(),
            35 if nested && self.chance(Feature::Choices, 2) => self.if_some(),
            35 => self.destructure(),
            36 if self.on(Feature::Leaving) => self.leave(),
            37 if self.random.once_in(3) && self.on(Feature::Library) => self.exchange(),
            37 => self.constant_inside(),
            38 => self.line("assert!(1 + 1 == 2, \"arithmetic\");"),
            _ => self.let_(),
        }
    }

    /// `place = value` or `place op= value`.
    pub(super) fn assign(&mut self) {
        let Some(place) = self.writable(None) else {
            return self.plain_let();
        };
        self.assign_to(&place.text, &place.ty, &place.root);
    }

    pub(super) fn assign_to(&mut self, place: &str, ty: &Ty, root: &str) {
        let want = self.wish(if self.poor() { 1 } else { 2 }).inferred(true);
        let plain = ty.plain() || *ty == Ty::Usize;
        if plain && self.random.below(3) > 0 {
            let op = match ty {
                Ty::F32 | Ty::Vec(Lane::F, _) => self.random.pick(&["+", "-", "*"]),
                Ty::Usize => "+",
                Ty::Vec(..) => self.random.pick(&["+", "-", "*"]),
                _ => self.random.pick(&["+", "-", "*", "^", "|", "&", "<<", ">>", "/", "%"]),
            };
            if op == "<<" || op == ">>" {
                let by = self.random.between(0, 9);
                return self.line(format!("{place} {op}= {by};"));
            }
            if op == "/" || op == "%" {
                let by = self.random.between(2, 9);
                return self.line(format!("{place} {op}= {by};"));
            }
            let scalar = match ty.lane() {
                Some(lane) if self.random.once_in(3) => lane,
                _ => ty.clone(),
            };
            // An operator on vectors borrows its left side first; on numbers it is read after the right side.
            let blocked = ty.lane().is_some();
            if blocked {
                self.freeze(root, true);
            }
            let value = if blocked {
                self.expr(&scalar, want.inferred(scalar == *ty))
            } else {
                self.with_effects(|m| m.expr(&scalar, want))
            };
            if blocked {
                self.freeze(root, false);
            }
            let value = if *ty == Ty::Usize {
                format!("({value} % 9)")
            } else {
                value
            };
            return self.line(format!("{place} {op}= {value};"));
        }
        let value = self.with_effects(|m| m.expr(ty, want));
        self.line(format!("{place} = {value};"));
    }

    /// Statements in braces, whose variables end with them.
    pub(super) fn body(&mut self, statements: usize) {
        let (mark, indent) = (self.locals.len(), self.indent);
        self.nesting += 1;
        for _ in 0..statements {
            self.statement();
        }
        if !self.loops.is_empty() && self.chance(Feature::RuntimeLeaving, 4) {
            self.leave_at_run_time();
        }
        // Values computed inside are carried out.
        if self.random.below(3) > 0 && self.locals.len() > mark {
            self.carry();
        }
        self.nesting -= 1;
        debug_assert_eq!(indent, self.indent);
        self.locals.truncate(mark);
    }

    fn block_statement(&mut self) {
        self.open("{");
        self.body(2);
        self.close("}");
    }
}
