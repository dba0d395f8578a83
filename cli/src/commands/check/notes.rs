//! Notes on kernels without errors: sums whose order of operations matters, uniforms that look like coordinates, and loops
//! that are unrolled to very many operations.

use super::message;
use crate::args::MessageFormat;
use crate::commands::notes::long_loop;
use straightline_codegen::diagnostic::{Diagnostic, Errors, File, Span};
use straightline_codegen::{Compiled, Kernel};

/// Names that the coordinate of a pixel has in other languages.
const COORDINATES: [&str; 8] = [
    "uv",
    "coord",
    "coords",
    "frag_coord",
    "fragcoord",
    "tex_coord",
    "texcoord",
    "tex_coords",
];

/// Returns a note for each uniform that is named like a coordinate, for each line whose operations drivers must not reorder,
/// and for a loop that is unrolled to very many operations.
pub fn find_notes(compiled: &Compiled, kernel: &Kernel) -> Vec<Errors> {
    let mut notes = note_coordinates(compiled, kernel);
    notes.extend(note_orders(compiled, kernel));
    notes.extend(long_loop(compiled).map(|(report, note)| Errors {
        diagnostics: vec![Diagnostic::remark_at(report.span, note)],
        files: kernel.files().to_vec().into(),
    }));
    notes
}

fn note_coordinates(compiled: &Compiled, kernel: &Kernel) -> Vec<Errors> {
    let uniforms = compiled.graph.uniforms.iter();
    let vectors = uniforms.filter(|uniform| uniform.ty.is_float() && uniform.ty.component_count() == 2);
    let named = vectors.filter(|uniform| COORDINATES.contains(&uniform.name.as_str()));
    let note = |name: &str| {
        let what = format!(
            "`{name}` is a uniform, the same for all pixels; a pixel's own is `(pixel.as_vec2() + 0.5) / size.as_vec2()`"
        );
        Some(Errors {
            diagnostics: vec![Diagnostic::remark_at(kernel.parameter_span(name)?, what)],
            files: kernel.files().to_vec().into(),
        })
    };
    named.filter_map(|uniform| note(&uniform.name)).collect()
}

fn note_orders(compiled: &Compiled, kernel: &Kernel) -> Vec<Errors> {
    let places = compiled.exact_places().into_iter();
    let note = |(path, line, name): (&str, u32, &str)| {
        let (index, file) = (0..).zip(kernel.files()).find(|(_, file)| file.path == path)?;
        let subject = match name {
            "" => "this line".to_owned(),
            name => format!("`{name}`"),
        };
        let what = format!("the order of the operations of {subject} matters: drivers are kept from changing it");
        let diagnostic = Diagnostic::remark_at(line_of(file, index, line)?, what)
            .note("`as_written` in WGSL and MSL, `precise` in GLSL and HLSL, `NoContraction` in SPIR-V");
        Some(Errors {
            diagnostics: vec![diagnostic],
            files: kernel.files().to_vec().into(),
        })
    };
    places.filter_map(note).collect()
}

/// Returns the span of a line, without surrounding whitespace.
fn line_of(file: &File, index: u32, line: u32) -> Option<Span> {
    let text = file.text.split_inclusive('\n').nth(line as usize - 1)?;
    let before = file
        .text
        .split_inclusive('\n')
        .take(line as usize - 1)
        .map(str::len)
        .sum::<usize>();
    let indent = text.len() - text.trim_start().len();
    let start = (before + indent) as u32;
    Some(Span {
        file: index,
        start,
        end: start + text.trim().len() as u32,
        line,
        column: text[..indent].chars().count() as u32 + 1,
    })
}

/// Prints a note: one line for people, rustc's JSON for editors.
pub fn print(format: MessageFormat, kernel: &str, note: &Errors) {
    let Some(diagnostic) = note.diagnostics.first() else {
        return;
    };
    match (format, diagnostic.span) {
        (MessageFormat::Json, _) => outln!("{}", message::message_json(kernel, note)),
        (MessageFormat::Human, Some(at)) => {
            let path = note.files.get(at.file as usize).map_or("", |file| file.path.as_str());
            outln!("{path}:{}: note: {}", at.line, diagnostic.message);
        }
        (MessageFormat::Human, None) => outln!("note: {}", diagnostic.message),
    }
}
