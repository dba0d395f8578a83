//! Loops that are unrolled because a constant is needed that they assign: which, why, and at what cost.

use std::sync::Arc;
use straightline_evaluator::diagnostic::{Errors, File};
use straightline_evaluator::eval::{Evaluated, evaluate_kernel};
use straightline_evaluator::ir::Invocation;
use straightline_evaluator::limits::{Limits, Meter};
use straightline_evaluator::policy::{Policy, Unroll};
use straightline_evaluator::{front, infer};

/// A kernel with statements in the middle, which may read `n`, and write `s` and `m`.
fn kernel(functions: &str, body: &str) -> String {
    format!(
        "{functions}
pub fn k(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {{
    let mut s = color.load(pixel).x;
    let mut m = 0;
    {body}
    vec4(s, m as f32, 0.0, 1.0)
}}
"
    )
}

/// Evaluates the kernel `k` of a text, with the work that it takes.
fn evaluated(text: &str, unroll: Unroll) -> (Result<Evaluated, Errors>, u64) {
    let path = "k.rs".to_owned();
    let text = text.to_owned();
    let files = Arc::new(vec![File { path, text }]);
    let mut parsed = front::parse(&files, "k").unwrap_or_else(|e| panic!("{e}"));
    let mistyped = infer::infer_types(&mut parsed.library, &parsed.reached)
        .err()
        .unwrap_or_default();
    let wrong = [parsed.errors, mistyped].concat();
    assert!(wrong.is_empty(), "{}", Errors::new(wrong, &files));
    let policy = Policy {
        unroll,
        ..Policy::default()
    };
    let meter = Meter::open(Limits::DEFAULT);
    let found = evaluate_kernel(&parsed.library, &files, "k", &[], &policy, Invocation::Pixel);
    (found, meter.work())
}

/// Fates of the loops in order of the source, such as `k.i none`.
fn fates(text: &str, unroll: Unroll) -> Vec<String> {
    let found = evaluated(text, unroll).0.unwrap_or_else(|e| panic!("{e}\n{text}"));
    let fates = found.loops.iter();
    fates
        .map(|report| format!("{} {}", report.policy_path(), report.unroll))
        .collect()
}

/// Functions that kernels share.
const FUNCTIONS: &str = "
fn sum(list: [i32; 3]) -> i32 {
    let mut sum = 0;
    for t in 0..3 { sum += list[t]; }
    sum
}
fn power(x: f32, n: i32) -> f32 { x.powi(n) }
struct Pair { a: f32, b: f32 }
fn down(n: i32) -> f32 { if n <= 0 { 1.0 } else { 0.5 * down(n - 1) } }
";

/// Statements of kernels, and what becomes of their loops where all are asked to be left in the shader.
const CASES: &[(&str, &[&str])] = &[
    // No constant is needed.
    ("for i in 0..3 { m += i; } s += m as f32;", &["k.i none"]),
    // The loop that assigns it is unrolled, and no other.
    (
        "for i in 0..3 { m += i; } for j in 0..3 { s += j as f32; } s = s.powi(m);",
        &["k.i full", "k.j none"],
    ),
    // All loops that it comes from, and what they start from.
    (
        "for i in 0..3 { m += i; } for j in 0..3 { s += 0.5; } for l in 0..3 { m += l; } s = s.powi(m);",
        &["k.i full", "k.j none", "k.l full"],
    ),
    // Another variable of the same loop comes from one before it.
    (
        "let mut a = 0; for i in 0..3 { a += i; }
         for j in 0..3 { m += j; a += 1; } s = s.powi(m) + a as f32;",
        &["k.i none", "k.j full"],
    ),
    // A loop in a function that has returned, and a demand in a function.
    ("s += power(s, sum([1, 0, 2]));", &["sum.t full"]),
    (
        "for j in 0..3 { s += 0.5; } let p = sum([1, 0, 2]); s += power(s, p);",
        &["sum.t full", "k.j none"],
    ),
    // A loop in a closure.
    (
        "let f = |x: i32| { let mut y = x; for i in 0..3 { y += i; } y }; s = s.powi(f(1));",
        &["k.i full"],
    ),
    // A need of the loop's own counter, and of that of the loop around.
    ("for i in 1..3 { s += s.powi(i); }", &["k.i full"]),
    (
        "for i in 1..3 { for j in 0..3 { s += j as f32; } s = s.powi(i); }",
        &["k.i full", "k.j none"],
    ),
    (
        "for i in 1..3 { for j in 0..3 { s = s.powi(i + j); } }",
        &["k.i full", "k.j full"],
    ),
    // A loop inside of one that stays.
    (
        "for i in 0..n { let mut p = 0; for j in 0..3 { p += j; } s += s.powi(p); }",
        &["k.i none", "k.j full"],
    ),
    // The bounds of the loop that needs it.
    (
        "for i in 0..3 { m += i; } for j in 0..m { s += s.powi(j); }",
        &["k.i full", "k.j full"],
    ),
    // A `while`, by what it assigns and by its end.
    ("while m < 4 { m += 1; s += 0.5; } s = s.powi(m);", &["k.while none"]),
    (
        "let mut p = 0; while m < 4 { m += 1; p += m; if s > 9.0 { break; } } s = s + p as f32;",
        &["k.while none"],
    ),
    (
        "for i in 0..3 { m += i; } let mut p = 0; while p < m { p += 1; s += s.powi(p); }",
        &["k.i full", "k.while full"],
    ),
    // A need after an exit.
    (
        "for i in 0..3 { m += i; } if s > 1.0 { return vec4(1.0, 1.0, 1.0, 1.0); } s = s.powi(m);",
        &["k.i full"],
    ),
    // A condition between values of two shapes, a recursion, and an element of an array of structures.
    (
        "for i in 0..3 { m += i; } let f = [1.0, 2.0]; s += if m == 3 { f } else { [0.5, s] }[0];",
        &["k.i none"],
    ),
    ("for i in 0..3 { m += i; } s += down(m);", &["k.i full"]),
    // A bound of an iterator is a runtime value, unless all values are needed at once.
    (
        "for i in 1..3 { m += i; } s += (0..m).map(|x| x as f32).sum::<f32>();",
        &["k.i none", "__Lazy::sum.x none"],
    ),
    (
        "for i in 1..3 { m += i; } s += (0..m).chain(0..9).map(|x| x as f32).sum::<f32>();",
        &["k.i full"],
    ),
];

#[test]
fn loops_that_a_constant_depends_on_are_unrolled_and_no_others() {
    for (body, expected) in CASES {
        let text = kernel(FUNCTIONS, body);
        let mut expected: Vec<&str> = expected.to_vec();
        let mut found = fates(&text, Unroll::None);
        expected.sort_unstable();
        found.sort_unstable();
        assert_eq!(found, expected, "{body}");
        // Partly unrolled, the same loops are.
        let found = fates(&text, Unroll::Partial(2));
        for (found, expected) in found.iter().zip(fates(&text, Unroll::None)) {
            let stays = expected.ends_with("none");
            assert!(stays || found.ends_with("full"), "{body}: {found}, not {expected}");
        }
    }
}

#[test]
fn reports_name_the_value_its_place_and_the_need() {
    let text = kernel(FUNCTIONS, "for i in 0..3 { m += i; }\n    s = s.powi(m);");
    let found = evaluated(&text, Unroll::None).0.unwrap_or_else(|e| panic!("{e}"));
    let reason = found.loops[0].reason.as_deref();
    let line = text.lines().position(|line| line.contains("s.powi(m)")).unwrap_or(0) + 1;
    let expected = format!(
        "`s.powi(m)` needs a compile-time constant at k.rs:{line}, and this loop assigns it: \
         the power of `powi` must be a compile-time constant"
    );
    assert_eq!(reason, Some(expected.as_str()));
}

/// Statements of kernels with a loop whose end is a runtime value, with the reason for which it stays.
const RUNTIME_ENDS: &[(&str, &str)] = &[
    (
        "for i in 0..n * 2 { m += i; }",
        "`n * 2` at k.rs:LINE is a runtime value, as it depends on the uniform `n`",
    ),
    (
        "for i in (n..4).rev().step_by(2) { m += i; }",
        "`n` at k.rs:LINE is a runtime value, as it depends on the uniform `n`",
    ),
    (
        "let list = [1, 2, 3]; for x in list { for i in 0..=(x + pixel.x).min(n) { m += i; } }",
        "`(x + pixel.x).min(n)` at k.rs:LINE is a runtime value, as it depends on the pixel's position and the uniform `n`",
    ),
    (
        "while s < 1.0 { s = s * 1.5 + 0.1; m += 1; }",
        "`s < 1.0` at k.rs:LINE is a runtime value, as it depends on texels of `color`",
    ),
    (
        "loop { m += 1; if m > color.size().x { break; } }",
        "`m > color.size().x` at k.rs:LINE is a runtime value, as it depends on the size of the frame",
    ),
];

#[test]
fn reports_name_the_value_that_ends_a_loop_at_run_time() {
    for (body, expected) in RUNTIME_ENDS {
        let text = kernel("", body);
        let found = evaluated(&text, Unroll::Full).0.unwrap_or_else(|e| panic!("{e}"));
        let line = text.lines().position(|line| line.contains(body)).unwrap_or(0) + 1;
        let reasons: Vec<&str> = found
            .loops
            .iter()
            .filter_map(|report| report.reason.as_deref())
            .collect();
        assert_eq!(reasons, [expected.replace("LINE", &line.to_string())], "{body}");
    }
}

#[test]
fn errors_between_a_loop_and_the_need_are_told_once() {
    let text = kernel(
        FUNCTIONS,
        "for i in 0..3 { m += i; } assert!(n == 2, \"two\"); s = s.powi(m); assert!(n == 3, \"three\");",
    );
    let errors = evaluated(&text, Unroll::None)
        .0
        .err()
        .map(|errors| errors.diagnostics.len());
    assert_eq!(errors, Some(2));
}

/// A part of a kernel for each number.
type Part = fn(usize) -> String;

/// No part.
fn nothing(_: usize) -> String {
    String::new()
}

/// Kernels of parts with a loop that can be left in the shader, and then of other parts.
const GROWING: [(&str, Part, Part); 7] = [
    (
        "loops without a need",
        |k| format!("for i{k} in 0..4 {{ s += i{k} as f32; }}\n"),
        nothing,
    ),
    (
        "a need after each",
        |k| format!("let mut p{k} = 0; for i{k} in 0..4 {{ p{k} += i{k}; }} s = s.powi(p{k});\n"),
        nothing,
    ),
    (
        "a need of all at the end",
        |k| format!("for i{k} in 0..4 {{ m += i{k}; }}\n"),
        |k| {
            if k == 0 {
                "s = s.powi(m % 5);".to_owned()
            } else {
                String::new()
            }
        },
    ),
    (
        "a need of each at the end",
        |k| format!("let mut p{k} = 0; for i{k} in 0..4 {{ p{k} += i{k}; }}\n"),
        |k| format!("s = s.powi(p{k});\n"),
    ),
    (
        "a need of each after an exit",
        |k| format!("let mut p{k} = 0; for i{k} in 0..4 {{ p{k} += i{k}; }}\n"),
        |k| match k {
            0 => "if s > 9.0 { return vec4(s, s, s, s); } s = s.powi(p0);\n".to_owned(),
            k => format!("s = s.powi(p{k});\n"),
        },
    ),
    (
        "a need in a function",
        |_| "s += power(s, sum([1, 0, 2]));\n".to_owned(),
        nothing,
    ),
    (
        "loops in a loop",
        |k| format!("for i{k} in 0..n {{ for j{k} in 1..4 {{ s += s.powi(j{k}); }} }}\n"),
        nothing,
    ),
];

#[test]
fn work_grows_as_the_number_of_loops_does() {
    for (name, part, then) in GROWING {
        let works: Vec<u64> = [5, 10, 20, 40]
            .into_iter()
            .map(|count| {
                let body: String = (0..count).map(part).chain((0..count).map(then)).collect();
                let (found, work) = evaluated(&kernel(FUNCTIONS, &body), Unroll::None);
                found.unwrap_or_else(|e| panic!("{name}: {e}"));
                work
            })
            .collect();
        println!("{name}: {works:?}");
        // Twice as many further loops take twice as much further work.
        let further = [works[2] - works[1], works[3] - works[2]];
        assert!(further[1] <= further[0] * 21 / 10, "{name}: {works:?}");
    }
}
