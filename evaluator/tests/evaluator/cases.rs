//! Runs file tests: the text before a line `// gives` is the input, the text after it the expected output.
//!
//! - `STRAIGHTLINE_BLESS=1` writes the output into the files.
//! - `STRAIGHTLINE_FILETEST=passes/fold` runs only the files whose path below `filetests/` begins with `passes/fold`.
//!
//! Codegen's tests include this file too.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

const GIVES: &str = "// gives\n";

/// The input of a case: its text before `// gives`.
pub fn input(text: &str) -> &str {
    text.split(GIVES).next().unwrap_or_default()
}

/// A case with this input and output.
pub fn with_output(input: &str, output: &str) -> String {
    format!("{input}{GIVES}{output}")
}

/// The value of the first line `// NAME: VALUE`.
pub fn directive<'t>(text: &'t str, name: &str) -> Option<&'t str> {
    text.lines()
        .find_map(|line| line.strip_prefix("// ")?.strip_prefix(name)?.strip_prefix(": "))
}

/// Compares each case below `filetests/` of the crate with the text that `now` returns for it, several at once.
///
/// Panics with every case that differs, and if there are fewer than `least`.
pub fn run(least: usize, now: impl Fn(&str) -> Result<String, String> + Sync) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/filetests");
    let mut all = Vec::new();
    collect(&root, &mut all);
    all.sort();
    assert!(all.len() >= least, "{} cases", all.len());
    let name = |path: &Path| {
        let name = path.strip_prefix(&root).expect("below the root").with_extension("");
        name.to_string_lossy().replace('\\', "/")
    };
    if let Ok(chosen) = std::env::var("STRAIGHTLINE_FILETEST") {
        all.retain(|path| name(path).starts_with(&chosen));
        assert!(!all.is_empty(), "no file test begins with `{chosen}`");
    }
    let wrong = in_parallel(&all, |path| {
        check(path, &now).err().map(|why| format!("{}: {why}", name(path)))
    });
    let help = "bless with STRAIGHTLINE_BLESS=1";
    assert!(
        wrong.is_empty(),
        "{}\n{} of {} cases; {help}",
        wrong.join("\n\n"),
        wrong.len(),
        all.len()
    );
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    for entry in entries {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            collect(&path, files);
        } else {
            files.push(path);
        }
    }
}

/// Compares a case with its text now, or writes that text where the environment asks for it.
fn check(path: &Path, now: impl Fn(&str) -> Result<String, String>) -> Result<(), String> {
    let text = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
    let found = now(&text)?;
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(path, found).map_err(|e| e.to_string())
    } else if found != text {
        Err(format!("now it is\n{found}"))
    } else {
        Ok(())
    }
}

/// The results of `check` for all paths, in their order; a thread takes the next path when it is done with one.
fn in_parallel(paths: &[PathBuf], check: impl Fn(&Path) -> Option<String> + Sync) -> Vec<String> {
    let next = AtomicUsize::new(0);
    let work = || {
        let taken = std::iter::from_fn(|| paths.get(next.fetch_add(1, Ordering::Relaxed)));
        taken.filter_map(|path| Some((path, check(path)?))).collect::<Vec<_>>()
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut found: Vec<(&PathBuf, String)> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let found = threads.into_iter();
        found
            .flat_map(|thread| thread.join().expect("no case panics"))
            .collect()
    });
    found.sort();
    found.into_iter().map(|(_, why)| why).collect()
}
