//! What stands around the body: header, bindings, entry point. From templates, which hold no arithmetic.

use super::body::Body;
use super::dialect::Dialect;
use super::error::EmitError;
use super::resources::{OUTPUT, Resources, SAMPLER, UNIFORMS};
use crate::ir::{Invocation, TextureKind};
use crate::pipeline::Compiled;
use crate::policy::Transport;
use serde_json::json;
use straightline_manifest::{Counts, Precision, REGION, Stage};

/// Name and version, for headers and manifests.
pub const GENERATOR: &str = concat!("straightline ", env!("CARGO_PKG_VERSION"));

/// The entry point of a kernel.
pub fn entry_point(kernel: &str) -> String {
    if super::names::is_reserved(kernel) {
        format!("{kernel}_kernel")
    } else {
        kernel.to_owned()
    }
}

/// Renders a shader in a dialect, with what its header says of it.
pub fn render(
    compiled: &Compiled,
    counts: &Counts,
    resources: &Resources,
    body: &Body,
    dialect: &dyn Dialect,
) -> Result<String, EmitError> {
    let entry = entry_point(&compiled.kernel);
    let Body {
        tables, lines, results, ..
    } = body;
    let template = match dialect.name() {
        "wgsl" => include_str!("../../templates/shader.wgsl.tera"),
        _ => include_str!("../../templates/shader.glsl.tera"),
    };
    let textures: Vec<_> = resources
        .read
        .iter()
        .map(|bound| {
            let texture = resources.texture(bound.index);
            let (wgsl, glsl) = texture_types(texture.kind);
            json!({ "name": texture.name, "binding": bound.binding, "wgsl": wgsl, "glsl": glsl })
        })
        .collect();
    let buffers: Vec<_> = resources
        .read_buffers
        .iter()
        .map(|(k, binding)| {
            let buffer = resources.buffer(*k);
            json!({ "name": buffer.name, "binding": binding, "element": dialect.outside(buffer.element) })
        })
        .collect();
    let samplers: Vec<_> = resources
        .used_samplers
        .iter()
        .map(|(k, binding)| {
            let sampler = resources.sampler(*k);
            let (wgsl, glsl) = match sampler.comparison {
                true => ("sampler_comparison", "samplerShadow"),
                false => ("sampler", "sampler"),
            };
            json!({ "name": sampler.name, "binding": binding, "wgsl": wgsl, "glsl": glsl })
        })
        .collect();
    let frame = resources.framed().map(|t| {
        json!({
            "name": t.name, "glsl": glsl_sampler(t.kind), "lod": t.kind != TextureKind::Multisampled
        })
    });
    let members: Vec<_> = resources
        .fields
        .iter()
        .map(|f| json!({ "name": f.name, "wgsl": f.ty, "glsl": glsl_type(&f.ty) }))
        .collect();
    let varyings: Vec<_> = resources
        .varyings
        .iter()
        .zip(0..)
        .map(|(v, location)| json!({ "name": v.name, "location": location, "ty": dialect.outside(v.ty) }))
        .collect();
    let width = resources.block[0] as usize;
    let stores: Vec<_> = results
        .iter()
        .enumerate()
        .map(|(k, result)| json!({ "x": k % width, "y": k / width, "result": result }))
        .collect();
    let context = json!({
        "header": header(compiled, counts, resources),
        "textures": textures,
        "buffers": buffers,
        "samplers": samplers,
        "frame": frame,
        "uniforms": members,
        "uniform_binding": resources.uniform_binding(),
        "region_binding": resources.region_binding(),
        "output_binding": resources.output_binding(),
        "sampler_binding": resources.sampler_binding(),
        "format_wgsl": resources.options.format.wgsl(),
        "format_glsl": resources.options.format.glsl(),
        "compute": resources.options.stage == Stage::Compute,
        "needs_frame": resources.needs_frame,
        "workgroup": resources.options.workgroup(),
        "entry": entry,
        "names": { "output": OUTPUT, "uniforms": UNIFORMS, "sampler": SAMPLER, "region": REGION },
        "tables": tables,
        "body": lines.join("\n"),
        "results": results,
        "stores": stores,
        "block": resources.block,
        "blocks": resources.block != [1, 1],
        "varyings": varyings,
        "subgroups": resources.subgroups,
        "half": resources.options.precision == Precision::F16,
    });
    let failed = |error: tera::Error| EmitError::Shell {
        kernel: compiled.kernel.clone(),
        message: format!("{error:?}"),
    };
    let context = tera::Context::from_value(context).map_err(failed)?;
    tera::Tera::one_off(template, &context, false).map_err(failed)
}

