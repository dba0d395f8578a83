//! `explain`: operation counts of a kernel, per pixel.

use super::at::explain_at;
use super::chain::explain_chain;
use super::footprint::{footprint_json, write_drawing};
use super::machine;
use super::notes::find_notes;
use super::paper::count_for_paper;
use crate::args::ExplainArgs;
use crate::failure::Failure;
use crate::paragraph::wrap_text;
use serde_json::{Map, Value, json};
use straightline_codegen::diagnostic::Code;
use straightline_codegen::emit::Target;
use straightline_codegen::footprint::find_footprint;
use straightline_codegen::passes::{Gathered, Sharing};
use straightline_codegen::{Compiled, EmitOptions, ReadOrder, Unroll};
use straightline_kernels::{OptionValue, PaperCounts};
use straightline_manifest::{BindingKind, Counts, Manifest, Precision};
use straightline_table::Table;

/// Prints the counts of one kernel with one set of options.
pub fn explain_kernel(args: &ExplainArgs) -> Result<(), Failure> {
    if let Some(code) = Code::from_number(&args.kernel.kernel) {
        if args.draw.is_some() {
            return Err(Failure::Usage(
                "--draw goes with a kernel, not with an error code".to_owned(),
            ));
        }
        explain_code(code, args.json);
        return Ok(());
    }
    if let Some(at) = &args.at {
        args.chain.refuse(&args.kernel.kernel)?;
        return explain_at(args, at);
    }
    if let Some(chain) = args.kernel.locate_chain()? {
        return explain_chain(args, &chain);
    }
    args.chain.refuse(&args.kernel.kernel)?;
    let kernel = args.kernel.locate_kernel()?;
    let compiled = kernel.compile_observed(&args.kernel.options.settings(), &mut |stage, graph| {
        if args.dump {
            outln!("== {stage}\n{}", straightline_codegen::ir::print(graph));
        }
    })?;
    if let Some(path) = &args.draw {
        write_drawing(path, &compiled, &find_footprint(&compiled))?;
    }
    // Statements and live values are counted in the emitted text.
    let options = EmitOptions::new()
        .stage(super::natural_stage(&compiled))
        .precision(args.precision)
        .accept_loss(true);
    let described = compiled.describe(&options)?;
    let machine = match args.isa {
        None => None,
        Some(gpu) => Some(machine::ask(&compiled.emit(&options.targets([Target::Spirv]))?, gpu)?),
    };
    let bound = bound_names(&described);
    let features = described.features.join(", ");
    let counts = described.counts;
    let paper = count_for_paper(&kernel, &compiled)?;
    let remarks = find_notes(&kernel, &args.kernel.options.settings(), &compiled);
    if args.json {
        let mut out = to_json(&compiled, &counts, &bound, paper);
        out.insert("precision".into(), json!(args.precision));
        out.insert("footprint".into(), footprint_json(&find_footprint(&compiled)));
        if !remarks.is_empty() {
            out.insert("notes".into(), json!(remarks));
        }
        if let Some(machine) = &machine {
            out.insert("isa".into(), machine.to_json());
        }
        outln!("{:#}", Value::Object(out));
    } else {
        print(&compiled, &counts, &bound, paper);
        remarks.iter().for_each(|note| outln!("{note}"));
        if args.precision != Precision::default() {
            outln!("\nin {}: the device needs {features}", args.precision);
        }
        if let Some(machine) = &machine {
            machine.print(args.dump);
        }
    }
    Ok(())
}

/// Prints the explanation of an error code.
fn explain_code(code: Code, as_json: bool) {
    let (number, title, explanation) = (code.number(), code.title(), code.explanation());
    match as_json {
        true => outln!(
            "{:#}",
            json!({ "code": number, "title": title, "explanation": explanation })
        ),
        false => outln!("{number}: {title}\n\n{}", explanation.trim_end()),
    }
}

/// Width of the output, in columns.
const WIDTH: usize = 80;

/// Width of a section's heading, in columns.
const HEAD: usize = 10;

fn print_section(head: &str, text: &str) {
    let text = if text.is_empty() { "none" } else { text };
    outln!(
        "{}",
        wrap_text(text, WIDTH, &format!("{head:HEAD$}"), &" ".repeat(HEAD))
    );
}

/// Names of the shader's inputs and uniforms, exactly what a host must bind, and of its overrides.
struct Bound {
    inputs: Vec<String>,
    uniforms: Vec<String>,
    overrides: Vec<String>,
}

