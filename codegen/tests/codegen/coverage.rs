//! Coverage of tests, compared with counts by hand.

use std::time::{Duration, Instant};
use straightline_codegen::spec::Settings;
use straightline_codegen::testing::{Coverage, Plan, Test, TestFile, TestKernel, cover_cases};

const KERNEL: &str = "use straightline_kernels::prelude::*;

pub fn sum(x: f32, taps: i32) -> f32 {
    let mut sum = 0.0;
    for k in 0..taps {
        if k % 2 == 0 {
            sum += x;
        } else {
            sum -= x;
        }
    }
    sum
}

fn sign(x: f32) -> f32 {
    if x < 0.0 {
        return -1.0;
    }
    1.0
}

struct Pick;

impl Pick {
    fn value(n: i32) -> f32 {
        match n {
            0 => 0.0,
            1 | 2 => 1.0,
            _ => {
                let many = 3.0;
                many
            }
        }
    }
}

fn unused(x: f32) -> f32 {
    let twice = |y: f32| y + y;
    twice(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_kernels::testing::*;

    #[test]
    fn of_constants() {
        assert_eq!(sum(1.0, 3), 1.0);
    }

    #[test]
    fn of_no_iteration() {
        for_all_in(0..=0, |n: i32| assert_eq!(sum(1.0, n), 0.0));
    }

    #[test]
    fn of_a_return() {
        for_all_in(-1.0..=-1.0, |x: f32| assert_eq!(sign(x), -1.0));
    }

    #[test]
    fn of_an_arm() {
        for_all_in(2..=2, |n: i32| assert!(Pick::value(n) > 0.0));
    }
}
";

/// Counts by hand: 8 cases of each property.
const LCOV: &str = "TN:
SF:kernel.rs
FN:3,sum
FN:15,sign
FN:25,Pick::value
FN:37,unused
FNDA:9,sum
FNDA:8,sign
FNDA:8,Pick::value
FNDA:0,unused
FNF:4
FNH:3
BRDA:5,0,0,3
BRDA:6,1,0,2
BRDA:6,1,1,1
BRDA:16,2,0,8
BRDA:16,2,1,0
BRDA:26,3,0,0
BRDA:26,3,1,8
BRDA:26,3,2,0
BRF:8
BRH:5
DA:3,9
DA:4,9
DA:5,9
DA:6,3
DA:7,2
DA:9,1
DA:12,9
DA:15,8
DA:16,8
DA:17,8
DA:19,0
DA:25,8
DA:26,8
DA:27,0
DA:28,8
DA:30,0
DA:31,0
DA:37,0
DA:38,0
DA:39,0
LF:20
LH:13
end_of_record
";

fn read(text: &str) -> TestFile {
    TestFile::from_text("kernel.rs", text).unwrap_or_else(|errors| panic!("{}", errors.render(false)))
}

/// Coverage by the tests of a file, each compiled by `compile`.
fn cover(file: &TestFile, compile: impl Fn(&Test) -> TestKernel) -> Coverage {
    let plan = Plan {
        cases: 8,
        ..Plan::default()
    };
    let mut coverage = Coverage::new(file).unwrap_or_else(|errors| panic!("{}", errors.render(false)));
    for test in &file.tests {
        let kernel = compile(test);
        let counts = cover_cases(&kernel, &plan.cases_of(test), Instant::now() + Duration::from_secs(20));
        coverage.add(&counts.expect("it runs"));
    }
    coverage
}

fn compile_covered(file: &TestFile, test: &Test) -> TestKernel {
    let kernel = file.compile_covered(test, None, &Settings::default());
    kernel.unwrap_or_else(|errors| panic!("{}", errors.render(false)))
}

#[test]
fn executions_are_those_counted_by_hand() {
    let file = read(KERNEL);
    let coverage = cover(&file, |test| compile_covered(&file, test));
    assert_eq!(coverage.to_lcov(), LCOV);
    let all = coverage.by_file();
    assert_eq!(
        all[0].to_string(),
        "kernel.rs  65.0 % of lines, 5 of 8 branches; not run: 19, 27, 30-39"
    );
}

#[test]
fn unrolled_loops_and_selected_sides_have_the_same_counts() {
    let file = read(KERNEL);
    let unrolled = cover(&file, |test| {
        let covered = Test {
            covered: true,
            ..test.clone()
        };
        let kernel = file.compile_with(&covered, &Settings::default());
        kernel.unwrap_or_else(|errors| panic!("{}", errors.render(false)))
    });
    assert_eq!(unrolled.to_lcov(), LCOV);
}

/// A probe behind every kind of expression, each compared with the counts that rustc would have.
#[test]
fn probes_stand_in_every_kind_of_body() {
    let text = "use straightline_kernels::prelude::*;

pub fn kinds(n: i32) -> f32 {
    let Some(m) = positive(n) else {
        return 0.0;
    };
    let squares: [f32; 3] = std::array::from_fn(|k|
        (k * k) as f32);
    let mut k = 0;
    while k < m {
        k += 1;
        if k == 2 { continue; }
        if k > 3 { break; }
    }
    let chosen = if let 1 = m { 1.0 } else if m > 5 { 2.0 } else { 3.0 };
    let most = squares.iter().copied().fold(0.0, |a: f32, b|
        a.max(b));
    chosen + most + k as f32
}

fn positive(n: i32) -> Option<i32> {
    if n > 0 { Some(n) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_kernels::testing::*;

    #[test]
    fn some() {
        for_all_in(4..=4, |n: i32| assert!(kinds(n) > 0.0));
    }

    #[test]
    fn none() {
        for_all_in(-4..=-4, |n: i32| assert!(kinds(n) == 0.0));
    }
}
";
    let file = read(text);
    let covered = cover(&file, |test| compile_covered(&file, test)).by_file().remove(0);
    let lines = [
        (3, 16),
        (4, 16),
        (5, 8),
        (7, 8),
        (8, 24),
        (9, 8),
        (10, 8),
        (11, 32),
        (12, 32),
        (13, 24),
        (15, 8),
        (16, 8),
        (17, 24),
        (18, 8),
        (21, 16),
        (22, 16),
    ];
    assert_eq!(covered.lines.clone().into_iter().collect::<Vec<_>>(), lines);
    let sides: Vec<(u32, Vec<Option<u64>>)> = covered.branches.into_iter().map(|b| (b.line, b.sides)).collect();
    let of = |counts: &[u64]| counts.iter().map(|count| Some(*count)).collect::<Vec<_>>();
    assert_eq!(
        sides,
        [
            (10, of(&[32])),
            (12, of(&[8, 24])),
            (13, of(&[8, 16])),
            (15, of(&[0, 8])),
            (15, of(&[0, 8])),
            (22, of(&[8, 8])),
        ]
    );
}
