//! Calling rustc on many kernels at once: each is a module of one crate.

use super::Text;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicU64, Ordering};

/// rustc, and where the crates that kernels use have been built.
#[derive(Clone, Debug)]
pub struct Rustc {
    program: PathBuf,
    /// Folder of the workspace's built crates.
    built: PathBuf,
    /// The crate of the prelude.
    prelude: PathBuf,
    folder: PathBuf,
}

/// Verdict of rustc on a kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Compiles.
    Accepted,
    /// The first error in it.
    Refused(String),
}

static NEXT: AtomicU64 = AtomicU64::new(0);

impl Rustc {
    /// rustc from the path (or `RUSTC`), with the crates that were built beside this program.
    ///
    /// # Errors
    ///
    /// The prelude's crate is not there, or rustc cannot be run.
    pub fn find() -> Result<Rustc, String> {
        let program = std::env::var_os("RUSTC").map_or_else(|| PathBuf::from("rustc"), PathBuf::from);
        let this = std::env::current_exe().map_err(|e| e.to_string())?;
        let beside = this.parent().ok_or("this program lies in no folder")?;
        let built = if beside.ends_with("deps") {
            beside.to_owned()
        } else {
            beside.join("deps")
        };
        let folder = built.join("oracle");
        std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        let mut rustc = Rustc {
            program,
            built,
            prelude: PathBuf::new(),
            folder,
        };
        let mut why = String::from("no `libstraightline_kernels-*.rlib` beside this program");
        for prelude in rustc.preludes() {
            rustc.prelude = prelude;
            let probe = "#![allow(unused)]\nuse straightline_kernels::prelude::*;\npub fn k(a: &Frame<Vec4>) {}\n";
            match rustc.compile(probe, &["--crate-type=lib", "--emit=metadata"]) {
                Ok(_) => return Ok(rustc),
                Err(text) => why = text,
            }
        }
        Err(why)
    }

    /// Candidates for the prelude's crate, the newest first.
    fn preludes(&self) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(&self.built).into_iter().flatten().flatten();
        let mut found: Vec<_> = entries
            .filter(|entry| {
                let name = entry.file_name().to_string_lossy().into_owned();
                name.starts_with("libstraightline_kernels-") && name.ends_with(".rlib")
            })
            .filter_map(|entry| Some((entry.metadata().ok()?.modified().ok()?, entry.path())))
            .collect();
        found.sort();
        found.into_iter().rev().map(|(_, path)| path).collect()
    }

    /// A path for a file of this process that no other call uses.
    pub(super) fn scratch(&self, ending: &str) -> PathBuf {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        self.folder.join(format!("b{}-{number}{ending}", std::process::id()))
    }

    /// Compiles a crate and gives where its output lies, or the errors as rustc's lines of JSON.
    pub(super) fn compile(&self, source: &str, flags: &[&str]) -> Result<PathBuf, String> {
        let (file, out) = (self.scratch(".rs"), self.scratch(""));
        std::fs::write(&file, source).map_err(|e| format!("{}: {e}", file.display()))?;
        let output = self.invoke(&file, &out, flags);
        let _ = std::fs::remove_file(&file);
        let output = output?;
        if output.status.success() {
            Ok(out)
        } else {
            let _ = std::fs::remove_file(&out);
            Err(String::from_utf8_lossy(&output.stderr).into_owned())
        }
    }

    fn invoke(&self, file: &Path, out: &Path, flags: &[&str]) -> Result<Output, String> {
        let mut command = Command::new(&self.program);
        command.args(["--edition=2024", "--error-format=json", "--cap-lints=allow"]);
        command.args([
            "-Cdebuginfo=0",
            "-Coverflow-checks=off",
            "-Cdebug-assertions=off",
            "-Copt-level=0",
        ]);
        command.args(["--crate-name", "batch"]).args(flags);
        command
            .arg("--extern")
            .arg(format!("straightline_kernels={}", self.prelude.display()));
        command.arg("-L").arg(format!("dependency={}", self.built.display()));
        command.arg("-o").arg(out).arg(file);
        command.output().map_err(|e| format!("{}: {e}", self.program.display()))
    }

    /// Returns rustc's verdict on each text, all checks included.
    ///
    /// # Errors
    ///
    /// rustc cannot be run, or says something that belongs to no kernel.
    pub fn judge(&self, texts: &[Text]) -> Result<Vec<Verdict>, String> {
        let mut verdicts = vec![Verdict::Accepted; texts.len()];
        // An error in one module can hide those of another, so the rest is tried again until nothing is left to say.
        loop {
            let (source, lines) = modules(texts, &verdicts, |_| String::new());
            if lines.is_empty() {
                return Ok(verdicts);
            }
            let errors = match self.compile(&source, &["--crate-type=lib", "--emit=metadata"]) {
                Ok(out) => {
                    let _ = std::fs::remove_file(out);
                    return Ok(verdicts);
                }
                Err(errors) => errors,
            };
            refuse(&errors, &lines, &mut verdicts)?;
        }
    }
}

/// Notes which modules errors of rustc belong to.
///
/// # Errors
///
/// They belong to none.
pub(super) fn refuse(errors: &str, lines: &[(usize, usize)], verdicts: &mut [Verdict]) -> Result<(), String> {
    let mut found = BTreeSet::new();
    for (line, message) in errors.lines().filter_map(error) {
        let at = lines.partition_point(|(first, _)| *first <= line);
        let Some((_, k)) = at.checked_sub(1).map(|at| lines[at]) else {
            return Err(message);
        };
        if found.insert(k) {
            verdicts[k] = Verdict::Refused(message);
        }
    }
    if found.is_empty() {
        Err(errors.to_owned())
    } else {
        Ok(())
    }
}

/// Writes a module for each text that is not refused yet, each with the addition for it; returns the first line of each and
/// its number.
pub(super) fn modules(
    texts: &[Text],
    verdicts: &[Verdict],
    added: impl Fn(usize) -> String,
) -> (String, Vec<(usize, usize)>) {
    let mut source = String::new();
    let mut lines = Vec::new();
    let mut line = 1;
    for (k, text) in texts.iter().enumerate() {
        if verdicts[k] != Verdict::Accepted {
            continue;
        }
        let module = module(k, text, &added(k));
        lines.push((line, k));
        line += module.lines().count();
        source += &module;
    }
    (source, lines)
}

/// The module of a text.
fn module(k: usize, text: &Text, added: &str) -> String {
    format!(
        "pub mod k{k} {{\nuse straightline_kernels::prelude::*;\n{}\n{added}\n}}\n",
        text.source
    )
}

/// Line and message of an error in rustc's JSON.
fn error(json: &str) -> Option<(usize, String)> {
    let value: serde_json::Value = serde_json::from_str(json).ok()?;
    if value["level"] != "error" {
        return None;
    }
    let spans = value["spans"].as_array()?;
    let primary = spans.iter().find(|span| span["is_primary"] == true)?;
    let said = value["message"].as_str()?;
    let message = match value["code"]["code"].as_str() {
        Some(code) => format!("{code}: {said}"),
        None => said.to_owned(),
    };
    // An error inside a macro of the prelude names the place in the kernel that called it.
    let mut place = primary;
    while place["expansion"].is_object()
        && place["file_name"]
            .as_str()
            .is_some_and(|f| f.starts_with('/') && !f.contains("oracle"))
    {
        place = &place["expansion"]["span"];
    }
    Some((place["line_start"].as_u64()? as usize, message))
}
