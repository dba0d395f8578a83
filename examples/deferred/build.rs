//! Turns the built-in kernels of SRAA into shaders and the Rust code that binds them: the filter once for each preset.

use straightline_codegen::config::{Config, Error, KernelConfig};

fn main() -> Result<(), Error> {
    let mut config = Config::new();
    for preset in ["paper", "fast", "edges", "full", "guided"] {
        config = config.kernel("sraa", |k| k.set("preset", preset).name(&format!("sraa_{preset}")));
    }
    config
        // Places of the shading: `full` has the same.
        .kernel("sraa_place", guided)
        // The guide: its scale from sums over tiles, its mean over each pixel, and the colours less the guide. The sums are fewer
        // than the pixels that they read, which only a region may be.
        .kernel("sraa_fit_sums", |k| guided(k).region(true))
        .kernel("sraa_fit", guided)
        .kernel("sraa_guide", guided)
        .kernel("sraa_residual", guided)
        .compile()
}

/// Options that kernels beside the filter share with it. The guide is the albedo in the light of a sun and of an even sky.
fn guided(kernel: KernelConfig) -> KernelConfig {
    kernel.set("preset", "guided").set("estimate", "diffuse")
}
