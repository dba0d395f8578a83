//! Emission of graphs as text: `tests/filetests/{tidy,legalise}/*.ir`; and printing and parsing there and back.
//!
//! A case is a graph of a few nodes with a directive `// emit: TARGET`: after `// gives` stand the statements that are emitted for
//! it, without bindings and without the beginning of every entry point. `// emit: TARGET fragment` emits a fragment shader, `half` in
//! half precision, `rows` with reads in the order of rows. The language's compiler reads the shader.

use crate::cases::{self, directive, input, with_output};
use crate::compilers;
use std::path::Path;
use straightline_codegen::emit::Target;
use straightline_codegen::ir::{Graph, parse, print, verify};
use straightline_codegen::policy::Policy;
use straightline_codegen::{Compiled, EmitOptions, Kernel, Precision, ReadOrder, Settings, Stage, Unroll, passes};

/// Lines that a case of emission may have.
const LONGEST: usize = 30;

/// The case with the output that it has now.
fn now(text: &str, template: &Compiled) -> Result<String, String> {
    let input = input(text);
    let graph = parse(input).map_err(|e| e.to_string())?;
    verify::verify_graph(&graph)?;
    let how = directive(text, "emit").ok_or("no directive")?;
    let case = with_output(input, &emitted(graph, how, template)?);
    let lines = case.lines().count();
    match lines < LONGEST {
        true => Ok(case),
        false => Err(format!("{lines} lines: a case has less than {LONGEST}\n{case}")),
    }
}

/// A kernel whose graph and schedule are replaced by those of the cases.
fn template() -> Compiled {
    let text = "pub fn tested(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 { color.load(pixel) }";
    let kernel = Kernel::from_text("tested.rs", text, "tested");
    kernel
        .compile(&Settings::default())
        .unwrap_or_else(|errors| panic!("{errors}"))
}

/// The statements that are emitted for a graph.
fn emitted(graph: Graph, how: &str, template: &Compiled) -> Result<String, String> {
    let reads = match how.split(' ').any(|word| word == "rows") {
        true => ReadOrder::Rows,
        false => ReadOrder::Source,
    };
    let schedule = passes::schedule_graph(&graph, reads);
    let compiled = Compiled {
        counts: passes::count_operations(&graph, &schedule),
        graph,
        schedule,
        policy: Policy {
            reads,
            ..template.policy.clone()
        },
        ..template.clone()
    };
    let mut words = how.split(' ');
    let target: Target = words.next().unwrap_or_default().parse()?;
    let mut options = EmitOptions::new().targets([target]);
    for word in words {
        options = match word {
            "fragment" => options.stage(Stage::Fragment),
            "half" => options.precision(Precision::F16),
            "rows" => options,
            _ => return Err(format!("`{word}` is neither `fragment`, `half` nor `rows`")),
        };
    }
    let emitted = compiled.emit(&options).map_err(|e| e.to_string())?;
    compilers::read(&emitted)?;
    let text = String::from_utf8(emitted.files[&target].clone()).map_err(|e| e.to_string())?;
    Ok(of_the_kernel(&text))
}

/// Tables, functions and statements of a shader, without its bindings and without what every entry point begins with.
fn of_the_kernel(text: &str) -> String {
    let mut paragraphs: Vec<&str> = text.trim_end().split("\n\n").collect();
    let entry = paragraphs.pop().unwrap_or_default();
    let mut out = String::new();
    for paragraph in paragraphs {
        let mut code = paragraph.lines().filter(|line| !line.starts_with("//"));
        let first = code.next().unwrap_or_default();
        let binds = ["struct", "layout", "cbuffer", "@"]
            .iter()
            .any(|word| first.starts_with(word));
        let table = first.starts_with("const ") || first.starts_with("static const ");
        if table || (first.ends_with(" {") && !binds) {
            out += &format!("{paragraph}\n");
        }
    }
    // The entry point's head, of two lines where the stage stands before it, and its last brace.
    let mut lines: Vec<&str> = entry.lines().skip_while(|line| !line.ends_with('{')).skip(1).collect();
    lines.pop();
    let own = |line: &str| {
        let mut words = line.split_whitespace().skip(1);
        matches!(words.next(), Some("frame" | "pixel")) && words.next() == Some("=")
    };
    lines.retain(|line| !own(line));
    if let Some(at) = lines.iter().position(|line| line.trim() == "return;") {
        // The test whether the pixel lies outside.
        lines.drain(at - 1..at + 2);
    }
    out + &lines.join("\n") + "\n"
}

#[test]
fn graphs_are_emitted_as_in_the_files() {
    let template = template();
    cases::run(200, |text| now(text, &template));
}

/// Every graph of the kernels, after every stage, is the same graph when it is read back.
#[test]
fn printed_graphs_read_back() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../kernels/filters");
    let mut kernels = vec![Kernel::builtin("sraa").expect("built in")];
    for entry in std::fs::read_dir(examples).expect("kernels/filters") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|e| e == "rs") {
            kernels.push(Kernel::from_file(&path, None).unwrap_or_else(|e| panic!("{e}")));
        }
    }
    assert!(kernels.len() > 10);
    for kernel in kernels {
        for unroll in [Unroll::Full, Unroll::None, Unroll::Partial(2)] {
            let settings = Settings::new().unroll(unroll);
            let mut observe = |stage: &str, graph: &straightline_codegen::ir::Graph| {
                let text = print(graph);
                let again = parse(&text).unwrap_or_else(|e| panic!("{} after {stage}: {e}", kernel.name()));
                assert_eq!(again.nodes, graph.nodes, "{} after {stage}", kernel.name());
                assert_eq!(print(&again), text, "{} after {stage}", kernel.name());
                verify::verify_graph(&again).unwrap_or_else(|e| panic!("{} after {stage}: {e}", kernel.name()));
            };
            kernel
                .compile_observed(&settings, &mut observe)
                .unwrap_or_else(|e| panic!("{e}"));
        }
    }
}
