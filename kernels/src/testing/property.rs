//! Properties: closures that hold for all arguments.

use super::domain::{Domains, apply_ranges};
use super::panics::{Outcome, run_caught};
use super::value::{Bits, Value};
use crate::properties::{Argument, CASES, Case, SEED, case_text, generate_cases, minimise_case};

/// A closure of 1 to 6 arguments.
pub trait Property<Arguments> {
    /// Arguments of the closure.
    fn arguments(&self) -> Vec<Argument>;

    /// Calls the closure.
    fn call(&self, bits: Bits<'_>);
}

macro_rules! closures {
    ($($($name:ident)+;)*) => {$(
        impl<F: Fn($($name),+), $($name: Value),+> Property<($($name,)+)> for F {
            fn arguments(&self) -> Vec<Argument> {
                vec![$($name::ARGUMENT),+]
            }

            fn call(&self, mut bits: Bits<'_>) {
                self($($name::read(&mut bits)),+);
            }
        }
    )*};
}

closures! {
    A;
    A B;
    A B C;
    A B C D;
    A B C D E;
    A B C D E G;
}

/// Asserts that a property holds for all arguments of its types: of floats, for all finite ones.
///
/// # Panics
///
/// If it fails, with the simplest arguments found.
#[track_caller]
pub fn for_all<A>(property: impl Property<A>) {
    check_property(&property, &property.arguments());
}

/// Asserts that a property holds for all arguments in ranges, one range an argument.
///
/// # Panics
///
/// If it fails, with the simplest arguments found, or if a range does not fit its argument.
#[track_caller]
pub fn for_all_in<A>(domains: impl Domains, property: impl Property<A>) {
    let mut arguments = property.arguments();
    apply_ranges(&mut arguments, &domains.ranges());
    check_property(&property, &arguments);
}

#[track_caller]
fn check_property<A>(property: &impl Property<A>, arguments: &[Argument]) {
    let run = |case: &Case| run_caught(|| property.call(Bits(case.iter())));
    let fails = |case: &Case| matches!(run(case), Outcome::Failed(_));
    let cases = generate_cases(arguments, CASES, SEED);
    let mut held = 0;
    for case in &cases {
        match run(case) {
            Outcome::Held => held += 1,
            Outcome::PassedOver => {}
            Outcome::Failed(first) => {
                let least = minimise_case(arguments, case, &mut |cases| cases.iter().map(fails).collect());
                let message = match run(&least) {
                    Outcome::Failed(message) => message,
                    _ => first,
                };
                let named = arguments.iter().enumerate();
                let named: Vec<_> = named.map(|(k, of)| (format!("argument_{k}"), *of)).collect();
                let inputs = case_text(&named, &least).join("\n    ");
                panic!("the property fails for\n    {inputs}\n{message}");
            }
        }
    }
    assert!(held > 0, "`assume` passed over all {} cases", cases.len());
}

#[cfg(test)]
mod tests {
    use super::super::*;
    use crate::prelude::*;

    fn message_of(test: fn()) -> String {
        let payload = std::panic::catch_unwind(test).expect_err("it fails");
        payload.downcast_ref::<String>().cloned().unwrap_or_default()
    }

    #[test]
    fn properties_that_hold_pass() {
        for_all(|x: f32, n: i32, on: bool| assert!(x == 1.0 * x && n.wrapping_add(0) == n && u32::from(on) < 2));
        for_all(|v: Vec3, taps: [f32; 2]| assert_close(v + taps[0], Vec3::splat(taps[0]) + v, ulp(0)));
        for_all_in(
            (0.0..1.0, unit(), 3..=5, every_float()),
            |a: f32, b: Vec2, n: u32, c: f32| {
                assert!((0.0..1.0).contains(&a) && b.max_element() <= 1.0 && (3..=5).contains(&n));
                assume(!c.is_nan());
                assert!(c == c);
            },
        );
    }

    #[test]
    fn a_failure_has_the_simplest_arguments_both_values_and_their_distance() {
        let message = message_of(|| for_all(|x: f32, v: Vec2| assert_close(x.abs() + v.x * 0.0, x, ulp(2))));
        assert!(
            message.starts_with(
                "the property fails for\n    let argument_0: f32 = -1.0;\n    let argument_1 = Vec2::splat(0.0);\n"
            ),
            "{message}"
        );
        assert!(message.contains("property.rs:"), "{message}");
        assert!(
            message.contains("2130706432 ULPs apart\n  left: 1.0\n right: -1.0"),
            "{message}"
        );
    }

    #[test]
    fn wrong_ranges_are_refused() {
        let message = message_of(|| for_all_in((unit(), unit()), |x: f32| assert!(x >= 0.0)));
        assert_eq!(message, "2 ranges for 1 arguments");
        let message = message_of(|| for_all_in(0.5..1.5, |n: i32| assert!(n >= 0)));
        assert!(message.contains("integers take a range of integers"), "{message}");
        let message = message_of(|| for_all(|x: f32| assume(x.is_nan())));
        assert_eq!(message, "`assume` passed over all 256 cases");
    }
}
