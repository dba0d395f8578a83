//! Rules of source files, in this crate and in the evaluator: which files import each other, and that passes name their file tests.

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Files by their modules, as `emit::print::glsl`; a folder's `mod.rs` and the crate's `lib.rs` by the folder.
type Modules = BTreeMap<Vec<String>, PathBuf>;

/// Modules whose files define types that hold each other.
const TYPES_OF_EACH_OTHER: [&[&str]; 1] = [&[
    "eval::control",
    "eval::endless",
    "eval::enums",
    "eval::types",
    "eval::value",
]];

/// Files of the evaluator whose functions call each other: expressions hold statements, loops hold loops.
const MUTUALLY_RECURSIVE: [&[&str]; 4] = [
    &["eval::loops::for_loops", "eval::loops::partial"],
    &[
        "front::cfg",
        "front::choice",
        "front::expr",
        "front::names",
        "front::parts",
        "front::targets",
    ],
    &["front::foreign", "front::items"],
    &["interp::cube", "interp::sampling"],
];

fn modules(root: &Path) -> Modules {
    let mut files = Vec::new();
    collect(root, &mut files);
    let named = files.into_iter().map(|path| {
        let inside = path.strip_prefix(root).expect("inside").with_extension("");
        let mut names: Vec<String> = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        if ["lib", "mod"].contains(&names.last().map_or("", String::as_str)) {
            names.pop();
        }
        (names, path)
    });
    named.collect()
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

/// Paths in a text that begin with `crate`, `self` or `super`; of a group in braces each.
fn paths(tokens: TokenStream, before: &[String], found: &mut Vec<Vec<String>>) {
    let mut path: Vec<String> = before.to_vec();
    let mut colons = if before.is_empty() { 0 } else { 2 };
    let mut end = |path: &mut Vec<String>| {
        if path.len() > 1 {
            found.push(std::mem::take(path));
        }
        path.clear();
    };
    let mut groups = Vec::new();
    for token in tokens {
        match token {
            TokenTree::Ident(word) => {
                let (word, rooted) = (word.to_string(), !path.is_empty());
                if !(rooted && colons == 2) {
                    end(&mut path);
                    // Of a group each name goes on from what stands before the braces.
                    path.extend_from_slice(before);
                }
                if !path.is_empty() || ["crate", "self", "super"].contains(&word.as_str()) {
                    path.push(word);
                }
                colons = 0;
            }
            TokenTree::Punct(punct) if punct.as_char() == ':' => colons += 1,
            TokenTree::Group(group) => {
                let inner = if colons == 2 {
                    std::mem::take(&mut path)
                } else {
                    Vec::new()
                };
                end(&mut path);
                groups.push((group.stream(), inner));
                colons = 0;
            }
            _ => {
                end(&mut path);
                colons = 0;
            }
        }
    }
    end(&mut path);
    groups
        .into_iter()
        .for_each(|(tokens, inner)| paths(tokens, &inner, found));
}

/// The modules that each module names, tests left out.
fn imports(modules: &Modules) -> BTreeMap<&[String], BTreeSet<&[String]>> {
    let resolved = |own: &[String], path: &[String]| {
        let supers = path.iter().take_while(|word| *word == "super").count();
        let mut whole = match path[0].as_str() {
            "crate" => path[1..].to_vec(),
            "self" => [own, &path[1..]].concat(),
            _ => [&own[..own.len().saturating_sub(supers)], &path[supers..]].concat(),
        };
        while !whole.is_empty() && !modules.contains_key(&whole) {
            whole.pop();
        }
        modules.get_key_value(&whole).map(|(name, _)| name.as_slice())
    };
    let of = |(own, path): (&Vec<String>, &PathBuf)| {
        let text = std::fs::read_to_string(path).expect("a text");
        let file = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let items = file.items.iter().map(ToTokens::to_token_stream);
        let items = items.filter(|item| !item.to_string().contains("# [cfg (test)]"));
        let mut found = Vec::new();
        items.for_each(|item| paths(item, &[], &mut found));
        found
            .iter()
            .filter_map(|path| resolved(own, path))
            .filter(|of| !of.is_empty() && *of != own.as_slice())
            .collect()
    };
    modules
        .iter()
        .map(|(own, path)| (own.as_slice(), of((own, path))))
        .collect()
}

/// Modules that one imports, and those that they import, and so on.
fn reach<'m>(imports: &BTreeMap<&'m [String], BTreeSet<&'m [String]>>, from: &'m [String]) -> BTreeSet<&'m [String]> {
    let (mut reached, mut pending) = (BTreeSet::new(), vec![from]);
    while let Some(one) = pending.pop() {
        pending.extend(imports[one].iter().filter(|of| reached.insert(**of)));
    }
    reached
}

/// Groups of modules that import each other, by their names.
fn circles(imports: &BTreeMap<&[String], BTreeSet<&[String]>>) -> BTreeSet<Vec<String>> {
    let reached: BTreeMap<&[String], _> = imports.keys().map(|one| (*one, reach(imports, one))).collect();
    let together = imports.keys().map(|one| {
        let group = reached[one].iter().filter(|other| reached[**other].contains(one));
        group.map(|names| names.join("::")).collect::<Vec<_>>()
    });
    together.filter(|group| !group.is_empty()).collect()
}

#[test]
fn imports_go_one_way() {
    for (of, module, its, known) in [
        (
            "evaluator",
            "eval",
            "front",
            [&TYPES_OF_EACH_OTHER[..], &MUTUALLY_RECURSIVE].concat(),
        ),
        ("codegen", "pipeline", "emit", Vec::new()),
    ] {
        let modules = modules(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(of).join("src"));
        let imports = imports(&modules);
        let [from, to] = [module, its].map(|name| [name.to_owned()]);
        let reaches = |name: &[String]| imports[name].iter().any(|of| of.starts_with(&to));
        assert!(reaches(&from), "{imports:?}");
        let known: BTreeSet<Vec<String>> = known
            .iter()
            .map(|of| of.iter().map(|&name| name.to_owned()).collect())
            .collect();
        assert_eq!(circles(&imports), known, "files of {of} that import each other");
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
