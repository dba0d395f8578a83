//! `if`, `match`, `break` and `continue` as statements.

use super::{Feature, Maker};

impl Maker {
    pub(super) fn runtime_if(&mut self) {
        let want = self.wish(2);
        let condition = self.with_effects(|m| m.condition(want));
        if self.chance(Feature::Attributes, 3) {
            let word = self.random.pick(&["branch", "select"]);
            self.line(format!("#[cfg_attr(false, {word})]"));
        }
        self.open(format!("if {condition} {{"));
        self.dynamic += 1;
        let count = 1 + self.random.below(2);
        self.body(count);
        if self.random.once_in(4) {
            let condition = self.condition(want);
            self.close(&format!("}} else if {condition} {{"));
            self.indent += 1;
            self.body(1);
        }
        if self.random.once_in(2) {
            self.close("} else {");
            self.indent += 1;
            let count = 1 + self.random.below(2);
            self.body(count);
        }
        self.dynamic -= 1;
        self.close("}");
    }

    pub(super) fn known_if(&mut self) {
        let condition = self.known_condition();
        self.open(format!("if {condition} {{"));
        self.body(1);
        if self.random.once_in(2) {
            self.close("} else {");
            self.indent += 1;
            self.body(1);
        }
        self.close("}");
    }

    pub(super) fn match_statement(&mut self) {
        let (subject, patterns) = self.known_match();
        self.open(format!("match {subject} {{"));
        for pattern in patterns {
            self.open(format!("{pattern} => {{"));
            self.body(1);
            self.close("}");
        }
        self.close("}");
    }

    /// `break`, `continue` or `return`, under a condition that is a runtime value or not.
    pub(super) fn leave_at_run_time(&mut self) {
        let innermost = self.loops.len().saturating_sub(1);
        let free: Vec<(usize, Option<String>)> = self
            .loops
            .iter()
            .enumerate()
            .filter(|(k, l)| l.label.is_some() || *k == innermost)
            .map(|(k, l)| (k, l.label.clone()))
            .collect();
        let returns = self.result.is_some() && (free.is_empty() || self.random.once_in(4));
        if free.is_empty() && !returns {
            return;
        }
        if returns {
            self.loops.iter_mut().for_each(|l| l.left = true);
            return self.early_return();
        }
        let (target, label) = self.random.pick(&free);
        self.loops[target..].iter_mut().for_each(|l| l.left = true);
        let label = label.map_or(String::new(), |l| format!(" {l}"));
        let word = self.random.pick(&["break", "continue"]);
        let want = self.wish(2);
        let condition = self.with_effects(|m| m.condition(want));
        self.open(format!("if {condition} {{"));
        if self.random.once_in(3) {
            let mark = self.locals.len();
            self.assign();
            self.locals.truncate(mark);
        }
        self.line(format!("{word}{label};"));
        match self.random.below(6) {
            0 => {
                self.close("} else {");
                self.indent += 1;
                self.dynamic += 1;
                self.body(1);
                self.dynamic -= 1;
            }
            1 => {
                let condition = self.condition(want);
                self.close(&format!("}} else if {condition} {{"));
                self.indent += 1;
                let word = self.random.pick(&["break", "continue"]);
                self.line(format!("{word}{label};"));
            }
            _ => {}
        }
        self.close("}");
    }

    /// Values that changed in a loop that is left at run time are no constants any more.
    pub(super) fn unknown_after(&mut self, left: bool) {
        if left {
            self.locals.iter_mut().filter(|l| l.mutable).for_each(|l| {
                l.known = false;
                l.range = None;
            });
        }
    }

    /// `break`, `continue` or `return`, mostly under a condition that is known.
    pub(super) fn leave(&mut self) {
        if self.on(Feature::RuntimeLeaving) && self.random.once_in(2) {
            return self.leave_at_run_time();
        }
        let free: Vec<Option<String>> = self
            .loops
            .iter()
            .enumerate()
            .filter(|(k, l)| l.dynamic == self.dynamic && (l.label.is_some() || *k + 1 == self.loops.len()))
            .map(|(_, l)| l.label.clone())
            .collect();
        if free.is_empty() {
            if self.dynamic == 0 && self.loops.is_empty() && self.result.is_some() && self.random.once_in(3) {
                self.early_return();
            }
            return;
        }
        let label = self.random.pick(&free).map_or(String::new(), |l| format!(" {l}"));
        let condition = self.known_condition();
        let word = self.random.pick(&["break", "continue"]);
        self.open(format!("if {condition} {{"));
        self.line(format!("{word}{label};"));
        self.close("}");
    }
}
