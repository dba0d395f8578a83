//! Errors of a text name the place in the kernel's source, by the text's source map.

use crate::common::{Gpu, Stage};
use straightline_runtime::codegen::spec::DebugInfo;
use straightline_runtime::manifest::{Manifest, SourceMap, hash_of_text};
use straightline_runtime::{Draw, DrawOptions, Error, KernelConfig, Pass, PassOptions, Shader};

const KERNEL: &str = "pub fn gain(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let brightness = color.load(pixel).x;
    let curve = brightness.sqrt() + brightness.sin();
    Vec4::new(curve, brightness * curve, brightness, 1.0)
}
";

/// A shader with one expression replaced, and its manifest and map, as if the generator had written it so.
fn emit(stage: Stage, from: &str, to: &str) -> (Manifest, String, SourceMap) {
    let path = std::env::temp_dir().join(format!("straightline-gain-{stage:?}-{}.rs", std::process::id()));
    std::fs::write(&path, KERNEL).expect("to write");
    let config = KernelConfig::from_file(&path)
        .function("gain")
        .stage(stage)
        .debug(DebugInfo::Map);
    let emitted = config.emit().expect("a good kernel");
    std::fs::remove_file(&path).expect("to remove");
    let wgsl = emitted.wgsl();
    assert!(wgsl.contains(from), "{wgsl}");
    let wgsl = wgsl.replacen(from, to, 1);
    let mut manifest = emitted.manifest.clone();
    manifest.hashes.insert("wgsl".to_owned(), hash_of_text(&wgsl));
    (manifest, wgsl, emitted.source_map.expect("a map"))
}

/// The statement of the third line.
const PLACE: &str = ".rs:3:17: brightness.sqrt() + brightness.sin()";

#[test]
fn a_text_that_does_not_parse() {
    let (manifest, wgsl, map) = emit(Stage::Compute, "sqrt(", "square_root(");
    let error = Shader::with_source_map(&manifest, &wgsl, map).expect_err("a refusal");
    let message = error.to_string();
    assert!(matches!(error, Error::Shader { .. }), "{message}");
    let place = message.lines().last().unwrap_or_default();
    assert!(
        place.starts_with("in the kernel: ") && place.ends_with(PLACE),
        "{message}"
    );
    // Without a map there is naga's message alone.
    let bare = Shader::from_manifest(&manifest, &wgsl)
        .expect_err("a refusal")
        .to_string();
    assert!(message.starts_with(&bare) && !bare.contains("in the kernel"), "{bare}");
}

#[test]
fn a_text_that_wgpu_refuses() {
    let gpu = Gpu::new();
    for stage in [Stage::Compute, Stage::Fragment] {
        // naga's parser accepts the index, its validator does not.
        let (manifest, wgsl, map) = emit(stage, "sqrt(brightness)", "array<f32, 2>(brightness, brightness)[2]");
        let shader = Shader::with_source_map(&manifest, &wgsl, map).expect("it parses");
        let options = DrawOptions::new("@vertex fn v() -> @builtin(position) vec4f { return vec4f(); }", "v");
        let errors = [
            Pass::from_shader(&gpu.device, &shader, &PassOptions::default()).err(),
            Draw::from_shader(&gpu.device, &shader, &options).err(),
        ];
        for error in errors.into_iter().take(if stage == Stage::Compute { 1 } else { 2 }) {
            let error = error.expect("a refusal");
            let message = error.to_string();
            assert!(matches!(error, Error::Shader { .. }), "{message}");
            let place = message.lines().last().unwrap_or_default();
            assert!(
                place.starts_with("in the kernel: ") && place.ends_with(PLACE),
                "{message}"
            );
        }
    }
}
