//! Texts that nest without brackets, which a parser goes down with: none may use up the stack that it is read on.

use crate::diagnostic::File;
use std::sync::Arc;

/// Text before, text to repeat, and text after.
const NESTED: &[(&str, &str, &str)] = &[
    ("fn k() { ", "become ", "x }"),
    ("fn k() { ", "return ", "x }"),
    ("fn k() { ", "break ", "x }"),
    ("fn k() { ", "break 'a ", "x }"),
    ("fn k() { ", "yield ", "x }"),
    ("fn k() { ", "do yeet ", "x }"),
    ("fn k() { ", "if ", "x {} }"),
    ("fn k() { ", "if let a = ", "x }"),
    ("fn k() { ", "if let S {} = ", "x }"),
    ("fn k() { ", "while let a = ", "x }"),
    ("fn k() { ", "while ", "x {} }"),
    ("fn k() { ", "match ", "x {} }"),
    ("fn k() { ", "for x in ", "x {} }"),
    ("fn k() { ", "for S {} in ", "x {} }"),
    ("fn k() { ", "let a = ", "x }"),
    ("fn k() { let y = ", "let a = ", "x; }"),
    ("fn k() { ", "a = ", "x }"),
    ("fn k() { ", "a += ", "x }"),
    ("fn k() { ", "a != b = ", "x }"),
    ("fn k() { ", "a == b = ", "x }"),
    ("fn k() { ", "a < b = ", "x }"),
    ("fn k() { ", "- ", "x }"),
    ("fn k() { ", "-", "x }"),
    ("fn k() { ", "!", "x }"),
    ("fn k() { ", "*", "x }"),
    ("fn k() { ", "&", "x }"),
    ("fn k() { ", "& ", "x }"),
    ("fn k() { ", "&mut ", "x }"),
    ("fn k() { ", "&raw const ", "x }"),
    ("fn k() { ", "|| ", "x }"),
    ("fn k() { ", "||", "x }"),
    ("fn k() { ", "|a| ", "x }"),
    ("fn k() { ", "|a: &'static f32| ", "x }"),
    ("fn k() { ", "move || ", "x }"),
    ("fn k() { ", "async move || ", "x }"),
    ("fn k() { ", "static || ", "x }"),
    ("fn k() { ", "for<'a> |b| ", "x }"),
    ("fn k() { ", "..", " }"),
    ("fn k() { ", ".. ", " }"),
    ("fn k() { ", "..=", "x }"),
    ("fn k() { ", "'a: ", "x }"),
    ("fn k() { x", " + x", " }"),
    ("fn k() { x", " + -x", " }"),
    ("fn k() { x", " << x", " }"),
    ("fn k() { x", " < x", " }"),
    ("fn k() { x", " && x < y", " }"),
    ("fn k() { x", " as f32", " }"),
    ("fn k() { x", " as A<", " }"),
    ("fn k() { x", ".y", " }"),
    ("fn k() { x", ".y()", " }"),
    ("fn k() { x", ".0", " }"),
    ("fn k() { x", ".await", " }"),
    ("fn k() { x", "()", " }"),
    ("fn k() { x", "[0]", " }"),
    ("fn k() { x", "?", " }"),
    ("fn k() { if a {} ", "else if a {} ", " }"),
    ("fn k() { ", "if a {} else ", "{} }"),
    ("fn k() { ", "{} + ", "x }"),
    ("fn k() { x = ", "{} + ", "x }"),
    ("fn k() { ", "unsafe {} as ", "x }"),
    ("fn k() { x::<", "A<", "x }"),
    ("fn k() { let y: ", "&dyn Fn() -> ", "x; }"),
    ("fn k() { let y: ", "impl Fn() -> ", "x; }"),
    ("fn k() { let y: ", "fn() -> ", "x; }"),
    ("fn k() { let y: ", "for<'a> fn() -> ", "x; }"),
    ("fn k() { let y: ", "unsafe extern \"C\" fn() -> ", "x; }"),
    ("fn k() { let y: ", "&'static ", "x; }"),
    ("fn k() { let y: ", "&", "x; }"),
    ("fn k() { let y: ", "*const ", "x; }"),
    ("fn k() { let y: ", "*mut ", "x; }"),
    ("fn k() { let y: ", "A<", "x; }"),
    ("fn k() { let y: ", "A<B, ", "x; }"),
    ("fn k() { let y: ", "&&&&&&&&A<B, ", "x; }"),
    ("fn k() { let y: ", "A<{ 3 }, ", "x; }"),
    ("fn k() { let y: ", "A<B = ", "x; }"),
    ("fn k() { let y: ", "A<B: ", "x; }"),
    ("fn k() { let y: ", "A<<", "x; }"),
    ("fn k() { let y: ", "<", "x; }"),
    ("fn k() { let y: ", "<A as ", "x; }"),
    ("fn k() { let y: ", "dyn A + ", "x; }"),
    ("fn k() { let ", "&", "x = y; }"),
    ("fn k() { let ", "&mut ", "x = y; }"),
    ("fn k() { let ", "a @ ", "x = y; }"),
    ("fn k() { let ", "a | ", "x = y; }"),
    ("fn k() { let ", "ref ", "x = y; }"),
    ("fn k() { let ", "box ", "x = y; }"),
    ("fn k() { match x { ", "a => ", "y } }"),
    ("fn k() { match x { ", "a if match ", "y } }"),
    ("fn k<", "T: A<", ">() {}"),
    ("fn k() where ", "T: A<", "> {}"),
    ("fn k", "<T: Fn() -> ", "() {}"),
    ("use ", "a::", "b;"),
    ("use {", "a::", "b};"),
    ("use a::{", "b, a::", "b};"),
    ("type A = ", "fn() -> ", "B;"),
    ("impl ", "A<", "B {}"),
    ("const A: B = ", "-", "x;"),
    ("#[a = ", "-", "x] fn k() {}"),
    ("#[a = ", "x + ", "x] fn k() {}"),
    ("#[cfg(", "not(", "x] fn k() {}"),
    ("fn k() { assert!(", "-", "x) }"),
    ("fn k() { assert!(", "!a == ", "x) }"),
    ("", "(", ""),
    ("", "{", ""),
    ("fn k() { ", "(-", "x }"),
    ("", "mod a ", ";"),
    ("", "pub ", "fn k() {}"),
    ("", "unsafe ", "fn k() {}"),
    ("", "const ", "fn k() {}"),
    ("", "#[a] ", "fn k() {}"),
    ("fn k() { ", "x; ", "}"),
    ("fn k() { ", "{} ", "}"),
    ("fn k() { ", "if a {} ", "}"),
    ("fn k() { ", "#[cfg(test)] {} ", "}"),
];

