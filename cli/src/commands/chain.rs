//! `emit` and `explain` of chains of passes.

use super::emit::{check_name, engine_failure};
use crate::args::{EmitArgs, ExplainArgs};
use crate::failure::{Failure, format_count};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use straightline_codegen::chain::{Chain, CompiledChain, EmittedChain, PassPlan, PicturePlan, SharedPass};
use straightline_codegen::{Format, ShaderSpec, files};
use straightline_engines::{ChainRequest, Engine};
use straightline_table::{Column, Table};

/// Writes the shaders of a chain and its plan; prints the paths.
pub fn emit_chain(args: &EmitArgs, chain: &Chain) -> Result<(), Failure> {
    let name = args.name.as_deref().unwrap_or(chain.name());
    check_name(name)?;
    let compiled = chain.compile(&args.chain.chain_spec(args.shader_spec()))?;
    let named = match &args.engine {
        Some(engine) => engine_files(args, chain, (&compiled, name), engine)?,
        None => compiled.emit()?.renamed(name).named_files(),
    };
    let written = files::write_all(&args.out, &named).map_err(Failure::from_error)?;
    for file in written {
        outln!("{}", file.display());
    }
    for (picture, reason) in &compiled.kept {
        errln!("note: the picture `{picture}` is stored: {reason}");
    }
    Ok(())
}

/// Returns the files for an engine.
fn engine_files(
    args: &EmitArgs,
    chain: &Chain,
    (compiled, name): (&CompiledChain, &str),
    engine: &str,
) -> Result<BTreeMap<String, Vec<u8>>, Failure> {
    let options = chain.options()?;
    let request = ChainRequest {
        name: name.to_owned(),
        emit: args.shader_spec().emit,
        binds: args.bind.iter().cloned().collect(),
        ..ChainRequest::new(compiled, &options)
    };
    let engine = Engine::find(engine).map_err(engine_failure)?;
    engine.render_chain_files(&request).map_err(engine_failure)
}

/// Prints the passes of a chain, with what each reads and costs.
pub fn explain_chain(args: &ExplainArgs, chain: &Chain) -> Result<(), Failure> {
    let unfit = [
        ("--draw", args.draw.is_some()),
        ("--isa", args.isa.is_some()),
        ("--dump", args.dump),
    ];
    if let Some((name, _)) = unfit.iter().find(|(_, given)| *given) {
        return Err(Failure::Usage(format!(
            "{name} is for kernels, and `{}` has several",
            chain.name()
        )));
    }
    let mut shader = ShaderSpec::new();
    shader.settings = args.kernel.options.settings();
    shader.emit = shader.emit.precision(args.precision).accept_loss(true);
    let compiled = chain.compile(&args.chain.chain_spec(shader))?;
    let emitted = compiled.emit()?;
    match args.json {
        true => outln!("{:#}", to_json(&compiled, &emitted)),
        false => print(&compiled, &emitted),
    }
    Ok(())
}

