//! Arithmetic on sizes of pictures, as rules in the sizes of inputs.

use crate::front::raw_name;
use straightline_manifest::chain::{SizeOp, SizeRule, SizeTerm};

/// A size that is a constant.
pub fn constant_size(size: [u32; 2]) -> SizeRule {
    SizeRule(vec![SizeTerm::Number(size)].into())
}

/// The constant that a rule is.
pub fn as_constant(rule: &SizeRule) -> Option<[u32; 2]> {
    match &*rule.0 {
        [SizeTerm::Number(size)] => Some(*size),
        _ => None,
    }
}

/// The size that a picture of this rule has: at least one texel.
pub fn size_of_picture(rule: &SizeRule) -> SizeRule {
    match &*rule.0 {
        [SizeTerm::Of(_)] => rule.clone(),
        _ => apply(SizeOp::Max, rule, &constant_size([1, 1])),
    }
}

/// Applies an operation to two sizes. Constants are folded, and operations that change nothing are dropped.
pub fn apply(op: SizeOp, a: &SizeRule, b: &SizeRule) -> SizeRule {
    match (op, as_constant(a), as_constant(b)) {
        (op, Some(a), Some(b)) => constant_size([0, 1].map(|axis: usize| op.apply(a[axis], b[axis]))),
        (SizeOp::Mul | SizeOp::Div, _, Some([1, 1])) | (SizeOp::Add | SizeOp::Sub, _, Some([0, 0])) => a.clone(),
        (SizeOp::Div, _, Some(by)) if by.iter().all(|side| *side >= 2) => divide(a, by),
        _ => SizeRule([&*a.0, &*b.0, &[SizeTerm::Apply(op)]].concat().into()),
    }
}

/// Divides by at least 2: a side of 0 then gives 0 like one of 1, and two divisions in a row are one.
fn divide(a: &SizeRule, by: [u32; 2]) -> SizeRule {
    let a = without_least(a);
    let (dividend, by) = match a {
        [dividend @ .., SizeTerm::Number(before), SizeTerm::Apply(SizeOp::Div)] => (
            dividend,
            [0, 1].map(|axis: usize| before[axis].saturating_mul(by[axis])),
        ),
        _ => (a, by),
    };
    SizeRule(
        [dividend, &[SizeTerm::Number(by), SizeTerm::Apply(SizeOp::Div)]]
            .concat()
            .into(),
    )
}

/// The rule of a picture, which has at least one texel without saying so.
pub fn rule_of_picture(size: &SizeRule) -> SizeRule {
    SizeRule(without_least(size).to_vec().into())
}

/// Terms of a rule without a final `.max(1)`.
fn without_least(rule: &SizeRule) -> &[SizeTerm] {
    match &*rule.0 {
        [terms @ .., SizeTerm::Number([1, 1]), SizeTerm::Apply(SizeOp::Max)] => terms,
        terms => terms,
    }
}

/// The size with the width of `x` and the height of `y`.
pub fn combine_sides(x: &SizeRule, y: &SizeRule) -> SizeRule {
    match (as_constant(x), as_constant(y)) {
        (Some([x, _]), Some([_, y])) => constant_size([x, y]),
        _ if x == y => x.clone(),
        _ => {
            let only = |rule: &SizeRule, mask| apply(SizeOp::Mul, rule, &constant_size(mask));
            apply(SizeOp::Add, &only(x, [1, 0]), &only(y, [0, 1]))
        }
    }
}

/// The rule as Rust of the kernel language.
pub fn as_rust(rule: &SizeRule) -> String {
    let of = |name: &str| Ok(format!("{}.size()", raw_name(name)));
    let number = |[x, y]: [u32; 2]| format!("uvec2({x}, {y})");
    let apply = |op: SizeOp, a: String, b: String| match op {
        SizeOp::Add => format!("({a} + {b})"),
        SizeOp::Sub => format!("({a} - {b})"),
        SizeOp::Mul => format!("({a} * {b})"),
        SizeOp::Div => format!("({a} / {b})"),
        SizeOp::Max => format!("{a}.max({b})"),
        SizeOp::Min => format!("{a}.min({b})"),
    };
    rule.fold(of, number, apply)
        .expect("rules are made of whole operations")
}

/// Inputs that a rule needs.
pub fn inputs_of(rule: &SizeRule) -> impl Iterator<Item = &str> {
    rule.0.iter().filter_map(|term| match term {
        SizeTerm::Of(name) => Some(&**name),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::{apply, constant_size, rule_of_picture, size_of_picture};
    use straightline_manifest::chain::{SizeOp, SizeRule};

    fn halved(rule: &SizeRule) -> SizeRule {
        rule_of_picture(&apply(SizeOp::Div, &size_of_picture(rule), &constant_size([2, 2])))
    }

    #[test]
    fn a_pyramid_has_short_rules() {
        let color = SizeRule::of_input("color");
        let quarter = halved(&halved(&color));
        assert_eq!(quarter.to_string(), "color.size() / 4");
        let twice = apply(SizeOp::Mul, &size_of_picture(&quarter), &constant_size([2, 2]));
        assert_eq!(twice.to_string(), "(color.size() / 4).max(1) * 2");
    }

    #[test]
    fn short_rules_have_the_sizes_of_each_step() {
        let color = SizeRule::of_input("color");
        let (quarter, eighth) = (halved(&halved(&color)), halved(&halved(&halved(&color))));
        for side in 1..40 {
            let size_of = |_: &str| Some([side, 41 - side]);
            let step = |side: u32| (side / 2).max(1);
            let quarters = [side, 41 - side].map(|side| step(step(side)));
            assert_eq!(quarter.evaluate(&size_of), Ok(quarters));
            assert_eq!(eighth.evaluate(&size_of), Ok(quarters.map(step)));
        }
    }
}
