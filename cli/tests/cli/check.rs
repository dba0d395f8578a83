//! `check` as an editor runs it: what it prints is read by the crate that rust-analyzer reads cargo's messages with.

use crate::common;

use cargo_metadata::Message;
use cargo_metadata::diagnostic::{Diagnostic, DiagnosticLevel, DiagnosticSpan};
use common::{example, fails, finishes, here, scratch, straightline, write};
use std::path::Path;

/// Three errors: behind characters of two, three and four bytes; over two lines; and in a function that the kernel calls.
const BROKEN: &str = "\
use straightline_kernels::prelude::*;

fn sharper(color: Vec4) -> Vec4 {
    let half: f32 = color;
    color * half
}

/// Größer – 🦀.
pub fn lens(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    /* größer – 🦀 */ let x: f32 = true;
    let y: f32 = color
        .load(pixel);
    sharper(color.load(pixel) * x + y)
}
";

/// The messages of a run, and whether it succeeded.
fn messages(arguments: &[&str]) -> (Vec<Diagnostic>, bool) {
    let output = straightline(arguments);
    let (mut found, mut finished) = (Vec::new(), None);
    for message in Message::parse_stream(&output.stdout[..]) {
        assert!(finished.is_none(), "a message comes after the last");
        match message.expect("a line") {
            Message::CompilerMessage(message) => {
                assert!(message.target.src_path.is_absolute() && !message.package_id.repr.is_empty());
                found.push(message.message);
            }
            Message::BuildFinished(last) => finished = Some(last.success),
            other => panic!("{other:?} is no message of a check"),
        }
    }
    let finished = finished.expect("a last message");
    assert_eq!(
        output.status.code(),
        Some(if finished { 0 } else { 1 }),
        "{arguments:?}"
    );
    (found, finished)
}

/// Returns the text that a span marks in its file, read by lines and columns; bytes and the quoted lines must say the same.
fn marked(span: &DiagnosticSpan) -> String {
    assert!(Path::new(&span.file_name).is_absolute(), "{}", span.file_name);
    let text = std::fs::read_to_string(&span.file_name).expect("the file is there");
    let lines: Vec<&str> = text.lines().collect();
    let lines = &lines[span.line_start - 1..span.line_end];
    let quoted: Vec<&str> = span.text.iter().map(|line| line.text.as_str()).collect();
    assert_eq!(quoted, lines);
    let mut marked = Vec::new();
    for (k, line) in lines.iter().enumerate() {
        let characters: Vec<char> = line.chars().collect();
        let first = if k == 0 { span.column_start } else { 1 };
        let last = if k + 1 == lines.len() {
            span.column_end
        } else {
            characters.len() + 1
        };
        let quote = &span.text[k];
        assert_eq!((quote.highlight_start, quote.highlight_end), (first, last));
        marked.push(characters[first - 1..last - 1].iter().collect::<String>());
    }
    let marked = marked.join("\n");
    assert_eq!(&text[span.byte_start as usize..span.byte_end as usize], marked);
    marked
}

#[test]
fn an_editor_reads_every_error_and_its_place() {
    let folder = scratch("check-json");
    let kernel = write(&folder, "lens.rs", BROKEN);
    let (found, finished) = messages(&["check", &kernel, "--message-format=json"]);
    assert!(!finished);
    let told: Vec<(String, String)> = found
        .iter()
        .map(|error| {
            assert_eq!(error.level, DiagnosticLevel::Error);
            assert!(
                error
                    .rendered
                    .as_ref()
                    .is_some_and(|text| text.contains(&error.message))
            );
            let primary: Vec<_> = error.spans.iter().filter(|span| span.is_primary).collect();
            assert_eq!(primary.len(), 1, "{error:?}");
            (error.message.clone(), marked(primary[0]))
        })
        .collect();
    let expected = [
        ("Vec4", "color"),
        ("bool", "true"),
        ("Vec4", "color\n        .load(pixel)"),
    ];
    assert_eq!(told.len(), expected.len(), "{told:?}");
    for ((message, place), (name, marks)) in told.iter().zip(expected) {
        assert!(
            message.contains(&format!("found `{name}`")) && place == marks,
            "{message}: {place}"
        );
    }
    let of_people = straightline(&["check", &kernel]);
    let said = String::from_utf8_lossy(&of_people.stderr);
    for error in &found {
        assert!(said.contains(error.rendered.as_deref().expect("a text")), "{said}");
    }
    assert!(said.ends_with("error: 3 errors in 1 of 1 kernel\n"), "{said}");
}