fn print(compiled: &CompiledChain, emitted: &EmittedChain) {
    let plan = &emitted.plan;
    outln!("{}: {}\n", compiled.name, compiled.summary);
    // Pictures of a pass, which mostly draws one.
    let drawn = |pass: &PassPlan, of: &dyn Fn(&PicturePlan) -> String| {
        let mut texts: Vec<String> = pass
            .writes
            .iter()
            .filter_map(|name| plan.picture(name))
            .map(of)
            .collect();
        texts.dedup();
        texts.join(", ")
    };
    let counts = |pass: &PassPlan| emitted.shaders[&*pass.shader].emitted.manifest.counts.clone();
    let sources = |pass: &PassPlan| {
        let reads: Vec<&str> = pass.reads.iter().map(|read| &*read.from).collect();
        reads.join(" ")
    };
    let table = Table::of(plan.passes.iter())
        .column(Column::new("pass").left(), |pass| {
            drawn(pass, &|picture| picture.name.to_string())
        })
        .column(Column::new("shader").left(), |pass| pass.shader.to_string())
        .column(Column::new("size").left(), |pass| {
            drawn(pass, &|picture| picture.size.to_string())
        })
        .column(Column::new("format").left(), |pass| {
            drawn(pass, &|picture| picture.format.to_string())
        })
        .column(Column::new("reads").left(), |pass| sources(pass))
        .column("statements", |pass| counts(pass).statements.to_string())
        .column("texel reads", |pass| {
            let counts = counts(pass);
            (counts.texture_reads + counts.colour_reads).to_string()
        })
        .finish();
    out!("{}", table.to_text());
    let stored = plan.pictures.iter().filter_map(|picture| picture.memory);
    let textures = stored.max().map_or(0, |last| last as usize + 1);
    let (passes, shaders) = (plan.passes.len(), emitted.shaders.len());
    outln!(
        "\n{passes} passes of {}; {} between them",
        format_count(shaders, "shader"),
        format_count(textures, "texture")
    );
    if let Some([all, shared]) = bytes_at_full_hd(&plan.pictures) {
        outln!(
            "at 1920x1080: {:.1} MB of textures between passes, {:.1} MB if each picture had its own",
            shared as f64 / 1e6,
            all as f64 / 1e6
        );
    }
    if !compiled.fused.is_empty() {
        outln!("computed where they are read: {}", compiled.fused.join(", "));
    }
    for shared in &compiled.shared {
        let names: Vec<&str> = shared.cascade.tiles.iter().map(|tile| tile.name.as_str()).collect();
        let steps = shared
            .cascade
            .tiles
            .iter()
            .map(|tile| format!("{}x{}", tile.size[0], tile.size[1]));
        outln!(
            "`{}`: workgroups compute {}, in tiles of {} texels, with {} bytes of memory",
            shared.kernel,
            names.join(", "),
            steps.collect::<Vec<_>>().join(", "),
            shared.cascade.byte_size()
        );
    }
    for (picture, reason) in &compiled.kept {
        outln!("`{picture}` is stored: {reason}");
    }
}

/// Bytes of all pictures between passes, and of the textures that hold them, if every input has 1920x1080 texels.
fn bytes_at_full_hd(pictures: &[PicturePlan]) -> Option<[u64; 2]> {
    let (mut all, mut shared, mut known) = (0, 0, Vec::new());
    for picture in pictures.iter() {
        let Some(memory) = picture.memory else {
            continue;
        };
        let [width, height] = picture.size.evaluate(&|_| Some([1920, 1080])).ok()?;
        let bytes = u64::from(width) * u64::from(height) * bytes_per_texel(picture.format);
        all += bytes;
        if !known.contains(&memory) {
            known.push(memory);
            shared += bytes;
        }
    }
    Some([all, shared])
}

fn bytes_per_texel(format: Format) -> u64 {
    let each = match format {
        Format::Rgba8Unorm => 1,
        Format::Rgba16Float => 2,
        _ => 4,
    };
    u64::from(format.components()) * each
}

fn to_json(compiled: &CompiledChain, emitted: &EmittedChain) -> Value {
    let shaders = emitted.shaders.iter().map(|(name, pass)| {
        let manifest = &pass.emitted.manifest;
        (
            name.clone(),
            json!({ "kernel": pass.kernel, "counts": manifest.counts }),
        )
    });
    json!({
        "chain": emitted.plan.chain,
        "plan": emitted.plan,
        "shaders": shaders.collect::<serde_json::Map<_, _>>(),
        "fused": compiled.fused,
        "shared": compiled.shared.iter().map(shared_json).collect::<Vec<_>>(),
        "stored": compiled.kept.iter().map(|(name, reason)| json!({ "picture": name, "reason": reason })).collect::<Vec<_>>(),
    })
}

fn shared_json(shared: &SharedPass) -> Value {
    let tiles = shared.cascade.tiles.iter().map(|tile| {
        json!({ "picture": tile.name, "step": tile.step, "first": tile.first, "size": tile.size, "bytes": tile.bytes })
    });
    json!({ "kernel": shared.kernel, "tiles": tiles.collect::<Vec<_>>() })
}
