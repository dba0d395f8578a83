//! FXAA, one of the ten filters; embedded, so that it is available wherever the program runs.

use straightline_codegen::Kernel;
use straightline_kernels::filters::FXAA;

/// FXAA 3.11 (Lottes 2011), which reads `color` through the sampler `linear`.
pub fn fxaa_kernel() -> Kernel {
    Kernel::from_text(FXAA.path, FXAA.text, FXAA.name)
}
