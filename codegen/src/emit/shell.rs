//! What stands around the body: header, bindings, entry point. From templates, which hold no arithmetic.

use super::body::{Body, body};
use super::dialect::Dialect;
use super::error::EmitError;
use super::resources::{OUTPUT, Resources, SAMPLER, UNIFORMS, WORKGROUP};
use crate::pipeline::Compiled;
use serde_json::json;
use straightline_manifest::Stage;

/// Name and version, for headers and manifests.
pub const GENERATOR: &str = concat!("straightline ", env!("CARGO_PKG_VERSION"));

/// Keywords and built-in functions of GLSL that a value of a kernel might be called.
pub const GLSL_WORDS: &[&str] = &[
    "abs",
    "acos",
    "active",
    "all",
    "any",
    "asin",
    "asm",
    "atan",
    "attribute",
    "bool",
    "break",
    "buffer",
    "case",
    "cast",
    "ceil",
    "centroid",
    "clamp",
    "class",
    "coherent",
    "common",
    "const",
    "continue",
    "cos",
    "cross",
    "default",
    "degrees",
    "discard",
    "distance",
    "do",
    "dot",
    "double",
    "else",
    "enum",
    "equal",
    "exp",
    "exp2",
    "extern",
    "external",
    "false",
    "faceforward",
    "filter",
    "fixed",
    "flat",
    "float",
    "floor",
    "fma",
    "for",
    "fract",
    "goto",
    "half",
    "highp",
    "if",
    "image2D",
    "in",
    "inline",
    "inout",
    "input",
    "int",
    "interface",
    "invariant",
    "inversesqrt",
    "isinf",
    "isnan",
    "layout",
    "length",
    "log",
    "log2",
    "long",
    "lowp",
    "main",
    "max",
    "mediump",
    "min",
    "mix",
    "mod",
    "modf",
    "namespace",
    "noinline",
    "noperspective",
    "normalize",
    "not",
    "notEqual",
    "out",
    "output",
    "partition",
    "patch",
    "pow",
    "precise",
    "precision",
    "public",
    "radians",
    "readonly",
    "reflect",
    "refract",
    "resource",
    "restrict",
    "return",
    "round",
    "roundEven",
    "sample",
    "sampler",
    "sampler2D",
    "shared",
    "short",
    "sign",
    "sin",
    "sizeof",
    "smooth",
    "smoothstep",
    "sqrt",
    "static",
    "step",
    "struct",
    "subroutine",
    "superp",
    "switch",
    "tan",
    "template",
    "texture",
    "texture2D",
    "this",
    "true",
    "trunc",
    "typedef",
    "uint",
    "uniform",
    "union",
    "unsigned",
    "using",
    "varying",
    "vec2",
    "vec3",
    "vec4",
    "void",
    "volatile",
    "while",
    "writeonly",
];

/// A rendered shader.
pub struct Rendered {
    /// The whole text.
    pub text: String,
    /// Statements of the body.
    pub statements: u32,
}

/// The entry point of a kernel.
pub fn entry_point(kernel: &str) -> String {
    if super::names::is_reserved(kernel) {
        format!("{kernel}_kernel")
    } else {
        kernel.to_owned()
    }
}

/// Renders a shader in a dialect.
pub fn render(compiled: &Compiled, resources: &Resources, dialect: &dyn Dialect) -> Result<Rendered, EmitError> {
    let entry = entry_point(&compiled.kernel);
    let Body {
        tables,
        lines,
        result,
        statements,
    } = body(compiled, resources, &entry, dialect)?;
    let template = match dialect.name() {
        "wgsl" => include_str!("../../templates/shader.wgsl.tera"),
        _ => include_str!("../../templates/shader.glsl.tera"),
    };
    let textures: Vec<_> = resources
        .read
        .iter()
        .map(|(k, binding, _)| {
            let texture = resources.texture(*k);
            json!({ "name": texture.name, "binding": binding, "layered": texture.layered })
        })
        .collect();
    let members: Vec<_> = resources
        .fields
        .iter()
        .map(|f| json!({ "name": f.name, "wgsl": f.ty, "glsl": glsl_type(&f.ty) }))
        .collect();
    let context = json!({
        "header": header(compiled, resources, statements),
        "textures": textures,
        "uniforms": members,
        "uniform_binding": resources.uniform_binding(),
        "output_binding": resources.output_binding(),
        "sampler_binding": resources.sampler_binding(),
        "format_wgsl": resources.format.wgsl(),
        "format_glsl": resources.format.glsl(),
        "compute": resources.stage == Stage::Compute,
        "needs_frame": resources.needs_frame,
        "workgroup": WORKGROUP,
        "entry": entry,
        "names": { "output": OUTPUT, "uniforms": UNIFORMS, "sampler": SAMPLER },
        "tables": tables,
        "body": lines.join("\n"),
        "result": result,
    });
    let failed = |error: tera::Error| EmitError::Shell {
        kernel: compiled.kernel.clone(),
        message: format!("{error:?}"),
    };
    let context = tera::Context::from_value(context).map_err(failed)?;
    let text = tera::Tera::one_off(template, &context, false).map_err(failed)?;
    Ok(Rendered { text, statements })
}

/// What a reader should know, a line each. The same for the same input: no date, no path of the machine.
fn header(compiled: &Compiled, resources: &Resources, statements: u32) -> Vec<String> {
    let counts = &compiled.counts;
    let options: Vec<String> = compiled
        .options
        .iter()
        .map(|(name, value)| format!("{name}={value}"))
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
            "Stage {}, unroll {}, output {}.",
            resources.stage.name(),
            compiled.unroll.name(),
            resources.format
        ),
    ];
    let mut figures = vec![
        format!(
            "{} basic block{}",
            counts.basic_blocks,
            if counts.basic_blocks == 1 { "" } else { "s" }
        ),
        format!("{statements} statements"),
        format!(
            "{} texture reads + {} of colour",
            counts.texture_reads, counts.colour_reads
        ),
    ];
    figures.extend(
        counts
            .tallies
            .iter()
            .map(|(name, n)| format!("{n} {}", name.replace('_', " "))),
    );
    figures.push(format!("{} transcendental calls", counts.transcendentals));
    lines.push(format!("Per pixel: {}.", figures.join(", ")));
    lines
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
