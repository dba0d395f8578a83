//! Loops.

use super::types::Ty;
use super::{Around, Feature, Hold, Maker};

/// Most iterations of nested loops together.
const ITERATIONS: u32 = 40;

impl Maker {
    fn attribute(&mut self) {
        if self.chance(Feature::Attributes, 5) {
            let word = self
                .random
                .pick(&["unroll(none)", "unroll(full)", "unroll(2)", "unroll(4)"]);
            self.line(format!("#[cfg_attr(false, {word})]"));
        }
    }

    fn label(&mut self) -> Option<String> {
        self.chance(Feature::Leaving, 4).then(|| self.fresh("'l"))
    }

    /// The body of a loop of at most `times` iterations, between its braces.
    fn iterate(&mut self, head: &str, label: Option<String>, times: u32, bind: impl FnOnce(&mut Maker)) {
        let prefix = label.as_ref().map_or(String::new(), |l| format!("{l}: "));
        self.open(format!("{prefix}{head} {{"));
        let (mark, repeats) = (self.locals.len(), self.repeats);
        self.repeats = self.repeats.saturating_mul(times.max(1));
        self.loops.push(Around {
            dynamic: self.dynamic,
            label,
            left: false,
        });
        bind(self);
        let count = 1 + self.random.below(3);
        let leaves = self.chance(Feature::RuntimeLeaving, 3);
        self.nesting += u32::from(leaves);
        if leaves && self.random.once_in(2) {
            self.leave_at_run_time();
        }
        self.body(count);
        self.nesting -= u32::from(leaves);
        let left = self.loops.pop().is_some_and(|l| l.left);
        self.repeats = repeats;
        self.locals.truncate(mark);
        self.close("}");
        self.unknown_after(left);
    }

    /// `for` over a range of any kind.
    pub(super) fn for_range(&mut self) {
        let allowed = ITERATIONS / self.repeats.max(1);
        if allowed < 2 {
            return self.assign();
        }
        if self.chance(Feature::RuntimeLoops, 7) {
            return self.for_runtime();
        }
        let ty = match self.random.below(5) {
            0..=1 => Ty::I32,
            2..=3 if self.on(Feature::UnsignedLoops) => Ty::U32,
            4 => Ty::Usize,
            _ => Ty::I32,
        };
        let most = i64::from(allowed.min(6));
        let low = match ty {
            Ty::I32 => self.random.between(-3, 3),
            _ => self.random.between(0, 3),
        };
        let mut high = low + self.random.between(0, most);
        let inclusive = self.random.once_in(3);
        if inclusive && high - low == most {
            high -= 1;
        }
        let step = if self.random.once_in(4) {
            self.random.between(1, 3)
        } else {
            1
        };
        if self.chance(Feature::Edges, 25) && ty != Ty::Usize {
            return self.for_edge(&ty);
        }
        // The bound may be a constant, a counter around, or a function's literal.
        let from_range = |l: &super::Local| {
            l.known
                && l.ty == ty
                && l.hold == Hold::Value
                && l.range
                    .is_some_and(|(a, b)| a >= low && b <= low + most && b - a <= most)
        };
        let mut bounds: Vec<(String, (i64, i64))> = self
            .visible()
            .into_iter()
            .filter(from_range)
            .filter_map(|l| Some((l.name, l.range?)))
            .collect();
        let constants = self.constants.iter().filter(|(_, t, _)| *t == ty);
        bounds.extend(
            constants
                .filter_map(|(name, _, range)| Some((name.clone(), (*range)?)))
                .filter(|(_, (a, b))| *a >= low && *b < low + most),
        );
        let typed = self.random.once_in(2);
        let start = self.int_text(&ty, low, typed);
        let (end, top) = match bounds.is_empty() || self.random.once_in(2) {
            true => (self.int_text(&ty, high, !typed), high),
            false => {
                let (name, (_, b)) = self.random.pick(&bounds);
                (name, b)
            }
        };
        let last = if inclusive { top } else { top - 1 };
        let dots = if inclusive { "..=" } else { ".." };
        let range = match (step, self.random.below(4)) {
            (1, 0) => format!("({start}{dots}{end}).rev()"),
            (1, _) => format!("{start}{dots}{end}"),
            // rustc takes no inclusive range there.
            (step, 0) if !inclusive => format!("({start}{dots}{end}).step_by({step}).rev()"),
            (step, _) => format!("({start}{dots}{end}).step_by({step})"),
        };
        let label = self.label();
        self.attribute();
        let wild = self.random.once_in(12);
        let name = if wild { "_".to_owned() } else { self.fresh("k") };
        let times = (last - low + 1).max(0) as u32;
        let head = format!("for {name} in {range}");
        self.iterate(&head, label, times, |m| {
            if !wild {
                m.bind(&name, &ty, false);
                m.last().known = true;
                m.last().counter = true;
                m.last().range = Some((low, last.max(low)));
            }
        });
    }

