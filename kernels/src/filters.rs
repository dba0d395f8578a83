//! Ten well-known filters, each in a file of its own as a graphics programmer would write it: text for the generator, as a
//! starting point and for measurements. They are not built-in kernels; `straightline run kernels/filters/NAME.rs` runs one.

/// A file of `kernels/filters/`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Filter {
    /// Name of the filter and of its function.
    pub name: &'static str,
    /// Path in the repository.
    pub path: &'static str,
    /// Source text.
    pub text: &'static str,
}

macro_rules! filter {
    ($name:literal) => {
        Filter {
            name: $name,
            path: concat!("kernels/filters/", $name, ".rs"),
            text: include_str!(concat!("../filters/", $name, ".rs")),
        }
    };
}

/// FXAA 3.11 (Lottes 2011).
pub const FXAA: Filter = filter!("fxaa");

/// All ten filters.
pub const FILTERS: [Filter; 10] = [
    filter!("gaussian"),
    filter!("bilateral"),
    filter!("median"),
    filter!("sobel"),
    filter!("catmull_rom"),
    filter!("kuwahara"),
    FXAA,
    filter!("ssao"),
    filter!("joint_bilateral_upsampling"),
    filter!("convolution"),
];
