//! FXAA, a kernel among the examples; carried along so that it is there wherever the program runs.

use straightline_codegen::Kernel;

/// FXAA 3.11 (Lottes 2011), which reads `color` through the sampler `linear`.
pub fn fxaa() -> Kernel {
    let text = include_str!("../../../examples/kernels/fxaa.rs");
    Kernel::from_text("examples/kernels/fxaa.rs", text, "fxaa")
}