fn bound_names(manifest: &Manifest) -> Bound {
    let immediates = manifest.immediates.iter().flat_map(|immediates| &immediates.fields);
    let mut uniforms: Vec<String> = immediates.map(|field| field.name.clone()).collect();
    let mut inputs = Vec::new();
    for binding in &manifest.bindings {
        match &binding.kind {
            BindingKind::Uniform { fields, .. } => uniforms.extend(fields.iter().map(|field| field.name.clone())),
            _ => inputs.push(binding.name.clone()),
        }
    }
    Bound {
        inputs,
        uniforms,
        overrides: manifest.overrides.iter().map(|of| of.name.clone()).collect(),
    }
}

fn to_json(compiled: &Compiled, counts: &Counts, bound: &Bound, paper: Option<PaperCounts>) -> Map<String, Value> {
    let mut out = Map::new();
    out.insert("kernel".into(), json!(compiled.kernel));
    out.insert("unroll".into(), json!(compiled.policy.to_string()));
    out.insert("options".into(), json!(compiled.options.spelled()));
    out.insert("inputs".into(), json!(bound.inputs));
    out.insert("uniforms".into(), json!(bound.uniforms));
    out.insert("overrides".into(), json!(bound.overrides));
    if let Value::Object(figures) = json!(counts) {
        for (name, figure) in figures {
            // Tallies appear among the other counts under their own names.
            match figure {
                Value::Object(tallies) if name == "tallies" => out.extend(tallies),
                other => {
                    out.insert(name, other);
                }
            }
        }
    }
    if let Some(sharing) = &compiled.sharing {
        out.insert("sharing".into(), sharing_json(sharing));
    }
    if compiled.policy.reads == ReadOrder::Gather {
        out.insert("gathered".into(), compiled.gathered.iter().map(gathered_json).collect());
    }
    let loops = compiled.loops.iter().map(|report| {
        let reason_of = |unrolled: bool| {
            let reason = report.reason.as_ref();
            reason.filter(|_| unrolled == (report.unroll == Unroll::Full))
        };
        json!({
            "loop": report.policy_path(),
            "line": report.span.line,
            "unroll": report.unroll.to_string(),
            "unrolled_because": reason_of(true),
            "left_because": reason_of(false),
            "copies": report.copies,
            "operations": report.operations,
        })
    });
    out.insert("loops_of_the_source".into(), loops.collect());
    if let Some(paper) = paper {
        if paper.weight_evaluations > 0 {
            out.insert("paper_weight_evaluations".into(), json!(paper.weight_evaluations));
        }
        out.insert("paper_texture_reads".into(), json!(paper.texture_reads));
    }
    out
}

fn gathered_json(gathered: &Gathered) -> Value {
    json!({
        "texture": gathered.texture,
        "layer": gathered.layer,
        "component": gathered.component,
        "reads": gathered.reads,
        "gathers": gathered.gathers,
    })
}

/// Describes the memory shared by a workgroup, and the reads that are not shared, with the reason.
fn sharing_json(sharing: &Sharing) -> Value {
    let tiles = sharing.tiles.iter().map(|tile| {
        json!({
            "texture": tile.texture,
            "layer": tile.layer,
            "first": tile.first,
            "size": tile.size,
            "bytes": tile.bytes,
            "reads": tile.reads,
            "reads_of_a_thread": tile.fills,
        })
    });
    let apart = sharing.unshared.iter();
    let apart = apart.map(|apart| json!({ "texture": apart.texture, "reads": apart.reads, "why": apart.why }));
    json!({
        "workgroup": sharing.threads,
        "tiles": tiles.collect::<Vec<_>>(),
        "not_shared": apart.collect::<Vec<_>>(),
    })
}

