//! Output for engines: the kernels that fit each engine, and compilation of the texts by compilers of the engines'
//! languages. A folder for each engine is kept in `tests/engines/snapshots` for readers. `tests/engines/run` runs the
//! engines.
//!
//! `STRAIGHTLINE_BLESS=1` writes the current output.

mod chains;
mod code;
mod hostile;
mod meanings;
pub mod readable;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use straightline_codegen::diagnostic::{Code, Errors};
use straightline_codegen::{Compiled, Kernel, OptionInfo, Settings};
use straightline_engines::{Engine, EngineError, Request, engine_names};

/// A kernel for engines.
struct Subject {
    name: &'static str,
    compiled: Compiled,
    options: Vec<OptionInfo>,
}

impl Subject {
    fn new(name: &'static str, path: &str, set: &[(&str, &str)]) -> Subject {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let kernel = match path {
            "" => Kernel::builtin(name),
            path => std::fs::read_to_string(root.join(path))
                .map(|text| Kernel::from_text(path, &text, name))
                .map_or_else(|e| panic!("{path}: {e}"), Ok),
        };
        let settings = Settings::new().set_all(set.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())));
        let made = kernel.and_then(|kernel| Ok((kernel.compile(&settings)?, kernel.options()?)));
        let (compiled, options) = made.unwrap_or_else(|errors| panic!("{name}:\n{errors}"));
        Subject {
            name,
            compiled,
            options,
        }
    }

    fn files(&self, engine: &str) -> Result<BTreeMap<String, Vec<u8>>, EngineError> {
        Engine::find(engine)?.render_files(&Request::new(&self.compiled, &self.options))
    }
}

fn subjects() -> Vec<Subject> {
    vec![
        Subject::new("sraa", "", &[]),
        Subject::new("kuwahara", "kernels/filters/kuwahara.rs", &[]),
        Subject::new("fxaa", "kernels/filters/fxaa.rs", &[]),
        Subject::new("bilateral", "kernels/filters/bilateral.rs", &[("sigma", "uniform")]),
        Subject::new("pcf", "", &[]),
        Subject::new("stretched", "tests/engines/kernels/stretched.rs", &[]),
        Subject::new("fog", "tests/engines/kernels/fog.rs", &[]),
        Subject::new("ssao", "kernels/filters/ssao.rs", &[]),
    ]
}

fn snapshots() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("engines/snapshots")
}

fn blesses() -> bool {
    std::env::var_os("STRAIGHTLINE_BLESS").is_some()
}