    /// A range at the end of its type.
    fn for_edge(&mut self, ty: &Ty) {
        let range = match ty {
            Ty::I32 => self.random.pick(&[
                "i32::MAX - 2..=i32::MAX",
                "(i32::MIN..=i32::MIN + 2).rev()",
                "(i32::MIN..i32::MAX).step_by(1_500_000_000)",
                "2147483645..i32::MAX",
            ]),
            _ => self.random.pick(&[
                "u32::MAX - 2..=u32::MAX",
                "(4294967290..u32::MAX).step_by(2)",
                "0x7fff_ffff..0x8000_0002u32",
                "(0..=u32::MAX).step_by(2_000_000_000)",
            ]),
        };
        let name = self.fresh("k");
        self.attribute();
        self.iterate(&format!("for {name} in {range}"), None, 3, |m| {
            m.bind(&name, ty, false);
            m.last().known = true;
            m.last().counter = true;
        });
    }

    /// A loop that stays one, since its bounds are runtime values.
    fn for_runtime(&mut self) {
        if !self.inputs {
            return self.assign();
        }
        let (head, names) = self.runtime_head();
        let leaving = self.on(Feature::RuntimeLeaving);
        let loops = match leaving {
            true => self.loops.clone(),
            false => std::mem::take(&mut self.loops),
        };
        self.dynamic += 1;
        let label = if leaving { self.label() } else { None };
        self.iterate(&head, label, 4, |m| {
            if !leaving {
                // Nothing leaves it early: how often it runs is a runtime value.
                m.loops.last_mut().expect("inside of a loop").dynamic = u32::MAX;
            }
            for (name, ty) in &names {
                m.bind(name, ty, false);
                m.last().counter = true;
            }
        });
        self.dynamic -= 1;
        if !leaving {
            self.loops = loops;
        }
    }

    /// What such a loop runs over: its head, and the names and types that it binds.
    fn runtime_head(&mut self) -> (String, Vec<(String, Ty)>) {
        if self.chance(Feature::Lazy, 2) {
            return self.lazy_head();
        }
        let (ty, range) = match self.random.below(7) {
            0 => (Ty::I32, "0..p.clamp(0, 4)".to_owned()),
            1 => (Ty::I32, "-1..=(p & 3)".to_owned()),
            2 if self.on(Feature::UnsignedLoops) => (Ty::U32, "0..(q & 3)".to_owned()),
            3 if self.on(Feature::UnsignedLoops) => (Ty::U32, "1..=(q >> 30)".to_owned()),
            4 if self.on(Feature::UnsignedLoops) => (Ty::Usize, "0..(q % 4) as usize".to_owned()),
            5 if self.on(Feature::Edges) => (Ty::I32, "(0..=(p & 5)).rev()".to_owned()),
            _ => (Ty::I32, "pixel.x..pixel.x + 3".to_owned()),
        };
        let name = self.fresh("k");
        (format!("for {name} in {range}"), vec![(name, ty)])
    }

