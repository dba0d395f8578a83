//! SMAA's three passes as a chain, as fragment shaders.

use std::path::Path;
use straightline_bench::execute::{Bench, Inputs};
use straightline_codegen::chain::{Chain, ChainSpec};
use straightline_codegen::{Branches, Format, ShaderSpec, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_scene::picture;

fn examples() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples")
}

/// A table of the reference implementation.
pub fn table(name: &str) -> Frame<Vec4> {
    let path = examples().join(format!("gallery/{name}.png"));
    let stored = picture::read_integers(&path).unwrap_or_else(|e| panic!("{e}"));
    let texels = stored.texels().iter().map(|texel| texel.as_vec4() / 255.0);
    Frame::new(stored.size(), texels.collect())
}

/// The picture of `examples/chains/smaa.rs` in one form.
pub fn antialias(bench: &Bench, color: &Frame<Vec4>, unroll: Unroll, branches: Branches) -> Frame<Vec4> {
    let chain = Chain::from_file(&examples().join("chains/smaa.rs"), None).unwrap_or_else(|e| panic!("{e}"));
    let passes = ["smaa_edges", "smaa_weights", "smaa_blend"];
    let files = passes.map(|name| examples().join(format!("gallery/{name}.rs")));
    let chain = files
        .iter()
        .try_fold(chain.expect("a chain"), |chain, file| chain.with_file(file));
    let mut spec = ShaderSpec::new().unroll(unroll).branches(branches);
    spec.emit = spec.emit.stage(Stage::Fragment).format(Format::Rgba32Float);
    let compiled = chain.and_then(|chain| chain.compile(&ChainSpec::from(spec)));
    let emitted = compiled
        .and_then(|compiled| compiled.emit())
        .unwrap_or_else(|e| panic!("{e}"));
    let inputs = Inputs::new(color.size())
        .with_image("color", color.clone())
        .with_image("area", table("smaa_area"))
        .with_image("search", table("smaa_search"));
    let written = bench.run_chain(&emitted, &inputs).unwrap_or_else(|e| panic!("{e}"));
    written[0].frame()
}
