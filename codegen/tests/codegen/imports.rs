//! Rules of source files, in this crate and in the evaluator: no module is part of a circle of imports, and passes name their file tests.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A crate's modules that each of them names as `crate::module`, tests left out.
fn imports(of: &str) -> BTreeMap<String, BTreeSet<String>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(of).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    let module = |path: &Path| {
        let first = path.strip_prefix(&root).expect("inside").components().next();
        let name = first.expect("a file").as_os_str().to_string_lossy().into_owned();
        name.trim_end_matches(".rs").to_owned()
    };
    let modules: BTreeSet<String> = files.iter().map(|path| module(path)).collect();
    let mut imports: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for path in &files {
        let (text, own) = (std::fs::read_to_string(path).expect("a text"), module(path));
        let text = text.split("#[cfg(test)]").next().unwrap_or_default();
        for after in text.split("crate::").skip(1) {
            // One, or several in braces, each of which may have more in its own.
            let end = if after.starts_with('{') { ';' } else { ':' };
            let names = after.split(end).next().unwrap_or_default();
            let names = names.split(|c: char| !c.is_alphanumeric() && c != '_');
            let known = names.filter(|name| modules.contains(*name) && *name != own);
            imports.entry(own.clone()).or_default().extend(known.map(str::to_owned));
        }
    }
    imports
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.extension() {
            _ if path.is_dir() => collect(&path, files),
            Some(extension) if extension == "rs" => files.push(path),
            _ => {}
        }
    }
}

/// Takes away what imports nothing that is left, which is in no circle, until nothing more goes.
fn circles(mut left: BTreeMap<String, BTreeSet<String>>) -> BTreeMap<String, BTreeSet<String>> {
    loop {
        let there: BTreeSet<String> = left.keys().cloned().collect();
        let before = left.len();
        left.retain(|_, of| of.iter().any(|name| there.contains(name)));
        if left.len() == before {
            return left;
        }
    }
}

#[test]
fn imports_go_one_way() {
    for (of, module, its) in [("evaluator", "eval", "front"), ("codegen", "pipeline", "emit")] {
        let imports = imports(of);
        assert!(imports[module].contains(its), "{imports:?}");
        let left = circles(imports);
        assert!(left.is_empty(), "these import each other, or what does: {left:?}");
    }
}

/// Modules name the folders of their file tests, and every folder of passes has a module that names it.
#[test]
fn modules_name_their_file_tests() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    for folder in ["evaluator/src", "codegen/src"] {
        collect(&root.join(folder), &mut files);
    }
    let mut named = BTreeSet::new();
    for path in &files {
        let text = std::fs::read_to_string(path).expect("a text");
        let line = text.lines().find_map(|line| line.strip_prefix("//! File tests: `"));
        if let Some(folder) = line.and_then(|line| line.strip_suffix("`.")) {
            let cases = std::fs::read_dir(root.join(folder)).map_or(0, Iterator::count);
            assert!(cases > 0, "{}: no file tests in {folder}", path.display());
            named.insert(root.join(folder));
        }
    }
    let passes = std::fs::read_dir(root.join("evaluator/tests/filetests/passes")).expect("a folder a pass");
    for folder in passes.map(|entry| entry.expect("an entry").path()) {
        assert!(named.contains(&folder), "no pass names {}", folder.display());
    }
}
