//! Ranges of arguments.

use crate::properties::{Argument, Component, Range};
use std::ops;

/// Values of an argument, of each of its components.
pub trait Domain {
    /// The range.
    fn range(&self) -> Range;
}

impl Domain for Range {
    fn range(&self) -> Range {
        *self
    }
}

/// Any value; of floats any finite one.
pub const fn any() -> Range {
    Range::Any
}

/// Any float, infinities and NaN too.
pub const fn every_float() -> Range {
    Range::EveryFloat
}

/// From 0 to 1, both included.
pub const fn unit() -> Range {
    Range::Between {
        low: 0.0,
        high: 1.0,
        closed: true,
    }
}

macro_rules! ranges {
    ($($number:ty),*) => {$(
        impl Domain for ops::Range<$number> {
            fn range(&self) -> Range {
                Range::Between { low: f64::from(self.start), high: f64::from(self.end), closed: false }
            }
        }

        impl Domain for ops::RangeInclusive<$number> {
            fn range(&self) -> Range {
                Range::Between { low: f64::from(*self.start()), high: f64::from(*self.end()), closed: true }
            }
        }
    )*};
}

ranges!(f32, i32, u32);

/// The ranges of all arguments: one, or a tuple of as many as there are arguments.
pub trait Domains {
    /// The ranges in order.
    fn ranges(&self) -> Vec<Range>;
}

impl<D: Domain> Domains for D {
    fn ranges(&self) -> Vec<Range> {
        vec![self.range()]
    }
}

macro_rules! tuples {
    ($($($name:ident)+;)*) => {$(
        impl<$($name: Domain),+> Domains for ($($name,)+) {
            fn ranges(&self) -> Vec<Range> {
                #[allow(non_snake_case)]
                let ($($name,)+) = self;
                vec![$($name.range()),+]
            }
        }
    )*};
}

tuples! {
    A;
    A B;
    A B C;
    A B C D;
    A B C D E;
    A B C D E F;
}

/// Gives the arguments their ranges.
///
/// # Panics
///
/// If there are more or fewer ranges than arguments, or one does not fit.
#[track_caller]
pub(super) fn apply_ranges(arguments: &mut [Argument], ranges: &[Range]) {
    let (given, taken) = (ranges.len(), arguments.len());
    assert!(given == taken, "{given} ranges for {taken} arguments");
    for (argument, range) in arguments.iter_mut().zip(ranges) {
        argument.range = *range;
        if let Some(error) = argument.range_error() {
            panic!("a range that the argument cannot have: {error}");
        }
        debug_assert!(argument.component != Component::Bool || argument.range == Range::Any);
    }
}