#[test]
fn a_file_that_cannot_be_read_is_a_message_too() {
    let output = straightline(&["check", "no/such/lens.rs", "--message-format=json"]);
    assert_eq!(output.status.code(), Some(2));
    let messages: Vec<Message> = Message::parse_stream(&output.stdout[..])
        .map(|m| m.expect("a line"))
        .collect();
    let [Message::CompilerMessage(first), Message::BuildFinished(last)] = messages.as_slice() else {
        panic!("{messages:?}");
    };
    assert!(
        first
            .message
            .message
            .contains("cannot read the kernel file `no/such/lens.rs`"),
        "{first:?}"
    );
    assert!(first.target.src_path.is_absolute() && !last.success);
}

#[cfg(unix)]
#[test]
fn a_file_of_a_folder_whose_name_is_not_utf8_is_named() {
    use std::os::unix::ffi::OsStrExt;
    let folder = scratch("check-names");
    let name = std::ffi::OsStr::from_bytes(b"gr\xf6sser.rs");
    std::fs::write(Path::new(&folder).join(name), "pub fn k(pixel: IVec2) -> f32 { 1.0 }").expect("a file");
    let shown = folder.display().to_string();
    fails(&["check", &shown], 2, &["is not UTF-8", "rename the file"]);
}

#[test]
fn an_error_behind_the_graph_stands_at_its_input() {
    let folder = scratch("check-places");
    let text = "// the old fn layers read depth wrongly\npub fn layers(depth: &FrameLayers<f32>, layer: u32, pixel: IVec2) -> Vec4 {\n    \
        Vec4::splat(depth.load(pixel, layer as usize))\n}\n";
    let kernel = write(&folder, "layers.rs", text);
    let (found, _) = messages(&["check", &kernel, "--message-format=json"]);
    let [error] = found.as_slice() else { panic!("{found:?}") };
    assert!(error.message.contains("whose index is a runtime value"), "{error:?}");
    assert_eq!(
        (error.spans[0].line_start, marked(&error.spans[0]).as_str()),
        (2, "depth"),
        "{error:?}"
    );
    let code = error.code.as_ref().expect("a code");
    let explained = code
        .explanation
        .as_deref()
        .is_some_and(|text| text.contains("Bound the index."));
    assert!(code.code == "straightline::E0706" && explained, "{code:?}");
    let out = folder.display().to_string();
    let says = [
        "error[E0706]: ",
        "layers.rs:2:15",
        "this input",
        "= help: bound it with",
    ];
    fails(&["emit", &kernel, "--out", &out], 1, &says);
    // Engines find the input that they cannot bind.
    let depth = "pub fn shade(depth: &DepthTexture, pixel: IVec2) -> Vec4 {\n    Vec4::splat(depth.load(pixel))\n}\n";
    let shade = write(&folder, "shade.rs", depth);
    let says = [
        "error[E0801]: `shade` does not fit Godot",
        "shade.rs:1:14",
        "this input",
    ];
    fails(&["emit", &shade, "--engine", "godot", "--out", &out], 1, &says);
    // A stage that lacks what the kernel needs is reported at the kernel's name.
    let writes = "// fn writes\npub fn writes(color: &Frame<Vec4>, bins: &AtomicBuffer<u32>, pixel: IVec2) {\n    \
        bins.add((color.load(pixel).x * 8.0) as usize, 1);\n}\n";
    let kernel = write(&folder, "writes.rs", writes);
    fails(
        &["emit", &kernel, "--stage", "fragment", "--out", &out],
        1,
        &["writes.rs:2:8", "this kernel"],
    );
}

