//! Running a kernel in the interpreter.

use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::{Kernel, Settings};
use straightline_kernels::prelude::{Frame, Vec4, uvec2};

#[test]
fn a_loop_without_end_ends_in_the_interpreter() {
    let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut s = color.load(pixel).x;
    loop { s = s * 0.5; if s > 100.0 { break; } }
    Vec4::splat(s)
}";
    let compiled = Kernel::from_text("k.rs", text, "k")
        .compile(&Settings::default())
        .unwrap_or_else(|e| panic!("{e}"));
    let mut inputs = Inputs::new(uvec2(1, 1));
    inputs.images = vec![("color".to_owned(), vec![Frame::new(uvec2(1, 1), vec![Vec4::ONE])])];
    let refused = interpret_kernel::<f32>(&compiled, &inputs, false)
        .expect_err("endless")
        .to_string();
    assert!(
        refused.contains("does not end at the pixel (0, 0)") && refused.contains("`k.while`"),
        "{refused}"
    );
}