/// Compares a text with the one that is kept, or keeps it.
#[track_caller]
fn as_kept(path: &Path, found: &str) {
    if blesses() {
        let folder = path.parent().expect("a folder");
        std::fs::create_dir_all(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        std::fs::write(path, found).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        return;
    }
    let kept = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    assert!(
        kept == found,
        "{} is not what is emitted now (STRAIGHTLINE_BLESS=1 writes it):\n{found}",
        path.display()
    );
}

/// Code and message of an error, with what would fit.
fn refusal(errors: &Errors) -> String {
    let first = &errors.diagnostics[0];
    let code = first.code().map_or("", Code::number);
    let rest = first.notes.iter().chain(&first.help).cloned().collect::<Vec<_>>();
    format!("[{code}] {}; {}", first.message, rest.join("; "))
}

/// Each kernel on each engine: the files that are written, or why not and what would fit.
#[test]
fn every_kernel_is_emitted_or_refused_by_name() {
    let mut table = String::new();
    let subjects = subjects();
    for engine in engine_names() {
        for subject in &subjects {
            let outcome = match subject.files(engine) {
                Ok(files) => files.into_keys().collect::<Vec<_>>().join(", "),
                Err(EngineError::Kernel(errors)) => refusal(&errors),
                Err(error) => panic!("{} for {engine}: {error}", subject.name),
            };
            table += &format!("{engine}, {}: {outcome}\n", subject.name);
        }
    }
    as_kept(&snapshots().join("fits.txt"), &table);
}

/// Every shader of every folder is read by a compiler of its language, in what the engine puts around it.
#[test]
fn compilers_read_what_is_emitted() {
    let mut read = BTreeMap::<&str, usize>::new();
    for subject in subjects() {
        for engine in engine_names() {
            let Ok(files) = subject.files(engine) else { continue };
            let files: BTreeMap<String, String> = files
                .into_iter()
                .map(|(name, bytes)| (name, String::from_utf8(bytes).expect("text")))
                .collect();
            let count = readable::check(engine, &files);
            let count = count.unwrap_or_else(|e| panic!("{} for {engine}: {e}", subject.name));
            *read.entry(engine).or_default() += count;
        }
    }
    for engine in engine_names() {
        // A folder whose shader is not found would be read in silence.
        assert!(read.get(engine).is_some_and(|n| *n >= 2), "{engine}: {read:?}");
    }
}

/// An engine creates the pipeline, so its shaders have the defaults of overrides; their text declares them.
#[test]
fn overrides_have_their_defaults() {
    let subject = Subject::new(
        "bilateral",
        "kernels/filters/bilateral.rs",
        &[("sigma", "override(1.75)")],
    );
    let mut engines = 0;
    for engine in engine_names() {
        let files = subject.files(engine).unwrap_or_else(|e| panic!("{engine}: {e}"));
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
        let files: BTreeMap<String, String> = files.into_iter().map(|(name, bytes)| (name, text(bytes))).collect();
        let is_declared =
            |text: &String| text.contains("#define OVERRIDE_SIGMA 1.75") || text.contains("override sigma: f32 = 1.75");
        assert!(files.values().any(is_declared), "{engine}: {files:?}");
        readable::check(engine, &files).unwrap_or_else(|e| panic!("{engine}: {e}"));
        engines += 1;
    }
    assert!(engines > 9);
}

/// The folder of one small kernel, engine by engine.
#[test]
fn folders_are_as_they_were() {
    let subject = Subject::new(
        "orientation",
        "tests/engines/kernels/orientation.rs",
        &[("below", "uniform")],
    );
    for engine in engine_names() {
        let folder = snapshots().join(engine);
        let files = subject.files(engine).unwrap_or_else(|e| panic!("{engine}: {e}"));
        if blesses() && folder.exists() {
            std::fs::remove_dir_all(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        }
        for (name, bytes) in &files {
            let text = std::str::from_utf8(bytes).expect("text");
            assert!(
                !text.contains("{{") && !text.contains("{%"),
                "{engine}: {name} has tags of a template"
            );
            as_kept(&folder.join(name), text);
        }
        let kept = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        assert_eq!(kept.count(), files.len(), "{engine}: files that are not emitted");
        assert!(files.contains_key("README.md"), "{engine} has no README");
    }
}

/// A folder of a user's own is an engine, and what is wrong with one is said.
#[test]
fn folders_of_users_are_engines() {
    let subject = Subject::new("kuwahara", "kernels/filters/kuwahara.rs", &[]);
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/engines/shadertoy");
    let files = subject
        .files(&example.to_string_lossy())
        .unwrap_or_else(|e| panic!("{e}"));
    let text = std::str::from_utf8(&files["kuwahara.glsl"]).expect("text");
    assert!(
        text.contains("void mainImage(out vec4 fragColor, in vec2 fragCoord)"),
        "{text}"
    );
    readable::shadertoy(text).unwrap_or_else(|e| panic!("{e}"));

    let folder = std::env::temp_dir().join(format!("straightline-engine-{}", std::process::id()));
    let tried = |toml: &str| {
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(folder.join("engine.toml"), toml).expect("a file");
        std::fs::write(folder.join("t.tera"), "{{ nothing }}").expect("a file");
        let found = subject.files(&folder.to_string_lossy());
        found.expect_err("it is wrong").to_string()
    };
    let head = "title = \"Mine\"\nabout = \"a text\"\n[shaders.a]\n";
    for (toml, said) in [
        ("title = 3", "invalid type: integer"),
        (
            &format!("{head}language = \"msl\"\n[files]\n"),
            "`msl` is no language of engines",
        ),
        (
            &format!("{head}language = \"wgsl\"\n[files]\n"),
            "it names no shader, or no file",
        ),
        (
            &format!("{head}language = \"wgsl\"\n[files]\n\"t.tera\" = \"../a\"\n"),
            "fails: Variable `nothing` is not defined",
        ),
        (
            &format!("{head}language = \"wgsl\"\nwhat = 1\n[files]\n\"t.tera\" = \"a\"\n"),
            "a shader has no setting `what`",
        ),
        (
            &format!("{head}language = \"wgsl\"\n[files]\n\"none.tera\" = \"a\"\n"),
            "cannot read",
        ),
    ] {
        let message = tried(toml);
        assert!(message.contains(said), "{message}");
    }
    std::fs::write(folder.join("t.tera"), "text").expect("a file");
    let outside = format!("{head}language = \"wgsl\"\n[files]\n\"t.tera\" = \"../a\"\n");
    std::fs::write(folder.join("engine.toml"), outside).expect("a file");
    let message = subject
        .files(&folder.to_string_lossy())
        .expect_err("outside")
        .to_string();
    assert!(
        message.contains("`../a` is no name of a file in the folder"),
        "{message}"
    );
    std::fs::remove_dir_all(&folder).expect("the folder");
}

#[test]
fn engines_that_are_not_there_are_named() {
    let subject = Subject::new("kuwahara", "kernels/filters/kuwahara.rs", &[]);
    let message = subject.files("gdot").expect_err("no such engine").to_string();
    assert!(
        message.starts_with("there is no engine `gdot`: one of babylon, bevy, "),
        "{message}"
    );
}

/// The largest difference of a row of the record, and the share that lies within the bound where not all do.
fn difference(row: &serde_json::Value) -> String {
    let [most, within, limit] = ["most", "within", "limit"].map(|key| row[key].as_f64().expect("a number"));
    match (most, within) {
        (0.0, _) => "0".to_owned(),
        (most, 1.0) => format!("{most:.0e}"),
        (most, within) => format!("{most:.0e}; {:.1} % within {limit:.0e}", 100.0 * within),
    }
}

/// The table of `docs/engines.md` is that of the record of `tests/engines/run`.
#[test]
fn the_table_is_that_of_the_record() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let read = |path: &str| std::fs::read_to_string(root.join(path)).unwrap_or_else(|e| panic!("{path}: {e}"));
    let record: serde_json::Value = serde_json::from_str(&read("tests/engines/record.json")).expect("a record");
    let rows = record["rows"].as_array().expect("rows");
    let text = |row: &serde_json::Value, key: &str| row[key].as_str().unwrap_or_default().to_owned();
    let mut kernels: Vec<String> = Vec::new();
    let mut engines: Vec<String> = Vec::new();
    for row in rows {
        for (list, key) in [(&mut kernels, "kernel"), (&mut engines, "engine")] {
            let name = text(row, key);
            if !list.contains(&name) {
                list.push(name);
            }
        }
    }
    let line = |first: &str, cells: &[String]| format!("| {first} | {} |\n", cells.join(" | "));
    let mut table = line("engine", &kernels) + &line("---", &vec!["---".to_owned(); kernels.len()]);
    for engine in &engines {
        let cell = |kernel: &String| {
            let row = rows
                .iter()
                .find(|row| text(row, "engine") == *engine && text(row, "kernel") == *kernel);
            let row = row.unwrap_or_else(|| panic!("the record has no {kernel} on {engine}"));
            match text(row, "state").as_str() {
                "same" => difference(row),
                "refused" => {
                    let why = text(row, "why");
                    let why = why.split_once(": it ").map_or(why.as_str(), |(_, why)| why);
                    format!("refused: {}", why.split("; ").next().unwrap_or_default())
                }
                other => panic!("{kernel} on {engine}: {other}: a record is of a run that passes"),
            }
        };
        table += &line(engine, &kernels.iter().map(cell).collect::<Vec<_>>());
    }
    let path = "docs/engines.md";
    let document = read(path);
    let (before, rest) = document.split_once("<!-- engines record.json -->\n").expect("the mark");
    let (found, behind) = rest.split_once("<!-- end -->").expect("the end");
    if blesses() {
        let written = format!("{before}<!-- engines record.json -->\n{table}<!-- end -->{behind}");
        std::fs::write(root.join(path), written).unwrap_or_else(|e| panic!("{path}: {e}"));
        return;
    }
    assert_eq!(
        found, table,
        "{path} is not what the record says (STRAIGHTLINE_BLESS=1 writes it)"
    );
}
