//! Engines' files of a kernel whose documentation is hostile, and folders that are.

use super::code::without_words;
use super::readable;
use crate::engines::Subject;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use straightline_codegen::{Kernel, Settings};
use straightline_engines::{Engine, Request, engine_names};

/// Documentation that would end a comment or a string, go on in the next line, be a tag of a template or too long, in some
/// language.
pub const HOSTILE: [&str; 9] = [
    r"Title */ pwned(); /* \",
    r##"doc */ pwned(); // ` ${pwned()} """; pwned() \"##,
    "line\u{2028}pwned()\rpwned()\u{85}pwned()\u{b}pwned()\u{c}pwned()\u{2029}pwned()\npwned() \\",
    r#"" + pwned() + " ' pwned ' #{x} {{ 7*7 }} {% raw %} %} --> <!-- ]]>"#,
    r##"`${pwned()}` """ pwned ''' "; pwned(); </script><script>pwned()</script> <img src=x onerror=pwned()> ??/"##,
    r#"The "look" of it, in C:\new."#,
    r"From dark*/bright `a` ${b} to C:\new\",
    "\u{202e}pwned\u{2066} /\u{feff}* *\u{feff}/ pwned()",
    "Strength of the effect, which is far longer than the sixty-three bytes that some reader has room for: \"pwned\"",
];

/// A kernel with these words as documentation, as any of the engines takes it.
fn documented(kernel: &str, first: &str, second: &str) -> Subject {
    let text = format!(
        "use straightline_kernels::prelude::*;\noptions! {{\n    #[doc = {kernel:?}]\n    pub struct O {{\n        \
        #[doc = {first:?}]\n        pub amount: f32 [0.0..=1.0] = uniform(0.5),\n        \
        #[doc = {second:?}]\n        pub other: f32 = uniform(0.25),\n    }}\n}}\n#[doc = {kernel:?}]\n\
        pub fn words(cfg: &O, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{\n    color.load(pixel) * cfg.amount + cfg.other\n}}\n"
    );
    let kernel = Kernel::from_text("words.rs", &text, "words");
    let compiled = kernel
        .compile(&Settings::default())
        .unwrap_or_else(|e| panic!("{text}\n{e}"));
    let options = kernel.options().unwrap_or_else(|e| panic!("{e}"));
    Subject {
        name: "words",
        compiled,
        options,
    }
}

/// Whatever the words, the code of each file is that of a kernel with plain ones, and compilers read it.
#[test]
fn words_of_authors_stay_words() {
    let plain = documented("Plain.", "Plain.", "Plain.");
    for (k, words) in HOSTILE.iter().enumerate() {
        let hostile = documented(
            words,
            HOSTILE[(k + 1) % HOSTILE.len()],
            HOSTILE[(k + 4) % HOSTILE.len()],
        );
        for engine in engine_names() {
            let [wanted, found] = [&plain, &hostile].map(|subject| texts(subject, engine));
            readable::check(engine, &found).unwrap_or_else(|e| panic!("{engine}, {words:?}: {e}"));
            assert!(wanted.keys().eq(found.keys()), "{engine}");
            for (name, text) in &found {
                if name == "README.md" {
                    let tags = ["<script", "</script", "<img", "<!--"];
                    assert!(tags.iter().all(|tag| !text.contains(tag)), "{engine}: {text}");
                    continue;
                }
                let [wanted, found] = [&wanted[name], text].map(|text| {
                    without_words(name, text).unwrap_or_else(|e| panic!("{engine}, {name}, {words:?}: {e}\n{text}"))
                });
                assert_eq!(found, wanted, "{engine}, {name}, {words:?}:\n{text}");
                // mpv, libretro and Godot read directives line by line.
                let directive = |line: &&str| line.starts_with("//!") || line.starts_with("#pragma parameter");
                let parameters = text.lines().filter(|line| line.starts_with("#pragma parameter"));
                for line in parameters {
                    let description = line.split('"').nth(1).unwrap_or_default();
                    assert!(description.len() <= 63 && line.matches('"').count() == 2, "{line}");
                }
                let directives = text.lines().filter(directive).count();
                assert!(
                    directives == 0 || name.ends_with(".glsl") || name.ends_with(".slang") || name.ends_with(".rs")
                );
            }
        }
    }
}

/// As above, of words put together at random from what is special somewhere. Comparing code takes no compilers.
#[test]
fn words_at_random_stay_words() {
    const PIECES: [&str; 24] = [
        "*/",
        "/*",
        "//",
        "\\",
        "\"",
        "'",
        "`",
        "${",
        "}",
        "\n",
        "\r",
        "\u{2028}",
        "\u{85}",
        "??/",
        "#",
        "{{",
        "%}",
        "-->",
        "<!--",
        "</script>",
        "\u{202e}",
        "*\u{feff}/",
        " ",
        "pwned",
    ];
    let mut state = 1u32;
    let mut next = || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (state >> 16) as usize
    };
    let plain = documented("Plain.", "Plain.", "Plain.");
    for _ in 0..60 {
        let [kernel, first, second] = [(); 3].map(|()| {
            (0..=next() % 12)
                .map(|_| PIECES[next() % PIECES.len()])
                .chain(["word"])
                .rev()
                .collect::<String>()
        });
        let hostile = documented(&kernel, &first, &second);
        for engine in engine_names() {
            let [wanted, found] = [&plain, &hostile].map(|subject| texts(subject, engine));
            for (name, text) in found.iter().filter(|(name, _)| *name != "README.md") {
                let [wanted, found] = [&wanted[name], text].map(|text| {
                    without_words(name, text).unwrap_or_else(|e| panic!("{engine}, {name}, {kernel:?}, {first:?}: {e}"))
                });
                assert_eq!(
                    found, wanted,
                    "{engine}, {name}, {kernel:?}, {first:?}, {second:?}:\n{text}"
                );
            }
        }
    }
}

