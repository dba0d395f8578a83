//! Limits of the generator: chains of operators are read up to what the language page says, kernels that cost too much are refused
//! with the place of the work, and time and memory have limits of their own. Work is counted, never timed.

use std::fmt::Write;
use std::time::Duration;
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::interp::{Bindings, Image, Interpreter};
use straightline_codegen::{Branches, Compiled, EmitOptions, Kernel, Settings, Unroll};

fn compile(text: &str, settings: &Settings) -> Result<Compiled, Errors> {
    Kernel::from_text("k.rs", text, "k").compile(settings)
}

/// A kernel of a body that may use `c`, a colour, and gives `s`.
fn kernel(items: &str, body: &str) -> String {
    format!(
        "{items}\npub fn k(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {{\n    let c = color.load(pixel);\n{body}\n    \
         Vec4::splat(s)\n}}\n"
    )
}

fn texel(compiled: &Compiled) -> f32 {
    let image = Image::new([1, 1], vec![vec![[0.5, 0.25, 2.0, 1.0]]]).expect("one texel");
    let bindings = Bindings::new().texture("color", &image).uniform("n", &[3.0]);
    let interpreter = Interpreter::new(&compiled.graph, &compiled.schedule, [1, 1], &bindings).expect("all is bound");
    interpreter.run_pixel(0, 0, &mut interpreter.new_scratch())[0]
}

