//! Minimisation of a failing case: each component becomes 0, 1 or a round number where the case still fails.

use super::argument::{Argument, Component};
use super::cases::Case;

/// Rounds after which minimisation ends.
const MOST_ROUNDS: usize = 40;

/// Returns a simpler case that still fails, or `case` itself. `fails` runs several cases at once, in order.
pub fn minimise_case(arguments: &[Argument], case: &Case, fails: &mut dyn FnMut(&[Case]) -> Vec<bool>) -> Case {
    let owners: Vec<&Argument> = arguments
        .iter()
        .flat_map(|argument| std::iter::repeat_n(argument, argument.component_count()))
        .collect();
    let mut best = case.clone();
    for _ in 0..MOST_ROUNDS {
        let before = best.clone();
        let with = |component: usize, bits: u32| {
            let mut case = before.clone();
            case[component] = bits;
            case
        };
        // All components at once, so that those that must be alike get simpler together.
        let mut candidates = Vec::new();
        for (component, argument) in owners.iter().enumerate() {
            for bits in simpler_components(argument, before[component]) {
                candidates.push(with(component, bits));
                let same = |k: usize| before[k] == before[component] && owners[k].includes(bits);
                let together = (0..before.len()).map(|k| if same(k) { bits } else { before[k] });
                candidates.push(together.collect());
            }
        }
        candidates.sort_by_key(|case| cost_of(&owners, case));
        candidates.dedup();
        let failed = fails(&candidates);
        if let Some((simplest, _)) = candidates.into_iter().zip(failed).find(|(_, failed)| *failed) {
            best = simplest;
        }
        if best == before {
            break;
        }
    }
    best
}

type Cost = (usize, usize, bool, u64);

fn cost_of(owners: &[&Argument], case: &Case) -> Vec<Cost> {
    let mut costs: Vec<Cost> = owners
        .iter()
        .zip(case)
        .map(|(argument, bits)| component_cost(argument.component, *bits))
        .collect();
    // The worst component first: two simple ones are simpler than one of each kind.
    costs.sort_by(|a, b| b.cmp(a));
    costs
}

/// Cost of a component: 0 and 1 first, then by the number of digits, the sign, and the distance from 1.
fn component_cost(component: Component, bits: u32) -> Cost {
    let value = component.value(bits);
    match component {
        Component::F32 => {
            let x = f32::from_bits(bits);
            let class = match x {
                _ if bits == 0 => 0,
                1.0 => 1,
                _ if x.is_finite() => 2,
                _ => 3,
            };
            let distance = if x == 0.0 { 0.0 } else { x.abs().log2().abs() };
            // 120 is rounder than 123, since `1.2e2` has fewer digits than `1.23e2`.
            let text = format!("{:e}", x.abs());
            let digits = text.find('e').unwrap_or(text.len());
            (class, digits, x.is_sign_negative(), distance as u64)
        }
        _ => {
            let class = (value.abs() as usize).min(2);
            (class, 0, value < 0.0, value.abs() as u64)
        }
    }
}

/// Values in the range of a component that are simpler than its own.
fn simpler_components(argument: &Argument, bits: u32) -> Vec<u32> {
    let component = argument.component;
    let value = component.value(bits);
    let mut values = vec![0.0, 1.0];
    match component {
        Component::F32 => {
            values.extend([-1.0, 0.5, 2.0, -value, value.trunc(), value / 2.0, value / 10.0]);
            for digits in 0..6 {
                values.extend(format!("{value:.digits$e}").parse::<f64>());
            }
            if value != 0.0 && value.is_finite() {
                values.push(value.abs().log2().floor().exp2().copysign(value));
            }
        }
        Component::I32 | Component::U32 => {
            values.extend([-1.0, -value, (value / 10.0).trunc()]);
            values.extend((1..32).map(|k| value - (value / 2f64.powi(k)).trunc()));
            values.push(value - value.signum());
        }
        Component::Bool => {}
    }
    let own = component_cost(component, bits);
    let fits = |bits: &u32| argument.includes(*bits) && component_cost(component, *bits) < own;
    let mut simpler: Vec<u32> = values.into_iter().map(|v| component.bits(v)).filter(fits).collect();
    simpler.sort_by_key(|bits| component_cost(component, *bits));
    simpler.dedup();
    simpler
}

#[cfg(test)]
mod tests {
    use super::*;

    fn minimised(arguments: &[Argument], case: &[u32], fails: fn(&[u32]) -> bool) -> Case {
        minimise_case(arguments, &case.to_vec(), &mut |cases| {
            cases.iter().map(|case| fails(case)).collect()
        })
    }

    #[test]
    fn components_become_zero_one_or_round() {
        let pair = [Argument::new(Component::F32, 2)];
        let case = [123.456f32, -0.789].map(f32::to_bits);
        let negative = minimised(&pair, &case, |case| f32::from_bits(case[1]) < 0.0);
        assert_eq!(negative, [0.0f32, -1.0].map(f32::to_bits));
        let large = minimised(&pair, &case, |case| f32::from_bits(case[0]) > 100.0);
        assert_eq!(large[1], 0);
        assert!(f32::from_bits(large[0]) <= 120.0, "{}", f32::from_bits(large[0]));
    }

    #[test]
    fn integers_go_to_the_first_that_fails() {
        let one = [Argument::new(Component::U32, 1)];
        assert_eq!(minimised(&one, &[u32::MAX], |case| case[0] >= 1000), [1000]);
        let signed = [Argument::new(Component::I32, 1)];
        assert_eq!(
            minimised(&signed, &[i32::MIN as u32], |case| (case[0] as i32) < 0),
            [-1i32 as u32]
        );
    }

    #[test]
    fn a_case_stays_in_its_range() {
        let range = super::super::Range::Between {
            low: 3.0,
            high: 9.0,
            closed: true,
        };
        let one = [Argument {
            range,
            ..Argument::new(Component::I32, 1)
        }];
        assert_eq!(minimised(&one, &[8], |_| true), [3]);
    }
}