fn print(compiled: &Compiled, counts: &Counts, bound: &Bound, paper: Option<PaperCounts>) {
    let title = match compiled.summary.as_str() {
        "" => compiled.kernel.clone(),
        summary => format!("{}: {summary}", compiled.kernel),
    };
    outln!("{}\n", wrap_text(&title, WIDTH, "", "  "));
    let is_empty = |value: &OptionValue| value.numbers().is_some_and(<[f64]>::is_empty);
    let given = compiled.options.iter().filter(|(_, value)| !is_empty(value));
    let options = given.map(|(name, value)| format!("{name}={value}"));
    print_section("Options", &options.collect::<Vec<_>>().join(" "));
    print_section("Unroll", &compiled.policy.to_string());
    print_section("Inputs", &bound.inputs.join(", "));
    print_section("Uniforms", &bound.uniforms.join(", "));
    if !bound.overrides.is_empty() {
        print_section("Overrides", &bound.overrides.join(", "));
    }
    outln!();
    let mut rows = vec![
        count_row("basic blocks", counts.basic_blocks, None),
        count_row("loops", counts.loops, None),
        count_row("texture reads", counts.texture_reads, paper.map(|p| p.texture_reads)),
    ];
    for (name, n) in &counts.reads {
        rows.push(count_row(
            &format!("  of {name}{}", if name == "color" { ", counted apart" } else { "" }),
            *n,
            None,
        ));
    }
    for (name, n) in &counts.tallies {
        let paper = paper
            .filter(|_| name == "weight_evaluations")
            .map(|p| p.weight_evaluations);
        rows.push(count_row(&name.replace('_', " "), *n, paper));
    }
    if counts.messages > 0 {
        rows.push(count_row("messages", counts.messages, None));
    }
    for (name, n) in [
        ("reads of shared memory", counts.shared_reads),
        ("barriers", counts.barriers),
        ("bytes a workgroup shares", counts.shared_memory),
    ] {
        if n > 0 {
            rows.push(count_row(name, n, None));
        }
    }
    if counts.exact > 0 {
        rows.push(count_row("operations kept in order", counts.exact, None));
    }
    rows.push(count_row("transcendentals", counts.transcendentals, None));
    rows.push(count_row("other arithmetic", counts.alu, None));
    rows.push(count_row("statements", counts.statements, None));
    rows.push(count_row("scalars alive at most", counts.max_live, None));
    let per = match compiled.graph.invocation.block_size() {
        [1, 1] => "a pixel".to_owned(),
        [width, height] => format!("{width}x{height} pixels"),
    };
    let per = format!("Counts for {per}");
    let table = Table::of(rows)
        .column(per, |(name, ..)| name.clone())
        .column("here", |(_, here, _)| *here)
        .column("paper", |(.., paper)| *paper)
        .finish();
    let unwanted: &[&str] = if paper.is_some() { &[] } else { &["paper"] };
    out!("{}", table.without(unwanted).to_text());
    if !counts.max_live_at.is_empty() {
        outln!("most scalars are alive at {}", counts.max_live_at);
    }
    if let Some(sharing) = &compiled.sharing {
        print_sharing(sharing);
    }
    if compiled.policy.reads == ReadOrder::Gather {
        print_gathered(&compiled.gathered);
    }
    print_loops(compiled);
}

/// Prints the memory shared by a workgroup, and the reads that are not shared, with the reason.
fn print_sharing(sharing: &Sharing) {
    let [width, height] = sharing.threads;
    let head = format!("Shared by {width}x{height} pixels");
    let table = Table::of(&sharing.tiles)
        .column(head, |tile| tile.display_name())
        .column("texels", |tile| {
            let ([left, upper], [width, height]) = (tile.first, tile.size);
            format!("{width}x{height} from ({left}, {upper})")
        })
        .column("bytes", |tile| tile.bytes)
        .column("reads", |tile| tile.reads)
        .column("now", |tile| tile.fills)
        .finish();
    out!("\n{}", table.to_text());
    for apart in &sharing.unshared {
        let (reads, of) = (apart.reads, &apart.texture);
        let noun = if reads == 1 { "read" } else { "reads" };
        outln!("{reads} {noun} of `{of}` not shared: {}", apart.why);
    }
}

/// Prints the reads that became gathers.
fn print_gathered(gathered: &[Gathered]) {
    outln!();
    if gathered.is_empty() {
        outln!(
            "no reads gathered: no two of one component lie in a square of 2x2 texels at constant offsets from the pixel"
        );
        return;
    }
    let table = Table::of(gathered)
        .column("Gathered", |g| g.display_name())
        .column("reads", |g| g.reads)
        .column("gathers", |g| g.gathers)
        .finish();
    out!("{}", table.to_text());
}

/// Prints the outcome for each loop. A loop that was unrolled against the request has its reason.
fn print_loops(compiled: &Compiled) {
    let loops = Table::of(&compiled.loops)
        .column("Loop", |report| report.policy_path())
        .column("unroll", |report| report.unroll.to_string())
        .column("copies", |report| report.copies)
        .column("operations", |report| report.operations)
        .finish();
    if loops.is_empty() {
        return;
    }
    out!("\n{}", loops.to_text());
    for report in &compiled.loops {
        if let Some(reason) = &report.reason {
            let became = match report.unroll {
                Unroll::Full => "was unrolled",
                _ => "was left in the shader",
            };
            outln!("`{}` {became}: {reason}", report.policy_path());
        }
    }
}

fn count_row(name: &str, n: u32, paper: Option<u32>) -> (String, u32, Option<u32>) {
    (name.to_owned(), n, paper)
}
