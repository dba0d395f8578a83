//! Turns this crate's kernels, and a built-in one, into shaders and the Rust code that binds them.

use straightline_codegen::{Share, Unroll};

fn main() -> Result<(), straightline_codegen::config::Error> {
    straightline_codegen::Config::new()
        .kernel("sraa", |k| k.set("pattern", "latin4").set("metric", "depth"))
        .file_with("src/kernels/glow.rs", |k| {
            k.set("strength", "uniform")
                // The fastest of these depends on the GPU: `Pass::choose` times them.
                .candidate("looped", |s| s.unroll(Unroll::None))
                .candidate("shared", |s| s.share(Share::WORKGROUP))
        })
        .compile()
}
