//! Tests of kernels' files that run as shaders.

use std::time::{Duration, Instant};
use straightline_codegen::Stage;
use straightline_codegen::diagnostic::{Code, Errors};
use straightline_codegen::spec::{EmitOptions, Settings};
use straightline_codegen::testing::{
    Case, Failure, ImageSource, Outcome, Plan, Runner, RunnerError, TestFile, TestKernel, Verdict, check_test,
    interpret_cases,
};

/// A file with a kernel's functions and one test of this body.
fn file_with(functions: &str, body: &str) -> String {
    format!(
        "use straightline_kernels::prelude::*;\n\n{functions}\n\n#[cfg(test)]\nmod tests {{\n    use super::*;\n    \
         use straightline_kernels::testing::*;\n\n    #[test]\n    fn holds() {{\n        {body}\n    }}\n}}\n"
    )
}

fn compile(text: &str) -> Result<TestKernel, Errors> {
    let file = TestFile::from_text("kernel.rs", text)?;
    assert_eq!(file.tests.len(), 1, "{text}");
    file.compile(&file.tests[0])
}

fn verdict(functions: &str, body: &str) -> Verdict {
    let text = file_with(functions, body);
    let kernel = compile(&text).unwrap_or_else(|errors| panic!("{}", errors.render(false)));
    // Every kernel of a test is valid in every language.
    let emitted = kernel.compiled.emit(&EmitOptions::default());
    emitted.unwrap_or_else(|errors| panic!("{}", errors.render(false)));
    check_test(&kernel, &Plan::default(), None)
}

#[track_caller]
fn failure(functions: &str, body: &str) -> Failure {
    match verdict(functions, body) {
        Verdict::Failed(failure) => *failure,
        Verdict::Passed(passed) => panic!("{body} passes: {passed:?}"),
    }
}

#[track_caller]
fn assert_passes(functions: &str, body: &str) {
    if let Verdict::Failed(failure) = verdict(functions, body) {
        panic!("{}", failure.errors.render(false));
    }
}

const LUMA: &str = "pub fn luma(color: Vec3) -> f32 {\n    color.dot(vec3(0.2126, 0.7152, 0.0722))\n}";

#[test]
fn properties_that_hold_pass() {
    assert_passes(
        LUMA,
        "for_all(|grey: f32| assert_close(luma(Vec3::splat(grey)), grey, ulp(2)));",
    );
    assert_passes(
        "pub fn taps(radius: usize) -> usize { 3 * radius }",
        "assert_eq!(taps(3), 9);",
    );
    assert_passes(
        "",
        "for_all_in((unit(), -4..=4), |x: Vec2, n: IVec3| { assert!(x.x <= 1.0); assert!(n.y >= -4); });",
    );
    assert_passes(
        "",
        "for_all(|on: bool, taps: [f32; 3]| { let x = if on { taps[2] } else { taps[1] }; assert!(x.is_finite()); });",
    );
    assert_passes(
        "",
        "for_all(|a: f32, b: f32| { assume(a <= b); assert!(a.max(b) == b); });",
    );
}

#[test]
fn a_failure_has_place_inputs_and_values() {
    let found = failure(
        LUMA,
        "for_all(|grey: f32| assert_close(luma(Vec3::splat(grey)), grey + 1.0, ulp(2)));",
    );
    let text = found.errors.render(false);
    assert_eq!(found.inputs, ["let grey: f32 = 0.0;"]);
    assert_eq!(found.values, [Some("0.0".to_owned()), Some("1.0".to_owned())]);
    assert_eq!(found.ulps, Some(1_065_353_216));
    assert!(
        text.starts_with("error[E0511]: `tests::holds` fails by the interpreter, f32\n"),
        "{text}"
    );
    assert!(text.contains("kernel.rs:14:29"), "{text}");
    assert!(
        text.contains("`luma(Vec3::splat(grey))` is 0.0, `grey + 1.0` is 1.0"),
        "{text}"
    );
    assert!(text.contains("interpreter, f64: fails with the same values"), "{text}");
}