#[test]
fn functions_that_no_kernel_reaches_are_checked_for_their_types() {
    let folder = scratch("check-others");
    let kernel = "use straightline_kernels::prelude::*;\n\npub fn lens(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel)\n}\n";
    // Functions that a kernel does not reach may be outside of its language.
    let outside =
        "\nfn printed(x: f32) {\n    println!(\"{x}\");\n}\n\nfn others(x: f32) -> u64 {\n    elsewhere::of(x)\n}\n";
    let fine = write(&folder, "lens.rs", &format!("{kernel}{outside}"));
    finishes(&["check", &fine]);
    let broken = write(
        &folder,
        "lens.rs",
        &format!("{kernel}{outside}\nfn broken() -> f32 {{\n    1\n}}\n"),
    );
    let (found, _) = messages(&["check", &broken, "--message-format=json"]);
    let [error] = found.as_slice() else { panic!("{found:?}") };
    assert_eq!(
        (error.message.as_str(), marked(&error.spans[0]).as_str()),
        ("mismatched types: expected `f32`, found an integer", "1")
    );
}

/// Each error of functions and constants that no kernel reaches, beside those of the kernel.
#[test]
fn functions_that_no_kernel_reaches_have_the_errors_of_rustc() {
    let folder = scratch("check-all");
    let head = "use straightline_kernels::prelude::*;\n\n";
    let kernel = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel)\n}\n";
    let items = "struct Tap { weight: f32 }\nenum Mode { Sharp, Soft }\n";
    let cases = [
        ("const WRONG: f32 = 1;", "E0301"),
        ("fn f() -> f32 { let x = 1.0_f32; }", "E0301"),
        ("fn f(x: f32) -> f32 { x + unknown }", "E0201"),
        ("fn f(x: f32) -> f32 { nowhere(x) }", "E0202"),
        ("fn f(tap: Tap) -> f32 { tap.wight }", "E0205"),
        ("fn f(x: f32) -> f32 { x += 1.0; x }", "E0214"),
        ("fn f(x: f32) -> f32 { x(1.0) }", "E0303"),
        ("fn f(a: Tap, b: Tap) -> Tap { a + b }", "E0304"),
        ("fn f(mode: Mode) -> f32 { match mode { Mode::Sharp => 1.0 } }", "E0310"),
        ("fn f(x: f32) -> f32 { continue; x }", "E0402"),
        ("fn f<T: Copy>(x: T) -> f32 { let y: u32 = 1.5; x; 1.0 }", "E0301"),
    ];
    for (mistake, code) in cases {
        let file = write(&folder, "k.rs", &format!("{head}{items}{kernel}{mistake}\n"));
        let (found, _) = messages(&["check", &file, "--message-format=json"]);
        let codes: Vec<_> = found
            .iter()
            .map(|error| error.code.as_ref().map(|code| code.code.clone()))
            .collect();
        assert_eq!(codes, [Some(format!("straightline::{code}"))], "{mistake}");
    }
    // All of them at once, with one of the kernel.
    let wrong = kernel.replace("color.load(pixel)", "color.lood(pixel)");
    let both = format!("{head}{wrong}fn f() -> f32 {{\n    1\n}}\nfn g() -> f32 {{\n    x\n}}\n");
    let file = write(&folder, "k.rs", &both);
    assert_eq!(messages(&["check", &file, "--message-format=json"]).0.len(), 3);
}

/// Functions that rustc takes and that are not of the kernel language, or use what the file does not show.
#[test]
fn functions_that_no_kernel_reaches_may_be_outside_of_the_language() {
    let folder = scratch("check-outside");
    let kernel = "use straightline_kernels::prelude::*;\n\npub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel)\n}\n";
    let taken = [
        "fn main() { let frame = Frame::new(uvec2(1, 1), vec![Vec4::ONE]); println!(\"{}\", k(&frame, ivec2(0, 0))); }",
        "#[cfg(test)] mod tests { use super::*; #[test] fn works() { assert_eq!(helper(), 1); } }",
        "use crate::shared::helper; fn f(x: f32) -> f32 { helper(x) + crate::shared::other(x) * super::LIMIT }",
        "use super::shared::*; fn f(x: f32) -> f32 { helper(x) + LIMIT }",
        "#[derive(PartialEq, PartialOrd, Clone, Copy)] struct Tap { x: f32 } fn f(a: Tap, b: Tap) -> bool { a < b }",
        "struct Tap(f32); fn f(list: [f32; 2]) -> [Tap; 2] { list.map(Tap) }",
        "fn f(r: std::ops::Range<usize>) -> usize { r.end - r.start }",
        "fn f() -> usize { let r = 1..3_usize; drop(r.start); r.end }",
        "fn f(q: Quat, v: Vec3) -> Vec3 { (q * v).any_orthonormal_vector() + (q * q).normalize() * v }",
        "fn f<T: Into<f32> + Copy>(x: T) -> f32 { x.into() * 2.0 }",
        "macro_rules! half { ($x:expr) => { $x * 0.5 } } fn f(x: f32) -> f32 { half!(x) }",
        "fn f(x: f32) -> f32 { x.to_radians().mul_add(2.0, x.asinh()) }",
        "fn f(x: Vec3) -> f32 { Vec3::from_slice(&[1.0, 2.0, 3.0]).dot(x) }",
        "use std::cmp::max; fn f(a: i32, b: i32) -> i32 { max(a, b) }",
    ];
    for item in taken {
        let file = write(&folder, "k.rs", &format!("{kernel}{item}\n"));
        finishes(&["check", &file]);
    }
}

