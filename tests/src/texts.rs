//! Kernels that a test writes down, as text and as rustc compiles them.

use crate::sraa::Random;
use straightline_codegen::{Compiled, Kernel, Settings};
use straightline_kernels::prelude::{Frame, UVec2, Vec4, vec4};

/// `kernel!(TEXT, module, { .. })`: a kernel's text, which rustc compiles here too.
#[macro_export]
macro_rules! kernel {
    ($text:ident, $module:ident, { $($source:tt)* }) => {
        #[allow(dead_code, clippy::all)]
        mod $module {
            use straightline_kernels::prelude::*;
            $($source)*
        }
        const $text: &str = stringify!($($source)*);
    };
}

/// A kernel of a text, compiled. Panics where it is wrong.
pub fn compiled(name: &str, text: &str, settings: &Settings) -> Compiled {
    let compiled = Kernel::from_text("kernel.rs", text, name).compile(settings);
    compiled.unwrap_or_else(|e| panic!("{name}:\n{e}"))
}

/// Random texels in multiples of 1/64, so that half precision has them too.
pub fn texels(size: UVec2, seed: u64) -> Frame<Vec4> {
    let mut random = Random(seed);
    let mut lane = || (random.unit() * 64.0).floor() / 64.0;
    let texels = (0..size.x * size.y).map(|_| vec4(lane(), lane(), lane(), lane()));
    Frame::new(size, texels.collect())
}
