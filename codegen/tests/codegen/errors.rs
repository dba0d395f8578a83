//! Every message of the generator, as a user sees it: `tests/errors/NAME.rs` is refused with `NAME.txt`. Lines
//! `// set: OPTION=VALUE`, `// override: OPTIONS`, `// unroll: POLICY`, `// unroll-loop: LOOP=POLICY`, `// budget: N`, `// function: NAME`,
//! `// fuse: PICTURES`, `// stage: fragment`, `// target: LANGUAGE`, `// binding: NAME=N`, `// register: NAME=REGISTER`, `// entry: NAME`, `// parameters: SPACE`, `// form: FORM` and
//! `// origin: ORIGIN` at the top of a case say how it is compiled and emitted.
//!
//! `STRAIGHTLINE_BLESS=1` writes what the messages are now.

use std::path::{Path, PathBuf};
use straightline_codegen::chain::{Chain, ChainSpec, Fuse};
use straightline_codegen::{EmitOptions, Kernel, Settings, ShaderSpec, Stage};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/errors")
}

fn cases() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder()).expect("tests/errors");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "rs"));
    paths.sort();
    paths
}

/// Returns the message that refuses a case.
fn message(path: &Path) -> Result<String, String> {
    let text = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut settings = Settings::default();
    let mut options = EmitOptions::new();
    let mut function = "k".to_owned();
    let mut fuse = Fuse::None;
    for line in text.lines().map_while(|line| line.strip_prefix("// ")) {
        let (what, value) = line.split_once(": ").ok_or("a directive is `// WHAT: VALUE`")?;
        let pair = || value.split_once('=').ok_or("a pair is NAME=VALUE".to_owned());
        match what {
            "set" => settings
                .options
                .push(pair().map(|(a, b)| (a.to_owned(), b.to_owned()))?),
            "override" => settings = settings.override_options(value.split(',')),
            "unroll" => settings.unroll = value.parse()?,
            "unroll-loop" => {
                let (path, policy) = pair()?;
                settings.loops.push((path.to_owned(), policy.parse()?));
            }
            "budget" => settings.budget = value.parse().map_err(|_| "a number")?,
            "function" => value.clone_into(&mut function),
            "fuse" => fuse = value.parse()?,
            "stage" => options.stage = Stage::Fragment,
            "target" => options = options.targets([value.parse()?]),
            "binding" => {
                let (name, number) = pair()?;
                options = options.binding(name, number.parse().map_err(|_| "a number")?);
            }
            "register" => {
                let (name, register) = pair()?;
                options = options.register(name, register.parse()?);
            }
            "parameters" => options.parameters = value.parse()?,
            "entry" => options = options.entry(value),
            "form" => options.form = value.parse()?,
            "origin" => options.origin = value.parse()?,
            other => return Err(format!("no such directive: {other}")),
        }
    }
    match Chain::find(&name, &text, Some(&function), &function) {
        Err(errors) => return Ok(errors.render(false)),
        Ok(None) => {}
        Ok(Some(chain)) => {
            let mut spec = ShaderSpec::new();
            (spec.settings, spec.emit) = (settings, options);
            let compiled = chain.compile(&ChainSpec::from(spec).fuse(fuse));
            return match compiled.and_then(|compiled| compiled.emit()) {
                Err(errors) => Ok(errors.render(false)),
                Ok(_) => Err("it is a chain".to_owned()),
            };
        }
    }
    let kernel = Kernel::from_text(&name, &text, &function);
    let emitted = kernel.compile(&settings).and_then(|compiled| compiled.emit(&options));
    match emitted.map(|_| ()).and_then(|()| kernel.check_others()) {
        Err(errors) => Ok(errors.render(false)),
        Ok(()) => Err("it is a kernel".to_owned()),
    }
}

#[test]
fn messages_are_as_they_were() {
    let bless = std::env::var_os("STRAIGHTLINE_BLESS").is_some();
    let cases = cases();
    assert!(cases.len() >= 60, "{} cases", cases.len());
    let mut wrong = Vec::new();
    for path in &cases {
        let shown = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let found = message(path).unwrap_or_else(|e| panic!("{shown}: {e}"));
        assert!(
            !found.contains("mistake in Straightline"),
            "{shown} blames the generator:\n{found}"
        );
        let expected = path.with_extension("txt");
        if bless {
            std::fs::write(&expected, found).expect("the message is written");
        } else if std::fs::read_to_string(&expected).unwrap_or_default() != found {
            wrong.push(format!("{shown}:\n{found}"));
        }
    }
    assert!(
        wrong.is_empty(),
        "messages changed; look at them, and bless them with STRAIGHTLINE_BLESS=1:\n{}",
        wrong.join("\n")
    );
}

/// Each says where it is, unless it is about the command, and how to go on.
#[test]
fn messages_have_a_place_and_help() {
    let mut without = Vec::new();
    for path in cases() {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let found = message(&path).unwrap_or_default();
        let about_the_command = ["emit_", "option_", "entry_", "no_such_loop"];
        let placed = found.contains("┌─") || about_the_command.iter().any(|p| name.starts_with(p));
        // rustc gives the help for a syntax error, of a wrong number of arguments and the like.
        let plain = name.starts_with("syntax_") || found.contains("┌─");
        if !placed || !(plain || found.contains("help:") || found.contains(": ")) {
            without.push(name);
        }
    }
    assert!(without.is_empty(), "{without:?}");
}

/// `docs/kernel-language.md` shows five of them as they are.
#[test]
fn the_page_shows_messages_as_they_are() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/kernel-language.md");
    let text = std::fs::read_to_string(&page).expect("the page");
    let (head, rest) = text.split_once("<!-- errors -->\n").expect("the place for errors");
    let (_, tail) = rest.split_once("<!-- end of errors -->").expect("its end");
    let chosen = [
        "budget",
        "fused_roundings",
        "while_unrolled_by_attribute",
        "argument_of_another_type",
        "array_of_textures_at_run_time",
    ];
    let shown: String = chosen
        .iter()
        .map(|name| {
            let message = message(&folder().join(format!("{name}.rs"))).unwrap_or_else(|e| panic!("{name}: {e}"));
            format!("\n```text\n{message}```\n")
        })
        .collect();
    let wanted = format!("{head}<!-- errors -->\n{shown}\n<!-- end of errors -->{tail}");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(&page, wanted).expect("the page is written");
    } else {
        assert_eq!(text, wanted, "bless with STRAIGHTLINE_BLESS=1");
    }
}
