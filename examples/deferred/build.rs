//! Turns the built-in kernels of SRAA into shaders and the Rust code that binds them.

use straightline_codegen::config::KernelConfig;

fn main() -> Result<(), straightline_codegen::config::Error> {
    straightline_codegen::Config::new()
        // The pass that places shading, and the filter. Numbers that are uniforms turn their parts off while the example runs. A
        // renderer that needs no switch sets only the parts that it wants, which makes its shader smaller.
        .kernel("sraa_place", |k| geometry(k).set("unseen", "uniform"))
        .kernel("sraa", |k| {
            geometry(k)
                .set("search", "five")
                .set("search-threshold", "uniform")
                .set("demodulate", "albedo")
                .set("albedo-floor", "uniform")
                .set("rest", true)
                .set("history", 3)
        })
        .compile()
}

/// Four geometry samples a pixel, with shading at one of these or at the pixel's centre. Depth differences are relative, so that
/// a receding floor is one surface.
fn geometry(k: KernelConfig) -> KernelConfig {
    k.set("pattern", "latin4").set("shading", "placed").set("difference", "relative").set("depth-scale", 3)
}
