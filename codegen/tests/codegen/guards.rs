//! Guards of functions at the edges of their domains: fast mathematics drops them, and so do bounds that a kernel has by itself.

use straightline_codegen::emit::Target;
use straightline_codegen::{EmitOptions, Kernel};

/// With fast mathematics no function is guarded, and a power that is a product remains one.
#[test]
fn fast_mathematics_drops_the_guards() {
    let source = "use straightline_kernels::prelude::*;
pub fn k(one: f32, pixel: IVec2) -> Vec4 {
    vec4(one.atan2(one), one.powf(one), one.ln() + fract(one) + one.tanh() + one.atan(), one % 3.0 + one.powf(3.0))
}";
    let compiled = |math| {
        let settings = straightline_codegen::Settings::new().math(math);
        let compiled = Kernel::from_text("fast.rs", source, "k").compile(&settings);
        let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
        let emitted = compiled.emit(&EmitOptions::new().targets([Target::Wgsl]));
        let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
        String::from_utf8_lossy(&emitted.files[&Target::Wgsl]).into_owned()
    };
    let functions = |text: &str| text.lines().filter(|line| line.starts_with("fn ")).count();
    let exact = compiled(straightline_codegen::Math::Exact);
    for name in [
        "angle",
        "power",
        "natural_logarithm",
        "fraction",
        "hyperbolic_tangent",
        "arc_tangent",
        "remainder",
        "cube",
    ] {
        assert!(exact.contains(&format!("fn {name}(")), "{name}:\n{exact}");
    }
    let fast = compiled(straightline_codegen::Math::Fast);
    assert!(fast.contains("fn cube("), "{fast}");
    assert_eq!(functions(&fast), 2, "the entry point and the product:\n{fast}");
}

/// Arguments that a kernel bounds itself are not guarded again.
#[test]
fn bounded_arguments_need_no_guard() {
    let source = "use straightline_kernels::prelude::*;
pub fn k(one: f32, pixel: IVec2) -> Vec4 {
    let x = one.clamp(0.25, 8.0);
    let rounds = x.tanh() + x.sinh() + x.atan() + fract(x) + one.max(1.0e-6).ln() + one % 2.0;
    vec4(x.atan2(x), x.powf(x), saturate(one).powf(0.4545) + one.max(0.0).powf(0.5), rounds)
}";
    let compiled = Kernel::from_text("bounded.rs", source, "k").compile(&Default::default());
    let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
    let emitted = compiled.emit(&EmitOptions::new().targets([Target::Wgsl]));
    let emitted = emitted.unwrap_or_else(|e| panic!("{e}"));
    let text = String::from_utf8_lossy(&emitted.files[&Target::Wgsl]).into_owned();
    let functions = text.lines().filter(|line| line.starts_with("fn ")).count();
    assert_eq!(functions, 1, "the entry point alone:\n{text}");
}
