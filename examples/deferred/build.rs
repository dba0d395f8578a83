//! Turns the built-in kernels of SRAA into shaders, and the Rust that binds them.

use straightline_codegen::config::KernelConfig;

fn main() -> Result<(), straightline_codegen::config::Error> {
    straightline_codegen::Config::new()
        // Where each pixel is shaded, and the filter. Numbers that are uniforms turn their parts off while the example runs; a
        // renderer that needs no switch sets the parts that it wants instead, and has less in its shader.
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

/// Four samples of geometry a pixel, and shading at one of these or at the pixel's centre. Depths count as shares of themselves, so that
/// a receding floor is one surface.
fn geometry(k: KernelConfig) -> KernelConfig {
    k.set("pattern", "latin4").set("shading", "placed").set("difference", "relative").set("depth-scale", 3)
}