#[test]
fn faults_that_people_make_are_found_with_simple_inputs() {
    // `powf` of a negative number.
    let gamma = "pub fn encode(x: f32) -> f32 { x.powf(2.5) }";
    let found = failure(
        gamma,
        "for_all(|x: f32| { assume(x < 100.0); assert!(!encode(x).is_nan()); });",
    );
    assert_eq!(found.inputs, ["let x: f32 = -1.0;"]);
    // Overflow of an intermediate value.
    let length = "pub fn size(v: Vec2) -> f32 { v.length() }";
    let found = failure(length, "for_all(|v: Vec2| assert!(size(v).is_finite()));");
    assert!(found.errors.render(false).contains("`size(v)` is f32::INFINITY"));
    // Rounding to even against rounding up.
    let found = failure(
        "",
        "for_all_in(0.0..100.0, |x: f32| assert_eq!(x.round_ties_even(), (x + 0.5).floor()));",
    );
    assert_eq!(found.inputs, ["let x: f32 = 0.5;"]);
    // Integers that wrap.
    let found = failure("", "for_all(|n: u32| assert!(n.wrapping_mul(2) >= n));");
    assert_eq!(found.inputs, ["let n: u32 = 2147483648;"]);
    // A NaN that a comparison lets through.
    let found = failure(
        "",
        "for_all_in(every_float(), |x: f32| { let y = if x < 0.0 { 0.0 } else { x }; assert!(y >= 0.0); });",
    );
    assert_eq!(found.inputs, ["let x: f32 = f32::NAN;"]);
    // A branch for one case alone.
    let found = failure(
        "",
        "for_all(|n: IVec2, on: bool| assert!(!(on && n.x > 30 && n.y < 0)));",
    );
    assert_eq!(found.inputs, ["let n = ivec2(31, -1);", "let on = true;"]);
}

#[test]
fn assertions_of_called_functions_and_loops_count() {
    let helper = "fn checked(x: f32) -> f32 {\n    debug_assert!(x <= 8.0, \"{x} is large\");\n    x\n}";
    let found = failure(helper, "for_all_in(0.0..16.0, |x: f32| assert!(checked(x) >= 0.0));");
    let text = found.errors.render(false);
    assert!(text.contains("kernel.rs:4:5") && text.contains("`x` is "), "{text}");
    let found = failure("", "for_all_in(0..10, |n: i32| { for k in 0..n { assert!(k < 7); } });");
    assert_eq!(found.inputs, ["let n: i32 = 8;"]);
    assert_eq!(found.values[0].as_deref(), Some("7"));
    // The first that fails is reported.
    let found = failure("", "for_all_in(1..10, |n: i32| { assert!(n < 1); assert!(n < 0); });");
    assert_eq!(found.values[1].as_deref(), Some("1"));
}

#[test]
fn the_first_operation_in_which_f32_and_f64_part_is_named() {
    let variance = "pub fn variance(a: f32, b: f32) -> f32 {\n    let mean = (a + b) / 2.0;\n    \
                    let squares = (a * a + b * b) / 2.0;\n    let spread = squares - mean * mean;\n    spread\n}";
    let body = "for_all_in((1000.0..1001.0, 0.5..1.0), |a: f32, d: f32| assert_close(variance(a, a + d), d * d / 4.0, relative(0.01)));";
    let text = failure(variance, body).errors.render(false);
    assert!(text.contains("interpreter, f64: all assertions hold"), "{text}");
    assert!(text.contains("f32 and f64 part first in `sub`: `spread` is "), "{text}");
    assert!(text.contains("at kernel.rs:6"), "{text}");
}

#[test]
fn tests_of_other_forms_are_refused_with_their_place_and_help() {
    for (body, what, help) in [
        (
            "for_all(|x| assert!(x > 0.0));",
            "an argument of a property without a type",
            "write its type: `|x: f32|`",
        ),
        (
            "for_all(|x: f64| assert!(x > 0.0));",
            "an argument of the type `f64`",
            "take f32, i32, u32, bool",
        ),
        (
            "for_all(check);",
            "a property that is no closure",
            "write `|x: f32| property(x)`",
        ),
        (
            "for_all(|x: f32| assert!(x > 0.0)); for_all(|x: f32| assert!(x > 0.0));",
            "a second property",
            "a test of its own",
        ),
        (
            "if true { for_all(|x: f32| assert!(x > 0.0)); }",
            "`for_all` here",
            "a statement of the test itself",
        ),
        (
            "for_all_in(low..high, |x: f32| assert!(x > 0.0));",
            "a range that is not written out",
            "`unit()`",
        ),
        (
            "for_all_in(0.5..1.0, |n: i32| assert!(n > 0));",
            "a range that the argument cannot have",
            "integers",
        ),
        (
            "for_all_in((unit(), unit()), |x: f32| assert!(x > 0.0));",
            "2 ranges for 1 arguments",
            "one range an argument",
        ),
        (
            "for_all(|x: f32| println!(\"{x}\"));",
            "a macro other than",
            "write out",
        ),
    ] {
        let errors = compile(&file_with("", body)).expect_err(body);
        let text = errors.render(false);
        assert!(text.contains(what) && text.contains(help), "{body}\n{text}");
        assert!(errors.diagnostics[0].span.is_some(), "{text}");
    }
    let of = |test: &str| {
        let file = TestFile::from_text("kernel.rs", test).expect("it is Rust");
        file.compile(&file.tests[0]).expect_err(test).render(false)
    };
    assert!(of("#[test] fn t() -> Result<(), ()> { Ok(()) }").contains("a test with a result"));
    assert!(of("#[test] #[should_panic] fn t() { assert!(false); }").contains("`#[should_panic]`"));
}

