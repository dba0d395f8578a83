//! GLSL shown to naga, which validates it. Its reader does not know all of GLSL: what it cannot take is shown to it as something
//! of the same type. The tests have glslang read the text as it is.

use super::print::{GATHER, LENGTH, MESSAGES, PRECISE};
use super::refusal::Refusal;
use super::translate::{stage, validate};
use straightline_manifest::Stage;

/// Parses and validates GLSL. naga's reader makes an invalid module of the length of a storage buffer, so it is shown a
/// number in its place; it knows no quad operations, so it is shown what they are called with; it knows no gathers, so it is
/// shown samples; it does not know `precise`; and it takes a texture that is `compared`, given by name and shape, for one of depths alone, so that its
/// texels are shown to it as another texture's.
pub fn check_glsl(kernel: &str, of: Stage, text: &str, compared: &[(&str, &str)]) -> Result<(), Refusal> {
    let mut text = gathers_as_samples(&lengths_as_numbers(text)).replace(PRECISE, "");
    for message in MESSAGES {
        text = text.replace(message, "");
    }
    let mut text = text.replace("#extension GL_KHR_shader_subgroup_quad : require\n", "");
    for (k, (name, shape)) in compared.iter().enumerate() {
        let sampler = super::own_words::SAMPLER;
        // A text of so many letters does not have as many names.
        let mut names = (0..=text.len()).map(|n| format!("{name}_texels{n}"));
        let shown = names.find(|shown| !text.contains(shown)).unwrap_or_default();
        text = text.replace(
            &format!("sampler{shape}({name}, {sampler})"),
            &format!("sampler{shape}({shown}, {sampler})"),
        );
        let binding = 1000 + k;
        let other = format!("#version 450\nlayout(set = 0, binding = {binding}) uniform texture{shape} {shown};\n");
        text = text.replacen("#version 450\n", &other, 1);
    }
    let text = &text;
    let invalid = |message: String| Refusal::invalid(kernel, "glsl450", &message);
    let options = naga::front::glsl::Options::from(stage(of));
    let module = naga::front::glsl::Frontend::default()
        .parse(&options, text)
        .map_err(|error| invalid(error.emit_to_string(text)))?;
    validate(&module, text).map_err(invalid)?;
    Ok(())
}

/// The text with `1` for every `buffer.elements.length()`.
fn lengths_as_numbers(text: &str) -> String {
    let mut parts = text.split(LENGTH);
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        // What stands before is the buffer's name.
        let name = out
            .trim_end_matches(|c: char| c.is_ascii_alphanumeric() || c == '_')
            .len();
        out.truncate(name);
        out += "1";
        out += part;
    }
    out
}

/// The text with a sample for every gather: `textureGather(t, uv, x)` becomes `textureLod(t, uv, 0.0)`, of a comparison
/// `vec4(textureLod(t, vec3(uv, x), 0.0))`.
fn gathers_as_samples(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    let call = format!("{GATHER}(");
    while let Some(at) = rest.find(&call) {
        out += &rest[..at];
        let inside = &rest[at + call.len()..];
        let (arguments, length) = arguments(inside);
        match arguments[..] {
            [texture, uv, reference] if texture.starts_with("sampler2DShadow") => {
                out += &format!("vec4(textureLod({texture}, vec3({uv}, {reference}), 0.0))");
            }
            [texture, uv, _] => out += &format!("textureLod({texture}, {uv}, 0.0)"),
            _ => {}
        }
        rest = &inside[length..];
    }
    out + rest
}

/// The arguments of a call whose opening parenthesis was just read, and where it ends.
fn arguments(text: &str) -> (Vec<&str>, usize) {
    let (mut found, mut begin, mut depth) = (Vec::new(), 0, 0);
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' if depth == 0 => {
                found.push(text[begin..at].trim());
                return (found, at + 1);
            }
            ')' | ']' => depth -= 1,
            ',' if depth == 0 => {
                found.push(text[begin..at].trim());
                begin = at + 1;
            }
            _ => {}
        }
    }
    (found, text.len())
}
