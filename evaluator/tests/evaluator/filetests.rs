//! Passes on graphs as text: `tests/filetests/passes/PASS/*.ir`, and texts that are refused.
//!
//! A case is a graph of a few nodes with a directive:
//!
//! - `// run: PASS`, or `// run: half NAMES`: the graph after `// gives` is the result of the pass.
//! - `// verify: TEXT` or `// parse: TEXT`: the error contains the text.

use crate::cases::{self, directive, input, with_output};
use straightline_evaluator::ir::{parse, print, verify};
use straightline_evaluator::passes;

/// The case with the output that it has now.
fn now(text: &str) -> Result<String, String> {
    let input = input(text);
    let parsed = parse(input);
    if let Some(expected) = directive(text, "parse") {
        return match parsed {
            Err(error) if error.to_string().contains(expected) => Ok(text.to_owned()),
            other => Err(format!("parsing gives {:?}", other.err().map(|e| e.to_string()))),
        };
    }
    let graph = parsed.map_err(|e| e.to_string())?;
    let verified = verify::verify_graph(&graph);
    if let Some(expected) = directive(text, "verify") {
        return match verified {
            Err(why) if why.contains(expected) => Ok(text.to_owned()),
            other => Err(format!("verification gives {other:?}")),
        };
    }
    verified?;
    let directive = directive(text, "run").ok_or("no directive")?;
    let (pass, names) = directive.split_once(' ').unwrap_or((directive, ""));
    let names = || names.split(' ').map(str::to_owned).collect();
    let made = match pass {
        "clean" => passes::clean_graph(&graph),
        "share-loads" => passes::share_loads(&graph),
        "coordinates" => passes::clean_graph(&passes::by_component(&graph)),
        "exactness" => passes::clean_graph(&passes::mark_exact_ops(&graph)),
        "fast" => passes::clean_graph(&passes::apply_fast_math(&graph)),
        "half" => passes::clean_graph(&passes::lower_to_half(&graph, &names())),
        "gathers" => passes::clean_graph(&passes::form_gathers(&graph)?.0),
        "share-by-workgroup" => passes::clean_graph(&passes::by_workgroup(&graph, [4, 4])?.0),
        other => return Err(format!("there is no pass `{other}`")),
    };
    verify::verify_graph(&made)?;
    Ok(with_output(input, &print(&made)))
}

#[test]
fn passes_make_the_graphs_of_the_files() {
    cases::run(60, now);
}
