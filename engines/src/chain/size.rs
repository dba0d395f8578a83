//! Sizes of pictures as engines take them: expressions of JavaScript, and multiples of the picture's size.

use straightline_codegen::chain::{SizeOp, SizeRule, SizeTerm};

/// Precedence of an expression of JavaScript.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binds {
    Sum,
    Product,
    Whole,
}

/// Returns the width (`axis` 0) or height of a rule in JavaScript, at least 1. `of("NAME")` has the width and height of an input.
///
/// Numbers of JavaScript are exact to 2^53, where those of the rule end at 2^32; no texture is as large.
pub fn javascript(rule: &SizeRule, axis: usize) -> String {
    let side = ["width", "height"][axis];
    let grouped = |(text, binds): (String, Binds), least: Binds| match binds < least {
        true => format!("({text})"),
        false => text,
    };
    let of = |name: &str| Ok((format!("of(\"{name}\").{side}"), Binds::Whole));
    let number = |size: [u32; 2]| (size[axis].to_string(), Binds::Whole);
    let apply = |op: SizeOp, a: (String, Binds), b: (String, Binds)| match op {
        SizeOp::Add => (format!("{} + {}", a.0, b.0), Binds::Sum),
        SizeOp::Sub => {
            let b = grouped(b, Binds::Product);
            (format!("Math.max(0, {} - {b})", a.0), Binds::Whole)
        }
        SizeOp::Mul => {
            let [a, b] = [a, b].map(|side| grouped(side, Binds::Product));
            (format!("{a} * {b}"), Binds::Product)
        }
        SizeOp::Div => {
            let a = grouped(a, Binds::Product);
            let b = match b.0.parse::<u32>() {
                // Division by 0 leaves the dividend.
                Ok(0) => "1".to_owned(),
                Ok(_) => b.0,
                Err(_) => format!("({} || 1)", b.0),
            };
            (format!("Math.floor({a} / {b})"), Binds::Whole)
        }
        SizeOp::Max => (format!("Math.max({}, {})", a.0, b.0), Binds::Whole),
        SizeOp::Min => (format!("Math.min({}, {})", a.0, b.0), Binds::Whole),
    };
    // The plan is the generator's own, whose rules are well-formed.
    let text = rule.fold(of, number, apply).map(|(text, _)| text).unwrap_or_default();
    match rule.0.as_ref() {
        [SizeTerm::Of(_)] => text,
        [SizeTerm::Number(size)] => size[axis].max(1).to_string(),
        _ => format!("Math.max(1, {text})"),
    }
}

/// A width or height as a multiple of an input's, or a number of texels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Extent {
    /// `times / per` of the input's.
    Share {
        input: String,
        times: u32,
        per: u32,
    },
    Texels(u32),
}

impl Extent {
    /// Reads a rule; `None` of one that is no multiple. Rounding is left out.
    pub fn from_rule(rule: &SizeRule, axis: usize) -> Option<Extent> {
        let of = |name: &str| {
            Ok(Some(Extent::Share {
                input: name.to_owned(),
                times: 1,
                per: 1,
            }))
        };
        let number = |size: [u32; 2]| Some(Extent::Texels(size[axis]));
        let apply = |op: SizeOp, a: Option<Extent>, b: Option<Extent>| a?.apply(op, b?);
        let extent = rule.fold(of, number, apply).ok()??;
        Some(match extent {
            Extent::Texels(texels) => Extent::Texels(texels.max(1)),
            share => share,
        })
    }

    fn apply(self, op: SizeOp, other: Extent) -> Option<Extent> {
        let (input, times, per, number) = match (self, other) {
            (Extent::Texels(a), Extent::Texels(b)) => return Some(Extent::Texels(op.apply(a, b))),
            (Extent::Share { input, times, per }, Extent::Texels(number)) => (input, times, per, number),
            (Extent::Texels(number), Extent::Share { input, times, per }) if op == SizeOp::Mul => {
                (input, times, per, number)
            }
            _ => return None,
        };
        let (times, per) = match op {
            SizeOp::Mul => (times.checked_mul(number)?, per),
            SizeOp::Div if number > 0 => (times, per.checked_mul(number)?),
            // No picture is smaller.
            SizeOp::Max if number <= 1 => (times, per),
            _ => return None,
        };
        let common = greatest_divisor(times, per);
        (times > 0).then_some(Extent::Share {
            input,
            times: times / common,
            per: per / common,
        })
    }
}