#[test]
fn notes_help_and_further_places_are_kept() {
    let folder = scratch("check-parts");
    let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let b = color.load(pixel).x.exp_m1();\n    Vec4::splat(b)\n}\n";
    let kernel = write(&folder, "k.rs", text);
    let (found, _) = messages(&["check", &kernel, "--message-format", "json"]);
    let children: Vec<_> = found[0]
        .children
        .iter()
        .map(|child| (child.level, child.message.as_str()))
        .collect();
    let label = found[0].spans[0].label.as_deref().expect("a label");
    assert!(children.contains(&(DiagnosticLevel::Note, label)), "{children:?}");
    assert!(
        children.contains(&(DiagnosticLevel::Help, "write `x.exp() - 1.0`")),
        "{children:?}"
    );
    assert_eq!(
        found[0].code.as_ref().map(|code| code.code.as_str()),
        Some("straightline::E0411")
    );
}

#[test]
fn an_error_of_all_of_a_kernel_is_at_its_name() {
    let folder = scratch("check-whole");
    let text =
        "// fn lens is below\npub fn lens(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    color.load(pixel)\n}\n";
    let kernel = write(&folder, "lens.rs", text);
    let (found, _) = messages(&["check", &kernel, "--message-format=json", "--set", "radius=3"]);
    assert_eq!(
        (found.len(), marked(&found[0].spans[0]).as_str()),
        (1, "lens"),
        "{found:?}"
    );
    // A file of several public functions, none of its name, is shown at the first of them.
    let several = format!(
        "{text}{}",
        text.lines()
            .skip(1)
            .collect::<Vec<_>>()
            .join("\n")
            .replace("lens", "glow")
    );
    let other = write(&folder, "other.rs", &several);
    let (found, _) = messages(&["check", &other, "--message-format=json"]);
    let primary = found[0].spans.iter().find(|span| span.is_primary).expect("a place");
    assert_eq!(marked(primary), "lens");
    assert!(
        found[0]
            .message
            .contains("several functions that may be its kernel: `lens`, `glow`"),
        "{found:?}"
    );
}

#[test]
fn a_folder_is_checked_whole_and_shared_errors_once() {
    let folder = scratch("check-folder");
    let kernel = |name: &str| {
        format!("pub fn {name}(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{\n    shared(color.load(pixel))\n}}\n")
    };
    for name in ["a", "b"] {
        write(&folder, &format!("{name}.rs"), &kernel(name));
    }
    let shared = write(
        &folder,
        "shared.rs",
        "pub fn shared(x: Vec4) -> Vec4 {\n    x.missing()\n}\n",
    );
    write(&folder, "mod.rs", "mod a;\nmod b;\nmod shared;\n");
    let all = folder.to_str().expect("a path");
    let (found, _) = messages(&["check", all, "--source", &shared, "--message-format=json"]);
    assert_eq!(found.len(), 1, "{found:?}");
    fails(
        &["check", all, "--source", &shared],
        1,
        &["error: 1 error in 2 of 2 kernels"],
    );
    write(
        &folder,
        "shared.rs",
        "pub fn shared(x: Vec4) -> Vec4 {\n    x * 0.5\n}\n",
    );
    let said = finishes(&["check", all, "--source", &shared]);
    assert_eq!(said.matches(": no errors\n").count(), 2, "{said}");
    let (found, finished) = messages(&["check", all, "--source", &shared, "--message-format=json"]);
    assert!(found.is_empty() && finished);
}

