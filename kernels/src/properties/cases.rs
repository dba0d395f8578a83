//! Generation of cases: edges first, then random values of a fixed seed.

use super::argument::{Argument, Component, Range};

/// The bits of all components of all arguments, in order.
pub type Case = Vec<u32>;

/// Number of cases of a property, by default.
pub const CASES: usize = 256;

/// Seed of the random values, by default.
pub const SEED: u64 = 1;

/// Values of a float at which functions go wrong: zeros, ones, the limits of normal numbers, powers of two.
const FLOATS: [f32; 20] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    f32::MIN_POSITIVE,
    1.0e-40,
    f32::MAX,
    f32::MIN,
    -f32::MIN_POSITIVE,
    -1.0e-40,
    f32::EPSILON,
    1.0 - f32::EPSILON / 2.0,
    1.0 + f32::EPSILON,
    0.25,
    1024.0,
    16_777_216.0,
    4_294_967_296.0,
    -2_147_483_648.0,
];

const NOT_FINITE: [f32; 3] = [f32::INFINITY, f32::NEG_INFINITY, f32::NAN];

const SIGNED: [i32; 12] = [0, 1, -1, 2, -2, 7, 31, 32, 1 << 16, i32::MAX, i32::MIN, i32::MIN + 1];

const UNSIGNED: [u32; 10] = [0, 1, 2, 7, 31, 32, 1 << 16, 1 << 31, i32::MAX as u32, u32::MAX];

/// Generates cases, the same for the same arguments, number and seed.
///
/// First all components have one edge after the other, then an eighth of the cases have a random edge in each component.
pub fn generate_cases(arguments: &[Argument], count: usize, seed: u64) -> Vec<Case> {
    let mut random = Random(seed);
    let edges: Vec<Vec<u32>> = arguments.iter().map(edges_of).collect();
    let longest = edges.iter().map(Vec::len).max().unwrap_or(0);
    let mut cases = Vec::with_capacity(count);
    for k in 0..count {
        let mut case = Case::new();
        // A case has values of one kind: a condition on all arguments together is then met often.
        let kind = random.below(4);
        for (argument, edges) in arguments.iter().zip(&edges) {
            for _ in 0..argument.component_count() {
                case.push(match k {
                    k if k < longest => edges[k % edges.len()],
                    k if k < longest + count / 8 => edges[random.below(edges.len())],
                    _ => random_component(argument, edges, kind, &mut random),
                });
            }
        }
        cases.push(case);
    }
    cases
}

/// Edges of a component that its range includes; never empty.
fn edges_of(argument: &Argument) -> Vec<u32> {
    let mut edges: Vec<u32> = match argument.component {
        Component::F32 => FLOATS.iter().chain(&NOT_FINITE).map(|x| x.to_bits()).collect(),
        Component::I32 => SIGNED.map(|n| n as u32).to_vec(),
        Component::U32 => UNSIGNED.to_vec(),
        Component::Bool => vec![0, 1],
    };
    if let (Range::Between { .. }, Some((low, high))) = (argument.range, argument.bounds()) {
        let ends = [low, high, low / 2.0 + high / 2.0];
        edges.splice(0..0, ends.map(|end| argument.component.bits(end)));
    }
    edges.retain(|bits| argument.includes(*bits));
    if edges.is_empty() {
        edges.push(0);
    }
    let mut seen = Vec::new();
    edges.retain(|bits| {
        !seen.contains(bits) && {
            seen.push(*bits);
            true
        }
    });
    edges
}

fn random_component(argument: &Argument, edges: &[u32], kind: usize, random: &mut Random) -> u32 {
    let component = argument.component;
    if let (Range::Between { .. }, Some((low, high))) = (argument.range, argument.bounds()) {
        let value = low + (high - low) * random.unit();
        let value = if component == Component::F32 {
            value
        } else {
            value.round()
        };
        return component.bits(value.clamp(low, high));
    }
    let bits = match (component, kind) {
        (Component::Bool, _) => random.below(2) as u32,
        (Component::F32, 0) => (random.unit() as f32).to_bits(),
        (Component::F32, 1) => ((random.unit() as f32 * 2.0 - 1.0) * 64.0).to_bits(),
        (Component::I32, 0 | 1) => (random.below(201) as i32 - 100) as u32,
        (Component::U32, 0 | 1) => random.below(101) as u32,
        _ => random.next() as u32,
    };
    match argument.includes(bits) {
        true => bits,
        false => edges[random.below(edges.len())],
    }
}

/// SplitMix64, by Steele, Lea and Flood.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (((self.next() >> 32) * end as u64) >> 32) as usize
    }

    /// A number from 0 to below 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_the_same_each_time_and_within_their_ranges() {
        let unit = Range::Between {
            low: 0.0,
            high: 1.0,
            closed: false,
        };
        let arguments = [
            Argument {
                range: unit,
                ..Argument::new(Component::F32, 3)
            },
            Argument::new(Component::F32, 1),
            Argument {
                range: Range::Between {
                    low: -3.0,
                    high: 5.0,
                    closed: true,
                },
                ..Argument::new(Component::I32, 2)
            },
            Argument::new(Component::Bool, 1),
        ];
        let cases = generate_cases(&arguments, CASES, SEED);
        assert_eq!(cases, generate_cases(&arguments, CASES, SEED));
        assert_ne!(cases, generate_cases(&arguments, CASES, SEED + 1));
        for case in &cases {
            assert_eq!(case.len(), 7);
            let each = [0, 0, 0, 1, 2, 2, 3].map(|k| &arguments[k]);
            assert!(each.iter().zip(case).all(|(of, bits)| of.includes(*bits)), "{case:?}");
        }
        // Both ends of a range are cases.
        assert!(cases.iter().any(|case| case[0] == 0));
        assert!(cases.iter().any(|case| f32::from_bits(case[0]) == 1.0f32.next_down()));
        assert!(cases.iter().any(|case| case[4] as i32 == -3) && cases.iter().any(|case| case[4] == 5));
    }

    #[test]
    fn infinities_and_nan_are_there_on_request() {
        let of = |range| Argument {
            range,
            ..Argument::new(Component::F32, 1)
        };
        let has = |range, is: fn(f32) -> bool| {
            let cases = generate_cases(&[of(range)], CASES, SEED);
            cases.iter().any(|case| is(f32::from_bits(case[0])))
        };
        assert!(!has(Range::Any, |x| !x.is_finite()));
        assert!(has(Range::EveryFloat, f32::is_nan) && has(Range::EveryFloat, f32::is_infinite));
        assert!(has(Range::Any, |x| x.is_subnormal()) && has(Range::Any, |x| x == f32::MAX));
    }
}
