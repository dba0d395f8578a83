//! `adapters`: the GPUs and drivers that wgpu finds.

use crate::args::AdaptersArgs;
use crate::failure::Failure;
use crate::gpu;
use serde_json::json;
use wgpu::{DownlevelFlags, Features, TextureFormat, TextureUsages};

/// Prints every adapter and its capabilities.
pub fn print_adapters(args: &AdaptersArgs) -> Result<(), Failure> {
    let adapters = gpu::list_adapters();
    let described: Vec<_> = adapters.iter().map(adapter_json).collect();
    if args.json {
        outln!("{:#}", json!({ "adapters": described }));
        return Ok(());
    }
    if described.is_empty() {
        outln!("no adapter: {}", gpu::INSTALL);
    }
    for adapter in &described {
        outln!("{}", adapter["name"].as_str().unwrap_or_default());
        for key in [
            "type",
            "backend",
            "driver",
            "largest_texture",
            "compute",
            "timestamps",
            "f16",
            "subgroups",
            "float32_output",
        ] {
            outln!("  {:<16} {}", key.replace('_', " "), format_value(&adapter[key]));
        }
    }
    Ok(())
}

fn format_value(value: &serde_json::Value) -> String {
    match value {
        serde_json::Value::String(text) => text.clone(),
        serde_json::Value::Bool(yes) => if *yes { "yes" } else { "no" }.to_owned(),
        other => other.to_string(),
    }
}

fn adapter_json(adapter: &wgpu::Adapter) -> serde_json::Value {
    let info = adapter.get_info();
    let features = adapter.features();
    let storage = adapter
        .get_texture_format_features(TextureFormat::Rgba32Float)
        .allowed_usages;
    json!({
        "name": info.name,
        "type": format!("{:?}", info.device_type),
        "backend": info.backend.to_string(),
        "driver": format!("{} {}", info.driver, info.driver_info).trim(),
        "largest_texture": adapter.limits().max_texture_dimension_2d,
        "compute": adapter.get_downlevel_capabilities().flags.contains(DownlevelFlags::COMPUTE_SHADERS),
        "timestamps": features.contains(Features::TIMESTAMP_QUERY),
        "f16": features.contains(Features::SHADER_F16),
        "subgroups": features.contains(Features::SUBGROUP),
        "float32_output": storage.contains(TextureUsages::STORAGE_BINDING),
    })
}
