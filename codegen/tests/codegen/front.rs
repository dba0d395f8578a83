//! Legal Rust that is easily misread by a front end: each case checks the value that a kernel computes, or its refusal.

use std::path::Path;
use straightline_codegen::ir::Graph;
use straightline_codegen::{Kernel, Settings};

/// Returns the value of a kernel of constants, or its first error.
fn value(items: &str, body: &str) -> Result<f32, String> {
    let text = format!("{items}\npub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{\n{body}\n}}\n");
    match Kernel::from_text("k.rs", &text, "k").compile(&Settings::default()) {
        Ok(compiled) => {
            let graph: &Graph = &compiled.graph;
            let bits = graph.constant_bits(graph.outputs()[0]).ok_or("not a constant")?;
            Ok(f32::from_bits(bits[0]))
        }
        Err(errors) => Err(errors
            .diagnostics
            .first()
            .map_or("no message".to_owned(), |d| d.message.clone())),
    }
}

#[test]
fn cfg_is_evaluated_wherever_it_stands() {
    let cases: &[(&str, &str, f32)] = &[
        ("", "let mut a = 1.0; #[cfg(any())] { a = 2.0; } Vec4::splat(a)", 1.0),
        ("", "let mut a = 1.0; #[cfg(all())] { a = 2.0; } Vec4::splat(a)", 2.0),
        ("", "let mut a = 1.0; #[cfg(test)] a = 2.0; Vec4::splat(a)", 1.0),
        ("", "let mut a = 1.0; #[cfg(false)] a += 2.0; Vec4::splat(a)", 1.0),
        ("", "let mut a = 1.0; #[cfg(not(test))] a = 2.0; Vec4::splat(a)", 2.0),
        (
            "",
            "let a = 1.0; #[cfg(not(all(true, not(test))))] let a = 2.0; Vec4::splat(a)",
            1.0,
        ),
        (
            "",
            "#[cfg(test)] { Vec4::splat(1.0) } #[cfg(not(test))] { Vec4::splat(2.0) }",
            2.0,
        ),
        (
            "",
            "#[cfg(not(test))] { Vec4::splat(1.0) } #[cfg(test)] { Vec4::splat(2.0) }",
            1.0,
        ),
        ("", "let a = [1.0, #[cfg(any())] 2.0, 3.0]; Vec4::splat(a[1])", 3.0),
        (
            "",
            "let a = match 1 { #[cfg(any())] 1 => 1.0, _ => 2.0 }; Vec4::splat(a)",
            2.0,
        ),
        ("", "#[cfg(any())] assert!(false, \"never\"); Vec4::splat(1.0)", 1.0),
        (
            "",
            "for k in 0..4 { #[cfg(any())] continue; return Vec4::splat(1.0); } Vec4::splat(2.0)",
            1.0,
        ),
        (
            "struct S { a: f32, #[cfg(any())] b: f32 }",
            "let s = S { a: 1.0, #[cfg(any())] b: gone }; Vec4::splat(s.a)",
            1.0,
        ),
        (
            "struct S { a: f32, b: f32 }",
            "let S { a, #[cfg(any())] b: c, .. } = S { a: 1.0, b: 2.0 }; Vec4::splat(a)",
            1.0,
        ),
        (
            "fn f(#[cfg(any())] x: f32, y: f32) -> f32 { y }",
            "Vec4::splat(f(#[cfg(any())] 1.0, 2.0))",
            2.0,
        ),
        (
            "#[cfg(test)] fn f() -> f32 { 1.0 } #[cfg(not(test))] fn f() -> f32 { 2.0 }",
            "Vec4::splat(f())",
            2.0,
        ),
        (
            "#[cfg(any())] mod m { fn f() -> f32 { 1.0 } } fn f() -> f32 { 2.0 }",
            "Vec4::splat(f())",
            2.0,
        ),
        (
            "enum E { #[cfg(any())] A, B }",
            "let a = match E::B { E::B => 1.0 }; Vec4::splat(a)",
            1.0,
        ),
        (
            "#[cfg(any())] const K: f32 = 1.0; #[cfg(all())] const K: f32 = 2.0;",
            "Vec4::splat(K)",
            2.0,
        ),
        (
            "struct S; impl S { #[cfg(any())] const K: f32 = 1.0; #[cfg(all())] const K: f32 = 2.0; }",
            "Vec4::splat(S::K)",
            2.0,
        ),
        (
            "#[cfg(any())] impl S { const K: f32 = 1.0; } struct S; impl S { const K: f32 = 2.0; }",
            "Vec4::splat(S::K)",
            2.0,
        ),
        (
            "",
            "let mut a = 1.0; #[cfg_attr(feature = \"x\", allow(unused))] { a = 2.0; } Vec4::splat(a)",
            2.0,
        ),
    ];
    for (items, body, wanted) in cases {
        assert_eq!(value(items, body), Ok(*wanted), "{items} {body}");
    }
}

