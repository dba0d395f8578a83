//! The footprint of a kernel for `explain`: as JSON, and as a drawing.

use crate::failure::Failure;
use crate::scene;
use serde_json::{Value, json};
use std::path::Path;
use straightline_codegen::drawing::{Drawing, draw_footprint};
use straightline_codegen::footprint::{Footprint, Tap, TextureReads, Unit};
use straightline_codegen::{Compiled, files};

/// Writes a drawing of the texels that a kernel reads.
pub fn write_drawing(path: &Path, compiled: &Compiled, footprint: &Footprint) -> Result<(), Failure> {
    if compiled.graph.targets.is_empty() && footprint.textures.is_empty() {
        return Err(Failure::Failed(format!(
            "`{}` has no pixel to draw: it returns no colour and reads no texture",
            compiled.kernel
        )));
    }
    let spelled = compiled.options.spelled();
    let changed = compiled
        .changed
        .iter()
        .filter_map(|name| Some((name, spelled.get(name)?)));
    let settings: Vec<String> = changed.map(|(name, value)| format!("{name}={value}")).collect();
    let text = draw_footprint(&Drawing {
        title: &compiled.kernel,
        subtitle: &settings.join("  "),
        footprint,
        samples: &sample_offsets(compiled),
    });
    files::write_file(path, text.as_bytes()).map_err(Failure::from_error)
}

/// Offsets of the samples by layer, for a built-in kernel with a pattern of them; otherwise empty.
fn sample_offsets(compiled: &Compiled) -> Vec<[f64; 2]> {
    let options = &compiled.options;
    let named = compiled.builtin.and_then(|_| options.choice("pattern"));
    let listed = |numbers: &[f64]| numbers.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
    match named {
        None => Vec::new(),
        Some("listed") => options.numbers("offsets").map_or(Vec::new(), listed),
        Some(name) => {
            let offsets = scene::sample_offsets(name).unwrap_or_default();
            offsets.iter().map(|at| [f64::from(at.x), f64::from(at.y)]).collect()
        }
    }
}

/// Returns the facts that a drawing shows.
pub fn footprint_json(footprint: &Footprint) -> Value {
    let messages = footprint.messages.iter().map(|messages| {
        let direction = match messages.direction {
            [1, 0] => "horizontal",
            [0, 1] => "vertical",
            _ => "diagonal",
        };
        json!({ "direction": direction, "messages": messages.messages, "scalars": messages.values })
    });
    let memories = footprint.memories.iter().map(|memory| {
        let kind = if memory.workgroup { "workgroup" } else { "buffer" };
        json!({ "name": memory.name, "memory": kind, "reads": memory.reads })
    });
    json!({
        "pixels": footprint.pixels,
        "lanes": footprint.lanes,
        "textures": footprint.textures.iter().map(texture_json).collect::<Vec<_>>(),
        "messages": messages.collect::<Vec<_>>(),
        "memories": memories.collect::<Vec<_>>(),
        "weights_are_tested": footprint.tested,
    })
}

fn texture_json(of: &TextureReads) -> Value {
    let (unit, scale) = match of.unit {
        Unit::Texels(scale) => ("texels", scale),
        Unit::Pixels => ("pixels", 1.0),
        Unit::Around(_) => ("texels around a runtime place", 1.0),
    };
    let elsewhere = of.elsewhere.iter();
    let elsewhere = elsewhere.map(|other| json!({ "reads": other.reads, "place": other.place }));
    json!({
        "texture": of.texture,
        "level": of.level,
        "unit": unit,
        "units_per_pixel": scale,
        "reads": of.reads,
        "taps": of.taps.iter().map(tap_json).collect::<Vec<_>>(),
        "elsewhere": elsewhere.collect::<Vec<_>>(),
    })
}

fn tap_json(tap: &Tap) -> Value {
    json!({
        "at": tap.at,
        "by": tap.method.name(),
        "layer": tap.layer,
        "lane": tap.lane,
        "reads": tap.reads,
        "conditional": tap.conditional,
        "weights": tap.weights,
    })
}
