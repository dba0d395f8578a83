//! From texts to a linked program.

use super::draw::{Objects, describe};
use super::program::{Program, Stage, Varying};
use glow::HasContext;
use std::fmt::Write;

/// Compiles and links a program.
pub fn link(objects: &mut Objects<'_>, program: &Program<'_>) -> Result<glow::Program, String> {
    let version = program.text.lines().next().unwrap_or_default();
    if !version.starts_with("#version") {
        return Err(format!("the text does not begin with `#version`:\n{}", program.text));
    }
    if matches!(program.stage, Stage::Fragment) {
        require_varyings(program)?;
    }
    let own = (program.text, stage_of(program.stage));
    let vertex = vertex_shader(version, &program.varyings);
    let texts = match program.stage {
        Stage::Fragment => vec![(vertex.as_str(), glow::VERTEX_SHADER), own],
        Stage::Compute { .. } => vec![own],
    };
    let linked = objects.program()?;
    let gl = objects.gl;
    for (text, stage) in &texts {
        let shader = objects.shader(*stage)?;
        // SAFETY: see the module.
        let log = unsafe {
            gl.shader_source(shader, text);
            gl.compile_shader(shader);
            gl.attach_shader(linked, shader);
            (!gl.get_shader_compile_status(shader)).then(|| gl.get_shader_info_log(shader))
        };
        if let Some(log) = log {
            return Err(refusal("the compiler refuses it", &log, &[text]));
        }
    }
    // SAFETY: see the module.
    let log = unsafe {
        gl.link_program(linked);
        (!gl.get_program_link_status(linked)).then(|| gl.get_program_info_log(linked))
    };
    match log {
        None => describe(gl, "linking").map(|()| linked),
        Some(log) => {
            let all: Vec<&str> = texts.iter().map(|(text, _)| *text).collect();
            Err(refusal("the linker refuses it", &log, &all))
        }
    }
}

fn stage_of(stage: Stage) -> u32 {
    match stage {
        Stage::Fragment => glow::FRAGMENT_SHADER,
        Stage::Compute { .. } => glow::COMPUTE_SHADER,
    }
}

/// Refuses a fragment shader with an input that is not given. Mesa links it, and the shader reads whatever lies there.
fn require_varyings(program: &Program<'_>) -> Result<(), String> {
    for line in program.text.lines() {
        let line = line.trim();
        let line = match line.strip_prefix("layout") {
            Some(rest) => rest.split_once(')').map_or("", |(_, rest)| rest),
            None => line,
        };
        let qualifiers = [
            "smooth",
            "centroid",
            "noperspective",
            "flat",
            "highp",
            "mediump",
            "lowp",
        ];
        let mut words = line.split_whitespace().skip_while(|word| qualifiers.contains(word));
        let (Some("in"), Some(name)) = (words.next(), words.last()) else {
            continue;
        };
        let name = name.trim_end_matches(';');
        if !program.varyings.iter().any(|varying| varying.name == name) {
            return Err(format!("no varying is given for the input `{name}`:\n{}", program.text));
        }
    }
    Ok(())
}

/// Horizontal positions of the triangle's vertices, in widths of the picture. No local variables, which could have the name
/// of a varying.
const ACROSS: &str = "float(2 * int(gl_VertexID == 1))";
/// Vertical positions in heights.
const DOWN: &str = "float(2 * int(gl_VertexID == 2))";

/// The vertex shader of a triangle that covers the picture, in the version of the fragment shader.
fn vertex_shader(version: &str, varyings: &[Varying]) -> String {
    let (mut outputs, mut statements) = (String::new(), String::new());
    for varying in varyings {
        let Varying {
            name,
            location,
            components,
            corners,
        } = varying;
        let ty = ["float", "vec2", "vec3", "vec4"][components.clamp(&1, &4) - 1];
        let [origin, right, up] = corners.map(|corner| {
            let components = corner[..(*components).clamp(1, 4)].iter();
            let components: Vec<String> = components.map(|c| format!("{c:?}")).collect();
            format!("{ty}({})", components.join(", "))
        });
        let place = location.map_or(String::new(), |location| format!("layout(location = {location}) "));
        let _ = writeln!(outputs, "{place}out {ty} {name};");
        let _ = writeln!(
            statements,
            "    {name} = {origin} + {ACROSS} * ({right} - {origin}) + {DOWN} * ({up} - {origin});"
        );
    }
    format!(
        "{version}
{outputs}void main() {{
    gl_Position = vec4(2.0 * {ACROSS} - 1.0, 2.0 * {DOWN} - 1.0, 0.0, 1.0);
{statements}}}
"
    )
}

/// A log with what it is about, the lines of each text numbered.
fn refusal(what: &str, log: &str, texts: &[&str]) -> String {
    let mut message = format!("{what}:\n{}\n", log.trim_end_matches(['\0', '\n']));
    for text in texts {
        for (k, line) in (1..).zip(text.lines()) {
            let _ = writeln!(message, "{k:4} {line}");
        }
    }
    message
}