/// A constant of a block holds in all of it, and hides one of the file.
#[test]
fn constants_of_a_block_hold_before_their_line() {
    assert_eq!(
        value("const K: f32 = 1.0;", "let a = K; const K: f32 = 2.0; Vec4::splat(a)"),
        Ok(2.0)
    );
    let chained = "const A: f32 = B + 1.0; const B: f32 = C; const C: f32 = 3.0; Vec4::splat(A)";
    assert_eq!(value("const B: f32 = 7.0;", chained), Ok(4.0));
}

#[test]
fn fields_are_named_by_numbers() {
    let item = "struct S(f32, f32);";
    assert_eq!(value(item, "let S(a, b) = S(1.0, 2.0); Vec4::splat(b)"), Ok(2.0));
    assert_eq!(
        value(item, "let S { 1: b, .. } = S { 1: 2.0, 0: 1.0 }; Vec4::splat(b)"),
        Ok(2.0)
    );
}

/// Items and trait functions that the kernel does not reach may hold anything.
#[test]
fn what_is_not_reached_may_hold_anything() {
    let items = "use other::thing as x; type T = f64; static mut S: f64 = 1.0; union U { a: f32, b: f64 } struct V { a: f64 } \
                 trait Shade { fn shade(self) -> f64; } impl Shade for f32 { fn shade(self) -> f64 { 1.0 } } \
                 unsafe extern \"C\" { fn sinf(x: f64) -> f64; } macro_rules! m { () => {} } async fn later() {} \
                 #[cfg(feature = \"window\")] fn draw() {} #[tokio::main] fn main() {} const _: () = (); const _: () = (); \
                 impl std::ops::Add for V { type Output = V; fn add(self, o: V) -> V { self } } enum E { a(f64) = 3 }";
    assert_eq!(value(items, "Vec4::splat(1.0)"), Ok(1.0));
    // Nor a function of a trait of which another is called.
    let items = "trait Shade { fn shade(self) -> f32; fn exact(self, x: f64) -> f64; } \
                 impl Shade for f32 { fn shade(self) -> f32 { self } fn exact(self, x: f64) -> f64 { x } }";
    assert_eq!(value(items, "Vec4::splat(2.0f32.shade())"), Ok(2.0));
}

/// A method of a type goes before one of the same name in a trait.
#[test]
fn a_type_s_own_method_goes_before_a_trait_s() {
    let items = "struct S { a: f32 } impl S { fn get(&self) -> f32 { self.a } } \
                 impl Get for S { fn get(&self) -> f32 { 7.0 } }";
    assert_eq!(value(items, "Vec4::splat(S { a: 1.0 }.get())"), Ok(1.0));
}

/// Some functions in trouble: each is refused, though the evaluator could compute something.
#[test]
fn what_would_be_misread_is_refused() {
    let cases = [
        (
            "const k2: i32 = 3;",
            "let a = match 4 { k2 => 1.0, _ => 2.0 }; Vec4::splat(a)",
            "lower case",
        ),
        ("", "let a: f64 = 1.0; Vec4::splat(1.0)", "the type `f64`"),
        ("fn f(a: u64) -> f32 { 1.0 }", "Vec4::splat(f(1))", "the type `u64`"),
        (
            "use noise::mix;",
            "Vec4::splat(mix(0.0, 1.0, 0.5))",
            "not among the kernel's files",
        ),
        (
            "use crate::noise::mix;",
            "Vec4::splat(mix(0.0, 1.0, 0.5))",
            "not among the kernel's files",
        ),
        (
            "fn area(x: f32) -> f32 { x } fn f<T: Shape>(x: T) -> f32 { T::area(x) }",
            "Vec4::splat(f(1.0))",
            "cannot find trait `Shape`",
        ),
        (
            "mod a { pub struct S { x: f32 } } mod b { pub struct S { y: f32 } }",
            "let s = S { y: 1.0 }; Vec4::splat(1.0)",
            "defined twice",
        ),
        (
            "",
            "assert!(true, \"a {x}\"); Vec4::splat(1.0)",
            "a message with values",
        ),
        ("", "let a; Vec4::splat(a)", "never given a value"),
        ("", "let a: f32; if a == 1.0 {} Vec4::splat(a)", "never given a value"),
    ];
    for (items, body, wanted) in cases {
        let error = value(items, body).expect_err(body);
        assert!(error.contains(wanted), "{items} {body}: {error}");
    }
}