/// What a reader should know, a line each. The same for the same input: no date, no path of the machine.
fn header(compiled: &Compiled, counts: &Counts, resources: &Resources) -> Vec<String> {
    let options: Vec<String> = compiled
        .options
        .iter()
        .map(|(name, value)| format!("{name}={}", shortened(value)))
        .collect();
    let mut lines = vec![
        format!("{}: {}", compiled.kernel, compiled.summary),
        format!("Generated by {GENERATOR}; do not edit. Licence: MIT OR Apache-2.0, or that of the kernel's source."),
        format!(
            "Options: {}",
            if options.is_empty() {
                "none".to_owned()
            } else {
                options.join(" ")
            }
        ),
        format!(
            "Stage {}, unroll {}, {}{}output {}.",
            resources.options.stage.name(),
            compiled.policy,
            messages(compiled),
            precision(resources.options.precision),
            resources.options.format
        ),
    ];
    let reads = match (counts.texture_reads, counts.colour_reads) {
        (reads, 0) => format!("{reads} reads"),
        (0, reads) => format!("{reads} reads of colour"),
        (reads, colour) => format!("{reads} texture reads + {colour} of colour"),
    };
    let mut figures = vec![
        format!(
            "{} basic block{}",
            counts.basic_blocks,
            if counts.basic_blocks == 1 { "" } else { "s" }
        ),
        format!("{} statements", counts.statements),
        reads,
    ];
    figures.extend(
        counts
            .tallies
            .iter()
            .map(|(name, n)| format!("{n} {}", name.replace('_', " "))),
    );
    figures.push(format!("{} transcendental calls", counts.transcendentals));
    if counts.messages > 0 {
        figures.push(format!("{} messages", counts.messages));
    }
    let per = match resources.block {
        [1, 1] => "pixel".to_owned(),
        [width, height] => format!("block of {width}x{height} pixels"),
    };
    lines.push(format!("Per {per}: {}.", figures.join(", ")));
    lines
}

/// A list of many numbers that are all alike by one of them.
fn shortened(value: &str) -> String {
    let numbers: Vec<&str> = value.split(',').collect();
    match numbers[..] {
        [first, .., last] if numbers.len() > 9 && numbers.iter().all(|n| *n == last) => {
            format!("{first},...({} alike)", numbers.len())
        }
        _ => value.to_owned(),
    }
}

/// How lanes hear from each other, where there are some.
fn messages(compiled: &Compiled) -> &'static str {
    match compiled.graph.invocation {
        Invocation::Lane if compiled.transport == Some(Transport::Derivatives) => "messages by fine derivatives, ",
        Invocation::Lane => "messages by quad operations, ",
        _ => "",
    }
}

/// What the shader computes in, where that is not what all do.
fn precision(precision: Precision) -> &'static str {
    match precision {
        Precision::F32 => "",
        Precision::F16 => "half precision (f16), ",
    }
}

/// Types of a texture in WGSL and in GLSL.
fn texture_types(kind: TextureKind) -> (&'static str, &'static str) {
    match kind {
        TextureKind::Flat => ("texture_2d<f32>", "texture2D"),
        TextureKind::Layers => ("texture_2d_array<f32>", "texture2DArray"),
        TextureKind::Multisampled => ("texture_multisampled_2d<f32>", "texture2DMS"),
        TextureKind::Depth => ("texture_depth_2d", "texture2D"),
    }
}

/// What GLSL calls a texture together with a sampler that filters nothing.
pub fn glsl_sampler(kind: TextureKind) -> &'static str {
    match kind {
        TextureKind::Flat | TextureKind::Depth => "sampler2D",
        TextureKind::Layers => "sampler2DArray",
        TextureKind::Multisampled => "sampler2DMS",
    }
}

fn glsl_type(wgsl: &str) -> String {
    let (kind, scalar) = match wgsl {
        "f32" => return "float".to_owned(),
        "i32" => return "int".to_owned(),
        "u32" => return "uint".to_owned(),
        vector => (&vector[3..4], &vector[4..]),
    };
    let prefix = if scalar == "f" { "" } else { scalar };
    format!("{prefix}vec{kind}")
}