#[test]
fn files_without_tests_and_texts_that_are_no_rust() {
    assert!(TestFile::from_text("k.rs", "pub fn f() -> f32 { 1.0 }").is_ok_and(|file| file.tests.is_empty()));
    let errors = TestFile::from_text("k.rs", "#[test] fn f( {").expect_err("no Rust");
    assert_eq!(errors.first_code(), Some(Code::Syntax));
}

#[test]
fn a_test_that_checks_nothing_or_takes_too_long_fails() {
    let found = failure(
        "",
        "for_all_in(unit(), |x: f32| { assume(x > 2.0); assert!(x > 3.0); });",
    );
    assert!(
        found
            .errors
            .render(false)
            .contains("`assume` passes over all 256 cases")
    );
    // Up to 2^32 iterations.
    let body = "for_all(|n: u32| { let mut x = n; for k in 0..n { x = x.wrapping_mul(3) ^ k; } assert!(x < 9); });";
    let kernel = compile(&file_with("", body)).unwrap_or_else(|errors| panic!("{}", errors.render(false)));
    for (time, why) in [
        (0, "the interpreter ran out of time"),
        (60, "a case has more than 16777216 iterations"),
    ] {
        let plan = Plan {
            time: Duration::from_secs(time),
            ..Plan::default()
        };
        let Verdict::Failed(found) = check_test(&kernel, &plan, None) else {
            panic!("it passes");
        };
        let text = found.errors.render(false);
        assert!(text.contains("could not be run") && text.contains(why), "{text}");
    }
}

#[test]
fn names_under_cfg_test_are_there_and_others_are_not() {
    let text = "#[cfg(not(test))]\npub const LIMIT: f32 = 1.0;\n#[cfg(test)]\npub const LIMIT: f32 = 2.0;\n\
                pub fn limit() -> f32 { LIMIT }\n#[test]\nfn limit_of_tests() { assert_eq!(limit(), 2.0); }\n\
                #[cfg(test)]\nmod limit { #[test]\nfn limit() { assert_eq!(super::limit(), 1.0); } }\n";
    let file = TestFile::from_text("kernel.rs", text).expect("it is Rust");
    let verdicts = file.tests.iter().map(|test| {
        let kernel = file
            .compile(test)
            .unwrap_or_else(|errors| panic!("{}", errors.render(false)));
        matches!(check_test(&kernel, &Plan::default(), None), Verdict::Passed(_))
    });
    assert_eq!(verdicts.collect::<Vec<_>>(), [true, false]);
}

/// A driver that takes arguments above 4 for infinite.
struct Faulty;

impl Runner for Faulty {
    fn name(&self) -> String {
        "faulty driver".to_owned()
    }

    fn run_cases(&mut self, kernel: &TestKernel, cases: &[Case]) -> Result<Vec<Outcome>, RunnerError> {
        let wrong = |bits: &u32| {
            if f32::from_bits(*bits) > 4.0 {
                f32::INFINITY.to_bits()
            } else {
                *bits
            }
        };
        let changed: Vec<Case> = cases.iter().map(|case| case.iter().map(wrong).collect()).collect();
        interpret_cases::<f32>(kernel, &changed, Instant::now() + Duration::from_secs(9))
    }
}

/// A driver that runs nothing.
struct Broken;

impl Runner for Broken {
    fn name(&self) -> String {
        "broken driver".to_owned()
    }

    fn run_cases(&mut self, _: &TestKernel, _: &[Case]) -> Result<Vec<Outcome>, RunnerError> {
        Err(RunnerError::Failed("device lost".to_owned()))
    }
}

#[test]
fn failures_of_a_driver_alone_are_failures() {
    let text = file_with("", "for_all_in(0.0..=100.0, |x: f32| assert!(x * 0.5 <= 50.0));");
    let kernel = compile(&text).unwrap_or_else(|errors| panic!("{}", errors.render(false)));
    let Verdict::Failed(found) = check_test(&kernel, &Plan::default(), Some(&mut Faulty)) else {
        panic!("it passes");
    };
    let text = found.errors.render(false);
    assert!(
        text.contains("fails by the faulty driver") && text.contains("`x * 0.5` is f32::INFINITY"),
        "{text}"
    );
    assert!(text.contains("interpreter, f32: all assertions hold"), "{text}");
    assert_eq!(found.inputs, ["let x: f32 = 5.0;"]);
    let Verdict::Failed(found) = check_test(&kernel, &Plan::default(), Some(&mut Broken)) else {
        panic!("it passes");
    };
    let text = found.errors.render(false);
    assert!(
        text.contains("could not be run: device lost") && text.contains("`--without-gpu`"),
        "{text}"
    );
}