/// Chains as long as the language page allows, with their values.
#[test]
fn long_chains_are_read() {
    let join = |count: u32, between: &str, each: &dyn Fn(u32) -> String| {
        (0..count).map(each).collect::<Vec<_>>().join(between)
    };
    let mut elses = String::new();
    for k in 0..300 {
        write!(elses, "if n == {} {{ {k}.0 }} else ", k + 100).expect("to a string");
    }
    let chains = [
        (
            "sums",
            format!(
                "let s = {};",
                join(1400, " + ", &|_| "c.y".to_owned()).replace("c.y", "y")
            ),
            350.0,
        ),
        (
            "products",
            format!("let s = {};", join(1400, " * ", &|_| "w".to_owned())),
            1.0,
        ),
        (
            "both",
            format!("let s = {};", join(180, " + ", &|_| "c.x * 2.0".to_owned())),
            180.0,
        ),
        (
            "ands",
            format!(
                "let s = if {} {{ 5.0 }} else {{ 6.0 }};",
                join(600, " && ", &|_| "b".to_owned())
            ),
            5.0,
        ),
        (
            "ors",
            format!(
                "let s = if {} {{ 5.0 }} else {{ 6.0 }};",
                join(600, " || ", &|_| "!b".to_owned())
            ),
            6.0,
        ),
        (
            "bits",
            format!("let s = ({}) as f32;", join(1400, " | ", &|_| "n".to_owned())),
            3.0,
        ),
        (
            "compared",
            format!(
                "let s = if {} {{ 5.0 }} else {{ 6.0 }};",
                join(300, " && ", &|k| format!("n < {}", k + 4))
            ),
            5.0,
        ),
        (
            "shifts",
            format!(
                "let s = ({}) as f32;",
                join(120, " ^ ", &|k| format!("(n << {})", k % 4))
            ),
            0.0,
        ),
        ("methods", format!("let s = c.x{};", ".abs()".repeat(700)), 0.5),
        ("else ifs", format!("let s = {elses}{{ 9.0 }};"), 9.0),
    ];
    for (name, body, expected) in chains {
        let body = format!("let (y, w, b) = (c.y, c.w, n == 3);\n{body}");
        for branches in [Branches::Select, Branches::Keep] {
            let settings = Settings::new().branches(branches);
            let compiled = compile(&kernel("", &body), &settings).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(texel(&compiled), expected, "{name}");
            compiled
                .emit(&EmitOptions::new())
                .unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
    let longer = format!("let s = {};", join(1600, " + ", &|_| "c.y".to_owned()));
    let refused = compile(&kernel("", &longer), &Settings::default()).expect_err("too long");
    assert!(
        refused
            .to_string()
            .contains("more than 1500 operators in one expression"),
        "{refused}"
    );
}

/// Texts that multiply, with what the error says; the name is that of what does the work.
fn heavy() -> Vec<(String, &'static str)> {
    let doubling =
        "fn f(n: u32, x: f32) -> f32 { if n == 0 { x * 1.5 } else { f(n - 1, x + 1.0) + f(n - 1, x * 2.0) } }";
    let mut closures = "let f0 = |x: f32| x * 1.5 + c.y;\n".to_owned();
    for k in 1..25 {
        writeln!(closures, "let f{k} = |x: f32| f{}(f{}(x + {k}.0));", k - 1, k - 1).expect("to a string");
    }
    let mut calls = "fn f0(x: f32) -> f32 { x * 1.5 + 1.0 }\n".to_owned();
    for k in 1..12 {
        let inner = k - 1;
        writeln!(
            calls,
            "fn f{k}(x: f32) -> f32 {{ let mut s = x; for i in 0..4 {{ s += f{inner}(s * i as f32); }} s }}"
        )
        .expect("to a string");
    }
    let copies = "fn step(mut a: [f32; 65536], k: usize) -> [f32; 65536] { a[k] += 1.0; a }";
    let copied = "let mut a = [c.x; 65536];
    for k in 0..1000 { let b = step(a, k); if c.y > k as f32 { a = b; } else { a[0] = 1.0; } }
    let s = a[5];";
    let nested = "let mut s = c.x;
    for a in 0..40 { for b in 0..40 { for d in 0..40 { for e in 0..40 { s = s * 1.5 + (a + b + d + e) as f32; } } } }";
    vec![
        (kernel(doubling, "let s = f(40, c.x);"), "operations"),
        (kernel("", &format!("{closures}let s = f24(c.x);")), "operations"),
        (kernel(&calls, "let s = f11(c.x);"), "operations"),
        (kernel(copies, copied), "`k.k`"),
        (kernel("", nested), "`k.e`"),
    ]
}

#[test]
fn kernels_that_multiply_are_refused_by_their_work() {
    for (text, part) in heavy() {
        let refused = compile(&text, &Settings::default()).expect_err(&text).to_string();
        assert!(refused.contains(part), "{refused}");
    }
}

/// Loops whose end is a runtime value, three deep: each is tried to be unrolled, and not 256 times a level.
#[test]
fn attempts_do_not_multiply() {
    let body = "let mut s = c.x;
    let (mut a, mut i) = (0, 0);
    loop {
        i += 1;
        let mut b = 0;
        loop {
            b += 1;
            let mut d = 0;
            loop {
                d += 1;
                s = s * 1.5;
                if s > d as f32 * 100.0 { break; }
                if d > n { break; }
            }
            if s > b as f32 { break; }
            if b + a > n { break; }
        }
        a += i;
        if a > n { break; }
    }";
    let compiled = compile(&kernel("", body), &Settings::default()).unwrap_or_else(|e| panic!("{e}"));
    assert!(compiled.work < 400_000, "{}", compiled.work);
    let long = "let mut s = c.x;
    let mut i = 0;
    while i < 1_000_000 { s = s * 0.5 + 1.0; i += 1; }";
    let settings = Settings::new().unroll(Unroll::None);
    let compiled = compile(&kernel("", long), &settings).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(compiled.counts.loops, 1);
    assert_eq!(texel(&compiled), 2.0);
}

#[test]
fn time_and_memory_have_limits() {
    let loops = "let mut s = c.x;
    for a in 0..30 { for b in 0..30 { s = s * 1.5 + (a * b) as f32; } }";
    let text = kernel("", loops);
    let late = Settings::new().time_limit(Duration::from_nanos(1));
    let refused = compile(&text, &late).expect_err("no time").to_string();
    assert!(refused.contains("takes more than 0.000000001 s"), "{refused}");
    assert!(
        refused.contains("`k.b`") && refused.contains("--time-limit"),
        "{refused}"
    );
    let small = Settings::new().memory_limit(100_000);
    let refused = compile(&text, &small).expect_err("no memory").to_string();
    assert!(refused.contains("takes more than 0 MB"), "{refused}");
    assert!(
        refused.contains("`k.b`") && refused.contains("--memory-limit"),
        "{refused}"
    );
    // Emission goes on with the time that is left.
    let mut compiled = compile(&text, &Settings::default()).unwrap_or_else(|e| panic!("{e}"));
    compiled.emit(&EmitOptions::new()).unwrap_or_else(|e| panic!("{e}"));
    compiled.limits.time = compiled.time;
    let refused = compiled.emit(&EmitOptions::new()).expect_err("no time").to_string();
    assert!(
        refused.contains("`k.b`") && refused.contains("--time-limit"),
        "{refused}"
    );
}

/// Copies of arrays that are held at the same time count; copies that are gone do not.
#[test]
fn memory_is_what_is_held() {
    let settings = Settings::new().memory_limit(40_000_000);
    let gone = "let mut s = c.x;
    for k in 0..60 { let mut a = [c.x; 20000]; let b = a; a[k] = b[0] * 2.0; s += a[k]; }";
    compile(&kernel("", gone), &settings).unwrap_or_else(|e| panic!("{e}"));
    let held = "let mut s = c.x;
    let mut a = [c.x; 20000];
    for k in 0..200 { a[k] = c.y; if c.z > k as f32 { continue; } a[k + 1] = c.w; if c.y > k as f32 { break; } }
    s += a[3];";
    let refused = compile(&kernel("", held), &settings).expect_err("too much").to_string();
    assert!(refused.contains("takes more than 40 MB"), "{refused}");
}

/// The compile-time work of an array that no driver could hold is not done, and no writer of SPIR-V is asked to.
#[test]
fn arrays_beyond_an_instruction_are_refused() {
    let body = "let mut a = [c.x; 65536];
    for k in 0..n { a[k as usize] = 1.0; }
    let s = a[5];";
    let refused = compile(&kernel("", body), &Settings::default())
        .expect_err("too large")
        .to_string();
    assert!(refused.contains("65536 elements"), "{refused}");
}