/// The stack of a thread, on which the kernel of a file is found, and that on which a kernel is compiled (`STACK` in
/// `codegen/src/pipeline.rs`).
const STACKS: [usize; 2] = [2 << 20, 256 << 20];

/// The front end on the stacks that it runs on: nothing of this may end the process.
fn run_front_end(text: String) {
    let of_parsing = text.clone();
    let find = move || drop(super::kernel_of(&text, "k", "k.rs"));
    let parse = move || {
        let file = File {
            path: "k.rs".to_owned(),
            text: of_parsing,
        };
        drop(super::parse(&Arc::new(vec![file]), "k"));
    };
    on_stack(STACKS[0], find);
    on_stack(STACKS[1], parse);
}

fn on_stack(size: usize, work: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(size).spawn(work);
    thread.expect("a thread").join().expect("no panic");
}

#[test]
fn texts_that_nest_without_brackets_are_refused() {
    let sizes: &[usize] = match std::env::var_os("STRAIGHTLINE_ALL") {
        Some(_) => &[90, 120, 250, 1400, 22_000, 100_000],
        None => &[120, 250, 1400, 22_000],
    };
    for (before, repeated, after) in NESTED {
        for count in sizes {
            eprintln!("{count} × `{repeated}` after `{before}`");
            run_front_end(format!("{before}{}{after}", repeated.repeat(*count)));
        }
    }
}

/// Below the bound texts are read: files of many items, blocks of many statements, lists of many elements.
#[test]
fn long_texts_are_read() {
    let functions: String = (0..2000)
        .map(|k| {
            format!("/// Documented: {k}.\n#[inline]\npub fn f{k}(x: &[Vec4; 2], y: Option<f32>) -> f32 {{ x[0].x }}\n")
        })
        .collect();
    let table: Vec<String> = (0..5000).map(|k| format!("[{k}.0, -{k}.5, f(A::B) + 1.0]")).collect();
    let arms: String = (0..2000).map(|k| format!("{k} => {{ a }} ")).collect();
    let ifs =
        "if a < b && c > d { x = -x; } 'l: for k in 0..4 { continue 'l; } *x += 1.0; if let a = b {} ".repeat(1000);
    let compared: Vec<String> = (0..200).map(|k| format!("a < {k}.0 && b > a")).collect();
    let text = format!(
        "{functions} const T: [[f32; 3]; 5000] = [{}]; fn g() {{ match a {{ {arms} }} {ifs} [{}] }}",
        table.join(", "),
        compared.join(", ")
    );
    assert_eq!(super::depth::check_depth(0, &text).map_err(|e| e.message), Ok(()));
}
