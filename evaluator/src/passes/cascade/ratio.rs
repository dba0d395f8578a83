//! Relations between the sizes of pictures, by their rules.

use super::footprint::Span;
use straightline_manifest::chain::{SizeOp, SizeRule, SizeTerm};

/// Bound on the first pixel of a workgroup in a picture. In a picture that is read by another one, the workgroup's tile begins at
/// `end` or less: `size - 1 + slack`. The reader's tile begins at its `size - 1 + slack` or less. `None` if nothing is known.
pub fn slack_of_read(read: &SizeRule, reader: &SizeRule, span: &Span, axis: usize, slack: i64) -> Option<i64> {
    if (span.times, span.over) == (1, 1) {
        return (read == reader).then_some(slack);
    }
    let n = span.times.max(span.over);
    if span.times.min(span.over) != 1 {
        return None;
    }
    let (large, small) = match span.over == 1 {
        true => (read, reader),
        false => (reader, read),
    };
    let is_down = is_quotient(small, large, n, axis, false);
    let is_up = is_quotient(small, large, n, axis, true);
    match (span.over == 1, is_down, is_up) {
        // Times the quotient is at most the dividend.
        (true, true, _) => Some((n * slack - n + 1).max(0)),
        (true, _, true) => Some(n * slack),
        (false, true, _) => Some(1 + (n - 2 + slack).div_euclid(n)),
        (false, _, true) => Some(1 + (slack - 1).div_euclid(n)),
        _ => None,
    }
}

/// Returns whether `small` is `large / n` along an axis, rounded down, or up.
fn is_quotient(small: &SizeRule, large: &SizeRule, n: i64, axis: usize, up: bool) -> bool {
    let (mut dividend, divisor) = split(&small.0, axis);
    let (of, before) = split(without_least(&large.0), axis);
    if !up {
        return dividend == of && i64::from(divisor) == i64::from(before) * n;
    }
    match dividend {
        [terms @ .., SizeTerm::Number(more), SizeTerm::Apply(SizeOp::Add)] if i64::from(more[axis]) == n - 1 => {
            dividend = without_least(terms);
        }
        _ => return false,
    }
    dividend == without_least(&large.0) && i64::from(divisor) == n
}

/// Terms of a dividend, and the divisor along an axis.
fn split(terms: &[SizeTerm], axis: usize) -> (&[SizeTerm], u32) {
    match terms {
        [dividend @ .., SizeTerm::Number(by), SizeTerm::Apply(SizeOp::Div)] if by[axis] > 0 => (dividend, by[axis]),
        terms => (terms, 1),
    }
}

/// Terms without a final `.max(1)`, which every picture has.
fn without_least(terms: &[SizeTerm]) -> &[SizeTerm] {
    match terms {
        [terms @ .., SizeTerm::Number([1, 1]), SizeTerm::Apply(SizeOp::Max)] => terms,
        terms => terms,
    }
}