/// Greatest common divisor.
pub fn greatest_divisor(a: u32, b: u32) -> u32 {
    match b {
        0 => a.max(1),
        _ => greatest_divisor(b, a % b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str) -> Vec<SizeTerm> {
        vec![SizeTerm::Of(name.to_owned().into())]
    }

    fn number(x: u32, y: u32) -> Vec<SizeTerm> {
        vec![SizeTerm::Number([x, y])]
    }

    fn apply(op: SizeOp, a: &[SizeTerm], b: &[SizeTerm]) -> Vec<SizeTerm> {
        [a, b, &[SizeTerm::Apply(op)]].concat()
    }

    fn rule(terms: Vec<SizeTerm>) -> SizeRule {
        SizeRule(terms.into())
    }

    #[test]
    fn rules_are_expressions() {
        let js = |terms: &[SizeTerm], axis| javascript(&rule(terms.to_vec()), axis);
        let color = of("color");
        assert_eq!(js(&color, 0), "of(\"color\").width");
        assert_eq!(js(&number(256, 0), 1), "1");
        let half = apply(SizeOp::Div, &color, &number(2, 2));
        assert_eq!(js(&half, 1), "Math.max(1, Math.floor(of(\"color\").height / 2))");
        let up = apply(SizeOp::Div, &apply(SizeOp::Add, &color, &number(1, 3)), &number(2, 2));
        assert_eq!(js(&up, 1), "Math.max(1, Math.floor((of(\"color\").height + 3) / 2))");
        let less = apply(SizeOp::Sub, &color, &apply(SizeOp::Add, &of("a"), &number(1, 1)));
        assert_eq!(
            js(&less, 0),
            "Math.max(1, Math.max(0, of(\"color\").width - (of(\"a\").width + 1)))"
        );
        let share = apply(SizeOp::Div, &apply(SizeOp::Mul, &color, &number(3, 3)), &of("a"));
        assert_eq!(
            js(&share, 0),
            "Math.max(1, Math.floor(of(\"color\").width * 3 / (of(\"a\").width || 1)))"
        );
        let whole = apply(SizeOp::Div, &apply(SizeOp::Max, &color, &of("a")), &number(0, 0));
        assert_eq!(
            js(&whole, 0),
            "Math.max(1, Math.floor(Math.max(of(\"color\").width, of(\"a\").width) / 1))"
        );
    }

    #[test]
    fn multiples_are_reduced() {
        let extent = |terms: &[SizeTerm]| Extent::from_rule(&rule(terms.to_vec()), 0);
        let share = |times, per| {
            Some(Extent::Share {
                input: "color".to_owned(),
                times,
                per,
            })
        };
        let color = of("color");
        let half = apply(SizeOp::Div, &color, &number(2, 2));
        assert_eq!(extent(&color), share(1, 1));
        assert_eq!(extent(&apply(SizeOp::Mul, &half, &number(6, 6))), share(3, 1));
        assert_eq!(extent(&apply(SizeOp::Max, &half, &number(1, 1))), share(1, 2));
        assert_eq!(
            extent(&apply(SizeOp::Mul, &number(2, 2), &number(0, 8))),
            Some(Extent::Texels(1))
        );
        assert_eq!(extent(&apply(SizeOp::Add, &color, &number(1, 1))), None);
        assert_eq!(extent(&apply(SizeOp::Mul, &color, &number(0, 0))), None);
        assert_eq!(extent(&apply(SizeOp::Max, &color, &of("a"))), None);
    }
}