/// A variable that is declared first, and given its value once.
#[test]
fn a_variable_may_be_given_its_value_later() {
    assert_eq!(value("", "let a; a = 1.0; Vec4::splat(a)"), Ok(1.0));
    assert_eq!(
        value("", "let a: f32; if 1 > 0 { a = 1.0; } else { a = 2.0; } Vec4::splat(a)"),
        Ok(1.0)
    );
    let at_run_time = "let a; if color.load(pixel).x > 0.5 { a = 1.0; } else { a = 1.0; } Vec4::splat(a)";
    assert_eq!(value("", at_run_time), Ok(1.0));
}

/// Messages stay of a size that a screen takes, whatever the text.
#[test]
fn messages_are_of_a_bounded_size() {
    let many = format!("let a = [{}]; Vec4::splat(1.0)", "b?, ".repeat(5000));
    let text = format!("pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{ {many} }}");
    let errors = Kernel::from_text("k.rs", &text, "k")
        .compile(&Settings::default())
        .expect_err("it has errors");
    assert_eq!(errors.diagnostics.len(), 50);
    let shown = errors.render(false);
    assert!(
        shown.contains("= note: 4950 further errors are not shown\n"),
        "{}",
        &shown[shown.len() - 200..]
    );
    assert!(shown.len() < 60_000, "{} bytes", shown.len());
    assert!(shown.lines().all(|line| line.chars().count() < 200));

    let long = "x".repeat(100_000);
    let text = format!("pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{ {long} }}");
    let errors = Kernel::from_text("k.rs", &text, "k")
        .compile(&Settings::default())
        .expect_err("it has an error");
    assert!(
        errors.render(false).len() < 3000,
        "{} bytes",
        errors.render(false).len()
    );
}

/// Characters that a terminal acts on are written out; places are those of an editor.
#[test]
fn places_stay_right() {
    let heads = [
        "",
        "\u{feff}",
        "#!/usr/bin/env kernel\n",
        "\u{feff}#!/bin/x\r\n",
        "\r\n\r\n",
    ];
    for head in heads {
        for end in ["\n", "\r\n"] {
            let text = format!(
                "{head}pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{{end}\tlet a = /* é\u{202e}\u{1b}[31m */ gone;{end}    color.load(pixel)\n}}"
            );
            let errors = Kernel::from_text("k\u{1b}.rs", &text, "k")
                .compile(&Settings::default())
                .expect_err("an error");
            let span = errors.diagnostics[0].span.expect("a place");
            assert_eq!(&text[span.start as usize..span.end as usize], "gone", "{head:?}");
            let shown = errors.render(false);
            let line = head.matches('\n').count() + 2;
            assert!(shown.contains(&format!("k\\u{{1b}}.rs:{line}:24")), "{head:?}\n{shown}");
            assert!(shown.contains("é\\u{202e}\\u{1b}[31m"), "{shown}");
            assert!(!shown.contains(['\u{1b}', '\u{202e}', '\r']), "{shown}");
        }
    }
}

/// The kernel of a file for which no function is named: a public one that takes and returns what a kernel does.
#[test]
fn a_file_has_one_kernel() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("one-kernel");
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("blur.rs");
    let found = |text: &str| {
        std::fs::write(&path, text).expect("a file");
        let found = Kernel::from_file(&path, None);
        found.map(|kernel| kernel.name().to_owned()).map_err(|e| e.to_string())
    };
    let kernel = |name: &str| format!("fn {name}(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{ color.load(pixel) }}");
    let (soft, hard, blur) = (kernel("soft"), kernel("hard"), kernel("blur"));
    for (text, name) in [
        (format!("pub {soft} fn tap() {{}}"), "soft"),
        (format!("pub {soft} pub {blur}"), "blur"),
        (format!("pub {soft} {blur}"), "soft"),
        (format!("pub {soft} pub fn blur() {{}}"), "soft"),
        // The parser says more of what is no Rust.
        ("not Rust".to_owned(), "blur"),
    ] {
        assert_eq!(found(&text), Ok(name.to_owned()), "{text}");
    }
    for (text, says) in [
        (
            format!("pub {soft} pub {hard}"),
            "several functions that may be its kernel: `soft`, `hard`",
        ),
        (soft, "has no public function"),
    ] {
        let error = found(&text).expect_err(&text);
        assert!(error.contains(says), "{error}");
    }
}