#[test]
fn what_is_not_there_is_bad_use() {
    let folder = scratch("check-nothing");
    let empty = folder.to_str().expect("a path");
    fails(&["check"], 2, &["<KERNEL>"]);
    fails(&["check", empty], 2, &["no .rs file lies in the folder"]);
    fails(&["check", "sraaa", "--message-format=json"], 2, &["no kernel `sraaa`"]);
    fails(
        &["check", "nowhere.rs"],
        2,
        &["cannot read the kernel file `nowhere.rs`"],
    );
    fails(&["check", "sraa", "--message-format=xml"], 2, &["human", "json"]);
}

/// The command that an editor would otherwise run: here the binary itself, on another kernel.
#[test]
fn messages_of_a_command_come_first_and_its_failure_counts() {
    let folder = scratch("check-before");
    let kernel = write(&folder, "lens.rs", BROKEN);
    let good = example("sobel");
    let binary = env!("CARGO_BIN_EXE_straightline");
    let before = |first: &str, second: &str| {
        messages(&[
            "check",
            second,
            "--message-format=json",
            "--",
            binary,
            "check",
            first,
            "--message-format=json",
        ])
    };
    let (found, finished) = before(&good, &kernel);
    assert!(found.len() == 3 && !finished);
    let (found, finished) = before(&kernel, &good);
    assert!(found.len() == 3 && !finished);
    let (found, finished) = before(&good, &good);
    assert!(found.is_empty() && finished);
    fails(
        &["check", &good, "--", "no-such-program"],
        1,
        &["cannot run `no-such-program`"],
    );
    fails(
        &["check", &good, "--", binary, "check", &kernel],
        1,
        &["lens.rs:10", "failed: exit status: 1"],
    );
}

/// A parameter that is named like a coordinate is a uniform: `check` says so, and how a pixel's own is computed.
#[test]
fn a_uniform_named_like_a_coordinate_is_noted() {
    let path = write(
        &scratch("coordinate"),
        "blur.rs",
        "use straightline_kernels::prelude::*;\n\
         pub fn blur(image: &Texture<Vec4>, linear: &Sampler, uv: Vec2, offset: Vec2) -> Vec4 {\n\
             image.sample(linear, uv + offset)\n}\n",
    );
    let said = finishes(&["check", &path]);
    let notes: Vec<&str> = said.lines().filter(|line| line.contains(":2: note:")).collect();
    assert_eq!(notes.len(), 1, "{said}");
    assert!(
        notes[0].contains("`uv` is a uniform, the same for all pixels"),
        "{said}"
    );
    let (found, succeeded) = messages(&["check", "--message-format", "json", &path]);
    let levels: Vec<DiagnosticLevel> = found.iter().map(|message| message.level).collect();
    assert_eq!((levels.as_slice(), succeeded), (&[DiagnosticLevel::Note][..], true));
}

/// A loop that could stay in the shader, and is unrolled to thousands of operations, is pointed out.
#[test]
fn a_loop_with_very_many_operations_is_noted() {
    let march = |steps: u32| {
        format!(
            "pub fn march(image: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{\n    let ray = image.load(pixel).truncate();\n    \
             let mut t = 0.0;\n    for step in 0..{steps} {{\n        let d = (ray * t).sin().length() - 0.5;\n        \
             if d < 0.001 {{\n            break;\n        }}\n        t += d;\n    }}\n    Vec4::splat(t)\n}}\n"
        )
    };
    let folder = scratch("march");
    let long = write(&folder, "march.rs", &march(800));
    let said = finishes(&["check", &long]);
    assert!(said.contains(":4: note: `march.step` is unrolled to"), "{said}");
    assert!(
        said.contains("`--unroll-loop march.step=none` leaves it in the shader"),
        "{said}"
    );
    let explained = finishes(&["explain", &long]);
    assert!(explained.contains("`--unroll-loop march.step=none`"), "{explained}");
    for quiet in [
        write(&folder, "short.rs", &march(40)),
        here("kernels/filters/bilateral.rs"),
    ] {
        let said = finishes(&["check", &quiet]);
        assert!(!said.contains("--unroll-loop"), "{said}");
    }
    let explained = finishes(&["explain", &long, "--unroll-loop", "march.step=none"]);
    assert!(!explained.contains("is unrolled to"), "{explained}");
}
