//! The graph as text: passes on `tests/filetests/*.ir`, and printing and parsing there and back.
//!
//! A case says `// run: PASS` and holds, after a line `// gives`, what the pass makes of the graph before it; or
//! `// verify: TEXT` or `// parse: TEXT`, what is said of it. `STRAIGHTLINE_BLESS=1` writes what passes give now.

use std::path::{Path, PathBuf};
use straightline_codegen::ir::{parse, print, verify};
use straightline_codegen::{Kernel, Settings, Unroll, passes};

const GIVES: &str = "// gives\n";

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("filetests");
    let entries = std::fs::read_dir(folder).expect("tests/filetests");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
    paths.sort();
    paths
}

fn directive<'t>(text: &'t str, name: &str) -> Option<&'t str> {
    text.lines()
        .find_map(|line| line.strip_prefix("// ")?.strip_prefix(name)?.strip_prefix(": "))
}

/// The case with what it gives now.
fn now(text: &str) -> Result<String, String> {
    let input = text.split(GIVES).next().unwrap_or_default();
    let parsed = parse(input);
    if let Some(expected) = directive(text, "parse") {
        return match parsed {
            Err(error) if error.to_string().contains(expected) => Ok(text.to_owned()),
            other => Err(format!("parsing gives {:?}", other.err().map(|e| e.to_string()))),
        };
    }
    let graph = parsed.map_err(|e| e.to_string())?;
    let verified = verify::verify(&graph);
    if let Some(expected) = directive(text, "verify") {
        return match verified {
            Err(why) if why.contains(expected) => Ok(text.to_owned()),
            other => Err(format!("verification gives {other:?}")),
        };
    }
    verified?;
    let made = match directive(text, "run").ok_or("no directive")? {
        "clean" => passes::clean(&graph),
        "share-loads" => passes::share_loads(&graph),
        other => return Err(format!("there is no pass `{other}`")),
    };
    verify::verify(&made)?;
    Ok(format!("{input}{GIVES}{}", print(&made)))
}

#[test]
fn passes_give_what_the_files_say() {
    let bless = std::env::var_os("STRAIGHTLINE_BLESS").is_some();
    let cases = cases();
    assert!(cases.len() >= 15);
    for path in cases {
        let text = std::fs::read_to_string(&path).expect("a case");
        let found = now(&text).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
        if bless {
            std::fs::write(&path, found).expect("the case is written");
        } else {
            assert_eq!(text, found, "{}: bless with STRAIGHTLINE_BLESS=1", path.display());
        }
    }
}

/// Every graph of the kernels, after every stage, is the same graph when it is read back.
#[test]
fn printed_graphs_read_back() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/kernels");
    let mut kernels = vec![Kernel::builtin("sraa").expect("built in")];
    for entry in std::fs::read_dir(examples).expect("examples/kernels") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|e| e == "rs") {
            kernels.push(Kernel::from_file(&path, None).unwrap_or_else(|e| panic!("{e}")));
        }
    }
    assert!(kernels.len() > 10);
    for kernel in kernels {
        for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(2)] {
            let settings = Settings {
                unroll,
                ..Settings::default()
            };
            let mut observe = |stage: &str, graph: &straightline_codegen::ir::Graph| {
                let text = print(graph);
                let again = parse(&text).unwrap_or_else(|e| panic!("{} after {stage}: {e}", kernel.name()));
                assert_eq!(again.nodes, graph.nodes, "{} after {stage}", kernel.name());
                assert_eq!(print(&again), text, "{} after {stage}", kernel.name());
                verify::verify(&again).unwrap_or_else(|e| panic!("{} after {stage}: {e}", kernel.name()));
            };
            kernel
                .compile_observed(&settings, &mut observe)
                .unwrap_or_else(|e| panic!("{e}"));
        }
    }
}
