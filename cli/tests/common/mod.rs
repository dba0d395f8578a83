//! The command line as its user sees it: arguments in, status and words out.
#![allow(dead_code, reason = "no test program calls everything")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs the binary.
pub fn straightline(arguments: &[&str]) -> Output {
    let binary = env!("CARGO_BIN_EXE_straightline");
    Command::new(binary).args(arguments).output().expect("the binary runs")
}

/// Runs it to success; what it printed.
pub fn finishes(arguments: &[&str]) -> String {
    let output = straightline(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?} said: {error}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Runs it to failure with `status` (1: the work failed, 2: the words are wrong), and sees that it `says` why.
pub fn fails(arguments: &[&str], status: i32, says: &[&str]) {
    let output = straightline(arguments);
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{arguments:?} said: {error}");
    for text in says {
        assert!(
            error.contains(text),
            "{arguments:?} does not say `{text}` but:\n{error}"
        );
    }
    assert!(!error.contains("panicked"), "{error}");
}

/// An empty folder of the test's own.
pub fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a scratch folder");
    folder
}

/// A file of the workspace.
pub fn here(path: &str) -> String {
    format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"))
}

/// A file in a folder; its path.
pub fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a file is written");
    path.display().to_string()
}

/// Returns whether a folder does not exist or is empty.
pub fn is_empty(folder: &Path) -> bool {
    !folder.exists() || std::fs::read_dir(folder).expect("a folder").next().is_none()
}

/// A kernel of `kernels/filters`.
pub fn example(name: &str) -> String {
    here(&format!("kernels/filters/{name}.rs"))
}