/// Files of an engine as text, by name.
fn texts(subject: &Subject, engine: &str) -> BTreeMap<String, String> {
    let files = subject.files(engine).unwrap_or_else(|e| panic!("{engine}: {e}"));
    let texts = files
        .into_iter()
        .map(|(name, bytes)| (name, String::from_utf8(bytes).expect("text")));
    texts.collect()
}

/// A folder of a user's engine with these files.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, file: (&str, &str), template: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("straightline-hostile-{}-{name}", std::process::id()));
        std::fs::create_dir_all(path.join("engine")).expect("a folder");
        let toml = format!(
            "title = \"Mine\"\nabout = \"a text\"\n[shaders.a]\nlanguage = \"wgsl\"\n[files]\n{:?} = {:?}\n",
            file.0, file.1
        );
        std::fs::write(path.join("engine/engine.toml"), toml).expect("a file");
        std::fs::write(path.join("engine/t.tera"), template).expect("a file");
        std::fs::write(path.join("secret"), "secret").expect("a file");
        Folder(path)
    }

    /// The message of the error that it leads to.
    fn refused(&self) -> String {
        let plain = documented("Plain.", "Plain.", "Plain.");
        let found = Engine::find(&self.0.join("engine").to_string_lossy())
            .and_then(|engine| engine.render_files(&Request::new(&plain.compiled, &plain.options)));
        found.expect_err("a refusal").to_string()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Left over, it is in the way of nothing.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Nothing outside of an engine's folder is read.
#[test]
fn templates_lie_in_their_folder() {
    for (k, outside) in [
        "../secret",
        "/etc/hostname",
        "a/../../secret",
        "..\\secret",
        "C:secret",
        ".",
    ]
    .into_iter()
    .enumerate()
    {
        let message = Folder::new(&format!("outside-{k}"), (outside, "out.txt"), "").refused();
        assert!(
            message.contains(&format!("`{outside}` is no name of a template in its folder")),
            "{message}"
        );
    }
    #[cfg(unix)]
    {
        let folder = Folder::new("link", ("link.tera", "out.txt"), "");
        std::os::unix::fs::symlink(folder.0.join("secret"), folder.0.join("engine/link.tera")).expect("a link");
        let message = folder.refused();
        assert!(message.contains("a link out of the engine's folder"), "{message}");
    }
}

/// Files are what they are called, each made by one template.
#[test]
fn files_have_names_of_their_own() {
    let folder = Folder::new("twice", ("t.tera", "out.txt"), "text");
    let toml = std::fs::read_to_string(folder.0.join("engine/engine.toml")).expect("a file");
    std::fs::write(folder.0.join("engine/u.tera"), "other").expect("a file");
    std::fs::write(folder.0.join("engine/engine.toml"), toml + "\"u.tera\" = \"OUT.txt\"\n").expect("a file");
    let message = folder.refused();
    assert!(
        message.contains("two templates make one file: `out.txt` and `OUT.txt`"),
        "{message}"
    );
    for outside in ["../out", "/out", "a\\b", "c:d", "a\nb", ""] {
        let message = Folder::new("names", ("t.tera", outside), "text").refused();
        assert!(
            message.contains("is no name of a file in the folder"),
            "{outside:?}: {message}"
        );
    }
}

/// Templates end, and so do the files that they make.
#[test]
fn templates_have_limits() {
    let loops = |inside: &str| {
        let range = |name: &str| format!("{{% for {name} in range(end=100000) %}}");
        format!(
            "{}{}{}{inside}{}",
            range("a"),
            range("b"),
            range("c"),
            "{% endfor %}".repeat(3)
        )
    };
    let message = Folder::new("long", ("t.tera", "out.txt"), &loops(&"text".repeat(2048))).refused();
    assert!(message.contains("makes more than"), "{message}");
    let began = Instant::now();
    let message = Folder::new("endless", ("t.tera", "out.txt"), &loops("")).refused();
    assert!(message.contains("take longer than 10 s"), "{message}");
    // Not how fast it is, but that it ended: without the limit it would take days.
    assert!(began.elapsed() < Duration::from_secs(300));
    let large = Folder::new("large", ("t.tera", "out.txt"), &"x".repeat((1 << 20) + 1));
    assert!(large.refused().contains("at most 1048576 are read"));
}