#[test]
fn a_failure_in_f64_alone_is_a_note() {
    // In f32 the sum is 1.
    let body = "for_all_in(0.0..1.0e-9, |x: f32| assert_eq!(1.0 + x, 1.0));";
    let Verdict::Passed(passed) = verdict("", body) else {
        panic!("it fails");
    };
    let text = passed.note.expect("a note").render(false);
    assert!(
        text.starts_with("note: an assertion of `tests::holds` holds in f32 and fails in f64"),
        "{text}"
    );
    assert!(text.contains("interpreter, f32: all assertions hold"), "{text}");
}

#[test]
fn pictures_that_no_shader_can_draw_are_refused_with_their_place() {
    let picture = |before: &str, rest: &str| format!("{before}assert_picture({rest});");
    let of = "uvec2(4, 4), |pixel| pixel.x as f32, psnr(50.0)";
    let cases = [
        (
            picture("", &format!("\"../a.png\", {of}")),
            "a picture of this name",
            "leads out of the folder",
        ),
        (
            picture("", &format!("\"a.exr\", {of}")),
            "a picture of this name",
            "no `.png`",
        ),
        (
            picture("let name = \"a.png\";", &format!("name, {of}")),
            "not written out",
            "write `\"golden.png\"`",
        ),
        (
            picture("", "\"a.png\", uvec2(4, 0), |pixel| 1.0, exactly()"),
            "a picture of this size",
            "1 to 4096",
        ),
        (
            picture("", "\"a.png\", size(), |pixel| 1.0, exactly()"),
            "a size that is not written out",
            "let size",
        ),
        (
            picture("", "\"a.png\", uvec2(4, 4), |pixel| 1.0, ulp(2)"),
            "such a tolerance",
            "psnr(50.0)",
        ),
        (
            picture("", "\"a.png\", uvec2(4, 4), shade, exactly()"),
            "no closure",
            "|pixel|",
        ),
        (
            picture("let a = read_picture(\"a.png\");", &format!("\"b.png\", {of}")),
            "without a type",
            "Texture<Vec4>",
        ),
        (
            picture(
                "",
                "\"a.png\", uvec2(4, 4), |pixel| read(&Sampler::default()), exactly()",
            ),
            "`Sampler` here",
            "let linear = Sampler::default();",
        ),
        (
            format!("for k in 0..2 {{ assert_picture(\"a.png\", {of}); }}"),
            "`assert_picture` here",
            "a statement of the test",
        ),
        (
            format!("assert_picture(\"a.png\", {of}); assert_picture(\"b.png\", {of});"),
            "a second picture",
            "a test of its own",
        ),
        (
            format!("for_all(|x: f32| assert!(x == x)); assert_picture(\"a.png\", {of});"),
            "a property and a picture",
            "a test of its own",
        ),
    ];
    for (body, what, help) in cases {
        let errors = compile(&file_with("", &body)).expect_err(&body);
        let text = errors.render(false);
        assert!(text.contains(what) && text.contains(help), "{body}:\n{text}");
        assert!(text.contains("kernel.rs:"), "{text}");
    }
}

#[test]
fn pictures_are_valid_shaders_of_every_stage() {
    let body = "let size = uvec2(8, 8); let image: Texture<Vec3> = read_picture(\"a.png\"); let linear = Sampler::default();\n        \
                let grey: Texture<f32> = draw(size, |at| image.load(at).x);\n        \
                assert_picture(\"b.png\", size, |at| grey.sample(&linear, at.as_vec2() / 8.0) * vec3(1.0, 0.5, 0.25), exactly());";
    let text = file_with("", body);
    let file = TestFile::from_text("kernel.rs", &text).unwrap_or_else(|errors| panic!("{}", errors.render(false)));
    let picture = file.tests[0].picture.clone().expect("a picture");
    let names: Vec<&str> = picture.images.iter().map(|image| image.name.as_str()).collect();
    assert_eq!(names, ["image", "grey"]);
    let ImageSource::Drawn(grey) = &picture.images[1].source else {
        panic!("it is drawn");
    };
    for kernel in [
        file.compile(&file.tests[0]),
        file.compile_picture(&file.tests[0], grey, &Settings::default()),
    ] {
        let kernel = kernel.unwrap_or_else(|errors| panic!("{}", errors.render(false)));
        for stage in [Stage::Compute, Stage::Fragment] {
            let emitted = kernel.compiled.emit(&EmitOptions::default().stage(stage));
            emitted.unwrap_or_else(|errors| panic!("{}", errors.render(false)));
        }
    }
}