    /// `for` over an array, in all its ways.
    pub(super) fn for_array(&mut self) {
        let arrays: Vec<super::Local> = self
            .visible()
            .into_iter()
            .filter(|l| matches!(l.ty, Ty::Array(..)))
            .collect();
        if arrays.is_empty() || self.repeats > ITERATIONS / 4 {
            return self.assign();
        }
        let array = self.random.pick(&arrays);
        let Ty::Array(of, len) = array.ty.clone() else { return };
        let may_write = self.on(Feature::Mutable)
            && (array.hold == Hold::Mutable || array.mutable && array.hold == Hold::Value)
            && !array.known;
        let (name, label) = (self.fresh("e"), self.label());
        self.attribute();
        if may_write && self.random.below(3) > 0 {
            let path = array.name.clone();
            let (slice, count) = self.slice(len, 4);
            let (head, counter) = match self.random.below(4) {
                _ if !slice.is_empty() => match self.random.once_in(2) {
                    true => (format!("for {name} in &mut {path}{slice}"), None),
                    false => (format!("for {name} in {path}{slice}.iter_mut()"), None),
                },
                0 if array.hold == Hold::Value => (format!("for {name} in &mut {path}"), None),
                1 => {
                    let k = self.fresh("k");
                    (format!("for ({k}, {name}) in {path}.iter_mut().enumerate()"), Some(k))
                }
                2 if array.hold == Hold::Mutable => (format!("for {name} in &mut *{path}"), None),
                _ => (format!("for {name} in {path}.iter_mut()"), None),
            };
            self.freeze(&path, true);
            self.iterate(&head, label, count as u32, |m| {
                m.bind(&name, &of, false);
                m.last().hold = Hold::Mutable;
                if let Some(k) = counter {
                    m.bind(&k, &Ty::Usize, false);
                    m.last().known = true;
                    m.last().counter = true;
                    m.last().range = Some((0, len as i64 - 1));
                }
                m.write_to(&name);
            });
            self.freeze(&path, false);
            return;
        }
        let by_value = self.copies(&of) && array.hold == Hold::Value;
        let path = array.name.clone();
        let (slice, count) = self.slice(len, 4);
        let (head, hold, counter) = match self.random.below(5) {
            0 | 1 if !slice.is_empty() => (format!("for {name} in &{path}{slice}"), Hold::Shared, None),
            _ if !slice.is_empty() => (format!("for {name} in {path}{slice}.iter()"), Hold::Shared, None),
            0 if by_value => (format!("for {name} in {path}"), Hold::Value, None),
            1 => {
                let k = self.fresh("k");
                (
                    format!("for ({k}, {name}) in {path}.iter().enumerate()"),
                    Hold::Shared,
                    Some(k),
                )
            }
            2 => (format!("for {name} in {path}.iter().rev()"), Hold::Shared, None),
            3 if self.copies(&of) => (format!("for &{name} in {path}.iter()"), Hold::Value, None),
            _ => (format!("for {name} in {path}.iter()"), Hold::Shared, None),
        };
        // An array that is iterated by reference cannot be changed inside.
        let blocks = head.contains(".iter()") || !slice.is_empty();
        let writes = array.mutable || array.hold == Hold::Mutable;
        if blocks && writes {
            self.freeze(&path, true);
        }
        self.iterate(&head, label, count as u32, |m| {
            m.bind(&name, &of, false);
            m.last().hold = hold;
            m.last().known = array.known;
            if let Some(k) = counter {
                m.bind(&k, &Ty::Usize, false);
                m.last().known = true;
                m.last().counter = true;
                m.last().range = Some((0, len as i64 - 1));
            }
        });
        if blocks && writes {
            self.freeze(&path, false);
        }
    }

    /// `while` and `loop`, with a counter that is known.
    pub(super) fn while_(&mut self) {
        let allowed = ITERATIONS / self.repeats.max(1);
        if allowed < 4 {
            return self.assign();
        }
        let ty = self.random.pick(&[Ty::I32, Ty::U32, Ty::Usize]);
        let ty = if self.on(Feature::UnsignedLoops) { ty } else { Ty::I32 };
        let name = self.fresh("c");
        let zero = self.random.between(0, 2);
        let first = self.int_text(&ty, zero, false);
        let end = zero + self.random.between(1, 3);
        self.line(format!("let mut {name} = {first};"));
        self.bind(&name, &ty, true);
        self.last().known = true;
        self.last().counter = true;
        let label = self.label();
        let step = match self.random.below(3) {
            0 => format!("{name} += 1;"),
            1 => format!("{name} = {name} * 2 + 1;"),
            _ => format!("{name} += 2;"),
        };
        let dynamic = self.dynamic;
        let endless = self.random.once_in(3);
        let mut ends = false;
        let head = if endless {
            "loop".to_owned()
        } else if self.chance(Feature::RuntimeLeaving, 3) {
            // The trip count is a runtime value.
            let want = self.wish(1);
            ends = true;
            let condition = self.condition(want);
            match self.random.once_in(2) {
                true => format!("while {name} < {end} && {condition}"),
                false => format!("while {condition} && {name} < {end}"),
            }
        } else {
            format!("while {name} < {end}")
        };
        if self.chance(Feature::Attributes, 6) {
            // The loop has at most three iterations.
            let bound = self.random.between(3, 6);
            self.line(format!("#[cfg_attr(false, bound({bound}))]"));
        }
        let prefix = label.as_ref().map_or(String::new(), |l| format!("{l}: "));
        self.open(format!("{prefix}{head} {{"));
        if endless {
            self.open(format!("if {name} >= {end} {{"));
            self.line("break;");
            self.close("}");
        }
        // The counter goes on first, so that `continue` ends too.
        self.line(step);
        let repeats = self.repeats;
        self.repeats *= 3;
        let left = ends;
        self.loops.push(Around { dynamic, label, left });
        if ends {
            self.unknown_after(true);
        }
        let count = 1 + self.random.below(2);
        if self.chance(Feature::RuntimeLeaving, 3) {
            self.leave_at_run_time();
        }
        self.body(count);
        let left = self.loops.pop().is_some_and(|l| l.left);
        self.repeats = repeats;
        self.close("}");
        self.unknown_after(left);
    }
}
