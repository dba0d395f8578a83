//! Generates the shaders of every preset: for perspective and for parallel cameras, with four and with sixteen samples.

use straightline_codegen::Format;
use straightline_codegen::config::{Config, Error, KernelConfig, Variants};

/// Options of all shaders with a number of samples: the name of the number, and the geometry of a pixel.
type Samples = (&'static str, fn(KernelConfig) -> KernelConfig);

/// One pass of a multisampled target, whose samples lie where Direct3D and Vulkan have them.
const FOUR: Samples = ("four", |k| k.set("pattern", "latin4").set("layout", "multisampled"));

/// A pass for each sample, into a layer of its own.
const SIXTEEN: Samples = ("sixteen", |k| k.set("pattern", "latin16").set("layout", "layers"));

/// A projection: the suffix of its shaders' names, and its options.
type Projection = (&'static str, fn(KernelConfig) -> KernelConfig);

const PERSPECTIVE: Projection = ("", |k| k);

/// Depth has another unit without an eye: it is the host's to set.
const PARALLEL: Projection = ("_parallel", |k| {
    k.set("projection", "parallel")
        .set("difference", "absolute")
        .set("depth-scale", "uniform")
});

fn main() -> Result<(), Error> {
    let samples = [FOUR].into_iter().chain(feature("SIXTEEN", SIXTEEN));
    let projections: Vec<_> = [PERSPECTIVE].into_iter().chain(feature("PARALLEL", PARALLEL)).collect();
    let mut config = Config::new();
    for samples in samples {
        for projection in &projections {
            config = add_filters(config, samples, *projection);
        }
        config = add_guide(config, samples);
    }
    config
        // A row of tiles sums up to more than a half can hold.
        .kernel("sraa_fit_rows", |k| guided(k).format(Format::Rgba32Float).region(true))
        .kernel("sraa_fit", guided)
        .compile()
}

/// Returns a value if cargo enables a feature.
fn feature<T>(name: &str, value: T) -> Option<T> {
    std::env::var_os(format!("CARGO_FEATURE_{name}")).map(|_| value)
}

/// Adds the filter of each preset, and the kernel that places shading.
fn add_filters(config: Config, (count, geometry): Samples, (suffix, camera): Projection) -> Config {
    let filters = ["paper", "fast", "edges", "full", "guided"];
    let named = |k: KernelConfig, kernel: &str| camera(geometry(k)).name(&format!("{kernel}_{count}{suffix}"));
    config
        .kernel("sraa", |k| {
            named(k, "sraa").variants(|v| depths(v.set("preset", filters)))
        })
        // Both presets that place have the same shader.
        .kernel("sraa_place", |k| guided(named(k, "place")).variants(depths))
}

/// Encodings of depth in a depth buffer.
fn depths(variants: Variants) -> Variants {
    variants.set("depth", ["perspective", "reversed"])
}

/// Adds the kernels of the guide that read the geometry.
fn add_guide(config: Config, (count, geometry): Samples) -> Config {
    let named = |k: KernelConfig, kernel: &str| guided(geometry(k)).name(&format!("{kernel}_{count}"));
    config
        // The sums are fewer than the pixels that they read, which only a region may be.
        .kernel("sraa_fit_sums", |k| named(k, "fit_sums").region(true))
        .kernel("sraa_guide", |k| named(k, "guide"))
        .kernel("sraa_residual", |k| named(k, "residual"))
}

fn guided(kernel: KernelConfig) -> KernelConfig {
    kernel.set("preset", "guided")
}
